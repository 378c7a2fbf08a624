//! Indices of arrays and ranges of loops: affine in loop variables and sizes, optionally modulo a
//! size.
//!
//! Input: what the front end resolved. Output: [`Affine`], [`Index`], [`Domain`] ids. Invariant:
//! terms sorted by variable, no zero coefficients, so that equal indices are equal values.

/// A loop: a range in the context of an enclosing loop. Its number also names its variable.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Domain(pub u32);

/// A size known by name: a const generic or a run-time `usize` parameter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Size(pub u16);

/// The most loops that one arena tells apart: a set of them is the bits of a word.
pub const LOOPS: usize = 64;

/// The loops of a set.
pub fn members(set: u64) -> impl Iterator<Item = Domain> {
    (0..LOOPS as u32)
        .filter(move |number| set >> number & 1 == 1)
        .map(Domain)
}

/// `constant + Σ k·loop variable + Σ k·size`.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Affine {
    /// The constant part.
    pub constant: i64,
    /// Loop variables with their factors, outermost loop first.
    pub loops: Vec<(Domain, i64)>,
    /// Sizes with their factors.
    pub sizes: Vec<(Size, i64)>,
}

/// The end of its range at which a form is taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The first value.
    Least,
    /// The last value.
    Greatest,
}

fn merge<K: Copy + Ord>(a: &[(K, i64)], factor: i64, b: &[(K, i64)]) -> Option<Vec<(K, i64)>> {
    let mut all = a.to_vec();
    for &(key, k) in b {
        let k = k.checked_mul(factor)?;
        match all.binary_search_by_key(&key, |entry| entry.0) {
            Ok(at) => all[at].1 = all[at].1.checked_add(k)?,
            Err(at) => all.insert(at, (key, k)),
        }
    }
    all.retain(|entry| entry.1 != 0);
    Some(all)
}

fn factor<K: PartialEq>(terms: &[(K, i64)], wanted: K) -> i64 {
    let term = terms.iter().find(|(key, _)| *key == wanted);
    term.map_or(0, |(_, factor)| *factor)
}

impl Affine {
    /// A constant.
    #[must_use]
    pub fn constant(value: i64) -> Affine {
        Affine {
            constant: value,
            ..Affine::default()
        }
    }
    /// A loop variable.
    #[must_use]
    pub fn variable(domain: Domain) -> Affine {
        Affine {
            loops: vec![(domain, 1)],
            ..Affine::default()
        }
    }
    /// A size.
    #[must_use]
    pub fn size(size: Size) -> Affine {
        Affine {
            sizes: vec![(size, 1)],
            ..Affine::default()
        }
    }
    /// `self + factor·other`; `None` where a coefficient overflows.
    #[must_use]
    pub fn checked_plus(&self, factor: i64, other: &Affine) -> Option<Affine> {
        let constant = factor.checked_mul(other.constant)?;
        Some(Affine {
            constant: self.constant.checked_add(constant)?,
            loops: merge(&self.loops, factor, &other.loops)?,
            sizes: merge(&self.sizes, factor, &other.sizes)?,
        })
    }
    /// `self + factor·other`.
    ///
    /// # Panics
    /// If a coefficient overflows, which the macro reports as its own fault.
    #[must_use]
    pub fn plus(&self, factor: i64, other: &Affine) -> Affine {
        self.checked_plus(factor, other)
            .expect("coefficients of an index fit 64 bits")
    }
    /// The value, if it is a constant.
    #[must_use]
    pub fn as_constant(&self) -> Option<i64> {
        (self.loops.is_empty() && self.sizes.is_empty()).then_some(self.constant)
    }
    /// The value for given loop variables and sizes.
    pub fn value(&self, variable: &impl Fn(Domain) -> i64, size: &impl Fn(Size) -> i64) -> i64 {
        let loops: i64 = self.loops.iter().map(|&(d, k)| k * variable(d)).sum();
        let sizes: i64 = self.sizes.iter().map(|&(s, k)| k * size(s)).sum();
        self.constant + loops + sizes
    }
    /// The factor of a loop variable.
    #[must_use]
    pub fn factor(&self, domain: Domain) -> i64 {
        factor(&self.loops, domain)
    }
    /// The factor of a size.
    #[must_use]
    pub fn factor_of_size(&self, size: Size) -> i64 {
        factor(&self.sizes, size)
    }
    /// The same with each loop variable replaced.
    #[must_use]
    pub fn substitute(&self, mut replace: impl FnMut(Domain) -> Affine) -> Affine {
        let rest = Affine {
            loops: Vec::new(),
            ..self.clone()
        };
        self.loops
            .iter()
            .fold(rest, |sum, &(d, k)| sum.plus(k, &replace(d)))
    }
    /// The form over sizes alone that is left when loop variables are replaced from the innermost
    /// out: `choose` has for a variable and its factor a form over the loops around it. `None` where
    /// a coefficient overflows.
    pub fn eliminate(
        &self,
        mut choose: impl FnMut(Domain, i64) -> Option<Affine>,
    ) -> Option<Affine> {
        let mut form = self.clone();
        // A range reads only loops around it, which have smaller numbers.
        while let Some((domain, factor)) = form.loops.pop() {
            form = form.checked_plus(factor, &choose(domain, factor)?)?;
        }
        Some(form)
    }
    /// The least or greatest value over all iterations of its loops, given the range
    /// `lower..upper` of each, as a form over sizes.
    pub fn extreme<'a>(
        &self,
        end: End,
        mut range: impl FnMut(Domain) -> [&'a Affine; 2],
    ) -> Option<Affine> {
        self.eliminate(|domain, factor| end.of(range(domain), factor))
    }
    /// Whether a form over sizes is at least 0 whatever the sizes are.
    #[must_use]
    pub fn is_never_negative(&self) -> bool {
        self.constant >= 0 && self.sizes.iter().all(|(_, factor)| *factor >= 0)
    }
    /// Whether a form over sizes is below 0 whatever the sizes are.
    #[must_use]
    pub fn is_always_negative(&self) -> bool {
        self.constant < 0 && self.sizes.iter().all(|(_, factor)| *factor <= 0)
    }
    /// The loop variables as a bit set.
    #[must_use]
    pub fn variables(&self) -> u64 {
        self.loops.iter().fold(0, |set, (d, _)| set | 1 << d.0)
    }
}

