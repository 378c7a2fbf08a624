//! A system with numbers: as the interpreter reads it, by name, and written out over scalars.

use super::System;
use crate::common;
use crate::sums::{Numbers, World, read};
use crate::tree::Random;
use hamiltonian_lanes::Real;
use hamiltonian_symbolic::dag::{Array, Column, Node, Parameter, Side};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::interpret::{Outcome, Point};
use hamiltonian_symbolic::model::{Group, Model, ParameterDeclaration, Shape};
use hamiltonian_symbolic::program::Target;
use std::collections::HashMap;
use std::marker::PhantomData;

/// One number of the system.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Place {
    Phase(Side, usize, usize, usize),
    Direction(Side, usize, usize, usize),
    /// Number, column, row.
    Parameter(usize, usize, usize),
    Time,
}

/// A system with numbers.
pub struct Instance {
    pub model: Model,
    pub n: usize,
    pub values: HashMap<Place, f64>,
    pub coefficient: f64,
    pub start: f64,
}

pub fn extents(shape: &Shape, n: usize) -> (usize, usize) {
    let value = |a: &Affine| usize::try_from(a.value(&|_| 0, &|_| n as i64)).unwrap();
    match shape {
        Shape::Scalar => (1, 1),
        Shape::Vector(rows) | Shape::Lattice(rows, _) => (value(rows), 1),
        Shape::Matrix(rows, columns) => (value(rows), value(columns)),
    }
}

impl Instance {
    pub fn new(system: &System, n: usize) -> Instance {
        let model = common::system(system.signature, "N", system.parameters, system.h);
        let mut random = Random(n as u64);
        let mut instance = Instance {
            n,
            values: HashMap::new(),
            coefficient: 0.3,
            start: 0.7,
            model,
        };
        for place in instance.places() {
            let positive = matches!(place, Place::Parameter(..) | Place::Time);
            let value = random.unit() * 2.0 - if positive { -0.5 } else { 1.0 };
            instance.values.insert(place, value);
        }
        instance
    }

