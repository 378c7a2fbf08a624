//! Quotients of exponentials in forms that do not overflow.
//!
//! Input: roots, derivatives among them. Output: the same functions. A product of which one factor grows and another
//! vanishes, such as exp(x)/(1 + exp(x))² or exp(x)·exp(−x²), and a sum whose leading terms cancel as it grows, such as
//! 1 − tanh(x)², are written in exponentials that do not overflow before the whole does. Invariant: what cannot fail is
//! left as it is; a choice is made by 0 < x alone, so that derivatives over dual numbers are those of the branch taken.
//!
//! `form` multiplies out, `emit` writes the result. Different exponentials are independent variables there.

mod emit;
mod form;
mod removable;

use crate::dag::{Dag, Kind, Map, Node};
use crate::list::IntoList;
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;
use form::{Direction, Form};
use removable::series_near_zero;

/// The highest power of e that a function has.
const HIGHEST: i32 = 8;

/// The most exponentials whose directions are combined.
const FEW: usize = 4;

/// The size of arguments up to which nothing overflows, and no digits are lost by cancellation.
const SMALL: f64 = 2.0;

/// Rewrites the expressions the roots stand for.
pub(crate) fn saturate(dag: &mut Dag, roots: &mut [Node]) {
    rewrite(dag, roots, Exponentials::image);
}

/// What is rewritten before differentiation: w/(eʷ − 1) near 0, and powers of sums of exponentials.
pub(crate) fn before_derivatives(dag: &mut Dag, roots: &mut [Node]) {
    series_near_zero(dag, roots);
    powers_as_exponentials(dag, roots);
}

/// Writes roots and powers of positive sums that may overflow or vanish before the power does as exponentials of
/// logarithms, and 2^x as one where it stands in such a sum or in a divisor. The derivatives of these are quotients of the
/// sums.
fn powers_as_exponentials(dag: &mut Dag, roots: &mut [Node]) {
    let is_power = |kind: &Kind| matches!(kind, Kind::Call(Op::Sqrt | Op::Cbrt | Op::Pow, _));
    if dag.has(roots, &is_power) {
        let inner = powers_in_sums(dag, roots);
        if !inner.is_empty() {
            for root in roots.iter_mut() {
                *root = dag.substitute(*root, |dag, node| {
                    let is_inner = inner.contains(&node);
                    let (x, _) = exponential_argument(dag, node).filter(|_| is_inner)?;
                    Some(dag.call(Op::Exp, &[x]))
                });
            }
        }
        rewrite(dag, roots, Exponentials::power);
    }
}

/// The powers such as 2^x in divisors, and in sums of which a logarithm or a power is taken; and the same elsewhere.
fn powers_in_sums(dag: &Dag, roots: &[Node]) -> Vec<Node> {
    let order = dag.reachable(roots);
    let mut left: Vec<Node> = Vec::new();
    for &node in &order {
        match dag.kind(node) {
            Kind::Product(_, factors) => {
                left.extend(factors.iter().filter(|(_, n)| *n < 0).map(|(x, _)| *x));
            }
            Kind::Call(Op::Ln | Op::Ln1p | Op::Sqrt | Op::Cbrt | Op::Pow, x) => left.push(x[0]),
            _ => {}
        }
    }
    let (mut met, mut bases) = (Map::default(), Vec::new());
    while let Some(node) = left.pop() {
        if met.insert(node, ()).is_some() {
            continue;
        }
        match dag.kind(node) {
            Kind::Sum(..) | Kind::Product(..) => dag.for_children(node, |child| left.push(child)),
            Kind::Call(Op::Pow, x) => bases.push(x[0]),
            _ => {}
        }
    }
    let is_own =
        |node: &Node| matches!(dag.kind(*node), Kind::Call(Op::Pow, x) if bases.contains(&x[0]));
    order.into_iter().filter(is_own).into_list()
}

