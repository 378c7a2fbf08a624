//! The signature: coordinates, momenta (velocities), and time.
//!
//! Input: the definition statement. Output: groups and time, and the bindings of
//! their names.
//! Invariant: each coordinate has a partner of its shape.

use super::{Binding, Checker};
use crate::ast::{Declarator, Signature, Size, StatementKind};
use crate::checked::{Extent, Group, GroupId, Type, Variable};
use crate::names::listed;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Ident, Span};
use quote::format_ident;
use std::collections::HashMap;

/// The largest last extent whose columns are written out, each an array of its own.
const WRITTEN_OUT: u64 = 4;

/// The largest last extent of coordinates of a Lagrangian whose columns are written out, so that the mass matrix
/// may couple them.
const COUPLED: u64 = 16;

/// The largest number of elements of a lattice with literal extents.
const LARGEST: i64 = 1 << 32;

/// The largest last extent whose columns are written out.
fn written_out(lagrangian: bool) -> u64 {
    if lagrangian { COUPLED } else { WRITTEN_OUT }
}

impl Checker<'_> {
    /// Declares the signature of the definition. Returns true if its names are known.
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
        self.declare(&coordinate, known(Binding::Phase(Variable::Coordinate, id)));
        match &velocity {
            Some(velocity) => {
                self.declare(velocity, known(Binding::Phase(Variable::Velocity, id)));
                // The author did not declare it: any other meaning of the name takes precedence.
                if let Some(symbol) = self.symbol(&momentum)
                    && self.bindings[symbol.0 as usize].is_none()
                {
                    self.bindings[symbol.0 as usize] =
                        Some(known(Binding::Phase(Variable::Momentum, id)));
                }
            }
            None => self.declare(&momentum, known(Binding::Phase(Variable::Momentum, id))),
        }
        let ty = ty.unwrap_or(Type::Scalar);
        let is_lattice = match ty {
            Type::Matrix(_, Extent::Literal(columns)) => columns > written_out(velocity.is_some()),
            Type::Matrix(..) | Type::Array(_) => true,
            _ => false,
        };
        self.out.groups.push(Group {
            coordinate,
            momentum,
            velocity,
            ty,
            is_lattice,
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
        if self.is_misplaced(coordinates, others, word) {
            return false;
        }
        for (coordinate, other) in coordinates.iter().zip(others) {
            let ty = self
                .variable_type(coordinate, lagrangian)
                .filter(|due| self.same_shape(coordinate, other, *due, lagrangian));
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

    /// Returns true if a momentum (velocity) stands among the coordinates, `H(x, p_x; y, p_y)`, or
    /// in the place of another's, `H(x, y; p_y, p_x)`. A coordinate whose own momentum is named
    /// after it is not such a case.
    fn is_misplaced(
        &mut self,
        coordinates: &[Declarator],
        others: &[Declarator],
        word: &str,
    ) -> bool {
        let all = || coordinates.iter().chain(others);
        let (owners, of_coordinates) = (
            Owners::new(all(), word),
            Owners::new(coordinates.iter(), word),
        );
        let mut pairs = coordinates.iter().zip(others);
        let wrong = pairs.find_map(|(coordinate, other)| {
            let owned = match (owners.of(coordinate), of_coordinates.of(other)) {
                (Some(owner), _) => (coordinate, owner),
                (None, owner) => (other, owner?),
            };
            (!owners.is_of(other, coordinate)).then_some(owned)
        });
        let Some((name, owner)) = wrong else {
            return false;
        };
        let (partner, partners) = match word {
            "L" => ("velocity", "velocities"),
            _ => ("momentum", "momenta"),
        };
        let (second, first): (Vec<&Declarator>, Vec<&Declarator>) =
            all().partition(|variable| owners.of(variable).is_some());
        let partner_of = |first: &&Declarator| {
            let mut second = second.iter().copied();
            second.find(|second| owners.is_of(second, first))
        };
        let ordered: Option<Vec<&Declarator>> = first.iter().map(partner_of).collect();
        let rule = format!("coordinates come first, then their {partners} in the same order");
        let help = match ordered.filter(|ordered| ordered.len() == second.len()) {
            Some(ordered) => format!("{rule}: `{word}({}; {})`", list(first), list(ordered)),
            None => rule,
        };
        let message = format!(
            "`{}` has the name of the {partner} of `{}`, but does not stand in its place",
            name.name, owner.name
        );
        self.report.error(name.name.span(), message, help);
        true
    }

    /// Reports coordinates without momentum (velocity), and the reverse.
    fn partner_missing(&mut self, signature: &Signature, word: &str, partner: &str, prefix: &str) {
        let (coordinates, others) = (&signature.sections[0], &signature.sections[1]);
        for coordinate in coordinates.iter().skip(others.len()) {
            let missing = coordinates.iter().skip(others.len());
            let added = listed(missing.map(|coordinate| format!("{prefix}{}", coordinate.name)));
            let help = format!(
                "write `{word}({}; {}, {})`",
                list(coordinates),
                list(others),
                added
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

    /// Returns true if a momentum (velocity) has the shape of its coordinate.
    fn same_shape(
        &mut self,
        coordinate: &Declarator,
        other: &Declarator,
        due: Type,
        lagrangian: bool,
    ) -> bool {
        let Some(found) = self.variable_type(other, lagrangian) else {
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
    fn variable_type(&mut self, variable: &Declarator, lagrangian: bool) -> Option<Type> {
        let [_, columns] = variable.sizes.as_slice() else {
            return match variable.sizes.len() {
                0 | 1 => self.array(&variable.sizes),
                _ => self.lattice(&variable.sizes),
            };
        };
        match columns {
            Size::Literal(number, _) if *number <= written_out(lagrangian) => {
                self.array(&variable.sizes)
            }
            _ => self.lattice(&variable.sizes),
        }
    }

    /// The shape of coordinates that are stored row after row, on the heap.
    fn lattice(&mut self, sizes: &[Size]) -> Option<Type> {
        // All unknown sizes are reported.
        let extents: Vec<Option<Extent>> = sizes.iter().map(|size| self.extent(size)).into_list();
        let ty = Type::of(&extents.into_iter().collect::<Option<Vec<_>>>()?);
        let numbers = ty.elements();
        let numbers = numbers.map_or(i64::MAX, |n| n.as_constant().unwrap_or_default());
        if numbers > LARGEST {
            let message = format!("an array of {numbers} numbers may not fit into memory");
            let help = "set the sizes at run time, where `new` tells whether they fit: \
                        `pub struct Name { n: usize, m: usize }` and `[n][m]`";
            self.report.error(sizes[0].spans(), message, help);
            return None;
        }
        Some(ty)
    }
}

/// A signature that was probably meant.
fn suggested(word: &str, prefix: &str, names: &[Declarator]) -> String {
    let partner = if word == "L" { "v" } else { "p" };
    match names {
        [] => format!("{word}(q; {partner})"),
        [name] if name.name == "q" => format!("{word}(q; {partner})"),
        _ if names.len().is_multiple_of(2) => {
            let (coordinates, others) = names.split_at(names.len() / 2);
            format!("{word}({}; {})", list(coordinates), list(others))
        }
        _ => {
            let partners = listed(names.iter().map(|v| format!("{prefix}{}", v.name)));
            format!("{word}({}; {partners})", list(names))
        }
    }
}

/// Variables by the names of their momenta (velocities).
struct Owners<'a> {
    prefix: char,
    by_name: HashMap<String, &'a Declarator>,
}

impl<'a> Owners<'a> {
    fn new(variables: impl Iterator<Item = &'a Declarator>, word: &str) -> Owners<'a> {
        let prefix = if word == "L" { 'v' } else { 'p' };
        let by_name = variables.map(|variable| (variable.name.to_string(), variable));
        let by_name = by_name.collect();
        Owners { prefix, by_name }
    }

    /// The names that own `name`: `x` owns `p_x` and `px`, `q1` owns `p1`.
    fn names(&self, name: &str) -> Vec<String> {
        let Some(rest) = name.strip_prefix(self.prefix) else {
            return Vec::new();
        };
        let underscored = rest.strip_prefix('_').map(str::to_owned);
        [rest.to_owned(), format!("q{rest}")]
            .into_iter()
            .chain(underscored)
            .collect()
    }

    /// The variable whose momentum (velocity) has the name of this one.
    fn of(&self, variable: &Declarator) -> Option<&'a Declarator> {
        let names = self.names(&variable.name.to_string());
        names
            .iter()
            .find_map(|name| self.by_name.get(name).copied())
    }

    /// Returns true if `variable` has the name of the momentum (velocity) of `owner`.
    fn is_of(&self, variable: &Declarator, owner: &Declarator) -> bool {
        let names = self.names(&variable.name.to_string());
        names.contains(&owner.name.to_string())
    }
}

fn list<'a>(variables: impl IntoIterator<Item = &'a Declarator>) -> String {
    listed(variables.into_iter().map(|variable| &variable.name))
}
