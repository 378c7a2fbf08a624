//! Forms as expressions that do not overflow before they do as a whole.
//!
//! Input: [`Form`]s. Output: nodes. A polynomial in one e is e^−d·(c₀·E^d + … + c_d) with E = exp(−|ln e|) ≤ 1 for e > 1,
//! otherwise c₀ + … + c_d·E^d: the powers of e before these are added up and cancel. Of any other polynomial the largest
//! exponential stands in front, exp(m)·Σ c·exp(aᵢ − m). Invariant: the exponents in front of the parts that grow and of
//! those that vanish are added up before the exponential is taken.

use super::form::{Form, Polynomial, Powers};
use super::{Exponentials, is_positive};
use crate::dag::{Dag, Kind, Map, Node};
use crate::list::IntoList;
use crate::op::Op;
use crate::product::Factors;
use crate::rational::Rational;

/// One exponential e, or a product of several, of which all else consists.
struct Axis {
    powers: Powers,
    /// ln e
    exponent: Node,
    /// Where e can go: 1 for ∞, −1 for 0.
    directions: Vec<i32>,
}

impl Axis {
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
        match self.directions.as_slice() {
            [1] => up,
            [-1] => down,
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

    /// The factors of a form in e alone.
    fn factors(&self, dag: &mut Dag, form: &Form) -> Factors {
        let mut factors = Factors::new();
        let down = form.power.steps(&self.powers).unwrap_or(0);
        let degrees = form.factors.iter();
        let degrees = degrees.map(|(polynomial, n)| polynomial.degree(&self.powers) * n);
        let up = -(down + degrees.sum::<i32>());
        let same = match self.directions.as_slice() {
            [1] => Some(up),
            [-1] => Some(down),
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
            let value = self.reduced(dag, polynomial, *n);
            factors.push((value, *n));
        }
        factors
    }

    /// A polynomial divided by its highest power of e where that is above 1, up to a sign its even powers do not have.
    fn reduced(&self, dag: &mut Dag, polynomial: &Polynomial, n: i32) -> Node {
        let fall = self.fall(dag);
        if polynomial.is_one_less(&self.powers) {
            let less = dag.call(Op::ExpM1, &[fall]);
            let minus = dag.neg(less);
            return match n % 2 {
                0 => less,
                _ => self.choose(dag, less, minus),
            };
        }
        let [up, down] = self.branches(dag, polynomial).map(|(value, _)| value);
        self.choose(dag, up, down)
    }

    /// A polynomial divided by its highest power of e, in 1/e, and as it is; with the coefficients of what is largest.
    fn branches(&self, dag: &mut Dag, polynomial: &Polynomial) -> [(Node, Node); 2] {
        let fall = self.fall(dag);
        let e = dag.call(Op::Exp, &[fall]);
        let mut coefficients = self.coefficients(dag, polynomial);
        let down = (horner(dag, e, &coefficients), coefficients[0]);
        coefficients.reverse();
        [(horner(dag, e, &coefficients), coefficients[0]), down]
    }

    /// The logarithm of a polynomial with positive coefficients, divided as above.
    fn logarithm(&self, dag: &mut Dag, polynomial: &Polynomial) -> Node {
        let branches = self.branches(dag, polynomial);
        let [up, down] = branches.map(|(value, largest)| match dag.is_one(largest) {
            true => {
                let less = dag.integer(-1);
                let rest = dag.add(&[value, less]);
                dag.call(Op::Ln1p, &[rest])
            }
            false => dag.call(Op::Ln, &[value]),
        });
        self.choose(dag, up, down)
    }

    /// The coefficients of e⁰, e¹, …
    fn coefficients(&self, dag: &mut Dag, polynomial: &Polynomial) -> Vec<Node> {
        let all = 0..=polynomial.degree(&self.powers);
        let coefficient = |n: i32| {
            let own = polynomial.0.iter();
            let own = own.filter(|(power, _)| power.steps(&self.powers) == Some(n));
            let terms: Vec<(Rational, Node)> = own
                .map(|(_, product)| product.clone().split(dag))
                .into_list();
            dag.linear(&Rational::ZERO, &terms)
        };
        all.map(coefficient).into_list()
    }
}

/// A sum of exponents, of which sums are taken apart so that what is in two of them cancels.
#[derive(Default)]
struct Exponent {
    constant: Option<Rational>,
    terms: Vec<(Rational, Node)>,
}

impl Exponent {
    fn add(&mut self, dag: &mut Dag, k: &Rational, node: Node) {
        match dag.kind(node).clone() {
            Kind::Sum(c, terms) => {
                let own = self.constant.take().unwrap_or(Rational::ZERO);
                self.constant = Some(own.add(&c.mul(k)));
                let terms = terms.into_iter().map(|(n, node)| (n.mul(k), node));
                self.terms.extend(terms);
            }
            _ => self.terms.push((k.clone(), node)),
        }
    }
    fn node(self, dag: &mut Dag) -> Node {
        let constant = self.constant.unwrap_or(Rational::ZERO);
        dag.linear(&constant, &self.terms)
    }
}

impl Exponentials {
    /// The logarithm of a product of the exponentials.
    fn exponent(&self, dag: &mut Dag, powers: &Powers, new: &Map<Node, Node>) -> Node {
        let mut sum = Exponent::default();
        let is_alone = powers.all().count() == 1;
        for (at, n) in powers.all() {
            let own = &self.all[at];
            let image = |node: Node| new.get(&node).copied();
            let image = match image(own.base) {
                Some(image) => image,
                None => dag.rebuild(own.base, &|child| image(child).unwrap_or(child)),
            };
            let k = own.unit.mul(&Rational::integer(i64::from(n)));
            if is_alone {
                return dag.scale(&k, image);
            }
            sum.add(dag, &k, image);
        }
        sum.node(dag)
    }

