//! Structure is proven, and refused with the reason in the user's notation.

use crate::common::{model, parse, system};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::print::text;
use hamiltonian_symbolic::structure::{Structure, analyse, kick_beside};

fn scalar(h: &str) -> (Model, Structure) {
    let mut model = system("q, x; p, u; t", "", "a m k G", h);
    let structure = analyse(&mut model);
    (model, structure)
}

fn parts(h: &str) -> (String, String) {
    let (model, structure) = scalar(h);
    let split = structure
        .separable
        .unwrap_or_else(|c| panic!("{h}: {}", c.text));
    (text(&model, split.kinetic), text(&model, split.potential))
}

fn coupling(h: &str) -> String {
    scalar(h).1.separable.expect_err(h).text
}

#[test]
fn the_source_grouping_is_kept() {
    for (h, kinetic, potential) in [
        ("p^2/(2*m) + k*q^2/2", "p^2/(2*m)", "0.5*k*q^2"),
        (
            "p^2/2 + u^2/2 + (q^2 + x^2)/2 + q^2*x - x^3/3",
            "p^2/2 + u^2/2",
            "(q^2 + x^2)/2 + q^2*x - x^3/3",
        ),
        (
            "(p + u)^2*a - (q - x)^4 + 1",
            "(p + u)^2*a",
            "1 - (q - x)^4",
        ),
        ("m*(p^2 + q^2)", "m*p^2", "m*q^2"),
        (
            "m*(k*(p^2 + q^2) - cos(q))",
            "m*k*p^2",
            "m*(k*q^2 - cos(q))",
        ),
        ("p^2/2 - q*cos(t) + a*t", "p^2/2", "-q*cos(t) + a*t"),
        ("p*t + q", "p*t", "q"),
        (
            "sqrt(1 + p^2) - cos(q) + q^4/10",
            "sqrt(p^2 + 1)",
            "-cos(q) + 0.1*q^4",
        ),
        (
            "if a < 1 { p^2 + q } else { p^2 - q }",
            "p^2",
            "if a < 1 { q } else { -q }",
        ),
        ("p^2", "p^2", "0"),
        ("q", "0", "q"),
    ] {
        assert_eq!(parts(h), (kinetic.to_owned(), potential.to_owned()), "{h}");
    }
}

#[test]
fn products_are_multiplied_out_only_where_they_must_be() {
    assert_eq!(
        parts("(q + p)^2 - 2*q*p"),
        ("p^2".to_owned(), "q^2".to_owned())
    );
    assert_eq!(
        parts("(p - q)*(p + q)"),
        ("p^2".to_owned(), "-q^2".to_owned())
    );
    assert_eq!(coupling("0.5*(q^2 + 1)*(p^2 + 1)"), "0.5*q^2*p^2");
    assert_eq!(coupling("(q^2 + 1)*(p^2 + 1)/2"), "0.5*q^2*p^2");
    assert_eq!(coupling("p^2/2 + a*q*p - cos(q)"), "a*q*p");
    assert_eq!(coupling("(p - a*x)^2/2 + q^2"), "-p*a*x");
    assert_eq!(coupling("p^2/(2*(1 + q^2))"), "p^2/(2*(q^2 + 1))");
    assert_eq!(coupling("cos(q - p)"), "cos(q - p)");
    assert_eq!(coupling("m*(p^2 + k*(q*u + 1))"), "m*k*q*u");
    assert_eq!(coupling("(p^2*cos(x) + q)*(1 + a)"), "p^2*cos(x)*a");
    assert_eq!(
        coupling("if q < 0 { p^2 } else { 2*p^2 }"),
        "if q < 0 { p^2 } else { 2*p^2 }"
    );
}

