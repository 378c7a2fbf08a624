//! Regularity of expressions: one pass over the arena that proofs read.
//!
//! Input: roots. Output: for each node below them its regularity as a function of what moves
//! (coordinates, momenta, time), for all parameters and sizes. Functions say their part in the
//! operation table; signs are facts of the arena itself ([`Dag::is_nonnegative`]).
//!
//! All statements are about points outside sets of two dimensions less than the whole, such as
//! r = 0 in space: they separate nothing, and what is constant along the trajectories that miss
//! them is so, by continuity, along the others.
//!
//! Invariant: a flag is set only by a rule that holds at all such points.

use crate::dag::{Array, Dag, Dependence, Kind, Map, Node};
use crate::index::{Affine, Domain, Index};
use crate::model::Model;
use crate::op::{At, Break, Domain as Values, Far, Op, Range};
use crate::print;

/// The regularity of a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Regular {
    /// Analytic, with a value at every point.
    pub is_analytic: bool,
    /// Continuous, with a value at every point.
    pub is_continuous: bool,
    /// A quotient of analytic functions.
    pub is_meromorphic: bool,
    /// Analytic and of one value at every complex point near a real one, but for a set that
    /// separates nothing: exp(1/q) is, ln q and |q| are not.
    pub is_single_valued: bool,
    /// Continuous into the line that one point ∞ closes: 1/|q| is, |q|/q is not.
    pub is_projective: bool,
    /// Never 0, and not near 0 either; or 0 everywhere.
    pub is_nonzero: bool,
}

impl Regular {
    /// An expression that does not move.
    const STILL: Regular = Regular {
        is_analytic: true,
        is_continuous: true,
        is_meromorphic: true,
        is_single_valued: true,
        is_projective: true,
        is_nonzero: true,
    };
    /// A coordinate.
    const PLAIN: Regular = Regular {
        is_nonzero: false,
        ..Regular::STILL
    };
    /// Nothing is known.
    const UNKNOWN: Regular = Regular {
        is_analytic: false,
        is_continuous: false,
        is_meromorphic: false,
        is_single_valued: false,
        is_projective: false,
        is_nonzero: false,
    };

    /// The properties that both have.
    #[must_use]
    pub fn and(self, other: Regular) -> Regular {
        Regular {
            is_analytic: self.is_analytic && other.is_analytic,
            is_continuous: self.is_continuous && other.is_continuous,
            is_meromorphic: self.is_meromorphic && other.is_meromorphic,
            is_single_valued: self.is_single_valued && other.is_single_valued,
            is_projective: self.is_projective && other.is_projective,
            is_nonzero: self.is_nonzero && other.is_nonzero,
        }
    }

    /// The flags with those that follow from them.
    fn closed(mut self) -> Regular {
        self.is_continuous |= self.is_analytic;
        self.is_meromorphic |= self.is_analytic;
        self.is_single_valued |= self.is_meromorphic;
        self.is_projective |= self.is_continuous || self.is_meromorphic;
        self
    }

    /// The reciprocal.
    fn recip(self) -> Regular {
        Regular {
            is_analytic: self.is_analytic && self.is_nonzero,
            is_continuous: self.is_projective && self.is_nonzero,
            is_nonzero: self.is_continuous,
            ..self
        }
        .closed()
    }
}

/// A set that may be met: where a node, or two, are as [`At`] says.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Locus {
    /// The condition on the nodes.
    pub at: At,
    /// The argument.
    pub x: Node,
    /// The second argument, or the first again.
    pub y: Node,
    /// Whether something jumps there by itself, rather than grow beyond all bounds.
    pub jumps: bool,
}

/// Conditions whose branches agree where they switch.
pub type Meeting = Map<Node, ()>;

/// The regularity of the nodes below some roots.
#[derive(Debug)]
pub struct Facts {
    of: Map<Node, Regular>,
    /// The sets where something has a pole or jumps, in order of first use.
    pub loci: Vec<Locus>,
}

