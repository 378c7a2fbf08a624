//! Programs at given sizes as flat code.
//!
//! Input: a program, the sizes, the places of arrays. Output: a [`Stage`] for each block of steps. Invariant: operations in
//! the order of the program's steps; what has no such code is refused by name.

use crate::allocate::{Layout, allocate};
use crate::chain::{CHAINED, chained, forwarded};
use crate::machine;
use crate::op::{
    Address, Axis, COEFFICIENT, Change, DEPTH, Form, From, HELD, Held, Op, Register, Stage, To,
};
use crate::sizes::value;
use crate::tabulated::Derivative;
use hamiltonian_symbolic::PI_LOW;
use hamiltonian_symbolic::dag::{Array, Column, Map, Relation, Side};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::op;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Target, Update, Value};

/// The places of arrays.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Places {
    /// Of each group its first component, and the number of its rows.
    pub(crate) groups: Vec<(usize, usize)>,
    /// The number of components.
    pub(crate) len: usize,
    /// Of each parameter the place of its first element, and the number of its columns.
    pub(crate) parameters: Vec<(usize, usize)>,
    /// Of each array that preparation fills.
    pub(crate) hoisted: Vec<usize>,
    /// The number of all these elements.
    pub(crate) data: usize,
}

/// What the stages of a program share.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    pub(crate) program: &'a Program,
    pub(crate) sizes: &'a [usize],
    pub(crate) places: &'a Places,
}

/// The stage that is built.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// It fills arrays.
    Prepare,
    /// Of the step coefficient, or an evaluation.
    Plain,
    /// It moves a point in place.
    InPlace,
}

/// Builds the stage of some steps, and returns the values of the coefficient stage that it reads; `coefficients` are
/// those that there are.
pub(crate) fn stage(
    setting: Setting,
    kind: Kind,
    steps: &[Step],
    coefficients: &[Value],
    results: &[Value],
) -> Result<(Stage, Vec<Value>), String> {
    let mut builder = Builder::new(setting, kind, coefficients);
    builder.steps(steps)?;
    for result in results {
        let register = match setting.program.instruction(*result).is_mask() {
            true => {
                let mask = builder.mask(*result)?;
                let to = builder.register();
                builder.push(Op::Number01(to, mask));
                to
            }
            false => builder.number(*result)?,
        };
        builder.stage.results.push(register);
    }
    let read = builder.read;
    let mut stage = builder.stage;
    stage.coefficients = read.len();
    let layout = Layout::of(&stage);
    let mut other = stage.clone();
    allocate(&mut stage, layout, &[]);
    if stage.loops.is_empty() && stage.ops.len() <= CHAINED {
        other.ops = chained(&other.ops);
        allocate(&mut other, layout, &[]);
        // More registers take longer to clear than the order saves.
        if machine::is_shortest(&other) || !machine::is_shortest(&stage) {
            stage = other;
        }
    }
    stage.short = machine::is_short(&stage).then(|| forwarded(&stage.ops));
    Ok((stage, read))
}

/// The values that steps compute, those of loops too.
pub(crate) fn computed(steps: &[Step], values: &mut Vec<Value>) {
    for step in steps {
        match step {
            Step::Let(value) => values.push(*value),
            Step::Loop(of) => {
                values.extend(&of.accumulators);
                computed(&of.body, values);
            }
            Step::Accumulate(..) | Step::Store(..) => {}
        }
    }
}

/// The iterations of loops that are unrolled.
#[derive(Default)]
pub(crate) struct Unrolled {
    pub(crate) variables: Map<Domain, i64>,
    /// The partial sums of the present loop, if its sums are trees: of each sum, eight.
    pub(crate) partials: Option<Map<Value, [Register; 8]>>,
    /// The number of the present iteration.
    pub(crate) iteration: usize,
    /// Of each operation the value of the program that it computes.
    pub(crate) sites: Vec<Option<Value>>,
}

impl Unrolled {
    fn variable(&self, domain: Domain) -> Result<i64, String> {
        let known = self.variables.get(&domain).copied();
        known.ok_or_else(|| "a variable outside of its loop".to_owned())
    }
}

