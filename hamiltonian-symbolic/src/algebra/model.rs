//! A Hamiltonian as mathematics: the arena with the names and shapes of what its leaves mean.
//!
//! Input: the checked definition. Output: [`Model`], from which `pipeline` makes a program and
//! `print` makes text. Invariant: numbers of groups, parameters, sizes and external functions used
//! in the arena index the lists here.

mod flow;

pub(crate) use flow::{EXPONENTIAL, NamedMotion};
pub use flow::{ExactFlow, Motion, Move, Piece};

use crate::dag::{Array, Column, Dag, Dependence, Node, Side};
use crate::diff;
use crate::index::{Affine, Index};
use crate::list::IntoList;
use std::fmt::Display;

/// The shape of a parameter, or, with columns of a literal number `C`, of a group of coordinates.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Shape<C = Affine> {
    /// One number.
    Scalar,
    /// `[rows]`
    Vector(Affine),
    /// `[rows][columns]`
    Matrix(Affine, C),
    /// `[a][b][c]…`: the number of elements, which are a vector, row after row, to everything that does not name
    /// them, and the extents.
    Lattice(Affine, Vec<Affine>),
}

impl<C> Shape<C> {
    /// The rows of an array; of a lattice the elements.
    #[must_use]
    pub fn rows(&self) -> Option<&Affine> {
        match self {
            Shape::Scalar => None,
            Shape::Vector(rows) | Shape::Matrix(rows, _) | Shape::Lattice(rows, _) => Some(rows),
        }
    }
    /// The extents of a lattice; none of others.
    #[must_use]
    pub fn axes(&self) -> &[Affine] {
        match self {
            Shape::Lattice(_, axes) => axes,
            _ => &[],
        }
    }
    /// Changes the number of rows, and the extents of a lattice.
    pub fn for_each_extent(&mut self, mut change: impl FnMut(&mut Affine)) {
        match self {
            Shape::Scalar => {}
            Shape::Vector(rows) | Shape::Matrix(rows, _) => change(rows),
            Shape::Lattice(rows, axes) => {
                change(rows);
                axes.iter_mut().for_each(change);
            }
        }
    }
    /// `q`, `q[2]`, `q[2][0]`
    pub fn element(&self, name: &str, row: impl Display, column: impl Display) -> String {
        match self {
            Shape::Scalar => name.to_owned(),
            Shape::Vector(_) | Shape::Lattice(..) => format!("{name}[{row}]"),
            Shape::Matrix(..) => format!("{name}[{row}][{column}]"),
        }
    }
}

impl Shape<u16> {
    /// The number of columns; 1 of all but matrices.
    #[must_use]
    pub fn columns(&self) -> u16 {
        match self {
            Shape::Matrix(_, columns) => *columns,
            _ => 1,
        }
    }
    /// Rows, 1 of a scalar, and columns, where the rows are literal.
    #[must_use]
    pub fn literal(&self) -> Option<(i64, u16)> {
        let rows = self.rows().map_or(Some(1), Affine::as_constant)?;
        Some((rows, self.columns()))
    }
    /// The shape as one that a parameter may have.
    #[must_use]
    pub fn of_parameter(&self) -> Shape {
        match self {
            Shape::Scalar => Shape::Scalar,
            Shape::Vector(rows) => Shape::Vector(rows.clone()),
            Shape::Matrix(rows, columns) => {
                Shape::Matrix(rows.clone(), Affine::constant(i64::from(*columns)))
            }
            Shape::Lattice(elements, axes) => Shape::Lattice(elements.clone(), axes.clone()),
        }
    }
}

/// A group of coordinates with its conjugate momenta.
#[derive(Clone, Debug)]
pub struct Group {
    /// The coordinate's name.
    pub coordinate: String,
    /// The momentum's name.
    pub momentum: String,
    /// The velocity's name, of a Lagrangian.
    pub velocity: Option<String>,
    /// The shape of all.
    pub shape: Shape<u16>,
}

