//! The paper's own schemes: leaps over a point, on two interleaved trajectories.
//!
//! Input: any system and a [`SecondPoint`]. Output: [`TwoStepMidpoint`] (25),
//! [`ConsecutiveSubTrajectories`] (26), [`IntersectingSubTrajectories`] (33). Invariant: with
//! z = (q, p) and J∇H = (∂H/∂p, −∂H/∂q), every move is `z_earlier + leap·J∇H(z_between)`.

use crate::flows::map::{Clock, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::flow::VectorField;
use crate::systems::state::{Pair, Point, State};
use crate::systems::system::{Dynamics, System, Unforced, VectorOf};
use crate::systems::vector::Vector;
use core::marker::PhantomData;
use hamiltonian_lanes::Real;

/// The construction of the second starting point, half a leap before the first.
///
/// Its error excites the parasitic mode (root −1) of these schemes, a permanent oscillation of H,
/// which grows on some systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SecondPoint {
    /// The paper's: equal to the first, an error of O(Δt). The scheme is of order 1.
    Equal,
    /// An explicit Euler step back, an error of O(Δt²).
    HalfEuler,
    /// An explicit midpoint step back, an error of O(Δt³).
    #[default]
    SecondOrder,
}

impl SecondPoint {
    const fn words(self) -> &'static str {
        match self {
            SecondPoint::Equal => "equal start",
            SecondPoint::HalfEuler => "half-Euler start",
            SecondPoint::SecondOrder => "second-order start",
        }
    }

    const fn order(self) -> u32 {
        match self {
            SecondPoint::Equal => 1,
            SecondPoint::HalfEuler | SecondPoint::SecondOrder => 2,
        }
    }

    /// The start, and the point `back` before it.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn pair<T, D, V>(self, prepared: &D, start: &State<V>, back: T) -> Points<V>
    where
        T: Real,
        D: Dynamics<T, Vector = V>,
        V: Vector<Scalar = T>,
    {
        Pair {
            x: start.point(),
            y: self.before(prepared, start, back),
        }
    }

    /// The point `back` before the start.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn before<T, D, V>(self, prepared: &D, start: &State<V>, back: T) -> Point<V>
    where
        T: Real,
        D: Dynamics<T, Vector = V>,
        V: Vector<Scalar = T>,
    {
        let mut point = start.point();
        match self {
            SecondPoint::Equal => {}
            SecondPoint::HalfEuler => {
                let field = prepared.field(-back);
                field.add(start.t, &start.q, &start.p, &mut point.q, &mut point.p);
            }
            SecondPoint::SecondOrder => {
                let half = back * T::constant(0.5, 0.0);
                let mut middle = point.clone();
                let field = prepared.field(-half);
                field.add(start.t, &start.q, &start.p, &mut middle.q, &mut middle.p);
                let field = prepared.field(-back);
                field.add(
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
            fn entry(&self) -> Entry {
                Entry {
                    name: stringify!($scheme),
                    variant: self.start.words(),
                    equations: $equations,
                    order: self.start.order(),
                    duration: $duration,
                    needs: Needs::UNFORCED,
                    preserves: Form::TwoPoint,
                    source: SOURCE,
                }
            }
        }
    };
}

/// The explicit two-step midpoint rule, equations (25): order 2 (1 with [`SecondPoint::Equal`]).
///
/// ```text
/// z[n+1] = z[n−1] + 2h J∇H(z[n], t[n])
/// ```
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of the last two points, not dq∧dp of one. The start requires
/// `z[−1]`, made by [`SecondPoint`]. No step of its derivation requires a separable H; its parasitic root
/// −1 limits it.
///
/// Source: the paper, eqs. 25a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::TwoStepMidpoint;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, TwoStepMidpoint::default(), start, 0.01)?;
/// // The error of 100 steps is near h²t/6 = 1.7e-5.
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 2e-5);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TwoStepMidpoint {
    /// The construction of `z[−1]`. Saved runs contain the name of this field.
    start: SecondPoint,
}