    /// Every number, in order.
    pub fn places(&self) -> Vec<Place> {
        let mut all = vec![Place::Time];
        for (number, group) in self.model.groups.iter().enumerate() {
            let (rows, columns) = extents(&group.shape.of_parameter(), self.n);
            for side in [Side::Q, Side::P] {
                for column in 0..columns {
                    all.extend((0..rows).map(|row| Place::Phase(side, number, column, row)));
                    all.extend((0..rows).map(|row| Place::Direction(side, number, column, row)));
                }
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let (rows, columns) = extents(&parameter.shape, self.n);
            for column in 0..columns {
                all.extend((0..rows).map(|row| Place::Parameter(number, column, row)));
            }
        }
        all
    }

    /// The columns of one array.
    pub fn columns<T>(
        &self,
        shape: &Shape,
        place: impl Fn(usize, usize) -> Place,
        lift: &mut impl FnMut(Place, f64) -> T,
    ) -> Vec<Vec<T>> {
        let (rows, columns) = extents(shape, self.n);
        let mut column = |c: usize| {
            (0..rows)
                .map(|row| lift(place(c, row), self.values[&place(c, row)]))
                .collect()
        };
        (0..columns).map(&mut column).collect()
    }

    /// The values by name.
    pub fn world<T: Copy>(&self, mut lift: impl FnMut(Place, f64) -> T) -> World<T> {
        let mut world = World {
            values: HashMap::new(),
            sizes: HashMap::from([("N".to_owned(), self.n as i64)]),
            axes: HashMap::new(),
            loops: Vec::new(),
        };
        for (number, group) in self.model.groups.iter().enumerate() {
            for (side, name) in [(Side::Q, &group.coordinate), (Side::P, &group.momentum)] {
                let place = |column, row| Place::Phase(side, number, column, row);
                let columns = self.columns(&group.shape.of_parameter(), place, &mut lift);
                world.values.insert(name.clone(), columns);
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let place = |column, row| Place::Parameter(number, column, row);
            let columns = self.columns(&parameter.shape, place, &mut lift);
            world.values.insert(parameter.name.clone(), columns);
            let axes = parameter.shape.axes().iter();
            let axes = axes.map(|extent| extents(&Shape::Vector(extent.clone()), self.n).0);
            world.axes.insert(parameter.name.clone(), axes.collect());
        }
        let time = lift(Place::Time, self.values[&Place::Time]);
        world.values.insert("t".into(), vec![vec![time]]);
        world
    }

    /// H over a scalar.
    pub fn evaluate<T: Real>(&self, h: &str, lift: impl FnMut(Place, f64) -> T) -> T {
        self.world(lift)
            .evaluate(&mut Numbers::<T>(PhantomData), &read(h))
    }

    /// The point for the interpreter.
    pub fn point<T: Real>(&self, mut lift: impl FnMut(Place, f64) -> T) -> Point<T> {
        let mut point = Point::new();
        point.sizes = vec![self.n];
        point.c = lift(Place::Time, self.coefficient);
        point.t = lift(Place::Time, self.values[&Place::Time]);
        let start = lift(Place::Time, self.start);
        for (number, declared) in self.model.groups.iter().enumerate() {
            let (rows, columns) = extents(&declared.shape.of_parameter(), self.n);
            let group = number as u16;
            for side in [Side::Q, Side::P] {
                for at in 0..columns {
                    let column = at as u16;
                    let place = |row| Place::Phase(side, number, at, row);
                    let along = |row| Place::Direction(side, number, at, row);
                    let mut read = |place: &dyn Fn(usize) -> Place| {
                        let list = (0..rows).map(|r| lift(place(r), self.values[&place(r)]));
                        vec![list.collect::<Vec<T>>()]
                    };
                    point.arrays.insert(
                        Array::Phase(Column {
                            side,
                            group,
                            column,
                        }),
                        read(&place),
                    );
                    point.arrays.insert(
                        Array::Direction(Column {
                            side,
                            group,
                            column,
                        }),
                        read(&along),
                    );
                    point.outputs.insert(
                        Target::Phase(Column {
                            side,
                            group,
                            column,
                        }),
                        vec![vec![start; rows]],
                    );
                }
            }
        }
        for (number, parameter) in self.model.parameters.iter().enumerate() {
            let place = |column, row| Place::Parameter(number, column, row);
            let columns = self.columns(&parameter.shape, place, &mut lift);
            let (rows, count) = extents(&parameter.shape, self.n);
            point
                .scalars
                .push(columns[0].first().copied().unwrap_or(T::zero()));
            let number = Parameter(number as u16);
            point.arrays.insert(Array::Parameter(number), columns);
            let target = Target::Parameter(number);
            point.outputs.insert(target, vec![vec![start; rows]; count]);
        }
        point
    }

    /// The same system written out over scalars, and where each of its numbers stands here.
    pub fn written_out(&self, h: &str) -> (Model, Vec<[Place; 2]>, Vec<Place>) {
        let mut model = Model {
            name: "WrittenOut".into(),
            time: Some("t".into()),
            ..Model::default()
        };
        let mut leaves: HashMap<Place, Node> = HashMap::new();
        let (mut pairs, mut parameters) = (Vec::new(), Vec::new());
        for place in self.places() {
            match place {
                Place::Phase(Side::Q, group, column, row) => {
                    let momentum = Place::Phase(Side::P, group, column, row);
                    pairs.push([place, momentum]);
                    let number = model.groups.len();
                    let group = Group::scalar(format!("q{number}"), format!("p{number}"));
                    model.groups.push(group);
                    leaves.insert(place, model.scalar(Side::Q, number));
                    leaves.insert(momentum, model.scalar(Side::P, number));
                }
                Place::Parameter(..) => {
                    parameters.push(place);
                    let number = model.parameters.len();
                    model.parameters.push(ParameterDeclaration {
                        name: format!("a{number}"),
                        shape: Shape::Scalar,
                    });
                    leaves.insert(place, model.dag.parameter(Parameter(number as u16)));
                }
                Place::Time => {
                    leaves.insert(place, model.dag.time());
                }
                _ => {}
            }
        }
        let mut world = self.world(|place, _| leaves[&place]);
        model.hamiltonian = Some(world.evaluate(&mut model.dag, &read(h)));
        (model, pairs, parameters)
    }
}

/// The outputs of a function at a place.
pub fn at<T: Copy>(outcome: &Outcome<T>, place: Place) -> T {
    match place {
        Place::Phase(side, group, column, row) => {
            let (group, column) = (group as u16, column as u16);
            outcome.outputs[&Target::Phase(Column {
                side,
                group,
                column,
            })][0][row]
        }
        Place::Parameter(number, column, row) => {
            outcome.outputs[&Target::Parameter(Parameter(number as u16))][column][row]
        }
        Place::Time | Place::Direction(..) => outcome.results[0],
    }
}
