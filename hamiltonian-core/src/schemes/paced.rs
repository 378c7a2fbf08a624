//! Variable steps that are reversible: the density of steps follows a function of the state.
//!
//! Input: a one-step scheme and a [`Density`]. Output: [`Paced`]. Invariant: the map is symmetric
//! in the point and the density together, so it adds no drift to that of a fixed step.

use crate::errors::Error;
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, OneStep, Scheme};
use crate::systems::flow::{Scratch, VectorField};
use crate::systems::state::{Carried, CarriedShape, Point, State};
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use crate::systems::vector::{Over, Shape, Vector};
use core::fmt::Debug;
use core::marker::PhantomData;
use hamiltonian_lanes::{Mask, Real};

/// The density of steps, Q(t, q, p) > 0, in any unit: steps are proportional to 1/Q.
///
/// Its method returns the rate d ln Q/dt along the orbit, given q̇ and ṗ. For Kepler's problem with
/// Q = r^(−3/2) it is −(3/2) q·q̇/q·q.
pub trait Density<S: System>: Clone + Debug + Send + Sync + 'static {
    /// d ln Q/dt at (t, q, p), where the velocity is (dq, dp). The vectors are those of the system, over any scalar.
    fn rate<T: Real>(
        &self,
        t: T,
        q: &VectorOf<S, T>,
        p: &VectorOf<S, T>,
        dq: &VectorOf<S, T>,
        dp: &VectorOf<S, T>,
    ) -> T;
}

/// A one-step scheme with variable steps, explicit and time-reversible.
///
/// With the run's step ε, the scheme's map Φ and G = d ln Q/dt, starting from ρ = 1,
///
/// ```text
/// ρ ← ρ + ½εG(z);   h = ε/ρ;   z ← Φₕ(z);   t ← t + h;   ρ ← ρ + ½εG(z)
/// ```
///
/// so the first step is about ε, and ρ stays near Q/Q(z₀). Time is carried: the run's clock counts ε, the
/// state shows the time itself. Preserves no form (steps depend on the state), but for reversible systems and symmetric Φ
/// it has no drift of H. A symplectic alternative is a change of time in the definition of the system.
///
/// Source: E. Hairer, G. Söderlind, SIAM J. Sci. Comput. 26 (2005) 1838, eq. 2.8,
/// doi:10.1137/040606995.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paced<M, G> {
    /// The scheme that makes the steps.
    scheme: M,
    /// The density of steps.
    density: G,
}

impl<M, G> Paced<M, G> {
    /// Returns the scheme that makes steps of `scheme` with this density.
    #[must_use]
    pub fn new(scheme: M, density: G) -> Self {
        Paced { scheme, density }
    }
}

impl<M: OneStep, G: Clone + Debug + Send + Sync + 'static> Listed for Paced<M, G> {
    fn entry(&self) -> Entry {
        let of = self.scheme.entry();
        Entry {
            name: "Paced",
            variant: of.name,
            equations: "",
            preserves: Form::Nothing,
            source: "Hairer, Söderlind 2005, eq. 2.8, doi:10.1137/040606995",
            ..of
        }
    }
}

/// The value that [`Paced`] and [`Adaptive`](super::Adaptive) carry: that of their scheme, with the density of steps ρ,
/// the rate G, the time, and further numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Pace<C: Vector, const N: usize = 3> {
    /// The value of the scheme.
    pub(super) of: C,
    /// ρ, G, t; if there are more, then the number of refused steps, ρ in the last step, and others.
    pub(super) numbers: [C::Scalar; N],
}

/// The shape of a [`Pace`], where `H` is that of what the scheme carries.
#[derive(Debug)]
pub struct PaceShape<H, const N: usize = 3>(PhantomData<H>);

impl<H: Shape, const N: usize> Shape for PaceShape<H, N> {
    type Vector<T: Real> = Pace<H::Vector<T>, N>;
}

impl<H: Shape, K: CarriedShape<H>, const N: usize> CarriedShape<H> for PaceShape<K, N> {
    type Of<T: Real> = Pace<K::Of<T>, N>;
}

