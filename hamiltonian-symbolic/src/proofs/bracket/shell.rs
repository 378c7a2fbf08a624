//! Statements on the shell H = e.
//!
//! Input: a residual and the shell. Output: whether the residual vanishes on the shell, or a point
//! of the shell where it does not. Invariant: a polynomial vanishes on the shell if, after
//! multiplication with the leading coefficient in some momentum, it is a multiple of H − e. Assumes a
//! leading coefficient that is 0 nowhere where H has a value, for no parameters: on a part of the
//! shell where it is 0, the residual may be anything.

use crate::algebra::ball::Ball;
use crate::dag::{Array, Column, Dag, Kind, Node, Side, Sign};
use crate::list::IntoList;
use crate::loops::{Sample, SamplePoint, Signs, sample};
use crate::model::Model;
use crate::normal_form::{Algebra, Atom, Key, Monomial, Poly, Undecided};
use crate::sort::Arrange;

/// Returns true if the residual vanishes where `shell` does.
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
    let written = algebra.convert(dag, shell)?;
    let shell = algebra.numerator(&written)?;
    // The momentum of lowest degree is eliminated; one is enough.
    let mut momenta: Vec<(i32, Atom)> = Vec::new();
    for atom in shell.atoms() {
        let is_momentum = match algebra.entry(atom).key {
            Key::Leaf(node) => matches!(
                dag.kind(node),
                Kind::Element(Array::Phase(Column { side: Side::P, .. }), ..)
            ),
            _ => false,
        };
        let powers = shell.by_power(atom);
        if let (true, Some((degree @ 1.., leading))) = (is_momentum, powers.last())
            && powers[0].0 >= 0
            && !leading.is_zero()
            && !algebra.is_mentioned(&shell, atom)
            && !algebra.is_mentioned(&residual, atom)
            && is_never_zero(algebra, leading, &written)?
        {
            momenta.push((*degree, atom));
        }
    }
    momenta.arrange();
    let Some((_, atom)) = momenta.first().copied() else {
        return Ok(false);
    };
    Ok(remainder(algebra, &residual, &shell, atom)?.is_zero())
}

/// Returns true if a polynomial is a product of factors that are positive, or that H divides by: a number, a
/// positive polynomial, what stands below a fraction line of H as it is `written`.
fn is_never_zero(algebra: &mut Algebra, poly: &Poly, written: &Poly) -> Result<bool, Undecided> {
    let below: Vec<Atom> = written
        .terms()
        .iter()
        .flat_map(|(m, _)| &m.0)
        .filter(|(_, n)| *n < 0)
        .map(|(atom, _)| *atom)
        .into_list();
    let (k, monomial, mut rest) = algebra.content(poly)?;
    if k.is_zero() {
        return Ok(false);
    }
    for &atom in &below {
        // A divisor of H, and a power of it in the normal form.
        let entry = algebra.entry(atom);
        let relation = entry.relation.as_ref().map(|(_, power)| power.as_ref());
        let factor = match &entry.key {
            Key::Divisor(divisor) => Some(divisor),
            _ => relation,
        };
        if let Some(factor) = factor.cloned() {
            while let Some(quotient) = algebra.quotient(&rest, &factor)? {
                rest = quotient;
            }
        }
    }
    let sign = algebra.sign_of(&rest);
    let is_factor = |(atom, _): &(Atom, i32)| {
        algebra.entry(*atom).sign == Sign::POSITIVE || below.contains(atom)
    };
    let is_one_sign =
        rest.as_constant().is_some() || matches!(sign, Sign::POSITIVE | Sign::NEGATIVE);
    Ok(is_one_sign && monomial.0.iter().all(is_factor))
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

/// A point with `shell` = 0 where the residual is certainly not. The shell is solved for momenta, and
/// where these lead to no such point, as p does not from q·p = 0, for coordinates.
pub(super) fn witness(
    model: &Model,
    residual: Node,
    shell: Node,
    others: &[Node],
) -> Option<(SamplePoint, f64)> {
    let below = model.dag.reachable(&[shell]);
    let of_side = |wanted: Side| -> Vec<Node> {
        let is_wanted = |node: &&Node| match model.dag.kind(**node) {
            Kind::Element(Array::Phase(Column { side, .. }), ..) => *side == wanted,
            _ => false,
        };
        below.iter().filter(is_wanted).copied().into_list()
    };
    let mut sides = [Side::P, Side::Q].into_iter();
    sides.find_map(|side| solved(model, residual, shell, others, &of_side(side)))
}

/// A witness among points at which the shell is solved for one of some variables.
fn solved(
    model: &Model,
    residual: Node,
    shell: Node,
    others: &[Node],
    variables: &[Node],
) -> Option<(SamplePoint, f64)> {
    let mut all = vec![shell, residual];
    all.extend(others);
    let positive = (0..6).map(|seed| Sample {
        seed,
        signed: seed % 2 == 1,
        ..Sample::default()
    });
    // The shell need not have a point at each.
    let twice = Signs::negative().chain(Signs::negative());
    let negative = (0..).zip(twice).map(|(seed, signs)| Sample {
        seed,
        signed: true,
        signs,
        ..Sample::default()
    });
    // Two points are enough where parameters are positive, and where they are not.
    let mut found = [0; 2];
    for how in positive.chain(negative) {
        let found = &mut found[usize::from(how.signs != Signs::default())];
        if *found == 2 {
            continue;
        }
        for &variable in variables {
            let at =
                |roots: &[Node], value: Ball| sample(model, roots, &[], how, &[(variable, value)]);
            let shell_at = |p: f64| {
                let found = at(&[shell], Ball::exact(p));
                found.map_or(Ball::exact(f64::NAN), |(values, _)| values[0])
            };
            let Some(root) = solve(|p| shell_at(p).value) else {
                continue;
            };
            // Between these ends H has a value everywhere, and no jump or pole: it is one of a shell at a
            // point between them.
            let off = 1e-9 * (1.0 + root.abs());
            let near = Ball {
                value: root,
                error: off,
            };
            let (values, point) = at(&all, near)?;
            let [below, above] = [root - off, root + off].map(shell_at);
            let is_met = below.is_nonzero()
                && above.is_nonzero()
                && (below.value < 0.0) != (above.value < 0.0);
            if !(is_met && values.iter().all(|value| value.is_defined())) {
                continue;
            }
            // The residual is not 0 anywhere between them.
            if values[1].is_nonzero() {
                return Some((point, values[1].value));
            }
            *found += 1;
            break;
        }
    }
    None
}

/// A zero by false position (the Illinois variant) between two of a range of points.
fn solve(f: impl Fn(f64) -> f64) -> Option<f64> {
    let mut last: Option<(f64, f64)> = None;
    for x in (-12..=12).map(|n| f64::from(n) + 0.015625) {
        let value = f(x);
        match last {
            Some((a, at_a)) if at_a * value < 0.0 => {
                return Some(false_position(&f, (a, at_a), (x, value)));
            }
            _ => last = Some((x, value)),
        }
    }
    None
}

fn false_position(f: &impl Fn(f64) -> f64, mut a: (f64, f64), mut b: (f64, f64)) -> f64 {
    let mut x = a.0;
    for _ in 0..60 {
        let next = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        if (next - x).abs() <= 1e-13 * (1.0 + x.abs()) {
            return next;
        }
        x = next;
        let value = f(x);
        if value * b.1 < 0.0 {
            a = b;
        } else {
            // The end that stays is drawn in, so that neither stays for long.
            a.1 *= 0.5;
        }
        b = (x, value);
    }
    x
}
