//! Declarations of the header: sizes and parameters. Exactly one definition is required.
//!
//! Input: the header and the definition statement. Output: sizes, parameters, groups, time, and
//! the bindings of their names. Invariant: every name is declared once.

use super::{Binding, Checker};
use crate::ast::{ExprKind, Expression, Function, ParameterKind, Size, StatementKind};
use crate::checked::{
    Extent, Field, FunctionId, NodeId, NodeKind, Parameter, ParameterId, SizeDeclaration, Type,
};
use hamiltonian_symbolic::index;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Ident, Span};

/// The largest number of elements of an array of literal size. Such arrays are on the stack, a
/// scheme has tens of them, and the stack of a thread may be as small as 2 MB.
const LARGEST: u64 = 1 << 12;

/// The default of a vector.
const LIST: &str = "write one number for each component: `[1.0, 2.0]`";

impl Checker<'_> {
    /// Binds a name, or reports an error if it is bound already.
    pub(super) fn declare(&mut self, name: &Ident, binding: Binding) {
        let Some(symbol) = self.symbol(name) else {
            return;
        };
        if let Some(earlier) = self.bindings[symbol.0 as usize] {
            let what = self.described(earlier);
            self.report.error(
                name.span(),
                format!("the name `{name}` is used twice: it is {what} already"),
                "choose another name",
            );
            return;
        }
        self.bindings[symbol.0 as usize] = Some(binding);
    }

    /// Declares the header of item form. Returns false if the statements cannot be checked.
    pub(super) fn header(&mut self) -> bool {
        let ast = self.ast;
        if let Some(item) = &ast.item {
            if item.header.name == "T" {
                self.report.error(
                    item.header.name.span(),
                    "a type cannot be called `T`",
                    "choose another name: `T` is the scalar that a state is made of",
                );
            }
            if let Some(last) = item.parameters.last() {
                let (count, last) = (item.parameters.len(), last.name.span());
                if !self.are_numbered(count, ("parameters", "a"), last) {
                    return false;
                }
            }
            for name in &item.generics {
                self.size(name, false, Vec::new());
            }
            for parameter in &item.parameters {
                if matches!(parameter.kind, ParameterKind::Size) {
                    self.size(&parameter.name, true, parameter.attributes.clone());
                }
            }
            let mut next_size = item.generics.len();
            for parameter in &item.parameters {
                let ty = match &parameter.kind {
                    ParameterKind::Size => {
                        self.out
                            .fields
                            .push(Field::Size(index::Size(next_size as u16)));
                        next_size += 1;
                        continue;
                    }
                    ParameterKind::Function(arguments) => {
                        let id = FunctionId(self.out.functions.len() as u32);
                        self.declare(&parameter.name, Binding::Function(id));
                        self.out.fields.push(Field::Function(id));
                        self.out.function_docs.push(parameter.attributes.clone());
                        self.out.functions.push(Function {
                            name: parameter.name.clone(),
                            arguments: arguments.clone(),
                            value: None,
                            first: None,
                            second: None,
                        });
                        continue;
                    }
                    ParameterKind::Scalar(_) => Some(Type::Scalar),
                    ParameterKind::Array(sizes, _) => self.array(sizes),
                };
                let default = match (&parameter.kind, ty) {
                    (
                        ParameterKind::Scalar(Some(default))
                        | ParameterKind::Array(_, Some(default)),
                        Some(ty),
                    ) => self.default_value(&parameter.name, ty, default),
                    _ => None,
                };
                let id = ParameterId(self.out.parameters.len() as u32);
                let known = if ty.is_some() {
                    Binding::Parameter(id)
                } else {
                    Binding::Erroneous
                };
                self.declare(&parameter.name, known);
                self.out.fields.push(Field::Parameter(id));
                self.out.parameters.push(Parameter {
                    attributes: parameter.attributes.clone(),
                    name: parameter.name.clone(),
                    ty: ty.unwrap_or(Type::Scalar),
                    default,
                });
            }
            self.out.item = Some(item.header.clone());
        }
        self.one_definition()
    }

    /// The numbers of a default, row by row, if it is made of numbers.
    fn default_value(
        &mut self,
        name: &Ident,
        ty: Type,
        default: &Expression,
    ) -> Option<Vec<NodeId>> {
        let root = &self.ast.nodes[default.root.0 as usize];
        let extents = ty.extents();
        let (inner, outer) = match extents.split_last() {
            Some((last, outer)) => (Type::Vector(*last), outer),
            None => (Type::Scalar, &[][..]),
        };
        // The lists of all axes but the last are no expressions.
        let (mut lists, mut roots) = (Vec::new(), vec![default.root]);
        let mut fits = true;
        for extent in outer {
            let mut parts = Vec::new();
            for root in &roots {
                match &self.ast.nodes[root.0 as usize].kind {
                    ExprKind::Vector(items) if *extent == Extent::Literal(items.len() as u64) => {
                        parts.extend(items);
                    }
                    _ => fits = false,
                }
            }
            lists.append(&mut roots);
            roots = parts;
        }
        let mut rows = Vec::new();
        if fits {
            let read = self.visit(default, Vec::new(), &lists);
            let values = roots.iter().map(|root| read.value(*root));
            rows = values.collect::<Option<Vec<_>>>()?;
            fits = rows.iter().all(|row| self.type_of(*row) == inner);
        }
        if !fits {
            let message = match rows.as_slice() {
                [found] if outer.is_empty() => format!(
                    "the default of `{name}` is {}, but the parameter is {}",
                    self.type_shown(self.type_of(*found)),
                    self.type_shown(ty)
                ),
                _ => format!(
                    "the default of `{name}` does not list the rows of {}",
                    self.type_shown(ty)
                ),
            };
            let is_open = |extent: &Extent| !matches!(extent, Extent::Literal(_));
            let help = match ty {
                _ if extents.iter().any(is_open) => {
                    "remove it and give the value to `new`: an array with a default has literal extents"
                }
                Type::Matrix(..) => "write its rows: `[[1.0, 2.0], [3.0, 4.0]]`",
                Type::Array(_) => "write a list for each index: `[[[1.0, 2.0]], [[3.0, 4.0]]]`",
                Type::Vector(_) => LIST,
                _ => "write one number",
            };
            self.report.error(root.spans, message, help);
            return None;
        }
        let mut pending = rows.clone();
        while let Some(id) = pending.pop() {
            let node = self.out.node(id);
            match &node.kind {
                NodeKind::Number(_)
                | NodeKind::Pi
                | NodeKind::Unary(..)
                | NodeKind::Binary(..)
                | NodeKind::Vector(_)
                | NodeKind::Call(..) => node.kind.for_each_child(|child| pending.push(child)),
                _ => {
                    let message = format!("the default of `{name}` is not made of numbers alone");
                    let help = "write a number, such as `0.5`, `2/3` or `pi/4`";
                    self.report.error(node.spans, message, help);
                    return None;
                }
            }
        }
        let mut numbers = Vec::new();
        for row in rows {
            match &self.out.node(row).kind {
                NodeKind::Vector(items) => numbers.extend(items),
                _ if ty == Type::Scalar => numbers.push(row),
                _ => {
                    let message = format!("the default of `{name}` is not a list of numbers");
                    self.report.error(self.out.node(row).spans, message, LIST);
                    return None;
                }
            }
        }
        Some(numbers)
    }

    fn size(&mut self, name: &Ident, run_time: bool, attributes: Vec<proc_macro2::TokenStream>) {
        let id = index::Size(self.out.sizes.len() as u16);
        self.declare(name, Binding::Size(id));
        self.out.sizes.push(SizeDeclaration {
            name: name.clone(),
            run_time,
            attributes,
        });
    }

    pub(super) fn array(&mut self, sizes: &[Size]) -> Option<Type> {
        let numbers = sizes.iter().map(Size::number);
        let numbers = numbers.fold(1, u64::saturating_mul);
        let is_open =
            |name: &Ident| (self.out.sizes.iter()).any(|one| one.run_time && one.name == *name);
        if numbers > LARGEST && !sizes.iter().flat_map(Size::names).any(is_open) {
            let rows = &sizes[0];
            let message = format!(
                "an array of {numbers} numbers does not fit on the stack, where at most {LARGEST} may stand"
            );
            let help = "set the size at run time, which keeps the numbers on the heap: `pub struct Name { n: usize }` and `[n]`";
            self.report.error(rows.spans(), message, help);
            return None;
        }
        // All unknown sizes are reported.
        let extents: Vec<Option<Extent>> = sizes.iter().map(|size| self.extent(size)).into_list();
        Some(Type::of(&extents.into_iter().collect::<Option<Vec<_>>>()?))
    }

    /// Finds the definition: exactly one H or L.
    fn one_definition(&mut self) -> bool {
        let mut first = None;
        for statement in &self.ast.statements {
            let word = match statement.kind {
                StatementKind::Hamiltonian { .. } => "H",
                StatementKind::Lagrangian { .. } => "L",
                _ => continue,
            };
            match first {
                None => first = Some(word),
                Some(other) if other == word => self.report.error(
                    statement.keyword,
                    format!("`{word}` is defined twice"),
                    "keep one definition; parts of it are named by `let`",
                ),
                Some(_) => self.report.error(
                    statement.keyword,
                    "both `H` and `L` are given",
                    "keep one: the other follows from it",
                ),
            }
        }
        if first.is_some() {
            return true;
        }
        let (span, what) = match &self.ast.item {
            Some(item) => (
                item.header.name.span(),
                format!("`{}` has no Hamiltonian", item.header.name),
            ),
            None => match self.ast.statements.first() {
                Some(statement) => (statement.keyword, "the Hamiltonian is missing".into()),
                None => (Span::call_site(), "the Hamiltonian is missing".into()),
            },
        };
        self.report
            .error(span, what, "write `H(q; p) = …` among the statements");
        false
    }
}
