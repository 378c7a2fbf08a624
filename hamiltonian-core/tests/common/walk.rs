//! The walk over the whole catalogue: every scheme on a system with the structure it asks for.
//!
//! Input: an action on a scheme. Output: the action done with each. Invariant: no entry is left out.

use super::kepler::{InRadius, in_radius, pericentre};
use super::start;
use super::systems::{Formula, Hand, HenonHeiles, Pumped, Relativistic};
use hamiltonian_core::VectorOf;
use hamiltonian_core::schemes::{
    author::catalogue,
    walk::{
        Visitor, visit_any, visit_compensated, visit_doubled, visit_energy, visit_exact,
        visit_implicit, visit_nystrom, visit_quadratic, visit_separable, visit_split,
        visit_transformed, visit_unforced,
    },
};
use hamiltonian_core::{
    QuadraticKinetic, Real, Scheme, State, System,
    schemes::author::{Group, OneStep},
};

/// H = ½(1 + ½ sin 2t)(q² + 1)(p² + 1): not separable, and with time in it.
#[derive(Debug, Clone)]
pub struct Swaying;

impl Formula<1> for Swaying {
    const NAME: &'static str = "Swaying";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> T {
        let half = T::constant(0.5, 0.0);
        let swaying = T::one() + half * (T::constant(2.0, 0.0) * t).sin();
        half * swaying * (q[0] * q[0] + T::one()) * (p[0] * p[0] + T::one())
    }
}

impl QuadraticKinetic for Hand<HenonHeiles, 2> {}

/// A system of the walk, with a start.
pub trait Sample<T: Real>: System + Sized {
    /// The system.
    fn sample() -> Self;
    /// The start.
    fn begin() -> State<VectorOf<Self, T>>;
}

macro_rules! sample {
    ($formula:ident, $n:literal, $q:expr, $p:expr) => {
        impl<T: Real> Sample<T> for Hand<$formula, $n> {
            fn sample() -> Self {
                Hand($formula)
            }
            fn begin() -> State<VectorOf<Self, T>> {
                start::<T, Self>(&Hand($formula), &$q, &$p)
            }
        }
    };
}

sample!(Swaying, 1, [0.9], [0.4]);
sample!(Pumped, 1, [0.9], [0.4]);
sample!(Relativistic, 1, [0.9], [0.4]);
sample!(HenonHeiles, 2, [0.12, 0.23], [0.31, -0.17]);

impl<T: Real> Sample<T> for InRadius {
    fn sample() -> Self {
        in_radius(false)
    }
    fn begin() -> State<VectorOf<Self, T>> {
        (in_radius(false).start(&pericentre::<T>(0.4))).expect("a good start")
    }
}

/// Counts.
struct Walk<'a, V> {
    visitor: &'a mut V,
    met: usize,
}

impl<S: System, V: Visitor<S>> Visitor<S> for Walk<'_, V> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        self.met += 1;
        self.visitor.visit(scheme);
    }
    fn visit_one_step<M>(&mut self, scheme: M)
    where
        M: Scheme<S> + OneStep<Adjoint: Scheme<S>>,
    {
        self.met += 1;
        self.visitor.visit_one_step(scheme);
    }
}

/// Every scheme of the catalogue, once.
pub fn everywhere<V>(visitor: &mut V)
where
    V: Visitor<Hand<Swaying, 1>>
        + Visitor<Hand<Pumped, 1>>
        + Visitor<Hand<HenonHeiles, 2>>
        + Visitor<InRadius>,
{
    let mut walk = Walk { visitor, met: 0 };
    visit_any::<Hand<Swaying, 1>>(&mut walk);
    visit_unforced::<Hand<Swaying, 1>>(&mut walk);
    visit_implicit::<Hand<Swaying, 1>>(&mut walk);
    visit_energy::<Hand<Swaying, 1>>(&mut walk);
    visit_doubled::<Hand<Swaying, 1>>(&mut walk);
    visit_split::<Hand<Pumped, 1>>(&mut walk);
    visit_exact::<Hand<Pumped, 1>>(&mut walk);
    visit_separable::<Hand<Pumped, 1>>(&mut walk);
    visit_compensated::<Hand<Pumped, 1>>(&mut walk);
    visit_nystrom::<Hand<HenonHeiles, 2>>(&mut walk);
    visit_quadratic::<Hand<HenonHeiles, 2>>(&mut walk);
    visit_transformed(&mut walk);
    assert_eq!(walk.met, catalogue().count());
}
