//! cosh(√λ s), sinh(√λ s)/√λ and their remainders for any sign of λ.
//!
//! Input: λ and s as expressions. Output: [`Growth`]. Invariant: each is an entire function of λ
//! and s, and is computed without division by λ where λs² is small. If the sign of λ is certain, only its branch is
//! made.

use crate::dag::Node;
use crate::flows::space::Space;
use crate::op::Op;
use crate::rational::Rational;
use std::sync::LazyLock;

/// The functions that solve ẍ = λx.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Growth {
    /// C = cosh(√λ s)
    pub(crate) c: Node,
    /// S = sinh(√λ s)/√λ
    pub(crate) s: Node,
    /// (C − 1)/λ
    pub(crate) c2: Node,
    /// (S − s)/λ
    pub(crate) c3: Node,
}

/// Σ zⁿ/(2n + 1) = artanh(√z)/√z for |z| below [`near_zero`], and arctan(√−z)/√−z.
pub(crate) fn arctangent(space: &mut Space, z: Node) -> Node {
    /// As many as |z| < 1/256 needs for 106 bits.
    const TERMS: i64 = 13;
    let dag = space.dag();
    let mut sum = dag.constant(Rational::new(1, 2 * TERMS + 1));
    for n in (0..TERMS).rev() {
        let higher = dag.mul(&[z, sum]);
        sum = dag.linear(&Rational::new(1, 2 * n + 1), &[(Rational::ONE, higher)]);
    }
    sum
}

/// The condition |z| < 1/256.
pub(crate) fn near_zero(space: &mut Space, z: Node) -> Node {
    let dag = space.dag();
    let size = dag.call(Op::Abs, &[z]);
    let bound = dag.constant(Rational::new(1, 256));
    dag.less(size, bound)
}

/// As many terms of Σ zⁿ/(2n + k)! as |z| ≤ ½ needs for 106 bits.
const TERMS: usize = 13;

impl Growth {
    /// The functions of λ and s.
    pub(crate) fn of(space: &mut Space, lambda: Node, s: Node) -> Growth {
        let sign = space.sign(lambda);
        let dag = space.dag();
        let constant = dag.as_constant(lambda).is_some();
        let square = dag.powi(s, 2);
        let z = dag.mul(&[lambda, square]);
        match sign {
            Some(0) => {
                let (half, sixth) = (Rational::new(1, 2), Rational::new(1, 6));
                let cube = dag.powi(s, 3);
                Growth {
                    c: dag.integer(1),
                    s,
                    c2: dag.scale(&half, square),
                    c3: dag.scale(&sixth, cube),
                }
            }
            Some(sign) if constant => {
                let size = if sign < 0 { dag.neg(lambda) } else { lambda };
                let root = dag.call(Op::Sqrt, &[size]);
                let angle = dag.mul(&[root, s]);
                let (even, odd) = match sign {
                    1 => (Op::Cosh, Op::Sinh),
                    _ => (Op::Cos, Op::Sin),
                };
                let c = dag.call(even, &[angle]);
                let sine = dag.call(odd, &[angle]);
                let half = dag.scale(&Rational::new(1, 2), angle);
                let half = dag.call(odd, &[half]);
                let s1 = dag.div(sine, root);
                // C − 1 = ±2 sin²(half), without cancellation.
                let c2 = dag.product(&Rational::integer(2), &[(half, 2), (size, -1)]);
                let rest = dag.sub(s1, s);
                let closed = dag.div(rest, lambda);
                let series = Growth::series(space, z, 3);
                let cube = space.dag().powi(s, 3);
                let series = space.dag().mul(&[cube, series]);
                let c3 = Growth::where_small(space, z, series, closed);
                Growth { c, s: s1, c2, c3 }
            }
            _ => {
                let dag = space.dag();
                let minus = dag.neg(z);
                let (up, down) = (dag.call(Op::Sqrt, &[z]), dag.call(Op::Sqrt, &[minus]));
                let zero = dag.integer(0);
                let grows = dag.less(zero, z);
                let pair = |dag: &mut crate::dag::Dag, a: Op, b: Op| {
                    let (a, b) = (dag.call(a, &[up]), dag.call(b, &[down]));
                    (a, b)
                };
                let (cosh, cos) = pair(dag, Op::Cosh, Op::Cos);
                let (sinh, sin) = pair(dag, Op::Sinh, Op::Sin);
                let (sinh, sin) = (dag.div(sinh, up), dag.div(sin, down));
                let c = dag.select(grows, cosh, cos);
                let s1 = dag.select(grows, sinh, sin);
                let one = dag.integer(1);
                let (less_c, less_s) = (dag.sub(c, one), dag.sub(s1, one));
                let (far2, far3) = (dag.div(less_c, z), dag.div(less_s, z));
                let (near2, near3) = (Growth::series(space, z, 2), Growth::series(space, z, 3));
                let c2 = Growth::where_small(space, z, near2, far2);
                let c3 = Growth::where_small(space, z, near3, far3);
                let dag = space.dag();
                let (zc2, zc3) = (dag.mul(&[z, c2]), dag.mul(&[z, c3]));
                let (near_c, near_s) = (dag.add(&[one, zc2]), dag.add(&[one, zc3]));
                let c = Growth::where_small(space, z, near_c, c);
                let s1 = Growth::where_small(space, z, near_s, s1);
                let dag = space.dag();
                Growth {
                    c,
                    s: dag.mul(&[s, s1]),
                    c2: dag.product(&Rational::ONE, &[(s, 2), (c2, 1)]),
                    c3: dag.product(&Rational::ONE, &[(s, 3), (c3, 1)]),
                }
            }
        }
    }

    /// Σ zⁿ/(2n + k)!, k = 2 or 3
    fn series(space: &mut Space, z: Node, k: usize) -> Node {
        /// 1/n!, n = 0, 1, … 2·TERMS + 3
        static TERMS_OF_EXP: LazyLock<Vec<Rational>> = LazyLock::new(|| {
            let mut terms = vec![Rational::ONE];
            for n in 1..=2 * TERMS as i64 + 3 {
                let next = Rational::new(1, n).mul(&terms[terms.len() - 1]);
                terms.push(next);
            }
            terms
        });
        let dag = space.dag();
        let mut sum = dag.constant(TERMS_OF_EXP[2 * TERMS + k].clone());
        for n in (0..TERMS).rev() {
            let term = &TERMS_OF_EXP[2 * n + k];
            let higher = dag.mul(&[z, sum]);
            sum = dag.linear(term, &[(Rational::ONE, higher)]);
        }
        sum
    }

    /// The first where |z| < ½, the second elsewhere.
    fn where_small(space: &mut Space, z: Node, near: Node, far: Node) -> Node {
        let dag = space.dag();
        let size = dag.call(Op::Abs, &[z]);
        let half = dag.constant(Rational::new(1, 2));
        let is_small = dag.less(size, half);
        dag.select(is_small, near, far)
    }
}
