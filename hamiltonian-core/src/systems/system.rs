//! The traits of a Hamiltonian system, as schemes need them; the `hamiltonian!` macro implements them.
//!
//! Input: parameters. Output: [`System`] → [`System::prepare`] → [`Dynamics`] → [`VectorField`], and
//! by [`Split`] and [`Separable`] exact flows. Invariant: every number that depends on parameters
//! alone is computed in `prepare`, every one that depends on parameters and a step coefficient where
//! the field or the flow is made; what remains per evaluation depends on (t, q, p) or, such as 1/m\[i\], on
//! an element of a parameter array.

use crate::errors::{Error, InputError};
use crate::systems::flow::{Piece, Pieces, VectorField};
mod description;
pub mod gather;

pub use description::{Description, Group, NamedPiece, Observable, ObservableKind, Text};

use crate::systems::state::{Gradient, Point, State};
use crate::systems::uneven::same_part;
use crate::systems::vector::{Shape, Vector};
use gather::{InPack, Kept};
use hamiltonian_lanes::{Dual, Pack, Real};

/// The coordinates of a system over a scalar, and its momenta, which have the same shape.
pub type VectorOf<S, T = f64> = <<S as System>::Shape as Shape>::Vector<T>;

/// A Hamiltonian H(q, p, t) with its parameters, over every scalar of states: `f64`, dual numbers, lanes of packs.
///
/// Signs: q̇ = ∂H/∂p, ṗ = −∂H/∂q. Units are the caller's. A bound `S: System` serves every scalar; a parameter may be
/// of any type that is a [`Parameter`](hamiltonian_lanes::Parameter).
///
/// The macro implements it for every definition. A system written by hand is generic over its scalar too:
///
/// ```
/// use hamiltonian::{Unforced, VectorOf, schemes::author::{Description, Dynamics, Group, InPack, Kept, VectorField, gather}};
/// use hamiltonian::lanes::Pack;
/// use hamiltonian::nalgebra::SVector;
/// use hamiltonian::prelude::*;
///
/// const GROUPS: &[Group] = &[Group::scalar("q", "p", 0)];
/// const SPRING: &Description = &Description::new("Spring", GROUPS);
///
/// /// H = ½(p² + ω²q²)
/// struct Spring {
///     omega: f64,
/// }
/// /// It, prepared.
/// #[derive(Debug, Clone)]
/// struct Ready<T> {
///     omega_squared: T,
/// }
///
/// impl System for Spring {
///     type Shape = SVector<(), 1>;
///     type Prepared<T: Real> = Ready<T>;
///     fn description(&self) -> &Description {
///         SPRING
///     }
///     fn prepare<T: Real>(&self) -> Ready<T> {
///         Ready { omega_squared: T::constant(self.omega * self.omega, 0.0) }
///     }
///     fn zeros<T: Real>(&self) -> SVector<T, 1> {
///         SVector::from_element(T::zero())
///     }
///     fn gather<T: Real, P: Pack>(members: &[&Ready<T>]) -> Ready<T::Over<P>> {
///         Ready { omega_squared: gather::number::<T, P, _>(members, |one| one.omega_squared) }
///     }
///     fn fits<T: Real>(_: &Ready<T>, _: &Ready<T>) -> bool {
///         true // no sizes that could differ
///     }
///     fn equals<T: Real>(a: &Ready<T>, b: &Ready<T>) -> bool {
///         a.omega_squared == b.omega_squared
///     }
/// }
/// impl Unforced for Spring {}
/// # impl<T: Real> Dynamics<T> for Ready<T> {
/// #     type Vector = SVector<T, 1>;
/// #     type Field = Scaled<T>;
/// #     fn description(&self) -> &Description { SPRING }
/// #     fn energy(&self, _: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> T { (p[0] * p[0] + self.omega_squared * q[0] * q[0]) * T::constant(0.5, 0.0) }
/// #     fn gradient_q(&self, _: T, q: &SVector<T, 1>, _: &SVector<T, 1>, out: &mut SVector<T, 1>) { out[0] = self.omega_squared * q[0]; }
/// #     fn gradient_p(&self, _: T, _: &SVector<T, 1>, p: &SVector<T, 1>, out: &mut SVector<T, 1>) { out[0] = p[0]; }
/// #     fn time_derivative(&self, _: T, _: &SVector<T, 1>, _: &SVector<T, 1>) -> T { T::zero() }
/// #     fn hessian_vector(&self, _: T, _: &SVector<T, 1>, _: &SVector<T, 1>, vq: &SVector<T, 1>, vp: &SVector<T, 1>, out_q: &mut SVector<T, 1>, out_p: &mut SVector<T, 1>) { out_q[0] = self.omega_squared * vq[0]; out_p[0] = vp[0]; }
/// #     fn field(&self, c: T) -> Scaled<T> { Scaled(self.clone(), c) }
/// #     fn in_pack<P: Pack, K: InPack<T, SVector<T, 1>, P>>(&self, kept: &mut Kept, kernel: K) -> Option<K::Output> {
/// #         gather::in_pack::<T, Spring, P, K>(self, kept, kernel)
/// #     }
/// # }
/// # #[derive(Debug, Clone)]
/// # struct Scaled<T>(Ready<T>, T);
/// # impl<T: Real> VectorField<SVector<T, 1>> for Scaled<T> {
/// #     fn add(&self, _: T, q: &SVector<T, 1>, p: &SVector<T, 1>, into_q: &mut SVector<T, 1>, into_p: &mut SVector<T, 1>) {
/// #         into_q[0] += self.1 * p[0];
/// #         into_p[0] -= self.1 * self.0.omega_squared * q[0];
/// #     }
/// # }
///
/// let start = |member: Member| {
///     let omega = 1.0 + member.index as f64;
///     (Spring { omega }, State::new([1.0], [0.0]))
/// };
/// let mut springs = Ensemble::new(3, start, Gauss::<2>::default(), 0.01)?;
/// springs.advance(100);
/// for (state, omega) in springs.states().zip([1.0, 2.0, 3.0]) {
///     assert!((state?.q[0] - f64::cos(omega)).abs() < 1e-6);
/// }
/// # Ok::<(), Error>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be a Hamiltonian system",
    label = "expected a system of `hamiltonian!`",
    note = "in generic code bound it by what is used: `S: System` for energies and gradients, and what the scheme requires, such as `S: Separable` or `S: Split`, for a run",
    note = "`new` of a system whose sizes are set at run time returns a `Result`: write `Name::new(…)?`"
)]
pub trait System {
    /// The shape of the coordinates, and of the momenta: `SVector<(), 2>` for coordinates `SVector<T, 2>` over `T`.
    type Shape: Shape;
    /// The prepared system over a scalar, with all that depends on parameters alone computed.
    type Prepared<T: Real>: Dynamics<T, Vector = VectorOf<Self, T>> + Send + Sync + 'static;

