//! Sixty true and sixty false statements, all decided: invariants, splits, separability. Of textbook
//! systems none is undecided.

use crate::common::{parse, system};
use hamiltonian_symbolic::bracket::{Verdict, is_invariant};
use hamiltonian_symbolic::structure::analyse;
use hamiltonian_symbolic::transform::check_split;

/// A system with statements true of it, and false ones.
struct System {
    /// Coordinates, momenta, time; sizes; parameters.
    names: [&'static str; 3],
    h: &'static str,
    conserved: &'static [&'static str],
    /// Not conserved, which a point shows.
    changing: &'static [&'static str],
    /// Constant wherever it is smooth, and not across a jump or a pole.
    jumping: &'static [&'static str],
}

const SYSTEMS: &[System] = &[
    System {
        names: ["q; p", "", "k m"],
        h: "p^2/(2*m) + k*q^2/2",
        conserved: &["p^2 + k*m*q^2"],
        changing: &["p^2 - k*m*q^2", "q*p"],
        jumping: &["sign(q)"],
    },
    System {
        names: ["q; p; t", "", "w"],
        h: "p^2/2 + w^2*q^2/2",
        conserved: &["(p*cos(w*t) + w*q*sin(w*t))", "w*q*cos(w*t) - p*sin(w*t)"],
        changing: &["p*cos(w*t) - w*q*sin(w*t)"],
        jumping: &["atan2(w*q, p) - w*t", "atan(w*q/p) - w*t"],
    },
    System {
        names: ["x, y, z; u, v, w", "", "k m"],
        h: "(u^2 + v^2 + w^2)/(2*m) - k/sqrt(x^2 + y^2 + z^2)",
        conserved: &[
            "x*v - y*u",
            "(x*v - y*u)^2 + (y*w - z*v)^2 + (z*u - x*w)^2",
            "v*(x*v - y*u) - w*(z*u - x*w) - k*m*x/sqrt(x^2 + y^2 + z^2)",
        ],
        changing: &[
            "x*v + y*u",
            "v*(x*v - y*u) - w*(z*u - x*w) - k*x/sqrt(x^2 + y^2 + z^2)",
        ],
        jumping: &["(x*v - y*u)*sign(z)^2"],
    },
    System {
        names: ["q[n][3]; p[n][3]", "n", "m[n]"],
        h: "sum(i in 0..n) { (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*m[i]) } - sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }",
        conserved: &[
            "sum(i in 0..n) { p[i][0] }",
            "sum(i in 0..n) { q[i][0]*p[i][1] - q[i][1]*p[i][0] }",
        ],
        changing: &["sum(i in 0..n) { m[i]*p[i][0] }", "p[0][0]"],
        jumping: &[],
    },
    System {
        names: ["q[n]; p[n]", "n", "m[n]"],
        h: "sum(i in 0..n) { p[i]^2/(2*m[i]) } - sum(i in 0..n, j in 0..i) { m[i]*m[j]/abs(q[i] - q[j]) }",
        conserved: &["sum(i in 0..n) { p[i] }"],
        changing: &["sum(i in 0..n) { p[i]^2 }"],
        jumping: &[],
    },
    System {
        names: ["q[3]; p[3]", "", "m[3]"],
        h: "sum(i in 0..3) { p[i]^2/(2*m[i]) } - sum(i in 0..3, j in 0..i) { m[i]*m[j]*ln(abs(q[i] - q[j])) }",
        conserved: &["p[0] + p[1] + p[2]"],
        changing: &["p[0] + p[1]"],
        jumping: &[],
    },
    System {
        names: ["q[N]; p[N]", "N", ""],
        h: "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
        conserved: &[
            "sum(i in 0..N) { p[i] }",
            "sum(i in 0..N) { p[i]^3/3 + (p[i] + p[(i + 1) % N])*exp(q[i] - q[(i + 1) % N]) }",
        ],
        changing: &[
            "sum(i in 0..N) { p[i]^3/3 }",
            "sum(i in 0..N) { q[i]*p[i] }",
        ],
        jumping: &[],
    },
    System {
        names: ["q[N]; p[N]", "N", "a"],
        h: "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { (q[i + 1] - q[i])^2/2 + a*(q[i + 1] - q[i])^4/4 }",
        conserved: &[
            "sum(i in 0..N) { p[i] }",
            "sum(i in 0..N) { p[i]^2/2 } + sum(i in 1..N) { (q[i] - q[i - 1])^2/2 + a*(q[i] - q[i - 1])^4/4 }",
        ],
        changing: &["sum(i in 0..N) { p[i]^2/2 } + sum(i in 1..N) { (q[i] - q[i - 1])^2/2 }"],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v", "", ""],
        h: "(u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y + y^3/3",
        conserved: &["u*v + x*y + x^3/3 + x*y^2"],
        changing: &["u*v - x*y + x^3/3 + x*y^2"],
        jumping: &["sign(x + y)^2"],
    },
    System {
        names: ["x, y; u, v", "", "m"],
        h: "((u + y)^2 + (v - x)^2)/2 - (x^2 + y^2)/2 - (1 - m)/sqrt((x + m)^2 + y^2) - m/sqrt((x - 1 + m)^2 + y^2)",
        conserved: &[
            "x^2 + y^2 + 2*(1 - m)/sqrt((x + m)^2 + y^2) + 2*m/sqrt((x - 1 + m)^2 + y^2) - (u + y)^2 - (v - x)^2",
        ],
        changing: &["x*v - y*u"],
        jumping: &[],
    },
    System {
        names: ["q; p", "", "a b"],
        h: "q - ln(q) + a*(p - b*ln(p))",
        conserved: &["exp(q)*exp(a*p)/q/p^(a*b)"],
        changing: &["q - ln(q) - a*p"],
        jumping: &[],
    },
    System {
        names: ["q; p", "", ""],
        h: "cosh(p)*sqrt(1 + 1/q^2)",
        conserved: &["cosh(p)^2*(1 + 1/q^2)", "(cosh(p)*sqrt(1 + 1/q^2))^2"],
        changing: &["cosh(p)^2 + 1/q^2"],
        jumping: &[],
    },
    System {
        names: ["q; p", "", "a"],
        h: "p^2/2 + 1/q^2",
        conserved: &["sign(q)", "p^2 + 2/q^2", "abs(q)/q*(p^2 + 2/q^2)"],
        changing: &["p^2 + 1/q^2"],
        jumping: &["sign(q - a)"],
    },
    System {
        names: ["x, y; u, v", "", ""],
        h: "(u^2 + v^2)/2 + 1/(x - y)^2",
        conserved: &[
            "u + v",
            "sign(x - y)",
            "(x*v - y*u)*0 + (u + v)*abs(x - y)/(x - y)",
        ],
        changing: &["u - v"],
        jumping: &["sign(x + y)"],
    },
    System {
        names: ["q; p; t", "", "a"],
        h: "q*p",
        conserved: &[
            "q^2*p^2",
            "ln(abs(q)) - t",
            "abs(q)*p*sqrt(q^2)/q",
            "abs(q)^a*abs(p)^a",
        ],
        changing: &["ln(abs(q)) + t", "q^a*p"],
        jumping: &["sign(q - a)*q/q"],
    },
    System {
        names: ["q; p; t", "", "a"],
        h: "p^2/2",
        conserved: &[
            "q - p*t",
            "p + atan(1/(q - 100000)^2) + atan((q - 100000)^2)",
            "max(q, 0)/q - max(-q, 0)/q",
            "abs(p)^a",
        ],
        changing: &["q + p*t", "p^a*q"],
        jumping: &[
            "p + atan(1/(q - 100000)) + atan(q - 100000)",
            "abs(q)/q",
            "q*sqrt(1/q^2)",
            "abs(q - a)/(q - a)",
            "abs(q^2 - a)/(q^2 - a)",
            "atan(tan(q)) - q",
            "exp(-ln(abs(q)))*q",
        ],
    },
    System {
        names: ["q; p", "", "a b"],
        h: "p^2/2 + abs(q^a)",
        conserved: &["p^2/2 + abs(q^a)"],
        changing: &["p^2/2 + q^a", "p^2/2 + abs(q)^(2*a)"],
        jumping: &[],
    },
    System {
        names: ["q; p", "", "a b"],
        h: "p^2/2 + (q^a)^b",
        conserved: &["p^2 + 2*(q^a)^b"],
        changing: &["p^2/2 + q^(a*b)"],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v", "", "a"],
        h: "(u^2 + v^2)/2 + (x^2 + y^2)^a + abs(x^2 + y^2)^(a/2)",
        conserved: &["x*v - y*u"],
        changing: &["x*v + y*u"],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v; t", "", "b"],
        h: "((u + b*y/2)^2 + (v - b*x/2)^2)/2",
        conserved: &["u - b*y/2", "v + b*x/2", "x*v - y*u"],
        changing: &["u + b*y/2"],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v", "", ""],
        h: "u^2/2 + v^2/2 + if x < 1 { 0 } else { (x - 1)^2 }",
        conserved: &["v", "u^2 + 2*max(x - 1, 0)^2"],
        changing: &["u"],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v", "", ""],
        h: "u^2/2 + v^2/2 + if x < 1 { 0 } else { 2 }",
        conserved: &[],
        changing: &["y"],
        jumping: &["u", "u^2/2 + v^2/2"],
    },
    System {
        names: ["q[3]; p[3]", "", "g"],
        h: "sum(i in 0..3) { p[i]^2/2 } + sum(i in 0..3, j in 0..i) { g/(q[i] - q[j])^2 }",
        conserved: &[
            "p[0] + p[1] + p[2]",
            "sum(i in 0..3) { p[i]^3/3 } + sum(i in 0..3, j in 0..i) { g*(p[i] + p[j])/(q[i] - q[j])^2 }",
        ],
        changing: &[
            "sum(i in 0..3) { p[i]^3/3 } - sum(i in 0..3, j in 0..i) { g*(p[i] + p[j])/(q[i] - q[j])^2 }",
        ],
        jumping: &[],
    },
    System {
        names: ["x, y; u, v", "", ""],
        h: "(u^2 + v^2 + x^2 + y^2)/2",
        conserved: &["u*v + x*y", "u^2 + x^2", "x*v - y*u"],
        changing: &["u*v - x*y", "u^2 - x^2"],
        jumping: &["(u^2 + x^2)*abs(y)/y"],
    },
    System {
        names: ["q; p; t", "", "g"],
        h: "p^2/2 + g*q",
        conserved: &["p + g*t", "q - p*t - g*t^2/2"],
        changing: &["p - g*t"],
        jumping: &[],
    },
    System {
        names: ["q; p; t", "", "g"],
        h: "exp(-g*t)*p^2/2 + exp(g*t)*q^2/2",
        conserved: &["exp(-g*t)*p^2 + exp(g*t)*q^2 + g*q*p"],
        changing: &["exp(-g*t)*p^2 + exp(g*t)*q^2 - g*q*p"],
        jumping: &[],
    },
];

