//! Definitions that are accepted, and what they become.

use super::{accept, read};
use hamiltonian_language::ast::BinaryOp;
use hamiltonian_language::checked::{
    Checked, Definition, Extent, Field, NodeId, NodeKind, ParameterId, Type, Variable,
};
use hamiltonian_symbolic::index::Size;
use hamiltonian_symbolic::transform::Chart;

const GRAVITY: &str = "
    /// Point masses.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..n) { p[i] };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) }";

const TODA: &str = "
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] }";

/// All definitions of the design, and one of each further construct.
pub(super) const DEFINITIONS: &[&str] = &[
    "H = 0.5*(q^2 + 1)*(p^2 + 1)",
    "H(x; p_x) = p_x^2/(2*m) + k*x^2/2",
    // Empty ranges, and some that are so for some sizes only.
    "struct A<const N: usize> {} H(q[N]; p[N]) = norm_squared(p) + sum(i in 0..0) { q[i] }
         + sum(i in 3..N) { q[i] } + sum(i in 0..3, j in i + 1..3) { i*j*q[0] }",
    // Functions of their own names, and the functions of the language.
    "pub struct Rounds { floor = 1.0, remainder = 2.0 }
     let round(x) = x + floor;
     H = p^2 + round(q)*floor + remainder",
    "H = p^2/2 + q*floor^2 + remainder*round - floor(q)",
    "H = p^2/2 + floor(q)*round(q/2) + remainder(q, 2)^2 + (q % 1)*(-q % (2*l))",
    "H(q[4]; p[4]) = norm_squared(p) + sum(i in 0..4) { (i % 2)*q[(i + 1) % 4] }",
    // Named like a momentum, but with one of its own.
    "H(q, p; p_q, p_p) = p_q^2 + p_p^2 + q*p",
    "/// A planar pendulum.
     pub struct Pendulum {
         /// Mass of the bob.
         m = 1.0,
         l = 10.0,
         g = 9.81,
     }
     H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)",
    TODA,
    GRAVITY,
    "pub struct Driven { a = 0.1, omega = 1.0 }
     let U(r) = r^2/2 + r^4/4;
     H(q; p; t) = p^2/2 + U(q) - a*q*cos(omega*t)",
    "pub struct DoublePendulum { m1 = 1.0, m2 = 1.0, l1 = 1.0, l2 = 1.0, g = 9.81 }
     L(a, b; va, vb) = (m1 + m2)*l1^2*va^2/2 + m2*l2^2*vb^2/2 + m2*l1*l2*va*vb*cos(a - b)
         + (m1 + m2)*g*l1*cos(a) + m2*g*l2*cos(b)",
    "pub(crate) struct Kerr { a = 0.9, M = 1.0, E = 0.95, L = 3.0 }
     let Delta = r^2 - 2*M*r + a^2;
     H(r, theta; p_r, p_theta) = (Delta*p_r^2 + p_theta^2
         - ((r^2 + a^2)*E - a*L)^2/Delta + (L - a*E*sin(theta)^2)^2/sin(theta)^2)
         /(2*(r^2 + a^2*cos(theta)^2));
     dt = (r^2 + a^2*cos(theta)^2)*ds;
     invariant carter = p_theta^2 + cos(theta)^2*(a^2*(-2*H - E^2) + L^2/sin(theta)^2);
     #[assume] invariant shell = p_theta^2 + cos(theta)^2 on H = -1/2",
    // Several charts; splits in their variables, above and below the charts.
    "pub struct Pair {}
     H(q[3], w[3]; p[3], u[3]) = (norm_squared(p) + norm_squared(u))/2 - 1/norm(q) - 1/norm(w);
     coordinates spherical(q);
     coordinates spherical(w)",
    "pub struct Three {}
     H(a[2], b[2], x, y; u[2], v[2], p_x, p_y) = (norm_squared(u) + norm_squared(v) + p_x^2 + p_y^2)/2
         - 1/norm(a) - 1/norm(b) - ln(x^2 + y^2) + norm(a)*norm(b);
     coordinates polar(a);
     split {
         Free = p_r^2/2 + p_phi^2/(2*r^2) + p_r_2^2/2 + p_phi_2^2/(2*r_2^2) + p_r_3^2/2 + p_phi_3^2/(2*r_3^2);
         Bound = -1/r - 1/r_2 - 2*ln(r_3) + r*r_2;
     }
     coordinates polar(b);
     coordinates polar(x, y)",
    "pub struct Ball { g = 1.0 }
     H(z, q[3]; p_z, p[3]) = p_z^2/2 + norm_squared(p)/2 + g*q[2] + z*norm(q);
     coordinates spherical(q);
     split {
         Free = p_r^2/2 + p_theta^2/(2*r^2) + p_phi^2/(2*r^2*sin(theta)^2);
         Along = p_z^2/2;
         Fall = g*r*cos(theta) + z*r;
     }",
    "H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2);
     let l = x*p_y - y*p_x;
     let b = bracket(l, H);
     monitor angular = [l, b, pi];
     event periapsis = x*p_x + y*p_y;
     force(x, y; p_x, p_y) = [-0.1*p_x, -0.1*p_y];
     split { A = (p_x^2 + p_y^2)/2; B = -1/sqrt(x^2 + y^2); }
     coordinates polar(x, y)",
    "struct Rust { k = 1 } fn well(r) = crate::well, (crate::well_prime), (crate::well_second);
     fn two(a, b) = m::f::<f64>, (fa, fb,), (faa, fab, fbb);
     H = p^2/2 + k*well(q) + two(q, p)",
    "fn f(x) = <f64 as m::Real<_>>::f, (<T>::f); fn g(x) = ::m::g::<Vec<m::V<f64>>>::r#fn, (self::g);
     H = p^2/2 + f(q) + g(q)",
    "H(q[3]; p[3]) = norm_squared(p)/2 + if norm(q) < 1 { dot(q, q) } else { max(1, q[0]) }",
    "struct Matrix<const N: usize> { M: [N][N], b: [N] }
     H(q[N]; p[N]) = dot(p, M*p)/2 + dot(b, q) + sqrt(1 + sum(i in 0..N) { p[i]^2 })",
    "#[derive(Clone)] #[max_ops = 40] struct Attributes { m } H = p^2/(2*m)",
    "struct Fput<const N: usize> { alpha = 0.25 }
     let d(i) = q[i + 1] - q[i];
     H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N - 1) { d(i)^2/2 + alpha*d(i)^3/3 }",
    "struct Mixed<const N: usize> { n: usize, w: [n] }
     H(x, q[N], r[n][2]; p_x, p[N], s[n][2]; tau) = p_x^2 + x*tau + norm_squared(p)
         + sum(k in 0..n) { w[k]*norm_squared(s[k] - r[k]) + k/n };
     force(x, q, r; p_x, p, s; tau) = [-x, -q, -r]",
    "struct Bodies<const N: usize> { m: [N] }
     H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) };
     coordinates jacobi(q, m); coordinates heliocentric(q, m)",
    "H(q[3]; p[3]) = norm_squared(p); coordinates spherical(q)",
    "let kinetic(v) = norm_squared(v)/2; H(q[3], r[2]; p[3], s[2]) = kinetic(p) + kinetic(s)",
    "H(q; p) = p^2/2; #[assume] invariant e = H;",
    "H(theta; p) = p^2/2 - cos(theta) + m - θ",
];

