//! Schemes: types that make one-step maps for a prepared system and a step.
//!
//! Input: a prepared system. Output: [`Scheme::prepare`] returns a [`Map`], [`Scheme::start`] the value that it
//! carries. Invariant: the requirements of a scheme are the bounds of its implementation, so a wrong pairing is a
//! compile error.

use crate::errors::Error;
use crate::flows::map::{Map, Step};
use crate::systems::state::{CarriedShape, State};
use crate::systems::system::{Description, System, VectorOf};
use core::fmt::Debug;
use hamiltonian_lanes::Real;

/// The 2-form a step preserves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// dq∧dp of the state itself: the scheme is symplectic.
    OnePoint,
    /// dq∧dp + dq̃∧dp̃ of two copies of the state that the scheme carries, and not dq∧dp of the
    /// observed one.
    TwoCopies,
    /// dq_a∧dp_b + dq_b∧dp_a of two points a and b that the scheme carries, and not dq∧dp of
    /// the observed one.
    TwoPoint,
    /// dq∧dp of the point that the scheme carries, and not of the observed one.
    CarriedPoint,
    /// dq∧dp of the state up to O(h^(2p+2)) a step for order p: the scheme is pseudo-symplectic.
    Nearly,
    /// None.
    Nothing,
}

/// The structure that a scheme requires of a system: a set of traits.
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::author::{Listed, Needs};
///
/// let needs = GaussNystrom::<2>::default().entry().needs;
/// assert!(needs.contains(Needs::UNFORCED));
/// assert_eq!(needs.to_string(), "Unforced + Separable + QuadraticKinetic");
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Needs(u8);

impl Needs {
    /// Nothing: any H(q, p, t), with forces.
    pub const ANY: Self = Needs(0);
    /// No forces, [`Unforced`](crate::Unforced).
    pub const UNFORCED: Self = Needs(1);
    /// Pieces, [`Split`](crate::Split).
    pub const SPLIT: Self = Needs(1 << 1);
    /// Flows that are all exact, [`Exact`](crate::Exact).
    pub const EXACT: Self = Needs(1 << 2);
    /// H = T(p, t) + V(q, t), [`Separable`](crate::Separable).
    pub const SEPARABLE: Self = Needs(1 << 3);
    /// H = A(q, p) + V(q, t), A at most quadratic in p: [`Nystrom`](crate::Nystrom).
    pub const NYSTROM: Self = Needs(1 << 4);
    /// T = ½ pᵀM⁻¹p with constant M, [`QuadraticKinetic`](crate::QuadraticKinetic).
    pub const QUADRATIC_KINETIC: Self = Needs(1 << 5);
    /// H(q, p) without t, [`Autonomous`](crate::Autonomous).
    pub const AUTONOMOUS: Self = Needs(1 << 6);
    /// A time-transformed system, [`TimeTransformed`](crate::TimeTransformed). The other traits are those of the system
    /// inside.
    pub const TIME_TRANSFORMED: Self = Needs(1 << 7);

    /// Each requirement, with the name of its trait or type.
    pub const ALL: [(Self, &str); 8] = [
        (Self::UNFORCED, "Unforced"),
        (Self::SPLIT, "Split"),
        (Self::EXACT, "Exact"),
        (Self::SEPARABLE, "Separable"),
        (Self::NYSTROM, "Nystrom"),
        (Self::QUADRATIC_KINETIC, "QuadraticKinetic"),
        (Self::AUTONOMOUS, "Autonomous"),
        (Self::TIME_TRANSFORMED, "TimeTransformed"),
    ];

    /// Both requirements.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Needs(self.0 | other.0)
    }

    /// Returns true if all that `other` requires is required.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

/// The names with `+` between them, or `any`.
impl core::fmt::Display for Needs {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut names = (Needs::ALL.iter())
            .filter(|(one, _)| self.contains(*one))
            .map(|(_, name)| name);
        f.write_str(names.next().unwrap_or(&"any"))?;
        names.try_for_each(|name| write!(f, " + {name}"))
    }
}

