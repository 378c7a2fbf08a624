//! The contract of emitted code: bodies that a definition gives, and the fields, flows and pieces made of them.
//!
//! Input: straight-line bodies over any scalar, as implementations of [`Shift`], [`FlowBody`] and [`FieldBody`] for a
//! prepared system, one for each kind. Output: [`Emitted`], the vector field, the flow and the piece of each kind.
//! Invariant: a body has two stages. The first computes the held values from the prepared system and a coefficient, once
//! for each map. The second computes the change of a point from the held values, the data of the prepared system and the
//! point.

use crate::flows::exponential::{Exponential, raised};
use crate::flows::narrow::{Varied, along, derivatives, fixed};
use crate::flows::push::{Both, Coupled, SubStep};
use crate::systems::flow::{Flow, Piece, VectorField};
use crate::systems::state::Point;
use crate::systems::system::Dynamics;
use crate::systems::vector::{Over, Vector};
use core::fmt::{self, Debug};
use core::marker::PhantomData;
use hamiltonian_lanes::Real;

/// The scalars over which a program has one copy of a body for all of its uses: a function of its own. Over others the
/// body is written out at each use.
#[derive(Debug, Clone, Copy)]
pub enum SharedCode {
    /// No scalar.
    None,
    /// Packs: a long line of instructions over several registers takes most of the time of a build. In a run of numbers
    /// a call would take time.
    InPacks,
    /// All: a call is short beside nested loops.
    All,
}

impl SharedCode {
    /// Returns true if the code over `T` is shared.
    const fn over<T: Real>(self) -> bool {
        match self {
            SharedCode::None => false,
            SharedCode::InPacks => T::LANES > 1,
            SharedCode::All => true,
        }
    }
}

/// A prepared system with the data that its bodies read beside held values.
pub trait WithData<T: Real>: Dynamics<T> {
    /// The arithmetic of loops, the sizes set at run time, the functions and the arrays. A flow or a field has a copy.
    type Data: Clone + Debug;
    /// The data.
    fn data(&self) -> &Self::Data;
}

/// The data of a prepared system.
pub type DataOf<T, X> = <X as WithData<T>>::Data;

/// A body that reads one half of phase space and adds to the other: a kick, a drift.
pub trait Shift<K, T: Real>: WithData<T> {
    /// The piece in the author's notation.
    const NAME: &'static str;
    /// True if momenta move, false if coordinates do.
    const KICKS: bool = true;
    /// See [`Flow::MERGES`].
    const MERGES: bool = true;
    /// The scalars over which all uses of the body share its code.
    const SHARED: SharedCode = SharedCode::None;
    /// The values that depend on the prepared system and the coefficient alone.
    type Held: Clone + Debug;
    /// Computes these values.
    fn fold(&self, c: T) -> Self::Held;
    /// Adds to one half of phase space the change that the other half determines.
    fn add(
        held: &Self::Held,
        data: &Self::Data,
        t: T,
        from: &Self::Vector,
        into: &mut Self::Vector,
    );
}

/// A body that reads and writes one point: an exact flow.
pub trait FlowBody<K, T: Real>: WithData<T> {
    /// The piece in the author's notation.
    const NAME: &'static str;
    /// See [`Flow::MERGES`].
    const MERGES: bool = true;
    /// The scalars over which all uses of the body share its code.
    const SHARED: SharedCode = SharedCode::None;
    /// The values that depend on the prepared system and the coefficient alone.
    type Held: Clone + Debug;
    /// Computes these values.
    fn fold(&self, c: T) -> Self::Held;
    /// Moves a point.
    fn apply(
        held: &Self::Held,
        data: &Self::Data,
        t: T,
        q: &mut Self::Vector,
        p: &mut Self::Vector,
    );
    /// The same with the terms of loops in the opposite order.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply_reversed(
        held: &Self::Held,
        data: &Self::Data,
        t: T,
        q: &mut Self::Vector,
        p: &mut Self::Vector,
    ) {
        Self::apply(held, data, t, q, p);
    }
}

