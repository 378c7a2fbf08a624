//! Quotients, products, logarithms and powers of sums of different exponentials, with two derivatives, against numbers
//! of 9000 bits after the point.
//!
//! Bounds: what a relative error of 4ε of an argument of an exponential, or of x, does to the exact result, eight times,
//! and some roundings. The control evaluates the formula over dual numbers in `f64`, which is not rewritten: values or
//! derivatives of a part of the cases are NaN or wrong.

use crate::common;
use crate::saturation::{Fixed, Jet, computed};
use crate::tree::Random;
use hamiltonian_lanes::{Dual, Real};
use num_bigint::BigInt;
use std::collections::HashMap;

/// The change of an argument, in units of which bounds are.
const NUDGE: f64 = 4.0 * f64::EPSILON;

/// A formula in x and a parameter r.
#[derive(Clone, Debug)]
enum Formula {
    Number(f64),
    X,
    R,
    Exp(Box<Formula>),
    /// 2^x
    Two(Box<Formula>),
    Ln(Box<Formula>),
    Sqrt(Box<Formula>),
    Power(Box<Formula>, f64),
    Add(Box<Formula>, Box<Formula>),
    Mul(Box<Formula>, Box<Formula>),
    Div(Box<Formula>, Box<Formula>),
}

use Formula::{Add, Div, Exp, Ln, Mul, Number, Power, R, Sqrt, Two, X};

/// The place where numbers are exact but for one argument of an exponential.
struct Place {
    x: Fixed,
    r: Fixed,
    /// The roundings that have been met, and the one that is nudged.
    met: usize,
    nudged: usize,
    /// Exponentials and logarithms by their arguments.
    known: HashMap<(bool, BigInt), Fixed>,
}

impl Place {
    fn exp(&mut self, a: &Fixed) -> Fixed {
        let value = self.known.entry((true, a.0.clone()));
        value.or_insert_with(|| a.exp()).clone()
    }
    fn ln(&mut self, a: &Fixed) -> Fixed {
        let value = self.known.entry((false, a.0.clone()));
        value.or_insert_with(|| a.ln()).clone()
    }
    fn is_next_nudged(&mut self) -> bool {
        self.met += 1;
        self.met - 1 == self.nudged
    }
}

impl Formula {
    fn text(&self) -> String {
        match self {
            Number(k) => format!("({k})"),
            X => "x".into(),
            R => "r".into(),
            Exp(a) => format!("exp({})", a.text()),
            Two(a) => format!("2^({})", a.text()),
            Ln(a) => format!("ln({})", a.text()),
            Sqrt(a) => format!("sqrt({})", a.text()),
            Power(a, k) => format!("({})^({k})", a.text()),
            Add(a, b) => format!("({} + {})", a.text(), b.text()),
            Mul(a, b) => format!("({}*{})", a.text(), b.text()),
            Div(a, b) => format!("({}/{})", a.text(), b.text()),
        }
    }
    /// The reference.
    fn jet(&self, place: &mut Place) -> Jet {
        match self {
            Number(k) => Jet::number(*k),
            X => Jet([place.x.clone(), Fixed::of(1.0), Fixed::of(0.0)]),
            R => Jet([place.r.clone(), Fixed::of(0.0), Fixed::of(0.0)]),
            Exp(a) => exponential(&a.jet(place), place),
            Two(a) => {
                let log = place.ln(&Fixed::of(2.0));
                let log = Jet([log, Fixed::of(0.0), Fixed::of(0.0)]);
                let a = a.jet(place).mul(&log);
                exponential(&a, place)
            }
            Ln(a) => {
                let mut jet = logarithm(&a.jet(place), place);
                // The argument is rounded.
                if place.is_next_nudged() {
                    jet.0[0] = jet.0[0].add(&Fixed::of(NUDGE));
                }
                jet
            }
            Sqrt(a) => power(&a.jet(place), 0.5, place),
            Power(a, k) => power(&a.jet(place), *k, place),
            Add(a, b) => a.jet(place).add(&b.jet(place)),
            Mul(a, b) => a.jet(place).mul(&b.jet(place)),
            Div(a, b) => a.jet(place).div(&b.jet(place)),
        }
    }
    /// The formula as it stands.
    fn plain<T: Real>(&self, x: T, r: T) -> T {
        let number = |k: f64| T::constant(k, 0.0);
        match self {
            Number(k) => number(*k),
            X => x,
            R => r,
            Exp(a) => a.plain(x, r).exp(),
            Two(a) => number(2.0).pow(a.plain(x, r)),
            Ln(a) => a.plain(x, r).ln(),
            Sqrt(a) => a.plain(x, r).sqrt(),
            Power(a, k) => a.plain(x, r).pow(number(*k)),
            Add(a, b) => a.plain(x, r) + b.plain(x, r),
            Mul(a, b) => a.plain(x, r) * b.plain(x, r),
            Div(a, b) => a.plain(x, r) / b.plain(x, r),
        }
    }
}

/// exp(a), times 1 + NUDGE·a if it is nudged.
fn exponential(a: &Jet, place: &mut Place) -> Jet {
    let [value, slope, bend] = &a.0;
    let mut e = place.exp(value);
    if place.is_next_nudged() {
        e = e.add(&e.mul(value).mul(&Fixed::of(NUDGE)));
    }
    let second = bend.add(&slope.mul(slope));
    Jet([e.clone(), e.mul(slope), e.mul(&second)])
}

fn logarithm(a: &Jet, place: &mut Place) -> Jet {
    let [value, slope, bend] = &a.0;
    let first = slope.div(value);
    let second = bend.div(value).sub(&first.mul(&first));
    Jet([place.ln(value), first, second])
}

