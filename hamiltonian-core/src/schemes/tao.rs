//! Tao's binding of the two copies.
//!
//! Input: a system without forces. Output: [`Tao`], and [`Bind`], the piece that turns the copies
//! around their mean. Invariant: the two pieces of H and the binding are exact flows of the doubled
//! space; the loop is [`Zigzag`]'s.

use super::extended::{Copies, Cross};
use super::strang::Strang;
use super::zigzag::Zigzag;
use crate::flows::map::Step;
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::{Flow, Piece, Pieces};
use crate::systems::state::{Pair, State};
use crate::systems::system::{Dynamics, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// Tao's scheme: Pihajoki's two copies, bound together by ω; order 2, explicit for every H.
///
/// Strang's splitting of H(q, p̃) + H(q̃, p) + ½ω(|q − q̃|² + |p − p̃|²). The last piece turns
/// (q − q̃, p − p̃) by the angle 2ωh; three evaluations of J∇H a step.
///
/// Preserves dq∧dp + dq̃∧dp̃ in the doubled space, and there an energy near H(q, p̃) + H(q̃, p) +
/// the binding; dq∧dp of the observed state is *not* preserved, but the copies stay together if ω
/// is large enough.
///
/// ω should be larger than the rate at which copies of the unbound scheme separate, which is of the
/// order of the largest frequency of the motion. The error grows as ωh², and stability requires ωh
/// well below 1. Begin with ten to twenty times the frequency. No theorem bounds the distance of
/// the copies for a small ω: watch [`Integrator::copy_distance`](crate::Integrator::copy_distance).
///
/// Higher even orders are compositions: `KahanLi6.of(Tao::default().with_omega(20.0))`.
///
/// Source: M. Tao, Phys. Rev. E 94 (2016) 043303, eqs. 1 to 4, doi:10.1103/PhysRevE.94.043303.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Tao;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Tao::default().with_omega(10.0), start, 0.01)?;
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 1e-4);
/// assert!(run.copy_distance() < 1e-4);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tao {
    /// ω, the strength of the binding, in units of 1 over time.
    omega: f64,
}

impl Default for Tao {
    /// ω = 20, for motions whose frequencies are about 1.
    fn default() -> Self {
        Tao { omega: 20.0 }
    }
}

impl Tao {
    /// ω, the strength of the binding, in units of 1 over time; 20 by default.
    #[must_use]
    pub fn with_omega(self, omega: f64) -> Self {
        Tao { omega }
    }
}

impl Listed for Tao {
    fn entry(&self) -> Entry {
        Entry {
            name: "Tao",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::UNFORCED,
            preserves: Form::TwoCopies,
            source: "Tao 2016, eqs. 1 to 4, doi:10.1103/PhysRevE.94.043303",
        }
    }
}

symmetric!(Tao);

/// ½ω(|q − q̃|² + |p − p̃|²).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bind {
    /// ω.
    pub omega: f64,
}

/// The flow of [`Bind`]: (q − q̃, p − p̃) turned by 2ωc, the means as they are.
#[derive(Debug, Clone, Copy)]
pub struct Turned<T> {
    cos: T,
    sin: T,
}

impl<V: Vector> Flow<Copies<V>> for Turned<V::Scalar> {
    const NAME: &'static str = "binding";
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, _: V::Scalar, z: &mut Copies<V>, _: &mut ()) {
        let half = V::Scalar::constant(0.5, 0.0);
        let Pair { x, y } = z;
        for k in 0..V::PARTS {
            let first = x.q.part_mut(k).iter_mut().zip(x.p.part_mut(k));
            let second = y.q.part_mut(k).iter_mut().zip(y.p.part_mut(k));
            for ((q, p), (other_q, other_p)) in first.zip(second) {
                let (dq, dp) = (half * (*q - *other_q), half * (*p - *other_p));
                let (mean_q, mean_p) = (half * (*q + *other_q), half * (*p + *other_p));
                let turned_q = self.cos * dq + self.sin * dp;
                let turned_p = self.cos * dp - self.sin * dq;
                *q = mean_q + turned_q;
                *p = mean_p + turned_p;
                *other_q = mean_q - turned_q;
                *other_p = mean_p - turned_p;
            }
        }
    }
}

impl<T: Real, P: Dynamics<T>> Piece<T, P> for Bind {
    type Point = Copies<P::Vector>;
    type Flow = Turned<T>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn flow(&self, _: &P, c: T) -> Turned<T> {
        let (sin, cos) = (T::constant(2.0 * self.omega, 0.0) * c).sin_cos();
        Turned { cos, sin }
    }
}

/// The pieces of Tao's H, the outermost first.
type Bound = (Cross<true>, Cross<false>, Bind);

impl<S: System + Unforced> Scheme<S> for Tao {
    type Carried = Copies<S::Shape>;
    type Map<T: Real> = Zigzag<
        Copies<VectorOf<S, T>>,
        <Bound as Pieces<T, S::Prepared<T>>>::Outer,
        <Bound as Pieces<T, S::Prepared<T>>>::Inner,
        Strang,
    >;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let bind = Bind { omega: self.omega };
        Zigzag::new(&Strang, &(Cross, Cross, bind), prepared, step)
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