#[test]
fn every_construct_is_accepted() {
    for source in DEFINITIONS {
        let checked = accept(source);
        in_order(&checked);
    }
}

/// Children precede parents; types are as the comments of [`NodeKind`] say for the plainest kinds.
fn in_order(checked: &Checked) {
    for (index, node) in checked.nodes.iter().enumerate() {
        node.kind
            .for_each_child(|child| assert!((child.0 as usize) < index));
        if let NodeKind::Binary(BinaryOp::Add | BinaryOp::Sub, a, b) = node.kind {
            assert_eq!(checked.node(a).ty, node.ty);
            assert_eq!(checked.node(b).ty, node.ty);
        }
        if let NodeKind::Sum { loops, body } = &node.kind {
            assert_eq!(checked.node(*body).ty, node.ty);
            for id in loops.clone() {
                let bounds = &checked.loops[id as usize];
                for (outer, _) in bounds.lower.loops.iter().chain(&bounds.upper.loops) {
                    assert!(outer.0 < id);
                }
            }
        }
    }
}

fn hamiltonian(checked: &Checked) -> NodeId {
    match checked.definition {
        Definition::Hamiltonian(root) | Definition::Lagrangian(root) => root,
    }
}

#[test]
fn gravity_is_resolved() {
    let checked = accept(GRAVITY);
    let item = checked.item.as_ref().expect("it is an item");
    assert_eq!(item.name, "Gravity");
    assert_eq!(
        checked.fields,
        [
            Field::Size(Size(0)),
            Field::Parameter(ParameterId(0)),
            Field::Parameter(ParameterId(1))
        ]
    );
    assert!(checked.sizes[0].run_time);
    let n = Extent::Size(Size(0));
    assert_eq!(checked.parameters[1].ty, Type::Vector(n));
    assert_eq!(checked.groups[0].ty, Type::Matrix(n, Extent::Literal(3)));
    assert_eq!(checked.node(hamiltonian(&checked)).ty, Type::Scalar);
    let vector = Type::Vector(Extent::Literal(3));
    let types = checked
        .observables
        .iter()
        .map(|observable| checked.node(observable.value).ty);
    assert_eq!(types.collect::<Vec<_>>(), [vector, vector]);
    assert!(checked.reaches.is_empty());
}

