//! Taking common factors out of sums, and putting coefficients where they cost nothing.
//!
//! Input: roots in canonical form. Output: the same functions with fewer multiplications.
//! Invariant: a term used elsewhere too is left whole, so that factoring never undoes sharing;
//! sums are regrouped by common factors only, which cannot introduce cancellation.

use crate::dag::{Dag, Kind, Map, Node, Numbers, Stage};
use crate::index::Domain;
use crate::list::IntoList;
use crate::product::{Factors, Product};
use crate::rational::Rational;
use crate::sort::Arrange;

/// The number of uses of each node, by parents or as a root.
pub(crate) fn count_uses(dag: &Dag, roots: &[Node], order: &[Node]) -> Numbers {
    let mut uses = Numbers::new(dag);
    let mut count = |node| uses.set(node, uses.get(node).unwrap_or(0) + 1);
    roots.iter().for_each(|root| count(*root));
    for &node in order {
        dag.for_children(node, &mut count);
    }
    uses
}

/// Returns true if a node is computed before any evaluation, outside loops: its multiplication into a
/// coefficient is free.
pub(crate) fn is_prepared(dag: &Dag, node: Node) -> bool {
    is_known(dag, node, Stage::Evaluation)
}

/// Returns true if a node is computed before a stage, outside loops.
pub(crate) fn is_known(dag: &Dag, node: Node, now: Stage) -> bool {
    dag.stage(node) < now && dag.variables(node).is_empty()
}

/// The longest sum into whose terms a coefficient is multiplied: it spares one multiplication and
/// takes a prepared value for every term.
const ABSORBING: usize = 16;

/// A term `p·rest`: p prepared, none of the other factors.
#[derive(Clone, Debug)]
struct Summand {
    p: Node,
    rest: Product,
}

impl Summand {
    /// The term `p·product`.
    fn new(dag: &mut Dag, p: Node, product: Product) -> Summand {
        let factors = product.factors.into_iter();
        let (prepared, rest): (Vec<_>, Vec<_>) = factors.partition(|(n, _)| is_prepared(dag, *n));
        let rest = Product::new(product.coefficient, rest);
        if prepared.is_empty() {
            return Summand { p, rest };
        }
        let prepared = dag.product(&Rational::ONE, &prepared);
        let p = dag.mul(&[p, prepared]);
        Summand { p, rest }
    }
    fn has_coefficient(&self, one: Node) -> bool {
        self.p != one || !self.rest.coefficient.is_unit()
    }
    fn multiplications(&self, one: Node) -> i64 {
        let factors = self.rest.factors.iter();
        let factors: i64 = factors.map(|(_, n)| i64::from(n.abs())).sum();
        if factors == 0 {
            0
        } else {
            factors - 1 + i64::from(self.has_coefficient(one))
        }
    }
    /// The power of a base, if it has that sign.
    fn power(&self, base: Node, sign: i32) -> Option<i32> {
        let power = self.rest.exponent(base);
        (power.signum() == sign).then_some(power)
    }
    fn without(&self, base: Node, power: i32) -> Summand {
        let mut rest = self.rest.clone();
        rest.multiply(base, -power);
        let rest = rest.simplified();
        Summand { p: self.p, rest }
    }
    /// The term with ±1 for its coefficient.
    fn without_coefficient(&self, one: Node) -> Summand {
        let mut rest = self.rest.clone();
        rest.coefficient = rest.coefficient.sign();
        Summand { p: one, rest }
    }
}

/// Rewrites the expressions the roots stand for.
pub fn factor(dag: &mut Dag, roots: &mut [Node]) {
    let order = dag.reachable(roots);
    let uses = count_uses(dag, roots, &order);
    let new = dag.map(order, |dag, node, new| match dag.kind(node).clone() {
        Kind::Sum(c, terms) => {
            let terms: Vec<_> = terms
                .into_iter()
                .map(|(k, n)| (k, new[&n], uses.get(n) == Some(1)))
                .into_list();
            factored_sum(dag, &c, &terms, &Rational::ONE, None)
        }
        Kind::Product(..) if dag.is_sealed(node) => dag.rebuild(node, &|child| new[&child]),
        Kind::Product(..) => match gathered(dag, &Product::of(dag, node), &uses) {
            Some((domain, body, negative)) => {
                // Its factors are these, so they are rewritten already.
                let image = factored_product(dag, body, &uses, new);
                new.insert(body, image);
                let sum = dag.intern(Kind::Reduce(domain, image));
                if negative { dag.neg(sum) } else { sum }
            }
            None => factored_product(dag, node, &uses, new),
        },
        _ => dag.rebuild(node, &|child| new[&child]),
    });
    for root in roots {
        *root = new[root];
    }
}

