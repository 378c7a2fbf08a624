//! G(L, ρ², c) with L = x·p_y − y·p_x: a kick along the radius, then a turn by s·∂G/∂L. x may be scaled.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: {h, L} = 0 and x·h_{p_x} + y·h_{p_y} = 0 are
//! proven, so that the momenta stand in h through L alone; no orbit crosses a jump or a kink of h.

use crate::algebra::ball::Ball;
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::space::{Space, Variables};
use crate::model::Motion;
use crate::rational::Rational;

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [a, b] = active.as_slice() else {
        return None;
    };
    let mut scale = Rational::ONE;
    if is_not_turned(space, h, [*a, *b], &scale) {
        scale = scale_of(space, h, [*a, *b])?;
        if is_not_turned(space, h, [*a, *b], &scale) {
            return None;
        }
    }
    let over = scale.recip()?;
    let ((x, px), (y, py)) = (space.pairs[*a], space.pairs[*b]);
    let dag = space.dag();
    let (scaled, p_scaled) = (dag.scale(&scale, x), dag.scale(&over, px));
    let mut names = Names::of(&[
        ("x0", x),
        ("x", scaled),
        ("y", y),
        ("px", p_scaled),
        ("py", py),
        ("s", s),
    ]);
    let l = names.one(space.dag(), "x*py - y*px")?;
    if !space.brackets_vanish(h, l) {
        return None;
    }
    let one = Rational::ONE;
    for (name, leaf, k) in [
        ("hx", x, &over),
        ("hy", y, &one),
        ("hpx", px, &scale),
        ("hpy", py, &one),
    ] {
        let slope = space.d(h, leaf);
        let slope = space.dag().scale(k, slope);
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
    for (leaf, name, k) in [
        (x, "x1", &over),
        (y, "y1", &one),
        (px, "px1", &scale),
        (py, "py1", &one),
    ] {
        let image = names.get(name)?;
        let image = space.dag().scale(k, image);
        motion.set(leaf, image);
    }
    let own = Variables::of_pairs(&[*a, *b]);
    let rest = space.set(h).without(own);
    for one in rest.members() {
        let inert = space.variable(one);
        let slope = space.d(h, inert);
        let kick = space.dag().mul(&[slope, s]);
        space.push(&mut motion, one, kick);
    }
    Some(motion)
}

/// Returns true if numbers say that h changes where the point is turned and kicked along its radius.
fn is_not_turned(space: &mut Space, h: Node, pairs: [usize; 2], scale: &Rational) -> bool {
    let mut here = space.point();
    // The point in the scaled variables, and back.
    let scaled = |point: &[Ball], up: Ball| {
        let mut point = point.to_vec();
        let (x, px) = (2 * pairs[0], 2 * pairs[0] + 1);
        point[x] = point[x] * up;
        point[px] = point[px] * up.powi(-1);
        point
    };
    let scale = Ball::from(scale);
    let start = scaled(&here, scale.powi(-1));
    let mut there = here.clone();
    let [c, s] = [4, 3].map(|n| Ball::from(&Rational::new(n, 5)));
    for side in 0..2 {
        let [x, y] = pairs.map(|pair| 2 * pair + side);
        there[x] = c * here[x] - s * here[y];
        there[y] = s * here[x] + c * here[y];
    }
    for pair in pairs {
        there[2 * pair + 1] = there[2 * pair + 1] + Ball::exact(0.25) * there[2 * pair];
    }
    here = start;
    let there = scaled(&there, scale.powi(-1));
    space.value_at(h, &here).differs(space.value_at(h, &there))
}

/// A guess of the number k for which h is a function of L = k·x·p_y − y·p_x/k: {h, L} = 0 gives its square.
fn scale_of(space: &mut Space, h: Node, pairs: [usize; 2]) -> Option<Rational> {
    let [(x, px), (y, py)] = pairs.map(|pair| space.pairs[pair]);
    let slopes = [x, px, y, py].map(|leaf| space.d(h, leaf));
    let square = space.fraction(|space, point| {
        let [hx, hpx, hy, hpy] = slopes.map(|slope| space.value_at(slope, point));
        let [x, px, y, py] = [x, px, y, py].map(|leaf| space.value_at(leaf, point));
        (y * hx - px * hpy) * (x * hy - py * hpx).powi(-1)
    });
    square?.sqrt()
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
    let off = names.one(space.dag(), "(x*hpy - y*hpx)/(x^2 + y^2)")?;
    // On the axis the point rests and the momenta turn, if they are not 0.
    let zero = space.dag().integer(0);
    let there = space.at(h, &[(names.get("x0")?, zero), (names.get("y")?, zero)]);
    if !space.value(there).is_defined() {
        return Some(off);
    }
    let on = names.one(
        space.dag(),
        "pick(0 < px^2 + py^2, (hx*py - hy*px)/(px^2 + py^2), 0)",
    )?;
    let is_off = names.one(space.dag(), "0 < x^2 + y^2")?;
    Some(space.dag().select(is_off, off, on))
}
