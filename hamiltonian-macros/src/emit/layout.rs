//! Storage of coordinates and parameter arrays, and access to the numbers in function bodies.
//!
//! Input: the groups and shapes of a model. Output: types as text, and the bindings of slices at
//! the top of a function body. Invariant: element (row, column) of a column-major array is `row`
//! of the slice of its column; scalar coordinates share one vector, in the order of their groups.

use super::context::{Context, ZERO};
use super::mixed;
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::{Group, Shape};
use hamiltonian_symbolic::program::Target;
use std::fmt::Write;

/// The storage of the coordinates of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Scalars only: one static vector.
    Scalars,
    /// One group with extents: one vector or matrix.
    Array,
    /// Anything else: a generated struct with one part a group.
    Mixed,
}

/// The column of the vector that is stored: scalar coordinates share one.
fn stored(layout: Layout, column: Column) -> Column {
    match layout {
        Layout::Scalars => Column { group: 0, ..column },
        Layout::Array | Layout::Mixed => column,
    }
}

/// The storage of a group.
pub fn layout(groups: &[Group]) -> Layout {
    if groups.iter().all(|group| group.shape == Shape::Scalar) {
        Layout::Scalars
    } else if groups.len() == 1 {
        Layout::Array
    } else {
        Layout::Mixed
    }
}

impl Context<'_> {
    /// Whether an extent is set at run time.
    fn is_set_at_run_time(self, extent: &Affine) -> bool {
        let mut sizes = extent.sizes.iter();
        sizes.any(|(size, _)| self.is_run_time[usize::from(size.0)])
    }

    /// Whether any extent of a shape is set at run time.
    pub fn is_dynamic(self, shape: &Shape) -> bool {
        match shape {
            Shape::Scalar => false,
            Shape::Vector(rows) => self.is_set_at_run_time(rows),
            Shape::Matrix(rows, columns) => {
                self.is_set_at_run_time(rows) || self.is_set_at_run_time(columns)
            }
        }
    }

    /// Whether the number of columns is set at run time.
    pub fn has_dynamic_columns(self, shape: &Shape) -> bool {
        matches!(shape, Shape::Matrix(_, columns) if self.is_set_at_run_time(columns))
    }

    /// Rows and columns as expressions.
    pub fn extents(self, shape: &Shape) -> (String, String) {
        let extent = |extent: &Affine| self.indices.plain(extent);
        match shape {
            Shape::Scalar => ("1usize".into(), "1usize".into()),
            Shape::Vector(rows) => (extent(rows), "1usize".into()),
            Shape::Matrix(rows, columns) => (extent(rows), extent(columns)),
        }
    }

    /// The type of an array of `scalar`s.
    pub fn storage(self, shape: &Shape, scalar: &str) -> String {
        let text = |extent: &Affine| self.constant_extent(extent);
        match shape {
            Shape::Scalar => scalar.to_owned(),
            Shape::Vector(_) if self.is_dynamic(shape) => format!("__h::DVector<{scalar}>"),
            Shape::Vector(rows) => format!("__h::SVector<{scalar}, {}>", text(rows)),
            Shape::Matrix(rows, columns) if self.is_dynamic(shape) => {
                let dimension = |extent| match self.is_set_at_run_time(extent) {
                    true => "__h::Dyn".to_owned(),
                    false => format!("__h::Const<{}>", text(extent)),
                };
                let shape = format!("{scalar}, {}, {}", dimension(rows), dimension(columns));
                format!("__h::Matrix<{shape}, __h::VecStorage<{shape}>>")
            }
            Shape::Matrix(rows, columns) => {
                format!("__h::SMatrix<{scalar}, {}, {}>", text(rows), text(columns))
            }
        }
    }

    /// An extent as a const generic argument: a literal or a name.
    fn constant_extent(self, extent: &Affine) -> String {
        match extent.as_constant() {
            Some(value) => value.to_string(),
            None => self.indices.plain(extent),
        }
    }

    /// The expression of an array of zeros of that shape.
    pub fn zero(self, shape: &Shape) -> String {
        let dimension = |extent: &Affine| match self.is_set_at_run_time(extent) {
            true => format!("__h::Dyn({})", self.indices.plain(extent)),
            false => format!("__h::Const::<{}>", self.constant_extent(extent)),
        };
        let (rows, columns) = match shape {
            Shape::Scalar => return ZERO.to_owned(),
            Shape::Vector(rows) => (dimension(rows), "__h::Const::<1>".to_owned()),
            Shape::Matrix(rows, columns) => (dimension(rows), dimension(columns)),
        };
        format!("__h::Matrix::from_element_generic({rows}, {columns}, {ZERO})")
    }

    /// The type of coordinates and of momenta over `T`.
    pub fn vector(self) -> String {
        match self.layout {
            Layout::Scalars => format!("__h::SVector<T, {}>", self.groups.len()),
            Layout::Array => self.storage(&self.groups[0].shape.of_parameter(), "T"),
            Layout::Mixed => mixed::ty(self),
        }
    }

    /// The expression of the zero vector, where run-time sizes are called as in bodies.
    pub fn zeros(self) -> String {
        let zero = |group: &Group| self.zero(&group.shape.of_parameter());
        let groups = self.groups;
        match self.layout {
            Layout::Scalars => {
                let n = groups.len();
                format!("__h::SVector::<T, {n}>::from_element({ZERO})")
            }
            Layout::Array => zero(&groups[0]),
            Layout::Mixed => {
                let field = |group: &Group| format!("{}: {}", group.coordinate, zero(group));
                let fields: Vec<String> = groups.iter().map(field).collect();
                format!("{} {{ {} }}", mixed::name(self), fields.join(", "))
            }
        }
    }

    /// The `let`s that bind slices at the top of a body. `slices` is sorted.
    pub fn bind(self, out: &mut String, slices: &[Slice]) {
        let part = |slice: &Slice| part_of(*slice).map(|(_, at)| (slice.vector(), at.group));
        for run in slices.chunk_by(|a, b| part(a) == part(b)) {
            let Some((mutable, Column { group, .. })) = part_of(run[0]) else {
                continue;
            };
            let vector = run[0].vector();
            let (suffix, borrow) = if mutable {
                ("_mut", "mut")
            } else {
                ("", "ref")
            };
            let Group {
                shape, coordinate, ..
            } = &self.groups[usize::from(group)];
            // Two parts of one vector are borrowed at once only as fields.
            let whole = match (self.layout, shape) {
                (Layout::Mixed, Shape::Scalar) => {
                    let reference = if mutable { "&mut " } else { "&" };
                    format!("__h::core::slice::from_{borrow}({reference}{vector}.{coordinate})")
                }
                (Layout::Mixed, _) => format!("{vector}.{coordinate}.as{suffix}_slice()"),
                _ => format!("__h::Vector::part{suffix}({vector}, 0)"),
            };
            let is_cut = shape.columns() > 1 || self.is_dynamic(&shape.of_parameter());
            let _ = match shape.rows() {
                Some(rows) if self.layout != Layout::Scalars && is_cut => {
                    let rows = self.indices.plain(rows);
                    let name = |column| {
                        let is_it = |slice: &&Slice| {
                            part_of(**slice).is_some_and(|(_, at)| at.column == column)
                        };
                        run.iter()
                            .find(is_it)
                            .map_or("_".to_owned(), |slice| slice.name())
                    };
                    let names: Vec<String> = (0..shape.columns()).map(name).collect();
                    let names = names.join(", ");
                    writeln!(
                        out,
                        "let [{names}] = __h::columns{suffix}({whole}, {rows});"
                    )
                }
                _ => writeln!(out, "let {} = {whole};", run[0].name()),
            };
        }
    }
}

