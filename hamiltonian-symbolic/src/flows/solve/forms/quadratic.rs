//! ½zᵀAz + gᵀz of the pairs it stands with, coefficients of parameters: ż = Mz + b, M = JA.
//!
//! Input: h and s. Output: [`Motion`]. Invariant: M² = λ, M³ = λM or M⁴ = λM² is proven, so that
//! e^{sM} = 1 + sM + c₂M² + c₃M³ is closed for every sign of λ.

use crate::algebra::ball::Ball;
use crate::dag::{Dependence, Node};
use crate::flows::solve::growth::Growth;
use crate::flows::space::{Space, Variable, Variables};
use crate::list::IntoList;
use crate::model::Motion;
use crate::rational::Rational;

/// The most pairs of one form.
const PAIRS: usize = 4;

type Matrix = Vec<Vec<Node>>;

pub(super) fn solve(space: &mut Space, h: Node, s: Node) -> Option<Motion> {
    let set = space.set(h);
    let pairs = set.pairs();
    if pairs.len() > PAIRS || space.active(h).is_empty() {
        return None;
    }
    // z = (q, p): row i moves by the derivative along its conjugate.
    let leaves = |side: usize| pairs.iter().map(move |pair| Variable::pair(*pair)[side]);
    let z = leaves(0).chain(leaves(1));
    let z: Vec<Node> = z.map(|one| space.variable(one)).into_list();
    let (a, g) = coefficients(space, h, set, &z)?;
    let n = pairs.len();
    let turned = |i: usize| if i < n { i + n } else { i - n };
    let signed = |space: &mut Space, i: usize, node: Node| match i < n {
        true => node,
        false => space.dag().neg(node),
    };
    let m: Matrix = (0..2 * n)
        .map(|i| {
            (0..2 * n)
                .map(|j| signed(space, i, a[turned(i)][j]))
                .into_list()
        })
        .into_list();
    let b: Vec<Node> = (0..2 * n)
        .map(|i| signed(space, i, g[turned(i)]))
        .into_list();
    let (flow, shift) = exponential(space, &m, &b, s)?;
    let mut motion = Motion::default();
    for i in 0..2 * n {
        let mut terms: Vec<Node> = Vec::new();
        for (parts, vector) in [(&flow, &z), (&shift, &b)] {
            for j in 0..2 * n {
                let dag = space.dag();
                let entry: Vec<Node> = parts
                    .iter()
                    .map(|(weight, power)| dag.mul(&[*weight, power[i][j]]))
                    .into_list();
                let entry = dag.add(&entry);
                terms.push(dag.mul(&[entry, vector[j]]));
            }
        }
        let value = space.dag().add(&terms);
        motion.add(space.dag(), z[i], value);
    }
    Some(motion)
}

/// Returns true if numbers along a line say that h is no polynomial of second degree.
fn is_steeper(space: &mut Space, h: Node) -> bool {
    let set = space.set(h);
    let [a, b, c, d] = [0.0, 1.0, 2.0, 3.0].map(|step| {
        let point = space.point_off(&[(set, step)]);
        space.value_at(h, &point)
    });
    let three = Ball::exact(3.0);
    (d + three * b).differs(a + three * c)
}

/// A and g, if h = ½·zᵀAz + gᵀz + constant.
fn coefficients(
    space: &mut Space,
    h: Node,
    set: Variables,
    z: &[Node],
) -> Option<(Matrix, Vec<Node>)> {
    if is_steeper(space, h) {
        return None;
    }
    let mut a: Matrix = Vec::new();
    for &x in z {
        let slope = space.d(h, x);
        let mut row = Vec::new();
        for &y in z {
            let second = space.d(slope, y);
            row.push(space.section(second, set));
        }
        a.push(row);
    }
    let mut g = Vec::new();
    let mut form = Vec::new();
    for (i, &x) in z.iter().enumerate() {
        let slope = space.d(h, x);
        let products: Vec<Node> = z
            .iter()
            .zip(&a[i])
            .map(|(y, k)| space.dag().mul(&[*k, *y]))
            .into_list();
        let linear = space.dag().add(&products);
        let rest = space.dag().sub(slope, linear);
        // A difference that cancels is 0, and is not computed.
        let rest = match space.section(rest, set) {
            rest if space.is_zero(rest) => space.dag().integer(0),
            rest => rest,
        };
        g.push(rest);
        let twice = space.dag().scale(&Rational::new(1, 2), linear);
        let both = space.dag().add(&[twice, rest]);
        form.push(space.dag().mul(&[x, both]));
    }
    let form = space.dag().add(&form);
    let rest = space.dag().sub(h, form);
    let constant = space.section(rest, set);
    space.same(rest, constant).then_some((a, g))
}