/// A product with a sum over a loop whose body, with the other factors in it, is computed inside
/// that loop anyway (up to sign): the same force on both bodies of a pair.
fn gathered(dag: &Dag, product: &Product, uses: &Numbers) -> Option<(Domain, Node, bool)> {
    let factors = &product.factors;
    factors.iter().find_map(|&(sum, n)| {
        let Kind::Reduce(domain, body) = *dag.kind(sum) else {
            return None;
        };
        let others = || factors.iter().filter(|(node, _)| *node != sum);
        if n != 1
            || uses.get(sum) != Some(1)
            || others().any(|(f, _)| dag.variables(*f).has(domain))
        {
            return None;
        }
        let mut all: Factors = others().copied().into_list();
        match dag.kind(body) {
            Kind::Product(c, inner) if c.is_one() => all.extend(inner),
            _ => all.push((body, 1)),
        }
        all.arrange();
        if all.windows(2).any(|pair| pair[0].0 == pair[1].0) {
            return None;
        }
        [false, true].into_iter().find_map(|negative| {
            let k = &product.coefficient;
            let k = if negative { k.neg() } else { k.clone() };
            let known = dag.known(&Kind::Product(k, all.clone()))?;
            uses.has(known).then_some((domain, known, negative))
        })
    })
}

fn factored_product(dag: &mut Dag, node: Node, uses: &Numbers, new: &Map<Node, Node>) -> Node {
    let product = Product::of(dag, node);
    let place = absorbing_sum(dag, &product, uses);
    let (k, factors) = (&product.coefficient, &product.factors);
    let Some((at, Kind::Sum(c, terms))) = place.map(|at| (at, dag.kind(factors[at].0).clone()))
    else {
        let factors = factors.iter().map(|(n, e)| (new[n], *e)).into_list();
        return dag.product(k, &factors);
    };
    let (prepared, mut others): (Vec<_>, Vec<_>) = factors
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != at)
        .map(|(_, f)| (new[&f.0], f.1))
        .partition(|(n, _)| is_prepared(dag, *n));
    let p = dag.product(&Rational::ONE, &prepared);
    let terms: Vec<_> = terms
        .into_iter()
        .map(|(k, n)| (k, new[&n], uses.get(n) == Some(1)))
        .into_list();
    // The sign stays outside, where it becomes a subtraction.
    let sum = factored_sum(dag, &c, &terms, &k.abs(), Some(p));
    others.insert(0, (sum, 1));
    dag.product(&k.sign(), &others)
}

/// The factor of a product into which the product's coefficient can be multiplied for free: a
/// sum used only here, all of whose terms but at most one have a coefficient already.
fn absorbing_sum(dag: &Dag, product: &Product, uses: &Numbers) -> Option<usize> {
    let mut factors = product.factors.iter();
    let has_prepared = factors.any(|(n, _)| is_prepared(dag, *n));
    if !has_prepared && product.coefficient.is_unit() {
        return None;
    }
    product.factors.iter().position(|&(node, n)| {
        let Kind::Sum(c, terms) = dag.kind(node) else {
            return false;
        };
        if n != 1 || uses.get(node) != Some(1) || is_prepared(dag, node) || terms.len() > ABSORBING
        {
            return false;
        }
        let plain = terms
            .iter()
            .filter(|(k, n)| {
                let product = match dag.kind(*n) {
                    Kind::Product(_, inner) if uses.get(*n) == Some(1) => {
                        inner.iter().any(|(f, _)| is_prepared(dag, *f))
                    }
                    _ => is_prepared(dag, *n),
                };
                k.is_unit() && !product
            })
            .count();
        plain + usize::from(!c.is_zero()) <= 1
    })
}

