//! What is proven of a system, with the reasons against the rest, and its texts.
//!
//! Input: none (built by the stages around it). Output: [`Verdicts`], [`Text`]. Invariant: a reason is in the words of an
//! error.

use hamiltonian_symbolic::program::Purpose;

/// The source of ∂H/∂q and ∂H/∂p.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GradientSource {
    /// Functions of their own, or `energy_and_gradient` of a large H.
    Written,
    /// The kick and the drift.
    Halves,
    /// The vector field.
    Field,
}

/// The source of the vector field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldSource {
    /// The kick and the drift.
    Halves,
    /// A function of its own.
    Whole,
    /// The gradient of a large H.
    OfGradient,
}

/// The proven structure of H.
#[derive(Debug)]
pub struct Verdicts {
    /// H = T(p, t) + V(q, t)
    pub separable: Result<(), Reason>,
    /// H is a sum of pieces with exact flows: those of the model, or V and T.
    pub split: Result<(), Reason>,
    /// V and T in the author's notation, where H is separable.
    pub halves: [String; 2],
    /// T = ½ pᵀM⁻¹p with constant M
    pub quadratic_kinetic: Result<(), Reason>,
    /// A kick V(q, t) and a piece at most quadratic in the momenta.
    pub nystrom: Result<Nystrom, Reason>,
    /// No force acts.
    pub unforced: Result<(), Reason>,
    /// The flows of all pieces are exact.
    pub exact: Result<(), Reason>,
    /// The kick of V, with the force, or of the force alone beside pieces of H.
    pub kick: Option<Kick>,
    /// H does not depend on t
    pub autonomous: Result<(), Reason>,
    /// Coordinates that do not appear in H.
    pub cyclic: Vec<String>,
    /// The growth of H, where it is finite for all finite numbers.
    pub growth: Option<u32>,
    /// The parts that jump at times that do not depend on the state, if any does.
    pub jumping: Option<Jumping>,
}

impl Verdicts {
    /// Returns true if T is the first piece, because V jumps in time and T does not.
    pub fn is_drift_first(&self) -> bool {
        (self.jumping.as_ref()).is_some_and(|jumping| jumping.halves == [true, false])
    }

    /// Returns true if the force is a piece of its own, the last one.
    pub fn is_forced_apart(&self) -> bool {
        self.kick.is_some() && self.separable.is_err()
    }
}

/// The parts of H that jump at times that do not depend on the state.
#[derive(Debug)]
pub struct Jumping {
    /// V with the force, and T, where H is separable.
    pub halves: [bool; 2],
    /// The pieces of the model, and at the end the force.
    pub pieces: Vec<bool>,
}

/// The places of the kick and of the piece at most quadratic in the momenta.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nystrom {
    /// V and T.
    Halves,
    /// The model's pieces of these numbers.
    Pieces([usize; 2]),
}

/// The functions that make up the kick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kick {
    /// The kick alone: without a force, or with one that does not depend on momenta.
    Plain,
    /// The part that reads momenta, and where `rest` the kick after it.
    Damped {
        /// True if there is a part that reads none.
        rest: bool,
    },
    /// Exact by a series over the rates of momenta and their linear part: momenta push each other.
    Coupled,
    /// A symmetric sub-step over the rates of momenta.
    SubStep,
}

impl Kick {
    /// The purposes of the functions that a kick is made of.
    #[must_use]
    pub fn purposes(self) -> &'static [Purpose] {
        match self {
            Kick::Plain => &[Purpose::Kick],
            Kick::Damped { rest: false } => &[Purpose::Push],
            Kick::Damped { rest: true } => &[Purpose::Push, Purpose::Kick],
            Kick::Coupled => &[Purpose::Rates, Purpose::Linear],
            Kick::SubStep => &[Purpose::Rates],
        }
    }
}

/// Why a structure is not there: the words of rustc where a scheme requires it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// The property of H in the way, with the term at fault.
    pub message: String,
    /// The missing property.
    pub label: String,
    /// The alternative.
    pub note: String,
}

/// H and Hamilton's equations as people read them.
#[derive(Debug, Default)]
pub struct Text {
    /// `H(q; p) = …`
    pub hamiltonian: String,
    /// Hamilton's equations, one a line.
    pub equations: Vec<String>,
    /// H in LaTeX.
    pub latex: String,
    /// Hamilton's equations in LaTeX, one a line.
    pub latex_equations: Vec<String>,
    /// H in MathML; empty where formulas are long.
    pub math: String,
    /// Hamilton's equations in MathML, one a row of a table; empty where formulas are long.
    pub math_equations: String,
    /// Facts of H, one sentence a line.
    pub facts: Vec<String>,
    /// A table of the operations of value and gradient, one row a line.
    pub operations: Vec<String>,
}
