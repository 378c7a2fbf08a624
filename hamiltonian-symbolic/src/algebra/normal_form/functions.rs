//! Functions of polynomials in terms of atoms: exponents over common bases, roots, logarithms and signs of products taken apart.
//!
//! Input: canonical polynomials. Output: polynomials. Invariant: each rule here is an identity
//! wherever the original is defined (logarithms are of absolute values).

use super::atoms::{Algebra, Base, Key};
use super::polynomial::{Monomial, Poly, Undecided};
use crate::dag::{Partial, Sign};
use crate::op::{Op, Parity};
use crate::rational::Rational;
use crate::sort::Arrange;

/// The most arguments of functions that are compared with each other.
pub(super) const MOST_ARGUMENTS: usize = 64;

impl Algebra {
    /// An elementary function.
    pub(super) fn call(&mut self, op: Op, x: &[Poly]) -> Result<Poly, Undecided> {
        let half = Rational::new(1, 2);
        let one = Poly::integer(1);
        let first = self.argument(&x[0])?;
        Ok(match op {
            Op::Sqrt => self.root(&first)?,
            Op::Cbrt => {
                let (sign, first) = self.oriented(first)?;
                if first.is_zero() {
                    return Ok(first);
                }
                if let Some(base) = self.root_of_power(&first, 3)? {
                    return Ok(base.scale(&sign));
                }
                let atom = self.function(Key::Root(3, first.clone()), Some((3, first)));
                Poly::term(sign, Monomial::atom(atom, 1))
            }
            Op::Abs => self.size(&first)?,
            Op::Sign => self.sign(&first)?,
            Op::Sin => self.angle(&first)?.1,
            Op::Cos => self.angle(&first)?.0,
            Op::Tan => {
                let (cos, sin) = self.angle(&first)?;
                let cos = self.invert(&cos)?;
                self.mul(&sin, &cos)?
            }
            Op::Exp => self.exponential(&first)?,
            Op::ExpM1 => self.exponential(&first)?.sub(&one),
            Op::Sinh | Op::Cosh | Op::Tanh => {
                let up = self.exponential(&first)?;
                let down = self.exponential(&first.scale(&Rational::MINUS_ONE))?;
                let (sinh, cosh) = (up.sub(&down).scale(&half), up.add(&down).scale(&half));
                match op {
                    Op::Sinh => sinh,
                    Op::Cosh => cosh,
                    _ => {
                        let cosh = self.invert(&cosh)?;
                        self.mul(&sinh, &cosh)?
                    }
                }
            }
            Op::Ln => self.positive_logarithm(&first)?,
            Op::Ln1p => self.positive_logarithm(&first.add(&one))?,
            Op::Asinh => {
                let square = self.mul(&first, &first)?.add(&one);
                let root = self.root(&square)?;
                let sum = first.add(&root);
                self.set_positive(&sum)?;
                self.logarithm(&sum)?
            }
            Op::Atanh => {
                let (above, below) = (
                    self.positive_logarithm(&one.add(&first))?,
                    self.positive_logarithm(&one.sub(&first))?,
                );
                above.sub(&below).scale(&half)
            }
            Op::Hypot => {
                let y = self.argument(&x[1])?;
                let (a, b) = (self.mul(&first, &first)?, self.mul(&y, &y)?);
                let sum = a.add(&b);
                self.root(&sum)?
            }
            Op::Min | Op::Max => {
                let y = self.argument(&x[1])?;
                let difference = first.sub(&y);
                let sign = self.sign(&difference)?;
                let size = self.mul(&sign, &difference)?;
                let both = first.add(&y);
                (if op == Op::Min {
                    both.sub(&size)
                } else {
                    both.add(&size)
                })
                .scale(&half)
            }
            Op::Pow => {
                let y = self.argument(&x[1])?;
                self.power(&first, &y)?
            }
            Op::Floor => self.floor(&first)?,
            Op::Round => {
                let (sign, first) = self.oriented(first)?;
                if first.is_zero() {
                    return Ok(first);
                }
                let atom = self.function(Key::Function(op, vec![first]), None);
                Poly::term(sign, Monomial::atom(atom, 1))
            }
            // x − |y|·⌊x/|y|⌋ and x − y·round(x/y)
            Op::Modulo | Op::Remainder => {
                let y = self.argument(&x[1])?;
                let (whole, size) = match op {
                    Op::Modulo => (Op::Floor, self.size(&y)?),
                    _ => (Op::Round, y),
                };
                let per = self.invert(&size)?;
                let turns = self.mul(&first, &per)?;
                let turns = self.call(whole, &[turns])?;
                first.sub(&self.mul(&size, &turns)?)
            }
            Op::Erfc => {
                let erf = self.call(Op::Erf, x)?;
                one.sub(&erf)
            }
            Op::Asin
            | Op::Acos
            | Op::Atan
            | Op::Acosh
            | Op::Erf
            | Op::Atan2
            | Op::Anomaly
            | Op::Orbit
            | Op::Stumpff2
            | Op::Stumpff3 => {
                let mut arguments = vec![first];
                for other in &x[1..] {
                    arguments.push(self.argument(other)?);
                }
                let mut sign = Rational::ONE;
                if op.row().parity == Parity::Odd {
                    let (k, argument) = self.oriented(arguments.remove(0))?;
                    if argument.is_zero() {
                        return Ok(argument);
                    }
                    sign = k;
                    arguments.push(argument);
                }
                let atom = self.function(Key::Function(op, arguments), None);
                Poly::term(sign, Monomial::atom(atom, 1))
            }
        })
    }

