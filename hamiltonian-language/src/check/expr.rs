//! Expressions: the meaning and the shape of every node.
//!
//! Input: the nodes of one expression, in post-order. Output: nodes of [`Checked`]. Invariants: one
//! forward loop; a node whose operands are erroneous is erroneous without a further error; a call
//! of a `let` function is this pass over the function's body with the nodes of its arguments.
//!
//! [`Checked`]: crate::checked::Checked

use super::Checker;
use crate::ast::{BinaryOp, ExprId, ExprKind, Expression, LoopVariableId, Symbol, UnaryOp};
use crate::checked::{Extent, Node, NodeId, NodeKind, Type, Variable};
use crate::names::Builtin;
use crate::parse::MAX_DEPTH;
use crate::report::Spans;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::op::Op;

/// The largest number of nodes that calls of `let` functions make in all.
const MAX_INSTANTIATED: usize = 1 << 19;

/// The values of the nodes of one expression.
pub(super) struct Frame {
    first: u32,
    values: Vec<Option<NodeId>>,
    /// The arguments of the `let` function that has this body.
    pub(super) arguments: Vec<(Symbol, Option<NodeId>)>,
}

impl Frame {
    /// The checked node of a node of the expression; `None` if it is erroneous.
    pub(super) fn value(&self, raw: ExprId) -> Option<NodeId> {
        self.values[(raw.0 - self.first) as usize]
    }
}

