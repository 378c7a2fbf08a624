//! Dual numbers: derivatives of every operation against differences in double-double, second
//! derivatives by nesting, and the conventions where no derivative exists.

use hamiltonian_lanes::{DoubleDouble, Dual, Parameter, Real};

type First = Dual<DoubleDouble>;
type Second = Dual<First>;

/// A function in three arithmetics, and where to test it.
struct Function {
    name: &'static str,
    double_double: fn(DoubleDouble) -> DoubleDouble,
    first: fn(First) -> First,
    second: fn(Second) -> Second,
    single_word: fn(Dual<f64>) -> Dual<f64>,
    points: &'static [f64],
}

/// `name at points` for the methods of `Real`, `name(x) = e at points` for other functions.
macro_rules! functions {
    ($($name:ident $(($x:ident) = $e:expr)? , at $points:expr;)*) => {
        [$({
            fn evaluate<T: Real>(x: T) -> T {
                functions!(@body x $name $(($x) = $e)?)
            }
            Function {
                name: stringify!($name),
                double_double: evaluate,
                first: evaluate,
                second: evaluate,
                single_word: evaluate,
                points: &$points,
            }
        }),*]
    };
    (@body $v:ident $name:ident) => { $v.$name() };
    (@body $v:ident $name:ident ($x:ident) = $e:expr) => {{ let $x = $v; $e }};
}

/// A constant of any scalar.
fn c<T: Real>(value: f64) -> T {
    T::constant(value, 0.0)
}

fn all_functions() -> Vec<Function> {
    let everywhere = functions! {
        cbrt, at [0.3, -2.0, 40.0, -1e-3];
        abs, at [0.3, -2.0];
        sign, at [0.3, -2.0];
        sin, at [0.0, 0.3, -2.0, 11.0];
        cos, at [0.0, 0.3, -2.0, 11.0];
        tan, at [0.0, 0.3, -2.0, 11.2];
        sinh, at [0.0, 0.3, -2.0, 6.0];
        cosh, at [0.0, 0.3, -2.0, 6.0];
        tanh, at [0.0, 0.3, -2.0, 6.0, -9.0];
        asinh, at [0.0, 0.3, -2.0, 60.0];
        atan, at [0.0, 0.3, -2.0, 60.0];
        exp, at [0.0, 0.3, -2.0, 6.0];
        exp_m1, at [0.0, 0.3, -2.0, 6.0];
        sin_of_pair(x) = x.sin_cos().0, at [0.3, -2.0];
        cos_of_pair(x) = x.sin_cos().1, at [0.3, -2.0];
    };
    let somewhere = functions! {
        sqrt, at [0.3, 2.0, 40.0];
        asin, at [0.0, 0.3, -0.9];
        acos, at [0.0, 0.3, -0.9];
        acosh, at [1.1, 2.0, 60.0];
        atanh, at [0.0, 0.3, -0.9];
        ln, at [0.3, 1.0, 2.0, 60.0];
        ln_1p, at [-0.6, 0.0, 0.3, 60.0];
        recip, at [0.3, -2.0];
    };
    let two_arguments = functions! {
        atan2_first(x) = x.atan2(c(0.7)), at [0.0, 0.3, -2.0];
        atan2_second(x) = c::<T>(0.7).atan2(x), at [0.0, 0.3, -2.0];
        atan2_left(x) = x.atan2(c(-0.7)), at [0.3, -2.0];
        atan2_both(x) = x.sin().atan2(x.cos() * c(1.5)), at [0.3, -2.0];
        hypot_first(x) = x.hypot(c(0.7)), at [0.0, 0.3, -2.0];
        hypot_second(x) = c::<T>(0.7).hypot(x), at [0.0, 0.3, -2.0];
        hypot_both(x) = x.hypot(x.exp()), at [0.3, -2.0];
        pow_base(x) = x.pow(c(2.5)), at [0.3, 2.0, 9.0];
        pow_negative_base(x) = x.pow(c(-3.0)), at [0.3, -2.0];
        pow_exponent(x) = c::<T>(2.5).pow(x), at [0.0, 0.3, -2.0];
        pow_both(x) = x.pow(x), at [0.3, 2.0];
        pow_both_at_zero(x) = (x + c(2.0)).pow(x), at [0.0, 0.3];
        min(x) = x.min(x * x), at [0.3, 2.0, -2.0];
        max(x) = x.max(x * x), at [0.3, 2.0, -2.0];
        select(x) = T::select(x.lt(c(1.0)), x.sin(), x.exp()), at [0.3, 2.0];
    };
    let operators = functions! {
        add(x) = x + x.exp(), at [0.3];
        sub(x) = x - x.exp(), at [0.3];
        mul(x) = x * x.exp(), at [0.3, -2.0];
        div(x) = x / x.exp(), at [0.3, -2.0];
        neg(x) = -x.exp(), at [0.3];
        fma(x) = x.fma(x.exp(), x.sin()), at [0.3, -2.0];
        mul_absorbing(x) = x.exp().mul_absorbing(x), at [0.0, 0.3];
        assigning(x) = {
            let mut y = x.exp();
            y += x;
            y *= x.sin();
            y -= x * x;
            y /= x.cos();
            y
        }, at [0.3, -2.0];
    };
    everywhere
        .into_iter()
        .chain(somewhere)
        .chain(two_arguments)
        .chain(operators)
        .collect()
}

