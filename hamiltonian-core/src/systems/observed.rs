//! An observable of a system as a Hamiltonian.
//!
//! Input: a system and the name of one of its observables. Output: [`Observed`], a system whose H is the observable.
//! Invariant: derivatives are computed by the observable's code over dual numbers.

use crate::errors::{Error, ObservableError};
use crate::systems::flow::VectorField;
use crate::systems::system::gather::{InPack, Kept, with_whole};
use crate::systems::system::{
    Autonomous, Description, Dynamics, ParameterText, System, Unforced, VectorOf,
    derivatives_are_free,
};
use crate::systems::vector::{Over, Vector};
use alloc::format;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use hamiltonian_lanes::{Dual, Pack, Real};

/// A system whose Hamiltonian is a monitor, invariant or event of another system.
///
/// It can be the monitor function of [`TimeTransformed`](crate::TimeTransformed). Its flow is the symmetry that an
/// invariant generates. Derivatives are computed over dual numbers: one evaluation for each coordinate and momentum,
/// for the gradient and for the product of the Hessian and a vector.
///
/// ```
/// use hamiltonian::schemes::author::Observed;
#[doc = include_str!("../doc/oscillator.md")]
///
/// // The oscillator declares no observable.
/// assert!(Observed::new(Oscillator {}, "height").is_err());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Observed<S> {
    system: S,
    description: Arc<Description>,
    index: usize,
}

impl<S: System> Observed<S> {
    /// Creates the system for the observable of this name: `height`, or `angular_momentum[2]` for a component.
    ///
    /// # Errors
    /// [`ObservableError::Unknown`] if the system does not declare it, [`ObservableError::Timed`] if it depends on
    /// time.
    pub fn new(system: S, name: &str) -> Result<Self, Error> {
        let known = system.description();
        let Some(index) = known.observable_index(name) else {
            return Err(known.unknown(name).into());
        };
        let observable = &known.observables[index];
        if observable.depends_on_time {
            return Err(ObservableError::Timed {
                name: (*observable.name).into(),
                system: (*known.name).into(),
            }
            .into());
        }
        let description = Arc::new(Description {
            name: known.name.clone(),
            formula: format!("{} of {}", observable.name, known.formula).into(),
            groups: known.groups.clone(),
            ..Description::NONE
        });
        Ok(Observed {
            system,
            description,
            index,
        })
    }
}

impl<S> Unforced for Observed<S> {}
/// [`Observed::new`] refuses observables that depend on time.
impl<S> Autonomous for Observed<S> {}

impl<S: System> System for Observed<S> {
    type Shape = S::Shape;
    type Prepared<T: Real> =
        ReadyObserved<T, S::Prepared<T>, S::Prepared<Dual<T>>, S::Prepared<Dual<Dual<T>>>>;
    const DUALS: u32 = S::DUALS;
    const INTERPRETED: bool = S::INTERPRETED;

