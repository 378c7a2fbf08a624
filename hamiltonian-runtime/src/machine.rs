//! The loop that runs flat code, over any scalar.
//!
//! Input: a [`Stage`], the numbers that it holds, and arrays. Output: results, and changes of arrays. Invariant: the same
//! operations in the same order as `interpret` of hamiltonian-symbolic, so that the bits agree; nothing is allocated for
//! up to [`FEW`] registers, and for more after the first call.

use crate::op::{Change, DEPTH, From, Op, Stage, To};
use hamiltonian_lanes::{Mask, Real};
use std::sync::{Arc, Mutex, PoisonError};

/// The least number of iterations of an innermost loop whose sums are trees.
const LONG: i64 = 32;

/// The registers, and those of conditions, that are on the stack.
pub(crate) const FEW: [usize; 2] = [96, 16];

/// What a stage is given.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a, T> {
    /// The numbers that it holds.
    pub(crate) held: &'a [T],
    /// Those of the step coefficient.
    pub(crate) folded: &'a [T],
    /// The arrays of parameters, and those that preparation fills.
    pub(crate) data: &'a [T],
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
    pub(crate) fn clear(&mut self, (to, start, end): (To, usize, usize)) {
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

/// Registers of long code, which are kept from call to call.
#[derive(Debug)]
pub(crate) struct Pool<T: Real>(Arc<Mutex<Vec<Registers<T>>>>);

type Registers<T> = (Vec<T>, Vec<<T as Real>::Mask>);

impl<T: Real> Pool<T> {
    pub(crate) fn new() -> Self {
        Pool(Arc::new(Mutex::new(Vec::new())))
    }

    #[cold]
    fn take(&self, stage: &Stage) -> Registers<T> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let (mut numbers, mut masks) = kept.unwrap_or_default();
        numbers.resize(numbers.len().max(stage.registers), T::zero());
        masks.resize(masks.len().max(stage.masks), T::Mask::splat(false));
        (numbers, masks)
    }

    #[cold]
    fn give(&self, registers: Registers<T>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push(registers);
    }
}

impl<T: Real> Clone for Pool<T> {
    fn clone(&self) -> Self {
        Pool(self.0.clone())
    }
}

/// Runs a stage from the numbers that it holds and those of the step coefficient, and writes its results.
#[inline(always)]
pub(crate) fn run<T: Real>(
    stage: &Stage,
    given: Given<'_, T>,
    pool: &Pool<T>,
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    T::out_of_line(|| run_here(stage, given, pool, arrays, results));
}

#[inline(always)]
fn run_here<T: Real>(
    stage: &Stage,
    given: Given<'_, T>,
    pool: &Pool<T>,
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    const SHORT: usize = 24;
    let few = stage.masks <= FEW[1];
    if few && stage.registers <= SHORT {
        let mut numbers = [T::zero(); SHORT];
        let mut masks = [T::Mask::splat(false); FEW[1]];
        filled(stage, given, &mut numbers, &mut masks, arrays, results);
    } else if few && stage.registers <= FEW[0] {
        let mut numbers = [T::zero(); FEW[0]];
        let mut masks = [T::Mask::splat(false); FEW[1]];
        filled(stage, given, &mut numbers, &mut masks, arrays, results);
    } else {
        let (mut numbers, mut masks) = pool.take(stage);
        filled(stage, given, &mut numbers, &mut masks, arrays, results);
        pool.give((numbers, masks));
    }
}

#[inline(always)]
fn filled<T: Real>(
    stage: &Stage,
    Given { held, folded, data }: Given<'_, T>,
    numbers: &mut [T],
    masks: &mut [T::Mask],
    arrays: &mut Arrays<'_, T>,
    results: &mut [T],
) {
    for (to, from) in numbers.iter_mut().zip(held.iter().chain(folded)) {
        *to = *from;
    }
    T::out_of_line(|| execute(stage, data, numbers, masks, arrays));
    for (to, from) in results.iter_mut().zip(&stage.results) {
        *to = numbers[*from as usize];
    }
}

/// A loop that runs.
#[derive(Clone, Copy)]
struct Frame {
    start: i64,
    end: i64,
    /// True if its sums are trees.
    is_long: bool,
}

