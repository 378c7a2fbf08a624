//! The components M₁ and M₂ of the angular momentum along body axes, in Euler angles (φ, θ, ψ):
//! M₁ = ((p_φ − p_ψ cosθ)sinψ + p_θ sinθ cosψ)/sinθ, M₂ = ((p_φ − p_ψ cosθ)cosψ − p_θ sinθ sinψ)/sinθ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: h = κ·M² with κ constant is proven; φ may be
//! missing in h, as p_φ = const; the variables of θ and ψ may be scaled. The flow turns the other two components and the vertical γ about
//! the axis; angles are followed from where they are, without branch cuts.

use super::circle::SWEPT;
use crate::dag::{Kind, Node};
use crate::flow::Motion;
use crate::formula::Names;
use crate::op::Op;
use crate::rational::Rational;
use crate::split::space::{Space, differ};
use std::f64::consts::FRAC_PI_2;

/// The sine and cosine of ψ, and of ψ − π/2: M₂ is −M₁ a quarter of a turn back.
const SIDES: [(f64, &str); 2] = [
    (0.0, "sps = sin(ps); cps = cos(ps)"),
    (-FRAC_PI_2, "sps = 0 - cos(ps); cps = sin(ps)"),
];

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [a, b] = active.as_slice() else {
        return None;
    };
    let set = space.set(h);
    for third in 0..space.pairs.len() {
        // p_φ stands in h, φ does not.
        if set >> (2 * third) & 3 != 2 {
            continue;
        }
        for (theta, psi) in [(*a, *b), (*b, *a)] {
            for scale in scales(space, h, theta) {
                for turn in scales(space, h, psi) {
                    for side in SIDES {
                        let angles = [(theta, &scale), (psi, &turn)];
                        if let Some(motion) = about(space, h, s, third, angles, side) {
                            return Some(motion);
                        }
                    }
                }
            }
        }
    }
    None
}

/// The numbers k for which h has a sine or cosine of k·x + …, with the coordinate x of a pair.
fn scales(space: &mut Space, h: Node, pair: usize) -> Vec<Rational> {
    let (x, _) = space.pairs[pair];
    let mut found = Vec::new();
    for node in space.dag().reachable(&[h]) {
        let Kind::Call(Op::Sin | Op::Cos, arguments) = space.dag().kind(node).clone() else {
            continue;
        };
        let rate = space.d(arguments[0], x);
        if let Some(rate) = space.dag().as_constant(rate).cloned()
            && !rate.is_zero()
            && !found.contains(&rate)
        {
            found.push(rate);
        }
    }
    found
}

fn about(
    space: &mut Space,
    h: Node,
    s: Node,
    phi: usize,
    [(theta, scale), (psi, turn)]: [(usize, &Rational); 2],
    (quarter, sides): (f64, &str),
) -> Option<Motion> {
    let (over_scale, over_turn) = (scale.recip()?, turn.recip()?);
    let factors = |pair: usize| match pair {
        pair if pair == theta => (scale.to_f64(), over_scale.to_f64()),
        pair if pair == psi => (turn.to_f64(), over_turn.to_f64()),
        _ => (1.0, 1.0),
    };
    // Numbers say first that h/M² is no constant.
    let set = space.set(h);
    let [here, there] = [0.0, 1.0].map(|step| {
        let point = space.point_off(&[(set, step)]);
        let at = |pair: usize, side: usize| {
            let (of_angle, of_momentum) = factors(pair);
            point[2 * pair + side] * if side == 0 { of_angle } else { of_momentum }
        };
        let (st, ct) = at(theta, 0).sin_cos();
        let (sp, cp) = (at(psi, 0) + quarter).sin_cos();
        let flat = (at(phi, 1) - at(psi, 1) * ct) / st;
        let m = flat * sp + at(theta, 1) * cp;
        space.value_at(h, &point) / (m * m)
    });
    if differ(here, there) {
        return None;
    }
    let [(f, pf), (x, px), (z, pz)] = [phi, theta, psi].map(|pair| space.pairs[pair]);
    let dag = space.dag();
    let (th, pt) = (dag.scale(scale, x), dag.scale(&over_scale, px));
    let (ps, pp) = (dag.scale(turn, z), dag.scale(&over_turn, pz));
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
    let ratio = space.dag().div(h, square);
    let k = space.section(ratio, set);
    let form = space.dag().mul(&[k, square]);
    if !space.same(h, form) {
        return None;
    }
    let k = space.free(ratio, set)?;
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
    motion.add(space.dag(), f, turned);
    Some(motion)
}
