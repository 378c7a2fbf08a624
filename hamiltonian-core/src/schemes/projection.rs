//! Explicit schemes on two copies that are brought together after every step.
//!
//! Input: a system without forces and a table of weights. Output: [`MidpointProjected`], [`Mixed`]. Invariant: a step is
//! the splitting of H(q, p̃) + H(q̃, p), and then a mean of both copies.

use super::extended::{Copies, Cross, Doubled};
use super::splitting::Splitting;
use super::zigzag::Zigzag;
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme, Symmetric};
use crate::systems::state::{Pair, State};
use crate::systems::system::{System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// The splitting of H(q, p̃) + H(q̃, p) by the table `W`.
pub(super) type Inner<T, S, W> = Doubled<T, S, Cross<false>, Cross<true>, W>;

/// That splitting for a step `h`.
pub(super) fn inner<T: Real, S: System, W: Splitting>(
    table: &W,
    prepared: &S::Prepared<T>,
    h: T,
) -> Inner<T, S, W> {
    Zigzag::new(
        table,
        &(Cross::<false>, Cross::<true>),
        prepared,
        Step::of(h),
    )
}

/// Two copies from the point, moved by a splitting of the doubled space, and their mean: explicit for
/// every H, of the order of the table.
///
/// With Ψ the splitting of H(q, p̃) + H(q̃, p) by the table `M`,
///
/// ```text
/// (a, b) = Ψ(z[n], z[n]);   z[n+1] = (a + b)/2
/// ```
///
/// dq∧dp is *not* preserved, but nearly: a step of order p violates it by O(h^(2p+2))
/// (pseudo-symplectic), because the copies separate by O(h^(p+1)). The first copy before the
/// projection is carried besides the point:
/// [`Integrator::copy_distance`](crate::Integrator::copy_distance) is half of |a − b|, an estimate
/// of the error of the last step that costs nothing.
///
/// Source: J. Luo, X. Wu, G. Huang, F. Liu, Astrophys. J. 834 (2017) 64,
/// doi:10.3847/1538-4357/834/1/64.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::MidpointProjected;
///
/// let start = State::new([1.0], [0.0]);
/// let scheme = MidpointProjected::<KahanLi8>::default();
/// let mut run = Integrator::new(&Oscillator {}, scheme, start, 0.1)?;
/// assert!((run.advance(100)?.q[0] - 10.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MidpointProjected<M>(pub M);

impl<M: Default> Default for MidpointProjected<M> {
    /// The default of the table.
    fn default() -> Self {
        MidpointProjected(M::default())
    }
}

impl<M: Splitting> Listed for MidpointProjected<M> {
    fn entry(&self) -> Entry {
        let of = self.0.entry();
        Entry {
            name: "MidpointProjected",
            variant: of.name,
            needs: Needs::UNFORCED,
            preserves: Form::Nearly,
            source: "Luo, Wu, Huang, Liu 2017, doi:10.3847/1538-4357/834/1/64",
            ..of
        }
    }
}

impl<M: Splitting + Symmetric> OneStep for MidpointProjected<M> {
    type Adjoint = super::Adjoint<Self>;
    fn adjoint(&self) -> Self::Adjoint {
        super::Adjoint(*self)
    }
}

impl<S: System + Unforced, M: Splitting> Scheme<S> for MidpointProjected<M> {
    type Carried = Copies<S::Shape>;
    type Map<T: Real> = Averaged<Inner<T, S, M>>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Averaged(inner::<T, S, M>(&self.0, prepared, step.h))
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Copies<VectorOf<S, T>> {
        Pair {
            x: state.point(),
            y: state.point(),
        }
    }
}

/// The map of [`MidpointProjected`].
#[derive(Debug, Clone)]
pub struct Averaged<M>(M);

impl<V: Vector, M: Map<Carried = Copies<V>>> Map for Averaged<M> {
    type Carried = Copies<V>;
    type Work = M::Work;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Copies<V>, work: &mut M::Work) {
        z.y.copy_from(&z.x);
        self.0.step(t, end, z, work);
        let half = V::Scalar::constant(0.5, 0.0);
        z.x.scale(half);
        z.x.accumulate(half, &z.y);
    }

    #[cold]
    fn explain(
        &self,
        t: V::Scalar,
        end: V::Scalar,
        _: bool,
        z: &mut Copies<V>,
        work: &mut M::Work,
    ) -> Cause {
        z.y.copy_from(&z.x);
        self.0.explain(t, end, true, z, work)
    }
}

