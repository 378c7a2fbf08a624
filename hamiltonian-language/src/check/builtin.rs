//! Calls: functions of the language, `let` functions, Rust functions.
//!
//! Input: a name with arguments. Output: a node. Invariant: arity is checked before shapes, and a
//! wrong call shows how the function is written.

use super::expr::Frame;
use super::lookup::Found;
use super::{Binding, Checker};
use crate::ast::{BinaryOp, ExprId, LoopVariableId, Symbol};
use crate::checked::{Extent, NodeId, NodeKind, Type};
use crate::names::{self, Builtin, Entry};
use hamiltonian_symbolic::op::Op;

/// Names of products over a range in other languages.
const PRODUCTS: &[&str] = &["prod", "product", "Π"];

impl Checker<'_> {
    pub(super) fn call(
        &mut self,
        raw: ExprId,
        symbol: Symbol,
        scope: Option<LoopVariableId>,
        arguments: &[ExprId],
        frame: &Frame,
    ) -> Option<NodeId> {
        let ast = self.ast;
        let name = ast.symbols.name(symbol);
        match self.find(symbol, scope, frame) {
            Some(Found::Declared(Binding::LetFunction(index))) => {
                let arity = self.lets[index].arguments.len();
                let shown = self.lets[index].shown.clone();
                self.arity(raw, arity, arguments.len(), &shown)?;
                let mut values = Vec::with_capacity(arity);
                for argument in arguments {
                    values.push(self.number(*argument, frame).map(|(value, _)| value));
                }
                self.instantiate(raw, index, values)
            }
            Some(Found::Declared(binding @ Binding::Function(id))) => {
                let arity = self.out.functions[id.0 as usize].arguments.len();
                let shown = self.function_shown(binding);
                self.arity(raw, arity, arguments.len(), &shown)?;
                let values = self.scalars(name, arguments, frame)?;
                self.push(raw, NodeKind::Function(id, values), Type::Scalar)
            }
            Some(Found::Declared(Binding::Erroneous)) => None,
            Some(found) => {
                let what = self.found_shown(found);
                let message = format!("`{name}` is {what}, not a function");
                self.refuse(raw, message, format!("write `{name}*(…)` for a product"))
            }
            None => match names::function(name) {
                Some(entry) => self.builtin(raw, &entry, arguments, frame),
                None => {
                    self.unknown_function(raw, symbol);
                    None
                }
            },
        }
    }

    fn unknown_function(&mut self, raw: ExprId, symbol: Symbol) {
        let ast = self.ast;
        let name = ast.symbols.name(symbol);
        if name == "H" {
            self.error(raw, "`H` is a value here, not a function", "write `H`");
        } else if name == "pi" {
            self.error(
                raw,
                "`pi` is a constant, not a function",
                "write `pi*(…)` for a product",
            );
        } else if names::meaning(name).is_some() {
            let message = format!("`{name}` is a word of the language, not a function");
            self.error(raw, message, "choose another name");
        } else if PRODUCTS.contains(&name) {
            let message =
                format!("`{name}` is not a function: the language has no product over a range");
            let help =
                "write the factors with `*`; of positive ones, `exp(sum(i in 0..N) { ln(…) })`";
            self.error(raw, message, help);
        } else if !self.is_early(raw, symbol)
            && !std::mem::replace(&mut self.unknown[symbol.0 as usize], true)
        {
            let help = if let Some(known) = names::synonym(name) {
                if known.contains('(') || names::function(known).is_none() {
                    format!("write `{known}`")
                } else {
                    names::function(known)
                        .map_or_else(String::new, |f| format!("write `{}`", f.signature()))
                }
            } else {
                let known = self.known_names(true);
                match names::nearest(name, known.iter().map(String::as_str)) {
                    Some(nearest) => format!("the nearest known function is `{nearest}`"),
                    None => format!(
                        "define it, `let {name}(x) = …;`, take it from Rust, `fn {name}(x) = path, (derivative);`, or write `{name}*(…)` for a product"
                    ),
                }
            };
            self.error(raw, format!("unknown function `{name}`"), help);
        }
    }

    /// The number of arguments.
    fn arity(&mut self, raw: ExprId, due: usize, given: usize, shown: &str) -> Option<()> {
        if due == given {
            return Some(());
        }
        let name = shown.split('(').next().unwrap_or(shown);
        let arguments = if due == 1 { "argument" } else { "arguments" };
        let message = format!("`{name}` takes {due} {arguments}, not {given}");
        self.refuse(raw, message, format!("write `{shown}`"))
    }

    /// Arguments that are scalars.
    fn scalars(&mut self, name: &str, arguments: &[ExprId], frame: &Frame) -> Option<Vec<NodeId>> {
        let count = arguments.len();
        self.operands(arguments, frame, Type::is_scalar, |checker, argument, ty| {
            let message = format!(
                "`{name}` takes scalars, but {} is {}",
                checker.written(argument),
                checker.type_shown(ty)
            );
            let help = match (name, ty) {
                ("abs", _) => "write `norm(…)` for the length of a vector".into(),
                (_, Type::Vector(extent)) if count == 1 => {
                    let extent = checker.extent_shown(extent);
                    let vector = checker.name_of(argument).unwrap_or("…");
                    format!(
                        "write a component, or `sum(i in 0..{extent}) {{ {name}({vector}[i]) }}`"
                    )
                }
                _ => "write a component".into(),
            };
            (message, help)
        })
    }

    /// A node as messages show it: its name, if it is a name.
    fn written(&self, raw: ExprId) -> String {
        match self.name_of(raw) {
            Some(name) => format!("`{name}`"),
            None => "this".into(),
        }
    }

    fn builtin(
        &mut self,
        raw: ExprId,
        entry: &Entry,
        arguments: &[ExprId],
        frame: &Frame,
    ) -> Option<NodeId> {
        self.arity(
            raw,
            entry.arguments.len(),
            arguments.len(),
            &entry.signature(),
        )?;
        match entry.function {
            Builtin::Elementary(_) | Builtin::Bracket => {
                let values = self.scalars(entry.name, arguments, frame)?;
                let kind = match (entry.function, values.as_slice()) {
                    (Builtin::Elementary(Op::Pow), [base, exponent]) => {
                        NodeKind::Binary(BinaryOp::Pow, *base, *exponent)
                    }
                    (Builtin::Bracket, [a, b]) => {
                        if !self.active.is_empty() {
                            return self.refuse(
                                raw,
                                "`bracket` cannot be used inside a `sum`",
                                "take the bracket of the whole sums: `bracket(sum(…) { … }, b)`",
                            );
                        }
                        NodeKind::Bracket(*a, *b)
                    }
                    (function, _) => NodeKind::Call(function, values),
                };
                self.push(raw, kind, Type::Scalar)
            }
            Builtin::Dot | Builtin::Norm | Builtin::NormSquared => {
                let values = self.vectors(entry, arguments, frame)?;
                self.equal_extents(raw, entry, &values)?;
                self.push(raw, NodeKind::Call(entry.function, values), Type::Scalar)
            }
            Builtin::Cross => {
                let values = self.vectors(entry, arguments, frame)?;
                let space = Type::Vector(Extent::Literal(3));
                for (value, argument) in values.iter().zip(arguments) {
                    let ty = self.type_of(*value);
                    if ty != space {
                        let message = format!(
                            "`{}` needs vectors `[3]`, but this is {}",
                            entry.name,
                            self.type_shown(ty)
                        );
                        let help = if ty == Type::Vector(Extent::Literal(2)) {
                            let [a, b] = [0, 1].map(|at| self.name_of(arguments[at]));
                            let (a, b) = (a.unwrap_or("a"), b.unwrap_or("b"));
                            format!("in the plane write `{a}[0]*{b}[1] - {a}[1]*{b}[0]`")
                        } else {
                            "a vector product is one of space".into()
                        };
                        self.error_over(*argument, message, help);
                        return None;
                    }
                }
                self.push(raw, NodeKind::Call(entry.function, values), space)
            }
        }
    }

    /// Arguments that are vectors.
    fn vectors(
        &mut self,
        entry: &Entry,
        arguments: &[ExprId],
        frame: &Frame,
    ) -> Option<Vec<NodeId>> {
        let name = entry.name;
        self.operands(
            arguments,
            frame,
            Type::is_vector,
            |checker, argument, ty| {
                let message = format!(
                    "`{name}` takes vectors, but {} is {}",
                    checker.written(argument),
                    checker.type_shown(ty)
                );
                let help = match (entry.function, ty) {
                    (Builtin::Norm, Type::Scalar) => "write `abs(…)`".into(),
                    (Builtin::NormSquared, Type::Scalar) => "write `(…)^2`".into(),
                    (Builtin::Dot, Type::Scalar) => "write a product, `a*b`".into(),
                    (_, Type::Matrix(rows, _)) => {
                        let rows = checker.extent_shown(rows);
                        let matrix = checker.name_of(argument).unwrap_or("…");
                        format!("write a row, `{matrix}[i]`, inside `sum(i in 0..{rows}) {{ … }}`")
                    }
                    _ => format!("write `{}` of vectors", entry.signature()),
                };
                (message, help)
            },
        )
    }

    fn equal_extents(&mut self, raw: ExprId, entry: &Entry, values: &[NodeId]) -> Option<()> {
        if let [a, b] = values
            && self.type_of(*a) != self.type_of(*b)
        {
            let message = format!(
                "`{}` needs vectors of equal extent, but these are {} and {}",
                entry.name,
                self.type_shown(self.type_of(*a)),
                self.type_shown(self.type_of(*b))
            );
            return self.refuse(raw, message, "both need the same number of components");
        }
        Some(())
    }
}
