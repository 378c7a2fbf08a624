//! Störmer–Verlet for a time-transformed system.
//!
//! Input: H = ½pᵀM⁻¹p + V(q) in the time of a monitor function g(q). Output: [`TransformedVerlet`].
//! Invariant: one ∂V/∂q a step; only two equations, for one number each, are implicit.

use crate::errors::{Error, StartError};
use crate::flows::iterate::{Contraction, iterate};
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{
    Autonomous, Dynamics, QuadraticKinetic, Separable, System, Unforced, VectorOf,
};
use crate::systems::transformed::{InNewTime, TimeTransformed, WithTime};
use crate::systems::vector::{Vector, dot};
use hamiltonian_lanes::{Mask, Real};
use nalgebra::SVector;

/// Störmer–Verlet, the partitioned Lobatto IIIA–B pair of two stages, for K = g(q)·(½pᵀM⁻¹p + V(q) + p_t):
/// order 2, symplectic in (q, t, p, p_t), symmetric.
///
/// ```text
/// Q = q[0] + h/2 g(Q) M⁻¹p[0]
/// p[1] = p[0] − h g(Q) ∂V/∂q(Q) − h/2 (γ(Q, p[0]) + γ(Q, p[1])) ∂g/∂q(Q),   γ = H + p_t
/// q[1] = Q + h/2 g(Q) M⁻¹p[1],   t[1] = t[0] + h g(Q)
/// ```
///
/// Q is on a line, so the first is one equation for the number g(Q), solved by Newton's method;
/// p\[1\] too is on a line, on which γ is a quadratic polynomial, solved in closed form. So a step
/// costs one ∂V/∂q and some g. Without ∂g/∂q it would be a leapfrog with steps that follow g, which
/// is not symplectic. Compositions such as `KahanLi6.of(TransformedVerlet::default())` have a
/// higher order.
///
/// It requires a [`TimeTransformed`] system. g must not depend on momenta; otherwise steps return
/// an error.
///
/// Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), section VIII.2.1,
/// doi:10.1007/3-540-30666-8; E. Hairer, Appl. Numer. Math. 25 (1997) 219,
/// doi:10.1016/S0168-9274(97)00061-5.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// hamiltonian! {
///     /// A mass on a spring.
///     pub struct Oscillator {}
///     H(q; p) = p^2/2 + q^2/2;
///     monitor half = q^2/2
/// }
///
/// // The oscillator in the time of g = q²/2.
/// let system = TimeTransformed::by(Oscillator {}, "half")?;
/// let start = system.start(&State::new([1.0], [0.0]))?;
/// let mut run = Integrator::new(&system, TransformedVerlet::default(), start, 0.01)?;
/// let end = system.declared(run.advance(100)?);
/// assert!((end.q[0] - end.t.cos()).abs() < 1e-5);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TransformedVerlet {
    /// The number of iterations after which a step without g(Q) is an error.
    max_iterations: u32,
}

impl Default for TransformedVerlet {
    /// At most 50 iterations of Newton's method, which doubles the digits.
    fn default() -> Self {
        TransformedVerlet { max_iterations: 50 }
    }
}

impl TransformedVerlet {
    /// The number of iterations after which an unsolved step is an error; 50 by default.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        TransformedVerlet { max_iterations }
    }
}

impl Listed for TransformedVerlet {
    fn entry(&self) -> Entry {
        Entry {
            name: "TransformedVerlet",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::TIME_TRANSFORMED
                .and(Needs::SEPARABLE)
                .and(Needs::QUADRATIC_KINETIC)
                .and(Needs::UNFORCED)
                .and(Needs::AUTONOMOUS),
            preserves: Form::OnePoint,
            source: "Hairer, Lubich, Wanner 2006, section VIII.2.1, doi:10.1007/3-540-30666-8",
        }
    }
}

symmetric!(TransformedVerlet);

