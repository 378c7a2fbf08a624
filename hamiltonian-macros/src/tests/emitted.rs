//! Snapshots of emitted code.

use crate::expand::expand;
use proc_macro2::TokenStream;
use quote::quote;
use std::str::FromStr;

const PENDULUM: &str = "/// A system.
    pub struct Pendulum { m = 1, l = 10, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)";

const TODA: &str = "/// A system.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] }";

const GRAVITY: &str = "/// A system.
    pub struct Gravity { n: usize, G = 1, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }";

const VALUE: &str = "H(q; p) = a*(q^2 + 1)*(p^2 + 1)/2";

fn emitted(definition: &str) -> TokenStream {
    let definition = TokenStream::from_str(definition).unwrap();
    let code = expand(quote! { (::hamiltonian) #definition });
    assert!(!code.to_string().contains("compile_error"), "{code}");
    code
}

fn pretty(tokens: &TokenStream) -> String {
    prettyplease::unparse(&syn::parse2(tokens.clone()).unwrap())
}

#[test]
fn pendulum_is_emitted() {
    insta::assert_snapshot!(pretty(&emitted(PENDULUM)));
}

#[test]
fn expression_form_is_emitted() {
    let value = emitted(VALUE);
    insta::assert_snapshot!(pretty(&quote! { fn value() { let value = #value; } }));
}

#[test]
fn loops_stay_loops() {
    insta::assert_snapshot!(pretty(&emitted(TODA)));
}

#[test]
fn pair_sums_with_a_size_of_run_time() {
    insta::assert_snapshot!(pretty(&emitted(GRAVITY)));
}

/// Second derivatives with a third one of a Rust function, and those of loops, come from the gradient over dual numbers.
#[test]
fn hessians_come_from_the_gradient_over_dual_numbers() {
    for (definition, is_written) in [
        (PENDULUM, true),
        (TODA, false),
        (GRAVITY, false),
        (
            "pub struct Well {} fn depth(x) = well; fn other(x) = well;
             H(q; p) = p^2/2 + other(q) + bracket(depth(q), p)",
            false,
        ),
    ] {
        let code = emitted(definition).to_string();
        assert_eq!(
            code.contains("fn hessian_vector"),
            is_written,
            "{definition}"
        );
        assert_eq!(
            code.contains("hessian_by_gradient"),
            !is_written,
            "{definition}"
        );
    }
}

#[test]
fn halves_without_common_work_make_the_gradient() {
    let code = |definition| emitted(definition).to_string();
    assert!(!code(PENDULUM).contains("fn gradient ("));
    // The cosine of the time is work of both.
    assert!(code("H(q; p; t) = cos(t)*(p^2 + q^2)").contains("fn gradient ("));
}

/// Loops are written once for the gradient and the equations of motion, unless a force is in these.
#[test]
fn gradients_with_loops_come_from_the_equations_of_motion() {
    for (definition, source) in [
        (
            "H(q[9]; p[9]) = sum(i in 0..9) { p[i]^2 + q[i]^2 }",
            "gradient_by_halves",
        ),
        (
            "H(q[9]; p[9]) = sum(i in 0..9) { p[i]^2*q[i]^2 }",
            "gradient_by_field",
        ),
    ] {
        let code = emitted(definition).to_string();
        assert!(code.contains(source), "{definition}");
        assert!(!code.contains("fn gradient"), "{definition}");
    }
    let forced = "pub struct Forced {} H(q[9]; p[9]) = sum(i in 0..9) { p[i]^2 + q[i]^2 };
        force(q[i]; p[i]) = -p[i]";
    let forced = emitted(forced).to_string();
    assert!(forced.contains("fn gradient_q") && !forced.contains("gradient_by"));
}

#[test]
fn independent_calls_are_neighbours() {
    let code = |definition: &str| {
        let code = emitted(definition).to_string();
        code.replace(' ', "")
    };
    let exponentials = code("H(a, b, c; p, r, s) = exp(a - b) + exp(b*c) + exp(c) + p*r*s");
    assert!(
        exponentials.contains("__h::each!(T,Expexptrue:"),
        "{exponentials}"
    );
    // One needs the value of the other; those of two functions are two lines.
    let nested = code("H(a, b; p, r) = exp(exp(a)) + p + r*b");
    assert!(!nested.contains("each!"), "{nested}");
    let two = code("H(a, b; p, r) = exp(ln(a)*b) + exp(b) + ln(b) + p*r");
    assert!(two.contains("__h::each!(T,Lnlntrue:"), "{two}");
    // Many calls are not written out.
    let terms: Vec<String> = (1..30).map(|k| format!("exp(a/{k})")).collect();
    let many = code(&format!("H(a; p) = p + {}", terms.join(" + ")));
    assert!(many.contains("__h::each!(T,Expexpfalse:"), "{many}");
    // Sines of one angle each are faster alone.
    assert!(!code("H(a, b; p, r) = sin(a)*p + sin(b)*r").contains("Sinsin"));
    let angles = code("H(a, b; p, r) = sin(a)*cos(a)*p + sin(b)*cos(b)*r");
    assert!(
        angles.contains("__h::each!(T,SinCossin_costrue:"),
        "{angles}"
    );
}

#[test]
fn emission_is_deterministic() {
    for definition in [PENDULUM, GRAVITY] {
        let [first, second] = [(); 2].map(|()| emitted(definition).to_string());
        assert_eq!(first, second);
    }
}

#[test]
fn long_bodies_have_one_copy_in_a_program() {
    let shared = |definition, over: &str| {
        let code = emitted(definition).to_string();
        let name = format!("const SHARED : __h :: SharedCode = __h :: SharedCode :: {over} ;");
        code.matches(&name).count()
    };
    // A chain of twenty numbers; the field is the kick and the drift.
    let [q, p] = ["q", "p"].map(|x| (0..20).map(|k| format!("{x}{k}")).collect::<Vec<_>>());
    let terms: Vec<String> = (q.windows(2).map(|pair| format!("exp({})", pair.join("-"))))
        .chain(p.iter().map(|p| format!("{p}^2/2")))
        .collect();
    let chain = format!(
        "pub struct Chain {{}} H({}; {}) = {}",
        q.join(", "),
        p.join(", "),
        terms.join(" + ")
    );
    for (definition, in_packs, all) in [(PENDULUM, 0, 0), (&chain, 1, 0), (GRAVITY, 0, 1)] {
        assert_eq!(shared(definition, "InPacks"), in_packs, "{definition}");
        assert_eq!(shared(definition, "All"), all, "{definition}");
    }
}
