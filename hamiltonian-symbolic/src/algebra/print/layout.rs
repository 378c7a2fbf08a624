//! The layout of both notations: the order of fragments, parentheses, signs, the parts of a
//! product, the loops around a place.
//!
//! Input: a node. Output: fragments, written one after another from an explicit stack, so that depth
//! costs no stack and length is bounded. Invariant: parentheses stand exactly where precedence
//! needs them.

use super::names::LoopNames;
use crate::dag::{Array, Dag, Kind, Node, Parameter, Partial, Relation, StandIn};
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::model::{External, Model, Shape};
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;

/// The rest of an expression past this many bytes is written as an ellipsis.
const LONGEST: usize = 16_384;

/// The precedence of an expression, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Level {
    /// `if`, `||`
    Loose,
    /// `&&`
    And,
    /// A comparison.
    Comparison,
    /// A sum.
    Sum,
    /// A product or quotient.
    Product,
    /// `-x`, `!x`, a sum over a loop: fine as a factor, not as a base.
    Unary,
    /// A power.
    Power,
    /// A name, a number, a call.
    Atom,
}

/// An entry of the writer's stack.
#[derive(Clone, Debug)]
pub(super) enum Fragment {
    /// As it stands.
    Static(&'static str),
    /// As it stands.
    Owned(String),
    /// A node, in parentheses if it holds together less tightly.
    Node(Node, Level),
    /// A product: `k·Π`, without its sign.
    Product(Product),
    /// The terms of a sum from this one on, negated if the flag says so.
    Terms(Node, usize, bool),
    /// The head of a sum over a loop; the loop is entered.
    Open(Domain),
    /// The loop is left.
    Close,
}

/// The differences of a notation: its words, and the parts that it writes in another order.
#[derive(Debug)]
pub(super) struct Style {
    pub(super) pi: &'static str,
    /// Parentheses, of arguments too.
    pub(super) open: &'static str,
    pub(super) close: &'static str,
    /// a < b, a ≤ b, a = b
    pub(super) relations: [&'static str; 3],
    /// a ≥ b, a > b, a ≠ b
    pub(super) opposites: [&'static str; 3],
    pub(super) not: &'static str,
    pub(super) and: &'static str,
    pub(super) or: &'static str,
    /// The sign of an omission.
    pub(super) ellipsis: &'static str,
    pub(super) modulo: &'static str,
    /// Between a number and the name of a loop or a size.
    pub(super) times: &'static str,
    /// The precedence of a sum over a loop, the least one of its body, and the word that ends it.
    pub(super) loop_level: Level,
    pub(super) body_level: Level,
    pub(super) loop_end: &'static str,
    /// The upper bound that is written, less the end of the range: 0, or −1 where it is the last index.
    pub(super) last: i64,
    /// The head of a sum over a loop: its variable and bounds.
    pub(super) loop_head: fn(&str, &str, &str) -> String,
    pub(super) number: fn(&Rational) -> String,
    /// True if a number ≥ 0 is written as a fraction.
    pub(super) is_fraction: fn(&Rational) -> bool,
    /// A declared name with indices.
    pub(super) indexed: fn(&str, &[String]) -> String,
    /// A function of the language, and its precedence.
    pub(super) call: fn(&Writer<'_>, Op, &[Node]) -> Vec<Fragment>,
    pub(super) call_level: fn(Op) -> Level,
    /// The name of a function in Rust, or of a derivative of it.
    pub(super) external: fn(&External, Partial) -> String,
    /// A condition, and the two values.
    pub(super) select: fn(Node, Node, Node) -> Vec<Fragment>,
    /// `k·Π` with k ≥ 0.
    pub(super) product: fn(&Writer<'_>, &Product) -> Vec<Fragment>,
}

impl Style {
    fn relation(&self, relation: Relation) -> &'static str {
        self.relations[relation as usize]
    }
    fn opposite(&self, relation: Relation) -> &'static str {
        self.opposites[relation as usize]
    }
}

/// Writes one expression.
#[derive(Debug)]
pub(super) struct Writer<'a> {
    model: &'a Model,
    style: &'static Style,
    scope: LoopNames<'a>,
    out: String,
    stack: Vec<Fragment>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(
        model: &'a Model,
        style: &'static Style,
        bound: &[(Domain, &str)],
    ) -> Writer<'a> {
        Writer {
            model,
            style,
            scope: LoopNames::new(model, bound),
            out: String::new(),
            stack: Vec::new(),
        }
    }

    pub(super) fn dag(&self) -> &'a Dag {
        &self.model.dag
    }

