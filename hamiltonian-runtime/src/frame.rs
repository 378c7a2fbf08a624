//! The loop that runs the code of a frame.
//!
//! Input: operations on registers alone, and a [`Frame`]. Output: changes of its registers. Invariant: the same operations in
//! the same order as those of `machine`, so that the bits agree.

use crate::machine::{of_registers, put, sin_cos_apart};
use crate::op::{EIGHT, Op, Register};
use crate::registers::{FRAME, Frame};
use hamiltonian_lanes::Real;

/// Runs the code of a frame; compiled once for each scalar.
#[inline(always)]
pub(crate) fn in_frame<T: Real>(ops: &[Op], t: T, frame: &mut Frame<T>) {
    T::out_of_line(
        #[inline(always)]
        || in_frame_here(ops, t, &mut frame.numbers, &mut frame.masks),
    );
}

#[inline(always)]
fn in_frame_here<T: Real>(
    mut ops: &[Op],
    t: T,
    r: &mut [T; FRAME[0]],
    m: &mut [T::Mask; FRAME[1]],
) {
    let number = |register: Register| register as usize % FRAME[0];
    let mut last = T::zero();
    // The most frequent operations, as long as they are equal: the CPU foresees that without the jump of a match.
    macro_rules! repeated {
        ($kind:ident($($from:ident),+) => $value:expr) => {
            while let [Op::$kind(to, $($from),+), rest @ ..] = ops {
                put!(r, [last], number(*to), $value);
                ops = rest;
            }
        };
    }
    while let [op, rest @ ..] = ops {
        match op {
            Op::Mul(..) => repeated!(Mul(a, b) => r[number(*a)] * r[number(*b)]),
            Op::Add(..) => repeated!(Add(a, b) => r[number(*a)] + r[number(*b)]),
            Op::Sub(..) => repeated!(Sub(a, b) => r[number(*a)] - r[number(*b)]),
            Op::MulAdd(..) => {
                repeated!(MulAdd(a, b, c) => r[number(*a)].fma(r[number(*b)], r[number(*c)]));
            }
            _ => {
                of_registers!(*op, T, r, m, [last], number, {
                    Op::Time(to) => put!(r, [last], number(to), t),
                    Op::EightAdd(to, a, b) => eight(r, to, [a, b], |[a, b]| a + b),
                    Op::EightSub(to, a, b) => eight(r, to, [a, b], |[a, b]| a - b),
                    Op::EightMul(to, a, b) => eight(r, to, [a, b], |[a, b]| a * b),
                    Op::EightMulAdd(to, a, b, c) => {
                        eight(r, to, [a, b, c], |[a, b, c]| a.fma(b, c));
                    }
                    Op::EightRecip(to, a) => eight(r, to, [a], |[a]| a.recip()),
                    Op::EightSqrt(to, a) => eight(r, to, [a], |[a]| a.sqrt()),
                    // A frame has none of the others.
                    _ => {}
                });
                ops = rest;
            }
        }
    }
}

/// Runs an operation on eight registers each.
#[inline(always)]
fn eight<T: Real, const N: usize>(
    r: &mut [T; FRAME[0]],
    to: Register,
    from: [Register; N],
    f: impl Fn([T; N]) -> T,
) {
    let place = |register: Register| register as usize % (FRAME[0] - EIGHT);
    let (to, from) = (place(to), from.map(place));
    if const { T::LANES == 1 } {
        // Numbers are read before any is written, so that they lie in lanes.
        let read = from.map(|from| -> [T; EIGHT] { std::array::from_fn(|k| r[from + k]) });
        let results: [T; EIGHT] = std::array::from_fn(|k| f(read.map(|read| read[k])));
        r[to..to + EIGHT].copy_from_slice(&results);
    } else {
        for k in 0..EIGHT {
            r[to + k] = f(from.map(|from| r[from + k]));
        }
    }
}