pub(crate) struct Builder<'a> {
    pub(crate) setting: Setting<'a>,
    pub(crate) kind: Kind,
    pub(crate) coefficients: &'a [Value],
    pub(crate) stage: Stage,
    pub(crate) numbers: Map<Value, Register>,
    pub(crate) masks: Map<Value, Register>,
    /// The cosines that were computed with a sine.
    pub(crate) cosines: Map<Value, Register>,
    /// Where code has no loops and no addresses: the iterations of the present step.
    pub(crate) unrolled: Option<Unrolled>,
    /// The loops around the present step, each with the first partial sums of its sums.
    pub(crate) loops: Vec<(Domain, Vec<(Register, Register)>)>,
    /// The values of the coefficient stage that are read.
    pub(crate) read: Vec<Value>,
    /// The next register of numbers, and of conditions.
    pub(crate) next: [Register; 2],
}

impl<'a> Builder<'a> {
    pub(crate) fn new(setting: Setting<'a>, kind: Kind, coefficients: &'a [Value]) -> Self {
        Builder {
            setting,
            kind,
            coefficients,
            stage: Stage::default(),
            numbers: Map::default(),
            masks: Map::default(),
            cosines: Map::default(),
            unrolled: None,
            loops: Vec::new(),
            read: Vec::new(),
            next: [0; 2],
        }
    }

    pub(crate) fn push(&mut self, op: Op) {
        self.push_of(op, None);
    }

    /// An operation that computes a value of the program.
    fn push_of(&mut self, op: Op, of: Option<Value>) {
        self.stage.ops.push(op);
        if let Some(unrolled) = &mut self.unrolled {
            unrolled.sites.push(of);
        }
    }

    pub(crate) fn register(&mut self) -> Register {
        self.next[0] += 1;
        self.next[0] - 1
    }

    /// A register that holds a number.
    pub(crate) fn held(&mut self, held: Held) -> Register {
        let same = |known: &Held| match (known, &held) {
            (Held::Constant(a, b), Held::Constant(c, d)) => {
                [a.to_bits(), b.to_bits()] == [c.to_bits(), d.to_bits()]
            }
            _ => *known == held,
        };
        let at = self.stage.held.iter().position(same).unwrap_or_else(|| {
            self.stage.held.push(held);
            self.stage.held.len() - 1
        });
        HELD + at as Register
    }

    /// The register of a value of an earlier stage.
    fn earlier(&mut self, of: Value) -> Result<Register, String> {
        if self.coefficients.contains(&of) {
            let read = self.read.iter().position(|known| *known == of);
            let at = read.unwrap_or_else(|| {
                self.read.push(of);
                self.read.len() - 1
            });
            return Ok(COEFFICIENT + at as Register);
        }
        let prepared = &self.setting.program.prepared;
        match prepared.iter().position(|known| *known == of) {
            Some(at) => Ok(self.held(Held::Prepared(at as u32))),
            None => Err(format!("a value without a stage ({of:?})")),
        }
    }

    /// The register of a number.
    pub(crate) fn number(&mut self, of: Value) -> Result<Register, String> {
        if let Some(register) = self.numbers.get(&of) {
            return Ok(*register);
        }
        let register = match self.setting.program.instruction(of) {
            Instruction::Constant(rational) => {
                let (hi, lo) = rational.to_words();
                self.held(Held::Constant(hi, lo))
            }
            Instruction::Pi => self.held(Held::Constant(std::f64::consts::PI, PI_LOW)),
            Instruction::Scalar(parameter) => self.held(Held::Scalar(parameter.0)),
            _ => self.earlier(of)?,
        };
        self.numbers.insert(of, register);
        Ok(register)
    }

    /// The register of a condition.
    fn mask(&mut self, of: Value) -> Result<Register, String> {
        if let Some(register) = self.masks.get(&of) {
            return Ok(*register);
        }
        let number = self.earlier(of)?;
        let to = self.next[1];
        self.next[1] += 1;
        self.push(Op::IsOne(to, number));
        // Inside of a loop it is computed in each iteration: nothing keeps it for what follows.
        if self.loops.is_empty() {
            self.masks.insert(of, to);
        }
        Ok(to)
    }

    fn level(&self, domain: Domain) -> Result<u8, String> {
        let level = self.loops.iter().position(|(known, _)| *known == domain);
        let level = level.ok_or("a variable outside of its loop")?;
        Ok(level as u8)
    }

