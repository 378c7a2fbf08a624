//! The traits of a Hamiltonian system, as schemes need them; the `hamiltonian!` macro implements them.
//!
//! Input: parameters. Output: [`System`] → [`System::prepare`] → [`Dynamics`] → [`VectorField`], and
//! by [`Split`] and [`Separable`] exact flows. Invariant: every number that depends on parameters
//! alone is computed in `prepare`, every one that depends on parameters and a step coefficient where
//! the field or the flow is made; what remains per evaluation depends on (t, q, p) or, such as 1/m\[i\], on
//! an element of a parameter array.

mod description;
pub mod gather;
mod parameters;
mod structure;

pub use description::{Description, Group, Missing, NamedPiece, Observable, ObservableKind, Text};
pub use parameters::ParameterText;
pub use structure::{Autonomous, Exact, Nystrom, QuadraticKinetic, Separable, Split, Unforced};

use crate::errors::{Error, InputError};
use crate::systems::flow::VectorField;
use crate::systems::state::{Gradient, State};
use crate::systems::uneven::same_part;
use crate::systems::vector::{Shape, Vector};
use gather::{InPack, Kept};
use hamiltonian_lanes::{Dual, Pack, Real};

/// The coordinates of a system over a scalar, and its momenta, which have the same shape.
pub type VectorOf<S, T = f64> = <<S as System>::Shape as Shape>::Vector<T>;

