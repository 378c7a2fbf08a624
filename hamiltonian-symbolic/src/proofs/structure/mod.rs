//! The structure of a Hamiltonian: separable or not, quadratic in its momenta, autonomous,
//! cyclic coordinates.
//!
//! Input: a model with its H. Output: [`Structure`], each negative answer with the part of H that
//! is the reason, in the user's notation. Invariant: a positive answer is proven; parts of a split
//! keep the grouping of the source wherever the source already separates term by term.

mod components;
mod expand;
mod growth;
mod quadratic;
mod separate;

pub(crate) use components::components;
pub use expand::expand;
pub(crate) use expand::{Collected, expand_within};
pub use growth::growth;
pub(crate) use quadratic::degrees;
pub use quadratic::kick_beside;

use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Side};
use crate::index::Affine;
use crate::list::IntoList;
use crate::model::Model;
use crate::print;
use std::collections::HashSet;
use std::fmt;

/// H = T(p, t) + V(q, t).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Separation {
    /// T: everything that depends on momenta.
    pub kinetic: Node,
    /// V: everything else, terms of time and parameters alone included.
    pub potential: Node,
    /// True if H separates without being multiplied out.
    pub as_written: bool,
}

/// Why H is not separable.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Coupling {
    /// The first term of H, multiplied out, that depends on coordinates and momenta.
    pub term: Node,
    /// The term as text.
    pub text: String,
    /// The limit that left it undecided if the term cancels, as a clause.
    pub limit: Option<String>,
}

impl fmt::Display for Coupling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = &self.text;
        match &self.limit {
            None => write!(f, "the term `{text}` couples coordinates and momenta"),
            Some(limit) => write!(
                f,
                "nothing shows that the term `{text}` cancels in the sum of the coupling terms: {limit}"
            ),
        }
    }
}

/// A coordinate that H does not depend on: its momentum is conserved.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Cyclic {
    /// The coordinate as text: `phi`, `q[2]`, `q[i][0]` for all i.
    pub coordinate: String,
    /// Its momentum as text.
    pub momentum: String,
}

/// The structure of a Hamiltonian.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Structure {
    /// T and V, or the first coupling term.
    pub separable: Result<Separation, Coupling>,
    /// `Ok` if T = ½pᵀM⁻¹p with M of parameters only; otherwise the reason, a sentence without a
    /// full stop.
    pub quadratic_kinetic: Result<(), String>,
    /// `Ok` if H does not depend on time; otherwise the reason.
    pub autonomous: Result<(), String>,
    /// Coordinates H does not depend on.
    pub cyclic: Vec<Cyclic>,
    /// See [`growth`].
    pub growth: Option<u32>,
}

/// The structure of the model's H (0 where there is none).
pub fn analyse(model: &mut Model) -> Structure {
    let h = model.h();
    let separable = separate::split(model, h);
    let quadratic_kinetic = match &separable {
        Ok(split) => quadratic::form(model, split.kinetic),
        Err(coupling) => Err(format!("H is not separable: {coupling}")),
    };
    Structure {
        separable,
        quadratic_kinetic,
        autonomous: is_autonomous(model, h),
        cyclic: cyclic(model, h),
        growth: growth(&model.dag, h),
    }
}

fn is_autonomous(model: &Model, h: Node) -> Result<(), String> {
    let mut forces = model.force.iter().map(|entry| entry.value);
    if let Some(force) = forces.find(|f| model.dag.dependence(*f).on(Dependence::TIME)) {
        let time = model.time_name();
        return Err(format!(
            "the force `{}` depends on `{time}`",
            print::text(model, force)
        ));
    }
    match term_with(&model.dag, h, |dag, node| {
        dag.dependence(node).on(Dependence::TIME)
    }) {
        None => Ok(()),
        Some(term) => {
            let time = model.time_name();
            Err(format!(
                "the term `{}` depends on `{time}`",
                print::text(model, term)
            ))
        }
    }
}

/// The first term of a node with a property, down through sums, loops, and products and conditions
/// of which one part has it.
fn term_with(dag: &Dag, root: Node, has: impl Fn(&Dag, Node) -> bool) -> Option<Node> {
    if !has(dag, root) {
        return None;
    }
    let mut at = root;
    loop {
        let is_sum = |node: Node| matches!(dag.kind(node), Kind::Sum(..) | Kind::Reduce(..));
        let part = match dag.kind(at) {
            Kind::Sum(_, terms) => terms.iter().map(|(_, n)| *n).find(|n| has(dag, *n)),
            Kind::Reduce(_, body) => Some(*body),
            Kind::Select(condition, then, otherwise) if !has(dag, *condition) => {
                [*then, *otherwise].into_iter().find(|n| has(dag, *n))
            }
            Kind::Product(_, factors) => {
                let mut having = factors.iter().filter(|(n, _)| has(dag, *n));
                match (having.next(), having.next()) {
                    (Some((factor, 1)), None) if is_sum(*factor) => Some(*factor),
                    _ => None,
                }
            }
            _ => None,
        };
        match part {
            Some(part) => at = part,
            None => return Some(at),
        }
    }
}

/// The coordinates that do not occur in H.
fn cyclic(model: &Model, h: Node) -> Vec<Cyclic> {
    let mut read: Map<Column, Vec<Option<i64>>> = Map::default();
    for node in model.dag.reachable(&[h]) {
        if let Some((column, row)) = model.dag.phase_place(node)
            && column.side == Side::Q
        {
            read.entry(column).or_default().push(row.as_constant());
        }
    }
    // Under a force a momentum is not conserved, whatever H looks at.
    for entry in &model.force {
        if !model.dag.is_zero(entry.value) {
            let rows = read.entry(entry.at.on(Side::Q)).or_default();
            rows.push(entry.row.as_constant());
        }
    }
    let mut found = Vec::new();
    for (at, rows) in model.columns(Side::Q) {
        let group = &model.groups[usize::from(at.group)];
        let element = |index: &str| Cyclic {
            coordinate: group.shape.element(&group.coordinate, index, at.column),
            momentum: group.shape.element(&group.momentum, index, at.column),
        };
        let literal = |extent: &Affine| extent.as_constant().unwrap_or(1);
        let numbered = |row: i64| {
            let [coordinate, momentum] = [at, at.conjugate()].map(|at| {
                let place = [row, i64::from(at.column)];
                model.element(group.name(at.side), Array::Phase(at), place, literal)
            });
            Cyclic {
                coordinate,
                momentum,
            }
        };
        let used: Option<HashSet<i64>> = match read.get(&at) {
            None => {
                // `i`, or `i][j` between the brackets.
                let names = ["i", "j", "k"].into_iter().chain(std::iter::repeat("l"));
                let names: Vec<&str> = names.take(group.shape.axes().len().max(1)).into_list();
                found.push(element(&names.join("][")));
                continue;
            }
            // Rows can be told apart where all are named by number.
            Some(used) => used.iter().copied().collect(),
        };
        if let (Some(used), Some(rows)) = (used, rows.and_then(|rows| rows.as_constant())) {
            let is_unused = |row: &i64| !used.contains(row);
            let unused = (0..rows.min(1024)).filter(is_unused);
            found.extend(unused.map(numbered));
        }
    }
    found
}
