//! Values that are computed before an evaluation, and held by a prepared system, a field or a flow.
//!
//! Input: numbers and conditions of a definition, and its sizes, functions and arrays. Output: [`Held`], which
//! emitted bodies read. Invariant: each of them is a [`LaneValue`], which can be copied into the lanes of a pack.

use crate::flows::narrow::{Varied, fixed, fixed_vector};
use crate::systems::function::Function;
use crate::systems::system::Arithmetic;
use crate::systems::system::gather::{masks, numbers, vectors};
use crate::systems::vector::{Over, Vector};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::Debug;
use hamiltonian_lanes::{Mask, Pack, Real};

/// Values that bodies read: `N` numbers, `M` conditions, and data that is not computed.
#[derive(Debug, Clone)]
pub struct Held<T: Real, const N: usize, const M: usize = 0, D = ()> {
    /// Numbers.
    pub v: [T; N],
    /// Conditions.
    pub m: [T::Mask; M],
    /// The arithmetic of loops, the sizes set at run time, the functions and the arrays, as nested pairs in this order.
    /// Absent ones are left out.
    pub data: D,
}

impl<T: Real, const N: usize, const M: usize, D> Held<T, N, M, D> {
    /// Numbers, conditions and data.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn new(v: [T; N], m: [T::Mask; M], data: D) -> Self {
        Held { v, m, data }
    }
}

/// A value of a member that can be placed in a lane of a pack, or is the same for all lanes.
pub trait LaneValue<T: Real>: Clone + Debug + Send + Sync + 'static {
    /// The same over another scalar.
    type Over<U: Real>;
    /// Gathers the values of members into lanes.
    fn gather<P: Pack>(members: &[&Self]) -> Self::Over<T::Over<P>>;
    /// The same, without derivatives.
    fn lifted(&self) -> Self::Over<Varied<T>>;
    /// Returns true if the lanes of one pack can hold both.
    fn fits(&self, _: &Self) -> bool {
        true
    }
    /// Returns true if both are equal, provided that they [fit](LaneValue::fits).
    fn equals(&self, other: &Self) -> bool;
}

impl<T: Real, const N: usize, const M: usize, D: LaneValue<T>> LaneValue<T> for Held<T, N, M, D> {
    type Over<U: Real> = Held<U, N, M, D::Over<U>>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<P: Pack>(members: &[&Self]) -> Self::Over<T::Over<P>> {
        Held {
            v: numbers::<T, P, _, _>(members, |one| &one.v),
            m: masks::<T, P, _, _>(members, |one| &one.m),
            data: gathered::<T, P, _, _>(members, |one| &one.data),
        }
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lifted(&self) -> Self::Over<Varied<T>> {
        let mut v = [fixed(T::zero()); N];
        let mut k = 0;
        while k < N {
            v[k] = fixed(self.v[k]);
            k += 1;
        }
        Held::new(v, self.m, self.data.lifted())
    }
    fn fits(&self, other: &Self) -> bool {
        self.data.fits(&other.data)
    }
    fn equals(&self, other: &Self) -> bool {
        same_numbers(&self.v, &other.v)
            && same_masks::<T, M>(&self.m, &other.m)
            && self.data.equals(&other.data)
    }
}

/// Returns true if both have the same numbers. A number that is computed for a branch that is not taken may be NaN.
fn same_numbers<T: Real, const N: usize>(these: &[T; N], those: &[T; N]) -> bool {
    let not_a_number = |x: &T| !x.equals(*x);
    let mut pairs = these.iter().zip(those);
    pairs.all(|(a, b)| a == b || (not_a_number(a) & not_a_number(b)).all())
}

/// Returns true if the same conditions hold in both.
fn same_masks<T: Real, const N: usize>(these: &[T::Mask; N], those: &[T::Mask; N]) -> bool {
    let same = |k: usize| ((these[k] & those[k]) | (!these[k] & !those[k])).all();
    (0..N).all(same)
}

/// Gathers a part of each member into its lane.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn gathered<'a, T: Real, P: Pack, W, D: LaneValue<T>>(
    members: &[&'a W],
    of: impl Fn(&'a W) -> &'a D,
) -> D::Over<T::Over<P>> {
    D::gather::<P>(&parts_of(members, &of))
}

/// A part of each member. It is not inlined, since no pack concerns it.
#[inline(never)]
fn parts_of<'a, W, D>(members: &[&'a W], of: &dyn Fn(&'a W) -> &'a D) -> Vec<&'a D> {
    members.iter().map(|member| of(member)).collect()
}