/// A system without sizes set at run time that has a flow with a matrix.
pub trait Origin<T: Real>: Dynamics<T> {
    /// The zero vector.
    fn origin() -> Self::Vector;
}

/// A body that adds the values of a vector field at a point.
pub trait FieldBody<K, T: Real>: WithData<T> {
    /// The scalars over which all uses of the body share its code.
    const SHARED: SharedCode = SharedCode::None;
    /// The values that depend on the prepared system and the coefficient alone.
    type Held: Clone + Debug;
    /// Computes these values.
    fn fold(&self, c: T) -> Self::Held;
    /// See [`VectorField::add`].
    fn add(
        held: &Self::Held,
        data: &Self::Data,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        into_q: &mut Self::Vector,
        into_p: &mut Self::Vector,
    );
    /// See [`VectorField::has_halves`].
    const HALVES: bool = false;
    /// See [`VectorField::add_half`].
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_half<const KICKS: bool>(
        held: &Self::Held,
        data: &Self::Data,
        t: T,
        from: &Self::Vector,
        into: &mut Self::Vector,
    ) {
        let _ = (held, data, t, from, into);
    }
}

/// A call of a body, in a function of its own if its code is shared.
macro_rules! call {
    ($body:ident::$method:ident($($argument:expr),*)) => {
        if const { $body::SHARED.over::<T>() } {
            T::out_of_line(
                #[cfg_attr(not(unoptimised), inline(always))]
                || $body::$method($($argument),*),
            );
        } else {
            $body::$method($($argument),*);
        }
    };
}

/// [`Shift::add`], at each use.
#[cfg_attr(not(unoptimised), inline(always))]
fn shift<K, T: Real, D: Shift<K, T>>(
    held: &D::Held,
    data: &D::Data,
    t: T,
    from: &D::Vector,
    into: &mut D::Vector,
) {
    call!(D::add(held, data, t, from, into));
}

/// [`FlowBody::apply`] or [`FlowBody::apply_reversed`], at each use.
#[cfg_attr(not(unoptimised), inline(always))]
fn flow<K, T: Real, D: FlowBody<K, T>, const REVERSED: bool>(
    held: &D::Held,
    data: &D::Data,
    t: T,
    q: &mut D::Vector,
    p: &mut D::Vector,
) {
    if REVERSED {
        call!(D::apply_reversed(held, data, t, q, p));
    } else {
        call!(D::apply(held, data, t, q, p));
    }
}

/// [`FieldBody::add`], at each use.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn add_field<K, T: Real, D: FieldBody<K, T>>(
    held: &D::Held,
    data: &D::Data,
    t: T,
    [q, p]: [&D::Vector; 2],
    [into_q, into_p]: [&mut D::Vector; 2],
) {
    call!(D::add(held, data, t, q, p, into_q, into_p));
}

