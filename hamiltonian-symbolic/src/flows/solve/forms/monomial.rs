//! c·xᵃyᵇ: w = c·x^{a−1}y^{b−1}, u = 1 + (b−a)·w·s; x·u^{b/(b−a)}, y·u^{−a/(b−a)}, and for a = b
//! x·e^{aws}, y·e^{−aws}.
//!
//! Input: K and s. Output: [`Moved`]. Invariant: a and b are integers other than 0, and u > 0:
//! past u = 0 the formula stays finite and symplectic, and is wrong.

use super::{Axes, Moved, power};
use crate::dag::Node;
use crate::flows::space::Space;
use crate::op::Op;
use crate::rational::Rational;

pub(super) fn solve(space: &mut Space, axes: Axes, k: Node, s: Node) -> Option<Moved> {
    let y = axes.y(space);
    let (kx, ky) = (space.d(k, axes.x), axes.dy(space, k));
    let (xkx, yky) = (space.dag().mul(&[axes.x, kx]), space.dag().mul(&[y, ky]));
    let a = space.ratio(xkx, k)?;
    let b = space.ratio(yky, k)?;
    if a == 0 || b == 0 {
        return None;
    }
    let bare = space
        .dag()
        .product(&Rational::ONE, &[(k, 1), (axes.x, -a), (y, -b)]);
    let set = space.set(axes.x) | space.set(y);
    let c = space.free(bare, set)?;
    let dag = space.dag();
    let ws = dag.product(
        &Rational::ONE,
        &[(s, 1), (c, 1), (axes.x, a - 1), (y, b - 1)],
    );
    if a == b {
        let angle = dag.scale(&Rational::integer(i64::from(a)), ws);
        let grown = dag.call(Op::Exp, &[angle]);
        return Some(Moved {
            x: dag.mul(&[axes.x, grown]),
            y: dag.div(y, grown),
            domain: Vec::new(),
        });
    }
    let rate = Rational::integer(i64::from(b - a));
    let u = dag.linear(&Rational::ONE, &[(rate, ws)]);
    let (grown, shrunk) = (power(space, u, b, b - a), power(space, u, -a, b - a));
    Some(Moved {
        x: space.dag().mul(&[axes.x, grown]),
        y: space.dag().mul(&[y, shrunk]),
        domain: vec![u],
    })
}
