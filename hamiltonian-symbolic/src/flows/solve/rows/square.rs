//! f(x)·y²: in a chart u(x) with F = f·u′² = a + b·u + ½F₂u² the position u moves linearly,
//! ü = 2k·F_u with k = f·y² held.
//!
//! Input: K and s. Output: [`Moved`]. Invariant: with P = y/u′ and d = C + F_u·P·S, P becomes
//! P/d; past d = 0, where F vanishes, the formula stays finite and is wrong.

use super::{Axes, Moved};
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::solve::growth::Growth;
use crate::flows::space::{Space, Variables};
use crate::rational::Rational;

/// A chart: u, u′, the way back from u₁ (with the range of u₁ that is > 0), u′ there.
struct Substitution {
    u: &'static str,
    slope: &'static str,
    back: &'static str,
    range: &'static str,
    slope_there: &'static str,
}

const CHARTS: &[Substitution] = &[
    Substitution {
        u: "x",
        slope: "1",
        back: "u1",
        range: "",
        slope_there: "1",
    },
    Substitution {
        u: "x^2",
        slope: "2*x",
        back: "pick(0 < x, sqrt(u1), 0 - sqrt(u1))",
        range: "u1",
        slope_there: "2*x1",
    },
    Substitution {
        u: "1/x",
        slope: "0 - 1/x^2",
        back: "1/u1",
        range: "u1*x",
        slope_there: "0 - 1/x1^2",
    },
];

pub(super) fn solve(space: &mut Space, axes: Axes, k: Node, s: Node) -> Option<Moved> {
    let y = axes.y(space);
    let (x_set, y_set) = (space.set(axes.x), space.set(y));
    let slope = axes.dy(space, k);
    let slope = axes.dy(space, slope);
    let f = space.section(slope, y_set);
    let f = space.dag().scale(&Rational::new(1, 2), f);
    let form = space.dag().product(&Rational::ONE, &[(f, 1), (y, 2)]);
    if !space.same(k, form) {
        return None;
    }
    CHARTS
        .iter()
        .find_map(|chart| in_chart(space, chart, axes, (y, f, s), x_set))
}

fn in_chart(
    space: &mut Space,
    chart: &Substitution,
    axes: Axes,
    (y, f, s): (Node, Node, Node),
    x_set: Variables,
) -> Option<Moved> {
    let mut names = Names::of(&[("x", axes.x), ("y", y), ("f", f), ("s", s)]);
    let u = names.one(space.dag(), chart.u)?;
    let slope = names.one(space.dag(), chart.slope)?;
    names.set("u", u);
    names.set("du", slope);
    let big = names.one(space.dag(), "f*du^2")?;
    let along = |space: &mut Space, node: Node| {
        let d = space.d(node, axes.x);
        space.dag().div(d, slope)
    };
    let first = along(space, big);
    let second = along(space, first);
    let f2 = space.section(second, x_set);
    names.set("f2", f2);
    names.set("first", first);
    names.set("big", big);
    let b = names.one(space.dag(), "first - f2*u")?;
    let b = space.section(b, x_set);
    names.set("b", b);
    let a = names.one(space.dag(), "big - b*u - f2*u^2/2")?;
    let a = space.section(a, x_set);
    names.set("a", a);
    names.read(
        space.dag(),
        "F = a + b*u + f2*u^2/2; Fu = b + f2*u; P = y/du",
    )?;
    let whole = names.get("F")?;
    if !space.same(big, whole) {
        return None;
    }
    let mut domain = Vec::new();
    let signs = (space.sign(f2), space.sign(whole));
    match signs {
        (Some(0), _) => {
            names.read(space.dag(), "d = 1 + b*P*s; u1 = u + F*P*s*(1 + d)")?;
            domain.push(names.get("d")?);
        }
        (Some(1), Some(1)) => {
            // By half of the argument: √(1 + sinh²) of a short time rounds down more often than up, and
            // the energy of a run drifts.
            names.read(
                space.dag(),
                "r = sqrt(2*F*f2); half = sinh(P*r*s/2); C = 1 + 2*half^2; S = 2*half*sqrt(1 + half^2)/r; \
                 d = C + Fu*S; \
                 u1 = (u + b/f2)*C - b/f2 + 2*F*S",
            )?;
        }
        _ => {
            let lambda = names.one(space.dag(), "2*F*P^2*f2")?;
            let growth = Growth::of(space, lambda, s);
            names.set("C", growth.c);
            names.set("S", growth.s);
            names.set("c2", growth.c2);
            names.read(space.dag(), "d = C + Fu*P*S; u1 = u + 2*F*P*(S + Fu*P*c2)")?;
            domain.push(names.get("d")?);
            names.set("l", lambda);
            let whole = names.one(space.dag(), "pi^2 + l*s^2")?;
            domain.push(whole);
        }
    }
    if !chart.range.is_empty() {
        let range = names.one(space.dag(), chart.range)?;
        domain.push(range);
    }
    let x1 = names.one(space.dag(), chart.back)?;
    names.set("x1", x1);
    let slope = names.one(space.dag(), chart.slope_there)?;
    names.set("du1", slope);
    Some(Moved {
        x: x1,
        y: names.one(space.dag(), "P*du1/d")?,
        domain,
    })
}
