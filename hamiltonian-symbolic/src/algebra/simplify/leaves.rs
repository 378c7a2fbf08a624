//! Leaves: numbers, parameters, elements, sizes and indices as expressions.

use crate::dag::{Array, Column, Dag, Kind, Node, Parameter, Side, StandIn};
use crate::index::{Affine, Domain, Index, Size};
use crate::list::IntoList;
use crate::rational::Rational;

impl Dag {
    /// An exact number.
    pub fn constant(&mut self, value: Rational) -> Node {
        self.intern(Kind::Constant(value))
    }
    /// An integer.
    pub fn integer(&mut self, value: i64) -> Node {
        self.constant(Rational::integer(value))
    }
    /// π.
    pub fn pi(&mut self) -> Node {
        self.intern(Kind::Pi)
    }
    /// A scalar parameter.
    pub fn parameter(&mut self, parameter: Parameter) -> Node {
        self.intern(Kind::Scalar(parameter))
    }
    /// A node in the place of another.
    pub(crate) fn stand_in(&mut self, what: StandIn) -> Node {
        self.intern(Kind::StandIn(what))
    }
    /// Time.
    pub fn time(&mut self) -> Node {
        self.intern(Kind::Time)
    }
    /// The coefficient of an accumulating kick, drift or flow.
    pub fn coefficient(&mut self) -> Node {
        self.intern(Kind::Coefficient)
    }
    /// An array element.
    pub fn element(&mut self, array: Array, row: Index, column: Option<Index>) -> Node {
        self.intern(Kind::Element(array, row, column.map(Box::new)))
    }
    /// An element of phase space.
    pub fn phase(&mut self, column: Column, row: Index) -> Node {
        self.element(Array::Phase(column), row, None)
    }
    /// The momentum in the place of a velocity, as the Legendre transform takes velocities.
    pub fn momentum_in_place(&mut self, node: Node) -> Option<Node> {
        match self.kind(node).clone() {
            Kind::Element(Array::Velocity(column), row, _) => {
                Some(self.phase(column.on(Side::P), row))
            }
            _ => None,
        }
    }
    /// A size as a real.
    pub fn extent(&mut self, size: Size) -> Node {
        self.intern(Kind::Extent(size))
    }
    /// A loop variable as a real.
    pub fn variable(&mut self, domain: Domain) -> Node {
        self.intern(Kind::Variable(domain))
    }
    /// An affine index as a real.
    pub fn affine(&mut self, affine: &Affine) -> Node {
        let mut terms = Vec::new();
        for &(domain, k) in &affine.loops {
            let node = self.variable(domain);
            terms.push((Rational::integer(k), node));
        }
        for &(size, k) in &affine.sizes {
            let node = self.extent(size);
            terms.push((Rational::integer(k), node));
        }
        for (sizes, k) in &affine.products {
            let factors: Vec<Node> = sizes.iter().map(|size| self.extent(*size)).into_list();
            let node = self.mul(&factors);
            terms.push((Rational::integer(*k), node));
        }
        self.linear(&Rational::integer(affine.constant), &terms)
    }
}
