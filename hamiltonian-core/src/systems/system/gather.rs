//! Several members in the lanes of one, which takes code over `f64` to packs.
//!
//! Input: vectors and prepared systems over a scalar, one a member. Output: one over [`Real::Over`]
//! a pack, and back. Invariant: lane k has the bits of member k; the last member fills the
//! remaining lanes; prepared values are computed once, over the scalar, and copied.
//!
//! Two routes lead here. An ensemble gathers the prepared systems of its members ([`System::gather`]). A
//! scheme of a single run passes an [`InLanes`] kernel to [`in_lanes`], which chooses the pack at the
//! level of the CPU, and [`Dynamics::in_pack`] gathers one system into all lanes of it. A system made
//! of others, such as a time-transformed one, passes its kernel on to each of them in turn.

use super::{Dynamics, System, VectorOf};
use crate::systems::compiled::Compiled;
use crate::systems::vector::{Over, Vector};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::any::Any;
use core::fmt;
use core::marker::PhantomData;
use hamiltonian_lanes::{Base, Cpu, Kernel, Level, Nf, Pack, Real, dispatch};

/// The scalar of a vector with a value in each lane of the pack `P`.
pub type ScalarOver<V, P> = <<V as Vector>::Scalar as Real>::Over<P>;
/// A vector with a member in each lane of the pack `P`.
pub type VectorOver<V, P> = Over<V, ScalarOver<V, P>>;

/// The largest number of members that are gathered into one pack.
pub const MAX_MEMBERS: usize = 128;

/// Work of a single run over the scalar `T` that is faster in packs: stages, loops.
///
/// `run` and all that it calls in a loop must be `#[cfg_attr(not(unoptimised), inline(always))]`, as for [`Kernel`].
pub trait InLanes<T: Real, V: Vector<Scalar = T>> {
    /// The computation.
    type Output;
    /// The pack that is used on a level; wrapped in [`Nf`] unless products
    /// [fuse](crate::schemes::author::Arithmetic::fused), so that a run has the same bits on every level.
    type Pack<L: Level>: Base;
    /// The lowest and the highest level on which packs are faster than single numbers. No code is
    /// compiled for other levels. A better CPU runs the highest of them.
    const LEVELS: [Cpu; 2];
    /// Computes the result with the system in every lane. The next kernel with the same system in
    /// the same packs finds in `kept` the values that this one stored.
    fn run<P, D>(self, system: &D, kept: &mut Kept) -> Self::Output
    where
        P: Pack,
        D: Dynamics<T::Over<P>, Vector = Over<V, T::Over<P>>> + 'static;
}

/// Work that is done with a system in all lanes of the pack `P`: an [`InLanes`] kernel at its level, or a step
/// on the way of one through a system that is made of others.
///
/// `run` must be `#[cfg_attr(not(unoptimised), inline(always))]`, as for [`Kernel`].
pub trait InPack<T: Real, V: Vector<Scalar = T>, P: Pack> {
    /// The computation.
    type Output;
    /// Computes the result, with what [`InLanes::run`] has.
    fn run<D>(self, system: &D, kept: &mut Kept) -> Self::Output
    where
        D: Dynamics<T::Over<P>, Vector = Over<V, T::Over<P>>> + 'static;
}

/// Scratch of work in lanes, whose type is the level's: a part of the scratch of a map. Its content never
/// matters; it saves allocations and preparation. A copy is empty.
#[derive(Default)]
pub struct Kept(Option<Box<dyn Any + Send + Sync>>);

impl Kept {
    /// The kept value, if it has this type and passes the test; otherwise a new one.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn get<X: Any + Send + Sync>(
        &mut self,
        is_good: impl FnOnce(&X) -> bool,
        make: impl FnOnce() -> X,
    ) -> &mut X {
        let any = self.0.take();
        let kept = any
            .and_then(|any| any.downcast().ok())
            .filter(|kept| is_good(kept));
        let kept = self.0.insert(kept.unwrap_or_else(|| Box::new(make())));
        match kept.downcast_mut() {
            Some(kept) => kept,
            None => unreachable!("a value of this type was kept a line before"),
        }
    }
}