/// A value that is the same in all lanes of a pack.
macro_rules! same {
    ($ty:ty, $one:ident, $other:ident, $fits:expr) => {
        type Over<U: Real> = $ty;
        #[cfg_attr(not(unoptimised), inline(always))]
        fn gather<P: Pack>(members: &[&Self]) -> Self {
            members[0].clone()
        }
        #[cfg_attr(not(unoptimised), inline(always))]
        fn lifted(&self) -> Self {
            self.clone()
        }
        fn fits(&self, other: &Self) -> bool {
            let ($one, $other) = (self, other);
            $fits
        }
        fn equals(&self, _: &Self) -> bool {
            true
        }
    };
}

impl<T: Real> LaneValue<T> for Arithmetic {
    same!(Arithmetic, _one, _other, true);
}

impl<T: Real> LaneValue<T> for usize {
    same!(usize, one, other, one == other);
}

/// A function of `N` numbers that is a parameter.
#[derive(Debug, Clone)]
pub struct Given<F, const N: usize>(pub F);

impl<T: Real, F: Function<N>, const N: usize> LaneValue<T> for Given<F, N> {
    same!(Given<F, N>, one, other, one.0.fingerprint() == other.0.fingerprint());
}

impl<V: Vector> LaneValue<V::Scalar> for V {
    type Over<U: Real> = Over<V, U>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<P: Pack>(members: &[&Self]) -> Over<V, <V::Scalar as Real>::Over<P>> {
        vectors::<V, P, _>(members, |one| one)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lifted(&self) -> Over<V, Varied<V::Scalar>> {
        fixed_vector(self)
    }
    fn equals(&self, other: &Self) -> bool {
        self == other
    }
}

/// Holders of a run share an array of run-time size.
impl<V: Vector> LaneValue<V::Scalar> for Arc<V> {
    type Over<U: Real> = Arc<Over<V, U>>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<P: Pack>(members: &[&Self]) -> Arc<Over<V, <V::Scalar as Real>::Over<P>>> {
        Arc::new(vectors::<V, P, _>(members, |one| &**one))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lifted(&self) -> Arc<Over<V, Varied<V::Scalar>>> {
        Arc::new(fixed_vector(&**self))
    }
    fn equals(&self, other: &Self) -> bool {
        self == other
    }
}

impl<T: Real> LaneValue<T> for () {
    same!((), _one, _other, true);
}

/// One value, and the rest.
impl<T: Real, A: LaneValue<T>, B: LaneValue<T>> LaneValue<T> for (A, B) {
    type Over<U: Real> = (A::Over<U>, B::Over<U>);
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather<P: Pack>(members: &[&Self]) -> Self::Over<T::Over<P>> {
        let first = gathered::<T, P, _, _>(members, |one| &one.0);
        (first, gathered::<T, P, _, _>(members, |one| &one.1))
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lifted(&self) -> Self::Over<Varied<T>> {
        (self.0.lifted(), self.1.lifted())
    }
    fn fits(&self, other: &Self) -> bool {
        self.0.fits(&other.0) && self.1.fits(&other.1)
    }
    fn equals(&self, other: &Self) -> bool {
        self.0.equals(&other.0) && self.1.equals(&other.1)
    }
}
