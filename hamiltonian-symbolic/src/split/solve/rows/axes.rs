//! The components M₁ and M₂ of the angular momentum along body axes, in Euler angles (φ, θ, ψ):
//! M₁ = ((p_φ − p_ψ cosθ)sinψ + p_θ sinθ cosψ)/sinθ, M₂ = ((p_φ − p_ψ cosθ)cosψ − p_θ sinθ sinψ)/sinθ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: h = κ·M² with κ constant is proven; φ may be
//! missing in h, as p_φ = const. The flow turns the other two components and the vertical γ about
//! the axis; angles are followed from where they are, without branch cuts.

use super::circle::SWEPT;
use crate::dag::Node;
use crate::flow::Motion;
use crate::formula::Names;
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
            for side in SIDES {
                if let Some(motion) = about(space, h, s, [third, theta, psi], side) {
                    return Some(motion);
                }
            }
        }
    }
    None
}

fn about(
    space: &mut Space,
    h: Node,
    s: Node,
    [phi, theta, psi]: [usize; 3],
    (quarter, sides): (f64, &str),
) -> Option<Motion> {
    // Numbers say first that h/M² is no constant.
    let set = space.set(h);
    let [here, there] = [0.0, 1.0].map(|step| {
        let point = space.point_off(&[(set, step)]);
        let at = |pair: usize, side: usize| point[2 * pair + side];
        let (st, ct) = at(theta, 0).sin_cos();
        let (sp, cp) = (at(psi, 0) + quarter).sin_cos();
        let flat = (at(phi, 1) - at(psi, 1) * ct) / st;
        let m = flat * sp + at(theta, 1) * cp;
        space.value_at(h, &point) / (m * m)
    });
    if differ(here, there) {
        return None;
    }
    let [(f, pf), (th, pt), (ps, pp)] = [phi, theta, psi].map(|pair| space.pairs[pair]);
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
         k = abs(g1); rest = g2^2 + g3^2; side = sign(g1); chi0 = atan2(g2, g3); \
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
    motion.set(th, names.get("th1")?);
    motion.set(ps, names.get("ps1")?);
    motion.set(pt, names.get("pt1")?);
    motion.set(pp, names.get("pp1")?);
    let turned = names.get("f1")?;
    motion.add(space.dag(), f, turned);
    Some(motion)
}
