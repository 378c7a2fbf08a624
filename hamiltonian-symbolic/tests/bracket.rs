//! Invariants of known systems are accepted, near misses rejected with a residual.

use crate::common::{parse, system};
use hamiltonian_symbolic::bracket::{Verdict, bracket, is_invariant};
use hamiltonian_symbolic::loops::{Sample, sample, unroll_nodes};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::print::text;

fn verdict(model: &mut Model, invariant: &str, shell: Option<&str>) -> Verdict {
    let node = parse(model, invariant);
    let shell = shell.map(|e| parse(model, e));
    is_invariant(model, node, shell)
}

fn accepted(model: &mut Model, invariant: &str) {
    let found = verdict(model, invariant, None);
    assert!(found.is_proven(), "{invariant}: {found:?}");
}

fn rejected(model: &mut Model, invariant: &str) -> String {
    match verdict(model, invariant, None) {
        Verdict::Disproven {
            residual,
            point,
            value,
        } => {
            assert!(value != 0.0 && !point.is_empty());
            residual
        }
        other => panic!("{invariant}: {other:?}"),
    }
}

#[test]
fn kepler_keeps_its_runge_lenz_vector() {
    let mut kepler = system(
        "x, y, z; u, v, w",
        "",
        "k",
        "(u^2 + v^2 + w^2)/2 - k/sqrt(x^2 + y^2 + z^2)",
    );
    for (good, bad) in [
        (
            "v*(x*v - y*u) - w*(z*u - x*w) - k*x/sqrt(x^2 + y^2 + z^2)",
            "v*(x*v - y*u) - w*(z*u - x*w) + k*x/sqrt(x^2 + y^2 + z^2)",
        ),
        (
            "w*(y*w - z*v) - u*(x*v - y*u) - k*y/sqrt(x^2 + y^2 + z^2)",
            "w*(y*w + z*v) - u*(x*v - y*u) - k*y/sqrt(x^2 + y^2 + z^2)",
        ),
        (
            "u*(z*u - x*w) - v*(y*w - z*v) - k*z/sqrt(x^2 + y^2 + z^2)",
            "u*(z*u - x*w) + v*(y*w - z*v) - k*z/sqrt(x^2 + y^2 + z^2)",
        ),
        ("x*v - y*u", "x*v + y*u"),
        (
            "(u^2 + v^2 + w^2)/2 - k/sqrt(x^2 + y^2 + z^2)",
            "(u^2 + v^2 + w^2)/2 + k/sqrt(x^2 + y^2 + z^2)",
        ),
    ] {
        accepted(&mut kepler, good);
        rejected(&mut kepler, bad);
    }
}

#[test]
fn henon_heiles_with_the_other_sign_is_integrable() {
    let mut integrable = system(
        "x, y; p_x, p_y",
        "",
        "",
        "(p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y + y^3/3",
    );
    accepted(&mut integrable, "p_x*p_y + x*y + x^3/3 + x*y^2");
    assert_eq!(
        rejected(&mut integrable, "p_x*p_y - x*y + x^3/3 + x*y^2"),
        "-2*y*p_x - 2*p_y*x"
    );
    let mut original = system(
        "x, y; p_x, p_y",
        "",
        "",
        "(p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3",
    );
    rejected(&mut original, "p_x*p_y + x*y + x^3/3 + x*y^2");
    let residual = rejected(&mut original, "x*p_y - y*p_x");
    assert_eq!(residual, "3*x*y^2 - x^3");
}

const KERR: &str = "((r^2 - 2*M*r + a^2)*p_r^2 + p_th^2 - ((r^2 + a^2)*E - a*L)^2/(r^2 - 2*M*r + a^2) + (L - a*E*sin(th)^2)^2/sin(th)^2)/(2*(r^2 + a^2*cos(th)^2))";

