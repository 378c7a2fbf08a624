//! Rows: that each takes its pattern and is its flow, and that none crosses a kink or a jump.

use crate::common;
use crate::flows::{Case, check};
use hamiltonian_symbolic::split::exact_flow;

#[test]
fn forms_take_their_patterns_and_flow() {
    let fails = |case: &&Case| std::panic::catch_unwind(|| check(case)).is_err();
    let failed: Vec<&str> = CASES.iter().filter(fails).map(|case| case.h).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

pub const CASES: &[Case] = &[
    // Scaled coordinates.
    Case {
        signature: "x, y; px, py",
        parameters: "k",
        h: "k*(2*x*py - y*px/2)/sqrt(4*x^2 + y^2)",
        form: "rotation",
    },
    Case {
        signature: "l; L",
        parameters: "C",
        h: "sqrt(C^2 - L^2/4)*cos(2*l)",
        form: "spin component",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A",
        h: "((pf/2 - 3*pp*cos(3*th/2))*sin(ps/3)/sin(3*th/2) + 2*pt*cos(ps/3)/3)^2/(2*A)",
        form: "body axis",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A",
        h: "((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/(2*A)",
        form: "body axis",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "B",
        h: "((pf - pp*cos(th))*cos(ps)/sin(th) - pt*sin(ps))^2/(2*B)",
        form: "body axis",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*(q^2 + p^2) + 0.5",
        form: "quadratic form",
    },
    Case {
        signature: "q; p",
        parameters: "k m",
        h: "p^2/(2*m) + k*q^2/2 + k*q",
        form: "quadratic form",
    },
    Case {
        signature: "q, x; p, y",
        parameters: "",
        h: "(p - q^3)*x*y",
        form: "shear",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*q^2*p^2",
        form: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "a",
        h: "a*q*p^2",
        form: "monomial",
    },
    Case {
        signature: "r; p_r",
        parameters: "",
        h: "-p_r^2/r",
        form: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "q^3*p^5/7",
        form: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*q^2*(p^2 + 1)",
        form: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "l",
        h: "(1 + l*q^2)*p^2/2",
        form: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 - q^2)*p^2",
        form: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "a b",
        h: "(a + b*q)*p^2",
        form: "f(q)·p²",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "a",
        h: "(r^2 - 2*r + a^2)*p^2/2 + pt^2/2",
        form: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "sin(q)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a",
        h: "(a + cos(q))*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 + q^2)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 - q^2)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "exp(q)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "cosh(q)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "b",
        h: "(px - b*y*x^2)^2/2",
        form: "shear",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "m k",
        h: "(px^2 + py^2)/(2*m) - k/sqrt(x^2 + y^2)",
        form: "Kepler",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "k",
        h: "px^2 + py^2 + pz^2 + 1/(k*hypot(hypot(x, y), z))",
        form: "Kepler",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "m",
        h: "p^2/(2*m) + pt^2/(2*m*r^2)",
        form: "free flight",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "L",
        h: "p^2/2 + (pt^2 + L^2/sin(th)^2)/(2*r^2)",
        form: "free flight",
    },
    Case {
        signature: "th, ph; pt, pp",
        parameters: "b",
        h: "b*(pt^2 + pp^2/sin(th)^2)",
        form: "great circle",
    },
    Case {
        signature: "r, th, ph; p, pt, pp",
        parameters: "",
        h: "p^2/2 + (pt^2 + pp^2/sin(th)^2)/(2*r^2)",
        form: "free flight",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "mu",
        h: "mu*(x*py - y*px)/(x^2 + y^2 + z^2)^(3/2) + (x^2 + y^2)/(x^2 + y^2 + z^2)^3",
        form: "rotation",
    },
    Case {
        signature: "l, g; L, G",
        parameters: "A",
        h: "(G^2 - L^2)*sin(l)^2/(2*A)",
        form: "spin component",
    },
    Case {
        signature: "l, g; L, G",
        parameters: "B",
        h: "(G^2 - L^2)*cos(l)^2/(2*B)",
        form: "spin component",
    },
    Case {
        signature: "a, b; z, w",
        parameters: "J",
        h: "J*sqrt(1 - z^2/9)*cos(a)*sqrt(1 - w^2/9)*cos(b)",
        form: "spin component",
    },
    Case {
        signature: "q; p",
        parameters: "g",
        h: "g*(q^2 + p^2)^2/4",
        form: "quadratic form",
    },
    Case {
        signature: "q, r; p, s",
        parameters: "",
        h: "q*r + p*s",
        form: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2",
        form: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B E",
        h: "px^2/2 + (py - B*x)^2/2 - E*x",
        form: "quadratic form",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2 + pz^2/2",
        form: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "",
        h: "px^2/2 + py^2/2 - (x*py - y*px)",
        form: "quadratic form",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "B",
        h: "(px^2 + py^2 + pz^2)/2 + B*(x*py - y*px)/2",
        form: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "a b",
        h: "(px^2 + a*x^2)/2 + (py^2 + b*y^2)/2",
        form: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B",
        h: "sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2)",
        form: "quadratic form",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "",
        h: "p^2*pt^2/r^2",
        form: "monomial",
    },
    // Parameters of the two-term families, and those that may be 0.
    Case {
        signature: "q; p",
        parameters: "a b c k",
        h: "(a + b*cos(k*q) + c*sin(k*q))*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a b c k",
        h: "(a + b*exp(k*q) + c*exp(-k*q))*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "k",
        h: "exp(k*q)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "k",
        h: "sin(k*q)*p",
        form: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a b",
        h: "cos(a*q + b*p)",
        form: "quadratic form",
    },
    Case {
        signature: "q, x; p, y",
        parameters: "a b",
        h: "exp(a*x*q^2 + b*p)",
        form: "shear",
    },
    Case {
        signature: "f; z",
        parameters: "J",
        h: "J*sqrt(1 - z^2)*cos(f)",
        form: "spin component",
    },
    Case {
        signature: "r; p",
        parameters: "l",
        h: "p^2 + l/r^2",
        form: "free flight",
    },
    Case {
        signature: "r, x; p, y",
        parameters: "l",
        h: "p^2 + (y^2 - l*x^2)/r^2",
        form: "free flight",
    },
    Case {
        signature: "r, th, f; p, pt, pf",
        parameters: "",
        h: "p^2/2 + (pt^2 + pf^2/sin(th)^2)/(2*r^2)",
        form: "free flight",
    },
    Case {
        signature: "q, u; p, v",
        parameters: "",
        h: "q*p^2*u + v^2*0",
        form: "monomial",
    },
];