impl<C: Vector, const N: usize> Vector for Pace<C, N> {
    type Scalar = C::Scalar;
    type Shape = PaceShape<C::Shape, N>;
    fn zeros_over<U: Real>(&self) -> Pace<Over<C, U>, N> {
        Pace {
            of: self.of.zeros_over(),
            numbers: [U::zero(); N],
        }
    }
    const PARTS: usize = C::PARTS + 1;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, k: usize) -> &[C::Scalar] {
        if k < C::PARTS {
            self.of.part(k)
        } else {
            &self.numbers
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_mut(&mut self, k: usize) -> &mut [C::Scalar] {
        if k < C::PARTS {
            self.of.part_mut(k)
        } else {
            &mut self.numbers
        }
    }
    fn zeros_like(&self) -> Self {
        Pace {
            of: self.of.zeros_like(),
            numbers: [C::Scalar::zero(); N],
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        Pace {
            of: self.of.take(),
            numbers: self.numbers,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_from(&mut self, other: &Self) {
        self.of.copy_from(&other.of);
        self.numbers = other.numbers;
    }
}

impl<C: Carried, const N: usize> Carried for Pace<C, N> {
    type Vector = C::Vector;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn point(&self) -> &Point<C::Vector> {
        self.of.point()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn time(&self, _: C::Scalar) -> C::Scalar {
        self.numbers[2]
    }
    /// The longer one of the last step, where that is carried, and the next.
    fn duration(&self, interval: C::Scalar) -> Option<C::Scalar> {
        let next = self.numbers[0];
        let least = match self.numbers.get(4) {
            Some(last) => C::Scalar::select(last.lt(next), *last, next),
            None => next,
        };
        Some(interval / least)
    }
    fn is_constant(&self) -> bool {
        let limit = self.numbers.get(5);
        limit.is_some_and(|limit| C::Scalar::zero().lt(*limit).all())
    }
    /// Constant steps become shorter where one is refused, and longer or varying by a pilot alone.
    fn steps_within(&self, interval: C::Scalar, time: C::Scalar) -> u64 {
        if !self.is_constant() {
            return 1;
        }
        // A conversion of NaN is 0.
        let steps = ((time / interval * self.numbers[0]).to_f64() as u64).max(1);
        steps.min(self.steps_to_pilot().map_or(SOON, |left| left.min(SOON)))
    }
    fn rescale(&mut self, by: C::Scalar) {
        // All but G, the times and the count are densities of steps.
        for k in [0, 4, 5, 7, 8] {
            if let Some(density) = self.numbers.get_mut(k) {
                *density *= by;
                // The inverse of an inverse: the parameter is the size itself.
                let is_one = (*density - C::Scalar::one()).magnitude() < 4.0 * C::Scalar::epsilon();
                if is_one {
                    *density = C::Scalar::one();
                }
            }
        }
    }
    fn refused(&self) -> u64 {
        self.numbers
            .get(3)
            .map_or(0, |refused| refused.to_f64() as u64)
    }
}

/// The number of steps from the start, or a refused step, until a pilot may choose anew.
pub(super) const SOON: u64 = 32;

impl<C: Vector, const N: usize> Pace<C, N> {
    /// The number of steps until a pilot may choose anew, if one will.
    pub(super) fn steps_to_pilot(&self) -> Option<u64> {
        let left = self.numbers.get(9)?.to_f64();
        (left > 0.0).then_some(left as u64)
    }
}

/// G at a point.
#[cfg_attr(not(unoptimised), inline(always))]
fn rate<T: Real, S: System, G: Density<S>>(
    density: &G,
    field: &<S::Prepared<T> as Dynamics<T>>::Field,
    t: T,
    point: &Point<VectorOf<S, T>>,
    velocity: &mut Point<VectorOf<S, T>>,
) -> T {
    velocity.set_zero();
    let Point { q: dq, p: dp } = velocity;
    field.add(t, &point.q, &point.p, dq, dp);
    density.rate(t, &point.q, &point.p, dq, dp)
}

impl<S, M, G> Scheme<S> for Paced<M, G>
where
    S: System,
    M: OneStep + Scheme<S, Carried = Point<S::Shape>>,
    G: Density<S>,
{
    type Carried = PaceShape<Point<S::Shape>>;
    type Map<T: Real> = Pacing<T, S, M, G>;
    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.scheme.times_of_jumps(of)
    }
    fn check<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
    ) -> Result<(), Error> {
        self.scheme.check(prepared, state)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Pacing {
            prepared: prepared.clone(),
            field: prepared.field(T::one()),
            scheme: self.scheme.clone(),
            density: self.density.clone(),
            epsilon: step.h,
            half: step.h * T::constant(0.5, 0.0),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Pace<Point<VectorOf<S, T>>> {
        let point = state.point();
        let mut velocity = point.zeros_like();
        let field = prepared.field(T::one());
        let rate = rate::<T, S, G>(&self.density, &field, state.t, &point, &mut velocity);
        Pace {
            of: point,
            numbers: [T::one(), rate, state.t],
        }
    }
}

/// The map of [`Paced`].
pub struct Pacing<T: Real, S: System, M, G> {
    prepared: S::Prepared<T>,
    field: <S::Prepared<T> as Dynamics<T>>::Field,
    scheme: M,
    density: G,
    epsilon: T,
    half: T,
}

/// The scratch of [`Pacing`].
pub struct PacingWork<V: Vector, W> {
    velocity: Point<V>,
    inner: W,
}

impl<V: Vector, W: Scratch<Point<V>>> Scratch<Pace<Point<V>>> for PacingWork<V, W> {
    fn like(like: &Pace<Point<V>>) -> Self {
        PacingWork {
            velocity: like.of.clone(),
            inner: W::like(&like.of),
        }
    }
}

impl<T, S, M, G> Map for Pacing<T, S, M, G>
where
    T: Real,
    S: System,
    M: OneStep + Scheme<S, Carried = Point<S::Shape>>,
    G: Density<S>,
{
    type Carried = Pace<Point<VectorOf<S, T>>>;
    type Work = PacingWork<VectorOf<S, T>, <M::Map<T> as Map>::Work>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, _: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        let [density, rate_here, t] = &mut z.numbers;
        *density += self.half * *rate_here;
        let h = self.epsilon / *density;
        let ends = [*t, *t + h];
        (self.scheme).step(&self.prepared, h, ends, &mut z.of, &mut work.inner);
        *t += h;
        *rate_here = rate::<T, S, G>(&self.density, &self.field, *t, &z.of, &mut work.velocity);
        *density += self.half * *rate_here;
        // There is no step for a density that is not positive.
        let gone = density.le(T::zero());
        *density = T::replaced(gone, T::constant(f64::NAN, 0.0), *density);
    }

    #[cold]
    fn explain(&self, _: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        let [density, rate_here, t] = &mut z.numbers;
        *density += self.half * *rate_here;
        let h = self.epsilon / *density;
        let map = self.scheme.prepare(&self.prepared, Step::of(h));
        map.explain(*t, *t + h, true, &mut z.of, &mut work.inner)
    }
}
