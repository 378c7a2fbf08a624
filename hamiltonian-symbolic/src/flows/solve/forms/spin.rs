//! A component of a spin in a chart, K(l, L) with K² + (K_l/c)²·… : N = K_l, N_l = −K, and
//! (K, N/c, L) turns about its first axis at the rate c; the length C may depend on other variables.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: (N_l·K_L − N_L·K_l) = c²·L and C² = (K² + N²)/c² + L²
//! free of l and L are proven; no orbit crosses a jump or a kink of K; K keeps its sign, so that the angles are followed without branch cuts.

use super::Axes;
use super::circle::SWEPT;
use crate::algebra::ball::Ball;
use crate::algebra::formula::Names;
use crate::dag::{Kind, Node};
use crate::flows::space::Space;
use crate::model::Motion;
use crate::op::Op;
use crate::rational::Rational;

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [pair] = active.as_slice() else {
        return None;
    };
    let (q, p) = space.pairs[*pair];
    // A factor that does not move is one of the time: it may be 0.
    let (h, factor) = bare(space, h);
    let s = space.dag().mul(&[factor, s]);
    for axes in Axes::both_ways(q, p) {
        if let Some(motion) = component(space, axes, h, s, false) {
            return Some(motion);
        }
        for sign in [1, -1] {
            let Some((root, k)) = square_root(space, h, sign) else {
                continue;
            };
            // h = κK²: K acts for the time 2κK·s.
            let time = space
                .dag()
                .product(&k.mul(&Rational::integer(2)), &[(root, 1), (s, 1)]);
            if let Some(motion) = component(space, axes, root, time, true) {
                return Some(motion);
            }
        }
    }
    None
}

/// A product without the factors that do not move, and these.
fn bare(space: &mut Space, h: Node) -> (Node, Node) {
    let Kind::Product(c, factors) = space.dag().kind(h).clone() else {
        return (h, space.dag().integer(1));
    };
    let is_still = |(node, _): &(Node, i32)| space.set(*node).is_empty();
    let (still, moving): (Vec<_>, Vec<_>) = factors.into_iter().partition(is_still);
    let dag = space.dag();
    (
        dag.product(&Rational::ONE, &moving),
        dag.product(&c, &still),
    )
}

/// K and κ with κK² a product: even powers halved, of the others times a sign the root.
fn square_root(space: &mut Space, h: Node, sign: i64) -> Option<(Node, Rational)> {
    let dag = space.dag();
    let Kind::Product(mut k, factors) = dag.kind(h).clone() else {
        return None;
    };
    let mut halves = Vec::new();
    for (node, n) in factors {
        if n % 2 == 0 {
            halves.push((node, n / 2));
        } else {
            let signed = dag.scale(&Rational::integer(sign), node);
            let root = dag.call(Op::Sqrt, &[signed]);
            halves.push((root, n));
            k = k.mul(&Rational::integer(sign));
        }
    }
    Some((dag.product(&Rational::ONE, &halves), k))
}

/// Returns true if no orbit of K crosses a set where K is not smooth: K keeps its value, so that it does not
/// reach the zeros of its factors.
fn stays_smooth(space: &mut Space, k: Node) -> bool {
    let factors = match space.dag().kind(k).clone() {
        Kind::Product(_, factors) => factors,
        _ => vec![(k, 1)],
    };
    let mut zeros = Vec::new();
    for (base, n) in factors {
        match *space.dag().kind(base) {
            Kind::Call(Op::Sqrt | Op::Cbrt | Op::Abs, ref x) if n > 0 => zeros.push(x[0]),
            _ if n > 0 => zeros.push(base),
            _ => {}
        }
    }
    let breaks = space.breaks(k).into_iter();
    let mut others = breaks.filter(|(node, _)| !zeros.contains(node));
    others.all(|(node, _)| space.brackets_vanish(node, k))
}

