//! Located events.

use crate::common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_exact, visit_implicit, visit_quadratic, visit_separable, visit_split,
    visit_unforced,
};
use hamiltonian_core::{Scheme, observers::Located};

type Heiles = Hand<HenonHeiles, 2>;
type Plane = SVector<f64, 2>;

/// A function and the sign of the slope that counts, 0 for both.
type Watched = (fn(&State<Plane>) -> f64, i8);

fn begin() -> State<Plane> {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// x = 0 rising, y = 0 both ways, and y at its extremes.
fn events() -> Events<Plane> {
    Events::new([
        Event::of("x", |state: &State<Plane>| state.q[0]).with_direction(1),
        Event::of("y", |state: &State<Plane>| state.q[1]),
        Event::of("turn", |state: &State<Plane>| state.p[1]).with_direction(-1),
    ])
}

/// Every scheme locates events, leaves the run as it is, and goes on from a saved run with all of it.
struct Locates;

impl Visitor<Heiles> for Locates {
    fn visit<M: Scheme<Heiles>>(&mut self, scheme: M) {
        let name = scheme.entry().name;
        let (h, steps) = (0.0625, 320);
        let new = || Integrator::new(&Hand(HenonHeiles), scheme.clone(), begin(), h).unwrap();
        let mut plain = new();
        let mut run = new().observe(events());
        let mut around: Vec<[State<Plane>; 2]> = Vec::new();
        for _ in 0..steps {
            let before = plain.state().clone();
            around.push([before, plain.advance(1).unwrap().clone()]);
        }
        run.advance(steps).unwrap();
        assert_eq!(run.state(), plain.state(), "{name}");
        assert_eq!(run.carried(), plain.carried(), "{name}");

        // As many as there are changes of sign between steps, and in their order.
        let located = run.observer().located();
        let functions: [Watched; 3] = [(|s| s.q[0], 1), (|s| s.q[1], 0), (|s| s.p[1], -1)];
        let mut expected = Vec::new();
        for [before, after] in &around {
            let mut here = Vec::new();
            for (event, (function, slope)) in functions.iter().enumerate() {
                let (a, b) = (function(before), function(after));
                let rises = a < 0.0 && b > 0.0 && *slope >= 0;
                let falls = a > 0.0 && b < 0.0 && *slope <= 0;
                if rises || falls {
                    here.push((event, rises, before.t, after.t, a / (a - b)));
                }
            }
            here.sort_by(|a, b| a.4.total_cmp(&b.4));
            expected.extend(here);
        }
        assert!(expected.len() > 8, "{name}");
        assert_eq!(located.len(), expected.len(), "{name}");
        for (located, (event, rises, from, to, _)) in located.iter().zip(expected) {
            let Located { state, rising, .. } = located;
            assert_eq!((located.event, *rising), (event, rises), "{name}");
            assert!(
                from <= state.t && state.t <= to,
                "{name}: {from} {} {to}",
                state.t
            );
            let value = functions[event].0(state);
            assert!(value.abs() < 4e-16, "{name}: {value:e}");
        }
        let times: Vec<f64> = located.iter().map(|located| located.state.t).collect();
        assert!(times.is_sorted(), "{name}");

        // Saved in between, and at the end.
        for made in [0, 1, 97, 320] {
            let mut first = new().observe(events());
            first.advance(made).unwrap();
            let saved = Checkpoint::from_bytes(&first.checkpoint().to_bytes()).unwrap();
            let mut again = Integrator::resume(&Hand(HenonHeiles), scheme.clone(), saved)
                .unwrap()
                .observe(events());
            again.advance(steps - made).unwrap();
            assert_eq!(
                again.observer().located(),
                run.observer().located(),
                "{name}"
            );
            assert_eq!(again.checkpoint(), run.checkpoint(), "{name}");
        }
    }
}

#[test]
fn every_scheme_locates_events() {
    visit_any(&mut Locates);
    visit_unforced(&mut Locates);
    visit_separable(&mut Locates);
    visit_split(&mut Locates);
    visit_exact(&mut Locates);
    visit_implicit(&mut Locates);
    visit_quadratic(&mut Locates);
}
