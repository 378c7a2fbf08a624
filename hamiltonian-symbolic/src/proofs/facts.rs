//! Regularity of expressions: one pass over the arena that proofs read.
//!
//! Input: roots, and what is known of their orbits ([`Given`]). Output: for each node below them its
//! regularity as a function of what moves (coordinates, momenta, time), for all parameters and sizes.
//! The regularity of functions is in the operation table; signs are properties of nodes
//! ([`Dag::is_nonnegative`]).
//!
//! [`Facts::of`] makes its statements about points outside sets of two dimensions less than the
//! whole, such as r = 0 in space. They separate nothing: under a flow that is continuous with its
//! inverse, almost every trajectory misses them, and what is constant along these is constant along the
//! others by continuity. On a shell, or under a force whose flow is not continuous, this argument
//! fails: [`Facts::everywhere`] makes its statements about every point.
//!
//! Invariant: a flag is set only by a rule that holds at all such points.

mod differences;
mod domain;
mod leaves;
mod lines;
mod products;

pub use domain::conditions;

use crate::dag::{Dag, Dependence, Kind, Map, Node, Sign};
use crate::list::IntoList;
use crate::op::{Break, Far, Op, SingularSet, ValueSign};
use crate::sort::Arrange;
use differences::{difference, is_pair};
pub(crate) use leaves::{have_no_degree_in_common, is_of_own_rows};
use leaves::{have_nothing_in_common, is_moving_leaf, is_solved_beside, varies};
pub(crate) use lines::are_along_other_lines;
use products::is_between;
pub(crate) use products::stem;

/// The number of the function in the place of a sign, smooth and otherwise arbitrary.
///
/// Eight numbers are reserved, and no function of a definition has one of them. The three below this one are functions in
/// the place of comparisons, with values between 0 and 1. They are distinct because signs and comparisons differ at the
/// step itself. The four from [`ROUNDED`] down are in the place of functions that round.
pub(crate) const STEP: u16 = u16::MAX;
/// The highest number of a function in the place of one that rounds.
pub(crate) const ROUNDED: u16 = STEP - 4;

/// The regularity of a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Regular {
    /// True if it has one value along each orbit.
    pub is_still: bool,
    /// Analytic, with a value at every point.
    pub is_analytic: bool,
    /// Continuous, with a value at every point.
    pub is_continuous: bool,
    /// Locally Lipschitz, with a value at every point.
    pub is_lipschitz: bool,
    /// A quotient of analytic functions.
    pub is_meromorphic: bool,
    /// Continuous into the line that one point ∞ closes: 1/|q| is, |q|/q is not.
    pub is_projective: bool,
    /// Never 0, and not near 0 at any point, whatever the parameters.
    pub has_no_zero: bool,
    /// For each choice of the parameters: never 0 as above, or 0 everywhere.
    pub has_no_moving_zero: bool,
}

impl Regular {
    /// An expression that does not move. A parameter may be 0.
    const STILL: Regular = Regular {
        is_still: true,
        is_analytic: true,
        is_continuous: true,
        is_lipschitz: true,
        is_meromorphic: true,
        is_projective: true,
        has_no_zero: false,
        has_no_moving_zero: true,
    };
    /// A coordinate.
    const PLAIN: Regular = Regular {
        is_still: false,
        has_no_moving_zero: false,
        ..Regular::STILL
    };
    /// Nothing is known.
    const UNKNOWN: Regular = Regular {
        is_still: false,
        is_analytic: false,
        is_continuous: false,
        is_lipschitz: false,
        is_meromorphic: false,
        is_projective: false,
        has_no_zero: false,
        has_no_moving_zero: false,
    };
    /// The neutral element of the conjunction of properties over several nodes.
    const ALL: Regular = Regular {
        has_no_zero: true,
        ..Regular::STILL
    };

    /// The properties that both have.
    #[must_use]
    pub fn and(self, other: Regular) -> Regular {
        Regular {
            is_still: self.is_still && other.is_still,
            is_analytic: self.is_analytic && other.is_analytic,
            is_continuous: self.is_continuous && other.is_continuous,
            is_lipschitz: self.is_lipschitz && other.is_lipschitz,
            is_meromorphic: self.is_meromorphic && other.is_meromorphic,
            is_projective: self.is_projective && other.is_projective,
            has_no_zero: self.has_no_zero && other.has_no_zero,
            has_no_moving_zero: self.has_no_moving_zero && other.has_no_moving_zero,
        }
    }