    fn description(&self) -> &Description {
        &self.description
    }
    fn describe_parameters(&self, to: &mut dyn fmt::Write) -> fmt::Result {
        self.system.describe_parameters(to)
    }
    fn parameter_text(&self) -> ParameterText {
        self.system.parameter_text()
    }
    fn prepare<T: Real>(&self) -> Self::Prepared<T> {
        derivatives_are_free::<T, S>();
        ReadyObserved {
            plain: self.system.prepare(),
            first: ready::<_, Dual<T>>(&self.system),
            second: ready::<_, Dual<Dual<T>>>(&self.system),
            description: Arc::clone(&self.description),
            index: self.index,
        }
    }
    fn zeros<T: Real>(&self) -> VectorOf<S, T> {
        self.system.zeros()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<T: Real, L: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<L>> {
        let plain: Vec<_> = members.iter().map(|one| &one.plain).collect();
        let first: Vec<_> = members.iter().map(|one| &one.first.0).collect();
        let second: Vec<_> = members.iter().map(|one| &one.second.0).collect();
        let [one, ..] = members else {
            unreachable!("there is at least one member")
        };
        ReadyObserved {
            plain: S::gather::<T, L>(&plain),
            first: (S::gather::<Dual<T>, L>(&first), one.first.1.zeros_over()),
            second: (
                S::gather::<Dual<Dual<T>>, L>(&second),
                one.second.1.zeros_over(),
            ),
            description: Arc::clone(&one.description),
            index: one.index,
        }
    }
    fn fits<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool {
        a.index == b.index && S::fits(&a.plain, &b.plain)
    }
    fn equals<T: Real>(a: &Self::Prepared<T>, b: &Self::Prepared<T>) -> bool {
        a.index == b.index && S::equals(&a.plain, &b.plain)
    }
}

/// A prepared system with zeros of its shape.
type Ready<F, T> = (F, <F as Dynamics<T>>::Vector);

fn ready<S: System, T: Real>(system: &S) -> Ready<S::Prepared<T>, T> {
    (system.prepare(), system.zeros())
}

/// [`Observed`], prepared: the system over numbers, over duals and over duals of duals.
#[derive(Debug, Clone)]
pub struct ReadyObserved<T, P, F, G>
where
    T: Real,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
{
    plain: P,
    first: Ready<F, Dual<T>>,
    second: Ready<G, Dual<Dual<T>>>,
    description: Arc<Description>,
    index: usize,
}

/// Lifts the components of `from` to constants, in a vector of the shape of `like`.
#[cfg_attr(not(unoptimised), inline(always))]
fn lift_constant<V: Vector, W: Vector<Scalar = Dual<V::Scalar>>>(like: &W, from: &V) -> W {
    let mut lifted = like.clone();
    for i in 0..from.len() {
        *lifted.component_mut(i) = Dual::fixed(from.component(i));
    }
    lifted
}

/// Lifts the components of `from` with those of `along` as derivatives, in a vector of the shape of `like`.
#[cfg_attr(not(unoptimised), inline(always))]
fn lift_along<V, W>(like: &W, from: &V, along: &V) -> W
where
    V: Vector,
    W: Vector<Scalar = Dual<Dual<V::Scalar>>>,
{
    let mut lifted = like.clone();
    for i in 0..from.len() {
        let number = Dual::new(from.component(i), along.component(i));
        *lifted.component_mut(i) = Dual::fixed(number);
    }
    lifted
}

impl<T, P, F, G> ReadyObserved<T, P, F, G>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
{
    /// Computes the derivatives by the components of q and of p, if a vector for them is given.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn derivatives(
        &self,
        t: T,
        q: &P::Vector,
        p: &P::Vector,
        mut by_q: Option<&mut P::Vector>,
        mut by_p: Option<&mut P::Vector>,
    ) {
        let (prepared, zeros) = &self.first;
        let (mut q, mut p) = (lift_constant(zeros, q), lift_constant(zeros, p));
        let (t, one) = (Dual::fixed(t), T::one());
        for i in 0..q.len() {
            if let Some(by_q) = &mut by_q {
                q.component_mut(i).eps = one;
                *by_q.component_mut(i) = prepared.observable(self.index, t, &q, &p).eps;
                q.component_mut(i).eps = T::zero();
            }
            if let Some(by_p) = &mut by_p {
                p.component_mut(i).eps = one;
                *by_p.component_mut(i) = prepared.observable(self.index, t, &q, &p).eps;
                p.component_mut(i).eps = T::zero();
            }
        }
    }
}

impl<T, P, F, G> Dynamics<T> for ReadyObserved<T, P, F, G>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
{
    type Vector = P::Vector;
    type Field = FieldObserved<Self, T>;

