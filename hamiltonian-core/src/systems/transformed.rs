//! Time transformed by a monitor function: K = g(q)·(H + p_t) as a system of its own.
//!
//! Input: a system, and a function g > 0 of its coordinates. Output: [`TimeTransformed`], whose
//! time is s with dt = g ds. Invariant: orbits on the shell K = 0 are those of H, and the lengths
//! of steps are part of the integrated system, not of a separate control.

use crate::errors::{Error, StartError};
use crate::systems::flow::VectorField;
use crate::systems::observed::Observed;
use crate::systems::state::{Pair, State};
use crate::systems::system::gather::{InPack, Kept, with_whole};
use crate::systems::system::{
    Arithmetic, Autonomous, Description, Dynamics, Group, ParameterText, System, Unforced,
    VectorOf, deepest,
};
use crate::systems::vector::{Over, Vector, dot};
use alloc::format;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use hamiltonian_lanes::{Mask, Pack, Real};
use nalgebra::SVector;

/// Coordinates and the time t, or momenta and that of the time, p_t.
pub type WithTime<V> = Pair<V, SVector<<V as Vector>::Scalar, 1>>;

/// The system H in the time s with dt = g ds: Hamilton's equations of
///
/// ```text
/// K(q, t, p, p_t) = g(q, p)·(H(q, p) + p_t)
/// ```
///
/// on the shell K = 0, where p_t = −H. The time t is the last coordinate, and `state.t` is s. A step h of s is a step of
/// about h·g in t, so g must be small where steps of t must be short.
///
/// `energy` and `gradient` of this system are those of K: on the shell its energy is 0, up to the error of the
/// scheme. A run, a [`Recorder`](crate::observers::Recorder) and an
/// [`EnergyDrift`](crate::observers::EnergyDrift) show the energy K/g − p_t = H. For a state, it is
/// `system.system.energy(&system.declared(&state))`.
///
/// g is a monitor that the system declares ([`by`](TimeTransformed::by)), or the H of another system of
/// the same shape ([`new`](TimeTransformed::new)). A definition whose H depends on no momentum is an error, so a
/// g(q) must be a monitor, or a [`System`] written by hand. In a `hamiltonian!` definition, `dt = g*ds` makes the same
/// change of time. There, H and g may depend on t, and a force may act. Here, neither is possible.
///
/// A scheme that is symplectic for K is symplectic in (q, t, p, p_t). For H = ½pᵀM⁻¹p + V(q) and g(q), use
/// [`TransformedVerlet`](crate::schemes::TransformedVerlet) and its compositions. For any H and g, use a scheme for any
/// system, such as [`Gauss`](crate::schemes::Gauss).
/// [`Paced`](crate::schemes::Paced) is the explicit alternative: reversible, and not symplectic.
///
/// Source: E. Hairer, Appl. Numer. Math. 25 (1997) 219, doi:10.1016/S0168-9274(97)00061-5; S. Reich, SIAM
/// J. Numer. Anal. 36 (1999) 1549, doi:10.1137/S0036142997329797; E. Hairer, C. Lubich, G. Wanner,
/// Geometric Numerical Integration (2006), section VIII.2.1, doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// // The oscillator as its own monitor: g = q²/2, dt = q²/2 ds.
/// let system = TimeTransformed::new(Oscillator {}, Oscillator {});
/// let start = system.start(&State::new([1.0], [0.0]))?;
/// let mut run = Integrator::new(&system, Gauss::<3>::default(), start, 0.05)?;
/// let end = system.declared(run.advance(20)?);
/// assert!((0.4..0.5).contains(&end.t) && (end.q[0] - end.t.cos()).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TimeTransformed<S, G> {
    /// H.
    pub system: S,
    /// g.
    pub monitor: G,
    description: Arc<Description>,
}

/// [`TimeTransformed`], prepared.
#[derive(Debug, Clone)]
pub struct InNewTime<P, G> {
    pub(crate) system: P,
    pub(crate) monitor: G,
    description: Arc<Description>,
}

