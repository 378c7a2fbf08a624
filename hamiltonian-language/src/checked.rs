//! The definition as lowering reads it: names are resolved, every node has a type, every index is
//! affine.
//!
//! Input: none (built by `check`). Output: [`Checked`]. Invariants that lowering relies on:
//!
//! - **Children precede parents** in [`Checked::nodes`]: one forward loop over the indices is a
//!   bottom-up walk of all nodes, and no pass needs recursion. Some nodes may not be reachable from
//!   a root; they cost nothing once lowered into a DAG.
//! - Scopes, `let`s and functions are resolved: a `let` value is its node, and a `let` function is
//!   instantiated at every call with the nodes of its arguments. Loop variables are leaves. Only
//!   the names of the `let`s remain, in [`Checked::lets`].
//! - Every node is well typed: the comments of [`NodeKind`] state operand and result types. [`Type`]
//!   extents are equal exactly if they are the same size.
//! - Every [`Affine`] mentions only sizes and the loops around it. A loop's bounds
//!   mention only loops outside it; a [`NodeKind::Sum`] lists its loops outermost first. A range with an
//!   upper bound not above its lower one is empty, its sum zero.
//! - Loops are not shared between sums, so a loop variable stands for one loop only.
//! - A [`Domain`] is an index into [`Checked::loops`], a [`Size`] one into [`Checked::sizes`].
//! - Where the loops around it run, an index is in range for all sizes, or it has a [`Reach`]: then
//!   the sizes decide, and it is checked once they are known. No index is provably out of range. The
//!   same holds for products of sizes, which fit a `usize`.
//! - There is exactly one definition, and at least one group.

use crate::ast::{AXES, BinaryOp, Function, Header, UnaryOp};
use crate::names::Builtin;
use crate::report::Spans;
use hamiltonian_symbolic::index::{Affine, Domain, Index, Size};
use hamiltonian_symbolic::model::ObservableKind;
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::transform;
use proc_macro2::{Ident, Span, TokenStream};
use std::ops::Range;

/// A resolved definition.
#[derive(Debug, Default)]
pub struct Checked {
    /// The header of item form; `None` in expression form.
    pub item: Option<Header>,
    /// Run-time sizes and parameters in the order they were declared: the fields of the struct.
    pub fields: Vec<Field>,
    /// Sizes that are not literals: const generics first, then run-time sizes.
    pub sizes: Vec<SizeDeclaration>,
    /// Scalar and array parameters.
    pub parameters: Vec<Parameter>,
    /// Names captured in expression form, scalars, in order of first use. Their spans are the
    /// user's, so that the identifier resolves where the macro was called.
    pub captures: Vec<Ident>,
    /// Coordinates with their momenta.
    pub groups: Vec<Group>,
    /// The name of time, if the signature has one.
    pub time: Option<Ident>,
    /// H or L.
    pub definition: Definition,
    /// Values named by `let`, in source order.
    pub lets: Vec<(Ident, NodeId)>,
    /// Rust functions. Parameters come first, with the docs of their fields.
    pub functions: Vec<Function>,
    /// The docs of the functions that are parameters, each with its `#`.
    pub function_docs: Vec<Vec<TokenStream>>,
    /// Invariants, monitors and events in source order.
    pub observables: Vec<Observable>,
    /// `split { A = …; B = …; }`: scalars; empty without one.
    pub split: Vec<(Ident, NodeId)>,
    /// `#[assume]` stands before the split.
    pub split_assumed: bool,
    /// `force(q; p) = …`: one value a group, of the group's type; empty without one.
    pub force: Vec<NodeId>,
    /// The i of `force(q[i]; p[i]) = …`, the i and j of `force(u[i][j]; p[i][j]) = …`; `force` is the value there.
    pub force_rows: Vec<Domain>,
    /// `dt = g*ds`: g, a scalar, with the first word of the statement.
    pub time_factor: Option<(NodeId, Span)>,
    /// `coordinates polar(x, y)`.
    pub charts: Vec<Chart>,
    /// All loops of all sums.
    pub loops: Vec<Loop>,
    /// Indices that are in range for some sizes only.
    pub reaches: Vec<Reach>,
    /// All expressions, children before parents.
    pub nodes: Vec<Node>,
}

impl Checked {
    /// A node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }
}

/// Before the definition is read.
impl Default for Definition {
    fn default() -> Definition {
        Definition::Hamiltonian(NodeId(0))
    }
}

