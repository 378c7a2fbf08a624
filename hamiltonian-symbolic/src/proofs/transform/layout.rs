//! The groups that charts replace, and those in their places.
//!
//! Input: a model and charts, each of coordinates of the shape it is for. Output: [`GroupLayout`], or why the charts do not fit. Invariant: the new
//! groups of a chart stand where its first old group stood; names are told apart.

use super::NoTransform;
use super::charts::{Chart, Component, Formulas, PhaseNodes, Replaced};
use crate::dag::{Column, Dag, Node, Side};
use crate::index::Index;
use crate::list::IntoList;
use crate::model::{Group, Model, Shape};
use crate::sort::Arrange;

/// A group, or one row of it, among the old variables, and where it stands among the new ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Placement {
    /// The group of the source, and the row of a vector that becomes scalars.
    pub old: (u16, Option<u32>),
    /// The group of the model, which has as many elements.
    pub new: u16,
}

/// A scalar place of phase space.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Slot {
    pub(super) group: u16,
    pub(super) row: u32,
    pub(super) column: u16,
}

impl Slot {
    /// Its column on a side.
    pub(super) fn at(self, side: Side) -> Column {
        let Slot { group, column, .. } = self;
        Column {
            side,
            group,
            column,
        }
    }
    /// Its row.
    pub(super) fn row(self) -> Index {
        Index::constant(i64::from(self.row))
    }
    /// The scalar there.
    pub(super) fn node(self, dag: &mut Dag, side: Side) -> Node {
        dag.phase(self.at(side), self.row())
    }
}

/// One set of variables that a chart maps as a whole: bodies are mapped component by component.
pub(super) struct ChartVariables {
    pub(super) old: Vec<Slot>,
    pub(super) new: Vec<Slot>,
}

impl ChartVariables {
    pub(super) fn variables(&self, dag: &mut Dag, old: bool) -> PhaseNodes {
        let mut variables = PhaseNodes::default();
        for slot in if old { &self.old } else { &self.new } {
            variables.q.push(slot.node(dag, Side::Q));
            variables.p.push(slot.node(dag, Side::P));
        }
        variables
    }
}

/// The variables that a chart maps.
pub(super) struct Mapped {
    pub(super) charted: Vec<ChartVariables>,
    /// The first new group.
    pub(super) first: u16,
}

/// The groups of the new model.
pub(super) struct GroupLayout {
    pub(super) groups: Vec<Group>,
    pub(super) places: Vec<Mapped>,
    pub(super) kept: Vec<(u16, u16)>,
    pub(super) replaced: Vec<u16>,
}

impl GroupLayout {
    pub(super) fn new(model: &Model, charts: &[Chart]) -> Result<GroupLayout, NoTransform> {
        let mut replaced: Vec<u16> = Vec::new();
        for chart in charts {
            if let Chart::Jacobi(bodies) = chart
                && model.groups[usize::from(bodies.group)]
                    .shape
                    .literal()
                    .is_none()
            {
                return Err(NoTransform::Number {
                    coordinate: coordinate(model, bodies.group),
                });
            }
            for group in members(chart) {
                if replaced.contains(&group) {
                    return Err(NoTransform::Twice {
                        coordinate: coordinate(model, group),
                    });
                }
                replaced.push(group);
            }
        }
        let own = new_groups(model, charts);
        let mut groups: Vec<Group> = Vec::new();
        let mut kept = Vec::new();
        let mut firsts: Vec<Option<u16>> = vec![None; charts.len()];
        for (number, group) in model.groups.iter().enumerate() {
            let number = number as u16;
            if !replaced.contains(&number) {
                kept.push((number, groups.len() as u16));
                groups.push(group.clone());
                continue;
            }
            for ((chart, own), first) in charts.iter().zip(&own).zip(&mut firsts) {
                if first.is_none() && members(chart).contains(&number) {
                    *first = Some(groups.len() as u16);
                    groups.extend(own.iter().cloned());
                }
            }
        }
        // Old names go, so they may come back: names that are kept must differ from new ones.
        let mut left = model.clone();
        left.groups = kept
            .iter()
            .map(|(old, _)| model.groups[usize::from(*old)].clone())
            .into_list();
        for (chart, own) in charts.iter().zip(&own) {
            for group in own {
                for name in [&group.coordinate, &group.momentum] {
                    if left.declares(name) {
                        return Err(NoTransform::NameTaken {
                            name: name.clone(),
                            by: chart.word(),
                        });
                    }
                }
                left.groups.push(group.clone());
            }
        }
        let places = charts
            .iter()
            .zip(firsts)
            .map(|(chart, first)| {
                let first = first.expect("a chart has members");
                let charted = charted(model, chart, first);
                Mapped { charted, first }
            })
            .into_list();
        Ok(GroupLayout {
            groups,
            places,
            kept,
            replaced,
        })
    }
}

