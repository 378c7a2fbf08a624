//! φ(x)·y with φ‴ = κφ′: quadratics, exponentials, sines and hyperbolic functions of x.
//!
//! Input: K and s. Output: [`Moved`]. Invariant: nothing is divided by φ, so that the flow holds
//! at its zeros, where x rests and y grows, nor by √κ where that may be 0. φ is analytic, or its one kink is a zero at x = 0.

use super::{Axes, Moved};
use crate::algebra::formula::Names;
use crate::dag::{Kind, Node};
use crate::flows::solve::growth::{Growth, arctangent, near_zero};
use crate::flows::space::Space;
use crate::op::Op;
use crate::rational::Rational;

pub(super) fn solve(space: &mut Space, axes: Axes, k: Node, s: Node) -> Option<Moved> {
    let y = axes.y(space);
    let (x_set, y_set) = (space.set(axes.x), space.set(y));
    let slope = axes.dy(space, k);
    let f = space.section(slope, y_set);
    let form = space.dag().mul(&[f, y]);
    if !space.same(k, form) {
        return None;
    }
    // φ‴ = κφ′ holds on each side of a kink or a jump by itself. An orbit stays on its side of a kink at
    // which φ = 0.
    let breaks = space.breaks(f);
    if !breaks.is_empty() {
        let zero = space.dag().integer(0);
        let there = space.at(f, &[(axes.x, zero)]);
        let is_at_rest = breaks.iter().all(|found| *found == (axes.x, false));
        if !is_at_rest || !space.dag().is_zero(there) {
            return None;
        }
    }
    let f1 = space.d(f, axes.x);
    let f2 = space.d(f1, axes.x);
    let f3 = space.d(f2, axes.x);
    let (kappa, sign) = constant(space, f, [f1, f3], axes.x)?;
    let mut names = Names::of(&[
        ("x", axes.x),
        ("y", y),
        ("f", f),
        ("f1", f1),
        ("f2", f2),
        ("k", kappa),
        ("s", s),
    ]);
    let big = names.one(space.dag(), "f1^2 - 2*f*f2 + k*f^2")?;
    // D is a constant because φ‴ = κφ′, on each side of a break by itself.
    let big = match breaks.is_empty() {
        true => at_zero(space, big, axes.x).unwrap_or_else(|| space.section(big, x_set)),
        false => big,
    };
    let half = space.dag().scale(&Rational::new(1, 2), s);
    let growth = Growth::of(space, big, half);
    names.set("D", big);
    names.set("C", growth.c);
    names.set("S", growth.s);
    let size = if sign < 0 {
        space.dag().neg(kappa)
    } else {
        kappa
    };
    let a = super::root(space, size);
    names.set("a", a);
    let dag = space.dag();
    names.read(dag, "d = C - f1*S")?;
    let mut domain = Vec::new();
    match sign {
        0 => {
            names.read(dag, "x1 = x + 2*f*S/d; y1 = y*d^2")?;
            domain.push(names.get("d")?);
        }
        1 => {
            names.read(
                dag,
                "e = a*f*S; below = d - e; above = d + e; \
                 x1 = x + ln_1p(2*e/below)/a; y1 = y*above*below",
            )?;
            domain.push(names.get("below")?);
            domain.push(names.get("above")?);
        }
        _ => {
            names.read(dag, "e = a*f*S; turn = atan2(e, d); y1 = y*(d^2 + e^2)")?;
            if space.sign(big) == Some(1) {
                names.read(space.dag(), "x1 = x + 2*turn/a")?;
            } else {
                // If x goes round, the angle is counted from that of an even turn.
                names.read(
                    space.dag(),
                    "w = pick(D < 0, sqrt(0 - D)*s*sign(f)/2, 0); sw = sin(w); cw = cos(w); \
                     x1 = x + 2*(w + atan2(e*cw - d*sw, d*cw + e*sw))/a",
                )?;
            }
        }
    }
    if sign >= 0 && space.sign(big) != Some(1) {
        // For D < 0 the same formula comes back to finite values after the blow-up.
        let whole = names.one(space.dag(), "4*pi^2 + D*s^2")?;
        domain.push(whole);
    }
    let mut x = names.get("x1")?;
    if sign != 0 && space.dag().as_constant(kappa).is_none() {
        x = beside_zero(space, &mut names, x)?;
    }
    Some(Moved {
        x,
        y: names.get("y1")?,
        domain,
    })
}

/// x₁ where a = 0 is met, or near it: x + 2v·artanh(√z)/√z with v = φS/d and z = κv², as long as x has not
/// gone round.
fn beside_zero(space: &mut Space, names: &mut Names, far: Node) -> Option<Node> {
    names.read(space.dag(), "v = f*S/d; z = k*v^2")?;
    let z = names.get("z")?;
    let series = arctangent(space, z);
    names.set("T", series);
    let near = names.one(space.dag(), "x + 2*v*T")?;
    let small = near_zero(space, z);
    let (ahead, once) = (
        names.one(space.dag(), "0 < d")?,
        names.one(space.dag(), "0 < pi^2 + D*s^2")?,
    );
    let dag = space.dag();
    let condition = dag.and(ahead, once);
    let condition = dag.and(small, condition);
    Some(dag.select(condition, near, far))
}

/// A node at x = 0, where it has a value there.
fn at_zero(space: &mut Space, node: Node, x: Node) -> Option<Node> {
    let zero = space.dag().integer(0);
    let there = space.at(node, &[(x, zero)]);
    space.value(there).is_defined().then_some(there)
}

/// κ with φ‴ = κφ′, and its sign, 0 for κ = 0. `None` if there is no such κ or its sign is unknown.
fn constant(space: &mut Space, f: Node, [f1, f3]: [Node; 2], x: Node) -> Option<(Node, i32)> {
    if space.is_zero(f3) {
        return Some((space.dag().integer(0), 0));
    }
    for (rate, sign) in rates(space, f, x) {
        let square = space.dag().powi(rate, 2);
        let kappa = space
            .dag()
            .scale(&Rational::integer(i64::from(sign)), square);
        let multiple = space.dag().mul(&[kappa, f1]);
        if space.same(f3, multiple) {
            return Some((kappa, sign));
        }
    }
    let ratio = space.dag().div(f3, f1);
    let x_set = space.set(x);
    let kappa = space.section(ratio, x_set);
    let multiple = space.dag().mul(&[kappa, f1]);
    if !space.same(f3, multiple) {
        return None;
    }
    let sign = match space.sign(kappa) {
        Some(sign) => sign,
        None => match space.dag().sign(kappa) {
            sign if sign.is_nonnegative() => 1,
            sign if sign.is_nonpositive() => -1,
            _ => return None,
        },
    };
    Some((kappa, sign))
}

/// The rates k of the functions of k·x in an expression, and twice these, with the sign of κ = ±k².
fn rates(space: &mut Space, f: Node, x: Node) -> Vec<(Node, i32)> {
    let x_set = space.set(x);
    let mut found = Vec::new();
    for node in space.dag().reachable(&[f]) {
        let Kind::Call(op, arguments) = space.dag().kind(node).clone() else {
            continue;
        };
        let sign = match op {
            Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh => 1,
            Op::Sin | Op::Cos => -1,
            _ => continue,
        };
        let rate = space.d(arguments[0], x);
        if space.dag().is_zero(rate) || space.set(rate).meets(x_set) {
            continue;
        }
        for multiple in [1, 2] {
            let rate = space.dag().scale(&Rational::integer(multiple), rate);
            if !found.contains(&(rate, sign)) {
                found.push((rate, sign));
            }
        }
    }
    found
}
