//! Innermost loops that core runs: their arithmetic, the elements it reads, its stores and sums.
//!
//! Input: a loop with the columns that run along with it. Output: [`Stretch`], a type that implements
//! core's `Body`, and a `Loop` of core. Invariant: every element that is reached moves on by one with the loop
//! variable, in its ring if its index wraps, or does not move; what an iteration computes is a function over any scalar.

use super::block::{Writer, name, names};
use crate::emit::names::context::{Access, ZERO};
use crate::emit::names::index::variable;
use crate::emit::names::layout::Slice;
use crate::emit::steps::accesses::Accesses;
use crate::emit::steps::scan::scan;
use hamiltonian_symbolic::index::{Affine, Domain, Index, Loops};
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
    /// The values that are read, and their places.
    reads: Vec<(Value, Place)>,
    /// Reads of elements that a store changes later, each with the store.
    own: Vec<(usize, usize)>,
    /// The loop variable as a real.
    number: Option<Value>,
    /// Values that others are names of, in the arithmetic of several loops.
    same: Vec<(Value, Value)>,
    /// The steps of the arithmetic.
    computed: Vec<Step>,
    /// The results of the arithmetic.
    results: Vec<Value>,
    /// The columns that are written.
    columns: Vec<Slice>,
    stores: Vec<ColumnStore>,
    /// Sums that are added to.
    sums: Vec<Value>,
    /// The number of a sum and that of a result added to it, in order.
    added: Vec<(usize, usize)>,
}

/// An element that moves on by one with the loop variable.
type Place = (Slice, Index);

/// The place in a ring, and its extent.
type Ring = (Affine, Affine);

