//! Canonical changes of coordinates.
//!
//! Input: `coordinates polar(x, y)`. Output: [`Chart`]. Invariant: a chart replaces coordinates of
//! the definition that have the shape it requires, each coordinate once.

use super::Checker;
use crate::ast::{Ast, StatementKind};
use crate::checked::{self, Bound, Extent, GroupId, Reach, Type, Variable};
use crate::names;
use crate::report::Spans;
use hamiltonian_symbolic::dag::Parameter;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::transform::{self, Bodies, Chart, Component};
use proc_macro2::Ident;

const CHARTS: &[&str] = &["polar", "spherical", "jacobi", "heliocentric"];

/// A scalar that a chart introduces.
pub(super) struct NewScalar<'a> {
    /// The word of the chart.
    pub(super) chart: String,
    /// The coordinates that the chart replaces.
    pub(super) arguments: &'a [Ident],
    /// A coordinate or a momentum.
    pub(super) variable: Variable,
    /// Its number among those of the chart.
    pub(super) at: usize,
}

impl<'a> Checker<'a> {
    /// The chart that introduces a scalar of a name.
    pub(super) fn new_scalar(&self, name: &str) -> Option<NewScalar<'a>> {
        let ast: &'a Ast = self.ast;
        let charts = ast.statements.iter().filter_map(|s| match &s.kind {
            StatementKind::Coordinates { chart, arguments } => Some((chart.to_string(), arguments)),
            _ => None,
        });
        let charts: Vec<(String, &'a Vec<Ident>)> = charts.into_list();
        let words: Vec<&str> = charts.iter().map(|(word, _)| word.as_str()).into_list();
        let (new, variable) = match name.strip_prefix("p_") {
            Some(new) => (new, Variable::NewMomentum),
            None => (name, Variable::NewCoordinate),
        };
        let names = transform::names_of_scalars(&words).into_iter();
        let mut all = names.zip(&charts).flat_map(|(names, chart)| {
            let named = names.into_iter().enumerate();
            named.map(move |(at, name)| (name, at, chart))
        });
        let (_, at, (word, arguments)) = all.find(|(other, ..)| other == new)?;
        Some(NewScalar {
            chart: word.clone(),
            arguments,
            variable,
            at,
        })
    }

    /// The old coordinate in whose place a new scalar stands: its group and its row. `None` if the chart does not fit,
    /// which is reported where it stands.
    pub(super) fn replaced_by(&self, new: &NewScalar<'_>) -> Option<(GroupId, Option<u32>)> {
        let place = |name: &Ident| {
            let mut groups = self.out.groups.iter();
            let at = groups.position(|group| group.coordinate == *name)?;
            Some((GroupId(at as u32), self.out.groups[at].ty))
        };
        match new.arguments {
            [vector] => match place(vector)? {
                (group, Type::Vector(Extent::Literal(rows))) if (new.at as u64) < rows => {
                    Some((group, Some(new.at as u32)))
                }
                _ => None,
            },
            scalars => match place(scalars.get(new.at)?)? {
                (group, Type::Scalar) => Some((group, None)),
                _ => None,
            },
        }
    }
}

