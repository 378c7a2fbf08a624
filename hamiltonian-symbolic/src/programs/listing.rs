//! Programs as text, one step a line.
//!
//! Input: a program. Output: its `Display`. Invariant: groups, parameters, sizes and loops appear by number;
//! a program does not contain their names.

use crate::dag::{Array, Column, Parameter, Partial, Relation, Side};
use crate::index::{Affine, Index};
use crate::list::IntoList;
use crate::program::{Instruction, Program, Step, Target, Update, Value};
use core::fmt::{Display, Formatter, Result, Write};

impl Display for Value {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match *self {
            Value::NONE => f.write_str("no value"),
            Value(number) => write!(f, "_{number}"),
        }
    }
}

impl Display for Affine {
    /// `i0 - n1 + 2`
    fn fmt(&self, f: &mut Formatter) -> Result {
        let loops = self.loops.iter().map(|(d, k)| (format!("i{}", d.0), *k));
        let sizes = self.sizes.iter().map(|(s, k)| (format!("n{}", s.0), *k));
        let products = self.products.iter().map(|(sizes, k)| {
            let names: Vec<String> = sizes.iter().map(|s| format!("n{}", s.0)).into_list();
            (names.join("*"), *k)
        });
        let mut is_first = true;
        for (name, k) in loops.chain(sizes).chain(products) {
            let (sign, size) = (if k < 0 { "-" } else { "+" }, k.unsigned_abs());
            match (is_first, k < 0) {
                (true, false) => {}
                (true, true) => f.write_char('-')?,
                _ => write!(f, " {sign} ")?,
            }
            match size {
                1 => f.write_str(&name)?,
                _ => write!(f, "{size}*{name}")?,
            }
            is_first = false;
        }
        match self.constant {
            0 if !is_first => Ok(()),
            k if is_first => write!(f, "{k}"),
            k if k < 0 => write!(f, " - {}", k.unsigned_abs()),
            k => write!(f, " + {k}"),
        }
    }
}

impl Display for Index {
    fn fmt(&self, f: &mut Formatter) -> Result {
        if let Some(outer) = &self.outer {
            write!(f, "({})*({}) + ", outer.index, outer.extent)?;
        }
        match &self.modulo {
            Some(modulo) => write!(f, "({}) % ({modulo})", self.affine),
            None => write!(f, "{}", self.affine),
        }
    }
}

impl Display for Column {
    fn fmt(&self, f: &mut Formatter) -> Result {
        let side = match self.side {
            Side::Q => 'q',
            Side::P => 'p',
        };
        write!(f, "{side}{}_{}", self.group, self.column)
    }
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Target::Phase(column) => write!(f, "d{column}"),
            Target::Parameter(Parameter(number)) => write!(f, "da{number}"),
            Target::Hoisted(number) => write!(f, "hoisted{number}"),
        }
    }
}

impl Display for Array {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Array::Phase(column) => write!(f, "{column}"),
            Array::Direction(column) => write!(f, "v{column}"),
            Array::Velocity(column) => write!(f, "velocity {column}"),
            Array::Parameter(Parameter(number)) => write!(f, "a{number}"),
            Array::Hoisted(number) => write!(f, "hoisted{number}"),
        }
    }
}

fn at(row: &Index, column: &Option<Index>) -> String {
    match column {
        Some(column) => format!("[{row}, {column}]"),
        None => format!("[{row}]"),
    }
}

