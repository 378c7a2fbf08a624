//! Quotients of exponentials in forms that do not overflow.
//!
//! Input: roots, derivatives among them. Output: the same functions. A product whose factors grow and vanish with one
//! exponential, such as exp(x)/(1 + exp(x))², and a sum whose leading terms cancel as it grows, such as 1 − tanh(x)², are
//! written in E = exp(−|x|) ≤ 1, here E/(1 + E)² and 4E²/(1 + E²)². Invariant: what cannot fail is left as it is; a choice
//! is made by 0 < x alone, so that derivatives over dual numbers are those of the branch taken.
//!
//! One exponential e = exp(w) is treated after the other, all else in coefficients. For x > 0 a polynomial is
//! E^−d·(c₀·E^d + … + c_d), otherwise c₀ + … + c_d·E^d: the powers of E before these are added up and cancel.

mod form;

use crate::dag::{Dag, Kind, Map, Node};
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;
use form::{Form, Polynomial};

/// The highest power of e that a function has.
const HIGHEST: i32 = 8;

/// The size of arguments up to which nothing overflows, and no digits are lost by cancellation.
const SMALL: f64 = 2.0;

/// Rewrites the expressions the roots stand for.
pub(crate) fn saturate(dag: &mut Dag, roots: &mut [Node]) {
    for (base, unit) in bases(dag, roots) {
        let exponent = dag.scale(&unit, base);
        let mut exponential = Exponential {
            base,
            unit,
            exponent,
            forms: Map::default(),
        };
        exponential.rewrite(dag, roots);
    }
}

/// The factor and the rest of an argument: numbers alone are a base by themselves.
fn argument(dag: &mut Dag, x: Node) -> (Rational, Node) {
    match dag.is_number(x) {
        true => (Rational::ONE, x),
        false => dag.split_coefficient(x),
    }
}

/// A bound of the size of an expression.
fn bound(dag: &Dag, node: Node) -> f64 {
    match dag.kind(node) {
        Kind::Constant(k) => k.to_f64().abs(),
        Kind::Pi => 4.0,
        Kind::Call(Op::Sin | Op::Cos | Op::Tanh | Op::Erf | Op::Sign, _) => 1.0,
        Kind::Call(Op::Asin | Op::Atan, _) => 1.6,
        Kind::Call(Op::Min | Op::Max | Op::Abs, x) => {
            x.iter().map(|x| bound(dag, *x)).fold(0.0, f64::max)
        }
        Kind::Sum(c, terms) => {
            let terms = terms
                .iter()
                .map(|(k, node)| k.to_f64().abs() * bound(dag, *node));
            c.to_f64().abs() + terms.sum::<f64>()
        }
        Kind::Product(k, factors) => {
            let factor = |(node, n): &(Node, i32)| match *n > 0 {
                true => bound(dag, *node).powi(*n),
                false => f64::INFINITY,
            };
            k.to_f64().abs() * factors.iter().map(factor).product::<f64>()
        }
        _ => f64::INFINITY,
    }
}

/// The argument of a function of exponentials, and the least power of exp(argument) in it.
fn exponential_argument(kind: &Kind) -> Option<(Node, i64)> {
    match kind {
        Kind::Call(Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh, x) => Some((x[0], 1)),
        Kind::Call(Op::Tanh, x) => Some((x[0], 2)),
        _ => None,
    }
}

/// The nodes below the roots in the order of the source, which does not depend on their numbers.
fn in_source_order(dag: &Dag, roots: &[Node]) -> Vec<Node> {
    let (mut order, mut met) = (Vec::new(), Map::default());
    let mut left: Vec<Node> = roots.iter().rev().copied().collect();
    while let Some(node) = left.pop() {
        if met.insert(node, ()).is_none() {
            order.push(node);
            let children = left.len();
            dag.for_children(node, |child| left.push(child));
            left[children..].reverse();
        }
    }
    order
}

