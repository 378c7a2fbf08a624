//! The table of exact flows: the pattern of a piece, its motion, the domain, and the source.
//!
//! Input: an expression h and the time s it acts for, constant along its own flow. Output: its
//! [`Motion`]. Invariant: a solver answers only where h is proven to be an instance of its pattern;
//! that the flow of the pattern is exact is proven once a form by tests. A new form is a file here
//! and a line in [`FORMS`].

mod axes;
mod circle;
mod flight;
mod kepler;
mod linear;
mod monomial;
mod quadratic;
mod rotation;
mod shear;
mod spin;
mod square;

pub(crate) use quadratic::{is_constant_form, is_quadratic};

use crate::dag::Node;
use crate::flows::space::Space;
use crate::model::{EXPONENTIAL, Motion};
use crate::rational::Rational;

/// One pair as a solver takes it: a position x and its momentum y, which are (q, p) or (p, −q).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    /// The position.
    pub(crate) x: Node,
    /// The momentum; where the axes are exchanged, −y is the variable.
    leaf: Node,
    exchanged: bool,
}

impl Axes {
    /// A pair both ways round.
    pub(crate) fn both_ways(q: Node, p: Node) -> [Axes; 2] {
        [(q, p, false), (p, q, true)].map(|(x, leaf, exchanged)| Axes { x, leaf, exchanged })
    }
    /// y
    pub(crate) fn y(self, space: &mut Space) -> Node {
        self.signed(space, self.leaf)
    }
    /// ∂h/∂y
    pub(crate) fn dy(self, space: &mut Space, h: Node) -> Node {
        let slope = space.d(h, self.leaf);
        self.signed(space, slope)
    }
    /// The variable that y is, up to its sign.
    pub(crate) fn leaf(self) -> Node {
        self.leaf
    }
    /// A value of y as one of the variable, and the other way.
    pub(crate) fn signed(self, space: &mut Space, value: Node) -> Node {
        if self.exchanged {
            space.dag().neg(value)
        } else {
            value
        }
    }
}

/// The images of x and y.
#[derive(Clone, Debug)]
pub(crate) struct Moved {
    pub(crate) x: Node,
    pub(crate) y: Node,
    /// Expressions that must be > 0.
    pub(crate) domain: Vec<Node>,
}

/// The solver of a form.
#[derive(Clone, Copy)]
pub(crate) enum Solve {
    /// Solves K(x, y) of one pair and parameters.
    Pair(fn(&mut Space, Axes, Node, Node) -> Option<Moved>),
    /// Solves a piece over a whole point, by a matrix at run time.
    Exponential,
    /// Solves any h.
    Whole(fn(&mut Space, Node, Node) -> Option<Motion>),
    /// Like `Whole`, but tried later: if h = G(u) and u has a flow, that flow needs fewer divisions.
    Bare(fn(&mut Space, Node, Node) -> Option<Motion>),
}

/// A form of H with an exact flow: its pattern, and the domain and source of the flow.
pub struct SolvableForm {
    /// A short name.
    pub name: &'static str,
    /// The Hamiltonian.
    pub pattern: &'static str,
    /// The domain of the flow.
    pub domain: &'static str,
    /// The source of the flow.
    pub source: &'static str,
    pub(crate) solve: Solve,
}