/// One entry between the braces of the struct.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// `name: usize`
    Size(Size),
    /// `name`, `name = 1.0`, `name: [s]`, `name: [s][s]`, …
    Parameter(ParameterId),
    /// `name: fn(a, …)`
    Function(FunctionId),
}

/// A size that is not a literal.
#[derive(Debug, Clone)]
pub struct SizeDeclaration {
    /// The name of the const generic or field.
    pub name: Ident,
    /// True if it is a field that is set at run time, false for a const generic.
    pub run_time: bool,
    /// Docs of a run-time size, each with its `#`.
    pub attributes: Vec<TokenStream>,
}

/// A scalar or array parameter.
#[derive(Debug)]
pub struct Parameter {
    /// Docs, each with its `#`.
    pub attributes: Vec<TokenStream>,
    /// The name of the field.
    pub name: Ident,
    /// A number or an array.
    pub ty: Type,
    /// Its default, number by number.
    pub default: Option<Vec<NodeId>>,
}

/// A group of coordinates with its momenta.
#[derive(Debug)]
pub struct Group {
    /// The name of the coordinate.
    pub coordinate: Ident,
    /// The name of the conjugate momentum. Under a Lagrangian it is `p_` followed by the name of
    /// the coordinate.
    pub momentum: Ident,
    /// The name of the velocity, under a Lagrangian.
    pub velocity: Option<Ident>,
    /// The type of the coordinate, of the momentum and of the velocity.
    pub ty: Type,
    /// True if it is an array of several axes that is stored row after row and read in loops. The
    /// columns of any other matrix are separate arrays, and their number is literal.
    pub is_lattice: bool,
}

impl Group {
    /// The velocity under a Lagrangian, the momentum otherwise.
    pub fn partner(&self) -> &Ident {
        self.velocity.as_ref().unwrap_or(&self.momentum)
    }
}

/// The kind of variables of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// The coordinates.
    Coordinate,
    /// The momenta.
    Momentum,
    /// The coordinates by which a chart replaces the group, in a split: bodies row by row, scalars each in the place of
    /// the one they replace.
    NewCoordinate,
    /// The momenta of these.
    NewMomentum,
    /// The velocities, under a Lagrangian.
    Velocity,
}

/// The given function.
#[derive(Debug, Clone, Copy)]
pub enum Definition {
    /// `H(q; p[; t]) = …`, a scalar
    Hamiltonian(NodeId),
    /// `L(q; v[; t]) = …`, a scalar without [`Variable::Momentum`] and [`NodeKind::Hamiltonian`].
    /// Elsewhere in such a definition [`Variable::Velocity`] means the velocity as a function of q, p.
    Lagrangian(NodeId),
}

/// An invariant, a monitor or an event.
#[derive(Debug)]
pub struct Observable {
    /// Docs, each with its `#`.
    pub attributes: Vec<TokenStream>,
    /// One of the three.
    pub kind: ObservableKind,
    /// True if the author assumes it to be an invariant, without proof.
    pub assumed: bool,
    /// Its name, different from those of other observables.
    pub name: Ident,
    /// A scalar, or (not for events) a vector of literal extent.
    pub value: NodeId,
    /// `on H = shell`: the energy of the shell on which the invariant is claimed, a scalar.
    pub shell: Option<NodeId>,
}

/// A canonical change of coordinates.
#[derive(Debug)]
pub struct Chart {
    /// The name of the chart, for errors.
    pub name: Ident,
    /// The change, with groups and parameters by their numbers here.
    pub kind: transform::Chart,
}

/// One loop of a sum: `name in lower..upper`.
#[derive(Debug)]
pub struct Loop {
    /// The loop variable.
    pub name: Ident,
    /// The first value. If the sizes decide whether it is negative, there is a [`Reach`].
    pub lower: Affine,
    /// One past the last value.
    pub upper: Affine,
}

/// A form that is in range for some sizes only: an index, the first value of a range, or a sum of products of sizes.
#[derive(Debug, Clone)]
pub struct Reach {
    /// The form as it is written: `q[i + 1]`, `i in n - 3..n`, `2*n*m`.
    pub shown: String,
    /// Its place.
    pub span: Span,
    /// The loops it depends on, outermost first, each with its `[lower, upper]`.
    pub loops: Vec<(Domain, [Affine; 2])>,
    /// The form that must be ≥ 0 in all iterations.
    pub form: Affine,
    /// The values that the form may not reach.
    pub limit: Bound,
}

