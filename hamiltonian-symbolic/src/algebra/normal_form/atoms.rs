//! The atoms of an algebra, which its polynomials are made of.
//!
//! Input: leaves and functions of polynomials. Output: [`Atom`] numbers. Invariant: an atom's
//! arguments are made of atoms with smaller numbers; an atom either is algebraically independent
//! of those or has its relation here.

use super::polynomial::{Atom, Budget, Monomial, Poly, Undecided};
use crate::dag::{Dag, Dependence, Map, Node, Partial, Sign};
use crate::index::{Domain, Loops};
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;
use crate::sort::Arrange;
use std::rc::Rc;

/// The kind of an atom.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Key {
    /// A variable, a parameter, π, a size.
    Leaf(Node),
    /// The cosine of a base angle.
    Cos(Poly),
    /// The sine of a base angle; its square is 1 − cos².
    Sin(Poly),
    /// e to a base exponent.
    Exp(Poly),
    /// A square or cube root; its square or cube is the polynomial.
    Root(u32, Poly),
    /// The logarithm of an absolute value.
    Ln(Poly),
    /// The sign, −1, 0 or 1: its rules are with [`Algebra::canonical`].
    Sign(Poly),
    /// 1/polynomial: this atom stands for the polynomial, and only negative powers of it occur.
    Divisor(Poly),
    /// Any other function.
    Function(Op, Vec<Poly>),
    /// A function written in Rust, or a derivative of it.
    External(u16, Partial, Vec<Poly>),
    /// A sum over a loop of a product that depends on its variable.
    Sum(Domain, Monomial),
}

impl Key {
    /// The atoms it is made of.
    fn parts(&self) -> Vec<Atom> {
        match self {
            Key::Leaf(_) => Vec::new(),
            Key::Cos(x)
            | Key::Sin(x)
            | Key::Exp(x)
            | Key::Root(_, x)
            | Key::Ln(x)
            | Key::Sign(x)
            | Key::Divisor(x) => x.atoms(),
            Key::Function(_, arguments) | Key::External(_, _, arguments) => {
                arguments.iter().flat_map(Poly::atoms).into_list()
            }
            Key::Sum(_, body) => body.0.iter().map(|(atom, _)| *atom).into_list(),
        }
    }
}

/// The points at which a statement is to hold, for all parameters and sizes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Scope {
    /// At every point.
    Everywhere,
    /// At points that come near to every point.
    Densely,
}

/// An atom with its facts.
#[derive(Clone, Debug)]
pub(crate) struct AtomEntry {
    /// The expression it stands for.
    pub(crate) key: Key,
    /// `atom^n = polynomial`
    pub(crate) relation: Option<(u32, Rc<Poly>)>,
    /// The polynomial that took its place, when a finer base was needed.
    pub(crate) redefined: Option<Rc<Poly>>,
    /// Its dependences.
    pub(crate) dependence: Dependence,
    /// The loop variables it depends on.
    pub(crate) variables: Loops,
    /// The signs that it may have.
    pub(crate) sign: Sign,
}

/// The base that angles or exponents with one monomial are multiples of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Base {
    /// The base is the monomial times this.
    pub(super) numerator: i64,
    /// And over this.
    pub(super) denominator: i64,
    /// Its cosine, or its exponential.
    pub(super) first: Atom,
    /// Its sine.
    pub(super) second: Atom,
}

/// How often a loop runs.
#[derive(Clone, Debug)]
pub(super) struct Runs {
    /// The number of its iterations.
    pub(super) count: Poly,
    /// The first value and one past the last, if that is nowhere less.
    pub(super) ends: Option<[Poly; 2]>,
}

/// An algebra over the leaves of one arena.
#[derive(Debug)]
pub(crate) struct Algebra {
    entries: Vec<AtomEntry>,
    known: Map<Key, Atom>,
    pub(super) angles: Map<Monomial, Base>,
    pub(super) exponents: Map<Monomial, Base>,
    pub(super) converted: Map<Node, Rc<Poly>>,
    /// How often loops run, as far as that was asked for ([`Algebra::count`]).
    pub(super) runs: Map<Domain, Runs>,
    /// Arguments of functions so far, with whether they have divisors.
    pub(super) arguments: Vec<(Poly, bool)>,
    /// How often an atom was redefined.
    pub(super) redefined: usize,
    /// True if a condition guards a fraction, which may be undefined where the condition is false.
    pub(super) any_guarded: bool,
    /// True if an expression is read that may be undefined where the statement is not or, in statements about
    /// all points, that distinguishes single points.
    pub(super) has_conditions: bool,
    /// True if an expression is read that has elements the statement does not read.
    pub(super) has_unread: bool,
    /// The points at which statements are to hold.
    pub(super) scope: Scope,
    /// The rest of the budget.
    pub(crate) budget: Budget,
    /// The limit at which a rule was left out.
    pub(crate) left_out: Option<Undecided>,
}