/// The indices of an element that is given by its number, of an array with these axes.
fn places(axes: &[i64], element: i64) -> Vec<i64> {
    let mut rest = element;
    let mut places: Vec<i64> = (axes.iter().rev())
        .map(|extent| {
            let place = rest.rem_euclid((*extent).max(1));
            rest = rest.div_euclid((*extent).max(1));
            place
        })
        .into_list();
    places.reverse();
    places
}

impl Group {
    /// A coordinate and its momentum.
    pub fn scalar(coordinate: impl Into<String>, momentum: impl Into<String>) -> Group {
        Group {
            coordinate: coordinate.into(),
            momentum: momentum.into(),
            velocity: None,
            shape: Shape::Scalar,
        }
    }
    /// The name of one side.
    #[must_use]
    pub fn name(&self, side: Side) -> &str {
        match side {
            Side::Q => &self.coordinate,
            Side::P => &self.momentum,
        }
    }
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct ParameterDeclaration {
    /// The name it is printed by.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
}

/// A function written in Rust.
#[derive(Clone, Debug)]
pub struct External {
    /// Its name inside the mathematics.
    pub name: String,
    /// The names of its arguments.
    pub arguments: Vec<String>,
}

/// The declaration of a named function of (t, q, p).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ObservableKind {
    /// `monitor`
    Monitor,
    /// `invariant`
    Invariant,
    /// `event`
    Event,
}

impl ObservableKind {
    /// The word that declares it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            ObservableKind::Invariant => "invariant",
            ObservableKind::Monitor => "monitor",
            ObservableKind::Event => "event",
        }
    }
}

/// The number of the group that is to replace a group of bodies, less the number of that group: nodes that
/// are carried may read it before the change. A model has at most so many groups.
pub const REPLACING: u16 = 1 << 15;

/// A named function of (t, q, p): one node a component.
#[derive(Clone, Debug)]
pub struct Observable {
    /// The name it is recorded by.
    pub name: String,
    /// Its declaration.
    pub kind: ObservableKind,
    /// Its components; one for a scalar.
    pub components: Vec<Node>,
}

/// A vector of (q, p, t): velocities, momenta, a force, the gradient of an event, a change of
/// coordinates.
#[derive(Clone, Debug)]
pub struct VectorFunction {
    /// Its use.
    pub usage: VectorUse,
    /// The contributions to its elements, in every iteration of the loops of value and row. Elements
    /// not named are 0.
    pub entries: Vec<VectorEntry>,
}

/// The use of a vector function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VectorUse {
    /// p(q, v)
    ConjugateMomentum,
    /// v(q, p)
    Velocity,
    /// The force on the momenta.
    Force,
    /// The gradient of the observable of this number.
    Gradient(usize),
    /// The coordinates and momenta the system is integrated in, from the declared ones.
    FromDeclared,
    /// The declared coordinates and momenta.
    ToDeclared,
    /// The momenta on the shell of an extended phase space, that of time among them.
    OnShell,
}

impl VectorUse {
    /// True if it has a part shaped like the coordinates, and the same for the momenta.
    #[must_use]
    pub fn sides(self) -> (bool, bool) {
        match self {
            VectorUse::Velocity => (true, false),
            VectorUse::ConjugateMomentum | VectorUse::Force | VectorUse::OnShell => (false, true),
            VectorUse::Gradient(_) | VectorUse::FromDeclared | VectorUse::ToDeclared => {
                (true, true)
            }
        }
    }

    /// The name of its method; that of a gradient has the name of its observable before it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            VectorUse::ConjugateMomentum => "conjugate_momentum",
            VectorUse::Velocity => "velocity",
            VectorUse::Force => "force",
            VectorUse::Gradient(_) => "gradient",
            VectorUse::FromDeclared => "from_declared",
            VectorUse::ToDeclared => "to_declared",
            VectorUse::OnShell => "on_shell",
        }
    }
}

/// A contribution to an element of a vector function.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct VectorEntry {
    /// The column.
    pub at: Column,
    /// The row.
    pub row: Index,
    /// The contribution, in terms of the loops of the row.
    pub value: Node,
}