#[test]
fn ranges_are_followed() {
    let proven = |header: &str, body: &str| {
        let source = format!("{header} H(q[N]; p[N]) = sum(k in 0..N) {{ p[k] }} + {body}");
        accept(&source).reaches.is_empty()
    };
    let sized = "struct A<const N: usize, const M: usize> {}";
    assert!(proven(sized, "sum(i in 0..N, j in i + 1..N) { q[j]*q[i] }"));
    assert!(proven(
        sized,
        "sum(i in 0..N) { q[N - 1 - i] + q[(i + 5) % N] }"
    ));
    assert!(proven(sized, "sum(i in 0..N - 1) { q[i + 1] }"));
    // Ranges that a size may make too long, and constants, need a look at the sizes.
    assert!(!proven(sized, "sum(i in 0..M) { q[i] }"));
    assert!(!proven(sized, "q[0]"));
    assert!(!proven(sized, "sum(i in 0..N) { q[i % M] }"));
    // The inner loop is empty where the index would leave its range.
    assert!(!proven(
        sized,
        "sum(i in 0..N, j in i + 1..N) { q[i + j]*q[j] }"
    ));
}

#[test]
fn functions_are_instantiated_for_each_call() {
    let checked = accept("let f(x) = x^2; H = f(p) + f(f(q))");
    let powers = checked
        .nodes
        .iter()
        .filter(|node| matches!(node.kind, NodeKind::Binary(BinaryOp::Pow, ..)))
        .count();
    assert_eq!(powers, 3);
    assert!(checked.captures.is_empty());
    // Arguments hide what is declared outside.
    let checked = accept("let f(p) = p; H = p^2 + f(q)");
    let momenta = checked
        .nodes
        .iter()
        .filter(|node| matches!(node.kind, NodeKind::Phase(Variable::Momentum, _)))
        .count();
    assert_eq!(momenta, 1);
}

#[test]
fn captures_are_names_of_the_scope_around() {
    let checked = accept("let a = m*q; H = p^2/m + k*a + T");
    let names: Vec<String> = checked
        .captures
        .iter()
        .map(|name| name.to_string())
        .collect();
    assert_eq!(names, ["m", "k", "T"]);
}

#[test]
fn lagrangians_have_momenta_elsewhere() {
    let checked = accept("L(x; v) = v^2/2 - x^2; invariant e = p_x*v + H");
    assert_eq!(checked.groups[0].momentum, "p_x");
    assert!(matches!(checked.definition, Definition::Lagrangian(_)));
    // A name its author gives wins.
    let checked = accept("struct A { p_x = 1 } L(x; v) = v^2*p_x");
    assert!(
        checked
            .nodes
            .iter()
            .any(|node| matches!(node.kind, NodeKind::Parameter(_)))
    );
}

#[test]
fn time_factors_and_charts_are_taken_apart() {
    let checked = accept("H(r; p_r) = p_r^2; dt = r*2*ds");
    let (factor, _) = checked.time_factor.expect("it has one");
    assert!(matches!(
        checked.node(factor).kind,
        NodeKind::Binary(BinaryOp::Mul, ..)
    ));
    let checked = accept("H(q[2]; p[2]) = norm_squared(p); coordinates polar(q)");
    assert!(matches!(&checked.charts[0].kind, Chart::Polar([x, y])
        if x.row == Some(0) && y.row == Some(1)));
}

#[test]
fn paths_of_functions_are_paths_to_syn() {
    const WORDS: [&str; 10] = ["a", "_", "as", "match", "::", "<", ">", "dyn", "true", "1"];
    let mut accepted = 0;
    let mut sequences = ["", "a::<", "a::<impl", "<dyn", "<a as a"]
        .map(String::from)
        .to_vec();
    for _ in 0..4 {
        sequences = sequences
            .iter()
            .flat_map(|sequence| WORDS.map(|word| format!("{sequence} {word}")))
            .collect();
        for sequence in &sequences {
            let (_, _, report) = read(&format!("fn f(x) = {sequence}; H = p^2/2 + f(q)"));
            let by_syn = syn::parse_str::<syn::ExprPath>(sequence).is_ok();
            assert_eq!(report.is_empty(), by_syn, "{sequence}");
            accepted += usize::from(by_syn);
        }
    }
    assert_eq!(accepted, 27);
    // Depth that would overflow the stack is refused.
    let deep = "a::<".repeat(100_000);
    let (_, _, report) = read(&format!("fn f(x) = {deep}; H = p^2/2 + f(q)"));
    assert_eq!(report.errors().len(), 1);
}
