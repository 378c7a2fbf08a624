//! Arrays of parameters and columns of phase space.
//!
//! Input: the groups of a model by number. Output: columns, and arrays. Invariant: equal arrays are the same
//! storage.

use super::Parameter;

/// The vector of phase space that an element belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Side {
    /// Coordinates.
    Q,
    /// Momenta.
    P,
}

impl Side {
    /// Momenta for coordinates, coordinates for momenta.
    #[must_use]
    pub fn other(self) -> Side {
        match self {
            Side::Q => Side::P,
            Side::P => Side::Q,
        }
    }
}

/// A column of phase space: component `column` (0 where there is one) of the coordinates or momenta
/// of group `group`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Column {
    /// Coordinates or momenta.
    pub side: Side,
    /// The group of coordinates.
    pub group: u16,
    /// The component of a rank-2 group.
    pub column: u16,
}

impl Column {
    /// The first component of a group.
    #[must_use]
    pub fn first(side: Side, group: u16) -> Column {
        let column = 0;
        Column {
            side,
            group,
            column,
        }
    }
    /// The conjugate component.
    #[must_use]
    pub fn conjugate(self) -> Column {
        self.on(self.side.other())
    }
    /// This component of coordinates or of momenta.
    #[must_use]
    pub fn on(self, side: Side) -> Column {
        Column { side, ..self }
    }
}

/// The array of an element.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Array {
    /// A column of the coordinates or momenta.
    Phase(Column),
    /// A component of the direction that a Hessian is multiplied with.
    Direction(Column),
    /// A parameter array; rank 2 is indexed by row and column.
    Parameter(Parameter),
    /// The velocities of a column of coordinates, in what was said of a Lagrangian: no program
    /// reads them.
    Velocity(Column),
    /// An array that preparation fills, by its number in the program.
    Hoisted(u16),
}