    /// The flags with those that follow from them. A quotient of analytic functions is continuous into
    /// the closed line but for 0/0, a set of two dimensions less.
    fn closed(mut self, points: Points) -> Regular {
        self.is_continuous |= self.is_analytic;
        self.is_lipschitz |= self.is_analytic;
        self.is_meromorphic |= self.is_analytic;
        self.is_projective |= self.is_continuous || self.is_meromorphic && points == Points::Most;
        self.has_no_moving_zero |= self.has_no_zero || self.is_still;
        self
    }

    /// The reciprocal. Where the expression is 0 for some parameters and everywhere, the reciprocal is
    /// nowhere defined, and nothing is stated.
    fn recip(self, points: Points) -> Regular {
        let is_finite = self.has_no_moving_zero;
        Regular {
            is_analytic: self.is_analytic && is_finite,
            is_continuous: self.is_projective && is_finite,
            is_lipschitz: self.is_lipschitz && is_finite,
            has_no_zero: self.is_continuous,
            has_no_moving_zero: self.is_continuous,
            ..self
        }
        .closed(points)
    }
}

/// A set that may be met: where a node, or two, are as [`SingularSet`] says.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Locus {
    /// The condition on the nodes.
    pub at: SingularSet,
    /// The argument.
    pub x: Node,
    /// The second argument, or the first again.
    pub y: Node,
}

/// The points that statements are about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Points {
    /// Every point.
    All,
    /// The points outside sets of two dimensions less than the whole.
    Most,
}

/// Assumptions about nodes.
#[derive(Clone, Default, Debug)]
pub struct Given {
    /// Conditions whose branches agree where the two sides compared are equal.
    pub meeting: Map<Node, ()>,
    /// Expressions that are constant along each orbit.
    pub constant: Map<Node, ()>,
    /// Expressions that are not 0, nor near 0 at any point, wherever orbits come.
    pub nonzero: Map<Node, ()>,
}

/// The regularity of the nodes below some roots.
#[derive(Debug)]
pub struct Facts {
    of: Map<Node, Regular>,
    points: Points,
    /// The sets where something has a pole or jumps, in order of first use.
    pub loci: Vec<Locus>,
}

impl Facts {
    /// The pass, about all points but sets of two dimensions less.
    #[must_use]
    pub fn of(dag: &Dag, roots: &[Node], given: &Given) -> Facts {
        Facts::about(Points::Most, dag, roots, given)
    }

    /// The pass, about every point.
    #[must_use]
    pub fn everywhere(dag: &Dag, roots: &[Node], given: &Given) -> Facts {
        Facts::about(Points::All, dag, roots, given)
    }

    fn about(points: Points, dag: &Dag, roots: &[Node], given: &Given) -> Facts {
        let mut facts = Facts {
            of: Map::default(),
            points,
            loci: Vec::new(),
        };
        for node in dag.reachable(roots) {
            let mut is_still = given.constant.contains_key(&node);
            if !is_still && !is_moving_leaf(dag, node) {
                is_still = true;
                dag.for_children(node, |child| is_still &= facts.get(child).is_still);
            }
            let mut regular = facts.regular(dag, node, given);
            regular.has_no_zero |= regular.is_continuous && is_between(dag, node);
            if is_still {
                regular = Regular {
                    has_no_zero: regular.has_no_zero,
                    ..Regular::STILL
                };
            }
            regular.has_no_zero |= given.nonzero.contains_key(&node);
            facts.of.insert(node, regular.closed(points));
        }
        let Facts { of, loci, .. } = &mut facts;
        let is_still = |node: Node| of.get(&node).is_some_and(|regular| regular.is_still);
        loci.retain(|locus| !(is_still(locus.x) && is_still(locus.y)));
        facts
    }

    /// The regularity of a node.
    #[must_use]
    pub fn get(&self, node: Node) -> Regular {
        self.of.get(&node).copied().unwrap_or(Regular::UNKNOWN)
    }