/// A store of an iteration.
#[derive(Clone)]
struct ColumnStore {
    column: usize,
    change: &'static str,
    by: [usize; 2],
    index: Index,
    /// True if another store may reach other elements of the column.
    is_shared: bool,
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

impl Writer<'_> {
    /// The loop for core, if it has the form.
    pub(super) fn stretch(&self, inner: &Loop, found: &Accesses) -> Option<Stretch> {
        let program = self.context.program;
        let varies = |variables: Loops| variables.has(inner.domain);
        let mut made = Stretch {
            sums: sums(inner),
            ..Stretch::default()
        };
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
                        if !found.cuts.contains(&cut) {
                            return None;
                        }
                        made.reads.push((*value, cut));
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
                    let place = (slice, row.clone());
                    let is_shared = !found.cuts.contains(&place);
                    if column.is_some() || is_shared && !moves_on(row, inner.domain) {
                        return None;
                    }
                    let column = number(&mut made.columns, slice);
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
                        index: place.1,
                        is_shared,
                    });
                }
            }
        }
        if self.context.access != Access::Apart {
            made.own = self.own(inner, &made)?;
        }
        Some(made)
    }

    /// The reads of elements that an iteration changes later, if inputs and outputs are the same vectors. `None` if it
    /// reads what another one changes, or what it has changed itself.
    fn own(&self, inner: &Loop, stretch: &Stretch) -> Option<Vec<(usize, usize)>> {
        let store_of = |slice: &Slice| {
            (stretch.stores.iter()).position(|store| stretch.columns[store.column] == *slice)
        };
        // Its sums are added to in order, whatever their length.
        if !stretch.sums.is_empty() || stretch.stores.iter().any(|store| store.is_shared) {
            return None;
        }
        let mut stored = Vec::new();
        for step in &inner.body {
            match step {
                Step::Store(target, ..) => {
                    stored.push(Slice::write(self.context.layout, *target));
                }
                Step::Let(value) => {
                    if let Instruction::Load(array, ..) = self.context.program.instruction(*value) {
                        let slice = self.context.read(*array);
                        let is_given = stretch.given.contains(value);
                        if stored.contains(&slice) || is_given && store_of(&slice).is_some() {
                            return None;
                        }
                    }
                }
                _ => {}
            }
        }
        let mut own = Vec::new();
        for (read, (_, (slice, index))) in stretch.reads.iter().enumerate() {
            if let Some(store) = store_of(slice) {
                if stretch.stores[store].index != *index {
                    return None;
                }
                own.push((read, store));
            }
        }
        Some(own)
    }

    /// Writes what stands before a loop that is not core's: the partial sums of a long one. `length` and `start` are
    /// its extent and its first value.
    pub(super) fn open(&mut self, inner: &Loop, [length, start]: [&str; 2]) {
        let sums = self.partial(inner);
        if sums.is_empty() {
            return;
        }
        let d = inner.domain.0;
        line!(self, "let _from{d} = {start};");
        line!(self, "let _long{d} = {length} >= __h::LONG;");
        line!(
            self,
            "let mut _sums{d} = [[{ZERO}; __h::STRIDE]; {}];",
            sums.len()
        );
        for (at, sum) in sums.into_iter().enumerate() {
            let place = format!("_sums{d}[{at}][(_i{d} - _from{d}) % __h::STRIDE]");
            self.trees.push((sum, format!("_long{d}"), place));
        }
    }

    /// The sums of a loop that are partial ones where it is long.
    fn partial(&self, inner: &Loop) -> Vec<Value> {
        match self.context.access == Access::Apart {
            true => sums(inner),
            false => Vec::new(),
        }
    }

    /// The least extent from which a loop without sums goes through lanes: core's, from what an iteration computes.
    fn least(&self, stretch: &Stretch) -> String {
        use Instruction::{Add, Constant, Mul, MulAdd, MulSub, Neg, NegMulAdd, Sub};
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
        format!("__h::worth({cheap}, {})", stretch.computed.len() - cheap)
    }

    /// Writes what stands after a loop: long sums are put together.
    pub(super) fn close(&mut self, inner: &Loop) {
        self.trees.clear();
        let d = inner.domain.0;
        let totals: Vec<String> = (self.partial(inner).into_iter().enumerate())
            .map(|(at, sum)| format!("{} += __h::total(&_sums{d}[{at}]);", name(sum)))
            .into_list();
        if !totals.is_empty() {
            line!(self, "if _long{d} {{\n{}\n}}", totals.join("\n"));
        }
    }

    /// Writes the arithmetic of an iteration as a type, if it is not there yet.
    pub(super) fn body(&mut self, stretch: &Stretch, domain: Domain) {
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
        if stretch.added.is_empty() {
            line!(self, "const LEAST: __h::usize = {};", self.least(stretch));
        }
        let elements = stretch.reads.iter().enumerate();
        let rings =
            elements.filter_map(|(at, (_, (_, index)))| Some((at, stretch.ring(index, domain)?)));
        let rings: Vec<(usize, usize)> = rings.into_list();
        if !rings.is_empty() {
            line!(self, "const RINGS: &'static [__h::InRing] = &{rings:?};");
        }
        if !stretch.own.is_empty() {
            line!(
                self,
                "const OWN: &'static [__h::OfStore] = &{:?};",
                stretch.own
            );
        }
        if !stretch.stores.is_empty() {
            line!(self, "const STORES: &'static [__h::ColumnStore] = &[");
            for ColumnStore {
                column,
                change,
                by: [a, b],
                index,
                is_shared,
            } in &stretch.stores
            {
                let kind = if *is_shared { "among" } else { "to" };
                let ring = (stretch.ring(index, domain)).map(|ring| format!(".in_ring({ring})"));
                line!(
                    self,
                    "__h::ColumnStore::{kind}({column}, __h::Change::{change}, [{a}, {b}]){},",
                    ring.unwrap_or_default()
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

    /// Writes a loop that core runs: its arithmetic, and the call.
    pub(super) fn run(&mut self, inner: &Loop, stretch: &Stretch, [start, end]: [&str; 2]) {
        self.body(stretch, inner.domain);
        let length = match start {
            "0usize" => end.to_owned(),
            _ => format!("({end}).saturating_sub({start})"),
        };
        let is_tile = self.tile == Some(inner.domain);
        let method = if is_tile { "run_long" } else { "run" };
        // Values of elements that an empty loop does not have.
        let is_guarded = !is_tile && self.reaches(inner, stretch);
        let are_own = !is_guarded && stretch.sums == inner.accumulators;
        if !are_own {
            for sum in &inner.accumulators {
                line!(self, "let mut {} = {ZERO};", name(*sum));
            }
        }
        if is_guarded {
            line!(self, "if {start} < {end} {{");
        }
        self.loads(inner, stretch);
        let sums = match (stretch.sums.is_empty(), are_own) {
            (true, _) => String::new(),
            (false, true) => format!("let [{}] = ", names(&stretch.sums)),
            (false, false) => format!("[{}] = ", names(&stretch.sums)),
        };
        self.call(stretch, inner.domain, [start, &length], &sums, method);
        if is_guarded {
            line!(self, "}}");
        }
    }

    /// Returns true if what stands before the iterations is there only if there is one.
    fn reaches(&self, inner: &Loop, stretch: &Stretch) -> bool {
        let loads = |step: &Step| match step {
            Step::Let(value) => {
                let instruction = self.context.program.instruction(*value);
                stretch.given.contains(value) && matches!(instruction, Instruction::Load(..))
            }
            _ => false,
        };
        let places = (stretch.reads.iter().map(|(_, place)| place.clone())).chain(
            stretch
                .stores
                .iter()
                .map(|store| (stretch.columns[store.column], store.index.clone())),
        );
        inner.body.iter().any(loads)
            || places
                .into_list()
                .iter()
                .any(|place| self.first(place, inner.domain).contains(" - "))
    }

    /// Where the first iteration finds an element; of a ring, where its first element is.
    fn first(&self, (slice, index): &Place, domain: Domain) -> String {
        let number = match ring_of(index, domain) {
            Some(_) => self.context.indices.in_row(index, "0usize"),
            None => self.index(index),
        };
        self.within(slice, number)
    }

    /// Writes the call of core for `length` iterations from `start` on, whose sums go to the pattern `sums`.
    pub(super) fn call(
        &mut self,
        stretch: &Stretch,
        domain: Domain,
        [start, length]: [&str; 2],
        sums: &str,
        method: &str,
    ) {
        let variable = variable(domain);
        let rings = stretch
            .rings(domain)
            .iter()
            .map(|(affine, modulo)| {
                let [first, extent] = [
                    self.context.indices.wrapped(affine, modulo),
                    self.context.indices.modulus(modulo),
                ];
                format!("[{first}, {extent}]")
            })
            .into_list();
        let is_bound = start == variable;
        let of = |place: &Place| match self.first(place, domain) {
            text if text == variable => start.to_owned(),
            text => text,
        };
        let reads = stretch
            .reads
            .iter()
            .enumerate()
            .map(|(at, (_, place))| {
                let is_own = stretch.own.iter().any(|(read, _)| *read == at);
                match (is_own, self.context.access) {
                    (true, _) => "(&[], 0usize)".to_owned(),
                    (false, Access::Apart) => format!("({}, {})", place.0.name(), of(place)),
                    (false, _) => format!("(&{}[..], {})", place.0.name(), of(place)),
                }
            })
            .into_list();
        let offsets = stretch
            .stores
            .iter()
            .map(|store| of(&(stretch.columns[store.column], store.index.clone())))
            .into_list();
        let columns: Vec<String> = (stretch.columns.iter())
            .map(|column| format!("&mut {}[..]", column.name()))
            .into_list();
        let before = match sums.is_empty() || sums.starts_with("let") {
            true => format!("[{ZERO}; {}]", stretch.sums.len()),
            false => format!("[{}]", names(&stretch.sums)),
        };
        let text = format!(
            "__h::Loop {{ length: {length}, number: {start}, given: [{}], reads: [{}], columns: [{}], offsets: [{}], \
             rings: [{}], sums: {before}, arithmetic: {} }}",
            names(&stretch.given),
            reads.join(", "),
            columns.join(", "),
            offsets.join(", "),
            rings.join(", "),
            self.arithmetic,
        );
        if !is_bound && text.contains(&variable) {
            line!(self, "let {variable} = {start};");
        }
        match self.is_nest && method == "run" {
            true => line!(
                self,
                "{sums}<__M as __h::Mode>::run_all({text}, {});",
                stretch.name
            ),
            false => line!(self, "{sums}{text}.{method}({});", stretch.name),
        }
    }

    /// Writes what is given.
    pub(super) fn loads(&mut self, inner: &Loop, stretch: &Stretch) {
        let is_given =
            |step: &&Step| matches!(step, Step::Let(value) if stretch.given.contains(value));
        let steps: Vec<Step> = inner.body.iter().filter(is_given).cloned().into_list();
        self.steps(&steps);
    }
}

/// Returns true if an element moves on by one with the loop variable.
fn moves_on(index: &Index, domain: Domain) -> bool {
    index.affine.factor(domain) == 1
}

/// The place in its ring of an element that wraps with the loop variable, and the ring's extent.
fn ring_of(index: &Index, domain: Domain) -> Option<Ring> {
    let modulo = index.modulo.as_ref()?;
    moves_on(index, domain).then(|| (index.affine.clone(), modulo.clone()))
}

impl Stretch {
    /// Returns true if each element that is written is the iteration's own, and nothing is summed.
    pub(super) fn is_apart(&self) -> bool {
        self.sums.is_empty() && self.stores.iter().all(|store| !store.is_shared)
    }

    /// Adds the iterations of another loop, whose places are those of `moved`.
    pub(super) fn append(&mut self, other: &Stretch, moved: impl Fn(&Index) -> Index) {
        if self.name.is_empty() {
            self.name = format!("__All{}", other.name.trim_start_matches('_'));
        }
        for value in &other.given {
            number(&mut self.given, *value);
        }
        for (value, (slice, index)) in &other.reads {
            let place = (*slice, moved(index));
            match self.reads.iter().find(|(_, known)| *known == place) {
                Some((known, _)) => self.same.push((*value, *known)),
                None => self.reads.push((*value, place)),
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
            self.stores.push(ColumnStore {
                column: number(&mut self.columns, other.columns[store.column]),
                by: store.by.map(|by| before + by),
                index: moved(&store.index),
                ..store.clone()
            });
        }
    }

    /// The rings that its elements move in.
    fn rings(&self, domain: Domain) -> Vec<Ring> {
        let mut all = Vec::new();
        let reads = self.reads.iter().map(|(_, (_, index))| index);
        for index in reads.chain(self.stores.iter().map(|store| &store.index)) {
            if let Some(ring) = ring_of(index, domain) {
                number(&mut all, ring);
            }
        }
        all
    }

    /// The number of the ring of an element, if it wraps.
    fn ring(&self, index: &Index, domain: Domain) -> Option<usize> {
        let own = ring_of(index, domain)?;
        self.rings(domain).iter().position(|ring| *ring == own)
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
    pub(super) fn counts(&self) -> String {
        let (given, reads) = (self.given.len(), self.reads.len());
        format!("{given}, {reads}, {}", self.results.len())
    }
}
