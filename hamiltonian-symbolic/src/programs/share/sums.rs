//! Sums as they stand, and what several of them have in common.
//!
//! Input: sums of the arena. Output: sums with shared parts as terms. Invariant: the operands keep
//! their order; nothing cancels that did not.

use super::products::LONGEST;
use crate::dag::{Dag, Kind, Map, Node, Numbers, Stage};
use crate::list::IntoList;
use crate::product::Product;
use crate::programs::factor::is_known;
use crate::rational::Rational;
use crate::sort::Arrange;

/// `constant + Σ k·node`.
pub(super) type Terms = (Rational, Vec<(Rational, Node)>);

/// A sum that goes on from another one that is computed before: `a + b + c` from `a + b`. How
/// many terms it takes over, and the other sum.
pub(super) fn known_start(dag: &Dag, uses: &Numbers, sum: Node) -> Option<(usize, Node)> {
    let Kind::Sum(c, list) = dag.kind(sum) else {
        return None;
    };
    if list.len() > LONGEST {
        return None;
    }
    let least = if c.is_zero() { 2 } else { 1 };
    (least..list.len()).rev().find_map(|length| {
        let mut part = list[..length].to_vec();
        part.arrange_by_key(|(_, n)| *n);
        let known = dag.known(&Kind::Sum(c.clone(), part))?;
        let again = list[length..].iter().any(|(_, n)| *n == known);
        (known < sum && uses.has(known) && !again).then_some((length, known))
    })
}

/// A multiple of a term that is computed before the sum, up to sign.
pub(super) fn known_multiple(
    dag: &Dag,
    uses: &Numbers,
    sum: Node,
    (k, term): &(Rational, Node),
) -> Option<(Rational, Node)> {
    if k.is_unit() {
        return None;
    }
    let mut product = Product::of(dag, *term).scaled(k);
    product.factors.arrange();
    [Rational::ONE, Rational::MINUS_ONE]
        .into_iter()
        .find_map(|sign| {
            let scaled = product.clone().scaled(&sign);
            let known = dag.known(&Kind::Product(scaled.coefficient, scaled.factors))?;
            (known < sum && uses.has(known)).then_some((sign, known))
        })
}

/// A sum as it stands, negated products merged into signs.
pub(super) fn raw_sum(dag: &mut Dag, c: Rational, list: Vec<(Rational, Node)>) -> Node {
    let mut terms: Vec<(Rational, Node)> = Vec::with_capacity(list.len());
    let mut place: Map<Node, usize> = Map::default();
    for (mut k, mut node) in list {
        if let Kind::Product(sign, factors) = dag.kind(node)
            && *sign == Rational::MINUS_ONE
        {
            k = k.neg();
            node = if let [(single, 1)] = factors.as_slice() {
                *single
            } else {
                let factors = factors.clone();
                dag.intern(Kind::Product(Rational::ONE, factors))
            };
        }
        match place.get(&node) {
            Some(&at) => terms[at].0 = terms[at].0.add(&k),
            None => {
                place.insert(node, terms.len());
                terms.push((k, node));
            }
        }
    }
    terms.retain(|(k, _)| !k.is_zero());
    if let ([(k, node)], true) = (terms.as_slice(), c.is_zero()) {
        let (k, node) = (k.clone(), *node);
        return dag.scale(&k, node);
    }
    if terms.is_empty() {
        return dag.constant(c);
    }
    dag.intern(Kind::Sum(c, terms))
}

/// The prepared terms of a sum, its constant among them, as one prepared term where they first
/// stand.
pub(super) fn gathered(dag: &mut Dag, now: Stage, (c, terms): Terms) -> Terms {
    let prepared: Vec<_> = terms
        .iter()
        .filter(|(_, n)| is_known(dag, *n, now))
        .cloned()
        .into_list();
    let Some(place) = terms.iter().position(|(_, n)| is_known(dag, *n, now)) else {
        return (c, terms);
    };
    if prepared.len() == 1 && c.is_zero() && prepared[0].0.is_unit() {
        return (c, terms);
    }
    let sum = dag.linear(&c, &prepared);
    let mut rest: Vec<_> = terms
        .iter()
        .filter(|(_, n)| !is_known(dag, *n, now))
        .cloned()
        .into_list();
    rest.insert(place.min(rest.len()), (Rational::ONE, sum));
    (Rational::ZERO, rest)
}

/// For each sum, its terms that stand in a shared pair: the first of the two carries the pair
/// (its number and whether it is subtracted), the second carries nothing.
pub(super) type TermPairs = Map<Node, Map<Node, Option<(usize, bool)>>>;

/// Two terms added, the second subtracted if so marked.
#[derive(Clone, Copy, Debug)]
pub(super) struct TermPair {
    pub(super) first: Node,
    pub(super) second: Node,
    pub(super) opposite: bool,
}

/// Pairs of plain terms that several sums have in common, up to a common sign. One round: a pair
/// shared by two sums saves one addition.
pub(super) fn share_terms(
    order: &[Node],
    sums: &Map<Node, Vec<(Node, bool)>>,
) -> (Vec<TermPair>, TermPairs) {
    let mut holders: Map<(Node, Node, bool), Vec<Node>> = Map::default();
    let mut keys = Vec::new();
    for node in order {
        let Some(terms) = sums.get(node) else {
            continue;
        };
        if terms.len() < 2 || terms.len() > LONGEST {
            continue;
        }
        for (i, &(a, sa)) in terms.iter().enumerate() {
            for &(b, sb) in &terms[i + 1..] {
                let key = (a.min(b), a.max(b), sa != sb);
                let list = holders.entry(key).or_default();
                if list.is_empty() {
                    keys.push(key);
                }
                list.push(*node);
            }
        }
    }
    keys.retain(|key| holders[key].len() > 1);
    keys.arrange_by_key(|key| std::cmp::Reverse(holders[key].len()));
    let mut pairs: Vec<TermPair> = Vec::new();
    let mut result: TermPairs = Map::default();
    for key in keys {
        let (a, b, opposite) = key;
        let free: Vec<Node> = holders[&key]
            .iter()
            .copied()
            .filter(|sum| {
                result
                    .get(sum)
                    .is_none_or(|taken| !taken.contains_key(&a) && !taken.contains_key(&b))
            })
            .into_list();
        if free.len() < 2 {
            continue;
        }
        // The pair is written as it stands in the first sum, led by its positive term.
        let sign_of = |sum: &Node, node: Node| {
            sums[sum]
                .iter()
                .find(|(n, _)| *n == node)
                .is_some_and(|(_, s)| *s)
        };
        let a_first = !opposite || !sign_of(&free[0], a);
        let (first, second) = if a_first { (a, b) } else { (b, a) };
        pairs.push(TermPair {
            first,
            second,
            opposite,
        });
        for sum in free {
            let negative = sign_of(&sum, first);
            let taken = result.entry(sum).or_default();
            let leading = sums[&sum]
                .iter()
                .find(|(n, _)| *n == a || *n == b)
                .map_or(a, |(n, _)| *n);
            taken.insert(leading, Some((pairs.len() - 1, negative)));
            taken.insert(if leading == a { b } else { a }, None);
        }
    }
    (pairs, result)
}
