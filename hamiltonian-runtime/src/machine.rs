//! The loop that runs flat code, over any scalar.
//!
//! Input: a [`Stage`], the numbers that it holds, and arrays. Output: results, and changes of arrays. Invariant: the same
//! operations in the same order as `interpret` of hamiltonian-symbolic, so that the bits agree; nothing is allocated after the
//! first call.

use crate::op::{Change, DEPTH, From, Op, Register, Stage, To};
use crate::registers::{Home, SHORT};
use crate::tabulated::Tabulated;
use hamiltonian_lanes::{Mask, Real};

/// The least number of iterations of an innermost loop whose sums are trees.
pub(crate) const LONG: i64 = 32;

/// The same of code that is shorter still. Registers on the stack are cleared at each call, which would take longer than the
/// code.
const SHORTEST: [usize; 2] = [8, 1];

/// True if a stage is short code that reads no variable of a loop.
pub(crate) fn is_short(stage: &Stage) -> bool {
    let is_plain = |op: &Op| {
        !matches!(
            op,
            Op::Number(..)
                | Op::Count(..)
                | Op::LoadAt(..)
                | Op::StoreAt(..)
                | Op::Accumulate { .. }
                | Op::Loop(_)
                | Op::End(_)
        )
    };
    stage.registers <= SHORT[0] && stage.masks <= SHORT[1] && stage.ops.iter().all(is_plain)
}

/// True if short code needs the fewest registers.
pub(crate) fn is_shortest(stage: &Stage) -> bool {
    stage.registers <= SHORTEST[0] && stage.masks <= SHORTEST[1]
}

/// What a stage is given.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a, T> {
    /// The numbers that it holds, and behind them those of the step coefficient: the first registers.
    pub(crate) numbers: &'a [T],
    /// The arrays of parameters, and those that preparation fills.
    pub(crate) data: &'a [T],
    /// The functions with data.
    pub(crate) functions: &'a [Tabulated],
}

/// The arrays of an evaluation.
pub(crate) struct Arrays<'a, T> {
    pub(crate) t: T,
    pub(crate) c: T,
    pub(crate) q: &'a [T],
    pub(crate) p: &'a [T],
    pub(crate) direction: [&'a [T]; 2],
    pub(crate) into_q: &'a mut [T],
    pub(crate) into_p: &'a mut [T],
    pub(crate) into_data: &'a mut [T],
}

impl<T: Real> Arrays<'_, T> {
    /// No arrays.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Arrays {
            t: T::zero(),
            c: T::zero(),
            q: &[],
            p: &[],
            direction: [&[], &[]],
            into_q: &mut [],
            into_p: &mut [],
            into_data: &mut [],
        }
    }

    #[inline(always)]
    fn read(&self, data: &[T], from: From, at: usize) -> T {
        match from {
            From::Q => self.q[at],
            From::P => self.p[at],
            From::VQ => self.direction[0][at],
            From::VP => self.direction[1][at],
            From::Data => data[at],
            From::Written(To::Q) => self.into_q[at],
            From::Written(To::P) => self.into_p[at],
            From::Written(To::Data) => self.into_data[at],
        }
    }

    #[inline(always)]
    fn written(&mut self, to: To) -> &mut [T] {
        match to {
            To::Q => self.into_q,
            To::P => self.into_p,
            To::Data => self.into_data,
        }
    }

    #[inline(always)]
    fn clear(&mut self, (to, start, end): (To, usize, usize)) {
        for element in &mut self.written(to)[start..end] {
            *element = T::zero();
        }
    }

    #[inline(always)]
    fn change(&mut self, to: To, at: usize, change: Change, [a, b]: [T; 2]) {
        let element = &mut self.written(to)[at];
        *element = match change {
            Change::Set => a,
            Change::Add => *element + a,
            Change::Sub => *element - a,
            Change::AddProduct => a.fma(b, *element),
            Change::SubProduct => (-a).fma(b, *element),
        };
    }
}

/// Runs a stage from the numbers that it is given, and writes its results.
#[inline(always)]
pub(crate) fn run<T: Real>(
    stage: &Stage,
    given: Given<'_, T>,
    home: Home<'_, T>,
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    T::out_of_line(
        #[inline(always)]
        || run_here(stage, given, home, arrays, results),
    );
}

