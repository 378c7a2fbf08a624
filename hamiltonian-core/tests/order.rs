//! The order of every scheme of the catalogue, measured by slopes over five steps, on systems
//! that are neither linear nor quadratic, with and without time in H.

mod common;

use common::checks::{self, Order};
use common::systems::*;
use hamiltonian_core::schemes::{catalogue, visit_any, visit_separable};
use hamiltonian_core::{DoubleDouble, System};

fn order<S: System<DoubleDouble>>(
    system: S,
    q: &[f64],
    p: &[f64],
    span: f64,
    coarsest: f64,
) -> Order<S> {
    let start = checks::start(&system, q, p);
    Order {
        system,
        start,
        span,
        coarsest,
        measured: Vec::new(),
    }
}

#[test]
fn of_all_schemes_on_a_separable_system() {
    let mut order = order(Hand(Relativistic), &[0.9], &[0.4], 2.0, 0.02);
    visit_any(&mut order);
    visit_separable(&mut order);
    assert_eq!(order.measured.len(), catalogue().count());
    for (entry, slope) in order.measured {
        println!("{} {}: {slope:.3}", entry.name, entry.variant);
    }
}

#[test]
fn of_all_schemes_where_both_halves_depend_on_time() {
    let mut order = order(Hand(Pumped), &[0.9], &[0.4], 2.0, 0.02);
    visit_any(&mut order);
    visit_separable(&mut order);
}

#[test]
fn of_all_schemes_on_the_driven_oscillator() {
    let mut order = order(
        Hand(Driven { a: 0.1, omega: 1.0 }),
        &[1.0],
        &[0.0],
        2.0,
        0.02,
    );
    visit_any(&mut order);
    visit_separable(&mut order);
}

#[test]
fn on_the_papers_nonseparable_system() {
    visit_any(&mut order(Hand(Paper34), &[-3.0], &[0.0], 1.0, 0.002));
}

#[test]
fn on_a_nonseparable_system_with_time() {
    visit_any(&mut order(Hand(Shaken34), &[1.0], &[0.5], 2.0, 0.01));
}

#[test]
fn on_the_double_pendulum() {
    visit_any(&mut order(
        Hand(DoublePendulum),
        &[0.8, -0.4],
        &[0.3, 0.2],
        1.0,
        0.005,
    ));
}