    /// The description of the system; for a definition it is a constant.
    fn description(&self) -> &Description;

    /// The number of dual numbers inside each other in its parameters: 1 for parameters `Dual<f64>`. Derivatives by
    /// coordinates are outside of these. They need as many dual numbers in the scalar of the states, or do not compile:
    /// the two derivatives would be one number. It is a constant, since rustc refuses what does not fit it.
    ///
    /// ```compile_fail,E0080
    /// use hamiltonian::prelude::*;
    ///
    /// let k = Dual::variable(4.0);
    /// let spring = hamiltonian! { H(x; y) = y^2/2 + k*x^2/2; monitor v = k*x };
    /// // ∂v/∂x + ∂v/∂k would come out.
    /// spring.observable_gradient("v", &State::new([0.5], [1.0]));
    /// ```
    /// Over the scalar of the parameters, both are there:
    /// ```
    /// # use hamiltonian::prelude::*;
    /// # let k = Dual::variable(4.0);
    /// # let spring = hamiltonian! { H(x; y) = y^2/2 + k*x^2/2; monitor v = k*x };
    /// let state = State::over([Dual::fixed(0.5)], [Dual::fixed(1.0)]);
    /// let slope = spring.observable_gradient("v", &state).unwrap().q[0];
    /// assert_eq!((slope.re, slope.eps), (4.0, 1.0)); // ∂v/∂x = k, and its derivative by k
    /// ```
    const DUALS: u32 = 0;

