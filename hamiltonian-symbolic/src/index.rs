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

fn merge<K: Copy + Ord>(a: &[(K, i64)], b: &[(K, i64)], factor: i64) -> Vec<(K, i64)> {
    let mut all: Vec<(K, i64)> = a.to_vec();
    for &(k, v) in b {
        match all.iter_mut().find(|(key, _)| *key == k) {
            Some(entry) => entry.1 += v * factor,
            None => all.push((k, v * factor)),
        }
    }
    all.retain(|entry| entry.1 != 0);
    all.sort_unstable();
    all
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
    /// `self + factor·other`.
    #[must_use]
    pub fn plus(&self, factor: i64, other: &Affine) -> Affine {
        Affine {
            constant: self.constant + factor * other.constant,
            loops: merge(&self.loops, &other.loops, factor),
            sizes: merge(&self.sizes, &other.sizes, factor),
        }
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
        self.loops
            .iter()
            .find(|(d, _)| *d == domain)
            .map_or(0, |entry| entry.1)
    }
    /// The same with each loop variable replaced.
    #[must_use]
    pub fn substitute(&self, replace: &impl Fn(Domain) -> Affine) -> Affine {
        let rest = Affine {
            loops: Vec::new(),
            ..self.clone()
        };
        self.loops
            .iter()
            .fold(rest, |sum, &(d, k)| sum.plus(k, &replace(d)))
    }
    /// The loop variables as a bit set.
    #[must_use]
    pub fn variables(&self) -> u64 {
        self.loops.iter().fold(0, |set, (d, _)| set | 1 << d.0)
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
    pub fn substitute(&self, replace: &impl Fn(Domain) -> Affine) -> Index {
        let affine = self.affine.substitute(replace);
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
