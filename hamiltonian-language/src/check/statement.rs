//! Statements: definitions, observables, forces and pieces.
//!
//! Input: the statements, after the declarations. Output: definition, observables, forces, pieces,
//! charts. Invariant: `let`s and the definition are read in source order, before the statements
//! that may use all of them.

use super::{Binding, Checker, LetFunction, Position};
use crate::ast::{Expression, Function, Statement, StatementKind};
use crate::checked::{Definition, Extent, FunctionId, NodeId, Observable, Type};
use crate::names;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::ObservableKind;
use proc_macro2::Ident;

impl<'a> Checker<'a> {
    /// Reads `let`, `fn`, H and L, in source order.
    pub(super) fn values(&mut self) {
        let ast = self.ast;
        for statement in &ast.statements {
            if let StatementKind::Let { name, .. } | StatementKind::Function(Function { name, .. }) =
                &statement.kind
                && let Some(symbol) = self.symbol(name)
            {
                self.later[symbol.0 as usize] = true;
            }
        }
        for statement in &ast.statements {
            match &statement.kind {
                StatementKind::Let {
                    name,
                    arguments,
                    value,
                } => {
                    self.defining = self.symbol(name);
                    self.let_statement(name, arguments.as_deref(), value);
                    self.defining = None;
                }
                StatementKind::Function(function) => self.function(function),
                StatementKind::Hamiltonian { value, .. } => {
                    self.definition("H", value, Definition::Hamiltonian);
                }
                StatementKind::Lagrangian { value, .. } => {
                    self.definition("L", value, Definition::Lagrangian);
                }
                _ => {}
            }
        }
    }

    fn definition(&mut self, word: &str, value: &Expression, make: fn(NodeId) -> Definition) {
        // A second definition was reported; it is not read.
        if self.place == Position::After {
            return;
        }
        self.place = Position::Within;
        if let Some(root) = self.scalar_expression(value, &format!("`{word}`")) {
            self.out.definition = make(root);
        }
        self.place = Position::After;
    }

    fn let_statement(&mut self, name: &Ident, arguments: Option<&[Ident]>, value: &'a Expression) {
        let Some(symbol) = self.symbol(name) else {
            return;
        };
        let Some(arguments) = arguments else {
            let root = self.expression(value);
            let root = match root.map(|root| self.type_of(root)) {
                Some(Type::Bool) => {
                    self.condition_as_number(value.root);
                    None
                }
                _ => root,
            };
            self.later[symbol.0 as usize] = false;
            self.declare(name, Binding::Value(root));
            if let Some(root) = root {
                self.out.lets.push((name.clone(), root));
            }
            return;
        };
        let symbols: Vec<_> = arguments
            .iter()
            .filter_map(|name| self.symbol(name))
            .into_list();
        // The body is read once with unknown arguments, to find its own errors; shapes are checked
        // at the calls.
        let unknown = symbols.iter().map(|symbol| (*symbol, None)).into_list();
        let errors = self.report.errors().len();
        self.visit(value, unknown, &[]);
        self.lets.push(LetFunction {
            arguments: symbols,
            body: value,
            shown: format!("{name}({})", names::listed(arguments)),
            erroneous: self.report.errors().len() > errors,
        });
        self.later[symbol.0 as usize] = false;
        self.declare(name, Binding::LetFunction(self.lets.len() - 1));
    }

    fn function(&mut self, function: &Function) {
        let name = &function.name;
        let arity = function.arguments.len();
        let pairs = arity * (arity + 1) / 2;
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        if let Some(first) = &function.first
            && first.paths.len() != arity
        {
            let given = first.paths.len();
            let message = format!(
                "`{name}` takes {arity} argument{}, but {given} partial derivative{} given",
                plural(arity),
                if given == 1 { " is" } else { "s are" }
            );
            let help = "write one for each argument, in their order";
            self.report.error(first.spans, message, help);
        }
        if let Some(second) = &function.second
            && second.paths.len() != pairs
        {
            let message = format!(
                "`{name}` takes {arity} argument{}, so it has {pairs} second partial{}, not {}",
                plural(arity),
                plural(pairs),
                second.paths.len()
            );
            let help = "write the upper triangle row by row: `(xx, xy, yy)` for two arguments";
            self.report.error(second.spans, message, help);
        }
        let id = FunctionId(self.out.functions.len() as u32);
        if let Some(symbol) = self.symbol(name) {
            self.later[symbol.0 as usize] = false;
        }
        self.declare(name, Binding::Function(id));
        self.out.functions.push(function.clone());
    }

