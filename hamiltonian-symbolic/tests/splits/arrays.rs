//! Sums over arrays as loops of exact flows: their pieces, and the order of their composition.

use super::order::slope_of;
use crate::common;
use hamiltonian_lanes::DoubleDouble;
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret::{Point, run, run_reversed};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use hamiltonian_symbolic::split::find;

/// A system of arrays, and its pieces.
pub struct Ring {
    pub signature: &'static str,
    pub parameters: &'static str,
    pub h: &'static str,
    pieces: &'static [&'static str],
    merges: &'static [bool],
}

pub const RINGS: &[Ring] = &[
    Ring {
        signature: "q[n]; p[n]",
        parameters: "g",
        h: "sum(i in 0..n) { g*(q[i]^2 + p[i]^2)^2/4 } - sum(i in 0..n) { q[i]*q[(i + 1) % n] + p[i]*p[(i + 1) % n] }",
        pieces: &[
            "0.25*g*sum(i in 0..n) { (q[i]^2 + p[i]^2)^2 }",
            "-sum(i in 0..n) { q[i]*q[(i + 1) % n] + p[i]*p[(i + 1) % n] }",
        ],
        merges: &[true, false],
    },
    Ring {
        signature: "x[n]; y[n]",
        parameters: "g[n]",
        h: "-sum(i in 0..n, j in 0..i) { g[i]*g[j]*ln((x[i] - x[j])^2 + (y[i] - y[j])^2)/(4*pi) }",
        pieces: &[
            "-sum(i in 0..n) { g[i]*sum(j in 0..i) { g[j]*ln((x[i] - x[j])^2 + (y[i] - y[j])^2) } }/(4*pi)",
        ],
        merges: &[false],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { 0.5*(q[i]^2 + 1)*(p[i]^2 + 1) } + sum(i in 0..n) { cos(q[i] - q[(i + 1) % n]) }",
        pieces: &[
            "sum(i in 0..n) { p[i]^2/2 + 0.5 }",
            "sum(i in 0..n) { cos(q[i] - q[(i + 1) % n]) }",
            "sum(i in 0..n) { 0.5*p[i]^2*q[i]^2 + q[i]^2/2 }",
        ],
        merges: &[true, true, true],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..i) { 1/hypot(q[i] - q[j], 1) }",
        pieces: &[
            "sum(i in 0..n) { p[i]^2 }/2",
            "sum(i in 0..n) { sum(j in 0..i) { 1/hypot(q[i] - q[j], 1) } }",
        ],
        merges: &[true, true],
    },
    // The toy model of the cubic wave equation (J. Colliander and others, Invent. Math. 181 (2010) 39).
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { (q[i]^2 + p[i]^2)^2/4 } - sum(i in 0..n) { (q[i]^2 - p[i]^2)*(q[(i + 1) % n]^2 - p[(i + 1) % n]^2)/2 } - sum(i in 0..n) { 2*q[i]*p[i]*q[(i + 1) % n]*p[(i + 1) % n] }",
        pieces: &[
            "sum(i in 0..n) { (q[i]^2 + p[i]^2)^2 }/4",
            "-sum(i in 0..n) { (q[i]^2 - p[i]^2)*(q[(i + 1) % n]^2 - p[(i + 1) % n]^2) }/2",
            "-2*sum(i in 0..n) { q[i]*p[i]*q[(i + 1) % n]*p[(i + 1) % n] }",
        ],
        merges: &[true, false, false],
    },
    // XY spins of length 2, (angle, component along z).
    Ring {
        signature: "f[n]; z[n]",
        parameters: "",
        h: "sum(i in 0..n) { sqrt(4 - z[i]^2)*sqrt(4 - z[(i + 1) % n]^2)*cos(f[i])*cos(f[(i + 1) % n]) } + sum(i in 0..n) { sqrt(4 - z[i]^2)*sqrt(4 - z[(i + 1) % n]^2)*sin(f[i])*sin(f[(i + 1) % n]) }",
        pieces: &[
            "sum(i in 0..n) { sqrt(4 - z[i]^2)*sqrt(4 - z[(i + 1) % n]^2)*sin(f[i])*sin(f[(i + 1) % n]) }",
            "sum(i in 0..n) { sqrt(4 - z[i]^2)*sqrt(4 - z[(i + 1) % n]^2)*cos(f[i])*cos(f[(i + 1) % n]) }",
        ],
        merges: &[false, false],
    },
    // Shears between sites do not commute, however linear each of them is.
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 1..n) { q[i]*p[i - 1] }",
        pieces: &["sum(i in 1..n) { q[i]*p[i - 1] }"],
        merges: &[false],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { q[i]^2*p[(i + 1) % n] }",
        pieces: &["sum(i in 0..n) { q[i]^2*p[(i + 1) % n] }"],
        merges: &[false],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n, j in 0..i) { sin(q[i]*p[j]) }",
        pieces: &["sum(i in 0..n) { sum(j in 0..i) { sin(q[i]*p[j]) } }"],
        merges: &[false],
    },
    // Pairs the other way, and a ring as a chain with a closing bond.
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n, j in i + 1..n) { (q[i]*p[j] - q[j]*p[i])^2 }",
        pieces: &["sum(i in 0..n) { sum(j in i + 1..n) { (q[i]*p[j] - q[j]*p[i])^2 } }"],
        merges: &[false],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { (q[i]^2 + p[i]^2)^2/4 } - sum(i in 0..n - 1) { q[i]*q[i + 1] + p[i]*p[i + 1] } - q[n - 1]*q[0] - p[n - 1]*p[0]",
        pieces: &[
            "sum(i in 0..n) { (q[i]^2 + p[i]^2)^2 }/4",
            "-sum(i in 0..n - 1) { q[i]*q[i + 1] + p[i]*p[i + 1] }",
            "-q[n - 1]*q[0] - p[n - 1]*p[0]",
        ],
        merges: &[true, false, true],
    },
    // Each site twice, by different terms.
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 1..2*n) { (q[i % n]^2 + i*p[i % n])^2/90 }",
        pieces: &["sum(i in 1..2*n) { (q[i % n]^2 + i*p[i % n])^2 }/90"],
        merges: &[false],
    },
    Ring {
        signature: "q[n]; p[n]",
        parameters: "",
        h: "sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }",
        pieces: &[
            "sum(i in 0..n) { p[i]^2 }/2",
            "sum(i in 0..n) { exp(q[i] - q[(i + 1) % n]) }",
        ],
        merges: &[true, true],
    },
];

