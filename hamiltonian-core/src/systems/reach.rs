//! Indices that are in range for some sizes only.
//!
//! Input: an index and the loops it runs in, affine, as numbers. Output: its least and greatest
//! value. Invariants: exact (an iteration that does not take place reaches nothing); usable in
//! constants, where sizes are const generics; the cost does not grow with the sizes for up to two
//! loops, nor where every loop runs at every iteration of those around it; otherwise loops outside
//! of the inner two are run.

use crate::errors::InputError;

/// An index that is affine in sizes and loop variables, in its loops.
///
/// A form is `[constant, factor of each size…, factor of each loop variable…]`.
#[derive(Debug, Clone, Copy)]
pub struct Reach<'a, const LOOPS: usize> {
    /// The sizes.
    pub sizes: &'a [usize],
    /// The first value of each loop, and one past the last, in sizes and the loops before it.
    pub loops: [[&'a [i64]; 2]; LOOPS],
    /// The index.
    pub index: &'a [i64],
}

impl<const LOOPS: usize> Reach<'_, LOOPS> {
    /// The index in an iteration that leaves `0..extent`, if there is one.
    #[must_use]
    pub const fn escape(&self, extent: usize) -> Option<i64> {
        let extremes = if self.no_loop_is_empty() {
            let mut index = (0, [0; LOOPS]);
            self.add(&mut index, 1, self.index);
            Some([self.at_ends(index, false), self.at_ends(index, true)])
        } else {
            self.extremes(0, [0; LOOPS])
        };
        match extremes {
            Some([least, _]) if least < 0 => Some(narrowed(least)),
            Some([_, greatest]) if greatest >= extent as i128 => Some(narrowed(greatest)),
            Some(_) | None => None,
        }
    }

    /// Returns true if the index stays in `0..extent`.
    #[must_use]
    pub const fn is_within(&self, extent: usize) -> bool {
        self.escape(extent).is_none()
    }

    /// Returns true if the first value of a range is not negative.
    #[must_use]
    pub const fn begins_at_0(&self) -> bool {
        self.is_within(usize::MAX)
    }

    /// Returns true if a sum of products of sizes is less than the largest `isize`: no array is longer, and `usize` has
    /// room for what is added to it.
    #[must_use]
    pub const fn fits(&self) -> bool {
        self.is_within(isize::MAX.unsigned_abs())
    }

    /// Returns an error if a sum of products of sizes is too large.
    ///
    /// # Errors
    /// [`InputError::Memory`]
    pub fn check_memory(&self, sum: &str) -> Result<(), InputError> {
        match self.fits() {
            true => Ok(()),
            false => Err(InputError::Memory { name: sum.into() }),
        }
    }

    /// Returns an error if `index` leaves `0..extent`.
    ///
    /// # Errors
    /// [`InputError::Index`]
    pub fn check(&self, index: &str, extent: usize) -> Result<(), InputError> {
        match self.escape(extent) {
            Some(reached) => Err(InputError::Index {
                expression: index.into(),
                reached,
                extent,
            }),
            None => Ok(()),
        }
    }

    /// Returns an error if the first value of `range` is negative.
    ///
    /// # Errors
    /// [`InputError::Range`]
    pub fn check_range(&self, range: &str) -> Result<(), InputError> {
        match self.escape(usize::MAX) {
            Some(first) if first < 0 => Err(InputError::Range {
                expression: range.into(),
                reached: first,
            }),
            Some(_) | None => Ok(()),
        }
    }

    /// The value of a form. The forms of a loop lack the factors of the loops inside it.
    const fn value(&self, form: &[i64], at: &[i128; LOOPS]) -> i128 {
        let mut value = form[0] as i128;
        let mut term = 1;
        while term < form.len() {
            let variable = if term <= self.sizes.len() {
                self.sizes[term - 1] as i128
            } else {
                at[term - 1 - self.sizes.len()]
            };
            value = value.saturating_add((form[term] as i128).saturating_mul(variable));
            term += 1;
        }
        value
    }

    /// Adds a multiple of a form to another, which is a number, the sizes being known, and the
    /// factors of loop variables.
    const fn add(&self, to: &mut (i128, [i128; LOOPS]), factor: i128, form: &[i64]) {
        to.0 =
            to.0.saturating_add(factor.saturating_mul(self.value(form, &[0; LOOPS])));
        let mut term = 1 + self.sizes.len();
        while term < form.len() {
            let level = term - 1 - self.sizes.len();
            to.1[level] = to.1[level].saturating_add(factor.saturating_mul(form[term] as i128));
            term += 1;
        }
    }

    /// The least or greatest value of a form, if no loop is ever empty: every variable stands at an
    /// end of its range then, the innermost first.
    const fn at_ends(&self, mut form: (i128, [i128; LOOPS]), greatest: bool) -> i128 {
        let mut level = LOOPS;
        while level > 0 {
            level -= 1;
            let factor = form.1[level];
            form.1[level] = 0;
            let [lower, upper] = self.loops[level];
            if (factor > 0) == greatest {
                self.add(&mut form, factor, upper);
                form.0 = form.0.saturating_sub(factor);
            } else {
                self.add(&mut form, factor, lower);
            }
        }
        form.0
    }

    /// Returns true if every loop runs at every iteration of the loops around it.
    const fn no_loop_is_empty(&self) -> bool {
        let mut level = 0;
        while level < LOOPS {
            let [lower, upper] = self.loops[level];
            let mut width = (0, [0; LOOPS]);
            self.add(&mut width, 1, upper);
            self.add(&mut width, -1, lower);
            // The loops around this one were checked before.
            if self.at_ends(width, false) < 1 {
                return false;
            }
            level += 1;
        }
        true
    }

    /// The first and the last value of a loop; the last is less if the loop is empty.
    const fn range(&self, level: usize, at: &[i128; LOOPS]) -> [i128; 2] {
        let [lower, upper] = self.loops[level];
        [
            self.value(lower, at),
            self.value(upper, at).saturating_sub(1),
        ]
    }

    /// Least and greatest value of the index, the loops outside of `level` being at `at`.
    const fn extremes(&self, level: usize, mut at: [i128; LOOPS]) -> Option<[i128; 2]> {
        if level == LOOPS {
            let value = self.value(self.index, &at);
            return Some([value, value]);
        }
        let [mut first, mut last] = self.range(level, &at);
        if level + 2 == LOOPS {
            [first, last] = self.not_empty(level, at, [first, last]);
        }
        if first > last {
            return None;
        }
        if level + 2 < LOOPS {
            let mut all = None;
            while first <= last {
                at[level] = first;
                all = joined(all, self.extremes(level + 1, at));
                first += 1;
            }
            return all;
        }
        // The ends are affine in this variable, so its own ends suffice.
        at[level] = first;
        let at_first = self.extremes(level + 1, at);
        at[level] = last;
        joined(at_first, self.extremes(level + 1, at))
    }

    /// The part of a range in which the next loop is not empty: its width is affine.
    const fn not_empty(
        &self,
        level: usize,
        mut at: [i128; LOOPS],
        [first, last]: [i128; 2],
    ) -> [i128; 2] {
        at[level] = 0;
        let [inner_first, inner_last] = self.range(level + 1, &at);
        let width = inner_last.saturating_sub(inner_first);
        at[level] = 1;
        let [inner_first, inner_last] = self.range(level + 1, &at);
        let slope = inner_last.saturating_sub(inner_first).saturating_sub(width);
        // width + slope·variable ≥ 0
        if slope > 0 {
            let from = -width.div_euclid(slope);
            [if from > first { from } else { first }, last]
        } else if slope < 0 {
            let to = width.div_euclid(-slope);
            [first, if to < last { to } else { last }]
        } else if width < 0 {
            [0, -1]
        } else {
            [first, last]
        }
    }
}

/// The product of sizes, or the largest `usize` where that is less.
#[must_use]
pub const fn product(sizes: &[usize]) -> usize {
    let (mut product, mut at) = (1_usize, 0);
    while at < sizes.len() {
        product = product.saturating_mul(sizes[at]);
        at += 1;
    }
    product
}

const fn joined(a: Option<[i128; 2]>, b: Option<[i128; 2]>) -> Option<[i128; 2]> {
    match (a, b) {
        (Some(a), Some(b)) => Some([
            if a[0] < b[0] { a[0] } else { b[0] },
            if a[1] > b[1] { a[1] } else { b[1] },
        ]),
        (one, None) => one,
        (None, other) => other,
    }
}

const fn narrowed(value: i128) -> i64 {
    if value > i64::MAX as i128 {
        i64::MAX
    } else if value < i64::MIN as i128 {
        i64::MIN
    } else {
        value as i64
    }
}
