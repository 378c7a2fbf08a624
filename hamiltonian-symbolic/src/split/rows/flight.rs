//! a·(p² + Λ/r²): X = r + 2ats·p, Y = 2as·√Λ/r, a straight line; Λ acts for the angle it turns.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: Λ is free of r and p and has a flow of its own.

use crate::dag::Node;
use crate::formula::Names;
use crate::rational::Rational;
use crate::split::motion::Motion;
use crate::split::solve::flow;
use crate::split::space::{Space, differ};

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    active.into_iter().find_map(|pair| along(space, pair, h, s))
}

fn along(space: &mut Space, pair: usize, h: Node, s: Node) -> Option<Motion> {
    let (r, p) = space.pairs[pair];
    if is_not_central(space, h, pair, |r| r * r) {
        return None;
    }
    let own = 3 << (2 * pair);
    let set = space.set(h);
    let half = Rational::new(1, 2);
    let slope = space.d(h, p);
    let slope = space.d(slope, p);
    let a = space.section(slope, set);
    let a = space.dag().scale(&half, a);
    if space.sign(a) == Some(0) {
        return None;
    }
    // Λ = r²(h/a − p²)
    let kinetic = space.dag().product(&Rational::ONE, &[(a, 1), (p, 2)]);
    let rest = terms_without(space, h, kinetic);
    let over = space.dag().product(&Rational::ONE, &[(r, 2), (a, -1)]);
    let lambda = distributed(space, rest, over);
    let lambda = space.section(lambda, own);
    if space.set(lambda) == 0 && space.dag().is_zero(lambda) {
        return None;
    }
    let mut names = Names::of(&[("r", r), ("p", p), ("a", a), ("l", lambda), ("s", s)]);
    let form = names.one(space.dag(), "a*(p^2 + l/r^2)")?;
    if !space.same(h, form) {
        return None;
    }
    let root = super::root(space, lambda);
    names.set("root", root);
    names.read(
        space.dag(),
        "X = r + 2*a*s*p; Y = 2*a*s*root/r; side = sign(r); r1 = side*hypot(X, Y); \
         p1 = (r*p + 2*a*s*(p^2 + root^2/r^2))/r1; angle = atan2(side*Y, side*X)",
    )?;
    // ∫a/r² dt = angle/2√Λ, where Λ = 0: as/(rX).
    let squared = space.dag().powi(root, 2);
    let is_square = squared == lambda;
    let time = match is_square && space.set(lambda) != 0 && space.active(lambda).is_empty() {
        true => names.one(space.dag(), "angle/(2*root)")?,
        false => names.one(space.dag(), "pick(0 < l, angle/(2*root), a*s/(r*X))")?,
    };
    let mut motion = flow(space, lambda, time)?.motion;
    let (r1, p1) = (names.get("r1")?, names.get("p1")?);
    motion.set(r, r1);
    motion.set(p, p1);
    let dag = space.dag();
    // Past the centre only a motion with an angle goes on.
    let zero = dag.integer(0);
    let ahead = dag.mul(&[names.get("side")?, names.get("X")?]);
    let (turns, ahead) = (dag.less(zero, squared), dag.less(zero, ahead));
    let either = dag.or(turns, ahead);
    motion.domain.push(either);
    Some(motion)
}

/// Whether numbers say that h is not a·(p² + Λ/f(x)).
pub(super) fn is_not_central(space: &mut Space, h: Node, pair: usize, f: fn(f64) -> f64) -> bool {
    let mut at = |x: f64, p: f64| {
        let mut point = space.point();
        (point[2 * pair], point[2 * pair + 1]) = (x, p);
        space.value_at(h, &point)
    };
    let (x, y) = (0.8, 1.3);
    let (here, there) = (at(x, 0.0), at(y, 0.0));
    let (kinetic, far) = (at(x, 1.0) - here, at(y, 1.0) - there);
    differ(kinetic, far)
        || differ(4.0 * kinetic, at(x, 2.0) - here)
        || differ(here * f(x), there * f(y))
}

/// A sum without one of its terms, which must not be computed as a difference.
fn terms_without(space: &mut Space, h: Node, term: Node) -> Node {
    let dag = space.dag();
    dag.sub(h, term)
}

/// Each term of a sum times a factor, so that terms cancel.
fn distributed(space: &mut Space, sum: Node, factor: Node) -> Node {
    use crate::dag::Kind;
    let dag = space.dag();
    match dag.kind(sum).clone() {
        Kind::Sum(c, terms) => {
            let constant = dag.constant(c);
            let mut all: Vec<(Rational, Node)> = terms
                .into_iter()
                .map(|(k, node)| (k, dag.mul(&[node, factor])))
                .collect();
            all.push((Rational::ONE, dag.mul(&[constant, factor])));
            dag.linear(&Rational::ZERO, &all)
        }
        _ => dag.mul(&[sum, factor]),
    }
}
