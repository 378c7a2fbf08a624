//! Where an expression may jump through a pole, as |q|/q and arctan(p/q) do.
//!
//! Input: expressions. Output: a part of them whose limits from the two sides of a pole differ.
//!
//! What is analytic but for poles, and constant along a trajectory on one side of a pole, is the
//! same constant on the other side: it is continued around the pole through complex times. What is
//! continuous is the same constant too. So a jump takes a pole and a function that is not analytic
//! there: it has a kink where the pole is (|q|), or is read at infinity (arctan(1/q)). Where both
//! occur, limits are compared at points of the poles. Sets that trajectories need not cross, those
//! of less than one dimension below the whole (r = 0 in space), separate nothing.
//!
//! Invariant: expressions without both are never looked at in numbers; points are the same on every
//! machine.

use crate::dag::{Array, Dag, Dependence, Kind, Map, Node};
use crate::loops::{Sample, Sampled, Signs, sample, unroll_nodes};
use crate::model::Model;
use crate::normal_form::trials;
use crate::op::Op;
use crate::print;

/// How many lines through phase space are followed where parameters are positive (one more for each
/// choice of negative ones),
const LINES: usize = 2;
/// how often a pole is looked for on a line: of many poles each is on fewer lines, the first at least,
const LOOKS: usize = 256;
/// and how many points of one pole are looked at on each.
const CROSSINGS: usize = 3;
/// How far from the pole values are compared: what has limits has nearly reached them.
const STEPS: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// A part that jumps through a pole, as text; or that may, where no sizes are known at which it has
/// a value.
pub(super) fn find(model: &Model, roots: &[Node]) -> Option<String> {
    let traits = Traits::of(&model.dag, roots);
    let suspects: Vec<Node> = roots
        .iter()
        .copied()
        .filter(|n| traits.is_suspect(*n))
        .collect();
    let first = *suspects.first()?;
    let written = trials(model, &suspects)
        .into_iter()
        .find_map(|sizes| unroll_nodes(model, &sizes, &suspects).ok());
    match written {
        Some((mut model, roots)) => jumping(&mut model, &roots),
        None => Some(print::text(model, first)),
    }
}

/// The first part of expressions without loops that jumps, in one of them that does.
fn jumping(model: &mut Model, roots: &[Node]) -> Option<String> {
    for &root in roots {
        let traits = Traits::of(&model.dag, &[root]);
        let parts: Vec<Node> = model.dag.reachable(&[root]);
        let parts: Vec<Node> = parts
            .into_iter()
            .filter(|n| traits.is_suspect(*n))
            .collect();
        let poles = traits.zeros(&mut model.dag);
        let signs = std::iter::repeat_n(Signs::default(), LINES).chain(Signs::negative());
        let lines = (LOOKS / poles.len().max(1)).max(1);
        for (number, signs) in signs.enumerate().take(lines) {
            let line = Line::new(model, root, number as u64, signs);
            for &pole in &poles {
                let jump = line
                    .zeros(pole)
                    .into_iter()
                    .find(|at| line.jumps(root, *at));
                if let Some(at) = jump {
                    let part = parts.iter().find(|part| line.jumps(**part, at));
                    return Some(print::text(model, *part.unwrap_or(&root)));
                }
            }
        }
    }
    None
}

/// What is known of nodes.
struct Traits {
    /// Those with a pole that trajectories may cross.
    has_pole: Map<Node, ()>,
    /// Those that are not analytic somewhere trajectories may cross.
    is_rough: Map<Node, ()>,
    /// Where poles are: zeros of expressions, or poles of the tangent of them, or where they are 1
    /// or −1.
    poles: Vec<(Pole, Node)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Pole {
    Zero,
    Tangent,
    Unit,
    MinusOne,
}

impl Traits {
    fn of(dag: &Dag, roots: &[Node]) -> Traits {
        let mut traits = Traits {
            has_pole: Map::default(),
            is_rough: Map::default(),
            poles: Vec::new(),
        };
        for node in dag.reachable(roots) {
            if !dag.dependence(node).on(Dependence::MOVING) {
                continue;
            }
            let (mut has_pole, mut is_rough) = (false, false);
            dag.for_children(node, |child| {
                has_pole |= traits.has_pole.contains_key(&child);
                is_rough |= traits.is_rough.contains_key(&child);
            });
            is_rough |= is_rough_itself(dag, node, has_pole);
            for pole in poles_of(dag, node) {
                has_pole = true;
                if !traits.poles.contains(&pole) {
                    traits.poles.push(pole);
                }
            }
            if has_pole {
                traits.has_pole.insert(node, ());
            }
            if is_rough {
                traits.is_rough.insert(node, ());
            }
        }
        traits
    }

    /// Whether a jump is possible.
    fn is_suspect(&self, node: Node) -> bool {
        self.has_pole.contains_key(&node) && self.is_rough.contains_key(&node)
    }

