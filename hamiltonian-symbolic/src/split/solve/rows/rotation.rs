//! G(L, ρ², c) with L = x·p_y − y·p_x: a kick along the radius, then a turn by s·∂G/∂L.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: {h, L} = 0 and x·h_{p_x} + y·h_{p_y} = 0 are
//! proven, so that the momenta stand in h through L alone; no orbit crosses a jump or a kink of h.

use crate::dag::Node;
use crate::flow::Motion;
use crate::formula::Names;
use crate::split::space::{Space, bits, differ};

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [a, b] = active.as_slice() else {
        return None;
    };
    if is_not_turned(space, h, [*a, *b]) {
        return None;
    }
    let ((x, px), (y, py)) = (space.pairs[*a], space.pairs[*b]);
    let mut names = Names::of(&[("x", x), ("y", y), ("px", px), ("py", py), ("s", s)]);
    let l = names.one(space.dag(), "x*py - y*px")?;
    if !space.brackets_vanish(h, l) {
        return None;
    }
    for (name, leaf) in [("hx", x), ("hy", y), ("hpx", px), ("hpy", py)] {
        let slope = space.d(h, leaf);
        names.set(name, slope);
    }
    let radial = names.one(space.dag(), "x*hpx + y*hpy")?;
    if !space.is_zero(radial) || !space.stays_smooth(h, h) {
        return None;
    }
    // ∂G/∂L: as it stands in h where that is plain, else by the angle that the point turns.
    let g = rate(space, h, l, &names)?;
    names.set("g", g);
    names.read(
        space.dag(),
        "kx = px - s*(hx - g*py); ky = py - s*(hy + g*px); \
         c = cos(s*g); d = sin(s*g); x1 = c*x - d*y; y1 = d*x + c*y; \
         px1 = c*kx - d*ky; py1 = d*kx + c*ky",
    )?;
    let mut motion = Motion::default();
    for (leaf, name) in [(x, "x1"), (y, "y1"), (px, "px1"), (py, "py1")] {
        motion.set(leaf, names.get(name)?);
    }
    let own = 3 << (2 * a) | 3 << (2 * b);
    let rest = space.set(h) & !own;
    for bit in bits(rest) {
        let inert = space.variable(bit);
        let slope = space.d(h, inert);
        let kick = space.dag().mul(&[slope, s]);
        space.push(&mut motion, bit, kick);
    }
    Some(motion)
}

/// Whether numbers say that h changes where the point is turned and kicked along its radius.
fn is_not_turned(space: &mut Space, h: Node, pairs: [usize; 2]) -> bool {
    let here = space.point();
    let mut there = here.clone();
    let (c, s) = (0.8, 0.6);
    for side in 0..2 {
        let [x, y] = pairs.map(|pair| 2 * pair + side);
        there[x] = c * here[x] - s * here[y];
        there[y] = s * here[x] + c * here[y];
    }
    for pair in pairs {
        there[2 * pair + 1] += 0.25 * there[2 * pair];
    }
    differ(space.value_at(h, &here), space.value_at(h, &there))
}

/// ∂G/∂L
fn rate(space: &mut Space, h: Node, l: Node, names: &Names) -> Option<Node> {
    let slope = space.by_node(h, l);
    let (hpx, x, hpy, y) = (
        names.get("hpx")?,
        names.get("x")?,
        names.get("hpy")?,
        names.get("y")?,
    );
    let ahead = space.dag().mul(&[slope, x]);
    let aside = space.dag().mul(&[slope, y]);
    let aside = space.dag().neg(aside);
    if space.same(hpy, ahead) && space.same(hpx, aside) {
        return Some(slope);
    }
    names.one(space.dag(), "(x*hpy - y*hpx)/(x^2 + y^2)")
}
