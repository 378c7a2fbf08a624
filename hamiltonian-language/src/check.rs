//! Statements as written → names resolved, shapes checked.
//!
//! Input: an [`Ast`] without parse errors. Output: [`Checked`], which is valid only if nothing was
//! reported. Invariants: a mistake is reported once, at the narrowest token; a value that depends
//! on a mistake is `None` and causes no further error; every pass over expressions is a forward
//! loop.

mod affine;
mod builtin;
mod chart;
mod declare;
mod expr;
mod force;
mod lookup;
mod memory;
mod range;
mod reach;
mod signature;
mod statement;

use crate::ast::{Ast, Expression, Size, Symbol};
use crate::checked::{Checked, Extent, FunctionId, GroupId, NodeId, ParameterId, Type, Variable};
use crate::names::listed;
use crate::report::{Report, Spans};
use hamiltonian_symbolic::index::{self, Affine, Domain, LOOPS};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::REPLACING;
use proc_macro2::{Ident, Span};

/// Resolves and checks a definition.
pub fn check(ast: &Ast, report: &mut Report) -> Checked {
    let mut checker = Checker::new(ast, report);
    if checker.header() && checker.signature() {
        checker.values();
        checker.claims();
        if let Some(one) = checker.out.loops.get(LOOPS) {
            let message = format!("there are more than {LOOPS} loops");
            let at = one.name.span();
            checker.report.error(at, message, SHARE_LOOPS);
        }
        if let Some(last) = checker.out.captures.last().map(Ident::span) {
            let count = checker.out.captures.len();
            checker.are_numbered(count, ("captured values", "a"), last);
        }
    }
    checker.out
}

/// The remedy for too many loops.
pub const SHARE_LOOPS: &str = "let several sums share a loop, or write a function with `let`";

/// The most scalars and arrays of one sort: programs number them in 16 bits, groups in 15.
const MAX_OF_A_SORT: usize = REPLACING as usize;

/// The binding of a name.
#[derive(Debug, Clone, Copy)]
enum Binding {
    Phase(Variable, GroupId),
    Time,
    Parameter(ParameterId),
    Size(index::Size),
    /// `None` if its value is erroneous.
    Value(Option<NodeId>),
    /// Index into [`Checker::lets`].
    LetFunction(usize),
    Function(FunctionId),
    /// Its declaration is erroneous.
    Erroneous,
}

/// A `let` function.
struct LetFunction<'a> {
    arguments: Vec<Symbol>,
    body: &'a Expression,
    /// `f(x, y)`
    shown: String,
    /// An error in the body was reported where it stands.
    erroneous: bool,
}

/// The place of the statement that is being read, relative to the definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Position {
    /// A `let` above the definition.
    Before,
    /// The right side of H or L.
    Within,
    /// A statement that the definition does not depend on.
    After,
}

struct Checker<'a> {
    ast: &'a Ast,
    report: &'a mut Report,
    out: Checked,
    /// By symbol.
    bindings: Vec<Option<Binding>>,
    /// Symbols that a later statement defines, by symbol.
    later: Vec<bool>,
    /// Symbols of loop variables, by symbol.
    loop_symbols: Vec<bool>,
    /// True for each symbol that was reported as unknown.
    unknown: Vec<bool>,
    /// Sizes that were reported as unknown.
    unknown_sizes: Vec<String>,
    /// The symbol that the statement being read defines.
    defining: Option<Symbol>,
    place: Position,
    /// True if the statement that is being read is a `split`, which reads new coordinates too.
    in_split: bool,
    lets: Vec<LetFunction<'a>>,
    /// The affine form of nodes that have one, by node.
    affines: Vec<Option<Affine>>,
    /// The loop that each scope currently stands for.
    scope_loops: Vec<Option<Domain>>,
    /// The loops around the node that is being read, outermost first.
    active: Vec<Domain>,
    /// True for each raw node for which an error was reported.
    reported: Vec<bool>,
    call_depth: u32,
    /// Nodes made by calls of `let` functions.
    instantiated: usize,
}

/// A limit of extents.
const MANY_SIZES: &str = "this product has more than four sizes";

impl<'a> Checker<'a> {
    fn new(ast: &'a Ast, report: &'a mut Report) -> Self {
        let symbols = ast.symbols.count();
        let mut loop_symbols = vec![false; symbols];
        for scope in &ast.scopes {
            loop_symbols[scope.symbol.0 as usize] = true;
        }
        Checker {
            ast,
            report,
            out: Checked::default(),
            bindings: vec![None; symbols],
            later: vec![false; symbols],
            loop_symbols,
            unknown: vec![false; symbols],
            unknown_sizes: Vec::new(),
            defining: None,
            place: Position::Before,
            in_split: false,
            lets: Vec::new(),
            affines: Vec::new(),
            scope_loops: vec![None; ast.scopes.len()],
            active: Vec::new(),
            reported: vec![false; ast.nodes.len()],
            call_depth: 0,
            instantiated: 0,
        }
    }

    /// Returns true if programs can number `count` scalars or arrays of one sort. Otherwise reports
    /// an error at the last of them.
    fn are_numbered(&mut self, count: usize, (sort, name): (&str, &str), last: Span) -> bool {
        if count > MAX_OF_A_SORT {
            let message = format!("there are {count} {sort}, more than {MAX_OF_A_SORT}");
            let help = format!("make them an array, such as `{name}[{count}]`");
            self.report.error(last, message, help);
        }
        count <= MAX_OF_A_SORT
    }