impl Facts {
    /// The pass.
    #[must_use]
    pub fn of(dag: &Dag, roots: &[Node], meeting: &Meeting) -> Facts {
        let mut facts = Facts {
            of: Map::default(),
            loci: Vec::new(),
        };
        for node in dag.reachable(roots) {
            let regular = if dag.dependence(node).on(Dependence::MOVING) {
                facts.moving(dag, node, meeting).closed()
            } else {
                Regular::STILL
            };
            facts.of.insert(node, regular);
        }
        facts
    }

    /// The regularity of a node.
    #[must_use]
    pub fn get(&self, node: Node) -> Regular {
        self.of.get(&node).copied().unwrap_or(Regular::UNKNOWN)
    }

    fn moving(&mut self, dag: &Dag, node: Node, meeting: &Meeting) -> Regular {
        match dag.kind(node) {
            Kind::Element(..) | Kind::Time => Regular::PLAIN,
            Kind::Sum(..) => self.sum(dag, node),
            Kind::Product(_, factors) => self.product(dag, factors),
            Kind::Call(op, x) => self.call(dag, *op, x),
            Kind::External(_, _, x) => {
                // Functions in Rust are taken for analytic.
                let all = x
                    .iter()
                    .fold(Regular::STILL, |all, x| all.and(self.get(*x)));
                Regular {
                    is_analytic: all.is_analytic,
                    is_continuous: all.is_continuous,
                    ..Regular::UNKNOWN
                }
            }
            Kind::Reduce(_, body) => {
                let body_is = self.get(*body);
                let is_apart = || {
                    let place = self.meeting_place(dag, *body);
                    place.is_some_and(|place| is_pair(dag, place))
                };
                Regular {
                    is_projective: body_is.is_projective
                        && (dag.is_nonnegative(*body) || is_apart()),
                    is_nonzero: body_is.is_nonzero && dag.is_nonnegative(*body),
                    ..body_is
                }
            }
            Kind::Select(condition, yes, no) => {
                let both = self.get(*yes).and(self.get(*no));
                if !dag.dependence(*condition).on(Dependence::MOVING) {
                    return both;
                }
                if !(meeting.contains_key(&node) && both.is_continuous) {
                    self.switches(dag, *condition);
                    return Regular::UNKNOWN;
                }
                Regular {
                    is_continuous: true,
                    is_nonzero: both.is_nonzero,
                    ..Regular::UNKNOWN
                }
            }
            _ => Regular::UNKNOWN,
        }
    }

    /// The places where a condition switches.
    fn switches(&mut self, dag: &Dag, condition: Node) {
        for node in dag.reachable(&[condition]) {
            if let Kind::Compare(_, a, b) = dag.kind(node) {
                self.note(dag, At::Equal, *a, *b, true);
            }
        }
    }

    fn note(&mut self, dag: &Dag, at: At, x: Node, y: Node, jumps: bool) {
        let is_moving = |n: Node| dag.dependence(n).on(Dependence::MOVING);
        let locus = Locus { at, x, y, jumps };
        if (is_moving(x) || is_moving(y)) && !self.loci.contains(&locus) {
            self.loci.push(locus);
        }
    }

