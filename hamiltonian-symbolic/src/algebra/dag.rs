//! The arena of expressions: hash-consed, children before parents.
//!
//! Input: constructor calls (the rules they apply are in `simplify`). Output: [`Node`] handles.
//! Invariant: structurally equal expressions are the same node, sums and products up to the order
//! of their operands; the order first written is kept for evaluation; a child's number is below
//! its parents', so a forward pass over numbers is bottom-up and nothing here recurses.

mod array;
mod bounds;
mod map;
mod numbers;
pub mod op;
mod sign;
mod work;

pub use array::{Array, Column, Side};
pub use map::{Map, Mixer};
pub(crate) use numbers::Numbers;
pub(crate) use sign::Sign;
pub(crate) use work::work;

use crate::index::{Affine, Domain, Index, LOOPS, Loops, Size};
use crate::ranges::Ranges;
use crate::rational::Rational;
use crate::sort::Arrange;
use op::Op;

/// An expression.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Node(pub u32);

/// A parameter of the system: its number in the model.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Parameter(pub u16);

/// A comparison.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Relation {
    /// a < b
    Less,
    /// a ≤ b
    LessEqual,
    /// a = b
    Equal,
}

/// The value of an external function, or a derivative.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Partial {
    /// The function itself.
    Value,
    /// ∂/∂(argument i).
    First(u16),
    /// ∂²/∂(argument i)∂(argument j), i ≤ j.
    Second(u16, u16),
    /// A derivative of third or higher order, which proofs may meet and programs refuse.
    Higher {
        /// The order.
        order: u16,
        /// The sum of one number for each of the arguments: the same for each order of differentiation.
        arguments: u64,
    },
}

impl Partial {
    /// The derivative by argument i.
    pub fn by(self, i: u16) -> Partial {
        let higher = |order: u16, arguments: u64| Partial::Higher {
            order,
            arguments: arguments.wrapping_add(Partial::mixed(i)),
        };
        match self {
            Partial::Value => Partial::First(i),
            Partial::First(j) => Partial::Second(i.min(j), i.max(j)),
            Partial::Second(j, k) => higher(3, Partial::mixed(j).wrapping_add(Partial::mixed(k))),
            Partial::Higher { order, arguments } => higher(order.saturating_add(1), arguments),
        }
    }

    /// A number of an argument whose sums tell multisets of arguments apart (the finalizer of SplitMix64).
    fn mixed(argument: u16) -> u64 {
        let mut x = (u64::from(argument) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }
}

/// A node that the engine puts in the place of another. None is in a program, which
/// [`Program::validate`](crate::program::Program::validate) checks.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum StandIn {
    /// A derivative that was not made, because the budget of the search was spent.
    Spent,
    /// A part of an expression that is differentiated by it.
    Part,
    /// A part of an expression that is held.
    Held,
    /// The value of H, a constant of the motion.
    Energy,
}

/// The kind of a node.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// An exact number.
    Constant(Rational),
    /// π.
    Pi,
    /// A scalar parameter.
    Scalar(Parameter),
    /// Time.
    Time,
    /// The coefficient of an accumulating kick, drift or flow.
    Coefficient,
    /// A loop variable as a real.
    Variable(Domain),
    /// A size as a real.
    Extent(Size),
    /// An array element: row, and column for a rank-2 parameter.
    Element(Array, Index, Option<Box<Index>>),
    /// `constant + Σ k·node`
    Sum(Rational, Vec<(Rational, Node)>),
    /// `k·Π node^n`, n a non-zero integer.
    Product(Rational, Vec<(Node, i32)>),
    /// An elementary function.
    Call(Op, Vec<Node>),
    /// A function written in Rust, by its number in the model, or a derivative of it.
    External(u16, Partial, Vec<Node>),
    /// Σ of the body over a loop.
    Reduce(Domain, Node),
    /// The number of times a loop runs, as a real.
    Count(Domain),
    /// A comparison (a condition, not a number).
    Compare(Relation, Node, Node),
    /// Not (a condition).
    Not(Node),
    /// And (conditions).
    And(Node, Node),
    /// Or (conditions).
    Or(Node, Node),
    /// The second where the first (a condition) holds, the third elsewhere.
    Select(Node, Node, Node),
    /// A node in the place of another, which has no value.
    StandIn(StandIn),
}