    /// The symbol of a name, if it occurs in any expression.
    fn symbol(&self, name: &Ident) -> Option<Symbol> {
        self.ast.symbols.find(&name.to_string())
    }

    /// The kind of a declared name, in words.
    fn described(&self, binding: Binding) -> &'static str {
        match binding {
            Binding::Phase(Variable::Coordinate | Variable::NewCoordinate, _) => "a coordinate",
            Binding::Phase(Variable::Momentum | Variable::NewMomentum, _) => "a momentum",
            Binding::Phase(Variable::Velocity, _) => "a velocity",
            Binding::Time => "time",
            Binding::Parameter(_) => "a parameter",
            Binding::Size(_) => "a size",
            Binding::Value(_) => "a `let`",
            Binding::LetFunction(_) | Binding::Function(_) => "a function",
            Binding::Erroneous => "declared",
        }
    }

    /// `(q, r; p, s; t)` of the definition as it would be written with time.
    fn signature_with_time(&self) -> String {
        let shown = |name: &Ident, ty: Type| format!("{name}{}", self.extents_shown(ty));
        let groups = &self.out.groups;
        let coordinates = listed(
            groups
                .iter()
                .map(|group| shown(&group.coordinate, group.ty)),
        );
        let partners = listed(groups.iter().map(|group| shown(group.partner(), group.ty)));
        let word = if self.is_lagrangian() { "L" } else { "H" };
        format!("{word}({coordinates}; {partners}; t)")
    }

    fn is_lagrangian(&self) -> bool {
        self.out
            .groups
            .first()
            .is_some_and(|group| group.velocity.is_some())
    }

    fn extent_shown(&self, extent: Extent) -> String {
        match extent {
            Extent::Literal(value) => value.to_string(),
            _ => self.affine_shown(&extent.affine()),
        }
    }

    /// `[n][3]`
    fn extents_shown(&self, ty: Type) -> String {
        let extents = ty.extents().into_iter();
        extents
            .map(|extent| format!("[{}]", self.extent_shown(extent)))
            .collect()
    }

    /// A type in words.
    fn type_shown(&self, ty: Type) -> String {
        match ty {
            Type::Bool => "a condition".into(),
            Type::Scalar => "a scalar".into(),
            Type::Vector(_) => format!("a vector `{}`", self.extents_shown(ty)),
            Type::Matrix(..) => format!("a matrix `{}`", self.extents_shown(ty)),
            Type::Array(_) => format!("an array `{}`", self.extents_shown(ty)),
        }
    }

    fn type_of(&self, node: NodeId) -> Type {
        self.out.nodes[node.0 as usize].ty
    }

    /// The extent that a product of sizes is. It is in no type, so one of them is set at run time.
    fn product(&mut self, spans: Spans, factors: &[Size]) -> Option<Extent> {
        // All unknown sizes are reported.
        let extents: Vec<Option<Extent>> = factors.iter().map(|size| self.extent(size)).into_list();
        let mut extents = extents.into_iter().collect::<Option<Vec<_>>>()?.into_iter();
        let form = extents.try_fold(Affine::constant(1), |product, extent| {
            product.checked_times(&extent.affine())
        });
        let Some(form) = form else {
            let message = "the number in this product needs more than 64 bits";
            self.report.error(spans, message, "write smaller factors");
            return None;
        };
        let Some(extent) = Extent::of(&form) else {
            let help = "write several extents: `[n][m]`";
            self.report.error(spans, MANY_SIZES, help);
            return None;
        };
        let mut sizes = form.all_sizes();
        if form.has_sizes() && !sizes.any(|size| self.out.sizes[size.0 as usize].run_time) {
            let message = format!(
                "the extent `{}` is set by const generics alone",
                self.affine_shown(&form)
            );
            let help = "write several extents, `[N][M]`, or set a size at run time, `n: usize`: types of Rust have no products";
            self.report.error(spans, message, help);
            return None;
        }
        self.fits_at(spans.start, &form);
        Some(extent)
    }

    /// The extent that a size stands for.
    fn extent(&mut self, size: &Size) -> Option<Extent> {
        let name = match size {
            Size::Literal(value, _) => return Some(Extent::Literal(*value)),
            Size::Name(name) => name,
            Size::Product(factors) => return self.product(size.spans(), factors),
        };
        let text = name.to_string();
        if let Some(index) = self.out.sizes.iter().position(|size| size.name == *name) {
            return Some(Extent::Size(index::Size(index as u16)));
        }
        let sizes = self.out.sizes.iter().map(|size| size.name.to_string());
        let sizes: Vec<String> = sizes.into_list();
        if self.unknown_sizes.contains(&text) {
            return None;
        }
        let nearest = crate::names::nearest(&text, sizes.iter().map(String::as_str));
        let mut parameters = self.ast.item.iter().flat_map(|item| &item.parameters);
        let is_parameter = parameters.any(|parameter| parameter.name == *name);
        let message = if is_parameter {
            format!("`{text}` is a parameter, not a size")
        } else {
            format!("unknown size `{text}`")
        };
        let help = match (nearest, &self.ast.item) {
            _ if is_parameter => format!("declare it as a size: `{text}: usize`"),
            (Some(known), _) => format!("the nearest size is `{known}`"),
            (None, Some(item)) => format!(
                "declare it: `struct {}<const {text}: usize>`, or `{text}: usize` among the parameters",
                item.header.name
            ),
            (None, None) => {
                "write a number; named sizes need the item form, `struct Name<const N: usize>`"
                    .into()
            }
        };
        self.report.error(name.span(), message, help);
        self.unknown_sizes.push(text);
        None
    }
}
