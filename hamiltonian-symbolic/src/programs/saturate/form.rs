//! Quotients of polynomials in exponentials e₁, e₂, …
//!
//! Input: sums, products and powers of them. Output: [`Form`], a product of powers of polynomials. Invariant: sums are
//! over a common denominator and multiplied out exactly, so that what cancels is gone; each polynomial begins with 1, and
//! one in a single power e of the exponentials is divided by 1 − e as often as that divides it.

use crate::dag::Node;
use crate::list::IntoList;
use crate::product::{Factors, Product};
use crate::rational::Rational;

/// The longest polynomial that is multiplied out, in terms.
const LONGEST: usize = 24;

/// The most terms that are collected.
const MAX_TERMS: usize = 256;

/// Exponentials that go to ∞ as t, with 1, and to 0 as 1/t, with −1.
pub(super) type Direction = Vec<(usize, i32)>;

/// A product of powers of the exponentials.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Powers(Vec<i32>);

impl Powers {
    /// 1
    pub(super) fn none() -> Powers {
        Powers(Vec::new())
    }
    /// The n-th power of one exponential.
    pub(super) fn of(at: usize, n: i32) -> Powers {
        let mut all = vec![0; at];
        all.push(n);
        Powers::trimmed(all)
    }
    fn trimmed(mut all: Vec<i32>) -> Powers {
        while all.last() == Some(&0) {
            all.pop();
        }
        Powers(all)
    }
    /// The power of one exponential.
    pub(super) fn at(&self, at: usize) -> i32 {
        self.0.get(at).copied().unwrap_or(0)
    }
    /// The exponentials with their powers, of those that have one.
    pub(super) fn all(&self) -> impl Iterator<Item = (usize, i32)> {
        let all = self.0.iter().copied().enumerate();
        all.filter(|(_, n)| *n != 0)
    }
    /// The powers of some exponentials alone.
    pub(super) fn among(&self, wanted: &[usize]) -> Powers {
        let all = self.0.iter().enumerate();
        let own = all.map(|(at, n)| if wanted.contains(&at) { *n } else { 0 });
        Powers::trimmed(own.into_list())
    }
    /// n if the size grows as tⁿ.
    fn growth(&self, direction: &Direction) -> i32 {
        let all = direction.iter();
        let all = all.map(|(at, sign)| self.at(*at).saturating_mul(*sign));
        all.fold(0, i32::saturating_add)
    }
    /// The product with the n-th power of another.
    pub(super) fn times(&self, other: &Powers, n: i32) -> Option<Powers> {
        let length = self.0.len().max(other.0.len());
        let power = |at| self.at(at).checked_add(other.at(at).checked_mul(n)?);
        let all = (0..length).map(power).collect::<Option<_>>()?;
        Some(Powers::trimmed(all))
    }
    /// n if this is the n-th power of another.
    pub(super) fn steps(&self, other: &Powers) -> Option<i32> {
        let (at, unit) = other.all().next()?;
        let n = self.at(at) / unit;
        (Powers::none().times(other, n)? == *self).then_some(n)
    }
    /// The least product of which this is a power; one exponential is that itself.
    fn primitive(&self) -> Powers {
        let divisor = match self.all().count() {
            1 => self.all().map(|(_, n)| n.abs()).sum(),
            _ => (self.all()).fold(0, |all, (_, n)| num_integer::gcd(all, n)),
        };
        Powers(self.0.iter().map(|n| n / divisor.max(1)).into_list())
    }
}

impl Ord for Powers {
    fn cmp(&self, other: &Powers) -> std::cmp::Ordering {
        let mut places = 0..self.0.len().max(other.0.len());
        let differs = places.find(|at| self.at(*at) != other.at(*at));
        differs.map_or(std::cmp::Ordering::Equal, |at| {
            self.at(at).cmp(&other.at(at))
        })
    }
}

impl PartialOrd for Powers {
    fn partial_cmp(&self, other: &Powers) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Σ coefficient·Π eᵢⁿ: each power with a coefficient, each pair of power and factors once. Factors keep the order of the
/// source, which equality ignores: nothing may depend on the numbers of nodes.
#[derive(Clone, Debug)]
pub(super) struct Polynomial(pub(super) Vec<(Powers, Product)>);

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
        let same = |((n, a), (m, b)): (&(Powers, Product), &(Powers, Product))| {
            n == m && a.coefficient == b.coefficient && have_same_factors(a, b)
        };
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(same)
    }
}