    fn axis(&self, dag: &mut Dag, powers: Powers, new: &Map<Node, Node>) -> Axis {
        let exponent = self.exponent(dag, &powers, new);
        let directions = match powers.all().into_list().as_slice() {
            [(at, 1)] => self.all[*at].directions.clone(),
            _ => vec![1, -1],
        };
        Axis {
            powers,
            exponent,
            directions,
        }
    }

    /// A form.
    pub(super) fn emitted(&self, dag: &mut Dag, form: &Form, new: &Map<Node, Node>) -> Node {
        if form.is_zero() {
            return dag.integer(0);
        }
        let parts = parts(form);
        let changes = |dag: &Dag, part: &Form, sign: i32| {
            let mut directions = self.directions(dag, part.exponentials()).into_iter();
            directions.any(|direction| part.growth(&direction).signum() == sign)
        };
        let places = |dag: &Dag, sign: i32| -> Vec<usize> {
            let all = parts.iter().enumerate();
            let own = all.filter(|(_, part)| changes(dag, part, sign));
            own.map(|(at, _)| at).into_list()
        };
        let (grows, vanishes) = (places(dag, 1), places(dag, -1));
        let clashes = grows
            .iter()
            .any(|at| vanishes.iter().any(|other| other != at));
        let mut factors = form.monomial.factors.clone();
        let mut others = Factors::new();
        let mut exponent = Exponent::default();
        for (at, part) in parts.iter().enumerate() {
            let is_added = clashes && (grows.contains(&at) || vanishes.contains(&at));
            match axis_of(part).filter(|_| !is_added) {
                Some(axis) => {
                    let axis = self.axis(dag, axis, new);
                    factors.extend(axis.factors(dag, part));
                }
                None => {
                    let power = self.exponent(dag, &part.power, new);
                    exponent.add(dag, &Rational::ONE, power);
                    for (polynomial, n) in &part.factors {
                        let (value, far) = self.scaled(dag, polynomial, *n, new);
                        others.push((value, *n));
                        exponent.add(dag, &Rational::integer(i64::from(*n)), far);
                    }
                }
            }
        }
        if !exponent.terms.is_empty() {
            let exponent = exponent.node(dag);
            factors.push((dag.call(Op::Exp, &[exponent]), 1));
        }
        factors.extend(others);
        dag.product(&form.monomial.coefficient, &factors)
    }

    /// A polynomial divided by its largest exponential, and the logarithm of that.
    fn scaled(
        &self,
        dag: &mut Dag,
        polynomial: &Polynomial,
        n: i32,
        new: &Map<Node, Node>,
    ) -> (Node, Node) {
        let zero = dag.integer(0);
        if let Some(axis) = polynomial.axis() {
            let axis = self.axis(dag, axis, new);
            let degree = Rational::integer(i64::from(polynomial.degree(&axis.powers)));
            let up = dag.scale(&degree, axis.exponent);
            let value = axis.reduced(dag, polynomial, n);
            return (value, axis.choose(dag, up, zero));
        }
        let mut exponents: Vec<Node> = Vec::new();
        for (powers, _) in &polynomial.0 {
            exponents.push(self.exponent(dag, powers, new));
        }
        let mut largest = zero;
        for exponent in &exponents {
            largest = dag.call(Op::Max, &[largest, *exponent]);
        }
        let mut terms = Vec::new();
        for ((_, product), own) in polynomial.0.iter().zip(exponents) {
            let mut exponent = Exponent::default();
            exponent.add(dag, &Rational::ONE, own);
            exponent.add(dag, &Rational::MINUS_ONE, largest);
            let exponent = exponent.node(dag);
            let mut product = product.clone();
            product.multiply(dag.call(Op::Exp, &[exponent]), 1);
            terms.push(product.split(dag));
        }
        (dag.linear(&Rational::ZERO, &terms), largest)
    }

