//! Meanings of names in expressions.
//!
//! Input: a name and where it stands. Output: its node, or one error for each unknown name.
//! Invariant: inner names win (loop variables, then arguments, then declarations).

use super::expr::Frame;
use super::{Binding, Checker, Position};
use crate::ast::{ExprId, LoopVariableId, StatementKind, Symbol};
use crate::checked::{CaptureId, NodeId, NodeKind, Type, Variable};
use crate::names;
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::Ident;

/// A name that is known where it is used.
pub(super) enum Found {
    /// A loop variable; `None` if its range is erroneous.
    Loop(Option<Domain>),
    Argument(Option<NodeId>),
    Declared(Binding),
}

impl Checker<'_> {
    /// The binding of a name, if it is declared.
    pub(super) fn find(
        &self,
        symbol: Symbol,
        scope: Option<LoopVariableId>,
        frame: &Frame,
    ) -> Option<Found> {
        let mut inner = scope;
        while let Some(id) = inner {
            let scope = &self.ast.scopes[id.0 as usize];
            if scope.symbol == symbol {
                return Some(Found::Loop(self.scope_loops[id.0 as usize]));
            }
            inner = scope.parent;
        }
        if let Some((_, value)) = frame.arguments.iter().find(|(name, _)| *name == symbol) {
            return Some(Found::Argument(*value));
        }
        self.bindings[symbol.0 as usize].map(Found::Declared)
    }

    /// The kind of a meaning, in words.
    pub(super) fn found_shown(&self, found: Found) -> &'static str {
        match found {
            Found::Loop(_) => "a loop variable",
            Found::Argument(_) => "an argument",
            Found::Declared(binding) => self.described(binding),
        }
    }

    /// The node of a name that is used as a value.
    pub(super) fn name(
        &mut self,
        raw: ExprId,
        symbol: Symbol,
        scope: Option<LoopVariableId>,
        frame: &Frame,
    ) -> Option<NodeId> {
        let binding = match self.find(symbol, scope, frame) {
            Some(Found::Loop(id)) => {
                let id = id?;
                return self.push_affine(
                    raw,
                    NodeKind::Loop(id),
                    Type::Scalar,
                    Some(Affine::variable(id)),
                );
            }
            Some(Found::Argument(value)) => return value,
            Some(Found::Declared(binding)) => binding,
            None => return self.undeclared(raw, symbol),
        };
        match binding {
            Binding::Value(value) => value,
            Binding::Erroneous => None,
            Binding::Time => self.push(raw, NodeKind::Time, Type::Scalar),
            Binding::Size(id) => self.push_affine(
                raw,
                NodeKind::Size(id),
                Type::Scalar,
                Some(Affine::size(id)),
            ),
            Binding::Parameter(id) => {
                let ty = self.out.parameters[id.0 as usize].ty;
                self.push(raw, NodeKind::Parameter(id), ty)
            }
            Binding::Phase(Variable::Momentum, id)
                if self.is_lagrangian() && self.place != Position::After =>
            {
                let group = &self.out.groups[id.0 as usize];
                let message = format!(
                    "`{}` is a momentum, which `L` itself defines",
                    group.momentum
                );
                let help = match &group.velocity {
                    Some(velocity) => format!("write the velocity `{velocity}`"),
                    None => "write the velocity".into(),
                };
                self.refuse(raw, message, help)
            }
            Binding::Phase(variable, id) => {
                let ty = self.out.groups[id.0 as usize].ty;
                self.push(raw, NodeKind::Phase(variable, id), ty)
            }
            Binding::LetFunction(_) | Binding::Function(_) => {
                let name = self.ast.symbols.name(symbol);
                let arguments = self.function_shown(binding);
                let message = format!("`{name}` is a function, not a value");
                self.refuse(raw, message, format!("write `{arguments}`"))
            }
        }
    }

    /// `f(x, y)` as it was declared.
    pub(super) fn function_shown(&self, binding: Binding) -> String {
        match binding {
            Binding::LetFunction(index) => self.lets[index].shown.clone(),
            Binding::Function(id) => {
                let function = &self.out.functions[id.0 as usize];
                format!("{}({})", function.name, names::listed(&function.arguments))
            }
            _ => String::new(),
        }
    }

    /// A name without a declaration: a word of the language, a capture, or a mistake.
    fn undeclared(&mut self, raw: ExprId, symbol: Symbol) -> Option<NodeId> {
        let ast = self.ast;
        let name = ast.symbols.name(symbol);
        if name == "pi" {
            return self.push(raw, NodeKind::Pi, Type::Scalar);
        }
        if name == "H" {
            return self.hamiltonian(raw);
        }
        if let Some((group, variable, chart)) = self.new_of_bodies(name) {
            if self.in_split {
                let ty = self.out.groups[group.0 as usize].ty;
                return self.push(raw, NodeKind::Phase(variable, group), ty);
            }
            let message = format!(
                "`{name}` is a variable of `coordinates {chart}`, which only `split` reads"
            );
            let help = "write it in the declared coordinates and momenta";
            return self.refuse(raw, message, help);
        }
        let is_captured = ast.item.is_none() && names::is_hidden(name);
        if let Some(function) = names::function(name).filter(|_| !is_captured) {
            let message = format!("`{name}` is a function, not a value");
            return self.refuse(raw, message, format!("write `{}`", function.signature()));
        }
        if names::meaning(name).is_some() {
            let help = match name {
                "ds" | "dt" => "it belongs to a statement of its own: `dt = (…)*ds`",
                _ => "choose another name",
            };
            return self.refuse(
                raw,
                format!("`{name}` is a word of the language and not a value"),
                help,
            );
        }
        if self.is_early(raw, symbol)
            || std::mem::replace(&mut self.unknown[symbol.0 as usize], true)
        {
            return None;
        }
        if self.loop_symbols[symbol.0 as usize] {
            let message =
                format!("`{name}` is a loop variable and means nothing outside its `sum`");
            return self.refuse(raw, message, "write it inside the braces of the `sum`");
        }
        if name == "t" {
            let help = format!("declare it: `{}`", self.signature_with_time());
            return self.refuse(raw, "`t` is not declared", help);
        }
        if names::is_rust_keyword(name) {
            let message = format!("`{name}` is a keyword of Rust and not a value");
            return self.refuse(raw, message, "choose another name");
        }
        if let Some(new) = self.new_scalar(name) {
            let (chart, replaced) = (new.chart.clone(), names::listed(new.arguments));
            if self.in_split {
                self.unknown[symbol.0 as usize] = false;
                let (variable, place) = (new.variable, self.replaced_by(&new));
                let (group, row) = place?;
                let ty = self.out.groups[group.0 as usize].ty;
                let base = self.push(raw, NodeKind::Phase(variable, group), ty)?;
                let Some(row) = row else { return Some(base) };
                let index = Index::constant(i64::from(row));
                return self.push(raw, NodeKind::Index { base, index }, Type::Scalar);
            }
            let message = format!(
                "`{name}` is a variable of `coordinates {chart}`, which only `split` reads"
            );
            let help = format!("write it in `{replaced}` and their momenta");
            return self.refuse(raw, message, help);
        }
        if ast.item.is_none() {
            self.unknown[symbol.0 as usize] = false;
            return self.capture(raw, symbol);
        }
        let help = self.help_for_unknown(name);
        self.refuse(raw, format!("unknown name `{name}`"), help)
    }

    /// Returns true if a name is used in its own definition or above it, which is an error.
    pub(super) fn is_early(&mut self, raw: ExprId, symbol: Symbol) -> bool {
        let name = self.ast.symbols.name(symbol);
        let is_own = self.defining == Some(symbol);
        let is_later = self.later[symbol.0 as usize];
        if is_own {
            let message = format!("`{name}` is defined in terms of itself");
            self.error(raw, message, "a `let` uses only names defined above it");
        } else if is_later {
            let message = format!("`{name}` is used above its definition");
            let help = format!("move the definition of `{name}` above this statement");
            self.error(raw, message, help);
        }
        is_own || is_later
    }

    /// The known name that was probably meant.
    fn help_for_unknown(&self, name: &str) -> String {
        if let Some(known) = names::synonym(name) {
            return format!("write `{known}`");
        }
        let observables = self.ast.statements.iter().filter_map(|s| match &s.kind {
            StatementKind::Observable { kind, name, .. } => Some((kind, name)),
            _ => None,
        });
        if let Some((kind, _)) = observables.into_iter().find(|(_, given)| *given == name) {
            return format!(
                "`{} {name}` is not read by other statements; write its formula as a `let` above both",
                kind.word()
            );
        }
        let mut known = self.known_names(false);
        if self.is_lagrangian() && self.place == Position::After {
            known.extend(self.out.groups.iter().map(|g| g.momentum.to_string()));
            if name == "p" || name.starts_with("p_") {
                let momenta = self.out.groups.iter().map(|g| format!("`{}`", g.momentum));
                let momenta = momenta.into_list();
                return format!("the momenta of this Lagrangian are {}", momenta.join(", "));
            }
        }
        if let Some(nearest) = names::nearest(name, known.iter().map(String::as_str)) {
            return format!("the nearest known name is `{nearest}`");
        }
        if let Some(longer) = known.iter().find(|known| known.starts_with(name)) {
            return format!("the nearest known name is `{longer}`");
        }
        match &self.ast.item {
            Some(item) => {
                let number = match name {
                    "e" => "; Euler's number is `exp(1)`",
                    _ => "",
                };
                format!(
                    "declare it: a parameter of `{}`, such as `{name} = 1.0`, a size, `{name}: usize`, or `let {name} = …;`{number}",
                    item.header.name
                )
            }
            None => format!("declare it: `let {name} = …;`"),
        }
    }

    /// All declared names of functions, or of values, in the order of declaration.
    pub(super) fn known_names(&self, functions: bool) -> Vec<String> {
        let mut known = Vec::new();
        for (index, binding) in self.bindings.iter().enumerate() {
            let is_function = matches!(
                binding,
                Some(Binding::LetFunction(_) | Binding::Function(_))
            );
            if binding.is_some() && is_function == functions {
                known.push(self.ast.symbols.name(Symbol(index as u32)).to_owned());
            }
        }
        if functions {
            known.extend(names::functions().map(|entry| entry.name.to_owned()));
        } else {
            // The `q` and `p` of `H = …` are implicit.
            for group in &self.out.groups {
                for name in [&group.coordinate, group.partner()].map(Ident::to_string) {
                    if !known.contains(&name) {
                        known.push(name);
                    }
                }
            }
            known.extend(names::CONSTANTS.iter().map(|name| (*name).to_owned()));
        }
        known
    }

    /// `H` as a value.
    fn hamiltonian(&mut self, raw: ExprId) -> Option<NodeId> {
        match (self.place, self.is_lagrangian()) {
            (Position::After, _) => self.push(raw, NodeKind::Hamiltonian, Type::Scalar),
            (Position::Within, false) => self.refuse(
                raw,
                "`H` is defined in terms of itself",
                "H depends on coordinates, momenta, time and parameters",
            ),
            (Position::Within, true) => self.refuse(
                raw,
                "`H` follows from `L` and cannot define it",
                "write it in terms of coordinates and velocities",
            ),
            (Position::Before, _) => self.refuse(
                raw,
                "`H` is used above its definition",
                "move this statement below the definition of `H`",
            ),
        }
    }

    /// A name of the scope around the macro.
    fn capture(&mut self, raw: ExprId, symbol: Symbol) -> Option<NodeId> {
        let name = self.ast.symbols.name(symbol);
        let known = self.out.captures.iter().position(|capture| capture == name);
        let index = known.unwrap_or_else(|| {
            self.out
                .captures
                .push(Ident::new(name, self.ast.nodes[raw.0 as usize].at.start));
            self.out.captures.len() - 1
        });
        self.push(
            raw,
            NodeKind::Capture(CaptureId(index as u32)),
            Type::Scalar,
        )
    }
}
