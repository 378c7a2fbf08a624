//! Products of powers `k·Π base^n` in the order of the source.
//!
//! Input: numbers, nodes and powers. Output: [`Product`]. Invariant: each base stands in a product once. An
//! exponent may be 0 until `simplified` removes it.
//!
//! Products have two forms. This one keeps the order in which factors were written: programs evaluate and texts
//! print them in that order, and the arena stores it (`Kind::Product`). The normal form has sorted polynomials
//! (`normal_form::polynomial`): there equal expressions must be equal values.

use crate::dag::{Dag, Kind, Map, Node};
use crate::list::IntoList;
use crate::rational::Rational;
use std::hash::Hash;

/// Bases with their exponents.
pub type Factors<B = Node> = Vec<(B, i32)>;

/// `k·Π base^n`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Product<B = Node> {
    /// k.
    pub coefficient: Rational,
    /// The bases with their exponents.
    pub factors: Factors<B>,
}

/// The exponent of a base, 0 if it is no factor.
pub(crate) fn exponent<B: PartialEq>(factors: &[(B, i32)], base: &B) -> i32 {
    let found = factors.iter().find(|(other, _)| other == base);
    found.map_or(0, |(_, n)| *n)
}

/// The length of the range of each base's exponents in some products.
pub(crate) fn exponent_ranges<'a, B: Copy + Hash + Eq + 'a>(
    products: impl Iterator<Item = &'a [(B, i32)]>,
) -> Vec<u64> {
    let mut ranges: Map<B, (i32, i32)> = Map::default();
    for &(base, n) in products.flatten() {
        let (least, most) = ranges.entry(base).or_default();
        (*least, *most) = ((*least).min(n), (*most).max(n));
    }
    let lengths = ranges
        .values()
        .map(|(least, most)| most.abs_diff(*least).into());
    lengths.into_list()
}

impl<B: Copy + PartialEq> Product<B> {
    /// `coefficient·Π base^n`
    pub(crate) fn new(coefficient: Rational, factors: Factors<B>) -> Product<B> {
        Product {
            coefficient,
            factors,
        }
    }
    /// A number.
    pub(crate) fn constant(coefficient: Rational) -> Product<B> {
        Product::new(coefficient, Vec::new())
    }
    /// A power.
    pub(crate) fn power(base: B, n: i32) -> Product<B> {
        Product::new(Rational::ONE, vec![(base, n)])
    }
    /// The exponent of a base, 0 if it is no factor.
    pub(crate) fn exponent(&self, base: B) -> i32 {
        exponent(&self.factors, &base)
    }
    /// The factors below the fraction line.
    pub(crate) fn divisors(&self) -> impl Iterator<Item = (B, i32)> {
        self.factors.iter().copied().filter(|(_, n)| *n < 0)
    }
    /// Multiplies by base^n; a new base is inserted at `place`.
    pub(crate) fn multiply_at(&mut self, place: usize, base: B, n: i32) {
        match self.factors.iter_mut().find(|(other, _)| *other == base) {
            Some((_, m)) => *m += n,
            None => self.factors.insert(place, (base, n)),
        }
    }
    /// Multiplies by base^n; a new base comes last.
    pub(crate) fn multiply(&mut self, base: B, n: i32) {
        self.multiply_at(self.factors.len(), base, n);
    }
    /// Puts the power of one base in place of that of another.
    pub(crate) fn replace(&mut self, old: B, new: B, n: i32) {
        if let Some(place) = self.factors.iter().position(|(base, _)| *base == old) {
            self.factors.remove(place);
            self.multiply_at(place, new, n);
        }
    }
    /// The product without factors to the power 0.
    pub(crate) fn simplified(mut self) -> Product<B> {
        self.factors.retain(|(_, n)| *n != 0);
        self
    }
    /// A rational multiple.
    pub(crate) fn scaled(mut self, k: &Rational) -> Product<B> {
        self.coefficient = self.coefficient.mul(k);
        self
    }
    /// The product of two; `None` if an exponent overflows.
    pub(crate) fn times(&self, other: &Product<B>) -> Option<Product<B>> {
        let mut all = self.clone().scaled(&other.coefficient);
        for &(base, n) in &other.factors {
            all.exponent(base).checked_add(n)?;
            all.multiply(base, n);
        }
        Some(all.simplified())
    }
    /// A power; `None` if a number overflows.
    pub(crate) fn pow(&self, n: i32) -> Option<Product<B>> {
        let power = |&(base, m): &(B, i32)| Some((base, m.checked_mul(n)?));
        let factors = self.factors.iter().map(power).collect::<Option<_>>()?;
        Some(Product::new(self.coefficient.pow(n)?, factors))
    }
}

impl Product {
    /// The product that a node is; any other node is the only factor.
    pub(crate) fn of(dag: &Dag, node: Node) -> Product {
        match dag.kind(node) {
            Kind::Product(k, factors) => Product::new(k.clone(), factors.clone()),
            Kind::Constant(value) => Product::constant(value.clone()),
            _ => Product::power(node, 1),
        }
    }
    /// The product as a node.
    pub fn node(&self, dag: &mut Dag) -> Node {
        dag.product(&self.coefficient, &self.factors)
    }
    /// The coefficient, and the rest as a node.
    pub(crate) fn split(self, dag: &mut Dag) -> (Rational, Node) {
        (self.coefficient, dag.product(&Rational::ONE, &self.factors))
    }
}
