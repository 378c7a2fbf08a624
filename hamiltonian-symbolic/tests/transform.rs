//! Canonical transformations: H in the new variables, that the maps are canonical, that both ways are
//! inverse, and refusals.

mod check;

use crate::common::{parse, system, values};
use hamiltonian_symbolic::dag::{Column, Dependence, Node, Parameter, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{Model, Observable, ObservableKind, VectorEntry};
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::print;
use hamiltonian_symbolic::structure;
use hamiltonian_symbolic::transform::{Bodies, Chart, Component, NoTransform, Transformed, apply};

fn scalar(group: u16) -> Component {
    Component { group, row: None }
}

const POLAR: Chart = Chart::Polar([
    Component {
        group: 0,
        row: None,
    },
    Component {
        group: 1,
        row: None,
    },
]);

fn spherical() -> Chart {
    Chart::Spherical([scalar(0), scalar(1), scalar(2)])
}

fn bodies() -> Bodies {
    Bodies {
        group: 0,
        masses: Parameter(0),
    }
}

fn polar(h: &str, parameters: &str) -> Transformed {
    let model = system("x, y; p_x, p_y; t", "", parameters, h);
    apply(&model, &[POLAR]).unwrap()
}

fn shown(transformed: &Transformed) -> String {
    print::text(&transformed.model, transformed.model.h())
}

/// H of the new system is the node that `text` means there.
#[track_caller]
fn assert_becomes(mut transformed: Transformed, text: &str) {
    let found = shown(&transformed);
    let expected = parse(&mut transformed.model, text);
    assert_eq!(
        transformed.model.hamiltonian,
        Some(expected),
        "{found}, expected {text}"
    );
}

#[test]
fn polar_coordinates_give_the_textbook_hamiltonians() {
    let groups = |t: &Transformed| -> Vec<(String, String)> {
        t.model
            .groups
            .iter()
            .map(|g| (g.coordinate.clone(), g.momentum.clone()))
            .collect()
    };
    let free = polar("(p_x^2 + p_y^2)/2", "");
    assert_eq!(
        groups(&free),
        [
            ("r".to_owned(), "p_r".to_owned()),
            ("phi".to_owned(), "p_phi".to_owned())
        ]
    );
    assert_becomes(free, "(p_r^2 + p_phi^2/r^2)/2");
    // A second chart of the same kind has names with numbers.
    let at = |group| Component { group, row: None };
    let charts = [Chart::Polar([at(0), at(1)]), Chart::Polar([at(2), at(3)])];
    let model = system(
        "x, y, u, v; p_x, p_y, p_u, p_v",
        "",
        "",
        "(p_x^2 + p_y^2 + p_u^2 + p_v^2)/2 - x*v",
    );
    let two = apply(&model, &charts).unwrap();
    let names = groups(&two).into_iter().map(|(q, _)| q);
    assert_eq!(names.collect::<Vec<_>>(), ["r", "phi", "r_2", "phi_2"]);
    assert_becomes(
        two,
        "(p_r^2 + p_phi^2/r^2 + p_r_2^2 + p_phi_2^2/r_2^2)/2 - r*cos(phi)*r_2*sin(phi_2)",
    );
    assert_becomes(polar("p_x^2 + p_y^2", ""), "p_r^2 + p_phi^2/r^2");
    assert_becomes(
        polar("x^2 + y^2 + p_x^2", ""),
        "r^2 + (p_r*cos(phi) - p_phi*sin(phi)/r)^2",
    );
    assert_becomes(
        polar("(p_x^2 + p_y^2)/(2*m) - k/sqrt(x^2 + y^2)", "m k"),
        "(p_r^2 + p_phi^2/r^2)/(2*m) - k/r",
    );
    assert_becomes(
        polar("p_x^2/2 + p_y^2/2 + (x^2 + y^2)^(3/2) + hypot(x, y)", ""),
        "p_r^2/2 + p_phi^2/(2*r^2) + r^3 + r",
    );
    // Angular momentum, alone and inside a product.
    assert_becomes(polar("(x*p_y - y*p_x)*omega", "omega"), "p_phi*omega");
    assert_becomes(polar("x*p_x + y*p_y", ""), "r*p_r");
    // The rotating frame: the square multiplied out is cheaper.
    assert_becomes(
        polar("((p_x + w*y)^2 + (p_y - w*x)^2)/2", "w"),
        "(p_r^2 + p_phi^2/r^2 + w^2*r^2 - 2*p_phi*w)/2",
    );
    // Hénon–Heiles: the monkey saddle without cosines.
    assert_becomes(
        polar("(p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3", ""),
        "(p_r^2 + p_phi^2/r^2)/2 + r^2/2 + r^3*sin(phi) - 4/3*r^3*sin(phi)^3",
    );
}

/// The coordinates of each chart stay inside it where both Hamiltonians are compared, whatever their names are.
#[test]
fn several_charts_have_distances_in_both_hamiltonians() {
    let at = |group| Component { group, row: None };
    let row = |group, row| Component {
        group,
        row: Some(row),
    };
    let of_vector = |group| Chart::Spherical([row(group, 0), row(group, 1), row(group, 2)]);
    let model = system(
        "q[3], w[3]; p[3], u[3]",
        "",
        "k",
        "(p[0]^2 + p[1]^2 + p[2]^2 + u[0]^2 + u[1]^2 + u[2]^2)/2
         - k/sqrt(q[0]^2 + q[1]^2 + q[2]^2) - k/sqrt(w[0]^2 + w[1]^2 + w[2]^2)",
    );
    assert_becomes(
        apply(&model, &[of_vector(0), of_vector(1)]).unwrap(),
        "(p_r^2 + p_theta^2/r^2 + p_phi^2/(r^2*sin(theta)^2)
          + p_r_2^2 + p_theta_2^2/r_2^2 + p_phi_2^2/(r_2^2*sin(theta_2)^2))/2 - k/r - k/r_2",
    );
    let model = system(
        "a, b, c, d, e, f; p_a, p_b, p_c, p_d, p_e, p_f",
        "",
        "",
        "-ln(sqrt(a^2 + b^2)) - ln(hypot(c, d)) - 1/sqrt(e^2 + f^2)",
    );
    let polar = |group| Chart::Polar([at(group), at(group + 1)]);
    let three = apply(&model, &[polar(0), polar(2), polar(4)]).unwrap();
    assert_becomes(three, "-ln(r) - ln(r_2) - 1/r_3");
    // A coordinate that no chart replaces may have the name of one that a chart introduces elsewhere.
    let model = system(
        "theta, x, y; p_theta, p_x, p_y",
        "",
        "",
        "p_theta^2 - 1/sqrt(x^2 + y^2) + sqrt(-theta)",
    );
    let kept = apply(&model, &[Chart::Polar([at(1), at(2)])]).unwrap();
    assert_becomes(kept, "p_theta^2 - 1/r + sqrt(-theta)");
}