/// A system.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The arena.
    pub dag: Dag,
    /// The system's name.
    pub name: String,
    /// Coordinates and momenta.
    pub groups: Vec<Group>,
    /// Parameters.
    pub parameters: Vec<ParameterDeclaration>,
    /// Names of sizes: const generics and run-time sizes.
    pub sizes: Vec<String>,
    /// The name of time, where it was declared.
    pub time: Option<String>,
    /// The name of what orbits are functions of where that is not time: s of dt = g ds.
    pub evolution: Option<String>,
    /// Functions written in Rust.
    pub externals: Vec<External>,
    /// Monitors, invariants and events in declaration order.
    pub observables: Vec<Observable>,
    /// Vector functions the system offers.
    pub vectors: Vec<VectorFunction>,
    /// The force on momenta, element by element: ṗ = f − ∂H/∂q.
    pub force: Vec<VectorEntry>,
    /// H.
    pub hamiltonian: Option<Node>,
    /// The pieces of H that were declared, in order; none without a `split`.
    pub split: Vec<Node>,
    /// g of `dt = g*ds`.
    pub factor: Option<Node>,
    /// The pieces of H with exact flows, outermost first; none where H is not split.
    pub pieces: Vec<Piece>,
}

impl Model {
    /// The number of coordinates and momenta together, if all sizes are literal.
    #[must_use]
    pub fn components(&self) -> Option<usize> {
        let count = |group: &Group| {
            let (rows, columns) = group.shape.literal()?;
            usize::try_from(2 * i64::from(columns) * rows).ok()
        };
        self.groups.iter().map(count).sum()
    }
    /// The scalar coordinate or momentum of a scalar group.
    pub fn scalar(&mut self, side: Side, group: usize) -> Node {
        self.dag
            .phase(Column::first(side, group as u16), Index::constant(0))
    }
    /// The columns of all groups on one side, with their rows; none of a scalar.
    #[must_use]
    pub fn columns(&self, side: Side) -> Vec<(Column, Option<Affine>)> {
        let groups = self.groups.iter().zip(0..);
        let of_group = |(declared, group): (&Group, u16)| {
            let rows = declared.shape.rows().cloned();
            let of = move |column| {
                (
                    Column {
                        side,
                        group,
                        column,
                    },
                    rows.clone(),
                )
            };
            (0..declared.shape.columns()).map(of)
        };
        groups.flat_map(of_group).into_list()
    }
    /// The group of a column; a group that replaces another has its shape.
    pub(super) fn group_of(&self, group: u16) -> &Group {
        &self.groups[usize::from(group % REPLACING)]
    }
    /// The extents of a lattice; none of other arrays.
    #[must_use]
    pub fn axes(&self, array: Array) -> &[Affine] {
        match array {
            Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => {
                self.group_of(at.group).shape.axes()
            }
            Array::Parameter(parameter) => self.parameters[usize::from(parameter.0)].shape.axes(),
            Array::Hoisted(_) => &[],
        }
    }
    /// The indices of all axes, the first one first: of a lattice those of the element that an index is the number
    /// of.
    #[must_use]
    pub fn places(&self, array: Array, row: &Index) -> Vec<Index> {
        let axes: Option<Vec<i64>> = self.axes(array).iter().map(Affine::as_constant).collect();
        match (axes, row.as_constant()) {
            (Some(axes), Some(element)) if !axes.is_empty() => {
                let places = places(&axes, element).into_iter();
                places.map(Index::constant).into_list()
            }
            _ => row.axes(),
        }
    }
    /// The name of an element of the array `name`, given its row (of a lattice the number of the element) and
    /// column, and what extents are.
    #[must_use]
    pub fn element(
        &self,
        name: &str,
        array: Array,
        [row, column]: [i64; 2],
        extent: impl Fn(&Affine) -> i64,
    ) -> String {
        let axes: Vec<i64> = self.axes(array).iter().map(extent).into_list();
        match axes.as_slice() {
            [] => self.shape(array).element(name, row, column),
            axes => {
                (places(axes, row).iter()).fold(name.to_owned(), |name, at| format!("{name}[{at}]"))
            }
        }
    }
    /// The shape of an array.
    #[must_use]
    pub fn shape(&self, array: Array) -> Shape {
        match array {
            Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => {
                self.group_of(at.group).shape.of_parameter()
            }
            Array::Parameter(parameter) => self.parameters[usize::from(parameter.0)].shape.clone(),
            Array::Hoisted(_) => unreachable!("only programs read hoisted arrays"),
        }
    }
    /// The name of an array.
    #[must_use]
    pub fn array_name(&self, array: Array) -> String {
        match array {
            Array::Phase(at) => self.group_of(at.group).name(at.side).to_owned(),
            Array::Direction(at) => {
                format!("v_{}", self.group_of(at.group).name(at.side))
            }
            Array::Velocity(at) => {
                let group = &self.groups[usize::from(at.group)];
                let derivative = || format!("d{}/dt", group.coordinate);
                group.velocity.clone().unwrap_or_else(derivative)
            }
            Array::Parameter(parameter) => self.parameters[usize::from(parameter.0)].name.clone(),
            Array::Hoisted(_) => unreachable!("only programs read hoisted arrays"),
        }
    }
    /// H.
    ///
    /// # Panics
    /// If there is none: a model without H has no dynamics.
    #[must_use]
    pub fn h(&self) -> Node {
        self.hamiltonian.expect("a model of dynamics has an H")
    }
    /// The components of all invariants.
    pub(crate) fn invariants(&self) -> Vec<Node> {
        let all = self.observables.iter();
        let all = all.filter(|one| one.kind == ObservableKind::Invariant);
        all.flat_map(|one| one.components.clone()).into_list()
    }
    /// H and the components of observables.
    #[must_use]
    pub fn functions(&self) -> Vec<Node> {
        let observables = self.observables.iter().flat_map(|o| &o.components);
        self.hamiltonian
            .iter()
            .chain(observables)
            .copied()
            .into_list()
    }
    /// All expressions: [`Model::functions`], the declared pieces, the factor of time, then the
    /// entries of the force and of vector functions.
    #[must_use]
    pub fn roots(&self) -> Vec<Node> {
        let vectors = self.vectors.iter().flat_map(|v| &v.entries);
        let entries = self.force.iter().chain(vectors).map(|entry| entry.value);
        let declared = self.split.iter().chain(&self.factor).copied();
        let functions = self.functions().into_iter();
        functions.chain(declared).chain(entries).into_list()
    }
    /// Puts other expressions in the places of [`Model::roots`], or of as many as are given.
    pub fn set_roots(&mut self, roots: &[Node]) {
        let vectors = self.vectors.iter_mut().flat_map(|v| &mut v.entries);
        let entries = self.force.iter_mut().chain(vectors);
        let places = (self.hamiltonian.iter_mut())
            .chain(self.observables.iter_mut().flat_map(|o| &mut o.components))
            .chain(self.split.iter_mut().chain(&mut self.factor))
            .chain(entries.map(|entry| &mut entry.value));
        for (place, root) in places.zip(roots) {
            *place = *root;
        }
    }
    /// The partial derivatives of a scalar by coordinates and momenta, element by element.
    #[must_use]
    pub fn partials(&mut self, root: Node) -> Vec<VectorEntry> {
        let both = Dependence(Dependence::Q.0 | Dependence::P.0);
        let adjoints = diff::gradient(&mut self.dag, root, both);
        let entry = |(leaf, value): (Node, Node)| {
            let place = self.dag.phase_place(leaf);
            let (at, row) = place.expect("leaves of phase space are elements of it");
            let row = row.clone();
            VectorEntry { at, row, value }
        };
        adjoints.into_iter().map(entry).into_list()
    }
    /// The name of time: the declared one, or `t`.
    #[must_use]
    pub fn time_name(&self) -> &str {
        self.time.as_deref().unwrap_or("t")
    }
    /// Returns true if something is declared under a name.
    #[must_use]
    pub fn declares(&self, name: &str) -> bool {
        let of_group = |g: &Group| {
            g.coordinate == name || g.momentum == name || g.velocity.as_deref() == Some(name)
        };
        self.groups.iter().any(of_group)
            || self.parameters.iter().any(|p| p.name == name)
            || self.sizes.iter().any(|s| s == name)
            || self.externals.iter().any(|e| e.name == name)
            || self.observables.iter().any(|o| o.name == name)
            || self.time.as_deref() == Some(name)
    }
}