    pub(crate) fn form(&self, affine: &Affine) -> Result<Form, String> {
        let mut form = Form {
            constant: value(affine, self.setting.sizes),
            terms: Vec::new(),
        };
        for (domain, factor) in &affine.loops {
            match &self.unrolled {
                Some(unrolled) => form.constant += factor * unrolled.variable(*domain)?,
                None => form.terms.push((self.level(*domain)?, *factor)),
            }
        }
        Ok(form)
    }

    fn form_number(&mut self, affine: &Affine) -> Result<u32, String> {
        let form = self.form(affine)?;
        self.stage.forms.push(form);
        Ok(self.stage.forms.len() as u32 - 1)
    }

    /// The indices of the axes of an array, the first one first.
    fn axes(&self, index: &Index, axes: &mut Vec<Axis>) -> Result<(), String> {
        let mut extent = 0;
        if let Some(outer) = &index.outer {
            self.axes(&outer.index, axes)?;
            extent = value(&outer.extent, self.setting.sizes);
        }
        axes.push(Axis {
            form: self.form(&index.affine)?,
            modulo: index.modulo.as_ref().map(|of| self.form(of)).transpose()?,
            extent,
            stride: 1,
        });
        Ok(())
    }

    /// The address of an element: its place if it is the same in each iteration.
    fn address(
        &mut self,
        base: usize,
        row: &Index,
        column: Option<(&Index, usize)>,
    ) -> Result<Result<u32, u32>, String> {
        let mut axes = Vec::new();
        self.axes(row, &mut axes)?;
        if let Some((column, columns)) = column {
            let before = axes.len();
            self.axes(column, &mut axes)?;
            if let Some(first) = axes.get_mut(before) {
                first.extent = columns as i64;
            }
        }
        let base = base as i64;
        let address = Address {
            base,
            terms: [(0, 0); 2],
            axes,
        };
        let is_fixed = |form: &Form| form.terms.is_empty();
        let mut all = address.axes.iter();
        if all.all(|axis| is_fixed(&axis.form) && axis.modulo.as_ref().is_none_or(is_fixed)) {
            let at = address.value(&[0; DEPTH]);
            return Ok(Ok(at as u32));
        }
        let address = address.simplified();
        let known = self.stage.addresses.iter();
        let at = { known }.position(|known| *known == address);
        let at = at.unwrap_or_else(|| {
            self.stage.addresses.push(address);
            self.stage.addresses.len() - 1
        });
        Ok(Err(at as u32))
    }

    fn of_column(&self, column: Column) -> usize {
        let (offset, rows) = self.setting.places.groups[usize::from(column.group)];
        offset + rows * usize::from(column.column)
    }

    fn load(
        &mut self,
        to: Register,
        array: Array,
        row: &Index,
        column: Option<&Index>,
    ) -> Result<Register, String> {
        let places = self.setting.places;
        let is_prepare = self.kind == Kind::Prepare;
        let data = match is_prepare {
            true => From::Written(To::Data),
            false => From::Data,
        };
        let (from, base, column) = match array {
            Array::Phase(at) => {
                let from = match (self.kind == Kind::InPlace, at.side) {
                    (false, Side::Q) => From::Q,
                    (false, Side::P) => From::P,
                    (true, Side::Q) => From::Written(To::Q),
                    (true, Side::P) => From::Written(To::P),
                };
                (from, self.of_column(at), None)
            }
            Array::Direction(at) => {
                let from = match at.side {
                    Side::Q => From::VQ,
                    Side::P => From::VP,
                };
                (from, self.of_column(at), None)
            }
            Array::Parameter(parameter) => {
                let (base, columns) = places.parameters[usize::from(parameter.0)];
                (data, base, column.map(|column| (column, columns)))
            }
            Array::Hoisted(number) => (data, places.hoisted[usize::from(number)], None),
            Array::Velocity(_) => return Err("velocities in a program".to_owned()),
        };
        let op = match self.address(base, row, column)? {
            Ok(place) if self.unrolled.is_some() => return self.in_frame(from, place),
            Ok(place) => match from {
                From::Q => Op::LoadQ(to, place),
                From::P => Op::LoadP(to, place),
                from => Op::Load(to, from, place),
            },
            Err(address) => Op::LoadAt(to, from, address),
        };
        self.push(op);
        Ok(to)
    }

