//! The paper's own schemes: leaps over a point, from one trajectory of points to the other.
//!
//! Input: any system and a [`Start`]. Output: [`TwoStepMidpoint`] (25),
//! [`ConsecutiveSubTrajectories`] (26), [`IntersectingSubTrajectories`] (33). Invariant: with
//! z = (q, p) and J∇H = (∂H/∂p, −∂H/∂q), every move is `z_earlier + leap·J∇H(z_between)`.

use super::separable::EULER;
use super::splitting::{Flowing, Splitting};
use crate::scheme::{Clock, Entry, Form, Listed, Needs, Scheme, Stepper, Unsolved};
use crate::state::{Pair, Point, State};
use crate::system::{Dynamics, Flow, System};
use crate::vector::Vector;
use hamiltonian_lanes::Real;

/// How the second starting point, half a leap before the first, is made.
///
/// An error of it excites the parasitic mode (root −1) of these schemes, which is then seen as an
/// oscillation of H for ever; on some systems it grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// The paper's: equal to the first, an error of O(Δt). The scheme is of order 1.
    Equal,
    /// An explicit Euler step back, an error of O(Δt²).
    HalfEuler,
    /// An explicit midpoint step back, an error of O(Δt³).
    #[default]
    SecondOrder,
}

impl Start {
    const fn words(self) -> &'static str {
        match self {
            Start::Equal => "equal start",
            Start::HalfEuler => "half-Euler start",
            Start::SecondOrder => "second-order start",
        }
    }

    const fn order(self) -> u32 {
        match self {
            Start::Equal => 1,
            Start::HalfEuler | Start::SecondOrder => 2,
        }
    }

    /// The point `back` before the start.
    fn before<T, D, V>(self, prepared: &D, start: &State<V>, back: T) -> Point<V>
    where
        T: Real,
        D: Dynamics<T, Vector = V>,
        V: Vector<Scalar = T>,
    {
        let mut point = Point {
            q: start.q.clone(),
            p: start.p.clone(),
        };
        match self {
            Start::Equal => {}
            Start::HalfEuler => {
                let flow = prepared.flow(-back);
                flow.flow(start.t, &start.q, &start.p, &mut point.q, &mut point.p);
            }
            Start::SecondOrder => {
                let half = back * T::constant(0.5, 0.0);
                let mut middle = point.clone();
                let flow = prepared.flow(-half);
                flow.flow(start.t, &start.q, &start.p, &mut middle.q, &mut middle.p);
                let flow = prepared.flow(-back);
                flow.flow(
                    start.t - half,
                    &middle.q,
                    &middle.p,
                    &mut point.q,
                    &mut point.p,
                );
            }
        }
        point
    }
}

const SOURCE: &str = "Developing an explicit Hamiltonian variational integrator; two-point form: \
                      Eirola and Sanz-Serna 1992, doi:10.1007/BF01385510";

/// The entries of one scheme for the three starts.
macro_rules! entries {
    ($scheme:ident, $equations:literal, $duration:literal) => {
        impl Listed for $scheme {
            fn entry(&self) -> &'static Entry {
                const fn with(start: Start) -> Entry {
                    Entry {
                        name: stringify!($scheme),
                        variant: start.words(),
                        equations: $equations,
                        order: start.order(),
                        duration: $duration,
                        needs: Needs::Any,
                        preserves: Form::TwoPoint,
                        source: SOURCE,
                    }
                }
                match self.start {
                    Start::Equal => const { &with(Start::Equal) },
                    Start::HalfEuler => const { &with(Start::HalfEuler) },
                    Start::SecondOrder => const { &with(Start::SecondOrder) },
                }
            }
        }
    };
}