    /// Writes the parameters with their values, all digits of them, each on a line, `m = 1.5`; by
    /// them a saved run is recognised, and the members of a stored sweep. Without them a sweep recognises its members
    /// by the `Debug` text of what [`prepare`](System::prepare) returns.
    ///
    /// # Errors
    /// Those of the writer.
    fn describe_parameters(&self, _: &mut dyn core::fmt::Write) -> core::fmt::Result {
        Ok(())
    }

    /// Does all work that depends on parameters alone.
    fn prepare<T: Real>(&self) -> Self::Prepared<T>;
    /// The zero vector of this system's shape.
    fn zeros<T: Real>(&self) -> VectorOf<Self, T>;

    /// One prepared system with member k in lane k of the pack, and the last in the lanes that are left. There are at
    /// least one and at most [`MAX_MEMBERS`](gather::MAX_MEMBERS) members, and all of them [fit](System::fits) the first.
    fn gather<T: Real, P: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<P>>;
    /// Returns true if both may be in one pack: sizes set at run time are equal.
    fn fits<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool;
    /// Returns true if every parameter is equal in both.
    fn equals<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool;

    /// Checks that a state has the shape of the system. With sizes set at run time, a state of another length has the
    /// same type, and evaluation on it panics. Runs and starts make this check once.
    ///
    /// # Errors
    /// [`InputError::Shape`] with the first coordinate or momentum of another length, [`InputError::Extent`] with the
    /// first axis of another extent, [`InputError::Row`] with a row of another length than others.
    fn check_shape<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> Result<(), Error> {
        let zeros = self.zeros();
        check_shape_like(self.description(), [&zeros, &zeros], state)
    }

    /// H at a state.
    fn energy<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> T {
        self.prepare::<T>().energy(state.t, &state.q, &state.p)
    }
    /// ∂H/∂q and ∂H/∂p at a state.
    fn gradient<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> Gradient<VectorOf<Self, T>> {
        let mut gradient = Gradient {
            q: self.zeros(),
            p: self.zeros(),
        };
        self.prepare::<T>().gradient(
            state.t,
            &state.q,
            &state.p,
            &mut gradient.q,
            &mut gradient.p,
        );
        gradient
    }

    /// The force f on the momenta at a state, dp/dt = −∂H/∂q + f; zero if there is none.
    fn force_at<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> VectorOf<Self, T> {
        let mut force = self.zeros();
        let prepared = self.prepare::<T>();
        prepared.force(state.t, &state.q, &state.p, &mut force);
        force
    }

    /// The observable of that name at a state; `None` if there is none.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let (oscillator, state) = (Oscillator {}, State::new([1.0], [0.0]));
    /// // The oscillator declares none.
    /// assert_eq!(oscillator.observable_named("height", &state), None);
    /// ```
    fn observable_named<T: Real>(&self, name: &str, state: &State<VectorOf<Self, T>>) -> Option<T> {
        let index = self.description().observable_index(name)?;
        let prepared = self.prepare::<T>();
        Some(prepared.observable(index, state.t, &state.q, &state.p))
    }

    /// The derivatives of the observable of that name by all coordinates and momenta at a state; `None` if there is
    /// none. The observable is evaluated over dual numbers, once for each coordinate and momentum.
    fn observable_gradient<T: Real>(
        &self,
        name: &str,
        state: &State<VectorOf<Self, T>>,
    ) -> Option<Gradient<VectorOf<Self, T>>> {
        derivatives_are_free::<T, Self>();
        let index = self.description().observable_index(name)?;
        let prepared = self.prepare::<Dual<T>>();
        let dual = |from: &VectorOf<Self, T>| {
            let mut to = self.zeros::<Dual<T>>();
            for i in 0..from.len() {
                *to.component_mut(i) = Dual::fixed(from.component(i));
            }
            to
        };
        let (t, mut q, mut p) = (Dual::fixed(state.t), dual(&state.q), dual(&state.p));
        let mut gradient = Gradient {
            q: state.q.zeros_like(),
            p: state.p.zeros_like(),
        };
        for i in 0..state.q.len() {
            *q.component_mut(i) = Dual::variable(state.q.component(i));
            *gradient.q.component_mut(i) = prepared.observable(index, t, &q, &p).eps;
            *q.component_mut(i) = Dual::fixed(state.q.component(i));
            *p.component_mut(i) = Dual::variable(state.p.component(i));
            *gradient.p.component_mut(i) = prepared.observable(index, t, &q, &p).eps;
            *p.component_mut(i) = Dual::fixed(state.p.component(i));
        }
        Some(gradient)
    }
}