#[test]
fn kerr_keeps_carters_constant() {
    let mut kerr = system("r, th; p_r, p_th", "", "a M E L", KERR);
    let on_all = format!("p_th^2 + cos(th)^2*(a^2*(-2*({KERR}) - E^2) + L^2/sin(th)^2)");
    accepted(&mut kerr, &on_all);
    rejected(&mut kerr, &on_all.replacen("a^2*(-2*(", "a^2*(2*(", 1));
    let fixed = "p_th^2 + cos(th)^2*(a^2*(1 - E^2) + L^2/sin(th)^2)";
    rejected(&mut kerr, fixed);
    assert!(verdict(&mut kerr, fixed, Some("-1/2")).is_proven());
    for (invariant, shell) in [
        (fixed, "-1/3"),
        ("p_th^2 - cos(th)^2*(a^2*(1 - E^2) + L^2/sin(th)^2)", "-1/2"),
    ] {
        match verdict(&mut kerr, invariant, Some(shell)) {
            Verdict::Disproven { .. } => {}
            other => panic!("{invariant} on {shell}: {other:?}"),
        }
    }
}

#[test]
fn sizes_are_chosen_so_that_something_happens() {
    let mut far = system(
        "q[N], s[n]; p[N], r[n]",
        "N n",
        "",
        "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 5) { q[i]*q[i + 5] } + q[9]^2 + sum(i in 0..n) { r[i]^2/2 }",
    );
    rejected(&mut far, "sum(i in 0..N) { p[i] }");
    accepted(&mut far, "sum(i in 0..n) { r[i] }");
    let mut uneven = system(
        "q[N], s[n]; p[N], r[n]",
        "N n",
        "",
        "sum(i in 0..N) { p[i]^2 } + (N - n)*sum(i in 0..N) { q[i] }",
    );
    rejected(&mut uneven, "sum(i in 0..N) { p[i] }");
}

#[test]
fn time_counts() {
    let mut driven = system("q; p; t", "", "omega", "p^2/2 + omega^2*q^2/2");
    accepted(&mut driven, "q*cos(omega*t) - p*sin(omega*t)/omega");
    rejected(&mut driven, "q*cos(omega*t) + p*sin(omega*t)/omega");
    let mut free = system("q; p; t", "", "m", "p^2/(2*m)");
    accepted(&mut free, "q - p*t/m");
    let mut explicit = system("q; p; t", "", "", "p^2/2 + q*t");
    assert_eq!(rejected(&mut explicit, "p^2/2 + q*t"), "q");
    accepted(&mut explicit, "p + t^2/2");
}

#[test]
fn toda_of_any_length() {
    let h = "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }";
    let mut toda = system("q[N]; p[N]", "N", "", h);
    accepted(&mut toda, "sum(i in 0..N) { p[i] }");
    accepted(&mut toda, h);
    accepted(
        &mut toda,
        "sum(i in 0..N) { p[i]^3/3 + (p[i] + p[(i + 1) % N])*exp(q[i] - q[(i + 1) % N]) }",
    );
    match verdict(
        &mut toda,
        "sum(i in 0..N) { p[i]^3/3 - (p[i] + p[(i + 1) % N])*exp(q[i] - q[(i + 1) % N]) }",
        None,
    ) {
        Verdict::Disproven {
            residual, point, ..
        } => {
            assert!(residual.contains("sum(i in 0..N)"), "{residual}");
            assert_eq!(point[0].0, "N");
        }
        other => panic!("{other:?}"),
    }
    rejected(
        &mut toda,
        "sum(i in 0..N) { p[i]^2/2 - exp(q[i] - q[(i + 1) % N]) }",
    );
    rejected(&mut toda, "sum(i in 0..N) { p[i]*q[i] }");
    rejected(&mut toda, "p[0]");
}

