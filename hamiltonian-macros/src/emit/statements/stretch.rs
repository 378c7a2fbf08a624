//! Innermost loops that core runs: their arithmetic, the elements it reads, its stores and sums.
//!
//! Input: a loop with the columns that run along with it. Output: [`Stretch`], a type that implements
//! core's `Body`, and the call. Invariant: every element that is reached moves on by one with the loop
//! variable, or does not move; what an iteration computes is a function over any scalar.

use super::block::{Writer, name, names};
use crate::emit::names::context::{Access, ZERO};
use crate::emit::names::layout::Slice;
use crate::emit::steps::accesses::Accesses;
use crate::emit::steps::scan::scan;
use hamiltonian_symbolic::index::{Domain, Index, Loops};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Update, Value};
use std::fmt::Write;

/// The most values that an iteration in lanes computes.
pub(super) const MAX_VALUES: usize = 300;

/// A loop whose iterations core runs.
#[derive(Default)]
pub(super) struct Stretch {
    /// The type of its arithmetic.
    pub(super) name: String,
    /// What does not vary: its instructions are steps of the loop's body, or values from outside.
    given: Vec<Value>,
    /// What is read, with the number of its cut.
    reads: Vec<(Value, usize)>,
    /// The loop variable as a real.
    number: Option<Value>,
    /// Values that others are names of, in the arithmetic of several loops.
    same: Vec<(Value, Value)>,
    /// The steps of the arithmetic.
    computed: Vec<Step>,
    /// The results of the arithmetic.
    results: Vec<Value>,
    /// The columns that are written.
    columns: Vec<String>,
    stores: Vec<ColumnStore>,
    /// Sums that are added to.
    sums: Vec<Value>,
    /// The number of a sum and that of a result added to it, in order.
    added: Vec<(usize, usize)>,
    /// Stores and additions, for iterations one by one.
    rest: Vec<Step>,
}

/// A store of an iteration.
#[derive(Clone)]
struct ColumnStore {
    column: usize,
    change: &'static str,
    by: [usize; 2],
    /// The place of the first iteration; `None` in a column that is cut to the stretch.
    start: Option<String>,
}

/// The number of an element of a list, which it is added to if it is not there.
pub(super) fn number<X: PartialEq>(list: &mut Vec<X>, element: X) -> usize {
    list.iter()
        .position(|known| *known == element)
        .unwrap_or_else(|| {
            list.push(element);
            list.len() - 1
        })
}

/// The sums that an innermost loop adds to.
fn sums(inner: &Loop) -> Vec<Value> {
    let mut sums = Vec::new();
    for step in &inner.body {
        match step {
            Step::Accumulate(to, _) => _ = number(&mut sums, *to),
            Step::Loop(_) => return Vec::new(),
            _ => {}
        }
    }
    sums
}

/// The import of the trait by which bodies are called, if these texts call any.
pub fn named(texts: [&str; 3]) -> &'static str {
    match texts.iter().any(|text| text.contains("::compute([")) {
        true => "use __h::Body as _;",
        false => "",
    }
}