    /// The expression as text.
    pub(super) fn write(mut self, root: Node) -> String {
        self.stack.push(Fragment::Node(root, Level::Loose));
        while let Some(fragment) = self.stack.pop() {
            match fragment {
                Fragment::Static(text) => self.out.push_str(text),
                Fragment::Owned(text) => self.out.push_str(&text),
                Fragment::Node(..) if self.is_long() => self.out.push_str(self.style.ellipsis),
                Fragment::Node(node, level) => self.node(node, level),
                Fragment::Product(product) => {
                    let fragments = (self.style.product)(&self, &product);
                    self.push(fragments);
                }
                Fragment::Terms(node, at, negated) => self.terms(node, at, negated),
                Fragment::Open(domain) => {
                    // The bounds stand outside the loop they bound.
                    let range = self.dag().range(domain);
                    let end = range.end.plus(self.style.last, &Affine::constant(1));
                    let (start, end) = (self.affine(&range.start), self.affine(&end));
                    self.scope.enter(domain);
                    let head = (self.style.loop_head)(&self.scope.name(domain), &start, &end);
                    self.out.push_str(&head);
                }
                Fragment::Close => self.scope.leave(),
            }
        }
        self.out
    }

    fn is_long(&self) -> bool {
        self.out.len() > LONGEST
    }

    /// Pushes fragments to be written next, in order.
    fn push(&mut self, fragments: Vec<Fragment>) {
        self.stack.extend(fragments.into_iter().rev());
    }

    fn node(&mut self, node: Node, level: Level) {
        let mut fragments = self.fragments(node);
        if self.level(node) < level {
            fragments.insert(0, Fragment::Static(self.style.open));
            fragments.push(Fragment::Static(self.style.close));
        }
        self.push(fragments);
    }