fn product(space: &mut Space, a: &Matrix, b: &Matrix) -> Matrix {
    let n = a.len();
    let mut rows = Vec::with_capacity(n);
    for row in a {
        let mut out = Vec::with_capacity(n);
        for (j, _) in row.iter().enumerate() {
            let terms: Vec<Node> = (0..n)
                .map(|k| space.dag().mul(&[row[k], b[k][j]]))
                .into_list();
            out.push(space.dag().add(&terms));
        }
        rows.push(out);
    }
    rows
}

/// λ with a = λ·b, entry by entry.
fn multiple(space: &mut Space, a: &Matrix, b: &Matrix) -> Option<Node> {
    let n = a.len();
    let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let sizes = places
        .clone()
        .map(|(i, j)| (space.value(b[i][j]).value.abs(), (i, j)));
    let (_, (i, j)) = sizes
        .filter(|(size, _)| *size > 0.0)
        .max_by(|(x, _), (y, _)| x.total_cmp(y))?;
    let lambda = space.dag().div(a[i][j], b[i][j]);
    places
        .into_iter()
        .all(|(i, j)| {
            let scaled = space.dag().mul(&[lambda, b[i][j]]);
            space.same(a[i][j], scaled)
        })
        .then_some(lambda)
}

/// Weights with the powers of M they stand at.
type Weights = Vec<(Node, Matrix)>;

/// e^{sM} − 1, and the integral of e^{sM}, which stands at b. With 1 in it a rounded matrix would make every
/// step longer or shorter by the same ε: cos² + sin² is not 1.
fn exponential(space: &mut Space, m: &Matrix, b: &[Node], s: Node) -> Option<(Weights, Weights)> {
    let n = m.len();
    let (zero, one) = (space.dag().integer(0), space.dag().integer(1));
    let unit: Matrix = (0..n)
        .map(|i| (0..n).map(|j| if i == j { one } else { zero }).into_list())
        .into_list();
    let squared = product(space, m, m);
    if let Some(lambda) = multiple(space, &squared, &unit) {
        let g = Growth::of(space, lambda, s);
        let less = space.dag().mul(&[lambda, g.c2]);
        let flow = vec![(less, unit.clone()), (g.s, m.clone())];
        return Some((flow, vec![(g.s, unit), (g.c2, m.clone())]));
    }
    let cubed = product(space, &squared, m);
    if let Some(lambda) = multiple(space, &cubed, m) {
        let g = Growth::of(space, lambda, s);
        let flow = vec![(g.s, m.clone()), (g.c2, squared.clone())];
        return Some((flow, vec![(s, unit), (g.c2, m.clone()), (g.c3, squared)]));
    }
    if !b.iter().all(|node| space.dag().is_zero(*node)) {
        return None;
    }
    let fourth = product(space, &cubed, m);
    let lambda = multiple(space, &fourth, &squared)?;
    let g = Growth::of(space, lambda, s);
    let flow = vec![(s, m.clone()), (g.c2, squared), (g.c3, cubed)];
    Some((flow, Vec::new()))
}

/// Returns true if an expression is such a form with coefficients that no time changes.
pub(crate) fn is_constant_form(space: &mut Space, h: Node) -> bool {
    !space.dag().dependence(h).on(Dependence::TIME) && is_quadratic(space, h)
}

/// Returns true if an expression is a polynomial of second degree.
pub(crate) fn is_quadratic(space: &mut Space, h: Node) -> bool {
    let set = space.set(h);
    let z: Vec<Node> = set.members().map(|one| space.variable(one)).into_list();
    coefficients(space, h, set, &z).is_some()
}
