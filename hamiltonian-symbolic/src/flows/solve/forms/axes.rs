//! The components M₁ and M₂ of the angular momentum along body axes, in Euler angles (φ, θ, ψ):
//! M₁ = ((p_φ − p_ψ cosθ)sinψ + p_θ sinθ cosψ)/sinθ, M₂ = ((p_φ − p_ψ cosθ)cosψ − p_θ sinθ sinψ)/sinθ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: h = κ·M² with κ constant is proven; φ may be
//! missing in h, as p_φ = const; the variables may be scaled. The flow turns the other two components and the vertical γ about
//! the axis; angles are followed from where they are, without branch cuts.

use super::circle::SWEPT;
use crate::algebra::ball::Ball;
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::space::{Space, Variable};
use crate::model::Motion;
use crate::op::Op;
use crate::rational::Rational;

/// The sine and cosine of ψ, and of ψ − π/2: M₂ is −M₁ a quarter of a turn back. Before them, the quarters of a
/// turn to the ψ whose sine is 1.
const SIDES: [(i64, &str); 2] = [
    (1, "sps = sin(ps); cps = cos(ps)"),
    (2, "sps = 0 - cos(ps); cps = sin(ps)"),
];

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [a, b] = active.as_slice() else {
        return None;
    };
    let set = space.set(h);
    for third in 0..space.pairs.len() {
        // p_φ stands in h, φ does not.
        let [angle, momentum] = Variable::pair(third);
        if set.has(angle) || !set.has(momentum) {
            continue;
        }
        for (theta, psi) in [(*a, *b), (*b, *a)] {
            for scale in super::rates(space, h, space.pairs[theta].0) {
                for turn in super::rates(space, h, space.pairs[psi].0) {
                    let angles = [(theta, &scale), (psi, &turn)];
                    let Some(own) = scale_of_third(space, h, third, angles) else {
                        continue;
                    };
                    for side in SIDES {
                        if let Some(motion) = about(space, h, s, (third, &own), angles, side) {
                            return Some(motion);
                        }
                    }
                }
            }
        }
    }
    None
}

/// A guess of the number k for which φ is scaled: in κ·M², ∂²h/∂p_φ² is −k/cosθ of ∂²h/∂p_φ∂p_ψ.
fn scale_of_third(
    space: &mut Space,
    h: Node,
    phi: usize,
    [(theta, scale), (psi, turn)]: [(usize, &Rational); 2],
) -> Option<Rational> {
    let [(_, pf), (x, _), (_, pp)] = [phi, theta, psi].map(|pair| space.pairs[pair]);
    let slope = space.d(h, pf);
    let (own, mixed) = (space.d(slope, pf), space.d(slope, pp));
    let angle = space.dag().scale(scale, x);
    let cosine = space.dag().call(Op::Cos, &[angle]);
    let over = turn.recip()?.neg();
    let k = space
        .dag()
        .product(&over, &[(own, 1), (cosine, 1), (mixed, -1)]);
    space.fraction(|space, point| space.value_at(k, point))
}