/// Runs a stage by the code for its length and its scalar. Each is compiled for every scalar, so dual numbers, whose
/// operations take longer than finding them, have that for any length alone.
#[inline(always)]
fn run_here<T: Real>(
    stage: &Stage,
    given: Given<'_, T>,
    home: Home<'_, T>,
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    for range in &stage.cleared {
        arrays.clear(*range);
    }
    if const { T::DUALS == 0 }
        && let Some(ops) = &stage.short
    {
        if let Home::Pool(_) = home
            && is_shortest(stage)
        {
            let mut numbers = [T::zero(); SHORTEST[0]];
            let mut masks = [T::Mask::splat(false); SHORTEST[1]];
            return straight(stage, ops, given, &mut numbers, &mut masks, arrays, results);
        }
        let mut on_stack;
        let (numbers, masks) = match home {
            Home::Own(registers) => (&mut *registers.numbers, &mut *registers.masks),
            Home::Pool(_) => {
                on_stack = ([T::zero(); SHORT[0]], [T::Mask::splat(false); SHORT[1]]);
                (&mut on_stack.0, &mut on_stack.1)
            }
        };
        return straight(stage, ops, given, numbers, masks, arrays, results);
    }
    let mut taken = None;
    let registers = match home {
        Home::Own(registers) => registers,
        Home::Pool(pool) => &mut taken.insert((pool, pool.take())).1,
    };
    if registers.long.0.len() < stage.registers || registers.long.1.len() < stage.masks {
        registers.grow(stage);
    }
    let (numbers, masks) = &mut registers.long;
    for (to, from) in numbers.iter_mut().zip(given.numbers) {
        *to = *from;
    }
    with_loops(stage, given, numbers, masks, arrays);
    for (to, from) in results.iter_mut().zip(&stage.results) {
        *to = numbers[*from as usize];
    }
    if let Some((pool, registers)) = taken {
        pool.give(registers);
    }
}

/// The sine and the cosine, compiled once for all loops over a scalar.
#[inline(always)]
pub(crate) fn sin_cos_apart<T: Real>(angle: T) -> (T, T) {
    T::out_of_line(
        #[inline(always)]
        || angle.sin_cos(),
    )
}

/// A loop that runs.
#[derive(Clone, Copy)]
struct Loop {
    /// The first value of its variable.
    first: i64,
    /// The value behind the last one.
    behind: i64,
    /// True if its sums are trees.
    is_long: bool,
}

/// Writes a result, and keeps it as the last one where there is a variable for it.
macro_rules! put {
    ($r:ident, [$($last:ident)?], $index:expr, $value:expr) => {{
        let value = $value;
        $($last = value;)?
        $r[$index] = value;
    }};
}