impl<T: Real, D: Shift<Kick, T> + Shift<Drift, T>> FieldBody<Halves, T> for D {
    type Held = (<D as Shift<Kick, T>>::Held, <D as Shift<Drift, T>>::Held);
    #[cfg_attr(not(unoptimised), inline(always))]
    fn fold(&self, c: T) -> Self::Held {
        (
            Shift::<Kick, T>::fold(self, c),
            Shift::<Drift, T>::fold(self, c),
        )
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(
        (kick, drift): &Self::Held,
        data: &Self::Data,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        into_q: &mut Self::Vector,
        into_p: &mut Self::Vector,
    ) {
        shift::<Kick, T, D>(kick, data, t, q, into_p);
        shift::<Drift, T, D>(drift, data, t, p, into_q);
    }
    const HALVES: bool = true;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_half<const KICKS: bool>(
        (kick, drift): &Self::Held,
        data: &Self::Data,
        t: T,
        from: &Self::Vector,
        into: &mut Self::Vector,
    ) {
        if KICKS {
            shift::<Kick, T, D>(kick, data, t, from, into);
        } else {
            shift::<Drift, T, D>(drift, data, t, from, into);
        }
    }
}

impl<T: Real, D: WithData<T>> FieldBody<OfGradient, T> for D {
    type Held = (D, T);
    #[cfg_attr(not(unoptimised), inline(always))]
    fn fold(&self, c: T) -> Self::Held {
        (self.clone(), c)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(
        (prepared, c): &Self::Held,
        _: &Self::Data,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        into_q: &mut Self::Vector,
        into_p: &mut Self::Vector,
    ) {
        let (mut x, mut y) = (into_q.clone(), into_p.clone());
        let _ = prepared.energy_and_gradient(t, q, p, &mut x, &mut y);
        into_q.accumulate(*c, &y);
        into_p.accumulate(-*c, &x);
    }
}

/// ∂V/∂q of a separable H without a force, by its kick.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn slopes_by_kick<T: Real, D: Shift<Kick, T>>(
    prepared: &D,
    t: T,
    q: &D::Vector,
    out: &mut D::Vector,
) {
    out.set_zero();
    shift::<Kick, T, D>(&prepared.fold(-T::one()), prepared.data(), t, q, out);
}

/// ∂T/∂p of a separable H, by its drift.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn velocities_by_drift<T: Real, D: Shift<Drift, T>>(
    prepared: &D,
    t: T,
    p: &D::Vector,
    out: &mut D::Vector,
) {
    out.set_zero();
    shift::<Drift, T, D>(&prepared.fold(T::one()), prepared.data(), t, p, out);
}

/// ∂H/∂q and ∂H/∂p of an H without a force, by its field.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn gradient_by_field<T: Real, D: FieldBody<Whole, T>>(
    prepared: &D,
    t: T,
    [q, p]: [&D::Vector; 2],
    [by_q, by_p]: [&mut D::Vector; 2],
) {
    by_q.set_zero();
    by_p.set_zero();
    let held = prepared.fold(-T::one());
    add_field::<Whole, T, D>(&held, prepared.data(), t, [q, p], [&mut *by_p, by_q]);
    for k in 0..D::Vector::PARTS {
        for place in by_p.part_mut(k) {
            *place = -*place;
        }
    }
}

/// The Hessian of H times a vector by the system over dual numbers: the derivatives of the gradient along the vector.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn hessian_by_gradient<V: Vector, D>(
    lifted: &D,
    t: V::Scalar,
    [q, p]: [&V; 2],
    [vq, vp]: [&V; 2],
    [out_q, out_p]: [&mut V; 2],
) where
    D: Dynamics<Varied<V::Scalar>, Vector = Over<V, Varied<V::Scalar>>>,
{
    V::Scalar::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || {
            let (q, p) = (along(q, vq), along(p, vp));
            let (mut by_q, mut by_p) = (q.clone(), p.clone());
            lifted.gradient(fixed(t), &q, &p, &mut by_q, &mut by_p);
            derivatives(&by_q, out_q);
            derivatives(&by_p, out_p);
        },
    );
}

/// The kick of V, or the part of it that reads no momenta.
#[derive(Debug)]
pub struct Kick;
/// The drift of T.
#[derive(Debug)]
pub struct Drift;
/// The part of a kick that reads momenta.
#[derive(Debug)]
pub struct Push;
/// c·(J∇H + f).
#[derive(Debug)]
pub struct Whole;
/// The same of a separable H, as the kick and the drift.
#[derive(Debug)]
pub struct Halves;
/// The same of a large system, whose code is not written out a second time: the gradient, then two
/// accumulations. The vectors of such systems have no size set at run time, so that nothing allocates.
#[derive(Debug)]
pub struct OfGradient;
/// c·(f − ∂V/∂q).
#[derive(Debug)]
pub struct Rates;
/// c·A·p of a force A·p + b.
#[derive(Debug)]
pub struct Linear;
/// The kick in two parts, of which the first reads momenta.
#[derive(Debug)]
pub struct Damped;
/// The kick of momenta that push each other.
#[derive(Debug)]
pub struct Pushed;
/// The kick by a symmetric sub-step.
#[derive(Debug)]
pub struct Stepped;