/// Only terms that couple are multiplied out, or brought to a normal form: (q − 1)¹⁰ written out cancels.
#[test]
fn what_does_not_couple_stays_as_it_was_written() {
    for (h, kinetic, potential) in [
        ("p*(p + q) - p*q + (q - 1)^10", "p^2", "(q - 1)^10"),
        ("(cos(q) - 1)^6 + p*(p + q) - p*q", "p^2", "(cos(q) - 1)^6"),
        (
            "p^2*sin(x)^2 + p^2*cos(x)^2 + (cos(q) - 1)^6 + (p - 1)^4",
            "(p - 1)^4 + p^2",
            "(cos(q) - 1)^6",
        ),
        (
            "m*((p + q)^2 - 2*q*p - (q - 1)^10)",
            "m*p^2",
            "-m*(q - 1)^10 + m*q^2",
        ),
    ] {
        assert_eq!(parts(h), (kinetic.to_owned(), potential.to_owned()), "{h}");
    }
    let mut chain = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { (p[i] + q[i])^2 - 2*q[i]*p[i] + (q[i] - 1)^10 }",
    );
    let split = analyse(&mut chain).separable.unwrap();
    assert_eq!(
        text(&chain, split.potential),
        "sum(i in 0..N) { (q[i] - 1)^10 } + sum(i in 0..N) { q[i]^2 }"
    );
}

#[test]
fn relations_between_functions_are_known() {
    assert_eq!(
        parts("p^2*sin(x)^2 + p^2*cos(x)^2 + q"),
        ("p^2".to_owned(), "q".to_owned())
    );
    assert_eq!(
        parts("exp(q - p)*exp(p)*x"),
        ("0".to_owned(), "exp(q)*x".to_owned())
    );
    assert_eq!(coupling("p^2*sin(x)^2 - p^2*cos(x)^2"), "p^2*sin(x)^2");
}

/// A term that couples at one value of a parameter couples.
#[test]
fn conditions_on_parameters_that_seldom_hold_count() {
    assert_eq!(
        coupling("p^2/2 + if k == 1 { q^2/2 + q*p } else { cos(q) }"),
        "if k == 1 { q*p } else { 0 }"
    );
    coupling("p^2/2 + q^2/2 + if k == 1 { q*p } else { 0 }");
    coupling("p^2/2 + q^2/2 + if k != 1 { 0 } else { q*p }");
    coupling("(p^2 + q^2)/2 + sign(k)^2*q*p - q*p");
    coupling("(p^2 + q^2)/2 + if q == p { 7*q } else { 0 }");
    coupling("if a/(if q <= p { q } else { 2 }) == 3 { 5 } else { p }");
    parts("if q <= p { p + sin(q)^2 } else { p + 1 - cos(q)^2 }");
    assert_eq!(
        parts("p^2/2 + if k == 1 { q*p } else { 0 } - q*p*(if k == 1 { 1 } else { 0 }) + q^2"),
        ("p^2/2".to_owned(), "q^2".to_owned())
    );
}

#[test]
fn a_quadratic_kinetic_part_is_recognised() {
    for h in [
        "p^2/2 + q",
        "p^2/(2*m) - u^2*a + q^2",
        "(p + u)^2*m/2 + cos(q)",
        "p*u",
        "p*(p + 1) - p + q",
        "if a < m { p^2 } else { u^2 }",
    ] {
        assert_eq!(scalar(h).1.quadratic_kinetic, Ok(()), "{h}");
    }
    for (h, reason) in [
        ("p^4 + q", "the term `p^4` is not quadratic in the momenta"),
        ("p^2/2 + a*p + q", "the term `a*p` is linear in the momenta"),
        (
            "sqrt(1 + p^2) + q",
            "the term `sqrt(p^2 + 1)` is not quadratic in the momenta",
        ),
        ("p^2*t + q", "the term `p^2*t` depends on time"),
        ("(p + 1)^2/2 + q", "the term `p` is linear in the momenta"),
        (
            "p^2*q",
            "H is not separable: the term `p^2*q` couples coordinates and momenta",
        ),
        ("q^2", "no term depends on momenta"),
    ] {
        assert_eq!(scalar(h).1.quadratic_kinetic, Err(reason.to_owned()), "{h}");
    }
}

