//! The text of innermost loops: the type of their arithmetic, and the call of core.
//!
//! Input: a loop as data ([`Stretch`]). Output: a type that implements core's `Body`, and a `Loop` of core; what stands
//! before and after a loop that core does not run. Invariant: the tables are those of the loop, in its order.

use super::block::{Writer, name, names};
use super::stretch::{ColumnStore, Place, Stretch, ring_of, sums};
use crate::emit::names::context::{Access, ZERO};
use crate::emit::names::index::variable;
use hamiltonian_symbolic::index::Domain;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Value};
use std::fmt::Write;

impl Writer<'_> {
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
