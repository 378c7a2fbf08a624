//! Schemes that a user adds: the two of `ARCHITECTURE.md`, to the letter, with their orders.

use crate::common::systems::*;
use crate::composition::{is, slope};
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::{Durations, Table, Weight, Zigzag, ZigzagOf};
use hamiltonian_core::{Dynamics, Entry, Form, Listed, Map, Needs, OneStep, Point, Scheme};
use hamiltonian_core::{Split, Step, Vector, VectorField};
use std::marker::PhantomData;

const fn entry(name: &'static str, order: u32, preserves: Form) -> Entry {
    Entry {
        name,
        variant: "",
        equations: "",
        order,
        duration: 1,
        needs: Needs::Any,
        preserves,
        source: "this test",
    }
}

impl Listed for Runge {
    fn entry(&self) -> Entry {
        entry("Runge", 2, Form::Nothing)
    }
}

impl Listed for Ruth {
    fn entry(&self) -> Entry {
        entry("Ruth", 3, Form::OnePoint)
    }
}

// A one-step scheme.
/// z ← z + h J∇H(z + h/2 J∇H(z)).
#[derive(Debug, Clone, PartialEq)]
struct Runge;

impl<T: Real, S: System<T>> Scheme<T, S> for Runge {
    type Map = Twice<S::Vector, <S::Prepared as Dynamics<T>>::Field>;
    fn prepare(&self, prepared: &S::Prepared, step: Step<T>) -> Self::Map {
        let half = step.h * T::constant(0.5, 0.0);
        Twice(prepared.field(half), prepared.field(step.h), PhantomData)
    }
    fn start(&self, _: &S::Prepared, state: &State<S::Vector>, _: T) -> Point<S::Vector> {
        state.point()
    }
}

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
// A one-step scheme, end.

impl OneStep for Runge {
    type Adjoint = Adjoint<Self>;
    fn adjoint(&self) -> Adjoint<Self> {
        Adjoint(self.clone())
    }
}

// A table.
/// Ruth's scheme of order 3: 7/24, 2/3, 3/4, −2/3, −1/24, 1 of the two pieces in turn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ruth;

impl Table for Ruth {
    type Of<U> = [U; 3];
    fn stages(&self) -> [Durations; 3] {
        const FIRST: Weight = Weight(0.2916666666666667, -1.850371707708594e-17);
        const MIDDLE: Weight = Weight(0.375, 0.0);
        const BACK: Weight = Weight(-1.0416666666666667, 7.401486830834377e-17);
        const LAST: Weight = Weight(1.0, 0.0);
        const NONE: Weight = Weight(0.0, 0.0);
        [(FIRST, MIDDLE), (MIDDLE, BACK), (LAST, NONE)]
    }
    fn map<A, U>(of: [A; 3], f: impl FnMut(A) -> U) -> [U; 3] {
        of.map(f)
    }
}

impl<T: Real, S: Split<T>> Scheme<T, S> for Ruth {
    type Map = ZigzagOf<T, S, S::Pieces, Self>;
    fn prepare(&self, prepared: &S::Prepared, step: Step<T>) -> Self::Map {
        Zigzag::new(self, &S::PIECES, prepared, step)
    }
    fn start(&self, _: &S::Prepared, state: &State<S::Vector>, _: T) -> Point<S::Vector> {
        state.point()
    }
}
// A table, end.

#[test]
fn their_orders_are_those_they_claim() {
    let (q, p) = (&[1.1][..], &[0.7][..]);
    is(2.0, slope(&Hand(Pumped), Runge, q, p));
    is(3.0, slope(&Hand(Pumped), Ruth, q, p));
    // Being one-step schemes they have adjoints, and compositions.
    let half = Weight(0.5, 0.0);
    let both = Composition::new(Runge, [half, half], 2, "two halves");
    is(2.0, slope(&Hand(Pumped), both, q, p));
    is(2.0, slope(&Hand(Paper34), Adjoint(Runge), &[0.9], &[0.4]));
}

/// The document shows these lines.
#[test]
fn the_document_shows_them() {
    let read = |path: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        let text = std::fs::read_to_string(&path).expect("it is there");
        text.replace('\r', "")
    };
    let (here, document) = (read("tests/own.rs"), read("../ARCHITECTURE.md"));
    for name in ["A one-step scheme", "A table"] {
        let after = here.split_once(&format!("// {name}.\n")).expect("begins").1;
        let lines = after
            .split_once(&format!("// {name}, end."))
            .expect("ends")
            .0;
        let shown = format!("```rust\n{lines}```");
        assert!(document.contains(&shown), "{name} is not shown as it is");
    }
}
