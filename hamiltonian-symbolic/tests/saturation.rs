//! Saturating functions and their first and second derivatives at arguments of any size, against numbers of 9000 bits
//! after the point.
//!
//! The reference evaluates each function as it is written, with derivatives by the rules for quotients. Bounds are some
//! roundings and those of the argument. The control evaluates the formula over dual numbers in `f64`, which is not
//! rewritten: values or derivatives of a part of the cases are NaN or wrong.

use crate::common;
use crate::tree::Random;
use hamiltonian_lanes::{Dual, Real};
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use num_bigint::BigInt;

/// The bits after the point.
const BITS: usize = 9000;

/// A fixed-point number.
#[derive(Clone, Debug)]
pub struct Fixed(pub BigInt);

impl Fixed {
    pub fn of(x: f64) -> Fixed {
        let bits = x.abs().to_bits();
        let (exponent, mantissa) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
        let (exponent, mantissa) = match exponent {
            0 => (-1074, mantissa),
            _ => (exponent - 1075, mantissa | 1 << 52),
        };
        let shift = BITS as i64 + exponent;
        let size = BigInt::from(mantissa) << shift;
        Fixed(if x < 0.0 { -size } else { size })
    }
    pub fn to_f64(&self) -> f64 {
        let bits = self.0.bits() as i64;
        let shift = (bits - 64).max(0);
        let top = (&self.0 >> shift).to_string().parse::<f64>().unwrap();
        let half = (shift - BITS as i64) / 2;
        let rest = shift - BITS as i64 - half;
        top * 2f64.powi(half as i32) * 2f64.powi(rest as i32)
    }
    pub fn add(&self, other: &Fixed) -> Fixed {
        Fixed(&self.0 + &other.0)
    }
    pub fn sub(&self, other: &Fixed) -> Fixed {
        Fixed(&self.0 - &other.0)
    }
    pub fn mul(&self, other: &Fixed) -> Fixed {
        Fixed((&self.0 * &other.0) >> BITS)
    }
    pub fn div(&self, other: &Fixed) -> Fixed {
        Fixed((&self.0 << BITS) / &other.0)
    }
    pub fn exp(&self) -> Fixed {
        // exp(x) = exp(x/2⁸⁰)^(2⁸⁰)
        let small = Fixed(&self.0 >> 80);
        let (mut term, mut sum) = (Fixed::of(1.0), Fixed::of(1.0));
        for n in 1..130 {
            term = Fixed(term.mul(&small).0 / n);
            sum = sum.add(&term);
        }
        (0..80).fold(sum, |power, _| power.mul(&power))
    }
    /// The logarithm, by Newton's steps from one of 50 bits on.
    pub fn ln(&self) -> Fixed {
        let bits = self.0.bits() as i64;
        let shift = (bits - 64).max(0);
        let top = (&self.0 >> shift).to_string().parse::<f64>().unwrap();
        let binary = (shift - BITS as i64) as f64;
        let mut y = Fixed::of(top.ln() + binary * std::f64::consts::LN_2);
        for _ in 0..2 {
            // x·exp(−y) − 1
            let less = self.mul(&Fixed(-&y.0).exp()).sub(&Fixed::of(1.0));
            y = y.add(&less.sub(&less.mul(&less).mul(&Fixed::of(0.5))));
        }
        y
    }
}

/// A value with two derivatives.
#[derive(Clone, Debug)]
pub struct Jet(pub [Fixed; 3]);

impl Jet {
    pub fn number(x: f64) -> Jet {
        Jet([Fixed::of(x), Fixed::of(0.0), Fixed::of(0.0)])
    }
    pub fn add(&self, other: &Jet) -> Jet {
        Jet(std::array::from_fn(|n| self.0[n].add(&other.0[n])))
    }
    pub fn mul(&self, other: &Jet) -> Jet {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        let mixed = b.mul(y);
        let second = a.mul(z).add(&mixed).add(&mixed).add(&c.mul(x));
        Jet([a.mul(x), a.mul(y).add(&b.mul(x)), second])
    }
    pub fn div(&self, other: &Jet) -> Jet {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        let q = a.div(x);
        let first = b.sub(&q.mul(y)).div(x);
        let mixed = first.mul(y);
        let second = c.sub(&q.mul(z)).sub(&mixed).sub(&mixed).div(x);
        Jet([q, first, second])
    }
}