/// The upper bound of a [`Reach`], excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The extent that an index goes into.
    Extent(Extent),
    /// None: the form is the first value of a range.
    Nothing,
    /// The largest `isize`: emitted code computes the form in `usize`.
    Memory,
}

/// An extent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Extent {
    /// A number, at least 1.
    Literal(u64),
    /// A const generic or run-time size.
    Size(Size),
    /// A number times sizes, in order.
    Product(u64, [Option<Size>; AXES]),
}

impl Extent {
    /// The number or the size as a form.
    pub fn affine(self) -> Affine {
        match self {
            Extent::Literal(value) => {
                Affine::constant(i64::try_from(value).expect("check bounds literal sizes"))
            }
            Extent::Size(size) => Affine::size(size),
            Extent::Product(number, sizes) => {
                let number = Extent::Literal(number).affine();
                let times = |form: Affine, size: Size| form.checked_times(&Affine::size(size));
                let form = sizes.into_iter().flatten().try_fold(number, times);
                form.expect("a product has one term")
            }
        }
    }

    /// The extent that a form is, if it is a number, a size, or a product of a number and at most [`AXES`] sizes.
    pub fn of(form: &Affine) -> Option<Extent> {
        let number = |factor: i64| u64::try_from(factor).ok().filter(|number| *number > 0);
        if let Some(value) = form.as_constant() {
            return number(value).map(Extent::Literal);
        }
        let (sizes, factor) = match (&form.sizes[..], &form.products[..]) {
            (&[(size, 1)], []) if *form == Affine::size(size) => return Some(Extent::Size(size)),
            ([(size, factor)], []) => (std::slice::from_ref(size), factor),
            ([], [(sizes, factor)]) => (&sizes[..], factor),
            _ => return None,
        };
        let mut product = [None; AXES];
        for (place, size) in product.get_mut(..sizes.len())?.iter_mut().zip(sizes) {
            *place = Some(*size);
        }
        let extent = Extent::Product(number(*factor)?, product);
        (extent.affine() == *form).then_some(extent)
    }
}

/// The type of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    /// A condition.
    Bool,
    /// A number.
    Scalar,
    /// `[extent]`
    Vector(Extent),
    /// `[rows][columns]`
    Matrix(Extent, Extent),
    /// `[extent][extent][extent]…`: three axes or more.
    Array(Axes),
}

/// The extents of an array with several axes, the first one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axes {
    count: usize,
    /// The extents; those past `count` are 1.
    extents: [Extent; AXES],
}

impl Axes {
    /// The extents.
    pub fn extents(&self) -> &[Extent] {
        &self.extents[..self.count]
    }
}

impl Type {
    /// The type of an array of these extents, at most [`AXES`].
    pub fn of(extents: &[Extent]) -> Type {
        match *extents {
            [] => Type::Scalar,
            [extent] => Type::Vector(extent),
            [rows, columns] => Type::Matrix(rows, columns),
            _ => {
                let mut axes = Axes {
                    count: extents.len().min(AXES),
                    extents: [Extent::Literal(1); AXES],
                };
                for (own, extent) in axes.extents.iter_mut().zip(extents) {
                    *own = *extent;
                }
                Type::Array(axes)
            }
        }
    }
    /// The extents of its axes.
    pub fn extents(self) -> Vec<Extent> {
        match self {
            Type::Bool | Type::Scalar => Vec::new(),
            Type::Vector(extent) => vec![extent],
            Type::Matrix(rows, columns) => vec![rows, columns],
            Type::Array(axes) => axes.extents().to_vec(),
        }
    }
    /// The extent of the first axis, and the type of an element of it.
    pub fn rows(self) -> Option<(Extent, Type)> {
        let extents = self.extents();
        let (rows, inner) = extents.split_first()?;
        Some((*rows, Type::of(inner)))
    }
    /// The number of its elements; `None` if a coefficient overflows.
    pub fn elements(self) -> Option<Affine> {
        let mut extents = self.extents().into_iter();
        extents.try_fold(Affine::constant(1), |product, extent| {
            product.checked_times(&extent.affine())
        })
    }
    /// A number.
    pub fn is_scalar(self) -> bool {
        self == Type::Scalar
    }
    /// `[extent]`
    pub fn is_vector(self) -> bool {
        matches!(self, Type::Vector(_))
    }
}