impl Writer<'_> {
    /// The loop for core, if it has the form.
    pub(super) fn stretch(&self, inner: &Loop, found: &Accesses) -> Option<Stretch> {
        let program = self.context.program;
        let varies = |variables: Loops| variables.has(inner.domain);
        let mut made = Stretch {
            sums: sums(inner),
            ..Stretch::default()
        };
        if self.context.access != Access::Apart {
            return None;
        }
        for step in &inner.body {
            let Step::Let(value) = step else {
                continue;
            };
            match program.instruction(*value) {
                Instruction::Scalar(_)
                | Instruction::Time
                | Instruction::Coefficient
                | Instruction::Extent(_) => made.given.push(*value),
                Instruction::Variable(domain) if *domain == inner.domain => {
                    made.number = Some(*value);
                }
                Instruction::Variable(_) => made.given.push(*value),
                Instruction::Count(start, end) => {
                    if varies(start.variables() | end.variables()) {
                        return None;
                    }
                    made.given.push(*value);
                }
                Instruction::Load(array, row, column) => {
                    let number = self.context.number(*array, row, column.as_ref());
                    if varies(number.variables()) {
                        let cut = (self.context.read(*array), number);
                        let at = found.cuts.iter().position(|known| *known == cut)?;
                        made.reads.push((*value, at));
                    } else {
                        made.given.push(*value);
                    }
                }
                instruction if instruction.is_number() => {}
                // The arithmetic of a stretch has numbers alone.
                Instruction::External(function, ..) if self.context.is_parameter(*function) => {
                    return None;
                }
                _ => made.computed.push(step.clone()),
            }
            if made.name.is_empty() && !program.instruction(*value).is_number() {
                made.name = format!("__Body{}", value.0);
            }
        }
        if made.reads.is_empty() || made.computed.len() > MAX_VALUES {
            return None;
        }
        // The values from outside the loop that the arithmetic reads.
        for value in scan(self.context, &made.computed, &[]).reads {
            made.takes(program.instruction(value), value)?;
        }
        for step in &inner.body {
            match step {
                Step::Let(_) => continue,
                Step::Loop(_) => return None,
                Step::Accumulate(to, value) => {
                    let sum = number(&mut made.sums, *to);
                    made.takes(program.instruction(*value), *value)?;
                    made.added.push((sum, number(&mut made.results, *value)));
                }
                Step::Store(target, row, column, update) => {
                    let slice = Slice::write(self.context.layout, *target);
                    let at = (found.cuts.iter()).position(|(s, index)| *s == slice && index == row);
                    let place = match at {
                        _ if column.is_some() => return None,
                        Some(at) => (format!("_x{}_{at}", inner.domain.0), None),
                        None => {
                            let first = self.first(row, inner, found)?;
                            (slice.name(), Some(self.within(&slice, first)))
                        }
                    };
                    let column = number(&mut made.columns, place.0);
                    let (change, [a, b]) = match *update {
                        Update::Set(a) => ("Set", [a, a]),
                        Update::Add(a) => ("Add", [a, a]),
                        Update::Sub(a) => ("Sub", [a, a]),
                        Update::AddProduct(a, b) => ("AddProduct", [a, b]),
                        Update::SubProduct(a, b) => ("SubProduct", [a, b]),
                    };
                    for value in [a, b] {
                        made.takes(program.instruction(value), value)?;
                    }
                    let by = [a, b].map(|value| number(&mut made.results, value));
                    made.stores.push(ColumnStore {
                        column,
                        change,
                        by,
                        start: place.1,
                    });
                }
            }
            made.rest.push(step.clone());
        }
        Some(made)
    }

    /// Where the first iteration of a segment finds an element that moves on by one; the columns of
    /// scalar coordinates have no such elements.
    fn first(&self, row: &Index, inner: &Loop, found: &Accesses) -> Option<String> {
        if row.affine.factor(inner.domain) != 1 {
            return None;
        }
        match &row.modulo {
            None => Some(self.context.indices.index(row)),
            Some(_) => found.start_of(inner.domain, row),
        }
    }

    /// Writes what stands before a loop: its arithmetic, and the partial sums of a long one. `length`
    /// and `start` are the extent and the first value of the loop.
    pub(super) fn open(
        &mut self,
        inner: &Loop,
        stretch: Option<&Stretch>,
        [length, start]: [&str; 2],
    ) {
        let d = inner.domain.0;
        if let Some(stretch) = stretch {
            self.body(stretch);
        }
        let sums = match self.context.access == Access::Apart {
            true => sums(inner),
            false => Vec::new(),
        };
        let is_long = match (self.tile == Some(inner.domain), sums.is_empty()) {
            (true, _) => "true".to_owned(),
            (false, true) => {
                let least =
                    stretch.map_or_else(|| "LONG".to_owned(), |stretch| self.least(stretch));
                format!("<T as __h::Real>::WIDENS && {length} >= __h::{least}")
            }
            (false, false) => format!("{length} >= __h::LONG"),
        };
        if sums.is_empty() {
            if stretch.is_some() {
                line!(self, "let _long{d} = {is_long};");
            }
            return;
        }
        line!(self, "let _from{d} = {start};");
        line!(self, "let _long{d} = {is_long};");
        line!(
            self,
            "let mut _sums{d} = [[{ZERO}; __h::STRIDE]; {}];",
            sums.len()
        );
        if stretch.is_none() {
            for (at, sum) in sums.into_iter().enumerate() {
                let place = format!("_sums{d}[{at}][(_i{d} - _from{d}) % __h::STRIDE]");
                self.trees.push((sum, format!("_long{d}"), place));
            }
        }
    }

    /// The least extent from which a loop without sums goes through lanes: core's, from what an iteration computes. A
    /// nest enters a level once for all rows.
    pub(super) fn least(&self, stretch: &Stretch) -> String {
        use Instruction::{Add, Constant, Mul, MulAdd, MulSub, Neg, NegMulAdd, Sub};
        if self.is_nest {
            return "LONG".to_owned();
        }
        let is_sum_or_product = |step: &&Step| match step {
            Step::Let(value) => matches!(
                self.context.program.instruction(*value),
                Constant(..)
                    | Neg(..)
                    | Add(..)
                    | Sub(..)
                    | Mul(..)
                    | MulAdd(..)
                    | MulSub(..)
                    | NegMulAdd(..)
            ),
            _ => false,
        };
        let cheap = stretch.computed.iter().filter(is_sum_or_product).count();
        format!("worth({cheap}, {})", stretch.computed.len() - cheap)
    }

    /// Writes what stands after a loop: long sums are put together.
    pub(super) fn close(&mut self, inner: &Loop) {
        self.trees.clear();
        if self.context.access != Access::Apart {
            return;
        }
        let d = inner.domain.0;
        let totals: Vec<String> = (sums(inner).into_iter().enumerate())
            .map(|(at, sum)| format!("{} += __h::total(&_sums{d}[{at}]);", name(sum)))
            .into_list();
        if !totals.is_empty() {
            line!(self, "if _long{d} {{\n{}\n}}", totals.join("\n"));
        }
    }

    /// Writes the arithmetic of an iteration as a type, if it is not there yet.
    pub(super) fn body(&mut self, stretch: &Stretch) {
        if self.body.as_ref() == Some(&stretch.name) {
            return;
        }
        let (given, reads) = (names(&stretch.given), stretch.read_names());
        line!(self, "struct {};", stretch.name);
        line!(
            self,
            "impl __h::Body<{}> for {} {{",
            stretch.counts(),
            stretch.name
        );
        if stretch.number.is_some() {
            line!(self, "const COUNTS: __h::core::primitive::bool = true;");
        }
        if !stretch.stores.is_empty() {
            line!(self, "const STORES: &'static [__h::ColumnStore] = &[");
            for ColumnStore {
                column,
                change,
                by: [a, b],
                start,
            } in &stretch.stores
            {
                let kind = if start.is_some() { "among" } else { "to" };
                line!(
                    self,
                    "__h::ColumnStore::{kind}({column}, __h::Change::{change}, [{a}, {b}]),"
                );
            }
            line!(self, "];");
        }
        if !stretch.added.is_empty() {
            line!(
                self,
                "const SUMS: &'static [__h::AddedTo] = &{:?};",
                stretch.added
            );
        }
        // As patterns of arguments they would take a line each.
        let pattern = match stretch.given.is_empty() {
            true => "_",
            false => "_given",
        };
        line!(
            self,
            "#[inline(always)]\n\
             fn compute<T: __h::Real>({pattern}: [T; {}], _read: [T; {}], {}: T) -> [T; {}] {{",
            stretch.given.len(),
            stretch.reads.len(),
            stretch.number.map_or("_".to_owned(), name),
            stretch.results.len(),
        );
        if !stretch.given.is_empty() {
            line!(self, "let [{given}] = _given;");
        }
        line!(self, "let [{reads}] = _read;");
        for (other, value) in &stretch.same {
            line!(self, "let {} = {};", name(*other), name(*value));
        }
        self.steps(&stretch.computed);
        let results: Vec<String> = (stretch.results.iter())
            .map(|value| self.operand(*value))
            .into_list();
        line!(self, "[{}]\n}}\n}}", results.join(", "));
    }

    /// Writes the call of core for a segment that begins at `start`, of a long loop. Segments that fill no pack
    /// are left to the loop's own iterations where these are written and have no sums, which are core's.
    pub(super) fn call(&mut self, stretch: &Stretch, inner: &Loop, start: &str, has_own: bool) {
        let d = inner.domain.0;
        match has_own && stretch.sums.is_empty() {
            true => line!(self, "if _long{d} && _l{d} >= __h::STRIDE {{"),
            false => line!(self, "if _long{d} {{"),
        }
        if start != format!("_i{d}") {
            line!(self, "let _i{d} = {start};");
        }
        self.loads(inner, stretch, false);
        self.launch(stretch, inner.domain);
    }

    /// Writes the call of core, after what is given.
    pub(super) fn launch(&mut self, stretch: &Stretch, domain: Domain) {
        let d = domain.0;
        let reads: Vec<String> = (stretch.reads.iter())
            .map(|(_, cut)| format!("_x{d}_{cut}"))
            .into_list();
        let columns: Vec<String> = (stretch.columns.iter())
            .map(|column| format!("&mut {column}[..]"))
            .into_list();
        let offsets: Vec<&str> = (stretch.stores.iter())
            .map(|store| store.start.as_deref().unwrap_or("0usize"))
            .into_list();
        let (first, sums) = match stretch.sums.is_empty() {
            true => ("0usize".to_owned(), "&mut []".to_owned()),
            false => (format!("_i{d} - _from{d}"), format!("&mut _sums{d}")),
        };
        let stretch_text = format!(
            "__h::Stretch {{ length: _l{d}, first: {first}, number: _i{d}, given: [{}], \
             reads: [{}], columns: [{}], offsets: [{}], sums: {sums}, arithmetic: {} }}",
            names(&stretch.given),
            reads.join(", "),
            columns.join(", "),
            offsets.join(", "),
            self.arithmetic,
        );
        match self.is_nest {
            true => line!(
                self,
                "<__M as __h::Mode>::run({stretch_text}, {});",
                stretch.name
            ),
            false => line!(self, "{stretch_text}.run({});", stretch.name),
        }
    }

    /// Writes what is given, and with `all` what is read.
    pub(super) fn loads(&mut self, inner: &Loop, stretch: &Stretch, all: bool) {
        let is_wanted = |step: &&Step| match step {
            Step::Let(value) => {
                let is_read = stretch.reads.iter().any(|(read, _)| read == value);
                stretch.given.contains(value) || all && (is_read || stretch.number == Some(*value))
            }
            _ => false,
        };
        let steps: Vec<Step> = inner.body.iter().filter(is_wanted).cloned().into_list();
        self.steps(&steps);
    }

    /// An iteration by itself: loads, a call of its arithmetic, stores.
    pub(super) fn iteration_of(&mut self, inner: &Loop, stretch: Option<&Stretch>) {
        let Some(stretch) = stretch else {
            return self.iteration(&inner.body);
        };
        self.loads(inner, stretch, true);
        if !stretch.computed.is_empty() {
            let is_computed = |value: &Value| {
                (stretch.computed.iter()).any(|step| matches!(step, Step::Let(v) if v == value))
            };
            let results: Vec<String> = (stretch.results.iter())
                .map(|value| match is_computed(value) {
                    true => name(*value),
                    false => "_".to_owned(),
                })
                .into_list();
            line!(
                self,
                "let [{}] = {}::compute([{}], [{}], {});",
                results.join(", "),
                stretch.name,
                names(&stretch.given),
                stretch.read_names(),
                stretch.number.map_or(ZERO.to_owned(), name),
            );
        }
        self.steps(&stretch.rest);
    }
}

