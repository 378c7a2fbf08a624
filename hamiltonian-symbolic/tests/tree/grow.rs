//! Growth of random expressions, and their points of evaluation.

use super::{Part, Random, TIME, Test, Tree, VARIABLES};
use hamiltonian_symbolic::op::Op;

/// A random expression and a point for it.
pub fn grow(random: &mut Random) -> (Tree, Vec<f64>) {
    // Mostly a handful of operations, some dozens.
    let mut budget = 2 + random.below(9);
    while budget < 60 && random.chance(0.25) {
        budget += random.below(12);
    }
    let mut tree = Tree::default();
    expression(&mut tree, random, budget);
    let special = random.chance(0.1);
    let point = (0..VARIABLES)
        .map(|at| {
            if special && random.chance(0.5) {
                return random.one_of(&[0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -2.0, 3.0]);
            }
            let size = random.unit() * if random.chance(0.9) { 2.0 } else { 20.0 };
            if at > TIME || random.chance(0.5) {
                size + 0.01
            } else {
                -size
            }
        })
        .collect();
    (tree, point)
}

fn push(tree: &mut Tree, part: Part) -> usize {
    tree.0.push(part);
    tree.0.len() - 1
}

fn leaf(tree: &mut Tree, random: &mut Random) -> usize {
    let part = match random.below(20) {
        0..=13 => Part::Variable(random.below(VARIABLES)),
        14..=16 => {
            let (n, d) = random.one_of(&[
                (1, 1),
                (2, 1),
                (3, 1),
                (-1, 1),
                (1, 2),
                (1, 3),
                (1, 10),
                (981, 100),
                (-7, 4),
                (5, 1),
            ]);
            Part::Number(n, d)
        }
        17 => Part::Pi,
        _ if !tree.0.is_empty() => return random.below(tree.0.len()),
        _ => Part::Variable(random.below(4)),
    };
    push(tree, part)
}

/// A subexpression of about `budget` operations; its place.
fn expression(tree: &mut Tree, random: &mut Random, budget: usize) -> usize {
    if budget == 0 {
        return leaf(tree, random);
    }
    let rest = budget - 1;
    let left = random.below(rest + 1);
    let right = rest - left;
    match random.below(100) {
        0..=14 => two(tree, random, left, right, Part::Add),
        15..=26 => two(tree, random, left, right, Part::Sub),
        27..=44 => two(tree, random, left, right, Part::Mul),
        45..=52 => {
            let a = expression(tree, random, left);
            let b = expression(tree, random, right);
            let b = away_from_zero(tree, random, b);
            push(tree, Part::Div(a, b))
        }
        53..=55 => {
            let a = expression(tree, random, rest);
            push(tree, Part::Neg(a))
        }
        56..=67 => power(tree, random, rest),
        68..=87 => function(tree, random, rest),
        88..=93 => {
            let op = random.one_of(&[
                Op::Atan2,
                Op::Hypot,
                Op::Min,
                Op::Max,
                Op::Pow,
                Op::Modulo,
                Op::Remainder,
            ]);
            let a = expression(tree, random, left);
            let b = expression(tree, random, right);
            match op {
                Op::Pow => {
                    let a = positive(tree, random, a);
                    let b = bounded(tree, random, b);
                    push(tree, Part::Call2(op, a, b))
                }
                Op::Modulo | Op::Remainder => {
                    let a = off_multiples(tree, a);
                    let b = away_from_zero(tree, random, b);
                    push(tree, Part::Call2(op, a, b))
                }
                _ => push(tree, Part::Call2(op, a, b)),
            }
        }
        _ => {
            let first = test(tree, random);
            let a = expression(tree, random, left);
            let b = expression(tree, random, right);
            if random.chance(0.6) {
                push(tree, Part::If(first, random.chance(0.3), a, b))
            } else {
                let second = test(tree, random);
                push(tree, Part::IfBoth(first, second, random.chance(0.5), a, b))
            }
        }
    }
}

fn two(
    tree: &mut Tree,
    random: &mut Random,
    left: usize,
    right: usize,
    part: fn(usize, usize) -> Part,
) -> usize {
    let a = expression(tree, random, left);
    let b = expression(tree, random, right);
    push(tree, part(a, b))
}

