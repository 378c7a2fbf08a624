//! Taking common factors out of sums, and putting coefficients where they cost nothing.
//!
//! Input: roots in canonical form. Output: the same functions with fewer multiplications.
//! Invariant: a term used elsewhere too is left whole, so that factoring never undoes sharing;
//! sums are regrouped by common factors only, which cannot introduce cancellation.

use crate::algebra::factors::{self, Factors};
use crate::dag::{Dag, Kind, Map, Node, Numbers, Stage};
use crate::index::Domain;
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

/// A term `k·p·Π f`, p prepared, the rest not.
#[derive(Clone, Debug)]
struct Summand {
    k: Rational,
    p: Node,
    factors: Factors,
}

impl Summand {
    fn has_coefficient(&self, one: Node) -> bool {
        self.p != one || !self.k.is_unit()
    }
    fn multiplications(&self, one: Node) -> i64 {
        let factors: i64 = self.factors.iter().map(|(_, n)| i64::from(n.abs())).sum();
        if factors == 0 {
            0
        } else {
            factors - 1 + i64::from(self.has_coefficient(one))
        }
    }
    /// The power of a base, if it has that sign.
    fn power(&self, base: Node, sign: i32) -> Option<i32> {
        let power = factors::power(&self.factors, &base);
        (power.signum() == sign).then_some(power)
    }
    fn without(&self, base: Node, power: i32) -> Summand {
        let mut rest = self.clone();
        factors::multiply(&mut rest.factors, base, -power);
        rest.factors.retain(|(_, n)| *n != 0);
        rest
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
                .collect();
            factored_sum(dag, &c, &terms, &Rational::ONE, None)
        }
        Kind::Product(..) if dag.is_sealed(node) => dag.rebuild(node, &|child| new[&child]),
        Kind::Product(k, factors) => match gathered(dag, &k, &factors, &uses) {
            Some((domain, body, negative)) => {
                // Its factors are these, so they are rewritten already.
                if let Kind::Product(k, factors) = dag.kind(body).clone() {
                    let image = factored_product(dag, k, factors, &uses, new);
                    new.insert(body, image);
                }
                let sum = dag.intern(Kind::Reduce(domain, new[&body]));
                if negative { dag.neg(sum) } else { sum }
            }
            None => factored_product(dag, k, factors, &uses, new),
        },
        _ => dag.rebuild(node, &|child| new[&child]),
    });
    for root in roots {
        *root = new[root];
    }
}

/// A product with a sum over a loop whose body, with the other factors in it, is computed inside
/// that loop anyway (up to sign): the same force on both bodies of a pair.
fn gathered(
    dag: &Dag,
    k: &Rational,
    factors: &[(Node, i32)],
    uses: &Numbers,
) -> Option<(Domain, Node, bool)> {
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
        let mut all: Factors = others().copied().collect();
        match dag.kind(body) {
            Kind::Product(c, inner) if c.is_one() => all.extend(inner),
            _ => all.push((body, 1)),
        }
        all.arrange();
        if all.windows(2).any(|pair| pair[0].0 == pair[1].0) {
            return None;
        }
        [false, true].into_iter().find_map(|negative| {
            let k = if negative { k.neg() } else { k.clone() };
            let known = dag.known(&Kind::Product(k, all.clone()))?;
            uses.has(known).then_some((domain, known, negative))
        })
    })
}

fn factored_product(
    dag: &mut Dag,
    k: Rational,
    factors: Factors,
    uses: &Numbers,
    new: &Map<Node, Node>,
) -> Node {
    let place = absorbing_sum(dag, &k, &factors, uses);
    let Some((at, Kind::Sum(c, terms))) = place.map(|at| (at, dag.kind(factors[at].0).clone()))
    else {
        let factors: Vec<_> = factors.into_iter().map(|(n, e)| (new[&n], e)).collect();
        return dag.product(&k, &factors);
    };
    let (prepared, others): (Vec<_>, Vec<_>) = factors
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != at)
        .map(|(_, f)| (new[&f.0], f.1))
        .partition(|(n, _)| is_prepared(dag, *n));
    let p = dag.product(&Rational::ONE, &prepared);
    let terms: Vec<_> = terms
        .into_iter()
        .map(|(k, n)| (k, new[&n], uses.get(n) == Some(1)))
        .collect();
    // The sign stays outside, where it becomes a subtraction.
    let sum = factored_sum(dag, &c, &terms, &k.abs(), Some(p));
    let mut all = vec![(sum, 1)];
    all.extend(others);
    dag.product(&k.sign(), &all)
}