#[test]
fn a_distance_is_not_computed_by_cancellation() {
    let two = polar("1/sqrt((x + a)^2 + y^2)", "a");
    let text = shown(&two);
    assert!(
        text.contains("r*cos(phi) + a"),
        "the square was multiplied out: {text}"
    );
    let mut free = 0;
    // If the sum is one of H's own, it is.
    for h in ["(x + a)^2 + y^2", "x*((x + a)^2 + y^2)"] {
        let text = shown(&polar(h, "a"));
        free += usize::from(!text.contains("sin"));
    }
    assert_eq!(free, 2);
}

#[test]
fn spherical_coordinates_give_the_textbook_hamiltonians() {
    let new = |h: &str, parameters: &str| {
        let model = system("x, y, z; p_x, p_y, p_z", "", parameters, h);
        apply(&model, &[spherical()]).unwrap()
    };
    assert_becomes(
        new(
            "(p_x^2 + p_y^2 + p_z^2)/(2*m) - k/sqrt(x^2 + y^2 + z^2)",
            "m k",
        ),
        "(p_r^2 + p_theta^2/r^2 + p_phi^2/(r^2*sin(theta)^2))/(2*m) - k/r",
    );
    assert_becomes(new("x^2 + y^2 + z^2", ""), "r^2");
    assert_becomes(new("sqrt(x^2 + y^2)", ""), "r*sin(theta)");
    assert_becomes(new("x*p_y - y*p_x", ""), "p_phi");
    assert_becomes(
        new(
            "(y*p_z - z*p_y)^2 + (z*p_x - x*p_z)^2 + (x*p_y - y*p_x)^2",
            "",
        ),
        "p_theta^2 + p_phi^2/sin(theta)^2",
    );
}