/// The explicit two-step midpoint rule, equations (25): order 2 (1 with [`Start::Equal`]).
///
/// ```text
/// z[n+1] = z[n−1] + 2h J∇H(z[n], t[n])
/// ```
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of the last two points, not dq∧dp of one. The start asks for
/// `z[−1]`, made by [`Start`]. No term of its derivation needs H separable; what limits it is its
/// parasitic root −1.
///
/// Source: the paper, eqs. 25a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::TwoStepMidpoint};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator, TwoStepMidpoint::default(), start, 0.01)?;
/// // The error of 100 steps is near h²t/6 = 1.7e-5.
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 2e-5);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TwoStepMidpoint {
    /// How `z[−1]` is made.
    pub start: Start,
}

entries!(TwoStepMidpoint, "25", 1);

/// The paper's scheme 1, consecutive sub-trajectories, equations (26): order 2 (1 with
/// [`Start::Equal`]).
///
/// ```text
/// z[n+½] = z[n−½] + 2h J∇H(z[n]);   z[n+1] = z[n] + 2h J∇H(z[n+½])
/// ```
///
/// **One step of size h advances the time by 2h**: the factor 2 of (25) is kept although points
/// lie half a step apart. The state's `t` is the true time, t₀ + 2kh after k steps. (The paper
/// plots against kh and so sees twice as many oscillations.) With half the step it is
/// [`IntersectingSubTrajectories`].
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of `z[n]` and `z[n−½]`. The start asks for `z[−½]`, made by
/// [`Start`].
///
/// Source: the paper, eqs. 26a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::{Integrator, State, schemes::ConsecutiveSubTrajectories};
///
/// let start = State::new([1.0], [0.0]);
/// let mut run =
///     Integrator::new(&Oscillator, ConsecutiveSubTrajectories::default(), start, 0.01)?;
/// let end = run.advance(50)?;
/// assert_eq!(end.t, 1.0);
/// assert!((end.q[0] - 1.0_f64.cos()).abs() < 2e-5);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ConsecutiveSubTrajectories {
    /// How `z[−½]` is made.
    pub start: Start,
}

entries!(ConsecutiveSubTrajectories, "26", 2);

/// The paper's scheme 2, intersecting sub-trajectories, equations (33): order 2 (1 with
/// [`Start::Equal`]).
///
/// ```text
/// z[n+½] = z[n−½] + h J∇H(z[n], t[n]);   z[n+1] = z[n] + h J∇H(z[n+½], t[n+½])
/// ```
///
/// With [`Start::HalfEuler`] it is [`Pihajoki`](super::Pihajoki)'s (29): `z[n]` is the copy (q̃, p).
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of `z[n]` and `z[n−½]`. The start asks for `z[−½]`, made by
/// [`Start`].
///
/// Source: the paper, eqs. 33a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian_core::schemes::{IntersectingSubTrajectories, Start};
/// use hamiltonian_core::{Integrator, State};
///
/// let scheme = IntersectingSubTrajectories { start: Start::HalfEuler };
/// let mut run = Integrator::new(&Oscillator, scheme, State::new([1.0], [0.0]), 0.01)?;
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 5e-5);
/// # Ok::<(), hamiltonian_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntersectingSubTrajectories {
    /// How `z[−½]` is made.
    pub start: Start,
}

entries!(IntersectingSubTrajectories, "33", 1);

impl<T: Real, S: System<T>> Scheme<T, S> for TwoStepMidpoint {
    type Stepper = TwoStep<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        TwoStep {
            clock: Clock {
                start: start.t,
                interval: step,
            },
            leap: prepared.flow(step + step),
            carried: Pair {
                x: self.start.before(prepared, start, step),
                y: Point {
                    q: start.q.clone(),
                    p: start.p.clone(),
                },
            },
        }
    }
}

/// The stepper of [`TwoStepMidpoint`]: y is the last point after an even number of steps, x after
/// an odd one; the other is the last but one.
#[derive(Debug, Clone)]
pub struct TwoStep<V: Vector, F: Flow<V>> {
    clock: Clock<V::Scalar>,
    leap: F,
    carried: Pair<Point<V>, Point<V>>,
}