#[test]
fn a_kick_beside_what_is_at_most_quadratic_is_recognised() {
    let kick = |a: &str, b: &str| {
        let mut model = model("q, x; p, u; t", "", "a m");
        let parts = [a, b].map(|text| parse(&mut model, text));
        kick_beside(&mut model, parts)
    };
    for (quadratic, potential) in [
        ("p^2/2", "q^4*cos(t)"),
        ("(p - a*x)^2/2 + (u + a*q)^2/2 + a*p", "1/q"),
        ("(1 + q^2)*p^2/2 + sin(x)", "q*x"),
        ("p*u*exp(q) + p", "cos(q)"),
        ("p*(p^2 + q) - p^3", "q"),
        ("if q < x { p } else { p^2 }", "q"),
    ] {
        let kicks_last = kick(quadratic, potential);
        assert_eq!(kicks_last, Ok([1, 0]), "{quadratic}, {potential}");
    }
    assert_eq!(kick("q*t", "x*p"), Ok([0, 1]));
    // Of two that could kick, the one that beside the other may have time in it.
    assert_eq!(kick("q", "x*t"), Ok([1, 0]));
    for (a, b, reason) in [
        (
            "sqrt(1 + p^2) + u^2",
            "q",
            "the term `sqrt(p^2 + 1)` is not a polynomial of degree 2 in the momenta",
        ),
        (
            "q*p^2*u",
            "q",
            "the term `q*p^2*u` is not a polynomial of degree 2 in the momenta",
        ),
        (
            "p^2/q + 1/p",
            "q",
            "the term `1/p` is not a polynomial of degree 2 in the momenta",
        ),
        (
            "p^2/2 + a*u*t",
            "q",
            "the term `a*u*t` beside the kick depends on time",
        ),
        (
            "if p < q { p } else { 0 }",
            "q",
            "the term `if p < q { p } else { 0 }` is not a polynomial of degree 2 in the momenta",
        ),
        (
            "(q^2 + p^2)/2",
            "q^2*p^2/2",
            "both pieces, `(q^2 + p^2)/2` and `0.5*q^2*p^2`, depend on momenta",
        ),
    ] {
        assert_eq!(kick(a, b), Err(reason.to_owned()), "{a}, {b}");
    }
}

#[test]
fn time_and_cyclic_coordinates_are_reported() {
    assert_eq!(scalar("p^2 + q").1.autonomous, Ok(()));
    assert_eq!(
        scalar("p^2 + (x - q*cos(t))").1.autonomous,
        Err("the term `q*cos(t)` depends on `t`".to_owned())
    );
    let names = |h: &str| {
        scalar(h)
            .1
            .cyclic
            .into_iter()
            .map(|c| (c.coordinate, c.momentum))
            .collect::<Vec<_>>()
    };
    assert_eq!(names("p^2 + q + u^2"), [("x".to_owned(), "u".to_owned())]);
    assert_eq!(names("p^2 + q*x"), []);
    let mut model = system(
        "q[N][3], s[3], c[N]; p[N][3], r[3], w[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i][0]^2 + q[i][1] } + s[0]*s[2]",
    );
    let cyclic = analyse(&mut model).cyclic;
    let found: Vec<_> = cyclic.iter().map(|c| c.coordinate.as_str()).collect();
    assert_eq!(found, ["q[i][0]", "q[i][2]", "s[1]", "c[i]"]);
    assert_eq!(cyclic[2].momentum, "r[1]");
}

