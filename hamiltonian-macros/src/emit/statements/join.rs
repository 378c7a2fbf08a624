//! Fusion of successive loops over parts of one lattice.
//!
//! Input: successive loops, for example over all sites, over the sites with a left neighbour, and over the sites
//! with a right one. Output: one loop over the common range, and the remaining iterations of each loop before and after.
//! Invariant: an iteration changes elements of its own site alone, so each element is changed in the order of
//! the loops.

use super::block::Writer;
use super::stretch::Stretch;
use crate::emit::names::context::Access;
use crate::emit::names::index::variable;
use crate::emit::names::layout::Layout;
use crate::emit::steps::accesses::Accesses;
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::program::{Loop, Step, Target};
use std::fmt::Write;

/// A loop, and the name of the flag that is true if the loop is executed.
type GuardedLoop<'a> = (&'a Loop, Option<String>);

impl Writer<'_> {
    /// Returns how many of the loops, from the first on, can be fused; 0 for fewer than two.
    pub(super) fn joint(&self, loops: &[&Loop]) -> usize {
        if self.context.access != Access::Apart || self.context.layout == Layout::Scalars {
            return 0;
        }
        let Some(depth) = loops
            .first()
            .and_then(|first| self.depth(first, &mut vec![]))
        else {
            return 0;
        };
        let mut count = loops.len();
        for (at, next) in loops.iter().enumerate() {
            let is_known = loops[..at].iter().any(|l| l.domain == next.domain);
            if is_known || self.depth(next, &mut vec![]) != Some(depth) {
                count = at;
                break;
            }
        }
        let all: Vec<&Loop> = innermost(&loops[..count]);
        let values: usize = all.iter().map(|inner| inner.body.len()).sum();
        if count < 2 || values > super::stretch::MAX_VALUES {
            return 0;
        }
        count
    }

    /// Returns the depth of a nest of loops. `None` if the nest does anything but change elements of the site whose
    /// indices are the loop variables.
    fn depth(&self, outer: &Loop, around: &mut Vec<Domain>) -> Option<usize> {
        if !outer.accumulators.is_empty() {
            return None;
        }
        around.push(outer.domain);
        let has_loops = outer.body.iter().any(|step| matches!(step, Step::Loop(_)));
        let mut depth = None;
        for step in &outer.body {
            match step {
                Step::Loop(inner) => {
                    let inside = self.depth(inner, around)?;
                    if *depth.get_or_insert(inside) != inside {
                        return None;
                    }
                }
                Step::Store(Target::Phase(_), row, None, _) => {
                    let own = |(axis, domain): (Index, &Domain)| {
                        axis == Index::plain(Affine::variable(*domain))
                    };
                    let axes = row.axes();
                    let is_own =
                        axes.len() == around.len() && axes.into_iter().zip(around.iter()).all(own);
                    if has_loops || !is_own {
                        return None;
                    }
                }
                Step::Let(_) if !has_loops => {}
                _ => return None,
            }
        }
        around.pop();
        if !has_loops {
            let found = Accesses::of(self.context, outer);
            let stretch = self.stretch(outer, &found)?;
            return (!found.wraps() && stretch.is_apart()).then_some(1);
        }
        depth.map(|inside| inside + 1)
    }

    /// Writes fused loops; for outermost loops in slabs, the rows of one slab.
    pub(super) fn join(&mut self, loops: &[GuardedLoop], slab: Option<Domain>) {
        let known = self.same.len();
        let first = loops[0].0.domain;
        self.same
            .extend(loops.iter().map(|(inner, _)| (inner.domain, first)));
        for (inner, is_there) in loops {
            let d = inner.domain.0;
            let start = self.context.indices.start(&inner.start);
            let end = self.context.indices.saturating(&inner.end);
            match is_there {
                Some(flag) => line!(
                    self,
                    "let (_s{d}, _e{d}) = if {flag} {{ ({start}, {end}) }} else {{ (0usize, 0usize) }};"
                ),
                None => line!(self, "let (_s{d}, _e{d}) = ({start}, {end});"),
            }
        }
        if loops[0]
            .0
            .body
            .iter()
            .any(|step| matches!(step, Step::Loop(_)))
        {
            self.outer(loops, slab);
        } else {
            self.inner(loops);
        }
        self.same.truncate(known);
    }

    /// Writes fused loops that contain loops.
    fn outer(&mut self, loops: &[GuardedLoop], slab: Option<Domain>) {
        let d = loops[0].0.domain.0;
        match slab {
            Some(slab) => line!(self, "for _o{d} in _r{} {{", slab.0),
            None => line!(
                self,
                "for _o{d} in {}..{} {{",
                of_all(loops, 's', "min"),
                of_all(loops, 'e', "max")
            ),
        }
        let mut inside = Vec::new();
        for (outer, _) in loops {
            let own = outer.domain.0;
            line!(
                self,
                "let ({}, _in{own}) = (_o{d}, _s{own} <= _o{d} && _o{d} < _e{own});",
                variable(outer.domain)
            );
            for step in &outer.body {
                if let Step::Loop(inner) = step {
                    inside.push((inner, Some(format!("_in{own}"))));
                }
            }
        }
        self.join(&inside, None);
        line!(self, "}}");
    }

    /// Writes fused innermost loops: the common range in lanes, the other iterations one by one.
    fn inner(&mut self, loops: &[GuardedLoop]) {
        let domain = loops[0].0.domain;
        let d = domain.0;
        let mut joint = Stretch::default();
        let mut parts = Vec::with_capacity(loops.len());
        for (inner, _) in loops {
            let found = Accesses::of(self.context, inner);
            let Some(stretch) = self.stretch(inner, &found) else {
                unreachable!("a loop that is joined has been seen as a stretch");
            };
            self.body(&stretch, inner.domain);
            joint.append(&stretch, |index| index.substitute(|d| self.same(d)));
            parts.push((*inner, stretch));
        }
        self.body(&joint, domain);
        line!(
            self,
            "let (_lo{d}, _hi{d}) = ({}, {});",
            of_all(loops, 's', "max"),
            of_all(loops, 'e', "min")
        );
        let least = match self.is_nest {
            true => "__h::LONG".to_owned(),
            false => format!("<{} as __h::Body<{}>>::LEAST", joint.name, joint.counts()),
        };
        line!(
            self,
            "let _long{d} = <T as __h::Real>::WIDENS && _hi{d}.saturating_sub(_lo{d}) >= {least};"
        );
        line!(self, "if _long{d} {{");
        for (inner, _) in &parts {
            line!(self, "let {} = _lo{d};", variable(inner.domain));
        }
        for (inner, stretch) in &parts {
            self.loads(inner, stretch);
        }
        let [start, length] = [variable(domain), format!("_hi{d} - _lo{d}")];
        self.call(&joint, domain, [&start, &length], "", "run");
        line!(self, "}}");
        for (inner, stretch) in &parts {
            let own = inner.domain.0;
            line!(
                self,
                "for [_i{own}, _e{own}] in if _long{d} {{ [[_s{own}, _lo{d}], [_hi{d}, _e{own}]] }} \
                 else {{ [[0usize, 0usize], [_s{own}, _e{own}]] }} {{"
            );
            line!(self, "if _i{own} < _e{own} {{");
            self.loads(inner, stretch);
            let [start, length] = [variable(inner.domain), format!("_e{own} - _i{own}")];
            self.call(stretch, inner.domain, [&start, &length], "", "run_short");
            line!(self, "}}\n}}");
        }
    }

    /// Returns the variable of the first of the fused loops.
    fn same(&self, domain: Domain) -> Affine {
        let known = self.same.iter().find(|(own, _)| *own == domain);
        Affine::variable(known.map_or(domain, |(_, first)| *first))
    }
}

/// The expression of the least or the largest of several bounds.
fn of_all(loops: &[GuardedLoop], end: char, which: &str) -> String {
    let (first, others) = (loops[0].0.domain.0, &loops[1..]);
    others
        .iter()
        .fold(format!("_{end}{first}"), |text, (inner, _)| {
            format!("{text}.{which}(_{end}{})", inner.domain.0)
        })
}

/// Returns the innermost loops of several nests.
fn innermost<'a>(loops: &[&'a Loop]) -> Vec<&'a Loop> {
    let mut all = Vec::new();
    for outer in loops {
        let inside: Vec<&Loop> = (outer.body.iter())
            .filter_map(|step| match step {
                Step::Loop(inner) => Some(inner),
                _ => None,
            })
            .into_list();
        match inside.is_empty() {
            true => all.push(*outer),
            false => all.extend(innermost(&inside)),
        }
    }
    all
}