    fn description(&self) -> &Description {
        &self.description
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn energy(&self, t: T, q: &P::Vector, p: &P::Vector) -> T {
        self.plain.observable(self.index, t, q, p)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient_q(&self, t: T, q: &P::Vector, p: &P::Vector, out: &mut P::Vector) {
        self.derivatives(t, q, p, Some(out), None);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient_p(&self, t: T, q: &P::Vector, p: &P::Vector, out: &mut P::Vector) {
        self.derivatives(t, q, p, None, Some(out));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gradient(&self, t: T, q: &P::Vector, p: &P::Vector, dq: &mut P::Vector, dp: &mut P::Vector) {
        self.derivatives(t, q, p, Some(dq), Some(dp));
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn time_derivative(&self, _: T, _: &P::Vector, _: &P::Vector) -> T {
        T::zero()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn hessian_vector(
        &self,
        t: T,
        q: &P::Vector,
        p: &P::Vector,
        vq: &P::Vector,
        vp: &P::Vector,
        out_q: &mut P::Vector,
        out_p: &mut P::Vector,
    ) {
        let (prepared, zeros) = &self.second;
        let t = Dual::fixed(Dual::fixed(t));
        let (mut q, mut p) = (lift_along(zeros, q, vq), lift_along(zeros, p, vp));
        let (one, zero) = (Dual::fixed(T::one()), Dual::fixed(T::zero()));
        for i in 0..q.len() {
            q.component_mut(i).eps = one;
            *out_q.component_mut(i) = prepared.observable(self.index, t, &q, &p).eps.eps;
            q.component_mut(i).eps = zero;
            p.component_mut(i).eps = one;
            *out_p.component_mut(i) = prepared.observable(self.index, t, &q, &p).eps.eps;
            p.component_mut(i).eps = zero;
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn observable(&self, _: usize, t: T, q: &P::Vector, p: &P::Vector) -> T {
        self.energy(t, q, p)
    }
    fn field(&self, c: T) -> Self::Field {
        FieldObserved {
            ready: self.clone(),
            c,
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_field(
        &self,
        c: T,
        t: T,
        q: &P::Vector,
        p: &P::Vector,
        into_q: &mut P::Vector,
        into_p: &mut P::Vector,
    ) {
        let (mut by_q, mut by_p) = (q.clone(), p.clone());
        self.derivatives(t, q, p, Some(&mut by_q), Some(&mut by_p));
        for i in 0..q.len() {
            *into_p.component_mut(i) -= c * by_q.component(i);
            *into_q.component_mut(i) += c * by_p.component(i);
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn in_pack<L: Pack, K: InPack<T, P::Vector, L>>(
        &self,
        kept: &mut Kept,
        kernel: K,
    ) -> Option<K::Output> {
        let ready = self;
        self.plain
            .in_pack::<L, _>(kept, ToFirst { ready, kernel })?
    }
}

/// A kernel on its way to packs: the system over numbers is there, those over duals follow.
struct ToFirst<'a, R, K> {
    ready: &'a R,
    kernel: K,
}

impl<T, P, F, G, L, K> InPack<T, P::Vector, L> for ToFirst<'_, ReadyObserved<T, P, F, G>, K>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
    L: Pack,
    K: InPack<T, P::Vector, L>,
{
    type Output = Option<K::Output>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<D>(self, plain: &D, kept: &mut Kept) -> Self::Output
    where
        D: Dynamics<T::Over<L>, Vector = Over<P::Vector, T::Over<L>>> + 'static,
    {
        let ToFirst { ready, kernel } = self;
        let kernel = ToSecond {
            ready,
            plain,
            kernel,
        };
        ready.first.0.in_pack::<L, _>(kept, kernel)?
    }
}

/// The same with the system over duals.
struct ToSecond<'a, R, D, K> {
    ready: &'a R,
    plain: &'a D,
    kernel: K,
}

impl<T, P, F, G, D, L, K> InPack<Dual<T>, F::Vector, L>
    for ToSecond<'_, ReadyObserved<T, P, F, G>, D, K>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
    D: Dynamics<T::Over<L>, Vector = Over<P::Vector, T::Over<L>>> + 'static,
    L: Pack,
    K: InPack<T, P::Vector, L>,
{
    type Output = Option<K::Output>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<E>(self, first: &E, kept: &mut Kept) -> Self::Output
    where
        E: Dynamics<Dual<T::Over<L>>, Vector = Over<F::Vector, Dual<T::Over<L>>>> + 'static,
    {
        let ToSecond {
            ready,
            plain,
            kernel,
        } = self;
        let kernel = ToAll {
            ready,
            plain,
            first,
            kernel,
        };
        ready.second.0.in_pack::<L, _>(kept, kernel)
    }
}

/// A kernel for the observable, when the system over duals of duals is there too.
struct ToAll<'a, R, D, E, K> {
    ready: &'a R,
    plain: &'a D,
    first: &'a E,
    kernel: K,
}

impl<T, P, F, G, D, E, L, K> InPack<Dual<Dual<T>>, G::Vector, L>
    for ToAll<'_, ReadyObserved<T, P, F, G>, D, E, K>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
    D: Dynamics<T::Over<L>, Vector = Over<P::Vector, T::Over<L>>> + 'static,
    E: Dynamics<Dual<T::Over<L>>, Vector = Over<F::Vector, Dual<T::Over<L>>>> + 'static,
    L: Pack,
    K: InPack<T, P::Vector, L>,
{
    type Output = K::Output;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<C>(self, second: &C, kept: &mut Kept) -> K::Output
    where
        C: Dynamics<Dual<Dual<T::Over<L>>>, Vector = Over<G::Vector, Dual<Dual<T::Over<L>>>>>
            + 'static,
    {
        let ReadyObserved {
            first: (_, first),
            second: (_, zeros),
            description,
            index,
            ..
        } = self.ready;
        let whole = || ReadyObserved {
            plain: self.plain.clone(),
            first: (self.first.clone(), first.zeros_over()),
            second: (second.clone(), zeros.zeros_over()),
            description: Arc::clone(description),
            index: *index,
        };
        with_whole(
            kept,
            |whole: &ReadyObserved<_, D, E, C>| whole.index == *index,
            whole,
            self.kernel,
        )
    }
}

/// c·J∇ of an observable.
#[derive(Debug, Clone)]
pub struct FieldObserved<R, T> {
    ready: R,
    c: T,
}

impl<T, P, F, G> VectorField<P::Vector> for FieldObserved<ReadyObserved<T, P, F, G>, T>
where
    T: Real,
    P: Dynamics<T>,
    F: Dynamics<Dual<T>>,
    G: Dynamics<Dual<Dual<T>>>,
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(
        &self,
        t: T,
        q: &P::Vector,
        p: &P::Vector,
        into_q: &mut P::Vector,
        into_p: &mut P::Vector,
    ) {
        self.ready.add_field(self.c, t, q, p, into_q, into_p);
    }
}