/// The piece of this number.
#[derive(Debug)]
pub struct Numbered<const K: usize>;

/// The [`Shift`] of a kind.
#[derive(Debug)]
pub struct Shifts<K>(K);
/// The [`FlowBody`] of a kind.
#[derive(Debug)]
pub struct Moves<K>(K);
/// The [`FieldBody`] of a kind.
#[derive(Debug)]
pub struct Adds<K>(K);
/// The [`FlowBody`] of a kind as a matrix of `N` rows.
#[derive(Debug)]
pub struct Matrices<K, const N: usize>(K);
/// The body of kind `K` of a prepared system `D` as a piece, or with held values as a flow or a field.
pub struct Emitted<D, K, H = ()> {
    held: H,
    of: PhantomData<fn() -> (D, K)>,
}

impl<D, K> Emitted<D, K> {
    /// The piece.
    pub const PIECE: Self = Emitted::holding(());
}

impl<D, K, H> Emitted<D, K, H> {
    #[cfg_attr(not(unoptimised), inline(always))]
    const fn holding(held: H) -> Self {
        let of = PhantomData;
        Emitted { held, of }
    }
}

impl<D, K, H: Clone> Clone for Emitted<D, K, H> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn clone(&self) -> Self {
        Emitted::holding(self.held.clone())
    }
}

impl<D, K, H: Copy> Copy for Emitted<D, K, H> {}

impl<D, K, H: Debug> Debug for Emitted<D, K, H> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.held.fmt(f)
    }
}

/// The flow of the [`Shift`] of kind `K`.
pub type ShiftOf<D, K, T> =
    Emitted<D, Shifts<K>, (<D as Shift<K, T>>::Held, <D as WithData<T>>::Data)>;
/// The flow of the [`FlowBody`] of kind `K`.
pub type FlowBodyOf<D, K, T> =
    Emitted<D, Moves<K>, (<D as FlowBody<K, T>>::Held, <D as WithData<T>>::Data)>;
/// The [`FieldBody`] of kind `K`.
pub type FieldOf<D, K, T> =
    Emitted<D, Adds<K>, (<D as FieldBody<K, T>>::Held, <D as WithData<T>>::Data)>;

impl<V, D, K, H, A> Flow<Point<V>> for Emitted<D, Shifts<K>, (H, A)>
where
    V: Vector,
    D: Shift<K, V::Scalar, Vector = V, Held = H, Data = A>,
    H: Clone + Debug,
    A: Clone + Debug,
{
    const NAME: &'static str = D::NAME;
    const MERGES: bool = D::MERGES;
    const MOVES: [bool; 2] = [!D::KICKS, D::KICKS];
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, x: &mut Point<V>, (): &mut ()) {
        let (held, data) = &self.held;
        if D::KICKS {
            shift::<K, V::Scalar, D>(held, data, t, &x.q, &mut x.p);
        } else {
            shift::<K, V::Scalar, D>(held, data, t, &x.p, &mut x.q);
        }
    }
}

impl<V, D, K, H, A> Flow<Point<V>> for Emitted<D, Moves<K>, (H, A)>
where
    V: Vector,
    D: FlowBody<K, V::Scalar, Vector = V, Held = H, Data = A>,
    H: Clone + Debug,
    A: Clone + Debug,
{
    const NAME: &'static str = D::NAME;
    const MERGES: bool = D::MERGES;
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: V::Scalar, x: &mut Point<V>, (): &mut ()) {
        let (held, data) = &self.held;
        flow::<K, V::Scalar, D, false>(held, data, t, &mut x.q, &mut x.p);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply_reversed(&self, t: V::Scalar, x: &mut Point<V>, (): &mut ()) {
        let (held, data) = &self.held;
        flow::<K, V::Scalar, D, true>(held, data, t, &mut x.q, &mut x.p);
    }
}