#[inline(always)]
fn execute<T: Real>(
    stage: &Stage,
    data: &[T],
    r: &mut [T],
    m: &mut [T::Mask],
    arrays: &mut Arrays<'_, T>,
) {
    let mut variables = [0_i64; DEPTH];
    let none = Frame {
        start: 0,
        end: 0,
        is_long: false,
    };
    let mut frames = [none; DEPTH];
    let mut next = 0;
    while let Some(op) = stage.ops.get(next) {
        next += 1;
        match *op {
            Op::Time(to) => r[to as usize] = arrays.t,
            Op::Coefficient(to) => r[to as usize] = arrays.c,
            Op::Number(to, form) => {
                let value = stage.forms[form as usize].value(&variables);
                r[to as usize] = T::constant(value as f64, 0.0);
            }
            Op::Count(to, start, end) => {
                let [start, end] =
                    [start, end].map(|form| stage.forms[form as usize].value(&variables));
                r[to as usize] = T::constant((end - start).max(0) as f64, 0.0);
            }
            Op::Load(to, from, at) => r[to as usize] = arrays.read(data, from, at as usize),
            Op::LoadAt(to, from, address) => {
                let at = stage.addresses[address as usize].value(&variables);
                r[to as usize] = arrays.read(data, from, at);
            }
            Op::Neg(to, a) => r[to as usize] = -r[a as usize],
            Op::Add(to, a, b) => r[to as usize] = r[a as usize] + r[b as usize],
            Op::Sub(to, a, b) => r[to as usize] = r[a as usize] - r[b as usize],
            Op::Mul(to, a, b) => r[to as usize] = r[a as usize] * r[b as usize],
            Op::MulAdd(to, a, b, c) => {
                r[to as usize] = r[a as usize].fma(r[b as usize], r[c as usize]);
            }
            Op::MulSub(to, a, b, c) => {
                r[to as usize] = r[a as usize].fma(r[b as usize], -r[c as usize]);
            }
            Op::NegMulAdd(to, a, b, c) => {
                r[to as usize] = (-r[a as usize]).fma(r[b as usize], r[c as usize]);
            }
            Op::Div(to, a, b) => r[to as usize] = r[a as usize] / r[b as usize],
            Op::Recip(to, a) => r[to as usize] = r[a as usize].recip(),
            Op::Call(to, function, a) => r[to as usize] = function.eval_apart(&[r[a as usize]]),
            Op::CallTwo(to, function, a, b) => {
                r[to as usize] = function.eval_apart(&[r[a as usize], r[b as usize]]);
            }
            Op::CallThree(to, function, a, b, c) => {
                r[to as usize] =
                    function.eval_apart(&[r[a as usize], r[b as usize], r[c as usize]]);
            }
            Op::SinCos(sin, cos, a) => {
                let angle = r[a as usize];
                let (s, c) = T::out_of_line(|| angle.sin_cos());
                r[sin as usize] = s;
                r[cos as usize] = c;
            }
            Op::Less(to, a, b) => m[to as usize] = r[a as usize].lt(r[b as usize]),
            Op::LessEqual(to, a, b) => m[to as usize] = r[a as usize].le(r[b as usize]),
            Op::Equal(to, a, b) => m[to as usize] = r[a as usize].equals(r[b as usize]),
            Op::Not(to, a) => m[to as usize] = !m[a as usize],
            Op::And(to, a, b) => m[to as usize] = m[a as usize] & m[b as usize],
            Op::Or(to, a, b) => m[to as usize] = m[a as usize] | m[b as usize],
            Op::Select(to, mask, a, b) => {
                r[to as usize] = T::select(m[mask as usize], r[a as usize], r[b as usize]);
            }
            Op::Number01(to, mask) => {
                r[to as usize] = T::select(m[mask as usize], T::one(), T::zero());
            }
            Op::IsOne(to, a) => m[to as usize] = r[a as usize].equals(T::one()),
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
                    true => partial as usize + ((variables[level] - frame.start) % 8) as usize,
                    false => sum as usize,
                };
                r[to] += term;
            }
            Op::Store(to, at, change, a, b) => {
                arrays.change(to, at as usize, change, [r[a as usize], r[b as usize]]);
            }
            Op::StoreAt(to, address, change, a, b) => {
                let at = stage.addresses[address as usize].value(&variables);
                arrays.change(to, at, change, [r[a as usize], r[b as usize]]);
            }
            Op::Loop(number) => {
                let of = &stage.loops[number as usize];
                let [start, end] = [&of.start, &of.end].map(|form| form.value(&variables));
                for sum in &of.zero {
                    r[*sum as usize] = T::zero();
                }
                if end <= start {
                    next = of.after;
                    continue;
                }
                let is_long = !of.trees.is_empty() && end - start >= LONG;
                if is_long {
                    for (_, partial) in &of.trees {
                        for k in 0..8 {
                            r[*partial as usize + k] = T::zero();
                        }
                    }
                }
                frames[of.level] = Frame {
                    start,
                    end,
                    is_long,
                };
                variables[of.level] = start;
            }
            Op::End(number) => {
                let of = &stage.loops[number as usize];
                let frame = frames[of.level];
                variables[of.level] += 1;
                if variables[of.level] < frame.end {
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
        }
    }
}
