//! The form between mathematics and Rust: scheduled instructions with loops, several functions
//! over one set of prepared values.
//!
//! Input: made by `schedule`. Output: read by emission and by the interpreter. Invariant:
//! a value is computed once, before its uses, in the outermost block where it can be: work that
//! depends on parameters alone in [`Program::prepare`], on parameters and the step coefficient in
//! [`Function::coefficient`], the rest in [`Function::evaluation`].

use crate::dag::{Array, Column, Parameter, Partial, Relation, Side, StandIn};
use crate::hoist::Hoisted;
use crate::index::{Affine, Domain, Index, Size};
use crate::op::Op;
use crate::rational::Rational;

/// The result of an instruction.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Value(pub u32);

impl Value {
    /// No value: it stands where a value is missing, and validation finds it.
    pub(crate) const NONE: Value = Value(u32::MAX);
}

/// The computation of a value.
#[derive(Clone, PartialEq, Debug)]
pub enum Instruction {
    /// An exact number, rounded once to the scalar type.
    Constant(Rational),
    /// π.
    Pi,
    /// A scalar parameter.
    Scalar(Parameter),
    /// Time.
    Time,
    /// The step coefficient.
    Coefficient,
    /// A loop variable as a real.
    Variable(Domain),
    /// A size as a real.
    Extent(Size),
    /// The number of times a loop runs, as a real: `max(end − start, 0)`.
    Count(Affine, Affine),
    /// An array element: row, and column for a rank-2 parameter.
    Load(Array, Index, Option<Index>),
    /// A running sum: 0 before its loop, added to by [`Step::Accumulate`] inside, final after.
    Accumulator,
    /// −a
    Neg(Value),
    /// a + b
    Add(Value, Value),
    /// a − b
    Sub(Value, Value),
    /// a·b
    Mul(Value, Value),
    /// a·b + c
    MulAdd(Value, Value, Value),
    /// a·b − c
    MulSub(Value, Value, Value),
    /// c − a·b
    NegMulAdd(Value, Value, Value),
    /// a/b
    Div(Value, Value),
    /// 1/a
    Recip(Value),
    /// An elementary function, with its arguments.
    Call(Op, Vec<Value>),
    /// sin of an angle whose cosine is needed too: computed together with the [`Instruction::PairedCos`]
    /// that names this value.
    PairedSin(Value),
    /// The cosine that belongs to a [`Instruction::PairedSin`] (named by its value).
    PairedCos(Value),
    /// A function written in Rust, or a derivative of it.
    External(u16, Partial, Vec<Value>),
    /// A comparison (a mask).
    Compare(Relation, Value, Value),
    /// Not (a mask).
    Not(Value),
    /// And (masks).
    And(Value, Value),
    /// Or (masks).
    Or(Value, Value),
    /// The second where the first (a mask) is set, the third elsewhere.
    Select(Value, Value, Value),
    /// A node in the place of another, which no valid program has.
    StandIn(StandIn),
}

impl Instruction {
    /// Calls `visit` with each operand.
    pub fn for_operands(&self, mut visit: impl FnMut(Value)) {
        match self {
            Instruction::Constant(_)
            | Instruction::Pi
            | Instruction::Scalar(_)
            | Instruction::Time
            | Instruction::Coefficient
            | Instruction::Variable(_)
            | Instruction::Extent(_)
            | Instruction::Count(..)
            | Instruction::Load(..)
            | Instruction::Accumulator
            | Instruction::StandIn(_) => {}
            Instruction::Neg(a)
            | Instruction::Recip(a)
            | Instruction::PairedSin(a)
            | Instruction::PairedCos(a)
            | Instruction::Not(a) => visit(*a),
            Instruction::Add(a, b)
            | Instruction::Sub(a, b)
            | Instruction::Mul(a, b)
            | Instruction::Div(a, b)
            | Instruction::Compare(_, a, b)
            | Instruction::And(a, b)
            | Instruction::Or(a, b) => [*a, *b].into_iter().for_each(visit),
            Instruction::MulAdd(a, b, c)
            | Instruction::MulSub(a, b, c)
            | Instruction::NegMulAdd(a, b, c)
            | Instruction::Select(a, b, c) => [*a, *b, *c].into_iter().for_each(visit),
            Instruction::Call(_, arguments) | Instruction::External(_, _, arguments) => {
                arguments.iter().copied().for_each(visit);
            }
        }
    }

    /// Returns true if this is a number, which stands where it is used.
    #[must_use]
    pub fn is_number(&self) -> bool {
        matches!(self, Instruction::Constant(_) | Instruction::Pi)
    }

    /// Returns true if this makes a mask.
    #[must_use]
    pub fn is_mask(&self) -> bool {
        use Instruction::{And, Compare, Not, Or};
        matches!(self, Compare(..) | Not(_) | And(..) | Or(..))
    }
}

/// An output of a function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Target {
    /// A column of the output vector that belongs to coordinates ([`Side::Q`]: ∂H/∂q, or the
    /// coordinates a drift or flow adds to) or to momenta.
    Phase(Column),
    /// The derivative with respect to a parameter; arrays element by element.
    Parameter(Parameter),
    /// An array that preparation fills, by its number in the program.
    Hoisted(u16),
}

/// The update of an element.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Update {
    /// `= v`
    Set(Value),
    /// `+= v`
    Add(Value),
    /// `−= v`
    Sub(Value),
    /// `+= a·b`, fused
    AddProduct(Value, Value),
    /// `−= a·b`, fused
    SubProduct(Value, Value),
}

