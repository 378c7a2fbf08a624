//! Declarations: sizes and parameters of the header, coordinates and momenta of the signature.
//!
//! Input: the header and the definition statement. Output: sizes, parameters, groups, time, and
//! what their names stand for. Invariant: every name is declared once.

use super::{Binding, Checker};
use crate::ast::{Expression, ParameterKind, Signature, Size, StatementKind, Variable};
use crate::checked::{
    Extent, Field, Group, GroupId, Item, Kind, NodeId, Parameter, ParameterId, Size as CheckedSize,
    SizeId, SizeKind, Type,
};
use proc_macro2::{Ident, Span};
use quote::format_ident;

/// The most numbers of an array whose size is a literal: such arrays live on the stack, a scheme holds
/// tens of them, and a thread may have no more than 2 MB.
const LARGEST: u64 = 1 << 12;

impl Checker<'_> {
    /// Lets a name stand for something, unless it does already.
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

    /// The header of item form. Whether the statements are worth reading.
    pub(super) fn header(&mut self) -> bool {
        let ast = self.ast;
        if let Some(item) = &ast.item {
            if item.name == "T" {
                self.report.error(
                    item.name.span(),
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
                self.size(name, SizeKind::Const, Vec::new());
            }
            for parameter in &item.parameters {
                if matches!(parameter.kind, ParameterKind::Size) {
                    self.size(
                        &parameter.name,
                        SizeKind::Runtime,
                        parameter.attributes.clone(),
                    );
                }
            }
            let mut fields = Vec::new();
            let mut next_size = item.generics.len();
            for parameter in &item.parameters {
                let ty = match &parameter.kind {
                    ParameterKind::Size => {
                        fields.push(Field::Size(SizeId(next_size as u32)));
                        next_size += 1;
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
                fields.push(Field::Parameter(id));
                self.out.parameters.push(Parameter {
                    attributes: parameter.attributes.clone(),
                    name: parameter.name.clone(),
                    ty: ty.unwrap_or(Type::Scalar),
                    default,
                });
            }
            self.out.item = Some(Item {
                attributes: item.attributes.clone(),
                max_ops: item.max_ops,
                visibility: item.visibility.clone(),
                name: item.name.clone(),
                fields,
            });
        }
        self.one_definition()
    }

    /// The numbers of a default, if that is what it is.
    fn default_value(
        &mut self,
        name: &Ident,
        ty: Type,
        default: &Expression,
    ) -> Option<Vec<NodeId>> {
        let value = self.expression(default)?;
        let at = self.out.node(value).spans;
        let found = self.type_of(value);
        if found != ty || matches!(ty, Type::Matrix(..)) {
            let message = format!(
                "the default of `{name}` is {}, but the parameter is {}",
                self.type_shown(found),
                self.type_shown(ty)
            );
            let help = match ty {
                Type::Vector(Extent::Literal(_)) => {
                    "write one number for each component: `[1.0, 2.0]`"
                }
                Type::Scalar => "write one number",
                _ => {
                    "remove it and give the value to `new`: an array with a default is a vector of a literal length"
                }
            };
            self.report.error(at, message, help);
            return None;
        }
        let mut pending = vec![value];
        while let Some(id) = pending.pop() {
            let node = self.out.node(id);
            match &node.kind {
                Kind::Number(_)
                | Kind::Pi
                | Kind::Neg(_)
                | Kind::Add(..)
                | Kind::Sub(..)
                | Kind::Mul(..)
                | Kind::Div(..)
                | Kind::Pow(..)
                | Kind::Vector(_)
                | Kind::Call(..) => node.kind.for_each_child(|child| pending.push(child)),
                _ => {
                    let message = format!("the default of `{name}` is not made of numbers alone");
                    let help = "write a number, such as `0.5`, `2/3` or `pi/4`";
                    self.report.error(node.spans, message, help);
                    return None;
                }
            }
        }
        match &self.out.node(value).kind {
            Kind::Vector(items) => Some(items.clone()),
            _ if ty == Type::Scalar => Some(vec![value]),
            _ => {
                let help = "write one number for each component: `[1.0, 2.0]`";
                let message = format!("the default of `{name}` is not a list of numbers");
                self.report.error(at, message, help);
                None
            }
        }
    }

    fn size(&mut self, name: &Ident, kind: SizeKind, attributes: Vec<proc_macro2::TokenStream>) {
        let id = SizeId(self.out.sizes.len() as u32);
        self.declare(name, Binding::Size(id));
        self.out.sizes.push(CheckedSize {
            name: name.clone(),
            kind,
            attributes,
        });
    }

    fn array(&mut self, sizes: &[Size]) -> Option<Type> {
        let literal = |size: &Size| match size {
            Size::Literal(value, _) => Some(*value),
            Size::Name(_) => None,
        };
        let numbers = sizes.iter().filter_map(literal);
        let numbers = numbers.fold(1u64, u64::saturating_mul);
        if numbers > LARGEST {
            let rows = &sizes[0];
            let message = format!(
                "an array of {numbers} numbers does not fit on the stack, where at most {LARGEST} may stand"
            );
            let help = "set the size at run time, which keeps the numbers on the heap: `pub struct Name { n: usize }` and `[n]`";
            self.report.error(rows.span(), message, help);
            return None;
        }
        match sizes {
            [] => Some(Type::Scalar),
            [size] => Some(Type::Vector(self.extent(size)?)),
            [rows, columns, ..] => {
                let (rows, columns) = (self.extent(rows), self.extent(columns));
                Some(Type::Matrix(rows?, columns?))
            }
        }
    }

    /// Exactly one H or L.
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
                item.name.span(),
                format!("`{}` has no Hamiltonian", item.name),
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

    /// The signature of the definition. Whether its names are known.
    pub(super) fn signature(&mut self) -> bool {
        let ast = self.ast;
        for statement in &ast.statements {
            match &statement.kind {
                StatementKind::Hamiltonian {
                    signature: Some(signature),
                    ..
                } => {
                    return self.groups(signature, false);
                }
                StatementKind::Hamiltonian {
                    signature: None, ..
                } => {
                    return self.implicit_group(statement.keyword);
                }
                StatementKind::Lagrangian { signature, .. } => {
                    return self.groups(signature, true);
                }
                _ => {}
            }
        }
        false
    }

    /// `H = …` is short for `H(q; p) = …`.
    fn implicit_group(&mut self, keyword: Span) -> bool {
        let (q, p) = (Ident::new("q", keyword), Ident::new("p", keyword));
        for name in [&q, &p] {
            let taken = self
                .symbol(name)
                .and_then(|symbol| self.bindings[symbol.0 as usize]);
            if let Some(earlier) = taken {
                let what = self.described(earlier);
                self.report.error(
                    keyword,
                    format!("`H = …` is short for `H(q; p) = …`, but `{name}` is {what} already"),
                    "name the coordinates: `H(x; p_x) = …`",
                );
                return false;
            }
        }
        self.group(q, p, None, Some(Type::Scalar));
        true
    }

    /// `ty` is `None` if the shape is erroneous.
    fn group(
        &mut self,
        coordinate: Ident,
        momentum: Ident,
        velocity: Option<Ident>,
        ty: Option<Type>,
    ) {
        let id = GroupId(self.out.groups.len() as u32);
        let known = |binding| {
            if ty.is_some() {
                binding
            } else {
                Binding::Erroneous
            }
        };
        self.declare(&coordinate, known(Binding::Coordinate(id)));
        match &velocity {
            Some(velocity) => {
                self.declare(velocity, known(Binding::Velocity(id)));
                // Not declared by its author: anything else of that name wins.
                if let Some(symbol) = self.symbol(&momentum)
                    && self.bindings[symbol.0 as usize].is_none()
                {
                    self.bindings[symbol.0 as usize] = Some(known(Binding::Momentum(id)));
                }
            }
            None => self.declare(&momentum, known(Binding::Momentum(id))),
        }
        let ty = ty.unwrap_or(Type::Scalar);
        self.out.groups.push(Group {
            coordinate,
            momentum,
            velocity,
            ty,
        });
    }

    fn groups(&mut self, signature: &Signature, lagrangian: bool) -> bool {
        let (word, partner, partners, prefix) = if lagrangian {
            ("L", "velocity", "velocities", "v_")
        } else {
            ("H", "momentum", "momenta", "p_")
        };
        let coordinates = &signature.sections[0];
        let others = signature.sections.get(1).map_or(&[][..], Vec::as_slice);
        if coordinates.is_empty() || others.is_empty() {
            let help = format!("write `{}`", suggested(word, prefix, coordinates));
            let what = if coordinates.is_empty() {
                "coordinates"
            } else {
                partners
            };
            self.report.error(
                signature.spans,
                format!("the signature names no {what}"),
                help,
            );
            return false;
        }
        if coordinates.len() != others.len() {
            self.partner_missing(signature, word, partner, prefix);
            return false;
        }
        let last = coordinates[coordinates.len() - 1].name.span();
        if !self.are_numbered(coordinates.len(), ("coordinates", "q"), last) {
            return false;
        }
        if self.is_interleaved(coordinates, others, word)
            || self.is_crossed(coordinates, others, word)
        {
            return false;
        }
        for (coordinate, other) in coordinates.iter().zip(others) {
            let ty = self
                .variable_type(coordinate)
                .filter(|due| self.same_shape(coordinate, other, *due));
            let name = coordinate.name.clone();
            if lagrangian {
                let momentum = format_ident!("p_{name}", span = name.span());
                self.group(name, momentum, Some(other.name.clone()), ty);
            } else {
                self.group(name, other.name.clone(), None, ty);
            }
        }
        self.time(signature, word);
        true
    }

    /// Whether names of momenta (velocities) stand among the coordinates, as in
    /// `H(x, p_x; y, p_y)`, which would make y the momentum of x. Where such a coordinate has a
    /// momentum that is named after it, it was meant.
    fn is_interleaved(
        &mut self,
        coordinates: &[Variable],
        others: &[Variable],
        word: &str,
    ) -> bool {
        let all = || coordinates.iter().chain(others);
        let names: Vec<(&Variable, String)> = all().map(|v| (v, v.name.to_string())).collect();
        let owner = |variable: &Variable| {
            let name = variable.name.to_string();
            let mut names = names.iter();
            let found = names.find(|(_, of)| is_partner_of(&name, of, word));
            found.map(|(variable, _)| *variable)
        };
        let mut found = false;
        for (coordinate, other) in coordinates.iter().zip(others) {
            let name = coordinate.name.to_string();
            let Some(of) = owner(coordinate) else {
                continue;
            };
            if is_partner_of(&other.name.to_string(), &name, word) {
                continue;
            }
            found = true;
            let (partner, partners) = if word == "L" {
                ("velocity", "velocities")
            } else {
                ("momentum", "momenta")
            };
            let (second, first): (Vec<&Variable>, Vec<&Variable>) =
                all().partition(|variable| owner(variable).is_some());
            let help = if first.len() == second.len() {
                let (first, second) = (list(first), list(second));
                format!("coordinates first, then {partners}: `{word}({first}; {second})`")
            } else {
                format!("coordinates come first, {partners} after the `;`")
            };
            let message = format!(
                "`{name}` is listed among the coordinates, but has the name of the {partner} of `{}`",
                of.name
            );
            self.report.error(coordinate.name.span(), message, help);
        }
        found
    }

    /// Whether a momentum (velocity) has the name of another coordinate's, as in `H(x, y; p_y, p_x)`,
    /// which would make p_y the momentum of x.
    fn is_crossed(&mut self, coordinates: &[Variable], others: &[Variable], word: &str) -> bool {
        let partner_of = |of: &Variable| {
            let of = of.name.to_string();
            let is = |other: &&Variable| is_partner_of(&other.name.to_string(), &of, word);
            others.iter().find(is)
        };
        let mut found = false;
        for (coordinate, other) in coordinates.iter().zip(others) {
            let name = other.name.to_string();
            let is = |of: &&Variable| is_partner_of(&name, &of.name.to_string(), word);
            let Some(owner) = coordinates.iter().find(is) else {
                continue;
            };
            if is_partner_of(&name, &coordinate.name.to_string(), word) {
                continue;
            }
            found = true;
            let partner = if word == "L" { "velocity" } else { "momentum" };
            let ordered: Option<Vec<&Variable>> = coordinates.iter().map(partner_of).collect();
            let help = match ordered {
                Some(ordered) => format!(
                    "in the order of the coordinates: `{word}({}; {})`",
                    list(coordinates),
                    list(ordered)
                ),
                None => format!("the {partner} in a place is that of the coordinate in this place"),
            };
            let message = format!(
                "`{name}` stands in the place of the {partner} of `{}`, but has the name of that of `{}`",
                coordinate.name, owner.name
            );
            self.report.error(other.name.span(), message, help);
        }
        found
    }

    /// Coordinates without momentum (velocity) or the other way round.
    fn partner_missing(&mut self, signature: &Signature, word: &str, partner: &str, prefix: &str) {
        let (coordinates, others) = (&signature.sections[0], &signature.sections[1]);
        for coordinate in coordinates.iter().skip(others.len()) {
            let missing = coordinates.iter().skip(others.len());
            let added: Vec<String> = missing
                .map(|coordinate| format!("{prefix}{}", coordinate.name))
                .collect();
            let help = format!(
                "write `{word}({}; {}, {})`",
                list(coordinates),
                list(others),
                added.join(", ")
            );
            let name = &coordinate.name;
            let message = format!("the coordinate `{name}` has no {partner}");
            self.report.error(name.span(), message, help);
        }
        for other in others.iter().skip(coordinates.len()) {
            let message = format!("the {partner} `{}` has no coordinate", other.name);
            let help = if other.name == "t" {
                let others = list(&others[..coordinates.len()]);
                format!(
                    "write time after a `;`: `{word}({}; {others}; t)`",
                    list(coordinates)
                )
            } else {
                format!("write as many coordinates before the `;` as after it: `{word}(x, y; …)`")
            };
            self.report.error(other.name.span(), message, help);
        }
    }

    /// Whether a momentum (velocity) has the shape of its coordinate.
    fn same_shape(&mut self, coordinate: &Variable, other: &Variable, due: Type) -> bool {
        let Some(found) = self.variable_type(other) else {
            return false;
        };
        if found == due {
            return true;
        }
        let message = format!(
            "`{}` is {}, but its coordinate `{}` is {}",
            other.name,
            self.type_shown(found),
            coordinate.name,
            self.type_shown(due)
        );
        let help = format!("write `{}{}`", other.name, self.extents_shown(due));
        self.report.error(other.name.span(), message, help);
        false
    }

    /// The third section.
    fn time(&mut self, signature: &Signature, word: &str) {
        let partner = if word == "L" { "v" } else { "p" };
        let form = format!("write `{word}(q; {partner}; t)`");
        match signature.sections.get(2).map(Vec::as_slice) {
            None => {}
            Some([time]) if time.sizes.is_empty() => {
                self.declare(&time.name, Binding::Time);
                self.out.time = Some(time.name.clone());
            }
            Some([]) => self.report.error(
                signature.spans,
                "the signature ends in `;` but names no time",
                format!("{form}, or remove the `;`"),
            ),
            Some([first, ..]) => {
                self.report
                    .error(first.name.span(), "time is one scalar", form.clone());
            }
        }
        if let Some(fourth) = signature.sections.get(3) {
            let span = fourth
                .first()
                .map_or(signature.spans.end, |variable| variable.name.span());
            let message = "time is the last entry of a signature";
            self.report.error(span, message, form);
        }
    }

    /// The shape of a coordinate or momentum.
    fn variable_type(&mut self, variable: &Variable) -> Option<Type> {
        let ty = self.array(&variable.sizes)?;
        if let (Type::Matrix(_, Extent::Size(_)), Some(last)) = (ty, variable.sizes.last()) {
            let message = format!("the last extent of `{}` is not a number", variable.name);
            let help = format!("write a number there: `{}[n][3]`", variable.name);
            self.report.error(last.span(), message, help);
            return None;
        }
        Some(ty)
    }
}

/// A signature that may have been meant.
fn suggested(word: &str, prefix: &str, names: &[Variable]) -> String {
    let partner = if word == "L" { "v" } else { "p" };
    match names {
        [] => format!("{word}(q; {partner})"),
        [name] if name.name == "q" => format!("{word}(q; {partner})"),
        _ if names.len().is_multiple_of(2) => {
            let (coordinates, others) = names.split_at(names.len() / 2);
            format!("{word}({}; {})", list(coordinates), list(others))
        }
        _ => {
            let partners: Vec<String> = names
                .iter()
                .map(|variable| format!("{prefix}{}", variable.name))
                .collect();
            format!("{word}({}; {})", list(names), partners.join(", "))
        }
    }
}

/// Whether `name` is what the momentum (velocity) of `of` is called: `p_x` and `px` belong to `x`,
/// `p1` belongs to `q1`.
fn is_partner_of(name: &str, of: &str, word: &str) -> bool {
    let prefix = if word == "L" { 'v' } else { 'p' };
    let Some(rest) = name.strip_prefix(prefix) else {
        return false;
    };
    rest.strip_prefix('_') == Some(of) || rest == of || of.strip_prefix('q') == Some(rest)
}

fn list<'a>(variables: impl IntoIterator<Item = &'a Variable>) -> String {
    let names: Vec<String> = variables
        .into_iter()
        .map(|variable| variable.name.to_string())
        .collect();
    names.join(", ")
}