fn component(space: &mut Space, axes: Axes, k: Node, s: Node, is_squared: bool) -> Option<Motion> {
    let one = Rational::ONE;
    // K_ll = −K changes its sign in half a turn.
    let (mut here, bit) = (space.point(), space.set(axes.x).number());
    let before = space.value_at(k, &here);
    here[bit] = here[bit] + Ball::pi();
    if !before.differs(-space.value_at(k, &here))
        && let Some(motion) = scaled(space, axes, k, s, is_squared, &one)
    {
        return Some(motion);
    }
    // K_ll = −λ²K, with a λ that stands in K.
    let rates = super::rates(space, k, axes.x);
    let mut scales = rates
        .iter()
        .map(Rational::abs)
        .filter(|rate| !rate.is_one());
    scales.find_map(|scale| scaled(space, axes, k, s, is_squared, &scale))
}

/// The flow of a spin whose angle is scaled by a number.
fn scaled(
    space: &mut Space,
    axes: Axes,
    k: Node,
    s: Node,
    is_squared: bool,
    scale: &Rational,
) -> Option<Motion> {
    let over = scale.recip()?;
    // In l·λ and L/λ the rule is that of λ = 1.
    let y = axes.y(space);
    let own = space.set(axes.x) | space.set(y);
    let (l, y) = (
        space.dag().scale(scale, axes.x),
        space.dag().scale(&over, y),
    );
    let n = space.d(k, axes.x);
    let n = space.dag().scale(&over, n);
    let nl = space.d(n, axes.x);
    let nl = space.dag().scale(&over, nl);
    let minus = space.dag().neg(k);
    if !space.same(nl, minus) || !stays_smooth(space, k) {
        return None;
    }
    let (kl, nl_of) = (axes.dy(space, k), axes.dy(space, n));
    let (kl, nl_of) = (
        space.dag().scale(scale, kl),
        space.dag().scale(scale, nl_of),
    );
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
    let value = space.value(rate);
    if matches!(space.sign(rate), Some(0 | -1)) || value.value <= value.error {
        return None;
    }
    let c = super::root(space, rate);
    names.set("c", c);
    let square = names.one(space.dag(), "(K^2 + N^2)/c^2 + L^2")?;
    let square = space.free(square, own)?;
    names.set("square", square);
    let rest = space.set(k).without(own);
    names.read(
        space.dag(),
        "ct = cos(c*s); st = sin(c*s); L1 = L*ct - N*st/c; N1 = N*ct + c*L*st; \
         l1 = l + atan2(K*(N - N1), K^2 + N*N1)",
    )?;
    let mut motion = Motion::default();
    let l1 = names.get("l1")?;
    motion.set(axes.x, space.dag().scale(&over, l1));
    let y1 = names.get("L1")?;
    let y1 = space.dag().scale(scale, y1);
    let y1 = axes.signed(space, y1);
    motion.set(axes.leaf, y1);
    if !rest.is_empty() {
        names.read(
            space.dag(),
            "C = sqrt(square); k = abs(K)/c; less = pick(0 < C, ((N/c)^2 + L^2)/(C + k), 0); \
             chi0 = atan2(N/c, L); chi1 = chi0 + c*s",
        )?;
        names.read(space.dag(), SWEPT)?;
        let angle = names.one(space.dag(), "sign(K)*angle")?;
        let length = names.get("C")?;
        for one in rest.members() {
            let inert = space.variable(one);
            // C is free of the turning components, as was proven above.
            let slope = space.d(length, inert);
            let moved = space.dag().mul(&[slope, angle]);
            space.push(&mut motion, one, moved);
        }
    }
    if !is_squared {
        // With K = 0 the angle rests until N changes its sign: there it jumps by half a turn.
        let (size, same) = (
            names.one(space.dag(), "0 < K^2")?,
            names.one(space.dag(), "0 < N*N1")?,
        );
        let inside = space.dag().or(size, same);
        motion.domain.push(inside);
    }
    Some(motion)
}
