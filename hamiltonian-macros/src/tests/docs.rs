//! The documentation of a generated type.

use crate::expand::expand;
use crate::tests::unmarked;
use proc_macro2::TokenStream;
use std::str::FromStr;

/// The documentation of the type a definition declares.
pub(super) fn docs(source: &str) -> String {
    let source = format!("(::hamiltonian) {}", unmarked(source).0);
    let code = expand(TokenStream::from_str(&source).unwrap());
    let file: syn::File = syn::parse2(code).unwrap();
    let of_struct = file.items.into_iter().find_map(|item| match item {
        syn::Item::Struct(item) => Some(item.attrs),
        _ => None,
    });
    let mut text = String::new();
    for attribute in of_struct.expect("the definition is of item form and right") {
        if let syn::Meta::NameValue(pair) = attribute.meta
            && pair.path.is_ident("doc")
            && let syn::Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Str(line),
                ..
            }) = pair.value
        {
            text.push_str(&line.value());
            text.push('\n');
        }
    }
    text
}

/// A section of the documentation, by its heading.
fn section(docs: &str, heading: &str) -> String {
    let start = docs.find(&format!("# {heading}\n")).expect(heading);
    let rest = &docs[start + heading.len() + 3..];
    rest[..rest.find("\n# ").unwrap_or(rest.len())]
        .trim()
        .to_owned()
}

/// The text of a section, between its fences.
fn text_of(docs: &str, heading: &str) -> String {
    let section = section(docs, heading);
    let (_, from) = section.split_once("```text\n").expect(heading);
    from.split("\n```").next().unwrap_or_default().to_owned()
}

/// The rows of the table of operations.
fn operations(source: &str) -> Vec<String> {
    let docs = docs(source);
    let section = section(&docs, "Operations");
    let rows = section.lines().filter(|line| line.starts_with('|'));
    rows.skip(2).map(str::to_owned).collect()
}

const PENDULUM: &str = "pub struct Pendulum { m = 1, l = 10, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)";

const GRAVITY: &str = "pub struct Gravity { n: usize, G = 1, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }";

#[test]
fn operations_of_a_pendulum() {
    assert_eq!(
        operations(PENDULUM),
        [
            "| `energy` | 4 | 0 | 0 | 1 | 5 |",
            "| `gradient` | 2 | 0 | 0 | 1 | 3 |",
            "| `energy_and_gradient` | 6 | 0 | 0 | 1 | 7 |",
        ]
    );
}

#[test]
fn operations_of_a_loop() {
    let toda = "pub struct Toda<const N: usize> {}
        H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }";
    assert_eq!(
        operations(toda),
        [
            "| `energy` | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..N | 5 | 0 | 0 | 1 | 6 |",
            "| kick | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..N | 4 | 0 | 0 | 1 | 5 |",
            "| drift | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..N | 2 | 0 | 0 | 0 | 2 |",
            "| `energy_and_gradient` | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..N | 7 | 0 | 0 | 1 | 8 |",
        ]
    );
}

#[test]
fn operations_of_nested_loops() {
    assert_eq!(
        operations(GRAVITY),
        [
            "| `energy` | 3 | 0 | 0 | 0 | 3 |",
            "| each i in 0..n | 9 | 0 | 0 | 0 | 9 |",
            "| each i in 0..n, j in 0..i | 9 | 1 | 1 | 0 | 11 |",
            "| kick | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..n | 4 | 0 | 0 | 0 | 4 |",
            "| each i in 0..n, j in 0..i | 20 | 1 | 1 | 0 | 22 |",
            "| drift | 0 | 0 | 0 | 0 | 0 |",
            "| each i in 0..n | 7 | 0 | 0 | 0 | 7 |",
            "| `energy_and_gradient` | 3 | 0 | 0 | 0 | 3 |",
            "| each i in 0..n | 16 | 0 | 0 | 0 | 16 |",
            "| each i in 0..n, j in 0..i | 22 | 1 | 1 | 0 | 24 |",
        ]
    );
}

