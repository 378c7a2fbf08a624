//! Statements on the shell H = e.
//!
//! Input: a residual and the shell. Output: whether the residual vanishes on the shell, or a point
//! of the shell where it does not. Invariant: a polynomial vanishes on the shell if, after
//! multiplication with the leading coefficient in some momentum, it is a multiple of H − e.

use crate::dag::{Array, Dag, Kind, Node, Side};
use crate::loops::{Point, Sample, sample};
use crate::model::Model;
use crate::normal_form::{Algebra, Atom, Key, Monomial, Poly, Undecided};

/// Whether the residual vanishes where `shell` does.
pub(super) fn vanishes(
    algebra: &mut Algebra,
    dag: &Dag,
    residual: Node,
    shell: Node,
) -> Result<bool, Undecided> {
    let residual = algebra.convert(dag, residual)?;
    let residual = algebra.numerator(&residual)?;
    if residual.is_zero() {
        return Ok(true);
    }
    let shell = algebra.convert(dag, shell)?;
    let shell = algebra.numerator(&shell)?;
    // The momentum of lowest degree is eliminated; one is enough.
    let mut momenta: Vec<(i32, Atom)> = Vec::new();
    for atom in shell.atoms() {
        let is_momentum = match algebra.entry(atom).key {
            Key::Leaf(node) => matches!(
                dag.kind(node),
                Kind::Element(Array::Phase { side: Side::P, .. }, ..)
            ),
            _ => false,
        };
        let powers = shell.by_power(atom);
        if let (true, Some((degree @ 1.., leading))) = (is_momentum, powers.last()) {
            if powers[0].0 >= 0
                && !leading.is_zero()
                && !mentions(algebra, &shell, atom)
                && !mentions(algebra, &residual, atom)
            {
                momenta.push((*degree, atom));
            }
        }
    }
    momenta.sort_unstable();
    let Some((_, atom)) = momenta.first().copied() else {
        return Ok(false);
    };
    Ok(remainder(algebra, &residual, &shell, atom)?.is_zero())
}

/// Whether an atom stands inside another one.
fn mentions(algebra: &Algebra, poly: &Poly, atom: Atom) -> bool {
    let mut stack: Vec<Atom> = poly.atoms();
    stack.retain(|a| *a != atom);
    let mut seen: Vec<Atom> = Vec::new();
    while let Some(at) = stack.pop() {
        if at == atom {
            return true;
        }
        if seen.contains(&at) {
            continue;
        }
        seen.push(at);
        stack.extend(algebra.parts(at));
    }
    false
}

/// The pseudo-remainder of the division by `shell` as polynomials in one atom.
fn remainder(
    algebra: &mut Algebra,
    dividend: &Poly,
    shell: &Poly,
    atom: Atom,
) -> Result<Poly, Undecided> {
    let powers = shell.by_power(atom);
    let Some((degree, leading)) = powers.last().cloned() else {
        return Ok(dividend.clone());
    };
    let mut rest = dividend.clone();
    loop {
        let Some((top, coefficient)) = rest.by_power(atom).last().cloned() else {
            return Ok(rest);
        };
        if top < degree {
            return Ok(rest);
        }
        let raised = shell.times(&Monomial::atom(atom, top - degree));
        let (a, b) = (
            algebra.mul(&rest, &leading)?,
            algebra.mul(&raised, &coefficient)?,
        );
        // The highest power cancels exactly; relations may lower others.
        rest = algebra.numerator(&a.sub(&b))?;
    }
}

/// A point with `shell` = 0 where the residual is certainly not.
pub(super) fn witness(model: &Model, residual: Node, shell: Node) -> Option<(Point, f64)> {
    let momenta: Vec<Node> = model
        .dag
        .reachable(&[shell])
        .into_iter()
        .filter(|n| {
            matches!(
                model.dag.kind(*n),
                Kind::Element(Array::Phase { side: Side::P, .. }, ..)
            )
        })
        .collect();
    for seed in 0..6 {
        let how = Sample {
            seed,
            signed: seed % 2 == 1,
            ..Sample::default()
        };
        for &momentum in &momenta {
            let at = |value: f64| sample(model, &[shell, residual], &[], how, &[(momentum, value)]);
            let Some(root) = solve(|p| at(p).map_or(f64::NAN, |(values, _)| values[0].value))
            else {
                continue;
            };
            let (values, point) = at(root)?;
            // How much the residual changes over the distance the root may be off.
            let off = 1e-9 * (1.0 + root.abs());
            let (above, below) = (at(root + off)?.0[1], at(root - off)?.0[1]);
            let change = (above.value - below.value).abs();
            if values[1].is_nonzero() && values[1].value.abs() > 16.0 * (change + values[1].error) {
                return Some((point, values[1].value));
            }
        }
    }
    None
}

/// A zero by bisection between two of a range of points.
fn solve(f: impl Fn(f64) -> f64) -> Option<f64> {
    let points = (-32..=32).map(|n| f64::from(n) * 0.25 + 0.015625);
    let mut last: Option<(f64, f64)> = None;
    for x in points {
        let value = f(x);
        if let Some((a, at_a)) = last {
            if at_a.is_finite() && value.is_finite() && at_a.signum() != value.signum() {
                let (mut low, mut high) = (a, x);
                for _ in 0..80 {
                    let middle = 0.5 * (low + high);
                    if f(middle).signum() == at_a.signum() {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                return Some(0.5 * (low + high));
            }
        }
        last = Some((x, value));
    }
    None
}