impl Clone for Kept {
    fn clone(&self) -> Self {
        Kept(None)
    }
}

impl fmt::Debug for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Kept").finish_non_exhaustive()
    }
}

/// Runs a kernel on the best level of this CPU with one system in all lanes. Nothing runs if `T` has no
/// form in lanes, if the system [has none](Dynamics::in_pack), if its [arithmetic](Dynamics::arithmetic)
/// does not use them, or if the CPU has none of the kernel's [levels](InLanes::LEVELS).
#[cfg_attr(not(unoptimised), inline(always))]
pub fn in_lanes<T: Real, D: Dynamics<T>, K: InLanes<T, D::Vector>>(
    system: &D,
    kept: &mut Kept,
    kernel: K,
) -> Option<K::Output> {
    if !T::WIDENS || !system.arithmetic().lanes {
        return None;
    }
    let scalar = PhantomData::<T>;
    dispatch(SystemKernel {
        system,
        kept,
        kernel,
        scalar,
    })
}

/// A system and an [`InLanes`] kernel as a kernel that enters a level.
struct SystemKernel<'a, T, D, K> {
    system: &'a D,
    kept: &'a mut Kept,
    kernel: K,
    scalar: PhantomData<T>,
}

impl<T: Real, D: Dynamics<T>, K: InLanes<T, D::Vector>> Kernel for SystemKernel<'_, T, D, K> {
    type Output = Option<K::Output>;
    const BEST: Cpu = K::LEVELS[1];
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> Self::Output {
        // The compiler decides this condition, because it is a constant of types.
        if const { (L::CPU as u8) < K::LEVELS[0] as u8 } {
            return None;
        }
        let SystemKernel { system, kept, .. } = self;
        let kernel = AtLevel(self.kernel);
        if D::FUSES && system.arithmetic().fused {
            system.in_pack::<Compiled<K::Pack<L>>, _>(kept, kernel)
        } else {
            system.in_pack::<Compiled<Nf<K::Pack<L>>>, _>(kept, kernel)
        }
    }
}

/// An [`InLanes`] kernel, whose pack is chosen.
struct AtLevel<K>(K);

impl<T: Real, V: Vector<Scalar = T>, P: Pack, K: InLanes<T, V>> InPack<T, V, P> for AtLevel<K> {
    type Output = K::Output;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<D>(self, system: &D, kept: &mut Kept) -> K::Output
    where
        D: Dynamics<T::Over<P>, Vector = Over<V, T::Over<P>>> + 'static,
    {
        self.0.run::<P, D>(system, kept)
    }
}

/// The value that [`in_pack`] keeps: the gathered system.
struct Gathered<D, O> {
    of: D,
    over: O,
    kept: Kept,
}

/// What a system prepares, gathered into a pack.
type GatheredOf<S, T, P> =
    Gathered<<S as System>::Prepared<T>, <S as System>::Prepared<<T as Real>::Over<P>>>;

/// Runs a kernel with one system in all lanes of its pack: the implementation of [`Dynamics::in_pack`] for what the
/// system `S` prepares.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn in_pack<T: Real, S: System, P: Pack, K: InPack<T, VectorOf<S, T>, P>>(
    prepared: &S::Prepared<T>,
    kept: &mut Kept,
    kernel: K,
) -> Option<K::Output> {
    let Gathered { over, kept, .. } = kept.get(
        |kept: &GatheredOf<S, T, P>| S::equals(&kept.of, prepared),
        || Gathered {
            of: prepared.clone(),
            over: S::gather::<T, P>(&[prepared]),
            kept: Kept::default(),
        },
    );
    Some(kernel.run(over, kept))
}

