//! a·(p² + Λ/r²): X = r + 2ats·p, Y = 2as·√Λ/r, a straight line; Λ acts for the angle it turns.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: Λ is free of r and p and has a flow of its own.

use crate::algebra::ball::Ball;
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::solve::growth::{arctangent, near_zero};
use crate::flows::solve::part;
use crate::flows::solve::units::distributed;
use crate::flows::space::{Space, Variables};
use crate::model::Motion;
use crate::rational::Rational;

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    active.into_iter().find_map(|pair| along(space, pair, h, s))
}

fn along(space: &mut Space, pair: usize, h: Node, s: Node) -> Option<Motion> {
    let mut names = central(space, pair, h, "x", |r| r)?;
    names.set("s", s);
    let (r, p) = space.pairs[pair];
    let (lambda, root) = (names.get("l")?, names.get("root")?);
    if space.dag().is_zero(lambda) {
        return None;
    }
    let squared = space.dag().powi(root, 2);
    let is_square = squared == lambda;
    if !is_square && !space.dag().is_nonnegative(lambda) {
        return of_either_sign(space, (r, p), lambda, names);
    }
    names.read(
        space.dag(),
        "X = x + 2*a*s*p; Y = 2*a*s*root/x; side = sign(x); x1 = side*hypot(X, Y); \
         p1 = (x*p + 2*a*s*(p^2 + root^2/x^2))/x1; angle = atan2(side*Y, side*X)",
    )?;
    // ∫a/r² dt = angle/2√Λ, where Λ = 0: as/(rX).
    let time = match is_square && !space.set(lambda).is_empty() && space.active(lambda).is_empty() {
        true => names.one(space.dag(), "angle/(2*root)")?,
        false => names.one(space.dag(), "pick(0 < l, angle/(2*root), a*s/(x*X))")?,
    };
    let mut motion = part(space, lambda, time)?.motion;
    let (r1, p1) = (names.get("x1")?, names.get("p1")?);
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

/// The flow for Λ of either sign: r₁² = X² + Λ(2as/r)², and the orbit ends at the centre.
fn of_either_sign(
    space: &mut Space,
    (r, p): (Node, Node),
    lambda: Node,
    mut names: Names,
) -> Option<Motion> {
    names.read(
        space.dag(),
        "v = 2*a*s/x; X = x + v*x*p; side = sign(x); square = X^2 + l*v^2; x1 = side*sqrt(square); \
         p1 = (x*p + v*(x*p^2 + l/x))/x1",
    )?;
    let mut motion = Motion::default();
    if !space.set(lambda).is_empty() {
        // ∫a/r² dt = arctan(√Λ·v/X)/2√Λ = v/2X·artanh(√z)/√z with z = −Λ(v/X)².
        names.read(space.dag(), "u = v/X; z = 0 - l*u^2")?;
        let z = names.get("z")?;
        let series = arctangent(space, z);
        names.set("T", series);
        let small = near_zero(space, z);
        let ahead = names.one(space.dag(), "0 < side*X")?;
        let near = space.dag().and(small, ahead);
        let far = names.one(
            space.dag(),
            "pick(0 < l, atan2(side*root*v, side*X)/(2*root), atanh(sqrt(0 - l)*u)/(2*sqrt(0 - l)))",
        )?;
        let series = names.one(space.dag(), "u*T/2")?;
        let time = space.dag().select(near, series, far);
        motion = part(space, lambda, time)?.motion;
    }
    motion.set(r, names.get("x1")?);
    motion.set(p, names.get("p1")?);
    let (positive, turns, ahead) = (
        names.one(space.dag(), "0 < square")?,
        names.one(space.dag(), "0 < l")?,
        names.one(space.dag(), "0 < side*X")?,
    );
    let either = space.dag().or(turns, ahead);
    motion.domain.extend([positive, either]);
    Some(motion)
}

/// The names x, p, a, f, l and root of h = a·(p² + Λ/f²), where Λ is free of x and p, f is a formula
/// of x, and root is √Λ.
pub(super) fn central(
    space: &mut Space,
    pair: usize,
    h: Node,
    f: &str,
    value: fn(Ball) -> Ball,
) -> Option<Names> {
    if is_not_central(space, h, pair, value) {
        return None;
    }
    let (x, p) = space.pairs[pair];
    let (own, set) = (Variables::of_pairs(&[pair]), space.set(h));
    let slope = space.d(h, p);
    let slope = space.d(slope, p);
    let a = space.section(slope, set);
    let a = space.dag().scale(&Rational::new(1, 2), a);
    if space.sign(a) == Some(0) {
        return None;
    }
    let mut names = Names::of(&[("x", x), ("p", p), ("a", a)]);
    let f = names.one(space.dag(), f)?;
    names.set("f", f);
    // Λ is f²·h/a where p = 0, term by term, so that f cancels.
    let zero = space.dag().integer(0);
    let rest = space.at(h, &[(p, zero)]);
    let over = space.dag().product(&Rational::ONE, &[(f, 2), (a, -1)]);
    let terms = distributed(space.dag(), rest, over);
    let lambda = space.dag().add(&terms);
    let lambda = space.section(lambda, own);
    names.set("l", lambda);
    let form = names.one(space.dag(), "a*(p^2 + l/f^2)")?;
    if !space.same(h, form) {
        return None;
    }
    let root = super::root(space, lambda);
    names.set("root", root);
    Some(names)
}

/// Returns true if numbers say that h is not a·(p² + Λ/f²).
fn is_not_central(space: &mut Space, h: Node, pair: usize, f: fn(Ball) -> Ball) -> bool {
    let mut at = |x: Ball, p: f64| {
        let mut point = space.point();
        (point[2 * pair], point[2 * pair + 1]) = (x, Ball::exact(p));
        space.value_at(h, &point)
    };
    let [x, y] = [0.8, 1.3].map(Ball::exact);
    let (here, there) = (at(x, 0.0), at(y, 0.0));
    let (kinetic, far) = (at(x, 1.0) - here, at(y, 1.0) - there);
    kinetic.differs(far)
        || (Ball::exact(4.0) * kinetic).differs(at(x, 2.0) - here)
        || (here * f(x).powi(2)).differs(there * f(y).powi(2))
}