impl Kind {
    /// Calls `visit` with each child.
    fn for_children(&self, visit: &mut dyn FnMut(Node)) {
        match self {
            Kind::Sum(_, terms) => terms.iter().for_each(|(_, n)| visit(*n)),
            Kind::Product(_, factors) => factors.iter().for_each(|(n, _)| visit(*n)),
            Kind::Call(_, arguments) | Kind::External(_, _, arguments) => {
                arguments.iter().for_each(|n| visit(*n))
            }
            Kind::Reduce(_, body) => visit(*body),
            Kind::Not(a) => visit(*a),
            Kind::Compare(_, a, b) | Kind::And(a, b) | Kind::Or(a, b) => {
                visit(*a);
                visit(*b);
            }
            Kind::Select(c, a, b) => {
                visit(*c);
                visit(*a);
                visit(*b);
            }
            Kind::Constant(_)
            | Kind::Pi
            | Kind::Scalar(_)
            | Kind::Time
            | Kind::Coefficient
            | Kind::Variable(_)
            | Kind::Extent(_)
            | Kind::Element(..)
            | Kind::Count(_)
            | Kind::StandIn(_) => {}
        }
    }
}

/// Nodes that are still to be visited: a bit for each.
pub(crate) struct Worklist(Vec<u64>);

impl Worklist {
    /// The node is visited too.
    pub(crate) fn add(&mut self, node: Node) {
        self.0[node.0 as usize / 64] |= 1 << (node.0 % 64);
    }
    /// All of them are.
    pub(crate) fn extend<'a>(&mut self, nodes: impl Iterator<Item = &'a Node>) {
        nodes.for_each(|node| self.add(*node));
    }
}

/// The dependences of a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Dependence(pub u8);

impl Dependence {
    /// On coordinates.
    pub const Q: Dependence = Dependence(1);
    /// On momenta.
    pub const P: Dependence = Dependence(2);
    /// On time.
    pub const TIME: Dependence = Dependence(4);
    /// On parameters or named sizes.
    pub const PARAMETER: Dependence = Dependence(8);
    /// On the step coefficient.
    pub const COEFFICIENT: Dependence = Dependence(16);
    /// On the direction of a Hessian product.
    pub const DIRECTION: Dependence = Dependence(32);
    /// On velocities that stand for themselves.
    pub const VELOCITY: Dependence = Dependence(64);
    /// On what moves along a trajectory.
    pub const MOVING: Dependence = Dependence(1 | 2 | 4);

    /// Returns true if it shares anything with `other`.
    #[must_use]
    pub fn on(self, other: Dependence) -> bool {
        self.0 & other.0 != 0
    }
    /// When it can be computed.
    #[must_use]
    pub fn stage(self) -> Stage {
        if self.0 & 0b110_0111 != 0 {
            Stage::Evaluation
        } else if self.0 & 16 != 0 {
            Stage::Coefficient
        } else if self.0 & 8 != 0 {
            Stage::Parameters
        } else {
            Stage::Constant
        }
    }
}

/// When a value can be computed: the binding times of the emitted code.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Stage {
    /// At compile time.
    Constant,
    /// Once per run, from parameters (`prepare`).
    Parameters,
    /// Once per step size, from parameters and the step coefficient.
    Coefficient,
    /// At every evaluation.
    Evaluation,
}

#[derive(Clone, Copy, Debug)]
struct Properties {
    dependence: Dependence,
    variables: Loops,
    sign: Sign,
    height: u32,
    /// A part of a long product, which no product it stands in takes apart.
    sealed: bool,
}

/// A loop: its range, in the context of its parent.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Range {
    /// The enclosing loop.
    pub parent: Option<Domain>,
    /// The first value.
    pub start: Affine,
    /// One past the last value.
    pub end: Affine,
}

/// The arena.
#[derive(Default, Debug, Clone)]
pub struct Dag {
    kinds: Vec<Kind>,
    facts: Vec<Properties>,
    known: Map<Kind, Node>,
    ranges: Vec<Range>,
    known_ranges: Map<Range, Domain>,
    /// In proofs, [`rooms`](crate::ranges::Ranges::rooms) (see [`Model::with_rooms`](crate::model::Model)).
    pub(crate) rooms: Vec<Affine>,
    /// True if a loop was requested after [`LOOPS`] others.
    has_too_many_loops: bool,
}