impl<V, D, K, H, A> VectorField<V> for Emitted<D, Adds<K>, (H, A)>
where
    V: Vector,
    D: FieldBody<K, V::Scalar, Vector = V, Held = H, Data = A>,
    H: Clone + Debug,
    A: Clone + Debug,
{
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(&self, t: V::Scalar, q: &V, p: &V, into_q: &mut V, into_p: &mut V) {
        let (held, data) = &self.held;
        add_field::<K, V::Scalar, D>(held, data, t, [q, p], [into_q, into_p]);
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_halves(&self) -> bool {
        D::HALVES
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_half<const KICKS: bool>(&self, t: V::Scalar, from: &V, into: &mut V) {
        let (held, data) = &self.held;
        D::add_half::<KICKS>(held, data, t, from, into);
    }
}

impl<D, K, H, A: Clone> Emitted<D, Adds<K>, (H, A)> {
    /// The field for the coefficient `c`.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn fold<T: Real>(prepared: &D, c: T) -> Self
    where
        D: FieldBody<K, T, Held = H, Data = A>,
    {
        Emitted::holding((prepared.fold(c), prepared.data().clone()))
    }
}

/// The flow that a piece makes for the coefficient `c`.
macro_rules! piece {
    ($kind:ty, [$($of:tt)*], [$($condition:tt)*], $flow:ty, |$prepared:ident, $c:ident| $body:expr) => {
        impl<T: Real, D, $($of)*> Piece<T, D> for Emitted<D, $kind>
        where
            D: $($condition)* + 'static,
        {
            type Point = Point<D::Vector>;
            type Flow = $flow;
            #[cfg_attr(not(unoptimised), inline(always))]
            fn flow(&self, $prepared: &D, $c: T) -> Self::Flow {
                $body
            }
        }
    };
}

piece!(Shifts<K>, [K: 'static], [Shift<K, T>], ShiftOf<D, K, T>, |prepared, c| {
    Emitted::holding((prepared.fold(c), prepared.data().clone()))
});
piece!(Moves<K>, [K: 'static], [FlowBody<K, T>], FlowBodyOf<D, K, T>, |prepared, c| {
    Emitted::holding((prepared.fold(c), prepared.data().clone()))
});
piece!(
    Matrices<K, N>,
    [K: 'static, const N: usize],
    [FlowBody<K, T> + Origin<T>],
    Exponential<FlowBodyOf<D, K, T>, T, N>,
    |prepared, c| {
        let rates = FlowBodyOf::<D, K, T>::holding((prepared.fold(raised(c)), prepared.data().clone()));
        Exponential::new(&rates, &Point { q: D::origin(), p: D::origin() })
    }
);
piece!(
    Damped,
    [],
    [FlowBody<Push, T> + Shift<Kick, T>],
    Both<FlowBodyOf<D, Push, T>, ShiftOf<D, Kick, T>>,
    |prepared, c| Both(
        Emitted::holding((
            FlowBody::<Push, T>::fold(prepared, c),
            prepared.data().clone()
        )),
        Emitted::holding((Shift::<Kick, T>::fold(prepared, c), prepared.data().clone())),
    )
);
piece!(
    Pushed,
    [],
    [FieldBody<Rates, T> + FieldBody<Linear, T>],
    Coupled<FieldOf<D, Rates, T>, FieldOf<D, Linear, T>>,
    |prepared, c| Coupled {
        field: Emitted::fold(prepared, c),
        linear: Emitted::fold(prepared, c),
    }
);
piece!(
    Stepped,
    [],
    [FieldBody<Rates, T>],
    SubStep<FieldOf<D, Rates, T>>,
    |prepared, c| SubStep(Emitted::fold(prepared, c))
);
