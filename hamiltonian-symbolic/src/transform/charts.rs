//! The charts: each new coordinate as a function of the old ones, and back.
//!
//! Input: old or new variables as nodes. Output: the other ones. Invariant: point transformations:
//! with Q = Q(q), p = (∂Q/∂q)ᵀ P from the generating function F(q, P) = P·Q(q), so that each map is
//! canonical (Goldstein, Classical Mechanics, 3rd ed. 2002, §9.1).

use super::reduce::Rules;
use crate::dag::{Dag, Node, Parameter};
use crate::op::Op;
use crate::rational::Rational;

/// A scalar coordinate: a group, or one component of a vector group.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Component {
    /// The number of the group it is of.
    pub group: u16,
    /// The component of a vector group; `None` for a scalar one.
    pub row: Option<u32>,
}

/// The number of what is to stand in the place of a group of bodies, less the number of the group: what
/// is carried may read it before the change. A model has at most so many groups.
pub const REPLACING: u16 = 1 << 15;

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
}

/// Coordinates and their conjugate momenta.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
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
        let sums = (1..=each.len()).map(|n| dag.add(&each[..n])).collect();
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

/// (x, y) from (r, φ).
pub(super) fn polar_to_old(dag: &mut Dag, new: &Variables, rules: &mut Rules) -> Variables {
    let [r, phi] = [new.q[0], new.q[1]];
    let [p_r, p_phi] = [new.p[0], new.p[1]];
    let (s, c) = (dag.call(Op::Sin, &[phi]), dag.call(Op::Cos, &[phi]));
    rules.angles.push((s, c));
    rules.positive.push(r);
    let p_x = [
        times(dag, 1, &[(p_r, 1), (c, 1)]),
        times(dag, -1, &[(p_phi, 1), (s, 1), (r, -1)]),
    ];
    let p_y = [
        times(dag, 1, &[(p_r, 1), (s, 1)]),
        times(dag, 1, &[(p_phi, 1), (c, 1), (r, -1)]),
    ];
    Variables {
        q: vec![dag.mul(&[r, c]), dag.mul(&[r, s])],
        p: vec![total(dag, &p_x), total(dag, &p_y)],
    }
}

/// (r, φ) from (x, y): p_r = (x p_x + y p_y)/r, p_φ = x p_y − y p_x.
pub(super) fn polar_to_new(dag: &mut Dag, old: &Variables) -> Variables {
    let ([x, y], [p_x, p_y]) = ([old.q[0], old.q[1]], [old.p[0], old.p[1]]);
    let r = dag.call(Op::Hypot, &[x, y]);
    let phi = dag.call(Op::Atan2, &[y, x]);
    let along = [
        times(dag, 1, &[(x, 1), (p_x, 1)]),
        times(dag, 1, &[(y, 1), (p_y, 1)]),
    ];
    let along = total(dag, &along);
    Variables {
        q: vec![r, phi],
        p: vec![dag.div(along, r), turning(dag, x, y, p_x, p_y)],
    }
}

/// x p_y − y p_x.
fn turning(dag: &mut Dag, x: Node, y: Node, p_x: Node, p_y: Node) -> Node {
    let terms = [
        times(dag, 1, &[(x, 1), (p_y, 1)]),
        times(dag, -1, &[(y, 1), (p_x, 1)]),
    ];
    total(dag, &terms)
}