/// A formula in x, and in u = (x − r)/s.
#[derive(Clone, Debug)]
enum Formula {
    Number(f64),
    X,
    Call(&'static str, f64),
    Add(Box<Formula>, Box<Formula>),
    Mul(Box<Formula>, Box<Formula>),
    Div(Box<Formula>, Box<Formula>),
}

use Formula::{Add, Call, Div, Mul, Number, X};

impl Formula {
    fn text(&self) -> String {
        match self {
            Number(x) => format!("({x})"),
            X => "x".into(),
            Call(name, k) => format!("{name}({k}*(x - r)/s)"),
            Add(a, b) => format!("({} + {})", a.text(), b.text()),
            Mul(a, b) => format!("({}*{})", a.text(), b.text()),
            Div(a, b) => format!("({}/{})", a.text(), b.text()),
        }
    }
    /// The reference: `e` is exp(u/2).
    fn jet(&self, x: f64, e: &Jet) -> Jet {
        match self {
            Number(x) => Jet::number(*x),
            X => Jet([Fixed::of(x), Fixed::of(1.0), Fixed::of(0.0)]),
            Call(name, k) => {
                let n = (2.0 * k) as i32;
                let one = Jet::number(1.0);
                let power = (0..n.abs()).fold(one.clone(), |power, _| power.mul(e));
                let inverse = one.div(&power);
                let (up, down) = if n < 0 {
                    (inverse, power)
                } else {
                    (power, inverse)
                };
                let minus = |a: &Jet| a.mul(&Jet::number(-1.0));
                let (half, one) = (Jet::number(0.5), Jet::number(1.0));
                match *name {
                    "exp" => up,
                    "exp_m1" => up.add(&minus(&one)),
                    "sinh" => up.add(&minus(&down)).mul(&half),
                    "cosh" => up.add(&down).mul(&half),
                    _ => up.add(&minus(&down)).div(&up.add(&down)),
                }
            }
            Add(a, b) => a.jet(x, e).add(&b.jet(x, e)),
            Mul(a, b) => a.jet(x, e).mul(&b.jet(x, e)),
            Div(a, b) => a.jet(x, e).div(&b.jet(x, e)),
        }
    }
    /// The formula as it stands.
    fn plain<T: Real>(&self, x: T, u: T) -> T {
        let number = |x: f64| T::constant(x, 0.0);
        match self {
            Number(x) => number(*x),
            X => x,
            Call(name, k) => {
                let u = number(*k) * u;
                match *name {
                    "exp" => u.exp(),
                    "exp_m1" => u.exp_m1(),
                    "sinh" => u.sinh(),
                    "cosh" => u.cosh(),
                    _ => u.tanh(),
                }
            }
            Add(a, b) => a.plain(x, u) + b.plain(x, u),
            Mul(a, b) => a.plain(x, u) * b.plain(x, u),
            Div(a, b) => a.plain(x, u) / b.plain(x, u),
        }
    }
}

fn product(a: Formula, b: Formula) -> Formula {
    Mul(Box::new(a), Box::new(b))
}
fn sum(a: Formula, b: Formula) -> Formula {
    Add(Box::new(a), Box::new(b))
}

/// A saturating function: a quotient that is bounded on one side at least, or a power of tanh.
fn grow(random: &mut Random) -> Formula {
    let k = random.one_of(&[1.0, -1.0, 2.0, 0.5]);
    let c = random.one_of(&[1.0, 2.0, 0.25]);
    let above = match random.below(8) {
        0 | 1 => Number(c),
        2 => Call("exp", k),
        3 => Call("sinh", k),
        4 => Call("exp_m1", k),
        5 => X,
        6 => sum(Call("exp", k), Number(-1.0)),
        _ => Call("tanh", k),
    };
    let below = match random.below(8) {
        0 | 1 => sum(Number(c), Call("exp", k)),
        2 => sum(Number(1.0), Call("exp", -k)),
        3 => Call("cosh", k),
        4 => sum(Call("cosh", k), Number(c)),
        5 => sum(Call("exp", k), Call("exp", -k)),
        6 => sum(sum(Number(c), Call("exp", k)), Call("exp", 2.0 * k)),
        _ => Call("exp_m1", k),
    };
    let below = match random.below(3) {
        0 => product(below.clone(), below),
        _ => below,
    };
    match random.below(6) {
        0 => product(Call("tanh", k), Call("tanh", k)),
        1 => Call("tanh", k),
        _ => Div(Box::new(above), Box::new(below)),
    }
}

/// H and its first and second derivative by x at a point.
pub fn computed(h: &str, [x, r, s]: [f64; 3]) -> [f64; 3] {
    let mut model = common::system("x; p", "", "r s", h);
    let wanted = [Purpose::Energy, Purpose::GradientQ, Purpose::HessianVector];
    let program = derive(&mut model, &wanted).unwrap();
    let column = |side| Column {
        side,
        group: 0,
        column: 0,
    };
    let mut point = Point::<f64>::new();
    point.scalars = vec![r, s];
    let numbers = |x: f64| vec![vec![x]];
    for (side, value, direction) in [(Side::Q, x, 1.0), (Side::P, 0.0, 0.0)] {
        point
            .arrays
            .insert(Array::Phase(column(side)), numbers(value));
        point
            .arrays
            .insert(Array::Direction(column(side)), numbers(direction));
        point
            .outputs
            .insert(Target::Phase(column(side)), numbers(0.0));
    }
    let [energy, gradient, hessian] =
        [0, 1, 2].map(|at| run(&program, &program.functions[at], &point));
    let slope = |outcome: &hamiltonian_symbolic::interpret::Outcome<f64>| {
        outcome.outputs[&Target::Phase(column(Side::Q))][0][0]
    };
    [energy.results[0], slope(&gradient), slope(&hessian)]
}

/// The errors in units of their bounds; 0 where a number is too small or too large for its digits.
fn off(found: [f64; 3], exact: [f64; 3], [x, r, s]: [f64; 3]) -> [f64; 3] {
    let u = (1.0 + ((x - r) / s).abs()) * (1.0 + r.abs() / (x - r).abs().max(1e-3));
    let near = 8.0 * f64::EPSILON * u;
    let [f, d, dd] = exact.map(f64::abs);
    let width = s.abs().min(1.0);
    // A derivative is 0 where the next is not.
    let bounds = [
        near * (f + d * width),
        near * (d + dd * width),
        near * (dd + d / width),
    ];
    std::array::from_fn(|n| match exact[n].abs() {
        size if size > 1e290 || !size.is_finite() => 0.0,
        size if size < 1e-290 => match found[n].abs() < 1e-280 {
            true => 0.0,
            false => f64::INFINITY,
        },
        _ if found[n].is_nan() => f64::INFINITY,
        _ => (found[n] - exact[n]).abs() / bounds[n],
    })
}

#[test]
fn saturating_functions_are_right_at_any_argument() {
    let mut random = Random(3801);
    let (mut wrong, mut control, mut worst) = (Vec::new(), 0, 0.0_f64);
    let count = common::cases(300, 10_000);
    for _ in 0..count {
        let formula = grow(&mut random);
        let s = random.one_of(&[1.0, -1.0, 0.5, 0.7]);
        let r = random.one_of(&[0.0, 1.0, 2.5]);
        let u = match random.below(4) {
            0 => 4.0 * random.unit(),
            1 => 40.0 * random.unit(),
            2 => 300.0 + 460.0 * random.unit(),
            _ => 10f64.powf(3.0 * random.unit() - 0.1),
        };
        let u = if random.chance(0.5) { u } else { -u };
        let x = (r + s * u) as f32;
        let at = [f64::from(x), r, s];
        let x = at[0];
        // u exactly, with its derivative.
        let argument = Fixed::of(x).sub(&Fixed::of(r)).div(&Fixed::of(2.0 * s));
        let slope = Fixed::of(1.0).div(&Fixed::of(2.0 * s));
        let e = argument.exp();
        let first = e.mul(&slope);
        let e = Jet([e, first.clone(), first.mul(&slope)]);
        let exact = formula.jet(x, &e).0.map(|x| x.to_f64());
        // Where the quotient x/(eˣ − 1) has a value at 0 for every parameter, the definition shows it.
        let text = match r {
            0.0 => formula.text().replace("(x - r)", "x"),
            _ => formula.text(),
        };
        let found = computed(&format!("p^2/2 + {text}"), at);
        let errors = off(found, exact, at);
        if errors.iter().any(|error| *error > 1.0) {
            wrong.push(format!(
                "{text} at {at:?}: {found:?} for {exact:?}, {errors:?}"
            ));
        }
        worst = errors.into_iter().fold(worst, f64::max);
        let inner = Dual::new(Dual::variable(x), Dual::fixed(1.0));
        let fixed = |x: f64| Dual::fixed(Dual::fixed(x));
        let plain = formula.plain(inner, (inner - fixed(r)) / fixed(s));
        let plain = [plain.re.re, plain.re.eps, plain.eps.eps];
        control += usize::from(off(plain, exact, at).iter().any(|error| *error > 1.0));
    }
    println!("{worst} of the bound; {control} of {count} wrong without rewriting");
    assert!(wrong.is_empty(), "{} wrong: {wrong:#?}", wrong.len());
    assert!(control * 12 > count, "{control} of {count}");
}

/// x/(eˣ − 1) and its derivatives near x = 0, and on both sides of the end of its series.
#[test]
fn a_quotient_with_a_value_at_zero_is_right_there() {
    let mut control = 0.0_f64;
    for k in [1.0, -1.0, 2.0, 0.5] {
        let formula = Div(Box::new(X), Box::new(Call("exp_m1", k)));
        let text = formula.text().replace("(x - r)", "x");
        for exponent in -40..=8 {
            for (sign, s) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -0.7)] {
                let x = f64::from((sign * 10_f64.powf(f64::from(exponent) / 8.0)) as f32);
                let at = [x, 0.0, s];
                let slope = Fixed::of(1.0).div(&Fixed::of(2.0 * s));
                let e = Fixed::of(x).mul(&slope).exp();
                let first = e.mul(&slope);
                let e = Jet([e, first.clone(), first.mul(&slope)]);
                let exact = formula.jet(x, &e).0.map(|x| x.to_f64());
                let found = computed(&format!("p^2/2 + {text}"), at);
                let errors = off(found, exact, at);
                assert!(
                    errors.iter().all(|error| *error < 1.0),
                    "{text} at {at:?}: {errors:?}"
                );
                let inner = Dual::new(Dual::variable(x), Dual::fixed(1.0));
                let plain = formula.plain(inner, inner / Dual::fixed(Dual::fixed(s)));
                let plain = [plain.re.re, plain.re.eps, plain.eps.eps];
                control = off(plain, exact, at).into_iter().fold(control, f64::max);
            }
        }
        let [value, slope, second] = computed(&format!("p^2/2 + {text}"), [0.0, 0.0, 1.0]);
        assert_eq!([value, slope], [1.0 / k, -0.5], "{text}");
        assert!((second - k / 6.0).abs() < 1e-16, "{text}: {second}");
    }
    assert!(control > 1e6, "the quotient itself is wrong: {control}");
}