    fn regular(&mut self, dag: &Dag, node: Node, given: &Given) -> Regular {
        match dag.kind(node) {
            Kind::Constant(value) => Regular {
                has_no_zero: !value.is_zero(),
                ..Regular::STILL
            },
            Kind::Pi => Regular::ALL,
            Kind::Element(..) | Kind::Time => Regular::PLAIN,
            Kind::Sum(..) => self.sum(dag, node),
            Kind::Product(k, factors) => {
                let regular = self.product(dag, factors);
                Regular {
                    has_no_zero: regular.has_no_zero && !k.is_zero(),
                    ..regular
                }
            }
            Kind::Call(op, x) => self.call(dag, *op, x),
            Kind::External(_, _, x) => {
                // Functions in Rust are taken for analytic.
                let all = x.iter().fold(Regular::ALL, |all, x| all.and(self.get(*x)));
                Regular {
                    is_analytic: all.is_analytic,
                    is_continuous: all.is_continuous,
                    is_lipschitz: all.is_lipschitz,
                    ..Regular::UNKNOWN
                }
            }
            Kind::Reduce(_, body) => {
                let body_is = self.get(*body);
                let is_apart = || {
                    let place = self.meeting_place(dag, *body);
                    self.points == Points::Most && place.is_some_and(|place| is_pair(dag, place))
                };
                Regular {
                    is_projective: body_is.is_projective
                        && (body_is.is_continuous || dag.is_nonnegative(*body) || is_apart()),
                    // The range may be empty.
                    has_no_zero: false,
                    has_no_moving_zero: body_is.has_no_moving_zero && dag.is_nonnegative(*body),
                    ..body_is
                }
            }
            Kind::Select(condition, yes, no) => {
                let both = self.get(*yes).and(self.get(*no));
                if self.get(*condition).is_still {
                    return both;
                }
                // Where the branches agree at a = b, and a and b are continuous, a path from a < b to
                // a > b goes through points where they agree. Sides that jump need not be equal anywhere.
                let mut sides = comparisons(dag, *condition).into_iter();
                let sides_are_continuous =
                    sides.all(|(a, b)| self.get(a).and(self.get(b)).is_continuous);
                let is_joined = given.meeting.contains_key(&node) && sides_are_continuous;
                if !(is_joined && both.is_continuous) {
                    self.switches(dag, *condition);
                    return Regular::UNKNOWN;
                }
                Regular {
                    is_continuous: true,
                    is_lipschitz: both.is_lipschitz,
                    has_no_zero: both.has_no_zero,
                    ..Regular::UNKNOWN
                }
            }
            _ => Regular::UNKNOWN,
        }
    }

    /// The places where a condition switches.
    fn switches(&mut self, dag: &Dag, condition: Node) {
        for (a, b) in comparisons(dag, condition) {
            self.note(SingularSet::Equal, a, b);
        }
    }

    fn note(&mut self, at: SingularSet, x: Node, y: Node) {
        let locus = Locus { at, x, y };
        if !self.loci.contains(&locus) {
            self.loci.push(locus);
        }
    }

    fn sum(&self, dag: &Dag, node: Node) -> Regular {
        let Kind::Sum(c, terms) = dag.kind(node) else {
            return Regular::UNKNOWN;
        };
        let each = || terms.iter().map(|(_, term)| self.get(*term));
        let all = each().fold(Regular::ALL, Regular::and);
        // Finite terms and quotients add up; of other infinities there may be one, or any number of
        // the same sign.
        let infinite: Vec<usize> = (0..terms.len())
            .filter(|at| !self.get(terms[*at].1).is_continuous)
            .into_list();
        let sign = |at: &usize| Sign::of(&terms[*at].0).times(dag.sign(terms[*at].1));
        let positive = infinite.iter().all(|at| sign(at).is_nonnegative());
        let negative = infinite.iter().all(|at| sign(at).is_nonpositive());
        let places = || {
            infinite
                .iter()
                .map(|at| self.meeting_place(dag, terms[*at].1))
        };
        let places: Option<Vec<(Node, Node)>> = places().collect();
        let has_pair_twice = |places: Vec<(Node, Node)>| {
            let mut sorted = places.clone();
            sorted.arrange();
            sorted.dedup();
            // At the variables of loops, two terms may mean the same pair.
            let is_fixed = |n: &Node| dag.variables(*n).is_empty();
            sorted.len() < places.len() || !sorted.iter().all(|(a, b)| is_fixed(a) && is_fixed(b))
        };
        let are_apart = || {
            infinite.iter().enumerate().all(|(n, a)| {
                let mut rest = infinite[n + 1..].iter();
                rest.all(|b| self.meet_rarely(dag, terms[*a].1, terms[*b].1))
            })
        };
        let are_apart = || {
            self.points == Points::Most
                && (are_apart() || places.is_some_and(|places| !has_pair_twice(places)))
        };
        let is_projective =
            all.is_projective && (infinite.len() <= 1 || positive || negative || are_apart());
        let nodes: Vec<Node> = terms.iter().map(|(_, term)| *term).into_list();
        let is_projective = is_projective || self.is_quotient_in_one(dag, nodes.iter().copied());
        let is_nonnegative = dag.is_nonnegative(node);
        // Terms ≥ 0 are 0 together only; those that are 0 for some parameters are so everywhere.
        let has_still_zeros = each().all(|term| term.has_no_moving_zero);
        Regular {
            is_projective,
            has_no_zero: is_nonnegative && (!c.is_zero() || self.have_no_common_zero(dag, &nodes)),
            has_no_moving_zero: is_nonnegative && has_still_zeros,
            ..all
        }
    }