impl<V: Vector, F: Flow<V>> TwoStep<V, F> {
    /// The step after the first `made`, an even number of them.
    #[inline(always)]
    fn even(&mut self, made: u64) {
        let Pair { x, y } = &mut self.carried;
        self.leap
            .flow(self.clock.at(made), &y.q, &y.p, &mut x.q, &mut x.p);
    }

    /// The step after the first `made`, an odd number of them.
    #[inline(always)]
    fn odd(&mut self, made: u64) {
        let Pair { x, y } = &mut self.carried;
        self.leap
            .flow(self.clock.at(made), &x.q, &x.p, &mut y.q, &mut y.p);
    }
}

impl<V: Vector, F: Flow<V>> Stepper for TwoStep<V, F> {
    type Vector = V;
    type Carried = Pair<Point<V>, Point<V>>;

    #[inline(always)]
    fn carried(&self) -> &Self::Carried {
        &self.carried
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Self::Carried {
        &mut self.carried
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        let end = made + n;
        let mut k = made;
        if k % 2 == 1 && k < end {
            self.odd(k);
            k += 1;
        }
        while k + 1 < end {
            self.even(k);
            self.odd(k + 1);
            k += 2;
        }
        if k < end {
            self.even(k);
        }
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, made: u64, q: &mut V, p: &mut V) {
        let last = if made.is_multiple_of(2) {
            &self.carried.y
        } else {
            &self.carried.x
        };
        q.copy_from(&last.q);
        p.copy_from(&last.p);
    }
}

impl<T: Real, S: System<T>> Scheme<T, S> for ConsecutiveSubTrajectories {
    type Stepper = Interleaved<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        Interleaved::new(self.start, prepared, start, step + step)
    }
}

impl<T: Real, S: System<T>> Scheme<T, S> for IntersectingSubTrajectories {
    type Stepper = Interleaved<S::Vector, <S::Prepared as Dynamics<T>>::Flow>;
    fn prepare(&self, prepared: &S::Prepared, start: &State<S::Vector>, step: T) -> Self::Stepper {
        Interleaved::new(self.start, prepared, start, step)
    }
}

/// The stepper of [`ConsecutiveSubTrajectories`] and [`IntersectingSubTrajectories`]: y is `z[n]`,
/// x is `z[n−½]`.
#[derive(Debug, Clone)]
pub struct Interleaved<V: Vector, F: Flow<V>> {
    splitting: Splitting<Point<V>, Point<V>, Flowing<F>, Flowing<F>, 1>,
}

impl<V: Vector, F: Flow<V>> Interleaved<V, F> {
    fn new<D>(start: Start, prepared: &D, state: &State<V>, leap: V::Scalar) -> Self
    where
        D: Dynamics<V::Scalar, Vector = V, Flow = F>,
    {
        const LAG: f64 = 0.5;
        let back = leap * V::Scalar::constant(LAG, 0.0);
        let carried = Pair {
            x: start.before(prepared, state, back),
            y: Point {
                q: state.q.clone(),
                p: state.p.clone(),
            },
        };
        let clock = Clock {
            start: state.t,
            interval: leap,
        };
        let flow = |c| Flowing(prepared.flow(c));
        Interleaved {
            splitting: Splitting::new(&EULER, clock, LAG, carried, flow, flow),
        }
    }
}

impl<V: Vector, F: Flow<V>> Stepper for Interleaved<V, F> {
    type Vector = V;
    type Carried = Pair<Point<V>, Point<V>>;

    #[inline(always)]
    fn carried(&self) -> &Self::Carried {
        self.splitting.carried()
    }

    #[inline(always)]
    fn carried_mut(&mut self) -> &mut Self::Carried {
        self.splitting.carried_mut()
    }

    #[inline(always)]
    fn run(&mut self, made: u64, n: u64) -> Result<(), Unsolved> {
        self.splitting.run(made, n);
        Ok(())
    }

    #[inline(always)]
    fn synchronise(&mut self, _: u64, q: &mut V, p: &mut V) {
        let y = &self.splitting.carried().y;
        q.copy_from(&y.q);
        p.copy_from(&y.p);
    }
}