    /// The logarithm of a form that may overflow or vanish.
    pub(super) fn logarithm(
        &self,
        dag: &mut Dag,
        node: Node,
        new: &Map<Node, Node>,
    ) -> Option<Node> {
        let &Kind::Call(op @ (Op::Ln | Op::Ln1p), ref x) = dag.kind(node) else {
            return None;
        };
        let known = self.forms.get(&x[0])?;
        let form = match op {
            Op::Ln => known.form.clone(),
            _ => Form::sum(&[known.form.clone(), Form::number(Rational::ONE)])?,
        };
        if !self.may_leave_range(dag, &form) {
            return None;
        }
        if let [(polynomial, 1)] = form.factors.as_slice()
            && let Some(axis) = polynomial.axis()
            && is_positive(dag, &form)
        {
            let axis = self.axis(dag, axis, new);
            let power = form
                .power
                .times(&axis.powers, polynomial.degree(&axis.powers))?;
            let up = self.exponent(dag, &power, new);
            let down = self.exponent(dag, &form.power, new);
            let far = axis.choose(dag, up, down);
            let near = axis.logarithm(dag, polynomial);
            let content = form.monomial.node(dag);
            let content = dag.call(Op::Ln, &[content]);
            return Some(dag.add(&[far, near, content]));
        }
        let mut exponent = Exponent::default();
        let power = self.exponent(dag, &form.power, new);
        exponent.add(dag, &Rational::ONE, power);
        let mut factors = form.monomial.factors.clone();
        for (polynomial, n) in &form.factors {
            let (value, far) = self.scaled(dag, polynomial, *n, new);
            factors.push((value, *n));
            exponent.add(dag, &Rational::integer(i64::from(*n)), far);
        }
        let near = dag.product(&form.monomial.coefficient, &factors);
        let near = dag.call(Op::Ln, &[near]);
        let far = exponent.node(dag);
        Some(dag.add(&[far, near]))
    }
}

/// The factors of a form without its monomial, apart if they have no exponential in common.
fn parts(form: &Form) -> Vec<Form> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let of = |(polynomial, n): &(Polynomial, i32)| Form {
        factors: vec![(polynomial.clone(), *n)],
        ..Form::number(Rational::ONE)
    };
    let connected = form.factors.iter().map(|factor| of(factor).exponentials());
    let alone = form.power.all().map(|(at, _)| vec![at]);
    for mut own in connected.chain(alone).filter(|own| !own.is_empty()) {
        groups.retain(|group| {
            let meets = group.iter().any(|at| own.contains(at));
            if meets {
                own.extend(group);
            }
            !meets
        });
        own.sort_unstable();
        own.dedup();
        groups.push(own);
    }
    groups.sort();
    if groups.is_empty() {
        groups.push(Vec::new());
    }
    let part = |(number, group): (usize, Vec<usize>)| {
        let mut part = Form::number(Rational::ONE);
        part.power = form.power.among(&group);
        let own = form.factors.iter().filter(|factor| {
            // Sums without an exponential are with the first.
            match of(factor).exponentials().first() {
                Some(at) => group.contains(at),
                None => number == 0,
            }
        });
        part.factors = own.cloned().into_list();
        part
    };
    groups.into_iter().enumerate().map(part).into_list()
}

/// The e of which a form consists.
fn axis_of(form: &Form) -> Option<Powers> {
    let axis = match form.exponentials().as_slice() {
        [] => return None,
        [at] => Powers::of(*at, 1),
        _ => form.factors.first()?.0.axis()?,
    };
    let powers = form.factors.iter().flat_map(|(p, _)| &p.0);
    let mut powers = powers.map(|(power, _)| power).chain([&form.power]);
    powers
        .all(|power| power.steps(&axis).is_some())
        .then_some(axis)
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
