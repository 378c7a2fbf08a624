//! Compositions of exact flows: orders, symplectic forms, ends of orbits against the table of check
//! values, and energies that stay.

use crate::common::geometry::Geometry;
use crate::common::is_heavy;
use crate::common::order::Order;
use crate::common::systems::Paper34;
use crate::flows::Top;
use crate::splits::{Body, InFour, Schwarzschild, Vortices};
use crate::systems::{Dipole, Vortices as Strengths};
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::schemes::walk::Visitor;
use hamiltonian::schemes::{KahanLi6, Yoshida4};
use hamiltonian::{DoubleDouble, Dual, Exact, Split, Vector};
use std::f64::consts::FRAC_PI_2;

/// The slope of Strang's scheme and of three compositions of it, from (q, p) over a time.
fn orders<S: Split + Exact>(system: S, q: &[f64], p: &[f64], span: f64) {
    let mut order = Order::new(system, q, p, span, span / 16.0);
    order.visit(Strang);
    order.visit(Yoshida4);
    order.visit(KahanLi6);
    order.visit(KahanLi8);
    let slopes: Vec<f64> = order.measured.iter().map(|(_, slope)| *slope).collect();
    println!("{}: {slopes:?}", order.system.description().name);
    assert_eq!(slopes.len(), 4);
}

#[test]
fn orders_of_paper_34() {
    orders(Paper34::default(), &[0.8], &[-0.5], 1.0);
}

#[test]
fn orders_of_a_body() {
    orders(Body::default(), &[0.7, 0.2], &[0.5, 1.3], 1.0);
}

#[test]
fn orders_round_a_black_hole() {
    orders(Schwarzschild::default(), &[5.0, 1.3], &[0.1, 2.0], 4.0);
}

#[test]
fn orders_of_vortices() {
    let strengths = [1.0, 1.2, 0.8].map(DoubleDouble::from).to_vec();
    let vortices = Vortices::new(3, strengths).expect("three strengths");
    orders(vortices, &[1.0, -1.0, 0.1], &[0.1, 0.2, 1.3], 4.0);
}

/// MᵀJM = J of one, two and three steps.
fn symplectic<S: Split + Exact>(system: S, q: &[f64], p: &[f64], h: f64) {
    let mut geometry = Geometry::new(system, q, p, h);
    geometry.visit(Strang);
    geometry.visit(KahanLi8);
    for (entry, defect) in &geometry.measured {
        let name = &geometry.system.description().name;
        println!("{} on {name}: {defect:e}", entry.name);
    }
    assert_eq!(geometry.measured.len(), 2 * 3);
}

#[test]
fn compositions_are_symplectic() {
    symplectic(Paper34::default(), &[0.8], &[-0.5], 0.3);
    symplectic(Schwarzschild::default(), &[5.0, 1.3], &[0.1, 2.0], 0.5);
    symplectic(Body::default(), &[0.7, 0.2], &[0.5, 1.3], 0.3);
    let strengths = [1.0, 1.2, 0.8].map(Dual::fixed).to_vec();
    let vortices = Vortices::new(3, strengths).expect("three strengths");
    symplectic(vortices, &[1.0, -1.0, 0.1], &[0.1, 0.2, 1.3], 0.3);
}

/// The point of an orbit after a time, by the composition of order 8, beside the printed figures; the
/// error over κ, and over what is large.
#[track_caller]
fn ends<S: Split + Exact>(
    system: &S,
    q: &[f64],
    p: &[f64],
    (t, steps): (f64, u32),
    end: &[f64],
    kappa: f64,
) {
    let start = crate::common::state(system, 0.0, q.iter().copied(), p.iter().copied());
    let h = t / f64::from(steps);
    let mut run = Integrator::new(system, KahanLi8, start, h).expect("a good start");
    run.advance(u64::from(steps)).expect("good steps");
    let state = run.state();
    let found = state.q.components().chain(state.p.components());
    let mut worst = 0.0_f64;
    for (found, wanted) in found.zip(end) {
        if wanted.is_finite() {
            worst = worst.max((found - wanted).abs() / (kappa * (1.0 + wanted.abs())));
        }
    }
    println!("{}: {worst:e}", system.description().name);
    // Each flow of 17 stages rounds in a direction of its own; four standard deviations.
    let flows = 17.0 * f64::from(steps) * system.description().pieces.len() as f64;
    let bound = 4.0 * f64::EPSILON * flows.sqrt();
    assert!(
        worst < bound,
        "{}: {worst:e} of {bound:e}",
        system.description().name
    );
}

/// Digits that the table does not print.
const UNKNOWN: f64 = f64::NAN;