#[test]
fn a_vector_is_replaced_as_well_as_scalars_and_other_groups_stay() {
    let mut model = system(
        "u, q[2], w[3]; p_u, p[2], p_w[3]; t",
        "",
        "k",
        "p_u^2/2 + u^2*w[1] + sum(i in 0..3) { p_w[i]^2/2 } + sum(i in 0..2) { p[i]^2/2 + k*q[i]^2/2 }",
    );
    let angular = parse(&mut model, "q[0]*p[1] - q[1]*p[0]");
    model.observables.push(Observable {
        name: "L".into(),
        kind: ObservableKind::Monitor,
        components: vec![angular],
    });
    model.split = vec![parse(&mut model, "u*hypot(q[0], q[1])")];
    let chart = Chart::Polar([0, 1].map(|row| Component {
        group: 1,
        row: Some(row),
    }));
    let new = apply(&model, &[chart]).unwrap();
    let names: Vec<&str> = new
        .model
        .groups
        .iter()
        .map(|g| g.coordinate.as_str())
        .collect();
    assert_eq!(names, ["u", "r", "phi", "w"]);
    assert_eq!(new.kept, [(0, 0), (2, 3)]);
    let text = |node: Node| print::text(&new.model, node);
    assert_eq!(text(new.model.observables[0].components[0]), "p_phi");
    assert_eq!(text(new.model.split[0]), "u*r");
    assert_becomes(
        new,
        "p_u^2/2 + u^2*w[1] + (p_w[0]^2 + p_w[1]^2 + p_w[2]^2)/2 + p_r^2/2 + k*r^2/2 + p_phi^2/(2*r^2)",
    );
}

fn leaf(model: &mut Model, entry: &VectorEntry) -> Node {
    model.dag.phase(entry.at, entry.row.clone())
}

/// Max |MᵀJM − J| of a map whose entries are coordinates, then momenta, in conjugate order, with
/// respect to the arguments in the same order.
fn defect(model: &mut Model, map: &[Node], arguments: &[Node], given: &[(Node, f64)]) -> f64 {
    let size = map.len();
    let zero = model.dag.integer(0);
    let both = Dependence(Dependence::Q.0 | Dependence::P.0);
    let mut partials = Vec::new();
    for node in map {
        let gradient = diff::gradient(&mut model.dag, *node, both);
        partials.extend(arguments.iter().map(|argument| {
            gradient
                .iter()
                .find(|(leaf, _)| leaf == argument)
                .map_or(zero, |(_, slope)| *slope)
        }));
    }
    let m = values(model, &partials, given);
    let n = size / 2;
    let mut worst: f64 = 0.0;
    for a in 0..size {
        for b in 0..size {
            let at = |row: usize, column: usize| m[row * size + column];
            let form: f64 = (0..n)
                .map(|k| at(k, a) * at(n + k, b) - at(n + k, a) * at(k, b))
                .sum();
            let expected = f64::from(u8::from(b == a + n)) - f64::from(u8::from(a == b + n));
            worst = worst.max((form - expected).abs());
        }
    }
    worst
}

