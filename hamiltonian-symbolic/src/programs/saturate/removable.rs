//! w/(eʷ − 1) near w = 0, where the terms of its derivatives cancel.
//!
//! Input: roots, before differentiation. Output: the same functions, continued to w = 0. Where w² < 1 the quotient is its
//! series Σ Bₙ·wⁿ/n! with the numbers of Bernoulli, so that derivatives are those of a polynomial. For example, the
//! derivative of x/exp_m1(x) as a quotient has an error of 2ε/x. Invariant: what has no such quotient is left as it is.

use crate::dag::{Dag, Kind, Node};
use crate::list::IntoList;
use crate::op::Op;
use crate::product::Product;
use crate::rational::Rational;

/// The powers of w² in the series: for w² < 1 the next one is below the last digit of the second derivative.
const POWERS: usize = 14;

/// Replaces the quotients in the expressions that the roots stand for.
pub(super) fn series_near_zero(dag: &mut Dag, roots: &mut [Node]) {
    if !dag.has(roots, &|kind| matches!(kind, Kind::Call(Op::ExpM1, _))) {
        return;
    }
    let nodes = dag.reachable(roots);
    let new = dag.map(nodes, |dag, node, new| {
        let node = dag.rebuild(node, &|child| new[&child]);
        let divisors: Vec<Node> = match dag.kind(node) {
            Kind::Product(_, factors) => {
                let below = factors.iter().filter(|(_, n)| *n < 0);
                below.map(|(x, _)| *x).into_list()
            }
            _ => return node,
        };
        divisors.into_iter().fold(node, |node, divisor| {
            quotient(dag, node, divisor).unwrap_or(node)
        })
    });
    for root in roots {
        *root = new[root];
    }
}

/// A product with the quotient of w and this divisor, if that is eʷ − 1 and w divides the product.
fn quotient(dag: &mut Dag, node: Node, divisor: Node) -> Option<Node> {
    let w = match dag.kind(divisor) {
        Kind::Call(Op::ExpM1, x) => x[0],
        _ => return None,
    };
    let (all, argument) = (Product::of(dag, node), Product::of(dag, w));
    let numerators = argument.factors.iter().filter(|(_, n)| *n > 0);
    let times = numerators.map(|(x, n)| all.exponent(*x) / n).min()?;
    let times = times.min(-all.exponent(divisor));
    if times < 1 {
        return None;
    }
    let one = Product::power(w, 1)
        .times(&Product::power(divisor, -1))?
        .node(dag);
    let (square, limit) = (dag.powi(w, 2), dag.integer(1));
    let is_near = dag.less(square, limit);
    let series = series(dag, w, square);
    let function = dag.select(is_near, series, one);
    let rest = all
        .times(&argument.pow(-times)?)?
        .times(&Product::power(divisor, times))?
        .times(&Product::power(function, times))?;
    Some(rest.node(dag))
}

/// 1 − w/2 + Σ B₂ₖ·w²ᵏ/(2k)!, by Horner's rule.
fn series(dag: &mut Dag, w: Node, square: Node) -> Node {
    let coefficients = coefficients();
    let mut sum = dag.integer(0);
    for k in (1..=POWERS).rev() {
        let own = dag.constant(coefficients[2 * k].clone());
        let inner = dag.add(&[own, sum]);
        sum = dag.mul(&[square, inner]);
    }
    let one = dag.integer(1);
    let half = dag.scale(&coefficients[1], w);
    dag.add(&[one, half, sum])
}

/// Bₙ/n!: the product of their series with that of (eʷ − 1)/w is 1.
fn coefficients() -> Vec<Rational> {
    let mut all = vec![Rational::ONE];
    for n in 1..=2 * POWERS {
        let (mut factorial, mut next) = (Rational::ONE, Rational::integer(0));
        for j in 1..=n {
            factorial = factorial.mul(&Rational::new(1, j as i64 + 1));
            next = next.sub(&all[n - j].mul(&factorial));
        }
        all.push(next);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_those_of_bernoulli() {
        let all = coefficients();
        let known = [
            (0, 1, 1),
            (1, -1, 2),
            (2, 1, 12),
            (3, 0, 1),
            (4, -1, 720),
            (12, -691, 1_307_674_368_000),
        ];
        for (n, numerator, denominator) in known {
            assert_eq!(all[n], Rational::new(numerator, denominator), "{n}");
        }
    }
}
