//! Answers demands: components of checked expressions as nodes of the arena.
//!
//! Input: roots with demands. Output: their nodes. Invariant: two passes over the expressions, one
//! from parents to children that gathers demands, one back that answers them; each is answered once.

use super::demand::{Children, Demand, Demands, Run};
use super::domain;
use super::velocity;
use super::{Beyond, LARGEST};
use crate::ast::{BinaryOp, Comparison, UnaryOp};
use crate::checked::{Checked, Definition, NodeId, NodeKind, Type, Variable};
use crate::names::Builtin;
use crate::report::{Report, Spans};
use hamiltonian_symbolic::bracket::bracket;
use hamiltonian_symbolic::dag::{self, Array, Column, Dag, Map, Node, Parameter, Partial, Side};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::legendre::ElementMap;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::loops::guarded;
use hamiltonian_symbolic::model::REPLACING;
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::print;
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::sort::Arrange;

/// Message and remedy for a bracket with indices that cannot be solved.
const UNSOLVED: (&str, &str) = (
    "this bracket cannot be formed: its sums meet at indices that cannot be solved for each other",
    "write the result of the bracket as an expression",
);

/// The nodes that were derived (brackets, momenta, velocities) from written ones.
#[derive(Debug, Default)]
pub struct Derived {
    made: Vec<core::ops::Range<usize>>,
    /// Derived nodes that the definition also contains as written.
    written: Map<Node, ()>,
}

impl Derived {
    /// Records the nodes from number `before` on as derived.
    pub fn since(&mut self, before: usize, model: &Model) {
        self.made.push(before..model.dag.len());
    }

    /// Records a node as written, even if it was derived first.
    fn wrote(&mut self, node: Node) {
        if !self.is_written(node) {
            self.written.insert(node, ());
        }
    }

    /// Records a written sum over a loop. Its parts that do not depend on the loop are factors.
    fn wrote_sum(&mut self, dag: &Dag, sum: Node, domain: Domain) {
        let start = &dag.range(domain).start;
        let mut wrote = |node: Node| match dag.kind(node) {
            dag::Kind::Reduce(own, _) if dag.range(*own).start == *start => self.wrote(node),
            _ => {}
        };
        match dag.kind(sum) {
            dag::Kind::Product(_, factors) => factors.iter().for_each(|(one, _)| wrote(*one)),
            _ => wrote(sum),
        }
    }

    /// Returns true if the node was written. Then its indices are in range wherever its loops run.
    pub fn is_written(&self, node: Node) -> bool {
        let is_made = |made: &core::ops::Range<usize>| made.contains(&(node.0 as usize));
        !self.made.iter().any(is_made) || self.written.contains_key(&node)
    }
}

/// Answers demands on the expressions of one definition.
#[derive(Debug)]
pub struct Evaluator<'a> {
    pub(super) checked: &'a Checked,
    pub(super) demands: Demands<'a>,
    report: &'a mut Report,
    /// True if something was refused: then there is no model.
    refused: bool,
    /// True if a bracket was formed.
    has_brackets: bool,
    /// Numbers outside the range of `f64`.
    pub(super) beyond: Beyond,
    /// Derived nodes.
    pub(super) derived: Derived,
    /// The velocities of a Lagrangian as functions of (q, p, t), once they are known.
    pub(super) velocities: Option<Vec<ElementMap>>,
    /// The answers to demands.
    answers: Map<(u32, Demand), Node>,
}

