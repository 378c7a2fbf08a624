//! The place of a point: away from every edge of every operation, exactly on one, or so close
//! that rounding decides.

use super::{Part, Test, Tree};
use hamiltonian_lanes::Dual;
use hamiltonian_symbolic::op::Op;

/// The place of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// Away from edges.
    Inside,
    /// Exactly on the edge of a domain, a kink or a tie.
    Edge,
    /// Rounding decides on which side.
    Undecided,
}

/// The place of the tree at a point, by forward error bounds of its plain evaluation.
pub fn region(tree: &Tree, point: &[f64]) -> Region {
    let values = tree.values(point);
    let mut errors: Vec<f64> = Vec::with_capacity(values.len());
    let mut result = Region::Inside;
    for (at, part) in tree.0.iter().enumerate() {
        for (distance, error) in distances(*part, &values, &errors) {
            if distance <= 8.0 * error {
                if error == 0.0 {
                    result = Region::Edge;
                } else {
                    return Region::Undecided;
                }
            }
        }
        let own = match part {
            Part::Variable(_) | Part::Neg(_) | Part::Number(_, 1) => 0.0,
            _ => f64::EPSILON * values[at].abs(),
        };
        let carried: f64 = part
            .operands()
            .into_iter()
            .map(|operand| {
                if errors[operand] == 0.0 {
                    return 0.0;
                }
                let slope = part.value(
                    &point.iter().map(|x| Dual::fixed(*x)).collect::<Vec<_>>(),
                    |other| {
                        if other == operand {
                            Dual::variable(values[other])
                        } else {
                            Dual::fixed(values[other])
                        }
                    },
                );
                // The branch a condition does not take may be NaN, with its error.
                if slope.eps == 0.0 {
                    return 0.0;
                }
                slope.eps.abs() * errors[operand]
            })
            .sum();
        errors.push(own + carried);
    }
    result
}

/// Distances from edges with the errors they are known to.
fn distances(part: Part, v: &[f64], e: &[f64]) -> Vec<(f64, f64)> {
    let from = |a: usize, edge: f64| ((v[a] - edge).abs(), e[a]);
    let tie = |a: usize, b: usize| {
        if a == b {
            (1.0, 0.0)
        } else {
            ((v[a] - v[b]).abs(), e[a] + e[b])
        }
    };
    let test = |test: Test| match test {
        Test::Less(a, b) | Test::LessEqual(a, b) | Test::Equal(a, b) => tie(a, b),
    };
    match part {
        Part::Div(_, b) => vec![from(b, 0.0)],
        Part::Power(a, n, d) if n < 0 || d > 1 => vec![from(a, 0.0)],
        Part::Call(op, a) => match op {
            Op::Sqrt | Op::Cbrt | Op::Abs | Op::Sign | Op::Ln => vec![from(a, 0.0)],
            Op::Asin | Op::Acos | Op::Atanh => vec![from(a, 1.0), from(a, -1.0)],
            Op::Acosh => vec![from(a, 1.0)],
            Op::Ln1p => vec![from(a, -1.0)],
            Op::Floor => vec![from(a, v[a].round())],
            Op::Round => vec![from(a, v[a].floor() + 0.5)],
            Op::Tan => vec![(v[a].cos().abs(), e[a])],
            _ => vec![],
        },
        Part::Call2(Op::Min | Op::Max, a, b) => vec![tie(a, b)],
        Part::Call2(op @ (Op::Modulo | Op::Remainder), a, b) => {
            let turns = v[a] / v[b];
            let jump = match op {
                Op::Modulo => turns.round(),
                _ => turns.floor() + 0.5,
            };
            let apart = (v[a] - jump * v[b]).abs();
            vec![from(b, 0.0), (apart, e[a] + jump.abs() * e[b])]
        }
        // Of a difference that is 0 the sign is rounding's: x − x is 0, and (x − x)·y may be −0.
        Part::Call2(Op::Atan2, a, b) if v[a] == 0.0 && v[a].is_sign_negative() && v[b] < 0.0 => {
            vec![(0.0, f64::MIN_POSITIVE)]
        }
        Part::Call2(Op::Atan2, a, b) if v[b] <= 8.0 * e[b] => vec![from(a, 0.0)],
        Part::Call2(Op::Hypot, a, b) => vec![(v[a].hypot(v[b]), e[a] + e[b])],
        Part::Call2(Op::Pow, a, b) => {
            let mut all = vec![from(a, 0.0)];
            if v[a] < 0.0 {
                all.push(((v[b] - v[b].round()).abs(), e[b]));
            }
            all
        }
        Part::If(one, ..) => vec![test(one)],
        Part::IfBoth(one, two, ..) => vec![test(one), test(two)],
        _ => vec![],
    }
}
