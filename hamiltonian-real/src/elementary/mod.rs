//! Elementary functions: the same bits in a single run, in a lane and on every machine.
//!
//! Input: a [`Word`](crate::word::Word), that is `f64` or a pack of them. Output: the function's
//! value. Invariant: the functions use only the operations of `Word`, which IEEE 754 defines to the
//! last bit, and a table of 2/π for large angles. Cold functions compute arguments outside the
//! common path: large angles, points and powers in lanes ([`Rare`](crate::word::Rare)), others lane
//! by lane. `f32` rounds the values of `f64`.

pub mod angle;
pub mod arc;
pub mod error;
pub mod exponential;
pub mod logarithm;
pub mod power;
pub mod whole;

pub mod exact;
pub mod reduction;
pub(crate) mod root;

mod coefficients;
mod pairs;

/// The methods of [`Real`](crate::Real) that are elementary functions, for a
/// [`Word`](crate::word::Word): `elementary! { #[…] }` with the attribute of the long ones.
#[doc(hidden)]
#[macro_export]
macro_rules! elementary {
    (#[$long:meta]) => {
        $crate::elementary! { @one inline(always):
            angle { sin cos } exponential { exp exp_m1 } logarithm { ln ln_1p } whole { floor round } }
        $crate::elementary! { @one $long:
            angle { tan } exponential { sinh cosh tanh } logarithm { asinh acosh atanh }
            power { cbrt } arc { asin acos atan } error { erf erfc } }
        $crate::elementary! { @two inline(always): whole { modulo remainder } }
        $crate::elementary! { @two $long: power { pow hypot } arc { atan2 } }
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            $crate::elementary::angle::sin_cos(self)
        }
    };
    (@one $inline:meta: $($module:ident { $($name:ident)* })*) => {
        $($($crate::elementary! { @method $inline, $module $name(self) })*)*
    };
    (@two $inline:meta: $($module:ident { $($name:ident)* })*) => {
        $($($crate::elementary! { @method $inline, $module $name(self, other) })*)*
    };
    (@method $inline:meta, $module:ident $name:ident($this:ident $(, $other:ident)?)) => {
        #[$inline]
        fn $name($this $(, $other: Self)?) -> Self {
            $crate::elementary::$module::$name($this $(, $other)?)
        }
    };
}
