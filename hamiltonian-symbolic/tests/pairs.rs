//! Sums over pairs in tiles are what the same loops are in any other order: random sums with whole numbers, which
//! are added without rounding.

use crate::common::{cases, system};
use crate::random_text::Random;
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::interpret::{Point, run, run_in_tiles, run_reversed};
use hamiltonian_symbolic::pairs::pairs;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Function, Program, Purpose, Step, Target};
use hamiltonian_symbolic::structure;

const PURPOSES: [Purpose; 4] = [
    Purpose::VectorField,
    Purpose::Gradient,
    Purpose::HessianVector,
    Purpose::GradientQ,
];

/// A polynomial of a pair.
fn pair(random: &mut Random) -> String {
    let factors: &[&str] = &[
        "m[i]",
        "m[j]",
        "(i + 1)",
        "(j + 2)",
        "(q[i] - q[j])",
        "(q[i] - q[j])^2",
        "(q[i] + 2*q[j])",
        "q[i]",
        "q[j]",
        "p[j]",
        "(p[i]*q[j] - q[i]*p[j])",
        "if q[i] < q[j] { q[i] } else { 2*q[j] }",
    ];
    let count = 1 + random.below(3);
    let some: Vec<&str> = (0..count).map(|_| random.pick(factors)).collect();
    some.join("*")
}

/// A sum over the pairs of a triangle, and what belongs to rows alone.
fn sum(random: &mut Random) -> String {
    let columns = random.pick(&["0..i", "i + 1..n", "0..i", "i + 1..n", "0..n", "0..i + 1"]);
    let term = pair(random);
    match random.below(5) {
        0 => format!("sum(i in 0..n) {{ m[i]*q[i]*sum(j in {columns}) {{ {term} }} }}"),
        1 => format!("sum(i in 0..n) {{ q[i]^3 + sum(j in {columns}) {{ {term} }} }}"),
        2 => format!("sum(i in 0..n) {{ sum(j in {columns}) {{ {term} }}^2 }}"),
        _ => format!("sum(i in 0..n, j in {columns}) {{ {term} }}"),
    }
}

/// Returns true if a loop of the function is computed in tiles.
fn has_tiles(function: &Function, program: &Program) -> bool {
    let is_one = |step: &Step| matches!(step, Step::Loop(outer) if pairs(outer, program).is_some());
    function.evaluation.iter().any(is_one)
}

#[test]
fn tiles_add_what_rows_add() {
    let mut random = Random(24);
    let mut tiled = 0;
    let all = cases(60, 600);
    for _ in 0..all {
        let h = format!(
            "sum(i in 0..n) {{ p[i]^2*m[i] }} + {} - {}",
            sum(&mut random),
            sum(&mut random)
        );
        let mut model = system("q[n]; p[n]", "n", "m[n]", &h);
        structure::analyse(&mut model);
        let program = derive(&mut model, &PURPOSES).expect("a program");
        let n = 1 + random.below(40);
        let mut numbers = |n: usize| -> Vec<f64> {
            let number = |_| random.below(7) as f64 - 3.0;
            (0..n).map(number).collect()
        };
        let mut point = Point::<f64>::new();
        point.c = 2.0;
        point.sizes = vec![n];
        point.scalars = vec![0.0];
        let parameter = Array::Parameter(Parameter(0));
        point.arrays.insert(parameter, vec![numbers(n)]);
        for side in [Side::Q, Side::P] {
            let column = Column::first(side, 0);
            point.arrays.insert(Array::Phase(column), vec![numbers(n)]);
            let direction = Array::Direction(column);
            point.arrays.insert(direction, vec![numbers(n)]);
            let output = Target::Phase(column);
            point.outputs.insert(output, vec![numbers(n)]);
        }
        for purpose in PURPOSES {
            let Some(function) = program.function(purpose) else {
                continue;
            };
            tiled += usize::from(has_tiles(function, &program));
            let expected = run(&program, function, &point);
            let reversed = run_reversed(&program, function, &point);
            assert_eq!(expected.outputs, reversed.outputs, "{h}");
            for rows in [1, 2, 3, 8, 40] {
                let found = run_in_tiles(&program, function, &point, rows);
                assert_eq!(found.outputs, expected.outputs, "{purpose:?}, {rows}: {h}");
            }
        }
    }
    assert!(tiled > all / 2, "{tiled} functions have tiles");
}
