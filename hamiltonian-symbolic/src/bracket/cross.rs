//! Whether what is constant on both sides of a pole or a jump is so across it.
//!
//! Input: a model, an expression whose derivative along the flow of H vanishes wherever both are
//! smooth. Output: the part of either that stands in the way, and why. These pass:
//!
//! - an expression that is continuous, into the line closed by one infinity: its limits on a
//!   trajectory are those of the constants on both sides, and where H tends to infinity no trajectory
//!   comes;
//! - a quotient of analytic functions, or another expression of one value in complex numbers, with
//!   an H of the same kind: it is continued around the place through complex times;
//! - place by place (x = x₀ ± u, u > 0, resolves |u|), an expression that is the same function on
//!   both sides or comes to the same value, and a place that orbits do not reach, as the expression
//!   or H tends to infinity on one side at least.
//!
//! Invariant: no rule here looks at points.

use crate::dag::{self, Column, Dag, Dependence, Kind, Node};
use crate::diff;
use crate::facts::{Facts, Locus, Meeting, Regular};
use crate::index::Index;
use crate::loops::unrolled;
use crate::model::Model;
use crate::normal_form::{self, Algebra, Poly, SMALL_BUDGET, Scope, Undecided};
use crate::op::{At, Op, Range};
use crate::print;
use crate::rational::Rational;

/// The most places that are looked at one by one.
const MOST_PLACES: usize = 64;

/// An obstacle to a proof.
pub(super) struct Obstacle {
    /// The part that may jump, as text.
    pub(super) part: String,
    /// The rule that is missing, or the limit that was met.
    pub(super) why: String,
}

/// The first obstacle for an expression whose derivative along the flow of `h` vanishes.
pub(super) fn find(model: &Model, expression: Node, h: Node) -> Option<Obstacle> {
    let mut model = model.clone();
    let facts = facts(&mut model, &[expression, h]);
    let first = Claim::new(&model, &facts, expression, h);
    if first.passes(first.expression.into(), first.h.into()) {
        return None;
    }
    let part = culprit(&model.dag, &facts, &[expression, h]);
    let part = part.map_or_else(|| "H".to_owned(), |part| print::text(&model, part));
    first
        .place_by_place(&mut model)
        .err()
        .map(|why| Obstacle { part, why })
}

/// An expression and H, with what is known of them everywhere.
struct Claim {
    roots: [Node; 2],
    expression: Regular,
    h: Regular,
    /// Whether H is conserved: it does not depend on time, and there is no force.
    is_still: bool,
    /// Whether there is a force, which need not be analytic.
    is_forced: bool,
}

impl Claim {
    fn new(model: &Model, facts: &Facts, expression: Node, h: Node) -> Claim {
        let is_forced = !model.force.is_empty();
        Claim {
            roots: [expression, h],
            expression: facts.get(expression),
            h: facts.get(h),
            is_still: !is_forced && !model.dag.dependence(h).on(Dependence::TIME),
            is_forced,
        }
    }

    /// Whether nothing is lost on the way through places of which so much is known.
    fn passes(&self, expression: Ends, h: Ends) -> bool {
        let is_kept = h.is_continuous || h.is_same || h.is_projective && self.is_still;
        is_kept && expression.is_projective
            || expression.is_same && h.is_same && (!self.is_forced || expression.is_quotient)
            || expression.is_quotient && h.is_continuous
    }

    fn place_by_place(mut self, model: &mut Model) -> Result<(), String> {
        for root in &mut self.roots {
            if model.dag.has_loops(&[*root]) {
                if !model.sizes.is_empty() {
                    return Err("sums of a length known at run time are not compared".to_owned());
                }
                *root = unrolled(model, *root)
                    .map_err(|_| "its sums are too long to be unrolled".to_owned())?;
            }
        }
        let facts = facts(model, &self.roots);
        (self.expression, self.h) = (facts.get(self.roots[0]), facts.get(self.roots[1]));
        let mut places: Vec<Place> = Vec::new();
        for locus in &facts.loci {
            let found = Place::of(&mut model.dag, *locus).ok_or(
                "the angle of a point jumps where the point crosses the negative half of an axis",
            )?;
            places.extend(found);
        }
        if places.len() > MOST_PLACES {
            return Err(format!("more than {MOST_PLACES} poles and jumps"));
        }
        let whole = model.clone();
        for place in places {
            // Nodes made for one place are not kept for the next.
            model.clone_from(&whole);
            self.crosses(model, &place)
                .map_err(|why| format!("{why} where `{}` is 0", print::text(model, place.zero)))?;
        }
        Ok(())
    }