impl TwoStepMidpoint {
    /// The construction of `z[−1]`; [`SecondPoint::default`] unless said here.
    #[must_use]
    pub fn with_second_point(self, start: SecondPoint) -> Self {
        TwoStepMidpoint { start }
    }
}

entries!(TwoStepMidpoint, "25", 1);

/// The paper's scheme 1, consecutive sub-trajectories, equations (26): order 2 (1 with
/// [`SecondPoint::Equal`]).
///
/// ```text
/// z[n+½] = z[n−½] + 2h J∇H(z[n]);   z[n+1] = z[n] + 2h J∇H(z[n+½])
/// ```
///
/// **One step of size h advances the time by 2h**: the factor 2 of (25) is kept although points lie
/// half a step apart. The state's `t` is the true time, t₀ + 2kh after k steps. (The paper plots
/// against kh and therefore shows twice as many oscillations.) With half the step it is
/// [`IntersectingSubTrajectories`].
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of `z[n]` and `z[n−½]`. The start asks for `z[−½]`, made by
/// [`SecondPoint`].
///
/// Source: the paper, eqs. 26a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::ConsecutiveSubTrajectories;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run =
///     Integrator::new(&Oscillator {}, ConsecutiveSubTrajectories::default(), start, 0.01)?;
/// let end = run.advance(50)?;
/// assert_eq!(end.t, 1.0);
/// assert!((end.q[0] - 1.0_f64.cos()).abs() < 2e-5);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ConsecutiveSubTrajectories {
    /// The construction of `z[−½]`. Saved runs contain the name of this field.
    start: SecondPoint,
}

impl ConsecutiveSubTrajectories {
    /// The construction of `z[−½]`; [`SecondPoint::default`] unless said here.
    #[must_use]
    pub fn with_second_point(self, start: SecondPoint) -> Self {
        ConsecutiveSubTrajectories { start }
    }
}

entries!(ConsecutiveSubTrajectories, "26", 2);

/// The paper's scheme 2, intersecting sub-trajectories, equations (33): order 2 (1 with
/// [`SecondPoint::Equal`]).
///
/// ```text
/// z[n+½] = z[n−½] + h J∇H(z[n], t[n]);   z[n+1] = z[n] + h J∇H(z[n+½], t[n+½])
/// ```
///
/// With [`SecondPoint::HalfEuler`] it is [`Pihajoki`](super::Pihajoki)'s (29): `z[n]` is the copy (q̃, p).
///
/// Preserves dq_a∧dp_b + dq_b∧dp_a of `z[n]` and `z[n−½]`. The start asks for `z[−½]`, made by
/// [`SecondPoint`].
///
/// Source: the paper, eqs. 33a–d; T. Eirola, J. M. Sanz-Serna, Numer. Math. 61 (1992) 281,
/// doi:10.1007/BF01385510 (the two-point form).
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::{IntersectingSubTrajectories, SecondPoint};
///
/// let scheme = IntersectingSubTrajectories::default().with_second_point(SecondPoint::HalfEuler);
/// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.01)?;
/// assert!((run.advance(100)?.q[0] - 1.0_f64.cos()).abs() < 5e-5);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntersectingSubTrajectories {
    /// The construction of `z[−½]`. Saved runs contain the name of this field.
    start: SecondPoint,
}

impl IntersectingSubTrajectories {
    /// The construction of `z[−½]`; [`SecondPoint::default`] unless said here.
    #[must_use]
    pub fn with_second_point(self, start: SecondPoint) -> Self {
        IntersectingSubTrajectories { start }
    }
}

entries!(IntersectingSubTrajectories, "33", 1);

/// Two points: the observed one, and one half a leap before it.
type Points<V> = Pair<Point<V>, Point<V>>;

