//! The input of everything that is written of a system.
//!
//! Input: a definition with its generics. Output: [`Context`], which every other file reads.
//! Invariant: it is small and copied; a copy with other variables or another order of loops writes
//! other text from the same program.

use super::generics::Generics;
use super::index::Indices;
use super::layout::{Layout, Slice, layout};
use crate::emit::definition::Definition;
use hamiltonian_symbolic::dag::Array;
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{Group, Model, Shape};
use hamiltonian_symbolic::program::{Program, Target};

/// The text of the zero of the scalar type `T`.
pub const ZERO: &str = "T::constant(0.0, 0.0)";

/// The input of the text of a system.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// The definition.
    pub definition: &'a Definition<'a>,
    /// Its generic parameters.
    pub generics: &'a Generics,
    /// The mathematics.
    pub model: &'a Model,
    /// The instructions.
    pub program: &'a Program,
    /// The groups of coordinates that are stored: those of the model, or the declared ones.
    pub groups: &'a [Group],
    /// Their storage.
    pub layout: Layout,
    /// The suffix of the system's name in that of the struct of coordinates of mixed shape.
    pub suffix: &'static str,
    /// The names of sizes inside bodies.
    pub indices: Indices<'a>,
    /// True for each size that is set at run time.
    pub is_run_time: &'a [bool],
    /// Access to the point of a body.
    pub access: Access,
}

/// Access to the point of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// Inputs and outputs are different vectors.
    Apart,
    /// Coordinates and momenta are read where they are written: iterations see the results
    /// of those before them.
    InPlace,
    /// The same, with loops from their last iteration to the first.
    Reversed,
}

impl<'a> Context<'a> {
    /// The context of a definition.
    pub fn of(definition: &'a Definition<'a>, generics: &'a Generics) -> Context<'a> {
        Context {
            definition,
            generics,
            model: definition.model,
            program: definition.program,
            groups: &definition.model.groups,
            layout: layout(&definition.model.groups),
            suffix: "Vector",
            indices: Indices {
                sizes: &generics.sizes,
            },
            is_run_time: &generics.is_run_time,
            access: Access::Apart,
        }
    }

    /// The numbers of the sizes that are set at run time.
    pub fn run_time_sizes(self) -> impl Iterator<Item = usize> + 'a {
        let sizes = self.is_run_time;
        (0..sizes.len()).filter(move |size| sizes[*size])
    }

    /// Returns true if any size is set at run time.
    pub fn has_run_time_sizes(self) -> bool {
        self.is_run_time.contains(&true)
    }

    /// Returns true if a Rust function is a parameter; these are the first ones.
    pub fn is_parameter(self, function: u16) -> bool {
        usize::from(function) < self.generics.functions.len()
    }

    /// An array parameter of `_self` over `T`.
    pub fn lifted(self, parameter: u16) -> String {
        format!(
            "{}.map(__h::Parameter::into_real::<T>)",
            self.of_parameter(parameter)
        )
    }

    /// An array parameter of `_self`.
    pub fn of_parameter(self, parameter: u16) -> String {
        let shape = &self.model.parameters[usize::from(parameter)].shape;
        let field = format!("_self.{}", self.generics.field(parameter));
        self.stored(shape, &field)
    }

    /// The number of an element where it is read; that of a matrix of parameters counts row after row.
    pub fn number(self, array: Array, row: &Index, column: Option<&Index>) -> Index {
        if let (Array::Parameter(parameter), Some(column)) = (array, column)
            && let Shape::Matrix(_, columns) =
                &self.model.parameters[usize::from(parameter.0)].shape
        {
            return row.clone().row_of(columns.clone(), column.clone());
        }
        row.clone()
    }

    /// The slice an array's elements are read from.
    pub fn read(self, array: Array) -> Slice {
        match array {
            Array::Phase(column) if self.access != Access::Apart => {
                Slice::write(self.layout, Target::Phase(column))
            }
            _ => Slice::read(self.layout, array),
        }
    }
}
