//! Products of sums multiplied out, without any other rule.
//!
//! Input: a node. Output: [`Product`]s that add up to it. Invariant: terms stand in order of first
//! appearance, factors in the order they were written in; like terms are one. A factor is a sum only
//! below a fraction line or inside a function.

use crate::dag::{Dag, Kind, Map, Node};
use crate::normal_form;
use crate::product::{Factors, Product, exponent_ranges};
use crate::sort::Arrange;
use std::rc::Rc;

/// The most terms an expansion may have.
pub(super) const MAX_TERMS: usize = 4096;

/// The terms of a node multiplied out; `None` where there are more than 4096 of them.
#[must_use]
pub fn expand(dag: &mut Dag, root: Node) -> Option<Vec<Product>> {
    expand_within(dag, root, MAX_TERMS)
}

/// The terms of a node multiplied out; `None` where it, or a part of it, has more of them.
pub(crate) fn expand_within(dag: &mut Dag, root: Node, most: usize) -> Option<Vec<Product>> {
    let mut expansions: Map<Node, Rc<Vec<Product>>> = Map::default();
    for node in spine(dag, root) {
        let kind = dag.kind(node).clone();
        let terms = match kind {
            Kind::Constant(value) if value.is_zero() => Vec::new(),
            Kind::Constant(value) => vec![Product::constant(value)],
            Kind::Sum(c, terms) => {
                let mut sum = Collected::default();
                for (k, child) in terms {
                    for term in expansions.get(&child)?.iter() {
                        sum.add(term.clone().scaled(&k));
                    }
                }
                sum.add(Product::constant(c));
                sum.terms()
            }
            Kind::Product(k, factors) => {
                let mut product = vec![Product::constant(k)];
                for (child, n) in factors {
                    match expansions.get(&child) {
                        Some(terms) if n > 0 && terms.len() > 1 => {
                            if n > 1 && terms_of_power(terms, n) > most {
                                return None;
                            }
                            for _ in 0..n {
                                product = multiply(&product, terms, most)?;
                            }
                        }
                        Some(terms) if terms.len() == 1 => {
                            product = multiply(&product, &[terms[0].pow(n)?], most)?;
                        }
                        _ => product = multiply(&product, &[Product::power(child, n)], most)?,
                    }
                }
                product
            }
            Kind::Reduce(domain, body) => {
                let mut sum = Collected::default();
                for term in expansions.get(&body)?.iter() {
                    let body = term.node(dag);
                    let reduced = dag.reduce(domain, body);
                    if !dag.is_zero(reduced) {
                        sum.add(Product::of(dag, reduced));
                    }
                }
                sum.terms()
            }
            _ => vec![Product::power(node, 1)],
        };
        if terms.len() > most {
            return None;
        }
        expansions.insert(node, Rc::new(terms));
    }
    expansions.get(&root).map(|terms| terms.as_ref().clone())
}

/// The nodes of a root that are multiplied out, children first: arguments of functions and
/// divisors are not.
fn spine(dag: &Dag, root: Node) -> Vec<Node> {
    dag.reached(&[root], &mut |node, ahead| match dag.kind(node) {
        Kind::Sum(_, terms) => ahead.extend(terms.iter().map(|(_, n)| n)),
        Kind::Product(_, factors) => {
            let above = factors.iter().filter(|(_, n)| *n > 0);
            ahead.extend(above.map(|(node, _)| node));
        }
        Kind::Reduce(_, body) => ahead.add(*body),
        _ => {}
    })
}

/// A bound of the number of terms of the n-th power of a sum.
fn terms_of_power(terms: &[Product], n: i32) -> usize {
    let factors = terms.iter().map(|term| term.factors.as_slice());
    normal_form::terms_of_power(terms.len(), &exponent_ranges(factors), n.unsigned_abs())
}

fn multiply(a: &[Product], b: &[Product], most: usize) -> Option<Vec<Product>> {
    if a.len().saturating_mul(b.len()) > 16 * most {
        return None;
    }
    let mut sum = Collected::default();
    for x in a {
        for y in b {
            sum.add(x.times(y)?);
        }
    }
    let terms = sum.terms();
    (terms.len() <= most).then_some(terms)
}

/// Like terms added up, in order of first appearance.
#[derive(Default)]
pub(crate) struct Collected {
    terms: Vec<Product>,
    place: Map<Factors, usize>,
}

impl Collected {
    pub(crate) fn add(&mut self, term: Product) {
        let mut key = term.factors.clone();
        key.arrange();
        match self.place.get(&key) {
            Some(&at) => {
                self.terms[at].coefficient = self.terms[at].coefficient.add(&term.coefficient)
            }
            None => {
                self.place.insert(key, self.terms.len());
                self.terms.push(term);
            }
        }
    }

    pub(crate) fn terms(mut self) -> Vec<Product> {
        self.terms.retain(|term| !term.coefficient.is_zero());
        self.terms
    }
}