impl<S: System + Unforced> Scheme<S> for TwoStepMidpoint {
    type Carried = Points<S::Shape>;
    type Map<T: Real> = TwoStep<<S::Prepared<T> as Dynamics<T>>::Field, VectorOf<S, T>>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        TwoStep {
            leap: prepared.field(step.h + step.h),
            vector: PhantomData,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        self.start.pair(prepared, state, h)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start_alone<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        SecondPoint::SecondOrder.pair(prepared, state, h)
    }
}

/// The map of [`TwoStepMidpoint`]: x is `z[n]`, y is `z[n−1]`.
#[derive(Debug, Clone)]
pub struct TwoStep<F, V> {
    leap: F,
    vector: PhantomData<V>,
}

impl<V: Vector, F: VectorField<V>> TwoStep<F, V> {
    /// `to += 2h·J∇H(by)`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn leap(&self, t: V::Scalar, by: &Point<V>, to: &mut Point<V>) {
        self.leap.add(t, &by.q, &by.p, &mut to.q, &mut to.p);
    }
}

impl<V: Vector, F: VectorField<V>> Map for TwoStep<F, V> {
    type Carried = Points<V>;
    type Work = ();

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, _: V::Scalar, z: &mut Points<V>, _: &mut ()) {
        let Pair { x, y } = z;
        self.leap(t, x, y);
        core::mem::swap(x, y);
    }

    /// Steps are made in pairs, after which the points are in their places again.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn go_on(&self, clock: Clock<V::Scalar>, made: u64, end: u64, z: &mut Points<V>, _: &mut ()) {
        let mut k = made;
        let Pair { mut x, mut y } = z.take();
        while k + 1 < end {
            self.leap(clock.at(k), &x, &mut y);
            self.leap(clock.at(k + 1), &y, &mut x);
            k += 2;
        }
        *z = Pair { x, y };
        if k < end {
            self.body(clock.at(k), clock.at(k + 1), z, &mut ());
        }
    }
}

impl<S: System + Unforced> Scheme<S> for ConsecutiveSubTrajectories {
    type Carried = Points<S::Shape>;
    type Map<T: Real> = Interleaved<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Interleaved::new(prepared, step.h + step.h)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        self.start.pair(prepared, state, h)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start_alone<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        SecondPoint::SecondOrder.pair(prepared, state, h)
    }
}

impl<S: System + Unforced> Scheme<S> for IntersectingSubTrajectories {
    type Carried = Points<S::Shape>;
    type Map<T: Real> = Interleaved<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Interleaved::new(prepared, step.h)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        self.start.pair(prepared, state, h * T::constant(0.5, 0.0))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn start_alone<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> Points<VectorOf<S, T>> {
        SecondPoint::SecondOrder.pair(prepared, state, h * T::constant(0.5, 0.0))
    }
}

/// The map of [`ConsecutiveSubTrajectories`] and [`IntersectingSubTrajectories`]: x is `z[n]`, y is
/// `z[n−½]`.
#[derive(Debug, Clone)]
pub struct Interleaved<V: Vector, F> {
    leap: F,
    half: V::Scalar,
}

impl<V: Vector, F: VectorField<V>> Interleaved<V, F> {
    fn new<D>(prepared: &D, leap: V::Scalar) -> Self
    where
        D: Dynamics<V::Scalar, Vector = V, Field = F>,
    {
        Interleaved {
            leap: prepared.field(leap),
            half: leap * V::Scalar::constant(0.5, 0.0),
        }
    }
}

impl<V: Vector, F: VectorField<V>> Map for Interleaved<V, F> {
    type Carried = Points<V>;
    type Work = ();

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: V::Scalar, _: V::Scalar, z: &mut Points<V>, _: &mut ()) {
        let Pair { x, y } = z;
        self.leap.add(t, &x.q, &x.p, &mut y.q, &mut y.p);
        self.leap.add(t + self.half, &y.q, &y.p, &mut x.q, &mut x.p);
    }
}