impl<S: System + Clone> TimeTransformed<S, Observed<S>> {
    /// H in the time of a monitor that the system declares, by its name.
    ///
    /// # Errors
    /// [`ObservableError::Unknown`](crate::errors::ObservableError::Unknown) if it declares none of this name,
    /// [`ObservableError::Timed`](crate::errors::ObservableError::Timed) if it depends on time.
    pub fn by(system: S, monitor: &str) -> Result<Self, Error> {
        let monitor = Observed::new(system.clone(), monitor)?;
        Ok(TimeTransformed::new(system, monitor))
    }
}

impl<S: System, G> TimeTransformed<S, G> {
    /// H in the time of g: `monitor` is a system whose H is g, not a closure, because schemes need
    /// the derivatives of g.
    pub fn new(system: S, monitor: G) -> Self {
        let description = Arc::new(in_new_time::<VectorOf<S>>(system.description()));
        TimeTransformed {
            system,
            monitor,
            description,
        }
    }

    /// The start of a run from a state of H: s = 0, and p_t = −H.
    ///
    /// # Errors
    /// [`InputError::Shape`](crate::errors::InputError::Shape) for a state of another shape, [`StartError::Monitor`]
    /// if g is not positive there.
    pub fn start<T: Real>(
        &self,
        state: &State<VectorOf<S, T>>,
    ) -> Result<State<WithTime<VectorOf<S, T>>>, Error>
    where
        G: System<Shape = S::Shape>,
    {
        self.system.check_shape(state)?;
        self.monitor.check_shape(state)?;
        let monitor = self.monitor.prepare::<T>();
        let value = monitor.energy(state.t, &state.q, &state.p);
        if !T::zero().lt(value).all() {
            let value = value.to_f64();
            return Err(StartError::Monitor { value }.into());
        }
        let with = |x: &VectorOf<S, T>, time: T| Pair {
            x: x.clone(),
            y: SVector::from_element(time),
        };
        Ok(State {
            t: T::zero(),
            q: with(&state.q, state.t),
            p: with(&state.p, -self.system.energy(state)),
        })
    }

    /// The state of H for a state of the run, with its time t.
    pub fn declared<V: Vector>(&self, state: &State<WithTime<V>>) -> State<V> {
        State {
            t: state.q.y[0],
            q: state.q.x.clone(),
            p: state.p.x.clone(),
        }
    }
}

/// The description of a system in the time s: its last group is the time t. V is its vector.
fn in_new_time<V: Vector>(of: &Description) -> Description {
    let mut groups = of.groups.to_vec();
    groups.push(Group {
        part: V::PARTS,
        ..Group::scalar("t", "p_t", 0)
    });
    Description {
        name: of.name.clone(),
        formula: of.formula.clone(),
        groups: groups.into(),
        observables: of.observables.clone(),
        fictitious_time: Some("s".into()),
        is_autonomous: true,
        missing: of.missing.clone(),
        ..Description::NONE
    }
}