/// The forms. Within a kind (`Solve`) they are tried in this order. Flows that are linear in time need no form.
pub static FORMS: &[SolvableForm] = &[
    SolvableForm {
        name: "quadratic form",
        pattern: "½zᵀAz + gᵀz of at most 4 pairs with M = JA and M² = λ, M³ = λM or M⁴ = λM²",
        domain: "everywhere",
        source: "Cayley–Hamilton: e^{sM} = 1 + sM + c₂M² + c₃M³",
        solve: Solve::Whole(quadratic::solve),
    },
    SolvableForm {
        name: EXPONENTIAL,
        pattern: "½zᵀAz + gᵀz of all of a point of at most 16 components, where that is not closed",
        domain: "everywhere",
        source: "scaling and squaring: C. Moler, C. Van Loan, SIAM Review 45 (2003) 3",
        solve: Solve::Exponential,
    },
    SolvableForm {
        name: "monomial",
        pattern: "c·qᵃpᵇ",
        domain: "1 + (b−a)·c·q^{a−1}p^{b−1}·t > 0",
        source: "q^{a−1}p^{b−1} moves at a constant rate of its reciprocal",
        solve: Solve::Pair(monomial::solve),
    },
    SolvableForm {
        name: "f(q)·p",
        pattern: "φ(q)·p with φ‴ = κφ′, κ a constant",
        domain: "the orbit stays finite",
        source: "Riccati's equation, linearised",
        solve: Solve::Pair(linear::solve),
    },
    SolvableForm {
        name: "f(q)·p²",
        pattern: "f(q)·p² with f·u′² quadratic in u for a chart u of q, q², 1/q",
        domain: "p keeps its sign, u stays in its range",
        source: "du/dt = 2f·u′²·(p/u′) is linear in u",
        solve: Solve::Pair(square::solve),
    },
    SolvableForm {
        name: "shear",
        pattern: "G(p − A(q; c); c) with A a polynomial in q of degree 8 at most",
        domain: "everywhere",
        source: "Y. K. Wu, É. Forest, D. S. Robin, Phys. Rev. E 68 (2003) 046502",
        solve: Solve::Bare(shear::solve),
    },
    SolvableForm {
        name: "free flight",
        pattern: "a·(p² + Λ/r²), Λ any form's that is free of r and p",
        domain: "Λ > 0, or r + 2a·t·p > 0 and the centre is not met",
        source: "a straight line in polar coordinates",
        solve: Solve::Whole(flight::solve),
    },
    SolvableForm {
        name: "great circle",
        pattern: "b·(p² + Λ/sin²θ), Λ ≥ 0 free of θ and p, with no pair of its own",
        domain: "off the poles",
        source: "a turn of the unit sphere",
        solve: Solve::Whole(circle::solve),
    },
    SolvableForm {
        name: "rotation",
        pattern: "G(x·p_y − y·p_x, x² + y², c)",
        domain: "everywhere",
        source: "a kick along the radius, then a turn about the axis",
        solve: Solve::Whole(rotation::solve),
    },
    SolvableForm {
        name: "Kepler",
        pattern: "a·|p|² − κ/|q| of two or three pairs, κ of either sign",
        domain: "the centre is not met",
        source: "universal variables: J. M. A. Danby, Fundamentals of Celestial Mechanics, 1988, §6.9; \
                 J. Wisdom, D. M. Hernandez, MNRAS 453 (2015) 3015",
        solve: Solve::Whole(kepler::solve),
    },
    SolvableForm {
        name: "spin component",
        pattern: "K(l, L) with K² + K_l² = c²(C² − L²), and its square",
        domain: "K ≠ 0, or the angle rests",
        source: "a turn of the vector (K, K_l, cL) about its first axis",
        solve: Solve::Whole(spin::solve),
    },
    SolvableForm {
        name: "body axis",
        pattern: "κ·M², M the angular momentum along a body axis, in Euler angles φ, θ, ψ",
        domain: "off the poles of the angles",
        source: "a turn of the body about the axis",
        solve: Solve::Whole(axes::solve),
    },
];

/// x^{n/d}
fn power(space: &mut Space, x: Node, n: i32, d: i32) -> Node {
    let (mut a, mut b) = (n.abs(), d.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    let sign = d.signum();
    let (n, d) = (sign * n / a.max(1), d.abs() / a.max(1));
    let dag = space.dag();
    match d {
        1 => dag.powi(x, n),
        2 => {
            let root = dag.call(crate::op::Op::Sqrt, &[x]);
            dag.powi(root, n)
        }
        3 => {
            let root = dag.call(crate::op::Op::Cbrt, &[x]);
            dag.powi(root, n)
        }
        _ => {
            let log = dag.call(crate::op::Op::Ln, &[x]);
            let log = dag.scale(&Rational::new(i64::from(n), i64::from(d)), log);
            dag.call(crate::op::Op::Exp, &[log])
        }
    }
}

/// The root of a square, with a sign of its own where there is one: ℓ of ℓ², else √Λ.
fn root(space: &mut Space, square: Node) -> Node {
    use crate::dag::Kind;
    use crate::op::Op;
    let dag = space.dag();
    let root = dag.call(Op::Sqrt, &[square]);
    match dag.kind(root) {
        Kind::Call(Op::Abs, x) => x[0],
        _ => root,
    }
}

/// The numbers k for which h has a sine or cosine of k·x + ….
fn rates(space: &mut Space, h: Node, x: Node) -> Vec<Rational> {
    use crate::dag::Kind;
    use crate::op::Op;
    let mut found = Vec::new();
    for node in space.dag().reachable(&[h]) {
        let Kind::Call(Op::Sin | Op::Cos, arguments) = space.dag().kind(node).clone() else {
            continue;
        };
        let rate = space.d(arguments[0], x);
        if let Some(rate) = space.dag().as_constant(rate).cloned()
            && !rate.is_zero()
            && !found.contains(&rate)
        {
            found.push(rate);
        }
    }
    found
}
