//! From a Lagrangian to its Hamiltonian.
//!
//! Input: L(q, v, t), quadratic in the velocities, which stand where momenta stand in H
//! ([`Side::P`] elements of the arena). Output: [`Legendre`]: H(q, p, t), p(q, v, t) and
//! v(q, p, t); with L = ½vᵀMv + bᵀv − V that is p = Mv + b and H = ½(p − b)ᵀM⁻¹(p − b) + V.
//! Invariant: M is proven not to depend on velocities, and not to be singular everywhere.
//!
//! All scalar coordinates together have one mass matrix, dense or not; array elements have one for
//! each element k, over the columns of all arrays of that length. Arrays of literal length whose
//! elements are coupled are unrolled, if they are short. A lattice is an array of its elements, by number.

mod elements;
mod form;
mod readable;

pub use readable::Readable;

use crate::dag::{Array, Column, Dag, Dependence, Kind, Node, Side};
use crate::diff;
use crate::index::{Domain, Index};
use crate::list::IntoList;
use crate::loops::{field, unrolled};
use crate::model::{Model, Shape};
use crate::normal_form::{Proof, is_zero};
use crate::print::{self, Notation};
use crate::rational::Rational;
use form::{QuadraticForm, Singular};

/// The help where arrays are coupled.
const COUPLED: &str = "arrays of literal length, with at most 16 elements in all, may be coupled in any way: `L(q[4]; v[4])`; else give H(q; p)";

/// The help where coordinates have several axes.
const LATTICE: &str = "a term of L with velocities of a lattice is a sum over all its sites, and depends on the site by elements of coordinates there alone: `sum(i in 0..n, j in 0..m) { mass*v[i][j]^2/2 }`; else give H(q; p)";

/// Arrays that are unrolled have at most this many elements, scalars included.
const LONGEST: i64 = 16;

/// The momentum or velocity of one coordinate, or of each element of a column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ElementMap {
    /// The element it belongs to, among momenta; in the loop `domain` where it is one of many.
    pub element: Node,
    /// The loop over elements, for arrays.
    pub domain: Option<Domain>,
    /// The component, as a function of the state.
    pub value: Node,
}

/// The Hamiltonian of a Lagrangian, with the maps between velocities and momenta.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Legendre {
    /// H(q, p, t): momentum elements are momenta.
    pub hamiltonian: Node,
    /// p(q, v, t): momentum elements stand for velocities.
    pub momenta: Vec<ElementMap>,
    /// v(q, p, t): momentum elements are momenta.
    pub velocities: Vec<ElementMap>,
    /// L(q, v, t) as it was solved: with its loops unrolled where that was needed.
    pub lagrangian: Node,
    /// The kinetic parts of H, as they are read, not computed.
    pub masses: Vec<Mass>,
    /// −L(q, 0, t), the rest of H: a number and terms with their factors.
    pub potential: (Rational, Vec<(Rational, Node)>),
}

/// Velocities with a common mass matrix M and momenta p = Mv + b.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mass {
    /// The loop over elements, for arrays.
    pub domain: Option<Domain>,
    /// The velocities, in the place of momenta.
    pub elements: Vec<Node>,
    /// M
    pub matrix: Vec<Vec<Node>>,
    /// p − b
    pub right: Vec<Node>,
    /// The order in which M was eliminated; `None` where two rows at a time had to be.
    pub order: Option<Vec<usize>>,
    /// ½(p − b)ᵀM⁻¹(p − b) as it is computed.
    pub energy: Node,
}

/// Why a Lagrangian has no Hamiltonian.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NoHamiltonian {
    /// No velocities, not quadratic in them, elements coupled with each other, singular mass
    /// matrix: a sentence without a full stop.
    pub reason: String,
    /// The help: the condition on L, or the way round it.
    pub help: &'static str,
}

