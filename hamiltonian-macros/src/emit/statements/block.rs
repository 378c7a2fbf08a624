//! Steps as source text: one `let` an instruction, loops as loops.
//!
//! Input: steps of a program. Output: Rust statements over a scalar type `T`. Invariants: value
//! `n` is called `_n`; numbers stand where they are used; an index modulo a size is no operation
//! of a loop body: the loop runs in segments in which nothing wraps.

use crate::emit::names::context::{Access, Context, ZERO};
use crate::emit::names::index::variable;
use crate::emit::names::layout::{Layout, Slice};
use crate::emit::names::number;
use crate::emit::steps::accesses::{Accesses, start_name};
use crate::emit::steps::inline::{Binding, Inlined};
use crate::emit::steps::together::{Calls, few, first};
use hamiltonian_symbolic::dag::{Array, Column, Partial, Relation};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Target, Update, Value};
use std::fmt::Write;

/// The name of a value.
pub fn name(value: Value) -> String {
    format!("_{}", value.0)
}

/// The names of values in a list.
pub fn names(values: &[Value]) -> String {
    let names: Vec<String> = values.iter().map(|value| name(*value)).into_list();
    names.join(", ")
}

/// The name of a function written in Rust, or of a derivative of it.
pub fn external(number: u16, part: Partial) -> String {
    match part {
        Partial::Value => format!("__f{number}"),
        Partial::First(i) => format!("__f{number}_{i}"),
        Partial::Second(i, j) => format!("__f{number}_{i}_{j}"),
        Partial::Higher { order, .. } => unreachable!("derivatives of order {order} are refused"),
    }
}

/// A value where it is used.
pub fn operand(context: Context, value: Value) -> String {
    match context.program.instruction(value) {
        Instruction::Constant(number) => number::constant(number),
        Instruction::Pi => number::pi(),
        _ => name(value),
    }
}

/// Writes steps; `arithmetic` is the expression of how their loops are computed. Values of `inlined` stand where
/// they are used. Returns them with those of the steps.
pub fn write(
    out: &mut String,
    context: Context,
    arithmetic: &'static str,
    steps: &[Step],
    inlined: Inlined,
) -> Inlined {
    let mut writer = Writer {
        is_written_out: few(context.program, steps),
        inlined,
        context,
        arithmetic,
        out,
        indices: Vec::new(),
        slices: Vec::new(),
        trees: Vec::new(),
        slabs: Vec::new(),
        tile: None,
        body: None,
        same: Vec::new(),
        is_inside: false,
        is_nest: false,
    };
    writer.steps(steps);
    writer.inlined
}

pub(super) struct Writer<'a> {
    pub(super) context: Context<'a>,
    /// The expression of how loops are computed.
    pub(super) arithmetic: &'static str,
    pub(super) out: &'a mut String,
    /// Wrapped indices of open loops and the text they are reached by.
    indices: Vec<(Index, String)>,
    /// Elements of open loops that are reached through a slice cut to the segment.
    pub(super) slices: Vec<(Slice, Index, String)>,
    /// Sums of the open loop that are trees where it is long: whether it is, and the partial sum that an
    /// iteration adds to.
    pub(super) trees: Vec<(Value, String, String)>,
    /// Columns of which a slab is there, with the number of elements of a row.
    pub(super) slabs: Vec<(Slice, String)>,
    /// Variables of loops that are made as one, and that of the first one.
    pub(super) same: Vec<(Domain, Domain)>,
    /// The loop over the columns of a row in a tile.
    pub(super) tile: Option<Domain>,
    /// The type of arithmetic that two forms of a loop share.
    pub(super) body: Option<String>,
    /// True if a loop is open.
    pub(super) is_inside: bool,
    /// True in a nest that core runs as a whole.
    pub(super) is_nest: bool,
    /// True if calls that are computed together are written out.
    is_written_out: bool,
    /// The values of the outermost level that stand where they are used.
    inlined: Inlined,
}