impl Debug for Needs {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(self, f)
    }
}

/// Facts about a scheme: one line of the [catalogue](crate::schemes::author::catalogue).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// The type's name.
    pub name: &'static str,
    /// The variant, in words; empty if there is none.
    pub variant: &'static str,
    /// The numbers of its equations in the paper; empty if it is not in the paper.
    pub equations: &'static str,
    /// The error of a trajectory is O(Δt^order).
    pub order: u32,
    /// The time that one step advances, in units of the step size Δt.
    pub duration: u32,
    /// The structure that it requires of a system.
    pub needs: Needs,
    /// The form it preserves.
    pub preserves: Form,
    /// Author, year, equation, DOI.
    pub source: &'static str,
}

/// The name, with the setting in parentheses: `StormerVerlet (kick-drift-kick)`.
impl core::fmt::Display for Entry {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.variant {
            "" => f.write_str(self.name),
            variant => write!(f, "{} ({variant})", self.name),
        }
    }
}

/// A scheme with an entry in the catalogue. Its `Debug` text contains all its settings; a saved run resumes only with a
/// scheme of the same text.
pub trait Listed: Clone + Debug + Send + Sync + 'static {
    /// The entry.
    fn entry(&self) -> Entry;
}

/// What the scheme `M` carries from step to step of the system `S` over a scalar.
pub type CarriedBy<M, S, T = f64> =
    <<M as Scheme<S>>::Carried as CarriedShape<<S as System>::Shape>>::Of<T>;