/// Both maps are canonical, and one the inverse of the other.
fn assert_canonical(transformed: &mut Transformed) {
    let sorted = |entries: &[VectorEntry]| {
        let mut entries = entries.to_vec();
        entries.sort_by_key(|e| (e.at, e.row.clone()));
        entries
    };
    let (forward, inverse) = (sorted(&transformed.forward), sorted(&transformed.inverse));
    assert_eq!(forward.len(), inverse.len());
    let new: Vec<Node> = forward
        .iter()
        .map(|e| leaf(&mut transformed.model, e))
        .collect();
    let old: Vec<Node> = inverse
        .iter()
        .map(|e| leaf(&mut transformed.source, e))
        .collect();
    let to_new: Vec<Node> = forward.iter().map(|e| e.value).collect();
    let to_old: Vec<Node> = inverse.iter().map(|e| e.value).collect();
    for shift in 0..4 {
        let start: Vec<f64> = (0..old.len())
            .map(|at| 1.5 * (2.3 * (at + 7 * shift) as f64 + 1.0).sin() + 0.01)
            .collect();
        let given: Vec<_> = old.iter().copied().zip(start.iter().copied()).collect();
        let there = values(&transformed.source, &to_new, &given);
        let wrong = defect(&mut transformed.source, &to_new, &old, &given);
        assert!(wrong < 1e-11, "old → new is off by {wrong}");
        let given: Vec<_> = new.iter().copied().zip(there).collect();
        let wrong = defect(&mut transformed.model, &to_old, &new, &given);
        assert!(wrong < 1e-11, "new → old is off by {wrong}");
        let back = values(&transformed.model, &to_old, &given);
        for (a, b) in start.iter().zip(&back) {
            assert!(
                (a - b).abs() < 1e-12 * (1.0 + a.abs()),
                "{start:?} {back:?}"
            );
        }
    }
}

#[test]
fn every_map_is_canonical_and_has_its_inverse() {
    assert_canonical(&mut polar("p_x^2", ""));
    let space = system("x, y, z; p_x, p_y, p_z", "", "", "p_x^2");
    assert_canonical(&mut apply(&space, &[spherical()]).unwrap());
    for chart in [Chart::Jacobi(bodies()), Chart::Heliocentric(bodies())] {
        let line = system("q[4]; p[4]", "", "m[4]", "p[0]^2");
        assert_canonical(&mut apply(&line, &[chart]).unwrap());
        let plane = system("q[3][2]; p[3][2]", "", "m[3]", "p[0][1]^2");
        assert_canonical(&mut apply(&plane, &[chart]).unwrap());
        let one = system("q[1][2]; p[1][2]", "", "m[1]", "p[0][1]^2");
        assert_canonical(&mut apply(&one, &[chart]).unwrap());
    }
    // The check itself sees a map that is not: one momentum half as large.
    let mut wrong = polar("p_x^2", "");
    let half = hamiltonian_symbolic::rational::Rational::new(1, 2);
    let entry = wrong
        .inverse
        .iter()
        .position(|e| e.at.side == Side::P)
        .unwrap();
    let value = wrong.inverse[entry].value;
    wrong.inverse[entry].value = wrong.model.dag.scale(&half, value);
    let caught = std::panic::catch_unwind(move || assert_canonical(&mut wrong));
    assert!(caught.is_err());
}

const GRAVITY: &str = "sum(i in 0..3, c in 0..2) { p[i][c]^2/(2*m[i]) }";

fn gravity() -> Model {
    let mut h = GRAVITY
        .replace(", c in 0..2", "")
        .replace("p[i][c]^2", "(p[i][0]^2 + p[i][1]^2)");
    h += " - G*sum(i in 0..3, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2) }";
    system("q[3][2]; p[3][2]", "", "m[3] G", &h)
}

