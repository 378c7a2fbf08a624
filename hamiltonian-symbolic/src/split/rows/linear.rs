//! φ(x)·y with φ‴ = κφ′: quadratics, exponentials, sines and hyperbolic functions of x.
//!
//! Input: K and s. Output: [`Moved`]. Invariant: nothing is divided by φ, so that the flow holds
//! at its zeros, where x rests and y grows.

use super::{Axes, Moved};
use crate::dag::Node;
use crate::formula::Names;
use crate::rational::Rational;
use crate::split::growth::Growth;
use crate::split::space::Space;

pub(super) fn solve(space: &mut Space, axes: Axes, k: Node, s: Node) -> Option<Moved> {
    let y = axes.y(space);
    let (x_set, y_set) = (space.set(axes.x), space.set(y));
    let slope = axes.dy(space, k);
    let f = space.section(slope, y_set);
    let form = space.dag().mul(&[f, y]);
    if !space.same(k, form) {
        return None;
    }
    let f1 = space.d(f, axes.x);
    let f2 = space.d(f1, axes.x);
    let f3 = space.d(f2, axes.x);
    let kappa = if space.is_zero(f3) {
        space.dag().integer(0)
    } else {
        let ratio = space.dag().div(f3, f1);
        let kappa = space.section(ratio, x_set);
        let multiple = space.dag().mul(&[kappa, f1]);
        space.same(f3, multiple).then_some(kappa)?
    };
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
    // D is a constant because φ‴ = κφ′.
    let big = space.section(big, x_set);
    let half = space.dag().scale(&Rational::new(1, 2), s);
    let growth = Growth::of(space, big, half);
    names.set("D", big);
    names.set("C", growth.c);
    names.set("S", growth.s);
    let sign = match space.sign(kappa) {
        Some(sign) => sign,
        None if space.dag().is_nonnegative(kappa) => 1,
        None => {
            let negative = space.dag().neg(kappa);
            space.dag().is_nonnegative(negative).then_some(-1)?
        }
    };
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
    Some(Moved {
        x: names.get("x1")?,
        y: names.get("y1")?,
        domain,
    })
}