    /// Whether nothing is lost through a place, or no trajectory goes there.
    fn crosses(&self, model: &mut Model, place: &Place) -> Result<(), String> {
        let [expression, h] = self.roots;
        let (of_expression, of_h) = (Ends::from(self.expression), Ends::from(self.h));
        if self.passes(of_expression, of_h) {
            return Ok(());
        }
        let u = distance(&mut model.dag);
        let limit =
            |Undecided| "the limit of expansions stops the comparison of both sides".to_owned();
        let of_h = if model.dag.has_loops(&[h]) {
            Ok(of_h)
        } else {
            place.ends(&mut model.dag, h, u)
        };
        if self.is_still && of_h.is_ok_and(|ends| ends.is_infinite) {
            return Ok(());
        }
        let of_expression = if self.passes(of_expression, Ends::ALL) {
            Ok(of_expression)
        } else {
            place.ends(&mut model.dag, expression, u)
        };
        if let (Ok(expression), Ok(h)) = (of_expression, of_h)
            && self.passes(expression, h)
        {
            return Ok(());
        }
        of_expression.and(of_h).map_err(limit)?;
        Err("no rule says that both sides agree".to_owned())
    }
}

/// Whether a node stands in another one.
fn reads(dag: &Dag, root: Node, node: Node) -> bool {
    dag.reachable(&[root]).binary_search(&node).is_ok()
}

/// Properties of the two sides of an expression at a place, or at all places.
#[derive(Clone, Copy)]
struct Ends {
    /// They come to the same finite value.
    is_continuous: bool,
    /// They come to the same value, or one to infinity.
    is_projective: bool,
    /// One of them comes to infinity.
    is_infinite: bool,
    /// They are one function of one value in complex numbers,
    is_same: bool,
    /// and a quotient of analytic functions.
    is_quotient: bool,
}

impl Ends {
    const ALL: Ends = Ends {
        is_continuous: true,
        is_projective: true,
        is_infinite: true,
        is_same: true,
        is_quotient: true,
    };
}

impl From<Regular> for Ends {
    fn from(regular: Regular) -> Ends {
        Ends {
            is_continuous: regular.is_continuous,
            is_projective: regular.is_projective,
            is_infinite: false,
            is_same: regular.is_single_valued,
            is_quotient: regular.is_meromorphic,
        }
    }
}

/// The facts of a node by itself.
fn regular(dag: &Dag, node: Node) -> Regular {
    Facts::of(dag, &[node], &Meeting::default()).get(node)
}

/// The pass over the arena, told of conditions whose branches agree.
fn facts(model: &mut Model, roots: &[Node]) -> Facts {
    let mut meeting = Meeting::default();
    let dag = &mut model.dag;
    for node in dag.reachable(roots) {
        if let Kind::Select(condition, yes, no) = *dag.kind(node)
            && dag.dependence(condition).on(Dependence::MOVING)
            && meets(dag, condition, yes, no)
        {
            meeting.insert(node, ());
        }
    }
    Facts::of(dag, roots, &meeting)
}

/// The first node that is neither continuous nor of one value while all below it are.
fn culprit(dag: &Dag, facts: &Facts, roots: &[Node]) -> Option<Node> {
    roots.iter().find_map(|root| {
        let nodes = dag.reachable(&[*root]);
        nodes.into_iter().find(|node| {
            let regular = facts.get(*node);
            let is_condition = matches!(
                dag.kind(*node),
                Kind::Compare(..) | Kind::And(..) | Kind::Or(..) | Kind::Not(_)
            );
            !is_condition && !regular.is_projective && !regular.is_single_valued
        })
    })
}

