//! b·(p² + Λ/sin²θ): the unit vector at θ turns at the constant rate w, w² = p² + Λ/sin²θ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: Λ is proven free of θ and p and meets no pair
//! of its own; its conjugates move by the angle of the turn seen from the pole.

use super::flight::is_not_central;
use crate::dag::Node;
use crate::formula::Names;
use crate::op::Op;
use crate::rational::Rational;
use crate::split::motion::Motion;
use crate::split::solve::flow;
use crate::split::space::Space;

/// χ + atan2((C − k)·sinχ·cosχ, k·cos²χ + C·sin²χ): a continuous branch of atan2(C·sinχ, k·cosχ),
/// with the difference C − k given by itself.
pub(super) const TURN: &str = "chi + atan2(less*sin(chi)*cos(chi), k*cos(chi)^2 + C*sin(chi)^2)";

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [pair] = active.as_slice() else {
        return None;
    };
    if is_not_central(space, h, *pair, |theta| theta.sin().powi(2)) {
        return None;
    }
    let (theta, p) = space.pairs[*pair];
    let (own, set) = (3 << (2 * pair), space.set(h));
    let slope = space.d(h, p);
    let slope = space.d(slope, p);
    let b = space.section(slope, set);
    let b = space.dag().scale(&Rational::new(1, 2), b);
    if space.sign(b) == Some(0) {
        return None;
    }
    let sine = space.dag().call(Op::Sin, &[theta]);
    // Λ by the section p = 0.
    let zero = space.dag().integer(0);
    let rest = space.at(h, &[(p, zero)]);
    let lambda = space
        .dag()
        .product(&Rational::ONE, &[(rest, 1), (sine, 2), (b, -1)]);
    let lambda = space.section(lambda, own);
    let mut names = Names::of(&[
        ("theta", theta),
        ("p", p),
        ("b", b),
        ("l", lambda),
        ("sine", sine),
        ("s", s),
    ]);
    let form = names.one(space.dag(), "b*(p^2 + l/sine^2)")?;
    if !space.same(h, form) {
        return None;
    }
    let root = super::root(space, lambda);
    names.set("root", root);
    names.read(
        space.dag(),
        "size = abs(root); w = hypot(p, size/sine); turn = 2*b*w*s; \
         c = cos(theta); d = 0 - sine*p/w; ct = cos(turn); st = sin(turn); \
         c1 = c*ct + d*st; d1 = d*ct - c*st; sine1 = sign(sine)*hypot(d1, size/w); \
         theta1 = theta + atan2(sine1*c - c1*sine, c1*c + sine1*sine); p1 = 0 - w*d1/sine1",
    )?;
    let mut motion = Motion::default();
    if space.set(lambda) != 0 {
        // ∫b/sin²θ dt = Δ𝓕(χ; 1, √Λ/w)/2√Λ
        names.read(
            space.dag(),
            "C = 1; k = size/w; chi0 = atan2(0 - d, c); chi1 = chi0 + turn; \
             less = d^2/((1 + k)) + c^2/(1 + k)",
        )?;
        let mut ends = Vec::new();
        for end in ["chi0", "chi1"] {
            let chi = names.get(end)?;
            names.set("chi", chi);
            ends.push(names.one(space.dag(), TURN)?);
        }
        let angle = space.dag().sub(ends[1], ends[0]);
        names.set("angle", angle);
        let squared = space.dag().powi(root, 2);
        let time = match squared == lambda {
            true => names.one(space.dag(), "sign(root)*angle/(2*root)")?,
            false => names.one(space.dag(), "angle/(2*root)")?,
        };
        motion = flow(space, lambda, time)?.motion;
    }
    let positive = names.one(space.dag(), "root^2")?;
    motion.asks(space.dag(), positive);
    motion.set(theta, names.get("theta1")?);
    motion.set(p, names.get("p1")?);
    Some(motion)
}
