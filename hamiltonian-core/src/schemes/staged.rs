//! Steps of methods whose stages may lie beside each other in lanes.
//!
//! Input: a map ([`StagedMap`]). Output: its steps. Invariant: the bits are those of the steps stage by stage.

use super::bundles::{Abreast, LEAST, Width};
use crate::flows::map::{Cause, Clock, Map, ScalarOf};

/// A map whose steps are computed stage by stage, or with several stages in the lanes of a pack.
pub(super) trait StagedMap<const S: usize>: Map {
    /// True if the stages may lie beside each other.
    fn has_bundles(&self) -> bool {
        true
    }

    /// Makes up to `n` steps after the first `made`, with so many stages beside each other, until one is not solved.
    /// Returns the number of steps made; `None` if there are no lanes.
    fn steps_beside<const WIDTH: usize>(
        &self,
        clock: Clock<ScalarOf<Self>>,
        made: u64,
        n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) -> Option<u64>
    where
        Abreast<WIDTH>: Width;

    /// Completes the step that was not solved in lanes.
    fn complete_unsolved(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work);

    /// Makes one step, stage by stage.
    fn solve(&self, t: ScalarOf<Self>, z: &mut Self::Carried, work: &mut Self::Work) -> Cause;

    /// Makes at least one and up to `n` steps after the first `made`, stage by stage. Returns the number of steps
    /// made.
    #[inline(always)]
    fn steps_apart(
        &self,
        clock: Clock<ScalarOf<Self>>,
        made: u64,
        _n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) -> u64 {
        self.solve(clock.at(made), z, work);
        1
    }

    /// Makes `n` steps after the first `from`, the stages beside each other where there are lanes for them.
    #[inline(always)]
    fn steps(
        &self,
        clock: Clock<ScalarOf<Self>>,
        from: u64,
        n: u64,
        z: &mut Self::Carried,
        work: &mut Self::Work,
    ) {
        let mut made = 0;
        while made < n && S >= LEAST && self.has_bundles() {
            let (before, left) = (from + made, n - made);
            let steps = if const { S.is_multiple_of(8) } {
                self.steps_beside::<8>(clock, before, left, z, work)
            } else {
                self.steps_beside::<4>(clock, before, left, z, work)
            };
            let Some(steps) = steps else {
                break;
            };
            made += steps;
            if made < n {
                self.complete_unsolved(clock.at(from + made), z, work);
                made += 1;
            }
        }
        while made < n {
            made += self.steps_apart(clock, from + made, n - made, z, work);
        }
    }
}