impl<S, G> Scheme<TimeTransformed<S, G>> for TransformedVerlet
where
    S: System + Separable + QuadraticKinetic + Unforced + Autonomous,
    G: System<Shape = S::Shape> + Unforced + Autonomous,
{
    type Carried = Point<Pair<S::Shape, SVector<(), 1>>>;
    type Map<T: Real> = VerletInNewTime<T, S::Prepared<T>, G::Prepared<T>>;
    /// ∂g/∂p is 0 here and at momenta beside, since it may vanish at rest alone.
    fn check<T: Real>(
        &self,
        prepared: &InNewTime<S::Prepared<T>, G::Prepared<T>>,
        state: &State<WithTime<VectorOf<S, T>>>,
    ) -> Result<(), Error> {
        let (q, mut p) = (&state.q.x, state.p.x.clone());
        let mut slope = p.zeros_like();
        for moved in [0.0, 1.0] {
            for index in 0..p.len() {
                // Beside zeros of differences too.
                let by = moved * (1.0 + index as f64).sqrt();
                *p.component_mut(index) += T::constant(by, 0.0);
            }
            prepared.monitor.gradient_p(T::zero(), q, &p, &mut slope);
            if slope.components().any(|x| x.magnitude() > 0.0) {
                let scheme = self.entry().name.into();
                return Err(StartError::MonitorOfMomenta { scheme }.into());
            }
        }
        Ok(())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(
        &self,
        prepared: &InNewTime<S::Prepared<T>, G::Prepared<T>>,
        step: Step<T>,
    ) -> Self::Map<T> {
        VerletInNewTime {
            dynamics: prepared.clone(),
            h: step.h,
            half: step.h * T::constant(0.5, 0.0),
            limit: self.max_iterations,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        _: &InNewTime<S::Prepared<T>, G::Prepared<T>>,
        state: &State<WithTime<VectorOf<S, T>>>,
        _: T,
    ) -> Point<WithTime<VectorOf<S, T>>> {
        state.point()
    }
}

/// The map of [`TransformedVerlet`].
#[derive(Debug, Clone)]
pub struct VerletInNewTime<T, P, G> {
    dynamics: InNewTime<P, G>,
    h: T,
    half: T,
    limit: u32,
}

/// The scratch of [`VerletInNewTime`].
#[derive(Debug, Clone)]
pub struct VerletWork<V> {
    middle: V,
    /// M⁻¹p at the beginning, then of the line of p\[1\].
    velocity: V,
    /// ∂V/∂q.
    slope: V,
    /// ∂g/∂q.
    along: V,
    /// ∂g/∂p, and M⁻¹∂g/∂q.
    other: V,
}

impl<V: Vector> Scratch<Point<WithTime<V>>> for VerletWork<V> {
    fn like(z: &Point<WithTime<V>>) -> Self {
        let vector = || z.q.x.clone();
        VerletWork {
            middle: vector(),
            velocity: vector(),
            slope: vector(),
            along: vector(),
            other: vector(),
        }
    }
}

/// A number σ ↦ the next of Newton's method for σ = g(q + h/2 σ M⁻¹p).
struct Scale<'a, T, G, V> {
    monitor: &'a G,
    half: T,
    q: &'a V,
    p: &'a V,
    velocity: &'a V,
    middle: &'a mut V,
    along: &'a mut V,
    other: &'a mut V,
}

impl<T: Real, V: Vector<Scalar = T>, G: Dynamics<T, Vector = V>> Scale<'_, T, G, V> {
    /// Q, and g with its derivatives there.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn at(&mut self, scale: T) -> T {
        self.middle.copy_from(self.q);
        self.middle.accumulate(self.half * scale, self.velocity);
        (self.monitor).energy_and_gradient(T::zero(), self.middle, self.p, self.along, self.other)
    }
}

impl<T: Real, V: Vector<Scalar = T>, G: Dynamics<T, Vector = V>> Contraction<SVector<T, 1>>
    for Scale<'_, T, G, V>
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn map(&mut self, scale: &SVector<T, 1>, next: &mut SVector<T, 1>) {
        let scale = scale[0];
        let residual = scale - self.at(scale);
        let slope = T::one() - self.half * dot(self.along, self.velocity);
        next[0] = scale - residual / slope;
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&self, scale: &SVector<T, 1>) -> T::Size {
        scale.size()
    }
}

impl<T, V, P, G> VerletInNewTime<T, P, G>
where
    T: Real,
    V: Vector<Scalar = T>,
    P: Dynamics<T, Vector = V>,
    G: Dynamics<T, Vector = V>,
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn solve(&self, z: &mut Point<WithTime<V>>, work: &mut VerletWork<V>) -> Cause {
        let InNewTime {
            system, monitor, ..
        } = &self.dynamics;
        let (zero, half, two) = (T::zero(), T::constant(0.5, 0.0), T::constant(2.0, 0.0));
        let (q, p) = (&mut z.q.x, &mut z.p.x);
        system.gradient_p(zero, q, p, &mut work.velocity);
        let mut equation = Scale {
            monitor,
            half: self.half,
            q,
            p,
            velocity: &work.velocity,
            middle: &mut work.middle,
            along: &mut work.along,
            other: &mut work.other,
        };
        let mut scale = SVector::from_element(monitor.energy(zero, q, p));
        let mut next = scale;
        let outcome = iterate(self.limit, &mut equation, &mut scale, &mut next);
        let scale = equation.at(scale[0]);
        let of_coordinates = work.other.size().equals(T::Size::zero());
        let kinetic = half * dot(p, &work.velocity);
        let VerletWork {
            middle,
            velocity,
            slope,
            along,
            other,
        } = work;
        // The kick: p[1] = line − γ·along, where γ is that at p[1].
        let shell = system.energy_and_gradient(zero, middle, p, slope, velocity) + z.p.y[0];
        p.accumulate(-(self.h * scale), slope);
        along.scale(self.half);
        p.accumulate(-shell, along);
        system.gradient_p(zero, middle, p, velocity);
        system.gradient_p(zero, middle, along, other);
        let on_line = shell + (half * dot(p, velocity) - kinetic);
        let linear = T::one() + dot(along, velocity);
        let square = dot(along, other);
        let root = (linear * linear - two * square * on_line).sqrt();
        let shell = two * on_line / (linear + root);
        p.accumulate(-shell, along);
        velocity.accumulate(-shell, other);
        q.copy_from(middle);
        q.accumulate(self.half * scale, velocity);
        z.q.y[0] += self.h * scale;
        let good = outcome.solved & zero.lt(scale) & of_coordinates;
        if !good.all() {
            z.poison(!good);
        }
        match () {
            () if !of_coordinates.all() => {
                Cause::Piece("monitor, which must not depend on momenta")
            }
            () if !outcome.solved.all() => outcome.cause(),
            () if !zero.lt(scale).all() => Cause::Piece("monitor, which must be positive"),
            () => Cause::Overflow,
        }
    }
}

impl<T, V, P, G> Map for VerletInNewTime<T, P, G>
where
    T: Real,
    V: Vector<Scalar = T>,
    P: Dynamics<T, Vector = V>,
    G: Dynamics<T, Vector = V>,
{
    type Carried = Point<WithTime<V>>;
    type Work = VerletWork<V>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, _: T, _: T, z: &mut Self::Carried, work: &mut Self::Work) {
        self.solve(z, work);
    }

    #[cold]
    fn explain(&self, _: T, _: T, _: bool, z: &mut Self::Carried, work: &mut Self::Work) -> Cause {
        self.solve(z, work)
    }
}
