//! How coordinates and parameter arrays are stored, and how function bodies get at the numbers.
//!
//! Input: the groups and shapes of a model. Output: types as text, and the bindings of slices at
//! the top of a function body. Invariant: element (row, column) of a column-major array is `row`
//! of the slice of its column; scalar coordinates share one vector, in the order of their groups.

use super::index::Indices;
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::{Group, Model, Shape};
use hamiltonian_symbolic::program::Target;

/// How the coordinates of a system are stored.
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

/// The size of an extent, if it is set at run time.
fn run_time(extent: &Affine, is_run_time: &[bool]) -> bool {
    extent
        .sizes
        .iter()
        .any(|(size, _)| is_run_time[usize::from(size.0)])
}

/// Whether any extent of a shape is set at run time.
pub fn is_dynamic(shape: &Shape, is_run_time: &[bool]) -> bool {
    match shape {
        Shape::Scalar => false,
        Shape::Vector(rows) => run_time(rows, is_run_time),
        Shape::Matrix(rows, columns) => {
            run_time(rows, is_run_time) || run_time(columns, is_run_time)
        }
    }
}

/// Whether the number of columns is set at run time.
pub fn has_dynamic_columns(shape: &Shape, is_run_time: &[bool]) -> bool {
    matches!(shape, Shape::Matrix(_, columns) if run_time(columns, is_run_time))
}

/// Rows and columns as expressions.
pub fn extents(shape: &Shape, indices: Indices) -> (String, String) {
    match shape {
        Shape::Scalar => ("1usize".into(), "1usize".into()),
        Shape::Vector(rows) => (indices.plain(rows, None), "1usize".into()),
        Shape::Matrix(rows, columns) => (indices.plain(rows, None), indices.plain(columns, None)),
    }
}

/// The type of an array of `scalar`s; paths begin with `root`.
pub fn storage(
    shape: &Shape,
    scalar: &str,
    indices: Indices,
    is_run_time: &[bool],
    root: &str,
) -> String {
    let dimension = |extent: &Affine| {
        if run_time(extent, is_run_time) {
            format!("{root}::Dyn")
        } else {
            format!("{root}::Const<{}>", extent_text(extent, indices))
        }
    };
    match shape {
        Shape::Scalar => scalar.to_owned(),
        Shape::Vector(_) if is_dynamic(shape, is_run_time) => format!("{root}::DVector<{scalar}>"),
        Shape::Vector(rows) => format!("{root}::SVector<{scalar}, {}>", extent_text(rows, indices)),
        Shape::Matrix(rows, columns) if is_dynamic(shape, is_run_time) => {
            let (rows, columns) = (dimension(rows), dimension(columns));
            format!(
                "{root}::Matrix<{scalar}, {rows}, {columns}, {root}::VecStorage<{scalar}, {rows}, {columns}>>"
            )
        }
        Shape::Matrix(rows, columns) => {
            format!(
                "{root}::SMatrix<{scalar}, {}, {}>",
                extent_text(rows, indices),
                extent_text(columns, indices)
            )
        }
    }
}

/// An extent as a const generic argument: a literal or a name.
pub fn extent_text(extent: &Affine, indices: Indices) -> String {
    match extent.as_constant() {
        Some(value) => value.to_string(),
        None => indices.plain(extent, None),
    }
}

/// The expression of an array of that shape filled with `value`.
pub fn filled(
    shape: &Shape,
    value: &str,
    indices: Indices,
    is_run_time: &[bool],
    root: &str,
) -> String {
    let dimension = |extent: &Affine| {
        if run_time(extent, is_run_time) {
            format!("{root}::Dyn({})", indices.plain(extent, None))
        } else {
            format!("{root}::Const::<{}>", extent_text(extent, indices))
        }
    };
    let (rows, columns) = match shape {
        Shape::Scalar => return value.to_owned(),
        Shape::Vector(rows) => (dimension(rows), format!("{root}::Const::<1>")),
        Shape::Matrix(rows, columns) => (dimension(rows), dimension(columns)),
    };
    format!("{root}::Matrix::from_element_generic({rows}, {columns}, {value})")
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

/// The `let`s that bind the slices at the top of a body. `slices` is sorted.
pub fn bind(
    out: &mut String,
    slices: &[Slice],
    model: &Model,
    layout: Layout,
    indices: Indices,
    is_run_time: &[bool],
) {
    let part = |slice: &Slice| part_of(*slice).map(|(_, at)| (slice.vector(), at.group));
    for run in slices.chunk_by(|a, b| part(a) == part(b)) {
        let Some((mutable, Column { group, .. })) = part_of(run[0]) else {
            continue;
        };
        let vector = run[0].vector();
        let suffix = if mutable { "_mut" } else { "" };
        let field = &model.groups[usize::from(group)];
        // Two parts of one vector are borrowed at once only as fields.
        let whole = match (layout, &field.shape) {
            (Layout::Mixed, Shape::Scalar) => {
                let borrow = if mutable { "&mut " } else { "&" };
                let from = if mutable { "from_mut" } else { "from_ref" };
                format!(
                    "__h::core::slice::{from}({borrow}{vector}.{})",
                    field.coordinate
                )
            }
            (Layout::Mixed, _) => format!("{vector}.{}.as{suffix}_slice()", field.coordinate),
            _ => format!("__h::Vector::part{suffix}({vector}, 0)"),
        };
        let (rows, columns) = match field.shape.rows() {
            Some(rows) if layout != Layout::Scalars => (rows, field.shape.columns()),
            _ => {
                out.push_str(&format!("let {} = {whole};\n", run[0].name()));
                continue;
            }
        };
        let rows = indices.plain(rows, None);
        if columns == 1 && !is_dynamic(&field.shape.of_parameter(), is_run_time) {
            out.push_str(&format!("let {} = {whole};\n", run[0].name()));
            continue;
        }
        let is_of =
            |slice: &Slice, column| part_of(*slice).is_some_and(|(_, at)| at.column == column);
        let names: Vec<String> = (0..columns)
            .map(|column| {
                let wanted = run.iter().find(|slice| is_of(slice, column));
                wanted.map_or_else(|| "_".to_owned(), |slice| slice.name())
            })
            .collect();
        let names = names.join(", ");
        out.push_str(&format!(
            "let [{names}] = __h::columns{suffix}({whole}, {rows});\n"
        ));
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
