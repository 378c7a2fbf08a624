//! Formulas of systems from Lagrangians: how they read, and that they are the formulas computed.

use crate::common::{model, parse};
use hamiltonian_symbolic::dag::{Dependence, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::legendre::Readable;
use hamiltonian_symbolic::legendre::transform;
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::print::Notation;

/// The model with its H, and the formulas, of a signature with velocities in the place of momenta.
fn read(signature: &str, sizes: &str, parameters: &str, l: &str) -> (Model, Readable) {
    let mut m = model(signature, sizes, parameters);
    let node = parse(&mut m, l);
    for group in &mut m.groups {
        let momentum = format!("p_{}", group.coordinate);
        group.velocity = Some(std::mem::replace(&mut group.momentum, momentum));
    }
    let legendre = transform(&mut m, node).unwrap();
    let readable = Readable::of(&m, &legendre);
    m.hamiltonian = Some(legendre.hamiltonian);
    (m, readable)
}

/// Names written out, in parentheses, until none is left.
fn inlined(text: &str, names: &[(String, String)]) -> String {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let mut text = text.to_owned();
    for _ in 0..8 {
        let mut out = String::new();
        let mut rest = text.as_str();
        while let Some(start) = rest.find(is_letter) {
            let end = rest[start..].find(|c| !is_letter(c));
            let end = end.map_or(rest.len(), |length| start + length);
            let word = &rest[start..end];
            out.push_str(&rest[..start]);
            match names.iter().find(|(name, _)| name == word) {
                Some((_, value)) => out.push_str(&format!("({value})")),
                None => out.push_str(word),
            }
            rest = &rest[end..];
        }
        out.push_str(rest);
        text = out;
    }
    text
}

fn equal(m: &mut Model, written: &str, value: Node) {
    let read = parse(m, written);
    let difference = m.dag.sub(read, value);
    assert_eq!(is_zero(m, difference), Proof::Zero, "{written}");
}

/// Every formula as written, read back, is the formula computed.
fn check(signature: &str, parameters: &str, l: &str) -> (String, Vec<String>) {
    let (mut m, readable) = read(signature, "", parameters, l);
    let text = readable.text("H");
    let mut names = Vec::new();
    for line in text.lines() {
        match line.strip_prefix("let ") {
            Some(line) => {
                let (name, value) = line.trim_end_matches(';').split_once(" = ").unwrap();
                names.push((name.to_owned(), value.to_owned()));
            }
            None => {
                let written = inlined(line.strip_prefix("H = ").unwrap(), &names);
                let h = m.h();
                equal(&mut m, &written, h);
            }
        }
    }
    let equations = readable.equations(Notation::Text).unwrap();
    let right = |of: &str| {
        let sides = equations.iter().filter_map(|line| line.split_once(" = "));
        let mut found = sides
            .filter(|(left, _)| *left == of)
            .map(|(_, right)| right);
        found.next().unwrap_or_else(|| panic!("no {of}")).to_owned()
    };
    for line in &equations {
        if let Some((name, rate)) = line
            .strip_prefix("where ")
            .and_then(|l| l.split_once(" = "))
        {
            names.push((name.to_owned(), right(rate)));
        }
    }
    let h = m.h();
    for (side, of) in [(Side::Q, Dependence::P), (Side::P, Dependence::Q)] {
        let gradient = diff::gradient(&mut m.dag, h, of);
        for group in 0..m.groups.len() {
            assert_eq!(m.groups[group].shape, Shape::Scalar);
            let (own, other, name) = match side {
                Side::Q => (1, Side::P, m.groups[group].coordinate.clone()),
                Side::P => (-1, Side::Q, m.groups[group].momentum.clone()),
            };
            let leaf = m.scalar(other, group);
            let slope = gradient.iter().find(|(known, _)| *known == leaf);
            let slope = slope.map_or_else(|| m.dag.integer(0), |(_, slope)| *slope);
            let sign = m.dag.integer(own);
            let rate = m.dag.mul(&[sign, slope]);
            let written = inlined(&right(&format!("d{name}/dt")), &names);
            equal(&mut m, &written, rate);
        }
    }
    (text, equations)
}

#[test]
fn the_double_pendulum() {
    let (text, equations) = check(
        "a, b; va, vb",
        "m1 m2 l1 l2 g",
        "(m1 + m2)*l1^2*va^2/2 + m2*l2^2*vb^2/2 + m2*l1*l2*va*vb*cos(a - b) + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b)",
    );
    assert_eq!(
        text,
        "let D = m1 + m2 - m2*cos(a - b)^2;\n\
         H = (m2*l2^2*p_a^2 - 2*m2*l1*l2*p_a*p_b*cos(a - b) + (m1 + m2)*l1^2*p_b^2)/(2*l1^2*m2*l2^2*D) \
         - (m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)"
    );
    assert_eq!(
        equations,
        [
            "da/dt = (l2*p_a - l1*p_b*cos(a - b))/(l2*l1^2*D)",
            "db/dt = ((m1 + m2)*l1*p_b - m2*l2*p_a*cos(a - b))/(l1*m2*l2^2*D)",
            "dp_a/dt = -m2*l1*l2*va*vb*sin(a - b) - (m1 + m2)*g*l1*sin(a)",
            "dp_b/dt = m2*l1*l2*va*vb*sin(a - b) - m2*g*l2*sin(b)",
            "where va = da/dt",
            "where vb = db/dt",
        ]
    );
}

#[test]
fn a_charge_in_a_magnetic_field() {
    let (text, equations) = check(
        "x, y, z; u, v, w",
        "m e B k",
        "m*(u^2 + v^2 + w^2)/2 + e*B*(x*v - y*u)/2 - k*(x^2 + y^2 - 2*z^2)",
    );
    assert_eq!(
        text,
        "H = ((p_x + 0.5*e*B*y)^2 + (p_y - 0.5*e*B*x)^2 + p_z^2)/(2*m) + k*(x^2 + y^2 - 2*z^2)"
    );
    assert_eq!(equations[1], "dy/dt = (p_y - 0.5*e*B*x)/m");
    assert_eq!(
        equations[3],
        "dp_x/dt = -2*k*x + (p_y - 0.5*e*B*x)*e*B/(2*m)"
    );
    assert_eq!(equations.len(), 6);
}

#[test]
fn a_dense_matrix_is_eliminated_by_names() {
    let (text, equations) = check(
        "x, y, z; u, v, w",
        "m",
        "m*u^2/2 + (1 + x^2)*v^2 + (2 + sin(y)^2)*w^2/2 + x*u*v/2 + cos(z)*v*w/3 + y*u*w/4 - x^2 - y^2*z^2",
    );
    assert!(
        text.ends_with("H = p_x^2/(2*m) + u_y^2/(2*m*D_y) + u_z^2/(2*m*D_y*D_z) + x^2 + y^2*z^2"),
        "{text}"
    );
    assert_eq!(equations[1], "dy/dt = (u_y - C_y_z*w)/D_y");
}

#[test]
fn matrices_of_other_forms() {
    // Off the diagonal only; a block and a single; constant and coupled; dependent on time.
    check("x, y; u, v", "", "u*v + x*u - x^2*y");
    check(
        "x, y, z; u, v, w",
        "a",
        "u^2 + a*u*w + (1 + x^2)*w^2/2 + v^2/2 - y^2",
    );
    check("x, y; u, v", "a b", "a*u^2/2 + b*u*v + v^2/2 - x^2*y^2");
    check(
        "x, y; u, v; t",
        "a",
        "(1 + t^2)*u^2/2 + a*u*v*cos(t) + v^2 - x*y",
    );
    check(
        "x, y, z; u, v, w",
        "",
        "u^2 + v^2 + w^2 + u*v/2 + v*w/3 + y*u - x^2*z",
    );
    check("x; u", "D", "(1 + x^2)*u^2/2 + u*sin(x) - D*x^2");
    check(
        "a, b, c, d; p, q, r, s",
        "",
        "2*p^2 + (3 + a^2)*q^2 + 2*r^2 + 2*s^2 + p*q/2 + p*r/3 + q*r*d/5 + q*s/2 + r*s - a^2 + p*b",
    );
}

#[test]
fn names_of_the_user_are_not_taken() {
    let (text, _) = check("x, D; u, v", "", "u^2 + u*v*cos(D) + v^2 - x^2");
    assert!(text.starts_with("let D2 = "), "{text}");
}

#[test]
fn arrays_stay_loops() {
    let (_, chain) = read(
        "q[n][2]; v[n][2]",
        "n",
        "m[n]",
        "sum(i in 0..n) { m[i]*(v[i][0]^2 + v[i][1]^2)/2 - q[i][0]^2 }",
    );
    assert_eq!(
        chain.text("H"),
        "H = sum(i in 0..n) { (p_q[i][0]^2 + p_q[i][1]^2)/m[i] }/2 + sum(i in 0..n) { q[i][0]^2 }"
    );
    assert_eq!(
        chain.equations(Notation::Text).unwrap()[0],
        "dq[k][0]/dt = p_q[k][0]/m[k]"
    );
}
