//! What is declared beside H and must fit it: the pieces of a split, the components of a force.
//!
//! Input: a model with its H, and nodes. Output: nothing, or what does not fit. Invariant: a split
//! that passes adds up to H, proven by the normal form; where that does not decide, the difference
//! is reported as it is, never passed on trust.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::Index;
use crate::loops::Point;
use crate::model::{Model, Shape};
use crate::normal_form::{self, Proof, Scope};
use crate::op::Op;
use crate::print;
use crate::rational::Rational;
use crate::structure::{Term, expand};

/// H is not the sum of its pieces, or was not shown to be.
#[derive(Clone, PartialEq, Debug)]
pub struct Difference {
    /// H − Σ pieces, multiplied out.
    pub node: Node,
    /// The same as text.
    pub text: String,
    /// A point where it is not 0, and its value there; `None` where no point was found, so that
    /// the question is undecided.
    pub point: Option<(Point, f64)>,
    /// Where there is no point, the rule or the limit that stopped the proof: a clause.
    pub why: String,
}

/// Checks that the pieces add up to H: Σ A = H as functions of (q, p, t), additive constants
/// included. Each piece is a Hamiltonian of its own.
///
/// # Errors
/// [`Difference`] with H − Σ A.
pub fn check_split(model: &mut Model, pieces: &[(String, Node)]) -> Result<(), Box<Difference>> {
    let h = match model.hamiltonian {
        Some(h) => h,
        None => model.dag.integer(0),
    };
    let mut terms = vec![(Rational::ONE, h)];
    terms.extend(
        pieces
            .iter()
            .map(|(_, piece)| (Rational::MINUS_ONE, *piece)),
    );
    let difference = model.dag.linear(&Rational::ZERO, &terms);
    // Multiplied out first, so that the point names only what the difference depends on.
    let node = multiplied_out(&mut model.dag, difference);
    let parts: Vec<Node> = terms.iter().map(|(_, part)| *part).collect();
    let point = match normal_form::is_zero_where(model, node, &parts) {
        Proof::Zero => return Ok(()),
        Proof::NonZero { point, value } => Some((point, value)),
        Proof::Undecided => None,
    };
    Err(Box::new(Difference {
        node,
        text: print::text(model, node),
        why: match point {
            Some(_) => String::new(),
            None => normal_form::answer(&mut model.dag, node, Scope::Everywhere).why(),
        },
        point,
    }))
}

/// The node multiplied out and collected, cos² written 1 − sin²; itself where there are too many
/// terms.
fn multiplied_out(dag: &mut Dag, node: Node) -> Node {
    let Some(terms) = expand(dag, node) else {
        return node;
    };
    let mut nodes = Vec::with_capacity(terms.len());
    for term in &terms {
        nodes.push(without_cosine_squares(dag, term));
    }
    let sum = dag.add(&nodes);
    match expand(dag, sum) {
        Some(terms) => {
            let nodes: Vec<Node> = terms.iter().map(|term| term.node(dag)).collect();
            dag.add(&nodes)
        }
        None => sum,
    }
}

fn without_cosine_squares(dag: &mut Dag, term: &Term) -> Node {
    let mut factors = Vec::with_capacity(term.factors.len());
    for &(node, n) in &term.factors {
        let angle = match dag.kind(node) {
            Kind::Call(Op::Cos, arguments) if n >= 2 => arguments[0],
            _ => {
                factors.push((node, n));
                continue;
            }
        };
        let sine = dag.call(Op::Sin, &[angle]);
        let square = dag.powi(sine, 2);
        let square = dag.linear(&Rational::ONE, &[(Rational::MINUS_ONE, square)]);
        factors.push((square, n / 2));
        if n % 2 == 1 {
            factors.push((node, 1));
        }
    }
    dag.product(&term.coefficient, &factors)
}

/// One component of a force: what is added to ṗ of a momentum. `row` may be a loop variable over
/// all rows of the group.
#[derive(Clone, PartialEq, Debug)]
pub struct Force {
    /// The group of the momentum.
    pub group: u16,
    /// Its row; 0 in a scalar group.
    pub row: Index,
    /// Its column; 0 unless the group is of rank 2.
    pub column: u16,
    /// The force.
    pub value: Node,
}

/// Checks that every momentum has one component of force and no more: ṗ = −∂H/∂q + f.
///
/// # Errors
/// A sentence without a full stop, which names the momentum.
pub fn check_forces(model: &Model, forces: &[Force]) -> Result<(), String> {
    let mut seen: Map<(u16, u16), Vec<Option<i64>>> = Map::default();
    for force in forces {
        let Some(group) = model.groups.get(usize::from(force.group)) else {
            return Err(format!("there is no momentum of group {}", force.group));
        };
        let (rows, columns) = extents(&group.shape);
        if force.column >= columns {
            return Err(format!(
                "`{}` has no column {}",
                group.momentum, force.column
            ));
        }
        let row = if force.row.modulo.is_none() {
            force.row.affine.as_constant()
        } else {
            None
        };
        let covers = match row {
            Some(row) => rows.is_none_or(|rows| (0..rows).contains(&row)) && row >= 0,
            None => is_whole(model, &group.shape, &force.row),
        };
        let known = seen.entry((force.group, force.column)).or_default();
        if !covers {
            return Err(format!(
                "a force on `{}` acts on rows that do not exist, or on some rows only",
                group.momentum
            ));
        }
        if known.contains(&None) || known.contains(&row) || (row.is_none() && !known.is_empty()) {
            return Err(format!("two forces act on `{}`", group.momentum));
        }
        known.push(row);
    }
    for (number, group) in model.groups.iter().enumerate() {
        let (rows, columns) = extents(&group.shape);
        for column in 0..columns {
            let known = seen.get(&(number as u16, column));
            let complete = known.is_some_and(|known| {
                known.contains(&None) || rows.is_some_and(|rows| known.len() as i64 == rows)
            });
            if !complete {
                return Err(format!("no force acts on all of `{}`", group.momentum));
            }
        }
    }
    Ok(())
}

/// Rows, where they are literal, and columns.
fn extents(shape: &Shape) -> (Option<i64>, u16) {
    match shape {
        Shape::Scalar => (Some(1), 1),
        Shape::Vector(rows) => (rows.as_constant(), 1),
        Shape::Matrix(rows, columns) => {
            let columns = columns.as_constant().unwrap_or(0);
            (
                rows.as_constant(),
                columns.clamp(0, i64::from(u16::MAX)) as u16,
            )
        }
    }
}

/// Whether an index is the variable of a loop over all rows.
fn is_whole(model: &Model, shape: &Shape, row: &Index) -> bool {
    let (Shape::Vector(rows) | Shape::Matrix(rows, _)) = shape else {
        return false;
    };
    let [(domain, 1)] = row.affine.loops.as_slice() else {
        return false;
    };
    let range = model.dag.range(*domain);
    row.modulo.is_none()
        && row.affine.constant == 0
        && row.affine.sizes.is_empty()
        && range.start.as_constant() == Some(0)
        && range.end == *rows
}
