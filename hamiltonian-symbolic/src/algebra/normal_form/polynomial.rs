//! Laurent polynomials with rational coefficients.
//!
//! Input: numbers of atoms. Output: [`Poly`]. Invariant: terms sorted by monomial, no zero
//! coefficients, atoms of a monomial sorted and with exponents other than 0, so that equal
//! polynomials are equal values; every product is charged to a [`Budget`].
//!
//! Proofs compare expressions in this form. Programs and texts keep the order of the source: their products are
//! [`Product`](crate::product::Product)s.

use crate::dag::Map;
use crate::list::IntoList;
use crate::product::{exponent, exponent_ranges};
use crate::rational::Rational;
use crate::sort::Arrange;
use std::cmp::Ordering;

/// The number of an atom in its algebra.
pub(crate) type Atom = u32;

/// The reason why an expression has no normal form, or why a rule was left out of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Undecided {
    /// The expansion grew past its budget.
    Budget,
    /// Relations still applied after the last pass.
    Passes,
    /// A number is too long.
    Numbers,
    /// It divides by 0.
    Zero,
    /// A condition stands before a fraction.
    Conditions,
    /// There are more loops than can be told apart.
    Loops,
    /// An angle has too many terms to be taken apart.
    Angle,
    /// An angle is too large a multiple of another one, or too small a part of it.
    Multiple,
    /// There are too many arguments of functions to compare them all.
    Arguments,
    /// A sum has too many re-indexings to compare them all.
    Reindexings,
}

/// The rest of the budget of an expansion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    /// The most terms a polynomial may have.
    pub(crate) terms: usize,
    /// The products of terms that are left.
    pub(crate) products: usize,
}

impl Budget {
    /// Checks that a number of terms, by a number of products, is within the budget.
    fn allow(&self, terms: usize, products: usize) -> Result<(), Undecided> {
        (terms <= self.terms && products <= self.products)
            .then_some(())
            .ok_or(Undecided::Budget)
    }
    pub(super) fn charge(&mut self, products: usize) -> Result<(), Undecided> {
        let left = self.products.checked_sub(products);
        self.products = left.ok_or(Undecided::Budget)?;
        Ok(())
    }
}

/// `Π atom^n`
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub(crate) struct Monomial(pub(crate) Vec<(Atom, i32)>);

impl Monomial {
    /// One atom.
    pub(crate) fn atom(atom: Atom, n: i32) -> Monomial {
        Monomial(if n == 0 { Vec::new() } else { vec![(atom, n)] })
    }
    /// The product.
    pub(crate) fn mul(&self, other: &Monomial) -> Monomial {
        let (a, b) = (&self.0, &other.0);
        let mut product = Vec::with_capacity(a.len() + b.len());
        let (mut i, mut j) = (0, 0);
        while i < a.len() && j < b.len() {
            if a[i].0 < b[j].0 {
                product.push(a[i]);
                i += 1;
            } else if b[j].0 < a[i].0 {
                product.push(b[j]);
                j += 1;
            } else {
                let n = a[i].1.saturating_add(b[j].1);
                if n != 0 {
                    product.push((a[i].0, n));
                }
                i += 1;
                j += 1;
            }
        }
        product.extend_from_slice(&a[i..]);
        product.extend_from_slice(&b[j..]);
        Monomial(product)
    }
    /// The power.
    pub(crate) fn pow(&self, n: i32) -> Monomial {
        if n == 0 {
            return Monomial::default();
        }
        Monomial(
            self.0
                .iter()
                .map(|(atom, m)| (*atom, m.saturating_mul(n)))
                .into_list(),
        )
    }
    /// The exponent of an atom.
    pub(crate) fn exponent(&self, atom: Atom) -> i32 {
        exponent(&self.0, &atom)
    }
    /// The monomial without an atom.
    pub(crate) fn without(&self, atom: Atom) -> Monomial {
        Monomial(
            self.0
                .iter()
                .filter(|(a, _)| *a != atom)
                .copied()
                .into_list(),
        )
    }
    /// The order by exponents of the newest atom first, which products keep.
    pub(super) fn newest_first(&self, other: &Monomial) -> Ordering {
        let (mut a, mut b) = (self.0.iter().rev(), other.0.iter().rev());
        loop {
            return match (a.next(), b.next()) {
                (None, None) => Ordering::Equal,
                (Some((_, n)), None) => n.cmp(&0),
                (None, Some((_, n))) => 0.cmp(n),
                (Some((x, n)), Some((y, _))) if x > y => n.cmp(&0),
                (Some((x, _)), Some((y, n))) if x < y => 0.cmp(n),
                (Some((_, n)), Some((_, m))) if n != m => n.cmp(m),
                _ => continue,
            };
        }
    }
    /// The quotient, where that has no power less than both have.
    pub(super) fn over(&self, divisor: &Monomial) -> Option<Monomial> {
        let divides = |&(atom, n): &(Atom, i32)| n <= self.exponent(atom);
        divisor
            .0
            .iter()
            .all(divides)
            .then(|| self.mul(&divisor.pow(-1)))
    }
    /// Returns true if this is 1.
    pub(crate) fn is_one(&self) -> bool {
        self.0.is_empty()
    }
}

