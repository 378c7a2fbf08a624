//! The requirements of schemes, compared with the bounds of their implementations.
//!
//! Input: the catalogue. Output: none. Invariant: a system without a trait is no system for exactly the schemes that
//! require this trait, so a set with a trait too many or too few is found.

use crate::schemes::GaussNystrom;
use crate::schemes::scheme::{Entry, Listed, Needs, Scheme};
use crate::systems::flow::{Nothing, Piece, VectorField};
use crate::systems::state::Point;
use crate::systems::system::{
    Autonomous, Description, Dynamics, Exact, Nystrom, QuadraticKinetic, Separable, Split, System,
    Unforced,
};
use crate::systems::transformed::TimeTransformed;
use alloc::string::String;
use alloc::vec::Vec;
use core::marker::PhantomData;
use hamiltonian_lanes::{Pack, Real};
use nalgebra::SVector;

/// A system that has all traits but that of this number in [`Needs::ALL`].
#[derive(Debug, Clone)]
pub struct Without<const TRAIT: usize>;

/// The number of no trait.
pub const NONE: usize = 7;

impl<const TRAIT: usize> System for Without<TRAIT> {
    type Shape = SVector<(), 1>;
    type Prepared<T: Real> = Self;
    fn description(&self) -> &Description {
        &Description::NONE
    }
    fn prepare<T: Real>(&self) -> Self {
        Without
    }
    fn zeros<T: Real>(&self) -> SVector<T, 1> {
        SVector::from_element(T::zero())
    }
    fn gather<T: Real, P: Pack>(_: &[&Self]) -> Self {
        Without
    }
    fn fits<T: Real>(_: &Self, _: &Self) -> bool {
        true
    }
    fn equals<T: Real>(_: &Self, _: &Self) -> bool {
        true
    }
}

type V<T> = SVector<T, 1>;

/// H = 0.
impl<T: Real, const TRAIT: usize> Dynamics<T> for Without<TRAIT> {
    type Vector = V<T>;
    type Field = Self;
    fn description(&self) -> &Description {
        &Description::NONE
    }
    fn energy(&self, _: T, _: &V<T>, _: &V<T>) -> T {
        T::zero()
    }
    fn gradient_q(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>) {}
    fn gradient_p(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>) {}
    fn time_derivative(&self, _: T, _: &V<T>, _: &V<T>) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        _: T,
        _: &V<T>,
        _: &V<T>,
        _: &V<T>,
        _: &V<T>,
        _: &mut V<T>,
        _: &mut V<T>,
    ) {
    }
    fn field(&self, _: T) -> Self {
        Without
    }
}

impl<T: Real, const TRAIT: usize> VectorField<V<T>> for Without<TRAIT> {
    fn add(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>, _: &mut V<T>) {}
}

/// A piece that does not move.
#[derive(Debug, Clone, Copy)]
pub struct Still;

impl<T: Real, const TRAIT: usize> Piece<T, Without<TRAIT>> for Still {
    type Point = Point<V<T>>;
    type Flow = Nothing;
    fn flow(&self, _: &Without<TRAIT>, _: T) -> Nothing {
        Nothing
    }
}

/// Implements a trait with pieces for all systems but one.
macro_rules! with_pieces {
    ($trait:ident $pieces:tt: $($number:literal)*) => {
        $(with_pieces!(@one $trait $pieces $number);)*
    };
    (@one $trait:ident ($($piece:ident $method:ident $value:tt),*) $number:literal) => {
        impl $trait for Without<$number> {
            $(type $piece<T: Real> = $value;
            fn $method<T: Real>() -> $value {
                $value
            })*
        }
    };
}

with_pieces!(Unforced(): 1 2 3 4 5 6 7);
with_pieces!(Split(Pieces pieces (Still,)): 0 2 3 4 5 6 7);
with_pieces!(Exact(): 0 1 3 4 5 6 7);
with_pieces!(Separable(Kick kick Still, Drift drift Still): 0 1 2 4 5 6 7);
with_pieces!(Nystrom(Kick kick Still, Quadratic quadratic Still): 0 1 2 3 5 6 7);
with_pieces!(QuadraticKinetic(): 0 1 2 3 4 6 7);
with_pieces!(Autonomous(): 0 1 2 3 4 5 7);