impl Algebra {
    /// An empty algebra.
    pub(crate) fn new(budget: Budget, scope: Scope) -> Algebra {
        Algebra {
            entries: Vec::new(),
            known: Map::default(),
            angles: Map::default(),
            exponents: Map::default(),
            converted: Map::default(),
            runs: Map::default(),
            arguments: Vec::new(),
            redefined: 0,
            any_guarded: false,
            has_conditions: false,
            has_unread: false,
            scope,
            budget,
            left_out: None,
        }
    }

    /// The facts of an atom.
    pub(crate) fn entry(&self, atom: Atom) -> &AtomEntry {
        &self.entries[atom as usize]
    }

    pub(super) fn redefine(&mut self, atom: Atom, as_what: Poly) {
        self.entries[atom as usize].redefined = Some(Rc::new(as_what));
        self.redefined += 1;
    }

    /// The atom of a leaf.
    pub(crate) fn leaf(&mut self, dag: &Dag, node: Node) -> Atom {
        let own = (dag.dependence(node), dag.variables(node));
        self.atom(Key::Leaf(node), None, own, dag.sign(node))
    }

    /// The atom of a function of polynomials, with its relation.
    pub(super) fn function(&mut self, key: Key, relation: Option<(u32, Poly)>) -> Atom {
        let sign = match &key {
            Key::Exp(_) => Sign::POSITIVE,
            Key::Root(2, x) => self.sign_of(x).root(),
            Key::Root(_, x) | Key::Divisor(x) | Key::Sign(x) => self.sign_of(x),
            Key::Function(op, arguments) => Sign::of_call(*op, self.sign_of(&arguments[0])),
            _ => Sign::UNKNOWN,
        };
        self.atom(key, relation, Default::default(), sign)
    }

    /// The atom of a sum over a loop.
    pub(crate) fn sum(&mut self, dag: &Dag, domain: Domain, body: Monomial) -> Atom {
        let range = dag.range(domain);
        let has_sizes = range.start.has_sizes() || range.end.has_sizes();
        let own = if has_sizes {
            Dependence::PARAMETER
        } else {
            Dependence::default()
        };
        let variables = range.start.variables() | range.end.variables();
        // The range may be empty.
        let sign = self.sign_of_term(&body, &Rational::ONE).or(Sign::ZERO);
        self.atom(Key::Sum(domain, body), None, (own, variables), sign)
    }

    /// The atom of a key, with its dependences beside those of its parts, and its sign.
    fn atom(
        &mut self,
        key: Key,
        relation: Option<(u32, Poly)>,
        (mut dependence, mut variables): (Dependence, Loops),
        sign: Sign,
    ) -> Atom {
        if let Some(&atom) = self.known.get(&key) {
            return atom;
        }
        for part in key.parts() {
            dependence.0 |= self.entry(part).dependence.0;
            variables |= self.entry(part).variables;
        }
        if let Key::Sum(domain, _) = key {
            variables = variables.without(Loops::of(domain));
        }
        let atom = self.entries.len() as Atom;
        self.known.insert(key.clone(), atom);
        self.entries.push(AtomEntry {
            key,
            relation: relation.map(|(n, poly)| (n, Rc::new(poly))),
            redefined: None,
            dependence,
            variables,
            sign,
        });
        atom
    }

    /// The signs that a polynomial may have, by its terms.
    pub(crate) fn sign_of(&self, poly: &Poly) -> Sign {
        let terms = poly.terms().iter();
        terms.fold(Sign::ZERO, |sum, (m, k)| sum.plus(self.sign_of_term(m, k)))
    }

    fn sign_of_term(&self, term: &Monomial, k: &Rational) -> Sign {
        let factors = term.0.iter();
        Sign::of_product(k, factors.map(|(atom, n)| (self.entry(*atom).sign, *n)))
    }

    /// Returns true if zeros of a polynomial do not count. It has few, whatever the parameters, if it is a
    /// polynomial in something that moves with a number for its leading coefficient.
    pub(crate) fn is_anything_but_zero(&self, poly: &Poly) -> bool {
        let moves = |atom: &Atom| {
            let entry = self.entry(*atom);
            matches!(entry.key, Key::Leaf(_)) && entry.dependence.on(Dependence::MOVING)
        };
        // Elements of a loop may be the same one.
        let atoms = poly.atoms();
        let is_fixed =
            atoms.len() == 1 || atoms.iter().all(|a| self.entry(*a).variables.is_empty());
        self.scope == Scope::Densely
            && is_fixed
            && atoms.into_iter().filter(moves).any(|atom| {
                let powers = poly.by_power(atom);
                let leading = powers.last().and_then(|(_, k)| k.as_constant());
                powers[0].0 >= 0 && leading.is_some() && !self.is_mentioned(poly, atom)
            })
    }

