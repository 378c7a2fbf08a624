//! Relations applied and divisors cleared.
//!
//! Input: a polynomial. Output: the polynomial with no power of an atom that its relation lowers
//! ([`Algebra::canonical`]), or a polynomial without divisors that is 0 exactly if the input is
//! ([`Algebra::numerator`]). Invariant: atoms are taken from the newest to the oldest, and what
//! replaces one is made of older ones.

use super::atoms::{Algebra, Key};
use super::polynomial::{Atom, Monomial, Poly, Sum, Undecided};
use crate::rational::Rational;
use std::rc::Rc;

/// How often all atoms are gone through: each pass but the first only meets what redefined atoms
/// brought back.
const PASSES: usize = 8;

impl Algebra {
    /// The polynomial with relations applied; divisors stay.
    pub(crate) fn canonical(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let mut poly = self.settled(poly)?;
        for _ in 0..PASSES {
            let mut changed = false;
            for atom in poly.atoms().into_iter().rev() {
                let Some((degree, replacement)) = self.entry(atom).relation.clone() else {
                    continue;
                };
                if poly
                    .terms()
                    .iter()
                    .any(|(m, _)| m.exponent(atom) >= degree as i32)
                {
                    poly = self.lowered(&poly, atom, degree, &replacement)?;
                    changed = true;
                }
            }
            if !changed {
                return Ok(poly);
            }
            poly = self.settled(&poly)?;
        }
        Err(Undecided)
    }

    /// A polynomial that is 0 exactly if the given one is, without divisors and without negative
    /// powers of atoms that have relations.
    pub(crate) fn numerator(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let mut poly = self.canonical(poly)?;
        for _ in 0..PASSES {
            let mut changed = false;
            let mut below = Atom::MAX;
            // Clearing a divisor brings older atoms in, so the list is read anew each time.
            while let Some(atom) = poly.atoms().into_iter().rev().find(|atom| *atom < below) {
                below = atom;
                let entry = self.entry(atom);
                let special = entry.relation.is_some() || matches!(entry.key, Key::Divisor(_));
                if special && poly.terms().iter().any(|(m, _)| m.exponent(atom) < 0) {
                    (_, poly) = self.cleared(&poly, atom)?;
                    changed = true;
                }
                if let Some((degree, replacement)) = self.entry(atom).relation.clone() {
                    if poly
                        .terms()
                        .iter()
                        .any(|(m, _)| m.exponent(atom) >= degree as i32)
                    {
                        poly = self.lowered(&poly, atom, degree, &replacement)?;
                        changed = true;
                    }
                }
            }
            if !changed {
                return Ok(poly);
            }
            poly = self.settled(&poly)?;
        }
        Err(Undecided)
    }

    /// The polynomial times the lowest power of the atom inverted, and that power (≤ 0). For a
    /// divisor its polynomial is multiplied in.
    pub(super) fn cleared(&mut self, poly: &Poly, atom: Atom) -> Result<(i32, Poly), Undecided> {
        let groups = poly.by_power(atom);
        let lowest = groups.iter().map(|(n, _)| *n).min().unwrap_or(0).min(0);
        let mut sum = Sum::default();
        let divisor = match &self.entry(atom).key {
            Key::Divisor(divisor) => Some(divisor.clone()),
            _ => None,
        };
        let Some(divisor) = divisor else {
            return Ok((
                lowest,
                poly.times(&Monomial::atom(atom, lowest.saturating_neg())),
            ));
        };
        let divisor = self.settled(&divisor)?;
        let mut power = Poly::integer(1);
        let mut reached = lowest;
        for (n, part) in groups {
            while reached < n {
                power = self.mul(&power, &divisor)?;
                reached += 1;
            }
            sum.add_product(&part, &power, &mut self.budget)?;
        }
        Ok((lowest, sum.finish(&self.budget)?))
    }

    /// Powers of an atom from `degree` on replaced.
    fn lowered(
        &mut self,
        poly: &Poly,
        atom: Atom,
        degree: u32,
        replacement: &Rc<Poly>,
    ) -> Result<Poly, Undecided> {
        let replacement = self.settled(replacement)?;
        let degree = degree as i32;
        let mut sum = Sum::default();
        let mut power = Poly::integer(1);
        let mut reached = 0;
        for (n, part) in poly.by_power(atom) {
            if n < degree {
                sum.add(&part.times(&Monomial::atom(atom, n)), &Rational::ONE);
                continue;
            }
            while reached < n / degree {
                power = self.mul(&power, &replacement)?;
                reached += 1;
            }
            sum.add_product(
                &part.times(&Monomial::atom(atom, n % degree)),
                &power,
                &mut self.budget,
            )?;
        }
        sum.finish(&self.budget)
    }

    /// The polynomial with redefined atoms replaced.
    pub(super) fn settled(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        if !self.any_redefined {
            return Ok(poly.clone());
        }
        let mut poly = poly.clone();
        loop {
            let redefined = poly
                .atoms()
                .into_iter()
                .find_map(|atom| self.entry(atom).redefined.clone().map(|by| (atom, by)));
            let Some((atom, by)) = redefined else {
                return Ok(poly);
            };
            poly = self.substituted(&poly, atom, &by)?;
        }
    }

    /// The polynomial with an atom replaced, whatever its powers.
    pub(crate) fn substituted(
        &mut self,
        poly: &Poly,
        atom: Atom,
        by: &Poly,
    ) -> Result<Poly, Undecided> {
        let mut sum = Sum::default();
        for (n, part) in poly.by_power(atom) {
            let power = self.pow(by, n)?;
            sum.add_product(&part, &power, &mut self.budget)?;
        }
        sum.finish(&self.budget)
    }
}
