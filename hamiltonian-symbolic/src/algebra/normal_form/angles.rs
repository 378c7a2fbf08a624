//! Cosines and sines of angles, over common bases.
//!
//! Input: an angle as a polynomial. Output: its cosine and sine as polynomials. Invariant: each rule
//! here is an identity wherever the original is defined.

use super::atoms::{Algebra, Base, Key};
use super::functions::{gcd, lcm};
use super::polynomial::{Atom, Monomial, Poly, Undecided};
use crate::op::Op;
use crate::rational::Rational;

/// Angles with more terms than this are not expanded.
pub(super) const LONGEST_ANGLE: usize = 6;
/// Multiples of a base past this are bases of their own.
pub(super) const LARGEST_MULTIPLE: i64 = 64;

impl Algebra {
    /// Cosine and sine of an angle, by addition over its base angles.
    pub(super) fn angle(&mut self, angle: &Poly) -> Result<(Poly, Poly), Undecided> {
        let mut sum = (Poly::integer(1), Poly::default());
        let terms: Vec<(Monomial, Rational)> = if angle.terms().len() > LONGEST_ANGLE {
            self.left_out = Some(Undecided::Angle);
            // The whole angle is one base, up to its sign.
            let (sign, angle) = self.oriented(angle.clone())?;
            let cos = self.function(Key::Cos(angle.clone()), None);
            let sin = self.sine(angle, cos);
            return Ok((Poly::atom(cos, 1), Poly::term(sign, Monomial::atom(sin, 1))));
        } else {
            angle.terms().to_vec()
        };
        for (monomial, k) in terms {
            let (n, d) = k.to_small().ok_or(Undecided::Numbers)?;
            let (cos, sin, multiple) = self.base_angle(&monomial, n, d)?;
            let (c, s) = self.multiple(&cos, &sin, multiple)?;
            sum = self.rotated(&sum, (&c, &s))?;
        }
        Ok(sum)
    }

    /// Cosine and sine of a sum of two angles.
    fn rotated(&mut self, a: &(Poly, Poly), b: (&Poly, &Poly)) -> Result<(Poly, Poly), Undecided> {
        let (cc, ss) = (self.mul(&a.0, b.0)?, self.mul(&a.1, b.1)?);
        let (cs, sc) = (self.mul(&a.0, b.1)?, self.mul(&a.1, b.0)?);
        Ok((cc.sub(&ss), cs.add(&sc)))
    }

    fn sine(&mut self, angle: Poly, cos: Atom) -> Atom {
        let square = Poly::integer(1).sub(&Poly::atom(cos, 2));
        self.function(Key::Sin(angle), Some((2, square)))
    }

    /// Cosine and sine of a base of `n/d·monomial`, and the multiple of the base this is.
    fn base_angle(
        &mut self,
        monomial: &Monomial,
        n: i64,
        d: i64,
    ) -> Result<(Poly, Poly, i64), Undecided> {
        if n.abs() > LARGEST_MULTIPLE {
            self.left_out = Some(Undecided::Multiple);
            let angle = Poly::term(Rational::new(n.abs(), d), monomial.clone());
            let cos = self.function(Key::Cos(angle.clone()), None);
            let sin = self.sine(angle, cos);
            return Ok((Poly::atom(cos, 1), Poly::atom(sin, 1), n.signum()));
        }
        if let (1, [(atom, 1)]) = (d, monomial.0.as_slice())
            && let Some((cos, sin)) = self.inverse_angle(*atom)?
        {
            return Ok((cos, sin, n));
        }
        let known = self.angles.get(monomial).copied();
        // The multiple of a base that n/d is.
        let times = |base: &Base| {
            let (n, unit) = (n * base.denominator, d * base.numerator);
            (n % unit == 0).then(|| n / unit)
        };
        if let Some(base) = known
            && let Some(multiple) = times(&base)
        {
            return Ok((
                Poly::atom(base.first, 1),
                Poly::atom(base.second, 1),
                multiple,
            ));
        }
        // The greatest common divisor with the base so far.
        let (numerator, denominator) = match known {
            None => (n.abs(), d),
            Some(base) => {
                let denominator = lcm(base.denominator, d);
                let [a, b] = [(n.abs(), d), (base.numerator, base.denominator)]
                    .map(|(n, d)| n * (denominator / d));
                let both = gcd(a, b);
                let common = gcd(both, denominator);
                (both / common, denominator / common)
            }
        };
        if denominator > LARGEST_MULTIPLE {
            return Err(Undecided::Multiple);
        }
        let angle = Poly::term(Rational::new(numerator, denominator), monomial.clone());
        let first = self.function(Key::Cos(angle.clone()), None);
        let second = self.sine(angle, first);
        let base = Base {
            numerator,
            denominator,
            first,
            second,
        };
        self.angles.insert(monomial.clone(), base);
        let (cos, sin) = (Poly::atom(first, 1), Poly::atom(second, 1));
        if let Some(old) = known {
            let times = old.numerator * denominator / (old.denominator * numerator);
            let (old_cos, old_sin) = self.multiple(&cos, &sin, times)?;
            self.redefine(old.first, old_cos);
            self.redefine(old.second, old_sin);
        }
        let multiple = times(&base).ok_or(Undecided::Numbers)?;
        Ok((cos, sin, multiple))
    }

    /// Cosine and sine of an angle that is itself an inverse function.
    fn inverse_angle(&mut self, atom: Atom) -> Result<Option<(Poly, Poly)>, Undecided> {
        let Key::Function(op, x) = self.entry(atom).key.clone() else {
            return Ok(None);
        };
        let one = Poly::integer(1);
        let square = self.mul(&x[0], &x[0])?;
        Ok(match op {
            Op::Asin => Some((self.root(&one.sub(&square))?, x[0].clone())),
            Op::Acos => Some((x[0].clone(), self.root(&one.sub(&square))?)),
            Op::Atan => {
                let root = self.root(&one.add(&square))?;
                let inverse = self.invert(&root)?;
                Some((inverse.clone(), self.mul(&x[0], &inverse)?))
            }
            Op::Atan2 => {
                let other = self.mul(&x[1], &x[1])?;
                let root = self.root(&square.add(&other))?;
                let inverse = self.invert(&root)?;
                Some((self.mul(&x[1], &inverse)?, self.mul(&x[0], &inverse)?))
            }
            _ => None,
        })
    }

    /// cos nx and sin nx from cos x and sin x.
    fn multiple(&mut self, cos: &Poly, sin: &Poly, n: i64) -> Result<(Poly, Poly), Undecided> {
        if n.abs() == 1 {
            return Ok((cos.clone(), sin.scale(&Rational::integer(n))));
        }
        let (mut c, mut s) = (Poly::integer(1), Poly::default());
        for _ in 0..n.unsigned_abs() {
            let next = self.rotated(&(c, s), (cos, sin))?;
            // Squares of the sine lowered at each step keep the cosine a polynomial in cos x.
            (c, s) = (self.canonical(&next.0)?, self.canonical(&next.1)?);
        }
        Ok((c, s.scale(&Rational::integer(n.signum()))))
    }
}