    fn sum(&self, dag: &Dag, node: Node) -> Regular {
        let Kind::Sum(c, terms) = dag.kind(node) else {
            return Regular::UNKNOWN;
        };
        let each = || terms.iter().map(|(_, term)| self.get(*term));
        let all = each().fold(Regular::STILL, Regular::and);
        // Finite terms and quotients add up; of other infinities there may be one, or any number of
        // the same sign.
        let infinite: Vec<usize> = (0..terms.len())
            .filter(|at| !self.get(terms[*at].1).is_continuous)
            .collect();
        let positive = infinite.iter().all(|at| {
            let (k, term) = &terms[*at];
            !k.is_negative() && dag.is_nonnegative(*term)
        });
        let negative = infinite.iter().all(|at| {
            let (k, term) = &terms[*at];
            k.is_negative() && dag.is_nonnegative(*term)
        });
        let places = || {
            infinite
                .iter()
                .map(|at| self.meeting_place(dag, terms[*at].1))
        };
        let places: Option<Vec<(Node, Node)>> = places().collect();
        let has_pair_twice = |places: Vec<(Node, Node)>| {
            let mut sorted = places.clone();
            sorted.sort_unstable();
            sorted.dedup();
            // At the variables of loops, two terms may mean the same pair.
            let is_fixed = |n: &Node| dag.variables(*n) == 0;
            sorted.len() < places.len() || !sorted.iter().all(|(a, b)| is_fixed(a) && is_fixed(b))
        };
        let are_apart = || {
            infinite.iter().enumerate().all(|(n, a)| {
                let mut rest = infinite[n + 1..].iter();
                rest.all(|b| have_nothing_in_common(dag, terms[*a].1, terms[*b].1))
            })
        };
        let are_apart = || are_apart() || places.is_some_and(|places| !has_pair_twice(places));
        let is_projective =
            all.is_projective && (infinite.len() <= 1 || positive || negative || are_apart());
        let nodes: Vec<Node> = terms.iter().map(|(_, term)| *term).collect();
        let is_nonzero =
            dag.is_nonnegative(node) && (!c.is_zero() || self.are_nonzero_together(dag, &nodes));
        Regular {
            is_projective,
            is_nonzero,
            ..all
        }
    }

    /// Whether the common zeros of some expressions are nothing, or a set that separates nothing:
    /// of one of them, or of two that have no coordinate, momentum or time in common.
    fn are_nonzero_together(&self, dag: &Dag, nodes: &[Node]) -> bool {
        let is_moving = |node: &Node| dag.dependence(*node).on(Dependence::MOVING);
        // A parameter may be 0: it is no bound of a sum.
        let mut bounds = nodes.iter().filter(|node| self.get(**node).is_nonzero);
        bounds.any(is_moving)
            || nodes.iter().enumerate().any(|(at, one)| {
                let mut others = nodes[at + 1..].iter().filter(|n| varies(dag, **n));
                varies(dag, *one) && others.any(|other| have_nothing_in_common(dag, *one, *other))
            })
    }

    fn product(&mut self, dag: &Dag, factors: &[(Node, i32)]) -> Regular {
        let mut each: Vec<(Node, Regular)> = Vec::with_capacity(factors.len());
        for &(base, n) in factors {
            let regular = self.get(base);
            if n < 0 && !regular.is_nonzero {
                self.note(dag, At::Zero, base, base, false);
            }
            each.push((base, if n < 0 { regular.recip() } else { regular }));
        }
        let all = each.iter().fold(Regular::STILL, |all, (_, f)| all.and(*f));
        // 0·∞ is decided among quotients only.
        let is_clear = |(a, f): &(Node, Regular), (b, g): &(Node, Regular)| {
            f.is_continuous
                || g.is_nonzero
                || f.is_meromorphic && g.is_meromorphic
                || have_nothing_in_common(dag, *a, *b)
        };
        let is_clear = (0..each.len())
            .all(|a| (0..each.len()).all(|b| a == b || is_clear(&each[a], &each[b])));
        Regular {
            is_projective: all.is_projective && is_clear,
            ..all
        }
    }

