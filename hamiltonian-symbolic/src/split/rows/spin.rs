//! A component of a spin in a chart, K(l, L) with K² + (K_l/c)²·… : N = K_l, N_l = −K, and
//! (K, N/c, L) turns about its first axis at the rate c; the length C may depend on other variables.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: (N_l·K_L − N_L·K_l) = c²·L and C² = (K² + N²)/c² + L²
//! free of l and L are proven; K keeps its sign, so that the angles are followed without branch cuts.

use super::Axes;
use super::circle::SWEPT;
use crate::dag::{Kind, Node};
use crate::flow::Motion;
use crate::formula::Names;
use crate::op::Op;
use crate::rational::Rational;
use crate::split::space::{Space, bits, differ};

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [pair] = active.as_slice() else {
        return None;
    };
    let (q, p) = space.pairs[*pair];
    for axes in Axes::both(q, p) {
        if let Some(motion) = component(space, axes, h, s, false) {
            return Some(motion);
        }
        let Some(root) = square_root(space, h) else {
            continue;
        };
        // h = κK²: K acts for the time 2κK·s.
        let ratio = space.dag().product(&Rational::ONE, &[(h, 1), (root, -2)]);
        let set = space.set(h);
        let Some(k) = space.free(ratio, set) else {
            continue;
        };
        let time = space
            .dag()
            .product(&Rational::integer(2), &[(k, 1), (root, 1), (s, 1)]);
        if let Some(motion) = component(space, axes, root, time, true) {
            return Some(motion);
        }
    }
    None
}

/// The root of a product, up to a constant: even powers halved, of the others the root.
fn square_root(space: &mut Space, h: Node) -> Option<Node> {
    let dag = space.dag();
    let Kind::Product(_, factors) = dag.kind(h).clone() else {
        return None;
    };
    let moving = crate::dag::Dependence::MOVING;
    let mut halves = Vec::new();
    for (node, n) in factors {
        if !dag.dependence(node).on(moving) {
            continue;
        }
        if n % 2 == 0 {
            halves.push((node, n / 2));
        } else {
            let root = dag.call(Op::Sqrt, &[node]);
            halves.push((root, n));
        }
    }
    Some(dag.product(&Rational::ONE, &halves))
}

fn component(space: &mut Space, axes: Axes, k: Node, s: Node, is_squared: bool) -> Option<Motion> {
    let y = axes.y(space);
    let l = axes.x;
    // K_ll = −K changes its sign in half a turn.
    let (mut here, bit) = (space.point(), space.set(l).trailing_zeros() as usize);
    let before = space.value_at(k, &here);
    here[bit] += std::f64::consts::PI;
    if differ(before, -space.value_at(k, &here)) {
        return None;
    }
    let own = space.set(l) | space.set(y);
    let n = space.d(k, l);
    let nl = space.d(n, l);
    let minus = space.dag().neg(k);
    if !space.same(nl, minus) {
        return None;
    }
    let (kl, nl_of) = (axes.dy(space, k), axes.dy(space, n));
    let mut names = Names::of(&[
        ("K", k),
        ("N", n),
        ("L", y),
        ("s", s),
        ("KL", kl),
        ("NL", nl_of),
        ("l", l),
    ]);
    let rate = names.one(space.dag(), "(0 - K*KL - NL*N)/L")?;
    let set = space.set(k);
    let rate = space.free(rate, set)?;
    if space.sign(rate) == Some(0) || space.sign(rate) == Some(-1) {
        return None;
    }
    let c = super::root(space, rate);
    names.set("c", c);
    let square = names.one(space.dag(), "(K^2 + N^2)/c^2 + L^2")?;
    let square = space.free(square, own)?;
    names.set("square", square);
    let rest = space.set(k) & !own;
    names.read(
        space.dag(),
        "ct = cos(c*s); st = sin(c*s); L1 = L*ct - N*st/c; N1 = N*ct + c*L*st; \
         l1 = l + atan2(K*(N - N1), K^2 + N*N1)",
    )?;
    let mut motion = Motion::default();
    motion.set(l, names.get("l1")?);
    let y1 = names.get("L1")?;
    let y1 = axes.signed(space, y1);
    motion.set(axes.leaf, y1);
    if rest != 0 {
        names.read(
            space.dag(),
            "C = sqrt(square); k = abs(K)/c; less = ((N/c)^2 + L^2)/(C + k); \
             chi0 = atan2(N/c, L); chi1 = chi0 + c*s",
        )?;
        names.read(space.dag(), SWEPT)?;
        let angle = names.one(space.dag(), "sign(K)*angle")?;
        let length = names.get("C")?;
        for bit in bits(rest) {
            let inert = space.variable(bit);
            // C is free of the turning components, as was proven above.
            let slope = space.d(length, inert);
            let moved = space.dag().mul(&[slope, angle]);
            space.push(&mut motion, bit, moved);
        }
    }
    if !is_squared {
        let size = names.one(space.dag(), "K^2")?;
        motion.asks(space.dag(), size);
    }
    Some(motion)
}