/// A one-step integration scheme for the system `S`: it makes the map of a step, z → Φₕ(z), over any scalar.
///
/// The bounds of an implementation are the requirements on the system, so that a scheme on a system without the
/// structure does not compile. Code that is generic over systems and schemes repeats these bounds:
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// fn drift<S: Separable, M: Scheme<S>>(system: &S, scheme: M, start: StateOf<S>) -> Result<f64, Error> {
///     let mut run = Integrator::new(system, scheme, start, 0.01)?.observe(EnergyDrift::new());
///     run.advance(100)?;
///     Ok(run.observer().max_relative())
/// }
/// assert!(drift(&Oscillator {}, BlanesMoan4, State::new([1.0], [0.0]))? < 1e-8);
/// # Ok::<(), Error>(())
/// ```
///
/// # Schemes of your own
/// A scheme implements [`Listed`], which describes it, [`prepare`](Scheme::prepare), which makes the [`Map`] of a step,
/// and [`start`](Scheme::start). The other methods are provided. Compositions of the scheme also require [`OneStep`],
/// and some of them [`Symmetric`]. [`schemes::author`](crate::schemes::author) has all that an implementation names. The
/// chapter "Extending" of the guide continues this example:
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::author::{Dynamics, Entry, Form, Listed, Map, Needs, Point, Step, VectorField};
/// use hamiltonian::VectorOf;
/// use std::marker::PhantomData;
///
/// hamiltonian! {
///     /// A mass on a spring.
///     pub struct Oscillator {}
///     H(q; p) = p^2/2 + q^2/2
/// }
///
/// /// Runge's explicit midpoint rule, z ← z + h J∇H(z + h/2 J∇H(z)).
/// #[derive(Debug, Clone)]
/// struct Runge;
///
/// impl Listed for Runge {
///     fn entry(&self) -> Entry {
///         Entry {
///             name: "Runge",
///             variant: "",
///             equations: "",
///             order: 2,
///             duration: 1,
///             needs: Needs::ANY,
///             preserves: Form::Nothing,
///             source: "C. Runge, Math. Ann. 46 (1895) 167, doi:10.1007/BF01446807",
///         }
///     }
/// }
///
/// impl<S: System> Scheme<S> for Runge {
///     type Carried = Point<S::Shape>;
///     type Map<T: Real> = Midpoint<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
///     #[cfg_attr(not(unoptimised), inline(always))]
///     fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
///         let half = step.h * T::constant(0.5, 0.0);
///         Midpoint { half: prepared.field(half), whole: prepared.field(step.h), vector: PhantomData }
///     }
///     #[cfg_attr(not(unoptimised), inline(always))]
///     fn start<T: Real>(&self, _: &S::Prepared<T>, state: &StateOf<S, T>, _: T) -> Point<VectorOf<S, T>> {
///         state.point()
///     }
/// }
///
/// /// J∇H times half a step, and times a step.
/// struct Midpoint<V, F> {
///     half: F,
///     whole: F,
///     vector: PhantomData<V>,
/// }
///
/// impl<V: Vector, F: VectorField<V>> Map for Midpoint<V, F> {
///     type Carried = Point<V>;
///     type Work = Point<V>;
///     #[cfg_attr(not(unoptimised), inline(always))]
///     fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Point<V>, middle: &mut Point<V>) {
///         middle.copy_from(z);
///         self.half.add(t, &z.q, &z.p, &mut middle.q, &mut middle.p);
///         let t = (t + end) * V::Scalar::constant(0.5, 0.0);
///         self.whole.add(t, &middle.q, &middle.p, &mut z.q, &mut z.p);
///     }
/// }
///
/// let mut run = Integrator::new(&Oscillator {}, Runge, State::new([1.0], [0.0]), 1e-3)?;
/// assert!((run.advance(1_000)?.q[0] - 1_f64.cos()).abs() < 1e-6);
/// # Ok::<(), Error>(())
/// ```
///
/// Mark the methods of `Scheme` and `Map` `#[cfg_attr(not(unoptimised), inline(always))]`: the members of an ensemble lie in the lanes of packs, and
/// the compiler uses vector instructions only in functions that it inlines. Otherwise results are the same, and ensembles
/// many times slower.
pub trait Scheme<S: System>: Listed {
    /// The shape of the value that is carried from step to step: for most schemes `Point<S::Shape>`, the coordinates and
    /// momenta of a [`Point`](crate::schemes::author::Point). A scheme with a second point carries a
    /// [`Pair`](crate::schemes::author::Pair).
    type Carried: CarriedShape<S::Shape>;
    /// The map of a step: the system's flows or fields, with all coefficients multiplied in.
    type Map<T: Real>: Map<Carried = CarriedBy<Self, S, T>>;
    /// Makes the map for steps of the size `step.h`. Products of coefficients, parameters and the step size are computed
    /// here, once for all steps. [`Paced`](crate::schemes::Paced) makes maps within its steps, so that `prepare` should
    /// not allocate.
    ///
    /// `step.before` is another size in compositions alone: that of the step whose closing piece [`Map::join`] applies.
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T>;
    /// Makes one step of the size `h`, from the time `t` to `end`: changes the carried value `z`, with the scratch `work`
    /// of the map. The result has the bits of [`Map::step`] of the map for this step.
    ///
    /// [`Paced`] calls it in each step. The provided method prepares the map. A splitting of several stages makes each
    /// flow where it applies it, by [`Zigzag::once`](crate::schemes::author::Zigzag::once), which stores no stages.
    ///
    /// [`Paced`]: crate::schemes::Paced
    #[cfg_attr(not(unoptimised), inline(always))]
    fn step<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        h: T,
        [t, end]: [T; 2],
        z: &mut CarriedBy<Self, S, T>,
        work: &mut <Self::Map<T> as Map>::Work,
    ) {
        self.prepare(prepared, Step::of(h)).step(t, end, z, work);
    }
    /// Returns the first and the last time at which a step evaluates parts of H that [jump](Description::jumps) in time.
    /// 0 is the beginning of the step and 1 its end.
    ///
    /// A run of a system with such parts requires that both lie between 0 and 1, so that steps may end at the jumps;
    /// otherwise [`Integrator::new`](crate::Integrator::new) returns
    /// [`StartError::Jumps`](crate::errors::StartError::Jumps). The provided method returns 0 and 1. A splitting returns
    /// `self.times_on(system.jumping_pieces())`.
    fn times_of_jumps(&self, _: &Description) -> [f64; 2] {
        [0.0, 1.0]
    }
    /// Checks whether the scheme can integrate this system from this state, for reasons that the bounds of the
    /// implementation do not express. [`Integrator::new`](crate::Integrator::new),
    /// [`set_state`](crate::Integrator::set_state), [`set_system`](crate::Integrator::set_system) and the members of
    /// ensembles call it. The provided method accepts all.
    ///
    /// # Errors
    /// Any error, for example by [`Error::other`]. The schemes of this crate return
    /// [`StartError::MonitorOfMomenta`](crate::errors::StartError::MonitorOfMomenta).
    fn check<T: Real>(&self, _: &S::Prepared<T>, _: &State<VectorOf<S, T>>) -> Result<(), Error> {
        Ok(())
    }
    /// Makes the map of a step that follows a step of `before`, the same scheme with other settings, in a
    /// [`Composition`](crate::schemes::Composition). Its [`Map::join`] applies the closing piece of `before`. `None` if
    /// the two cannot be joined; each step then is a whole one. The provided method joins equal schemes.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare_after<T: Real>(
        &self,
        before: &Self,
        prepared: &S::Prepared<T>,
        step: Step<T>,
    ) -> Option<Self::Map<T>>
    where
        Self: OneStep,
    {
        (self == before).then(|| self.prepare(prepared, step))
    }
    /// Returns the carried value for a run of steps of the size `h` from a state, for example
    /// [`State::point`](crate::State::point).
    fn start<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> CarriedBy<Self, S, T>;
    /// Returns the carried value for one step alone, as [`state_at`](crate::Integrator::state_at) makes it for states
    /// between two steps. The provided method is [`start`](Scheme::start). A scheme with a second point that `start`
    /// computes to first order computes it to second order here.
    fn start_alone<T: Real>(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> CarriedBy<Self, S, T> {
        self.start(prepared, state, h)
    }
}