    /// Expressions that are 0 where the poles are.
    fn zeros(&self, dag: &mut Dag) -> Vec<Node> {
        let one = dag.integer(1);
        let each = self.poles.iter();
        each.map(|&(pole, node)| match pole {
            Pole::Zero => node,
            Pole::Tangent => dag.call(Op::Cos, &[node]),
            Pole::Unit => {
                let square = dag.powi(node, 2);
                dag.sub(one, square)
            }
            Pole::MinusOne => dag.add(&[one, node]),
        })
        .collect()
    }
}

/// Where a node has poles of its own.
fn poles_of(dag: &Dag, node: Node) -> Vec<(Pole, Node)> {
    let found: Vec<(Pole, Node)> = match dag.kind(node) {
        Kind::Product(_, factors) => {
            let below = factors.iter().filter(|(_, n)| *n < 0);
            below.map(|(base, _)| (Pole::Zero, *base)).collect()
        }
        Kind::Call(Op::Ln | Op::Pow, x) => vec![(Pole::Zero, x[0])],
        Kind::Call(Op::Ln1p, x) => vec![(Pole::MinusOne, x[0])],
        Kind::Call(Op::Tan, x) => vec![(Pole::Tangent, x[0])],
        Kind::Call(Op::Atanh, x) => vec![(Pole::Unit, x[0])],
        _ => Vec::new(),
    };
    let crossed = found.into_iter().filter(|(pole, node)| match pole {
        Pole::Zero => !is_thin(dag, *node),
        _ => dag.dependence(*node).on(Dependence::MOVING),
    });
    crossed
        .map(|(pole, mut node)| {
            // Roots are 0 where what is below them is, and change sign nowhere.
            while let Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) = dag.kind(node) {
                node = x[0];
            }
            (pole, node)
        })
        .collect()
}

/// Whether a node is not analytic somewhere its operands are; or at infinity, where they have a
/// pole.
fn is_rough_itself(dag: &Dag, node: Node, has_pole: bool) -> bool {
    match dag.kind(node) {
        Kind::Select(..) => true,
        Kind::External(..) => has_pole,
        Kind::Call(op, x) => match op {
            Op::Min | Op::Max | Op::Asin | Op::Acos | Op::Acosh => true,
            Op::Abs | Op::Sqrt | Op::Ln | Op::Pow => has_pole || !is_thin(dag, x[0]),
            Op::Hypot => has_pole || !is_thin(dag, node),
            Op::Atan | Op::Asinh | Op::Atanh | Op::Ln1p => has_pole,
            // What jumps by itself is found before; the others have one value at every complex
            // number but their poles, or, the cubic root, at that of its argument.
            _ => false,
        },
        _ => false,
    }
}

/// Whether the zeros of a node are nowhere, or have two dimensions less than what they lie in:
/// nothing crosses them.
fn is_thin(dag: &Dag, node: Node) -> bool {
    if !dag.dependence(node).on(Dependence::MOVING) {
        return true;
    }
    match dag.kind(node) {
        Kind::Call(Op::Exp | Op::Cosh, _) => true,
        Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) => is_thin(dag, x[0]),
        Kind::Call(Op::Hypot, x) => are_thin_together(dag, x),
        Kind::Product(_, factors) => factors.iter().all(|(f, n)| *n < 0 || is_thin(dag, *f)),
        // 0 where all terms are.
        Kind::Sum(c, terms) if dag.is_nonnegative(node) => {
            let terms: Vec<Node> = terms.iter().map(|(_, term)| *term).collect();
            !c.is_zero() || are_thin_together(dag, &terms)
        }
        _ => false,
    }
}

/// Whether the common zeros of some expressions are so: of one of them, or of two that have no
/// coordinate, momentum or time in common.
fn are_thin_together(dag: &Dag, nodes: &[Node]) -> bool {
    nodes.iter().any(|node| is_thin(dag, *node))
        || nodes.iter().enumerate().any(|(at, one)| {
            let own = moving(dag, *one);
            let is_apart = |other: &Node| {
                let others = moving(dag, *other);
                !own.iter()
                    .any(|a| others.iter().any(|b| may_be_same(*a, *b)))
            };
            nodes[at + 1..].iter().any(is_apart)
        })
}

/// A coordinate or momentum: its array, and its row where that is a number. Nothing is the time.
type Leaf = Option<(Array, Option<i64>)>;

fn may_be_same(a: Leaf, b: Leaf) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some((a, i)), Some((b, j))) => a == b && (i.is_none() || j.is_none() || i == j),
        _ => false,
    }
}

/// What moves in a node.
fn moving(dag: &Dag, node: Node) -> Vec<Leaf> {
    let leaf = |node: Node| match dag.kind(node) {
        Kind::Time => Some(None),
        Kind::Element(array @ Array::Phase { .. }, row, _) => {
            let row = row.modulo.is_none().then(|| row.affine.as_constant());
            Some(Some((*array, row.flatten())))
        }
        _ => None,
    };
    dag.reachable(&[node])
        .into_iter()
        .filter_map(leaf)
        .collect()
}