/// The number in the docs is the one `#[max_ops]` is held against.
#[test]
fn the_limit_is_what_the_docs_say() {
    for source in [PENDULUM, GRAVITY] {
        let rows = operations(source);
        let from = rows
            .iter()
            .position(|row| row.contains("`energy_and_gradient`"))
            .unwrap();
        let together = |row: &String| {
            let last = row.trim_end_matches(" |").rsplit(' ').next();
            last.and_then(|number| number.parse::<u32>().ok()).unwrap()
        };
        let count: u32 = rows[from..].iter().map(together).sum();
        let code = |most: u32| {
            let source = format!("(::hamiltonian) #[max_ops = {most}] {source}");
            expand(TokenStream::from_str(&source).unwrap()).to_string()
        };
        assert!(!code(count).contains("compile_error"));
        assert!(code(count - 1).contains(&format!("needs {count} operations")));
    }
}

#[test]
fn structure() {
    let facts = |source: &str| -> Vec<String> {
        let docs = docs(source);
        let section = section(&docs, "Hamiltonian");
        let after = section.splitn(3, "```").nth(2).unwrap();
        let lines = after.lines().filter(|line| !line.is_empty());
        let facts = lines.take_while(|line| !line.starts_with("Another version"));
        facts.map(str::to_owned).collect()
    };
    assert_eq!(
        facts(PENDULUM),
        [
            "H is separable, and its kinetic part is a quadratic form of the momenta.",
            "H does not depend on time: it is conserved.",
        ]
    );
    assert_eq!(
        facts("struct A {} H(x, y; p_x, p_y; t) = p_x^4 + p_y^2 + x^2*cos(t)"),
        [
            "H is separable.",
            "H depends on time: the term `x^2*cos(t)` depends on `t`.",
            "`y` does not appear in H: `p_y` is conserved.",
        ]
    );
    assert_eq!(
        facts(
            "struct A<const N: usize> { a = 1 }
             H(q[N]; p[N]; t) = sum(i in 0..N) { p[i]^2/2 + (q[i]^4 + a*(q[i] + i*cos(t))) }"
        )[1],
        "H depends on time: the term `i*cos(t)` depends on `t`."
    );
    assert_eq!(
        facts("struct A {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2"),
        [
            "H is not separable: see the term `0.5*q^2*p^2`.",
            "H does not depend on time: it is conserved.",
            "H is split into 2 pieces with exact flows, outermost first: `p^2/2 + 0.5`; `0.5*q^2*p^2 + q^2/2` (f(q)·p²).",
            "This splitting was chosen among 12 by its error times its cost: H is off by at most 1.4e-2 in short runs of second order with step 0.1 near unit size.",
        ]
    );
    assert_eq!(
        facts("struct A {} H(q; p) = p^2/(2*(1 + q^2))")
            .last()
            .map(String::as_str),
        Some(
            "H is not split into exact flows: no exact flow is known for the term `p^2/(2*(q^2 + 1))`."
        )
    );
}

/// H of a Lagrangian with its determinant by name; forces in velocities.
#[test]
fn a_lagrangian_reads_well() {
    let docs = docs(
        "struct Cart { m = 1, M = 2, l = 1, g = 9.81 }
         L(x, theta; v, w) = (m + M)*v^2/2 + m*l*v*w*cos(theta) + m*l^2*w^2/2 + m*g*l*cos(theta)",
    );
    assert!(text_of(&docs, "Hamiltonian").starts_with(
        "let D = m + M - m*cos(theta)^2;
H(x, theta; p_x, p_theta) = (m*l^2*p_x^2 - 2*m*l*p_x*p_theta*cos(theta) + (m + M)*p_theta^2)/(2*m*l^2*D) - m*g*l*cos(theta)"
    ));
    assert_eq!(
        text_of(&docs, "Equations of motion"),
        "dx/dt = (l*p_x - p_theta*cos(theta))/(l*D)
dtheta/dt = ((m + M)*p_theta - m*l*p_x*cos(theta))/(m*l^2*D)
dp_x/dt = 0
dp_theta/dt = -(m*g*l + m*l*v*w)*sin(theta)
where v = dx/dt
where w = dtheta/dt"
    );
    let latex = text_of(&docs, "LaTeX");
    assert!(
        latex.contains(r",\quad D = m + M - m \cos^{2}(\theta)"),
        "{latex}"
    );
    assert!(
        latex.ends_with("w = \\frac{\\mathrm{d} \\theta}{\\mathrm{d} t}"),
        "{latex}"
    );
}

