//! The charts: each new coordinate as a function of the old ones, and back.
//!
//! Input: old or new variables as nodes. Output: the other ones. Invariant: point transformations:
//! with Q = Q(q), p = (∂Q/∂q)ᵀ P from the generating function F(q, P) = P·Q(q), so that each map is
//! canonical (Goldstein, Classical Mechanics, 3rd ed. 2002, §9.1).

use super::reduce::Rules;
use crate::algebra::formula::Names;
use crate::dag::{Dag, Node, Parameter};
use crate::list::IntoList;
use crate::rational::Rational;

/// A scalar coordinate: a group, or one component of a vector group.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Component {
    /// The number of the group it is of.
    pub group: u16,
    /// The component of a vector group; `None` for a scalar one.
    pub row: Option<u32>,
}

/// Positions `[N]` or `[N][d]` and masses `[N]`; d is literal, and N for Jacobi coordinates.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bodies {
    /// The positions and momenta.
    pub group: u16,
    /// The masses.
    pub masses: Parameter,
}

/// New coordinates.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Chart {
    /// `polar(x, y)` → (r, phi; p_r, p_phi): x = r cos φ, y = r sin φ, r > 0,
    /// p_x = p_r cos φ − p_φ sin φ/r, p_y = p_r sin φ + p_φ cos φ/r.
    Polar([Component; 2]),
    /// `spherical(x, y, z)` → (r, theta, phi; p_r, p_theta, p_phi): θ is the angle from the z axis,
    /// x = r sin θ cos φ, y = r sin θ sin φ, z = r cos θ, r > 0, 0 < θ < π.
    Spherical([Component; 3]),
    /// `jacobi(q, m)` → (q_jacobi; p_jacobi), one row a body: row 0 is the centre of mass with the
    /// total momentum, row i ≥ 1 the position relative to the centre of mass of bodies 0 … i−1.
    ///
    /// With M_i = m_0 + … + m_i: p_i = (m_i/M_{N−1}) P_0 + P_i − Σ_{j>i} (m_i/M_{j−1}) P_j (no P_i
    /// of its own for i = 0). All masses positive. Source: Wisdom & Holman, AJ 102, 1528 (1991),
    /// doi:10.1086/115978.
    Jacobi(Bodies),
    /// `heliocentric(q, m)` → (q_heliocentric; p_heliocentric), one row a body: row 0 is the
    /// position of body 0 with the total momentum, row i ≥ 1 the position relative to body 0 with
    /// the momentum of body i unchanged: Q_i = q_i − q_0, P_i = p_i, P_0 = Σ p.
    ///
    /// The canonical heliocentric variables of Poincaré; their momenta are barycentric where
    /// P_0 = 0. Source: Laskar & Robutel, Celest. Mech. Dyn. Astron. 62, 193 (1995),
    /// doi:10.1007/BF00692088.
    Heliocentric(Bodies),
}

/// The old coordinates of a chart.
pub(super) enum Replaced<'a> {
    /// Scalars, mapped by formulas.
    Scalars(&'static Formulas, &'a [Component]),
    /// Bodies, mapped component by component.
    Bodies(Bodies),
}

impl Chart {
    /// The word that declares it.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Chart::Polar(_) => "polar",
            Chart::Spherical(_) => "spherical",
            Chart::Jacobi(_) => "jacobi",
            Chart::Heliocentric(_) => "heliocentric",
        }
    }
    /// Returns true if it replaces a group, or rows of it.
    #[must_use]
    pub fn replaces(&self, group: u16) -> bool {
        match self.replaced() {
            Replaced::Scalars(_, components) => components.iter().any(|c| c.group == group),
            Replaced::Bodies(bodies) => bodies.group == group,
        }
    }
    pub(super) fn replaced(&self) -> Replaced<'_> {
        match self {
            Chart::Polar(components) => Replaced::Scalars(&POLAR, components),
            Chart::Spherical(components) => Replaced::Scalars(&SPHERICAL, components),
            Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) => Replaced::Bodies(*bodies),
        }
    }
}

/// Coordinates and their conjugate momenta.
#[derive(Clone, Debug, Default)]
pub(super) struct PhaseNodes {
    pub(super) q: Vec<Node>,
    pub(super) p: Vec<Node>,
}

/// Masses and their partial sums M_i = m_0 + … + m_i.
pub(super) struct Masses {
    each: Vec<Node>,
    sums: Vec<Node>,
}

impl Masses {
    pub(super) fn new(dag: &mut Dag, each: Vec<Node>) -> Masses {
        let sums = (1..=each.len()).map(|n| dag.add(&each[..n])).into_list();
        Masses { each, sums }
    }
}