/// A line through phase space and time.
struct Line<'a> {
    model: &'a Model,
    how: Sample,
    /// What moves, where it starts, and how fast it goes.
    leaves: Vec<(Node, f64, f64)>,
}

impl Line<'_> {
    /// The line of a number, along which everything moves that the expression reads.
    fn new(model: &Model, root: Node, number: u64, signs: Signs) -> Line<'_> {
        let mut bits = Scramble(number);
        let is_moving = |node: &Node| {
            let kind = model.dag.kind(*node);
            matches!(kind, Kind::Element(Array::Phase { .. }, ..) | Kind::Time)
        };
        let nodes = model.dag.reachable(&[root]);
        let leaves = nodes.into_iter().filter(is_moving);
        let leaves = leaves.map(|leaf| (leaf, bits.signed(), bits.signed()));
        Line {
            model,
            how: Sample {
                seed: number,
                signs,
                ..Sample::default()
            },
            leaves: leaves.collect(),
        }
    }

    /// The same line with what a node reads alone.
    fn of(&self, node: Node) -> Line<'_> {
        let nodes = self.model.dag.reachable(&[node]);
        let leaves = self.leaves.iter().copied();
        Line {
            model: self.model,
            how: self.how,
            leaves: leaves.filter(|(leaf, ..)| nodes.contains(leaf)).collect(),
        }
    }

    /// The value of a node and a bound of its error.
    fn value(&self, node: Node, at: f64) -> Sampled {
        let given: Vec<(Node, f64)> = self
            .leaves
            .iter()
            .map(|(leaf, start, slope)| (*leaf, start + at * slope))
            .collect();
        let nothing = Sampled {
            value: f64::NAN,
            error: f64::NAN,
        };
        sample(self.model, &[node], &[], self.how, &given).map_or(nothing, |(values, _)| values[0])
    }

    /// Points at which a node is 0: where it changes sign, and where it touches 0.
    fn zeros(&self, node: Node) -> Vec<f64> {
        let line = self.of(node);
        let value = |at: f64| line.value(node, at).value;
        // Near by and far away, in both directions.
        let out: Vec<f64> = std::iter::successors(Some(0.11), |at| Some(1.6 * at))
            .take(28)
            .collect();
        let back = out.iter().rev().map(|at| -at);
        let grid: Vec<(f64, f64)> = back
            .chain(out.iter().copied())
            .map(|at| (at, value(at)))
            .collect();
        let mut zeros = Vec::new();
        for around in grid.windows(3) {
            let [a, b, c] = [around[0], around[1], around[2]];
            if a.1 * b.1 < 0.0 {
                zeros.push(changing(value, a, b));
            } else if a.1 * b.1 > 0.0 && b.1 * c.1 > 0.0 && b.1.abs() < a.1.abs().min(c.1.abs()) {
                let (at, least) = least(|at| value(at).abs(), a.0, c.0);
                if least <= 1e-12 * b.1.abs() {
                    zeros.push(at);
                }
            }
        }
        // The nearest first.
        zeros.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        zeros.truncate(CROSSINGS);
        zeros
    }

    /// Whether limits from both sides of a point are there and differ.
    fn jumps(&self, node: Node, at: f64) -> bool {
        let differences = STEPS.map(|step| {
            let step = step * (1.0 + at.abs());
            let (above, below) = (self.value(node, at + step), self.value(node, at - step));
            let difference = above.value - below.value;
            let is_certain = difference.abs() > 16.0 * (above.error + below.error);
            if is_certain { difference } else { f64::NAN }
        });
        let [first, before, last] = differences;
        // What is continuous differs less and less, what has no limit more and more. A NaN is not
        // near anything.
        let converges = |a: f64, b: f64, share: f64| (a - b).abs() <= share * b.abs();
        converges(first, before, 0.5) && converges(before, last, 0.05)
    }
}

/// Where a function changes sign, by bisection.
fn changing(f: impl Fn(f64) -> f64, (mut a, at_a): (f64, f64), (mut b, _): (f64, f64)) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if f(middle) * at_a > 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

/// Where a function is least, and how much it is there, by golden section.
fn least(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> (f64, f64) {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    for _ in 0..60 {
        let (left, right) = (b - SHARE * (b - a), a + SHARE * (b - a));
        if f(left) < f(right) {
            b = right;
        } else {
            a = left;
        }
    }
    let at = 0.5 * (a + b);
    (at, f(at))
}

/// Pseudo-random numbers (SplitMix64: Steele, Lea & Flood 2014).
struct Scramble(u64);

impl Scramble {
    /// Of a size between 1/4 and 5/4, of either sign.
    fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        let size = 0.25 + (bits >> 11) as f64 / (1u64 << 53) as f64;
        if bits & 1 == 1 { -size } else { size }
    }
}
