//! Hamilton's equations as text.

use crate::common::system;
use hamiltonian_symbolic::dag::Dependence;
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::print::{Notation, hamilton_equations, latex, text};

fn lines(model: &Model) -> Vec<String> {
    hamilton_equations(model)
        .written(Notation::Text)
        .into_iter()
        .map(|(left, right)| format!("{left} = {right}"))
        .collect()
}

#[test]
fn scalar_coordinates_have_an_equation_each() {
    let model = system(
        "theta, x; p, p_x; t",
        "",
        "m l g",
        "p^2/(2*m*l^2) - m*g*l*cos(theta) - x*cos(t)",
    );
    assert_eq!(
        lines(&model),
        [
            "dtheta/dt = p/(m*l^2)",
            "dx/dt = 0",
            "dp/dt = -m*g*l*sin(theta)",
            "dp_x/dt = cos(t)"
        ]
    );
    let tex = hamilton_equations(&model).written(Notation::Latex);
    assert_eq!(
        tex[0],
        (
            r"\frac{\mathrm{d} \theta}{\mathrm{d} t}".to_owned(),
            r"\frac{p}{m l^{2}}".to_owned()
        )
    );
}

#[test]
fn arrays_have_one_equation_for_element_k() {
    let toda = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
    );
    assert_eq!(
        lines(&toda),
        [
            "dq[k]/dt = p[k]",
            "dp[k]/dt = -exp(q[k] - q[(k + 1) % N]) + exp(q[(k - 1) % N] - q[k])"
        ]
    );

    let gravity = system(
        "q[n][2]; p[n][2]",
        "n",
        "G m[n]",
        "sum(i in 0..n) { (p[i][0]^2 + p[i][1]^2)/(2*m[i]) } - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2) }",
    );
    let lines_of_gravity = lines(&gravity);
    assert_eq!(lines_of_gravity[0], "dq[k][0]/dt = p[k][0]/m[k]");
    assert!(
        lines_of_gravity[2].contains("sum(i in 0..k)")
            && lines_of_gravity[2].contains("sum(i in k + 1..n)"),
        "{}",
        lines_of_gravity[2]
    );

    let chain = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { (q[i + 1] - q[i])^4/4 }",
    );
    assert_eq!(
        lines(&chain)[1],
        "dp[k]/dt = (if 1 <= k { -(q[k] - q[k - 1])^3 } else { 0 }) + (if k + 2 <= N { (q[k + 1] - q[k])^3 } else { 0 })"
    );

    let numbered = system("q[3]; p[3]", "", "", "p[0]^2/2 + q[0]*q[2]");
    assert_eq!(
        lines(&numbered),
        [
            "dq[0]/dt = p[0]",
            "dq[1]/dt = 0",
            "dq[2]/dt = 0",
            "dp[0]/dt = -q[2]",
            "dp[1]/dt = 0",
            "dp[2]/dt = -q[0]"
        ]
    );
}

#[test]
fn an_index_that_cannot_be_solved_is_compared() {
    let sparse = system("q[N]; p[N]", "N n", "", "sum(i in 0..n) { q[2*i]*p[i] }");
    assert_eq!(
        lines(&sparse),
        [
            "dq[k]/dt = if k + 1 <= n { q[2*k] } else { 0 }",
            "dp[k]/dt = -sum(i in 0..n) { if 2*i == k { p[i] } else { 0 } }"
        ]
    );
    let folded = system(
        "q[N]; p[N]",
        "N n",
        "",
        "sum(i in 0..n) { q[(2*i) % N]*p[i] }",
    );
    assert_eq!(lines(&folded)[1], "dp[k]/dt = -∂H/∂q[k]");
}

#[test]
fn what_nobody_would_read_is_named() {
    let terms: Vec<String> = (0..300).map(|i| format!("p[{i}]^2*q[{i}]^3")).collect();
    let long = system("q[300]; p[300]", "", "", &terms.join(" + "));
    assert_eq!(
        lines(&long),
        ["dq[k]/dt = ∂H/∂p[k]", "dp[k]/dt = -∂H/∂q[k]"]
    );
    let terms: Vec<String> = (0..3000).map(|i| format!("sin({i}*q)")).collect();
    let large = system("q; p", "", "", &format!("p^2/2 + {}", terms.join(" + ")));
    assert_eq!(lines(&large), ["dq/dt = ∂H/∂p", "dp/dt = -∂H/∂q"]);
}

#[test]
fn derivatives_of_functions_in_rust() {
    let mut system = system(
        "q, r; p, p_r",
        "",
        "f/1 g/2",
        "p^2/2 + p_r^2/2 + f(2*q) + g(q, r)",
    );
    assert_eq!(
        lines(&system)[2..],
        [
            "dp/dt = -2*f'(2*q) - (∂g/∂x)(q, r)",
            "dp_r/dt = -(∂g/∂y)(q, r)"
        ]
    );
    let tex = hamilton_equations(&system).written(Notation::Latex);
    assert_eq!(tex[3].1, r"-\frac{\partial g}{\partial y}\left(q, r\right)");
    assert_eq!(
        tex[2].1,
        r"-2 f'\left(2 q\right) - \frac{\partial g}{\partial x}\left(q, r\right)"
    );
    // Second derivatives.
    let h = system.h();
    let slope = |model: &mut Model, of| diff::gradient(&mut model.dag, of, Dependence::Q)[0].1;
    let first = slope(&mut system, h);
    let second = slope(&mut system, first);
    assert_eq!(text(&system, second), "4*f''(2*q) + (∂²g/∂x²)(q, r)");
    assert_eq!(
        latex(&system, second),
        r"4 f''\left(2 q\right) + \frac{\partial^{2} g}{\partial x^{2}}\left(q, r\right)"
    );
}
