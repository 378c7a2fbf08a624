//! The elementary functions of `f64` and `f32`: the one place that names whose they are.
//!
//! Input: a float. Output: the function's value. Invariant: with the feature `std` the standard
//! library's functions, without it those of the `libm` crate; everything else in this crate calls
//! through here. The inverse hyperbolic functions are `libm`'s either way: the standard library's
//! area cosine is `ln(x + √((x−1)(x+1)))`, which near 1 keeps no digit of the result.

/// One module of functions for one float type: `name(x) = std method, libm function`.
macro_rules! functions {
    ($module:ident, $float:ident, unary { $($name:ident = $std:ident, $libm:ident;)* }
     binary { $($name2:ident = $std2:ident, $libm2:ident;)* }
     always_libm { $($name3:ident = $libm3:ident;)* }
     pair $pair:ident) => {
        pub(crate) mod $module {
            $(
                #[inline(always)]
                pub(crate) fn $name(x: $float) -> $float {
                    #[cfg(feature = "std")]
                    {
                        x.$std()
                    }
                    #[cfg(not(feature = "std"))]
                    {
                        libm::$libm(x)
                    }
                }
            )*
            $(
                #[inline(always)]
                pub(crate) fn $name2(x: $float, y: $float) -> $float {
                    #[cfg(feature = "std")]
                    {
                        x.$std2(y)
                    }
                    #[cfg(not(feature = "std"))]
                    {
                        libm::$libm2(x, y)
                    }
                }
            )*
            $(
                #[inline(always)]
                pub(crate) fn $name3(x: $float) -> $float {
                    libm::$libm3(x)
                }
            )*
            #[inline(always)]
            pub(crate) fn sin_cos(x: $float) -> ($float, $float) {
                #[cfg(feature = "std")]
                {
                    x.sin_cos()
                }
                #[cfg(not(feature = "std"))]
                {
                    libm::$pair(x)
                }
            }
        }
    };
}

functions! {
    double, f64,
    unary {
        sqrt = sqrt, sqrt;
        cbrt = cbrt, cbrt;
        sin = sin, sin;
        cos = cos, cos;
        tan = tan, tan;
        asin = asin, asin;
        acos = acos, acos;
        atan = atan, atan;
        sinh = sinh, sinh;
        cosh = cosh, cosh;
        tanh = tanh, tanh;
        exp = exp, exp;
        exp_m1 = exp_m1, expm1;
        ln = ln, log;
        ln_1p = ln_1p, log1p;
    }
    binary {
        atan2 = atan2, atan2;
        hypot = hypot, hypot;
        pow = powf, pow;
    }
    always_libm {
        asinh = asinh;
        acosh = acosh;
        atanh = atanh;
    }
    pair sincos
}

functions! {
    single, f32,
    unary {
        sqrt = sqrt, sqrtf;
        cbrt = cbrt, cbrtf;
        sin = sin, sinf;
        cos = cos, cosf;
        tan = tan, tanf;
        asin = asin, asinf;
        acos = acos, acosf;
        atan = atan, atanf;
        sinh = sinh, sinhf;
        cosh = cosh, coshf;
        tanh = tanh, tanhf;
        exp = exp, expf;
        exp_m1 = exp_m1, expm1f;
        ln = ln, logf;
        ln_1p = ln_1p, log1pf;
    }
    binary {
        atan2 = atan2, atan2f;
        hypot = hypot, hypotf;
        pow = powf, powf;
    }
    always_libm {
        asinh = asinhf;
        acosh = acoshf;
        atanh = atanhf;
    }
    pair sincosf
}
