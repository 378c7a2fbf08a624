//! Hamilton's equations as text.
//!
//! Input: a model. Output: one pair (left side, right side) for each scalar coordinate and
//! momentum, for each element that is read by number, for each column of an array. Invariants: the
//! model is not changed; derivatives are taken once, however often they are written.

use super::layout::Writer;
use super::names::is_taken;
use super::{Notation, write_within};
use crate::dag::{Array, Column, Dependence, Kind, Map, Node, Side};
use crate::diff;
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::loops::field;
use crate::model::{Model, Shape};
use crate::rational::Rational;

/// Equations of an H of more nodes than this are not written: they would be too long to read.
const LARGEST: usize = 2048;
/// Nor are equations read that have more nodes than this together, each counted where it is written: those
/// of a product of n coordinates have n² factors.
const LONGEST: usize = 8192;

/// Hamilton's equations, to be written in any notation.
#[derive(Debug)]
pub struct Equations {
    /// The model with the derivatives in its arena.
    model: Model,
    list: Vec<Equation>,
}

impl Equations {
    /// Left and right side of each.
    #[must_use]
    pub fn written(&self, notation: Notation) -> Vec<(String, String)> {
        let equations = self.list.iter();
        equations
            .map(|equation| equation.written(&self.model, notation))
            .into_list()
    }
}

/// Hamilton's equations: dq/dt = ∂H/∂p for all coordinates, then dp/dt = f − ∂H/∂q for all momenta, with
/// the force f where one acts.
/// Elements of an array share one equation for element k. Where the derivative cannot be written
/// as an expression of k, or H is too large for derivatives to be read, it is named instead:
/// `-∂H/∂q[k]`, or `force - ∂H/∂q[k]`.
#[must_use]
pub fn hamilton_equations(model: &Model) -> Equations {
    let mut model = model.clone();
    let mut list = Vec::new();
    let h = model.h();
    let is_large = model.dag.reachable(&[h]).len() > LARGEST;
    for side in [Side::Q, Side::P] {
        of_side(&mut model, h, side, is_large, &mut list);
    }
    Equations { model, list }
}

/// The equations of all coordinates, or of all momenta.
fn of_side(model: &mut Model, h: Node, side: Side, is_large: bool, list: &mut Vec<Equation>) {
    let what = match side {
        Side::Q => Dependence::P,
        Side::P => Dependence::Q,
    };
    let mut leaves = Vec::new();
    let (mut is_large, mut length) = (is_large, 0);
    if !is_large {
        for (leaf, value) in diff::gradient(&mut model.dag, h, what) {
            // Factors that differentiation multiplies one after another are one product to a reader.
            let value = model.dag.rebuilt(value);
            leaves.push((leaf, value));
            length = written_length(model, value).saturating_add(length);
            if length > LONGEST {
                is_large = true;
                break;
            }
        }
    }
    for force in model.force.clone().into_iter().filter(|_| side == Side::P) {
        // ∂H/∂q − f, whose sign is changed.
        let leaf = (model.dag).element(Array::Phase(force.at.conjugate()), force.row, None);
        let value = model.dag.neg(force.value);
        match leaves.iter_mut().find(|(other, _)| *other == leaf) {
            Some((_, adjoint)) => *adjoint = model.dag.add(&[*adjoint, value]),
            None => leaves.push((leaf, value)),
        }
    }
    let mut of_array: Map<Column, Vec<(Index, Node)>> = Map::default();
    for &(leaf, adjoint) in &leaves {
        if let Some((column, row)) = model.dag.phase_place(leaf) {
            let own = of_array.entry(column).or_default();
            own.push((row.clone(), adjoint));
        }
    }
    is_large |= model.dag.has_too_many_loops();
    for (at, rows) in model.columns(side) {
        let own = of_array.take(&at.conjugate()).unwrap_or_default();
        let found = match &rows {
            _ if is_large => vec![(rows.as_ref().map(|_| Subscript::any(model, None)), None)],
            None => {
                let value = signed(model, side, own.first().map(|(_, adjoint)| *adjoint));
                vec![(None, Some(value))]
            }
            Some(rows) => elements(model, at, rows, &leaves, &own),
        };
        let equation = |(row, value)| Equation { at, row, value };
        list.extend(found.into_iter().map(equation));
    }
}

/// The nodes of an expression, each as often as it is written.
fn written_length(model: &Model, value: Node) -> usize {
    let mut lengths: Map<Node, usize> = Map::default();
    let mut length = 0;
    for node in model.dag.reachable(&[value]) {
        length = 1;
        model.dag.for_children(node, |child| {
            length = lengths[&child].saturating_add(length);
        });
        lengths.insert(node, length);
    }
    length
}

/// The equation of a scalar coordinate or momentum with a right side that is known.
pub(crate) fn scalar_equation(
    model: &Model,
    side: Side,
    group: usize,
    notation: Notation,
    value: Node,
) -> (String, String) {
    let equation = Equation {
        at: Column::first(side, group as u16),
        row: None,
        value: Some(value),
    };
    equation.written(model, notation)
}

/// The name of an element's index.
fn index_name(model: &Model) -> &'static str {
    index_names(model).next().unwrap_or("index")
}

/// The names that nothing else has.
fn index_names(model: &Model) -> impl Iterator<Item = &'static str> {
    let all = ["k", "i", "j", "l", "n"].into_iter();
    all.filter(|name| !is_taken(model, name))
}

/// The index of an element: a number, or a name with the loop that it runs in.
#[derive(Clone, Debug)]
struct Subscript {
    name: String,
    domain: Option<Domain>,
}