/// Logarithms of sums of exponentials, whose value overflows or vanishes.
#[test]
fn logarithms_of_saturating_sums_are_finite() {
    for x in [-1e4, -800.0, -50.0, -1.0, 0.0, 1.0, 50.0, 800.0, 1e4] {
        let (large, e) = (f64::max(x, 0.0), (-f64::abs(x)).exp());
        let logistic = if x > 0.0 {
            1.0 / (1.0 + e)
        } else {
            e / (1.0 + e)
        };
        for h in ["ln(1 + exp(x))", "ln_1p(exp(x))"] {
            let [value, slope, bend] = computed(&format!("p^2/2 + {h}"), [x, 0.0, 1.0]);
            let near = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs() + 1e-300;
            assert!(near(value, large + e.ln_1p()), "{h} at {x}: {value}");
            assert!(near(slope, logistic), "{h} at {x}: {slope}");
            assert!(
                near(bend, e / ((1.0 + e) * (1.0 + e))),
                "{h} at {x}: {bend}"
            );
        }
        let [value, slope, bend] = computed("p^2/2 + ln(cosh(x))", [x, 0.0, 1.0]);
        let e = (-2.0 * f64::abs(x)).exp();
        let exact = x.abs() + e.ln_1p() - 2f64.ln();
        assert!((value - exact).abs() <= 4.0 * f64::EPSILON * exact.max(1.0));
        assert!((slope - x.tanh()).abs() <= 8.0 * f64::EPSILON * slope.abs());
        let exact = 4.0 * e / ((1.0 + e) * (1.0 + e));
        assert!(
            (bend - exact).abs() <= 8.0 * f64::EPSILON * exact,
            "{x}: {bend}"
        );
    }
}

