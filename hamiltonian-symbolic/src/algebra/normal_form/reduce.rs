//! Relations applied and divisors cleared.
//!
//! Input: a polynomial. Output: the polynomial with no power of an atom that its relation lowers
//! ([`Algebra::canonical`]), or a polynomial without divisors that is 0 exactly if the input is
//! ([`Algebra::numerator`]). Invariant: atoms are taken from the newest to the oldest, and what
//! replaces one is made of older ones.

use super::atoms::{Algebra, Key};
use super::polynomial::{Atom, Monomial, Poly, Sum, Undecided};
use crate::list::IntoList;
use crate::rational::Rational;

/// The most passes over all atoms. Each but the first meets only atoms that redefined ones brought
/// back.
pub(super) const PASSES: usize = 8;

impl Algebra {
    /// The polynomial with relations applied; divisors stay.
    pub(crate) fn canonical(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let mut poly = self.resolved(poly)?;
        self.budget.charge(poly.cost())?;
        for _ in 0..PASSES {
            let mut changed = false;
            for atom in poly.atoms().into_iter().rev() {
                changed |= self.lower(&mut poly, atom)?;
            }
            if !changed {
                return Ok(poly);
            }
            poly = self.resolved(&poly)?;
        }
        Err(Undecided::Passes)
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
                    poly = self.without_fractions(&poly, atom)?;
                    changed = true;
                }
                changed |= self.lower(&mut poly, atom)?;
            }
            if !changed {
                return Ok(poly);
            }
            poly = self.resolved(&poly)?;
        }
        Err(Undecided::Passes)
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
        let divisor = self.resolved(&divisor)?;
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

    /// A polynomial that is 0 exactly if the given one is, without negative powers of an atom: of
    /// two cases, that what is divided by is not 0, and that it is. In the second one fractions
    /// are behind conditions that do not hold, or nothing is defined.
    fn without_fractions(&mut self, poly: &Poly, atom: Atom) -> Result<Poly, Undecided> {
        let (_, cleared) = self.cleared(poly, atom)?;
        if !self.any_guarded {
            return Ok(cleared);
        }
        let divisor = match &self.entry(atom).key {
            Key::Divisor(divisor) => divisor.clone(),
            _ => Poly::atom(atom, 1),
        };
        let sign = self.sign(&divisor)?;
        let is_there = self.mul(&sign, &sign)?;
        let is_not = Poly::integer(1).sub(&is_there);
        let mut sum = Sum::default();
        sum.add_product(&cleared, &is_there, &mut self.budget)?;
        for (n, part) in poly.by_power(atom) {
            if n >= 0 {
                let part = part.times(&Monomial::atom(atom, n));
                sum.add_product(&part, &is_not, &mut self.budget)?;
            }
        }
        sum.finish(&self.budget)
    }

    /// Applies an atom's relation to its powers from the degree of the relation on, and to negative powers
    /// if that takes no divisor. Returns true if there were any.
    fn lower(&mut self, poly: &mut Poly, atom: Atom) -> Result<bool, Undecided> {
        if let Key::Sign(of) = self.entry(atom).key.clone() {
            return self.lower_sign(poly, atom, &of);
        }
        let Some((degree, replacement)) = self.entry(atom).relation.clone() else {
            return Ok(false);
        };
        let degree = degree as i32;
        let inverts = replacement
            .as_term()
            .is_some_and(|(m, _)| m.exponent(atom) == 0);
        let stays = |n: i32| n < degree && (n >= 0 || !inverts);
        if poly.terms().iter().all(|(m, _)| stays(m.exponent(atom))) {
            return Ok(false);
        }
        let replacement = self.resolved(&replacement)?;
        let mut sum = Sum::default();
        for (n, part) in poly.by_power(atom) {
            if stays(n) {
                sum.add(&part.times(&Monomial::atom(atom, n)), &Rational::ONE);
                continue;
            }
            let power = self.pow(&replacement, n.div_euclid(degree))?;
            let part = part.times(&Monomial::atom(atom, n.rem_euclid(degree)));
            sum.add_product(&part, &power, &mut self.budget)?;
        }
        *poly = sum.finish(&self.budget)?;
        Ok(true)
    }

    /// The rules of the sign s of x: s³ = s, s² = s if x ≥ 0, and s²·x = x. The last one replaces
    /// s²·m, where m is the leading monomial of x = c·m + r: by m + (r − s²·r)/c.
    fn lower_sign(&mut self, poly: &mut Poly, atom: Atom, of: &Poly) -> Result<bool, Undecided> {
        let of = self.resolved(of)?;
        let is_idempotent = self.sign_of(&of).is_nonnegative();
        let is_anything_but_zero = self.is_anything_but_zero(&of);
        let leading = of.terms().iter().max_by(|a, b| a.0.newest_first(&b.0));
        let (leading, c) = leading.cloned().ok_or(Undecided::Zero)?;
        let by = c.recip().ok_or(Undecided::Zero)?;
        let mut changed = false;
        let mut sum = Sum::default();
        let mut left = poly.terms().to_vec();
        while let Some((monomial, k)) = left.pop() {
            let n = monomial.exponent(atom);
            if n == 0 {
                sum.add_term(monomial, k);
                continue;
            }
            let power = if n % 2 != 0 || is_idempotent { 1 } else { 2 };
            changed |= power != n;
            let rest = monomial.without(atom);
            let is_square = power == 2 || is_idempotent;
            if is_square && is_anything_but_zero || self.has_zeros_of(&rest, &of, is_square) {
                changed = true;
                sum.add_term(rest, k);
                continue;
            }
            match rest.over(&leading) {
                Some(quotient) if is_square => {
                    changed = true;
                    self.budget.charge(of.terms().len())?;
                    for (other, l) in of.terms() {
                        if *other == leading {
                            continue;
                        }
                        let (other, l) = (quotient.mul(other), k.mul(l).mul(&by));
                        left.push((other.mul(&Monomial::atom(atom, power)), l.neg()));
                        sum.add_term(other, l);
                    }
                    sum.add_term(rest, k);
                }
                _ => sum.add_term(rest.mul(&Monomial::atom(atom, power)), k),
            }
        }
        if changed {
            *poly = sum.finish(&self.budget)?;
        }
        Ok(changed)
    }

    /// Returns true if a monomial is 0, or nothing, where x is, so that the sign of x is no other factor
    /// than 1; or where x is not > 0, unless it `is_square`.
    fn has_zeros_of(&self, monomial: &Monomial, x: &Poly, is_square: bool) -> bool {
        let is_x = |atom: Atom| *x == Poly::atom(atom, 1);
        // Without its condition a fraction is not 0 where it is nothing.
        let counts = |n: i32| n > 0 || !self.any_guarded;
        monomial
            .0
            .iter()
            .any(|&(atom, n)| match &self.entry(atom).key {
                // A root that the statement does not read says nothing of the sign of x.
                Key::Root(2, of) => counts(n) && of == x && (is_square || !self.has_unread),
                Key::Root(_, of) => is_square && counts(n) && of == x,
                Key::Divisor(of) => is_square && of == x,
                _ => is_square && n < 0 && counts(n) && is_x(atom),
            })
    }

    /// The quotient, where a divisor that is no constant divides a polynomial. Neither has negative powers.
    pub(crate) fn quotient(
        &mut self,
        dividend: &Poly,
        divisor: &Poly,
    ) -> Result<Option<Poly>, Undecided> {
        let newest = |poly: &Poly| {
            let terms = poly.terms().iter();
            terms.max_by(|a, b| a.0.newest_first(&b.0)).cloned()
        };
        let (mut rest, mut quotient) = (dividend.clone(), Poly::default());
        let Some((leading, c)) = newest(divisor).filter(|(leading, _)| !leading.is_one()) else {
            return Ok(None);
        };
        let by = c.recip().ok_or(Undecided::Zero)?;
        while let Some((monomial, k)) = newest(&rest) {
            let Some(over) = monomial.over(&leading) else {
                return Ok(None);
            };
            let term = Poly::term(k.mul(&by), over);
            let product = self.mul(&term, divisor)?;
            rest = rest.sub(&product);
            quotient = quotient.add(&term);
        }
        Ok(Some(quotient))
    }

    /// The polynomial of several terms whose power a polynomial is, if there is one. Neither has negative powers.
    ///
    /// Its leading term is the root of the leading term. The others follow one by one: if rⁿ is subtracted, what is left
    /// begins with n·(leading term of r)ⁿ⁻¹ times the next term of r.
    pub(super) fn root_of_power(&mut self, poly: &Poly, n: u32) -> Result<Option<Poly>, Undecided> {
        /// The most terms of a root.
        const MAX_TERMS_OF_ROOT: usize = 8;
        let newest = |poly: &Poly| {
            let terms = poly.terms().iter();
            terms.max_by(|a, b| a.0.newest_first(&b.0)).cloned()
        };
        if poly.terms().len() < 3 || Algebra::is_divided(poly) {
            return Ok(None);
        }
        let Some((leading, k)) = newest(poly) else {
            return Ok(None);
        };
        let is_power = leading.0.iter().all(|(_, m)| m % n as i32 == 0);
        let Some(k) = k.root(n).filter(|_| is_power) else {
            return Ok(None);
        };
        let over = leading.0.iter().map(|(atom, m)| (*atom, m / n as i32));
        let leading = Monomial(over.into_list());
        let mut root = Poly::term(k.clone(), leading.clone());
        let below = Poly::term(k, leading).pow(n - 1, &mut self.budget)?;
        let Some((below, l)) = below.as_term().cloned() else {
            return Ok(None);
        };
        let by = l.mul(&Rational::integer(i64::from(n))).recip();
        let by = by.ok_or(Undecided::Zero)?;
        loop {
            let power = root.pow(n, &mut self.budget)?;
            let Some((next, k)) = newest(&poly.sub(&power)) else {
                return Ok(Some(root));
            };
            let Some(next) = next
                .over(&below)
                .filter(|_| root.terms().len() < MAX_TERMS_OF_ROOT)
            else {
                return Ok(None);
            };
            let longer = root.add(&Poly::term(k.mul(&by), next));
            // Each term is older than those before it.
            if longer.terms().len() <= root.terms().len() {
                return Ok(None);
            }
            root = longer;
        }
    }

    /// The polynomial with redefined atoms replaced.
    pub(super) fn resolved(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        if self.redefined == 0 {
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
