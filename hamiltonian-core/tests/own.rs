//! Schemes that a user adds: the two of `book/src/extending.md`, to the letter, with their orders.

use crate::common::systems::*;
use crate::composition::{is, slope};
use hamiltonian_core::VectorOf;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::Adjoint;
use hamiltonian_core::schemes::author::{Durations, Splitting, Weight, Zigzag, ZigzagOf};
use hamiltonian_core::schemes::{Composition, Yoshida4};
use hamiltonian_core::{
    Scheme,
    schemes::author::{Description, Dynamics, Entry, Form, Listed, Map, Needs, OneStep, Point},
};
use hamiltonian_core::{
    Split, Vector,
    schemes::author::{Step, Symmetric, VectorField},
};
use std::marker::PhantomData;

// A one-step scheme.
/// z ← z + h J∇H(z + h/2 J∇H(z)).
#[derive(Debug, Clone, PartialEq)]
struct Runge;

impl Listed for Runge {
    fn entry(&self) -> Entry {
        Entry {
            name: "Runge",
            variant: "",
            equations: "",
            order: 2,
            duration: 1, // a step advances time by one step size
            needs: Needs::ANY,
            preserves: Form::Nothing,
            source: "C. Runge, Math. Ann. 46 (1895) 167, doi:10.1007/BF01446807",
        }
    }
}

impl<S: System> Scheme<S> for Runge {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = Twice<VectorOf<S, T>, <S::Prepared<T> as Dynamics<T>>::Field>;
    #[inline(always)]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let half = step.h * T::constant(0.5, 0.0);
        Twice(prepared.field(half), prepared.field(step.h), PhantomData)
    }
    #[inline(always)]
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &StateOf<S, T>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

/// J∇H for half a step, and for a step.
struct Twice<V, F>(F, F, PhantomData<V>);

impl<V: Vector, F: VectorField<V>> Map for Twice<V, F> {
    type Carried = Point<V>;
    type Work = Point<V>;
    #[inline(always)]
    fn body(&self, t: V::Scalar, end: V::Scalar, z: &mut Point<V>, middle: &mut Point<V>) {
        middle.copy_from(z);
        self.0.add(t, &z.q, &z.p, &mut middle.q, &mut middle.p);
        let t = (t + end) * V::Scalar::constant(0.5, 0.0);
        self.1.add(t, &middle.q, &middle.p, &mut z.q, &mut z.p);
    }
}

impl OneStep for Runge {
    type Adjoint = Adjoint<Self>;
    fn adjoint(&self) -> Adjoint<Self> {
        Adjoint(self.clone())
    }
}
// A one-step scheme, end.

// A table.
/// McLachlan's scheme with two stages, (λ, ½ − λ) and (½ − λ, λ). Its order is 2 for every λ; this λ minimises the
/// error.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TwoStages;

impl Splitting for TwoStages {
    type Of<U> = [U; 2];
    #[inline(always)]
    fn stages(&self) -> [Durations; 2] {
        const LAMBDA: f64 = 0.193_183_327_503_783_6;
        const OUTER: Weight = Weight(LAMBDA, 0.0);
        const INNER: Weight = Weight(0.5 - LAMBDA, 0.0);
        [(OUTER, INNER), (INNER, OUTER)]
    }
    #[inline(always)]
    fn filled<U: Clone>(&self, value: U) -> [U; 2] {
        [value.clone(), value]
    }
}

impl Listed for TwoStages {
    fn entry(&self) -> Entry {
        Entry {
            name: "TwoStages",
            variant: "",
            equations: "",
            order: 2,
            duration: 1,
            needs: Needs::SPLIT,
            preserves: Form::OnePoint,
            source: "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151, doi:10.1137/0916010",
        }
    }
}

impl<S: Split> Scheme<S> for TwoStages {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ZigzagOf<T, S, S::Pieces<T>, Self>;
    fn times_of_jumps(&self, system: &Description) -> [f64; 2] {
        self.times_on(system.jumping_pieces())
    }
    #[inline(always)]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Zigzag::new(self, &S::pieces::<T>(), prepared, step)
    }
    #[inline(always)]
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &StateOf<S, T>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

impl OneStep for TwoStages {
    type Adjoint = Self;
    fn adjoint(&self) -> Self {
        *self
    }
}

/// It is its own adjoint.
impl Symmetric for TwoStages {}
// A table, end.

#[test]
fn their_orders_are_those_they_claim() {
    let (q, p) = (&[1.1][..], &[0.7][..]);
    is(2.0, slope(&Hand(Pumped), Runge, q, p));
    is(2.0, slope(&Hand(Pumped), TwoStages, q, p));
    // Being one-step schemes they have adjoints, and compositions.
    let half = Weight(0.5, 0.0);
    let both = Composition::new(Runge, [half, half], 2, "two halves");
    is(2.0, slope(&Hand(Pumped), both, q, p));
    is(2.0, slope(&Hand(Paper34), Adjoint(Runge), &[0.9], &[0.4]));
    is(4.0, slope(&Hand(Pumped), Yoshida4.of(TwoStages), q, p));
}

/// The recipes show these lines.
#[test]
fn the_recipes_show_them() {
    let read = |path: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        let text = std::fs::read_to_string(&path).expect("it is there");
        text.replace('\r', "")
    };
    let (here, document) = (read("tests/own.rs"), read("../book/src/extending.md"));
    for name in ["A one-step scheme", "A table"] {
        let after = here.split_once(&format!("// {name}.\n")).expect("begins").1;
        let lines = after
            .split_once(&format!("// {name}, end."))
            .expect("ends")
            .0;
        assert!(document.contains(lines), "{name} is not shown as it is");
    }
}