/// The Legendre transform of a Lagrangian in the model's arena.
///
/// # Errors
/// [`NoHamiltonian`]
pub fn transform(model: &mut Model, lagrangian: Node) -> Result<Legendre, NoHamiltonian> {
    let refusal = |reason: String| NoHamiltonian {
        reason,
        help: "L must be quadratic in the velocities, with an invertible mass matrix; else give H(q; p)",
    };
    let mut transform = Transform { model };
    if !transform.model.dag.dependence(lagrangian).on(Dependence::P) {
        return Err(refusal("L has no velocities".to_owned()));
    }
    transform.check_polynomial(lagrangian).map_err(refusal)?;
    let solved = match transform.blocks(lagrangian) {
        Ok(blocks) => transform.solve(lagrangian, &blocks),
        // Elements that are coupled are coordinates like any other, once they are unrolled.
        Err(reason) => match transform.written_out(lagrangian) {
            Some((written, block)) => transform.solve(written, &[block]),
            None => {
                let mut groups = transform.model.groups.iter();
                let has_axes = groups.any(|group| !group.shape.axes().is_empty());
                return Err(NoHamiltonian {
                    reason,
                    help: if has_axes { LATTICE } else { COUPLED },
                });
            }
        },
    };
    solved.map_err(refusal)
}

/// Velocities with a common mass matrix: of scalars, or of element k of arrays.
#[derive(Default)]
struct Velocities {
    domain: Option<Domain>,
    /// The velocities.
    elements: Vec<Node>,
    /// ∂L/∂(velocity).
    momenta: Vec<Node>,
}

struct Transform<'a> {
    model: &'a mut Model,
}