    /// A node without parentheses around it.
    fn fragments(&self, node: Node) -> Vec<Fragment> {
        let dag = self.dag();
        let style = self.style;
        let pair = |a: Node, word: &'static str, b: Node, level: Level| {
            let (a, b) = (Fragment::Node(a, level), Fragment::Node(b, level));
            vec![a, Fragment::Static(word), b]
        };
        match dag.kind(node) {
            Kind::Constant(value) => vec![self.number(value)],
            Kind::Pi => vec![Fragment::Static(style.pi)],
            Kind::Scalar(parameter) => vec![self.name(&self.parameter(*parameter))],
            Kind::Time => vec![self.name(self.model.time_name())],
            Kind::Coefficient => vec![Fragment::Static("h")],
            Kind::StandIn(StandIn::Energy) => vec![Fragment::Static("H")],
            Kind::StandIn(_) => vec![Fragment::Static("…")],
            Kind::Variable(domain) => vec![Fragment::Owned(self.variable(*domain))],
            Kind::Extent(size) => vec![self.name(&self.size(*size))],
            Kind::Element(array, row, column) => {
                let indices = self.indices(*array, row, column.as_deref());
                let name = self.model.array_name(*array);
                vec![Fragment::Owned(self.indexed(&name, &indices))]
            }
            Kind::Sum(..) => vec![Fragment::Terms(node, 0, false)],
            Kind::Product(k, factors) => {
                if let Some(sum) = negated_sum(dag, node) {
                    return vec![Fragment::Terms(sum, 0, true)];
                }
                let mut fragments = Vec::new();
                if k.is_negative() {
                    fragments.push(Fragment::Static("-"));
                }
                let product = Product::new(k.abs(), factors.clone());
                fragments.push(Fragment::Product(product));
                fragments
            }
            Kind::Call(op, arguments) => (style.call)(self, *op, arguments),
            Kind::External(function, part, arguments) => {
                let of = &self.model.externals[usize::from(*function)];
                self.listed((style.external)(of, *part), arguments)
            }
            Kind::Reduce(domain, body) => vec![
                Fragment::Open(*domain),
                Fragment::Node(*body, style.body_level),
                Fragment::Close,
                Fragment::Static(style.loop_end),
            ],
            Kind::Count(domain) => {
                let range = dag.range(*domain);
                if range.start == Affine::constant(0) {
                    return vec![Fragment::Owned(self.affine(&range.end))];
                }
                let open = vec![
                    Fragment::Open(*domain),
                    Fragment::Close,
                    Fragment::Static("1"),
                ];
                open.into_iter()
                    .chain([Fragment::Static(style.loop_end)])
                    .into_list()
            }
            Kind::Compare(relation, a, b) => pair(*a, style.relation(*relation), *b, Level::Sum),
            Kind::Not(inner) => match dag.kind(*inner) {
                Kind::Compare(relation, a, b) => {
                    pair(*a, style.opposite(*relation), *b, Level::Sum)
                }
                _ => vec![
                    Fragment::Static(style.not),
                    Fragment::Node(*inner, Level::Atom),
                ],
            },
            Kind::And(a, b) => pair(*a, style.and, *b, Level::And),
            Kind::Or(a, b) => pair(*a, style.or, *b, Level::Loose),
            Kind::Select(c, yes, no) => (style.select)(*c, *yes, *no),
        }
    }

    /// A function with its arguments.
    pub(super) fn listed(&self, name: String, arguments: &[Node]) -> Vec<Fragment> {
        let mut fragments = vec![Fragment::Owned(name), Fragment::Static(self.style.open)];
        for (at, argument) in arguments.iter().enumerate() {
            if at > 0 {
                fragments.push(Fragment::Static(", "));
            }
            fragments.push(Fragment::Node(*argument, Level::Loose));
        }
        fragments.push(Fragment::Static(self.style.close));
        fragments
    }

    /// The precedence of a node as it is written.
    fn level(&self, node: Node) -> Level {
        match self.dag().kind(node) {
            Kind::Constant(value) if value.is_negative() => Level::Unary,
            Kind::Constant(value) if (self.style.is_fraction)(value) => Level::Product,
            Kind::Constant(_) => Level::Atom,
            Kind::Sum(..) => Level::Sum,
            Kind::Product(..) if negated_sum(self.dag(), node).is_some() => Level::Sum,
            Kind::Product(..) => Level::Product,
            Kind::Call(op, _) => (self.style.call_level)(*op),
            Kind::Reduce(..) => self.style.loop_level,
            Kind::Count(domain) => {
                let range = self.dag().range(*domain);
                if range.start == Affine::constant(0) {
                    self.affine_level(&range.end)
                } else {
                    Level::Unary
                }
            }
            Kind::Select(..) | Kind::Or(..) => Level::Loose,
            Kind::And(..) => Level::And,
            Kind::Compare(..) => Level::Comparison,
            Kind::Not(inner) => match self.dag().kind(*inner) {
                Kind::Compare(..) => Level::Comparison,
                _ => Level::Unary,
            },
            Kind::External(..)
            | Kind::Pi
            | Kind::Scalar(_)
            | Kind::Time
            | Kind::Coefficient
            | Kind::Variable(_)
            | Kind::Extent(_)
            | Kind::StandIn(_)
            | Kind::Element(..) => Level::Atom,
        }
    }

    /// The terms of a sum: the first with its sign as a prefix, the others with theirs between.
    fn terms(&mut self, node: Node, at: usize, negated: bool) {
        let dag = self.dag();
        let Kind::Sum(constant, terms) = dag.kind(node) else {
            return;
        };
        // A negative first term would read badly where the constant is positive: `1 - x`.
        let first = constant_stands_first(constant, terms, negated);
        let count = terms.len() + usize::from(!constant.is_zero());
        if at >= count {
            return;
        }
        if at > 0 && self.is_long() {
            self.out.push_str(" + ");
            self.out.push_str(self.style.ellipsis);
            return;
        }
        let term = if first {
            at.checked_sub(1)
        } else {
            Some(at).filter(|at| *at < terms.len())
        };
        let (negative, fragment) = match term {
            None => (constant.is_negative(), self.number(&constant.abs())),
            Some(term) => {
                let (k, child) = &terms[term];
                (k.is_negative(), self.scaled(&k.abs(), *child))
            }
        };
        match (at, negative != negated) {
            (0, false) => {}
            (0, true) => self.out.push('-'),
            (_, false) => self.out.push_str(" + "),
            (_, true) => self.out.push_str(" - "),
        }
        self.push(vec![fragment, Fragment::Terms(node, at + 1, negated)]);
    }

    fn number(&self, value: &Rational) -> Fragment {
        Fragment::Owned((self.style.number)(value))
    }

    /// `k·node` as one product, k ≥ 0.
    fn scaled(&self, k: &Rational, node: Node) -> Fragment {
        if k.is_one() && !matches!(self.dag().kind(node), Kind::Product(..)) {
            return Fragment::Node(node, Level::Product);
        }
        Fragment::Product(Product::of(self.dag(), node).scaled(k))
    }

    /// The name of a loop variable.
    pub(super) fn variable(&self, domain: Domain) -> String {
        self.scope.name(domain)
    }

    /// The name of a size.
    fn size(&self, size: crate::index::Size) -> String {
        self.model.sizes[usize::from(size.0)].clone()
    }

    /// The name of a parameter.
    fn parameter(&self, parameter: Parameter) -> String {
        self.model.parameters[usize::from(parameter.0)].name.clone()
    }

    /// The indices of an element as text: none of a scalar, a row, a row and a column.
    fn indices(&self, array: Array, row: &Index, column: Option<&Index>) -> Vec<String> {
        let column = match array {
            Array::Phase(at) | Array::Direction(at) | Array::Velocity(at) => at.column.to_string(),
            Array::Parameter(_) | Array::Hoisted(_) => {
                column.map_or_else(String::new, |column| self.index(column))
            }
        };
        match self.model.shape(array) {
            Shape::Scalar => Vec::new(),
            Shape::Vector(_) | Shape::Lattice(..) => {
                let places = self.model.places(array, row).into_iter();
                places.map(|place| self.index(&place)).into_list()
            }
            Shape::Matrix(..) => vec![self.index(row), column],
        }
    }

    /// A declared name with indices: `q[2][0]`.
    pub(super) fn indexed(&self, name: &str, indices: &[String]) -> String {
        (self.style.indexed)(name, indices)
    }

    /// A declared name as a fragment.
    fn name(&self, name: &str) -> Fragment {
        Fragment::Owned(self.named(name))
    }

    /// An index.
    fn index(&self, index: &Index) -> String {
        let inner = self.affine(&index.affine);
        let Some(modulo) = &index.modulo else {
            return inner;
        };
        let part = |affine: &Affine, text: String| {
            if self.affine_level(affine) >= Level::Product {
                text
            } else {
                format!("({text})")
            }
        };
        let (inner, modulo) = (
            part(&index.affine, inner),
            if self.affine_level(modulo) == Level::Atom {
                self.affine(modulo)
            } else {
                format!("({})", self.affine(modulo))
            },
        );
        format!("{inner} {} {modulo}", self.style.modulo)
    }

    fn affine_level(&self, affine: &Affine) -> Level {
        let terms: Vec<i64> = affine
            .loops
            .iter()
            .map(|e| e.1)
            .chain(affine.sizes.iter().map(|e| e.1))
            .chain(affine.products.iter().map(|e| e.1))
            .into_list();
        match (terms.as_slice(), affine.constant) {
            ([], c) if c >= 0 => Level::Atom,
            ([1], 0) if affine.products.is_empty() => Level::Atom,
            ([k], 0) if *k > 0 => Level::Product,
            _ => Level::Sum,
        }
    }

    /// An affine index or bound; a positive term first where there is one.
    pub(super) fn affine(&self, affine: &Affine) -> String {
        let mut terms: Vec<(i64, String)> = Vec::new();
        for &(domain, k) in &affine.loops {
            terms.push((k, self.variable(domain)));
        }
        for &(size, k) in &affine.sizes {
            terms.push((k, self.named(&self.size(size))));
        }
        for (sizes, k) in &affine.products {
            let names: Vec<String> = sizes.iter().map(|s| self.named(&self.size(*s))).into_list();
            terms.push((*k, names.join(self.style.times)));
        }
        if affine.constant != 0 || terms.is_empty() {
            terms.push((affine.constant, String::new()));
        }
        if terms[0].0 < 0
            && let Some(positive) = terms.iter().position(|(k, _)| *k > 0)
        {
            let term = terms.remove(positive);
            terms.insert(0, term);
        }
        let mut text = String::new();
        for (at, (k, name)) in terms.iter().enumerate() {
            match (at, *k < 0) {
                (0, true) => text.push('-'),
                (0, false) => {}
                (_, negative) => text.push_str(if negative { " - " } else { " + " }),
            }
            let size = k.unsigned_abs();
            match size {
                _ if name.is_empty() => text.push_str(&size.to_string()),
                1 => text.push_str(name),
                _ => text.push_str(&format!("{size}{}{name}", self.style.times)),
            }
        }
        text
    }

    /// A declared name as this notation writes it.
    pub(super) fn named(&self, name: &str) -> String {
        self.indexed(name, &[])
    }
}