/// Pieces of H that add up to it, and that do not.
const SPLITS: &[([&str; 4], &str, bool)] = &[
    (["q; p", "", "", "p^2/2 - cos(q)"], "p^2/2; -cos(q)", true),
    (
        ["q; p", "", "", "p^2/2 - cos(q)"],
        "p^2/2; 2*sin(q/2)^2 - 1",
        true,
    ),
    (["q; p", "", "", "p^2/2 - cos(q)"], "p^2/2; cos(q)", false),
    (
        ["q; p", "", "a b", "p^2/2 + (q^2)^a"],
        "p^2/2; abs(q)^(2*a)",
        true,
    ),
    (
        ["q; p", "", "a b", "p^2/2 + (q^2)^a"],
        "p^2/2; q^(2*a)",
        false,
    ),
    (
        ["q; p", "", "a b", "p^2/2 + exp(q)^a*exp(q)^b"],
        "p^2/2; exp(q)^(a + b)",
        true,
    ),
    (
        ["q; p", "", "a b", "p^2/2 + abs(a^b)*q"],
        "p^2/2; a^b*q",
        false,
    ),
    (
        ["q; p", "", "", "p^2/2 + exp(ln(abs(q)))"],
        "p^2/2; abs(q)",
        true,
    ),
    (
        ["q; p", "", "", "p^2/2 + exp(ln(abs(q)))"],
        "p^2/2; q",
        false,
    ),
    (
        ["q; p", "", "", "p^2/2 + (q^5)^(1/5)"],
        "p^2/2; abs(q)",
        true,
    ),
    (
        [
            "q[N]; p[N]",
            "N",
            "b[N]",
            "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { b[i] }",
        ],
        "sum(i in 0..N) { p[i]^2/2 }; sum(i in 1..N) { b[i - 1] }",
        true,
    ),
    (
        [
            "q[N]; p[N]",
            "N",
            "b[N]",
            "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { b[i] }",
        ],
        "sum(i in 0..N) { p[i]^2/2 }; sum(i in 1..N) { b[i] }",
        false,
    ),
    (
        [
            "q[N]; p[N]",
            "N",
            "",
            "sum(i in 0..N) { p[i]^2/2 + q[i]*q[(i + 1) % N] }",
        ],
        "sum(i in 0..N) { p[(i + 2) % N]^2/2 }; sum(i in 0..N) { q[(i + 1) % N]*q[(i + 2) % N] }",
        true,
    ),
];

