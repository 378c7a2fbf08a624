//! Calls of one function that are computed together have the bits of one call after the other.

use crate::counting::counted::Called;
use hamiltonian::Dual;
use hamiltonian::prelude::*;
use hamiltonian::private::{
    Acosh, Asinh, Atan, Atanh, Call, Cbrt, Cosh, Exp, ExpM1, Ln, Ln1p, SinCos, Sinh, Tan, Tanh,
    are_together, together,
};

hamiltonian! {
    /// Eight particles on a ring.
    pub struct Ring {}
    H(a, b, c, d, e, f, g, h; pa, pb, pc, pd, pe, pf, pg, ph) =
        (pa^2 + pb^2 + pc^2 + pd^2 + pe^2 + pf^2 + pg^2 + ph^2)/2
        + exp(a - b) + exp(b - c) + exp(c - d) + exp(d - e) + exp(e - f) + exp(f - g) + exp(g - h) + exp(h - a)
}

hamiltonian! {
    /// Functions of functions, more than eight of a kind, and angles of sums.
    pub struct Nested { k = 0.3 }
    H(a, b, c; pa, pb, pc) = exp(k*sin(a)) + exp(k*cos(b)) + exp(k*tanh(c - a)) + exp(exp(a*pb/9))
        + exp(a/2) + exp(b/3) + exp(c/4) + exp(pa/5) + exp(pb/6) + exp(pc/7)
        + ln(2 + exp(a)) + ln(3 + pb^2) + ln(2 + sin(c))
        + sin(a)*cos(a) + sin(b)*cos(b) + sin(c)*cos(c) + sin(a + b)*cos(a + b) + sin(pa - b)*cos(pa - b)
        + atan(a + pa) + atan(b*pb) + cosh(a/8) + cosh(b/9) + sinh(c/5)*sinh(pc/5)
}

hamiltonian! {
    /// The functions that no system above calls, each four times.
    pub struct Others {}
    let four(x, y, z, w) = x + y + z + w;
    H(a, b; pa, pb) = four(tan(a/3), tan(b/3), tan(pa/3), tan(pb/3)) + four(cbrt(3 + a), cbrt(4 + b), cbrt(5 + pa), cbrt(6 + pb))
        + four(asinh(a), asinh(b), asinh(pa), asinh(pb)) + four(acosh(2 + a^2), acosh(3 + b^2), acosh(4 + pa^2), acosh(5 + pb^2))
        + four(atanh(a/9), atanh(b/9), atanh(pa/9), atanh(pb/9)) + four(exp_m1(a), exp_m1(b), exp_m1(pa), exp_m1(pb))
        + four(ln_1p(a^2), ln_1p(b^2), ln_1p(pa^2), ln_1p(pb^2))
}

/// The bits of H, its gradient and its second derivatives, along a line of points.
macro_rules! same {
    ($system:expr, $n:literal) => {
        for step in 0..40 {
            let at = |k: usize| (f64::from(step) * 0.37 + k as f64 * 0.83).sin() * 1.7;
            let q: [f64; $n] = std::array::from_fn(at);
            let p: [f64; $n] = std::array::from_fn(|k| at(k + 20));
            let of = |x: [f64; $n]| x.map(Called::<false>);
            let system = $system;
            let (wide, lone) = (State::over(q, p), State::over(of(q), of(p)));
            let (energy, called) = (system.energy(&wide), system.energy(&lone));
            assert_eq!(energy.to_bits(), called.0.to_bits());
            let (wide, lone) = (system.gradient(&wide), system.gradient(&lone));
            for k in 0..$n {
                assert_eq!(wide.q[k].to_bits(), lone.q[k].0.to_bits(), "{k}");
                assert_eq!(wide.p[k].to_bits(), lone.p[k].0.to_bits(), "{k}");
            }
            let dual = |x: [f64; $n]| {
                x.map(|x| Dual {
                    re: x,
                    eps: 0.3 - x,
                })
            };
            let called = |x: [f64; $n]| {
                x.map(|x| Dual {
                    re: Called::<false>(x),
                    eps: Called(0.3 - x),
                })
            };
            let wide = system.gradient(&State::over(dual(q), dual(p)));
            let lone = system.gradient(&State::over(called(q), called(p)));
            for k in 0..$n {
                assert_eq!(wide.q[k].eps.to_bits(), lone.q[k].eps.0.to_bits(), "{k}");
                assert_eq!(wide.p[k].eps.to_bits(), lone.p[k].eps.0.to_bits(), "{k}");
            }
        }
    };
}

#[test]
fn definitions_have_the_bits_of_one_call_after_the_other() {
    same!(Ring {}, 8);
    same!(Nested::default(), 3);
    same!(Others {}, 2);
}

/// Arguments of every kind, the rare ones among them.
const POINTS: [f64; 24] = [
    0.3,
    -0.0,
    0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    -7.25,
    1e-9,
    -1e-300,
    5e-324,
    700.0,
    -745.2,
    709.9,
    1e6,
    1e22,
    -1e300,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    1.0000000001,
    0.999999,
    3.2,
    88.0,
];

// Out of line: one function with all of these would take minutes to optimise.
#[inline(never)]
fn check<C: Call<Value<f64> = V>, V: Copy, const N: usize>(words: impl Fn(V) -> [u64; 2]) {
    for start in 0..POINTS.len() {
        let x: [f64; N] =
            std::array::from_fn(|k| POINTS[(start + k * (1 + start % 5)) % POINTS.len()]);
        let values = together::<f64, C, N, true>(x);
        for (x, value) in x.iter().zip(values) {
            assert_eq!(
                words(value),
                words(C::of(*x)),
                "{} of {x:e}",
                std::any::type_name::<C>()
            );
        }
    }
}

#[test]
fn functions_have_the_same_bits_together_at_all_arguments() {
    // Which NaN it is does not matter.
    let bits = |x: f64| if x.is_nan() { 1 } else { x.to_bits() };
    macro_rules! all {
        ($($name:ident)*) => {
            $(
                check::<$name, _, 2>(|x| [bits(x), 0]);
                check::<$name, _, 3>(|x| [bits(x), 0]);
                check::<$name, _, 4>(|x| [bits(x), 0]);
                check::<$name, _, 7>(|x| [bits(x), 0]);
                check::<$name, _, 8>(|x| [bits(x), 0]);
            )*
        };
    }
    all!(Cbrt Tan Atan Sinh Cosh Tanh Asinh Acosh Atanh Exp ExpM1 Ln Ln1p);
    check::<SinCos, _, 4>(|(s, c)| [bits(s), bits(c)]);
    check::<SinCos, _, 8>(|(s, c)| [bits(s), bits(c)]);
}

#[test]
fn scalars_with_lanes_compute_enough_calls_together() {
    let is_there = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));
    assert_eq!(are_together::<f64, Exp>(8), is_there);
    assert_eq!(are_together::<Dual<f64>, Exp>(3), is_there);
    assert!(!are_together::<f64, Exp>(2) && !are_together::<f64, Exp>(9));
    assert!(!are_together::<Called<false>, Exp>(8) && !are_together::<DoubleDouble, Exp>(8));
}
