//! Forces: `force(q; p) = …`, and `force(q[i]; p[i]) = …` for the row of an array.
//!
//! Input: the statement. Output: one value a group of momenta. Invariant: a value has the shape of the
//! momenta it acts on.

use super::Checker;
use crate::ast::{ExprKind, Expression, Signature, Size, Statement};
use crate::checked::{Extent, Kind, Loop, Type};
use crate::names::listed;
use hamiltonian_symbolic::index::{Affine, Domain};
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
        if let Some((name, rows, ty)) = self.row(signature) {
            self.force_at_row(&name, rows, ty, value);
            return;
        }
        let items = match &self.ast.nodes[root.0 as usize].kind {
            ExprKind::Vector(items) if count > 1 => Some(items.clone()),
            _ => None,
        };
        let frame = self.visit(value, Vec::new(), items.is_some().then_some(root));
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

    /// The i of `force(q[i]; p[i])`, if i is not a size, with the number of rows and the type of a
    /// row.
    fn row(&self, signature: &Signature) -> Option<(Ident, Extent, Type)> {
        let [group] = &self.out.groups[..] else {
            return None;
        };
        let (rows, ty) = group.ty.rows()?;
        let variables = signature.sections.iter().take(2).flatten();
        let names = variables.map(|variable| match &variable.sizes[..] {
            [Size::Name(name)] => Some(name),
            _ => None,
        });
        let names: Vec<&Ident> = names.collect::<Option<_>>()?;
        let (first, rest) = names.split_first()?;
        let is_size = self.out.sizes.iter().any(|size| size.name == **first);
        (!is_size && rest.iter().all(|name| name == first)).then(|| ((*first).clone(), rows, ty))
    }

    /// `force(q[i]; p[i]) = …`: the force on row i.
    fn force_at_row(&mut self, name: &Ident, rows: Extent, ty: Type, value: &Expression) {
        let symbol = self.ast.symbols.find(&name.to_string());
        if let Some(binding) = symbol.and_then(|symbol| self.bindings[symbol.0 as usize]) {
            let message = format!(
                "`{name}` is used twice: it is {} already",
                self.described(binding)
            );
            self.report
                .error(name.span(), message, "choose another name for the row");
            return;
        }
        let id = Domain(self.out.loops.len() as u32);
        self.out.loops.push(Loop {
            name: name.clone(),
            lower: Affine::default(),
            upper: rows.affine(),
        });
        self.out.force_row = Some(id);
        let row = self.push_affine(
            value.root,
            Kind::Loop(id),
            Type::Scalar,
            Some(Affine::variable(id)),
        );
        self.active.push(id);
        let root = value.root;
        let arguments = symbol.map(|symbol| (symbol, row)).into_iter().collect();
        let frame = self.visit(value, arguments, None);
        self.active.pop();
        let Some((value, found)) = self.number(root, &frame) else {
            return;
        };
        if found == ty {
            self.out.force = vec![value];
            return;
        }
        let momentum = &self.out.groups[0].momentum;
        let message = format!(
            "expected a force of the shape of `{momentum}[{name}]`, {}, found {}",
            self.type_shown(ty),
            self.type_shown(found)
        );
        let help = format!("write one value of that shape, such as `-c*{momentum}[{name}]`");
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
            .collect();
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
