//! The symbolic engine of `hamiltonian`: expressions as mathematics, from H to a scheduled program.
//!
//! Input: a [`Model`](model::Model), whose expressions are nodes of one arena, the [`Dag`](dag::Dag).
//! Output: derivatives ([`diff`]), proofs ([`bracket`]), pieces with exact flows ([`split`]), text and LaTeX
//! ([`print`](mod@print)), and a [`Program`](program::Program) whose values are computed as seldom as they can be
//! ([`pipeline`]). Invariant: numbers are exact rationals until a program is emitted.
//!
//! H = ½(q² + 1)(p² + 1): its derivative as LaTeX, a proof, and its pieces.
//! ```
//! use hamiltonian_symbolic::bracket::{Verdict, is_invariant};
//! use hamiltonian_symbolic::dag::{Dependence, Side};
//! use hamiltonian_symbolic::model::{Group, Model};
//! use hamiltonian_symbolic::{diff, print, split};
//!
//! let mut model = Model::default();
//! model.groups.push(Group::scalar("q", "p"));
//! let [q, p] = [Side::Q, Side::P].map(|side| model.scalar(side, 0));
//! let [one, two] = [1, 2].map(|n| model.dag.integer(n));
//! let [q2, p2] = [q, p].map(|x| model.dag.powi(x, 2));
//! let [of_q, of_p] = [q2, p2].map(|square| model.dag.add(&[square, one]));
//! let twice = model.dag.mul(&[of_q, of_p]);
//! let h = model.dag.div(twice, two);
//! model.hamiltonian = Some(h);
//!
//! // ∂H/∂q
//! let gradient = diff::gradient(&mut model.dag, h, Dependence::Q);
//! assert_eq!(print::latex(&model, gradient[0].1), r"\left(p^{2} + 1\right) q");
//!
//! // {H², H} = 0, and {q, H} is not.
//! let squared = model.dag.powi(h, 2);
//! assert!(matches!(is_invariant(&model, squared, None), Verdict::Proven(_)));
//! assert!(matches!(is_invariant(&model, q, None), Verdict::Disproven { .. }));
//!
//! // Pieces that add up to H, each with an exact flow.
//! let found = split::find(&mut model).expect("it has pieces");
//! let pieces: Vec<_> = found.pieces.iter().map(|piece| print::text(&model, piece.h)).collect();
//! assert_eq!(pieces, ["p^2/2 + 0.5", "0.5*p^2*q^2 + q^2/2"]);
//! ```
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod algebra;
mod flows;
mod programs;
mod proofs;

pub use algebra::ball::Ball;
pub use algebra::dag::op;
pub use algebra::{
    dag, diff, index, list, loops, model, normal_form, overflow, print, product, ranges, rational,
    set, sort,
};
pub use flows::split;
pub use programs::{
    count, forces, halves, hoist, interpret, pairs, pipeline, program, schedule, support,
};
pub use proofs::{bracket, facts, jumps, legendre, structure, transform};

/// The second word of π: `π = f64::consts::PI + PI_LOW` to 106 bits.
pub const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;