impl Transform<'_> {
    /// Refuses functions of velocities: second derivatives of large ones are dear, and none is
    /// quadratic that would not be written as a polynomial.
    fn check_polynomial(&self, lagrangian: Node) -> Result<(), String> {
        let dag = &self.model.dag;
        let moves = |node: Node| dag.dependence(node).on(Dependence::P);
        for node in dag.reachable(&[lagrangian]) {
            let is_polynomial = match dag.kind(node) {
                Kind::Sum(..) | Kind::Element(..) | Kind::Reduce(..) => true,
                Kind::Product(_, factors) => {
                    factors.iter().all(|(n, power)| *power > 0 || !moves(*n))
                }
                Kind::Select(condition, ..) => !moves(*condition),
                _ => !moves(node),
            };
            if !is_polynomial {
                let name = self.name(node, None);
                return Err(format!(
                    "L is not quadratic in the velocities: {name} is not a polynomial in them"
                ));
            }
        }
        Ok(())
    }

    /// Scalars in one block, arrays by their length.
    fn blocks(&mut self, lagrangian: Node) -> Result<Vec<Velocities>, String> {
        let leaves = diff::gradient(&mut self.model.dag, lagrangian, Dependence::P);
        let mut scalars = Velocities::default();
        let mut arrays: Vec<Velocities> = Vec::new();
        for group in 0..self.model.groups.len() {
            let shape = self.model.groups[group].shape.clone();
            let Some(rows) = shape.rows() else {
                let element = self.model.scalar(Side::P, group);
                scalars.push(&mut self.model.dag, element, &leaves);
                continue;
            };
            let name = self
                .model
                .array_name(Array::Velocity(Column::first(Side::Q, group as u16)));
            let dag = &mut self.model.dag;
            let k = field::elements(dag, rows);
            let at = arrays
                .iter()
                .position(|block| block.domain == Some(k))
                .unwrap_or_else(|| {
                    arrays.push(Velocities {
                        domain: Some(k),
                        ..Velocities::default()
                    });
                    arrays.len() - 1
                });
            for column in 0..shape.columns() {
                let (side, of) = (Side::P, group as u16);
                let at_column = Column {
                    side,
                    group: of,
                    column,
                };
                let element = dag.phase(at_column, Index::of_loop(k));
                arrays[at].elements.push(element);
                let momentum = field::field(dag, &leaves, Array::Phase(at_column), rows);
                arrays[at].momenta.push(momentum.ok_or_else(|| format!("no element of `{name}` has a momentum of its own: its indices cannot be solved"))?);
            }
        }
        let mut blocks = arrays;
        // Short arrays whose elements differ read better when they are unrolled.
        let is_long = self.extents().is_none();
        let dag = &mut self.model.dag;
        for block in &mut blocks {
            let Some(k) = block.domain.filter(|_| is_long) else {
                continue;
            };
            let arrays: Vec<Array> = block
                .elements
                .iter()
                .filter_map(|e| array(dag, *e))
                .into_list();
            for momentum in &mut block.momenta {
                *momentum = elements::at_own_index(dag, *momentum, k, &arrays);
            }
        }
        if !scalars.elements.is_empty() {
            blocks.insert(0, scalars);
        }
        self.check_uncoupled(&mut blocks)?;
        Ok(blocks)
    }

    /// Each momentum may depend on velocities of its own block and element only.
    fn check_uncoupled(&mut self, blocks: &mut [Velocities]) -> Result<(), String> {
        for block in blocks {
            for (&element, momentum) in block.elements.iter().zip(&block.momenta) {
                // A sum over all elements may be one over k: its velocities are not element k's.
                let apart = self.model.dag.nested(*momentum, block.domain);
                for (leaf, slope) in diff::gradient(&mut self.model.dag, apart, Dependence::P) {
                    if block.elements.contains(&leaf) || is_zero(self.model, slope) == Proof::Zero {
                        continue;
                    }
                    let (one, other) = (
                        self.name(element, block.domain),
                        self.name(leaf, block.domain),
                    );
                    return Err(format!(
                        "the mass matrix couples {one} with {other}; in arrays only the columns of one row may be coupled"
                    ));
                }
            }
        }
        Ok(())
    }

    /// Rows and columns of each group, where these are few enough to be unrolled.
    fn extents(&self) -> Option<Vec<(i64, u16)>> {
        let mut extents = Vec::new();
        let mut count = 0i64;
        for group in &self.model.groups {
            let (rows, columns) = group.shape.literal()?;
            count = count.saturating_add(rows.saturating_mul(columns.into()));
            extents.push((rows, columns));
        }
        if count > LONGEST || self.model.groups.iter().all(|g| g.shape == Shape::Scalar) {
            return None;
        }
        Some(extents)
    }

    /// The Lagrangian with its loops unrolled and all elements in one block; `None` if there
    /// are too many, or their number is not literal.
    fn written_out(&mut self, lagrangian: Node) -> Option<(Node, Velocities)> {
        let extents = self.extents()?;
        let written = unrolled(self.model, lagrangian).ok()?;
        let leaves = diff::gradient(&mut self.model.dag, written, Dependence::P);
        let mut block = Velocities::default();
        for (group, (rows, columns)) in extents.into_iter().enumerate() {
            for row in 0..rows {
                for column in 0..columns {
                    let (side, group) = (Side::P, group as u16);
                    let at = Column {
                        side,
                        group,
                        column,
                    };
                    let element = self.model.dag.phase(at, Index::constant(row));
                    block.push(&mut self.model.dag, element, &leaves);
                }
            }
        }
        Some((written, block))
    }

    fn solve(&mut self, lagrangian: Node, blocks: &[Velocities]) -> Result<Legendre, String> {
        let mut momenta = Vec::new();
        let mut velocities = Vec::new();
        let mut kinetic = Vec::new();
        let mut masses = Vec::new();
        for block in blocks {
            let form = self.form(block)?;
            let (matrix, right) = (form.matrix.clone(), form.right.clone());
            let solved = form
                .solve(self.model)
                .map_err(|singular| self.explain(block, singular))?;
            masses.push(Mass {
                domain: block.domain,
                elements: block.elements.clone(),
                matrix,
                right,
                order: solved.order,
                energy: solved.energy,
            });
            kinetic.push(match block.domain {
                Some(domain) => self.model.dag.reduce(domain, solved.energy),
                None => solved.energy,
            });
            for (at, &element) in block.elements.iter().enumerate() {
                let component = |value| ElementMap {
                    element,
                    domain: block.domain,
                    value,
                };
                momenta.push(component(block.momenta[at]));
                velocities.push(component(solved.velocities[at]));
            }
        }
        let minus_potential = at_rest(&mut self.model.dag, lagrangian);
        let dag = &mut self.model.dag;
        let kinetic = dag.add(&kinetic);
        // −(a − b) term by term, as one would write it.
        let mut terms = Vec::new();
        let mut constant = Rational::ZERO;
        match dag.kind(minus_potential) {
            Kind::Sum(c, parts) => {
                constant = c.neg();
                terms.extend(parts.iter().map(|(k, part)| (k.neg(), *part)));
            }
            _ => terms.push((Rational::MINUS_ONE, minus_potential)),
        }
        let potential = (constant.clone(), terms.clone());
        terms.insert(0, (Rational::ONE, kinetic));
        let hamiltonian = dag.linear(&constant, &terms);
        Ok(Legendre {
            hamiltonian,
            momenta,
            velocities,
            lagrangian,
            masses,
            potential,
        })
    }

    /// M and p − b of a block.
    fn form(&mut self, block: &Velocities) -> Result<QuadraticForm, String> {
        let zero = self.model.dag.integer(0);
        let count = block.elements.len();
        let mut matrix = vec![vec![zero; count]; count];
        let mut right = Vec::with_capacity(count);
        for (i, &momentum) in block.momenta.iter().enumerate() {
            let slopes = diff::gradient(&mut self.model.dag, momentum, Dependence::P);
            for (j, &velocity) in block.elements.iter().enumerate().skip(i) {
                let slope = slopes
                    .iter()
                    .find(|(leaf, _)| *leaf == velocity)
                    .map_or(zero, |(_, slope)| *slope);
                let mut entry = at_rest(&mut self.model.dag, slope);
                let difference = self.model.dag.sub(slope, entry);
                if is_zero(self.model, difference) != Proof::Zero {
                    let one = self.name(block.elements[i], block.domain);
                    let other = self.name(velocity, block.domain);
                    return Err(format!(
                        "L is not quadratic in the velocities: its second derivative with respect to {one} and {other} depends on them"
                    ));
                }
                if let Some(k) = block.domain {
                    entry = elements::merged(&mut self.model.dag, entry, k);
                }
                matrix[i][j] = entry;
                matrix[j][i] = entry;
            }
            let offset = at_rest(&mut self.model.dag, momentum);
            right.push(self.model.dag.sub(block.elements[i], offset));
        }
        Ok(QuadraticForm {
            matrix,
            right,
            domain: block.domain,
        })
    }

    fn explain(&mut self, block: &Velocities, singular: Singular) -> String {
        let (rows, at) = match &singular {
            Singular::Empty(rows) | Singular::Dependent(rows) => (rows.clone(), None),
            Singular::Element { row, at, .. } | Singular::NoOrder { row, at } => {
                (vec![*row], Some(at))
            }
        };
        let names: Vec<String> = rows
            .iter()
            .map(|row| {
                let velocity = block.elements[*row];
                let dag = &mut self.model.dag;
                let velocity = match (array(dag, velocity), at) {
                    (Some(array), Some(at)) => dag.element(array, Index::plain(at.clone()), None),
                    _ => velocity,
                };
                self.name(velocity, block.domain)
            })
            .into_list();
        let names = names.join(" and ");
        match singular {
            Singular::Empty(_) | Singular::Element { is_alone: true, .. } => {
                format!("the mass matrix is singular: L has no term that is quadratic in {names}")
            }
            Singular::Dependent(_) | Singular::Element { .. } => format!(
                "the mass matrix is singular: the momentum of {names} is determined by the other momenta"
            ),
            Singular::NoOrder { .. } => format!(
                "no formula gives the velocities of all elements: its divisor would be 0 for {names}"
            ),
        }
    }

    /// A velocity as the user wrote it, in backticks.
    fn name(&self, element: Node, domain: Option<Domain>) -> String {
        let mut named = self.model.clone();
        for group in &mut named.groups {
            if let Some(velocity) = group.velocity.take() {
                group.momentum = velocity;
            }
        }
        let bound: Vec<(Domain, &str)> = domain.iter().map(|d| (*d, "k")).into_list();
        format!(
            "`{}`",
            print::write_within(&named, element, Notation::Text, &bound)
        )
    }
}

/// The array an element is of.
fn array(dag: &Dag, element: Node) -> Option<Array> {
    match dag.kind(element) {
        Kind::Element(array, ..) => Some(*array),
        _ => None,
    }
}

impl Velocities {
    fn push(&mut self, dag: &mut Dag, element: Node, leaves: &[(Node, Node)]) {
        let zero = dag.integer(0);
        let momentum = leaves
            .iter()
            .find(|(leaf, _)| *leaf == element)
            .map_or(zero, |(_, adjoint)| *adjoint);
        self.elements.push(element);
        self.momenta.push(momentum);
    }
}

/// The expression where all velocities are 0, with factors that differentiation kept apart
/// cancelled.
fn at_rest(dag: &mut Dag, root: Node) -> Node {
    let still = dag.substitute(root, |dag, node| match dag.kind(node) {
        Kind::Element(Array::Phase(Column { side: Side::P, .. }), ..) => Some(dag.integer(0)),
        _ => None,
    });
    dag.rebuilt(still)
}
