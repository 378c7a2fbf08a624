//! Calls of functions, together or apart.
//!
//! Input: nothing. Output: [`OfNumbers`], a function over any scalar, and the functions that are computed together.
//! Invariant: the bits are those of the calls where they stand.

use super::Real;

/// A function of numbers over any scalar, for [`Real::apart`].
///
/// ```
/// use hamiltonian::lanes::{OfNumbers, W};
/// use hamiltonian::prelude::*;
///
/// #[derive(Clone, Copy)]
/// struct Tangent;
/// impl OfNumbers<1> for Tangent {
///     #[inline(always)]
///     fn of<T: Real>(self, [x]: [T; 1]) -> T {
///         x.tan()
///     }
/// }
///
/// // A call for each number, the code of one tangent.
/// let x = W([0.5, 1.0, 1.5]);
/// assert_eq!(Real::apart(Tangent, [x]), x.tan());
/// ```
pub trait OfNumbers<const N: usize>: Copy {
    /// The value. To be `#[inline(always)]`.
    fn of<T: Real>(self, x: [T; N]) -> T;
}

/// Calls a macro with the functions of one number whose independent calls are faster together: a name, the method of
/// [`Real`], and the least number of calls. Core computes them, and the engine looks for them.
#[doc(hidden)]
#[macro_export]
macro_rules! computed_together {
    ($list:ident) => {
        // From how many calls on the chain of an evaluation is shorter by a fifth or more. (Zen 5, ns of 2, 4 and 8
        // calls alone and together: exp 19 → 17, 23 → 18, 41 → 21; ln 25 → 19, 27 → 19, 49 → 22; sines and cosines
        // together 20 → 20, 28 → 23, 56 → 34. Sines alone, cosines, inverse sines and error functions are slower
        // together.)
        $list! {
            Cbrt cbrt 4;
            Tan tan 4;
            Atan atan 2;
            Sinh sinh 2;
            Cosh cosh 2;
            Tanh tanh 2;
            Asinh asinh 2;
            Acosh acosh 2;
            Atanh atanh 2;
            Exp exp 3;
            ExpM1 exp_m1 4;
            Ln ln 2;
            Ln1p ln_1p 4;
        }
    };
}
