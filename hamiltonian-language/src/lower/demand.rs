//! Demands on an expression: its value as a scalar, or one component of it, for given values of the
//! loop variables that are unrolled.
//!
//! Input: a demand on a node. Output: the demands it makes on its children. Invariant: `evaluate`
//! reads the children in the same order.

use super::LARGEST;
use super::loops::Loops;
use crate::ast::BinaryOp;
use crate::checked::{Checked, Extent, NodeId, NodeKind, Type};
use crate::names::Builtin;
use hamiltonian_symbolic::dag::Dag;
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::set::Set;
use hamiltonian_symbolic::sort::Arrange;
use std::iter;

/// The length of the longest vector whose sums over components are unrolled.
const LONGEST: i64 = 16;

/// A demand on a node.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Demand {
    /// The component: empty for a scalar, the index in a vector, row and column in a matrix.
    pub indices: Vec<Index>,
    /// The values of the unrolled loop variables on which the node depends, in order: those of
    /// [`Loops::numbers`], by construction of the demands.
    ///
    /// [`Loops::numbers`]: super::loops::Loops::numbers
    pub values: Vec<(Domain, i64)>,
}

impl Demand {
    /// A component of a vector.
    pub fn at(index: Index) -> Demand {
        Demand {
            indices: vec![index],
            values: Vec::new(),
        }
    }

    /// The value of an unrolled loop variable.
    pub fn value(&self, id: Domain) -> Option<i64> {
        self.values
            .iter()
            .find(|(known, _)| *known == id)
            .map(|(_, value)| *value)
    }

    /// The number below `length` that chooses a component; expressions are checked to have one.
    pub fn number(&self, level: usize, length: usize) -> Option<usize> {
        let index = self.indices.get(level)?;
        let value = index.affine.as_constant()?;
        let value = usize::try_from(value).ok()?;
        (index.modulo.is_none() && value < length).then_some(value)
    }

    fn with(&self, indices: Vec<Index>) -> Demand {
        Demand {
            indices,
            values: self.values.clone(),
        }
    }

    fn scalar(&self) -> Demand {
        self.with(Vec::new())
    }
}

/// Demands on children.
pub type Children = Vec<(NodeId, Demand)>;

/// The reason why a demand cannot be met: message and remedy.
pub type Refused = (String, &'static str);

/// The way to run through the components of a vector.
#[derive(Debug)]
pub enum Run {
    /// One by one.
    Numbers(i64),
    /// By a loop.
    Loop(Domain),
}

impl Run {
    fn indices(&self) -> Vec<Index> {
        match self {
            Run::Numbers(length) => (0..*length).map(Index::constant).into_list(),
            Run::Loop(domain) => vec![Index::of_loop(*domain)],
        }
    }
}

/// The demands that the expressions of one definition make on each other.
#[derive(Debug)]
pub struct Demands<'a> {
    checked: &'a Checked,
    /// Its loops.
    pub loops: Loops,
    /// The number of parents of each node.
    uses: Vec<u32>,
}