#[test]
fn loops_are_split_body_by_body() {
    let mut toda = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
    );
    let structure = analyse(&mut toda);
    assert_eq!(structure.quadratic_kinetic, Ok(()));
    let split = structure.separable.unwrap();
    assert_eq!(text(&toda, split.kinetic), "sum(i in 0..N) { p[i]^2 }/2");
    assert_eq!(
        text(&toda, split.potential),
        "sum(i in 0..N) { exp(q[i] - q[(i + 1) % N]) }"
    );

    let mut gravity = system(
        "q[n][2]; p[n][2]",
        "n",
        "G m[n]",
        "sum(i in 0..n) { (p[i][0]^2 + p[i][1]^2)/(2*m[i]) } - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2) }",
    );
    let structure = analyse(&mut gravity);
    assert_eq!(structure.quadratic_kinetic, Ok(()));
    assert!(structure.separable.is_ok());

    let mut lattice = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { (p[i]^2 + 1)*(q[i]^2 + 1) }",
    );
    assert_eq!(
        analyse(&mut lattice).separable.unwrap_err().text,
        "sum(i in 0..N) { p[i]^2*q[i]^2 }"
    );
    let mut mixed = system(
        "q[N]; p[N]",
        "N",
        "",
        "sqrt(1 + sum(i in 0..N) { p[i]^2 + q[i]^2 })",
    );
    assert_eq!(
        analyse(&mut mixed).separable.unwrap_err().text,
        "sqrt(sum(i in 0..N) { p[i]^2 + q[i]^2 } + 1)"
    );
    let mut hidden = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { (p[i] + q[i])^2 - 2*q[i]*p[i] }",
    );
    let split = analyse(&mut hidden).separable.unwrap();
    assert_eq!(text(&hidden, split.kinetic), "sum(i in 0..N) { p[i]^2 }");
}

/// (c₁ + c₂ + …)ⁿ of so many names, times a factor.
fn power_of_sum(names: usize, n: usize) -> String {
    let names: Vec<String> = (1..=names).map(|k| format!("c{k}")).collect();
    format!("({})^{n}", names.join(" + "))
}

/// The structure of H with a great many parameters.
fn with_parameters(h: &str) -> Structure {
    let names: Vec<String> = (1..=12).map(|k| format!("c{k}")).collect();
    analyse(&mut system("q, x; p, u", "", &names.join(" "), h))
}

/// A limit of the expansion is named, and a term of another degree of freedom does not reach it.
#[test]
fn limits_of_expansion_are_named() {
    // C(n + 11, 11) terms: 364 of the third power, 12 376 of the sixth.
    let reason = |h: &str| {
        with_parameters(h)
            .separable
            .map_err(|c| c.to_string())
            .err()
    };
    let cancels = |n| {
        let long = power_of_sum(12, n);
        format!("{long}*(q + p)^2 - 2*{long}*q*p + x^2 + u^2")
    };
    assert_eq!(reason(&cancels(3)), None);
    assert_eq!(
        reason("(q + p)^2 - q*p").unwrap(),
        "the term `q*p` couples coordinates and momenta"
    );
    let limit = reason(&cancels(6)).unwrap();
    assert!(
        limit.starts_with("nothing shows that the term `"),
        "{limit}"
    );
    assert!(
        limit.ends_with("it has more than 4000 terms or takes more than 40000 products"),
        "{limit}"
    );

    // What cancels of one degree of freedom is found beside a long one, and the long one is named.
    let long = power_of_sum(12, 6);
    let beside = reason(&format!(
        "(x + u)^2 - 2*x*u + {long}*(q + p)^2 - 2*{long}*q*p"
    ));
    assert!(beside.unwrap().contains("(q + p)^2"));
    let half = |q: &str, p: &str, long: &str| format!("{long}*({q} + {p})^2 - 2*{long}*{q}*{p}");
    let [first, second] = [("q", "p", 3), ("x", "u", 3)].map(|(q, p, n)| {
        // 364·3 terms each way: 4096 together with the other, not alone.
        half(
            q,
            p,
            &format!("{}*{}", power_of_sum(12, n), power_of_sum(4, 1)),
        )
    });
    assert_eq!(reason(&format!("{first} + {second}")), None);

    let quadratic = |h: &str| with_parameters(h).quadratic_kinetic.err();
    let hidden = |n| {
        format!(
            "{}*p*(p + 1) - {}*p",
            power_of_sum(12, n),
            power_of_sum(12, n)
        )
    };
    assert_eq!(quadratic(&hidden(3)), None);
    let limit = quadratic(&hidden(6)).unwrap();
    assert!(limit.starts_with("the degree of the term `"), "{limit}");
    assert!(limit.ends_with("it has more than 4096 terms"), "{limit}");
    assert_eq!(
        quadratic(&format!("u*(u + 1) - u + {}*p^2", power_of_sum(12, 6))),
        None
    );
}