/// `k·a·b/c …`
fn times(dag: &mut Dag, k: i64, factors: &[(Node, i32)]) -> (Rational, Node) {
    (Rational::integer(k), dag.product(&Rational::ONE, factors))
}

fn total(dag: &mut Dag, terms: &[(Rational, Node)]) -> Node {
    dag.linear(&Rational::ZERO, terms)
}

/// The values that a new coordinate takes inside its chart.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum NumberRange {
    /// Any number.
    All,
    /// Numbers > 0.
    Positive,
    /// Angles between 0 and π.
    HalfTurn,
}

/// A point transformation of scalars by formulas; the momentum of `x` is `p_x`.
pub(super) struct Formulas {
    old: &'static [&'static str],
    pub(super) new: &'static [&'static str],
    /// The values of each new coordinate.
    pub(super) values: &'static [NumberRange],
    to_old: &'static str,
    to_new: &'static str,
    /// Sine and cosine of each angle, by name.
    angles: &'static [(&'static str, &'static str)],
    /// Names of expressions that are > 0.
    positive: &'static [&'static str],
}

static POLAR: Formulas = Formulas {
    old: &["x", "y"],
    new: &["r", "phi"],
    values: &[NumberRange::Positive, NumberRange::All],
    to_old: "s = sin(phi); c = cos(phi); \
        p_x = p_r*c - p_phi*s/r; p_y = p_r*s + p_phi*c/r; x = r*c; y = r*s",
    to_new: "r = hypot(x, y); phi = atan2(y, x); p_r = (x*p_x + y*p_y)/r; p_phi = x*p_y - y*p_x",
    angles: &[("s", "c")],
    positive: &["r"],
};

static SPHERICAL: Formulas = Formulas {
    old: &["x", "y", "z"],
    new: &["r", "theta", "phi"],
    values: &[
        NumberRange::Positive,
        NumberRange::HalfTurn,
        NumberRange::All,
    ],
    to_old: "s = sin(theta); c = cos(theta); sf = sin(phi); cf = cos(phi); \
        p_x = p_r*s*cf + p_theta*c*cf/r - p_phi*sf/r/s; \
        p_y = p_r*s*sf + p_theta*c*sf/r + p_phi*cf/r/s; \
        p_z = p_r*c - p_theta*s/r; x = r*s*cf; y = r*s*sf; z = r*c",
    to_new: "rho = hypot(x, y); r = hypot(rho, z); theta = atan2(rho, z); phi = atan2(y, x); \
        flat = x*p_x + y*p_y; p_r = (x*p_x + y*p_y + z*p_z)/r; \
        p_theta = flat*z/rho - rho*p_z; p_phi = x*p_y - y*p_x",
    angles: &[("s", "c"), ("sf", "cf")],
    positive: &["r", "s"],
};

impl Formulas {
    /// The formulas of a chart of scalars by its word.
    pub(super) fn named(word: &str) -> Option<&'static Formulas> {
        match word {
            "polar" => Some(&POLAR),
            "spherical" => Some(&SPHERICAL),
            _ => None,
        }
    }
    /// The old variables from the new ones; the rules of the chart are added.
    pub(super) fn to_old(&self, dag: &mut Dag, new: &PhaseNodes, rules: &mut Rules) -> PhaseNodes {
        let names = named(dag, self.new, new, self.to_old);
        let angles = self.angles.iter();
        rules
            .angles
            .extend(angles.map(|(s, c)| (node(&names, s), node(&names, c))));
        let positive = self.positive.iter();
        rules
            .positive
            .extend(positive.map(|name| node(&names, name)));
        variables(&names, self.old)
    }
    /// The new variables from the old ones.
    pub(super) fn to_new(&self, dag: &mut Dag, old: &PhaseNodes) -> PhaseNodes {
        let names = named(dag, self.old, old, self.to_new);
        variables(&names, self.new)
    }
}

/// The nodes of formulas over some coordinates.
fn named(dag: &mut Dag, from: &[&str], given: &PhaseNodes, formulas: &str) -> Names {
    let mut names = Names::default();
    for (at, name) in from.iter().enumerate() {
        names.set(name, given.q[at]);
        names.set(&format!("p_{name}"), given.p[at]);
    }
    names
        .read(dag, formulas)
        .expect("the formulas of a chart read");
    names
}

fn node(names: &Names, name: &str) -> Node {
    names.get(name).expect("the formulas of a chart name it")
}

