//! A scalar that records the operations on it: for error bounds by a reverse sweep over a
//! program's own operations, and for counting the operations of loops.
//!
//! Input: `f64`s. Output: the same bits as `f64`, and a tape of the thread's operations.
//! Invariant: inputs and exact constants are not on the tape, because they carry no error.

use hamiltonian_lanes::{Dual, Real};
use std::cell::RefCell;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number whose operations are recorded.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    pub value: f64,
    /// Its place on the tape.
    at: Option<u32>,
}

struct Record {
    name: &'static str,
    value: f64,
    /// Operands on the tape with the derivatives by them.
    operands: [Option<(u32, f64)>; 2],
    /// True if it is a zero that mathematics does not know.
    vanished: bool,
}

thread_local! {
    static TAPE: RefCell<Vec<Record>> = const { RefCell::new(Vec::new()) };
}

/// Forgets the record.
pub fn start() {
    TAPE.with_borrow_mut(Vec::clear);
}

/// The number of operations of that name that were recorded (`+`, `-`, `*`, `/`, `neg`, functions by name; a
/// fused multiply–add is both).
pub fn count(name: &str) -> usize {
    TAPE.with_borrow(|tape| tape.iter().filter(|r| r.name == name).count())
}

/// Returns true if something recorded overflowed, or lost digits by underflow.
pub fn left_range() -> bool {
    TAPE.with_borrow(|tape| {
        tape.iter().any(|r| {
            let size = r.value.abs();
            size > 1e290 || (size < 1e-290 && (size != 0.0 || r.vanished))
        })
    })
}

/// Σ |∂out/∂node|·|node| over everything recorded.
pub fn sensitivity(out: Traced) -> f64 {
    let Some(last) = out.at else { return 0.0 };
    TAPE.with_borrow(|tape| {
        let mut adjoints = vec![0.0; last as usize + 1];
        adjoints[last as usize] = 1.0;
        let mut total = 0.0;
        for at in (0..=last as usize).rev() {
            let adjoint: f64 = adjoints[at];
            if adjoint == 0.0 {
                continue;
            }
            total += (adjoint * tape[at].value).abs();
            for (operand, slope) in tape[at].operands.iter().flatten() {
                adjoints[*operand as usize] += adjoint * slope;
            }
        }
        total
    })
}

fn record(name: &'static str, value: f64, operands: [Option<(Traced, f64)>; 2]) -> Traced {
    let nonzero = operands.iter().flatten().all(|(x, _)| x.value != 0.0);
    let vanished = value == 0.0
        && match name {
            "*" | "/" | "pow" => nonzero,
            "exp" => true,
            _ => false,
        };
    let operands = operands.map(|o| o.and_then(|(x, slope)| x.at.map(|at| (at, slope))));
    TAPE.with_borrow_mut(|tape| {
        tape.push(Record {
            name,
            value,
            operands,
            vanished,
        });
        Traced {
            value,
            at: Some(tape.len() as u32 - 1),
        }
    })
}

impl Traced {
    /// An exact input.
    pub fn input(value: f64) -> Traced {
        Traced { value, at: None }
    }
    fn one(self, name: &'static str, f: impl Fn(Dual<f64>) -> Dual<f64>, value: f64) -> Traced {
        let slope = f(Dual::variable(self.value)).eps;
        record(name, value, [Some((self, slope)), None])
    }
    fn two(
        self,
        other: Traced,
        name: &'static str,
        f: impl Fn(Dual<f64>, Dual<f64>) -> Dual<f64>,
        value: f64,
    ) -> Traced {
        let first = f(Dual::variable(self.value), Dual::fixed(other.value)).eps;
        let second = f(Dual::fixed(self.value), Dual::variable(other.value)).eps;
        record(name, value, [Some((self, first)), Some((other, second))])
    }
}

impl Default for Traced {
    fn default() -> Traced {
        Traced::input(0.0)
    }
}
impl PartialEq for Traced {
    fn eq(&self, other: &Traced) -> bool {
        self.value == other.value
    }
}
macro_rules! operators {
    ($($trait:ident $method:ident $assign:ident $method_assign:ident $name:literal, |$x:ident, $y:ident| $slopes:expr;)*) => {$(
        impl $trait for Traced {
            type Output = Traced;
            fn $method(self, other: Traced) -> Traced {
                let ($x, $y) = (self.value, other.value);
                let [first, second]: [f64; 2] = $slopes;
                record($name, $x.$method($y), [Some((self, first)), Some((other, second))])
            }
        }
        impl $assign for Traced {
            fn $method_assign(&mut self, other: Traced) {
                *self = self.$method(other);
            }
        }
    )*};
}
operators! {
    Add add AddAssign add_assign "+", |_x, _y| [1.0, 1.0];
    Sub sub SubAssign sub_assign "-", |_x, _y| [1.0, -1.0];
    Mul mul MulAssign mul_assign "*", |x, y| [y, x];
    Div div DivAssign div_assign "/", |x, y| [1.0 / y, -x / y / y];
}
impl Neg for Traced {
    type Output = Traced;
    fn neg(self) -> Traced {
        record("neg", -self.value, [Some((self, -1.0)), None])
    }
}

macro_rules! functions {
    ($($name:ident)*; $($name2:ident)*) => {
        $(fn $name(self) -> Traced {
            self.one(stringify!($name), Real::$name, Real::$name(self.value))
        })*
        $(fn $name2(self, other: Traced) -> Traced {
            self.two(other, stringify!($name2), Real::$name2, Real::$name2(self.value, other.value))
        })*
    };
}

impl Real for Traced {
    type Mask = bool;
    type Size = f64;
    const LANES: u32 = 1;
    hamiltonian_real::itself_in_lanes! {}

    fn constant(hi: f64, lo: f64) -> Traced {
        if lo == 0.0 {
            Traced::input(hi)
        } else {
            record("constant", hi, [None, None])
        }
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Traced {
        Traced::input(next())
    }
    fn fma(self, b: Traced, c: Traced) -> Traced {
        self * b + c
    }
    fn select(mask: bool, yes: Traced, no: Traced) -> Traced {
        if mask { yes } else { no }
    }
    fn lt(self, other: Traced) -> bool {
        self.value < other.value
    }
    fn le(self, other: Traced) -> bool {
        self.value <= other.value
    }
    fn equals(self, other: Traced) -> bool {
        self.value == other.value
    }
    fn magnitude(self) -> f64 {
        self.value.abs()
    }
    fn size(self) -> f64 {
        self.value.abs()
    }
    fn finite(self) -> bool {
        self.value.is_finite()
    }
    fn lane(self, k: u32) -> f64 {
        self.value.lane(k)
    }
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    fn recip(self) -> Traced {
        let value = Real::recip(self.value);
        record("/", value, [Some((self, -value * value)), None])
    }
    fn sin_cos(self) -> (Traced, Traced) {
        (self.sin(), self.cos())
    }
    functions! {
        sqrt cbrt abs sign sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp exp_m1
        ln ln_1p erf erfc floor round;
        atan2 hypot pow modulo remainder
    }
}