    /// Returns true if an atom stands inside another one.
    pub(crate) fn is_mentioned(&self, poly: &Poly, atom: Atom) -> bool {
        let mut others = poly.atoms();
        others.retain(|other| *other != atom);
        self.needed(others).contains(&atom)
    }

    /// Atoms and all atoms they are made of, oldest first.
    pub(super) fn needed(&self, wanted: Vec<Atom>) -> Vec<Atom> {
        let mut needed: Vec<Atom> = Vec::new();
        let mut stack = wanted;
        let mut seen: Map<Atom, ()> = Map::default();
        while let Some(atom) = stack.pop() {
            if seen.insert(atom, ()).is_none() {
                needed.push(atom);
                stack.extend(self.entry(atom).key.parts());
            }
        }
        needed.arrange();
        needed
    }

    /// Returns true if a polynomial has negative powers.
    pub(super) fn is_divided(poly: &Poly) -> bool {
        let terms = poly.terms();
        terms.iter().any(|(m, _)| m.0.iter().any(|(_, n)| *n < 0))
    }

    /// The dependences of a polynomial.
    pub(crate) fn dependence(&self, monomial: &Monomial) -> Dependence {
        Dependence(
            monomial
                .0
                .iter()
                .fold(0, |set, (atom, _)| set | self.entry(*atom).dependence.0),
        )
    }

    /// The product, within the budget.
    pub(crate) fn mul(&mut self, a: &Poly, b: &Poly) -> Result<Poly, Undecided> {
        a.mul(b, &mut self.budget)
    }

    /// A power of any sign.
    pub(crate) fn pow(&mut self, poly: &Poly, n: i32) -> Result<Poly, Undecided> {
        let base = if n < 0 {
            self.invert(poly)?
        } else {
            poly.clone()
        };
        base.pow(n.unsigned_abs(), &mut self.budget)
    }

    /// 1/polynomial: a term is inverted atom by atom, anything longer becomes a divisor.
    pub(crate) fn invert(&mut self, poly: &Poly) -> Result<Poly, Undecided> {
        let (k, monomial, rest) = self.content(poly)?;
        let k = k.recip().ok_or(Undecided::Zero)?;
        let mut inverse = Poly::constant(k);
        for &(atom, n) in &monomial.0 {
            let factor = match &self.entry(atom).key {
                // The reciprocal of a divisor is what it divides by.
                Key::Divisor(divisor) if n < 0 => {
                    let divisor = divisor.clone();
                    divisor.pow(n.unsigned_abs(), &mut self.budget)?
                }
                _ => Poly::atom(atom, n.saturating_neg()),
            };
            inverse = self.mul(&inverse, &factor)?;
        }
        if rest.as_constant().is_none() {
            let divisor = self.function(Key::Divisor(rest), None);
            inverse = inverse.times(&Monomial::atom(divisor, -1));
        }
        Ok(inverse)
    }

    /// The rational and monomial factors that all terms share, and what is left: 1, or a
    /// polynomial of several terms without negative powers whose last term has the coefficient 1.
    pub(crate) fn content(&mut self, poly: &Poly) -> Result<(Rational, Monomial, Poly), Undecided> {
        let mut rest = self.canonical(poly)?;
        if self.any_guarded && rest.terms().len() > 1 && Algebra::is_divided(&rest) {
            // 1 + [x > 0]/x is 1 at x = 0, where a common denominator would be 0.
            return Err(Undecided::Conditions);
        }
        let mut monomial = Monomial::default();
        // Divisors inside are cleared: 1/(1 + 1/d) is d/(d + 1).
        loop {
            let divisor = rest
                .atoms()
                .into_iter()
                .rev()
                .find(|atom| matches!(self.entry(*atom).key, Key::Divisor(_)));
            let Some(atom) = divisor else { break };
            let (lowest, cleared) = self.cleared(&rest, atom)?;
            monomial = monomial.mul(&Monomial::atom(atom, lowest));
            rest = self.canonical(&cleared)?;
        }
        for atom in rest.atoms() {
            let lowest = rest
                .terms()
                .iter()
                .map(|(m, _)| m.exponent(atom))
                .min()
                .unwrap_or(0);
            if lowest != 0 {
                monomial = monomial.mul(&Monomial::atom(atom, lowest));
                rest = rest.times(&Monomial::atom(atom, lowest.saturating_neg()));
            }
        }
        rest = self.canonical(&rest)?;
        let k = rest
            .terms()
            .last()
            .map_or(Rational::ZERO, |(_, k)| k.clone());
        if let Some(recip) = k.recip() {
            rest = rest.scale(&recip);
        }
        if let Some((left, one)) = rest.as_term() {
            let k = k.mul(one);
            return Ok((k, monomial.mul(&left.clone()), Poly::integer(1)));
        }
        Ok((k, monomial, rest))
    }
}