/// The largest number; 0 of none.
pub const fn deepest(all: &[u32]) -> u32 {
    let (mut most, mut at) = (0, 0);
    while at < all.len() {
        if all[at] > most {
            most = all[at];
        }
        at += 1;
    }
    most
}

/// Refuses to compile where derivatives by coordinates over `Dual<T>` would meet those of parameters.
pub(crate) fn derivatives_are_free<T: Real, S: System + ?Sized>() {
    const {
        assert!(
            T::DUALS >= S::DUALS,
            "the parameters are dual numbers, and the states are not: derivatives by coordinates would be added to those \
             by parameters. Use states over the scalar of the parameters, such as `Dual<f64>`"
        );
    }
}

/// How a single run is computed: [`Integrator::with_lanes`](crate::Integrator::with_lanes),
/// [`Integrator::fused`](crate::Integrator::fused) and `Integrator::with_threads` choose it. A prepared system carries
/// it to the maps and flows that are made of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Arithmetic {
    /// True if stages and loops use the lanes of the CPU's registers; the bits are the same without.
    pub lanes: bool,
    /// True if products fuse with sums in those lanes, on CPUs that can: other bits there than elsewhere.
    pub fused: bool,
    /// The number of threads on which loops over arrays run, within the threads of a run: the bits are the
    /// same with each number.
    pub threads: usize,
}

impl Default for Arithmetic {
    /// In lanes, unfused, on one thread.
    fn default() -> Self {
        Arithmetic {
            lanes: true,
            fused: false,
            threads: 1,
        }
    }
}

/// A prepared system: H and its derivatives at (t, q, p).
///
/// Output vectors have the system's shape and are overwritten.
pub trait Dynamics<T: Real>: Clone + core::fmt::Debug + Send + Sync {
    /// Coordinates and momenta.
    type Vector: Vector<Scalar = T>;
    /// J∇H, with the force where there is one, scaled by a step coefficient.
    type Field: VectorField<Self::Vector>;