#[test]
fn jacobi_coordinates_make_the_kinetic_energy_diagonal() {
    let new = apply(&gravity(), &[Chart::Jacobi(bodies())]).unwrap();
    assert_eq!(new.model.groups[0].coordinate, "q_jacobi");
    assert_eq!(new.model.groups[0].momentum, "p_jacobi");
    let mut model = new.model;
    let structure = structure::analyse(&mut model);
    let split = structure.separable.as_ref().unwrap();
    let text = print::text(&model, split.kinetic);
    // One square a momentum, no products of two momenta.
    assert_eq!(text.matches("p_jacobi").count(), 6, "{text}");
    assert_eq!(structure.quadratic_kinetic, Ok(()));
    // The centre of mass is gone from the potential, and its momentum is conserved.
    let cyclic: Vec<&str> = structure
        .cyclic
        .iter()
        .map(|c| c.coordinate.as_str())
        .collect();
    assert_eq!(cyclic, ["q_jacobi[0][0]", "q_jacobi[0][1]"]);
    let text = print::text(&model, split.potential);
    assert!(
        text.contains("sqrt(q_jacobi[1][0]^2 + q_jacobi[1][1]^2)"),
        "{text}"
    );
    // T = P_0²/2M + Σ P_i²/2μ_i with 1/μ_i = 1/m_i + 1/M_{i−1}.
    let mut expected = String::new();
    for c in 0..2 {
        expected += &format!(
            "+ p_jacobi[0][{c}]^2/(2*(m[0] + m[1] + m[2])) \
             + p_jacobi[1][{c}]^2/2*(1/m[1] + 1/m[0]) \
             + p_jacobi[2][{c}]^2/2*(1/m[2] + 1/(m[0] + m[1]))"
        );
    }
    let expected = parse(&mut model, expected.trim_start_matches('+'));
    let difference = model.dag.sub(split.kinetic, expected);
    assert_eq!(is_zero(&model, difference), Proof::Zero);
}

#[test]
fn heliocentric_coordinates_keep_the_momenta() {
    let new = apply(&gravity(), &[Chart::Heliocentric(bodies())]).unwrap();
    let text = shown(&new);
    assert!(
        text.contains("sqrt(q_heliocentric[1][0]^2 + q_heliocentric[1][1]^2)"),
        "{text}"
    );
    let mut model = new.model;
    let structure = structure::analyse(&mut model);
    let cyclic: Vec<&str> = structure
        .cyclic
        .iter()
        .map(|c| c.coordinate.as_str())
        .collect();
    assert_eq!(cyclic, ["q_heliocentric[0][0]", "q_heliocentric[0][1]"]);
}

#[test]
fn ten_bodies_are_done_in_time() {
    let h = "sum(i in 0..10) { (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*m[i]) } \
        - sum(i in 0..10, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }";
    let model = system("q[10][3]; p[10][3]", "", "m[10]", h);
    let new = apply(&model, &[Chart::Jacobi(bodies())]).unwrap();
    assert_eq!(shown(&new).matches("p_jacobi").count(), 30);
}

#[test]
fn forces_are_transformed_with_the_momenta() {
    let mut model = system("x, y; p_x, p_y", "", "c", "(p_x^2 + p_y^2)/2");
    let (f_x, f_y) = (parse(&mut model, "-c*p_x"), parse(&mut model, "-c*p_y"));
    model.force = [(0, f_x), (1, f_y)]
        .into_iter()
        .map(|(group, value)| VectorEntry {
            at: Column::first(Side::P, group),
            row: Index::constant(0),
            value,
        })
        .collect();
    let new = apply(&model, &[POLAR]).unwrap();
    let found = &new.model.force;
    let text: Vec<String> = found
        .iter()
        .map(|e| print::text(&new.model, e.value))
        .collect();
    assert_eq!(text, ["-c*p_r", "-c*p_phi"]);
    assert_eq!((found[0].at.group, found[1].at.group), (0, 1));
}

