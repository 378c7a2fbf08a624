//! Flat code: operations on numbered registers.
//!
//! Input: none (built by `flatten`). Output: [`Stage`], which `machine` runs. Invariant: every register, address and loop
//! that an operation names is there; indices stay in range for the sizes of the code.

use crate::tabulated::Derivative;
use hamiltonian_symbolic::op;

/// A register of numbers, or of conditions.
pub(crate) type Register = u32;

/// Registers from here on are held ones, numbered from 0.
pub(crate) const HELD: Register = 1 << 30;
/// Registers from here on are those of the step coefficient.
pub(crate) const COEFFICIENT: Register = 1 << 31;
/// Registers from here on are the coordinates, and behind them the momenta, of code in a frame.
pub(crate) const PHASE: Register = COEFFICIENT + HELD;

/// The number of operations that are one where it says so.
pub(crate) const EIGHT: usize = 8;

/// The most loops inside each other.
pub(crate) const DEPTH: usize = 8;

/// An array that operations read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum From {
    /// Coordinates.
    Q,
    /// Momenta.
    P,
    /// The coordinates of a direction.
    VQ,
    /// The momenta of a direction.
    VP,
    /// Arrays of parameters, and those that preparation fills.
    Data,
    /// What is written, where a point is moved in place.
    Written(To),
}

/// An array that operations write.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum To {
    /// The vector of coordinates.
    Q,
    /// The vector of momenta.
    P,
    /// The arrays that preparation fills.
    Data,
}

/// The update of an element.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Change {
    Set,
    Add,
    Sub,
    /// With the product of two registers.
    AddProduct,
    SubProduct,
}

/// An operation. Its first register is that of the result.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Op {
    Time(Register),
    Coefficient(Register),
    /// The value of a form.
    Number(Register, u32),
    /// The difference of the second form and the first, at least 0.
    Count(Register, u32, u32),
    /// The element at a place.
    Load(Register, From, u32),
    /// The coordinate, or the momentum, at a place: the most frequent of `Load`.
    LoadQ(Register, u32),
    LoadP(Register, u32),
    /// The element at the address of this number.
    LoadAt(Register, From, u32),
    Copy(Register, Register),
    Neg(Register, Register),
    Add(Register, Register, Register),
    Sub(Register, Register, Register),
    Mul(Register, Register, Register),
    /// a·b + c
    MulAdd(Register, Register, Register, Register),
    /// a·b − c
    MulSub(Register, Register, Register, Register),
    /// c − a·b
    NegMulAdd(Register, Register, Register, Register),
    Div(Register, Register, Register),
    Recip(Register, Register),
    Sqrt(Register, Register),
    /// A function of one argument.
    Call(Register, op::Op, Register),
    /// A function of two arguments.
    CallTwo(Register, op::Op, Register, Register),
    /// A function of three arguments.
    CallThree(Register, op::Op, Register, Register, Register),
    /// A function with data, by its number: a derivative at one or two numbers.
    External(Register, u16, Derivative, Register, Register),
    /// The sine and, after it, the cosine.
    SinCos(Register, Register, Register),
    Less(Register, Register, Register),
    LessEqual(Register, Register, Register),
    Equal(Register, Register, Register),
    Not(Register, Register),
    And(Register, Register, Register),
    Or(Register, Register, Register),
    /// Where the condition holds, the second, elsewhere the third.
    Select(Register, Register, Register, Register),
    /// 1 where the condition holds, 0 elsewhere.
    Number01(Register, Register),
    /// The condition that a number is 1.
    IsOne(Register, Register),
    /// Operations that read the result of the operation before, where they say `Last`: it need not come back from memory.
    LastAdd(Register, Register),
    LastSub(Register, Register),
    SubLast(Register, Register),
    LastMul(Register, Register),
    LastSquare(Register),
    LastMulAdd(Register, Register, Register),
    MulAddLast(Register, Register, Register),
    LastNegMulAdd(Register, Register, Register),
    NegMulAddLast(Register, Register, Register),
    LastCall(Register, op::Op),
    /// Eight operations, of these registers and the seven behind each.
    EightAdd(Register, Register, Register),
    EightSub(Register, Register, Register),
    EightMul(Register, Register, Register),
    EightMulAdd(Register, Register, Register, Register),
    EightRecip(Register, Register),
    EightSqrt(Register, Register),
    /// Adds a term to a sum, with the first of its eight partial sums, in the loop of a depth.
    Accumulate {
        sum: Register,
        term: Register,
        partial: Register,
        level: u8,
    },
    /// Adds to the coordinate, or the momentum, at a place: the most frequent of `Store`.
    AddToQ(u32, Register),
    AddToP(u32, Register),
    AddProductToQ(u32, Register, Register),
    AddProductToP(u32, Register, Register),
    SubProductFromQ(u32, Register, Register),
    SubProductFromP(u32, Register, Register),
    /// Changes the element at a place.
    Store(To, u32, Change, Register, Register),
    /// Changes the element at the address of this number.
    StoreAt(To, u32, Change, Register, Register),
    /// The beginning of the loop of this number.
    Loop(u32),
    /// Its end.
    End(u32),
}

/// `constant + Σ factor·(variable of the loop of a depth)`
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Form {
    pub(crate) constant: i64,
    pub(crate) terms: Vec<(u8, i64)>,
}

impl Form {
    #[inline(always)]
    pub(crate) fn value(&self, variables: &[i64; DEPTH]) -> i64 {
        let mut sum = self.constant;
        for (level, factor) in &self.terms {
            sum += factor * variables[usize::from(*level)];
        }
        sum
    }
}

