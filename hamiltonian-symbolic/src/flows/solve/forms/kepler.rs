//! a·|p|² − κ/|q| of two or three pairs: an orbit about a centre, in universal variables.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: a and κ depend on nothing that moves. The increments
//! of q and p are computed from f − 1, g and their rates, so that a short time loses no digits. From far in
//! to far out on a hyperbola, f·q and g·p cancel: each unit of the anomaly past ten costs half a digit. Shorter steps
//! lose none.

use crate::algebra::ball::Ball;
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::space::{Space, Variables};
use crate::list::IntoList;
use crate::model::Motion;
use crate::rational::Rational;

/// |q×p|/|q||p| of an orbit that is a line through the centre to the rounding of a double.
const STRAIGHT: (i64, i64) = (1, 1 << 50);

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let own = Variables::of_pairs(&active);
    if !(2..=3).contains(&active.len()) || space.set(h) != own || is_not_of_distance(space, h, own)
    {
        return None;
    }
    let pairs: Vec<(Node, Node)> = active.iter().map(|pair| space.pairs[*pair]).into_list();
    let (zero, one) = (space.dag().integer(0), space.dag().integer(1));
    // At q = (1, 0, 0), p = 0 the value of h is −κ.
    let mut point = Vec::new();
    for (at, &(q, p)) in pairs.iter().enumerate() {
        point.push((q, if at == 0 { one } else { zero }));
        point.push((p, zero));
    }
    let value = space.at(h, &point);
    let kappa = space.dag().neg(value);
    let slope = space.d(h, pairs[0].1);
    let slope = space.d(slope, pairs[0].1);
    let a = space.at(slope, &point);
    let a = space.dag().scale(&Rational::new(1, 2), a);
    if space.sign(kappa) == Some(0) || space.sign(a) == Some(0) {
        return None;
    }
    let mut squares = [Vec::new(), Vec::new(), Vec::new()];
    for &(q, p) in &pairs {
        let dag = space.dag();
        squares[0].push(dag.powi(q, 2));
        squares[1].push(dag.powi(p, 2));
        squares[2].push(dag.mul(&[q, p]));
    }
    let [rr, pp, qp] = squares.map(|terms| space.dag().add(&terms));
    let mut names = Names::of(&[
        ("a", a),
        ("k", kappa),
        ("rr", rr),
        ("pp", pp),
        ("qp", qp),
        ("s", s),
    ]);
    let form = names.one(space.dag(), "a*pp - k/sqrt(rr)")?;
    if !space.same(h, form) {
        return None;
    }
    // The equations of `Real::universal_anomaly`: v = 2ap, μ = 2aκ. The motion is followed for the part of the time
    // that is left after whole revolutions.
    names.read(
        space.dag(),
        "r = sqrt(rr); whole = 2*a*s; inner = whole*s*k/(r*rr); outer = 2*inner - whole*whole*pp/rr; \
         part = orbit_remainder(inner, outer); s = part*s; v = part*whole; A = v*qp/rr; B = part*part*inner; \
         C = part*part*outer; y = universal_anomaly(A, B, C); psi = C*y^2; c2 = stumpff_2(psi); c3 = stumpff_3(psi); \
         g1 = y - y*psi*c3; g2 = y^2*c2; c0 = 1 - psi*c2; rise = A*g1; r1 = c0 + rise + B*g2; \
         f = -B*g2; g = v - v*B*y^3*c3; fd = -s*k*g1/(r*rr*r1); gd = f/r1",
    )?;
    let mut motion = Motion::default();
    for &(q, p) in &pairs {
        names.set("q", q);
        names.set("p", p);
        let dag = space.dag();
        let (along, across) = (names.one(dag, "f*q + g*p")?, names.one(dag, "fd*q + gd*p")?);
        motion.add(dag, q, along);
        motion.add(dag, p, across);
    }
    let straight = straight(space, &pairs, &mut names)?;
    motion.domain.push(straight);
    Some(motion)
}

/// The condition that an orbit is no line through the centre, or does not meet it: √r of a line is
/// u₀·(cos φ + …) with φ = ½√ψ, whose product with cos φ is half of 1 + c₀ + A·g₁.
fn straight(space: &mut Space, pairs: &[(Node, Node)], names: &mut Names) -> Option<Node> {
    let dag = space.dag();
    let mut areas = Vec::new();
    for (at, &(x, px)) in pairs.iter().enumerate() {
        for &(y, py) in &pairs[at + 1..] {
            let (one, other) = (dag.mul(&[x, py]), dag.mul(&[y, px]));
            let area = dag.sub(one, other);
            areas.push(dag.powi(area, 2));
        }
    }
    let area = dag.add(&areas);
    names.set("area", area);
    let sine = Rational::new(STRAIGHT.0, STRAIGHT.1);
    let epsilon = dag.constant(sine.mul(&sine));
    names.set("epsilon", epsilon);
    let turns = names.one(dag, "epsilon*rr*pp < area")?;
    let ahead = names.one(dag, "0 < (1 + c0 + rise)*(pi^2 - psi)")?;
    let once = names.one(dag, "psi < 4*pi^2")?;
    // After whole revolutions the part is at most a third.
    let never = names.one(dag, "1/2 < part")?;
    let once = dag.and(once, never);
    let misses = dag.and(ahead, once);
    Some(dag.or(turns, misses))
}

/// Returns true if numbers say that h is not a·|p|² + f(|q|).
fn is_not_of_distance(space: &mut Space, h: Node, own: Variables) -> bool {
    let mut at = |q: [f64; 3], p: [f64; 3]| {
        let mut point = space.point();
        for (k, pair) in own.pairs().into_iter().enumerate() {
            (point[2 * pair], point[2 * pair + 1]) = (Ball::exact(q[k]), Ball::exact(p[k]));
        }
        space.value_at(h, &point)
    };
    let still = [0.0; 3];
    let near = at([0.75, 1.0, 0.0], still);
    let (turned, twice) = (at([1.0, 0.75, 0.0], still), at([1.5, 2.0, 0.0], still));
    let moving = at([0.75, 1.0, 0.0], [1.0, 0.0, 0.0]) - near;
    near.differs(turned)
        || near.differs(Ball::exact(2.0) * twice)
        || moving.differs(at([0.75, 1.0, 0.0], [0.0, 1.0, 0.0]) - near)
        || (Ball::exact(4.0) * moving).differs(at([1.0, 0.75, 0.0], [2.0, 0.0, 0.0]) - near)
}
