//! Storage of coordinates and parameter arrays, as types, zeros and the slices of a body.
//!
//! Input: the groups and shapes of a model. Output: text of types and values, and the bindings of slices
//! at the top of a function body. Invariant: extents that are set at run time are in no type.

use super::context::{Context, ZERO};
use super::layout::{Layout, Slice};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{Group, Shape};
use std::fmt::Write;

impl Context<'_> {
    /// Returns true if an extent is set at run time.
    fn is_set_at_run_time(self, extent: &Affine) -> bool {
        let mut sizes = extent.all_sizes();
        sizes.any(|size| self.is_run_time[usize::from(size.0)])
    }

    /// Returns true if any extent of a shape is set at run time.
    pub fn is_dynamic(self, shape: &Shape) -> bool {
        match shape {
            Shape::Scalar => false,
            Shape::Vector(rows) | Shape::Lattice(rows, _) => self.is_set_at_run_time(rows),
            Shape::Matrix(rows, columns) => {
                self.is_set_at_run_time(rows) || self.is_set_at_run_time(columns)
            }
        }
    }

    /// Returns true if the numbers of an array are on the heap.
    pub fn is_on_heap(self, shape: &Shape) -> bool {
        matches!(shape, Shape::Lattice(..)) || self.is_dynamic(shape)
    }

    /// Rows and columns as expressions.
    pub fn extents(self, shape: &Shape) -> (String, String) {
        let extent = |extent: &Affine| self.indices.plain(extent);
        match shape {
            Shape::Scalar => ("1usize".into(), "1usize".into()),
            Shape::Vector(rows) | Shape::Lattice(rows, _) => (extent(rows), "1usize".into()),
            Shape::Matrix(rows, columns) => (extent(rows), extent(columns)),
        }
    }

    /// The extents of a lattice, as an array.
    pub fn axes(self, axes: &[Affine]) -> String {
        let extents: Vec<String> = (axes.iter())
            .map(|extent| self.indices.plain(extent))
            .into_list();
        format!("[{}]", extents.join(", "))
    }

    /// The extents of a lattice that has them in the type of its field, a list of lists.
    pub fn typed_axes(self, shape: &Shape) -> Option<&[Affine]> {
        let is_typed = !shape.axes().is_empty() && !self.is_dynamic(shape);
        is_typed.then(|| shape.axes())
    }

    /// The type of a list of lists, or its value, given that of a number.
    fn nested(self, axes: &[Affine], number: &str) -> String {
        let extents = axes.iter().rev();
        extents.fold(number.to_owned(), |inner, extent| {
            format!("[{inner}; {}]", self.constant_extent(extent))
        })
    }

    /// The type of the field of a parameter.
    pub fn field(self, shape: &Shape, scalar: &str) -> String {
        match self.typed_axes(shape) {
            Some(axes) => self.nested(axes, scalar),
            None => self.storage(shape, scalar),
        }
    }

    /// The expression of zeros of the type of a parameter.
    pub fn zero_field(self, shape: &Shape) -> String {
        match self.typed_axes(shape) {
            Some(axes) => self.nested(axes, ZERO),
            None => self.zero(shape),
        }
    }

    /// The field of an array, such as `_self.w`, in the type of [`Context::storage`].
    pub fn stored(self, shape: &Shape, field: &str) -> String {
        match self.typed_axes(shape) {
            Some(axes) => format!("__h::lattice::<_, {}>({field})", axes.len()),
            None => field.to_owned(),
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
                let (rows, columns) = (self.dimension(rows), self.dimension(columns));
                let shape = format!("{scalar}, {rows}, {columns}");
                format!("__h::Matrix<{shape}, __h::VecStorage<{shape}>>")
            }
            Shape::Matrix(rows, columns) => {
                format!("__h::SMatrix<{scalar}, {}, {}>", text(rows), text(columns))
            }
            Shape::Lattice(_, axes) => format!("__h::Lattice<{scalar}, {}>", axes.len()),
        }
    }

    /// An extent as a type of nalgebra.
    fn dimension(self, extent: &Affine) -> String {
        match self.is_set_at_run_time(extent) {
            true => "__h::Dyn".to_owned(),
            false => format!("__h::Const<{}>", self.constant_extent(extent)),
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
            Shape::Lattice(_, axes) => return format!("__h::Lattice::zeros({})", self.axes(axes)),
        };
        format!("__h::Matrix::from_element_generic({rows}, {columns}, {ZERO})")
    }

    /// The type of the coordinates of a group.
    pub fn group_storage(self, group: &Group, scalar: &str) -> String {
        self.storage(&group.shape.of_parameter(), scalar)
    }

    /// The check that the coordinates of a group, if a size is set at run time, fit into memory.
    pub fn room(self, group: &Group) -> Option<String> {
        let name = &group.coordinate;
        let shape = group.shape.of_parameter();
        let extents = match &shape {
            Shape::Lattice(_, axes) => self.axes(axes),
            shape => {
                let (rows, columns) = self.extents(shape);
                format!("[{rows}, {columns}]")
            }
        };
        (self.is_dynamic(&shape)).then(|| format!("__h::fits({name:?}, &{extents})?;\n"))
    }

    /// The type of coordinates and of momenta over `T`.
    pub fn vector(self) -> String {
        match self.layout {
            Layout::Scalars => format!("__h::SVector<T, {}>", self.groups.len()),
            Layout::Array => self.group_storage(&self.groups[0], "T"),
            Layout::Mixed => self.mixed_type(),
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
                let fields: Vec<String> = groups.iter().map(field).into_list();
                format!("{} {{ {} }}", self.mixed_name(), fields.join(", "))
            }
        }
    }

    /// The name of the struct of coordinates of mixed shape.
    pub fn mixed_name(self) -> String {
        format!("{}{}", self.generics.whole, self.suffix)
    }

    /// Its type over `T`.
    pub fn mixed_type(self) -> String {
        self.generics.vector_type_over(&self.mixed_name(), "T")
    }

    /// The `let`s that bind slices at the top of a body, but for scalar coordinates. `slices` is sorted.
    pub fn bind(self, out: &mut String, slices: &[Slice]) {
        if self.layout == Layout::Scalars {
            return;
        }
        let part = |slice: &Slice| slice.part().map(|(vector, at)| (vector, at.group));
        for run in slices.chunk_by(|a, b| part(a) == part(b)) {
            let Some((vector, group)) = part(&run[0]) else {
                continue;
            };
            let mutable = run[0].is_written();
            let (suffix, borrow) = if mutable {
                ("_mut", "mut")
            } else {
                ("", "ref")
            };
            let group = &self.groups[usize::from(group)];
            let Group {
                shape, coordinate, ..
            } = group;
            // Two parts of one vector are borrowed at once only as fields.
            let whole = match (self.layout, shape) {
                (Layout::Mixed, Shape::Scalar) => {
                    let reference = if mutable { "&mut " } else { "&" };
                    format!("__h::core::slice::from_{borrow}({reference}{vector}.{coordinate})")
                }
                (Layout::Mixed, _) => format!("{vector}.{coordinate}.as{suffix}_slice()"),
                _ => format!("__h::Vector::part{suffix}({vector}, 0)"),
            };
            let is_cut = shape.columns() > 1 || self.is_on_heap(&shape.of_parameter());
            let _ = match shape.rows() {
                Some(rows) if is_cut => {
                    let rows = self.indices.plain(rows);
                    let name = |column| {
                        let is_it = |slice: &&Slice| {
                            slice.part().is_some_and(|(_, at)| at.column == column)
                        };
                        run.iter()
                            .find(is_it)
                            .map_or("_".to_owned(), |slice| slice.name())
                    };
                    let names: Vec<String> = (0..shape.columns()).map(name).into_list();
                    let names = names.join(", ");
                    match self.layout {
                        Layout::Array => writeln!(
                            out,
                            "let [{names}] = __h::columns_of{suffix}({vector}, {rows});"
                        ),
                        _ => writeln!(
                            out,
                            "let [{names}] = __h::columns{suffix}({whole}, {rows});"
                        ),
                    }
                }
                _ => writeln!(out, "let {} = {whole};", run[0].name()),
            };
        }
    }
}
