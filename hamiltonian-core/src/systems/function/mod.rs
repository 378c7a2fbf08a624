//! Functions with data, as parameters of systems.
//!
//! Input: numbers, for example the values of a potential at knots. Output: [`Function`], which the macro
//! differentiates over dual numbers, and two implementations, [`Spline`] and [`Grid`]. Invariant: a value
//! depends only on the data and the point; in a pack, the value of a lane depends only on the point of this lane.

mod grid;
mod line;
mod spline;

pub use grid::Grid;
#[cfg(feature = "serde")]
pub(crate) use spline::EndCondition;
pub use spline::Spline;

use crate::systems::hash::Hash;
use core::fmt::Debug;
use hamiltonian_lanes::Real;

/// A function of `N` numbers that carries data: the type of a parameter `V: fn(r)` of `hamiltonian!`.
///
/// [`value`](Function::value) is generic over the scalar. Its derivatives are those of its value over dual
/// numbers, so they are exact. Numbers read from a table go through [`Real::look_up`], which
/// finds them for each lane of a pack. A system clones its functions when it is prepared and when a scheme
/// makes a map, so a clone must be cheap: keep large data in an `Arc`.
///
/// ```
/// use hamiltonian::systems::function;
/// use hamiltonian::prelude::*;
///
/// /// The potential of Morse, −D + D(1 − exp(−a(r − r₀)))².
/// #[derive(Debug, Clone)]
/// struct Morse { depth: f64, width: f64, place: f64 }
///
/// impl Function<1> for Morse {
///     fn value<T: Real>(&self, [r]: [T; 1]) -> T {
///         let [depth, width, place] = [self.depth, self.width, self.place].map(T::lift);
///         let x = T::one() - (-width * (r - place)).exp();
///         depth * (x * x - T::one())
///     }
///     fn fingerprint(&self) -> u64 {
///         function::fingerprint([self.depth, self.width, self.place])
///     }
/// }
/// let morse = Morse { depth: 2.0, width: 1.0, place: 1.5 };
/// assert_eq!(morse.value([1.5]), -2.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a function of {N} numbers",
    label = "the parameter is a function: give a `Spline`, a `Grid`, or a type of your own",
    note = "a type of your own: `impl Function<{N}> for {Self} {{ fn value<T: Real>(&self, x: [T; {N}]) -> T {{ … }} … }}`; a function without data is a statement: `fn V(x) = path;`"
)]
pub trait Function<const N: usize>: Clone + Debug + Send + Sync + 'static {
    /// The value at a point; NaN outside the domain.
    fn value<T: Real>(&self, at: [T; N]) -> T;

    /// A number that almost certainly differs between different functions: see [`fingerprint`]. A saved run
    /// resumes only with functions of the same fingerprints. All members of an ensemble have the same fingerprints.
    fn fingerprint(&self) -> u64;
}

/// The largest whole number that is at most x, which is finite; without a standard library.
fn floor(x: f64) -> f64 {
    /// From 2⁵² on every number is whole.
    const WHOLE: f64 = 4_503_599_627_370_496.0;
    if !(-WHOLE < x && x < WHOLE) {
        return x;
    }
    let towards_zero = x as i64 as f64;
    if towards_zero > x {
        towards_zero - 1.0
    } else {
        towards_zero
    }
}

/// A hash of numbers, for [`Function::fingerprint`]: all numbers on which a function depends, in a fixed
/// order.
///
/// ```
/// use hamiltonian::systems::function::fingerprint;
/// assert_ne!(fingerprint([1.0, 2.0]), fingerprint([2.0, 1.0]));
/// ```
#[must_use]
pub fn fingerprint(numbers: impl IntoIterator<Item = f64>) -> u64 {
    let mut hash = Hash::new();
    for number in numbers {
        hash.word(number.to_bits());
    }
    hash.0
}