impl Polynomial {
    fn of(terms: impl IntoIterator<Item = (Powers, Product)>) -> Polynomial {
        let mut all: Vec<(Powers, Product)> = Vec::new();
        for (power, product) in terms {
            let same = |(n, other): &&mut (Powers, Product)| {
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
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        Polynomial(all)
    }
    fn times(&self, other: &Polynomial) -> Option<Polynomial> {
        let mut terms = Vec::new();
        for (n, a) in &self.0 {
            for (m, b) in &other.0 {
                terms.push((n.times(m, 1)?, a.times(b)?));
            }
        }
        let product = Polynomial::of(terms);
        (product.0.len() <= LONGEST).then_some(product)
    }
    /// The e of which all powers of a polynomial are powers.
    pub(super) fn axis(&self) -> Option<Powers> {
        let mut powers = self.0.iter().map(|(power, _)| power);
        let axis = powers.find(|power| power.all().count() > 0)?.primitive();
        powers
            .all(|power| power.steps(&axis).is_some())
            .then_some(axis)
    }
    /// The degree in e.
    pub(super) fn degree(&self, axis: &Powers) -> i32 {
        let highest = self.0.last().and_then(|(power, _)| power.steps(axis));
        highest.unwrap_or(0)
    }
    /// The growth of the term that grows most.
    fn growth(&self, direction: &Direction) -> i32 {
        let all = self.0.iter().map(|(power, _)| power.growth(direction));
        all.max().unwrap_or(0)
    }
    /// Returns true if this is 1 − e.
    pub(super) fn is_one_less(&self, axis: &Powers) -> bool {
        *self == Polynomial::one_less(axis)
    }
    fn one_less(axis: &Powers) -> Polynomial {
        let number = |k| Product::constant(k);
        Polynomial(vec![
            (Powers::none(), number(Rational::ONE)),
            (axis.clone(), number(Rational::MINUS_ONE)),
        ])
    }
    /// The quotient by 1 − e, if it divides this: bᵢ = Σ cⱼ, j ≤ i.
    fn divided(&self, axis: &Powers) -> Option<Polynomial> {
        let at_one = self.0.iter();
        let at_one = at_one.map(|(_, product)| (Powers::none(), product.clone()));
        if !Polynomial::of(at_one).0.is_empty() {
            return None;
        }
        let degree = self.degree(axis);
        let mut sums = Vec::new();
        for (power, product) in &self.0 {
            for n in power.steps(axis).unwrap_or(0)..degree {
                sums.push((Powers::none().times(axis, n)?, product.clone()));
            }
        }
        Some(Polynomial::of(sums))
    }
}

/// k·Π atomⁿ·Π eᵢᵐ·Π polynomialⁿ
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Form {
    pub(super) monomial: Product,
    pub(super) power: Powers,
    pub(super) factors: Vec<(Polynomial, i32)>,
}

impl Form {
    /// An atom, or a product of atoms.
    pub(super) fn of(monomial: Product) -> Form {
        Form {
            monomial,
            power: Powers::none(),
            factors: Vec::new(),
        }
    }
    pub(super) fn number(k: Rational) -> Form {
        Form::of(Product::constant(k))
    }
    pub(super) fn atom(node: Node) -> Form {
        Form::of(Product::power(node, 1))
    }
    /// A power of one exponential.
    pub(super) fn exponential(at: usize, n: i32) -> Form {
        Form {
            power: Powers::of(at, n),
            ..Form::number(Rational::ONE)
        }
    }
    /// Returns true if this is 0.
    pub(super) fn is_zero(&self) -> bool {
        self.monomial.coefficient.is_zero()
    }
    /// n if the size grows as tⁿ for t → ∞.
    pub(super) fn growth(&self, direction: &Direction) -> i32 {
        let factors = self.factors.iter();
        let factors = factors.map(|(p, n)| n.saturating_mul(p.growth(direction)));
        factors.fold(self.power.growth(direction), i32::saturating_add)
    }
    /// The exponentials of a form.
    pub(super) fn exponentials(&self) -> Vec<usize> {
        let polynomials = self.factors.iter().flat_map(|(p, _)| &p.0);
        let powers = polynomials.map(|(power, _)| power);
        let powers = powers.chain([&self.power]).flat_map(Powers::all);
        let mut all: Vec<usize> = powers.map(|(at, _)| at).into_list();
        all.sort_unstable();
        all.dedup();
        all
    }
    pub(super) fn pow(&self, n: i32) -> Option<Form> {
        let factors = self.factors.iter();
        let factors = factors.map(|(p, m)| Some((p.clone(), m.checked_mul(n)?)));
        Some(Form {
            monomial: self.monomial.pow(n)?,
            power: Powers::none().times(&self.power, n)?,
            factors: factors.collect::<Option<_>>()?,
        })
    }
    pub(super) fn times(&self, other: &Form) -> Option<Form> {
        let mut product = self.clone();
        product.monomial = product.monomial.times(&other.monomial)?;
        product.power = product.power.times(&other.power, 1)?;
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
        let terms: Vec<&Form> = terms.iter().filter(|term| !term.is_zero()).into_list();
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
            let own = (term.power.clone(), term.monomial.clone());
            let mut product = Polynomial::of([own]);
            for (polynomial, least) in &common {
                let own = term.factors.iter().find(|(p, _)| p == polynomial);
                for _ in *least..own.map_or(0, |(_, n)| *n) {
                    product = product.times(polynomial)?;
                }
            }
            numerator.extend(product.0);
            if numerator.len() > MAX_TERMS {
                return None;
            }
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

    /// A polynomial as a product of its content, powers of the exponentials, powers of 1 − e, and the rest.
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
            terms.push((power.times(&low, -1)?, product.times(&inverse)?));
        }
        let mut rest = Polynomial::of(terms);
        let mut form = Form::of(content);
        form.power = low;
        while rest.0.len() > 1
            && let Some(axis) = rest.axis()
            && let Some(quotient) = rest.divided(&axis)
        {
            form.multiply(&Polynomial::one_less(&axis), 1);
            rest = quotient;
        }
        if rest.0.len() > 1 {
            form.multiply(&rest, 1);
        }
        Some(form)
    }
}