impl Writer<'_> {
    pub(super) fn steps(&mut self, steps: &[Step]) {
        let mut next = 0;
        while let Some(step) = steps.get(next) {
            next += 1;
            match step {
                Step::Let(value) => match first(self.context.program, &steps[next - 1..]) {
                    Some(calls) if !self.is_inside => next += self.each(calls) - 1,
                    _ => self.compute(*value),
                },
                Step::Accumulate(to, value) => {
                    let (sum, value) = (name(*to), self.operand(*value));
                    match self.trees.iter().find(|(tree, ..)| tree == to) {
                        Some((_, is_long, tree)) => line!(
                            self,
                            "if {is_long} {{ {tree} += {value}; }} else {{ {sum} += {value}; }}"
                        ),
                        None => line!(self, "{sum} += {value};"),
                    }
                }
                Step::Store(target, row, column, update) => {
                    let place = self.target(*target, row, column.as_ref());
                    self.update(&place, update);
                }
                Step::Loop(_) => next += self.loops(&steps[next - 1..]) - 1,
            }
        }
    }

    /// Writes the first of some steps, which are loops; their number.
    fn loops(&mut self, steps: &[Step]) -> usize {
        let mut loops = Vec::new();
        for step in steps {
            let Step::Loop(inner) = step else { break };
            loops.push(inner);
        }
        let count = self.joint(&loops);
        loops.truncate(count.max(1));
        let is_outermost = !std::mem::replace(&mut self.is_inside, true);
        let is_apart = is_outermost && (self.in_tiles(&loops) || self.in_slabs(&loops));
        if !is_apart {
            match is_outermost {
                true => self.whole(&loops, None),
                false => self.rows_of(&loops, None),
            }
        }
        self.is_inside = !is_outermost;
        loops.len()
    }

    /// Writes one loop, or several as one; of an outermost one the rows of a slab, if that is there.
    pub(super) fn rows_of(&mut self, loops: &[&Loop], slab: Option<Domain>) {
        match (loops, slab) {
            ([outer], None) => self.nest(outer),
            ([outer], Some(slab)) => {
                line!(self, "for {} in _r{} {{", variable(outer.domain), slab.0);
                self.steps(&outer.body);
                line!(self, "}}");
            }
            _ => {
                let parts = loops.iter().map(|outer| (*outer, None)).into_list();
                self.join(&parts, slab);
            }
        }
    }

    pub(super) fn operand(&self, value: Value) -> String {
        self.at(value, Binding::Atom)
    }

    /// A value in a place that binds it so tightly.
    fn at(&self, value: Value, place: Binding) -> String {
        let text = self.inlined.text(value, place);
        text.unwrap_or_else(|| operand(self.context, value))
    }

    /// Writes calls of one function as one; the number of their steps.
    fn each(&mut self, calls: Calls) -> usize {
        let values = calls.values.iter().map(|(value, cosine)| match cosine {
            Some(cosine) => format!("({}, {})", name(*value), name(*cosine)),
            None => name(*value),
        });
        let arguments = calls.arguments.iter();
        let arguments = arguments.map(|argument| self.at(*argument, Binding::Whole));
        line!(
            self,
            "let [{}] = __h::each!(T, {} {}: {});",
            values.into_list().join(", "),
            calls.function,
            self.is_written_out,
            arguments.into_list().join(", ")
        );
        calls.steps
    }

    fn compute(&mut self, value: Value) {
        let program = self.context.program;
        let instruction = program.instruction(value);
        if instruction.is_number() {
            return;
        }
        if let Instruction::PairedSin(angle) = instruction {
            // The cosine is the value that names this one; it was made right after.
            let cosine = (value.0 as usize + 1..program.instructions.len())
                .find(|at| program.instructions[*at] == Instruction::PairedCos(value));
            let (angle, sine) = (self.operand(*angle), name(value));
            match cosine {
                Some(cosine) => line!(self, "let ({sine}, _{cosine}) = {angle}.sin_cos();"),
                None => line!(self, "let {sine} = {angle}.sin();"),
            }
            return;
        }
        if matches!(instruction, Instruction::PairedCos(_)) {
            return;
        }
        let text = self.instruction(instruction);
        if !self.inlined.take(value, Binding::of(instruction), &text) {
            line!(self, "let {} = {text};", name(value));
        }
    }

    fn instruction(&self, instruction: &Instruction) -> String {
        let v = |value: &Value| self.operand(*value);
        let whole = |value: &Value| self.at(*value, Binding::Whole);
        // A right operand needs parentheses around operators of the same precedence; a left operand does not.
        let [term, factor] = [Binding::Term, Binding::Factor]
            .map(|place| move |value: &Value| self.at(*value, place));
        match instruction {
            Instruction::Constant(value) => number::constant(value),
            Instruction::Pi => number::pi(),
            Instruction::Scalar(parameter) => self.context.generics.lifted(parameter.0),
            Instruction::Time => "_t".into(),
            Instruction::Coefficient => "_c".into(),
            Instruction::StandIn(what) => unreachable!("a valid program has no {what:?}"),
            Instruction::Variable(domain) => real(&variable(*domain)),
            Instruction::Extent(size) => real(self.context.indices.size(*size)),
            Instruction::Count(start, end) => {
                let length = end.plus(-1, start);
                real(&format!("({})", self.context.indices.saturating(&length)))
            }
            Instruction::Load(array, row, column) => self.element(*array, row, column.as_ref()),
            Instruction::Accumulator => ZERO.into(),
            Instruction::Neg(a) => format!("-{}", v(a)),
            Instruction::Add(a, b) => format!("{} + {}", term(a), factor(b)),
            Instruction::Sub(a, b) => format!("{} - {}", term(a), factor(b)),
            Instruction::Mul(a, b) => format!("{} * {}", factor(a), v(b)),
            Instruction::MulAdd(a, b, c) => format!("{}.fma({}, {})", v(a), whole(b), whole(c)),
            Instruction::MulSub(a, b, c) => format!("{}.fma({}, -{})", v(a), whole(b), v(c)),
            Instruction::NegMulAdd(a, b, c) => {
                format!("(-{}).fma({}, {})", v(a), whole(b), whole(c))
            }
            Instruction::Div(a, b) => format!("{} / {}", factor(a), v(b)),
            Instruction::Recip(a) => format!("{}.recip()", v(a)),
            Instruction::Call(op, arguments) => {
                let others: Vec<String> = arguments[1..].iter().map(whole).into_list();
                format!(
                    "{}.{}({})",
                    v(&arguments[0]),
                    op.row().name,
                    others.join(", ")
                )
            }
            Instruction::PairedSin(a) => format!("{}.sin()", v(a)),
            Instruction::PairedCos(a) => v(a),
            Instruction::External(function, part, arguments) => {
                let mut arguments: Vec<String> = arguments.iter().map(whole).into_list();
                if self.context.is_parameter(*function) {
                    arguments.insert(0, format!("_f{function}"));
                }
                format!("{}({})", external(*function, *part), arguments.join(", "))
            }
            Instruction::Compare(relation, a, b) => {
                let method = match relation {
                    Relation::Less => "lt",
                    Relation::LessEqual => "le",
                    Relation::Equal => "equals",
                };
                format!("{}.{method}({})", v(a), whole(b))
            }
            Instruction::Not(a) => format!("!{}", v(a)),
            Instruction::And(a, b) => format!("{} & {}", v(a), v(b)),
            Instruction::Or(a, b) => format!("{} | {}", v(a), v(b)),
            Instruction::Select(c, a, b) => {
                format!("T::select({}, {}, {})", whole(c), whole(a), whole(b))
            }
        }
    }

    fn update(&mut self, place: &str, update: &Update) {
        let v = |value: &Value| self.operand(*value);
        let whole = |value: &Value| self.at(*value, Binding::Whole);
        let text = match update {
            Update::Set(a) => format!("{place} = {};", whole(a)),
            Update::Add(a) => format!("{place} += {};", whole(a)),
            Update::Sub(a) => format!("{place} -= {};", whole(a)),
            Update::AddProduct(a, b) => format!("{place} = {}.fma({}, {place});", v(a), whole(b)),
            Update::SubProduct(a, b) => {
                format!("{place} = (-{}).fma({}, {place});", v(a), whole(b))
            }
        };
        line!(self, "{text}");
    }

    /// An index where it is used: of a loop's segment, or computed on the spot.
    pub(super) fn index(&self, index: &Index) -> String {
        match self.indices.iter().find(|(known, _)| known == index) {
            Some((_, text)) => text.clone(),
            None => self.context.indices.index(index),
        }
    }

    fn element(&self, array: Array, row: &Index, column: Option<&Index>) -> String {
        let slice = self.context.read(array);
        match array {
            Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => {
                self.place(slice, Some(at.group), row)
            }
            Array::Parameter(_) | Array::Hoisted(_) => {
                self.place(slice, None, &self.context.number(array, row, column))
            }
        }
    }

    fn target(&self, target: Target, row: &Index, column: Option<&Index>) -> String {
        let slice = Slice::write(self.context.layout, target);
        match target {
            Target::Phase(Column { group, .. }) => self.place(slice, Some(group), row),
            Target::Hoisted(_) => self.place(slice, None, row),
            Target::Parameter(parameter) => self.entry(slice, parameter.0, row, column),
        }
    }

    /// An element of a column.
    fn place(&self, slice: Slice, group: Option<u16>, row: &Index) -> String {
        match (self.context.layout, group) {
            (Layout::Scalars, Some(group)) => slice.scalar(group),
            _ => match self
                .slices
                .iter()
                .find(|(s, index, _)| *s == slice && index == row)
            {
                Some((_, _, text)) => text.clone(),
                None => {
                    let place = self.within(&slice, self.index(row));
                    format!("{}[{place}]", slice.name())
                }
            },
        }
    }

    /// An element of an array of derivatives by parameters, stored as the parameter is.
    fn entry(&self, slice: Slice, parameter: u16, row: &Index, column: Option<&Index>) -> String {
        let Some(column) = column else {
            return self.place(slice, None, row);
        };
        let shape = &self.context.model.parameters[usize::from(parameter)].shape;
        let Some(extent) = shape.rows() else {
            return self.place(slice, None, row);
        };
        let rows = match extent.as_constant() {
            Some(number) => number.to_string(),
            None => self.context.indices.modulus(extent),
        };
        let numbers = [&row.affine, &column.affine].map(Affine::as_constant);
        let place = match (numbers, rows.parse::<i64>()) {
            ([Some(row), Some(column)], Ok(rows)) => (row + rows * column).to_string(),
            _ => format!("{} + {rows} * ({})", self.index(row), self.index(column)),
        };
        format!("{}[{place}]", slice.name())
    }

    /// A loop: whole where no index wraps, in segments otherwise.
    pub(super) fn nest(&mut self, inner: &Loop) {
        let mut found = Accesses::of(self.context, inner);
        let (known_indices, known_slices) = (self.indices.len(), self.slices.len());
        let d = inner.domain.0;
        let is_tile = self.tile == Some(inner.domain);
        let (start, end) = match is_tile {
            true => (format!("_r{d}.start"), format!("_r{d}.end")),
            false => (
                self.context.indices.start(&inner.start),
                self.context.indices.saturating(&inner.end),
            ),
        };
        if let Some(stretch) = self.stretch(inner, &found) {
            return self.run(inner, &stretch, [&start, &end]);
        }
        if self.context.access != Access::Apart {
            // Iterations that read what others change are not divided into segments.
            found = Accesses::default();
        }
        for accumulator in &inner.accumulators {
            line!(self, "let mut {} = {ZERO};", name(*accumulator));
        }
        // A check of an element costs little beside a loop.
        if inner.body.iter().any(|step| matches!(step, Step::Loop(_))) {
            found.cuts.clear();
        }
        if found.wrapped.is_empty() && found.cuts.is_empty() {
            let range = match self.context.access {
                Access::Reversed => format!("({start}..{end}).rev()"),
                Access::Apart | Access::InPlace => format!("{start}..{end}"),
            };
            let length = format!("({end}).saturating_sub({start})");
            self.open(inner, [&length, &start]);
            line!(self, "for _i{d} in {range} {{");
            match self.context.access {
                Access::Apart => self.iteration(&inner.body),
                // They follow from each other: no pack of them is made.
                Access::InPlace | Access::Reversed => self.steps(&inner.body),
            }
            line!(self, "}}");
            self.close(inner);
            return;
        }
        if found.is_plain(inner) && !is_tile {
            line!(self, "let _l{d} = {end};");
            self.open(inner, [&format!("_l{d}"), "0usize"]);
            for (at, (slice, index)) in found.cuts.iter().enumerate() {
                let (reference, name) = (reference(slice), slice.name());
                line!(self, "let _x{d}_{at} = {reference}{name}[.._l{d}];");
                let text = format!("_x{d}_{at}[_i{d}]");
                self.slices.push((*slice, index.clone(), text));
            }
            line!(self, "for _i{d} in 0.._l{d} {{");
            self.iteration(&inner.body);
            line!(self, "}}");
            self.close(inner);
            self.slices.truncate(known_slices);
            return;
        }
        let is_wrapped = !found.wrapped.is_empty();
        let mutable = if is_wrapped { "mut " } else { "" };
        line!(self, "let ({mutable}_i{d}, _e{d}) = ({start}, {end});");
        self.open(
            inner,
            [&format!("_e{d}.saturating_sub(_i{d})"), &format!("_i{d}")],
        );
        let word = if is_wrapped { "while" } else { "if" };
        line!(self, "{word} _i{d} < _e{d} {{");
        line!(self, "let {mutable}_l{d} = _e{d} - _i{d};");
        self.wrap(inner.domain, &found.wrapped);
        self.cut(inner.domain, &found.cuts);
        line!(self, "for _k{d} in 0.._l{d} {{");
        line!(self, "let _i{d} = _i{d} + _k{d};");
        self.iteration(&inner.body);
        line!(self, "}}");
        if is_wrapped {
            line!(self, "_i{d} += _l{d};");
        }
        line!(self, "}}");
        self.close(inner);
        self.indices.truncate(known_indices);
        self.slices.truncate(known_slices);
    }

    /// Binds the starts of the wrapped indices in a segment, and shortens it to where one of them wraps.
    fn wrap(&mut self, domain: Domain, wrapped: &[(Index, i64)]) {
        let d = domain.0;
        for (at, (index, factor)) in wrapped.iter().enumerate() {
            let Some(modulo) = &index.modulo else {
                continue;
            };
            let start = self.context.indices.wrapped(&index.affine, modulo);
            let room = if *factor > 0 {
                format!("{} - _w{d}_{at}", self.context.indices.modulus(modulo))
            } else {
                format!("_w{d}_{at} + 1")
            };
            line!(self, "let _w{d}_{at} = {start};");
            line!(self, "if {room} < _l{d} {{ _l{d} = {room}; }}");
            let own = start_name(domain, at, index);
            if index.outer.is_some() {
                let start = self.context.indices.in_row(index, &format!("_w{d}_{at}"));
                line!(self, "let {own} = {start};");
            }
            let sign = if *factor > 0 { '+' } else { '-' };
            self.indices
                .push((index.clone(), format!("{own} {sign} _k{d}")));
        }
    }

    /// The slices of a segment, as long as the segment, so that no element needs a check.
    pub(super) fn cut(&mut self, domain: Domain, cuts: &[(Slice, Index)]) {
        let d = domain.0;
        for (at, (slice, index)) in cuts.iter().enumerate() {
            let start = match self.indices.iter().position(|(known, _)| known == index) {
                Some(known) => {
                    let start = self.indices[known].1.split(' ').next();
                    start.expect("text has a first word").to_owned()
                }
                None => self.context.indices.index(index),
            };
            let start = self.within(slice, start);
            line!(
                self,
                "let _x{d}_{at} = {}{}[{start}..][.._l{d}];",
                reference(slice),
                slice.name()
            );
            self.slices
                .push((*slice, index.clone(), format!("_x{d}_{at}[_k{d}]")));
        }
    }
}

/// The borrow of a part of a slice.
fn reference(slice: &Slice) -> &'static str {
    if slice.is_written() { "&mut " } else { "&" }
}

/// A `usize` expression as a scalar.
fn real(text: &str) -> String {
    format!("T::constant({text} as __h::core::primitive::f64, 0.0)")
}

/// Sets output columns to 0.
pub fn clear(out: &mut String, context: Context, targets: &[Target]) {
    for target in targets {
        let slice = Slice::write(context.layout, *target);
        let _ = match target {
            Target::Phase(Column { group, .. }) if context.layout == Layout::Scalars => {
                writeln!(out, "{} = {ZERO};", slice.scalar(*group))
            }
            Target::Phase(_) => writeln!(out, "{}.fill({ZERO});", slice.name()),
            // Derivatives with respect to parameters start at 0.
            Target::Parameter(_) | Target::Hoisted(_) => Ok(()),
        };
    }
}

/// The slices that clearing writes.
pub fn cleared(context: Context, targets: &[Target]) -> Vec<Slice> {
    let phase = targets
        .iter()
        .filter(|target| matches!(target, Target::Phase(_)));
    phase
        .map(|target| Slice::write(context.layout, *target))
        .into_list()
}