    /// ⌊n + x⌋ = n + ⌊x⌋ for whole n.
    fn floor(&mut self, x: &Poly) -> Result<Poly, Undecided> {
        let mut terms = x.terms().iter();
        let number = terms.find(|(monomial, _)| monomial.is_one());
        let number = number.map_or(Rational::ZERO, |(_, k)| k.floor());
        let number = Poly::constant(number);
        let rest = self.argument(&x.sub(&number))?;
        if rest.is_zero() {
            return Ok(number);
        }
        let atom = self.function(Key::Function(Op::Floor, vec![rest]), None);
        Ok(number.add(&Poly::term(Rational::ONE, Monomial::atom(atom, 1))))
    }

    /// The argument of a function in the form it was first met in: with divisors, equal
    /// polynomials need not look alike.
    fn argument(&mut self, x: &Poly) -> Result<Poly, Undecided> {
        let x = self.canonical(x)?;
        let divided = x
            .atoms()
            .into_iter()
            .any(|atom| matches!(self.entry(atom).key, Key::Divisor(_)));
        if self.arguments.iter().any(|(known, _)| *known == x) {
            return Ok(x);
        }
        for at in 0..self.arguments.len() {
            let (known, with_divisors) = self.arguments[at].clone();
            if (divided || with_divisors) && self.numerator(&x.sub(&known))?.is_zero() {
                return Ok(known);
            }
        }
        if self.arguments.len() < MOST_ARGUMENTS {
            self.arguments.push((x.clone(), divided));
        } else {
            self.left_out = Some(Undecided::Arguments);
        }
        Ok(x)
    }

    /// A function written in Rust.
    pub(super) fn external(
        &mut self,
        function: u16,
        part: Partial,
        x: &[Poly],
    ) -> Result<Poly, Undecided> {
        let mut arguments = Vec::with_capacity(x.len());
        for argument in x {
            arguments.push(self.argument(argument)?);
        }
        let atom = self.function(Key::External(function, part, arguments), None);
        Ok(Poly::atom(atom, 1))
    }

    /// ±1 and the polynomial whose last coefficient is positive.
    pub(super) fn oriented(&mut self, poly: Poly) -> Result<(Rational, Poly), Undecided> {
        Ok(match poly.terms().last() {
            Some((_, k)) if k.is_negative() => {
                (Rational::MINUS_ONE, poly.scale(&Rational::MINUS_ONE))
            }
            _ => (Rational::ONE, poly),
        })
    }

