//! Splits that are true and of known flows are accepted, from one piece to eight, in the variables of charts, of sums of
//! sums; those beside them are refused.
//!
//! Input: definitions. Output: a panic with those that are judged otherwise. Invariant: a refusal is one of the proof or
//! of the search for flows, with its words.

use super::accepted::DEFINITIONS;
use super::builds::built;
use super::docs::docs;
use super::{Stage, refuse};
use hamiltonian_language::analyse::splits::WORDS;
use hamiltonian_symbolic::split;
use std::path::Path;

const ACCEPTED: &[&str] = &[
    // Three to eight pieces.
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4 + x*y; split { A = u^2/2 + v^2/2; B = x^4 + y^4; C = x*y }",
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4; split { A = u^2/2; B = v^2/2; C = x^4; D = y^4 }",
    "struct A {} H(x, y; u, v) = u^2/2 + v^2/2 + x^4 + y^4 + x*y; split { A = u^2/2; B = v^2/2; C = x^4; D = y^4; E = x*y }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4 }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z }",
    "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z + x*v - y*u;
     split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z; Turn = x*v - y*u }",
    // In the variables of charts.
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 - k/sqrt(x^2 + y^2) + (x^2 + y^2)^2; coordinates polar(x, y);
     split { Free = p_r^2/2 + p_phi^2/(2*r^2); Bound = -k/r + r^4 }",
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 + k*x; coordinates polar(x, y);
     split { Free = p_r^2/2 + p_phi^2/(2*r^2); Fall = k*r*cos(phi) }",
    "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 + k*x; coordinates polar(x, y);
     split { Free = (px^2 + py^2)/2; Fall = k*x }",
    "struct A {g} H(q[3]; p[3]) = norm_squared(p)/2 + g*q[2]; coordinates spherical(q);
     split { Free = p_r^2/2 + p_theta^2/(2*r^2) + p_phi^2/(2*r^2*sin(theta)^2); Fall = g*r*cos(theta) }",
    "struct A {g} H(x, y, z; px, py, pz) = (px^2 + py^2 + pz^2)/2 + g*z*(x^2 + y^2); coordinates polar(x, y);
     split { Plane = p_r^2/2 + p_phi^2/(2*r^2); Along = pz^2/2; V = g*z*r^2 }",
    "struct A {k} H(x, y, a, b; px, py, pa, pb) = (px^2 + py^2 + pa^2 + pb^2)/2 + k*(x*a + y*b);
     coordinates polar(x, y); coordinates polar(a, b);
     split { One = p_r^2/2 + p_phi^2/(2*r^2); Two = p_r_2^2/2 + p_phi_2^2/(2*r_2^2); V = k*r*r_2*cos(phi - phi_2) }",
    // Sums of sums of flows.
    "struct A {n: usize, k: usize, m: [n], e = 0.1}
     H(q[n][3], w[k][3]; p[n][3], u[k][3]) = sum(i in 0..n) { norm_squared(p[i])/2 - m[i]/norm(q[i]) }
       + sum(i in 0..k) { norm_squared(u[i])/2 - 1/norm(w[i]) } + e*sum(i in 0..n, j in 0..k) { dot(q[i], w[j]) };
     split {
         Kepler = sum(i in 0..n) { norm_squared(p[i])/2 - m[i]/norm(q[i]) } + sum(i in 0..k) { norm_squared(u[i])/2 - 1/norm(w[i]) };
         V = e*sum(i in 0..n, j in 0..k) { dot(q[i], w[j]) };
     }",
    "struct A<const N: usize> {k: [N]}
     H(q[N], w[N]; p[N], u[N]) = sum(i in 0..N) { (p[i]^2 + k[i]*q[i]^2)/2 + (u[i]^2 + w[i]^2)/2 + q[i]^2*w[i]^2 };
     split {
         Turns = sum(i in 0..N) { (p[i]^2 + k[i]*q[i]^2)/2 } + sum(i in 0..N) { (u[i]^2 + w[i]^2)/2 };
         V = sum(i in 0..N) { q[i]^2*w[i]^2 };
     }",
    // On one array: the lower part and the upper part, the even and the odd sites, the first one alone.
    "struct A {n: usize}
     H(q[2*n]; p[2*n]) = sum(i in 0..2*n) { (p[i]^2 + q[i]^2)/2 } + sum(i in 0..2*n) { q[i]^4 };
     split {
         Turns = sum(i in 0..n) { (p[i]^2 + q[i]^2)/2 } + sum(i in n..2*n) { (p[i]^2 + q[i]^2)/2 };
         V = sum(i in 0..2*n) { q[i]^4 };
     }",
    "struct A {n: usize}
     H(q[2*n]; p[2*n]) = sum(i in 0..n) { p[2*i]^2/2 - cos(q[2*i]) + p[2*i + 1]^2/2 + 2*q[2*i + 1]^2 } + sum(i in 0..n) { q[2*i]*q[2*i + 1] };
     split {
         Both = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[2*i + 1]^2/2 + 2*q[2*i + 1]^2 };
         V = sum(i in 0..n) { q[2*i]*q[2*i + 1] - cos(q[2*i]) - q[2*i]^2/2 };
     }",
    "struct A {n: usize}
     H(q[n][3]; p[n][3]) = norm_squared(p[0])/2 - 2/norm(q[0]) + sum(i in 1..n) { norm_squared(p[i])/2 - 1/norm(q[i]) } + sum(i in 0..n) { q[i][0] };
     split {
         Kepler = norm_squared(p[0])/2 - 2/norm(q[0]) + sum(i in 1..n) { norm_squared(p[i])/2 - 1/norm(q[i]) };
         V = sum(i in 0..n) { q[i][0] };
     }",
    // Fixed points of the flows of single monomials.
    "struct A {a, b, c} H(q; p) = (a*q^2 + b*q^3 + c*q^4)*p^2 + q^2; split { A = (a*q^2 + b*q^3 + c*q^4)*p^2; B = q^2 }",
    "struct A {a} H(q; p) = a*q^3*p + q^2; split { A = a*q^3*p; B = q^2 }",
];

