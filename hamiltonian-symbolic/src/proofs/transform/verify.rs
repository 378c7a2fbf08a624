//! Checks that a system in new coordinates is the system it was.
//!
//! Input: a [`Transformed`]. Output: nothing, or the point where they differ. Invariant: the points
//! are the same on every machine; agreement at points is no proof. The check looks for a slip
//! of the engine, which any point shows.

use super::NoTransform;
use super::charts::NumberRange;
use super::coordinates::Transformed;
use super::layout::Slot;
use crate::algebra::ball::Ball;
use crate::dag::{Node, Side};
use crate::index::Affine;
use crate::loops::{self, Sample, Signs, next_random};
use crate::model::{Model, VectorEntry};
use crate::normal_form::trials;

/// The number of points that [`check`] compares at certain sizes,
const POINTS: usize = 3;
/// of how many it tries for that.
const TRIES: u64 = 9;
/// At how many choices of sizes.
const CHOICES: usize = 2;
/// The largest difference it passes, relative to H or to 1.
const CLOSE: f64 = 1e-8;

/// Checks that H and the observables of the new model are those of the old one: K(Q, P, t) and
/// H(q(Q), p(Q, P), t) at pseudo-random points of the chart, to eight digits. Sizes are such that
/// every index is in range. Points outside the domain of H are passed over for others; so are those
/// where rounding leaves fewer digits, though as many as there are must agree. At how many points H
/// was compared is the answer.
///
/// # Errors
/// [`NoTransform::Unverified`] with the first point where they differ; [`NoTransform::Uncompared`] where
/// there is no point to compare at.
pub fn check(transformed: &Transformed) -> Result<usize, NoTransform> {
    let old_roots = transformed.source.functions();
    let old = &*transformed.source.with_rooms(&old_roots);
    let fitting = trials(old, &old_roots).into_iter();
    let fitting = fitting
        .filter(|sizes| sizes.is_empty() || loops::unroll_nodes(old, sizes, &old_roots).is_ok())
        .take(CHOICES);
    let mut compared = None;
    for sizes in fitting {
        *compared.get_or_insert(0) += check_at(transformed, &old_roots, &sizes)?;
    }
    let reason = match compared {
        Some(points @ 1..) => return Ok(points),
        Some(0) => "H has no value at any of the points tried, which are up to 9000 from 0",
        None => "no sizes were found at which every index is in range",
    };
    Err(NoTransform::Uncompared { reason })
}

/// The number of points that were compared at these sizes.
fn check_at(
    transformed: &Transformed,
    old_roots: &[Node],
    sizes: &[i64],
) -> Result<usize, NoTransform> {
    let mut old = transformed.source.clone();
    let mut new = transformed.model.clone();
    let inverse = at_sizes(&mut new, &transformed.inverse, sizes);
    let new_roots = new.functions();
    let new_slots = slots(&new, sizes);
    // To all the digits asked for, and to fewer.
    let (mut compared, mut roughly) = (0, 0);
    // Parameters are negative where H has values for such, too.
    let positive = (1..=TRIES).map(|seed| (seed, Signs::default()));
    let negative = (2..).zip(Signs::negative().take(POINTS - 1));
    let tries = positive
        .clone()
        .take(1)
        .chain(negative)
        .chain(positive.skip(1));
    for (seed, signs) in tries {
        if compared == POINTS {
            break;
        }
        let how = Sample {
            seed,
            signs,
            ..Sample::default()
        };
        let mut random = seed;
        let mut given: Vec<(Node, Ball)> = Vec::new();
        // If H has no value at the first points it may have one further out or in.
        let further = seed.saturating_sub(POINTS as u64) as i32;
        let scale = 4f64.powi(if further % 2 == 0 { further } else { -further });
        for &(side, slot) in &new_slots {
            let node = slot.node(&mut new.dag, side);
            // Between 1/4 and 9/4: inside every chart as it is. Variables of any value are of either sign.
            let size = 0.25 + 2.0 * fraction(&mut random);
            let flip = fraction(&mut random) < 0.5;
            let mut bounded = transformed.bounded.iter();
            let values = bounded.find(|(of, _)| side == Side::Q && *of == slot);
            let value = match values.map_or(NumberRange::All, |(_, values)| *values) {
                NumberRange::HalfTurn => size,
                NumberRange::Positive => scale * size,
                NumberRange::All if flip => -scale * size,
                NumberRange::All => scale * size,
            };
            given.push((node, Ball::exact(value)));
        }
        let mut all = new_roots.clone();
        all.extend(inverse.iter().map(|entry| entry.value));
        let Some((values, point)) = loops::sample(&new, &all, sizes, how, &given) else {
            continue;
        };
        let mut old_given: Vec<(Node, Ball)> = Vec::new();
        for (entry, value) in inverse.iter().zip(&values[new_roots.len()..]) {
            let node = old.dag.phase(entry.at, entry.row.clone());
            old_given.push((node, *value));
        }
        for (&(side, slot), (_, value)) in new_slots.iter().zip(&given) {
            if let Some((group, _)) = transformed.kept.iter().find(|(_, to)| *to == slot.group) {
                let group = *group;
                let node = Slot { group, ..slot }.node(&mut old.dag, side);
                old_given.push((node, *value));
            }
        }
        let Some((expected, _)) = loops::sample(&old, old_roots, sizes, how, &old_given) else {
            continue;
        };
        for (at, (a, b)) in expected.iter().zip(&values).enumerate() {
            let close = CLOSE * a.value.abs().max(b.value.abs()).max(1.0);
            let rounding = a.error + b.error;
            if !a.is_defined() || b.error.is_infinite() && b.value.is_finite() {
                continue;
            }
            // The first one is H.
            if at == 0 {
                let count = if rounding > close {
                    &mut roughly
                } else {
                    &mut compared
                };
                *count += 1;
            }
            // A value that is none is not the same.
            if !b.is_defined() || a.differs(*b) {
                return Err(NoTransform::Unverified {
                    point,
                    old: a.value,
                    new: b.value,
                });
            }
        }
    }
    Ok(if compared > 0 { compared } else { roughly })
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
                row: entry.row.substitute(|_| at.clone()),
                value: model.dag.replace(entry.value, domain, &at),
                ..entry.clone()
            });
        }
    }
    all
}

/// The value of an extent.
fn extent(affine: &Affine, sizes: &[i64]) -> i64 {
    let in_loop = |domain| unreachable!("an extent reads {domain:?}");
    affine.value(&in_loop, &|size| sizes[usize::from(size.0)])
}

/// All scalar places of a model at the given sizes.
fn slots(model: &Model, sizes: &[i64]) -> Vec<(Side, Slot)> {
    let extent = |affine: &Affine| extent(affine, sizes);
    let mut all = Vec::new();
    for (number, group) in model.groups.iter().enumerate() {
        let rows = group.shape.rows().map_or(1, extent);
        for side in [Side::Q, Side::P] {
            for column in 0..group.shape.columns() {
                for row in 0..rows {
                    let slot = Slot {
                        group: number as u16,
                        row: row as u32,
                        column,
                    };
                    all.push((side, slot));
                }
            }
        }
    }
    all
}

/// The next number of a sequence in 0..1.
fn fraction(state: &mut u64) -> f64 {
    (next_random(state) >> 11) as f64 / (1u64 << 53) as f64
}