/// Runs an operation of registers, or one of the arms behind. With a variable for the last result, it runs operations that
/// read that.
macro_rules! of_registers {
    ($op:expr, $T:ty, $r:ident, $m:ident, [$($last:ident)?], $index:ident, { $($arms:tt)* }) => {{
        macro_rules! set {
            ($to:expr, $value:expr) => {
                put!($r, [$($last)?], $index($to), $value)
            };
        }
        match $op {
            Op::Copy(to, a) => set!(to, $r[$index(a)]),
            Op::Neg(to, a) => set!(to, -$r[$index(a)]),
            Op::Add(to, a, b) => set!(to, $r[$index(a)] + $r[$index(b)]),
            Op::Sub(to, a, b) => set!(to, $r[$index(a)] - $r[$index(b)]),
            Op::Mul(to, a, b) => set!(to, $r[$index(a)] * $r[$index(b)]),
            Op::MulAdd(to, a, b, c) => {
                set!(to, $r[$index(a)].fma($r[$index(b)], $r[$index(c)]));
            }
            Op::MulSub(to, a, b, c) => {
                set!(to, $r[$index(a)].fma($r[$index(b)], -$r[$index(c)]));
            }
            Op::NegMulAdd(to, a, b, c) => {
                set!(to, (-$r[$index(a)]).fma($r[$index(b)], $r[$index(c)]));
            }
            Op::Div(to, a, b) => set!(to, $r[$index(a)] / $r[$index(b)]),
            Op::Recip(to, a) => set!(to, $r[$index(a)].recip()),
            Op::Sqrt(to, a) => set!(to, $r[$index(a)].sqrt()),
            Op::Call(to, function, a) => set!(to, function.eval_apart(&[$r[$index(a)]])),
            Op::CallTwo(to, function, a, b) => {
                set!(to, function.eval_apart(&[$r[$index(a)], $r[$index(b)]]));
            }
            Op::CallThree(to, function, a, b, c) => {
                set!(to, function.eval_apart(&[$r[$index(a)], $r[$index(b)], $r[$index(c)]]));
            }
            Op::SinCos(sin, cos, a) => {
                let angle = $r[$index(a)];
                let (s, c) = sin_cos_apart(angle);
                $r[$index(sin)] = s;
                set!(cos, c);
            }
            Op::Less(to, a, b) => $m[$index(to)] = $r[$index(a)].lt($r[$index(b)]),
            Op::LessEqual(to, a, b) => $m[$index(to)] = $r[$index(a)].le($r[$index(b)]),
            Op::Equal(to, a, b) => $m[$index(to)] = $r[$index(a)].equals($r[$index(b)]),
            Op::Not(to, a) => $m[$index(to)] = !$m[$index(a)],
            Op::And(to, a, b) => $m[$index(to)] = $m[$index(a)] & $m[$index(b)],
            Op::Or(to, a, b) => $m[$index(to)] = $m[$index(a)] | $m[$index(b)],
            Op::Select(to, mask, a, b) => {
                set!(to, <$T>::select($m[$index(mask)], $r[$index(a)], $r[$index(b)]));
            }
            Op::Number01(to, mask) => {
                set!(to, <$T>::select($m[$index(mask)], <$T>::one(), <$T>::zero()));
            }
            Op::IsOne(to, a) => $m[$index(to)] = $r[$index(a)].equals(<$T>::one()),
            $(
                Op::LastAdd(to, b) => set!(to, $last + $r[$index(b)]),
                Op::LastSub(to, b) => set!(to, $last - $r[$index(b)]),
                Op::SubLast(to, a) => set!(to, $r[$index(a)] - $last),
                Op::LastMul(to, b) => set!(to, $last * $r[$index(b)]),
                Op::LastSquare(to) => set!(to, $last * $last),
                Op::LastMulAdd(to, b, c) => set!(to, $last.fma($r[$index(b)], $r[$index(c)])),
                Op::MulAddLast(to, a, b) => set!(to, $r[$index(a)].fma($r[$index(b)], $last)),
                Op::LastNegMulAdd(to, b, c) => set!(to, (-$last).fma($r[$index(b)], $r[$index(c)])),
                Op::NegMulAddLast(to, a, b) => set!(to, (-$r[$index(a)]).fma($r[$index(b)], $last)),
                Op::LastCall(to, function) => set!(to, function.eval_apart(&[$last])),
            )?
            $($arms)*
        }
    }};
}

/// Runs an operation: those that need no loop, or one of the arms behind.
macro_rules! operation {
    ($op:expr, $T:ty, $r:ident, $m:ident, [$($last:ident)?], $index:ident, $given:ident, $arrays:ident, { $($arms:tt)* }) => {
        of_registers!($op, $T, $r, $m, [$($last)?], $index, {
            Op::Time(to) => put!($r, [$($last)?], $index(to), $arrays.t),
            Op::Coefficient(to) => put!($r, [$($last)?], $index(to), $arrays.c),
            Op::Load(to, from, at) => put!($r, [$($last)?], $index(to), $arrays.read($given.data, from, at as usize)),
            Op::LoadQ(to, at) => put!($r, [$($last)?], $index(to), $arrays.q[at as usize]),
            Op::LoadP(to, at) => put!($r, [$($last)?], $index(to), $arrays.p[at as usize]),
            Op::AddToQ(at, a) => $arrays.into_q[at as usize] += $r[$index(a)],
            Op::AddToP(at, a) => $arrays.into_p[at as usize] += $r[$index(a)],
            Op::AddProductToQ(at, a, b) => {
                let element = &mut $arrays.into_q[at as usize];
                *element = $r[$index(a)].fma($r[$index(b)], *element);
            }
            Op::AddProductToP(at, a, b) => {
                let element = &mut $arrays.into_p[at as usize];
                *element = $r[$index(a)].fma($r[$index(b)], *element);
            }
            Op::SubProductFromQ(at, a, b) => {
                let element = &mut $arrays.into_q[at as usize];
                *element = (-$r[$index(a)]).fma($r[$index(b)], *element);
            }
            Op::SubProductFromP(at, a, b) => {
                let element = &mut $arrays.into_p[at as usize];
                *element = (-$r[$index(a)]).fma($r[$index(b)], *element);
            }
            Op::External(to, function, derivative, a, b) => {
                let function = &$given.functions[usize::from(function)];
                let at = [$r[$index(a)], $r[$index(b)]];
                put!($r, [$($last)?], $index(to), function.derivative(derivative, at));
            }
            Op::Store(to, at, change, a, b) => {
                $arrays.change(to, at as usize, change, [$r[$index(a)], $r[$index(b)]]);
            }
            $($arms)*
        })
    };
}