/// Formulas are MathML, and their text and LaTeX open on demand; long ones are text alone.
#[test]
fn formulas_are_set() {
    let pendulum = docs(PENDULUM);
    let hamiltonian = section(&pendulum, "Hamiltonian");
    assert!(
        hamiltonian.starts_with(
            "<div style=\"overflow:auto hidden;padding:.3em 0 .8em\">\n<math display=\"block\">\n<mi>H</mi><mo>=</mo><mfrac>"
        ),
        "{hamiltonian}"
    );
    let equations = section(&pendulum, "Equations of motion");
    assert_eq!(equations.matches("<mtr>").count(), 2, "{equations}");
    assert!(
        equations.contains("</math>\n</div>\n\n<details><summary>As text</summary>\n\n```text\n")
    );
    assert!(section(&pendulum, "LaTeX").starts_with("<details>"));
    for tag in ["math", "mtable", "details", "mfrac", "msup", "mrow", "mtd"] {
        let (open, close) = (format!("<{tag}"), format!("</{tag}>"));
        let starts = pendulum.match_indices(&open).filter(|(at, _)| {
            let after = pendulum[at + open.len()..].chars().next();
            matches!(after, Some('>' | ' '))
        });
        assert_eq!(starts.count(), pendulum.matches(&close).count(), "{tag}");
    }
    // No empty line ends a block of HTML early.
    for block in pendulum.split("<math").skip(1) {
        let inner = block.split("</math>").next().unwrap_or_default();
        assert!(!inner.contains("\n\n"), "{inner}");
    }
    let terms: Vec<String> = (1..400).map(|k| format!("{k}/7*cos({k}*q)")).collect();
    let long = docs(&format!(
        "pub struct Long {{}} H = p^2/2 + {}",
        terms.join(" + ")
    ));
    assert!(!long.contains("<math"));
    assert!(
        section(&long, "Hamiltonian")
            .starts_with("<details><summary>H as text</summary>\n\n```text")
    );
    assert!(hamiltonian.contains("</div>\n\n```text\nH(theta; p) = "));
    // Many lines of text open on demand too.
    let masses: Vec<String> = (0..13).map(|k| format!("p{k}^2/(2*m{k})")).collect();
    let terms: Vec<String> = (1..400).map(|k| format!("{k}/7*cos({k}*q0)")).collect();
    let names = |letter: char| {
        (0..13)
            .map(|k| format!("{letter}{k}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let many = docs(&format!(
        "pub struct Many {{ {} }} H({}; {}) = {} + {}",
        names('m').replace(", ", " = 1, ") + " = 1",
        names('q'),
        names('p'),
        masses.join(" + "),
        terms.join(" + "),
    ));
    let equations = section(&many, "Equations of motion");
    assert!(
        equations.starts_with("<details><summary>Each variable</summary>"),
        "{equations}"
    );
}

/// rustdoc shows the first line in lists of types.
#[test]
fn a_summary_comes_first() {
    let first = |source: &str| docs(source).lines().next().unwrap_or_default().to_owned();
    let plain = "pub struct Spring {} H = (p^2 + q^2)/2";
    let own = "The Hamiltonian system `Spring`.";
    assert_eq!(first(plain), own);
    for attribute in [
        "#[derive(PartialEq)]",
        "#[must_use]",
        "#[non_exhaustive] #[allow(dead_code)]",
    ] {
        assert_eq!(first(&format!("{attribute} {plain}")), own);
    }
    let text = " A spring.";
    assert_eq!(
        first(&format!("#[must_use] #[doc = \"{text}\"] {plain}")),
        text
    );
    assert_eq!(first(&format!("///{text}\n {plain}")), text);
}

#[test]
fn equations_are_said_to_contain_the_force() {
    let damped = docs("pub struct Damped { c = 0.1 } H = p^2/2 + q^2/2; force(q; p) = -c*p");
    let equations = section(&damped, "Equations of motion");
    assert!(equations.contains("dp/dt = -q - c*p"), "{equations}");
    assert!(equations.contains("The declared force is in these equations."));
    assert!(!docs(PENDULUM).contains("force"));
}

#[test]
fn a_vector_that_is_read_by_number_has_an_equation_for_each_element() {
    let planet = docs(
        "pub struct Planet { c = 0.1 } H(q[3]; p[3]) = norm_squared(p)/2 - 1/norm(q); force(q; p) = -c*p",
    );
    let equations = section(&planet, "Equations of motion");
    for row in 0..3 {
        let gravity = format!("-q[{row}]/sqrt(q[0]^2 + q[1]^2 + q[2]^2)^3");
        let equation = format!("dp[{row}]/dt = {gravity} - c*p[{row}]\n");
        assert!(equations.contains(&equation), "{equations}");
    }
    assert!(!section(&planet, "LaTeX").contains("cases"));
    let shot = docs(
        "pub struct Shot { g = 9.81, c = 0.1 } H(q[3]; p[3]) = norm_squared(p)/2 + g*q[2];
        force(q[i]; p[i]) = -c*p[i]",
    );
    let equations = section(&shot, "Equations of motion");
    assert!(
        equations.contains("dp[1]/dt = -c*p[1]\ndp[2]/dt = -g - c*p[2]\n"),
        "{equations}"
    );
    // One element of many is a condition in one equation.
    let held = docs(
        "pub struct Held {} H(q[9]; p[9]) = norm_squared(p)/2 + q[0]^2/2 + sum(i in 0..9) { q[i]^4/4 }",
    );
    let equations = section(&held, "Equations of motion");
    assert!(equations.contains("dp[k]/dt = "), "{equations}");
}

#[test]
fn equations_in_another_time_are_in_that_time() {
    let sundman = docs(
        "pub struct Sundman {} let r = hypot(x, y);
        H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/r; dt = r*ds",
    );
    let equations = section(&sundman, "Equations of motion");
    assert!(equations.contains("dx/ds = "), "{equations}");
    assert!(equations.contains("dt/ds = hypot(x, y)\n"), "{equations}");
    assert!(!equations.contains("/dt"), "{equations}");
    // If s is a coordinate, the new time has another name.
    let lagrangian = docs("pub struct Bead {} L(s; v) = v^2/2 - s^2/2; dt = (1 + s^2)*ds");
    let equations = section(&lagrangian, "Equations of motion");
    assert!(equations.contains("ds/ds_2 = "), "{equations}");
    assert!(!equations.contains("/dt"), "{equations}");
    let latex = section(&lagrangian, "LaTeX");
    assert!(latex.contains(r"{\mathrm{d} s_{2}}"), "{latex}");
}

/// The code of a definition.
fn code(source: &str) -> String {
    let source = format!("(::hamiltonian) {}", unmarked(source).0);
    expand(TokenStream::from_str(&source).unwrap()).to_string()
}

#[test]
fn an_invariant_says_where_it_has_values() {
    let code = code(
        "pub struct Well { a = 2 }
        H(q; p) = p^2/2 + 1/q^2;
        invariant side = sign(q);
        invariant power = (p^2 + 2/q^2)^a;
        invariant log = ln(p^2/2 + 1/q^2 - 3)",
    );
    assert_eq!(code.matches("Conserved where").count(), 1, "{code}");
    let said = "Conserved where H has values and `p^2/2 + 1/q^2 - 3` > 0.";
    assert!(code.contains(said), "{code}");
}

/// The documentation of an invariant says what its proof rests on beside its derivative.
#[test]
fn an_invariant_says_how_it_is_proven() {
    let method = |source: &str| {
        let code = code(source);
        let (docs, _) = code
            .split_once("pub fn kept")
            .expect("the method of the invariant");
        docs[docs.rfind("pub fn").unwrap_or(0)..].to_owned()
    };
    for (definition, said) in [
        (
            "pub struct A {} H(q; p) = p^2/2 + 1/q^2; invariant kept = sign(q)",
            "It holds where H is finite: it is infinite at `q` = 0, where no orbit comes.",
        ),
        (
            "pub struct A<const N: usize> {} H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + 1/q[i]^2 };
             invariant kept = sum(i in 0..N) { sign(q[i]) }",
            "it is infinite at `q[i]` = 0 (i in 0..N), where no orbit comes.",
        ),
        (
            "pub struct A {} H(x, y; u, v) = (u^2 + v^2)/2; invariant kept = sign(x*v - y*u)",
            "No orbit crosses a level of `x*v - y*u`.",
        ),
        (
            "pub struct A {} H(q; p) = p^2/2; invariant kept = (max(q - 5, 0) - max(5 - q, 0))/(q - 5)",
            "Orbits may cross `q - 5` = 0, where both sides agree.",
        ),
        (
            "pub struct A {} H(x, y; p, u) = (p^2 + u^2)/2 + sign(x); invariant kept = u",
            "Orbits may cross the steps of H at `x` = 0.",
        ),
        (
            "pub struct A {} fn V(x) = well; fn W(x) = well; H(q, x; p, u) = (p^2 + u^2)/2 + 1/V(q)^2 + W(x);
             invariant kept = sign(V(q))",
            "it is infinite at `V(q)` = 0, where no orbit comes. `V` and `W` are assumed to be smooth: \
             analytic, without jumps, kinks and poles.",
        ),
        (
            "pub struct A {} fn V(x) = well; H(q; p) = p^2/2 + V(q); #[assume] invariant kept = q",
            "It is assumed to be conserved, without a proof.",
        ),
    ] {
        let docs = method(definition);
        assert!(docs.contains(said), "{definition}: {docs}");
    }
    let plain = method("pub struct A {} H(q; p) = p^2/2 + cos(q); invariant kept = H");
    for word in ["orbit", "assumed", "infinite"] {
        assert!(!plain.contains(word), "{plain}");
    }
}

/// No inverse of the mass matrix is needed for the proof.
#[test]
fn a_block_of_masses_keeps_its_energy() {
    let energy = "(3 + x^2)*u^2/2 + x*u*v + (2 + x^2)*v^2/2 + (4 + x^4)*w^2/2 + x*v*w + x^2*u*w";
    let block = |invariant: &str| {
        code(&format!(
            "pub struct Block {{}} L(x, y, z; u, v, w) = {energy}; invariant kept = {invariant}"
        ))
    };
    assert!(!block(energy).contains("compile_error"));
    assert!(!block("x*u + (2 + x^2)*v + x*w").contains("compile_error"));
    assert!(block("u^2").contains("is not conserved"));
}

/// A scheme that needs a split names the term without a flow, and the schemes for any H.
#[test]
fn what_is_not_split_says_so() {
    let source = "pub struct Sphere {} H(q; p) = p^2/(2*(1 + q^2)) + cos(q)";
    let code = format!("(::hamiltonian) {source}");
    let code = expand(TokenStream::from_str(&code).unwrap()).to_string();
    let message = "H of `Sphere` is not split into exact flows: no exact flow is known for the \
                   term `p^2/(2*(q^2 + 1))`";
    assert!(code.contains(message), "{code}");
    for scheme in [
        "ImplicitMidpoint",
        "Gauss",
        "Tao",
        "Semiexplicit",
        "Pihajoki",
    ] {
        assert!(code.contains(&format!("`{scheme}`")), "{scheme}");
    }
    // One that is split says nothing of it, and one loop of flows is no flow.
    let ring = docs(
        "pub struct Pairs { n: usize } H(x[n]; y[n]) = sum(i in 0..n, j in 0..i) {
            ln((x[i] - x[j])^2 + (y[i] - y[j])^2) }",
    );
    assert!(ring.contains("split into the terms of one loop"), "{ring}");
    assert!(!ring.contains("flow of all of H"), "{ring}");
}

#[test]
fn a_force_is_in_the_equations_and_conserves_nothing() {
    let forced = docs(
        "pub struct Drag { m = 1, c = 2 } H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/(2*m) + y; \
         force(x, y; p_x, p_y) = [-c*p_x, -c*p_y]",
    );
    assert!(forced.contains("dp_x/dt = -c*p_x"), "{forced}");
    assert!(forced.contains("dp_y/dt = -c*p_y - 1"), "{forced}");
    assert!(forced.contains("H does not depend on time; the force changes it."));
    assert!(!forced.contains("conserved"), "{forced}");
    let free = docs("pub struct Free { m = 1 } H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/(2*m) + y;");
    assert!(free.contains("`p_x` is conserved"), "{free}");
}