#[test]
fn toda_of_three_has_its_third_integral() {
    let h = "sum(i in 0..3) { p[i]^2/2 + exp(q[i] - q[(i + 1) % 3]) }";
    let mut toda = system("q[3]; p[3]", "", "", h);
    accepted(
        &mut toda,
        "sum(i in 0..3) { p[i]^3/3 + (p[i] + p[(i + 1) % 3])*exp(q[i] - q[(i + 1) % 3]) }",
    );
    rejected(
        &mut toda,
        "sum(i in 0..3) { p[i]^3/3 - (p[i] + p[(i + 1) % 3])*exp(q[i] - q[(i + 1) % 3]) }",
    );
    accepted(
        &mut toda,
        "p[0]*p[1]*p[2] - p[0]*exp(q[1] - q[2]) - p[1]*exp(q[2] - q[0]) - p[2]*exp(q[0] - q[1])",
    );
    rejected(
        &mut toda,
        "p[0]*p[1]*p[2] + p[0]*exp(q[1] - q[2]) - p[1]*exp(q[2] - q[0]) - p[2]*exp(q[0] - q[1])",
    );
}

const GRAVITY: &str = "sum(i in 0..n) { (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*m[i]) }
    - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }";

#[test]
fn bodies_in_any_number_keep_their_momenta() {
    let mut gravity = system("q[n][3]; p[n][3]", "n", "G m[n]", GRAVITY);
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        accepted(&mut gravity, &format!("sum(i in 0..n) {{ p[i][{axis}] }}"));
        accepted(
            &mut gravity,
            &format!("sum(i in 0..n) {{ q[i][{a}]*p[i][{b}] - q[i][{b}]*p[i][{a}] }}"),
        );
        let residual = rejected(
            &mut gravity,
            &format!("sum(i in 0..n) {{ q[i][{a}]*p[i][{b}] + q[i][{b}]*p[i][{a}] }}"),
        );
        assert!(residual.contains("sum(i in 0..n)"), "{residual}");
    }
    accepted(&mut gravity, GRAVITY);
    rejected(&mut gravity, &GRAVITY.replacen("- G", "+ G", 1));
    rejected(&mut gravity, "sum(i in 0..n) { m[i]*p[i][0] }");
}

#[test]
fn a_full_double_sum_counts_each_pair_twice() {
    let h = "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..n) { (q[i] - q[j])^4/4 }";
    let mut chain = system("q[n]; p[n]", "n", "m[n]", h);
    accepted(&mut chain, "sum(i in 0..n) { p[i] }");
    accepted(&mut chain, h);
    let mut uneven = system(
        "q[n]; p[n]",
        "n",
        "m[n]",
        "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..n) { m[i]*(q[i] - q[j])^3 }",
    );
    rejected(&mut uneven, "sum(i in 0..n) { i*p[i] }");
    accepted(&mut uneven, "sum(i in 0..n) { p[i] }");
}

#[test]
fn point_vortices_keep_their_impulses() {
    let h = "-sum(i in 0..n, j in 0..i) { g[i]*g[j]*ln((x[i]/sqrt(abs(g[i])) - x[j]/sqrt(abs(g[j])))^2 + (y[i]/sqrt(abs(g[i])) - y[j]/sqrt(abs(g[j])))^2) }/(4*pi)";
    let mut vortices = system("x[n]; y[n]", "n", "g[n]", h);
    accepted(&mut vortices, "sum(i in 0..n) { x[i]^2 + y[i]^2 }");
    accepted(&mut vortices, "sum(i in 0..n) { sqrt(abs(g[i]))*x[i] }");
    rejected(&mut vortices, "sum(i in 0..n) { x[i]^2 - y[i]^2 }");
}

#[test]
fn fermi_pasta_ulam_with_fixed_ends_has_no_momentum() {
    let h = "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { (q[i + 1] - q[i])^2/2 + (q[i + 1] - q[i])^3/6 } + q[0]^2/2 + q[N - 1]^2/2";
    let mut fpu = system("q[N]; p[N]", "N", "", h);
    rejected(&mut fpu, "sum(i in 0..N) { p[i] }");
    accepted(&mut fpu, h);
    let free = "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { (q[i + 1] - q[i])^2/2 + (q[i + 1] - q[i])^3/6 }";
    let mut free = system("q[N]; p[N]", "N", "", free);
    accepted(&mut free, "sum(i in 0..N) { p[i] }");
}

