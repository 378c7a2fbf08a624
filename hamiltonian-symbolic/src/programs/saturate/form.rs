//! Quotients of polynomials in one exponential e.
//!
//! Input: sums, products and powers of them. Output: [`Form`], a product of powers of polynomials. Invariant: sums are
//! over a common denominator and multiplied out exactly, so that what cancels is gone; each polynomial begins with e⁰ and
//! is divided by 1 − e as often as that divides it.

use crate::dag::Node;
use crate::product::{Factors, Product};
use crate::rational::Rational;

/// The longest polynomial that is multiplied out, in terms.
const LONGEST: usize = 24;

/// Σ coefficient·eⁿ: each power with a coefficient, each pair of power and factors once. Factors keep the order of the
/// source, which equality ignores: nothing may depend on the numbers of nodes.
#[derive(Clone, Debug)]
pub(super) struct Polynomial(pub(super) Vec<(i32, Product)>);

/// Returns true if the factors are the same in any order.
fn have_same_factors(a: &Product, b: &Product) -> bool {
    let has = |all: &Product, own: &Product| {
        let mut own = own.factors.iter();
        own.all(|(base, n)| all.exponent(*base) == *n)
    };
    has(a, b) && has(b, a)
}

impl PartialEq for Polynomial {
    fn eq(&self, other: &Polynomial) -> bool {
        let same = |((n, a), (m, b)): (&(i32, Product), &(i32, Product))| {
            n == m && a.coefficient == b.coefficient && have_same_factors(a, b)
        };
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(same)
    }
}

impl Polynomial {
    fn of(terms: impl IntoIterator<Item = (i32, Product)>) -> Polynomial {
        let mut all: Vec<(i32, Product)> = Vec::new();
        for (power, product) in terms {
            let same = |(n, other): &&mut (i32, Product)| {
                *n == power && have_same_factors(other, &product)
            };
            match all.iter_mut().find(same) {
                Some((_, other)) => {
                    other.coefficient = other.coefficient.add(&product.coefficient);
                }
                None => all.push((power, product)),
            }
        }
        all.retain(|(_, product)| !product.coefficient.is_zero());
        all.sort_by_key(|(power, _)| *power);
        Polynomial(all)
    }
    fn times(&self, other: &Polynomial) -> Option<Polynomial> {
        let mut terms = Vec::new();
        for (n, a) in &self.0 {
            for (m, b) in &other.0 {
                terms.push((n.checked_add(*m)?, a.times(b)?));
            }
        }
        let product = Polynomial::of(terms);
        (product.0.len() <= LONGEST).then_some(product)
    }
    /// The degree.
    pub(super) fn degree(&self) -> i32 {
        self.0.last().map_or(0, |(power, _)| *power)
    }
    /// Returns true if this is 1 − e.
    pub(super) fn is_one_less(&self) -> bool {
        *self == Polynomial::one_less()
    }
    fn one_less() -> Polynomial {
        let number = |k| Product::constant(k);
        Polynomial(vec![
            (0, number(Rational::ONE)),
            (1, number(Rational::MINUS_ONE)),
        ])
    }
    /// The quotient by 1 − e, if it divides this: bᵢ = Σ cⱼ, j ≤ i.
    fn divided(&self) -> Option<Polynomial> {
        let at_one = self.0.iter().map(|(_, product)| (0, product.clone()));
        if !Polynomial::of(at_one).0.is_empty() {
            return None;
        }
        let degree = self.degree();
        let sums = self
            .0
            .iter()
            .flat_map(|(power, product)| (*power..degree).map(move |at| (at, product.clone())));
        Some(Polynomial::of(sums))
    }
}

/// k·Π atomⁿ·eᵐ·Π polynomialⁿ
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Form {
    pub(super) monomial: Product,
    pub(super) power: i32,
    pub(super) factors: Vec<(Polynomial, i32)>,
}