const REFUSED: &[(&str, &str)] = &[
    (
        "struct A {k} H(x, y; px, py) = (px^2 + py^2)/2 - k/sqrt(x^2 + y^2); coordinates polar(x, y);
         split { Free = p_r^2/2 + p_phi^2/r^2; Bound = -k/r }",
        "do not add up",
    ),
    (
        "struct A {k} H(x, y, a, b; px, py, pa, pb) = (px^2 + py^2 + pa^2 + pb^2)/2 + k*(x*a + y*b);
         coordinates polar(x, y); coordinates polar(a, b);
         split { One = p_r^2/2 + p_phi^2/(2*r^2); Two = p_r_2^2/2 + p_phi_2^2/(2*r_2^2); V = k*r*r_2*cos(phi + phi_2) }",
        "do not add up",
    ),
    (
        "struct A {n: usize}
         H(q[n]; p[n]) = sum(i in 0..n) { (p[i]^2 + q[i]^2)/2 } + sum(i in 0..n) { q[i]^4 };
         split { Turns = sum(i in 1..n) { (p[i]^2 + q[i]^2)/2 }; V = sum(i in 0..n) { q[i]^4 } }",
        "do not add up",
    ),
    // Overlapping sums do not commute.
    (
        "struct A {n: usize}
         H(q[2*n]; p[2*n]) = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[i]^2/2 - 1/q[i]^2 } + q[0];
         split { V = q[0]; All = sum(i in 0..n) { (p[2*i]^2 + q[2*i]^2)/2 } + sum(i in 0..n) { p[i]^2/2 - 1/q[i]^2 } }",
        "no exact flow",
    ),
    (
        "struct A {} H(x, y, z; u, v, w) = u^2/2 + v^2/2 + w^2/2 + x^4 + y^4 + z^4 + x*y*z + x*v - y*u + y*w - z*v;
         split { A = u^2/2; B = v^2/2; C = w^2/2; D = x^4; E = y^4; F = z^4; G = x*y*z; Turn = x*v - y*u; More = y*w - z*v }",
        "more than 8",
    ),
];

#[test]
fn pieces_are_accepted_or_refused_for_a_reason() {
    let errors = |source: &str| -> Vec<String> {
        let errors = refuse(source).1;
        errors.iter().map(|error| error.text()).collect()
    };
    let refused = ACCEPTED.iter().map(|source| (source, errors(source)));
    let refused: Vec<_> = refused.filter(|(_, errors)| !errors.is_empty()).collect();
    assert!(refused.is_empty(), "{refused:#?}");
    for (source, reason) in REFUSED {
        let (stage, _) = refuse(source);
        let errors = errors(source);
        let is_said = errors.iter().any(|error| error.contains(reason));
        assert!(
            is_said && stage == Some(Stage::Prove),
            "{source}: {errors:#?}"
        );
    }
}

/// The formulas of the pieces of the type that a definition declares, in their order.
fn formulas(source: &str) -> Vec<String> {
    formulas_in(&built(source).unwrap_or_else(|errors| panic!("{source}: {errors:?}")))
}

/// The same from emitted code.
fn formulas_in(code: &str) -> Vec<String> {
    // Pieces as systems of their own stand before it.
    let described = code.split("described !").last().expect("a description");
    let pieces = described.split(":: piece (").skip(1);
    let formula = |piece: &str| piece.split('"').nth(3).expect("a formula").to_owned();
    pieces.map(formula).collect()
}