    /// The description of the system, as [`System::description`] returns it. Nothing reads it within a step.
    fn description(&self) -> &Description;
    /// H.
    fn energy(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T;
    /// ∂H/∂q into `out`.
    fn gradient_q(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector);
    /// ∂H/∂p into `out`.
    fn gradient_p(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector);
    /// ∂H/∂q and ∂H/∂p; emitted code shares all common work, the provided one none.
    #[inline(always)]
    fn gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) {
        self.gradient_q(t, q, p, dq);
        self.gradient_p(t, q, p, dp);
    }
    /// H, returned, with ∂H/∂q and ∂H/∂p; emitted code shares all common work, the provided one none.
    #[inline(always)]
    fn energy_and_gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) -> T {
        self.gradient(t, q, p, dq, dp);
        self.energy(t, q, p)
    }
    /// ∂H/∂t.
    fn time_derivative(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T;
    /// The Hessian of H in (q, p) times (vq, vp): `out_q = H_qq·vq + H_qp·vp`,
    /// `out_p = H_pq·vq + H_pp·vp`.
    #[allow(clippy::too_many_arguments)]
    fn hessian_vector(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        vq: &Self::Vector,
        vp: &Self::Vector,
        out_q: &mut Self::Vector,
        out_p: &mut Self::Vector,
    );
    /// The force f on the momenta into `out`; the provided one is for systems without a force.
    fn force(&self, _: T, _: &Self::Vector, _: &Self::Vector, out: &mut Self::Vector) {
        out.set_zero();
    }
    /// Observable `index` of [`Description::observables`]; the provided one is for systems that have none.
    ///
    /// # Panics
    /// If there is no observable of that index.
    fn observable(&self, index: usize, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        panic!("observable {index} of 0")
    }
    /// J∇H, and the force where there is one, with the coefficient `c` folded into the prepared
    /// constants.
    fn field(&self, c: T) -> Self::Field;
    /// Adds what the [`field`](Dynamics::field) with the coefficient `c` adds, for a coefficient that changes with
    /// each evaluation. The provided method makes that field; a system whose field copies more than a few numbers
    /// overrides it.
    #[inline(always)]
    fn add_field(
        &self,
        c: T,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        into_q: &mut Self::Vector,
        into_p: &mut Self::Vector,
    ) {
        self.field(c).add(t, q, p, into_q, into_p);
    }

    /// How work on this system is computed; a field of emitted systems. The provided method, for systems
    /// written by hand, returns the default.
    #[inline(always)]
    fn arithmetic(&self) -> Arithmetic {
        Arithmetic::default()
    }
    /// Sets [`arithmetic`](Dynamics::arithmetic), also that of the fields and flows that are made of this
    /// system from now on. The provided method does nothing.
    fn set_arithmetic(&mut self, _: Arithmetic) {}

    /// Runs a kernel with this system in all lanes of the pack `P`, for
    /// [`gather::in_lanes`](crate::schemes::author::gather::in_lanes). The provided method, for systems written by
    /// hand, runs nothing and returns `None`: they stay scalar. For the prepared system of an `S: System` it may be
    /// [`gather::in_pack`](crate::schemes::author::gather::in_pack)`::<T, S, P, K>(self, kept, kernel)`. `kept` is memory
    /// of the caller's.
    #[inline(always)]
    fn in_pack<P: Pack, K: InPack<T, Self::Vector, P>>(
        &self,
        _kept: &mut Kept,
        _kernel: K,
    ) -> Option<K::Output> {
        None
    }
}

/// The declared H at a state: in another time, where H = g·(h + p_t), it is h, with g = ∂H/∂p_t.
#[inline(always)]
pub(crate) fn declared_energy<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    state: &State<VectorOf<S, T>>,
) -> T {
    declared_energy_at::<T, S>(prepared, state.t, &state.q, &state.p)
}

/// See [`declared_energy`].
#[inline(always)]
pub(crate) fn declared_energy_at<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    t: T,
    q: &VectorOf<S, T>,
    p: &VectorOf<S, T>,
) -> T {
    let energy = prepared.energy(t, q, p);
    let Some(last) = p.len().checked_sub(1) else {
        return energy;
    };
    if prepared.description().fictitious_time.is_none() {
        return energy;
    }
    let mut velocities = p.zeros_like();
    prepared.gradient_p(t, q, p, &mut velocities);
    energy / velocities.component(last) - p.component(last)
}

/// H is a sum of pieces with exact flows. Splittings require it.
///
/// Every [`Separable`] system implements it, with kick and drift as its pieces. So does every definition with declared
/// pieces, `split { A = …; B = …; }`, or for which the macro finds pieces. A force is part of the kick. Beside other
/// pieces, the force is a piece of its own, the innermost, `force`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to split into pieces with exact flows",
    label = "this scheme composes the flows of pieces of H",
    note = "in generic code bound the system, `S: Split`; every `S: Separable` splits too",
    note = "a system written by hand implements `Split`"
)]
pub trait Split: System {
    /// The pieces, the outermost first, in the order of [`Description::pieces`].
    type Pieces<T: Real>: Pieces<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The pieces.
    fn pieces<T: Real>() -> Self::Pieces<T>;
}

/// H = T(p, t) + V(q, t), proven at compile time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be separable",
    label = "this scheme takes H = T(p, t) + V(q, t)",
    note = "in generic code bound the system, `S: Separable`",
    note = "a system written by hand implements `Separable`"
)]
pub trait Separable: System {
    /// V: its flow is `p −= c·∂V/∂q(q, t)`; with a force, `p += c·(f − ∂V/∂q)`.
    type Kick<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// T: its flow is `q += c·∂T/∂p(p, t)`.
    type Drift<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The kick.
    fn kick<T: Real>() -> Self::Kick<T>;
    /// The drift.
    fn drift<T: Real>() -> Self::Drift<T>;
}