#[test]
fn charts_that_do_not_fit_are_refused() {
    let taken = |parameters: &str| {
        let model = system("x, y; p_x, p_y", "", parameters, "p_x^2");
        apply(&model, &[POLAR]).unwrap_err()
    };
    assert_eq!(
        taken("p_phi").to_string(),
        "`polar` introduces `p_phi`, which is declared already"
    );
    assert!(matches!(taken("r"), NoTransform::NameTaken { .. }));
    // The name of a coordinate that goes is free.
    let model = system("r, y; p_r, p_y", "", "", "p_r^2");
    assert!(apply(&model, &[POLAR]).is_ok());
    let model = system("x, y, r; p_x, p_y, p_z", "", "", "p_x^2");
    assert!(matches!(
        apply(&model, &[POLAR]),
        Err(NoTransform::NameTaken { .. })
    ));
    // Twice.
    let model = system("x, y; p_x, p_y", "", "", "p_x^2");
    let twice = [POLAR, POLAR];
    assert!(matches!(
        apply(&model, &twice),
        Err(NoTransform::Twice { .. })
    ));
    // Bodies of a number that is not literal.
    let model = system("q[n]; p[n]", "n", "m[n]", "sum(i in 0..n) { p[i]^2 }");
    assert!(matches!(
        apply(&model, &[Chart::Jacobi(bodies())]),
        Err(NoTransform::Number { .. })
    ));
    // A loop of a length that is not known over a replaced coordinate.
    let model = system(
        "q[2], w[n]; p[2], v[n]",
        "n",
        "",
        "sum(i in 0..2) { p[i]^2 } + sum(i in 0..n) { p[i]*v[i]^2 }",
    );
    let whole = Chart::Polar([0, 1].map(|row| Component {
        group: 0,
        row: Some(row),
    }));
    assert!(matches!(
        apply(&model, &[whole]),
        Err(NoTransform::Loops { .. })
    ));
}

#[test]
fn loops_over_other_groups_stay_loops() {
    let model = system(
        "x, y, w[n]; p_x, p_y, v[n]",
        "n",
        "",
        "(p_x^2 + p_y^2)/2 + sum(i in 0..n) { v[i]^2/2 + w[i]*(x^2 + y^2) }",
    );
    let new = apply(&model, &[POLAR]).unwrap();
    assert_becomes(
        new,
        "(p_r^2 + p_phi^2/r^2)/2 + sum(i in 0..n) { v[i]^2/2 + w[i]*r^2 }",
    );
}

#[test]
fn loops_over_bodies_of_any_number_begin_at_the_second() {
    let model = system(
        "q[n]; p[n]",
        "n",
        "m[n]",
        "sum(i in 0..n) { p[i]^2/m[i] } + sum(i in 0..n, j in 0..i) { abs(q[i] - q[j]) }",
    );
    let chart = [Chart::Heliocentric(bodies())];
    let new = apply(&model, &chart).unwrap();
    assert_eq!(
        shown(&new),
        "(p_heliocentric[0] - sum(i in 1..n) { p_heliocentric[i] })^2/m[0] \
         + sum(i in 1..n) { p_heliocentric[i]^2/m[i] } \
         + sum(i in 1..n) { abs(q_heliocentric[i]) \
         + sum(j in 1..i) { abs(q_heliocentric[i] - q_heliocentric[j]) } }"
    );
    // An index that may be the first body or not is told apart where it runs.
    let model = system("q[n]; p[n]", "n", "m[n]", "p[0]^2 + q[n - 1]^2");
    let new = apply(&model, &chart).unwrap();
    assert!(
        shown(&new).contains("if n - 1 == 0 { 0 }"),
        "{}",
        shown(&new)
    );
    // One that wraps around is not.
    let model = system(
        "q[n]; p[n]",
        "n",
        "m[n]",
        "sum(i in 0..n) { q[i]*q[(i + 1) % n] + p[i]^2 }",
    );
    assert!(matches!(
        apply(&model, &chart),
        Err(NoTransform::Wrapped { .. })
    ));
}