impl Checker<'_> {
    /// A whole right side.
    pub(super) fn expression(&mut self, expression: &Expression) -> Option<NodeId> {
        self.visit(expression, Vec::new(), &[])
            .value(expression.root)
    }

    /// A right side that is a scalar.
    pub(super) fn scalar_expression(
        &mut self,
        expression: &Expression,
        what: &str,
    ) -> Option<NodeId> {
        self.scalar_unless(expression, what, choice)
    }

    /// The function of an event, whose roots are located.
    pub(super) fn event(&mut self, expression: &Expression) -> Option<NodeId> {
        self.scalar_unless(expression, "an event", |op| {
            format!("write the function whose roots are events: `x` for `x {op} 0`, `a - b` for `a {op} b`")
        })
    }

    /// A right side that is a scalar; `help` is the remedy if it is a comparison.
    fn scalar_unless(
        &mut self,
        expression: &Expression,
        what: &str,
        help: fn(&str) -> String,
    ) -> Option<NodeId> {
        let value = self.expression(expression)?;
        let ty = self.type_of(value);
        if ty == Type::Scalar {
            return Some(value);
        }
        let raw = expression.root;
        if ty == Type::Bool {
            self.refuse_condition(raw, help);
        } else {
            let message = format!("{what} is a scalar, but this is {}", self.type_shown(ty));
            let help = match self.name_of(raw) {
                Some(name) if matches!(ty, Type::Vector(_)) => {
                    format!("write `norm_squared({name})` or a component, `{name}[0]`")
                }
                _ => "write `norm_squared(…)`, `dot(a, b)` or a component".into(),
            };
            self.error_over(raw, message, help);
        }
        None
    }

    /// The name that is the whole expression, if it is one.
    pub(super) fn name_of(&self, raw: ExprId) -> Option<&str> {
        match self.ast.nodes[raw.0 as usize].kind {
            ExprKind::Name(symbol, _) => Some(self.ast.symbols.name(symbol)),
            _ => None,
        }
    }

    /// Visits all nodes of an expression but `skipped`.
    pub(super) fn visit(
        &mut self,
        expression: &Expression,
        arguments: Vec<(Symbol, Option<NodeId>)>,
        skipped: &[ExprId],
    ) -> Frame {
        let values = Vec::with_capacity(expression.nodes.len());
        let mut frame = Frame {
            first: expression.nodes.start,
            values,
            arguments,
        };
        let outer = self.active.len();
        for index in expression.nodes.clone() {
            let id = ExprId(index);
            let value = if skipped.contains(&id) {
                None
            } else {
                self.node(id, &frame)
            };
            frame.values.push(value);
        }
        self.active.truncate(outer);
        frame
    }

    /// Reports an error at the token of a node, once even if its function is called several times.
    pub(super) fn error(
        &mut self,
        raw: ExprId,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let at = self.ast.nodes[raw.0 as usize].at;
        self.error_in(raw, at, message, help);
    }

    /// Reports an error over all tokens of a node, once.
    pub(super) fn error_over(
        &mut self,
        raw: ExprId,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let spans = self.ast.nodes[raw.0 as usize].spans;
        self.error_in(raw, spans, message, help);
    }

    /// Reports an error of a node at a place of its own, once.
    pub(super) fn error_in(
        &mut self,
        raw: ExprId,
        spans: Spans,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        if !std::mem::replace(&mut self.reported[raw.0 as usize], true) {
            self.report.error(spans, message, help);
        }
    }

    /// Reports an error of a node and returns no value: [`Checker::error`].
    pub(super) fn refuse<T>(
        &mut self,
        raw: ExprId,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.error(raw, message, help);
        None
    }

    pub(super) fn push(&mut self, raw: ExprId, kind: NodeKind, ty: Type) -> Option<NodeId> {
        self.push_affine(raw, kind, ty, None)
    }

    pub(super) fn push_affine(
        &mut self,
        raw: ExprId,
        kind: NodeKind,
        ty: Type,
        affine: Option<Affine>,
    ) -> Option<NodeId> {
        let id = NodeId(self.out.nodes.len() as u32);
        let written = &self.ast.nodes[raw.0 as usize];
        self.out.nodes.push(Node {
            kind,
            ty,
            spans: written.spans,
            at: written.at,
        });
        self.affines.push(affine);
        Some(id)
    }

    fn node(&mut self, raw: ExprId, frame: &Frame) -> Option<NodeId> {
        let ast = self.ast;
        match &ast.nodes[raw.0 as usize].kind {
            ExprKind::Error => None,
            ExprKind::Number(number) => {
                let affine = match number.to_small() {
                    Some((whole, 1)) => Some(Affine::constant(whole)),
                    _ => None,
                };
                self.push_affine(raw, NodeKind::Number(number.clone()), Type::Scalar, affine)
            }
            ExprKind::Name(symbol, scope) => self.name(raw, *symbol, *scope, frame),
            ExprKind::Unary(op, operand) => self.unary(raw, *op, *operand, frame),
            ExprKind::Binary(op, left, right) => self.binary(raw, *op, *left, *right, frame),
            ExprKind::Call(symbol, scope, arguments) => {
                self.call(raw, *symbol, *scope, arguments, frame)
            }
            ExprKind::Index {
                base,
                index,
                modulo,
            } => self.index(raw, *base, (*index, *modulo), frame),
            ExprKind::Vector(items) => self.vector(raw, items, frame),
            ExprKind::Bind {
                scope,
                lower,
                upper,
            } => {
                self.bind(raw, *scope, (*lower, *upper), frame);
                None
            }
            ExprKind::Sum { scopes, body } => self.sum(raw, scopes, *body, frame),
            ExprKind::If {
                condition,
                then,
                otherwise,
            } => self.conditional(raw, *condition, [*then, *otherwise], frame),
        }
    }

    fn unary(
        &mut self,
        raw: ExprId,
        op: UnaryOp,
        operand: ExprId,
        frame: &Frame,
    ) -> Option<NodeId> {
        match op {
            UnaryOp::Neg => {
                let (value, ty) = self.number(operand, frame)?;
                let affine = self.affines[value.0 as usize]
                    .as_ref()
                    .and_then(|a| Affine::default().checked_plus(-1, a));
                self.push_affine(raw, NodeKind::Unary(op, value), ty, affine)
            }
            UnaryOp::Not => {
                let value = self.condition(operand, frame)?;
                self.push(raw, NodeKind::Unary(op, value), Type::Bool)
            }
        }
    }

    fn binary(
        &mut self,
        raw: ExprId,
        op: BinaryOp,
        left: ExprId,
        right: ExprId,
        frame: &Frame,
    ) -> Option<NodeId> {
        if matches!(op, BinaryOp::And | BinaryOp::Or) {
            let (a, b) = (self.condition(left, frame), self.condition(right, frame));
            let (a, b) = (a?, b?);
            return self.push(raw, NodeKind::Binary(op, a, b), Type::Bool);
        }
        let (a, b) = (self.number(left, frame), self.number(right, frame));
        let ((a, left_type), (b, right_type)) = (a?, b?);
        let forms = (&self.affines[a.0 as usize], &self.affines[b.0 as usize]);
        let affine = match (op, forms) {
            (BinaryOp::Add, (Some(x), Some(y))) => x.checked_plus(1, y),
            (BinaryOp::Sub, (Some(x), Some(y))) => x.checked_plus(-1, y),
            (BinaryOp::Mul, (Some(x), Some(y))) => match (x.as_constant(), y.as_constant()) {
                (Some(factor), _) => y.times(factor),
                (_, Some(factor)) => x.times(factor),
                _ => x.checked_times(y),
            },
            _ => None,
        };
        let ty = match (op, left_type, right_type) {
            (BinaryOp::Add | BinaryOp::Sub, ..) if left_type == right_type => Some(left_type),
            (BinaryOp::Mul, Type::Scalar, ty) => Some(ty),
            (BinaryOp::Mul | BinaryOp::Div, ty, Type::Scalar) => Some(ty),
            (BinaryOp::Mul, Type::Matrix(rows, columns), Type::Vector(extent))
                if columns == extent && self.is_of_parameter(a) =>
            {
                Some(Type::Vector(rows))
            }
            (BinaryOp::Pow | BinaryOp::Rem, Type::Scalar, Type::Scalar) => Some(Type::Scalar),
            (BinaryOp::Compare(_), Type::Scalar, Type::Scalar) => Some(Type::Bool),
            _ => None,
        };
        let Some(ty) = ty else {
            return self.shapes_differ(raw, op, (left, left_type), (right, right_type));
        };
        let kind = match op {
            BinaryOp::Rem => NodeKind::Call(Builtin::Elementary(Op::Modulo), vec![a, b]),
            _ => NodeKind::Binary(op, a, b),
        };
        self.push_affine(raw, kind, ty, affine)
    }

    /// Refuses two operands whose shapes the operator cannot combine.
    fn shapes_differ(
        &mut self,
        raw: ExprId,
        op: BinaryOp,
        (raw_left, left): (ExprId, Type),
        (raw_right, right): (ExprId, Type),
    ) -> Option<NodeId> {
        let name = |raw: ExprId, otherwise: &str| self.name_of(raw).unwrap_or(otherwise).to_owned();
        let (a, b) = (self.type_shown(left), self.type_shown(right));
        let array = if left == Type::Scalar {
            raw_right
        } else {
            raw_left
        };
        let array = name(array, "a");
        let (message, help) = match op {
            BinaryOp::Add | BinaryOp::Sub => (
                match op {
                    BinaryOp::Add => format!("{a} cannot be added to {b}"),
                    _ => format!("{b} cannot be subtracted from {a}"),
                },
                match (left, right) {
                    (Type::Scalar, _) | (_, Type::Scalar) => {
                        format!("write a component, `{array}[i]`, or a length, `norm({array})`")
                    }
                    _ => "both sides need the same extents".to_owned(),
                },
            ),
            BinaryOp::Mul => (
                format!("{a} times {b} has no meaning"),
                match (left, right) {
                    (Type::Vector(x), Type::Vector(y)) if x == y => {
                        let (x, y) = (name(raw_left, "a"), name(raw_right, "b"));
                        format!("write `dot({x}, {y})`, or `cross({x}, {y})` in space")
                    }
                    _ => "a matrix parameter `[r][c]` multiplies a vector `[c]` from the left"
                        .to_owned(),
                },
            ),
            BinaryOp::Div => (
                format!("nothing can be divided by {b}"),
                format!(
                    "divide by a component, or by the length of a vector, `norm({})`",
                    name(raw_right, "a")
                ),
            ),
            BinaryOp::Rem => (
                format!("{a} modulo {b} has no meaning"),
                "write the remainder of each component, such as `a[i] % b`".to_owned(),
            ),
            BinaryOp::Pow if right == Type::Scalar => (
                format!("{a} has no powers"),
                format!(
                    "write `norm_squared({array})`, or the power of a component, `{array}[i]^2`"
                ),
            ),
            BinaryOp::Pow => (
                format!("the exponent is {b}"),
                "write a scalar exponent".to_owned(),
            ),
            _ => (
                format!("{a} cannot be compared with {b}"),
                "compare scalars, such as `norm(a)`".to_owned(),
            ),
        };
        self.refuse(raw, message, help)
    }

    /// Returns true for a parameter, and for an element of one.
    fn is_of_parameter(&self, mut node: NodeId) -> bool {
        while let NodeKind::Index { base, .. } = self.out.nodes[node.0 as usize].kind {
            node = base;
        }
        matches!(self.out.nodes[node.0 as usize].kind, NodeKind::Parameter(_))
    }

    /// An operand that is a number or an array.
    pub(super) fn number(&mut self, raw: ExprId, frame: &Frame) -> Option<(NodeId, Type)> {
        let value = frame.value(raw)?;
        let ty = self.type_of(value);
        if ty == Type::Bool {
            self.condition_as_number(raw);
            return None;
        }
        Some((value, ty))
    }

    /// Operands of one sort; `refused` returns message and help for an operand of another type.
    pub(super) fn operands(
        &mut self,
        operands: &[ExprId],
        frame: &Frame,
        is_due: fn(Type) -> bool,
        refused: impl Fn(&Self, ExprId, Type) -> (String, String),
    ) -> Option<Vec<NodeId>> {
        let mut values = Vec::with_capacity(operands.len());
        for operand in operands {
            match self.number(*operand, frame) {
                Some((value, ty)) if is_due(ty) => values.push(value),
                Some((_, ty)) => {
                    let (message, help) = refused(self, *operand, ty);
                    self.error_over(*operand, message, help);
                }
                None => {}
            }
        }
        (values.len() == operands.len()).then_some(values)
    }

    pub(super) fn condition_as_number(&mut self, raw: ExprId) {
        self.refuse_condition(raw, choice);
    }

    fn refuse_condition(&mut self, raw: ExprId, help: fn(&str) -> String) {
        let node = &self.ast.nodes[raw.0 as usize];
        let (message, op) = match node.kind {
            ExprKind::Binary(op, ..) => (
                format!(
                    "expected a number, found a condition made by `{0}`",
                    op.symbol()
                ),
                op.symbol(),
            ),
            _ => ("expected a number, found a condition".into(), "<"),
        };
        self.error(raw, message, help(op));
    }

    fn condition(&mut self, raw: ExprId, frame: &Frame) -> Option<NodeId> {
        let value = frame.value(raw)?;
        let ty = self.type_of(value);
        if ty == Type::Bool {
            return Some(value);
        }
        let message = format!("expected a condition, found {}", self.type_shown(ty));
        self.refuse(raw, message, "compare it: `x > 0`")
    }

    fn index(
        &mut self,
        raw: ExprId,
        base: ExprId,
        index: (ExprId, Option<ExprId>),
        frame: &Frame,
    ) -> Option<NodeId> {
        let (value, ty) = self.number(base, frame)?;
        let (extent, ty) = match ty.rows() {
            Some(rows) => rows,
            None => {
                let node = &self.ast.nodes[base.0 as usize];
                let message = match &node.kind {
                    ExprKind::Name(symbol, _) => {
                        format!(
                            "`{}` is a scalar and has no components",
                            self.ast.symbols.name(*symbol)
                        )
                    }
                    _ => "a scalar has no components".into(),
                };
                let help = match self.out.nodes[value.0 as usize].kind {
                    NodeKind::Capture(_) => {
                        "captured names are scalars: write a parameter `name: [N]` in item form"
                    }
                    NodeKind::Parameter(_) => "declare it as an array: `name: [N]`",
                    NodeKind::Phase(Variable::Coordinate | Variable::Momentum, _) => {
                        "declare it with its extent: `H(q[N]; p[N])`"
                    }
                    _ => "remove the index",
                };
                return self.refuse(raw, message, help);
            }
        };
        let index = self.checked_index(value, index, frame, extent)?;
        self.push(raw, NodeKind::Index { base: value, index }, ty)
    }

    fn vector(&mut self, raw: ExprId, items: &[ExprId], frame: &Frame) -> Option<NodeId> {
        let values = self.operands(items, frame, Type::is_scalar, |checker, item, ty| {
            let message = format!(
                "the components of a vector are scalars, but this is {}",
                checker.type_shown(ty)
            );
            let help = match checker.ast.nodes[item.0 as usize].kind {
                ExprKind::Vector(_) => {
                    "declare a matrix as a parameter: `M: [2][2] = [[1.0, 2.0], [3.0, 4.0]]`".into()
                }
                _ => {
                    let name = checker.name_of(item).unwrap_or("a");
                    format!("write each component: `[{name}[0], {name}[1], …]`")
                }
            };
            (message, help)
        })?;
        let ty = Type::Vector(Extent::Literal(values.len() as u64));
        self.push(raw, NodeKind::Vector(values), ty)
    }

    fn sum(
        &mut self,
        raw: ExprId,
        scopes: &[LoopVariableId],
        body: ExprId,
        frame: &Frame,
    ) -> Option<NodeId> {
        let mut loops = Vec::with_capacity(scopes.len());
        for scope in scopes {
            loops.extend(self.scope_loops[scope.0 as usize].take());
        }
        self.active
            .truncate(self.active.len().saturating_sub(loops.len()));
        let (body, ty) = self.number(body, frame)?;
        if loops.len() != scopes.len() {
            return None;
        }
        let first = loops[0].0;
        self.push(
            raw,
            NodeKind::Sum {
                loops: first..first + loops.len() as u32,
                body,
            },
            ty,
        )
    }

    fn conditional(
        &mut self,
        raw: ExprId,
        condition: ExprId,
        branches: [ExprId; 2],
        frame: &Frame,
    ) -> Option<NodeId> {
        let condition = self.condition(condition, frame);
        let (then, otherwise) = (
            self.number(branches[0], frame),
            self.number(branches[1], frame),
        );
        let (condition, (then, ty), (otherwise, other)) = (condition?, then?, otherwise?);
        if ty != other {
            let message = format!(
                "the branches of `if` differ: {} and {}",
                self.type_shown(ty),
                self.type_shown(other)
            );
            return self.refuse(raw, message, "both branches need the same shape");
        }
        self.push(
            raw,
            NodeKind::If {
                condition,
                then,
                otherwise,
            },
            ty,
        )
    }

    /// The body of a `let` function with the nodes of its arguments.
    pub(super) fn instantiate(
        &mut self,
        raw: ExprId,
        function: usize,
        arguments: Vec<Option<NodeId>>,
    ) -> Option<NodeId> {
        // Erroneous arguments are not errors of the body.
        if self.lets[function].erroneous || arguments.iter().any(Option::is_none) {
            return None;
        }
        let body = self.lets[function].body;
        let bound = self.lets[function]
            .arguments
            .iter()
            .copied()
            .zip(arguments)
            .into_list();
        if self.call_depth >= MAX_DEPTH {
            return self.refuse(
                raw,
                format!("functions call each other deeper than {MAX_DEPTH}"),
                "inline the inner ones",
            );
        }
        self.instantiated += body.nodes.len();
        if self.instantiated > MAX_INSTANTIATED {
            if self.instantiated - body.nodes.len() <= MAX_INSTANTIATED {
                self.error(
                    raw,
                    format!(
                        "the calls of functions expand to more than {MAX_INSTANTIATED} operations"
                    ),
                    "name a repeated argument or result: `let name = …;`",
                );
            }
            return None;
        }
        self.call_depth += 1;
        let value = self.visit(body, bound, &[]).value(body.root);
        self.call_depth -= 1;
        value
    }
}

/// The remedy for a comparison where a number is required.
fn choice(op: &str) -> String {
    format!("write `if a {op} b {{ … }} else {{ … }}`")
}
