//! Steps of the second-order form whose stages lie beside each other in the lanes of a pack.
//!
//! Input: a map and the value that it carries. Output: the value after a number of steps. Invariant: the bits are those of
//! the steps stage by stage.

use super::{BundleScratch, CarriesForces, Eliminated, NystromTableau, Sums};
use crate::flows::map::Clock;
use crate::schemes::bundles::{
    Abreast, Beside, LEVELS, Width, copy, in_bundles, lay_in_bundles, load, store,
};
use crate::schemes::staged::Inspect;
use crate::schemes::stages::Stages;
use crate::systems::system::Dynamics;
use crate::systems::system::gather::{InLanes, Kept};
use crate::systems::vector::{Over, Vector};
use hamiltonian_lanes::{Cpu, Level, Mask, Pack, Real};

/// The values that steps beside each other keep: ∂V/∂q at the stages, of this step and the one before; scratch, and the
/// matrices in bundles.
type KeptBeside<X, R, const S: usize> = ([Stages<X, S>; 2], BundleScratch<X, S>, [[[R; S]; S]; 2]);

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
    /// The number of steps made. If it is less than `n`, the value carried is that before the step that was not solved or
    /// not accepted, but, where nothing is looked at, for ∂V/∂q.
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
            clock,
            made,
            n,
            z,
            sums,
            inspection,
        } = self;
        let times = in_bundles::<T, Beside<P, WIDTH>, S>(&map.times);
        let weights = in_bundles::<T, Beside<P, WIDTH>, S>(&map.weights);
        let ends = in_bundles::<T, Beside<P, WIDTH>, S>(&map.ends);
        // The matrices too: a run of single steps would spend its time on clearing them.
        let ([gradients, before], bundles, double) = kept.get(
            |_: &KeptBeside<D::Vector, T::Over<P>, S>| true,
            || {
                let zero = z.x.q.zeros_over::<T::Over<P>>();
                let gradients = Stages(core::array::from_fn(|_| zero.clone()));
                let gradients = [gradients.clone(), gradients];
                let double = [[[T::Over::<P>::zero(); S]; S]; 2];
                (gradients, BundleScratch::new(&zero), double)
            },
        );
        for (to, from) in double.iter_mut().zip(&map.double) {
            lay_in_bundles::<T, Beside<P, WIDTH>, S>(from, to);
        }
        let tableau = NystromTableau {
            times: &times,
            weights: &weights,
            double,
            ends: &ends,
            drifts: map.drifts,
        };
        // Moved out, they are variables of this loop alone and may stay in registers.
        let (mut of, mut scratch) = (gradients.take(), bundles.take());
        let (mut point, mut low) = (z.x.take(), z.y.y.take());
        let mut scalars = Sums {
            velocity: sums.velocity.take(),
            impulse: sums.impulse.take(),
            moved: sums.moved.take(),
        };
        load::<T, Beside<P, WIDTH>, _, _, S>(&z.y.x.0, &mut of.0);
        let mut left = n;
        while left > 0 {
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
            if !outcome.solved.all() {
                if W::LOOKS {
                    copy::<T, Beside<P, WIDTH>, _, S>(&before.0, &mut of.0);
                }
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
                inspection.undo(&mut point, &mut low);
                if W::LOOKS {
                    copy::<T, Beside<P, WIDTH>, _, S>(&before.0, &mut of.0);
                }
                break;
            }
            left -= 1;
        }
        store::<T, Beside<P, WIDTH>, _, _, S>(&of.0, &mut z.y.x.0);
        (z.x, z.y.y) = (point, low);
        (*gradients, *bundles, *sums) = (of, scratch, scalars);
        n - left
    }
}