impl<'a> Demands<'a> {
    /// Returns the demands of a definition.
    pub fn of(checked: &'a Checked) -> Demands<'a> {
        let mut uses = vec![0; checked.nodes.len()];
        for node in &checked.nodes {
            node.kind
                .for_each_child(|child| uses[child.0 as usize] += 1);
        }
        Demands {
            checked,
            loops: Loops::of(checked),
            uses,
        }
    }

    /// A loop variable for a demand: a number, or the engine's variable.
    fn variable(&self, dag: &mut Dag, id: Domain, demand: &Demand) -> Affine {
        match demand.value(id) {
            Some(value) => Affine::constant(value),
            None => Affine::variable(self.domain(dag, id, demand)),
        }
    }

    /// The engine's loop of a loop that is not unrolled.
    pub fn domain(&self, dag: &mut Dag, id: Domain, demand: &Demand) -> Domain {
        let mut path = vec![id];
        path.extend(iter::successors(self.loops.parent(id), |id| {
            self.loops.parent(*id)
        }));
        let mut domains: Vec<(Domain, Domain)> = Vec::new();
        for one in path.into_iter().rev() {
            let bound = |form: &Affine| {
                form.substitute(|outer| match demand.value(outer) {
                    Some(value) => Affine::constant(value),
                    None => domains
                        .iter()
                        .find(|(known, _)| *known == outer)
                        .map(|(_, domain)| Affine::variable(*domain))
                        .expect("a bound reads loops around it only"),
                })
            };
            let range = &self.checked.loops[one.0 as usize];
            let (start, end) = (bound(&range.lower), bound(&range.upper));
            let parent = domains.last().map(|(_, domain)| *domain);
            domains.push((one, dag.domain(parent, start, end)));
        }
        domains.last().expect("a loop is in its own path").1
    }

    /// The way to run through the components of the vectors `operands` of `node`. The sum over them
    /// stands inside the loops of `node` and of `demand`.
    pub fn run(
        &self,
        dag: &mut Dag,
        node: NodeId,
        operands: &[NodeId],
        extent: Extent,
        demand: &Demand,
    ) -> Run {
        let length = extent.affine();
        match length.as_constant() {
            Some(number)
                if number <= LONGEST || operands.iter().any(|one| self.loops.by_number(*one)) =>
            {
                Run::Numbers(number)
            }
            _ => {
                let mut set = Set::default();
                for index in &demand.indices {
                    set |= index.variables();
                }
                for id in self.loops.free(node).members() {
                    if !self.loops.is_unrolled(id) {
                        set |= Set::of(self.domain(dag, id, demand));
                    }
                }
                let parent = dag.deepest(set);
                Run::Loop(dag.domain(parent, Affine::constant(0), length))
            }
        }
    }

    /// The values of the loop variables of an unrolled sum, the innermost loop fastest.
    ///
    /// # Errors
    /// If a bound is not a number, or if there are more than [`LARGEST`] terms.
    pub fn unrolled_values(
        &self,
        dag: &mut Dag,
        loops: core::ops::Range<u32>,
        demand: &Demand,
    ) -> Result<Vec<Demand>, Refused> {
        let not_numbers = || {
            (
                "a loop that chooses components must have a literal range".to_owned(),
                "components of a vector are chosen by number: write the range in numbers, as in `sum(c in 0..3) { … }`",
            )
        };
        let mut all = vec![demand.clone()];
        for id in loops.map(Domain) {
            if !self.loops.is_unrolled(id) {
                continue;
            }
            let range = &self.checked.loops[id.0 as usize];
            let mut next = Vec::new();
            for one in &all {
                let mut number = |bound: &Affine| {
                    let bound = bound.substitute(|id| self.variable(dag, id, one));
                    bound.as_constant().ok_or_else(not_numbers)
                };
                let (start, end) = (number(&range.lower)?, number(&range.upper)?);
                if end.saturating_sub(start) > LARGEST as i64 || next.len() > LARGEST {
                    return Err((
                        format!(
                            "loops that choose components are unrolled, and here they run more than {LARGEST} times"
                        ),
                        "let a short loop choose the components, as in `sum(c in 0..3) { … }`, and others stay loops",
                    ));
                }
                for value in start..end {
                    let mut with = one.clone();
                    with.values.push((id, value));
                    next.push(with);
                }
            }
            all = next;
        }
        Ok(all)
    }

    /// The terms of a sum in the order of the source, with their signs. A leading sum that is used
    /// only here is part of it: `a + b - c` is one sum of three terms, so 50 000 terms are one sum.
    pub fn terms(&self, node: NodeId) -> Vec<(bool, NodeId)> {
        let mut terms = Vec::new();
        let mut at = node;
        loop {
            let (first, second, negative) = match &self.checked.node(at).kind {
                NodeKind::Binary(BinaryOp::Add, a, b) => (*a, *b, false),
                NodeKind::Binary(BinaryOp::Sub, a, b) => (*a, *b, true),
                _ => break,
            };
            terms.push((negative, second));
            at = first;
            if self.uses[at.0 as usize] > 1 {
                break;
            }
        }
        terms.push((false, at));
        terms.reverse();
        terms
    }

    /// The demands on the children of a node that follow from a demand on the node.
    ///
    /// # Errors
    /// If a loop variable chooses the component of a sum, and those of
    /// [`Demands::unrolled_values`].
    pub fn children(
        &self,
        dag: &mut Dag,
        node: NodeId,
        demand: &Demand,
    ) -> Result<Children, Refused> {
        let mut wanted = Vec::new();
        let checked = self.checked;
        let this = checked.node(node);
        let is_scalar = |child: NodeId| matches!(checked.node(child).ty, Type::Scalar | Type::Bool);
        // A scalar factor of a vector is demanded whole, a vector by the same component.
        let same = |child: NodeId| {
            if is_scalar(child) {
                demand.scalar()
            } else {
                demand.clone()
            }
        };
        match &this.kind {
            NodeKind::Binary(BinaryOp::Mul, a, b) => {
                match (checked.node(*a).ty, checked.node(*b).ty) {
                    (Type::Matrix(_, columns), Type::Vector(_)) => {
                        for k in self.run(dag, node, &[*b], columns, demand).indices() {
                            let row = &demand.indices[0];
                            wanted.push((*a, demand.with(vec![row.clone(), k.clone()])));
                            wanted.push((*b, demand.with(vec![k])));
                        }
                    }
                    _ => wanted.extend([(*a, same(*a)), (*b, same(*b))]),
                }
            }
            NodeKind::Unary(_, a) => wanted.push((*a, same(*a))),
            NodeKind::Binary(BinaryOp::Add | BinaryOp::Sub, ..) => {
                wanted.extend(
                    self.terms(node)
                        .into_iter()
                        .map(|(_, term)| (term, same(term))),
                );
            }
            NodeKind::Binary(_, a, b) => wanted.extend([(*a, same(*a)), (*b, same(*b))]),
            NodeKind::Index { base, index } => {
                let mut indices = vec![index.substitute(|id| self.variable(dag, id, demand))];
                indices.extend(demand.indices.iter().cloned());
                wanted.push((*base, demand.with(indices)));
            }
            NodeKind::Vector(items) => {
                if let Some(at) = demand.number(0, items.len()) {
                    wanted.push((items[at], demand.scalar()));
                }
            }
            NodeKind::Call(Builtin::Cross, items) => {
                if let Some(at) = demand.number(0, 3) {
                    let (i, j) = ((at as i64 + 1) % 3, (at as i64 + 2) % 3);
                    for (item, component) in
                        [(items[0], i), (items[1], j), (items[0], j), (items[1], i)]
                    {
                        wanted.push((item, demand.with(vec![Index::constant(component)])));
                    }
                }
            }
            NodeKind::Call(Builtin::Dot | Builtin::Norm | Builtin::NormSquared, items) => {
                let Type::Vector(extent) = checked.node(items[0]).ty else {
                    return Ok(wanted);
                };
                let run = self.run(dag, node, items, extent, demand);
                for k in run.indices() {
                    for item in items {
                        wanted.push((*item, demand.with(vec![k.clone()])));
                    }
                }
            }
            NodeKind::Sum { .. }
                if demand
                    .indices
                    .iter()
                    .any(|index| !index.variables().is_empty()) =>
            {
                return Err((
                    "a component of a sum of vectors is chosen by a loop variable here".to_owned(),
                    "choose the component inside the sum: `sum(i in 0..n) { w[i][k] }`",
                ));
            }
            NodeKind::Sum { loops, body } => {
                let all = self.unrolled_values(dag, loops.clone(), demand)?;
                wanted.extend(all.into_iter().map(|one| (*body, one)));
            }
            NodeKind::If {
                condition,
                then,
                otherwise,
            } => {
                wanted.extend([
                    (*condition, demand.scalar()),
                    (*then, same(*then)),
                    (*otherwise, same(*otherwise)),
                ]);
            }
            // All other nodes are leaves or have scalar children.
            kind => kind.for_each_child(|child| wanted.push((child, demand.scalar()))),
        }
        // Loops on which a value does not depend do not belong to its demand.
        for (child, demand) in &mut wanted {
            let numbers = self.loops.numbers(*child);
            demand.values.retain(|(id, _)| numbers.has(*id));
            demand.values.arrange();
        }
        Ok(wanted)
    }
}