    /// Reads all other statements.
    pub(super) fn claims(&mut self) {
        let ast = self.ast;
        for statement in &ast.statements {
            match &statement.kind {
                StatementKind::Observable {
                    kind,
                    assumed,
                    name,
                    value,
                    shell,
                } => {
                    self.observable(statement, *kind, *assumed, name, value, shell.as_ref());
                }
                StatementKind::Split { assumed, pieces } => {
                    self.split(statement, *assumed, pieces);
                }
                StatementKind::Force { signature, value } => {
                    self.force(statement, signature, value)
                }
                StatementKind::Time { factor } => {
                    if self.out.time_factor.is_some() {
                        self.once(statement, "dt");
                        continue;
                    }
                    let factor = self.scalar_expression(factor, "the factor of `ds`");
                    if let Some(factor) = factor {
                        self.out.time_factor = Some((factor, statement.keyword));
                    }
                }
                StatementKind::Coordinates { chart, arguments } => self.chart(chart, arguments),
                _ => {}
            }
        }
    }

    pub(super) fn once(&mut self, statement: &Statement, word: &str) {
        let message = format!("`{word}` is given twice");
        self.report.error(statement.keyword, message, "keep one");
    }

    fn observable(
        &mut self,
        statement: &Statement,
        kind: ObservableKind,
        assumed: bool,
        name: &Ident,
        value: &Expression,
        shell: Option<&Expression>,
    ) {
        // A `let` may have the name of an observable, which no expression reads.
        let symbol = self.symbol(name);
        let variable = symbol.and_then(|symbol| match self.bindings[symbol.0 as usize] {
            Some(Binding::Value(_) | Binding::LetFunction(_) | Binding::Function(_)) | None => None,
            variable => variable,
        });
        let fault = if let Some(variable) = variable {
            let what = self.described(variable);
            Some(format!(
                "the name `{name}` is used twice: it is {what} already"
            ))
        } else if self.out.observables.iter().any(|other| other.name == *name) {
            let fault = format!("the name `{name}` is used twice: an observable has it already");
            Some(fault)
        } else if names::is_method(&name.to_string()) {
            Some(format!("`{name}` is a method of every system already"))
        } else {
            None
        };
        if let Some(fault) = fault {
            self.report.error(name.span(), fault, "choose another name");
        }
        let word = kind.word();
        let value = match kind {
            ObservableKind::Event => self.event(value),
            _ => self.components(value, word),
        };
        let shell = match shell {
            Some(shell) => self
                .scalar_expression(shell, "the energy of a shell")
                .map(Some),
            None => Some(None),
        };
        if let (Some(value), Some(shell)) = (value, shell) {
            self.out.observables.push(Observable {
                attributes: statement.attributes.clone(),
                kind,
                assumed,
                name: name.clone(),
                value,
                shell,
            });
        }
    }

    /// A scalar or a vector of literal extent.
    fn components(&mut self, value: &Expression, word: &str) -> Option<NodeId> {
        let root = self.expression(value)?;
        let ty = self.type_of(root);
        match ty {
            Type::Scalar | Type::Vector(Extent::Literal(_)) => return Some(root),
            Type::Bool => self.condition_as_number(value.root),
            Type::Vector(_) | Type::Matrix(..) | Type::Array(_) => {
                let article = if word == "invariant" { "an" } else { "a" };
                let message = format!(
                    "{article} {word} is a scalar or a vector of known extent, but this is {}",
                    self.type_shown(ty)
                );
                self.error_over(
                    value.root,
                    message,
                    "write one component, or `sum(i in 0..N) { … }`",
                );
            }
        }
        None
    }

    fn split(&mut self, statement: &Statement, assumed: bool, pieces: &'a [(Ident, Expression)]) {
        if !self.out.split.is_empty() {
            self.once(statement, "split");
            return;
        }
        self.out.split_assumed = assumed;
        for (name, value) in pieces {
            let what = format!("the piece `{name}`");
            if let Some(item) = &self.ast.item
                && ["Vector", "Declared"].iter().any(|made| name == made)
            {
                let made = format!(
                    "`{}{name}` names the vectors of such a definition",
                    item.header.name
                );
                self.report
                    .error(name.span(), made, "give the piece another name");
            }
            self.in_split = true;
            let value = self.scalar_expression(value, &what);
            self.in_split = false;
            if let Some(value) = value {
                self.out.split.push((name.clone(), value));
            }
        }
    }
}
