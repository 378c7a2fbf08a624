//! Walls: places where H is infinite, which no orbit of a conserved H reaches.
//!
//! Input: H, and an expression z that is 0 at a place. Output: whether |H| → ∞ as z → 0. Invariant: the answer
//! holds for all parameters and sizes. For each node it rests on two bounds, c·|z|^−least ≤ |x| ≤ C·|z|^−most.
//!
//! An infinite term makes a sum infinite only if the others cannot cancel it: they grow more slowly, have its
//! sign, or move other degrees of freedom, as 1/(x − y)² and −1/(x + y)² do. So 1/x² − cos(x)/x² is no wall,
//! though both terms are infinite at x = 0. A loop counts only if it runs: it is one of the loops that z itself is
//! in, or its range is never empty. A factor counts only if it is not 0 anywhere: where y² + z² is 0 in
//! (y² + z²)/x², a free particle crosses x = 0.

use crate::dag::{Dag, Dependence, Kind, Map, Node, Sign};
use crate::facts::{
    Facts, Given, are_along_other_lines, have_no_degree_in_common, is_of_own_rows, stem,
};
use crate::index::Domain;
use crate::list::IntoList;
use crate::op::Op;
use crate::ranges::Ranges;
use crate::rational::Rational;

/// The points of a place that a bound holds at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum At {
    /// Every point, for all parameters.
    All,
    /// The points outside sets of two dimensions less. A parameter is 0 nowhere: a term whose factor is 0 is not
    /// there.
    Most,
}

/// Returns true if |H| → ∞ wherever a node tends to 0.
pub(super) fn is_infinite(dag: &mut Dag, h: Node, node: Node, given: &Given, at: At) -> bool {
    let minus = dag.neg(node);
    let zeros = [stem(dag, node), stem(dag, minus)];
    let path = dag.path(dag.home(node));
    let facts = match at {
        At::All => Facts::everywhere(dag, &[h], given),
        At::Most => Facts::of(dag, &[h], given),
    };
    let mut elsewhere = given.clone();
    for zero in zeros {
        elsewhere.nonzero.insert(zero, ());
    }
    let elsewhere = Facts::everywhere(dag, &[h], &elsewhere);
    let search = WallSearch {
        dag,
        h,
        zeros,
        path,
        facts,
        elsewhere,
        at,
    };
    let mut growth: Map<Node, WallGrowth> = Map::default();
    for x in dag.reachable(&[h]) {
        let found = search.growth(x, &growth);
        growth.insert(x, found);
    }
    growth[&h].is_infinite()
}

/// An exponent of 1/|z| and one of |ln |z||, compared in this order.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Order(Rational, Rational);

impl Order {
    const FINITE: Order = Order(Rational::ZERO, Rational::ZERO);
    const LOGARITHM: Order = Order(Rational::ZERO, Rational::ONE);

    fn plus(&self, other: &Order) -> Order {
        Order(self.0.add(&other.0), self.1.add(&other.1))
    }
    fn times(&self, k: &Rational) -> Order {
        Order(self.0.mul(k), self.1.mul(k))
    }
}

/// Bounds of a node as z → 0, and its sign there.
#[derive(Clone, Debug)]
struct WallGrowth {
    least: Option<Order>,
    most: Option<Order>,
    sign: Sign,
}

impl WallGrowth {
    fn is_infinite(&self) -> bool {
        self.least.as_ref().is_some_and(|n| *n > Order::FINITE)
    }
    fn is_below(&self, order: &Order) -> bool {
        self.most.as_ref().is_some_and(|most| most < order)
    }
    /// Bounds of |x|^k.
    fn power(&self, k: &Rational) -> [Option<Order>; 2] {
        let bounds = match k.is_negative() {
            true => [&self.most, &self.least],
            false => [&self.least, &self.most],
        };
        bounds.map(|bound| bound.as_ref().map(|bound| bound.times(k)))
    }
}

/// The more of two lower bounds.
fn larger(a: Option<Order>, b: Option<Order>) -> Option<Order> {
    a.max(b)
}

/// The upper bound of a sum.
fn together(a: Option<Order>, b: Option<Order>) -> Option<Order> {
    Some(a?.max(b?))
}

struct WallSearch<'a> {
    dag: &'a Dag,
    h: Node,
    /// The nodes that are 0 where z is, but for roots and powers.
    zeros: [Node; 2],
    /// The loops that z is in, each of which runs if z has a value.
    path: Vec<Domain>,
    facts: Facts,
    /// The facts where z is not 0.
    elsewhere: Facts,
    at: At,
}