/// Whether two branches are known to agree where a comparison of a coordinate, a momentum or the
/// time with something else switches.
fn meets(dag: &mut Dag, condition: Node, yes: Node, no: Node) -> bool {
    let Kind::Compare(_, a, b) = *dag.kind(condition) else {
        return false;
    };
    [(a, b), (b, a)].into_iter().any(|(leaf, value)| {
        let is_leaf = matches!(dag.kind(leaf), Kind::Element(..) | Kind::Time);
        if !is_leaf || reads(dag, value, leaf) {
            return false;
        }
        let difference = dag.sub(yes, no);
        // A variable that a sum binds is not the leaf, though it may have its name.
        let difference = dag.nested(difference, dag.home(leaf));
        let difference = replaced(dag, difference, leaf, value);
        normal_form::vanishes(dag, difference, Scope::Everywhere)
    })
}

fn replaced(dag: &mut Dag, root: Node, node: Node, by: Node) -> Node {
    dag.substitute(root, |_, at| (at == node).then_some(by))
}

/// A place where something has a pole or jumps: the zeros of an expression.
#[derive(Clone, Copy)]
struct Place {
    zero: Node,
    /// The node replaced near the place: a leaf of which the expression is a multiple plus a rest, or
    /// the expression itself.
    what: Node,
    /// ∂zero/∂what
    slope: Node,
    /// Whether something has a value of its own there.
    jumps: bool,
}

impl Place {
    /// The places of a locus; `None` for those that no expression is 0 at.
    fn of(dag: &mut Dag, locus: Locus) -> Option<Vec<Place>> {
        let one = dag.integer(1);
        let zeros = match locus.at {
            At::Zero => vec![locus.x],
            At::One => vec![dag.sub(locus.x, one)],
            At::MinusOne => vec![dag.add(&[locus.x, one])],
            At::Units => vec![dag.sub(locus.x, one), dag.add(&[locus.x, one])],
            At::Equal => vec![dag.sub(locus.x, locus.y)],
            At::Cosine => vec![dag.call(Op::Cos, &[locus.x])],
            At::Origin | At::Cut => return None,
        };
        let mut places = Vec::new();
        for zero in zeros {
            places.extend(
                Place::factors(dag, zero)
                    .into_iter()
                    .map(|zero| Place::at(dag, zero, locus.jumps)),
            );
        }
        Some(places)
    }