fn about(
    space: &mut Space,
    h: Node,
    s: Node,
    (phi, own): (usize, &Rational),
    [(theta, scale), (psi, turn)]: [(usize, &Rational); 2],
    (quarters, sides): (i64, &str),
) -> Option<Motion> {
    let (over_scale, over_turn, over_own) = (scale.recip()?, turn.recip()?, own.recip()?);
    let factors = |pair: usize| match pair {
        pair if pair == theta => (scale, &over_scale),
        pair if pair == psi => (turn, &over_turn),
        _ => (&over_own, own),
    };
    // Numbers say first that h/M² is no constant.
    let set = space.set(h);
    let right = |n: i64| Ball::from(&Rational::new(n - 1, 2)) * Ball::pi();
    let [here, there] = [0.0, 1.0].map(|step| {
        let point = space.point_off(&[(set, step)]);
        let at = |pair: usize, side: usize| {
            let (of_angle, of_momentum) = factors(pair);
            point[2 * pair + side] * Ball::from(if side == 0 { of_angle } else { of_momentum })
        };
        let of = |op: Op, angle: Ball| Ball::call(op, &[angle]);
        let (th, ps) = (at(theta, 0), at(psi, 0) - right(quarters));
        let flat = (at(phi, 1) - at(psi, 1) * of(Op::Cos, th)) * of(Op::Sin, th).powi(-1);
        let m = flat * of(Op::Sin, ps) + at(theta, 1) * of(Op::Cos, ps);
        (space.value_at(h, &point), m.powi(2))
    });
    if (here.0 * there.1).differs(there.0 * here.1) {
        return None;
    }
    let [(f, first), (x, px), (z, pz)] = [phi, theta, psi].map(|pair| space.pairs[pair]);
    let dag = space.dag();
    let (th, pt) = (dag.scale(scale, x), dag.scale(&over_scale, px));
    let (ps, pp) = (dag.scale(turn, z), dag.scale(&over_turn, pz));
    let pf = dag.scale(own, first);
    let mut names = Names::of(&[("th", th), ("ps", ps), ("pf", pf), ("pt", pt), ("pp", pp)]);
    names.read(space.dag(), sides)?;
    names.read(
        space.dag(),
        "sth = sin(th); cth = cos(th); \
         flat = (pf - pp*cth)/sth; M1 = flat*sps + pt*cps; M2 = flat*cps - pt*sps; \
         g1 = sth*sps; g2 = sth*cps; g3 = cth",
    )?;
    let m = names.get("M1")?;
    let square = space.dag().powi(m, 2);
    // κ is h where M₁ = p_φ = 1.
    let dag = space.dag();
    let pi = dag.pi();
    let half = |over: &Rational| over.mul(&Rational::new(1, 2));
    let there = [
        (x, dag.product(&half(&over_scale), &[(pi, 1)])),
        (
            z,
            dag.product(
                &half(&over_turn).mul(&Rational::integer(quarters)),
                &[(pi, 1)],
            ),
        ),
        (first, dag.constant(over_own)),
        (px, dag.integer(0)),
        (pz, dag.integer(0)),
    ];
    let k = space.at(h, &there);
    let form = space.dag().mul(&[k, square]);
    if !space.set(k).is_empty() || !space.same(h, form) {
        return None;
    }
    let w = space
        .dag()
        .product(&Rational::integer(2), &[(k, 1), (m, 1), (s, 1)]);
    names.set("w", w);
    // The turn of (M₂, M₃) and (γ₂, γ₃).
    names.read(
        space.dag(),
        "st = sin(w); ct = cos(w); N2 = M2*ct + pp*st; N3 = pp*ct - M2*st; \
         g5 = g2*ct + g3*st; g6 = g3*ct - g2*st; \
         k = abs(g1); rest = g2^2 + g3^2; side = pick(g1 < 0, -1, 1); chi0 = atan2(g2, g3); \
         turned = atan2(g1*g2 - g5*g1, g5*g2 + g1*g1); \
         upright = hypot(g1, g5); side_th = sign(sth); sth1 = side_th*upright; \
         th1 = th + atan2(sth1*cth - g6*sth, g6*cth + sth1*sth); \
         ps1 = ps + turned; C = 1; chi1 = chi0 + w; less = rest/(1 + k)",
    )?;
    names.read(space.dag(), SWEPT)?;
    names.read(
        space.dag(),
        "f1 = side*angle; pt1 = side_th*(M1*g5 - N2*g1)/upright; pp1 = N3",
    )?;
    let mut motion = Motion::default();
    let images = [
        (x, "th1", &over_scale),
        (z, "ps1", &over_turn),
        (px, "pt1", scale),
        (pz, "pp1", turn),
    ];
    for (leaf, image, k) in images {
        let image = names.get(image)?;
        let image = space.dag().scale(k, image);
        motion.set(leaf, image);
    }
    let turned = names.get("f1")?;
    let turned = space.dag().scale(own, turned);
    motion.add(space.dag(), f, turned);
    Some(motion)
}