/// `Σ k·Π atom^n`
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub(crate) struct Poly {
    terms: Vec<(Monomial, Rational)>,
}

impl Poly {
    /// A number.
    pub(crate) fn constant(value: Rational) -> Poly {
        Poly::term(value, Monomial::default())
    }
    /// An integer.
    pub(crate) fn integer(value: i64) -> Poly {
        Poly::constant(Rational::integer(value))
    }
    /// `k·monomial`
    pub(crate) fn term(k: Rational, monomial: Monomial) -> Poly {
        Poly {
            terms: if k.is_zero() {
                Vec::new()
            } else {
                vec![(monomial, k)]
            },
        }
    }
    /// An atom to a power.
    pub(crate) fn atom(atom: Atom, n: i32) -> Poly {
        Poly::term(Rational::ONE, Monomial::atom(atom, n))
    }
    /// The terms.
    pub(crate) fn terms(&self) -> &[(Monomial, Rational)] {
        &self.terms
    }
    /// Returns true if this is 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }
    /// The cost of reading it once, in products of terms.
    pub(super) fn cost(&self) -> usize {
        self.terms.iter().map(|(m, _)| 1 + m.0.len() / 8).sum()
    }
    /// The value, of a constant.
    pub(crate) fn as_constant(&self) -> Option<Rational> {
        match self.terms.as_slice() {
            [] => Some(Rational::ZERO),
            [(monomial, k)] if monomial.is_one() => Some(k.clone()),
            _ => None,
        }
    }
    /// The one term, if there is exactly one.
    pub(crate) fn as_term(&self) -> Option<&(Monomial, Rational)> {
        match self.terms.as_slice() {
            [term] => Some(term),
            _ => None,
        }
    }
    /// A rational multiple.
    pub(crate) fn scale(&self, k: &Rational) -> Poly {
        if k.is_zero() {
            return Poly::default();
        }
        Poly {
            terms: self
                .terms
                .iter()
                .map(|(m, c)| (m.clone(), c.mul(k)))
                .into_list(),
        }
    }
    /// The sum.
    pub(crate) fn add(&self, other: &Poly) -> Poly {
        let mut sum = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut a, mut b) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            match (a.peek(), b.peek()) {
                (Some(x), Some(y)) if x.0 == y.0 => {
                    let k = x.1.add(&y.1);
                    if !k.is_zero() {
                        sum.push((x.0.clone(), k));
                    }
                    a.next();
                    b.next();
                }
                (Some(x), Some(y)) if x.0 < y.0 => sum.extend(a.next().cloned()),
                (_, Some(_)) => sum.extend(b.next().cloned()),
                (Some(_), None) => sum.extend(a.next().cloned()),
                (None, None) => return Poly { terms: sum },
            }
        }
    }
    /// The difference.
    pub(crate) fn sub(&self, other: &Poly) -> Poly {
        self.add(&other.scale(&Rational::MINUS_ONE))
    }
    /// The product.
    pub(crate) fn mul(&self, other: &Poly, budget: &mut Budget) -> Result<Poly, Undecided> {
        let mut sum = Sum::default();
        sum.add_product(self, other, budget)?;
        sum.finish(budget)
    }
    /// The product with a monomial.
    pub(crate) fn times(&self, monomial: &Monomial) -> Poly {
        let mut terms: Vec<_> = self
            .terms
            .iter()
            .map(|(m, k)| (m.mul(monomial), k.clone()))
            .into_list();
        terms.arrange_by(|a, b| a.0.cmp(&b.0));
        Poly { terms }
    }
    /// The power, n ≥ 0.
    pub(crate) fn pow(&self, n: u32, budget: &mut Budget) -> Result<Poly, Undecided> {
        if let (Some((monomial, k)), Ok(power)) = (self.as_term(), i32::try_from(n)) {
            return Ok(Poly::term(
                k.pow(power).ok_or(Undecided::Numbers)?,
                monomial.pow(power),
            ));
        }
        if n > 1 {
            self.allow_power(n, budget)?;
        }
        let mut result = Poly::integer(1);
        for _ in 0..n {
            result = result.mul(self, budget)?;
        }
        Ok(result)
    }
    /// Checks that the n-th power is within the budget: its terms, and the products that make it.
    fn allow_power(&self, n: u32, budget: &Budget) -> Result<(), Undecided> {
        // No two terms of a power have the same exponents.
        let ranges = exponent_ranges(self.terms.iter().map(|(monomial, _)| monomial.0.as_slice()));
        let terms = terms_of_power(self.terms.len(), &ranges, n);
        budget.allow(terms, 0)?;
        // Numbers grow by the bits of the sum of coefficients.
        let longest = self.terms.iter().map(|(_, k)| k.length()).max();
        let bits = longest.unwrap_or(0) + u64::from(self.terms.len().max(1).ilog2());
        let mut products = 0usize;
        for m in 1..n {
            let terms = terms_of_power(self.terms.len(), &ranges, m);
            let words = (bits * u64::from(m) / 64) as usize;
            let each = 1 + words * words;
            products += terms.saturating_mul(self.terms.len()).saturating_mul(each);
            budget.allow(1, products)?;
        }
        Ok(())
    }
    /// The atoms that occur, ascending.
    pub(crate) fn atoms(&self) -> Vec<Atom> {
        let mut occurs: Vec<bool> = Vec::new();
        for (monomial, _) in &self.terms {
            for &(atom, _) in &monomial.0 {
                let at = atom as usize;
                if at >= occurs.len() {
                    occurs.resize(at + 1, false);
                }
                occurs[at] = true;
            }
        }
        (0..occurs.len())
            .filter(|at| occurs[*at])
            .map(|at| at as Atom)
            .into_list()
    }
    /// The coefficients of the powers of an atom, ascending.
    pub(crate) fn by_power(&self, atom: Atom) -> Vec<(i32, Poly)> {
        let mut groups: Vec<(i32, Vec<(Monomial, Rational)>)> = Vec::new();
        for (monomial, k) in &self.terms {
            let n = monomial.exponent(atom);
            let term = (monomial.without(atom), k.clone());
            match groups.iter_mut().find(|(power, _)| *power == n) {
                Some((_, terms)) => terms.push(term),
                None => groups.push((n, vec![term])),
            }
        }
        groups.arrange_by_key(|(n, _)| *n);
        groups
            .into_iter()
            .map(|(n, mut terms)| {
                terms.arrange_by(|a, b| a.0.cmp(&b.0));
                (n, Poly { terms })
            })
            .into_list()
    }
}