    /// Returns true if the common zeros of some expressions are nothing, or a set of two dimensions less
    /// where such sets do not count: of two that have no coordinate, momentum or time in common.
    fn have_no_common_zero(&self, dag: &Dag, nodes: &[Node]) -> bool {
        nodes.iter().any(|node| self.get(*node).has_no_zero)
            || nodes.iter().enumerate().any(|(at, one)| {
                let mut others = nodes[at + 1..].iter().filter(|n| varies(dag, **n));
                varies(dag, *one)
                    && others.any(|other| {
                        self.meet_rarely(dag, *one, *other)
                            || self.points == Points::Most
                                && (is_solved_beside(dag, *one, *other)
                                    || is_solved_beside(dag, *other, *one))
                    })
            })
    }

    /// Returns true if the zeros and poles of two expressions meet in sets that do not count.
    fn meet_rarely(&self, dag: &Dag, a: Node, b: Node) -> bool {
        self.points == Points::Most && have_nothing_in_common(dag, a, b)
    }

    fn call(&mut self, dag: &Dag, op: Op, x: &[Node]) -> Regular {
        let regularity = op.row().regularity;
        let all = x.iter().fold(Regular::ALL, |all, x| all.and(self.get(*x)));
        let (first, y) = (self.get(x[0]), *x.last().unwrap_or(&x[0]));
        let misses = |at: SingularSet| match at {
            SingularSet::Zero => first.has_no_moving_zero,
            SingularSet::MinusOne => dag.is_nonnegative(x[0]),
            SingularSet::Origin => self.have_no_common_zero(dag, x),
            // y = 0, x ≤ 0
            SingularSet::Cut => first.has_no_zero && first.is_continuous,
            SingularSet::Equal
            | SingularSet::One
            | SingularSet::PlusMinusOne
            | SingularSet::Cosine
            | SingularSet::Whole
            | SingularSet::HalfWhole
            | SingularSet::Multiple
            | SingularSet::HalfMultiple => false,
        };
        let jump = match regularity.breaks {
            Break::Jump(at) if !misses(at) => Some(at),
            _ => None,
        };
        // x^y is finite at x = 0 where y is no negative number.
        let is_root = op == Op::Pow && self.get(y).is_still && dag.is_nonnegative(y);
        let pole = regularity.pole.filter(|at| !misses(*at) && !is_root);
        let is_smooth = match regularity.breaks {
            Break::Nowhere => true,
            Break::Kink(at) | Break::Jump(at) => misses(at),
        };
        // An argument of one sign comes to one end, of which e^x has a finite one.
        let is_decaying = matches!(op, Op::Exp | Op::ExpM1) && dag.sign(x[0]).is_nonpositive();
        let is_closed = match regularity.far {
            // The infinity that is chosen is chosen on all sides of it.
            _ if op == Op::Max => self.are_finite_or(x, |x| dag.sign(x).is_nonnegative()),
            _ if op == Op::Min => self.are_finite_or(x, |x| dag.sign(x).is_nonpositive()),
            Far::Infinite => true,
            Far::Limits | Far::Mixed => dag.is_nonnegative(x[0]) || is_decaying,
            Far::Nothing => false,
        };
        let is_limited = is_closed && regularity.far == Far::Limits || is_decaying;
        // In x^y the base may be infinite, the exponent not. Where the base is 0 or infinite and the exponent
        // passes through 0, x^y has no limit.
        let is_away = first.has_no_zero && first.is_continuous;
        let is_one_limit = self.points == Points::Most || self.get(y).is_still || is_away;
        let is_bounded = op != Op::Pow || self.get(y).is_continuous && is_one_limit;
        let has_no_zero = match op {
            Op::Sqrt | Op::Abs | Op::Cbrt => first.has_no_zero,
            Op::Hypot => x.iter().any(|x| self.get(*x).has_no_zero) || misses(SingularSet::Origin),
            // x^y, of finite x and y
            Op::Pow => first.has_no_zero && all.is_continuous,
            Op::Cosh => true,
            _ => regularity.range == ValueSign::Positive && all.is_continuous,
        };
        let has_no_moving_zero =
            matches!(op, Op::Sqrt | Op::Abs | Op::Cbrt) && first.has_no_moving_zero;
        if let Some(at) = jump {
            self.note(at, x[0], y);
            return Regular::UNKNOWN;
        }
        if let Some(at) = pole {
            self.note(at, x[0], y);
        }
        let is_finite = pole.is_none() && (all.is_continuous || all.is_projective && is_limited);
        let is_gentle = is_smooth
            || matches!(op, Op::Abs | Op::Min | Op::Max | Op::Hypot)
            || op == Op::Sqrt && self.is_norm(dag, x[0]);
        Regular {
            is_still: false,
            is_analytic: all.is_analytic && is_smooth && pole.is_none(),
            is_continuous: is_finite,
            is_lipschitz: all.is_lipschitz && is_gentle && pole.is_none(),
            // With w = ∛q in the place of a coordinate q = w³, ∛q is analytic, and so is what was.
            is_meromorphic: all.is_analytic && regularity.is_entire
                || op == Op::Cbrt && is_moving_leaf(dag, x[0]),
            is_projective: all.is_projective && is_bounded && (all.is_continuous || is_closed),
            has_no_zero,
            has_no_moving_zero,
        }
    }