/// The different x of exp(k·x) with the unit of which each k is a whole multiple, none of them high.
fn bases(dag: &mut Dag, roots: &[Node]) -> Vec<(Node, Rational)> {
    let mut found: Vec<(Node, Vec<Rational>)> = Vec::new();
    for node in in_source_order(dag, roots) {
        let Some((x, power)) = exponential_argument(dag.kind(node)) else {
            continue;
        };
        if bound(dag, x) <= SMALL {
            continue;
        }
        let (k, base) = argument(dag, x);
        let k = k.mul(&Rational::integer(power));
        match found.iter_mut().find(|(other, _)| *other == base) {
            Some((_, all)) => all.push(k),
            None => found.push((base, vec![k])),
        }
    }
    let unit = |all: &[Rational]| {
        let small: Option<Vec<(i64, i64)>> = all.iter().map(Rational::to_small).collect();
        let small = small?;
        let denominator = small.iter().try_fold(1_i64, |all, (_, d)| {
            let product = all.checked_mul(*d)?;
            Some(product / num_integer::gcd(all, *d))
        })?;
        let whole = small.iter().map(|(n, d)| n.checked_mul(denominator / d));
        let whole: Vec<i64> = whole.collect::<Option<_>>()?;
        let divisor = whole.iter().fold(0, |all, n| num_integer::gcd(all, *n));
        let is_low = whole
            .iter()
            .all(|n| n.abs() / divisor <= i64::from(HIGHEST));
        is_low.then(|| Rational::new(divisor, denominator))
    };
    let units = found.into_iter();
    units
        .filter_map(|(base, all)| Some((base, unit(&all)?)))
        .collect()
}

/// An expression in e, and whether its evaluation as it stands may fail.
#[derive(Clone, Debug)]
struct KnownForm {
    form: Form,
    fails: bool,
}

/// One exponential.
struct Exponential {
    base: Node,
    unit: Rational,
    /// w of e = exp(w).
    exponent: Node,
    /// The forms of nodes that contain e.
    forms: Map<Node, KnownForm>,
}

impl Exponential {
    fn rewrite(&mut self, dag: &mut Dag, roots: &mut [Node]) {
        let order = dag.reachable(roots);
        let new = dag.map(order, |dag, node, new| {
            let known = self.known(dag, node, new);
            let image = match &known {
                Some(known) if known.fails => self.emitted(dag, &known.form),
                _ => match self.logarithm(dag, node) {
                    Some(image) => image,
                    None => dag.rebuild(node, &|child| new[&child]),
                },
            };
            if let Some(known) = known {
                self.forms.insert(node, known);
            }
            image
        });
        for root in roots {
            *root = new[root];
        }
    }

    /// n of exp(x) = eⁿ.
    fn multiple(&self, dag: &mut Dag, x: Node) -> Option<i32> {
        let (k, base) = argument(dag, x);
        if base != self.base {
            return None;
        }
        let (n, d) = k.mul(&self.unit.recip()?).to_small()?;
        // The unit of tanh is that of exp(2x).
        (d == 1).then(|| i32::try_from(n).ok()).flatten()
    }

    /// The directions in which e can go: to ∞ and to 0.
    fn directions(&self, dag: &Dag) -> Vec<bool> {
        let sign = dag.sign(self.exponent);
        let mut all = Vec::new();
        if !sign.is_nonpositive() {
            all.push(true);
        }
        if !sign.is_nonnegative() {
            all.push(false);
        }
        all
    }