impl Subscript {
    /// One row of those there are.
    fn numbered(row: i64) -> Subscript {
        Subscript {
            name: row.to_string(),
            domain: None,
        }
    }
    /// The row that stands for all of them.
    fn any(model: &Model, domain: Option<Domain>) -> Subscript {
        Subscript {
            name: index_name(model).to_owned(),
            domain,
        }
    }
}

/// One equation; the right side is named where its value is not there.
#[derive(Debug)]
struct Equation {
    at: Column,
    row: Option<Subscript>,
    value: Option<Node>,
}

/// The right side of an equation from the derivative of H: ∂H/∂p, or −∂H/∂q.
fn signed(model: &mut Model, side: Side, value: Option<Node>) -> Node {
    let dag = &mut model.dag;
    let Some(value) = value else {
        return dag.integer(0);
    };
    if side == Side::Q {
        return value;
    }
    // −(a + b) is written −a − b.
    let Kind::Sum(c, terms) = dag.kind(value).clone() else {
        return dag.neg(value);
    };
    let mut negated = Vec::with_capacity(terms.len());
    for (k, term) in terms {
        let k = k.neg();
        match *dag.kind(term) {
            // Nor is a condition negated, but its branches are.
            Kind::Select(condition, yes, no) => {
                let (yes, no) = (dag.scale(&k, yes), dag.scale(&k, no));
                negated.push((Rational::ONE, dag.select(condition, yes, no)));
            }
            _ => negated.push((k, term)),
        }
    }
    dag.linear(&c.neg(), &negated)
}

/// The rows of the equations of an array, with their right sides, from the adjoints of all leaves and
/// the `own` ones of its conjugate.
fn elements(
    model: &mut Model,
    at: Column,
    rows: &Affine,
    leaves: &[(Node, Node)],
    own: &[(Index, Node)],
) -> Vec<(Option<Subscript>, Option<Node>)> {
    let domain = field::elements(&mut model.dag, rows);
    if !model.groups[usize::from(at.group)].shape.axes().is_empty() {
        return vec![(Some(Subscript::any(model, None)), None)];
    }
    let array = Array::Phase(at.conjugate());
    let is_numbered = |row: &Index| row.as_constant().is_some();
    let numbered = own.iter().filter(|(row, _)| is_numbered(row)).count();
    // A short array that is read by number, at least by a quarter, has an equation for each element.
    if let Some(count @ 1..=16) = rows.as_constant()
        && numbered > 0
        && (numbered == own.len() || 4 * numbered >= count as usize)
    {
        let looped = leaves.iter().copied().filter(|(leaf, _)| {
            let place = model.dag.phase_place(*leaf);
            place.is_some_and(|(_, row)| !is_numbered(row))
        });
        let looped = looped.into_list();
        if let Some(looped) = field::field(&mut model.dag, &looped, array, rows) {
            let of_row = |row: i64| {
                let own = own.iter().filter(|(at, _)| at.as_constant() == Some(row));
                let mut parts: Vec<Node> = own.map(|(_, adjoint)| *adjoint).into_list();
                parts.push(model.dag.replace(looped, domain, &Affine::constant(row)));
                let sum = model.dag.add(&parts);
                (
                    Some(Subscript::numbered(row)),
                    Some(signed(model, at.side, Some(sum))),
                )
            };
            return (0..count).map(of_row).into_list();
        }
    }
    // A long one read at many numbers would be a list of conditions nobody reads.
    let is_listed = own.len() > 16 && own.iter().all(|(row, _)| row.variables().is_empty());
    let value = match is_listed {
        true => None,
        false => field::field(&mut model.dag, leaves, array, rows),
    };
    let value = value.map(|value| signed(model, at.side, Some(value)));
    vec![(Some(Subscript::any(model, Some(domain))), value)]
}

impl Equation {
    /// `dq[k]/dt`, or `dq[k]/ds` in another time, and its value.
    fn written(&self, model: &Model, notation: Notation) -> (String, String) {
        let at = self.at;
        let group = &model.groups[usize::from(at.group)];
        let (own, conjugate) = (group.name(at.side), group.name(at.side.other()));
        let mut indices: Vec<String> = match group.shape.axes().len() {
            0 => self.row.iter().map(|row| row.name.clone()).into_list(),
            count => (index_names(model).chain(std::iter::repeat("index")))
                .take(count)
                .map(str::to_owned)
                .into_list(),
        };
        if matches!(group.shape, Shape::Matrix(..)) {
            indices.push(at.column.to_string());
        }
        let writer = Writer::new(model, notation.style(), &[]);
        let element = |name: &str| writer.indexed(name, &indices);
        let time = writer.named(model.evolution.as_deref().unwrap_or(model.time_name()));
        let left = match notation {
            Notation::Text => format!("d{}/d{time}", element(own)),
            Notation::Latex => format!(
                "\\frac{{\\mathrm{{d}} {}}}{{\\mathrm{{d}} {time}}}",
                element(own)
            ),
        };
        let bound: Vec<(Domain, &str)> = self
            .row
            .iter()
            .filter_map(|row| row.domain.map(|domain| (domain, row.name.as_str())))
            .into_list();
        let right = match self.value {
            Some(value) => write_within(model, value, notation, &bound),
            None => {
                let is_forced = model.force.iter().any(|force| force.at == at);
                let sign = match (at.side, is_forced, notation) {
                    (Side::Q, ..) => "",
                    (Side::P, false, _) => "-",
                    (Side::P, true, Notation::Text) => "force - ",
                    (Side::P, true, Notation::Latex) => "\\mathrm{force} - ",
                };
                match notation {
                    Notation::Text => format!("{sign}∂H/∂{}", element(conjugate)),
                    Notation::Latex => format!(
                        "{sign}\\frac{{\\partial H}}{{\\partial {}}}",
                        element(conjugate)
                    ),
                }
            }
        };
        (left, right)
    }
}
