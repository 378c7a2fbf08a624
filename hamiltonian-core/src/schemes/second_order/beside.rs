//! Steps of the second-order form whose stages lie beside each other in the lanes of a pack.
//!
//! Input: a map and the value that it carries. Output: the value after a number of steps. Invariant: the bits are those of
//! the steps stage by stage.

use super::{BundleScratch, CarriesForces, Eliminated, NystromTableau, Sums};
use crate::flows::map::Clock;
use crate::schemes::bundles::{
    Abreast, Beside, LEVELS, StageLayout, Width, bundles, copy, in_bundles, lay_in_bundles, load,
    resize, store,
};
use crate::schemes::staged::Inspect;
use crate::schemes::stages::Stages;
use crate::systems::system::Dynamics;
use crate::systems::system::gather::{InLanes, Kept};
use crate::systems::vector::{Over, Vector};
use hamiltonian_lanes::{Cpu, Level, Mask, Pack, Real};

/// The values that steps beside each other keep: ∂V/∂q at the stages, of this step and the one before; scratch, and the
/// matrices in bundles, for the size of the steps and before them for that of the map.
type KeptBeside<X, R, const S: usize> = (
    [Stages<X, S>; 2],
    BundleScratch<X, S>,
    [[[[R; S]; S]; 2]; 2],
);

/// Steps whose stages lie beside each other, until one is not solved or not accepted.
pub(super) struct NystromStepsBeside<
    'a,
    T: Real,
    P: Dynamics<T>,
    W,
    const S: usize,
    const WIDTH: usize,
> {
    pub(super) map: &'a Eliminated<T, P, S>,
    /// See [`StagedMap::steps_beside`](crate::schemes::staged::StagedMap::steps_beside).
    pub(super) sized: &'a Eliminated<T, P, S>,
    pub(super) clock: Clock<T>,
    /// The steps made before.
    pub(super) made: u64,
    pub(super) n: u64,
    pub(super) z: &'a mut CarriesForces<P::Vector, S>,
    pub(super) sums: &'a mut Sums<P::Vector>,
    pub(super) inspection: &'a mut W,
}

impl<T, Q, W, const S: usize, const WIDTH: usize> InLanes<T, Q::Vector>
    for NystromStepsBeside<'_, T, Q, W, S, WIDTH>
where
    T: Real,
    Q: Dynamics<T>,
    W: Inspect<T, Q::Vector, S>,
    Abreast<WIDTH>: Width,
{
    /// The number of steps made. The value carried is that after a step that was not accepted; that before one that was not
    /// solved, but for ∂V/∂q, which is NaN where steps are looked at.
    type Output = u64;
    type Pack<L: Level> = <Abreast<WIDTH> as Width>::Pack<L>;
    const LEVELS: [Cpu; 2] = LEVELS;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<P, D>(self, system: &D, kept: &mut Kept) -> u64
    where
        P: Pack,
        D: Dynamics<T::Over<P>, Vector = Over<Q::Vector, T::Over<P>>> + 'static,
    {
        let NystromStepsBeside {
            map,
            sized,
            clock,
            made,
            n,
            z,
            sums,
            inspection,
        } = self;
        let of_map = [
            in_bundles::<T, Beside<P, WIDTH>, S>(&sized.times),
            in_bundles::<T, Beside<P, WIDTH>, S>(&sized.weights),
            in_bundles::<T, Beside<P, WIDTH>, S>(&sized.ends),
        ];
        let mut rows = of_map;
        let (mut h, mut drifts) = (sized.h, sized.drifts);
        // The matrices too: a run of single steps would spend its time on clearing them.
        let ([gradients, before], stored, matrices) = kept.get(
            |_: &KeptBeside<D::Vector, T::Over<P>, S>| true,
            || {
                let zero = z.x.q.zeros_over::<T::Over<P>>();
                let gradients = Stages(core::array::from_fn(|_| zero.clone()));
                let gradients = [gradients.clone(), gradients];
                let matrices = [[[[T::Over::<P>::zero(); S]; S]; 2]; 2];
                (gradients, BundleScratch::new(&zero), matrices)
            },
        );
        let [matrices_of_map, double] = matrices;
        let laid = if W::LOOKS {
            &mut *matrices_of_map
        } else {
            &mut *double
        };
        for (to, from) in laid.iter_mut().zip(&sized.double) {
            lay_in_bundles::<T, Beside<P, WIDTH>, S>(from, to);
        }
        // Moved out, they are variables of this loop alone and may stay in registers.
        let (mut of, mut scratch) = (gradients.take(), stored.take());
        let (mut point, mut low) = (z.x.take(), z.y.y.take());
        let mut scalars = Sums {
            velocity: sums.velocity.take(),
            impulse: sums.impulse.take(),
            moved: sums.moved.take(),
        };
        load::<T, Beside<P, WIDTH>, _, _, S>(&z.y.x.0, &mut of.0);
        let (mut left, mut is_solved) = (n, true);
        let mut size = T::constant(f64::NAN, 0.0);
        while left > 0 && !inspection.ends() {
            if W::LOOKS && !inspection.size().equals(size).all() {
                size = inspection.size();
                h = sized.h * size;
                drifts = [sized.drifts[0] * size, sized.drifts[1] * size];
                let by = <Beside<P, WIDTH> as StageLayout<T>>::splat(size);
                for (from, to) in of_map.iter().zip(&mut rows) {
                    resize(by, from, to);
                }
                for (from, to) in matrices_of_map.iter().zip(double.iter_mut()) {
                    for bundle in 0..bundles::<T, Beside<P, WIDTH>, S>() {
                        resize(by, &from[bundle], &mut to[bundle]);
                    }
                }
            }
            let [times, weights, ends] = if W::LOOKS { &rows } else { &of_map };
            let tableau = NystromTableau {
                h,
                times,
                weights,
                double,
                ends,
                drifts,
            };
            let t = inspection.begins(clock, made + (n - left));
            if W::LOOKS {
                copy::<T, Beside<P, WIDTH>, _, S>(&of.0, &mut before.0);
                inspection.keep(&point, &low);
            }
            let outcome = map.fixed_point::<Beside<P, WIDTH>, _>(
                &tableau,
                system,
                t,
                &point,
                &mut of.0,
                &mut scratch,
                &mut scalars,
            );
            is_solved = outcome.solved.all();
            if !is_solved {
                inspection.refuse::<Beside<P, WIDTH>, _>(&before.0);
                break;
            }
            map.finish::<Beside<P, WIDTH>, _>(
                &tableau,
                t,
                &of.0,
                &mut point,
                &mut low,
                &mut scalars,
            );
            if !inspection.accepts::<Beside<P, WIDTH>, _>(&point, &of.0) {
                inspection.refuse::<Beside<P, WIDTH>, _>(&before.0);
                break;
            }
            left -= 1;
        }
        store::<T, Beside<P, WIDTH>, _, _, S>(&of.0, &mut z.y.x.0);
        if W::LOOKS && !is_solved {
            z.y.x.poison(T::Mask::splat(true));
        }
        (z.x, z.y.y) = (point, low);
        (*gradients, *stored, *sums) = (of, scratch, scalars);
        n - left
    }
}