/// `scale·p·(c + Σ k·node)` with common factors taken out. `alone` says that a term is used here
/// only and may be taken apart.
fn factored_sum(
    dag: &mut Dag,
    c: &Rational,
    terms: &[(Rational, Node, bool)],
    scale: &Rational,
    p: Option<Node>,
) -> Node {
    let one = dag.integer(1);
    let p = p.unwrap_or(one);
    let mut list: Vec<Summand> = Vec::with_capacity(terms.len() + 1);
    for (k, node, alone) in terms {
        let product = match alone {
            true => Product::of(dag, *node),
            false => Product::power(*node, 1),
        };
        list.push(Summand::new(dag, p, product.scaled(&k.mul(scale))));
    }
    let constant = c.mul(scale);
    if p == one {
        collect(dag, &constant, list, one)
    } else {
        if !constant.is_zero() {
            let rest = Product::constant(constant);
            list.push(Summand { p, rest });
        }
        collect(dag, &Rational::ZERO, list, one)
    }
}

/// A common part of some terms of a sum: a power of a node, or a coefficient up to its sign.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Common {
    Factor(Node, i32),
    Coefficient(Rational, Node),
}

/// Greedily takes out what saves the most multiplications, until nothing saves any.
fn collect(dag: &mut Dag, constant: &Rational, mut terms: Vec<Summand>, one: Node) -> Node {
    // Long sums are searched a few times only; their common parts are found early.
    let mut rounds = 4 + 4096 / terms.len().max(1);
    while terms.len() > 1 && rounds > 0 {
        rounds -= 1;
        let Some(common) = best(&terms, one) else {
            break;
        };
        let common = match common {
            // The highest power that all of them have.
            Common::Factor(base, sign) => {
                let powers = terms.iter().filter_map(|term| term.power(base, sign));
                let least = powers.min_by_key(|n| n.abs());
                Common::Factor(base, least.expect("terms have it in common"))
            }
            other => other,
        };
        let mut inner = Vec::new();
        let mut rest = Vec::new();
        let mut place = None;
        for term in terms {
            let quotient = match &common {
                Common::Factor(base, power) => term
                    .power(*base, power.signum())
                    .map(|_| term.without(*base, *power)),
                Common::Coefficient(k, p) => (term.p == *p
                    && term.rest.coefficient.abs() == *k
                    && !term.rest.factors.is_empty())
                .then(|| term.without_coefficient(one)),
            };
            match quotient {
                Some(quotient) => {
                    place.get_or_insert(rest.len());
                    inner.push(quotient);
                }
                None => rest.push(term),
            }
        }
        let sum = collect(dag, &Rational::ZERO, inner, one);
        let mut product = Product::of(dag, sum);
        let mut coefficient = one;
        match common {
            Common::Factor(base, power) => product.multiply_at(0, base, power),
            Common::Coefficient(k, p) => {
                product = product.scaled(&k);
                coefficient = p;
            }
        }
        let term = Summand::new(dag, coefficient, product.simplified());
        rest.insert(place.unwrap_or(0).min(rest.len()), term);
        terms = rest;
    }
    let nodes = terms.into_iter().map(|mut term| {
        term.rest.multiply_at(0, term.p, 1);
        term.rest.split(dag)
    });
    let nodes = nodes.into_list();
    dag.collected(constant, &nodes, false)
}

/// The common part that saves most multiplications if it is taken out, the first of several; `None`
/// where none saves any.
fn best(terms: &[Summand], one: Node) -> Option<Common> {
    let mut places: Map<Common, usize> = Map::default();
    let mut savings: Vec<(Common, i64)> = Vec::new();
    let mut save = |common: Common, saved: i64| {
        let at = *places.entry(common.clone()).or_insert(savings.len());
        match savings.get_mut(at) {
            Some(entry) => entry.1 += saved,
            // The common part is multiplied once.
            None => savings.push((common, saved - 1)),
        }
    };
    for term in terms {
        let cost = term.multiplications(one);
        for &(base, n) in &term.rest.factors {
            let rest = term.without(base, n.signum()).multiplications(one);
            save(Common::Factor(base, n.signum()), cost - rest);
        }
        if term.has_coefficient(one) && !term.rest.factors.is_empty() {
            save(Common::Coefficient(term.rest.coefficient.abs(), term.p), 1);
        }
    }
    let mut winner: Option<(Common, i64)> = None;
    for (common, saved) in savings {
        if saved > 0 && winner.as_ref().is_none_or(|(_, best)| saved > *best) {
            winner = Some((common, saved));
        }
    }
    winner.map(|(common, _)| common)
}