/// Returns true if a sum reads better with its constant first: where it is positive and the first term is
/// not.
fn constant_stands_first(constant: &Rational, terms: &[(Rational, Node)], negated: bool) -> bool {
    !constant.is_zero()
        && constant.is_negative() == negated
        && terms
            .first()
            .is_some_and(|(k, _)| k.is_negative() != negated)
}

/// The sum that a node is the negative of: `-(1 - x)` is written `x - 1`.
fn negated_sum(dag: &Dag, node: Node) -> Option<Node> {
    match dag.kind(node) {
        Kind::Product(k, factors) if *k == Rational::MINUS_ONE => match factors.as_slice() {
            [(sum, 1)] if matches!(dag.kind(*sum), Kind::Sum(..)) => Some(*sum),
            _ => None,
        },
        _ => None,
    }
}

/// A node with its power.
pub(super) type Power = (Node, i32);

/// The factors above and below the line.
pub(super) fn fraction(factors: &[Power]) -> (Vec<Power>, Vec<Power>) {
    let above = factors.iter().filter(|(_, n)| *n > 0).copied().into_list();
    let below = factors
        .iter()
        .filter(|(_, n)| *n < 0)
        .map(|(node, n)| (*node, n.saturating_neg()))
        .into_list();
    (above, below)
}