    pub(crate) fn steps(&mut self, steps: &[Step]) -> Result<(), String> {
        for step in steps {
            match step {
                Step::Let(value) => self.compute(*value)?,
                Step::Accumulate(sum, term) if self.unrolled.is_some() => {
                    self.add_term(*sum, *term)?;
                }
                Step::Loop(of) if self.unrolled.is_some() => self.unroll(of)?,
                Step::Accumulate(sum, term) => {
                    let (sum, term) = (self.number(*sum)?, self.number(*term)?);
                    let level = self.loops.len().saturating_sub(1) as u8;
                    let partial = self.loops.last().and_then(|(_, sums)| {
                        let mut sums = sums.iter();
                        sums.find(|(known, _)| *known == sum)
                    });
                    let partial = partial.map_or(sum, |(_, partial)| *partial);
                    self.push(Op::Accumulate {
                        sum,
                        term,
                        partial,
                        level,
                    });
                }
                Step::Store(target, row, column, update) => {
                    self.store(*target, row, column.as_ref(), update)?;
                }
                Step::Loop(of) => self.nest(of)?,
            }
        }
        Ok(())
    }

    fn store(
        &mut self,
        target: Target,
        row: &Index,
        column: Option<&Index>,
        update: &Update,
    ) -> Result<(), String> {
        if column.is_some() {
            return Err("derivatives by a matrix of parameters".to_owned());
        }
        let (to, base) = match target {
            Target::Phase(at) => {
                let to = match at.side {
                    Side::Q => To::Q,
                    Side::P => To::P,
                };
                (to, self.of_column(at))
            }
            Target::Hoisted(number) => (To::Data, self.setting.places.hoisted[usize::from(number)]),
            Target::Parameter(_) => return Err("derivatives by parameters".to_owned()),
        };
        let (change, a, b) = match update {
            Update::Set(a) => (Change::Set, a, a),
            Update::Add(a) => (Change::Add, a, a),
            Update::Sub(a) => (Change::Sub, a, a),
            Update::AddProduct(a, b) => (Change::AddProduct, a, b),
            Update::SubProduct(a, b) => (Change::SubProduct, a, b),
        };
        let (a, b) = (self.number(*a)?, self.number(*b)?);
        let op = match self.address(base, row, None)? {
            Ok(place) if self.unrolled.is_some() => {
                return self.change_in_frame(to, place, change, [a, b]);
            }
            Ok(place) => match (to, change) {
                (To::Q, Change::Add) => Op::AddToQ(place, a),
                (To::P, Change::Add) => Op::AddToP(place, a),
                (To::Q, Change::AddProduct) => Op::AddProductToQ(place, a, b),
                (To::P, Change::AddProduct) => Op::AddProductToP(place, a, b),
                (To::Q, Change::SubProduct) => Op::SubProductFromQ(place, a, b),
                (To::P, Change::SubProduct) => Op::SubProductFromP(place, a, b),
                _ => Op::Store(to, place, change, a, b),
            },
            Err(address) => Op::StoreAt(to, address, change, a, b),
        };
        self.push(op);
        Ok(())
    }