fn test(tree: &mut Tree, random: &mut Random) -> Test {
    let make = random.one_of(&[Test::Less as fn(usize, usize) -> Test, Test::LessEqual]);
    let make = if random.chance(0.1) {
        Test::Equal
    } else {
        make
    };
    let size = random.below(3);
    let a = expression(tree, random, size);
    let b = leaf(tree, random);
    make(a, b)
}

fn power(tree: &mut Tree, random: &mut Random, rest: usize) -> usize {
    let a = expression(tree, random, rest);
    if random.chance(0.6) {
        let n = random.one_of(&[2, 2, 2, 3, 4, 5, 6, 7, -1, -2, -3]);
        let a = if n < 0 {
            away_from_zero(tree, random, a)
        } else {
            a
        };
        return push(tree, Part::Power(a, n, 1));
    }
    let (n, d) = random.one_of(&[
        (1, 2),
        (3, 2),
        (-1, 2),
        (-3, 2),
        (5, 2),
        (1, 3),
        (2, 3),
        (-4, 3),
        (3, 10),
        (-7, 5),
        (13, 4),
    ]);
    let a = positive(tree, random, a);
    push(tree, Part::Power(a, n, d))
}

fn function(tree: &mut Tree, random: &mut Random, rest: usize) -> usize {
    let op = random.one_of(Op::all());
    if op.row().arguments.len() != 1 {
        return function(tree, random, rest);
    }
    let a = expression(tree, random, rest);
    let a = match op {
        Op::Sqrt | Op::Ln | Op::Ln1p => positive(tree, random, a),
        Op::Asin | Op::Acos | Op::Atanh => within_one(tree, random, a),
        Op::Acosh => {
            let a = positive(tree, random, a);
            let one = push(tree, Part::Number(1, 1));
            push(tree, Part::Add(a, one))
        }
        Op::Floor | Op::Round => off_multiples(tree, a),
        Op::Exp | Op::ExpM1 | Op::Sinh | Op::Cosh | Op::Tan => bounded(tree, random, a),
        _ => a,
    };
    push(tree, Part::Call(op, a))
}

/// Moves simple numbers off the places where whole numbers jump.
fn off_multiples(tree: &mut Tree, a: usize) -> usize {
    let c = push(tree, Part::Number(3, 10));
    push(tree, Part::Add(a, c))
}

/// Mostly makes a positive number of `a`.
fn positive(tree: &mut Tree, random: &mut Random, a: usize) -> usize {
    match random.below(16) {
        0..=5 => {
            let square = push(tree, Part::Power(a, 2, 1));
            let (n, d) = random.one_of(&[(1, 1), (1, 4), (2, 1)]);
            let c = push(tree, Part::Number(n, d));
            push(tree, Part::Add(square, c))
        }
        6..=9 => push(tree, Part::Call(Op::Abs, a)),
        10..=12 => {
            let a = bounded(tree, random, a);
            push(tree, Part::Call(random.one_of(&[Op::Exp, Op::Cosh]), a))
        }
        13 | 14 => {
            let b = leaf(tree, random);
            let (a, b) = (
                push(tree, Part::Power(a, 2, 1)),
                push(tree, Part::Power(b, 2, 1)),
            );
            push(tree, Part::Add(a, b))
        }
        _ => a,
    }
}

fn away_from_zero(tree: &mut Tree, random: &mut Random, a: usize) -> usize {
    if random.chance(0.5) {
        positive(tree, random, a)
    } else {
        a
    }
}

/// Mostly makes a number of moderate size of `a`.
fn bounded(tree: &mut Tree, random: &mut Random, a: usize) -> usize {
    match random.below(10) {
        0..=5 => push(
            tree,
            Part::Call(random.one_of(&[Op::Sin, Op::Tanh, Op::Atan, Op::Cos]), a),
        ),
        _ => a,
    }
}

/// Mostly makes a number in (−1, 1) of `a`.
fn within_one(tree: &mut Tree, random: &mut Random, a: usize) -> usize {
    match random.below(10) {
        0..=3 => push(
            tree,
            Part::Call(random.one_of(&[Op::Sin, Op::Tanh, Op::Cos]), a),
        ),
        4..=8 => {
            let square = push(tree, Part::Power(a, 2, 1));
            let one = push(tree, Part::Number(1, 1));
            let below = push(tree, Part::Add(one, square));
            push(tree, Part::Div(a, below))
        }
        _ => a,
    }
}
