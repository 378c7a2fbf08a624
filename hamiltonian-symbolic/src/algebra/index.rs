//! Indices of arrays and ranges of loops: affine in loop variables and sizes, optionally modulo a
//! size, one for each axis of an array.
//!
//! Input: what the front end resolved. Output: [`Affine`], [`Index`], [`Domain`] ids. Invariant:
//! terms sorted by variable, no zero coefficients, so that equal indices are equal values.

use crate::list::IntoList;
use crate::set::{MEMBERS, Member, Set};
use crate::sort::Arrange;
use num_integer::Integer;

/// A loop: a range in the context of an enclosing loop. Its number also names its variable.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Domain(pub u32);

/// A size known by name: a const generic or a run-time `usize` parameter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Size(pub u16);

/// The most loops that one arena tells apart.
pub const LOOPS: usize = MEMBERS;

/// The largest size at which the engine evaluates indices and ranges, to refute statements.
pub const TRIED: i64 = 256;

/// The invariant of indices and ranges at the sizes at which they are evaluated.
const FITS: &str = "a value of an index or a range fits 64 bits";

/// A set of loops.
pub type Loops = Set<Domain>;

impl Member for Domain {
    fn number(self) -> u32 {
        self.0
    }
    fn numbered(number: u32) -> Domain {
        Domain(number)
    }
}

/// `constant + Σ k·loop variable + Σ k·size + Σ k·(product of sizes)`.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Affine {
    /// The constant part.
    pub constant: i64,
    /// Loop variables with their factors, outermost loop first.
    pub loops: Vec<(Domain, i64)>,
    /// Sizes with their factors.
    pub sizes: Vec<(Size, i64)>,
    /// Products of two sizes or more, each in order, with their factors: the number of elements of an
    /// array with several axes.
    pub products: Vec<(Vec<Size>, i64)>,
}

/// The end of its range at which a form is taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The first value.
    Least,
    /// The last value.
    Greatest,
}

