//! a·(p² + Λ/sin²θ): the unit vector at θ turns at the constant rate w, w² = p² + Λ/sin²θ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: Λ is proven free of θ and p and meets no pair
//! of its own; its conjugates move by the angle of the turn seen from the pole.

use super::flight::central;
use crate::algebra::ball::Ball;
use crate::dag::Node;
use crate::flows::solve::part;
use crate::flows::space::Space;
use crate::model::Motion;
use crate::op::Op;

/// The growth of χ + atan2((C − k)·sinχ·cosχ, k·cos²χ + C·sin²χ) from χ₀ to χ₁: a continuous branch of
/// atan2(C·sinχ, k·cosχ), with the difference C − k given by itself.
pub(super) const SWEPT: &str = "\
    angle0 = chi0 + atan2(less*sin(chi0)*cos(chi0), k*cos(chi0)^2 + C*sin(chi0)^2); \
    angle1 = chi1 + atan2(less*sin(chi1)*cos(chi1), k*cos(chi1)^2 + C*sin(chi1)^2); \
    angle = angle1 - angle0";

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [pair] = active.as_slice() else {
        return None;
    };
    let mut names = central(space, *pair, h, "sin(x)", |x| Ball::call(Op::Sin, &[x]))?;
    names.set("s", s);
    let (theta, p) = space.pairs[*pair];
    let (lambda, root) = (names.get("l")?, names.get("root")?);
    names.read(
        space.dag(),
        "size = abs(root); w = hypot(p, size/f); turn = 2*a*w*s; \
         c = cos(x); d = 0 - f*p/w; ct = cos(turn); st = sin(turn); \
         c1 = c*ct + d*st; d1 = d*ct - c*st; f1 = sign(f)*hypot(d1, size/w); \
         x1 = x + atan2(f1*c - c1*f, c1*c + f1*f); p1 = 0 - w*d1/f1",
    )?;
    // With Λ = 0 the turn is along a meridian, and goes through the poles.
    names.read(
        space.dag(),
        "D = 2*a*s*p; along = pick(0 < size, x1, x + D); still = pick(0 < size, p1, p)",
    )?;
    let mut motion = Motion::default();
    let squared = space.dag().powi(root, 2);
    let is_square = squared == lambda;
    if !space.set(lambda).is_empty() {
        // ∫a/sin²θ dt = Δ𝓕(χ; 1, √Λ/w)/2√Λ
        names.read(
            space.dag(),
            "C = 1; k = size/w; chi0 = atan2(0 - d, c); chi1 = chi0 + turn; \
             less = d^2/((1 + k)) + c^2/(1 + k)",
        )?;
        names.read(space.dag(), SWEPT)?;
        let time = match is_square {
            // The flow of Λ has a factor √Λ, which takes this one away.
            true => names.one(space.dag(), "sign(root)*pick(0 < size, angle, 0)/(2*root)")?,
            false => names.one(
                space.dag(),
                "pick(0 < size, angle/(2*root), a*s*pick(0 < abs(D), sin(D)/D, 1)/(f*sin(x + D)))",
            )?,
        };
        motion = part(space, lambda, time)?.motion;
    }
    if !is_square && !space.dag().is_nonnegative(lambda) {
        let zero = space.dag().integer(0);
        let below = space.dag().less(lambda, zero);
        let inside = space.dag().not(below);
        motion.domain.push(inside);
    }
    motion.set(theta, names.get("along")?);
    motion.set(p, names.get("still")?);
    Some(motion)
}
