//! A Hamiltonian as mathematics: the arena with the names and shapes of what its leaves mean.
//!
//! Input: what the front end checked. Output: [`Model`], from which `pipeline` makes a program and
//! `print` makes text. Invariant: numbers of groups, parameters, sizes and external functions used
//! in the arena index the lists here.

use crate::dag::{Array, Dag, Node, Parameter, Side};
use crate::index::{Affine, Index};
use crate::split::Piece;

/// The shape of a group of coordinates or of a parameter.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Shape {
    /// One number.
    Scalar,
    /// `[rows]`
    Vector(Affine),
    /// `[rows][columns]`
    Matrix(Affine, Affine),
}

/// A group of coordinates with its conjugate momenta.
#[derive(Clone, Debug)]
pub struct Group {
    /// The coordinate's name.
    pub coordinate: String,
    /// The momentum's name.
    pub momentum: String,
    /// The shape of both; the columns of a matrix are a literal.
    pub shape: Shape,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct ParameterDeclaration {
    /// Its name.
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
    /// Whether its second derivatives were given.
    pub second: bool,
}

/// What a named function of (t, q, p) was declared as.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ObservableKind {
    /// `monitor`
    Monitor,
    /// `invariant`
    Invariant,
    /// `event`
    Event,
}

/// A named function of (t, q, p): one node a component.
#[derive(Clone, Debug)]
pub struct Observable {
    /// Its name.
    pub name: String,
    /// How it was declared.
    pub kind: ObservableKind,
    /// Its components; one for a scalar.
    pub components: Vec<Node>,
}

/// A vector of (q, p, t): velocities, momenta, a force, the gradient of an event, a change of
/// coordinates.
#[derive(Clone, Debug)]
pub struct VectorFunction {
    /// Its name.
    pub name: String,
    /// Whether it has a part shaped like the coordinates, and one shaped like the momenta.
    pub sides: (bool, bool),
    /// What is added to which element, in every iteration of the loops of value and row; elements
    /// not named are 0.
    pub entries: Vec<VectorEntry>,
}

/// A contribution to an element of a vector function.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct VectorEntry {
    /// The part.
    pub side: Side,
    /// The group.
    pub group: u16,
    /// The column of a rank-2 group; 0 otherwise.
    pub column: u16,
    /// The row.
    pub row: Index,
    /// The value.
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
    /// The pieces of H with exact flows, outermost first; none where H is not split.
    pub pieces: Vec<Piece>,
}

impl Model {
    /// The scalar coordinate or momentum of a scalar group.
    pub fn scalar(&mut self, side: Side, group: usize) -> Node {
        self.dag.element(
            Array::Phase {
                side,
                group: group as u16,
                column: 0,
            },
            Index::constant(0),
            None,
        )
    }
    /// Puts other expressions in the places of all of its own: `pass` is given them in a fixed order.
    pub fn map_roots(&mut self, pass: impl FnOnce(&mut Dag, &mut [Node])) {
        let places = (self.hamiltonian.iter_mut())
            .chain(self.observables.iter_mut().flat_map(|o| &mut o.components))
            .chain((self.vectors.iter_mut().flat_map(|v| &mut v.entries)).map(|e| &mut e.value));
        let mut places: Vec<&mut Node> = places.collect();
        let mut roots: Vec<Node> = places.iter().map(|place| **place).collect();
        pass(&mut self.dag, &mut roots);
        for (place, root) in places.iter_mut().zip(roots) {
            **place = root;
        }
    }
    /// The number of the parameter of that name.
    #[must_use]
    pub fn parameter_named(&self, name: &str) -> Option<Parameter> {
        self.parameters
            .iter()
            .position(|p| p.name == name)
            .map(|at| Parameter(at as u16))
    }
}