#[test]
fn the_discrete_nonlinear_schroedinger_chain_keeps_its_norm() {
    let h = "sum(i in 0..N) { (q[i]^2 + p[i]^2)^2/4 - q[i]*q[(i + 1) % N] - p[i]*p[(i + 1) % N] }";
    let mut chain = system("q[N]; p[N]", "N", "", h);
    accepted(&mut chain, "sum(i in 0..N) { q[i]^2 + p[i]^2 }");
    rejected(&mut chain, "sum(i in 0..N) { q[i]^2 - p[i]^2 }");
    accepted(&mut chain, h);
}

/// The bracket over loops against the bracket of the same expressions written out, for N = 1 … 4;
/// whether there is one.
fn is_that_written_out(a: &str, b: &str) -> bool {
    let mut m = system("q[N]; p[N]", "N", "", "0");
    let (x, y) = (parse(&mut m, a), parse(&mut m, b));
    let Some(found) = bracket(&mut m, x, y) else {
        return false;
    };
    for size in 1..=4 {
        let how = Sample {
            seed: 3,
            signed: true,
            ..Sample::default()
        };
        let (mut written, images) = unroll_nodes(&m, &[size], &[x, y]).unwrap();
        let expected = bracket(&mut written, images[0], images[1]).unwrap();
        let expected = sample(&written, &[expected], &[], how, &[]).unwrap().0[0].value;
        let value = sample(&m, &[found], &[size], how, &[]).unwrap().0[0].value;
        let close = (value - expected).abs() <= 1e-11 * (1.0 + expected.abs());
        assert!(
            close,
            "{{{a}, {b}}} at {size}: {value} and {expected}: {}",
            text(&m, found)
        );
    }
    true
}

#[test]
fn brackets_over_loops_are_those_of_the_expressions_written_out() {
    let expressions = [
        "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
        "sum(i in 0..N) { q[i]*p[(i + 1) % N] - p[(i - 1) % N]^2*q[(i + 2) % N] }",
        "sum(i in 0..N) { i*p[i] + q[i]^2 }",
        "sum(i in 0..N, j in 0..i) { (q[i] - q[j])^3*p[i] + p[j]*q[i] }",
        "sum(i in 0..N, j in i + 1..N) { sin(q[i]*p[j]) }",
        "sum(i in 0..N - 1) { (q[i + 1] - q[i])^2 + p[i]*p[i + 1] } + q[0]*p[N - 1]",
        "sqrt(1 + sum(i in 0..N) { p[i]^2 })*sum(i in 0..N) { q[i] }",
        "sum(i in 0..N, j in 0..N) { q[i]*p[j]^2*i }",
        "q[0]^2 + p[0]*q[N - 1]",
    ];
    let mut compared = 0;
    for (at, a) in expressions.iter().enumerate() {
        for b in &expressions[at..] {
            compared += usize::from(is_that_written_out(a, b));
        }
    }
    assert!(compared >= 40, "{compared}");
}

/// A loop that runs past the modulus of its index: what depends on `(i + c) % N` as a number has no
/// bracket, what depends on elements there has.
#[test]
fn loops_longer_than_their_modulus() {
    let numbered = "sum(i in 0..N) { (i + 1)*p[i]^2/2 }";
    for (a, is_formed) in [
        ("sum(i in 0..N) { q[(i + 1) % N] }", true),
        ("sum(i in 0..N - 1) { q[(i + 1) % N] }", true),
        ("sum(i in 0..N, j in 0..i) { q[(j - 1) % N] }", true),
        ("sum(i in 0..3*N) { q[i % N] }", false),
        ("sum(i in 0..2*N) { q[(i + 1) % N] }", false),
        ("sum(i in 0..N + 1) { q[(i + 1) % N] }", false),
        ("sum(i in N..2*N) { q[i % N] }", false),
        ("sum(i in 0..3, j in 0..i) { q[(j + 1) % N] }", false),
    ] {
        assert_eq!(is_that_written_out(a, numbered), is_formed, "{a}");
        assert_eq!(is_that_written_out(numbered, a), is_formed, "{a}");
        assert!(is_that_written_out(
            a,
            "sum(i in 0..N) { sin(q[i])*p[i]^2/2 }"
        ));
    }
}

