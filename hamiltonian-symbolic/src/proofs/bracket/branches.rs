//! Conditions: where both branches agree, and steps replaced by smooth functions.
//!
//! Input: expressions with conditions. Output: the conditions whose branches agree where they
//! switch ([`known`]), an expression without its steps ([`smoothed`]). Invariant: agreement is an
//! identity, proven by the normal form.

use crate::dag::{Dag, Dependence, Kind, Node, Partial};
use crate::facts::{Facts, Given, ROUNDED, STEP, comparisons};
use crate::list::IntoList;
use crate::model::Model;
use crate::normal_form::{self, Scope};
use crate::op::Op;
use crate::rational::Rational;

/// The conditions below some roots whose branches agree where they switch.
pub(super) fn known(dag: &mut Dag, roots: &[Node]) -> Given {
    let mut given = Given::default();
    for node in dag.reachable(roots) {
        if let Kind::Select(condition, yes, no) = *dag.kind(node)
            && dag.dependence(condition).on(Dependence::MOVING)
            && comparisons(dag, condition)
                .into_iter()
                .all(|(a, b)| agree(dag, (a, b), yes, no))
        {
            given.meeting.insert(node, ());
        }
    }
    given
}

/// Returns true if two branches are the same wherever a = b.
pub(crate) fn agree(dag: &mut Dag, (a, b): (Node, Node), yes: Node, no: Node) -> bool {
    let difference = dag.sub(yes, no);
    // A variable that a sum binds is not the one of the loop around.
    let home = dag.deepest(dag.variables(a) | dag.variables(b));
    let difference = dag.nested(difference, home);
    let (apart, zero) = (dag.sub(a, b), dag.integer(0));
    [(a, b), (b, a), (apart, zero)]
        .into_iter()
        .any(|(x, value)| {
            solutions(dag, x, value).is_some_and(|solutions| {
                solutions.into_iter().all(|images| {
                    let image = |node: Node| {
                        let mut images = images.iter();
                        images.find(|(from, _)| *from == node).map(|(_, to)| *to)
                    };
                    let difference = dag.substitute(difference, |_, node| image(node));
                    normal_form::vanishes(dag, difference, Scope::Everywhere)
                })
            })
        })
}

/// Consequences of x = value: for each case, nodes with the nodes they are equal to. `None` if the
/// equation is solved for nothing that moves.
fn solutions(dag: &mut Dag, x: Node, value: Node) -> Option<Vec<Vec<(Node, Node)>>> {
    let mut done = Vec::new();
    let mut left = vec![(Vec::new(), x, value)];
    while let Some((mut images, x, value)) = left.pop() {
        if !dag.dependence(x).on(Dependence::MOVING) || reads(dag, value, x) {
            return None;
        }
        images.push((x, value));
        match dag.kind(x).clone() {
            Kind::Call(Op::Abs, y) => {
                let minus = dag.neg(value);
                left.push((images.clone(), y[0], value));
                left.push((images, y[0], minus));
            }
            Kind::Call(Op::Sqrt, y) => {
                let square = dag.powi(value, 2);
                left.push((images, y[0], square));
            }
            Kind::Product(k, factors) if factors.len() == 1 && factors[0].1 > 0 => {
                let (base, mut power) = factors[0];
                let by = dag.constant(k);
                let mut root = dag.div(value, by);
                let is_even = power % 2 == 0;
                for (op, n) in [(Op::Sqrt, 2), (Op::Cbrt, 3)] {
                    while power % n == 0 {
                        root = dag.call(op, &[root]);
                        power /= n;
                    }
                }
                if power != 1 {
                    done.push(images);
                    continue;
                }
                if is_even && !dag.is_nonnegative(base) {
                    let minus = dag.neg(root);
                    left.push((images.clone(), base, minus));
                }
                left.push((images, base, root));
            }
            Kind::Sum(c, terms) => {
                let is_leaf = |n: Node| matches!(dag.kind(n), Kind::Element(..) | Kind::Time);
                let is_moving = |n: Node| dag.dependence(n).on(Dependence::MOVING);
                let solved = (0..terms.len()).find(|at| {
                    let leaf = terms[*at].1;
                    let mut others = terms.iter().enumerate().filter(|(other, _)| other != at);
                    is_leaf(leaf)
                        && is_moving(leaf)
                        && !reads(dag, value, leaf)
                        && others.all(|(_, (_, other))| !reads(dag, *other, leaf))
                });
                if let Some((at, by)) = solved.and_then(|at| Some((at, terms[at].0.recip()?))) {
                    let mut rest: Vec<(Rational, Node)> = terms.clone();
                    let (_, leaf) = rest.remove(at);
                    let rest = dag.linear(&c, &rest);
                    let distance = dag.sub(value, rest);
                    images.push((leaf, dag.scale(&by, distance)));
                }
                done.push(images);
            }
            _ => done.push(images),
        }
    }
    Some(done)
}