/// Logarithms of sums with coefficients of unknown sign, and of small sums.
#[test]
fn logarithms_are_right_far_out() {
    let near = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs();
    for x in [-900.0, -45.0, 3.0, 45.0, 900.0] {
        // A double well: the wells are at −1 and 1, with depths r = 2 and s = 3.
        let h = "p^2/2 - ln(r*exp(-(x + 1)^2) + s*exp(-(x - 1)^2))";
        let [value, slope, bend] = computed(h, [x, 2.0, 3.0]);
        let (right, e) = (f64::from(x > 0.0), (-4.0 * x.abs()).exp());
        let (large, small) = if x > 0.0 { (3.0, 2.0) } else { (2.0, 3.0) };
        let exact = (x.abs() - 1.0).powi(2) - (large + small * e).ln();
        let share = small * e / (large + small * e);
        let side = 2.0 * right - 1.0;
        assert!(near(value, exact), "{x}: {value} for {exact}");
        let exact = 2.0 * (x - side) + 4.0 * side * share;
        assert!(near(slope, exact), "{x}: {slope} for {exact}");
        let exact = 2.0 - 16.0 * share * (1.0 - share);
        assert!(near(bend, exact), "{x}: {bend} for {exact}");
    }
    for x in [-900.0, -60.0, -1.0, 800.0] {
        let [value, ..] = computed("p^2/2 + ln_1p(2*exp(x))", [x, 0.0, 1.0]);
        let exact = match x > 0.0 {
            true => x + (2.0 + (-x).exp()).ln(),
            false => (2.0 * x.exp()).ln_1p(),
        };
        assert!(near(value, exact), "{x}: {value} for {exact}");
        let [value, ..] = computed("p^2/2 + ln(exp_m1(abs(x)))", [x, 0.0, 1.0]);
        let exact = x.abs() + (-(-x.abs()).exp_m1()).ln();
        assert!(near(value, exact), "{x}: {value} for {exact}");
    }
}

/// What cannot overflow keeps its form.
#[test]
fn other_functions_are_left_alone() {
    for h in [
        "(1 - exp(-(x - r)/s))^2",
        "exp(-x^2)",
        "cosh(x)*x",
        "sinh(x)^2 + exp(2*x)",
        "exp_m1(x)/x",
        "1/(1 + exp(-x^2))",
        "sqrt(1 + exp(-x^2))",
        "exp(x) + exp(r) + exp(-x^2)",
        "exp(-x^2)*exp(-r^2)",
        "2^x",
        "1/(exp(-x^2) + exp(-r^2) + 1)",
    ] {
        let mut model = common::system("x; p", "", "r s", h);
        let wanted = [Purpose::Energy, Purpose::GradientQ];
        let text = format!("{:?}", derive(&mut model, &wanted).unwrap());
        let changes = ["Min", "Max", "Select"].iter().any(|op| text.contains(op));
        assert!(!changes || h == "2^x", "{h}: {text}");
        assert!(!text.contains("Exp") || h.contains("exp"), "{h}: {text}");
    }
}