impl Form {
    /// An atom, or a product of atoms.
    pub(super) fn of(monomial: Product) -> Form {
        Form {
            monomial,
            power: 0,
            factors: Vec::new(),
        }
    }
    pub(super) fn number(k: Rational) -> Form {
        Form::of(Product::constant(k))
    }
    pub(super) fn atom(node: Node) -> Form {
        Form::of(Product::power(node, 1))
    }
    /// eⁿ
    pub(super) fn exponential(n: i32) -> Form {
        Form {
            power: n,
            ..Form::number(Rational::ONE)
        }
    }
    /// Returns true if this is 0.
    pub(super) fn is_zero(&self) -> bool {
        self.monomial.coefficient.is_zero()
    }
    /// n if the size grows as enⁿ where e → ∞, or, backwards, where e → 0.
    pub(super) fn growth(&self, up: bool) -> i32 {
        let degrees = self.factors.iter().map(|(p, n)| p.degree() * n);
        match up {
            true => self.power + degrees.sum::<i32>(),
            false => -self.power,
        }
    }
    pub(super) fn pow(&self, n: i32) -> Option<Form> {
        let factors = self.factors.iter();
        let factors = factors.map(|(p, m)| Some((p.clone(), m.checked_mul(n)?)));
        Some(Form {
            monomial: self.monomial.pow(n)?,
            power: self.power.checked_mul(n)?,
            factors: factors.collect::<Option<_>>()?,
        })
    }
    pub(super) fn times(&self, other: &Form) -> Option<Form> {
        let mut product = self.clone();
        product.monomial = product.monomial.times(&other.monomial)?;
        product.power += other.power;
        for (polynomial, n) in &other.factors {
            product.multiply(polynomial, *n);
        }
        Some(product)
    }
    fn multiply(&mut self, polynomial: &Polynomial, n: i32) {
        match self.factors.iter_mut().find(|(p, _)| p == polynomial) {
            Some((_, m)) => *m += n,
            None => self.factors.push((polynomial.clone(), n)),
        }
        self.factors.retain(|(_, n)| *n != 0);
    }

    /// The sum, multiplied out over a common denominator; `None` where it is too long.
    pub(super) fn sum(terms: &[Form]) -> Option<Form> {
        let terms: Vec<&Form> = terms.iter().filter(|term| !term.is_zero()).collect();
        // What all have in common stands in front.
        let mut common: Vec<(Polynomial, i32)> = Vec::new();
        for (polynomial, _) in terms.iter().flat_map(|term| &term.factors) {
            if common.iter().all(|(p, _)| p != polynomial) {
                let power = |term: &&Form| {
                    let own = term.factors.iter().find(|(p, _)| p == polynomial);
                    own.map_or(0, |(_, n)| *n)
                };
                let least = terms.iter().map(power).min().unwrap_or(0);
                common.push((polynomial.clone(), least));
            }
        }
        let mut numerator = Vec::new();
        for term in &terms {
            let own = (term.power, term.monomial.clone());
            let mut product = Polynomial::of([own]);
            for (polynomial, least) in &common {
                let own = term.factors.iter().find(|(p, _)| p == polynomial);
                for _ in *least..own.map_or(0, |(_, n)| *n) {
                    product = product.times(polynomial)?;
                }
            }
            numerator.extend(product.0);
        }
        let numerator = Polynomial::of(numerator);
        if numerator.0.len() > LONGEST {
            return None;
        }
        let mut sum = Form::primitive(numerator)?;
        if !sum.is_zero() {
            for (polynomial, n) in &common {
                sum.multiply(polynomial, *n);
            }
        }
        Some(sum)
    }

    /// A polynomial as a product of its content, a power of e, powers of 1 − e, and the rest.
    fn primitive(polynomial: Polynomial) -> Option<Form> {
        let Some((low, first)) = polynomial.0.first().cloned() else {
            return Some(Form::number(Rational::ZERO));
        };
        // The factors that all terms have.
        let mut shared: Factors = Vec::new();
        for &(base, _) in polynomial
            .0
            .iter()
            .flat_map(|(_, product)| &product.factors)
        {
            if shared.iter().all(|(other, _)| *other != base) {
                let powers = polynomial
                    .0
                    .iter()
                    .map(|(_, product)| product.exponent(base));
                shared.push((base, powers.min().unwrap_or(0)));
            }
        }
        shared.retain(|(_, n)| *n != 0);
        let content = Product::new(first.coefficient.clone(), shared);
        let inverse = content.pow(-1)?;
        let mut terms = Vec::new();
        for (power, product) in &polynomial.0 {
            terms.push((power - low, product.times(&inverse)?));
        }
        let mut rest = Polynomial::of(terms);
        let mut form = Form::of(content);
        form.power = low;
        while rest.0.len() > 1
            && let Some(quotient) = rest.divided()
        {
            form.multiply(&Polynomial::one_less(), 1);
            rest = quotient;
        }
        if rest.0.len() > 1 {
            form.multiply(&rest, 1);
        }
        Some(form)
    }
}