    fn call(&mut self, dag: &Dag, op: Op, x: &[Node]) -> Regular {
        let regularity = op.row().regularity;
        let all = x
            .iter()
            .fold(Regular::STILL, |all, x| all.and(self.get(*x)));
        let (first, y) = (self.get(x[0]), *x.last().unwrap_or(&x[0]));
        let misses = |at: At| match at {
            At::Zero => first.is_nonzero,
            At::MinusOne => dag.is_nonnegative(x[0]),
            At::Origin => self.are_nonzero_together(dag, x),
            At::Equal | At::One | At::Units | At::Cosine | At::Cut => false,
        };
        let jump = match regularity.breaks {
            Break::Jump(at) if !misses(at) => Some(at),
            _ => None,
        };
        let pole = regularity.pole.filter(|at| !misses(*at));
        let is_smooth = match regularity.breaks {
            Break::Nowhere => true,
            Break::Kink(at) | Break::Jump(at) => misses(at),
        };
        // An argument of one sign comes to one end.
        let is_closed = match regularity.far {
            Far::Infinite => true,
            Far::Limits | Far::Mixed => dag.is_nonnegative(x[0]),
            Far::Nothing => false,
        };
        // Of x^y the base may be infinite, the exponent not.
        let is_bounded = op != Op::Pow || self.get(y).is_continuous;
        let is_nonzero = match op {
            Op::Sqrt | Op::Abs | Op::Cbrt => first.is_nonzero,
            Op::Hypot => self.are_nonzero_together(dag, x),
            _ => regularity.range == Range::Positive && (all.is_continuous || op == Op::Cosh),
        };
        if let Some(at) = jump {
            self.note(dag, at, x[0], y, true);
            return Regular::UNKNOWN;
        }
        if let Some(at) = pole {
            self.note(dag, at, x[0], y, false);
        }
        let is_finite = pole.is_none()
            && (all.is_continuous
                || all.is_projective && is_closed && regularity.far == Far::Limits);
        Regular {
            is_analytic: all.is_analytic && is_smooth && pole.is_none(),
            is_continuous: is_finite,
            is_meromorphic: all.is_analytic && regularity.is_entire,
            is_single_valued: all.is_single_valued && regularity.is_entire,
            is_projective: all.is_projective && is_bounded && (all.is_continuous || is_closed),
            is_nonzero,
        }
    }

    /// The two leaves at whose one meeting place a node is infinite: of 1/|q[i] − q[j]| and its
    /// powers, ln|q[i] − q[j]|, and multiples of them by what does not move.
    fn meeting_place(&self, dag: &Dag, node: Node) -> Option<(Node, Node)> {
        let mut found = None;
        let single = [(node, 1)];
        let factors = match dag.kind(node) {
            Kind::Product(_, factors) => factors.as_slice(),
            _ => &single,
        };
        for &(factor, n) in factors {
            if !dag.dependence(factor).on(Dependence::MOVING) {
                continue;
            }
            let place = match dag.kind(factor) {
                Kind::Call(Op::Ln, x) if n == 1 => difference(dag, x[0]),
                Kind::Reduce(_, body) if n == 1 => self.meeting_place(dag, *body),
                _ if n < 0 => difference(dag, factor),
                _ => None,
            }?;
            if found.is_some_and(|other| other != place) {
                return None;
            }
            found = Some(place);
        }
        found
    }
}

/// The leaves of which a node is the difference, up to a number, an absolute value and a root.
fn difference(dag: &Dag, mut node: Node) -> Option<(Node, Node)> {
    while let Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) = dag.kind(node) {
        node = x[0];
    }
    let Kind::Sum(c, terms) = dag.kind(node) else {
        return None;
    };
    let is_leaf = |n: Node| matches!(dag.kind(n), Kind::Element(Array::Phase(_), ..));
    match terms.as_slice() {
        [(k, a), (l, b)] if c.is_zero() && *k == l.neg() && is_leaf(*a) && is_leaf(*b) => {
            Some((*a.min(b), *a.max(b)))
        }
        _ => None,
    }
}

/// Whether two leaves are elements of one array at the variables of two loops, one of which stays
/// below the other: no two iterations have the same pair.
fn is_pair(dag: &Dag, (a, b): (Node, Node)) -> bool {
    let variable = |leaf: Node| match dag.kind(leaf) {
        Kind::Element(array, row, None) => match row.affine.loops.as_slice() {
            [(domain, 1)] if *row == Index::plain(Affine::variable(*domain)) => {
                Some((*array, *domain))
            }
            _ => None,
        },
        _ => None,
    };
    let (Some((one, i)), Some((other, j))) = (variable(a), variable(b)) else {
        return false;
    };
    let is_below = |inner: Domain, outer: Domain| dag.range(inner).end == Affine::variable(outer);
    one == other && (is_below(i, j) || is_below(j, i))
}

