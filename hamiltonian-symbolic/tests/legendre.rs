//! Lagrangians become Hamiltonians, or are refused with the reason.

use crate::common::{model, parse};
use hamiltonian_symbolic::dag::{Array, Column, Dependence, Kind, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::legendre::{ElementMap, Legendre, transform};
use hamiltonian_symbolic::loops::unroll_nodes;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::print::text;

/// A model whose velocities stand in the place of momenta, as its L is read.
fn lagrangian(signature: &str, sizes: &str, parameters: &str, l: &str) -> (Model, Node) {
    let mut m = model(signature, sizes, parameters);
    let node = parse(&mut m, l);
    for group in &mut m.groups {
        let momentum = format!("p_{}", group.coordinate);
        group.velocity = Some(std::mem::replace(&mut group.momentum, momentum));
    }
    (m, node)
}

fn transformed(signature: &str, sizes: &str, parameters: &str, l: &str) -> (Model, Legendre, Node) {
    let (mut m, node) = lagrangian(signature, sizes, parameters, l);
    let legendre = transform(&mut m, node).unwrap_or_else(|reason| panic!("{l}: {reason:?}"));
    (m, legendre, node)
}

fn refused(signature: &str, sizes: &str, parameters: &str, l: &str) -> String {
    let (mut m, node) = lagrangian(signature, sizes, parameters, l);
    transform(&mut m, node).expect_err(l).reason
}

fn substituted(m: &mut Model, node: Node, values: &[(Node, Node)]) -> Node {
    m.dag.substitute(node, |_, leaf| {
        values
            .iter()
            .find(|(from, _)| *from == leaf)
            .map(|(_, to)| *to)
    })
}

/// v(q, p(q, v)) = v, ∂H/∂p = v and p·v − L = H, by normal form.
fn check(m: &mut Model, legendre: &Legendre, l: Node) {
    let momenta: Vec<(Node, Node)> = legendre
        .momenta
        .iter()
        .map(|c| (c.element, c.value))
        .collect();
    let velocities: Vec<(Node, Node)> = legendre
        .velocities
        .iter()
        .map(|c| (c.element, c.value))
        .collect();
    let gradient = diff::gradient(&mut m.dag, legendre.hamiltonian, Dependence::P);
    for &(element, velocity) in &velocities {
        let back = substituted(m, velocity, &momenta);
        let difference = m.dag.sub(back, element);
        assert_eq!(
            is_zero(m, difference),
            Proof::Zero,
            "v(p(v)) of {}",
            text(m, element)
        );
        let slope = gradient
            .iter()
            .find(|(leaf, _)| *leaf == element)
            .map_or_else(|| m.dag.integer(0), |(_, slope)| *slope);
        let difference = m.dag.sub(slope, velocity);
        assert_eq!(
            is_zero(m, difference),
            Proof::Zero,
            "∂H/∂p of {}",
            text(m, element)
        );
    }
    let mut sum: Vec<Node> = Vec::new();
    for &(element, velocity) in &velocities {
        sum.push(m.dag.mul(&[element, velocity]));
    }
    let l = substituted(m, l, &velocities);
    let minus = m.dag.neg(l);
    sum.push(minus);
    let energy = m.dag.add(&sum);
    let difference = m.dag.sub(energy, legendre.hamiltonian);
    assert_eq!(is_zero(m, difference), Proof::Zero, "p·v − L = H");
}

#[test]
fn constant_and_diagonal_masses() {
    let (m, legendre, _) = transformed("x; v", "", "m k", "m*v^2/2 - k*x^2/2");
    assert_eq!(text(&m, legendre.hamiltonian), "p_x^2/(2*m) + 0.5*k*x^2");
    assert_eq!(text(&m, legendre.momenta[0].value), "m*p_x");
    assert_eq!(text(&m, legendre.velocities[0].value), "p_x/m");
    let (mut m, legendre, l) = transformed(
        "r, phi; v_r, v_phi",
        "",
        "m k",
        "m*(v_r^2 + r^2*v_phi^2)/2 + k/r",
    );
    assert_eq!(
        text(&m, legendre.hamiltonian),
        "p_r^2/(2*m) + p_phi^2/(2*m*r^2) - k/r"
    );
    check(&mut m, &legendre, l);
}

#[test]
fn the_double_pendulum() {
    let (mut m, legendre, l) = transformed(
        "a, b; va, vb",
        "",
        "m1 m2 l1 l2 g",
        "(m1 + m2)*l1^2*va^2/2 + m2*l2^2*vb^2/2 + m2*l1*l2*va*vb*cos(a - b) + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b)",
    );
    check(&mut m, &legendre, l);
    let known = parse(
        &mut m,
        "(m2*l2^2*p_a^2 + (m1 + m2)*l1^2*p_b^2 - 2*m2*l1*l2*p_a*p_b*cos(a - b))/(2*m2*l1^2*l2^2*(m1 + m2*sin(a - b)^2)) - (m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)",
    );
    let difference = m.dag.sub(legendre.hamiltonian, known);
    assert_eq!(is_zero(&m, difference), Proof::Zero);
}

#[test]
fn dense_matrices_up_to_four() {
    let (mut m, legendre, l) = transformed(
        "x, y, z; u, v, w",
        "",
        "a b c",
        "u^2/2*(1 + x^2) + v^2*a/2 + w^2/2 + u*v*sin(z) + b*v*w*x + u*w*c - x*y*z",
    );
    check(&mut m, &legendre, l);
    let (mut m, legendre, l) = transformed(
        "x, y, z, s; u, v, w, r",
        "",
        "a",
        "a*u^2/2 + v^2 + 3*w^2/2 + 2*r^2 + cos(x)*(u*v + w*r)/4 + u*w/3 + v*r/2 + u*r/7 + v*w/5 - x^2",
    );
    check(&mut m, &legendre, l);
}

#[test]
fn gyroscopic_terms_shift_momenta() {
    let (mut m, legendre, l) = transformed(
        "x, y; u, v; t",
        "",
        "B m",
        "m*(u^2 + v^2)/2 + B*(x*v - y*u)/2 + x*u*cos(t)",
    );
    assert_eq!(text(&m, legendre.momenta[1].value), "m*p_y + 0.5*B*x");
    check(&mut m, &legendre, l);
}

#[test]
fn a_vanishing_diagonal_is_no_obstacle() {
    let (mut m, legendre, l) = transformed("x, y; u, v", "", "a", "a*u*v - x*y");
    assert_eq!(text(&m, legendre.hamiltonian), "p_x*p_y/a + x*y");
    check(&mut m, &legendre, l);
    let (mut m, legendre, l) = transformed(
        "x, y, z; u, v, w",
        "",
        "a b",
        "a*u*v + b*x*u*w + w*v + u + w*y",
    );
    check(&mut m, &legendre, l);
    let (mut m, legendre, l) =
        transformed("x, y; u, v", "", "", "(u + v)^2/2 + (u - v)^2/2*(1 + x^2)");
    check(&mut m, &legendre, l);
}

#[test]
fn degenerate_ones_are_refused_with_the_reason() {
    assert_eq!(refused("x; v", "", "", "x^2"), "L has no velocities");
    assert_eq!(
        refused("x, y; u, v", "", "", "u^2/2 + v*x"),
        "the mass matrix is singular: L has no term that is quadratic in `v`"
    );
    assert_eq!(
        refused("x, y; u, v", "", "", "(u + v)^2/2 - x"),
        "the mass matrix is singular: the momentum of `v` is determined by the other momenta"
    );
    assert_eq!(
        refused(
            "x, y; u, v",
            "",
            "",
            "(u*cos(x) + v*sin(x))^2/2 + 0*(u^2 + v^2)"
        ),
        "the mass matrix is singular: the momentum of `v` is determined by the other momenta"
    );
    assert_eq!(
        refused("x; v", "", "", "v^4/4 - x"),
        "L is not quadratic in the velocities: its second derivative with respect to `v` and `v` depends on them"
    );
    assert_eq!(
        refused("x; v", "", "m c", "-m*c^2*sqrt(1 - v^2/c^2)"),
        "L is not quadratic in the velocities: `sqrt(1 - v^2/c^2)` is not a polynomial in them"
    );
    assert_eq!(
        refused("x; v", "", "", "x/v"),
        "L is not quadratic in the velocities: `x/v` is not a polynomial in them"
    );
    assert_eq!(
        refused("x, y; u, v", "", "", "u^2/2 + v^2/2 + u*v^2"),
        "L is not quadratic in the velocities: its second derivative with respect to `u` and `v` depends on them"
    );
    assert_eq!(
        refused("q[N]; v[N]", "N", "", "sum(i in 0..N) { v[i]^4 }"),
        "L is not quadratic in the velocities: its second derivative with respect to `v[k]` and `v[k]` depends on them"
    );
    assert_eq!(
        refused("x; v", "", "k", "v^2/2 + if k == 1 { v^3 } else { 0 }"),
        "L is not quadratic in the velocities: its second derivative with respect to `v` and `v` depends on them"
    );
    // v² all the same.
    let (mut m, legendre, l) = transformed("x; v", "", "", "v^4/(2*v^2) - x");
    check(&mut m, &legendre, l);
    let (mut m, legendre, l) = transformed("x; v", "", "", "(v^2 + 1)^2/4 - v^4/4");
    check(&mut m, &legendre, l);
}

#[test]
fn arrays_stay_loops() {
    let (m, legendre, _) = transformed(
        "q[N]; v[N]",
        "N",
        "m[N]",
        "sum(i in 0..N) { m[i]*v[i]^2/2 - exp(q[i] - q[(i + 1) % N]) }",
    );
    assert_eq!(
        text(&m, legendre.hamiltonian),
        "sum(i in 0..N) { p_q[i]^2/m[i] }/2 + sum(i in 0..N) { exp(q[i] - q[(i + 1) % N]) }"
    );
    assert!(legendre.velocities[0].domain.is_some());
    let Kind::Element(Array::Phase(Column { side: Side::P, .. }), ..) =
        m.dag.kind(legendre.velocities[0].element)
    else {
        panic!()
    };
    assert_eq!(text(&m, legendre.velocities[0].value), "p_q[i]/m[i]");
    // The columns of one row, and a scalar beside.
    let (m, legendre, _) = transformed(
        "q[n][2], s; v[n][2], r",
        "n",
        "m[n]",
        "sum(i in 0..n) { m[i]*(v[i][0]^2 + q[i][0]^2*v[i][1]^2)/2 + v[i][0]*q[i][1] } + r^2/2*(1 + s^2)",
    );
    assert_eq!(
        text(&m, legendre.hamiltonian),
        "p_s^2/(2*(s^2 + 1)) + sum(i in 0..n) { (p_q[i][0] - q[i][1])^2/(2*m[i]) + p_q[i][1]^2/(2*m[i]*q[i][0]^2) }"
    );
}

#[test]
fn coupled_elements_are_refused_or_written_out() {
    assert_eq!(
        refused(
            "q[N]; v[N]",
            "N",
            "",
            "sum(i in 0..N) { v[i]^2/2 + v[i]*v[(i + 1) % N]/4 }"
        ),
        "the mass matrix couples `v[k]` with `v[(k + 1) % N]`; in arrays only the columns of one row may be coupled"
    );
    assert!(
        refused(
            "q[N], s; v[N], r",
            "N",
            "",
            "r^2/2 + sum(i in 0..N) { v[i]^2/2 + r*v[i] }"
        )
        .starts_with("the mass matrix couples `r` with")
    );
    let (mut m, legendre, l) = transformed(
        "q[3]; v[3]",
        "",
        "",
        "sum(i in 0..3) { v[i]^2/2 + v[i]*v[(i + 1) % 3]/4 } - q[0]*q[1]",
    );
    assert_eq!(legendre.momenta.len(), 3);
    let written = hamiltonian_symbolic::loops::unrolled(&mut m, l).unwrap();
    check(&mut m, &legendre, written);
}

#[test]
fn sums_over_all_elements_couple_them() {
    let coupled = "the mass matrix couples `v[k]` with `v[j]`; in arrays only the columns of one row may be coupled";
    let kinetic = "sum(i in 0..N) { v[i]^2 }";
    for l in [
        format!("{kinetic} + (sum(i in 0..N) {{ v[i] }})^2"),
        format!("{kinetic} + sum(i in 0..N, j in 0..N) {{ v[i]*v[j] }}"),
        "(sum(i in 0..N) { v[i] })^2".to_owned(),
    ] {
        assert_eq!(refused("q[N]; v[N]", "N", "", &l), coupled, "{l}");
    }
    assert_eq!(
        refused(
            "q[3]; v[3]",
            "",
            "",
            "sum(i in 0..3, j in 0..3) { v[i]*v[j] }"
        ),
        "the mass matrix is singular: the momentum of `v[1]` and `v[2]` is determined by the other momenta"
    );
    let (mut m, legendre, l) = transformed(
        "q[3]; v[3]",
        "",
        "",
        "sum(i in 0..3) { v[i]^2 } + (sum(i in 0..3) { v[i] })^2",
    );
    let written = hamiltonian_symbolic::loops::unrolled(&mut m, l).unwrap();
    check(&mut m, &legendre, written);
    // Sums that cancel couple nothing.
    let (m, legendre, _) = transformed(
        "q[N]; v[N]",
        "N",
        "",
        "sum(i in 0..N) { v[i]^2 } + q[0]*sum(i in 0..N) { v[i]*sum(j in 0..N) { v[j] } } - q[0]*(sum(i in 0..N) { v[i] })^2",
    );
    assert_eq!(
        text(&m, legendre.hamiltonian),
        "sum(i in 0..N) { p_q[i]^2 }/4"
    );
}

#[test]
fn elements_without_mass_are_named() {
    let without = |signature: &str, sizes: &str, parameters: &str, l: &str| {
        let reason = refused(signature, sizes, parameters, l);
        let start = "the mass matrix is singular: L has no term that is quadratic in ";
        let element = reason.strip_prefix(start);
        element
            .unwrap_or_else(|| panic!("{l}: {reason}"))
            .to_owned()
    };
    let of_n = |l: &str| without("q[N]; v[N]", "N", "m[N]", l);
    assert_eq!(of_n("sum(i in 1..N) { v[i]^2 }"), "`v[0]`");
    assert_eq!(of_n("sum(i in 0..N) { i*v[i]^2/2 }"), "`v[0]`");
    assert_eq!(of_n("sum(i in 0..N) { (i - 3)*v[i]^2/2 }"), "`v[3]`");
    assert_eq!(of_n("sum(i in 0..N - 1) { v[i]^2 }"), "`v[N - 1]`");
    assert_eq!(of_n("v[0]^2 + sum(i in 2..N) { v[i]^2 }"), "`v[1]`");
    assert_eq!(of_n("sum(i in 0..N) { (m[i] - m[0])*v[i]^2 }"), "`v[0]`");
    assert_eq!(
        without("q[3]; v[3]", "", "", "sum(i in 1..3) { v[i]^2 }"),
        "`v[0]`"
    );
    assert_eq!(
        without("q[1000]; v[1000]", "", "", "sum(i in 0..999) { v[i]^2 }"),
        "`v[999]`"
    );
    let columns = |l: &str| refused("q[N][2]; v[N][2]", "N", "", l);
    assert_eq!(
        columns("sum(i in 0..N) { v[i][0]^2/2 + i*v[i][1]^2/2 }"),
        "the mass matrix is singular: L has no term that is quadratic in `v[0][1]`"
    );
    assert_eq!(
        columns("sum(i in 0..N) { v[i][0]^2/2 + v[i][0]*v[i][1] + (i + 1)*v[i][1]^2/2 }"),
        "the mass matrix is singular: the momentum of `v[0][1]` is determined by the other momenta"
    );
    assert_eq!(
        columns("sum(i in 0..N) { i*v[i][0]^2/2 + v[i][0]*v[i][1] + i*v[i][1]^2/2 }"),
        "no formula gives the velocities of all elements: its divisor would be 0 for `v[0][0]`"
    );
    // A divisor that is 0 nowhere is found where there is one.
    let (mut m, legendre, l) = transformed(
        "q[N][2]; v[N][2]",
        "N",
        "",
        "sum(i in 0..N) { i*v[i][0]^2/2 + v[i][0]*v[i][1] + v[i][1]^2 }",
    );
    check_looped(&mut m, &legendre, l);
}

/// [`check`] of the system written out for four elements.
fn check_looped(m: &mut Model, legendre: &Legendre, l: Node) {
    let k = legendre.momenta[0].domain.expect("there is a loop");
    let sizes = vec![4; m.sizes.len()];
    let mut roots = vec![l, legendre.hamiltonian];
    for at in 0..4 {
        for component in legendre.momenta.iter().chain(&legendre.velocities) {
            for node in [component.element, component.value] {
                roots.push(m.dag.replace(node, k, &Affine::constant(at)));
            }
        }
    }
    let (mut written, images) = unroll_nodes(m, &sizes, &roots).expect("four elements");
    let mut images = images.into_iter();
    let l = images.next().expect("L");
    let mut legendre = Legendre {
        hamiltonian: images.next().expect("H"),
        momenta: Vec::new(),
        velocities: Vec::new(),
        ..legendre.clone()
    };
    let columns = (images.len() / 4) / 4;
    let images: Vec<Node> = images.collect();
    for (at, pair) in images.chunks_exact(2).enumerate() {
        let component = ElementMap {
            element: pair[0],
            domain: None,
            value: pair[1],
        };
        if at / columns % 2 == 0 {
            legendre.momenta.push(component);
        } else {
            legendre.velocities.push(component);
        }
    }
    check(&mut written, &legendre, l);
}

#[test]
fn elements_may_be_named_apart() {
    let h = |l: &str| {
        let (mut m, legendre, node) = transformed("q[N]; v[N]", "N", "m[N]", l);
        let shown = text(&m, legendre.hamiltonian);
        check_looped(&mut m, &legendre, node);
        shown
    };
    assert_eq!(
        h("v[0]^2 + sum(i in 1..N) { v[i]^2 }"),
        "sum(i in 0..N) { p_q[i]^2 }/4"
    );
    assert_eq!(
        h("v[0]^2 + sum(i in 1..N) { 2*v[i]^2 } - q[0]^2"),
        "sum(i in 0..N) { p_q[i]^2/(if 1 <= i { 4 } else { 2 }) }/2 + q[0]^2"
    );
    assert_eq!(
        h("sum(i in 0..N - 1) { m[i]*v[i]^2/2 } + v[N - 1]^2/2 + v[N - 1]*q[0]"),
        "sum(i in 0..N) { (p_q[i] - (if N - 1 == i { q[0] } else { 0 }))^2/(if i + 2 <= N { m[i] } else { 1 }) }/2"
    );
    h("v[0]^2 + sum(i in 0..N) { v[i]^2/2 } + v[N - 1]^2");
    h("v[0]^2/2 + v[1]^2 + 2*v[N - 1]^2 + sum(i in 2..N - 1) { m[i]*v[i]^2/2 }");
    // Short arrays are written out.
    let (m, legendre, _) = transformed(
        "q[3]; v[3]",
        "",
        "",
        "v[0]^2/2 + v[0]*q[2] + sum(i in 1..3) { v[i]^2 }",
    );
    assert_eq!(legendre.momenta.len(), 3);
    assert_eq!(text(&m, legendre.momenta[0].value), "p_q[0] + q[2]");
}