/// Systems with T(p) + V(q), and without.
const SEPARABLE: &[([&str; 4], bool)] = &[
    (["q; p", "", "", "(p + q)^2 - 2*p*q"], true),
    (
        ["q; p", "", "", "p^2/2 + sin(p + q)^2 + cos(p + q)^2"],
        true,
    ),
    (["q; p", "", "", "ln(exp(p)*exp(q^2))"], true),
    (["q; p", "", "", "(q^2 + 1)*(p^2 + 1)/2"], false),
    (["q; p", "", "", "(p + q)^3"], false),
    (
        [
            "q[N]; p[N]",
            "N",
            "",
            "sum(i in 0..N) { (p[i] + q[i])^2/2 - p[i]*q[i] }",
        ],
        true,
    ),
    (
        [
            "q[N]; p[N]",
            "N",
            "",
            "sum(i in 0..N) { p[i]*q[(i + 1) % N] }",
        ],
        false,
    ),
];

#[test]
fn statements_are_decided() {
    let (mut right, mut wrong) = (0, 0);
    let mut failures = Vec::new();
    for System {
        names: [signature, sizes, parameters],
        h,
        conserved,
        changing,
        jumping,
    } in SYSTEMS
    {
        let verdict = |claim: &str| {
            let mut model = system(signature, sizes, parameters, h);
            let node = parse(&mut model, claim);
            is_invariant(&model, node, None)
        };
        let mut expect = |claims: &[&str], is: fn(&Verdict) -> bool| {
            for claim in claims {
                let found = verdict(claim);
                if !is(&found) {
                    failures.push(format!("{h} | {claim}: {found:?}"));
                }
            }
            claims.len()
        };
        right += expect(conserved, Verdict::is_proven);
        wrong += expect(changing, |v| matches!(v, Verdict::Disproven { .. }));
        wrong += expect(jumping, |v| matches!(v, Verdict::Jumps { .. }));
    }
    for ([signature, sizes, parameters, h], pieces, is_whole) in SPLITS {
        let mut model = system(signature, sizes, parameters, h);
        let pieces: Vec<_> = pieces
            .split(';')
            .map(|piece| parse(&mut model, piece))
            .collect();
        let found = check_split(&mut model, &pieces);
        let is_decided = match &found {
            Ok(()) => *is_whole,
            Err(difference) => !is_whole && difference.point.is_some(),
        };
        if !is_decided {
            failures.push(format!("{h} = {pieces:?}: {found:?}"));
        }
        *(if *is_whole { &mut right } else { &mut wrong }) += 1;
    }
    for ([signature, sizes, parameters, h], is_separable) in SEPARABLE {
        let mut model = system(signature, sizes, parameters, h);
        let found = analyse(&mut model).separable;
        if found.is_ok() != *is_separable {
            failures.push(format!("{h}: {found:?}"));
        }
        *(if *is_separable {
            &mut right
        } else {
            &mut wrong
        }) += 1;
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(right >= 60 && wrong >= 60, "{right} true, {wrong} false");
}