    /// e^exponent: a product over base exponents; e^(n ln x) is a power of x.
    fn exponential(&mut self, exponent: &Poly) -> Result<Poly, Undecided> {
        let mut product = Poly::integer(1);
        for (monomial, k) in exponent.terms().to_vec() {
            let (n, d) = k.to_small().ok_or(Undecided::Numbers)?;
            let factor = match self.power_of_logarithm(&monomial, n, d)? {
                Some(factor) => factor,
                None => {
                    let known = self.exponents.get(&monomial).copied();
                    let base = match known {
                        Some(base) if base.denominator % d == 0 => base,
                        _ => {
                            let denominator = known.map_or(d, |base| lcm(base.denominator, d));
                            let base = Poly::term(Rational::new(1, denominator), monomial.clone());
                            let relation = self.power_relation(&monomial, denominator)?;
                            let first = self.function(Key::Exp(base), relation);
                            let base = Base {
                                numerator: 1,
                                denominator,
                                first,
                                second: first,
                            };
                            self.exponents.insert(monomial.clone(), base);
                            if let Some(old) = known {
                                let times = i32::try_from(denominator / old.denominator)
                                    .map_err(|_| Undecided::Numbers)?;
                                self.redefine(old.first, Poly::atom(first, times));
                            }
                            base
                        }
                    };
                    let n = n
                        .checked_mul(base.denominator / d)
                        .and_then(|n| i32::try_from(n).ok());
                    Poly::atom(base.first, n.ok_or(Undecided::Numbers)?)
                }
            };
            product = self.mul(&product, &factor)?;
        }
        Ok(product)
    }

    /// x^y, which has a value at x < 0 too where y is an integer: |x|^y·s^y, where s is the sign of
    /// x. s^(y + n) is s^n·s^y for whole n, s^(−y) is s^y, and its square is 1.
    fn power(&mut self, x: &Poly, y: &Poly) -> Result<Poly, Undecided> {
        if let Some(y) = y.as_constant() {
            let (n, d) = y.to_small().ok_or(Undecided::Numbers)?;
            if d == 1 {
                return self.pow(x, i32::try_from(n).map_err(|_| Undecided::Numbers)?);
            }
            // NaN at x < 0.
            self.assume_positive(x)?;
            let ln = self.logarithm(x)?;
            return self.exponential(&ln.scale(&Rational::new(n, d)));
        }
        let ln = self.logarithm(x)?;
        let exponent = self.mul(y, &ln)?;
        let size = self.exponential(&exponent)?;
        // An even power, or a factor ≥ 0, has no sign.
        let (k, monomial, rest) = self.content(x)?;
        let mut signed = rest;
        if self.sign_of(&signed).is_nonnegative() {
            signed = Poly::integer(1);
        }
        if k.is_negative() {
            signed = signed.scale(&Rational::MINUS_ONE);
        }
        for &(atom, n) in &monomial.0 {
            let entry = self.entry(atom);
            if n % 2 != 0 && !entry.sign.is_nonnegative() {
                let factor = match &entry.key {
                    Key::Divisor(divisor) => divisor.clone(),
                    _ => Poly::atom(atom, 1),
                };
                signed = self.mul(&signed, &factor)?;
            }
        }
        let sign = self.sign(&signed)?;
        let is_positive = |(monomial, k): &(Monomial, Rational)| {
            k.is_one() && monomial.0.iter().all(|(_, n)| n % 2 == 0)
        };
        if sign.as_term().is_some_and(is_positive) {
            return Ok(size);
        }
        let power = self.power_of_sign(&sign, y)?;
        self.mul(&size, &power)
    }

    /// s^y, where s is a product of signs.
    pub(super) fn power_of_sign(&mut self, sign: &Poly, y: &Poly) -> Result<Poly, Undecided> {
        let whole = y.terms().iter().find(|(monomial, _)| monomial.is_one());
        let (n, d) = whole
            .map_or(Some((0, 1)), |(_, k)| k.to_small())
            .ok_or(Undecided::Numbers)?;
        let whole = n.div_euclid(d);
        let (_, exponent) = self.oriented(y.sub(&Poly::integer(whole)))?;
        let odd = match whole % 2 {
            0 => Poly::integer(1),
            _ => sign.clone(),
        };
        if exponent.is_zero() {
            return Ok(odd);
        }
        let square = Some((2, Poly::integer(1)));
        let key = Key::Function(Op::Pow, vec![sign.clone(), exponent]);
        let power = self.function(key, square);
        Ok(odd.times(&Monomial::atom(power, 1)))
    }

    /// ln x, which is about points at which x > 0.
    fn positive_logarithm(&mut self, x: &Poly) -> Result<Poly, Undecided> {
        self.assume_positive(x)?;
        self.logarithm(x)
    }

    /// A statement is about points at which x > 0, or near such points, unless a condition may
    /// stand before the x, or the statement does not read x.
    fn assume_positive(&mut self, x: &Poly) -> Result<(), Undecided> {
        if self.has_conditions || self.has_unread {
            return Ok(());
        }
        self.set_positive(x)
    }