impl Dag {
    /// An empty arena.
    #[must_use]
    pub fn new() -> Dag {
        Dag::default()
    }
    /// The number of nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.kinds.len()
    }
    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }
    /// The kind of a node.
    #[must_use]
    pub fn kind(&self, node: Node) -> &Kind {
        &self.kinds[node.0 as usize]
    }
    /// The dependences of a node.
    #[must_use]
    pub fn dependence(&self, node: Node) -> Dependence {
        self.facts[node.0 as usize].dependence
    }
    /// When a node can be computed.
    #[must_use]
    pub fn stage(&self, node: Node) -> Stage {
        self.dependence(node).stage()
    }
    /// The column and the row of an element of phase space.
    #[must_use]
    pub fn phase_place(&self, node: Node) -> Option<(Column, &Index)> {
        match self.kind(node) {
            Kind::Element(Array::Phase(column), row, _) => Some((*column, row)),
            _ => None,
        }
    }
    /// The loops whose variables a node depends on.
    #[must_use]
    pub fn variables(&self, node: Node) -> Loops {
        self.facts[node.0 as usize].variables
    }
    /// The signs that the value may have, where there is one.
    pub(crate) fn sign(&self, node: Node) -> Sign {
        self.facts[node.0 as usize].sign
    }
    /// Returns true if the value is provably ≥ 0 (or NaN).
    #[must_use]
    pub fn is_nonnegative(&self, node: Node) -> bool {
        self.sign(node).is_nonnegative()
    }
    /// The longest way down to a leaf, in operations. A low node can be computed early.
    #[must_use]
    pub fn height(&self, node: Node) -> u32 {
        self.facts[node.0 as usize].height
    }
    /// Returns true if a node is a product of two that no product takes apart (see `programs::balance`).
    pub(crate) fn is_sealed(&self, node: Node) -> bool {
        self.facts[node.0 as usize].sealed
    }
    /// Keeps a product from being taken apart.
    pub(crate) fn close(&mut self, node: Node) {
        self.facts[node.0 as usize].sealed = true;
    }
    /// The innermost loop a node must be computed in.
    #[must_use]
    pub fn home(&self, node: Node) -> Option<Domain> {
        self.deepest(self.variables(node))
    }
    /// The deepest of a set of loops, which lie on one path.
    #[must_use]
    pub fn deepest(&self, set: Loops) -> Option<Domain> {
        let mut best: Option<(usize, Domain)> = None;
        for domain in set.members() {
            let depth = self.depth(Some(domain));
            if best.is_none_or(|(d, _)| depth > d) {
                best = Some((depth, domain));
            }
        }
        best.map(|(_, domain)| domain)
    }
    /// The number of loops from the outermost to `domain`.
    #[must_use]
    pub fn depth(&self, domain: Option<Domain>) -> usize {
        let mut depth = 0;
        let mut at = domain;
        while let Some(d) = at {
            depth += 1;
            at = self.range(d).parent;
        }
        depth
    }
    /// The loops from the outermost to `domain`.
    #[must_use]
    pub fn path(&self, domain: Option<Domain>) -> Vec<Domain> {
        let mut path = Vec::new();
        let mut at = domain;
        while let Some(d) = at {
            path.push(d);
            at = self.range(d).parent;
        }
        path.reverse();
        path
    }
    /// A loop's range.
    #[must_use]
    pub fn range(&self, domain: Domain) -> &Range {
        &self.ranges[domain.0 as usize]
    }
    /// The number of loops.
    #[must_use]
    pub fn loop_count(&self) -> usize {
        self.ranges.len()
    }
    /// Returns true if more than [`LOOPS`] loops were requested. Nodes made since may be wrong: code that
    /// makes loops checks this before it uses the result.
    #[must_use]
    pub fn has_too_many_loops(&self) -> bool {
        self.has_too_many_loops
    }
    /// The loop over `start..end` inside `parent`; an arbitrary one if there are [`LOOPS`] already
    /// (see [`Dag::has_too_many_loops`]).
    pub fn domain(&mut self, parent: Option<Domain>, start: Affine, end: Affine) -> Domain {
        let range = Range { parent, start, end };
        if let Some(&domain) = self.known_ranges.get(&range) {
            return domain;
        }
        if self.ranges.len() == LOOPS {
            self.has_too_many_loops = true;
            return Domain(LOOPS as u32 - 1);
        }
        let domain = Domain(self.ranges.len() as u32);
        self.ranges.push(range.clone());
        self.known_ranges.insert(range, domain);
        domain
    }

    /// Calls `visit` with each child of a node.
    pub fn for_children(&self, node: Node, mut visit: impl FnMut(Node)) {
        self.kind(node).for_children(&mut visit);
    }

    /// All nodes the roots need, children before parents.
    #[must_use]
    pub fn reachable(&self, roots: &[Node]) -> Vec<Node> {
        self.reached(roots, &mut |node, worklist| {
            self.for_children(node, |child| worklist.add(child));
        })
    }
    /// Returns true if the roots need a node of a kind.
    pub(crate) fn has(&self, roots: &[Node], is_asked: &dyn Fn(&Kind) -> bool) -> bool {
        let nodes = self.reachable(roots);
        nodes.iter().any(|node| is_asked(self.kind(*node)))
    }
    /// Returns true if there are sums over loops below the roots.
    pub(crate) fn has_loops(&self, roots: &[Node]) -> bool {
        self.has(roots, &|kind| matches!(kind, Kind::Reduce(..)))
    }
    /// All nodes that are reached from the roots by going from a node to those that `next` adds, some
    /// of its children: children before parents.
    pub(crate) fn reached(
        &self,
        roots: &[Node],
        next: &mut dyn FnMut(Node, &mut Worklist),
    ) -> Vec<Node> {
        let Some(top) = roots.iter().max() else {
            return Vec::new();
        };
        // Parents have larger numbers.
        let mut worklist = Worklist(vec![0; top.0 as usize / 64 + 1]);
        let mut order = Vec::new();
        roots.iter().for_each(|root| worklist.add(*root));
        for word in (0..worklist.0.len()).rev() {
            while worklist.0[word] != 0 {
                let bit = 63 - worklist.0[word].leading_zeros();
                worklist.0[word] ^= 1 << bit;
                let node = Node(word as u32 * 64 + bit);
                order.push(node);
                next(node, &mut worklist);
            }
        }
        order.reverse();
        order
    }

    /// The node of a kind, new or known. Operands of sums and products are compared without
    /// regard to order. Called by the constructors of `simplify`, and by `rewrite` and passes of `programs` for nodes
    /// that the constructors would change.
    pub(crate) fn intern(&mut self, kind: Kind) -> Node {
        let key = match &kind {
            Kind::Sum(c, terms) => {
                let mut sorted = terms.clone();
                sorted.arrange_by_key(|(_, n)| *n);
                Kind::Sum(c.clone(), sorted)
            }
            Kind::Product(c, factors) => {
                let mut sorted = factors.clone();
                sorted.arrange_by_key(|(n, _)| *n);
                Kind::Product(c.clone(), sorted)
            }
            _ => kind.clone(),
        };
        if let Some(&node) = self.known.get(&key) {
            return node;
        }
        let node = Node(self.kinds.len() as u32);
        let facts = self.properties_of(&kind);
        self.kinds.push(kind);
        self.facts.push(facts);
        self.known.insert(key, node);
        node
    }

    /// The node of a kind if it is already there.
    pub(crate) fn known(&self, sorted: &Kind) -> Option<Node> {
        self.known.get(sorted).copied()
    }

    fn properties_of(&self, kind: &Kind) -> Properties {
        let mut dependence = Dependence::default();
        let mut variables = Loops::default();
        let mut height = 0;
        kind.for_children(&mut |child| {
            height = height.max(self.height(child) + 1);
            dependence.0 |= self.dependence(child).0;
            variables |= self.variables(child);
        });
        let sign = match kind {
            Kind::Constant(c) => Sign::of(c),
            Kind::Pi => Sign::POSITIVE,
            Kind::Extent(_) | Kind::Count(_) => Sign::NONNEGATIVE,
            Kind::Variable(d) if self.is_never_negative(&self.range(*d).start) => Sign::NONNEGATIVE,
            Kind::Sum(c, terms) => {
                let mut sum = Sign::of(c);
                for (k, node) in terms {
                    sum = sum.plus(Sign::of(k).times(self.sign(*node)));
                    if sum.is_unknown() {
                        break;
                    }
                }
                sum
            }
            Kind::Product(c, factors) => {
                Sign::of_product(c, factors.iter().map(|(f, n)| (self.sign(*f), *n)))
            }
            Kind::Call(op, arguments) => Sign::of_call(*op, self.sign(arguments[0])),
            // The range may be empty.
            Kind::Reduce(_, body) => self.sign(*body).or(Sign::ZERO),
            Kind::Select(_, a, b) => self.sign(*a).or(self.sign(*b)),
            _ => Sign::UNKNOWN,
        };
        let own = match kind {
            Kind::Scalar(_)
            | Kind::Extent(_)
            | Kind::StandIn(_)
            | Kind::Element(Array::Parameter(_) | Array::Hoisted(_), ..) => Dependence::PARAMETER,
            Kind::Element(Array::Phase(Column { side: Side::Q, .. }), ..) => Dependence::Q,
            Kind::Element(Array::Phase(Column { side: Side::P, .. }), ..) => Dependence::P,
            Kind::Element(Array::Direction(_), ..) => Dependence::DIRECTION,
            Kind::Element(Array::Velocity(_), ..) => Dependence::VELOCITY,
            Kind::Time => Dependence::TIME,
            Kind::Coefficient => Dependence::COEFFICIENT,
            Kind::Count(d) | Kind::Reduce(d, _) => {
                let range = self.range(*d);
                variables |= range.start.variables() | range.end.variables();
                variables = variables.without(Loops::of(*d));
                if range.start.has_sizes() || range.end.has_sizes() {
                    Dependence::PARAMETER
                } else {
                    Dependence::default()
                }
            }
            _ => Dependence::default(),
        };
        dependence.0 |= own.0;
        match kind {
            Kind::Variable(d) => variables |= Loops::of(*d),
            Kind::Element(_, row, column) => {
                variables |= row.variables();
                variables |= column.as_ref().map(|c| c.variables()).unwrap_or_default();
            }
            _ => {}
        }
        Properties {
            dependence,
            variables,
            sign,
            height,
            sealed: false,
        }
    }
}
