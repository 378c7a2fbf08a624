//! Tangents.

use crate::common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::{Scheme, Vector};

type Heiles = Hand<HenonHeiles, 2>;
type Plane = State<SVector<f64, 2>>;

const HEILES: Heiles = Hand(HenonHeiles);

/// The tangent of every scheme is the derivative of its map, and other deviations of the same span may
/// take the place of those it has.
struct Exact;

impl Visitor<Heiles> for Exact {
    fn visit<M: Scheme<Heiles>>(&mut self, scheme: M) {
        let name = scheme.entry().name;
        let begin: Plane = State::new([0.1, -0.25], [0.42, 0.1]);
        let new = |start| Tangent::new(&HEILES, scheme.clone(), start, 0.05, 4).unwrap();
        let mut tangent = new(begin.clone());
        tangent.advance(40).unwrap();
        let matrix = tangent.matrix();
        let end = |of: usize, by: f64| {
            let mut start = begin.clone();
            match of < 2 {
                true => *start.q.component_mut(of) += by,
                false => *start.p.component_mut(of - 2) += by,
            }
            let mut run = new(start);
            run.advance(40).unwrap();
            let state = run.state();
            let all = state.q.components().chain(state.p.components());
            all.map(|component| component.re).collect::<Vec<_>>()
        };
        let d = 1e-5;
        for j in 0..4 {
            let (above, below) = (end(j, d), end(j, -d));
            for i in 0..4 {
                let difference = (above[i] - below[i]) / (2.0 * d);
                let off = (matrix[(i, j)] - difference).abs();
                assert!(off < 1e-8, "{name}: {off:e} at ({i}, {j})");
            }
        }
        // M = QR, and then M′Q of the rest of the way: in all M′M.
        let mut often = new(begin.clone());
        let mut volume = 1.0;
        for _ in 0..8 {
            often.advance(5).unwrap();
            volume *= often.orthonormalise().iter().product::<f64>();
        }
        let expected = tangent.orthonormalise().iter().product::<f64>();
        assert!(
            (volume / expected - 1.0).abs() < 1e-8,
            "{name}: {volume} {expected}"
        );
    }
}

#[test]
fn tangents_of_all_schemes_are_their_derivatives() {
    visit_any(&mut Exact);
    visit_unforced(&mut Exact);
    visit_separable(&mut Exact);
    visit_split(&mut Exact);
}