    /// x > 0.
    fn set_positive(&mut self, x: &Poly) -> Result<(), Undecided> {
        let sign = self.sign(x)?;
        if let Some((monomial, k)) = sign.as_term()
            && let [(atom, 1)] = monomial.0.as_slice()
            && matches!(self.entry(*atom).key, Key::Sign(_))
        {
            self.redefine(*atom, Poly::constant(k.clone()));
        }
        Ok(())
    }

    /// |x|
    fn size(&mut self, x: &Poly) -> Result<Poly, Undecided> {
        let sign = self.sign(x)?;
        self.mul(&sign, x)
    }

    /// e^(n/d·ln|x|) where the exponent is just that, d ≤ 3.
    fn power_of_logarithm(
        &mut self,
        monomial: &Monomial,
        n: i64,
        d: i64,
    ) -> Result<Option<Poly>, Undecided> {
        let [(atom, 1)] = monomial.0.as_slice() else {
            return Ok(None);
        };
        let Key::Ln(x) = self.entry(*atom).key.clone() else {
            return Ok(None);
        };
        let Ok(n) = i32::try_from(n) else {
            return Ok(None);
        };
        let x = if d == 1 && n % 2 == 0 {
            x
        } else {
            self.size(&x)?
        };
        Ok(match d {
            1 => Some(self.pow(&x, n)?),
            2 => {
                let root = self.root(&x)?;
                Some(self.pow(&root, n)?)
            }
            3 => {
                let root = self.call(Op::Cbrt, &[x])?;
                Some(self.pow(&root, n)?)
            }
            _ => None,
        })
    }

    /// (e^(ln|x|/d))^d = |x|
    fn power_relation(
        &mut self,
        monomial: &Monomial,
        d: i64,
    ) -> Result<Option<(u32, Poly)>, Undecided> {
        let [(atom, 1)] = monomial.0.as_slice() else {
            return Ok(None);
        };
        let (Key::Ln(x), Ok(d)) = (self.entry(*atom).key.clone(), u32::try_from(d)) else {
            return Ok(None);
        };
        Ok(Some((d, self.size(&x)?)))
    }

    /// √poly: squares come out, as absolute values.
    pub(super) fn root(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let (k, monomial, rest) = self.content(poly)?;
        if k.is_zero() {
            return Ok(Poly::default());
        }
        let mut outside = Poly::integer(1);
        let mut inside = rest.scale(&k.sign());
        if !k.is_negative()
            && let Some(base) = self.root_of_power(&rest, 2)?
        {
            // √(r²) = |r|
            (outside, inside) = (self.size(&base)?, Poly::integer(1));
        }
        for &(atom, n) in &monomial.0 {
            if let Key::Exp(exponent) = self.entry(atom).key.clone() {
                let factor = self.exponential(&exponent.scale(&Rational::new(i64::from(n), 2)))?;
                outside = self.mul(&outside, &factor)?;
                continue;
            }
            let half = n.div_euclid(2);
            if half != 0 {
                let mut factor = Poly::atom(atom, half);
                if half % 2 != 0 {
                    let sign = self.sign(&Poly::atom(atom, 1))?;
                    factor = self.mul(&factor, &sign)?;
                }
                outside = self.mul(&outside, &factor)?;
            }
            if n.rem_euclid(2) == 1 {
                let factor = match &self.entry(atom).key {
                    Key::Divisor(divisor) => divisor.clone(),
                    _ => Poly::atom(atom, 1),
                };
                inside = self.mul(&inside, &factor)?;
            }
        }
        for (prime, n) in factored(&k.abs()).ok_or(Undecided::Numbers)? {
            let whole = Rational::integer(prime)
                .pow(n.div_euclid(2))
                .ok_or(Undecided::Numbers)?;
            outside = outside.scale(&whole);
            if n.rem_euclid(2) == 1 {
                let radicand = Poly::integer(prime);
                let atom = self.function(Key::Root(2, radicand.clone()), Some((2, radicand)));
                outside = outside.times(&Monomial::atom(atom, 1));
            }
        }
        let inside = self.canonical(&inside)?;
        if inside.as_constant().is_some_and(|c| c.is_one()) {
            return Ok(outside);
        }
        let atom = self.function(Key::Root(2, inside.clone()), Some((2, inside)));
        self.mul(&outside, &Poly::atom(atom, 1))
    }

