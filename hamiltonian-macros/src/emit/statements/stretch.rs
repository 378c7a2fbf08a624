//! Innermost loops that core runs: their arithmetic, the elements it reads, its stores and sums.
//!
//! Input: a loop with the columns that run along with it. Output: [`Stretch`], the loop as data. Invariant: every element that is reached moves on by one with the loop
//! variable, in its ring if its index wraps, or does not move; what an iteration computes is a function over any scalar.

use super::block::{Writer, names};
use crate::emit::names::context::Access;
use crate::emit::names::layout::Slice;
use crate::emit::steps::accesses::Accesses;
use crate::emit::steps::scan::scan;
use hamiltonian_symbolic::index::{Affine, Domain, Index, Loops};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Update, Value};

/// The most values that an iteration in lanes computes.
pub(super) const MAX_VALUES: usize = 300;

/// A loop whose iterations core runs.
#[derive(Default)]
pub(super) struct Stretch {
    /// The type of its arithmetic.
    pub(super) name: String,
    /// What does not vary: its instructions are steps of the loop's body, or values from outside.
    pub(super) given: Vec<Value>,
    /// The values that are read, and their places.
    pub(super) reads: Vec<(Value, Place)>,
    /// Reads of elements that a store changes later, each with the store.
    pub(super) own: Vec<(usize, usize)>,
    /// The loop variable as a real.
    pub(super) number: Option<Value>,
    /// Values that others are names of, in the arithmetic of several loops.
    pub(super) same: Vec<(Value, Value)>,
    /// The steps of the arithmetic.
    pub(super) computed: Vec<Step>,
    /// The results of the arithmetic.
    pub(super) results: Vec<Value>,
    /// The columns that are written.
    pub(super) columns: Vec<Slice>,
    pub(super) stores: Vec<ColumnStore>,
    /// Sums that are added to.
    pub(super) sums: Vec<Value>,
    /// The number of a sum and that of a result added to it, in order.
    pub(super) added: Vec<(usize, usize)>,
}

/// An element that moves on by one with the loop variable.
pub(super) type Place = (Slice, Index);

/// The place in a ring, and its extent.
pub(super) type Ring = (Affine, Affine);

/// A store of an iteration.
#[derive(Clone)]
pub(super) struct ColumnStore {
    pub(super) column: usize,
    pub(super) change: &'static str,
    pub(super) by: [usize; 2],
    pub(super) index: Index,
    /// True if another store may reach other elements of the column.
    pub(super) is_shared: bool,
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
pub(super) fn sums(inner: &Loop) -> Vec<Value> {
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
}

/// Returns true if an element moves on by one with the loop variable.
fn moves_on(index: &Index, domain: Domain) -> bool {
    index.affine.factor(domain) == 1
}

/// The place in its ring of an element that wraps with the loop variable, and the ring's extent.
pub(super) fn ring_of(index: &Index, domain: Domain) -> Option<Ring> {
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
    pub(super) fn rings(&self, domain: Domain) -> Vec<Ring> {
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
    pub(super) fn ring(&self, index: &Index, domain: Domain) -> Option<usize> {
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

    pub(super) fn read_names(&self) -> String {
        let reads: Vec<Value> = self.reads.iter().map(|(value, _)| *value).into_list();
        names(&reads)
    }

    /// The generic arguments of its `Body`.
    pub(super) fn counts(&self) -> String {
        let (given, reads) = (self.given.len(), self.reads.len());
        format!("{given}, {reads}, {}", self.results.len())
    }
}