/// The question whether `M` is a scheme for `S`. The method of the type comes before that of the trait, where its bound
/// holds.
pub struct Is<M, S>(PhantomData<(M, S)>);

impl<M, S> Is<M, S> {
    pub fn new(_: &M) -> Self {
        Is(PhantomData)
    }
}

impl<M: Scheme<S>, S: System> Is<M, S> {
    pub fn scheme(&self) -> bool {
        true
    }
}

pub trait Otherwise {
    fn scheme(&self) -> bool {
        false
    }
}

impl<M, S> Otherwise for &Is<M, S> {}

/// The system of this number, and the same with its time transformed.
pub type InTime<const TRAIT: usize> = TimeTransformed<Without<TRAIT>, Without<NONE>>;

/// The entry of a scheme, and what the bounds of its implementation require.
macro_rules! required {
    ($scheme:expr) => {{
        #[allow(unused_imports)]
        use needs::{InTime, Is, NONE, Otherwise, Without};
        let scheme = $scheme;
        let is_scheme = [
            (&Is::<_, Without<0>>::new(&scheme)).scheme(),
            (&Is::<_, Without<1>>::new(&scheme)).scheme(),
            (&Is::<_, Without<2>>::new(&scheme)).scheme(),
            (&Is::<_, Without<3>>::new(&scheme)).scheme(),
            (&Is::<_, Without<4>>::new(&scheme)).scheme(),
            (&Is::<_, Without<5>>::new(&scheme)).scheme(),
            (&Is::<_, Without<6>>::new(&scheme)).scheme(),
            (&Is::<_, Without<NONE>>::new(&scheme)).scheme(),
        ];
        let is_in_time = [
            (&Is::<_, InTime<0>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<1>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<2>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<3>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<4>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<5>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<6>>::new(&scheme)).scheme(),
            (&Is::<_, InTime<NONE>>::new(&scheme)).scheme(),
        ];
        (scheme.entry(), needs::refusing(is_scheme, is_in_time))
    }};
}
pub(super) use required;

/// The traits without which a system is refused, of those for which a system with all traits is not.
pub fn refusing(is_scheme: [bool; 8], is_in_time: [bool; 8]) -> Needs {
    let (accepted, in_time) = match (is_scheme[NONE], is_in_time[NONE]) {
        (true, _) => (is_scheme, Needs::ANY),
        (false, true) => (is_in_time, Needs::TIME_TRANSFORMED),
        (false, false) => panic!("no system has the traits that the scheme requires"),
    };
    let refused = Needs::ALL.iter().zip(accepted).filter(|(_, is)| !is);
    refused.fold(in_time, |all, ((one, _), _)| all.and(*one))
}

/// The entries whose set is another one than the bounds.
fn wrong(entries: &[(Entry, Needs)]) -> Vec<String> {
    let wrong = entries
        .iter()
        .filter(|(entry, needs)| entry.needs != *needs);
    wrong
        .map(|(entry, needs)| alloc::format!("{entry} says {}, and requires {needs}", entry.needs))
        .collect()
}

#[test]
fn entries_require_what_the_bounds_do() {
    let entries = super::required();
    assert_eq!(entries.len(), super::catalogue().count());
    assert_eq!(wrong(&entries), [""; 0]);
}

/// A trait too few, and one too many, are found.
#[test]
fn a_wrong_set_is_found() {
    let (right, bounds) = (GaussNystrom::<2>::default().entry(), {
        let entries = super::required();
        let found = entries
            .iter()
            .find(|(entry, _)| entry.name == "GaussNystrom");
        found.expect("it is in the catalogue").1
    });
    let few = Needs::SEPARABLE.and(Needs::QUADRATIC_KINETIC);
    let many = right.needs.and(Needs::AUTONOMOUS);
    for needs in [few, many] {
        let entry = Entry { needs, ..right };
        assert_eq!(wrong(&[(entry, bounds)]).len(), 1, "{needs}");
    }
    assert_eq!(wrong(&[(right, bounds)]), [""; 0]);
}