pub(super) fn coordinate(model: &Model, group: u16) -> String {
    model.groups[usize::from(group)].coordinate.clone()
}

/// The groups a chart names, each once.
fn members(chart: &Chart) -> Vec<u16> {
    let components = match chart.replaced() {
        Replaced::Scalars(_, components) => components,
        Replaced::Bodies(bodies) => return vec![bodies.group],
    };
    let mut groups: Vec<u16> = components.iter().map(|c| c.group).into_list();
    groups.arrange();
    groups.dedup();
    groups
}

/// The names of the scalar coordinates of charts by their words, none for charts of bodies. The momentum of `r` is
/// `p_r`. A name that an earlier chart introduces gets a number: `r`, then `r_2`.
#[must_use]
pub fn names_of_scalars(words: &[&str]) -> Vec<Vec<String>> {
    let mut all: Vec<Vec<String>> = Vec::with_capacity(words.len());
    for word in words {
        let scalar = |name: &&str| {
            let is_taken = |name: &str| all.iter().flatten().any(|other| other == name);
            let mut numbered = (2..).map(|number| format!("{name}_{number}"));
            match is_taken(name) {
                true => numbered.find(|name| !is_taken(name)).unwrap_or_default(),
                false => (*name).to_owned(),
            }
        };
        let names = Formulas::named(word).map_or(&[][..], |formulas| formulas.new);
        let own = names.iter().map(scalar).into_list();
        all.push(own);
    }
    all
}

/// The groups of each chart.
fn new_groups(model: &Model, charts: &[Chart]) -> Vec<Vec<Group>> {
    let words: Vec<&str> = charts.iter().map(Chart::word).into_list();
    let scalar = |name: String| {
        let momentum = format!("p_{name}");
        Group::scalar(name, momentum)
    };
    let own = |(chart, names): (&Chart, Vec<String>)| match chart.replaced() {
        Replaced::Scalars(..) => names.into_iter().map(scalar).into_list(),
        Replaced::Bodies(bodies) => {
            let old = &model.groups[usize::from(bodies.group)];
            vec![Group {
                coordinate: format!("{}_{}", old.coordinate, chart.word()),
                momentum: format!("{}_{}", old.momentum, chart.word()),
                velocity: None,
                shape: old.shape.clone(),
            }]
        }
    };
    charts
        .iter()
        .zip(names_of_scalars(&words))
        .map(own)
        .into_list()
}

/// The sets of variables of a chart whose first new group has the given number.
fn charted(model: &Model, chart: &Chart, first: u16) -> Vec<ChartVariables> {
    let slot = |group, row, column| Slot { group, row, column };
    match chart.replaced() {
        Replaced::Scalars(_, components) => {
            let old = components
                .iter()
                .map(|c| slot(c.group, c.row.unwrap_or(0), 0));
            let new = (first..)
                .take(components.len())
                .map(|group| slot(group, 0, 0));
            vec![ChartVariables {
                old: old.into_list(),
                new: new.into_list(),
            }]
        }
        Replaced::Bodies(bodies) => {
            let shape = &model.groups[usize::from(bodies.group)].shape;
            // Bodies of any number have no such sets: `bodies` maps them in loops.
            let Some((rows, columns)) = shape.literal() else {
                return Vec::new();
            };
            let slots = |group, column| (0..rows as u32).map(move |row| slot(group, row, column));
            let variables = |column| ChartVariables {
                old: slots(bodies.group, column).into_list(),
                new: slots(first, column).into_list(),
            };
            (0..columns).map(variables).into_list()
        }
    }
}

/// The places of a chart's old variables among its new ones.
pub(super) fn placements(model: &Model, chart: &Chart, first: u16) -> Vec<Placement> {
    match chart.replaced() {
        Replaced::Scalars(_, components) => {
            let place = |(component, new): (&Component, u16)| {
                let is_scalar = model.groups[usize::from(component.group)].shape == Shape::Scalar;
                let row = component.row.filter(|_| !is_scalar);
                Placement {
                    old: (component.group, row),
                    new,
                }
            };
            components.iter().zip(first..).map(place).into_list()
        }
        Replaced::Bodies(bodies) => vec![Placement {
            old: (bodies.group, None),
            new: first,
        }],
    }
}