#[test]
fn orbits_end_where_the_table_says() {
    let end = [-2.402_238_313_100_827, 0.690_609_507_457_253_5];
    ends(
        &Paper34::default(),
        &[-3.0],
        &[0.0],
        (10.0, 2000),
        &end,
        8.0,
    );
    let p_theta = 2.062_449_325_976_816;
    let end = [
        122.486_719_036_045,
        1.495_696_594_046_55,
        0.069_598_468_153_017_1,
        -2.033_200_752_273_33,
    ];
    ends(
        &Schwarzschild::default(),
        &[11.0, FRAC_PI_2],
        &[0.0, p_theta],
        (1000.0, 2000),
        &end,
        243.0,
    );
    // One radial period brings r and p_r back.
    let round = Schwarzschild {
        E: 0.965_355_742_557_886,
        L: 4.020_151_261_036_848,
    };
    let (r, end) = (12.0 / 1.3, [12.0 / 1.3, FRAC_PI_2, 0.0, 0.0]);
    ends(
        &round,
        &[r, FRAC_PI_2],
        &[0.0, 0.0],
        (361.863_612_556_420_13, 2000),
        &end,
        243.0,
    );
    let end = [
        12.085_803_855_002_737,
        -9.394_898_242_086_06,
        10.641_560_792_938_645,
        0.562_364_308_794_907_5,
        -0.459_494_090_979_351,
        0.531_397_816_453_916_2,
    ];
    ends(
        &Dipole::default(),
        &[1.2, 0.3, 0.2],
        &[0.1, -0.2, 0.3],
        (20.0, 2000),
        &end,
        23.0,
    );
    let end = [
        2.385_267_154_242_963_7,
        20.632_978_680_799_48,
        -0.591_721_023_341_516_3,
        1.3,
    ];
    ends(
        &Body::default(),
        &[0.7, 0.2],
        &[0.5, 1.3],
        (20.0, 1000),
        &end,
        16.0,
    );
    // After the period of the polhode l has gone round and L is back.
    let end = [UNKNOWN, UNKNOWN, 0.5, 1.3];
    ends(
        &Body::default(),
        &[0.7, 0.2],
        &[0.5, 1.3],
        (13.510_502_678_700_29, 1000),
        &end,
        16.0,
    );
    let kovalevskaya = Top {
        A: 2.0,
        B: 2.0,
        C: 1.0,
        m: -1.0,
    };
    let end = [
        4.366_923_070_525_686,
        0.678_169_011_862_110_9,
        2.025_795_011_871_466,
        0.8,
        -0.907_236_155_622_159_9,
        0.163_230_408_592_397_67,
    ];
    ends(
        &kovalevskaya,
        &[0.3, 1.1, 0.4],
        &[0.8, 0.3, 0.6],
        (10.0, 2000),
        &end,
        8.0,
    );
    let strengths = Strengths::new([1.0, 2.0, -0.5, 1.0]);
    let end = [
        0.774_832_009_367_877_9,
        -0.093_131_710_935_730_3,
        0.828_126_867_039_044_8,
        -0.974_505_153_976_894_9,
        -1.680_244_550_479_663_7,
        2.0 * -0.911_136_728_730_642,
        -0.5 * -2.375_620_278_146_924_6,
        0.814_707_868_867_486,
    ];
    ends(
        &strengths,
        &[1.0, -1.0, 0.0, 0.2],
        &[0.0, 0.2, -0.6, -1.1],
        (20.0, 2000),
        &end,
        8.7,
    );
}

/// The largest |H − H₀| in the first and in the second half of a run.
fn halves<S: Split>(system: &S, start: &State<VectorOf<S>>, h: f64, steps: u64) -> [f64; 2] {
    let first = system.energy(start);
    let mut run = Integrator::new(system, Strang, start.clone(), h).expect("a good start");
    let mut worst = [0.0_f64; 2];
    for worst in &mut worst {
        for _ in 0..steps / 2 {
            let state = run.advance(1).expect("a good step");
            *worst = worst.max((system.energy(state) - first).abs());
        }
    }
    println!("{}: {worst:?}", system.description().name);
    worst
}

#[test]
fn energies_do_not_drift() {
    let steps = if is_heavy() { 10_000_000 } else { 100_000 };
    let start = State::new([-3.0], [0.0]);
    let paper = halves(&Paper34::default(), &start, 1e-3, steps);
    // Of H = 5.
    assert!(paper[0] / 5.0 < 1.0e-6, "{paper:?}");
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.062_449_325_976_816]);
    let four = halves(&InFour::default(), &start, 1.0, steps);
    assert!((7.2e-6..7.35e-6).contains(&four[0]), "{four:?}");
    let field = InFour {
        beta: 8.9e-4,
        ..InFour::default()
    };
    let start = State::new([11.0, FRAC_PI_2], [0.0, 2.178_571_077_150_622]);
    let charge = halves(&field, &start, 1.0, steps);
    assert!((4.05e-6..4.15e-6).contains(&charge[0]), "{charge:?}");
    for [early, late] in [paper, four, charge] {
        assert!((0.98..1.02).contains(&(late / early)), "{early:e} {late:e}");
    }
}
