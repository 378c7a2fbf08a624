//! Products of sums multiplied out, without any other rule.
//!
//! Input: a node. Output: [`Term`]s that add up to it. Invariant: terms stand in order of first
//! appearance, factors in the order they were written in; like terms are one.

use crate::algebra::factors::{Factors, product};
use crate::dag::{Dag, Kind, Map, Node};
use crate::normal_form;
use crate::rational::Rational;
use crate::sort::Arrange;
use std::rc::Rc;

/// The most terms an expansion may have.
pub(super) const MOST: usize = 4096;

/// `k·Π node^n`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Term {
    /// k.
    pub coefficient: Rational,
    /// The factors, none of them a sum unless below a fraction line or inside a function.
    pub factors: Factors,
}

impl Term {
    /// A number.
    fn constant(coefficient: Rational) -> Term {
        let factors = Vec::new();
        Term {
            coefficient,
            factors,
        }
    }
    /// A power of a node.
    fn power(node: Node, n: i32) -> Term {
        Term {
            coefficient: Rational::ONE,
            factors: vec![(node, n)],
        }
    }
    /// The term as a node.
    pub fn node(&self, dag: &mut Dag) -> Node {
        dag.product(&self.coefficient, &self.factors)
    }
}

/// The terms of a node multiplied out; `None` where there are more than 4096 of them.
#[must_use]
pub fn expand(dag: &mut Dag, root: Node) -> Option<Vec<Term>> {
    expand_within(dag, root, MOST)
}

/// The terms of a node multiplied out; `None` where it, or a part of it, has more of them.
pub(crate) fn expand_within(dag: &mut Dag, root: Node, most: usize) -> Option<Vec<Term>> {
    let mut expansions: Map<Node, Rc<Vec<Term>>> = Map::default();
    for node in spine(dag, root) {
        let kind = dag.kind(node).clone();
        let terms = match kind {
            Kind::Constant(value) if value.is_zero() => Vec::new(),
            Kind::Constant(value) => vec![Term::constant(value)],
            Kind::Sum(c, terms) => {
                let mut sum = Collected::default();
                for (k, child) in terms {
                    for term in expansions.get(&child)?.iter() {
                        sum.add(Term {
                            coefficient: term.coefficient.mul(&k),
                            factors: term.factors.clone(),
                        });
                    }
                }
                sum.add(Term::constant(c));
                sum.terms()
            }
            Kind::Product(k, factors) => {
                let mut product = vec![Term::constant(k)];
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
                            let power = terms[0].coefficient.pow(n)?;
                            let factors = terms[0]
                                .factors
                                .iter()
                                .map(|(f, m)| Some((*f, m.checked_mul(n)?)));
                            let term = Term {
                                coefficient: power,
                                factors: factors.collect::<Option<_>>()?,
                            };
                            product = multiply(&product, &[term], most)?;
                        }
                        _ => product = multiply(&product, &[Term::power(child, n)], most)?,
                    }
                }
                product
            }
            Kind::Reduce(domain, body) => {
                let mut sum = Collected::default();
                for term in expansions.get(&body)?.iter() {
                    let body = term.node(dag);
                    let (coefficient, factors) = match dag.reduce(domain, body) {
                        reduced if dag.is_zero(reduced) => continue,
                        reduced => match dag.kind(reduced) {
                            Kind::Product(k, factors) => (k.clone(), factors.clone()),
                            Kind::Constant(value) => (value.clone(), Vec::new()),
                            _ => (Rational::ONE, vec![(reduced, 1)]),
                        },
                    };
                    sum.add(Term {
                        coefficient,
                        factors,
                    });
                }
                sum.terms()
            }
            _ => vec![Term::power(node, 1)],
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
    dag.reached(&[root], |node, ahead| match dag.kind(node) {
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
fn terms_of_power(terms: &[Term], n: i32) -> usize {
    let mut ranges: Map<Node, (i64, i64)> = Map::default();
    for term in terms {
        for &(node, m) in &term.factors {
            let (least, most) = ranges.entry(node).or_default();
            (*least, *most) = ((*least).min(m.into()), (*most).max(m.into()));
        }
    }
    let lengths = ranges.values().map(|(least, most)| most.abs_diff(*least));
    normal_form::terms_of_power(terms.len(), lengths, n.unsigned_abs())
}

fn multiply(a: &[Term], b: &[Term], most: usize) -> Option<Vec<Term>> {
    if a.len().saturating_mul(b.len()) > 16 * most {
        return None;
    }
    let mut sum = Collected::default();
    for x in a {
        for y in b {
            sum.add(Term {
                coefficient: x.coefficient.mul(&y.coefficient),
                factors: product(&x.factors, &y.factors)?,
            });
        }
    }
    let terms = sum.terms();
    (terms.len() <= most).then_some(terms)
}

/// Like terms added up, in order of first appearance.
#[derive(Default)]
pub(crate) struct Collected {
    terms: Vec<Term>,
    place: Map<Factors, usize>,
}

impl Collected {
    pub(crate) fn add(&mut self, term: Term) {
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

    pub(crate) fn terms(mut self) -> Vec<Term> {
        self.terms.retain(|term| !term.coefficient.is_zero());
        self.terms
    }
}
