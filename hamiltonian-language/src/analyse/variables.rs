//! The variables a system is integrated in: canonical coordinates, another time; and the vector
//! functions it offers in them.
//!
//! Input: the lowered definition. Output: the model in its final variables with its vector
//! functions, and the pieces of a split. Invariant: signs stay
//! q̇ = ∂H/∂p, ṗ = −∂H/∂q; the order is coordinates, then time.

use super::proofs;
use super::surface::CLOCK;
use crate::checked::{Checked, Definition};
use crate::lower::Lowered;
use crate::report::Report;
use hamiltonian_symbolic::dag::{Column, Node, Side};
use hamiltonian_symbolic::index::{Affine, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{
    Group, Model, ObservableKind, VectorEntry, VectorFunction, VectorUse,
};
use hamiltonian_symbolic::support::support;
use hamiltonian_symbolic::transform::{self, Chart, NoTransform, Placement};
use proc_macro2::Ident;

/// The declared variables.
#[derive(Debug)]
pub struct Declared {
    /// Their groups.
    pub groups: Vec<Group>,
    /// The place of each among the system's own variables.
    pub places: Vec<Placement>,
    /// The group of the system that is the declared time, where it has another.
    pub time: Option<u16>,
}

/// A definition in its final variables.
#[derive(Debug)]
pub struct Changed {
    /// H, observables and vector functions.
    pub model: Model,
    /// The pieces of a split.
    pub pieces: Vec<(Ident, Node)>,
    /// The variables of the definition, where these are others.
    pub declared: Option<Declared>,
}

/// Carries a definition into its final variables.
pub fn change(checked: &Checked, lowered: Lowered, report: &mut Report) -> Option<Changed> {
    let mut system = Changed {
        model: lowered.model,
        pieces: Vec::new(),
        declared: None,
    };
    if !checked.charts.is_empty() {
        system.charts(checked, report)?;
    }
    if let Some((_, span)) = checked.time_factor
        && let Err(reason) = system.time()
    {
        report.error(
            span,
            format!("this time cannot be introduced: {reason}"),
            remedy(&reason),
        );
        return None;
    }
    if !system.model.force.is_empty() {
        system.offer(VectorUse::Force, system.model.force.clone());
    }
    system.gradients();
    let clock = checked.time_factor.map(|(_, span)| Ident::new(CLOCK, span));
    let names = checked.split.iter().map(|(name, _)| name.clone());
    let pieces = std::mem::take(&mut system.model.split);
    system.pieces = names.chain(clock).zip(pieces).into_list();
    Some(system)
}

impl Changed {
    fn offer(&mut self, usage: VectorUse, entries: Vec<VectorEntry>) {
        self.model.vectors.push(VectorFunction { usage, entries });
    }

    /// The gradients of events and monitors.
    fn gradients(&mut self) {
        for at in 0..self.model.observables.len() {
            let observable = &self.model.observables[at];
            if let (ObservableKind::Event | ObservableKind::Monitor, &[value]) =
                (observable.kind, observable.components.as_slice())
            {
                let mut value = [value];
                support(&mut self.model.dag, &mut value);
                let gradient = self.model.partials(value[0]);
                self.offer(VectorUse::Gradient(at), gradient);
            }
        }
    }

    fn charts(&mut self, checked: &Checked, report: &mut Report) -> Option<()> {
        let spans = checked.charts[0].name.span();
        let mut refuse = |message: String, help: &str| {
            report.error(spans, message, help);
        };
        if matches!(checked.definition, Definition::Lagrangian(_)) {
            refuse(
                "coordinates of a Lagrangian are not changed".to_owned(),
                "write L in the coordinates you want: any are allowed",
            );
            return None;
        }
        let charts: Vec<Chart> = checked.charts.iter().map(|chart| chart.kind).into_list();
        let mut transformed = match transform::apply(&self.model, &charts) {
            Ok(transformed) => transformed,
            Err(reason) => {
                refuse(
                    format!("these coordinates cannot be introduced: {reason}"),
                    remedy(&reason),
                );
                return None;
            }
        };
        let from = transformed.forward_placed();
        let from = map(&mut transformed, from);
        let to = transformed.inverse_placed();
        let to = map(&mut transformed, to);
        self.declared = Some(Declared {
            groups: transformed.source.groups,
            places: transformed.places,
            time: None,
        });
        self.model = transformed.model;
        proofs::split(checked, &mut self.model, report);
        report.barrier(())?;
        self.offer(VectorUse::FromDeclared, from);
        self.offer(VectorUse::ToDeclared, to);
        Some(())
    }

    fn time(&mut self) -> Result<(), NoTransform> {
        let whole = |group: u16| Placement {
            old: (group, None),
            new: group,
        };
        let groups = self.model.groups.len() as u16;
        let declared = self.declared.get_or_insert_with(|| Declared {
            groups: self.model.groups.clone(),
            places: (0..groups).map(whole).into_list(),
            time: None,
        });
        declared.time = Some(groups);
        let retimed = transform::retime(&self.model)?;
        let (group, start) = (retimed.group, retimed.start);
        self.model = retimed.model;
        // dt/dt = 1
        let one = self.model.dag.integer(1);
        for vector in &mut self.model.vectors {
            if vector.usage == VectorUse::Velocity {
                vector.entries.push(VectorEntry {
                    at: Column::first(Side::Q, group),
                    row: Index::constant(0),
                    value: one,
                });
            }
        }
        let mut on_shell = identity(&mut self.model, Side::P, &|other| other != group);
        on_shell.push(VectorEntry {
            at: Column::first(Side::P, group),
            row: Index::constant(0),
            value: start,
        });
        self.offer(VectorUse::OnShell, on_shell);
        Ok(())
    }
}

/// The help of an error: the way to a definition that is not refused.
fn remedy(reason: &NoTransform) -> &'static str {
    match reason {
        NoTransform::NameTaken { .. } => "rename the parameter or coordinate of that name",
        NoTransform::Number { .. } => {
            "declare them as `q[4][3]` with masses `m: [4]`; `heliocentric` takes any number"
        }
        NoTransform::Wrapped { .. } => {
            "write the term that closes the ring by itself, or declare a literal number of bodies"
        }
        NoTransform::Twice { .. } => "replace each coordinate once",
        NoTransform::Loops { .. } => "give the loop literal bounds, so that it can be unrolled",
        NoTransform::TooManyLoops => "let several sums share a loop",
        NoTransform::TooLong => {
            "bodies are written out one by one: take fewer, or `heliocentric`, which keeps loops"
        }
        NoTransform::Factor { .. } => "write `dt = g(q, p)*ds` with g > 0",
        NoTransform::Power { .. } => {
            "write the sums of H over `p[i]` with the loop variable alone as the index"
        }
        NoTransform::Uncompared { .. } => {
            "check where roots and logarithms in H are defined, and that literal indices and sizes fit together; units in which coordinates are of size 1 help"
        }
        NoTransform::Unverified { .. } => {
            "this is a fault of the transformation: please report it with the definition"
        }
    }
}