/// Conserved if a loop went round its modulus once at most, which this one does not.
#[test]
fn a_loop_longer_than_its_modulus_proves_nothing() {
    let mut m = system("q[N]; p[N]; t", "N", "", "sum(i in 0..N) { (i + 1)*p[i] }");
    let bad = "sum(i in 0..3*N) { q[i % N] } - t*sum(i in 0..3*N) { 1 + if i + 1 <= N { i } else { i - N } }";
    let bad = parse(&mut m, bad);
    assert!(!is_invariant(&m, bad, None).is_proven());
}

/// A sum inside a derivative that is read at an index modulo N: over a loop that another one's
/// range names, and over the very loop that the index runs in.
#[test]
fn sums_read_at_an_index_with_a_modulus() {
    for b in [
        "sum(k in 0..N) { p[k]*sum(j in 0..N) { sin(q[k]*q[j]) } }",
        "sum(k in 0..N) { p[k]*sum(j in 0..N, l in 0..N) { sin(q[k]*q[j] + q[l]) } }",
        "sum(k in 0..N) { p[k]*sum(j in 0..N, l in 0..j) { sin(q[k]*q[j]*q[l]) } }",
    ] {
        for a in [
            "sum(i in 0..N) { q[i]*q[(i + 1) % N] }",
            "sum(i in 0..N, j in 0..N) { q[(i + j) % N]*q[i] }",
            "sum(i in 0..N, j in 0..i) { q[(i - j) % N]*q[i] }",
        ] {
            assert!(is_that_written_out(a, b), "{a}, {b}");
            assert!(is_that_written_out(b, a), "{b}, {a}");
        }
    }
}

/// {a, b} = −{b, a}, {a, bc} = b{a, c} + {a, b}c, and Jacobi's identity.
#[test]
fn brackets_obey_their_laws() {
    let m = system("x, y; u, v; t", "", "k", "u^2");
    let expressions = [
        "x^2*v - y*u",
        "sin(x)*u + exp(y)",
        "u^2/2 + v^2/(2*x^2) - k/x",
        "x*u + y*v",
        "sqrt(x^2 + y^2)",
        "cos(x - y)*v",
    ];
    for a in expressions {
        for b in expressions {
            for c in expressions {
                let mut m = m.clone();
                let (a, b, c) = (parse(&mut m, a), parse(&mut m, b), parse(&mut m, c));
                let of = |m: &mut Model, x, y| bracket(m, x, y).unwrap();
                let (ab, ba, bc, ca) = (
                    of(&mut m, a, b),
                    of(&mut m, b, a),
                    of(&mut m, b, c),
                    of(&mut m, c, a),
                );
                let sum = m.dag.add(&[ab, ba]);
                assert_eq!(is_zero(&m, sum), Proof::Zero);
                let jacobi = [of(&mut m, a, bc), of(&mut m, b, ca), of(&mut m, c, ab)];
                let jacobi = m.dag.add(&jacobi);
                assert_eq!(is_zero(&m, jacobi), Proof::Zero);
                let product = m.dag.mul(&[b, c]);
                let whole = of(&mut m, a, product);
                let ac = of(&mut m, a, c);
                let (one, two) = (m.dag.mul(&[b, ac]), m.dag.mul(&[ab, c]));
                let parts = m.dag.add(&[one, two]);
                let difference = m.dag.sub(whole, parts);
                assert_eq!(is_zero(&m, difference), Proof::Zero);
            }
        }
    }
}

