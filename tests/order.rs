//! The order of every scheme of the catalogue, measured by slopes over five steps, on systems
//! that are neither linear nor quadratic, with and without time in H.

use crate::common::measured_here;
use crate::common::order::Order;
use crate::common::systems::*;
use hamiltonian::schemes::walk::{visit_any, visit_separable, visit_split, visit_unforced};
use hamiltonian::{Separable, Split, Unforced};

fn separable<S>(mut order: Order<S>)
where
    S: Separable + Split + Unforced,
{
    visit_any(&mut order);
    visit_unforced(&mut order);
    visit_split(&mut order);
    visit_separable(&mut order);
    assert_eq!(order.measured.len(), measured_here());
    for (entry, slope) in order.measured {
        println!("{entry}: {slope:.3}");
    }
}

#[test]
fn on_a_separable_system() {
    let system = Relativistic::default();
    separable(Order::new(system, &[0.9], &[0.4], 2.0, 0.02));
}

#[test]
fn where_both_halves_depend_on_time() {
    let system = Pumped::default();
    separable(Order::new(system, &[0.9], &[0.4], 2.0, 0.02));
}

#[test]
fn on_the_papers_nonseparable_system() {
    let system = Paper34::default();
    let mut order = Order::new(system, &[-3.0], &[0.0], 1.0, 0.002);
    visit_any(&mut order);
    visit_unforced(&mut order);
    visit_split(&mut order);
}

#[test]
fn on_a_nonseparable_system_with_time() {
    let system = Shaken34::default();
    let mut order = Order::new(system, &[1.0], &[0.5], 2.0, 0.01);
    visit_any(&mut order);
    visit_unforced(&mut order);
    visit_split(&mut order);
}

#[test]
fn on_the_double_pendulum() {
    let (system, q, p) = (DoublePendulum::default(), [0.8, -0.4], [0.3, 0.2]);
    let mut order = Order::new(system, &q, &p, 1.0, 0.005);
    visit_any(&mut order);
    visit_unforced(&mut order);
}