fn rewrite(
    dag: &mut Dag,
    roots: &mut [Node],
    image: fn(&Exponentials, &mut Dag, Node, &Map<Node, Node>) -> Option<Node>,
) {
    let mut exponentials = Exponentials {
        all: bases(dag, roots),
        forms: Map::default(),
    };
    if exponentials.all.is_empty() {
        return;
    }
    let order = dag.reachable(roots);
    let new = dag.map(order, |dag, node, new| {
        if let Some(known) = exponentials.known(dag, node, new) {
            exponentials.forms.insert(node, known);
        }
        match image(&exponentials, dag, node, new) {
            Some(image) => image,
            None => dag.rebuild(node, &|child| new[&child]),
        }
    });
    for root in roots {
        *root = new[root];
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
fn exponential_argument(dag: &mut Dag, node: Node) -> Option<(Node, i64)> {
    match *dag.kind(node) {
        Kind::Call(Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh, ref x) => Some((x[0], 1)),
        Kind::Call(Op::Tanh, ref x) => Some((x[0], 2)),
        Kind::Call(Op::Pow, ref x) => {
            let (base, power) = (x[0], x[1]);
            let sign = dag.sign(base);
            let is_exponential = dag.is_number(base) && !dag.is_number(power);
            if !is_exponential || !sign.is_nonnegative() || sign.may_be_zero() {
                return None;
            }
            let logarithm = dag.call(Op::Ln, &[base]);
            Some((dag.mul(&[power, logarithm]), 1))
        }
        _ => None,
    }
}

/// The nodes below the roots in the order of the source, which does not depend on their numbers.
fn in_source_order(dag: &Dag, roots: &[Node]) -> Vec<Node> {
    let (mut order, mut met) = (Vec::new(), Map::default());
    let mut left: Vec<Node> = roots.iter().rev().copied().into_list();
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

/// The different exponentials e = exp(unit·base), of which all others are whole powers, none of them high.
fn bases(dag: &mut Dag, roots: &[Node]) -> Vec<Exponential> {
    let may_be_one = |kind: &Kind| {
        matches!(
            kind,
            Kind::Call(
                Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh | Op::Tanh | Op::Pow,
                _
            )
        )
    };
    if !dag.has(roots, &may_be_one) {
        return Vec::new();
    }
    let mut found: Vec<(Node, Vec<Rational>)> = Vec::new();
    for node in in_source_order(dag, roots) {
        let Some((x, power)) = exponential_argument(dag, node) else {
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
    let mut all = Vec::new();
    for (base, multiples) in found {
        if let Some(unit) = unit(&multiples) {
            let exponent = dag.scale(&unit, base);
            let sign = dag.sign(exponent);
            let mut directions = Vec::new();
            if !sign.is_nonpositive() {
                directions.push(1);
            }
            if !sign.is_nonnegative() {
                directions.push(-1);
            }
            all.push(Exponential {
                base,
                unit,
                directions,
            });
        }
    }
    all
}

/// exp(unit·base)
struct Exponential {
    base: Node,
    unit: Rational,
    /// Where it can go: 1 for ∞, −1 for 0.
    directions: Vec<i32>,
}

/// An expression in exponentials.
#[derive(Clone, Debug)]
struct KnownForm {
    form: Form,
    /// The form to emit, if the evaluation of the expression as it stands may fail.
    instead: Option<Form>,
}

/// The exponentials with the forms of nodes that contain them.
struct Exponentials {
    all: Vec<Exponential>,
    forms: Map<Node, KnownForm>,
}

impl Exponentials {
    /// The node in a form that does not fail.
    fn image(&self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Option<Node> {
        let known = self.forms.get(&node);
        match known.and_then(|known| known.instead.as_ref()) {
            Some(form) => Some(self.emitted(dag, form, new)),
            None => self.logarithm(dag, node, new),
        }
    }

    /// A power of a positive sum as an exponential. Numbers are left: out of range, they are refused.
    fn power(&self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Option<Node> {
        let (sum, power) = match *dag.kind(node) {
            Kind::Call(Op::Sqrt, ref x) => (x[0], dag.constant(Rational::new(1, 2))),
            Kind::Call(Op::Cbrt, ref x) => (x[0], dag.constant(Rational::new(1, 3))),
            Kind::Call(Op::Pow, ref x) => (x[0], new[&x[1]]),
            _ => return None,
        };
        if dag.is_number(node) {
            return None;
        }
        let form = &self.forms.get(&sum)?.form;
        if !self.may_leave_range(dag, form) || !is_positive(dag, form) {
            return None;
        }
        let logarithm = dag.call(Op::Ln, &[new[&sum]]);
        let exponent = dag.mul(&[power, logarithm]);
        Some(dag.call(Op::Exp, &[exponent]))
    }

    /// Directions of exponentials: each alone, all together, and of a few all combinations.
    fn directions(&self, dag: &Dag, mut exponentials: Vec<usize>) -> Vec<Direction> {
        exponentials.sort_unstable();
        exponentials.dedup();
        let own = |at: usize| self.all[at].directions.iter().map(move |sign| (at, *sign));
        let mut all: Vec<Direction> = Vec::new();
        if exponentials.len() <= FEW {
            for &at in &exponentials {
                let before = all.len();
                for direction in own(at) {
                    for shorter in 0..before {
                        let mut longer = all[shorter].clone();
                        longer.push(direction);
                        all.push(longer);
                    }
                    all.push(vec![direction]);
                }
            }
            all.retain(|direction| self.is_possible(dag, direction, &exponentials));
            return all;
        }
        for sign in [1, -1] {
            let each = exponentials.iter().flat_map(|at| own(*at));
            let same: Direction = each.filter(|(_, other)| *other == sign).into_list();
            all.extend(same.iter().map(|direction| vec![*direction]));
            all.push(same);
        }
        all
    }

    /// Returns false if exp(exp(x)) were to grow where exp(x), which is among the exponentials, does not.
    fn is_possible(&self, dag: &Dag, direction: &Direction, exponentials: &[usize]) -> bool {
        direction.iter().all(|(at, _)| {
            let base = self.all[*at].base;
            match (dag.kind(base), self.forms.get(&base)) {
                (Kind::Call(Op::Exp, _), Some(KnownForm { form, .. })) => {
                    let mut inner = form.exponentials().into_iter();
                    let is_among = inner.all(|at| exponentials.contains(&at));
                    !is_among || form.growth(direction) > 0
                }
                _ => true,
            }
        })
    }

    /// Returns true if a form grows or vanishes somewhere.
    fn may_leave_range(&self, dag: &Dag, form: &Form) -> bool {
        let mut directions = self.directions(dag, form.exponentials()).into_iter();
        directions.any(|direction| form.growth(&direction) != 0)
    }

    /// exp(x) as a power of one of the exponentials.
    fn exponential(&self, dag: &mut Dag, x: Node) -> Option<(usize, i32)> {
        let (k, base) = argument(dag, x);
        let at = self.all.iter().position(|own| own.base == base)?;
        let (n, d) = k.mul(&self.all[at].unit.recip()?).to_small()?;
        // The unit of tanh is that of exp(2x).
        let n = (d == 1).then(|| i32::try_from(n).ok()).flatten()?;
        Some((at, n))
    }

    /// The form of a node that contains exponentials.
    fn known(&self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Option<KnownForm> {
        let safe = |form| {
            Some(KnownForm {
                form,
                instead: None,
            })
        };
        match dag.kind(node).clone() {
            Kind::Call(op @ (Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh | Op::Pow), _) => {
                let (x, _) = exponential_argument(dag, node)?;
                let (at, n) = self.exponential(dag, x)?;
                let half = Rational::new(1, 2);
                let scaled = |k: Rational, n| Form {
                    monomial: Product::constant(k),
                    ..Form::exponential(at, n)
                };
                let e = scaled(Rational::ONE, n);
                let terms = match op {
                    Op::Exp | Op::Pow => vec![e],
                    Op::ExpM1 => vec![e, Form::number(Rational::MINUS_ONE)],
                    Op::Sinh => vec![scaled(half.clone(), n), scaled(half.neg(), -n)],
                    _ => vec![scaled(half.clone(), n), scaled(half, -n)],
                };
                safe(Form::sum(&terms)?)
            }
            Kind::Call(Op::Tanh, x) => {
                let twice = dag.scale(&Rational::integer(2), x[0]);
                let (at, n) = self.exponential(dag, twice)?;
                let (e, one) = (Form::exponential(at, n), Form::number(Rational::ONE));
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
                            fails |= known.instead.is_some();
                            known.form.clone()
                        }
                        None => Form::atom(new[term]),
                    };
                    all.push(form.times(&Form::number(k.clone()))?);
                }
                let form = Form::sum(&all)?;
                let exponentials = all.iter().flat_map(Form::exponentials).into_list();
                for direction in self.directions(dag, exponentials) {
                    let own = all.iter().filter(|term| !term.is_zero());
                    let largest = own.map(|term| term.growth(&direction)).max();
                    fails |= form.is_zero() || largest > Some(form.growth(&direction));
                }
                let instead = fails.then(|| form.clone());
                Some(KnownForm { form, instead })
            }
            Kind::Product(k, factors)
                if factors.iter().any(|(n, _)| self.forms.contains_key(n)) =>
            {
                let mut form = Form::number(k.clone());
                let mut powers = Vec::new();
                for &(factor, n) in &factors {
                    let (power, fails) = match self.forms.get(&factor) {
                        Some(known) => (known.form.pow(n)?, known.instead.is_some()),
                        None => (Form::of(Product::power(new[&factor], n)), false),
                    };
                    form = form.times(&power)?;
                    powers.push((power, fails));
                }
                let taken = self.factors_that_fail(dag, &powers);
                let mut instead = None;
                if taken.contains(&true) {
                    let mut all = Form::number(k);
                    for (at, (power, _)) in powers.iter().enumerate() {
                        let (factor, n) = factors[at];
                        all = match taken[at] {
                            true => all.times(power)?,
                            false => all.times(&Form::of(Product::power(new[&factor], n)))?,
                        };
                    }
                    instead = Some(all);
                }
                Some(KnownForm { form, instead })
            }
            _ => None,
        }
    }

    /// The factors of a product that are written anew: those that fail, those that grow where others vanish, and
    /// others of the same exponentials.
    fn factors_that_fail(&self, dag: &Dag, factors: &[(Form, bool)]) -> Vec<bool> {
        let all = 0..factors.len();
        let mut taken: Vec<bool> = factors.iter().map(|(_, fails)| *fails).into_list();
        let exponentials = factors.iter().flat_map(|(form, _)| form.exponentials());
        for direction in self.directions(dag, exponentials.into_list()) {
            let growths = factors.iter().map(|(form, _)| form.growth(&direction));
            let growths: Vec<i32> = growths.into_list();
            if growths.iter().any(|n| *n > 0) && growths.iter().any(|n| *n < 0) {
                for at in all.clone().filter(|at| growths[*at] != 0) {
                    taken[at] = true;
                }
            }
        }
        if !taken.contains(&true) {
            return taken;
        }
        loop {
            let own = all.clone().filter(|at| taken[*at]);
            let own: Vec<usize> = own.flat_map(|at| factors[at].0.exponentials()).into_list();
            let shares = |at: &usize| {
                let mut exponentials = factors[*at].0.exponentials().into_iter();
                !taken[*at] && exponentials.any(|own_one| own.contains(&own_one))
            };
            match all.clone().find(shares) {
                Some(at) => taken[at] = true,
                None => return taken,
            }
        }
    }
}

/// Returns true if a form is a product of sums of positive terms.
fn is_positive(dag: &Dag, form: &Form) -> bool {
    let is_positive = |product: &Product| {
        let factors = product.factors.iter();
        let signs = factors.map(|(node, n)| (dag.sign(*node), *n));
        let sign = crate::dag::Sign::of_product(&product.coefficient, signs);
        sign.is_nonnegative() && !sign.may_be_zero()
    };
    let mut terms = form
        .factors
        .iter()
        .flat_map(|(polynomial, _)| &polynomial.0);
    is_positive(&form.monomial) && terms.all(|(_, product)| is_positive(product))
}