impl End {
    /// The value of a loop variable in `lower..upper` at which its multiple by `factor` is at this
    /// end.
    #[must_use]
    pub fn of(self, [lower, upper]: [&Affine; 2], factor: i64) -> Option<Affine> {
        if (factor > 0) == (self == End::Greatest) {
            upper.checked_plus(-1, &Affine::constant(1))
        } else {
            Some(lower.clone())
        }
    }
}

/// An index: affine, optionally modulo a size (Euclidean).
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Index {
    /// The affine part.
    pub affine: Affine,
    /// The modulus.
    pub modulo: Option<Affine>,
}

impl Index {
    /// An index without modulus.
    #[must_use]
    pub fn plain(affine: Affine) -> Index {
        Index {
            affine,
            modulo: None,
        }
    }
    /// `affine % modulo`, with multiples of the modulus taken out.
    #[must_use]
    pub fn wrapped(affine: Affine, modulo: Affine) -> Index {
        let mut affine = affine;
        if let (Some(n), Some(m)) = (affine.as_constant(), modulo.as_constant())
            && m > 0
        {
            return Index::plain(Affine::constant(n.rem_euclid(m)));
        }
        if modulo.loops.is_empty()
            && modulo.constant == 0
            && modulo.sizes.len() == 1
            && modulo.sizes[0].1 == 1
        {
            affine.sizes.retain(|(s, _)| *s != modulo.sizes[0].0);
        } else if let Some(m) = modulo.as_constant().filter(|m| *m > 0) {
            affine.constant = affine.constant.rem_euclid(m);
        }
        Index {
            affine,
            modulo: Some(modulo),
        }
    }
    /// A constant index.
    #[must_use]
    pub fn constant(value: i64) -> Index {
        Index::plain(Affine::constant(value))
    }
    /// The value, if it is a constant without modulus.
    #[must_use]
    pub fn as_constant(&self) -> Option<i64> {
        match self.modulo {
            None => self.affine.as_constant(),
            Some(_) => None,
        }
    }
    /// The value for given loop variables and sizes.
    pub fn value(&self, variable: &impl Fn(Domain) -> i64, size: &impl Fn(Size) -> i64) -> i64 {
        let value = self.affine.value(variable, size);
        match &self.modulo {
            Some(modulo) => value.rem_euclid(modulo.value(variable, size).max(1)),
            None => value,
        }
    }
    /// The same with each loop variable replaced.
    #[must_use]
    pub fn substitute(&self, mut replace: impl FnMut(Domain) -> Affine) -> Index {
        let affine = self.affine.substitute(&mut replace);
        match &self.modulo {
            Some(modulo) => Index::wrapped(affine, modulo.substitute(replace)),
            None => Index::plain(affine),
        }
    }
    /// The loop variables as a bit set.
    #[must_use]
    pub fn variables(&self) -> u64 {
        self.affine.variables() | self.modulo.as_ref().map_or(0, Affine::variables)
    }
}