#[test]
fn arrays_are_split_into_loops_of_flows() {
    for ring in RINGS {
        println!("{}", ring.h);
        let mut model = common::system(ring.signature, "n", ring.parameters, ring.h);
        let pieces = match find(&mut model) {
            Ok(splitting) => splitting.pieces,
            Err(refusal) => panic!("{}: {refusal:?}", ring.h),
        };
        let names: Vec<&str> = pieces.iter().map(|piece| piece.name.as_str()).collect();
        assert_eq!(names, ring.pieces);
        let merges: Vec<bool> = pieces.iter().map(|piece| piece.flow.merges()).collect();
        assert_eq!(merges, ring.merges, "{}", ring.h);
        model.pieces = pieces;
        let slope = ring_slope(&mut model);
        assert!((slope - 2.0).abs() < 0.05, "{}: {slope}", ring.h);
    }
}

fn ring_slope(model: &mut Model) -> f64 {
    const N: usize = 5;
    let count = model.pieces.len();
    let wanted: Vec<Purpose> = (0..count).map(|n| Purpose::Piece(n as u16)).collect();
    let program = derive(model, &wanted).unwrap();
    let end = |steps: u32| {
        let mut point = Point::<DoubleDouble>::new();
        point.sizes = vec![N];
        point.scalars = model
            .parameters
            .iter()
            .map(|_| DoubleDouble::from(0.7))
            .collect();
        let circulations = (0..N).map(|i| DoubleDouble::from(1.0 - 0.4 * i as f64));
        point
            .arrays
            .insert(Array::Parameter(Parameter(0)), vec![circulations.collect()]);
        for (side, shift) in [(Side::Q, 0.3), (Side::P, 1.1)] {
            let target = Target::Phase(Column {
                side,
                group: 0,
                column: 0,
            });
            let values = (0..N).map(|i| DoubleDouble::from((1.7 * i as f64 + shift).sin() + 0.2));
            point.outputs.insert(target, vec![values.collect()]);
        }
        let h = DoubleDouble::from(0.25) / DoubleDouble::from(f64::from(steps));
        point.c = h * DoubleDouble::from(0.5);
        for _ in 0..steps {
            for at in 0..count {
                point.outputs = run(&program, &program.functions[at], &point).outputs;
            }
            for at in (0..count).rev() {
                point.outputs = run_reversed(&program, &program.functions[at], &point).outputs;
            }
        }
        let mut targets: Vec<_> = point.outputs.into_iter().collect();
        targets.sort_by_key(|(target, _)| *target);
        targets
            .into_iter()
            .flat_map(|(_, columns)| columns[0].clone())
            .collect::<Vec<_>>()
    };
    slope_of([8, 16, 32].map(end))
}