/// Returns true if a node stands in another one.
fn reads(dag: &Dag, root: Node, node: Node) -> bool {
    dag.reachable(&[root]).binary_search(&node).is_ok()
}

/// An expression with its steps replaced by arbitrary smooth functions of what is 0 there, and the places of the
/// steps; `None` if it has none.
pub(super) fn smoothed(model: &mut Model, root: Node, given: &Given) -> Option<(Node, Vec<Node>)> {
    let dag = &mut model.dag;
    let facts = Facts::of(dag, &[root], given);
    // A condition around a step is smoothed after it.
    let is_step = |dag: &Dag, node: Node| {
        let may_jump = !facts.get(node).is_projective;
        match dag.kind(node) {
            Kind::Select(..) => may_jump,
            Kind::Call(op, x) => {
                let is_smooth = x.iter().all(|x| facts.get(*x).is_projective);
                may_jump && is_smooth && stand_in(*op).is_some()
            }
            _ => false,
        }
    };
    let mut steps: Vec<Node> = Vec::new();
    let nodes = dag.reachable(&[root]);
    let new = dag.map(nodes, |dag, node, new| match *dag.kind(node) {
        Kind::Select(condition, yes, no) if is_step(dag, node) => {
            for (a, b) in comparisons(dag, condition) {
                steps.push(dag.sub(a, b));
            }
            let weight = weight(dag, condition, &|side| new[&side]);
            let other = dag.complement(weight);
            let yes = dag.mul(&[weight, new[&yes]]);
            let no = dag.mul(&[other, new[&no]]);
            dag.add(&[yes, no])
        }
        Kind::Call(op, ref x) => {
            let Some(function) = stand_in(op).filter(|_| is_step(dag, node)) else {
                return dag.rebuild(node, &|child| new[&child]);
            };
            let (x, images) = (x.clone(), x.iter().map(|x| new[x]).into_list());
            steps.push(edge(dag, op, &x));
            dag.external(function, Partial::Value, &images)
        }
        _ => dag.rebuild(node, &|child| new[&child]),
    });
    (!steps.is_empty()).then(|| (new[&root], steps))
}

/// The reserved number of the smooth function in the place of one that jumps; `None` for other functions.
fn stand_in(op: Op) -> Option<u16> {
    match op {
        Op::Sign => Some(STEP),
        Op::Floor => Some(ROUNDED),
        Op::Round => Some(ROUNDED - 1),
        Op::Modulo => Some(ROUNDED - 2),
        Op::Remainder => Some(ROUNDED - 3),
        _ => None,
    }
}

/// An expression that is 0 exactly where a sign or a function that rounds jumps.
fn edge(dag: &mut Dag, op: Op, x: &[Node]) -> Node {
    if op == Op::Sign {
        return x[0];
    }
    let turns = match *x {
        [x, y] => dag.div(x, y),
        _ => x[0],
    };
    let pi = dag.pi();
    let angle = dag.mul(&[pi, turns]);
    let is_whole = matches!(op, Op::Floor | Op::Modulo);
    dag.call(if is_whole { Op::Sin } else { Op::Cos }, &[angle])
}

/// A condition as a number: 1 where it holds and 0 elsewhere, but for the functions in the places of its
/// comparisons, whose values are between 0 and 1; with the images of the sides.
fn weight(dag: &mut Dag, condition: Node, image: &dyn Fn(Node) -> Node) -> Node {
    let nodes = dag.reachable(&[condition]);
    let new = dag.map(nodes, |dag, node, new| match *dag.kind(node) {
        Kind::Compare(relation, a, b) => {
            let apart = dag.sub(image(b), image(a));
            dag.external(STEP - 1 - relation as u16, Partial::Value, &[apart])
        }
        Kind::Not(a) => dag.complement(new[&a]),
        Kind::And(a, b) => {
            let (a, b) = (new[&a], new[&b]);
            dag.mul(&[a, b])
        }
        Kind::Or(a, b) => {
            let neither = [a, b].map(|side| dag.complement(new[&side]));
            let neither = dag.mul(&neither);
            dag.complement(neither)
        }
        _ => node,
    });
    new[&condition]
}

impl Dag {
    /// 1 − x
    fn complement(&mut self, x: Node) -> Node {
        let one = self.integer(1);
        self.sub(one, x)
    }
}
