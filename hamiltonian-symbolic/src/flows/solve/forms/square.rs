//! f(x)·y²: in a chart u(x) with F = f·u′² = a + b·u + ½F₂u² the position u moves linearly,
//! ü = 2k·F_u with k = f·y² held.
//!
//! Input: K and s. Output: [`Moved`]. Invariant: with P = y/u′ and d = C + F_u·P·S, P becomes
//! P/d; past d = 0, where F vanishes, the formula stays finite and is wrong. The motion is defined wherever f is:
//! the chart 1/x has no value at x = 0, where x rests, so nothing is divided by x there.

use super::{Axes, Moved};
use crate::algebra::formula::Names;
use crate::dag::Node;
use crate::flows::solve::growth::Growth;
use crate::flows::space::{Space, Variables};
use crate::rational::Rational;

/// A chart u(x), with its motion in the names of [`in_chart`].
struct Substitution {
    u: &'static str,
    slope: &'static str,
    motion: MotionFormulas,
    /// An expression that is > 0 as long as u₁ is in the chart.
    range: &'static str,
    /// The new x and y.
    back: &'static str,
}

/// d and what gives the new position: u₁, in the chart 1/x the ratio w = x·u₁.
struct MotionFormulas {
    /// For F₂ = 0.
    straight: &'static str,
    /// For F₂ > 0 and F > 0. By half of the argument: √(1 + sinh²) of a short time rounds down more often than up, and
    /// the energy of a run drifts.
    positive: &'static str,
    /// λ of the growth, and the rest.
    general: [&'static str; 2],
}

const REGULAR: MotionFormulas = MotionFormulas {
    straight: "P = y/du; d = 1 + b*P*s; u1 = u + F*P*s*(1 + d)",
    positive: "P = y/du; r = sqrt(2*F*f2); half = sinh(P*r*s/2); C = 1 + 2*half^2; \
               S = 2*half*sqrt(1 + half^2)/r; d = C + Fu*S; u1 = (u + b/f2)*C - b/f2 + 2*F*S",
    general: [
        "P = y/du; l = 2*F*P^2*f2",
        "d = C + Fu*P*S; u1 = u + 2*F*P*(S + Fu*P*c2)",
    ],
};

/// With G = x²·F and P = −x²y: x·F·P = −x·G·y and F_u·P = −(b·x² + F₂·x)·y.
const INVERTED: MotionFormulas = MotionFormulas {
    straight: "d = 1 - b*x^2*y*s; w = 1 - (a*x^3 + b*x^2)*y*s*(1 + d)",
    positive: "G = a*x^2 + b*x + f2/2; r = sqrt(2*G*f2); half = sinh(x*y*r*s/2); C = 1 + 2*half^2; \
               S = 2*half*sqrt(1 + half^2)/r; d = C - (b*x + f2)*S; w = (1 + b*x/f2)*C - b*x/f2 - 2*G*S",
    general: [
        "l = 2*f*y^2*f2",
        "rate = 0 - (b*x^2 + f2*x)*y; d = C + rate*S; \
         w = 1 - (2*a*x^3 + 2*b*x^2 + f2*x)*y*(S + rate*c2)",
    ],
};

const CHARTS: &[Substitution] = &[
    Substitution {
        u: "x",
        slope: "1",
        motion: REGULAR,
        range: "",
        back: "x1 = u1; y1 = P/d",
    },
    Substitution {
        u: "x^2",
        slope: "2*x",
        motion: REGULAR,
        range: "u1",
        back: "x1 = pick(0 < x, sqrt(u1), 0 - sqrt(u1)); du1 = 2*x1; y1 = P*du1/d",
    },
    Substitution {
        u: "1/x",
        slope: "0 - 1/x^2",
        motion: INVERTED,
        range: "w",
        back: "x1 = x/w; y1 = y*w^2/d",
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
    names.read(space.dag(), "F = a + b*u + f2*u^2/2; Fu = b + f2*u")?;
    let whole = names.get("F")?;
    if !space.same(big, whole) {
        return None;
    }
    let mut domain = Vec::new();
    let signs = (space.sign(f2), space.sign(whole));
    let motion = &chart.motion;
    match signs {
        (Some(0), _) => {
            names.read(space.dag(), motion.straight)?;
            domain.push(names.get("d")?);
        }
        (Some(1), Some(1)) => names.read(space.dag(), motion.positive)?,
        _ => {
            let [lambda, rest] = motion.general;
            names.read(space.dag(), lambda)?;
            let growth = Growth::of(space, names.get("l")?, s);
            names.set("C", growth.c);
            names.set("S", growth.s);
            names.set("c2", growth.c2);
            names.read(space.dag(), rest)?;
            domain.push(names.get("d")?);
            let whole = names.one(space.dag(), "pi^2 + l*s^2")?;
            domain.push(whole);
        }
    }
    if !chart.range.is_empty() {
        domain.push(names.get(chart.range)?);
    }
    names.read(space.dag(), chart.back)?;
    Some(Moved {
        x: names.get("x1")?,
        y: names.get("y1")?,
        domain,
    })
}