fn variables(names: &Names, to: &[&str]) -> PhaseNodes {
    PhaseNodes {
        q: to.iter().map(|name| node(names, name)).into_list(),
        p: to
            .iter()
            .map(|name| node(names, &format!("p_{name}")))
            .into_list(),
    }
}

/// One component of the positions of all bodies from their Jacobi coordinates:
/// q_i = Q_0 + Q_i − Σ_{j≥i} (m_j/M_j) Q_j, for i = 0 without Q_i and from j = 1.
pub(super) fn jacobi_to_old(dag: &mut Dag, new: &PhaseNodes, masses: &Masses) -> PhaseNodes {
    let n = new.q.len();
    let (m, sums) = (&masses.each, &masses.sums);
    let mut old = PhaseNodes::default();
    for i in 0..n {
        let mut q = vec![(Rational::ONE, new.q[0])];
        let mut p = vec![times(
            dag,
            1,
            &[(new.p[0], 1), (m[i], 1), (sums[n - 1], -1)],
        )];
        if i > 0 {
            q.push((Rational::ONE, new.q[i]));
            p.push((Rational::ONE, new.p[i]));
        }
        for j in i.max(1)..n {
            q.push(times(dag, -1, &[(new.q[j], 1), (m[j], 1), (sums[j], -1)]));
        }
        for j in i + 1..n {
            p.push(times(
                dag,
                -1,
                &[(new.p[j], 1), (m[i], 1), (sums[j - 1], -1)],
            ));
        }
        old.q.push(total(dag, &q));
        old.p.push(total(dag, &p));
    }
    old
}

/// m_i = M_i − M_{i−1}, which makes the kinetic energy diagonal.
pub(super) fn jacobi_rules(masses: &Masses, rules: &mut Rules) {
    for i in 1..masses.each.len() {
        rules
            .masses
            .push((masses.each[i], masses.sums[i], masses.sums[i - 1]));
    }
}

/// One component of the Jacobi coordinates of all bodies: Q_0 = Σ m_k q_k/M,
/// Q_i = q_i − Σ_{k<i} m_k q_k/M_{i−1}; P_0 = Σ p_k, P_i = (M_{i−1} p_i − m_i Σ_{k<i} p_k)/M_i.
pub(super) fn jacobi_to_new(dag: &mut Dag, old: &PhaseNodes, masses: &Masses) -> PhaseNodes {
    let n = old.q.len();
    let (m, sums) = (&masses.each, &masses.sums);
    let moments: Vec<Node> = (0..n).map(|k| dag.mul(&[m[k], old.q[k]])).into_list();
    let moment = dag.add(&moments);
    let mut new = PhaseNodes {
        q: vec![dag.div(moment, sums[n - 1])],
        p: vec![dag.add(&old.p)],
    };
    for i in 1..n {
        let before = dag.add(&moments[..i]);
        let centre = dag.div(before, sums[i - 1]);
        new.q.push(dag.sub(old.q[i], centre));
        let momentum = dag.add(&old.p[..i]);
        let terms = [
            times(dag, 1, &[(old.p[i], 1), (sums[i - 1], 1), (sums[i], -1)]),
            times(dag, -1, &[(momentum, 1), (m[i], 1), (sums[i], -1)]),
        ];
        new.p.push(total(dag, &terms));
    }
    new
}

/// One component of all bodies: q_0 = Q_0, q_i = Q_0 + Q_i; p_0 = P_0 − Σ_{i≥1} P_i, p_i = P_i.
pub(super) fn heliocentric_to_old(dag: &mut Dag, new: &PhaseNodes) -> PhaseNodes {
    let mut first = vec![(Rational::ONE, new.p[0])];
    first.extend(new.p[1..].iter().map(|p| (Rational::MINUS_ONE, *p)));
    let mut old = PhaseNodes {
        q: vec![new.q[0]],
        p: vec![total(dag, &first)],
    };
    for i in 1..new.q.len() {
        old.q.push(dag.add(&[new.q[0], new.q[i]]));
        old.p.push(new.p[i]);
    }
    old
}

/// One component of all bodies: Q_0 = q_0, Q_i = q_i − q_0; P_0 = Σ p_k, P_i = p_i.
pub(super) fn heliocentric_to_new(dag: &mut Dag, old: &PhaseNodes) -> PhaseNodes {
    let mut new = PhaseNodes {
        q: vec![old.q[0]],
        p: vec![dag.add(&old.p)],
    };
    for i in 1..old.q.len() {
        new.q.push(dag.sub(old.q[i], old.q[0]));
        new.p.push(old.p[i]);
    }
    new
}
