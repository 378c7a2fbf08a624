//! Orbits to 24 digits: the extrapolated midpoint rule of Gragg, Bulirsch and Stoer with steps that shrink
//! until a kink lies in one of no length.

use super::field::Field;
use hamiltonian_lanes::{DoubleDouble as D, Real};

/// The columns of the extrapolation: order 2·COLUMNS.
const COLUMNS: usize = 9;
/// The error of a step, relative to the point.
const TOLERANCE: f64 = 1e-25;
/// The shortest step, relative to the whole: what a kink costs.
const SHORTEST: f64 = 1e-21;
/// The most steps.
const STEPS: usize = 2000;

/// Where an orbit ends.
pub struct End {
    pub z: Vec<D>,
    /// The largest component on the way.
    pub size: f64,
    /// True if something in a denominator changed its sign on the way: H has no value in between.
    pub crosses: bool,
}

/// The orbit of a field for a time; `None` where it leaves the field's domain, all bounds or patience.
pub fn follow(field: &Field, z: &[D], time: D) -> Option<End> {
    let mut z = z.to_vec();
    let mut size = largest(&z);
    let (mut done, mut step) = (D::from(0.0), time * D::from(0.25));
    let whole = time.to_f64().abs();
    let divisors = field.divisors(&z);
    let mut crosses = false;
    for _ in 0..STEPS {
        let left = time - done;
        if left.to_f64().abs() <= 1e-30 * whole {
            return Some(End { z, size, crosses });
        }
        let is_last = step.to_f64().abs() >= left.to_f64().abs();
        let h = if is_last { left } else { step };
        let (next, error) = extrapolate(field, &z, h);
        let scale = 1.0 + largest(&z);
        let ratio = error / (TOLERANCE * scale);
        let is_short = h.to_f64().abs() <= SHORTEST * whole;
        if ratio <= 1.0 || is_short && ratio.is_finite() && error < 1e-3 * scale {
            z = next;
            done = if is_last { time } else { done + h };
            size = size.max(largest(&z));
            crosses |= field.divisors(&z) != divisors;
            if size > 1e9 {
                return None;
            }
        } else if is_short {
            return None;
        }
        let factor = match ratio.is_finite() {
            true => 0.85 * ratio.max(1e-12).powf(-1.0 / (2.0 * COLUMNS as f64 - 1.0)),
            false => 0.1,
        };
        step = h * D::from(factor.clamp(0.1, 3.0));
    }
    None
}

pub fn largest(z: &[D]) -> f64 {
    z.iter().fold(0.0, |m: f64, x| m.max(x.to_f64().abs()))
}

/// A step and its error.
fn extrapolate(field: &Field, z: &[D], h: D) -> (Vec<D>, f64) {
    let mut rows: Vec<Vec<D>> = Vec::new();
    let mut error = f64::INFINITY;
    for j in 0..COLUMNS {
        let n = 2 * (j + 1);
        let mut row = vec![midpoint(field, z, h, n)];
        for k in 0..j {
            let below = 2.0 * (j - k) as f64;
            let weight = D::from((n * n) as f64) / D::from(below * below) - D::from(1.0);
            let (finer, coarser): (&Vec<D>, &[D]) = (&row[k], &rows[k]);
            let next = finer
                .iter()
                .zip(coarser)
                .map(|(a, b)| *a + (*a - *b) / weight);
            row.push(next.collect());
        }
        if j > 0 {
            let pairs = row[j].iter().zip(&row[j - 1]);
            error = pairs.fold(0.0, |m: f64, (a, b)| {
                let off = (*a - *b).to_f64().abs();
                if off.is_nan() { f64::NAN } else { m.max(off) }
            });
        }
        rows = row;
    }
    (rows.pop().unwrap_or_default(), error)
}

fn midpoint(field: &Field, z: &[D], h: D, n: usize) -> Vec<D> {
    let h = h / D::from(n as f64);
    let plus =
        |z: &[D], h: D, v: &[D]| -> Vec<D> { z.iter().zip(v).map(|(z, v)| *z + h * *v).collect() };
    let mut before = z.to_vec();
    let mut now = plus(z, h, &field.at(z).1);
    for _ in 1..n {
        let next = plus(&before, h + h, &field.at(&now).1);
        before = std::mem::replace(&mut now, next);
    }
    let ahead = plus(&before, h, &field.at(&now).1);
    let half = D::from(0.5);
    now.iter()
        .zip(&ahead)
        .map(|(a, b)| half * (*a + *b))
        .collect()
}
