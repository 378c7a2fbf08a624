//! A system by hand that cannot stand in lanes: the message names the trait that is missing.

use hamiltonian::nalgebra::SVector;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::{Dynamics, Group, Observable, VectorField};

type V<T> = SVector<T, 1>;

struct Free;

/// H = p²/2, prepared.
#[derive(Debug, Clone)]
struct Ready<T>(T);

impl<T: Real> System<T> for Free {
    type Vector = V<T>;
    type Prepared = Ready<T>;
    const NAME: &'static str = "Free";
    const GROUPS: &'static [Group] = &[];
    const OBSERVABLES: &'static [Observable] = &[];
    fn prepare(&self) -> Ready<T> {
        Ready(T::zero())
    }
    fn zeros(&self) -> V<T> {
        V::from_element(T::zero())
    }
}

impl<T: Real> Dynamics<T> for Ready<T> {
    type Vector = V<T>;
    type Field = Self;
    fn energy(&self, _: T, _: &V<T>, p: &V<T>) -> T {
        p[0] * p[0] * T::constant(0.5, 0.0)
    }
    fn gradient_q(&self, _: T, _: &V<T>, _: &V<T>, _: &mut V<T>) {}
    fn gradient_p(&self, _: T, _: &V<T>, p: &V<T>, out: &mut V<T>) {
        out[0] = p[0];
    }
    fn time_derivative(&self, _: T, _: &V<T>, _: &V<T>) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self, _: T, _: &V<T>, _: &V<T>, _: &V<T>, vp: &V<T>, _: &mut V<T>, out_p: &mut V<T>,
    ) {
        out_p[0] = vp[0];
    }
    fn observable(&self, _: usize, _: T, _: &V<T>, _: &V<T>) -> T {
        T::zero()
    }
    fn field(&self, c: T) -> Self {
        Ready(c)
    }
}

impl<T: Real> VectorField<V<T>> for Ready<T> {
    fn add(&self, _: T, _: &V<T>, p: &V<T>, into_q: &mut V<T>, _: &mut V<T>) {
        into_q[0] += self.0 * p[0];
    }
}

fn main() {
    let start = |_| (Free, State::new([1.0], [0.0]));
    let _ = Ensemble::new(10, start, RungeKutta4, 0.1);
}
