//! Nests of loops that core runs as a whole.
//!
//! Input: outermost loops with long loops inside. Output: a type that implements core's `Nest`, and the call,
//! with all that the loops read and write. Invariant: the level of the CPU is entered once, not for each row.

use super::block::{Writer, names};
use crate::emit::names::layout::{Layout, Slice};
use crate::emit::steps::scan::scan;
use hamiltonian_symbolic::index::Domain;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Instruction, Loop, Step, Target, Value};
use std::fmt::Write;

impl Writer<'_> {
    /// Writes outermost loops, as a nest if possible; in slabs, the rows of one slab.
    pub(super) fn whole(&mut self, loops: &[&Loop], slab: Option<Domain>) {
        let steps: Vec<Step> = loops.iter().map(|l| Step::Loop((*l).clone())).into_list();
        let scan = scan(self.context, &steps, &[]);
        let is_nest = self.is_whole(loops, &scan.reads);
        let known = std::mem::take(self.out);
        let arithmetic = self.arithmetic;
        if is_nest {
            (self.is_nest, self.arithmetic) = (true, "_arithmetic");
        }
        if let Some(slab) = slab {
            for (slice, row) in &self.slabs {
                let _ = writeln!(
                    self.out,
                    "let _b{} = _r{}.start * {row};",
                    slice.name(),
                    slab.0
                );
            }
        }
        self.rows_of(loops, slab);
        let text = std::mem::replace(self.out, known);
        if !is_nest {
            self.out.push_str(&text);
            return;
        }
        (self.is_nest, self.arithmetic) = (false, arithmetic);
        let (written, read): (Vec<Slice>, Vec<Slice>) = scan
            .slices
            .into_iter()
            .partition(|slice| slice.is_written());
        let mut sizes: Vec<String> = (self.context.run_time_sizes())
            .map(|size| format!("_n{size}"))
            .into_list();
        let mut passed = sizes.clone();
        if let Some(slab) = slab {
            let d = slab.0;
            sizes.extend([format!("_from{d}"), format!("_to{d}")]);
            passed.extend([format!("_r{d}.start"), format!("_r{d}.end")]);
        }
        let list = |slices: &[Slice]| {
            let names: Vec<String> = slices.iter().map(|slice| slice.name()).into_list();
            names.join(", ")
        };
        let columns: Vec<String> = (written.iter())
            .map(|slice| format!("&mut {}[..]", slice.name()))
            .into_list();
        let own = format!("__Nest{}", loops[0].domain.0);
        let given = names(&scan.reads);
        let counts = format!(
            "{}, {}, {}, {}",
            scan.reads.len(),
            read.len(),
            written.len(),
            sizes.len()
        );
        line!(
            self,
            "struct {own};\nimpl<T: __h::Real> __h::Nest<T, {counts}> for {own} {{\n\
             #[inline(always)]\n#[allow(unused_variables)]\nfn run<__M: __h::Mode>(_given: [T; {}], \
             _read: [&[T]; {}], _written: [&mut [T]; {}], _sizes: [__h::usize; {}], \
             _arithmetic: __h::Arithmetic) {{\nlet [{given}] = _given;\nlet [{}] = _read;\n\
             let [{}] = _written;\nlet [{}] = _sizes;",
            scan.reads.len(),
            read.len(),
            written.len(),
            sizes.len(),
            list(&read),
            list(&written),
            sizes.join(", "),
        );
        if let Some(slab) = slab {
            let d = slab.0;
            line!(self, "let _r{d} = _from{d}.._to{d};");
        }
        self.out.push_str(&text);
        line!(
            self,
            "}}\n}}\n__h::nest({own}, {}, [{given}], [{}], [{}], [{}], {});",
            self.is_long(loops),
            list(&read),
            columns.join(", "),
            passed.join(", "),
            self.arithmetic,
        );
    }

    /// Returns true if the loops contain loops, and everything that they read can be passed to a `Nest`.
    fn is_whole(&self, loops: &[&Loop], reads: &[Value]) -> bool {
        let program = self.context.program;
        let is_mask = |value: &Value| program.instruction(*value).is_mask();
        self.has_threads()
            && self.context.layout != Layout::Scalars
            && self.context.generics.is_run_time.iter().all(|is| *is)
            && !reads.iter().any(is_mask)
            && loops.iter().all(|outer| outer.accumulators.is_empty())
            && loops.iter().all(|outer| self.fits(&outer.body))
            && (loops.iter())
                .any(|outer| outer.body.iter().any(|step| matches!(step, Step::Loop(_))))
    }

    /// Returns true if the steps store to coordinates and momenta only, and read no scalar parameter, time or
    /// coefficient.
    fn fits(&self, steps: &[Step]) -> bool {
        steps.iter().all(|step| match step {
            Step::Let(value) => match self.context.program.instruction(*value) {
                Instruction::Scalar(_) | Instruction::Time | Instruction::Coefficient => false,
                Instruction::External(function, ..) => !self.context.is_parameter(*function),
                _ => true,
            },
            Step::Store(target, ..) => matches!(target, Target::Phase(_)),
            Step::Accumulate(..) => true,
            Step::Loop(inner) => self.fits(&inner.body),
        })
    }

    /// The condition under which an inner loop is long enough for lanes; `true` if its length varies with the row.
    fn is_long(&self, loops: &[&Loop]) -> String {
        let mut ends = Vec::new();
        let mut ahead: Vec<&Loop> = loops.to_vec();
        while let Some(outer) = ahead.pop() {
            let inside: Vec<&Loop> = (outer.body.iter())
                .filter_map(|step| match step {
                    Step::Loop(inner) => Some(inner),
                    _ => None,
                })
                .into_list();
            if inside.is_empty() {
                if !outer.end.variables().is_empty() {
                    return "true".to_owned();
                }
                let end = self.context.indices.saturating(&outer.end);
                let is_long = format!("{end} >= __h::LONG");
                if !ends.contains(&is_long) {
                    ends.push(is_long);
                }
            }
            ahead.extend(inside);
        }
        ends.join(" || ")
    }
}