    /// The factors whose zeros those of an expression are.
    fn factors(dag: &Dag, zero: Node) -> Vec<Node> {
        let mut found = Vec::new();
        let mut left = vec![zero];
        while let Some(node) = left.pop() {
            if !dag.dependence(node).on(Dependence::MOVING) {
                continue;
            }
            match dag.kind(node) {
                // Roots are 0 where what is below them is.
                Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) => left.push(x[0]),
                Kind::Call(op, _) if op.row().regularity.range == Range::Positive => {}
                Kind::Product(_, factors) => {
                    left.extend(factors.iter().filter(|(_, n)| *n > 0).map(|(f, _)| *f));
                }
                _ => found.push(node),
            }
        }
        found
    }

    fn at(dag: &mut Dag, zero: Node, jumps: bool) -> Place {
        let gradient = diff::gradient(dag, zero, Dependence::MOVING);
        let is_still = |dag: &Dag, node: Node| !dag.dependence(node).on(Dependence::MOVING);
        let linear = gradient.into_iter().find(|(leaf, slope)| {
            is_still(dag, *slope) && !dag.is_zero(*slope) && dag.variables(*leaf) == 0
        });
        let one = dag.integer(1);
        let (what, slope) = linear.unwrap_or((zero, one));
        Place {
            zero,
            what,
            slope,
            jumps,
        }
    }

    /// The expression near the place, on the side where its zero is `by`.
    fn near(&self, dag: &mut Dag, root: Node, by: Node) -> Node {
        let image = if self.what == self.zero {
            by
        } else {
            let nothing = dag.integer(0);
            let rest = replaced(dag, self.zero, self.what, nothing);
            let distance = dag.sub(by, rest);
            dag.div(distance, self.slope)
        };
        replaced(dag, root, self.what, image)
    }

    /// The properties of the two sides of an expression, each in its normal form over u > 0.
    fn ends(&self, dag: &mut Dag, root: Node, u: Node) -> Result<Ends, Undecided> {
        let minus = dag.neg(u);
        let above = self.near(dag, root, u);
        let above = Side::of(dag, above, u)?;
        let below = self.near(dag, root, minus);
        let below = Side::of(dag, below, u)?;
        let both = above.regular.and(below.regular);
        // One function, read at u < 0.
        let mirrored = replaced(dag, below.node, u, minus);
        let difference = dag.sub(above.node, mirrored);
        let vanishes = |dag: &mut Dag, node: Node| normal_form::vanishes(dag, node, Scope::Densely);
        // On that side no trajectory comes near.
        let is_infinite = above.is_infinite || below.is_infinite;
        // The value of its own that a jump may have. Where the limits may not be finite, at another
        // place that may be this one, they are not compared.
        let nothing = dag.integer(0);
        let is_joined = !self.jumps
            || is_infinite
            || both.is_continuous && {
                let limit = replaced(dag, above.node, u, nothing);
                let own = self.near(dag, root, nothing);
                let apart = dag.sub(own, limit);
                vanishes(dag, apart)
            };
        let is_same = is_joined && both.is_single_valued && vanishes(dag, difference);
        let is_continuous = is_joined && both.is_continuous && {
            let there = replaced(dag, difference, u, nothing);
            vanishes(dag, there)
        };
        Ok(Ends {
            is_continuous,
            is_projective: is_continuous || is_infinite || is_same && both.is_meromorphic,
            is_infinite,
            is_same,
            is_quotient: is_same && both.is_meromorphic,
        })
    }
}

/// A leaf that nothing else reads.
fn distance(arena: &mut Dag) -> Node {
    arena.phase(Column::first(dag::Side::Q, u16::MAX), Index::constant(0))
}

/// One side of an expression.
struct Side {
    node: Node,
    regular: Regular,
    is_infinite: bool,
}

impl Side {
    fn of(dag: &mut Dag, root: Node, u: Node) -> Result<Side, Undecided> {
        let mut algebra = Algebra::beside(SMALL_BUDGET, Scope::Densely, u);
        let poly = algebra.convert(dag, root)?;
        let poly = algebra.canonical(&poly)?;
        let node = algebra.node(dag, &poly);
        Ok(Side {
            node,
            regular: regular(dag, node),
            is_infinite: is_infinite(dag, &mut algebra, &poly, u)?,
        })
    }
}

/// Whether a polynomial tends to infinity as u tends to 0: its lowest power of u is negative, and the
/// factor of that has a value at u = 0 which is never 0, whatever the parameters.
fn is_infinite(
    dag: &mut Dag,
    algebra: &mut Algebra,
    poly: &Poly,
    u: Node,
) -> Result<bool, Undecided> {
    let atom = algebra.leaf(dag, u);
    let powers = poly.by_power(atom);
    let Some((..=-1, factor)) = powers.first() else {
        return Ok(false);
    };
    let (factor, nothing) = (algebra.node(dag, factor), dag.integer(0));
    if !regular(dag, factor).is_continuous {
        return Ok(false);
    }
    let there = replaced(dag, factor, u, nothing);
    let there = algebra.convert(dag, there)?;
    let there = algebra.canonical(&there)?;
    let is_number = there.as_constant().is_some_and(|c| !c.is_zero());
    let opposite = there.scale(&Rational::MINUS_ONE);
    Ok(is_number || algebra.is_positive(&there) || algebra.is_positive(&opposite))
}