pub(crate) use {of_registers, put};

/// The place of a register.
#[inline(always)]
fn long(register: Register) -> usize {
    register as usize
}

/// Runs short code without loops.
#[inline(always)]
fn straight<T: Real, const N: usize, const M: usize>(
    stage: &Stage,
    ops: &[Op],
    given: Given<'_, T>,
    r: &mut [T; N],
    m: &mut [T::Mask; M],
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    // A power of two, so that a masked number of a register is one of them.
    let short = |register: Register| register as usize % N;
    for (to, from) in r.iter_mut().zip(given.numbers) {
        *to = *from;
    }
    let mut last = T::zero();
    for op in ops {
        operation!(*op, T, r, m, [last], short, given, arrays, {
            // Short code has none of the others.
            _ => {}
        });
    }
    for (to, from) in results.iter_mut().zip(&stage.results) {
        *to = r[short(*from)];
    }
}

/// Runs code with loops.
#[inline(always)]
fn with_loops<T: Real>(
    stage: &Stage,
    given: Given<'_, T>,
    r: &mut [T],
    m: &mut [T::Mask],
    arrays: &mut Arrays<'_, T>,
) {
    let mut variables = [0_i64; DEPTH];
    let none = Loop {
        first: 0,
        behind: 0,
        is_long: false,
    };
    let mut frames = [none; DEPTH];
    let mut next = 0;
    while let Some(op) = stage.ops.get(next) {
        next += 1;
        operation!(*op, T, r, m, [], long, given, arrays, {
            Op::Number(to, form) => {
                let value = stage.forms[form as usize].value(&variables);
                r[to as usize] = T::constant(value as f64, 0.0);
            }
            Op::Count(to, start, end) => {
                let [start, end] =
                    [start, end].map(|form| stage.forms[form as usize].value(&variables));
                r[to as usize] = T::constant((end - start).max(0) as f64, 0.0);
            }
            Op::LoadAt(to, from, address) => {
                let at = stage.addresses[address as usize].value(&variables);
                r[to as usize] = arrays.read(given.data, from, at);
            }
            Op::Accumulate {
                sum,
                term,
                partial,
                level,
            } => {
                let term = r[term as usize];
                let level = usize::from(level);
                let frame = frames[level];
                let to = match frame.is_long {
                    true => partial as usize + ((variables[level] - frame.first) % 8) as usize,
                    false => sum as usize,
                };
                r[to] += term;
            }
            Op::StoreAt(to, address, change, a, b) => {
                let at = stage.addresses[address as usize].value(&variables);
                arrays.change(to, at, change, [r[a as usize], r[b as usize]]);
            }
            Op::Loop(number) => {
                let of = &stage.loops[number as usize];
                let [start, end] = [&of.start, &of.end].map(|form| form.value(&variables));
                let end = end.min(of.most);
                for sum in &of.zero {
                    r[*sum as usize] = T::zero();
                }
                if end <= start {
                    next = of.after;
                    continue;
                }
                let is_long = !of.trees.is_empty() && end - start >= of.long;
                if is_long {
                    for (_, partial) in &of.trees {
                        for k in 0..8 {
                            r[*partial as usize + k] = T::zero();
                        }
                    }
                }
                let [first, behind] = match of.step < 0 {
                    true => [end - 1, start - 1],
                    false => [start, end],
                };
                frames[of.level] = Loop {
                    first,
                    behind,
                    is_long,
                };
                variables[of.level] = first;
            }
            Op::End(number) => {
                let of = &stage.loops[number as usize];
                let frame = frames[of.level];
                variables[of.level] += of.step;
                if variables[of.level] != frame.behind {
                    next = of.body;
                } else if frame.is_long {
                    for (sum, partial) in &of.trees {
                        let s = &r[*partial as usize..*partial as usize + 8];
                        let tree =
                            ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
                        r[*sum as usize] += tree;
                    }
                }
            }
            // Code with loops has none of the others.
            _ => {}
        });
    }
}