/// A scheme whose step depends on the state alone, so that steps of different sizes can follow each
/// other.
///
/// The paper's (25), (26) and (33) are no such schemes: a value that they carry lags behind by a
/// time that depends on the step, and a composition of them loses its order (Yoshida's of (33) has
/// slope 0.8 instead of 4). A scheme whose observed state is a mean,
/// [`CheapProcessed`](crate::schemes::CheapProcessed), is none either: the inverse of a mean is no composition of
/// flows.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no one-step scheme",
    label = "steps of different sizes cannot be composed of it",
    note = "the paper's (25), (26) and (33) carry a second point that lags behind by a time which \
            depends on the step: a composition of them loses its order; compose `Strang`, \
            `StormerVerlet`, `ImplicitMidpoint` or `Pihajoki`",
    note = "the observed state of a `CheapProcessed` scheme is a mean, whose inverse is no composition of flows: \
            compose `Processed4` instead"
)]
pub trait OneStep: Listed + PartialEq {
    /// The type of its adjoint.
    type Adjoint: OneStep;
    /// The adjoint scheme Φ*ₕ = (Φ₋ₕ)⁻¹; symmetric schemes are their own.
    fn adjoint(&self) -> Self::Adjoint;
}

/// A scheme that is its own adjoint, Φₕ = (Φ₋ₕ)⁻¹, for all settings: its order is even.
///
/// An adjoint of the same type is not enough: that of `SymplecticEuler::KickDrift` is
/// `SymplecticEuler::DriftKick`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be symmetric",
    label = "expected a scheme that is its own adjoint",
    note = "weights for symmetric schemes have their order with those alone; \
            `Composition::with_adjoint(…)` makes a symmetric scheme of order 2 of one whose adjoint has its type",
    note = "for a scheme of yours that is its own adjoint: `impl Symmetric for … {{}}`"
)]
pub trait Symmetric: OneStep<Adjoint = Self> {}