fn number(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// `(f(x + h) − f(x − h))/2h`.
fn difference(f: impl Fn(DoubleDouble) -> DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    // Relative to x, the truncation is about h², the rounding 1e-31/h.
    let h = number(if x.hi() == 0.0 {
        1e-10
    } else {
        x.hi().abs() * 1e-10
    });
    (f(x + h) - f(x - h)) / (h + h)
}

fn close(a: DoubleDouble, b: DoubleDouble, tolerance: f64) -> bool {
    (a - b).magnitude() <= tolerance * (1.0 + b.magnitude())
}

#[test]
fn first_derivatives_are_limits_of_differences() {
    for f in all_functions() {
        for &x in f.points {
            let x = number(x);
            let dual = (f.first)(First::variable(x));
            assert!(
                close(dual.re, (f.double_double)(x), 1e-30),
                "{} at {x}",
                f.name
            );
            let expected = difference(f.double_double, x);
            assert!(
                close(dual.eps, expected, 1e-16),
                "{} at {x}: {}",
                f.name,
                dual.eps
            );
            // Along another direction, and along none.
            let scaled = (f.first)(First::new(x, number(-3.0)));
            assert!(
                close(scaled.eps, number(-3.0) * dual.eps, 1e-30),
                "{} at {x}",
                f.name
            );
            assert_eq!(
                (f.first)(First::fixed(x)).eps,
                number(0.0),
                "{} at {x}",
                f.name
            );
        }
    }
}

#[test]
fn second_derivatives_are_limits_of_differences() {
    for f in all_functions() {
        for &x in f.points {
            let x = number(x);
            let nested = (f.second)(Second::new(First::variable(x), First::fixed(number(1.0))));
            let slope = |x| (f.first)(First::variable(x)).eps;
            assert!(close(nested.re.eps, slope(x), 1e-29), "{} at {x}", f.name);
            assert!(close(nested.eps.re, slope(x), 1e-29), "{} at {x}", f.name);
            let expected = difference(slope, x);
            assert!(close(nested.eps.eps, expected, 1e-15), "{} at {x}", f.name);
        }
    }
}

#[test]
fn one_word_derivatives_agree_with_two() {
    for f in all_functions() {
        for &x in f.points {
            let one = (f.single_word)(Dual::variable(x));
            let two = (f.first)(First::variable(number(x)));
            assert!(close(number(one.re), two.re, 2e-15), "{} at {x}", f.name);
            assert!(close(number(one.eps), two.eps, 1e-14), "{} at {x}", f.name);
        }
    }
}

#[test]
fn mixed_second_derivatives() {
    // ∂²/∂x∂y of x^y is x^(y−1)(1 + y ln x), y = 0 included.
    for (x, y) in [(2.0, 3.0), (0.5, -1.5), (3.0, 0.0)] {
        let base = Dual::new(Dual::variable(number(x)), First::zero());
        let exponent = Dual::new(First::fixed(number(y)), First::one());
        let computed = base.pow(exponent).eps.eps;
        let [x, y] = [x, y].map(number);
        let expected = x.pow(y - number(1.0)) * (number(1.0) + y * x.ln());
        assert!(close(computed, expected, 1e-29), "{x}^{y}: {computed}");
    }
    // ∂²/∂x∂y of atan2(y, x) is (y² − x²)/(x² + y²)².
    let (x, y) = (number(1.5), number(-0.5));
    let vertical = Dual::new(First::fixed(y), First::one());
    let horizontal = Dual::new(First::variable(x), First::zero());
    let computed = vertical.atan2(horizontal).eps.eps;
    let square = x * x + y * y;
    assert!(close(computed, (y * y - x * x) / (square * square), 1e-29));
}

#[test]
fn third_derivative_of_tanh_at_zero() {
    let x = Dual::new(
        Dual::new(Dual::new(0.0, 1.0), Dual::fixed(1.0)),
        Dual::new(Dual::fixed(1.0), Dual::fixed(0.0)),
    );
    assert_eq!(x.tanh().eps.eps.eps, -2.0);
}

/// Slope of a function of `Dual<f64>` at a point.
fn slope(f: impl Fn(Dual<f64>) -> Dual<f64>, x: f64) -> f64 {
    f(Dual::variable(x)).eps
}

#[test]
fn slopes_at_the_edges_of_domains() {
    for zero in [0.0, -0.0] {
        assert_eq!(slope(Real::sqrt, zero), f64::INFINITY);
        assert_eq!(slope(Real::cbrt, zero), f64::INFINITY);
        assert_eq!(slope(Real::ln, zero), f64::INFINITY);
        assert_eq!(slope(Real::abs, zero), 0.0);
        assert_eq!(slope(Real::sign, zero), 0.0);
    }
    assert_eq!(slope(Real::asin, 1.0), f64::INFINITY);
    assert_eq!(slope(Real::asin, -1.0), f64::INFINITY);
    assert_eq!(slope(Real::acos, 1.0), f64::NEG_INFINITY);
    assert_eq!(slope(Real::acosh, 1.0), f64::INFINITY);
    assert_eq!(slope(Real::atanh, 1.0), f64::INFINITY);
    assert_eq!(slope(Real::atanh, -1.0), f64::INFINITY);
    assert_eq!(slope(Real::ln_1p, -1.0), f64::INFINITY);
    // Large arguments neither overflow nor cancel.
    assert_eq!(slope(Real::tanh, 800.0), 0.0);
    assert!((slope(Real::tanh, 20.0) / (4.0 * (-40f64).exp()) - 1.0).abs() < 1e-15);
    assert_eq!(slope(Real::asinh, 1e200), 1e-200);
    assert_eq!(slope(Real::acosh, 1e200), 1e-200);
    assert_eq!(slope(Real::atan, 1e200), 0.0);
    assert!((slope(|x| x.hypot(Dual::fixed(1e200)), 1e200) - 0.5f64.sqrt()).abs() < 2e-16);
    assert!((slope(|x| x.atan2(Dual::fixed(1e200)), 1e200) / 5e-201 - 1.0).abs() < 1e-15);
}

#[test]
fn constants_stay_constant_where_slopes_are_infinite() {
    let zero = Dual::fixed(0.0);
    let one = Dual::fixed(1.0);
    for value in [
        zero.sqrt(),
        zero.cbrt(),
        zero.ln(),
        one.asin(),
        one.acos(),
        one.acosh(),
        one.atanh(),
        (-one).ln_1p(),
        zero.hypot(zero),
        zero.atan2(zero),
        zero.pow(Dual::fixed(0.5)),
        zero.pow(zero),
        zero.pow(-one),
    ] {
        assert_eq!(value.eps, 0.0, "{value:?}");
    }
    // Nested: the inner derivative of a vanishing outer part is kept.
    let x = Dual::new(Dual::new(4.0, 0.0), Dual::new(0.0, 1.0));
    assert_eq!(x.sqrt().eps, Dual::new(0.0, 0.25));
}

#[test]
fn no_derivative_at_the_origin_of_the_plane() {
    let (x, zero) = (Dual::variable(0.0f64), Dual::fixed(0.0));
    assert!(x.hypot(zero).eps.is_nan());
    assert!(x.atan2(zero).eps.is_nan());
    assert_eq!(x.hypot(zero).re, 0.0);
}

#[test]
fn powers_at_zero_and_of_negative_numbers() {
    let square = |x: f64| Dual::variable(x).pow(Dual::fixed(2.0));
    assert_eq!(square(-3.0), Dual::new(9.0, -6.0));
    assert_eq!(square(0.0), Dual::new(0.0, 0.0));
    assert_eq!(slope(|x| x.pow(Dual::fixed(1.0)), 0.0), 1.0);
    assert_eq!(slope(|x| x.pow(Dual::fixed(0.5)), 0.0), f64::INFINITY);
    // The exponent 0, at 0 and elsewhere.
    assert_eq!(
        Dual::variable(0.0).pow(Dual::fixed(0.0)),
        Dual::new(1.0, 0.0)
    );
    assert_eq!(
        Dual::variable(-2.0).pow(Dual::fixed(0.0)),
        Dual::new(1.0, 0.0)
    );
    // A fraction of a negative base is outside the domain.
    assert!(Dual::variable(-2.0f64).pow(Dual::fixed(0.5)).re.is_nan());
    // The derivative by the exponent of a negative base is not real, that by the base is.
    assert!(Dual::fixed(-2.0f64).pow(Dual::variable(2.0)).eps.is_nan());
    // x^y·ln x at x = 0: its limit for y > 0, the logarithm's for y = 0.
    assert_eq!(Dual::fixed(0.0).pow(Dual::variable(2.0)).eps, 0.0);
    assert_eq!(
        Dual::fixed(0.0).pow(Dual::variable(0.0)).eps,
        f64::NEG_INFINITY
    );
}

#[test]
fn selection_never_shows_the_other_branch() {
    let x = Dual::variable(-1.0);
    let masked = Dual::select(x.lt(Dual::zero()), x * x, x.sqrt());
    assert_eq!(masked, Dual::new(1.0, -2.0));
    let masked = Dual::select(Dual::zero().le(x), x.sqrt(), x);
    assert_eq!(masked, x);
}

#[test]
fn ties_take_the_first_derivative_and_nan_is_returned() {
    let (a, b) = (Dual::new(1.0, 10.0), Dual::new(1.0, 20.0));
    assert_eq!(
        [a.min(b), b.min(a), a.max(b), b.max(a)].map(|x| x.eps),
        [10.0, 20.0, 10.0, 20.0]
    );
    let nan = Dual::variable(f64::NAN);
    for value in [a.min(nan), nan.min(a), a.max(nan), nan.max(a)] {
        assert!(value.re.is_nan());
    }
    assert_eq!(
        Dual::variable(f64::NAN).sign().re.to_bits(),
        f64::NAN.to_bits()
    );
}

#[test]
fn comparisons_go_by_value_and_sizes_by_component() {
    let (a, b) = (Dual::new(1.0, 10.0), Dual::new(1.0, -20.0));
    assert!(a.equals(b) && a.le(b) && !a.lt(b) && a != b);
    assert_eq!(b.magnitude(), 20.0);
    assert_eq!(Dual::new(-30.0, 1.0).magnitude(), 30.0);
    assert!(Dual::new(f64::NAN, 1.0).magnitude().is_nan());
    assert!(Dual::new(1.0, f64::NAN).magnitude().is_nan());
    assert!(a.is_finite());
    assert!(!Dual::new(1.0, f64::INFINITY).is_finite());
    assert!(!Dual::new(f64::NAN, 1.0).is_finite());
    assert_eq!(a.to_f64(), 1.0);
    assert_eq!(Dual::<f32>::epsilon(), f64::from(f32::EPSILON));
}

#[test]
fn parameters_lift_as_constants() {
    let third = number(1.0) / number(3.0);
    assert_eq!(First::lift(third), First::fixed(third));
    assert_eq!(Second::lift(third), Second::fixed(First::fixed(third)));
    assert_eq!(Dual::<f64>::lift(0.1), Dual::fixed(0.1));
    assert_eq!(Dual::<f32>::lift(0.1f64), Dual::fixed(0.1f32));
    assert_eq!(First::lift(0.1f32).re, number(f64::from(0.1f32)));
    assert_eq!(Dual::<f64>::lift(7u8), Dual::fixed(7.0));
    assert_eq!(
        First::lift(i64::MAX).re - number(2f64.powi(63)),
        number(-1.0)
    );
    let x = Dual::new(1.0, 2.0);
    assert_eq!(Dual::<f64>::lift(x), x);
}

/// Values are rounded once; derivatives are kept where the scalar has them, as its innermost ones.
#[test]
fn parameters_become_every_scalar() {
    let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
    assert_eq!(third.into_real::<DoubleDouble>(), third);
    assert_eq!(third.into_real::<f64>(), 1.0 / 3.0);
    assert_eq!(0.1.into_real::<f32>(), 0.1f32);
    assert_eq!(0.1f32.into_real::<f64>(), f64::from(0.1f32));
    assert_eq!(
        (-0.0).into_real::<Dual<f64>>().re.to_bits(),
        (-0f64).to_bits()
    );
    assert_eq!(u64::MAX.into_real::<DoubleDouble>().lo(), -1.0);
    let one = Dual::new(2.0, 3.0);
    assert_eq!(one.into_real::<f64>(), 2.0);
    assert_eq!(one.into_real::<Dual<f64>>(), one);
    assert_eq!(one.into_real::<Dual<Dual<f64>>>(), Dual::fixed(one));
    let two = Dual::new(one, Dual::new(5.0, 7.0));
    assert_eq!(two.into_real::<Dual<Dual<f64>>>(), two);
    assert_eq!(two.into_real::<Dual<Dual<Dual<f64>>>>(), Dual::fixed(two));
    // Of more derivatives than there are places, the outermost are kept.
    assert_eq!(two.into_real::<Dual<f64>>(), Dual::new(2.0, 5.0));
    assert_eq!(two.into_real::<f64>(), 2.0);
}