impl<'a> Evaluator<'a> {
    /// Returns an evaluator without answers.
    pub fn new(checked: &'a Checked, report: &'a mut Report) -> Evaluator<'a> {
        Evaluator {
            checked,
            demands: Demands::of(checked),
            report,
            refused: false,
            has_brackets: false,
            beyond: Vec::new(),
            derived: Derived::default(),
            velocities: None,
            answers: Map::default(),
        }
    }

    /// Reports an error; there will be no model.
    pub fn refuse(&mut self, spans: Spans, message: &str, help: &str) {
        self.refused = true;
        self.report.error(spans, message, help);
    }

    /// Reports an internal error. There will be no model, so the node is never read.
    fn fault(&mut self, node: NodeId, fault: &str) -> Node {
        self.refused = true;
        self.report.internal(self.checked.node(node).spans, fault);
        Node(u32::MAX)
    }

    /// The nodes of the roots.
    pub fn evaluate(&mut self, model: &mut Model, roots: &[(NodeId, Demand)]) -> Option<Vec<Node>> {
        let count = self.checked.nodes.len();
        let mut demands: Vec<Vec<Demand>> = vec![Vec::new(); count];
        let mut asked: Vec<Vec<(Demand, Children)>> = vec![Vec::new(); count];
        for (root, demand) in roots {
            demands[root.0 as usize].push(demand.clone());
        }
        let mut total = 0;
        for at in (0..count).rev() {
            let node = NodeId(at as u32);
            let mut own = core::mem::take(&mut demands[at]);
            own.arrange();
            own.dedup();
            own.retain(|demand| self.answer(node, demand).is_none());
            total += own.len();
            for demand in own {
                match self.demands.children(&mut model.dag, node, &demand) {
                    Ok(children) => {
                        for (child, wanted) in &children {
                            demands[child.0 as usize].push(wanted.clone());
                        }
                        asked[at].push((demand, children));
                    }
                    Err((message, help)) => {
                        self.refuse(self.checked.node(node).spans, &message, help);
                    }
                }
            }
            if self.refused || total > LARGEST {
                self.too_large(at, total);
                return None;
            }
        }
        for (at, own) in asked.into_iter().enumerate() {
            let node = NodeId(at as u32);
            for (demand, children) in own {
                let values: Option<Vec<Node>> = children
                    .iter()
                    .map(|(child, wanted)| self.answer(*child, wanted))
                    .collect();
                let Some(values) = values else {
                    self.fault(node, "an operand was not asked for");
                    return None;
                };
                let value = self.combine(model, node, &demand, &values);
                if self.refused {
                    return None;
                }
                if let NodeKind::Phase(Variable::Coordinate | Variable::Momentum, _)
                | NodeKind::Parameter(_) = &self.checked.node(node).kind
                {
                    self.derived.wrote(value);
                }
                if let Some(number) = model.dag.number_near_limits(value) {
                    self.beyond.push((number, node));
                }
                self.note(node, demand, value);
                if model.dag.len() > LARGEST {
                    self.too_large(at, model.dag.len());
                    return None;
                }
            }
        }
        let mut values = Vec::with_capacity(roots.len());
        for (root, demand) in roots {
            let Some(value) = self.answer(*root, demand) else {
                self.fault(*root, "it has no value");
                return None;
            };
            values.push(self.guarded(model, *root, value)?);
        }
        Some(values)
    }

    /// The value with elements that brackets left under conditions made safe to read. All brackets
    /// are formed before: the bracket of a bracket solves plain indices.
    fn guarded(&mut self, model: &mut Model, root: NodeId, value: Node) -> Option<Node> {
        if !self.has_brackets {
            return Some(value);
        }
        let guarded = guarded(model, value, &|node| self.derived.is_written(node));
        if guarded.is_none() {
            self.refuse(self.checked.node(root).spans, UNSOLVED.0, UNSOLVED.1);
        }
        guarded
    }

    fn too_large(&mut self, at: usize, count: usize) {
        if !self.refused {
            let spans = self.checked.nodes[at].spans;
            self.refuse(
                spans,
                &format!("this grows past {count} operations"),
                "a definition has at most 32768 operations: write sums with `sum(i in 0..N) { … }`: they stay loops unless they choose among components",
            );
        }
    }

    fn answer(&self, node: NodeId, demand: &Demand) -> Option<Node> {
        self.answers.get(&(node.0, demand.clone())).copied()
    }

    fn note(&mut self, node: NodeId, demand: Demand, value: Node) {
        self.answers.insert((node.0, demand), value);
    }

    /// The answer to a demand, from the answers to the demands on the children.
    fn combine(
        &mut self,
        model: &mut Model,
        node: NodeId,
        demand: &Demand,
        values: &[Node],
    ) -> Node {
        let checked = self.checked;
        let this = checked.node(node);
        let dag = &mut model.dag;
        match (&this.kind, values) {
            (NodeKind::Number(value), _) => dag.constant(value.clone()),
            (NodeKind::Pi, _) => dag.pi(),
            (NodeKind::Phase(variable, group), _) => {
                self.phase(model, node, *variable, group.0 as u16, demand)
            }
            (NodeKind::Time, _) => dag.time(),
            (NodeKind::Parameter(parameter), _) => {
                let parameter = Parameter(parameter.0 as u16);
                let shape = &model.parameters[usize::from(parameter.0)].shape;
                let (row, column) = match demand.indices.as_slice() {
                    [] => return dag.parameter(parameter),
                    [row, column] if shape.axes().is_empty() => (row.clone(), Some(column.clone())),
                    indices => (number(indices, shape.axes()), None),
                };
                dag.element(Array::Parameter(parameter), row, column)
            }
            (NodeKind::Capture(capture), _) => dag.parameter(Parameter(
                (checked.parameters.len() + capture.0 as usize) as u16,
            )),
            (NodeKind::Size(size), _) => dag.extent(*size),
            (NodeKind::Loop(id), _) => match demand.value(*id) {
                Some(value) => dag.integer(value),
                None => {
                    let domain = self.demands.domain(dag, *id, demand);
                    dag.variable(domain)
                }
            },
            (NodeKind::Hamiltonian, _) => model.h(),
            (NodeKind::Unary(UnaryOp::Neg, _), [a]) => dag.neg(*a),
            (NodeKind::Unary(UnaryOp::Not, _), [a]) => dag.not(*a),
            (NodeKind::Binary(BinaryOp::Add | BinaryOp::Sub, ..), values) => {
                let signs =
                    self.demands
                        .terms(node)
                        .into_iter()
                        .map(|(negative, _)| match negative {
                            true => Rational::MINUS_ONE,
                            false => Rational::ONE,
                        });
                let terms: Vec<(Rational, Node)> = signs.zip(values.iter().copied()).into_list();
                dag.linear(&Rational::ZERO, &terms)
            }
            (NodeKind::Binary(BinaryOp::Div, _, divisor), [a, b]) => {
                if is_zero(dag, *b) {
                    let spans = checked.node(*divisor).spans;
                    self.refuse(spans, "division by 0", "write a divisor other than 0");
                }
                dag.div(*a, *b)
            }
            (NodeKind::Binary(BinaryOp::Pow, base, _), [a, b]) => {
                self.refuse_outside(model, Op::Pow, *base, demand, values);
                model.dag.pow(*a, *b)
            }
            (NodeKind::Binary(BinaryOp::And, ..), [a, b]) => dag.and(*a, *b),
            (NodeKind::Binary(BinaryOp::Or, ..), [a, b]) => dag.or(*a, *b),
            (NodeKind::Binary(BinaryOp::Compare(comparison), ..), [a, b]) => {
                compare(dag, *comparison, *a, *b)
            }
            (NodeKind::Bracket(..), [a, b]) => self.bracket(model, node, *a, *b),
            (NodeKind::Binary(BinaryOp::Mul, a, b), values) => {
                match (checked.node(*a).ty, checked.node(*b).ty) {
                    (Type::Matrix(_, columns), Type::Vector(_)) => {
                        let run = self.demands.run(dag, node, &[*b], columns, demand);
                        products(dag, run, values)
                    }
                    _ => dag.mul(values),
                }
            }
            (NodeKind::Index { .. } | NodeKind::Vector(_), [value, ..]) => *value,
            (NodeKind::Call(Builtin::Elementary(op), items), values) => {
                let argument = match op {
                    Op::Modulo | Op::Remainder => items[1],
                    _ => items[0],
                };
                self.refuse_outside(model, *op, argument, demand, values);
                model.dag.call(*op, values)
            }
            (NodeKind::Call(function, items), values) => {
                self.call(&mut model.dag, node, *function, items, demand, values)
            }
            (NodeKind::Function(function, _), values) => {
                dag.external(function.0 as u16, Partial::Value, values)
            }
            (NodeKind::Sum { loops, .. }, values) => self.sum(dag, loops.clone(), demand, values),
            (NodeKind::If { .. }, [condition, then, otherwise]) => {
                dag.select(*condition, *then, *otherwise)
            }
            _ => self.fault(node, "its operands are not of its form"),
        }
    }

    /// Refuses functions of numbers outside their domains. In an unrolled loop, a condition may
    /// exclude such a number.
    fn refuse_outside(
        &mut self,
        model: &Model,
        function: Op,
        argument: NodeId,
        demand: &Demand,
        values: &[Node],
    ) {
        if !demand.values.is_empty() {
            return;
        }
        let Some(takes) = domain::outside(&model.dag, function, values) else {
            return;
        };
        let numbers: Vec<String> = values
            .iter()
            .map(|value| print::text(model, *value))
            .into_list();
        let message = match (function, numbers.as_slice()) {
            (Op::Sqrt, [x]) => format!("the square root of {x} is not a real number"),
            (Op::Pow, [x, y]) => format!("{x} to the power of {y} is not a real number"),
            (Op::Modulo, [x, y]) => format!("{x} % {y} is not a real number"),
            (_, [x, ..]) => format!("`{}` of {x} is not a real number", function.row().name),
            _ => return,
        };
        self.refuse(self.checked.node(argument).spans, &message, takes);
    }

    /// {a, b}, with velocities as functions of momenta.
    fn bracket(&mut self, model: &mut Model, node: NodeId, a: Node, b: Node) -> Node {
        let spans = self.checked.node(node).spans;
        let is_lagrangian = matches!(self.checked.definition, Definition::Lagrangian(_));
        if is_lagrangian && self.velocities.is_none() {
            let message = "a bracket is of functions of momenta, which a Lagrangian does not have";
            let help = "use it after `L`: in an invariant, a monitor or an event";
            self.refuse(spans, message, help);
            return a;
        }
        let (Some(a), Some(b)) = (
            self.in_momenta(model, spans, a),
            self.in_momenta(model, spans, b),
        ) else {
            return a;
        };
        self.has_brackets = true;
        let before = model.dag.len();
        let bracket = bracket(model, a, b);
        self.derived.since(before, model);
        bracket.unwrap_or_else(|| {
            // Too many loops are reported at the end of lowering.
            if !model.dag.has_too_many_loops() {
                self.refuse(spans, UNSOLVED.0, UNSOLVED.1);
            }
            a
        })
    }

    /// The value with velocities as functions of (q, p, t).
    pub fn in_momenta(&mut self, model: &mut Model, spans: Spans, value: Node) -> Option<Node> {
        let Some(velocities) = &self.velocities else {
            return Some(value);
        };
        let before = model.dag.len();
        let image = velocity::as_functions(model, value, velocities);
        self.derived.since(before, model);
        if image.is_none() {
            let message = "a velocity at an index with `%` is a function of that index here, which momenta do not give";
            let help = "let the masses be an array `m: [N]`, or write the velocity without `%` or in terms of momenta";
            self.refuse(spans, message, help);
        }
        image
    }

    /// An element of a group's variables.
    fn phase(
        &mut self,
        model: &mut Model,
        node: NodeId,
        variable: Variable,
        group: u16,
        demand: &Demand,
    ) -> Node {
        let shape = &model.groups[usize::from(group)].shape;
        let column = match shape {
            Shape::Matrix(_, columns) => match demand.number(1, usize::from(*columns)) {
                Some(column) => column as u16,
                None => return self.fault(node, "its column is not a literal"),
            },
            _ => 0,
        };
        let row = match shape {
            Shape::Scalar => Index::constant(0),
            shape => number(&demand.indices, shape.axes()),
        };
        let of = |group| Column {
            side: Side::Q,
            group,
            column,
        };
        let array = match variable {
            Variable::Coordinate => Array::Phase(of(group)),
            Variable::Momentum => Array::Phase(of(group).conjugate()),
            Variable::NewCoordinate => Array::Phase(of(REPLACING + group)),
            Variable::NewMomentum => Array::Phase(of(REPLACING + group).conjugate()),
            Variable::Velocity => Array::Velocity(of(group)),
        };
        model.dag.element(array, row, None)
    }

    fn call(
        &mut self,
        dag: &mut Dag,
        node: NodeId,
        function: Builtin,
        items: &[NodeId],
        demand: &Demand,
        values: &[Node],
    ) -> Node {
        match function {
            Builtin::Dot | Builtin::Norm | Builtin::NormSquared => {
                let Type::Vector(extent) = self.checked.node(items[0]).ty else {
                    return self.fault(node, "its argument is no vector");
                };
                let run = self.demands.run(dag, node, items, extent, demand);
                if function == Builtin::Dot {
                    return products(dag, run, values);
                }
                let squared = match run {
                    Run::Numbers(_) => dag.sum_of_squares(values),
                    Run::Loop(domain) => {
                        let square = dag.powi(values[0], 2);
                        dag.reduce(domain, square)
                    }
                };
                if function == Builtin::Norm {
                    dag.call(Op::Sqrt, &[squared])
                } else {
                    squared
                }
            }
            Builtin::Cross | Builtin::Elementary(_) | Builtin::Bracket => {
                let [a, b, c, d] = values else {
                    return self.fault(node, "a cross product has two vectors");
                };
                let (first, second) = (dag.mul(&[*a, *b]), dag.mul(&[*c, *d]));
                dag.sub(first, second)
            }
        }
    }

    fn sum(
        &mut self,
        dag: &mut Dag,
        loops: core::ops::Range<u32>,
        demand: &Demand,
        values: &[Node],
    ) -> Node {
        let unrolled = self.demands.unrolled_values(dag, loops.clone(), demand);
        let unrolled = unrolled.expect("its operands were asked for");
        let kept: Vec<Domain> = loops
            .rev()
            .map(Domain)
            .filter(|id| !self.demands.loops.is_unrolled(*id))
            .into_list();
        let mut nests: Vec<Vec<Domain>> = Vec::new();
        for one in &unrolled {
            nests.push(
                kept.iter()
                    .map(|id| self.demands.domain(dag, *id, one))
                    .into_list(),
            );
        }
        let derived = &mut self.derived;
        let mut over = |dag: &mut Dag, nest: &[Domain], body: Node| {
            nest.iter().fold(body, |body, domain| {
                let sum = dag.reduce(*domain, body);
                derived.wrote_sum(dag, sum, *domain);
                sum
            })
        };
        // Unrolled terms stand inside the remaining loops, if these are the same.
        if let Some((first, rest)) = nests.split_first()
            && rest.iter().all(|nest| nest == first)
        {
            let body = dag.add(values);
            return over(dag, first, body);
        }
        let terms: Vec<Node> = nests
            .iter()
            .zip(values)
            .map(|(nest, value)| over(dag, nest, *value))
            .into_list();
        dag.add(&terms)
    }
}