/// A Hamiltonian H(q, p, t) with its parameters.
///
/// The equations of motion are q̇ = ∂H/∂p and ṗ = −∂H/∂q + f, where f is the [force](System::force_at), if there is
/// one. Any consistent system of units serves. `hamiltonian!` implements this trait for every definition.
///
/// The trait is generic over the scalar of states, so that a bound `S: System` serves all of them: `f64`, dual numbers
/// for derivatives, double-double numbers, and packs, whose lanes hold the members of an ensemble.
///
/// Schemes that take any H, such as [`Gauss`](crate::schemes::Gauss), require `System` alone. Others also require
/// [`Separable`], [`Split`], [`Exact`], [`Nystrom`], [`QuadraticKinetic`], [`Autonomous`] or [`Unforced`]. The table in
/// [`schemes`](crate::schemes) lists the requirements of each scheme.
///
/// # Systems written by hand
/// A system written by hand consists of three implementations: `System` (parameters and shape), [`Dynamics`] for the
/// prepared system (H and its derivatives), and [`VectorField`] for J∇H. `T::constant(x, 0.0)` makes a scalar of the
/// number `x`; the second argument is the part of the constant below the precision of `f64`.
///
/// ```
/// use hamiltonian::lanes::Pack;
/// use hamiltonian::nalgebra::SVector;
/// use hamiltonian::prelude::*;
/// use hamiltonian::schemes::author::{Description, Dynamics, Group, VectorField, gather};
/// use hamiltonian::Unforced;
/// use std::fmt;
///
/// const GROUPS: &[Group] = &[Group::scalar("q", "p", 0)];
/// const SPRING: &Description = &Description::new("Spring", GROUPS);
/// type Coordinates<T> = SVector<T, 1>;
///
/// /// H = (p² + ω²q²)/2
/// struct Spring {
///     omega: f64,
/// }
///
/// /// ω² over the scalar of the states.
/// #[derive(Debug, Clone)]
/// struct Prepared<T> {
///     omega_squared: T,
/// }
///
/// impl System for Spring {
///     type Shape = SVector<(), 1>;
///     type Prepared<T: Real> = Prepared<T>;
///     fn description(&self) -> &Description {
///         SPRING
///     }
///     fn describe_parameters(&self, to: &mut dyn fmt::Write) -> fmt::Result {
///         writeln!(to, "omega = {:?}", self.omega)
///     }
///     fn prepare<T: Real>(&self) -> Prepared<T> {
///         Prepared { omega_squared: T::constant(self.omega * self.omega, 0.0) }
///     }
///     fn zeros<T: Real>(&self) -> Coordinates<T> {
///         SVector::from_element(T::zero())
///     }
///     fn gather<T: Real, P: Pack>(members: &[&Prepared<T>]) -> Prepared<T::Over<P>> {
///         Prepared { omega_squared: gather::number::<T, P, _>(members, |one| one.omega_squared) }
///     }
///     fn fits<T: Real>(_: &Prepared<T>, _: &Prepared<T>) -> bool {
///         true // no sizes that could differ
///     }
///     fn equals<T: Real>(a: &Prepared<T>, b: &Prepared<T>) -> bool {
///         a.omega_squared == b.omega_squared
///     }
/// }
///
/// impl<T: Real> Dynamics<T> for Prepared<T> {
///     type Vector = Coordinates<T>;
///     type Field = Field<T>;
///     fn description(&self) -> &Description {
///         SPRING
///     }
///     fn energy(&self, _t: T, q: &Coordinates<T>, p: &Coordinates<T>) -> T {
///         (p[0] * p[0] + self.omega_squared * q[0] * q[0]) * T::constant(0.5, 0.0)
///     }
///     fn gradient_q(&self, _t: T, q: &Coordinates<T>, _p: &Coordinates<T>, out: &mut Coordinates<T>) {
///         out[0] = self.omega_squared * q[0];
///     }
///     fn gradient_p(&self, _t: T, _q: &Coordinates<T>, p: &Coordinates<T>, out: &mut Coordinates<T>) {
///         out[0] = p[0];
///     }
///     fn time_derivative(&self, _t: T, _q: &Coordinates<T>, _p: &Coordinates<T>) -> T {
///         T::zero()
///     }
///     fn hessian_vector(
///         &self, _t: T, _q: &Coordinates<T>, _p: &Coordinates<T>, vq: &Coordinates<T>, vp: &Coordinates<T>,
///         out_q: &mut Coordinates<T>, out_p: &mut Coordinates<T>,
///     ) {
///         out_q[0] = self.omega_squared * vq[0];
///         out_p[0] = vp[0];
///     }
///     fn field(&self, c: T) -> Field<T> {
///         Field { c, minus_c_omega_squared: -c * self.omega_squared }
///     }
/// }
///
/// /// c·J∇H = (c·p, −c·ω²q).
/// #[derive(Debug, Clone)]
/// struct Field<T> {
///     c: T,
///     minus_c_omega_squared: T,
/// }
///
/// impl<T: Real> VectorField<Coordinates<T>> for Field<T> {
///     #[cfg_attr(not(unoptimised), inline(always))]
///     fn add(
///         &self, _t: T, q: &Coordinates<T>, p: &Coordinates<T>,
///         into_q: &mut Coordinates<T>, into_p: &mut Coordinates<T>,
///     ) {
///         into_q[0] += self.c * p[0];
///         into_p[0] += self.minus_c_omega_squared * q[0];
///     }
/// }
///
/// /// No force acts, so that schemes without forces integrate it.
/// impl Unforced for Spring {}
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
    /// The shape of the coordinates, and of the momenta: their vector type with `()` in place of the scalar, for example
    /// `SVector<(), 2>` or `DVector<()>`. [`Vector`] lists the types.
    type Shape: Shape;
    /// The prepared system over a scalar: the values that depend on parameters alone.
    type Prepared<T: Real>: Dynamics<T, Vector = VectorOf<Self, T>> + Send + Sync + 'static;

    /// The description of the system; for a definition it is a constant.
    fn description(&self) -> &Description;

    /// The nesting depth of dual numbers in the parameters: 0 for `f64`, 1 for `Dual<f64>`. A system written by hand with
    /// parameters of a type `P: Parameter` has [`P::DUALS`](hamiltonian_lanes::Parameter::DUALS).
    ///
    /// Derivatives by coordinates are taken in one more dual number. Over states of a smaller depth than that of the
    /// parameters they would be added to the derivatives by parameters, which is a compile error:
    ///
    /// ```compile_fail,E0080
    /// use hamiltonian::prelude::*;
    ///
    /// let k = Dual::variable(4.0);
    /// let spring = hamiltonian! { H(x; y) = y^2/2 + k*x^2/2; monitor v = k*x };
    /// // ∂v/∂x + ∂v/∂k would come out.
    /// spring.observable_gradient("v", &State::new([0.5], [1.0]));
    /// ```
    /// Over the scalar of the parameters, both are computed:
    /// ```
    /// # use hamiltonian::prelude::*;
    /// # let k = Dual::variable(4.0);
    /// # let spring = hamiltonian! { H(x; y) = y^2/2 + k*x^2/2; monitor v = k*x };
    /// let state = State::over([Dual::fixed(0.5)], [Dual::fixed(1.0)]);
    /// let slope = spring.observable_gradient("v", &state).unwrap().q[0];
    /// assert_eq!((slope.re, slope.eps), (4.0, 1.0)); // ∂v/∂x = k, and its derivative by k
    /// ```
    const DUALS: u32 = 0;

    /// True if starting an operation takes longer than computing it, as in code that is interpreted. Members of an ensemble
    /// then share packs that are as wide as the CPU level has, not as wide as stays in registers; those over dual numbers do
    /// not. All observers share one copy of the code that advances members.
    const INTERPRETED: bool = false;

    /// The [`jumps`](Description::jumps) of the description. `None`, the default, if they are known at run time alone:
    /// [`StormerVerlet`](crate::schemes::StormerVerlet) then has both orders of kick and drift in a program.
    const JUMPS: Option<[bool; 2]> = None;

    /// Writes each parameter with its value and all its digits, one per line, `m = 1.5`.
    ///
    /// [`resume`](crate::Integrator::resume) compares these lines with those of the saved run. The provided method writes
    /// nothing, so that `resume` accepts a system with other parameters. Stores of sweeps then compare the `Debug` text
    /// of the prepared system.
    ///
    /// # Errors
    /// Those of the writer.
    fn describe_parameters(&self, _: &mut dyn core::fmt::Write) -> core::fmt::Result {
        Ok(())
    }

    /// Returns the text of [`describe_parameters`](System::describe_parameters) for a run, which writes it when it is saved.
    ///
    /// The provided method writes the text at once. A definition keeps a copy of its parameters instead, since most runs
    /// are never saved. So can a system by hand that implements `Clone`: `ParameterText::of(self.clone())`.
    fn parameter_text(&self) -> ParameterText {
        let text = ParameterText::of_now(self);
        ParameterText::by(move || text.clone())
    }

    /// Computes the values that depend on parameters alone.
    fn prepare<T: Real>(&self) -> Self::Prepared<T>;
    /// The zero vector of this system's shape.
    fn zeros<T: Real>(&self) -> VectorOf<Self, T>;

    /// Copies the prepared systems of members into the lanes of one: member k into lane k, the last member into the
    /// remaining lanes. Ensembles advance the members of this system together.
    ///
    /// [`gather::number`], [`gather::numbers`] and [`gather::vectors`] copy one field each. There are 1 to
    /// [`MAX_MEMBERS`](gather::MAX_MEMBERS) members, and all of them [fit](System::fits) the first. A wrong lane is a
    /// wrong trajectory in ensembles.
    fn gather<T: Real, P: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<P>>;
    /// Returns true if both may be in one pack: sizes set at run time are equal. An ensemble refuses a member that does
    /// not fit the first. Return true if the system has no such sizes.
    fn fits<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool;
    /// Returns true if every parameter is equal in both. Ensembles store equal systems once: if this is true for unequal
    /// ones, members have wrong parameters; if it is false for equal ones, only memory is lost.
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

    /// Returns H at a state.
    ///
    /// This method and those below prepare the system in each call. In a loop, prepare it once:
    /// `system.prepare::<f64>().energy(t, &q, &p)`.
    ///
    /// For a time-transformed system (`dt = g*ds`), it is g·(h + p_t), which vanishes on orbits;
    /// [`Integrator::energy`](crate::Integrator::energy) returns the declared h.
    ///
    /// # Panics
    /// If the state has another length, see [`check_shape`](System::check_shape).
    fn energy<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> T {
        self.prepare::<T>().energy(state.t, &state.q, &state.p)
    }
    /// Returns ∂H/∂q and ∂H/∂p at a state. For a time-transformed system they are those of g·(h + p_t).
    ///
    /// # Panics
    /// If the state has another length.
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

    /// Returns the force f on the momenta at a state, ṗ = −∂H/∂q + f; zero if there is none.
    ///
    /// # Panics
    /// If the state has another length.
    fn force_at<T: Real>(&self, state: &State<VectorOf<Self, T>>) -> VectorOf<Self, T> {
        let mut force = self.zeros();
        let prepared = self.prepare::<T>();
        prepared.force(state.t, &state.q, &state.p, &mut force);
        force
    }

    /// Returns the observable of that name (a monitor, an invariant or an event) at a state; `None` if there is none.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// hamiltonian! {
    ///     /// A ball above the ground.
    ///     pub struct Ball { g = 9.81 }
    ///     H(z; p) = p^2/2 + g*z;
    ///     monitor height_of_turn = z + p^2/(2*g)
    /// }
    ///
    /// let (ball, state) = (Ball { g: 10.0 }, State::new([1.0], [4.0]));
    /// assert_eq!(ball.observable_named("height_of_turn", &state), Some(1.8));
    /// assert_eq!(ball.observable_named("speed", &state), None);
    /// ```
    ///
    /// # Panics
    /// If the state has another length.
    fn observable_named<T: Real>(&self, name: &str, state: &State<VectorOf<Self, T>>) -> Option<T> {
        let index = self.description().observable_index(name)?;
        let prepared = self.prepare::<T>();
        Some(prepared.observable(index, state.t, &state.q, &state.p))
    }

    /// Returns the derivatives of the observable of that name by all coordinates and momenta at a state; `None` if there
    /// is none. The observable is evaluated over dual numbers, once for each coordinate and momentum.
    ///
    /// # Panics
    /// If the state has another length.
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
    /// False if lanes never fuse products on this system, whatever its [arithmetic](Dynamics::arithmetic): then there is
    /// no code for it.
    const FUSES: bool = true;

    /// The description of the system, as [`System::description`] returns it. Nothing reads it within a step.
    fn description(&self) -> &Description;
    /// H.
    fn energy(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T;
    /// ∂H/∂q into `out`.
    fn gradient_q(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector);
    /// ∂H/∂p into `out`.
    fn gradient_p(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector);
    /// ∂H/∂q and ∂H/∂p; emitted code shares all common work, the provided one none.
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
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
    #[cfg_attr(not(unoptimised), inline(always))]
    fn in_pack<P: Pack, K: InPack<T, Self::Vector, P>>(
        &self,
        _kept: &mut Kept,
        _kernel: K,
    ) -> Option<K::Output> {
        None
    }
}

/// [`declared_energy_at`] a state.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn declared_energy<T: Real, S: System>(
    prepared: &S::Prepared<T>,
    state: &State<VectorOf<S, T>>,
) -> T {
    declared_energy_at::<T, S>(prepared, state.t, &state.q, &state.p)
}

/// The declared H at a time, coordinates and momenta: for a time-transformed system, where H = g·(h + p_t), it is h, with
/// g = ∂H/∂p_t.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn declared_energy_at<T: Real, S: System>(
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