/// φ‴ = κφ′, {h, L} = 0 and other identities of derivatives hold on each side of a kink or a jump by
/// itself; a flow that crosses it is none of theirs.
#[test]
fn no_row_crosses_a_kink_or_a_jump() {
    const CROSSED: &[(&str, &str)] = &[
        ("q; p", "(abs(q) + 1)*p"),
        ("q; p", "abs(q)*(p + 1)"),
        ("q; p", "max(q, 1)*p"),
        ("q; p", "(q + min(q, 2))*p"),
        ("q; p", "sqrt((q - 1)^2 + 0)*p"),
        ("q; p", "(sqrt(q^2 + 2*q + 1) + 2)*p"),
        ("q; p", "(sign(q) + 2)*p"),
        ("q; p", "sign(q)*p"),
        ("q; p", "abs(sin(q))*p"),
        ("q; p", "(2 + sign(cos(q)))*sin(q)*p"),
        ("q; p", "(atan(q) + atan(1/q) + 3)*p"),
        ("q; p", "exp(-abs(q))*p"),
        ("q; p", "q*(1 + sign(p)*p)"),
        ("x, y; px, py", "(2 + sign(x))*(x*py - y*px)"),
        ("x, y; px, py", "(2 + sign(x + px))*(x*py - y*px) + 0*px"),
        ("x, y; px, py", "sqrt(x^2)/x*(x*py - y*px)"),
        ("f; z", "sqrt(1 - z^2)*cos(f)*sign(sin(f))"),
        ("q, x; p, y", "p*(q + 1) + (2 + sign(q))*y^2"),
        ("q; p", "a*p + abs(q)"),
        ("q; p", "a*p + sign(q - 1)"),
        ("q; p", "p - (if a < 0 { sign(q - 1) } else { q })"),
        ("q; p", "(p - (if a < 0 { 2 + sign(q - 1) } else { q }))^2"),
    ];
    let mut taken = Vec::new();
    for (signature, h) in CROSSED {
        let mut model = common::model(signature, "", "a");
        let node = common::parse(&mut model, h);
        if let Some(flow) = exact_flow(&mut model, node) {
            taken.push((*h, flow.forms().to_vec()));
        }
    }
    assert!(taken.is_empty(), "{taken:#?}");
    // Nothing crosses a place where it rests, and what is constant crosses nothing.
    const KEPT: &[(&str, &str)] = &[
        ("q; p", "abs(q)*p"),
        ("q; p", "q*abs(q)*p"),
        ("q; p", "max(q, 0)*p"),
        ("x, y; px, py", "abs(x*py - y*px) + 1/hypot(x, y)"),
        ("x, y; px, py", "(x*py - y*px)*max(x^2 + y^2, 1)"),
    ];
    for (signature, h) in KEPT {
        let mut model = common::model(signature, "", "");
        let node = common::parse(&mut model, h);
        assert!(exact_flow(&mut model, node).is_some(), "{h}");
    }
}
