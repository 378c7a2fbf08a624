//! Functions with data, as values of parameters `V: fn(r)`.
//!
//! Input: core's `Spline` and `Grid`. Output: [`Tabulated`]. Invariant: a derivative is that of emitted code, the value over
//! dual numbers, so that the bits agree.

use hamiltonian_core::private::Dual;
use hamiltonian_core::systems::function::{Function, Grid, Spline};
use hamiltonian_lanes::Real;
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

/// The most words of a number that is taken apart into lanes.
const WORDS: usize = 128;

/// True for numbers over a pack with no more words.
const fn is_pack<T: Real>() -> bool {
    T::LANES > 1 && (T::LANES as usize) << T::DUALS <= WORDS
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

    /// A derivative at a point; a spline does not read the second number. Dual numbers over a pack have that of a grid lane by
    /// lane: a product of three dual numbers inside each other is many products, in each register of the pack.
    #[inline(always)]
    pub(crate) fn derivative<T: Real>(&self, derivative: Derivative, at: [T; 2]) -> T {
        match self {
            Tabulated::Spline(spline) => spline.derivative(derivative, at),
            Tabulated::Grid(grid) => {
                if const { is_pack::<T>() && T::DUALS == 1 } {
                    by_lanes::<T, Dual<f64>>(grid, derivative, at)
                } else if const { is_pack::<T>() && T::DUALS == 2 } {
                    by_lanes::<T, Dual<Dual<f64>>>(grid, derivative, at)
                } else {
                    grid.derivative(derivative, at)
                }
            }
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

/// A derivative over the scalar `E` of each lane.
#[inline(always)]
fn by_lanes<T: Real, E: Real>(grid: &Grid, derivative: Derivative, at: [T; 2]) -> T {
    // The lanes of the value, then those of its derivative.
    let lanes = T::LANES as usize;
    let words = at.map(|x| {
        let (mut words, mut next) = ([0.0; WORDS], 0);
        x.write_words(&mut |word| {
            words[next % WORDS] = word;
            next += 1;
        });
        words
    });
    let mut found = [0.0; WORDS];
    for lane in 0..lanes {
        let at = words.each_ref().map(|words| {
            let mut parts = words.iter().skip(lane).step_by(lanes);
            E::read_words(&mut || parts.next().copied().unwrap_or(f64::NAN))
        });
        let mut places = found.iter_mut().skip(lane).step_by(lanes);
        of_lane(grid, derivative, at).write_words(&mut |word| {
            if let Some(place) = places.next() {
                *place = word;
            }
        });
    }
    let mut words = found.into_iter();
    T::read_words(&mut || words.next().unwrap_or(f64::NAN))
}

/// The same of one lane, of which all packs have one copy.
#[inline(never)]
fn of_lane<E: Real>(grid: &Grid, derivative: Derivative, at: [E; 2]) -> E {
    grid.derivative(derivative, at)
}
