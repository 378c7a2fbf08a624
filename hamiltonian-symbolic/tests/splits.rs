//! Exact flows of pieces: that they are flows, of the right vector field, symplectic, and end
//! where the orbit does.

mod common;
mod flows;

use flows::{Case, check};

#[test]
fn rows_take_their_patterns_and_flow() {
    let fails = |case: &&Case| std::panic::catch_unwind(|| check(case)).is_err();
    let failed: Vec<&str> = CASES.iter().filter(fails).map(|case| case.h).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

const CASES: &[Case] = &[
    Case { signature: "q; p", parameters: "", h: "0.5*(q^2 + p^2) + 0.5", rows: "quadratic form" },
    Case { signature: "q; p", parameters: "k m", h: "p^2/(2*m) + k*q^2/2 + k*q", rows: "quadratic form" },
    Case { signature: "q; p", parameters: "", h: "0.5*q^2*p^2", rows: "monomial" },
    Case { signature: "q; p", parameters: "a", h: "a*q*p^2", rows: "monomial" },
    Case { signature: "r; p_r", parameters: "", h: "-p_r^2/r", rows: "monomial" },
    Case { signature: "q; p", parameters: "", h: "q^3*p^5/7", rows: "monomial" },
    Case { signature: "q; p", parameters: "", h: "0.5*q^2*(p^2 + 1)", rows: "f(q)·p²" },
    Case { signature: "q; p", parameters: "l", h: "(1 + l*q^2)*p^2/2", rows: "f(q)·p²" },
    Case { signature: "q; p", parameters: "", h: "(1 - q^2)*p^2", rows: "f(q)·p²" },
    Case { signature: "q; p", parameters: "a b", h: "(a + b*q)*p^2", rows: "f(q)·p²" },
    Case { signature: "r, th; p, pt", parameters: "a", h: "(r^2 - 2*r + a^2)*p^2/2 + pt^2/2", rows: "f(q)·p²" },
    Case { signature: "q; p", parameters: "", h: "sin(q)*p", rows: "f(q)·p" },
    Case { signature: "q; p", parameters: "a", h: "(a + cos(q))*p", rows: "f(q)·p" },
    Case { signature: "q; p", parameters: "", h: "(1 + q^2)*p", rows: "f(q)·p" },
    Case { signature: "q; p", parameters: "", h: "(1 - q^2)*p", rows: "f(q)·p" },
    Case { signature: "q; p", parameters: "", h: "exp(q)*p", rows: "f(q)·p" },
    Case { signature: "q; p", parameters: "", h: "cosh(q)*p", rows: "f(q)·p" },
    Case { signature: "x, y; px, py", parameters: "b", h: "(px - b*y*x^2)^2/2", rows: "shear" },
    Case { signature: "r, th; p, pt", parameters: "m", h: "p^2/(2*m) + pt^2/(2*m*r^2)", rows: "free flight" },
    Case { signature: "r, th; p, pt", parameters: "L", h: "p^2/2 + (pt^2 + L^2/sin(th)^2)/(2*r^2)", rows: "free flight" },
    Case { signature: "th, ph; pt, pp", parameters: "b", h: "b*(pt^2 + pp^2/sin(th)^2)", rows: "great circle" },
    Case { signature: "r, th, ph; p, pt, pp", parameters: "", h: "p^2/2 + (pt^2 + pp^2/sin(th)^2)/(2*r^2)", rows: "free flight" },
    Case { signature: "x, y, z; px, py, pz", parameters: "mu", h: "mu*(x*py - y*px)/(x^2 + y^2 + z^2)^(3/2) + (x^2 + y^2)/(x^2 + y^2 + z^2)^3", rows: "rotation" },
    Case { signature: "l, g; L, G", parameters: "A", h: "(G^2 - L^2)*sin(l)^2/(2*A)", rows: "spin component" },
    Case { signature: "l, g; L, G", parameters: "B", h: "(G^2 - L^2)*cos(l)^2/(2*B)", rows: "spin component" },
    Case { signature: "a, b; z, w", parameters: "J", h: "J*sqrt(1 - z^2/9)*cos(a)*sqrt(1 - w^2/9)*cos(b)", rows: "spin component" },
    Case { signature: "q; p", parameters: "g", h: "g*(q^2 + p^2)^2/4", rows: "quadratic form" },
    Case { signature: "q, r; p, s", parameters: "", h: "q*r + p*s", rows: "quadratic form" },
    Case { signature: "x, y; px, py", parameters: "B", h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2", rows: "quadratic form" },
    Case { signature: "x, y; px, py", parameters: "B E", h: "px^2/2 + (py - B*x)^2/2 - E*x", rows: "quadratic form" },
    Case { signature: "x, y, z; px, py, pz", parameters: "B", h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2 + pz^2/2", rows: "quadratic form" },
    Case { signature: "x, y; px, py", parameters: "", h: "px^2/2 + py^2/2 - (x*py - y*px)", rows: "quadratic form" },
    Case { signature: "x, y, z; px, py, pz", parameters: "B", h: "(px^2 + py^2 + pz^2)/2 + B*(x*py - y*px)/2", rows: "quadratic form" },
    Case { signature: "x, y; px, py", parameters: "a b", h: "(px^2 + a*x^2)/2 + (py^2 + b*y^2)/2", rows: "quadratic form" },
    Case { signature: "x, y; px, py", parameters: "B", h: "sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2)", rows: "quadratic form" },
    Case { signature: "r, th; p, pt", parameters: "", h: "p^2*pt^2/r^2", rows: "monomial" },
    Case { signature: "q, u; p, v", parameters: "", h: "q*p^2*u + v^2*0", rows: "monomial" },
];