/// The definitions of item form in the files of a folder of the workspace.
fn definitions_in(folder: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .join(folder);
    let mut found = Vec::new();
    let files = std::fs::read_dir(folder).expect("a folder").flatten();
    let mut files: Vec<_> = files.map(|file| file.path()).collect();
    files.sort();
    for file in files
        .iter()
        .filter(|file| file.extension().is_some_and(|end| end == "rs"))
    {
        let text = std::fs::read_to_string(file).expect("a text");
        for after in text.split("hamiltonian! {").skip(1) {
            let mut depth = 1;
            let end = after.find(|c: char| {
                depth += i32::from(c == '{') - i32::from(c == '}');
                depth == 0
            });
            let definition = &after[..end.unwrap_or(0)];
            if definition.contains("struct ") && !definition.contains('$') {
                found.push(definition.to_owned());
            }
        }
    }
    found
}

/// A definition with the statement that its documentation shows, or nothing if it shows none.
fn pasted(source: &str) -> Option<String> {
    let docs = docs(source);
    let (_, statement) = docs.split_once("```text\nsplit {")?;
    let statement = statement.split("```").next().unwrap_or_default();
    let source = source.trim_end().trim_end_matches(';');
    Some(format!("{source};\nsplit {{{statement}"))
}

/// Definitions whose statement is right, and beyond a limit of the proofs or of the search among declared pieces.
const LIMITS: [(&str, &str); 2] = [
    ("struct Columns<", "is of no known closed form"),
    ("struct Held ", "it is neither proven nor disproven"),
];

/// Pastes the pieces of these definitions into them. Returns how many have pieces that are shown, the errors, and the
/// names of the definitions that a limit refuses.
fn paste(sources: &[String]) -> (usize, Vec<String>, Vec<&'static str>) {
    let (mut count, mut wrong, mut limited) = (0, Vec::new(), Vec::new());
    for source in sources {
        let Ok(code) = built(source) else { continue };
        let shown = code.contains("Another version may find");
        let Some(pasted) = shown.then(|| pasted(source)).flatten() else {
            continue;
        };
        count += 1;
        let found = formulas_in(&code);
        match built(&pasted).map(|code| formulas_in(&code)) {
            Err(errors) => match LIMITS.iter().find(|(name, _)| source.contains(name)) {
                Some((name, why)) if errors[0].0.contains(why) => limited.push(*name),
                _ => wrong.push(format!("{pasted}: {errors:?}")),
            },
            Ok(other) if other != found => {
                wrong.push(format!("{pasted}: {other:?}, not {found:?}"))
            }
            Ok(_) => {}
        }
    }
    (count, wrong, limited)
}

/// The documentation of a definition whose pieces were found shows them as a statement. With it the definition is
/// accepted, and has the same pieces in the same order.
#[test]
fn the_pieces_of_the_documentation_can_be_pasted() {
    let mut sources: Vec<String> = DEFINITIONS.iter().map(|one| (*one).to_owned()).collect();
    sources.extend(
        ["examples", "benches", "tests", "tests/flows"]
            .iter()
            .flat_map(|folder| definitions_in(folder)),
    );
    sources.retain(|source| source.contains("struct "));
    let (first, second) = sources.split_at(sources.len() / 2);
    let halves = std::thread::scope(|scope| {
        let first = scope.spawn(|| paste(first));
        let second = paste(second);
        [first.join().expect("no panic"), second]
    });
    let count = halves.iter().map(|half| half.0).sum::<usize>();
    let wrong: Vec<_> = halves.iter().flat_map(|half| &half.1).cloned().collect();
    let limited: Vec<_> = halves.iter().flat_map(|half| half.2.clone()).collect();
    assert!(count > 50, "{count} definitions");
    assert!(
        wrong.is_empty(),
        "{} of {count}:\n{}",
        wrong.len(),
        wrong.join("\n\n")
    );
    assert_eq!(
        limited,
        LIMITS.map(|(name, _)| name),
        "an exception that is none"
    );
}

/// Pieces in another order, and a statement that is none of H, are found.
#[test]
fn other_pieces_are_found() {
    let source = "struct A {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2";
    let pasted = pasted(source).expect("pieces");
    assert_eq!(formulas(&pasted), formulas(source));
    let turned = pasted.replace("First", "Last").replace("Second", "First");
    assert_eq!(formulas(&turned), formulas(source), "names are free");
    let (first, second) = ("First = p^2/2 + 0.5;", "Second = 0.5*q^2*p^2 + q^2/2;");
    let swapped = pasted
        .replace(first, "")
        .replace(second, &format!("{second} {first}"));
    assert_ne!(formulas(&swapped), formulas(source));
    assert!(built(&pasted.replace("0.5*q^2*p^2", "q^2*p^2")).is_err());
}

#[test]
fn each_form_with_an_exact_flow_has_words() {
    let forms = split::FORMS.iter().map(|form| form.name);
    let words = WORDS.iter().map(|(name, _)| *name);
    assert!(forms.eq(words));
}
