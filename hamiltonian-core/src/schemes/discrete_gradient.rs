//! Gonzalez' discrete gradient: steps that preserve H.
//!
//! Input: a system without forces. Output: [`DiscreteGradient`]. Invariant: the difference of H
//! over a step is rounding error, for any step size.

use crate::flows::iterate::{Contraction, iterate};
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{Description, Dynamics, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The midpoint discrete gradient of Gonzalez: order 2, preserves H to rounding error,
/// time-reversible; not symplectic.
///
/// ```text
/// z[n+1] = z[n] + h J∇̄H,   ∇̄H = ∇H(m) + (H(z[n+1]) − H(z[n]) − ∇H(m)·Δ) Δ/|Δ|²
/// ```
///
/// with `m = (z[n] + z[n+1])/2` and `Δ = z[n+1] − z[n]`. If H depends on t, the step preserves H at
/// the time in its middle. Solved by fixed-point iteration from the slope of the step before.
///
/// Source: O. Gonzalez, J. Nonlinear Sci. 6 (1996) 449, eq. 3.7, doi:10.1007/BF02440162.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::DiscreteGradient;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, DiscreteGradient::default(), start, 0.5)?;
/// let end = run.advance(1_000)?;
/// assert!((System::energy(&Oscillator {}, end) - 0.5).abs() < 1e-14);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DiscreteGradient {
    /// The number of iterations after which an unsolved step is an error.
    max_iterations: u32,
}

impl Default for DiscreteGradient {
    /// At most 100 iterations.
    fn default() -> Self {
        DiscreteGradient {
            max_iterations: 100,
        }
    }
}

impl DiscreteGradient {
    /// The number of iterations after which an unsolved step is an error; 100 by default.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        DiscreteGradient { max_iterations }
    }
}

impl Listed for DiscreteGradient {
    fn entry(&self) -> Entry {
        Entry {
            name: "DiscreteGradient",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::UNFORCED,
            preserves: Form::Nothing,
            source: "Gonzalez 1996, eq. 3.7, doi:10.1007/BF02440162",
        }
    }
}

symmetric!(DiscreteGradient);

impl<S: System + Unforced> Scheme<S> for DiscreteGradient {
    type Carried = Pair<Point<S::Shape>, Point<S::Shape>>;
    type Map<T: Real> = EnergyKeeping<T, S::Prepared<T>>;
    fn times_of_jumps(&self, _: &Description) -> [f64; 2] {
        [0.5; 2]
    }
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        EnergyKeeping {
            dynamics: prepared.clone(),
            h: step.h,
            half: step.h * T::constant(0.5, 0.0),
            limit: self.max_iterations,
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Pair<Point<VectorOf<S, T>>, Point<VectorOf<S, T>>> {
        let point = state.point();
        let slope = point.zeros_like();
        Pair { x: point, y: slope }
    }
}

/// The map of [`DiscreteGradient`]: x is the point, y the slope Δ/h of the last step.
#[derive(Debug, Clone)]
pub struct EnergyKeeping<T, P> {
    dynamics: P,
    h: T,
    half: T,
    limit: u32,
}

/// The fixed-point equation slope ↦ J∇̄H.
struct DiscreteGradientEquation<'a, T: Real, P: Dynamics<T>> {
    map: &'a EnergyKeeping<T, P>,
    t: T,
    energy: T,
    point: &'a Point<P::Vector>,
    other: &'a mut Point<P::Vector>,
    gradient: &'a mut Point<P::Vector>,
}

impl<T: Real, P: Dynamics<T>> Contraction<Point<P::Vector>> for DiscreteGradientEquation<'_, T, P> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(&mut self, slope: &Point<P::Vector>, next: &mut Point<P::Vector>) {
        let EnergyKeeping {
            dynamics, h, half, ..
        } = self.map;
        self.other.copy_from(self.point);
        self.other.accumulate(*h, slope);
        let change = dynamics.energy(self.t, &self.other.q, &self.other.p) - self.energy;
        self.other.copy_from(self.point);
        self.other.accumulate(*half, slope);
        let Point { q, p } = &mut *self.gradient;
        dynamics.gradient(self.t, &self.other.q, &self.other.p, q, p);
        let (mut along, mut square) = (T::zero(), T::zero());
        for k in 0..<Point<P::Vector> as Vector>::PARTS {
            for (gradient, slope) in self.gradient.part(k).iter().zip(slope.part(k)) {
                along = gradient.fma(*slope, along);
                square = slope.fma(*slope, square);
            }
        }
        // (change − ∇H·Δ)/|Δ|², for the slope in place of Δ; a point at rest stays.
        let factor = (change / *h - along) / square;
        let factor = T::select(square.equals(T::zero()), T::zero(), factor);
        self.gradient.accumulate(factor, slope);
        // J
        next.q.copy_from(&self.gradient.p);
        next.p.copy_from(&self.gradient.q);
        next.p.scale(-T::one());
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, slope: &Point<P::Vector>) -> T::Size {
        // The rounding of H enters divided by |Δ|.
        let step = self.map.h.size();
        self.point.size() / step + slope.size() + self.energy.size() / (step * slope.size())
    }
}

/// The scratch of [`EnergyKeeping`].
#[derive(Debug, Clone)]
pub struct EnergyWork<V: Vector> {
    other: Point<V>,
    gradient: Point<V>,
    next: Point<V>,
}

impl<T: Real, P: Dynamics<T>> EnergyKeeping<T, P> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(
        &self,
        t: T,
        z: &mut Pair<Point<P::Vector>, Point<P::Vector>>,
        work: &mut EnergyWork<P::Vector>,
    ) -> Cause {
        let Pair { x: point, y: slope } = z;
        let t = t + self.half;
        let mut equation = DiscreteGradientEquation {
            map: self,
            t,
            energy: self.dynamics.energy(t, &point.q, &point.p),
            point,
            other: &mut work.other,
            gradient: &mut work.gradient,
        };
        let outcome = iterate(self.limit, &mut equation, slope, &mut work.next);
        let solved = outcome.solved.all();
        if !solved {
            slope.poison(!outcome.solved);
        }
        point.accumulate(self.h, slope);
        if solved {
            Cause::Overflow
        } else {
            outcome.cause()
        }
    }
}

impl<V: Vector> Scratch<Pair<Point<V>, Point<V>>> for EnergyWork<V> {
    fn like(like: &Pair<Point<V>, Point<V>>) -> Self {
        EnergyWork {
            other: like.x.clone(),
            gradient: like.x.clone(),
            next: like.x.clone(),
        }
    }
}

impl<T: Real, P: Dynamics<T>> Map for EnergyKeeping<T, P> {
    type Carried = Pair<Point<P::Vector>, Point<P::Vector>>;
    type Work = EnergyWork<P::Vector>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(t, z, work);
    }

    #[cold]
    fn explain(&self, t: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(t, z, work)
    }
}