/// Two copies that are mixed after every step: Pihajoki's scheme by any table, with his mixing maps.
///
/// ```text
/// (z, z̃) ← Ψ(z, z̃);   q ← αq + (1 − α)q̃,  q̃ ← (1 − α)q + αq̃;   p, p̃ likewise with β
/// ```
///
/// Without mixing, α = β = 1, it is [`Pihajoki`](super::Pihajoki); 0 exchanges halves of the
/// copies, ½ makes them equal; ½ for both is [`MidpointProjected`]. The copies are carried. Mixing
/// keeps them together, and does not preserve the form dq∧dp + dq̃∧dp̃ unless α = β = 1 or α = β =
/// 0.
///
/// Source: P. Pihajoki, Celest. Mech. Dyn. Astron. 121 (2015) 211, section 3.2,
/// doi:10.1007/s10569-014-9597-9.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Mixed;
///
/// let start = State::new([1.0], [0.0]);
/// let scheme = Mixed::new(Strang).with_weights(1.0, 0.5);
/// let mut run = Integrator::new(&Oscillator {}, scheme, start, 0.01)?;
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 1e-4);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixed<M> {
    /// The splitting of the doubled space.
    table: M,
    /// α.
    coordinates: f64,
    /// β.
    momenta: f64,
}

impl<M: Default> Default for Mixed<M> {
    /// Coordinates as they are, momenta averaged.
    fn default() -> Self {
        Mixed::new(M::default())
    }
}

impl<M> Mixed<M> {
    /// Returns the scheme that leaves coordinates as they are and averages momenta.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// use hamiltonian::schemes::Mixed;
    ///
    /// assert_eq!(Mixed::new(Strang), Mixed::default().with_weights(1.0, 0.5));
    /// ```
    #[must_use]
    pub fn new(table: M) -> Self {
        Mixed {
            table,
            coordinates: 1.0,
            momenta: 0.5,
        }
    }

    /// α, the weight of the first copy's coordinates, and β, that of its momenta; 1 and ½ by default.
    #[must_use]
    pub fn with_weights(self, coordinates: f64, momenta: f64) -> Self {
        Mixed {
            coordinates,
            momenta,
            ..self
        }
    }
}

impl<M: Splitting> Listed for Mixed<M> {
    fn entry(&self) -> Entry {
        let of = self.table.entry();
        Entry {
            name: "Mixed",
            variant: of.name,
            needs: Needs::UNFORCED,
            preserves: Form::Nothing,
            source: "Pihajoki 2015, section 3.2, doi:10.1007/s10569-014-9597-9",
            ..of
        }
    }
}

impl<S: System + Unforced, M: Splitting> Scheme<S> for Mixed<M> {
    type Carried = Copies<S::Shape>;
    type Map<T: Real> = Mixing<Inner<T, S, M>, T>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Mixing {
            inner: inner::<T, S, M>(&self.table, prepared, step.h),
            coordinates: T::constant(self.coordinates, 0.0),
            momenta: T::constant(self.momenta, 0.0),
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Copies<VectorOf<S, T>> {
        Pair {
            x: state.point(),
            y: state.point(),
        }
    }
}

/// The map of [`Mixed`].
#[derive(Debug, Clone)]
pub struct Mixing<M, T> {
    inner: M,
    coordinates: T,
    momenta: T,
}

impl<V: Vector, M: Map<Carried = Copies<V>>> Map for Mixing<M, V::Scalar> {
    type Carried = Copies<V>;
    type Work = M::Work;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Copies<V>, work: &mut M::Work) {
        self.inner.step(t, end, z, work);
        mix(self.coordinates, &mut z.x.q, &mut z.y.q);
        mix(self.momenta, &mut z.x.p, &mut z.y.p);
    }

    #[cold]
    fn explain(
        &self,
        t: V::Scalar,
        end: V::Scalar,
        _: bool,
        z: &mut Copies<V>,
        work: &mut M::Work,
    ) -> Cause {
        self.inner.explain(t, end, true, z, work)
    }
}

/// `a ← c·a + (1 − c)·b`, `b ← (1 − c)·a + c·b`.
#[cfg_attr(not(unoptimised), inline(always))]
fn mix<V: Vector>(c: V::Scalar, a: &mut V, b: &mut V) {
    let rest = V::Scalar::one() - c;
    for k in 0..V::PARTS {
        for (a, b) in a.part_mut(k).iter_mut().zip(b.part_mut(k)) {
            (*a, *b) = (c * *a + rest * *b, rest * *a + c * *b);
        }
    }
}