/// Whether a node varies with what moves, whatever the parameters: its zeros are not everything,
/// but in iterations of loops in which two leaves are the same one and it is 0.
fn varies(dag: &Dag, node: Node) -> bool {
    let is_leaf = |n: Node| matches!(dag.kind(n), Kind::Element(Array::Phase(_), ..) | Kind::Time);
    match dag.kind(node) {
        Kind::Product(_, factors) => factors.iter().all(|(factor, n)| {
            varies(dag, *factor) || *n < 0 && !dag.dependence(*factor).on(Dependence::MOVING)
        }),
        Kind::Call(op, x) => op.row().arguments.len() == 1 && varies(dag, x[0]),
        // A leaf that one term reads alone.
        Kind::Sum(_, terms) => terms.iter().enumerate().any(|(at, (_, term))| {
            let leaves = || dag.reachable(&[*term]).into_iter().filter(|n| is_leaf(*n));
            let mut others = terms.iter().enumerate().filter(|(other, _)| *other != at);
            varies(dag, *term)
                && others.all(|(_, (_, other))| {
                    let nodes = dag.reachable(&[*other]);
                    leaves().all(|leaf| nodes.binary_search(&leaf).is_err())
                })
        }),
        _ => is_leaf(node),
    }
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

/// Whether no coordinate or momentum, and not the time, is read by both: their zeros and poles meet
/// in sets that separate nothing.
fn have_nothing_in_common(dag: &Dag, a: Node, b: Node) -> bool {
    let others = moving(dag, b);
    !moving(dag, a)
        .iter()
        .any(|a| others.iter().any(|b| may_be_same(*a, *b)))
}

/// The coordinates, momenta and time in a node.
fn moving(dag: &Dag, node: Node) -> Vec<Leaf> {
    let leaf = |node: Node| match dag.kind(node) {
        Kind::Time => Some(None),
        Kind::Element(array @ Array::Phase(_), row, _) => {
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

/// The conditions under which expressions have values, as text: "`q - a` is not 0".
#[must_use]
pub fn conditions(model: &Model, roots: &[Node]) -> Vec<String> {
    let dag = &model.dag;
    let facts = Facts::of(dag, roots, &Meeting::default());
    let mut found: Vec<String> = Vec::new();
    let mut note = |x: Node, is: &str| {
        let condition = format!("`{}` {is}", print::text(model, x));
        if dag.dependence(x).on(Dependence::MOVING) && !found.contains(&condition) {
            found.push(condition);
        }
    };
    for node in dag.reachable(roots) {
        match dag.kind(node) {
            Kind::Product(_, factors) => {
                let below = factors.iter().filter(|(_, n)| *n < 0);
                below
                    .filter(|(base, _)| !facts.get(*base).is_nonzero)
                    .for_each(|(base, _)| note(*base, "is not 0"));
            }
            Kind::Call(op, x) => {
                let regularity = op.row().regularity;
                match regularity.domain {
                    Values::From(least) if !(least <= 0 && dag.is_nonnegative(x[0])) => {
                        let is = if regularity.pole.is_some() {
                            ">"
                        } else {
                            "≥"
                        };
                        note(x[0], &format!("{is} {least}"));
                    }
                    Values::Units => note(x[0], "is between -1 and 1"),
                    Values::Power if !dag.is_nonnegative(x[0]) => match dag.as_constant(x[1]) {
                        Some(_) => note(x[0], "≥ 0"),
                        None => {
                            let exponent = print::text(model, x[1]);
                            note(x[0], &format!("≥ 0, or `{exponent}` is whole"));
                        }
                    },
                    _ => {}
                }
                if regularity.pole == Some(At::Cosine) {
                    note(x[0], "is no odd multiple of pi/2");
                }
            }
            _ => {}
        }
    }
    found
}