/// A bound of the number of terms of an n-th power: of a sum of so many terms, whose exponents have
/// ranges of these lengths.
pub(crate) fn terms_of_power(terms: usize, ranges: &[u64], n: u32) -> usize {
    // Exponents of the terms in each product: n of them, in any order.
    let mut choices = 1usize;
    for at in 1..terms.max(1) {
        let more = choices.saturating_mul(n as usize + at);
        if more == usize::MAX {
            choices = more;
            break;
        }
        choices = more / at;
    }
    let n = u64::from(n);
    let exponents = ranges.iter().fold(1u64, |all, length| {
        all.saturating_mul(length.saturating_mul(n).saturating_add(1))
    });
    choices.min(usize::try_from(exponents).unwrap_or(usize::MAX))
}

/// A sum under construction.
#[derive(Default)]
pub(crate) struct Sum {
    terms: Map<Monomial, Rational>,
}

impl Sum {
    /// Adds a term.
    pub(crate) fn add_term(&mut self, monomial: Monomial, k: Rational) {
        match self.terms.get_mut(&monomial) {
            Some(sum) => *sum = sum.add(&k),
            None => {
                self.terms.insert(monomial, k);
            }
        }
    }
    /// Adds a multiple of a polynomial.
    pub(crate) fn add(&mut self, poly: &Poly, k: &Rational) {
        for (monomial, c) in &poly.terms {
            self.add_term(
                monomial.clone(),
                if k.is_one() { c.clone() } else { c.mul(k) },
            );
        }
    }
    /// Adds a product.
    pub(crate) fn add_product(
        &mut self,
        a: &Poly,
        b: &Poly,
        budget: &mut Budget,
    ) -> Result<(), Undecided> {
        budget.charge(a.terms.len().saturating_mul(b.terms.len()))?;
        for (m, k) in &a.terms {
            for (n, l) in &b.terms {
                let k = k.mul(l);
                // Long monomials and long numbers cost more than their count says.
                let words = (k.bits() / 64) as usize;
                budget.charge((m.0.len() + n.0.len()) / 16 + (words - 1) * words)?;
                self.add_term(m.mul(n), k);
            }
        }
        self.check(budget)
    }
    fn check(&self, budget: &Budget) -> Result<(), Undecided> {
        if self.terms.len() > budget.terms {
            Err(Undecided::Budget)
        } else {
            Ok(())
        }
    }
    /// The polynomial.
    pub(crate) fn finish(self, budget: &Budget) -> Result<Poly, Undecided> {
        self.check(budget)?;
        let mut terms: Vec<_> = self
            .terms
            .into_iter()
            .filter(|(_, k)| !k.is_zero())
            .into_list();
        terms.arrange_by(|a, b| a.0.cmp(&b.0));
        Ok(Poly { terms })
    }
}