/// A slice that a function body reads or writes: a column of a group, a parameter array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slice {
    /// Coordinates or momenta.
    Input(Column),
    /// The direction of a Hessian product.
    Direction(Column),
    /// A parameter array.
    Parameter(u16),
    /// An output vector.
    Output(Column),
    /// The derivative with respect to a parameter.
    Derivative(u16),
    /// An array that preparation filled.
    Held(u16),
    /// The same while it is filled.
    Filled(u16),
}

impl Slice {
    /// The slice an array's elements are read from.
    pub fn read(layout: Layout, array: Array) -> Slice {
        match array {
            Array::Phase(column) => Slice::Input(stored(layout, column)),
            Array::Direction(column) => Slice::Direction(stored(layout, column)),
            Array::Velocity(_) => unreachable!("`validate` finds velocities in a program"),
            Array::Parameter(Parameter(number)) => Slice::Parameter(number),
            Array::Held(number) => Slice::Held(number),
        }
    }

    /// The slice a target's elements are written to.
    pub fn write(layout: Layout, target: Target) -> Slice {
        match target {
            Target::Phase(column) => Slice::Output(stored(layout, column)),
            Target::Parameter(Parameter(number)) => Slice::Derivative(number),
            Target::Held(number) => Slice::Filled(number),
        }
    }

    /// Its name in a function body.
    pub fn name(self) -> String {
        let number = match self {
            Slice::Input(at) | Slice::Direction(at) | Slice::Output(at) => {
                format!("{}_{}", at.group, at.column)
            }
            Slice::Parameter(number) => return format!("_a{number}"),
            Slice::Derivative(number) => return format!("_d{number}"),
            Slice::Held(number) => return format!("_h{number}"),
            Slice::Filled(number) => return format!("_u{number}"),
        };
        format!("{}{number}", self.vector())
    }

    /// The name of the vector it is a part of.
    fn vector(self) -> &'static str {
        match self {
            Slice::Input(at) if at.side == Side::Q => "_q",
            Slice::Input(_) => "_p",
            Slice::Direction(at) if at.side == Side::Q => "_vq",
            Slice::Direction(_) => "_vp",
            Slice::Output(at) if at.side == Side::Q => "_oq",
            Slice::Output(_) => "_op",
            _ => "",
        }
    }
}

/// Whether it is written, and its column; `None` for parameters.
fn part_of(slice: Slice) -> Option<(bool, Column)> {
    match slice {
        Slice::Input(column) | Slice::Direction(column) => Some((false, column)),
        Slice::Output(column) => Some((true, column)),
        _ => None,
    }
}