impl Update {
    /// Calls `visit` with each value it reads.
    pub fn for_operands(&self, visit: impl FnMut(Value)) {
        match self {
            Update::Set(a) | Update::Add(a) | Update::Sub(a) => [*a].into_iter().for_each(visit),
            Update::AddProduct(a, b) | Update::SubProduct(a, b) => {
                [*a, *b].into_iter().for_each(visit);
            }
        }
    }
}

/// A step of a block.
#[derive(Clone, PartialEq, Debug)]
pub enum Step {
    /// Compute a value.
    Let(Value),
    /// Add a value to an accumulator of an enclosing loop.
    Accumulate(Value, Value),
    /// Update an element of an output: row, and column for a rank-2 parameter.
    Store(Target, Index, Option<Index>, Update),
    /// A loop.
    Loop(Loop),
}

/// A loop.
#[derive(Clone, PartialEq, Debug)]
pub struct Loop {
    /// Its variable.
    pub domain: Domain,
    /// The first value.
    pub start: Affine,
    /// One past the last value; nothing runs where it is not above the start.
    pub end: Affine,
    /// The accumulators set to 0 before it.
    pub accumulators: Vec<Value>,
    /// The steps of one iteration.
    pub body: Vec<Step>,
}

/// The purpose of a function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Purpose {
    /// Returns H.
    Energy,
    /// Writes ∂H/∂q into the [`Side::Q`] output.
    GradientQ,
    /// Writes ∂H/∂p into the [`Side::P`] output.
    GradientP,
    /// Writes ∂H/∂q and ∂H/∂p into the two outputs.
    Gradient,
    /// Returns H, and writes ∂H/∂q and ∂H/∂p into the two outputs.
    EnergyAndGradient,
    /// Returns ∂H/∂t.
    TimeDerivative,
    /// Writes ∂H/∂(each parameter) into the parameter outputs.
    ParameterGradient,
    /// Writes the Hessian times the direction into the two outputs.
    HessianVector,
    /// Returns the components of observable n.
    Observable(u16),
    /// Writes vector function n of the model into the outputs it has.
    Vector(u16),
    /// `into_q += c·∂H/∂p`, `into_p += c·(f − ∂H/∂q)` with the force f.
    VectorField,
    /// The part of the kick of a forced system that reads momenta: `p += w·(f − ∂H/∂q)`.
    Push,
    /// `into_p += c·(f − ∂V/∂q)`; beside pieces of H `into_p += c·f`.
    Rates,
    /// `into_p += c·A·p`, for a force f = A(q, t)·p + b(q, t) that couples momenta.
    Linear,
    /// `into_p −= c·∂H/∂q`; of a forced system the part of the kick that reads no momenta.
    Kick,
    /// `into_q += c·∂H/∂p`.
    Drift,
    /// The exact flow of piece n of the model's splitting, for the step coefficient: it reads and
    /// writes one point, the outputs.
    Piece(u16),
}

/// One function of a program.
#[derive(Clone, PartialEq, Debug)]
pub struct Function {
    /// Its purpose.
    pub purpose: Purpose,
    /// Work done once per step coefficient.
    pub coefficient: Vec<Step>,
    /// Work done at every evaluation.
    pub evaluation: Vec<Step>,
    /// Output columns that must be 0 before the evaluation (elements are then added to).
    pub cleared: Vec<Target>,
    /// The values returned.
    pub results: Vec<Value>,
}

/// A program.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Program {
    /// The number of parameters that the model declares.
    pub parameters: usize,
    /// The instructions, by value.
    pub instructions: Vec<Instruction>,
    /// Work done once, from parameters alone, for all functions.
    pub prepare: Vec<Step>,
    /// The arrays that `prepare` fills, by number.
    pub hoisted: Vec<Hoisted>,
    /// The values of `prepare` that functions read, in order of computation.
    pub prepared: Vec<Value>,
    /// The functions that a run calls, each with its purpose.
    pub functions: Vec<Function>,
}

impl Program {
    /// The instruction of a value.
    #[must_use]
    pub fn instruction(&self, value: Value) -> &Instruction {
        &self.instructions[value.0 as usize]
    }
    /// The function with a purpose.
    #[must_use]
    pub fn function(&self, purpose: Purpose) -> Option<&Function> {
        self.functions.iter().find(|f| f.purpose == purpose)
    }

    /// The side that a kick, a drift or the flow of a piece reads, if it writes the other one alone. Its loops need not see
    /// their own stores, so it need not be computed in place.
    #[must_use]
    pub fn one_way(&self, function: &Function) -> Option<Side> {
        match function.purpose {
            Purpose::Kick => return Some(Side::Q),
            Purpose::Drift => return Some(Side::P),
            _ => {}
        }
        let mut touched = Touched::default();
        touched.steps(self, &function.evaluation);
        match (touched.reads, touched.writes) {
            ([_, false], [false, true]) => Some(Side::Q),
            ([false, _], [true, false]) => Some(Side::P),
            _ => None,
        }
    }
}

/// The sides of phase space, coordinates and momenta, that steps read and write.
#[derive(Default)]
struct Touched {
    reads: [bool; 2],
    writes: [bool; 2],
}

impl Touched {
    fn steps(&mut self, program: &Program, steps: &[Step]) {
        let place = |side: Side| usize::from(side == Side::P);
        for step in steps {
            match step {
                Step::Let(value) => {
                    if let Instruction::Load(Array::Phase(at), ..) = program.instruction(*value) {
                        self.reads[place(at.side)] = true;
                    }
                }
                Step::Store(Target::Phase(at), ..) => self.writes[place(at.side)] = true,
                Step::Loop(inner) => self.steps(program, &inner.body),
                Step::Store(..) | Step::Accumulate(..) => {}
            }
        }
    }
}