impl Display for Instruction {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Instruction::Constant(value) => f.write_str(&value.to_text()),
            Instruction::Pi => f.write_str("pi"),
            Instruction::Scalar(Parameter(number)) => write!(f, "a{number}"),
            Instruction::Time => f.write_char('t'),
            Instruction::Coefficient => f.write_char('c'),
            Instruction::StandIn(what) => write!(f, "{what:?}"),
            Instruction::Variable(domain) => write!(f, "i{}", domain.0),
            Instruction::Extent(size) => write!(f, "n{}", size.0),
            Instruction::Count(start, end) => write!(f, "max({end} - ({start}), 0)"),
            Instruction::Load(array, row, column) => write!(f, "{array}{}", at(row, column)),
            Instruction::Accumulator => f.write_char('0'),
            Instruction::Neg(a) => write!(f, "-{a}"),
            Instruction::Add(a, b) => write!(f, "{a} + {b}"),
            Instruction::Sub(a, b) => write!(f, "{a} - {b}"),
            Instruction::Mul(a, b) => write!(f, "{a}*{b}"),
            Instruction::MulAdd(a, b, c) => write!(f, "{a}*{b} + {c}"),
            Instruction::MulSub(a, b, c) => write!(f, "{a}*{b} - {c}"),
            Instruction::NegMulAdd(a, b, c) => write!(f, "{c} - {a}*{b}"),
            Instruction::Div(a, b) => write!(f, "{a}/{b}"),
            Instruction::Recip(a) => write!(f, "1/{a}"),
            Instruction::Call(op, arguments) => {
                write!(f, "{}({})", op.row().name, listed(arguments))
            }
            Instruction::PairedSin(a) => write!(f, "sin({a})"),
            Instruction::PairedCos(sine) => write!(f, "cos beside {sine}"),
            Instruction::External(function, part, arguments) => {
                match part {
                    Partial::Value => write!(f, "f{function}(")?,
                    Partial::First(i) => write!(f, "f{function}_{i}(")?,
                    Partial::Second(i, j) => write!(f, "f{function}_{i}_{j}(")?,
                    Partial::Higher { order, .. } => write!(f, "f{function}^{order}(")?,
                }
                write!(f, "{})", listed(arguments))
            }
            Instruction::Compare(relation, a, b) => {
                let sign = match relation {
                    Relation::Less => "<",
                    Relation::LessEqual => "<=",
                    Relation::Equal => "==",
                };
                write!(f, "{a} {sign} {b}")
            }
            Instruction::Not(a) => write!(f, "!{a}"),
            Instruction::And(a, b) => write!(f, "{a} && {b}"),
            Instruction::Or(a, b) => write!(f, "{a} || {b}"),
            Instruction::Select(c, a, b) => write!(f, "if {c} {{ {a} }} else {{ {b} }}"),
        }
    }
}

impl Display for Program {
    fn fmt(&self, f: &mut Formatter) -> Result {
        writeln!(f, "prepare")?;
        self.list(f, &self.prepare, 1)?;
        for function in &self.functions {
            writeln!(f, "{:?}", function.purpose)?;
            if !function.coefficient.is_empty() {
                writeln!(f, "  with a coefficient")?;
                self.list(f, &function.coefficient, 2)?;
            }
            for target in &function.cleared {
                writeln!(f, "  {target} = 0")?;
            }
            self.list(f, &function.evaluation, 1)?;
            for value in &function.results {
                writeln!(f, "  return {value}")?;
            }
        }
        Ok(())
    }
}

impl Program {
    fn list(&self, f: &mut Formatter, steps: &[Step], depth: usize) -> Result {
        let margin = "  ".repeat(depth);
        for step in steps {
            match step {
                Step::Let(value) => writeln!(f, "{margin}{value} = {}", self.instruction(*value))?,
                Step::Accumulate(sum, value) => writeln!(f, "{margin}{sum} += {value}")?,
                Step::Store(target, row, column, update) => {
                    let place = format!("{margin}{target}{}", at(row, column));
                    match update {
                        Update::Set(a) => writeln!(f, "{place} = {a}")?,
                        Update::Add(a) => writeln!(f, "{place} += {a}")?,
                        Update::Sub(a) => writeln!(f, "{place} -= {a}")?,
                        Update::AddProduct(a, b) => writeln!(f, "{place} += {a}*{b}")?,
                        Update::SubProduct(a, b) => writeln!(f, "{place} -= {a}*{b}")?,
                    }
                }
                Step::Loop(nest) => {
                    for sum in &nest.accumulators {
                        writeln!(f, "{margin}{sum} = 0")?;
                    }
                    let (start, end) = (&nest.start, &nest.end);
                    writeln!(f, "{margin}for i{} in {start}..{end}", nest.domain.0)?;
                    self.list(f, &nest.body, depth + 1)?;
                }
            }
        }
        Ok(())
    }
}

/// `a, b, c`
fn listed(values: &[Value]) -> String {
    let values: Vec<String> = values.iter().map(Value::to_string).into_list();
    values.join(", ")
}
