//! Products of roots, of signs and of powers of signs as one.
//!
//! Input: a polynomial without negative powers of roots. Output: the polynomial with √a·√b as √(a·b), ∛a·∛b as
//! ∛(a·b), sign a·sign b as sign(a·b), and the signs of x^a·x^b as those of x^(a + b). Invariant: each rule is an
//! identity wherever its left side is defined, so none is used the other way round: √(a·b) has a value where a and b
//! are negative, √a·√b has none. A product that a condition guards is multiplied by 0 where it has none.
//!
//! Products that are multiplied out grow, so that this is tried last.

use super::atoms::{Algebra, Key};
use super::polynomial::{Atom, Monomial, Poly, Sum, Undecided};
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;

impl Algebra {
    /// The polynomial with products of roots and signs as one; `None` if it has none.
    pub(super) fn merged(&mut self, poly: &Poly) -> Result<Option<Poly>, Undecided> {
        let (mut sum, mut is_changed) = (Sum::default(), false);
        for (monomial, k) in poly.terms().to_vec() {
            let mut rest = monomial;
            let mut product = Poly::constant(k);
            for degree in [2, 3] {
                if let Some(root) = self.merged_roots(&mut rest, degree)? {
                    product = self.mul(&product, &root)?;
                    is_changed = true;
                }
            }
            if let Some(sign) = self.merged_signs(&mut rest)? {
                product = self.mul(&product, &sign)?;
                is_changed = true;
            }
            while let Some(power) = self.merged_pair_of_powers(&mut rest)? {
                product = self.mul(&product, &power)?;
                is_changed = true;
            }
            sum.add(&product.times(&rest), &Rational::ONE);
        }
        let sum = sum.finish(&self.budget)?;
        Ok(is_changed.then_some(sum))
    }

    /// The atoms of a monomial that are chosen, if there are several; they are taken out.
    fn taken(
        &self,
        monomial: &mut Monomial,
        is_chosen: impl Fn(&Key, i32) -> bool,
    ) -> Option<Vec<(Atom, i32)>> {
        let atoms = monomial.0.iter();
        let (chosen, rest): (Vec<_>, Vec<_>) =
            atoms.partition(|(atom, n)| is_chosen(&self.entry(*atom).key, *n));
        if chosen.len() < 2 {
            return None;
        }
        *monomial = Monomial(rest);
        Some(chosen)
    }

    fn merged_roots(
        &mut self,
        monomial: &mut Monomial,
        degree: u32,
    ) -> Result<Option<Poly>, Undecided> {
        // Roots of numbers are those of primes.
        let is_root = |key: &Key, n: i32| {
            n > 0 && matches!(key, Key::Root(d, of) if *d == degree && of.as_constant().is_none())
        };
        let Some(roots) = self.taken(monomial, is_root) else {
            return Ok(None);
        };
        let mut outside = Poly::integer(1);
        let mut inside: Vec<Poly> = Vec::new();
        for (atom, n) in roots {
            if let Key::Root(_, of) = self.entry(atom).key.clone() {
                inside.push(self.pow(&of, n)?);
            }
        }
        // √(b·q)·√b is b·√q.
        while degree == 2
            && let Some((of, by, quotient)) = self.divisible(&inside)?
        {
            outside = self.mul(&outside, &inside[by])?;
            inside[of] = quotient;
            inside.remove(by);
        }
        let mut product = Poly::integer(1);
        for of in &inside {
            product = self.mul(&product, of)?;
        }
        let product = self.canonical(&product)?;
        let root = match degree {
            2 => self.root(&product)?,
            _ => self.call(Op::Cbrt, &[product])?,
        };
        self.mul(&outside, &root).map(Some)
    }

    /// The places of two polynomials of which one divides the other, and the quotient.
    fn divisible(&mut self, polys: &[Poly]) -> Result<Option<(usize, usize, Poly)>, Undecided> {
        for of in 0..polys.len() {
            for by in 0..polys.len() {
                let is_plain = [of, by].iter().all(|at| !Algebra::is_divided(&polys[*at]));
                if of != by
                    && is_plain
                    && let Some(quotient) = self.quotient(&polys[of], &polys[by])?
                {
                    return Ok(Some((of, by, quotient)));
                }
            }
        }
        Ok(None)
    }

    fn merged_signs(&mut self, monomial: &mut Monomial) -> Result<Option<Poly>, Undecided> {
        // The signs of single atoms are those that signs of products are taken apart into.
        let is_sign =
            |key: &Key, n: i32| n == 1 && matches!(key, Key::Sign(of) if of.terms().len() > 1);
        let Some(signs) = self.taken(monomial, is_sign) else {
            return Ok(None);
        };
        let mut product = Poly::integer(1);
        for (atom, _) in signs {
            if let Key::Sign(of) = self.entry(atom).key.clone() {
                product = self.mul(&product, &of)?;
            }
        }
        self.sign(&product).map(Some)
    }

    /// s^a·s^b as s^(a + b) or, as a and b are whole where s is negative, as s^(a − b); s^a·t^a as (s·t)^a.
    fn merged_pair_of_powers(
        &mut self,
        monomial: &mut Monomial,
    ) -> Result<Option<Poly>, Undecided> {
        let power = |(atom, n): &(Atom, i32)| match &self.entry(*atom).key {
            Key::Function(Op::Pow, of) if *n == 1 => Some((*atom, of[0].clone(), of[1].clone())),
            _ => None,
        };
        let powers: Vec<(Atom, Poly, Poly)> = monomial.0.iter().filter_map(power).into_list();
        for (at, (one, s, a)) in powers.iter().enumerate() {
            for (other, t, b) in &powers[at + 1..] {
                let (sign, exponent) = match () {
                    () if s == t => {
                        let (sum, difference) = (a.add(b), a.sub(b));
                        let is_less = difference.terms().len() < sum.terms().len();
                        (s.clone(), if is_less { difference } else { sum })
                    }
                    () if a == b => (self.mul(s, t)?, a.clone()),
                    () => continue,
                };
                *monomial = monomial.without(*one).without(*other);
                return self.power_of_sign(&sign, &exponent).map(Some);
            }
        }
        Ok(None)
    }
}