/// (x, y, z) from (r, θ, φ).
pub(super) fn spherical_to_old(dag: &mut Dag, new: &Variables, rules: &mut Rules) -> Variables {
    let [r, theta, phi] = [new.q[0], new.q[1], new.q[2]];
    let [p_r, p_theta, p_phi] = [new.p[0], new.p[1], new.p[2]];
    let (s, c) = (dag.call(Op::Sin, &[theta]), dag.call(Op::Cos, &[theta]));
    let (sf, cf) = (dag.call(Op::Sin, &[phi]), dag.call(Op::Cos, &[phi]));
    rules.angles.extend([(s, c), (sf, cf)]);
    rules.positive.extend([r, s]);
    let p_x = [
        times(dag, 1, &[(p_r, 1), (s, 1), (cf, 1)]),
        times(dag, 1, &[(p_theta, 1), (c, 1), (cf, 1), (r, -1)]),
        times(dag, -1, &[(p_phi, 1), (sf, 1), (r, -1), (s, -1)]),
    ];
    let p_y = [
        times(dag, 1, &[(p_r, 1), (s, 1), (sf, 1)]),
        times(dag, 1, &[(p_theta, 1), (c, 1), (sf, 1), (r, -1)]),
        times(dag, 1, &[(p_phi, 1), (cf, 1), (r, -1), (s, -1)]),
    ];
    let p_z = [
        times(dag, 1, &[(p_r, 1), (c, 1)]),
        times(dag, -1, &[(p_theta, 1), (s, 1), (r, -1)]),
    ];
    Variables {
        q: vec![dag.mul(&[r, s, cf]), dag.mul(&[r, s, sf]), dag.mul(&[r, c])],
        p: vec![total(dag, &p_x), total(dag, &p_y), total(dag, &p_z)],
    }
}

/// (r, θ, φ) from (x, y, z), with ρ = √(x²+y²): p_r = q·p/r, p_θ = (x p_x + y p_y) z/ρ − ρ p_z,
/// p_φ = x p_y − y p_x.
pub(super) fn spherical_to_new(dag: &mut Dag, old: &Variables) -> Variables {
    let [x, y, z] = [old.q[0], old.q[1], old.q[2]];
    let [p_x, p_y, p_z] = [old.p[0], old.p[1], old.p[2]];
    let rho = dag.call(Op::Hypot, &[x, y]);
    let r = dag.call(Op::Hypot, &[rho, z]);
    let flat = [
        times(dag, 1, &[(x, 1), (p_x, 1)]),
        times(dag, 1, &[(y, 1), (p_y, 1)]),
    ];
    let along = [
        flat[0].clone(),
        flat[1].clone(),
        times(dag, 1, &[(z, 1), (p_z, 1)]),
    ];
    let (flat, along) = (total(dag, &flat), total(dag, &along));
    let p_theta = [
        times(dag, 1, &[(flat, 1), (z, 1), (rho, -1)]),
        times(dag, -1, &[(rho, 1), (p_z, 1)]),
    ];
    Variables {
        q: vec![
            r,
            dag.call(Op::Atan2, &[rho, z]),
            dag.call(Op::Atan2, &[y, x]),
        ],
        p: vec![
            dag.div(along, r),
            total(dag, &p_theta),
            turning(dag, x, y, p_x, p_y),
        ],
    }
}

/// One component of the positions of all bodies from their Jacobi coordinates:
/// q_i = Q_0 + Q_i − Σ_{j≥i} (m_j/M_j) Q_j, for i = 0 without Q_i and from j = 1.
pub(super) fn jacobi_to_old(dag: &mut Dag, new: &Variables, masses: &Masses) -> Variables {
    let n = new.q.len();
    let (m, sums) = (&masses.each, &masses.sums);
    let mut old = Variables::default();
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
pub(super) fn jacobi_to_new(dag: &mut Dag, old: &Variables, masses: &Masses) -> Variables {
    let n = old.q.len();
    let (m, sums) = (&masses.each, &masses.sums);
    let moments: Vec<Node> = (0..n).map(|k| dag.mul(&[m[k], old.q[k]])).collect();
    let moment = dag.add(&moments);
    let mut new = Variables {
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
pub(super) fn heliocentric_to_old(dag: &mut Dag, new: &Variables) -> Variables {
    let mut first = vec![(Rational::ONE, new.p[0])];
    first.extend(new.p[1..].iter().map(|p| (Rational::MINUS_ONE, *p)));
    let mut old = Variables {
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
pub(super) fn heliocentric_to_new(dag: &mut Dag, old: &Variables) -> Variables {
    let mut new = Variables {
        q: vec![old.q[0]],
        p: vec![dag.add(&old.p)],
    };
    for i in 1..old.q.len() {
        new.q.push(dag.sub(old.q[i], old.q[0]));
        new.p.push(old.p[i]);
    }
    new
}
