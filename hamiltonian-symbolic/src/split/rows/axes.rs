//! The components M₁ and M₂ of the angular momentum along body axes, in Euler angles (φ, θ, ψ):
//! M₁ = ((p_φ − p_ψ cosθ)sinψ + p_θ sinθ cosψ)/sinθ, M₂ = ((p_φ − p_ψ cosθ)cosψ − p_θ sinθ sinψ)/sinθ.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: h = κ·M² with κ constant is proven; φ may be
//! missing in h, as p_φ = const. The flow turns the other two components and the vertical γ about
//! the axis; angles are followed from where they are, without branch cuts.

use super::circle::SWEPT;
use crate::dag::Node;
use crate::formula::Names;
use crate::rational::Rational;
use crate::split::motion::Motion;
use crate::split::space::{Space, differ};

/// The turn about the first axis (M₂, M₃) and (γ₂, γ₃), and about the second (M₁, M₃), (γ₁, γ₃).
const FIRST: &str = "M = M1; st = sin(w); ct = cos(w); \
    N1 = M1; N2 = M2*ct + M3*st; N3 = M3*ct - M2*st; \
    g4 = g1; g5 = g2*ct + g3*st; g6 = g3*ct - g2*st; \
    k = abs(g1); rest = g2^2 + g3^2; side = sign(g1); chi0 = atan2(g2, g3); \
    turned = atan2(g4*g2 - g5*g1, g5*g2 + g4*g1)";
const SECOND: &str = "M = M2; st = sin(w); ct = cos(w); \
    N2 = M2; N1 = M1*ct - M3*st; N3 = M3*ct + M1*st; \
    g5 = g2; g4 = g1*ct - g3*st; g6 = g3*ct + g1*st; \
    k = abs(g2); rest = g1^2 + g3^2; side = sign(g2); chi0 = atan2(0 - g1, g3); \
    turned = 0 - atan2(g5*g1 - g4*g2, g4*g1 + g5*g2)";

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
            for axis in [FIRST, SECOND] {
                if let Some(motion) = about(space, h, s, [third, theta, psi], axis) {
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
    axis: &str,
) -> Option<Motion> {
    // Numbers say first that h/M² is no constant.
    let set = space.set(h);
    let [here, there] = [0.0, 1.0].map(|step| {
        let point = space.point_off(&[(set, step)]);
        let at = |pair: usize, side: usize| point[2 * pair + side];
        let (st, ct) = at(theta, 0).sin_cos();
        let (sp, cp) = at(psi, 0).sin_cos();
        let flat = (at(phi, 1) - at(psi, 1) * ct) / st;
        let m = match axis {
            FIRST => flat * sp + at(theta, 1) * cp,
            _ => flat * cp - at(theta, 1) * sp,
        };
        space.value_at(h, &point) / (m * m)
    });
    if differ(here, there) {
        return None;
    }
    let [(f, pf), (th, pt), (ps, pp)] = [phi, theta, psi].map(|pair| space.pairs[pair]);
    let mut names = Names::of(&[("th", th), ("ps", ps), ("pf", pf), ("pt", pt), ("pp", pp)]);
    names.read(
        space.dag(),
        "sth = sin(th); cth = cos(th); sps = sin(ps); cps = cos(ps); \
         flat = (pf - pp*cth)/sth; M1 = flat*sps + pt*cps; M2 = flat*cps - pt*sps; M3 = pp; \
         g1 = sth*sps; g2 = sth*cps; g3 = cth",
    )?;
    let m = names.get(if axis == FIRST { "M1" } else { "M2" })?;
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
    names.read(space.dag(), axis)?;
    names.read(
        space.dag(),
        "upright = hypot(g4, g5); side_th = sign(sth); sth1 = side_th*upright; \
         th1 = th + atan2(sth1*cth - g6*sth, g6*cth + sth1*sth); \
         ps1 = ps + turned; C = 1; chi1 = chi0 + w; less = rest/(1 + k)",
    )?;
    names.read(space.dag(), SWEPT)?;
    names.read(
        space.dag(),
        "f1 = side*angle; pt1 = side_th*(N1*g5 - N2*g4)/upright; pp1 = N3",
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