    fn compute(&mut self, of: Value) -> Result<(), String> {
        use Instruction as I;
        let program = self.setting.program;
        let instruction = program.instruction(of);
        if instruction.is_mask() {
            return self.condition(of);
        }
        if matches!(instruction, I::Constant(_) | I::Pi | I::Scalar(_)) {
            self.number(of)?;
            return Ok(());
        }
        if let I::PairedCos(sine) = instruction
            && let Some(cosine) = self.cosines.get(sine)
        {
            self.numbers.insert(of, *cosine);
            return Ok(());
        }
        let mut operands = Vec::new();
        if !matches!(instruction, I::PairedCos(_) | I::Select(..)) {
            let mut all = Vec::new();
            instruction.for_operands(|operand| all.push(operand));
            for operand in all {
                operands.push(self.number(operand)?);
            }
        }
        let to = self.register();
        let op = match (instruction, operands.as_slice()) {
            (I::Time, _) => Op::Time(to),
            (I::Coefficient, _) => Op::Coefficient(to),
            (I::Variable(_) | I::Extent(_) | I::Count(..), _) if self.unrolled.is_some() => {
                let number = self.count(instruction)?;
                self.numbers.insert(of, number);
                return Ok(());
            }
            (I::Variable(domain), _) => {
                Op::Number(to, self.form_number(&Affine::variable(*domain))?)
            }
            (I::Extent(size), _) => Op::Number(to, self.form_number(&Affine::size(*size))?),
            (I::Count(start, end), _) => {
                Op::Count(to, self.form_number(start)?, self.form_number(end)?)
            }
            (I::Load(array, row, column), _) => {
                let to = self.load(to, *array, row, column.as_ref())?;
                self.numbers.insert(of, to);
                return Ok(());
            }
            (I::Neg(_), &[a]) => Op::Neg(to, a),
            (I::Add(..), &[a, b]) => Op::Add(to, a, b),
            (I::Sub(..), &[a, b]) => Op::Sub(to, a, b),
            (I::Mul(..), &[a, b]) => Op::Mul(to, a, b),
            (I::MulAdd(..), &[a, b, c]) => Op::MulAdd(to, a, b, c),
            (I::MulSub(..), &[a, b, c]) => Op::MulSub(to, a, b, c),
            (I::NegMulAdd(..), &[a, b, c]) => Op::NegMulAdd(to, a, b, c),
            (I::Div(..), &[a, b]) => Op::Div(to, a, b),
            (I::Recip(_), &[a]) => Op::Recip(to, a),
            (I::Call(op::Op::Sqrt, _), &[a]) => Op::Sqrt(to, a),
            (I::Call(op, _), &[a]) => Op::Call(to, *op, a),
            (I::Call(op, _), &[a, b]) => Op::CallTwo(to, *op, a, b),
            (I::Call(op, _), &[a, b, c]) => Op::CallThree(to, *op, a, b, c),
            (I::PairedSin(_), &[a]) => {
                let cosine = self.register();
                self.cosines.insert(of, cosine);
                Op::SinCos(to, cosine, a)
            }
            (I::PairedCos(sine), _) => {
                let I::PairedSin(angle) = program.instruction(*sine) else {
                    return Err("a cosine without its sine".to_owned());
                };
                let (angle, sine) = (self.number(*angle)?, self.register());
                Op::SinCos(sine, to, angle)
            }
            (I::Select(mask, a, b), _) => {
                let mask = self.mask(*mask)?;
                Op::Select(to, mask, self.number(*a)?, self.number(*b)?)
            }
            (I::External(function, part, _), &[a] | &[a, _]) => {
                let derivative = Derivative::of(*part).ok_or("a third derivative")?;
                let b = operands.last().copied().unwrap_or(a);
                Op::External(to, *function, derivative, a, b)
            }
            // A loop sets it to 0.
            (I::Accumulator, _) if self.numbers.contains_key(&of) => return Ok(()),
            (other, _) => return Err(format!("an instruction without code ({other:?})")),
        };
        self.push_of(op, Some(of));
        self.numbers.insert(of, to);
        Ok(())
    }

    fn condition(&mut self, of: Value) -> Result<(), String> {
        let op = match self.setting.program.instruction(of) {
            Instruction::Compare(relation, a, b) => {
                let (a, b) = (self.number(*a)?, self.number(*b)?);
                let to = self.next[1];
                match relation {
                    Relation::Less => Op::Less(to, a, b),
                    Relation::LessEqual => Op::LessEqual(to, a, b),
                    Relation::Equal => Op::Equal(to, a, b),
                }
            }
            Instruction::Not(a) => {
                let a = self.mask(*a)?;
                Op::Not(self.next[1], a)
            }
            Instruction::And(a, b) => {
                let (a, b) = (self.mask(*a)?, self.mask(*b)?);
                Op::And(self.next[1], a, b)
            }
            Instruction::Or(a, b) => {
                let (a, b) = (self.mask(*a)?, self.mask(*b)?);
                Op::Or(self.next[1], a, b)
            }
            other => return Err(format!("no condition ({other:?})")),
        };
        self.masks.insert(of, self.next[1]);
        self.next[1] += 1;
        self.push(op);
        Ok(())
    }
}