fn merge<K: Clone + Ord>(a: &[(K, i64)], factor: i64, b: &[(K, i64)]) -> Option<Vec<(K, i64)>> {
    let mut all = a.to_vec();
    for (key, k) in b {
        let k = k.checked_mul(factor)?;
        match all.binary_search_by(|entry| entry.0.cmp(key)) {
            Ok(at) => all[at].1 = all[at].1.checked_add(k)?,
            Err(at) => all.insert(at, (key.clone(), k)),
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
            products: merge(&self.products, factor, &other.products)?,
        })
    }
    /// The product of two forms over sizes; `None` where a coefficient overflows, or where one has
    /// loop variables.
    #[must_use]
    pub fn checked_times(&self, other: &Affine) -> Option<Affine> {
        let terms = |form: &Affine| {
            let sizes = form.sizes.iter().map(|(size, k)| (vec![*size], *k));
            let constant = (form.constant != 0).then(|| (Vec::new(), form.constant));
            let products = form.products.iter().cloned();
            constant
                .into_iter()
                .chain(sizes)
                .chain(products)
                .into_list()
        };
        let (a, b): (Vec<(Vec<Size>, i64)>, Vec<_>) = (terms(self), terms(other));
        let mut product = Affine::default();
        for (own, k) in &a {
            for (others, n) in &b {
                let mut sizes = [own.as_slice(), others].concat();
                sizes.arrange();
                let term = match *sizes.as_slice() {
                    [] => Affine::constant(1),
                    [size] => Affine::size(size),
                    _ => Affine {
                        products: vec![(sizes, 1)],
                        ..Affine::default()
                    },
                };
                product = product.checked_plus(k.checked_mul(*n)?, &term)?;
            }
        }
        (self.loops.is_empty() && other.loops.is_empty()).then_some(product)
    }
    /// Returns true if any size occurs.
    #[must_use]
    pub fn has_sizes(&self) -> bool {
        !(self.sizes.is_empty() && self.products.is_empty())
    }
    /// The sizes that occur, those in products too.
    pub fn all_sizes(&self) -> impl Iterator<Item = Size> {
        let products = self.products.iter().flat_map(|(sizes, _)| sizes);
        (self.sizes.iter().map(|(size, _)| size).chain(products)).copied()
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
        (self.loops.is_empty() && !self.has_sizes()).then_some(self.constant)
    }
    /// The value for given loop variables and sizes.
    ///
    /// # Panics
    /// If it needs more than 64 bits. The language refuses forms that do so for sizes up to [`TRIED`].
    pub fn value(&self, variable: &impl Fn(Domain) -> i64, size: &impl Fn(Size) -> i64) -> i64 {
        self.checked_value(variable, size).expect(FITS)
    }
    /// The value for given loop variables and sizes; `None` if it needs more than 64 bits.
    pub fn checked_value(
        &self,
        variable: &impl Fn(Domain) -> i64,
        size: &impl Fn(Size) -> i64,
    ) -> Option<i64> {
        // In 128 bits, terms of different signs may be larger than their sum.
        let wide = i128::from;
        let loops = (self.loops.iter()).map(|&(d, k)| Some(wide(k) * wide(variable(d))));
        let sizes = (self.sizes.iter()).map(|&(s, k)| Some(wide(k) * wide(size(s))));
        let products = self.products.iter().map(|(sizes, k)| {
            let mut sizes = sizes.iter();
            sizes.try_fold(wide(*k), |product, s| product.checked_mul(wide(size(*s))))
        });
        let mut terms = loops.chain(sizes).chain(products);
        let sum = terms.try_fold(wide(self.constant), |sum, term| sum.checked_add(term?));
        sum.and_then(|sum| i64::try_from(sum).ok())
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
    /// The factor of a size, or of a product of sizes in order.
    #[must_use]
    pub fn factor_of_sizes(&self, sizes: &[Size]) -> i64 {
        match sizes {
            [size] => self.factor_of_size(*size),
            _ => {
                let term = self.products.iter().find(|(own, _)| own == sizes);
                term.map_or(0, |(_, factor)| *factor)
            }
        }
    }
    /// `factor·self`; `None` where a coefficient overflows.
    #[must_use]
    pub fn times(&self, factor: i64) -> Option<Affine> {
        Affine::default().checked_plus(factor, self)
    }
    /// `end − 1 − self`, which is negative where the form is not below the end of a range; `None` where a
    /// coefficient overflows.
    #[must_use]
    pub fn room_below(&self, end: &Affine) -> Option<Affine> {
        end.checked_plus(-1, self)?
            .checked_plus(-1, &Affine::constant(1))
    }
    /// The factor of a loop variable, and the form without it.
    #[must_use]
    pub fn isolated(&self, domain: Domain) -> (i64, Affine) {
        let factor = self.factor(domain);
        (factor, self.plus(-factor, &Affine::variable(domain)))
    }
    /// The shift c of `domain + c`, over sizes.
    #[must_use]
    pub fn shift(&self, domain: Domain) -> Option<Affine> {
        let (factor, rest) = self.isolated(domain);
        (factor == 1 && rest.loops.is_empty()).then_some(rest)
    }
    /// The number that is left when multiples of a form over sizes are taken out, if a number is left.
    #[must_use]
    pub fn remainder(&self, of: &Affine) -> Option<i64> {
        let Some(&(size, k)) = of.sizes.first() else {
            return self.as_constant();
        };
        let own = self.factor_of_size(size);
        let rest = self.checked_plus(-(own / k), of)?;
        rest.as_constant()
    }
    /// The form with each loop variable replaced.
    #[must_use]
    pub fn substitute(&self, mut replace: impl FnMut(Domain) -> Affine) -> Affine {
        self.substituted(&mut replace)
    }
    fn substituted(&self, replace: &mut dyn FnMut(Domain) -> Affine) -> Affine {
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
    /// A number that a form over sizes is never below, where some sizes are known to be positive.
    pub fn least(&self, is_positive: impl Fn(Size) -> bool) -> Option<i64> {
        let positive = self.sizes.iter().filter(|(size, _)| is_positive(*size));
        let least = self.constant + positive.map(|(_, factor)| factor).sum::<i64>();
        self.factors_of_sizes()
            .all(|factor| factor >= 0)
            .then_some(least)
    }
    /// Returns true if a form over sizes is at least 0 whatever the sizes are.
    #[must_use]
    pub fn is_never_negative(&self) -> bool {
        self.least(|_| false).is_some_and(|least| least >= 0)
    }
    /// Returns true if a form over sizes is below 0 whatever the sizes are.
    #[must_use]
    pub fn is_always_negative(&self) -> bool {
        self.constant < 0 && self.factors_of_sizes().all(|factor| factor <= 0)
    }
    fn factors_of_sizes(&self) -> impl Iterator<Item = i64> {
        let products = self.products.iter().map(|(_, factor)| *factor);
        self.sizes.iter().map(|(_, factor)| *factor).chain(products)
    }
    /// Returns true if a number divides all factors and not the constant, so that the form is never 0: 2·i − 2·j − 1.
    #[must_use]
    pub fn is_never_divisible(&self) -> bool {
        let of_loops = self.loops.iter().map(|(_, factor)| *factor);
        let factors = of_loops.chain(self.factors_of_sizes());
        let common = factors.fold(0_i64, |common, factor| common.gcd(&factor));
        common != 0 && self.constant % common != 0
    }
    /// The loop variables as a bit set.
    #[must_use]
    pub fn variables(&self) -> Loops {
        self.loops.iter().map(|(domain, _)| *domain).collect()
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

/// An index: affine, optionally modulo a size (Euclidean). Of an array with several axes it is that of the
/// last one, with those of the axes before it.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Index {
    /// The affine part.
    pub affine: Affine,
    /// The modulus.
    pub modulo: Option<Affine>,
    /// The index of the axes before, of an array whose elements are counted row after row.
    pub outer: Option<Box<Outer>>,
}

/// The index of the axes before the last: the element is `index·extent + last index`.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Outer {
    /// The index of these axes.
    pub index: Index,
    /// The extent of the last axis, over sizes.
    pub extent: Affine,
}

impl Index {
    /// An index without modulus.
    #[must_use]
    pub fn plain(affine: Affine) -> Index {
        Index {
            affine,
            modulo: None,
            outer: None,
        }
    }
    /// The variable of a loop by itself.
    #[must_use]
    pub fn of_loop(domain: Domain) -> Index {
        Index::plain(Affine::variable(domain))
    }
    /// The loop whose variable the index is.
    #[must_use]
    pub fn as_loop(&self) -> Option<Domain> {
        let &[(domain, 1)] = self.affine.loops.as_slice() else {
            return None;
        };
        (*self == Index::of_loop(domain)).then_some(domain)
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
            && modulo.products.is_empty()
        {
            affine.sizes.retain(|(s, _)| *s != modulo.sizes[0].0);
        } else if let Some(m) = modulo.as_constant().filter(|m| *m > 0) {
            affine.constant = affine.constant.rem_euclid(m);
        }
        Index {
            affine,
            modulo: Some(modulo),
            outer: None,
        }
    }
    /// The element with the index `last` of an axis of that extent, in row `self`. Where all are
    /// numbers it is the number of the element, so that equal elements have equal indices.
    #[must_use]
    pub fn row_of(self, extent: Affine, last: Index) -> Index {
        if let (Some(row), Some(extent), Some(last)) =
            (self.as_constant(), extent.as_constant(), last.as_constant())
        {
            return Index::constant(row * extent + last);
        }
        let outer = Outer {
            index: self,
            extent,
        };
        Index {
            outer: Some(Box::new(outer)),
            ..last
        }
    }
    /// The index with that of each axis replaced, the axes before the last first; `None` where one has no
    /// image.
    pub fn try_map(&self, replace: &mut impl FnMut(&Index) -> Option<Index>) -> Option<Index> {
        let Some(outer) = &self.outer else {
            return replace(self);
        };
        let before = outer.index.try_map(replace)?;
        let last = replace(&self.last())?;
        Some(before.row_of(outer.extent.clone(), last))
    }
    /// The index of the last axis by itself.
    #[must_use]
    pub fn last(&self) -> Index {
        Index {
            affine: self.affine.clone(),
            modulo: self.modulo.clone(),
            outer: None,
        }
    }
    /// The indices of all axes, the first one first, each by itself.
    #[must_use]
    pub fn axes(&self) -> Vec<Index> {
        let mut axes = match &self.outer {
            Some(outer) => outer.index.axes(),
            None => Vec::new(),
        };
        axes.push(self.last());
        axes
    }
    /// A constant index.
    #[must_use]
    pub fn constant(value: i64) -> Index {
        Index::plain(Affine::constant(value))
    }
    /// The value, if it is a constant without modulus.
    #[must_use]
    pub fn as_constant(&self) -> Option<i64> {
        match (&self.modulo, &self.outer) {
            (None, None) => self.affine.as_constant(),
            _ => None,
        }
    }
    /// The value for given loop variables and sizes.
    ///
    /// # Panics
    /// As [`Affine::value`].
    pub fn value(&self, variable: &impl Fn(Domain) -> i64, size: &impl Fn(Size) -> i64) -> i64 {
        let value = self.affine.value(variable, size);
        let last = match &self.modulo {
            Some(modulo) => value.rem_euclid(modulo.value(variable, size).max(1)),
            None => value,
        };
        match &self.outer {
            Some(outer) => {
                let (index, extent) = (&outer.index, &outer.extent);
                let before = index.value(variable, size);
                let before = before.checked_mul(extent.value(variable, size));
                before.and_then(|n| n.checked_add(last)).expect(FITS)
            }
            None => last,
        }
    }
    /// The form with each loop variable replaced.
    #[must_use]
    pub fn substitute(&self, mut replace: impl FnMut(Domain) -> Affine) -> Index {
        self.substituted(&mut replace)
    }
    fn substituted(&self, replace: &mut dyn FnMut(Domain) -> Affine) -> Index {
        // The arena numbers loops as they are met: outer axes first.
        let before = (self.outer.as_ref())
            .map(|outer| (outer.index.substituted(replace), outer.extent.clone()));
        let affine = self.affine.substituted(replace);
        let last = match &self.modulo {
            Some(modulo) => Index::wrapped(affine, modulo.substituted(replace)),
            None => Index::plain(affine),
        };
        match before {
            Some((row, extent)) => row.row_of(extent, last),
            None => last,
        }
    }
    /// The loops whose variables it names.
    #[must_use]
    pub fn variables(&self) -> Loops {
        let modulo = self.modulo.as_ref().map(Affine::variables);
        let outer = self.outer.as_ref().map(|outer| outer.index.variables());
        self.affine.variables() | modulo.unwrap_or_default() | outer.unwrap_or_default()
    }
}