/// Runs a kernel with a system that is made of others, all of them in the lanes of a pack. `kept` belongs to the
/// system that was gathered last, so it is empty when one of them has changed; `is_good` compares the rest.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn with_whole<T: Real, V, P, D, K>(
    kept: &mut Kept,
    is_good: impl FnOnce(&D) -> bool,
    make: impl FnOnce() -> D,
    kernel: K,
) -> K::Output
where
    V: Vector<Scalar = T>,
    P: Pack,
    D: Dynamics<T::Over<P>, Vector = Over<V, T::Over<P>>> + 'static,
    K: InPack<T, V, P>,
{
    let (whole, kept) = kept.get(|(whole, _)| is_good(whole), || (make(), Kept::default()));
    kernel.run(whole, kept)
}

/// A number of each member, in its lane.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn number<T: Real, P: Pack, M>(members: &[&M], of: impl Fn(&M) -> T) -> T::Over<P> {
    let mut values = [T::default(); MAX_MEMBERS];
    let count = members.len().min(MAX_MEMBERS);
    for (value, member) in values.iter_mut().zip(members) {
        *value = of(member);
    }
    T::gather::<P>(&values[..count])
}

/// An array of numbers of each member, in its lane.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn numbers<T: Real, P: Pack, M, const N: usize>(
    members: &[&M],
    of: impl Fn(&M) -> &[T; N],
) -> [T::Over<P>; N] {
    let mut all = [T::Over::<P>::default(); N];
    let rows = rows_of(members, &of);
    for (to, row) in all.iter_mut().zip(rows.chunks_exact(members.len().max(1))) {
        *to = T::gather::<P>(row);
    }
    all
}

/// The numbers of all members, number by number. It is not inlined, since no pack concerns it.
#[inline(never)]
fn rows_of<T: Real, M, const N: usize>(members: &[&M], of: &dyn Fn(&M) -> &[T; N]) -> Vec<T> {
    let count = members.len();
    let mut rows = vec![T::default(); N * count];
    for (lane, member) in members.iter().enumerate() {
        for (k, number) in of(member).iter().enumerate() {
            rows[k * count + lane] = *number;
        }
    }
    rows
}

/// Conditions of each member, in its lane.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn masks<T: Real, P: Pack, M, const N: usize>(
    members: &[&M],
    of: impl Fn(&M) -> &[T::Mask; N],
) -> [<T::Over<P> as Real>::Mask; N] {
    let flag = |k: usize| {
        let value = |member: &M| T::select(of(member)[k], T::one(), T::zero());
        number::<T, P, M>(members, value).equals(T::Over::<P>::one())
    };
    core::array::from_fn(flag)
}

/// A vector of each member, in its lane. All have the shape of the first.
///
/// # Panics
/// If there is no member.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn vectors<V: Vector, P: Pack, M>(members: &[&M], of: impl Fn(&M) -> &V) -> VectorOver<V, P> {
    let mut gathered = of(members[0]).zeros_over::<ScalarOver<V, P>>();
    for k in 0..V::PARTS {
        for (i, to) in gathered.part_mut(k).iter_mut().enumerate() {
            *to = number::<V::Scalar, P, M>(members, |member| of(member).part(k)[i]);
        }
    }
    gathered
}

/// Writes lane k of a vector to member k, for as many members as there are. All have its shape.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn scatter<V: Vector, P: Pack>(from: &VectorOver<V, P>, members: &mut [&mut V]) {
    let mut values = [V::Scalar::default(); MAX_MEMBERS];
    let count = members.len().min(MAX_MEMBERS);
    for k in 0..V::PARTS {
        for (i, from) in from.part(k).iter().enumerate() {
            V::Scalar::scatter::<P>(*from, &mut values[..count]);
            for (member, value) in members.iter_mut().zip(&values[..count]) {
                member.part_mut(k)[i] = *value;
            }
        }
    }
}