/// The number of an element of a lattice with these extents; the one index of another array.
fn number(indices: &[Index], axes: &[Affine]) -> Index {
    let inner = axes.iter().zip(indices).skip(1);
    inner.fold(indices[0].clone(), |row, (extent, index)| {
        row.row_of(extent.clone(), index.clone())
    })
}

fn is_zero(dag: &Dag, node: Node) -> bool {
    matches!(dag.kind(node), dag::Kind::Constant(value) if value.is_zero())
}

fn compare(dag: &mut Dag, comparison: Comparison, a: Node, b: Node) -> Node {
    match comparison {
        Comparison::Less => dag.less(a, b),
        Comparison::LessEqual => dag.less_equal(a, b),
        Comparison::Greater => dag.less(b, a),
        Comparison::GreaterEqual => dag.less_equal(b, a),
        Comparison::Equal => dag.equal(a, b),
        Comparison::NotEqual => {
            let equal = dag.equal(a, b);
            dag.not(equal)
        }
    }
}

/// Σ of products of pairs, over a loop or one by one.
fn products(dag: &mut Dag, run: Run, values: &[Node]) -> Node {
    let pairs = values.chunks_exact(2);
    let terms: Vec<Node> = pairs.map(|pair| dag.mul(pair)).into_list();
    match run {
        Run::Loop(domain) => dag.reduce(domain, terms[0]),
        Run::Numbers(_) => dag.add(&terms),
    }
}
