//! Whether a system in new coordinates is the system it was.
//!
//! Input: a [`Transformed`]. Output: nothing, or the point where they differ. Invariant: the points
//! are the same on every machine; agreement at points is no proof, and what is looked for is a slip
//! of the engine, which any point shows.

use super::coordinates::Transformed;
use super::layout::Slot;
use super::{Refusal, element};
use crate::dag::{Array, Node, Side};
use crate::index::Affine;
use crate::loops::{self, Sample};
use crate::model::{Model, Shape, VectorEntry};

/// How many points [`check`] takes.
const POINTS: u64 = 3;
/// The largest difference it passes, relative to H or to 1.
const CLOSE: f64 = 1e-8;

/// Whether H and the observables of the new model are those of the old one: K(Q, P, t) and
/// H(q(Q), p(Q, P), t) at pseudo-random points of the chart, to eight digits. Points outside the
/// domain of H are passed over.
///
/// # Errors
/// [`Refusal::Unverified`] with the first point where they differ.
pub fn check(transformed: &Transformed) -> Result<(), Refusal> {
    let mut old = transformed.source.clone();
    let mut new = transformed.model.clone();
    let sizes: Vec<i64> = (3..).take(old.sizes.len()).collect();
    let inverse = at_sizes(&mut new, &transformed.inverse, &sizes);
    let roots = |model: &Model| -> Vec<Node> {
        let mut roots: Vec<Node> = model.hamiltonian.into_iter().collect();
        for observable in &model.observables {
            roots.extend(&observable.components);
        }
        roots
    };
    let (old_roots, new_roots) = (roots(&old), roots(&new));
    let new_slots = slots(&new, &sizes);
    for seed in 1..=POINTS {
        let how = Sample {
            seed,
            ..Sample::default()
        };
        let mut random = seed;
        let mut given: Vec<(Node, f64)> = Vec::new();
        for &(side, slot) in &new_slots {
            let node = element(&mut new.dag, side, slot.group, slot.row, slot.column);
            // Between 1/4 and 9/4: inside every chart as it is; what need not be positive is of
            // either sign. A sine that must be positive is that of the second coordinate.
            let size = 0.25 + 2.0 * fraction(&mut random);
            let flip = fraction(&mut random) < 0.5;
            let name = &new.groups[usize::from(slot.group)].coordinate;
            let bounded = side == Side::Q && (name == "r" || name == "theta");
            given.push((node, if flip && !bounded { -size } else { size }));
        }
        let mut all = new_roots.clone();
        all.extend(inverse.iter().map(|entry| entry.value));
        let Some((values, point)) = loops::sample(&new, &all, &sizes, how, &given) else {
            continue;
        };
        let mut old_given: Vec<(Node, f64)> = Vec::new();
        for (entry, value) in inverse.iter().zip(&values[new_roots.len()..]) {
            let array = Array::Phase {
                side: entry.side,
                group: entry.group,
                column: entry.column,
            };
            let node = old.dag.element(array, entry.row.clone(), None);
            old_given.push((node, value.value));
        }
        for (&(side, slot), (_, value)) in new_slots.iter().zip(&given) {
            if let Some((group, _)) = transformed.kept.iter().find(|(_, to)| *to == slot.group) {
                let node = element(&mut old.dag, side, *group, slot.row, slot.column);
                old_given.push((node, *value));
            }
        }
        let Some((expected, _)) = loops::sample(&old, &old_roots, &sizes, how, &old_given) else {
            continue;
        };
        for (a, b) in expected.iter().zip(&values) {
            // The bounds of the rounding errors do not know that the arguments are rounded too.
            let rounding = 1e4 * (a.error + b.error).min(CLOSE);
            let tolerance = CLOSE * a.value.abs().max(b.value.abs()).max(1.0) + rounding;
            let close = (a.value - b.value).abs() <= tolerance;
            if a.value.is_finite() && !close {
                return Err(Refusal::Unverified {
                    point,
                    old: a.value,
                    new: b.value,
                });
            }
        }
    }
    Ok(())
}

/// The entries with their loops run at the given sizes.
fn at_sizes(model: &mut Model, entries: &[VectorEntry], sizes: &[i64]) -> Vec<VectorEntry> {
    let mut all = Vec::new();
    for entry in entries {
        let Some(domain) = model.dag.deepest(entry.row.variables()) else {
            all.push(entry.clone());
            continue;
        };
        let range = model.dag.range(domain).clone();
        for at in extent(&range.start, sizes)..extent(&range.end, sizes) {
            let at = Affine::constant(at);
            all.push(VectorEntry {
                row: entry.row.substitute(&|_| at.clone()),
                value: model.dag.replace(entry.value, domain, &at),
                ..entry.clone()
            });
        }
    }
    all
}

/// The value of an extent.
fn extent(affine: &Affine, sizes: &[i64]) -> i64 {
    affine.value(&|_| 0, &|size| {
        sizes.get(usize::from(size.0)).copied().unwrap_or(0)
    })
}

/// All scalar places of a model at the given sizes.
fn slots(model: &Model, sizes: &[i64]) -> Vec<(Side, Slot)> {
    let extent = |affine: &Affine| extent(affine, sizes);
    let mut all = Vec::new();
    for (number, group) in model.groups.iter().enumerate() {
        let (rows, columns) = match &group.shape {
            Shape::Scalar => (1, 1),
            Shape::Vector(rows) => (extent(rows), 1),
            Shape::Matrix(rows, columns) => (extent(rows), extent(columns)),
        };
        for side in [Side::Q, Side::P] {
            for column in 0..columns {
                for row in 0..rows {
                    let slot = Slot {
                        group: number as u16,
                        row: row as u32,
                        column: column as u16,
                    };
                    all.push((side, slot));
                }
            }
        }
    }
    all
}

/// The next number of a sequence in 0..1 (SplitMix64: Steele, Lea & Flood 2014).
fn fraction(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    (bits >> 11) as f64 / (1u64 << 53) as f64
}
