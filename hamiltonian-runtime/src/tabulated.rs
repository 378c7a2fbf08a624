//! Functions with data, as values of parameters `V: fn(r)`.
//!
//! Input: core's `Spline` and `Grid`. Output: [`Tabulated`]. Invariant: a derivative is that of emitted code, the value over
//! dual numbers, so that the bits agree.

use crate::words::{is_pack, of_two};
use hamiltonian_core::private::Dual;
use hamiltonian_core::systems::function::{Function, Grid, Spline};
use hamiltonian_lanes::{OfNumbers, Real};
use hamiltonian_symbolic::dag::Partial;

/// A function with data: the value of a parameter `V: fn(r)` or `V: fn(x, y)`.
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian_runtime::{Definition, Run, Values};
///
/// let well = Definition::parse("struct Well { V: fn(r), m = 1.0 } H(r; p) = p^2/(2*m) + V(r)", "well.txt")?;
/// let spline = Spline::natural(&[0.0, 1.0, 2.0, 3.0, 4.0], &[4.0, 1.0, 0.0, 1.0, 4.0])?;
/// let system = well.system(Values::new().with("V", spline).with("m", 2.0))?;
///
/// let start = State::new(vec![3.0], vec![0.0]);
/// assert_eq!(system.energy(&start), 1.0);
/// let mut run = Run::new(&system, "StormerVerlet", start, 0.01)?;
/// run.advance(1000)?;
/// assert!((run.energy() - 1.0).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub enum Tabulated {
    /// Of one number.
    Spline(Spline),
    /// Of two numbers.
    Grid(Grid),
}

/// Two functions are equal if their data are.
impl PartialEq for Tabulated {
    fn eq(&self, other: &Self) -> bool {
        self.arity() == other.arity() && self.fingerprint() == other.fingerprint()
    }
}

impl From<Spline> for Tabulated {
    fn from(spline: Spline) -> Tabulated {
        Tabulated::Spline(spline)
    }
}

impl From<Grid> for Tabulated {
    fn from(grid: Grid) -> Tabulated {
        Tabulated::Grid(grid)
    }
}

/// The derivative that an operation takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Derivative {
    Value,
    First(u8),
    Second(u8, u8),
}

impl Derivative {
    /// The derivative of a program; `None` for an order that programs do not have.
    pub(crate) fn of(partial: Partial) -> Option<Self> {
        match partial {
            Partial::Value => Some(Derivative::Value),
            Partial::First(i) => Some(Derivative::First(i as u8)),
            Partial::Second(i, j) => Some(Derivative::Second(i as u8, j as u8)),
            Partial::Higher { .. } => None,
        }
    }
}

/// The arguments as dual numbers, argument i as the variable.
#[inline(always)]
fn duals<T: Real>(at: [T; 2], i: u8) -> [Dual<T>; 2] {
    match i {
        0 => [Dual::variable(at[0]), Dual::fixed(at[1])],
        _ => [Dual::fixed(at[0]), Dual::variable(at[1])],
    }
}

impl Tabulated {
    /// The number of its arguments.
    pub(crate) fn arity(&self) -> usize {
        match self {
            Tabulated::Spline(_) => 1,
            Tabulated::Grid(_) => 2,
        }
    }

    /// A number that almost certainly differs between different functions.
    pub(crate) fn fingerprint(&self) -> u64 {
        match self {
            Tabulated::Spline(spline) => spline.fingerprint(),
            Tabulated::Grid(grid) => grid.fingerprint(),
        }
    }

    /// A derivative at a point; a spline does not read the second number. Dual numbers over a pack have it lane by lane: a
    /// product of three dual numbers inside each other is many products, in each register of the pack.
    #[inline(always)]
    pub(crate) fn derivative<T: Real>(&self, derivative: Derivative, at: [T; 2]) -> T {
        let of = DerivativeOf(self, derivative);
        if const { is_pack::<T>(1) } {
            of_two(at, |at: [Dual<f64>; 2]| Real::apart(of, at))
        } else if const { is_pack::<T>(2) } {
            of_two(at, |at: [Dual<Dual<f64>>; 2]| Real::apart(of, at))
        } else {
            T::apart(of, at)
        }
    }
}

/// A derivative as a function.
#[derive(Clone, Copy)]
struct DerivativeOf<'a>(&'a Tabulated, Derivative);

impl OfNumbers<2> for DerivativeOf<'_> {
    #[inline(always)]
    fn of<T: Real>(self, at: [T; 2]) -> T {
        match self.0 {
            Tabulated::Spline(spline) => spline.derivative(self.1, at),
            Tabulated::Grid(grid) => grid.derivative(self.1, at),
        }
    }
}

/// A function of two numbers, or of the first of them.
trait OfTwo {
    fn at<T: Real>(&self, at: [T; 2]) -> T;

    #[inline(always)]
    fn derivative<T: Real>(&self, derivative: Derivative, at: [T; 2]) -> T {
        match derivative {
            Derivative::Value => self.at(at),
            Derivative::First(i) => self.at(duals(at, i)).eps,
            Derivative::Second(i, j) => self.at(duals(duals(at, j), i)).eps.eps,
        }
    }
}

impl OfTwo for Spline {
    #[inline(always)]
    fn at<T: Real>(&self, [x, _]: [T; 2]) -> T {
        self.value([x])
    }
}

impl OfTwo for Grid {
    #[inline(always)]
    fn at<T: Real>(&self, at: [T; 2]) -> T {
        self.value(at)
    }
}