impl<S, G> System for TimeTransformed<S, G>
where
    S: System + Unforced + Autonomous,
    G: System<Shape = S::Shape> + Unforced + Autonomous,
{
    type Shape = Pair<S::Shape, SVector<(), 1>>;
    type Prepared<T: Real> = InNewTime<S::Prepared<T>, G::Prepared<T>>;
    const DUALS: u32 = deepest(&[S::DUALS, G::DUALS]);
    const INTERPRETED: bool = S::INTERPRETED;

    fn description(&self) -> &Description {
        &self.description
    }
    fn describe_parameters(&self, to: &mut dyn fmt::Write) -> fmt::Result {
        self.system.describe_parameters(to)?;
        let Description { name, formula, .. } = self.monitor.description();
        writeln!(to, "in the time of {name}: {formula}")?;
        self.monitor.describe_parameters(to)
    }
    fn parameter_text(&self) -> ParameterText {
        let [system, monitor] = [self.system.parameter_text(), self.monitor.parameter_text()];
        let Description { name, formula, .. } = self.monitor.description();
        let time = format!("in the time of {name}: {formula}\n");
        ParameterText::by(move || system.write() + &time + &monitor.write())
    }
    fn prepare<T: Real>(&self) -> Self::Prepared<T> {
        InNewTime {
            system: self.system.prepare(),
            monitor: self.monitor.prepare(),
            description: Arc::clone(&self.description),
        }
    }
    fn zeros<T: Real>(&self) -> WithTime<VectorOf<S, T>> {
        Pair {
            x: self.system.zeros(),
            y: SVector::from_element(T::zero()),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<T: Real, L: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<L>> {
        let systems: Vec<_> = members.iter().map(|one| &one.system).collect();
        let monitors: Vec<_> = members.iter().map(|one| &one.monitor).collect();
        InNewTime {
            system: S::gather::<T, L>(&systems),
            monitor: G::gather::<T, L>(&monitors),
            description: Arc::clone(&members[0].description),
        }
    }
    fn fits<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool {
        S::fits(&a.system, &b.system) && G::fits(&a.monitor, &b.monitor)
    }
    fn equals<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool {
        S::equals(&a.system, &b.system) && G::equals(&a.monitor, &b.monitor)
    }
}

impl<S: Unforced, G> Unforced for TimeTransformed<S, G> {}
impl<S: Autonomous, G> Autonomous for TimeTransformed<S, G> {}

impl<T, P, G> Dynamics<T> for InNewTime<P, G>
where
    T: Real,
    P: Dynamics<T>,
    G: Dynamics<T, Vector = P::Vector>,
{
    type Vector = WithTime<P::Vector>;
    type Field = FieldInNewTime<P, G, T>;

    fn description(&self) -> &Description {
        &self.description
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn energy(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        let scale = self.monitor.energy(t, &q.x, &p.x);
        scale * (self.system.energy(t, &q.x, &p.x) + p.y[0])
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient_q(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        let mut other = p.zeros_like();
        self.energy_and_gradient(t, q, p, out, &mut other);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient_p(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        let mut other = q.zeros_like();
        self.energy_and_gradient(t, q, p, &mut other, out);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) {
        self.energy_and_gradient(t, q, p, dq, dp);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn energy_and_gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) -> T {
        let scale = self.monitor.energy(t, &q.x, &p.x);
        let energy = (self.system).energy_and_gradient(t, &q.x, &p.x, &mut dq.x, &mut dp.x);
        let shell = energy + p.y[0];
        dp.x.scale(scale);
        // A field subtracts ∂g/∂q.
        dq.x.scale(-scale);
        (self.monitor).add_field(shell, t, &q.x, &p.x, &mut dp.x, &mut dq.x);
        dq.x.scale(-T::one());
        dq.y[0] = T::zero();
        dp.y[0] = scale;
        scale * shell
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn time_derivative(&self, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        T::zero()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn hessian_vector(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        vq: &Self::Vector,
        vp: &Self::Vector,
        out_q: &mut Self::Vector,
        out_p: &mut Self::Vector,
    ) {
        let (p_t, vp_t) = (p.y[0], vp.y[0]);
        let (q, p, vq, vp) = (&q.x, &p.x, &vq.x, &vp.x);
        let [mut h_q, mut h_p, mut g_q, mut g_p] = [q, p, q, p].map(Vector::zeros_like);
        let (system, monitor) = (&self.system, &self.monitor);
        let shell = system.energy_and_gradient(t, q, p, &mut h_q, &mut h_p) + p_t;
        let scale = monitor.energy_and_gradient(t, q, p, &mut g_q, &mut g_p);
        let moved_scale = dot(&g_q, vq) + dot(&g_p, vp);
        let moved_shell = dot(&h_q, vq) + dot(&h_p, vp) + vp_t;
        system.hessian_vector(t, q, p, vq, vp, &mut out_q.x, &mut out_p.x);
        out_q.x.scale(scale);
        out_p.x.scale(scale);
        out_q.x.accumulate(moved_scale, &h_q);
        out_p.x.accumulate(moved_scale, &h_p);
        out_q.x.accumulate(moved_shell, &g_q);
        out_p.x.accumulate(moved_shell, &g_p);
        monitor.hessian_vector(t, q, p, vq, vp, &mut g_q, &mut g_p);
        out_q.x.accumulate(shell, &g_q);
        out_p.x.accumulate(shell, &g_p);
        out_q.y[0] = T::zero();
        out_p.y[0] = moved_scale;
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn observable(&self, index: usize, _: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.system.observable(index, q.y[0], &q.x, &p.x)
    }
    fn arithmetic(&self) -> Arithmetic {
        self.system.arithmetic()
    }
    fn set_arithmetic(&mut self, arithmetic: Arithmetic) {
        self.system.set_arithmetic(arithmetic);
        self.monitor.set_arithmetic(arithmetic);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn field(&self, c: T) -> Self::Field {
        FieldInNewTime {
            system: self.system.clone(),
            monitor: self.monitor.clone(),
            c,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn in_pack<L: Pack, K: InPack<T, Self::Vector, L>>(
        &self,
        kept: &mut Kept,
        kernel: K,
    ) -> Option<K::Output> {
        let to_monitor = ToMonitor {
            monitor: &self.monitor,
            description: &self.description,
            kernel,
        };
        self.system.in_pack::<L, _>(kept, to_monitor)?
    }
}

/// A kernel on its way to packs: the system is there, the monitor follows.
struct ToMonitor<'a, G, K> {
    monitor: &'a G,
    description: &'a Arc<Description>,
    kernel: K,
}

impl<T, G, L, K> InPack<T, G::Vector, L> for ToMonitor<'_, G, K>
where
    T: Real,
    G: Dynamics<T>,
    L: Pack,
    K: InPack<T, WithTime<G::Vector>, L>,
{
    type Output = Option<K::Output>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<D>(self, system: &D, kept: &mut Kept) -> Self::Output
    where
        D: Dynamics<T::Over<L>, Vector = Over<G::Vector, T::Over<L>>> + 'static,
    {
        let ToMonitor {
            monitor,
            description,
            kernel,
        } = self;
        let to_both = ToBoth {
            system,
            description,
            kernel,
        };
        monitor.in_pack::<L, _>(kept, to_both)
    }
}

/// A kernel for the system in the packs where it is, when the monitor is there too.
struct ToBoth<'a, D, K> {
    system: &'a D,
    description: &'a Arc<Description>,
    kernel: K,
}

impl<T, V, D, L, K> InPack<T, V, L> for ToBoth<'_, D, K>
where
    T: Real,
    V: Vector<Scalar = T>,
    D: Dynamics<T::Over<L>, Vector = Over<V, T::Over<L>>> + 'static,
    L: Pack,
    K: InPack<T, WithTime<V>, L>,
{
    type Output = K::Output;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<G>(self, monitor: &G, kept: &mut Kept) -> K::Output
    where
        G: Dynamics<T::Over<L>, Vector = Over<V, T::Over<L>>> + 'static,
    {
        let whole = || InNewTime {
            system: self.system.clone(),
            monitor: monitor.clone(),
            description: Arc::clone(self.description),
        };
        with_whole(kept, |_| true, whole, self.kernel)
    }
}

/// c·J∇K.
#[derive(Debug, Clone)]
pub struct FieldInNewTime<P, G, T> {
    system: P,
    monitor: G,
    c: T,
}

impl<T, P, G> VectorField<WithTime<P::Vector>> for FieldInNewTime<P, G, T>
where
    T: Real,
    P: Dynamics<T>,
    G: Dynamics<T, Vector = P::Vector>,
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(
        &self,
        t: T,
        q: &WithTime<P::Vector>,
        p: &WithTime<P::Vector>,
        into_q: &mut WithTime<P::Vector>,
        into_p: &mut WithTime<P::Vector>,
    ) {
        let FieldInNewTime {
            system, monitor, ..
        } = self;
        let scale = self.c * monitor.energy(t, &q.x, &p.x);
        let shell = self.c * (system.energy(t, &q.x, &p.x) + p.y[0]);
        system.add_field(scale, t, &q.x, &p.x, &mut into_q.x, &mut into_p.x);
        monitor.add_field(shell, t, &q.x, &p.x, &mut into_q.x, &mut into_p.x);
        into_q.y[0] += scale;
    }
}