impl WallSearch<'_> {
    fn growth(&self, x: Node, below: &Map<Node, WallGrowth>) -> WallGrowth {
        let dag = self.dag;
        let mut found = self.structural(x, below);
        let regular = self.facts.get(x);
        let is_moving = dag.dependence(x).on(Dependence::MOVING);
        if regular.is_continuous {
            let finite = Some(Order::FINITE);
            found.most = match found.most {
                None => finite,
                most => most.min(finite),
            };
        }
        if regular.has_no_zero || self.at == At::Most && !is_moving {
            found.least = larger(found.least, Some(Order::FINITE));
        }
        if found.sign.is_unknown() {
            found.sign = dag.sign(x);
        }
        found
    }

    /// The bounds that follow from those of the nodes below.
    fn structural(&self, x: Node, below: &Map<Node, WallGrowth>) -> WallGrowth {
        let dag = self.dag;
        let nothing = WallGrowth {
            least: None,
            most: None,
            sign: dag.sign(x),
        };
        if self.zeros.contains(&x) {
            let zero = Some(Order(Rational::MINUS_ONE, Rational::ZERO));
            return WallGrowth {
                least: zero.clone(),
                most: zero,
                ..nothing
            };
        }
        match dag.kind(x) {
            Kind::Sum(c, terms) => self.sum(x, c, terms, below),
            Kind::Product(k, factors) => {
                let mut bounds = [Some(Order::FINITE), Some(Order::FINITE)];
                for (factor, n) in factors {
                    let power = below[factor].power(&Rational::integer((*n).into()));
                    for (bound, more) in bounds.iter_mut().zip(power) {
                        *bound = bound.take().zip(more).map(|(a, b)| a.plus(&b));
                    }
                }
                let [least, most] = bounds;
                let signs = factors.iter().map(|(factor, n)| (below[factor].sign, *n));
                WallGrowth {
                    least,
                    most,
                    sign: Sign::of_product(k, signs),
                }
            }
            Kind::Call(op, arguments) => self.call(*op, arguments, below, nothing),
            Kind::Reduce(domain, body) => self.sum_over(x, *domain, *body, below, nothing),
            Kind::Select(_, yes, no) => {
                let (yes, no) = (&below[yes], &below[no]);
                WallGrowth {
                    least: yes.least.clone().min(no.least.clone()),
                    most: together(yes.most.clone(), no.most.clone()),
                    sign: yes.sign.or(no.sign),
                }
            }
            _ => nothing,
        }
    }

    /// A sum is at least as large as its terms of one sign, or as one term, if the others grow more slowly. A term that
    /// moves other degrees of freedom than all others that do not is infinite alone: a sum of several may move these by
    /// one term, and cancel in another.
    fn sum(
        &self,
        x: Node,
        c: &Rational,
        terms: &[(Rational, Node)],
        below: &Map<Node, WallGrowth>,
    ) -> WallGrowth {
        let mut each: Vec<(Option<Node>, WallGrowth)> = terms
            .iter()
            .map(|(k, term)| {
                let mut growth = below[term].clone();
                growth.sign = Sign::of(k).times(growth.sign);
                (Some(*term), growth)
            })
            .into_list();
        if !c.is_zero() {
            let finite = Some(Order::FINITE);
            let constant = WallGrowth {
                least: finite.clone(),
                most: finite,
                sign: Sign::of(c),
            };
            each.push((None, constant));
        }
        let most = each
            .iter()
            .map(|(_, growth)| growth.most.clone())
            .reduce(together)
            .flatten();
        let mut found = WallGrowth {
            least: None,
            most,
            sign: Sign::UNKNOWN,
        };
        let mut consider = |group: Vec<usize>, sign: Sign| {
            let largest = group.iter().max_by_key(|at| &each[**at].1.least);
            let Some((largest, least)) =
                largest.and_then(|at| Some((*at, each[*at].1.least.clone()?)))
            else {
                return;
            };
            let mut rest = (0..each.len())
                .filter(|other| !(group.contains(other) || each[*other].1.is_below(&least)))
                .peekable();
            let are_less = rest.peek().is_none()
                || group.len() == 1 && self.is_on_top(x) && {
                    let rest: Option<Vec<Node>> = rest.map(|other| each[other].0).collect();
                    each[largest].0.zip(rest).is_some_and(|(one, rest)| {
                        let is_apart =
                            |other: &Node| have_no_degree_in_common(self.dag, one, *other);
                        rest.iter().all(is_apart) || are_along_other_lines(self.dag, one, &rest)
                    })
                };
            if are_less && found.least.as_ref().is_none_or(|known| least > *known) {
                found.least = Some(least);
                found.sign = sign;
            }
        };
        let of_sign = |is_of: fn(Sign) -> bool| -> Vec<usize> {
            let all = 0..each.len();
            all.filter(|at| is_of(each[*at].1.sign)).into_list()
        };
        consider(of_sign(Sign::is_nonnegative), Sign::NONNEGATIVE);
        let nonpositive = Sign::NONNEGATIVE.times(Sign::NEGATIVE);
        consider(of_sign(Sign::is_nonpositive), nonpositive);
        for at in 0..each.len() {
            consider(vec![at], Sign::UNKNOWN);
        }
        found
    }

    /// Returns true if a node is H, or the body of a loop that is a term of H and moves other degrees of freedom in each
    /// iteration: the velocities of one term are then those of H.
    fn is_on_top(&self, x: Node) -> bool {
        let terms = match self.dag.kind(self.h) {
            Kind::Sum(_, terms) => terms.iter().map(|(_, term)| *term).into_list(),
            _ => vec![self.h],
        };
        let is_body = |term: Node| match *self.dag.kind(term) {
            Kind::Reduce(domain, body) => body == x && is_of_own_rows(self.dag, body, domain),
            _ => false,
        };
        x == self.h || terms.into_iter().any(is_body)
    }

    /// A loop over a body. Of several iterations that are infinite, all are to have one sign, or to move other
    /// degrees of freedom.
    fn sum_over(
        &self,
        x: Node,
        domain: Domain,
        body: Node,
        below: &Map<Node, WallGrowth>,
        mut found: WallGrowth,
    ) -> WallGrowth {
        let dag = self.dag;
        let growth = &below[&body];
        let is_of_place = self.path.contains(&domain);
        let is_everywhere = self.at == At::All;
        if !is_of_place || !is_everywhere {
            found.most = growth.most.clone();
        }
        let has_one_sign = |sign: Sign| sign.is_nonnegative() || sign.is_nonpositive();
        let is_term = || {
            let terms = match dag.kind(self.h) {
                Kind::Sum(_, terms) => terms.iter().any(|(_, term)| *term == x),
                _ => false,
            };
            terms || x == self.h
        };
        let counts = match is_of_place {
            false => !is_empty(dag, domain) && has_one_sign(growth.sign),
            true => {
                // Other iterations have the sign of this one where they are infinite, or no infinity here.
                !is_everywhere
                    || has_one_sign(dag.sign(body))
                    || has_one_sign(growth.sign) && self.elsewhere.get(body).is_continuous
                    || is_term() && is_of_own_rows(dag, body, domain)
            }
        };
        if counts && growth.is_infinite() {
            found.least = growth.least.clone();
            found.sign = growth.sign;
        }
        found
    }

    fn call(
        &self,
        op: Op,
        arguments: &[Node],
        below: &Map<Node, WallGrowth>,
        nothing: WallGrowth,
    ) -> WallGrowth {
        let first = &below[&arguments[0]];
        let tends_to_zero = || first.is_below(&Order::FINITE);
        let logarithm = || {
            let is_known = first.least.is_some() && first.most.is_some();
            WallGrowth {
                least: Some(Order::LOGARITHM),
                most: is_known.then_some(Order::LOGARITHM),
                ..nothing.clone()
            }
        };
        let raised = |k: &Rational| {
            let [least, most] = first.power(k);
            WallGrowth {
                least,
                most,
                ..nothing.clone()
            }
        };
        match op {
            Op::Sqrt => raised(&Rational::new(1, 2)),
            Op::Cbrt => raised(&Rational::new(1, 3)),
            Op::Abs => raised(&Rational::ONE),
            Op::Pow => match self.dag.as_constant(arguments[1]) {
                Some(exponent) => raised(exponent),
                None => nothing,
            },
            Op::Hypot => {
                let second = &below[&arguments[1]];
                WallGrowth {
                    least: larger(first.least.clone(), second.least.clone()),
                    most: together(first.most.clone(), second.most.clone()),
                    ..nothing
                }
            }
            // max(x, y) ≥ x, min(x, y) ≤ x
            Op::Min | Op::Max => {
                let is_on_side = |growth: &WallGrowth| match op {
                    Op::Max => growth.sign.is_nonnegative(),
                    _ => growth.sign.is_nonpositive(),
                };
                let each = arguments.iter().map(|x| &below[x]);
                let far = each.clone().filter(|x| x.is_infinite() && is_on_side(x));
                let far = far.max_by_key(|x| x.least.clone()).cloned();
                let most = each.map(|x| x.most.clone()).reduce(together).flatten();
                WallGrowth {
                    least: far.as_ref().and_then(|x| x.least.clone()),
                    most,
                    sign: far.map_or(nothing.sign, |x| x.sign),
                }
            }
            // e^x ≥ x
            Op::Exp | Op::ExpM1 if first.is_infinite() && first.sign.is_nonnegative() => {
                WallGrowth {
                    least: first.least.clone(),
                    most: None,
                    sign: Sign::NONNEGATIVE,
                }
            }
            Op::Ln if tends_to_zero() => WallGrowth {
                sign: Sign::NEGATIVE,
                ..logarithm()
            },
            Op::Ln | Op::Ln1p | Op::Acosh if first.is_infinite() => WallGrowth {
                sign: Sign::POSITIVE,
                ..logarithm()
            },
            Op::Asinh if first.is_infinite() => logarithm(),
            // |sinh x| ≥ |x|, cosh x ≥ |x|
            Op::Sinh | Op::Cosh if first.is_infinite() => WallGrowth {
                least: first.least.clone(),
                ..nothing
            },
            _ => nothing,
        }
    }
}

/// Returns true if a loop may have no iteration, for some sizes or in some iteration of the loops around it.
fn is_empty(dag: &Dag, domain: Domain) -> bool {
    let [start, end] = dag.bounds(domain);
    let room = start.room_below(end);
    !room.is_some_and(|room| dag.is_never_negative(&room))
}