/// An expression node.
#[derive(Debug)]
pub struct Node {
    /// The operation, with its operands.
    pub kind: NodeKind,
    /// The type of its value.
    pub ty: Type,
    /// From its first to its last token.
    pub spans: Spans,
    /// The narrowest token that represents it: its operator, name or number.
    pub at: Spans,
}

/// The kind of a node. S is a scalar, V a vector, M a matrix, X any of the three, B a condition.
#[derive(Debug)]
pub enum NodeKind {
    /// S: an exact number.
    Number(Rational),
    /// S: π.
    Pi,
    /// X: the variables of a whole group.
    Phase(Variable, GroupId),
    /// S: time.
    Time,
    /// X: a parameter.
    Parameter(ParameterId),
    /// S: a name of the scope around the macro.
    Capture(CaptureId),
    /// S: a size as a real number.
    Size(Size),
    /// S: a loop variable as a real number.
    Loop(Domain),
    /// S: the Hamiltonian itself; only in statements that H does not depend on.
    Hamiltonian,
    /// `-`: X → X; `!`: B → B
    Unary(UnaryOp, NodeId),
    /// `+ -`: X, X → X, the same type. `*`: S, X → X; X, S → X; a matrix parameter `[r][c]` times
    /// `[c]` → `[r]`. `/`: X, S → X. `^`, and `pow(x, y)`: S, S → S. Comparisons: S, S → B.
    /// `&& ||`: B, B → B. Never `%`.
    Binary(BinaryOp, NodeId, NodeId),
    /// `base[index]`: V → S, M → V (a row), an array of more axes → one of the other axes
    Index {
        /// The indexed value.
        base: NodeId,
        /// The component or row.
        index: Index,
    },
    /// S, … → V of literal extent
    Vector(Vec<NodeId>),
    /// A function of the language; operand types in [`Builtin`]. Never [`Op::Pow`](hamiltonian_symbolic::op::Op::Pow) nor
    /// [`Builtin::Bracket`], which have nodes of their own.
    Call(Builtin, Vec<NodeId>),
    /// S, … → S: a Rust function.
    Function(FunctionId, Vec<NodeId>),
    /// S, S → S: the Poisson bracket {a, b} = Σ ∂a/∂q·∂b/∂p − ∂a/∂p·∂b/∂q; not inside a sum.
    Bracket(NodeId, NodeId),
    /// X → X: the sum of `body` over `loops`, the outermost first.
    Sum {
        /// Loops with consecutive ids.
        loops: Range<u32>,
        /// The summand.
        body: NodeId,
    },
    /// B, X, X → X, the same type
    If {
        /// The condition.
        condition: NodeId,
        /// The value where it holds.
        then: NodeId,
        /// The value where it does not.
        otherwise: NodeId,
    },
}

impl NodeKind {
    /// Calls `visit` with every child, in the order they are written.
    pub fn for_each_child(&self, mut visit: impl FnMut(NodeId)) {
        match self {
            NodeKind::Number(_)
            | NodeKind::Pi
            | NodeKind::Phase(..)
            | NodeKind::Time
            | NodeKind::Parameter(_)
            | NodeKind::Capture(_)
            | NodeKind::Size(_)
            | NodeKind::Loop(_)
            | NodeKind::Hamiltonian => {}
            NodeKind::Unary(_, a) => visit(*a),
            NodeKind::Binary(_, a, b) | NodeKind::Bracket(a, b) => {
                visit(*a);
                visit(*b);
            }
            NodeKind::Index { base, .. } => visit(*base),
            NodeKind::Vector(items) | NodeKind::Call(_, items) | NodeKind::Function(_, items) => {
                items.iter().copied().for_each(visit);
            }
            NodeKind::Sum { body, .. } => visit(*body),
            NodeKind::If {
                condition,
                then,
                otherwise,
            } => {
                visit(*condition);
                visit(*then);
                visit(*otherwise);
            }
        }
    }
}

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
            pub struct $name(pub u32);
        )*
    };
}

ids! {
    /// Index into [`Checked::nodes`].
    NodeId
    /// Index into [`Checked::groups`].
    GroupId
    /// Index into [`Checked::parameters`].
    ParameterId
    /// Index into [`Checked::captures`].
    CaptureId
    /// Index into [`Checked::functions`].
    FunctionId
}