/// H = A(q, p) + V(q, t), with A at most quadratic in p and with an exact flow. Nyström schemes require it: then
/// {V, {V, {V, A}}} = 0.
///
/// The macro implements it if the two are the pieces of [`Split`], in either order, and if H is [`Separable`] with such
/// a T. Examples are T + V, and a potential with a uniform magnetic field or in a rotating frame. If H is separable, a
/// force that does not depend on p is part of the kick.
#[diagnostic::on_unimplemented(
    message = "H of `{Self}` is not known to be at most quadratic in p beside V(q, t)",
    label = "this scheme takes H = A(q, p) + V(q, t), with A at most quadratic in p",
    note = "in generic code bound the system, `S: Nystrom`",
    note = "a system written by hand implements `Nystrom`"
)]
pub trait Nystrom: System {
    /// V: its flow is `p −= c·∂V/∂q(q, t)`.
    type Kick<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// A.
    type Quadratic<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The kick.
    fn kick<T: Real>() -> Self::Kick<T>;
    /// The piece that is at most quadratic in p.
    fn quadratic<T: Real>() -> Self::Quadratic<T>;
}

/// No force acts besides −∂H/∂q. Schemes that cannot integrate a force require it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be without forces",
    label = "this scheme integrates H alone",
    note = "in generic code bound the system, `S: Unforced`",
    note = "for a system written by hand without a force: `impl Unforced for … {{}}`"
)]
pub trait Unforced {}

/// The flows of all pieces are exact. Splittings with a table of coefficients require it. A force that is not
/// affine in p has no exact flow: [`Strang`](crate::schemes::Strang) and its like integrate it by a symmetric sub-step
/// of order 2.
#[diagnostic::on_unimplemented(
    message = "the pieces of `{Self}` are not known to have exact flows",
    label = "this scheme has an order above 2 with exact flows alone",
    note = "in generic code bound the system, `S: Exact`",
    note = "for a system written by hand whose flows are exact: `impl Exact for … {{}}`"
)]
pub trait Exact {}

/// T = ½ pᵀM⁻¹p with constant M, proven at compile time.
#[diagnostic::on_unimplemented(
    message = "T of `{Self}` is not known to be ½ pᵀM⁻¹p with constant M",
    label = "this scheme integrates second-order equations",
    note = "in generic code bound the system, `S: QuadraticKinetic`",
    note = "for a system written by hand: `impl QuadraticKinetic for … {{}}`"
)]
pub trait QuadraticKinetic {}

/// H does not depend on t, proven at compile time.
#[diagnostic::on_unimplemented(
    message = "H of `{Self}` is not known to be independent of t",
    label = "this needs an H that does not depend on t",
    note = "in generic code bound the system, `S: Autonomous`",
    note = "for a system written by hand: `impl Autonomous for … {{}}`"
)]
pub trait Autonomous {}

/// Returns an error for a state of another shape than these coordinates and momenta.
pub(crate) fn check_shape_like<V: Vector>(
    description: &Description,
    [q, p]: [&V; 2],
    state: &State<V>,
) -> Result<(), Error> {
    let groups = description.groups.iter();
    let coordinates = groups.clone().map(|g| (g.part, &*g.coordinate));
    same_shape(coordinates, q, &state.q)?;
    let momenta = groups.map(|g| (g.part, &*g.momentum));
    Ok(same_shape(momenta, p, &state.p)?)
}

/// An error where a part has not the length the system asks for, with the name of the first group
/// in it.
fn same_shape<'a, V: Vector>(
    groups: impl Iterator<Item = (usize, &'a str)> + Clone,
    expected: &V,
    found: &V,
) -> Result<(), InputError> {
    (0..V::PARTS).try_for_each(|k| {
        let group = groups.clone().find(|(part, _)| *part == k);
        let name = group.map_or("", |(_, name)| name);
        let [expected, own] = [expected, found].map(|v| (v.extents(k), v.part(k).len()));
        same_part(name, found.uneven(k), expected, own)
    })
}
