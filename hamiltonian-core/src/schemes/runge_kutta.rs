//! The classical Runge–Kutta method, which preserves nothing: the control.
//!
//! Input: any system. Output: [`RungeKutta4`]. Invariant: none but its order.

use super::composition::Adjoint;
use crate::flows::map::{Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme};
use crate::systems::flow::{Scratch, VectorField};
use crate::systems::state::{Point, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

/// The classical Runge–Kutta method: order 4, explicit, **not symplectic**. H drifts; it is here
/// to compare with.
///
/// ```text
/// k₁ = h J∇H(z, t)                k₂ = h J∇H(z + k₁/2, t + h/2)
/// k₃ = h J∇H(z + k₂/2, t + h/2)   k₄ = h J∇H(z + k₃, t + h)
/// z ← z + (k₁ + 2k₂ + 2k₃ + k₄)/6
/// ```
///
/// Source: W. Kutta, Z. Math. Phys. 46 (1901) 435; E. Hairer, S. Nørsett, G. Wanner, Solving
/// Ordinary Differential Equations I (1993), table II.1.2, doi:10.1007/978-3-540-78862-1.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, RungeKutta4, start, 0.01)?;
/// // The error of 100 steps is near h⁴t/120 = 8e-11.
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 1e-10);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RungeKutta4;

impl Listed for RungeKutta4 {
    fn entry(&self) -> Entry {
        Entry {
            name: "RungeKutta4",
            variant: "",
            equations: "",
            order: 4,
            duration: 1,
            needs: Needs::ANY,
            preserves: Form::Nothing,
            source: "Kutta 1901",
        }
    }
}

impl OneStep for RungeKutta4 {
    type Adjoint = Adjoint<Self>;
    fn adjoint(&self) -> Adjoint<Self> {
        Adjoint(*self)
    }
}

impl<S: System> Scheme<S> for RungeKutta4 {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = Classical<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Classical {
            field: prepared.field(step.h),
            h: step.h,
            weights: [(1.0, 6.0), (1.0, 3.0), (1.0, 3.0), (1.0, 6.0)].map(
                |(numerator, denominator)| {
                    T::constant(numerator, 0.0) / T::constant(denominator, 0.0)
                },
            ),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

/// The map of [`RungeKutta4`].
#[derive(Debug, Clone)]
pub struct Classical<V: Vector, F> {
    field: F,
    h: V::Scalar,
    weights: [V::Scalar; 4],
}

/// The scratch of [`Classical`].
#[derive(Debug, Clone)]
pub struct ClassicalWork<V: Vector> {
    increment: Point<V>,
    stage: Point<V>,
    sum: Point<V>,
}

impl<V: Vector, F: VectorField<V>> Classical<V, F> {
    /// `increment = h·J∇H(stage)`, added to the sum by its weight.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn evaluate(&self, t: V::Scalar, weight: V::Scalar, work: &mut ClassicalWork<V>) {
        work.increment.set_zero();
        let Point { q, p } = &mut work.increment;
        self.field.add(t, &work.stage.q, &work.stage.p, q, p);
        work.sum.accumulate(weight, &work.increment);
    }

    /// `stage = z + c·increment`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn place(&self, c: V::Scalar, z: &Point<V>, work: &mut ClassicalWork<V>) {
        work.stage.copy_from(z);
        work.stage.accumulate(c, &work.increment);
    }
}

impl<V: Vector> Scratch<Point<V>> for ClassicalWork<V> {
    fn like(like: &Point<V>) -> Self {
        ClassicalWork {
            increment: like.clone(),
            stage: like.clone(),
            sum: like.clone(),
        }
    }
}

impl<V: Vector, F: VectorField<V>> Map for Classical<V, F> {
    type Carried = Point<V>;
    type Work = ClassicalWork<V>;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Point<V>, work: &mut Self::Work) {
        let half = V::Scalar::constant(0.5, 0.0);
        let middle = t + self.h * half;
        let [first, second, third, fourth] = self.weights;
        work.sum.copy_from(z);
        work.stage.copy_from(z);
        self.evaluate(t, first, work);
        self.place(half, z, work);
        self.evaluate(middle, second, work);
        self.place(half, z, work);
        self.evaluate(middle, third, work);
        self.place(V::Scalar::one(), z, work);
        self.evaluate(end, fourth, work);
        z.copy_from(&work.sum);
    }
}