#[test]
fn brackets_are_expressions() {
    let mut m = system("x, y, z; u, v, w", "", "", "u^2");
    let (lx, ly, lz) = (
        parse(&mut m, "y*w - z*v"),
        parse(&mut m, "z*u - x*w"),
        parse(&mut m, "x*v - y*u"),
    );
    let found = bracket(&mut m, lx, ly).unwrap();
    let difference = m.dag.sub(found, lz);
    assert_eq!(is_zero(&m, difference), Proof::Zero);
    let (q, p) = (parse(&mut m, "x"), parse(&mut m, "u"));
    let one = bracket(&mut m, q, p).unwrap();
    assert_eq!(text(&m, one), "1");
    let minus = bracket(&mut m, p, q).unwrap();
    assert_eq!(text(&m, minus), "-1");
    let zero = bracket(&mut m, q, q).unwrap();
    assert_eq!(text(&m, zero), "0");
}

#[test]
fn what_no_rule_proves_is_undecided_with_its_residual() {
    let mut m = system(
        "q, x; p, u",
        "",
        "",
        "p^2/2 + u^2/2 + asin(q)^2*0 + (acos(q) + asin(q))*x",
    );
    // u changes by −π/2, which only a rule that is not there would say.
    match verdict(&mut m, "p", None) {
        Verdict::Proven(_) => {}
        other => panic!("{other:?}"),
    }
    let mut m = system("q; p; t", "", "", "p*(asin(q) + acos(q)) - p*pi/2");
    match verdict(&mut m, "q", None) {
        Verdict::Undecided { residual, .. } => assert!(residual.contains("asin(q)"), "{residual}"),
        other => panic!("{other:?}"),
    }
}

/// A statement that is false for negative parameters only, or before t = 0, is false.
#[test]
fn parameters_need_not_be_positive() {
    let point = |m: &mut Model, invariant: &str, shell: Option<&str>, name: &str| match verdict(
        m, invariant, shell,
    ) {
        Verdict::Disproven { point, .. } => {
            let found = point.iter().find(|(other, _)| other == name);
            assert!(found.is_some_and(|(_, value)| *value < 0.0), "{point:?}");
        }
        other => panic!("{invariant}: {other:?}"),
    };
    let h = "(p^2 + u^2)/2 + (abs(a) - a)*q + a*x";
    let mut tilted = system("q, x; p, u; t", "", "a b c d", h);
    point(&mut tilted, "p", None, "a");
    point(&mut tilted, "p", Some("1"), "a");
    // Another parameter must be positive.
    point(
        &mut tilted,
        "p + sqrt(b)*(p^2 + u^2)/2 + sqrt(b)*(q*(abs(a) - a) + a*x)",
        None,
        "a",
    );
    // Some of an array.
    let h = "sum(i in 0..n) { p[i]^2/2 + (abs(k[i]) - k[i])*q[i] }";
    let mut wells = system("q[n]; p[n]", "n", "k[n]", h);
    assert!(matches!(
        verdict(&mut wells, "sum(i in 0..n) { p[i] }", None),
        Verdict::Disproven { .. }
    ));
    let mut late = system("q; p; t", "", "", "p^2/2 + (abs(t) - t)*q");
    point(&mut late, "p", None, "t");
    // The system is there for a ≥ 0 only, and there it is conserved.
    for h in [
        "(p^2 + u^2)/2 + (abs(a) - a)*q + sqrt(a)*x",
        "(p^2 + u^2)/2 + (abs(a) - a)*q + ln(a)*x",
    ] {
        let mut half = system("q, x; p, u", "", "a", h);
        for shell in [None, Some("1")] {
            assert!(!matches!(
                verdict(&mut half, "p", shell),
                Verdict::Disproven { .. }
            ));
        }
    }
    let mut jumping = system("q; p", "", "a", "p^2/2");
    assert!(matches!(
        verdict(&mut jumping, "abs(q^2 + a)/(q^2 + a)", None),
        Verdict::Jumps { .. }
    ));
}