fn power(a: &Jet, k: f64, place: &mut Place) -> Jet {
    let logarithm = logarithm(a, place);
    exponential(&logarithm.mul(&Jet::number(k)), place)
}

fn sum(a: Formula, b: Formula) -> Formula {
    Add(Box::new(a), Box::new(b))
}
fn product(a: Formula, b: Formula) -> Formula {
    Mul(Box::new(a), Box::new(b))
}
fn quotient(a: Formula, b: Formula) -> Formula {
    Div(Box::new(a), Box::new(b))
}

/// The exponential of a number times x, x² or (x − r)², or of the parameter.
fn one(random: &mut Random, is_bell: bool) -> Formula {
    let k = Number(random.one_of(&[1.0, -1.0, 2.0, 0.5, -0.75]));
    let shifted = sum(X, product(Number(-1.0), R));
    let a = match (is_bell, random.below(3)) {
        (_, 0) => product(k, X),
        (false, 1) => sum(product(k, X), R),
        (false, _) => R,
        (true, 1) => product(Number(-1.0), product(shifted.clone(), shifted)),
        (true, _) => product(Number(-0.5), product(X, X)),
    };
    Exp(Box::new(a))
}

/// A sum of two or three exponentials, or of one and a number.
fn several(random: &mut Random, is_bell: bool) -> Formula {
    let c = Number(random.one_of(&[1.0, 2.0, 0.25]));
    let first = product(c.clone(), one(random, is_bell));
    match random.below(4) {
        0 => sum(c, first),
        1 => sum(sum(first, one(random, is_bell)), one(random, is_bell)),
        _ => sum(first, one(random, is_bell)),
    }
}

fn grow(random: &mut Random, is_bell: bool) -> Formula {
    match random.below(9) {
        0 | 1 => quotient(one(random, is_bell), several(random, is_bell)),
        2 => quotient(several(random, is_bell), several(random, is_bell)),
        3 | 4 => Ln(Box::new(several(random, is_bell))),
        5 => product(one(random, is_bell), one(random, is_bell)),
        6 => {
            let inner = Exp(Box::new(product(Number(-0.5), X)));
            let outer = Exp(Box::new(product(Number(-1.0), inner)));
            product(outer, one(random, false))
        }
        7 => match random.chance(0.5) {
            true => Sqrt(Box::new(several(random, is_bell))),
            false => Power(Box::new(several(random, is_bell)), 0.3),
        },
        _ => {
            let two = Two(Box::new(X));
            quotient(two.clone(), sum(Number(1.0), two))
        }
    }
}

#[test]
fn mixtures_of_exponentials_are_right_at_any_argument() {
    let mut random = Random(3804);
    let (mut wrong, mut control, mut worst) = (Vec::new(), 0, 0.0_f64);
    let count = common::cases(200, 3_000);
    for _ in 0..count {
        let is_bell = random.chance(0.4);
        let formula = grow(&mut random, is_bell);
        let size = match (is_bell, random.below(4)) {
            (_, 0) => 4.0,
            (true, _) => 40.0,
            (false, 1) => 40.0,
            (false, _) => 1200.0,
        };
        // Arguments of exponentials of exponentials are below a few thousand.
        let least = if formula.text().contains("-exp(") || formula.text().contains("(-1)*exp(") {
            -16.0
        } else {
            -size
        };
        let x = (least + (size - least) * random.unit()) as f32;
        let (x, r) = (f64::from(x), random.one_of(&[0.5, 3.0, -2.25]));
        let mut place = Place {
            x: Fixed::of(x),
            r: Fixed::of(r),
            met: 0,
            nudged: usize::MAX,
            known: HashMap::new(),
        };
        let exact = formula.jet(&mut place).0;
        let mut nudged = Vec::new();
        for n in 0..place.met {
            (place.met, place.nudged) = (0, n);
            nudged.push(formula.jet(&mut place).0);
        }
        (place.x, place.nudged) = (Fixed::of(x * (1.0 + NUDGE)), usize::MAX);
        nudged.push(formula.jet(&mut place).0);
        let value = exact.each_ref().map(Fixed::to_f64);
        let bound: [f64; 3] = std::array::from_fn(|n| {
            let change = |other: &[Fixed; 3]| other[n].sub(&exact[n]).to_f64().abs();
            let changes: f64 = nudged.iter().map(change).sum();
            8.0 * (changes + f64::EPSILON * value[n].abs())
        });
        let off = |found: [f64; 3]| {
            let one = |n: usize| match value[n].abs() {
                size if size > 1e290 || !size.is_finite() => 0.0,
                size if size < 1e-290 && found[n].abs() < 1e-280 => 0.0,
                _ if found[n].is_nan() => f64::INFINITY,
                _ => (found[n] - value[n]).abs() / bound[n],
            };
            (0..3).map(one).fold(0.0, f64::max)
        };
        let found = computed(&format!("p^2/2 + {}", formula.text()), [x, r, 1.0]);
        let error = off(found);
        if error > 1.0 {
            wrong.push(format!(
                "{} at x = {x}, r = {r}: {found:?} for {value:?}, {error}",
                formula.text()
            ));
        }
        worst = worst.max(error);
        let inner = Dual::new(Dual::variable(x), Dual::fixed(1.0));
        let plain = formula.plain(inner, Dual::fixed(Dual::fixed(r)));
        control += usize::from(off([plain.re.re, plain.re.eps, plain.eps.eps]) > 1.0);
    }
    println!("{worst} of the bound; {control} of {count} wrong without rewriting");
    assert!(wrong.is_empty(), "{} wrong: {wrong:#?}", wrong.len());
    assert!(control * 8 > count, "{control} of {count}");
}