/// An index of one axis: a form, and the modulus.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Axis {
    pub(crate) form: Form,
    pub(crate) modulo: Option<Form>,
    /// The extent of the axis, by which the index before it is multiplied.
    pub(crate) extent: i64,
    /// The distance of neighbours on the last axis.
    pub(crate) stride: i64,
}

/// The place of an element: that of the array, and the indices of its axes, the first one first. Most are the base with a few
/// terms instead.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Address {
    pub(crate) base: i64,
    /// Two loops with the factors of their variables, 0 if there is none: their products are added to the base.
    pub(crate) terms: [(u8, i64); 2],
    pub(crate) axes: Vec<Axis>,
}

impl Address {
    /// The address without axes, if it is a form over few loops.
    pub(crate) fn simplified(self) -> Address {
        let mut constant = self.base;
        let mut terms: Vec<(u8, i64)> = Vec::new();
        let mut before = 1;
        for axis in self.axes.iter().rev() {
            if axis.modulo.is_some() {
                return self;
            }
            let factor = before * axis.stride;
            constant += factor * axis.form.constant;
            for (level, of) in &axis.form.terms {
                match terms.iter_mut().find(|(known, _)| known == level) {
                    Some((_, sum)) => *sum += factor * of,
                    None => terms.push((*level, factor * of)),
                }
            }
            before *= axis.extent;
        }
        terms.retain(|(_, factor)| *factor != 0);
        if terms.len() > 2 {
            return self;
        }
        terms.resize(2, (0, 0));
        Address {
            base: constant,
            terms: [terms[0], terms[1]],
            axes: Vec::new(),
        }
    }

    #[inline(always)]
    pub(crate) fn value(&self, variables: &[i64; DEPTH]) -> usize {
        let mut place = 0;
        for axis in &self.axes {
            let mut index = axis.form.value(variables);
            if let Some(modulo) = &axis.modulo {
                index = index.rem_euclid(modulo.value(variables).max(1));
            }
            place = place * axis.extent + index * axis.stride;
        }
        for (level, factor) in self.terms {
            place += factor * variables[usize::from(level) % DEPTH];
        }
        // A negative place is that of no element.
        (self.base + place) as usize
    }
}

/// A loop.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct LoopCode {
    pub(crate) level: usize,
    pub(crate) start: Form,
    pub(crate) end: Form,
    /// The most that the end is.
    pub(crate) most: i64,
    /// The sums that begin at 0.
    pub(crate) zero: Vec<Register>,
    /// Sums with the first of their partial sums, if the loop is innermost and its sums are trees.
    pub(crate) trees: Vec<(Register, Register)>,
    /// 1, or −1 from the last iteration to the first.
    pub(crate) step: i64,
    /// The least number of iterations of such trees.
    pub(crate) long: i64,
    /// The operation behind the beginning.
    pub(crate) body: usize,
    /// The operation behind the end.
    pub(crate) after: usize,
}

/// A number that is known before a stage runs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Held {
    /// Its two words.
    Constant(f64, f64),
    /// A scalar parameter.
    Scalar(u16),
    /// A prepared value.
    Prepared(u32),
    /// An element of the arrays of parameters, and those that preparation fills.
    Data(u32),
}

/// A straight piece of code with loops.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Stage {
    pub(crate) ops: Vec<Op>,
    pub(crate) loops: Vec<LoopCode>,
    pub(crate) forms: Vec<Form>,
    pub(crate) addresses: Vec<Address>,
    /// What the first registers hold; those of the step coefficient follow.
    pub(crate) held: Vec<Held>,
    /// The number of values of the step coefficient that follow.
    pub(crate) coefficients: usize,
    /// The number of registers.
    pub(crate) registers: usize,
    /// The number of registers of conditions.
    pub(crate) masks: usize,
    /// The registers of the results.
    pub(crate) results: Vec<Register>,
    /// The same operations, which may read the result of the one before, if it is short and has no loops; otherwise none.
    pub(crate) short: Option<Vec<Op>>,
    /// The ranges of outputs that begin at 0.
    pub(crate) cleared: Vec<(To, usize, usize)>,
}

impl Stage {
    /// The same with loops from their last iteration to the first. It has no sums in trees.
    pub(crate) fn reversed(&self) -> Stage {
        let mut stage = self.clone();
        stage.loops.iter_mut().for_each(|of| of.step = -of.step);
        stage
    }
}

/// A function of a system.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct FunctionCode {
    /// The values that depend on parameters and the step coefficient alone.
    pub(crate) coefficient: Stage,
    pub(crate) evaluation: Stage,
    /// The evaluation in a frame, if it is the flow of a piece and short.
    pub(crate) framed: Option<Framed>,
}

impl FunctionCode {
    /// The same with loops from their last iteration to the first, for the numbers that this one folds.
    pub(crate) fn reversed(&self) -> FunctionCode {
        FunctionCode {
            coefficient: Stage::default(),
            evaluation: self.evaluation.reversed(),
            framed: None,
        }
    }
}

/// A flow as straight code in a frame, whose registers hold the point and the numbers of all flows.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Framed {
    pub(crate) ops: Vec<Op>,
    /// True if they are in an order for long code.
    pub(crate) is_laid: bool,
    /// The number of registers.
    pub(crate) registers: usize,
    /// The values of its held registers.
    pub(crate) held: Vec<Held>,
    /// The first of them.
    pub(crate) first_held: usize,
    /// The first register of the step coefficient.
    pub(crate) first_coefficient: usize,
    /// The number of those.
    pub(crate) coefficients: usize,
    /// True if the time is read.
    pub(crate) reads_time: bool,
}