impl Stretch {
    /// Returns true if each element that is written is the iteration's own, and nothing is summed.
    pub(super) fn is_apart(&self) -> bool {
        self.sums.is_empty() && self.stores.iter().all(|store| store.start.is_none())
    }

    /// Adds the iterations of another loop, whose columns run along with the variable of `domain` in the cuts
    /// with the numbers `places`.
    pub(super) fn append(&mut self, other: &Stretch, domain: Domain, places: &[usize]) {
        if self.name.is_empty() {
            self.name = format!("__All{}", other.name.trim_start_matches('_'));
        }
        for value in &other.given {
            number(&mut self.given, *value);
        }
        for (value, cut) in &other.reads {
            let cut = places[*cut];
            match self.reads.iter().find(|(_, known)| *known == cut) {
                Some((known, _)) => self.same.push((*value, *known)),
                None => self.reads.push((*value, cut)),
            }
        }
        match (self.number, other.number) {
            (Some(own), Some(other)) => self.same.push((other, own)),
            (own, other) => self.number = own.or(other),
        }
        self.computed.extend(other.computed.iter().cloned());
        let before = self.results.len();
        self.results.extend(&other.results);
        for store in &other.stores {
            let column = &other.columns[store.column];
            let cut = column.rsplit('_').next().and_then(|at| at.parse().ok());
            let column = cut.map_or(column.clone(), |cut: usize| {
                format!("_x{}_{}", domain.0, places[cut])
            });
            self.stores.push(ColumnStore {
                column: number(&mut self.columns, column),
                by: store.by.map(|by| before + by),
                ..store.clone()
            });
        }
    }

    /// Notes a value that comes from outside the loop. `None` if it is a mask, which has no form over
    /// another scalar.
    fn takes(&mut self, instruction: &Instruction, value: Value) -> Option<()> {
        let is_known = instruction.is_number()
            || self.number == Some(value)
            || self.given.contains(&value)
            || self.reads.iter().any(|(read, _)| *read == value)
            || (self.computed.iter()).any(|step| matches!(step, Step::Let(v) if *v == value));
        if is_known {
            return Some(());
        }
        if instruction.is_mask() {
            return None;
        }
        self.given.push(value);
        Some(())
    }

    fn read_names(&self) -> String {
        let reads: Vec<Value> = self.reads.iter().map(|(value, _)| *value).into_list();
        names(&reads)
    }

    /// The generic arguments of its `Body`.
    fn counts(&self) -> String {
        let (given, reads) = (self.given.len(), self.reads.len());
        format!("{given}, {reads}, {}", self.results.len())
    }
}
