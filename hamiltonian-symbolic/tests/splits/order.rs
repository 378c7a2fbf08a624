//! Pieces composed by their programs: the order of a composition, and rounding.

use super::table::{FOUND, Found};
use crate::common;
use hamiltonian_lanes::{DoubleDouble, Real};
use hamiltonian_symbolic::dag::{Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use hamiltonian_symbolic::split::find;

#[test]
fn compositions_of_programs_converge() {
    for found in FOUND {
        // The point of the last is too far out for its A(q) at these steps.
        let Some(slope) = slope(found) else {
            continue;
        };
        assert!((slope - 2.0).abs() < 0.05, "{}: {slope}", found.h);
    }
}

/// The slope of the composition of second order, run by the programs of its pieces: what the last
/// two of three halvings of the step change; `None` for one piece, which is exact.
fn slope(found: &Found) -> Option<f64> {
    let mut model = common::system(found.signature, "", found.parameters, found.h);
    model.pieces = find(&mut model).unwrap().pieces;
    let count = model.pieces.len();
    let wanted: Vec<Purpose> = (0..count).map(|n| Purpose::Piece(n as u16)).collect();
    let program = derive(&mut model, &wanted).unwrap();
    let n = model.groups.len();
    let end = |steps: u32| {
        let mut point = Point::<DoubleDouble>::new();
        point.scalars = model
            .parameters
            .iter()
            .enumerate()
            .map(|(at, _)| DoubleDouble::from(0.4 + 0.3 * at as f64))
            .collect();
        for group in 0..n {
            for (side, value) in [
                (Side::Q, 2.9 - 0.8 * group as f64),
                (Side::P, 0.3 + 0.2 * group as f64),
            ] {
                let target = Target::Phase(Column {
                    side,
                    group: group as u16,
                    column: 0,
                });
                point
                    .outputs
                    .insert(target, vec![vec![DoubleDouble::from(value)]]);
            }
        }
        let h = DoubleDouble::from(0.03125) / DoubleDouble::from(f64::from(steps));
        let half = h * DoubleDouble::from(0.5);
        for _ in 0..steps {
            let down = (0..count - 1).map(|at| (at, half));
            let up = (0..count - 1).rev().map(|at| (at, half));
            for (at, c) in down.chain([(count - 1, h)]).chain(up) {
                point.c = c;
                point.outputs = run(&program, &program.functions[at], &point).outputs;
            }
        }
        let mut targets: Vec<_> = point
            .outputs
            .iter()
            .map(|(target, columns)| (*target, columns[0][0]))
            .collect();
        targets.sort_by_key(|(target, _)| *target);
        targets
            .into_iter()
            .map(|(_, value)| value)
            .collect::<Vec<_>>()
    };
    let ends = [8, 16, 32].map(end);
    (count > 1).then(|| slope_of(ends))
}

/// The order of a composition, by its ends after steps that are halved twice.
pub fn slope_of([a, b, c]: [Vec<DoubleDouble>; 3]) -> f64 {
    let apart = |a: &[DoubleDouble], b: &[DoubleDouble]| {
        let squares = a.iter().zip(b).map(|(a, b)| (*a - *b).to_f64().powi(2));
        squares.sum::<f64>().sqrt()
    };
    (apart(&a, &b) / apart(&b, &c)).log2()
}

/// Short flows of (34)'s coupled piece, there and back: rounding leaves its energy where it was, to
/// ε√n. What rounds to one side more often, √(1 + sinh²) for the hyperbolic cosine, leaves nε/4.
#[test]
fn short_flows_round_to_both_sides() {
    const PAIRS: usize = 50_000;
    let mut model = common::system("q; p", "", "", "0.5*q^2*(p^2 + 1)");
    model.pieces = find(&mut model).unwrap().pieces;
    let program = derive(&mut model, &[Purpose::Piece(0)]).unwrap();
    let target = |side| {
        Target::Phase(Column {
            side,
            group: 0,
            column: 0,
        })
    };
    let mut point = Point::<f64>::new();
    point.outputs.insert(target(Side::Q), vec![vec![0.7]]);
    point.outputs.insert(target(Side::P), vec![vec![0.3]]);
    let energy = |point: &Point<f64>| {
        let at = |side| point.outputs[&target(side)][0][0];
        let (q, p): (f64, f64) = (at(Side::Q), at(Side::P));
        q * q * (p * p + 1.0)
    };
    let start = energy(&point);
    for n in 0..PAIRS {
        let c = 1e-4 * (0.5 + (n as f64 * 0.618_033_988_749_895).fract());
        for c in [c, -c] {
            point.c = c;
            point.outputs = run(&program, &program.functions[0], &point).outputs;
        }
    }
    let moved = (energy(&point) / start - 1.0).abs();
    let random = f64::EPSILON * (2.0 * PAIRS as f64).sqrt();
    assert!(moved < 10.0 * random, "{moved:e}, at random {random:e}");
}