impl Checker<'_> {
    pub(super) fn chart(&mut self, name: &Ident, arguments: &[Ident]) {
        let word = name.to_string();
        if !CHARTS.contains(&word.as_str()) {
            let help = match names::nearest(&word, CHARTS.iter().copied()) {
                Some(known) => format!("write `{known}`"),
                None if word.starts_with("cylind") => {
                    "write `polar(x, y)`, which leaves z as it is".into()
                }
                None => format!("known are `{}`", CHARTS.join("`, `")),
            };
            self.report
                .error(name.span(), format!("unknown coordinates `{word}`"), help);
            return;
        }
        let kind = match word.as_str() {
            "polar" => self.cartesian(name, arguments).map(Chart::Polar),
            "spherical" => self.cartesian(name, arguments).map(Chart::Spherical),
            "jacobi" => self.bodies(name, arguments).map(Chart::Jacobi),
            _ => self.bodies(name, arguments).map(|bodies| {
                self.needs_first(&arguments[0], bodies.group);
                Chart::Heliocentric(bodies)
            }),
        };
        let is_replaced = |argument: &&Ident| {
            let mut groups = self.out.groups.iter();
            let own = groups.position(|group| group.coordinate == **argument);
            let mut same = self.out.charts.iter().filter(|other| other.name == *name);
            own.is_some_and(|own| same.any(|other| other.kind.replaces(own as u16)))
        };
        let twice = arguments.iter().find(is_replaced);
        if let Some(twice) = twice {
            let message = format!("`{twice}` is replaced twice");
            self.report.error(name.span(), message, "keep one");
            return;
        }
        if let Some(kind) = kind {
            self.out.charts.push(checked::Chart {
                name: name.clone(),
                kind,
            });
        }
    }

    /// Records the condition that body 0 exists: the other bodies are relative to it.
    fn needs_first(&mut self, positions: &Ident, group: u16) {
        if let Some((bodies, _)) = self.out.groups[usize::from(group)].ty.rows()
            && !matches!(bodies, Extent::Literal(_))
        {
            self.note(Reach {
                shown: format!("{positions}[0]"),
                span: positions.span(),
                loops: Vec::new(),
                form: Affine::constant(0),
                limit: Bound::Extent(bodies),
            });
        }
    }

    /// The charts of bodies in the definition, with the groups they replace.
    fn charts_of_bodies(&self) -> impl Iterator<Item = (GroupId, String)> {
        self.ast.statements.iter().filter_map(|s| match &s.kind {
            StatementKind::Coordinates { chart, arguments } => {
                let word = chart.to_string();
                let of_bodies = word == "jacobi" || word == "heliocentric";
                let mut groups = self.out.groups.iter();
                let at = groups.position(|g| Some(&g.coordinate) == arguments.first())?;
                of_bodies.then_some((GroupId(at as u32), word))
            }
            _ => None,
        })
    }

    /// The variable of a group of bodies in the coordinates of a chart, with the name of the chart.
    pub(super) fn new_of_bodies(&self, name: &str) -> Option<(GroupId, Variable, String)> {
        self.charts_of_bodies().find_map(|(group, word)| {
            let variable = [Variable::NewCoordinate, Variable::NewMomentum]
                .into_iter()
                .find(|new| self.new_name(group, *new).as_deref() == Some(name))?;
            Some((group, variable, word))
        })
    }

    /// The name of a variable in the coordinates by which a chart replaces a group of bodies.
    pub(super) fn new_name(&self, group: GroupId, new: Variable) -> Option<String> {
        let (_, word) = self.charts_of_bodies().find(|(of, _)| *of == group)?;
        let group = &self.out.groups[group.0 as usize];
        let old = match new {
            Variable::NewMomentum => &group.momentum,
            _ => &group.coordinate,
        };
        Some(format!("{old}_{word}"))
    }

    /// Reads D scalar coordinates, or one vector of extent D.
    fn cartesian<const D: usize>(
        &mut self,
        chart: &Ident,
        arguments: &[Ident],
    ) -> Option<[Component; D]> {
        let mut groups = Vec::new();
        for argument in arguments {
            groups.push(self.coordinate(argument)?);
        }
        let ty = |checker: &Self, group: GroupId| checker.out.groups[group.0 as usize].ty;
        if let [group] = groups[..]
            && ty(self, group) == Type::Vector(Extent::Literal(D as u64))
        {
            return Some(std::array::from_fn(|row| Component {
                group: group.0 as u16,
                row: Some(row as u32),
            }));
        }
        let form = if D == 2 {
            "polar(x, y)"
        } else {
            "spherical(x, y, z)"
        };
        for (group, argument) in groups.iter().zip(arguments) {
            if ty(self, *group) != Type::Scalar {
                let message = format!("`{argument}` is {}", self.type_shown(ty(self, *group)));
                let help = format!(
                    "write `{form}` with scalars, or `{chart}({argument})` with one vector `[{D}]`"
                );
                self.report.error(argument.span(), message, help);
                return None;
            }
        }
        if groups.len() != D {
            let message = format!("`{chart}` replaces {D} coordinates, not {}", groups.len());
            self.report
                .error(chart.span(), message, format!("write `{form}`"));
            return None;
        }
        let components = |index: usize| Component {
            group: groups[index].0 as u16,
            row: None,
        };
        for (index, argument) in arguments.iter().enumerate() {
            if groups[..index].contains(&groups[index]) {
                let message = format!("the coordinate `{argument}` is given twice");
                self.report
                    .error(argument.span(), message, format!("write `{form}`"));
                return None;
            }
        }
        Some(std::array::from_fn(components))
    }

    fn coordinate(&mut self, name: &Ident) -> Option<GroupId> {
        let found = self
            .out
            .groups
            .iter()
            .position(|group| group.coordinate == *name);
        if found.is_none() {
            let groups = self.out.groups.iter();
            let known = names::listed(groups.map(|group| format!("`{}`", group.coordinate)));
            let message = format!("`{name}` is not a coordinate");
            self.report.error(
                name.span(),
                message,
                format!("the coordinates are {}", known),
            );
        }
        found.map(|index| GroupId(index as u32))
    }

    /// Positions and masses of as many bodies.
    fn bodies(&mut self, chart: &Ident, arguments: &[Ident]) -> Option<Bodies> {
        let form =
            format!("write `coordinates {chart}(q, m)` with positions `[n][3]` and masses `[n]`");
        let [positions, masses] = arguments else {
            let message = format!("`{chart}` needs positions and masses");
            self.report.error(chart.span(), message, form);
            return None;
        };
        let group = self.coordinate(positions)?;
        let Some(parameter) = self
            .out
            .parameters
            .iter()
            .position(|parameter| parameter.name == *masses)
        else {
            self.report.error(
                masses.span(),
                format!("`{masses}` is not a parameter"),
                form,
            );
            return None;
        };
        let extents = self.out.groups[group.0 as usize].ty.rows();
        let extents = extents.map(|(bodies, _)| bodies);
        if self.out.groups[group.0 as usize].is_lattice {
            let message = format!("`{positions}` has more components a body than space has");
            self.report.error(positions.span(), message, form);
            return None;
        }
        let ty = self.out.parameters[parameter].ty;
        if extents.is_none_or(|bodies| ty != Type::Vector(bodies)) {
            let message = format!(
                "`{positions}` and `{masses}` are not positions and masses of as many bodies"
            );
            self.report.error(
                Spans::from(positions.span()).to(masses.span()),
                message,
                form,
            );
            return None;
        }
        Some(Bodies {
            group: group.0 as u16,
            masses: Parameter(parameter as u16),
        })
    }
}
