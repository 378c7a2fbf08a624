//! Invariants of Lagrangians in velocities, whose mass matrices are blocks.

use crate::common::{parse, system};
use hamiltonian_symbolic::bracket::{Verdict, is_invariant_of_lagrangian};
use hamiltonian_symbolic::dag::{Array, Node, Side};
use hamiltonian_symbolic::legendre::{Legendre, transform};
use hamiltonian_symbolic::model::Model;

/// A system given by L, in which momenta stand for velocities, and its H.
fn lagrangian(signature: &str, parameters: &str, l: &str) -> (Model, Legendre) {
    let mut model = system(signature, "", parameters, l);
    let lagrangian = model.h();
    let legendre = transform(&mut model, lagrangian).unwrap();
    model.hamiltonian = Some(legendre.hamiltonian);
    (model, legendre)
}

/// The verdict on an expression of velocities.
fn verdict(model: &mut Model, legendre: &Legendre, source: &str) -> Verdict {
    let node = parse(model, source);
    let in_velocities = model.dag.substitute(node, |dag, node| {
        let (column, row) = dag.phase_place(node)?;
        let velocity = Array::Velocity(column.on(Side::Q));
        let row = row.clone();
        (column.side == Side::P).then(|| dag.element(velocity, row, None))
    });
    let velocity = |node: Node| {
        let mut velocities = legendre.velocities.iter();
        velocities.find(|v| v.element == node).map(|v| v.value)
    };
    let expression = model.dag.substitute(node, |_, node| velocity(node));
    is_invariant_of_lagrangian(model, expression, legendre, in_velocities)
}

fn check(signature: &str, parameters: &str, l: &str, good: &[&str], bad: &[&str]) {
    let (mut model, legendre) = lagrangian(signature, parameters, l);
    for source in good {
        let found = verdict(&mut model, &legendre, source);
        assert!(found.is_proven(), "{source}: {found:?}");
    }
    for source in bad {
        let found = verdict(&mut model, &legendre, source);
        assert!(
            matches!(found, Verdict::Disproven { .. }),
            "{source}: {found:?}"
        );
    }
}

#[test]
fn a_block_of_masses_keeps_its_energy() {
    let energy = "(3+x^2)*u^2/2 + x*u*v + (2+x^2)*v^2/2 + (4+x^4)*w^2/2 + x*v*w + x^2*u*w";
    check(
        "x, y, z; u, v, w",
        "",
        energy,
        // y and z are cyclic.
        &[
            energy,
            "x*u + (2 + x^2)*v + x*w",
            "(4 + x^4)*w + x*v + x^2*u",
        ],
        &["(3 + x^2)*u + x*v + x^2*w", "u*v"],
    );
}

/// φ, θ, ψ in the convention z-x-z.
#[test]
fn the_asymmetric_top_keeps_energy_and_momentum() {
    let (one, two, three) = (
        "(u*sin(y)*sin(z) + v*cos(z))",
        "(u*sin(y)*cos(z) - v*sin(z))",
        "(u*cos(y) + w)",
    );
    let energy = format!("(a*{one}^2 + b*{two}^2 + c*{three}^2)/2");
    let vertical = format!("a*{one}*sin(y)*sin(z) + b*{two}*sin(y)*cos(z) + c*{three}*cos(y)");
    let total = format!("a^2*{one}^2 + b^2*{two}^2 + c^2*{three}^2");
    let wrong = format!("a*{one}^2 + b^2*{two}^2 + c^2*{three}^2");
    check(
        "x, y, z; u, v, w",
        "a b c",
        &energy,
        &[&energy, &vertical, &total],
        &[&wrong, &format!("c*{three}")],
    );
}

#[test]
fn the_double_pendulum_without_gravity_keeps_its_momentum() {
    let energy = "(m + n)*k^2*u^2/2 + n*l^2*v^2/2 + n*k*l*u*v*cos(x - y)";
    check(
        "x, y; u, v",
        "m n k l",
        energy,
        &[energy, "(m + n)*k^2*u + n*l^2*v + n*k*l*(u + v)*cos(x - y)"],
        &["(m + n)*k^2*u + n*l^2*v"],
    );
}

/// The limit of velocities is named where it leaves a claim undecided, and not below it.
#[test]
fn the_limit_of_velocities_is_named() {
    let why = |count: usize| {
        let list = |letter: char| (1..=count).map(move |k| format!("{letter}{k}"));
        let [q, v] = ['q', 'v'].map(|letter| list(letter).collect::<Vec<_>>().join(", "));
        let squares: Vec<String> = list('v').map(|v| format!("{v}^2/2")).collect();
        let l = format!("{} - (1 + q1)^1000", squares.join(" + "));
        let (mut model, legendre) = lagrangian(&format!("{q}; {v}"), "", &l);
        match verdict(&mut model, &legendre, "v1^2/2 + (1 + 2*q1 + q1^2)^500") {
            Verdict::Undecided { why, .. } => why,
            found => panic!("{found:?}"),
        }
    };
    assert!(!why(6).contains("velocities"));
    assert!(why(7).ends_with("; a proof in velocities is tried with at most 6 of them"));
}