    /// ln|poly|: of a product the sum of its logarithms.
    fn logarithm(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let mut sum = Poly::default();
        let mut left = vec![(poly.clone(), Rational::ONE)];
        while let Some((poly, scale)) = left.pop() {
            let (k, monomial, rest) = self.content(&poly)?;
            for (prime, n) in factored(&k.abs()).ok_or(Undecided::Numbers)? {
                let atom = self.function(Key::Ln(Poly::integer(prime)), None);
                let n = scale.mul(&Rational::integer(i64::from(n)));
                sum = sum.add(&Poly::term(n, Monomial::atom(atom, 1)));
            }
            for &(atom, n) in &monomial.0 {
                let scale = scale.mul(&Rational::integer(i64::from(n)));
                match self.entry(atom).key.clone() {
                    Key::Exp(exponent) => sum = sum.add(&exponent.scale(&scale)),
                    Key::Root(degree, x) => {
                        left.push((x, scale.mul(&Rational::new(1, i64::from(degree)))))
                    }
                    Key::Sign(_) | Key::Function(Op::Pow, _) => {}
                    Key::Divisor(x) => left.push((x, scale)),
                    _ => {
                        let atom = self.function(Key::Ln(Poly::atom(atom, 1)), None);
                        sum = sum.add(&Poly::term(scale, Monomial::atom(atom, 1)));
                    }
                }
            }
            if rest.as_constant().is_none() {
                let atom = self.function(Key::Ln(rest), None);
                sum = sum.add(&Poly::term(scale, Monomial::atom(atom, 1)));
            }
        }
        Ok(sum)
    }

    /// The sign of a polynomial: of a product the product of its signs.
    pub(super) fn sign(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let mut sign = Poly::integer(1);
        // With the powers they are to.
        let mut left = vec![(poly.clone(), 1)];
        while let Some((poly, power)) = left.pop() {
            let (k, monomial, rest) = self.content(&poly)?;
            if k.is_zero() {
                return Ok(Poly::default());
            }
            if k.is_negative() && power % 2 != 0 {
                sign = sign.scale(&Rational::MINUS_ONE);
            }
            for &(atom, n) in &monomial.0 {
                let power = if n % 2 == 0 { 2 } else { power };
                let entry = self.entry(atom);
                if entry.sign == Sign::POSITIVE {
                    continue;
                }
                let factor = match entry.key.clone() {
                    // A sign and its powers.
                    Key::Sign(_) | Key::Function(Op::Pow, _) => Poly::atom(atom, power),
                    Key::Divisor(x) => self.sign_atom(&x, power),
                    Key::Root(_, x) => {
                        left.push((x, power));
                        continue;
                    }
                    _ => self.sign_atom(&Poly::atom(atom, 1), power),
                };
                sign = self.mul(&sign, &factor)?;
            }
            if rest.as_constant().is_none() && self.sign_of(&rest) != Sign::POSITIVE {
                let factor = self.sign_atom(&rest, power);
                sign = self.mul(&sign, &factor)?;
            }
        }
        self.canonical(&sign)
    }

    fn sign_atom(&mut self, of: &Poly, power: i32) -> Poly {
        let atom = self.function(Key::Sign(of.clone()), None);
        Poly::atom(atom, power)
    }
}

/// The prime factors of a positive rational with their exponents; the rest past 1000 counts as
/// prime. `None` for very large numbers.
fn factored(value: &Rational) -> Option<Vec<(i64, i32)>> {
    let (n, d) = value.to_small()?;
    let mut factors: Vec<(i64, i32)> = Vec::new();
    for (number, sign) in [(n, 1), (d, -1)] {
        let mut rest = number;
        for prime in (2..1000).take_while(|p| p * p <= number) {
            let mut count = 0;
            while rest % prime == 0 {
                rest /= prime;
                count += sign;
            }
            if count != 0 {
                factors.push((prime, count));
            }
        }
        if rest > 1 {
            factors.push((rest, sign));
        }
    }
    factors.arrange();
    Some(factors)
}

pub(super) fn lcm(a: i64, b: i64) -> i64 {
    (a / gcd(a, b)).saturating_mul(b)
}

/// The greatest common divisor of positive numbers.
pub(super) fn gcd(a: i64, b: i64) -> i64 {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    x
}