/// The images of a change of coordinates, and the variables it keeps.
fn map(transformed: &mut transform::Transformed, images: Vec<VectorEntry>) -> Vec<VectorEntry> {
    let kept: Vec<u16> = transformed.kept.iter().map(|(_, new)| *new).into_list();
    let kept = |group: u16| kept.contains(&group);
    let mut all = identity(&mut transformed.model, Side::Q, &kept);
    all.extend(identity(&mut transformed.model, Side::P, &kept));
    all.extend(images);
    all
}

/// Every element of the wanted groups as it is.
fn identity(model: &mut Model, side: Side, wanted: &dyn Fn(u16) -> bool) -> Vec<VectorEntry> {
    let mut all = Vec::new();
    for group in (0..model.groups.len() as u16).filter(|group| wanted(*group)) {
        let shape = &model.groups[usize::from(group)].shape;
        let (rows, columns) = (shape.rows().cloned(), shape.columns());
        let row = match rows {
            None => Index::constant(0),
            Some(rows) => {
                let domain = model.dag.domain(None, Affine::constant(0), rows);
                Index::of_loop(domain)
            }
        };
        for column in 0..columns {
            let at = Column {
                side,
                group,
                column,
            };
            let row = row.clone();
            let value = model.dag.phase(at, row.clone());
            all.push(VectorEntry { at, row, value });
        }
    }
    all
}