    /// The form of a node that contains e.
    fn known(&self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Option<KnownForm> {
        let safe = |form| Some(KnownForm { form, fails: false });
        match dag.kind(node).clone() {
            Kind::Call(op @ (Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh), x) => {
                let n = self.multiple(dag, x[0])?;
                let half = Rational::new(1, 2);
                let scaled = |k: Rational, n| Form {
                    monomial: Product::constant(k),
                    ..Form::exponential(n)
                };
                let terms = match op {
                    Op::Exp => vec![Form::exponential(n)],
                    Op::ExpM1 => vec![Form::exponential(n), Form::number(Rational::MINUS_ONE)],
                    Op::Sinh => vec![scaled(half.clone(), n), scaled(half.neg(), -n)],
                    _ => vec![scaled(half.clone(), n), scaled(half, -n)],
                };
                safe(Form::sum(&terms)?)
            }
            Kind::Call(Op::Tanh, x) => {
                let twice = dag.scale(&Rational::integer(2), x[0]);
                let n = self.multiple(dag, twice)?;
                let (e, one) = (Form::exponential(n), Form::number(Rational::ONE));
                let less = Form::number(Rational::MINUS_ONE);
                let (above, below) = (Form::sum(&[e.clone(), less])?, Form::sum(&[e, one])?);
                safe(above.times(&below.pow(-1)?)?)
            }
            Kind::Sum(c, terms) if terms.iter().any(|(_, n)| self.forms.contains_key(n)) => {
                let mut fails = false;
                let mut all = vec![Form::number(c)];
                for (k, term) in &terms {
                    let form = match self.forms.get(term) {
                        Some(known) => {
                            fails |= known.fails;
                            known.form.clone()
                        }
                        None => Form::atom(new[term]),
                    };
                    all.push(form.times(&Form::number(k.clone()))?);
                }
                let form = Form::sum(&all)?;
                for up in self.directions(dag) {
                    let own = all.iter().filter(|term| !term.is_zero());
                    let largest = own.map(|term| term.growth(up)).max();
                    fails |= form.is_zero() || largest > Some(form.growth(up));
                }
                Some(KnownForm { form, fails })
            }
            Kind::Product(k, factors)
                if factors.iter().any(|(n, _)| self.forms.contains_key(n)) =>
            {
                let mut fails = false;
                let mut form = Form::number(k);
                let mut growths = Vec::new();
                for &(factor, n) in &factors {
                    let power = match self.forms.get(&factor) {
                        Some(known) => {
                            fails |= known.fails;
                            growths
                                .push((known.form.growth(true) * n, known.form.growth(false) * n));
                            known.form.pow(n)?
                        }
                        None => Form::of(Product::power(new[&factor], n)),
                    };
                    form = form.times(&power)?;
                }
                for up in self.directions(dag) {
                    let growth = |both: &(i32, i32)| if up { both.0 } else { both.1 };
                    let grows = growths.iter().any(|both| growth(both) > 0);
                    fails |= grows && growths.iter().any(|both| growth(both) < 0);
                }
                Some(KnownForm { form, fails })
            }
            _ => None,
        }
    }

    /// min(w, −w), w as the smaller where both are 0.
    fn fall(&self, dag: &mut Dag) -> Node {
        let w = self.exponent;
        let minus = dag.neg(w);
        match (dag.is_nonnegative(w), dag.is_nonnegative(minus)) {
            (true, _) => minus,
            (_, true) => w,
            _ => dag.call(Op::Min, &[w, minus]),
        }
    }
    /// `up` where e > 1, `down` elsewhere.
    fn choose(&self, dag: &mut Dag, up: Node, down: Node) -> Node {
        match self.directions(dag).as_slice() {
            [true] => up,
            [false] => down,
            _ => {
                let zero = dag.integer(0);
                let grows = dag.less(zero, self.exponent);
                dag.select(grows, up, down)
            }
        }
    }
    /// exp(−n·|w|)
    fn powered(&self, dag: &mut Dag, n: i32) -> Node {
        let fall = self.fall(dag);
        let toward = if n < 0 { dag.neg(fall) } else { fall };
        let e = dag.call(Op::Exp, &[toward]);
        dag.powi(e, n.abs())
    }

    /// A form in E.
    fn emitted(&self, dag: &mut Dag, form: &Form) -> Node {
        if form.is_zero() {
            return dag.integer(0);
        }
        let mut factors = form.monomial.factors.clone();
        let (up, down) = (-form.growth(true), form.power);
        let same = match self.directions(dag).as_slice() {
            [true] => Some(up),
            [false] => Some(down),
            _ => (up == down).then_some(up),
        };
        if let Some(n) = same {
            let power = self.powered(dag, n);
            factors.push((power, 1));
        } else if up == -down {
            let toward = dag.scale(&Rational::integer(i64::from(down.signum())), self.exponent);
            let e = dag.call(Op::Exp, &[toward]);
            factors.push((e, down.abs()));
        } else {
            // What both have in common, with the same sign.
            let common = match (up < 0, down < 0) {
                (false, false) => up.min(down),
                (true, true) => up.max(down),
                _ => 0,
            };
            let shared = self.powered(dag, common);
            let (up, down) = (
                self.powered(dag, up - common),
                self.powered(dag, down - common),
            );
            let rest = self.choose(dag, up, down);
            factors.extend([(shared, 1), (rest, 1)]);
        }
        for (polynomial, n) in &form.factors {
            let value = match polynomial.is_one_less() {
                true => self.one_less(dag, *n),
                false => self.polynomial(dag, polynomial),
            };
            factors.push((value, *n));
        }
        dag.product(&form.monomial.coefficient, &factors)
    }

    /// 1 − e times e^-1 where that is above 1, of which the n-th power is made.
    fn one_less(&self, dag: &mut Dag, n: i32) -> Node {
        let fall = self.fall(dag);
        let less = dag.call(Op::ExpM1, &[fall]);
        let minus = dag.neg(less);
        match n % 2 {
            0 => less,
            _ => self.choose(dag, less, minus),
        }
    }

    /// A polynomial divided by its highest power of e where that is above 1.
    fn polynomial(&self, dag: &mut Dag, polynomial: &Polynomial) -> Node {
        let coefficients = coefficients(dag, polynomial);
        let fall = self.fall(dag);
        let e = dag.call(Op::Exp, &[fall]);
        let down = horner(dag, e, &coefficients);
        let reversed: Vec<Node> = coefficients.iter().rev().copied().collect();
        let up = match reversed == coefficients {
            true => down,
            false => horner(dag, e, &reversed),
        };
        self.choose(dag, up, down)
    }

    /// The logarithm of 1 + eⁿ and other sums of positive terms, whose argument may overflow or vanish.
    fn logarithm(&self, dag: &mut Dag, node: Node) -> Option<Node> {
        let &Kind::Call(op @ (Op::Ln | Op::Ln1p), ref x) = dag.kind(node) else {
            return None;
        };
        let known = self.forms.get(&x[0])?;
        let form = match op {
            Op::Ln => known.form.clone(),
            _ => Form::sum(&[known.form.clone(), Form::number(Rational::ONE)])?,
        };
        let changes = self
            .directions(dag)
            .into_iter()
            .any(|up| form.growth(up) != 0);
        let is_positive = |dag: &Dag, product: &Product| {
            let node = product.factors.iter();
            let signs = node.map(|(node, n)| (dag.sign(*node), *n));
            let sign = crate::dag::Sign::of_product(&product.coefficient, signs);
            sign.is_nonnegative() && !sign.may_be_zero()
        };
        let [(polynomial, 1)] = form.factors.as_slice() else {
            return None;
        };
        let terms = || polynomial.0.iter().map(|(_, product)| product);
        if !changes
            || !is_positive(dag, &form.monomial)
            || !terms().all(|product| is_positive(dag, product))
        {
            return None;
        }
        let one = dag.integer(1);
        let value = self.polynomial(dag, polynomial);
        let both = coefficients(dag, polynomial);
        let is_near_one = both.first() == Some(&one) && both.last() == Some(&one);
        let near = match is_near_one {
            true => {
                let less = dag.integer(-1);
                let rest = dag.add(&[value, less]);
                dag.call(Op::Ln1p, &[rest])
            }
            false => dag.call(Op::Ln, &[value]),
        };
        let times = |dag: &mut Dag, n: i32| {
            let k = Rational::integer(i64::from(n));
            dag.scale(&k, self.exponent)
        };
        let (up, down) = (times(dag, form.growth(true)), times(dag, form.power));
        let far = self.choose(dag, up, down);
        let content = form.monomial.node(dag);
        let content = dag.call(Op::Ln, &[content]);
        Some(dag.add(&[far, near, content]))
    }
}

/// The coefficients of e⁰, e¹, …
fn coefficients(dag: &mut Dag, polynomial: &Polynomial) -> Vec<Node> {
    let all = 0..=polynomial.degree();
    let coefficient = |power: i32| {
        let own = polynomial.0.iter().filter(|(n, _)| *n == power);
        let terms: Vec<(Rational, Node)> =
            own.map(|(_, product)| product.clone().split(dag)).collect();
        dag.linear(&Rational::ZERO, &terms)
    };
    all.map(coefficient).collect()
}

/// Σ coefficient·eⁿ
fn horner(dag: &mut Dag, e: Node, coefficients: &[Node]) -> Node {
    let mut value = dag.integer(0);
    let mut gap = 0;
    for &coefficient in coefficients.iter().rev() {
        if dag.is_zero(coefficient) {
            gap += 1;
            continue;
        }
        value = match dag.is_zero(value) {
            true => coefficient,
            false => {
                let product = dag.product(&Rational::ONE, &[(value, 1), (e, gap)]);
                dag.add(&[coefficient, product])
            }
        };
        gap = 1;
    }
    if gap > 1 {
        value = dag.product(&Rational::ONE, &[(value, 1), (e, gap - 1)]);
    }
    value
}