    fn are_finite_or(&self, nodes: &[Node], is: impl Fn(Node) -> bool) -> bool {
        let mut nodes = nodes.iter();
        nodes.all(|node| self.get(*node).is_continuous || is(*node))
    }

    /// Returns true if the root of an expression is a norm: of a sum of squares of what is Lipschitz.
    fn is_norm(&self, dag: &Dag, square: Node) -> bool {
        let is_square = |node: Node| match dag.kind(node) {
            Kind::Product(k, factors) => {
                let gentle =
                    |(f, n): &(Node, i32)| n % 2 == 0 && *n > 0 && self.get(*f).is_lipschitz;
                !k.is_negative() && factors.iter().all(gentle)
            }
            _ => false,
        };
        match dag.kind(square) {
            Kind::Sum(c, terms) => {
                let mut terms = terms.iter();
                !c.is_negative() && terms.all(|(k, term)| !k.is_negative() && is_square(*term))
            }
            Kind::Reduce(_, body) => self.is_norm(dag, *body),
            _ => is_square(square),
        }
    }

    /// The two coordinates whose difference is 0 at the pole of a node: of 1/|q[i] − q[j]| and its
    /// powers, ln|q[i] − q[j]|, and multiples of them by continuous factors.
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
                _ if n > 0 && self.get(factor).is_continuous => continue,
                Kind::Sum(_, terms) if n == 1 => {
                    let infinite = terms
                        .iter()
                        .filter(|(_, term)| !self.get(*term).is_continuous);
                    let mut places = infinite.map(|(_, term)| self.meeting_place(dag, *term));
                    let first = places.next().flatten();
                    first.filter(|_| places.all(|place| place == first))
                }
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

/// The sides of the comparisons that a condition is made of.
pub(crate) fn comparisons(dag: &Dag, condition: Node) -> Vec<(Node, Node)> {
    let nodes = dag.reached(&[condition], &mut |node, ahead| {
        if matches!(dag.kind(node), Kind::And(..) | Kind::Or(..) | Kind::Not(_)) {
            dag.for_children(node, |child| ahead.add(child));
        }
    });
    let sides = nodes.into_iter().filter_map(|node| match dag.kind(node) {
        Kind::Compare(_, a, b) => Some((*a, *b)),
        _ => None,
    });
    sides.into_list()
}
