//! Derivatives supplied by hand, compared with dual numbers.
//!
//! Input: a function over dual numbers, the functions that are to be its partial derivatives, a
//! point. Output: [`WrongDerivative`] for the first that differs. Invariant: no step size; both
//! sides are exact except for rounding.

use core::fmt::{self, Display, Formatter};
use hamiltonian_lanes::Dual;

/// A partial derivative that differs from the supplied one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrongDerivative {
    /// The number of the argument, from 0.
    pub argument: usize,
    /// The derivative of the function itself.
    pub expected: f64,
    /// The value of the function supplied for it.
    pub found: f64,
}

impl Display for WrongDerivative {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            argument,
            expected,
            found,
        } = self;
        write!(
            f,
            "the derivative by argument {argument} is {expected} there, but the function supplied \
             gives {found}"
        )
    }
}

impl core::error::Error for WrongDerivative {}

/// Checks `partials[i] = ∂f/∂xᵢ` at a point: the functions that `fn f(x, y) = f, (f_x, f_y);`
/// supplies to a definition. Second derivatives are checked as the derivatives of first ones.
///
/// A difference counts if it is larger than `tolerance·(1 + |∂f/∂xᵢ|)`, or if only one of the two
/// is NaN. Derivatives are exact ([`Dual`]), so `1e-12` suffices unless `f` loses digits.
///
/// # Errors
/// [`WrongDerivative`] with the argument and both values, for the first derivative that differs.
///
/// ```
/// use hamiltonian::schemes::author::check_derivatives;
/// use hamiltonian::prelude::*;
///
/// fn morse<T: Real>(x: T) -> T { let e = T::one() - (-x).exp(); e*e }
/// fn slope<T: Real>(x: T) -> T { let e = (-x).exp(); (e - e*e)*T::constant(2.0, 0.0) }
/// fn wrong<T: Real>(x: T) -> T { (-x).exp() }
///
/// assert!(check_derivatives(|[x]| morse(x), [&|[x]| slope(x)], [0.3], 1e-12).is_ok());
/// let error = check_derivatives(|[x]| morse(x), [&|[x]| wrong(x)], [0.3], 1e-12).unwrap_err();
/// assert_eq!(error.argument, 0);
/// assert!((error.expected - slope(0.3)).abs() < 1e-15);
/// ```
pub fn check_derivatives<const N: usize>(
    f: impl Fn([Dual<f64>; N]) -> Dual<f64>,
    partials: [&dyn Fn([f64; N]) -> f64; N],
    at: [f64; N],
    tolerance: f64,
) -> Result<(), WrongDerivative> {
    for (argument, partial) in partials.into_iter().enumerate() {
        let mut point = at.map(Dual::fixed);
        point[argument] = Dual::variable(at[argument]);
        let (expected, found) = (f(point).eps, partial(at));
        let agree = expected == found
            || (expected - found).abs() <= tolerance * (1.0 + expected.abs())
            || (expected.is_nan() && found.is_nan());
        if !agree {
            return Err(WrongDerivative {
                argument,
                expected,
                found,
            });
        }
    }
    Ok(())
}