/// The factor of a product into which the product's coefficient can be multiplied for free: a
/// sum used only here, all of whose terms but at most one have a coefficient already.
fn absorbing_sum(
    dag: &Dag,
    k: &Rational,
    factors: &[(Node, i32)],
    uses: &Numbers,
) -> Option<usize> {
    let has_prepared = factors.iter().any(|(n, _)| is_prepared(dag, *n));
    if !has_prepared && k.is_unit() {
        return None;
    }
    factors.iter().position(|&(node, n)| {
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
        let mut term = Summand {
            k: k.mul(scale),
            p,
            factors: Vec::new(),
        };
        match dag.kind(*node) {
            Kind::Product(k, factors) if *alone => {
                let (k, factors) = (k.clone(), factors.clone());
                term.k = term.k.mul(&k);
                let (prepared, rest): (Vec<_>, Vec<_>) =
                    factors.into_iter().partition(|(n, _)| is_prepared(dag, *n));
                if !prepared.is_empty() {
                    let prepared = dag.product(&Rational::ONE, &prepared);
                    term.p = dag.mul(&[p, prepared]);
                }
                term.factors = rest;
            }
            _ if is_prepared(dag, *node) => term.p = dag.mul(&[p, *node]),
            _ => term.factors.push((*node, 1)),
        }
        list.push(term);
    }
    let constant = c.mul(scale);
    if p == one {
        collect(dag, &constant, list, one)
    } else {
        if !constant.is_zero() {
            list.push(Summand {
                k: constant,
                p,
                factors: Vec::new(),
            });
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
                    && term.k.abs() == *k
                    && !term.factors.is_empty())
                .then(|| Summand {
                    k: term.k.sign(),
                    p: one,
                    factors: term.factors.clone(),
                }),
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
        let (k, mut factors) = match dag.kind(sum).clone() {
            Kind::Product(k, factors) => (k, factors),
            _ => (Rational::ONE, vec![(sum, 1)]),
        };
        let mut term = Summand {
            k,
            p: one,
            factors: Vec::new(),
        };
        match common {
            Common::Factor(base, power) => match factors.iter_mut().find(|(n, _)| *n == base) {
                Some(entry) => entry.1 += power,
                None => factors.insert(0, (base, power)),
            },
            Common::Coefficient(k, p) => {
                term.k = term.k.mul(&k);
                term.p = p;
            }
        }
        factors.retain(|(_, n)| *n != 0);
        let (prepared, others): (Vec<_>, Vec<_>) =
            factors.into_iter().partition(|(n, _)| is_prepared(dag, *n));
        if !prepared.is_empty() {
            let prepared = dag.product(&Rational::ONE, &prepared);
            term.p = dag.mul(&[term.p, prepared]);
        }
        term.factors = others;
        rest.insert(place.unwrap_or(0).min(rest.len()), term);
        terms = rest;
    }
    let nodes: Vec<_> = terms
        .into_iter()
        .map(|term| {
            let mut factors = vec![(term.p, 1)];
            factors.extend(term.factors);
            let node = dag.product(&Rational::ONE, &factors);
            (term.k, node)
        })
        .collect();
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
        for &(base, n) in &term.factors {
            let rest = term.without(base, n.signum()).multiplications(one);
            save(Common::Factor(base, n.signum()), cost - rest);
        }
        if term.has_coefficient(one) && !term.factors.is_empty() {
            save(Common::Coefficient(term.k.abs(), term.p), 1);
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
