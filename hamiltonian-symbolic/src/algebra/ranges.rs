//! Questions about indices in the loops around them.
//!
//! Input: indices and affine forms, and the ranges of loops. Output: statements that hold in every iteration,
//! whatever the sizes are. Invariant: a size is at least 0, and nothing more is known of it but, in proofs, that the
//! elements at fixed indices exist ([`Ranges::rooms`]).

use crate::index::{Affine, Domain, End, Index};
use crate::list::IntoList;
use crate::sort::Arrange;

/// The ranges of loops, and questions about indices in them.
pub trait Ranges {
    /// The range of a loop: the first value and one past the last.
    fn bounds(&self, domain: Domain) -> [&Affine; 2];

    /// The rooms: forms over sizes that are never negative, such as N − 3 for an array of N rows in which row 2 is read.
    fn rooms(&self) -> &[Affine] {
        &[]
    }

    /// The least or greatest value of a form over all iterations of its loops, as a form over sizes.
    fn extreme(&self, form: &Affine, end: End) -> Option<Affine> {
        form.eliminate(|domain, factor| end.of(self.bounds(domain), factor))
    }

    /// Returns true if a form is never negative, or never less than a room.
    fn is_never_negative(&self, form: &Affine) -> bool {
        let is_so = |form: &Affine| {
            let least = self.extreme(form, End::Least);
            least.is_some_and(|least| least.is_never_negative())
        };
        let mut beyond = self
            .rooms()
            .iter()
            .filter_map(|room| form.checked_plus(-1, room));
        is_so(form) || beyond.any(|rest| is_so(&rest))
    }

    /// Returns true if a form is always in `0..extent`.
    fn is_within(&self, form: &Affine, extent: &Affine) -> bool {
        let room = form.room_below(extent);
        self.is_never_negative(form) && room.is_some_and(|room| self.is_never_negative(&room))
    }

    /// Returns true if a loop is `i in 0..extent`.
    fn runs_over(&self, domain: Domain, extent: &Affine) -> bool {
        self.bounds(domain) == [&Affine::constant(0), extent]
    }

    /// The shift c, over sizes, of the index `(i + c) % n` in a loop over `0..n`: the iterations visit each
    /// element once.
    fn rotation(&self, index: &Index, domain: Domain) -> Option<Affine> {
        let runs = |modulo: &Affine| self.runs_over(domain, modulo);
        let is_periodic = index.outer.is_none() && index.modulo.as_ref().is_some_and(runs);
        index.affine.shift(domain).filter(|_| is_periodic)
    }

    /// The range of a loop without the iterations in which a form is negative; `None` where it is not that of one
    /// loop.
    fn narrowed(&self, domain: Domain, form: &Affine) -> Option<[Affine; 2]> {
        let [start, end] = self.bounds(domain);
        let (factor, rest) = form.isolated(domain);
        let [from, to] = match factor {
            // i ≥ −rest
            1 => [rest.times(-1)?, end.clone()],
            // i ≤ rest
            -1 => [start.clone(), rest.checked_plus(1, &Affine::constant(1))?],
            _ => return None,
        };
        let cut = [from.checked_plus(-1, start)?, end.checked_plus(-1, &to)?];
        let is_part = cut.iter().all(|cut| self.is_never_negative(cut));
        is_part.then_some([from, to])
    }

    /// Pairs of forms that must differ for two indices to differ in every iteration; `None` where that is not
    /// known.
    fn differ(&self, a: &Index, b: &Index) -> Option<Vec<[Affine; 2]>> {
        if a.outer.is_some() || b.outer.is_some() {
            return None;
        }
        let difference = a.affine.checked_plus(-1, &b.affine)?;
        let count = match (&a.modulo, &b.modulo) {
            (Some(a), Some(b)) if a != b => return None,
            // An index that is not taken modulo n is below n or differs from all that are.
            (Some(n), _) | (None, Some(n)) => n,
            (None, None) => {
                let sides = [difference.clone(), difference.times(-1)?];
                let zero = Affine::constant(0);
                let room = sides.map(|side| zero.room_below(&side));
                if room
                    .iter()
                    .flatten()
                    .any(|room| self.is_never_negative(room))
                {
                    return Some(Vec::new());
                }
                if difference.is_never_divisible() {
                    return Some(Vec::new());
                }
                let may_vary = difference.loops.is_empty() && difference.has_sizes();
                return may_vary.then(|| vec![[difference, zero]]);
            }
        };
        let distance = difference.remainder(count)?.unsigned_abs();
        if let Some(count) = count.as_constant() {
            let count = u64::try_from(count).ok().filter(|count| *count > 0)?;
            return (!distance.is_multiple_of(count)).then(Vec::new);
        }
        // On a ring of as many sites as a divisor of the distance the two are one.
        let divisors = (1..=distance).filter(|k| distance.is_multiple_of(*k));
        let pair = |divisor: u64| [count.clone(), Affine::constant(divisor as i64)];
        (1..=64)
            .contains(&distance)
            .then(|| divisors.map(pair).into_list())
    }

    /// The loops whose variables a form contains, with those that their ranges contain, outermost first.
    fn own_loops(&self, form: &Affine) -> Vec<Domain> {
        let mut own: Vec<Domain> = Vec::new();
        let mut forms = vec![form];
        while let Some(form) = forms.pop() {
            for (domain, _) in &form.loops {
                if !own.contains(domain) {
                    own.push(*domain);
                    forms.extend(self.bounds(*domain));
                }
            }
        }
        // A range reads only loops with smaller numbers.
        own.arrange();
        own
    }

    /// Returns true if `loops` run where a form has its extreme value. An inner loop may be empty there, for
    /// example `i in 0..n, j in i + 1..n` at `i = n - 1`.
    fn takes_place(&self, form: &Affine, end: End, loops: &[Domain]) -> bool {
        let mut chosen: Vec<(Domain, Affine)> = Vec::new();
        let followed = form.eliminate(|domain, factor| {
            let value = end.of(self.bounds(domain), factor)?;
            chosen.push((domain, value.clone()));
            Some(value)
        });
        let value = |domain: Domain, _| {
            let known = chosen.iter().find(|(other, _)| *other == domain);
            Some(
                known
                    .map_or(self.bounds(domain)[0], |(_, value)| value)
                    .clone(),
            )
        };
        let runs = |domain: &Domain| {
            let [start, end] = self.bounds(*domain);
            // Empty for all sizes: end − start − 1 < 0.
            let last = start.room_below(end).and_then(|last| last.eliminate(value));
            last.is_some_and(|last| !last.is_always_negative())
        };
        followed.is_some() && loops.iter().all(runs)
    }
}
