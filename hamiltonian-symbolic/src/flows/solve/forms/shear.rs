//! G(y − A(x; c); c), A a polynomial in x: x += gs, y += ΔA, and the conjugate of c is kicked
//! by ∂A/∂c along the way.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: h is proven to depend on x and y through
//! K = y − A only; A is taken to be 0 at x = 0, the rest of it is in G. Nothing is divided by a coefficient
//! of y that may be 0 where K stands in h by itself.

use super::Axes;
use crate::algebra::ball::Ball;
use crate::dag::Node;
use crate::flows::space::Space;
use crate::list::IntoList;
use crate::model::Motion;
use crate::rational::Rational;

/// The highest degree of A.
const DEGREE: i32 = 8;

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let active = space.active(h);
    let [pair] = active.as_slice() else {
        return None;
    };
    let (q, p) = space.pairs[*pair];
    Axes::both_ways(q, p)
        .into_iter()
        .find_map(|axes| along(space, axes, h, s))
}

/// Returns true if differences say that A′ is no polynomial of a degree below that of A.
fn is_no_polynomial(space: &mut Space, slope: Node, axes: Axes) -> bool {
    let bit = space.set(axes.x).number();
    let mut point = space.point();
    let (mut sum, mut weight) = (Ball::exact(0.0), 1.0);
    for k in 0..=DEGREE {
        point[bit] = Ball::exact(0.375 + f64::from(k) / 4.0);
        sum = sum + Ball::exact(weight) * space.value_at(slope, &point);
        // Binomial coefficients are exact.
        weight *= -f64::from(DEGREE - k) / f64::from(k + 1);
    }
    sum.is_nonzero()
}

/// β·y + B(x; c) with a β of parameters, which may be 0: y loses ∫B′(x + βt)dt, term by term.
fn linear(
    space: &mut Space,
    axes: Axes,
    h: Node,
    (hx, beta): (Node, Node),
    s: Node,
) -> Option<Motion> {
    if is_no_polynomial(space, hx, axes) {
        return None;
    }
    let (x_set, y) = (space.set(axes.x), axes.y(space));
    let y_set = space.set(y);
    // ∂h/∂y = β and the derivatives of B hold on each side of a break by themselves.
    for (place, _) in space.breaks(h) {
        if space.set(place).meets(x_set | y_set) {
            return None;
        }
    }
    let mut motion = Motion::default();
    let step = space.dag().mul(&[beta, s]);
    motion.add(space.dag(), axes.x, step);
    let swept = swept(space, hx, axes.x, beta, s)?;
    let swept = space.dag().neg(swept);
    let swept = axes.signed(space, swept);
    motion.add(space.dag(), axes.leaf, swept);
    let rest = space.set(h).without(x_set | y_set);
    for one in rest.members() {
        let inert = space.variable(one);
        let slope = space.d(h, inert);
        let kick = self::swept(space, slope, axes.x, beta, s)?;
        space.push(&mut motion, one, kick);
    }
    Some(motion)
}

/// ∫₀ˢf(x + βt)dt of a polynomial f of x: Σ f⁽ⁿ⁾(x)·βⁿsⁿ⁺¹/(n + 1)!
fn swept(space: &mut Space, f: Node, x: Node, beta: Node, s: Node) -> Option<Node> {
    let x_set = space.set(x);
    let (mut derivative, mut weight) = (f, Rational::ONE);
    let mut terms = Vec::new();
    for n in 0..=DEGREE {
        if space.set(derivative).meets(x_set) && space.is_zero(derivative)
            || space.dag().is_zero(derivative)
        {
            return Some(space.dag().add(&terms));
        }
        weight = weight.mul(&Rational::integer(i64::from(n) + 1).recip()?);
        let factors = [(derivative, 1), (beta, n), (s, n + 1)];
        let factors: Vec<(Node, i32)> = factors.into_iter().filter(|(_, n)| *n != 0).into_list();
        terms.push(space.dag().product(&weight, &factors));
        derivative = space.d(derivative, x);
    }
    None
}

fn along(space: &mut Space, axes: Axes, h: Node, s: Node) -> Option<Motion> {
    let y = axes.y(space);
    let (x_set, y_set) = (space.set(axes.x), space.set(y));
    let (hx, hy) = (space.d(h, axes.x), axes.dy(space, h));
    if space.dag().is_zero(hy) {
        return None;
    }
    if space.set(hy).is_empty() && space.dag().as_constant(hy).is_none() {
        return linear(space, axes, h, (hx, hy), s);
    }
    let ratio = space.dag().div(hx, hy);
    let slope = space.dag().neg(ratio);
    let slope = space.free(slope, y_set)?;
    if is_no_polynomial(space, slope, axes) {
        return None;
    }
    // A′ as a polynomial: Taylor's coefficients at 0.
    let zero = space.dag().integer(0);
    let (mut derivative, mut factorial) = (slope, Rational::ONE);
    let (mut terms, mut integral) = (Vec::new(), Vec::new());
    let mut n = 0;
    while !space.dag().is_zero(derivative) {
        if n > DEGREE || space.is_spent() {
            return None;
        }
        let at_zero = space.at(derivative, &[(axes.x, zero)]);
        n += 1;
        let over = Rational::integer(i64::from(n));
        let k = factorial.mul(&over).recip()?;
        let factors = |n: i32| [(at_zero, 1), (axes.x, n)];
        terms.push(space.dag().product(&k, &factors(n)));
        let over = Rational::integer(i64::from(n) + 1).recip()?;
        integral.push(space.dag().product(&k.mul(&over), &factors(n + 1)));
        factorial = factorial.mul(&Rational::integer(i64::from(n)));
        derivative = space.d(derivative, axes.x);
        if space.set(derivative).meets(x_set) && space.is_zero(derivative) {
            derivative = zero;
        }
    }
    let a = space.dag().add(&terms);
    let integral = space.dag().add(&integral);
    // G(κ; c) = h(0, κ; c), with y for κ.
    let general = space.at(h, &[(axes.x, zero)]);
    let k = space.dag().sub(y, a);
    let in_y = |space: &mut Space, node: Node| {
        // y is a variable or minus one: y → K.
        let (leaf, image) = if space.set(axes.leaf) == space.set(y) && axes.leaf == y {
            (axes.leaf, k)
        } else {
            let minus = space.dag().neg(k);
            (axes.leaf, minus)
        };
        space.at(node, &[(leaf, image)])
    };
    let form = in_y(space, general);
    if !space.same(h, form) {
        return None;
    }
    let rate = axes.dy(space, general);
    let rate = in_y(space, rate);
    let mut motion = Motion::default();
    let step = space.dag().mul(&[rate, s]);
    let x1 = space.dag().add(&[axes.x, step]);
    let there = |space: &mut Space, node: Node| {
        let moved = space.at(node, &[(axes.x, x1)]);
        space.dag().sub(moved, node)
    };
    let gained = there(space, a);
    let gained = axes.signed(space, gained);
    motion.add(space.dag(), axes.x, step);
    motion.add(space.dag(), axes.leaf, gained);
    let rest = space.set(h).without(x_set | y_set);
    for one in rest.members() {
        let inert = space.variable(one);
        let kick = space.d(general, inert);
        let kick = in_y(space, kick);
        let kick = space.dag().mul(&[kick, s]);
        let swept = space.d(integral, inert);
        let swept = there(space, swept);
        let total = space.dag().sub(kick, swept);
        space.push(&mut motion, one, total);
    }
    Some(motion)
}
