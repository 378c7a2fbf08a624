//! Forces: `force(q; p) = …`, `force(q[i]; p[i]) = …` for the row of an array, and `force(u[i][j]; p[i][j]) = …` for
//! its element.
//!
//! Input: the statement. Output: one value a group of momenta. Invariant: a value has the shape of the
//! momenta it acts on.

use super::Checker;
use crate::ast::{ExprKind, Expression, Signature, Size, Statement};
use crate::checked::{Loop, NodeKind, Type};
use crate::names::listed;
use hamiltonian_symbolic::index::{Affine, Domain};
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::Ident;

impl Checker<'_> {
    pub(super) fn force(
        &mut self,
        statement: &Statement,
        signature: &Signature,
        value: &Expression,
    ) {
        if !self.out.force.is_empty() {
            self.once(statement, "force");
            return;
        }
        if !self.repeats(signature) {
            return;
        }
        let count = self.out.groups.len();
        let root = value.root;
        if let Some(names) = self.rows(signature) {
            self.force_at_rows(&names, value);
            return;
        }
        let items = match &self.ast.nodes[root.0 as usize].kind {
            ExprKind::Vector(items) if count > 1 => Some(items.clone()),
            _ => None,
        };
        let list = items.as_ref().map(|_| root);
        let frame = self.visit(value, Vec::new(), list.as_slice());
        let items = match items {
            Some(items) => items,
            None if count == 1 => vec![root],
            None => {
                if frame.value(root).is_some() {
                    let groups = self.out.groups.iter();
                    let names = listed(groups.map(|group| format!("f_{}", group.coordinate)));
                    let message =
                        format!("a force has one component for each of the {count} momenta");
                    self.error_over(root, message, format!("write `[{}]`", names));
                }
                return;
            }
        };
        if items.len() != count {
            let message = format!("{} components of force act on {count} momenta", items.len());
            let at = self.ast.nodes[root.0 as usize].spans;
            self.report
                .error(at, message, "write one for each momentum, in their order");
            return;
        }
        let mut force = Vec::with_capacity(count);
        for (index, item) in items.into_iter().enumerate() {
            let Some((value, ty)) = self.number(item, &frame) else {
                continue;
            };
            let group = &self.out.groups[index];
            if ty == group.ty {
                force.push(value);
                continue;
            }
            let (coordinate, momentum) = (&group.coordinate, &group.momentum);
            let message = format!(
                "expected a force of the shape of `{momentum}`, {}, found {}",
                self.type_shown(group.ty),
                self.type_shown(ty)
            );
            self.error_over(
                item,
                message,
                match group.ty {
                    Type::Scalar => format!("write one number, such as `-c*{momentum}`"),
                    _ => format!(
                        "write one value of that shape, `-c*{momentum}`, or its rows, \
                         `force({coordinate}[i]; {momentum}[i]) = -c*{momentum}[i]`"
                    ),
                },
            );
        }
        if force.len() == count {
            self.out.force = force;
        }
    }

    /// The names i, j of `force(u[i][j]; p[i][j])`, at most one for each extent, if none is a size.
    fn rows(&self, signature: &Signature) -> Option<Vec<Ident>> {
        let [group] = &self.out.groups[..] else {
            return None;
        };
        let name = |size: &Size| match size {
            Size::Name(name) => Some(name.clone()),
            Size::Literal(..) | Size::Product(_) => None,
        };
        let variables = signature.sections.iter().take(2).flatten();
        let mut names = variables.map(|variable| variable.sizes.iter().map(name).collect());
        let first: Vec<Ident> = names.next()??;
        let is_size = |name: &Ident| self.out.sizes.iter().any(|size| size.name == *name);
        let is_some = !first.is_empty() && first.len() <= group.ty.extents().len();
        let is_every = names.all(|names: Option<Vec<Ident>>| names.as_ref() == Some(&first));
        (is_some && is_every && !first.iter().any(is_size)).then_some(first)
    }

    /// `force(q[i]; p[i]) = …`: the force on row i, or with more names on an element.
    fn force_at_rows(&mut self, names: &[Ident], value: &Expression) {
        let (mut arguments, mut ty) = (Vec::new(), self.out.groups[0].ty);
        for (axis, name) in names.iter().enumerate() {
            let symbol = self.ast.symbols.find(&name.to_string());
            let binding = symbol.and_then(|symbol| self.bindings[symbol.0 as usize]);
            let of = if axis == 0 { "row" } else { "index" };
            let known = match binding {
                Some(binding) => Some(self.described(binding)),
                None => names[..axis].contains(name).then_some("an index"),
            };
            if let Some(known) = known {
                let message = format!("`{name}` is used twice: it is {known} already");
                let help = format!("choose another name for the {of}");
                self.report.error(name.span(), message, help);
                return;
            }
            let Some((rows, inner)) = ty.rows() else {
                return;
            };
            ty = inner;
            let id = Domain(self.out.loops.len() as u32);
            self.out.loops.push(Loop {
                name: name.clone(),
                lower: Affine::default(),
                upper: rows.affine(),
            });
            self.out.force_rows.push(id);
            let index = Some(Affine::variable(id));
            let row = self.push_affine(value.root, NodeKind::Loop(id), Type::Scalar, index);
            arguments.extend(symbol.map(|symbol| (symbol, row)));
        }
        let root = value.root;
        self.active.extend(&self.out.force_rows);
        let frame = self.visit(value, arguments, &[]);
        self.active.truncate(self.active.len() - names.len());
        let Some((value, found)) = self.number(root, &frame) else {
            return;
        };
        if found == ty {
            self.out.force = vec![value];
            return;
        }
        let indices: String = names.iter().map(|name| format!("[{name}]")).collect();
        let momentum = &self.out.groups[0].momentum;
        let message = format!(
            "expected a force of the shape of `{momentum}{indices}`, {}, found {}",
            self.type_shown(ty),
            self.type_shown(found)
        );
        let help = format!("write one value of that shape, such as `-c*{momentum}{indices}`");
        self.error_over(root, message, help);
    }

    /// The signature of a force names the coordinates and momenta of the definition again.
    fn repeats(&mut self, signature: &Signature) -> bool {
        let groups = &self.out.groups;
        let momenta = listed(groups.iter().map(|group| &group.momentum));
        let mut due = vec![
            listed(groups.iter().map(|group| &group.coordinate)),
            listed(groups.iter().map(|group| group.partner())),
        ];
        let sections = signature.sections.iter();
        let given: Vec<String> = sections
            .map(|s| listed(s.iter().map(|v| &v.name)))
            .into_list();
        if given.len() > 2 {
            due.extend(self.out.time.iter().map(Ident::to_string));
        }
        let by_momenta = given.get(1) == Some(&momenta)
            && given.first() == due.first()
            && given[2..] == due[2..];
        if given == due || by_momenta {
            return true;
        }
        self.report.error(
            signature.spans,
            "a force acts on the coordinates and momenta of the definition",
            format!("write `force({})`", due.join("; ")),
        );
        false
    }
}
