//! The classical Runge–Kutta method, which preserves nothing: the control.
//!
//! Input: any system. Output: [`RungeKutta4`]. Invariant: none but its order.

use crate::scheme::{Clock, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
use crate::state::{Point, State};
use crate::system::{Dynamics, Flow, System};
use crate::vector::Vector;
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
/// use hamiltonian_core::{Integrator, State, schemes::RungeKutta4};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, RungeKutta4, start, 0.01)?;
/// // The error of 100 steps is near h⁴t/120 = 8e-11.
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 1e-10);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RungeKutta4;

impl Listed for RungeKutta4 {
    fn entry(&self) -> &'static Entry {
        &Entry {
            name: "RungeKutta4",
            variant: "",
            equations: "",
            order: 4,
            duration: 1,
            needs: Needs::Any,
            preserves: Form::Nothing,
            source: "Kutta 1901",
        }
    }
}

impl<T: Real, S: System<T>> Scheme<T, S> for RungeKutta4 {
    type Stepper = Classical<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        let point = Point {
            q: start.q.clone(),
            p: start.p.clone(),
        };
        let zero = point.zeros_like();
        Classical {
            clock: Clock {
                start: start.t,
                interval: step,
            },
            flow: prepared.flow(step),
            weights: [(1.0, 6.0), (1.0, 3.0), (1.0, 3.0), (1.0, 6.0)].map(
                |(numerator, denominator)| {
                    T::constant(numerator, 0.0) / T::constant(denominator, 0.0)
                },
            ),
            increment: zero.clone(),
            stage: zero.clone(),
            sum: zero,
            carried: point,
        }
    }
}

/// The stepper of [`RungeKutta4`].
#[derive(Debug, Clone)]
pub struct Classical<V: Vector, F: Flow<V>> {
    clock: Clock<V::Scalar>,
    flow: F,
    weights: [V::Scalar; 4],
    increment: Point<V>,
    stage: Point<V>,
    sum: Point<V>,
    carried: Point<V>,
}

impl<V: Vector, F: Flow<V>> Classical<V, F> {
    /// `increment = h·J∇H(stage)`, added to the sum by its weight.
    #[inline(always)]
    fn evaluate(&mut self, t: V::Scalar, index: usize) {
        self.increment.set_zero();
        let Point { q, p } = &mut self.increment;
        self.flow.flow(t, &self.stage.q, &self.stage.p, q, p);
        self.sum.accumulate(self.weights[index], &self.increment);
    }

    /// `stage = z + c·increment`.
    #[inline(always)]
    fn place(&mut self, c: V::Scalar) {
        self.stage.copy_from(&self.carried);
        self.stage.accumulate(c, &self.increment);
    }

    #[inline(always)]
    fn step(&mut self, made: u64) {
        let half = V::Scalar::constant(0.5, 0.0);
        let t = self.clock.at(made);
        let middle = t + self.clock.interval * half;
        self.sum.copy_from(&self.carried);
        self.stage.copy_from(&self.carried);
        self.evaluate(t, 0);
        self.place(half);
        self.evaluate(middle, 1);
        self.place(half);
        self.evaluate(middle, 2);
        self.place(V::Scalar::one());
        self.evaluate(self.clock.at(made + 1), 3);
        self.carried.copy_from(&self.sum);
    }
}

impl<V: Vector, F: Flow<V>> Stepper for Classical<V, F> {
    type Vector = V;
    type Carried = Point<V>;

    #[inline(always)]
    fn carried(&self) -> &Point<V> {
        &self.carried
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Point<V> {
        &mut self.carried
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        for k in made..made + n {
            self.step(k);
        }
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, _: u64, q: &mut V, p: &mut V) {
        q.copy_from(&self.carried.q);
        p.copy_from(&self.carried.p);
    }
}