/// A point has one value a size, also where the residual is found at that size only.
#[test]
fn a_point_names_each_size_once() {
    let h = "sum(i in 0..N) { p[i]^2/2 + (q[i] - q[(i + 1) % N])^2/2 }";
    let mut ring = system("q[N]; p[N]", "N", "", h);
    match verdict(&mut ring, "sum(i in 0..N) { p[(2*i) % N] }", None) {
        Verdict::Disproven { point, .. } => {
            let sizes = point.iter().filter(|(name, _)| name == "N");
            assert_eq!(sizes.count(), 1, "{point:?}");
        }
        other => panic!("{other:?}"),
    }
}

/// Nothing is proven on a shell without points, and nothing refuted.
#[test]
fn a_shell_without_points_decides_nothing() {
    let mut oscillator = system("q; p", "", "", "p^2/2 + q^2/2");
    match verdict(&mut oscillator, "p", Some("-1")) {
        Verdict::Undecided { residual, .. } => assert_eq!(residual, "-q"),
        other => panic!("{other:?}"),
    }
}

/// True of three bodies is not true of any number.
#[test]
fn what_holds_at_one_size_only_is_refuted_at_another() {
    let h = "sum(i in 0..N) { p[i]^2/2 } + (N - 3)*sum(i in 0..N) { q[i] }";
    let mut tilted = system("q[N]; p[N]", "N", "", h);
    match verdict(&mut tilted, "sum(i in 0..N) { p[i] }", None) {
        Verdict::Disproven { point, .. } => {
            assert!(point[0].0 == "N" && point[0].1 != 3.0, "{point:?}");
        }
        other => panic!("{other:?}"),
    }
}

/// No rule about loops says that a sum over three is that of three.
#[test]
fn loops_over_literal_ranges_are_written_out_for_a_proof() {
    let h = "u^2/2 + y*(sum(i in 0..3) { x[i] } - x[0] - x[1] - x[2])";
    let mut apart = system("x[3], y; v[3], u", "", "", h);
    accepted(&mut apart, "u");
    rejected(&mut apart, "y");
}

/// Pairs are counted once, whichever of the two comes first.
#[test]
fn pairs_above_the_diagonal_are_those_below() {
    let pairs = |range: &str| {
        format!(
            "sum(i in 0..n) {{ p[i]^2/(2*m[i]) }} + sum(i in 0..n, j in {range}) {{ m[i]*m[j]*exp(q[i] + q[j])*(i + j) }}"
        )
    };
    let mut bodies = system("q[n]; p[n]", "n", "m[n]", &pairs("0..i"));
    accepted(&mut bodies, &pairs("i + 1..n"));
    let mut bodies = system("q[n]; p[n]", "n", "m[n]", &pairs("i + 1..n"));
    accepted(&mut bodies, &pairs("0..i"));
}

/// A parameter with one certain value keeps it.
#[test]
fn equality_of_parameters_counts() {
    let mut m = system(
        "q, x; p, u",
        "",
        "k",
        "p^2/2 + u^2/2 + if k == 1 { q } else { 0 }",
    );
    assert!(matches!(
        verdict(&mut m, "p", None),
        Verdict::Undecided { .. }
    ));
    accepted(&mut m, "p^2/2 + if k != 1 { 0 } else { q }");
    accepted(&mut m, "u*if k == 1 { 2 } else { 3 }");
    // Both parameters may be 0, and then this is so everywhere.
    let line = "p^2/2 + u^2/2 + if k*q + l == 0 { x } else { 0 }";
    let mut m = system("q, x; p, u", "", "k l", line);
    assert!(matches!(
        verdict(&mut m, "u", None),
        Verdict::Undecided { .. }
    ));
}
