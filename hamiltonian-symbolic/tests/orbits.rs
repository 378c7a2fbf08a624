//! Kepler's flow in long times against orbital elements in 32 digits.
//!
//! Bounds: a part of the period's error for each radian of the mean anomaly, as an orbit in exact arithmetic from
//! rounded numbers has it, and some roundings of the result. The control is the same solution without whole
//! revolutions taken off, whose errors are past the bounds.

use crate::common;
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::model::Piece;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};
use hamiltonian_symbolic::split::exact_flow;

const EPSILON: f64 = f64::EPSILON;
const PI_2: f64 = 2.0 * std::f64::consts::PI;

/// A point in the plane: x, y, p_x, p_y.
type State<T> = [T; 4];

/// The flow of (p_x² + p_y²)/2 − 1/r.
fn flow() -> Program {
    let h = "(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)";
    let mut model = common::system("x, y; px, py", "", "", h);
    let h = model.h();
    let flow = exact_flow(&mut model, h).expect("Kepler's problem has a flow");
    let name = "Kepler".into();
    model.pieces = vec![Piece { h, name, flow }];
    derive(&mut model, &[Purpose::Piece(0)]).unwrap()
}

/// The state after a time.
fn moved(program: &Program, z: State<f64>, time: f64) -> State<f64> {
    let column = |at: usize| Column {
        side: [Side::Q, Side::P][at / 2],
        group: (at % 2) as u16,
        column: 0,
    };
    let mut point = Point::<f64>::new();
    point.c = time;
    for (at, x) in z.iter().enumerate() {
        let values = vec![vec![*x]];
        point
            .arrays
            .insert(Array::Phase(column(at)), values.clone());
        point.outputs.insert(Target::Phase(column(at)), values);
    }
    let out = run(program, &program.functions[0], &point).outputs;
    std::array::from_fn(|at| out[&Target::Phase(column(at))][0][0])
}

/// The same solution without a whole revolution taken off.
fn unreduced([x, y, u, v]: State<f64>, t: f64) -> State<f64> {
    let (rr, pp, qp) = (x * x + y * y, u * u + v * v, x * u + y * v);
    let r = rr.sqrt();
    let (a, b) = (t * qp / rr, t * t / (r * rr));
    let c = 2.0 * b - t * t * pp / rr;
    let s = a.universal_anomaly(b, c);
    let psi = c * s * s;
    let (two, three) = (psi.stumpff_2(), psi.stumpff_3());
    let (g1, g2) = (s - s * psi * three, s * s * two);
    let r1 = 1.0 - psi * two + a * g1 + b * g2;
    let (f, g) = (-b * g2, t - t * b * s * s * s * three);
    let (fd, gd) = (-t * g1 / (r * rr * r1), f / r1);
    [
        x + (f * x + g * u),
        y + (f * y + g * v),
        u + (fd * x + gd * u),
        v + (fd * y + gd * v),
    ]
}

/// An ellipse with a direction and an eccentric anomaly, in numbers of 53 bits.
fn start(random: &mut Random) -> State<f64> {
    let e = match random.below(3) {
        0 => random.unit(),
        1 => 1.0 - 10f64.powf(-3.0 * random.unit()),
        _ => 0.0,
    };
    let (size, angle, turn) = (
        10f64.powf(4.0 * random.unit() - 2.0),
        PI_2 * random.unit(),
        PI_2 * random.unit(),
    );
    let b = (1.0 - e * e).sqrt();
    let speed = 1.0 / ((1.0 - e * angle.cos()) * size.sqrt());
    let (x, y) = (size * (angle.cos() - e), size * b * angle.sin());
    let (u, v) = (-speed * angle.sin(), speed * b * angle.cos());
    let (s, c) = turn.sin_cos();
    [c * x - s * y, s * x + c * y, c * u - s * v, s * u + c * v]
}

/// The state after a time by orbital elements, with the bounds for positions and momenta.
fn by_elements(z: State<f64>, time: f64) -> (State<D>, [f64; 2]) {
    let [x, y, u, v] = z.map(D::from);
    let (one, two, t) = (D::one(), D::from(2.0), D::from(time));
    let r = (x * x + y * y).sqrt();
    let (square, along) = (u * u + v * v, x * u + y * v);
    let a = one / (two / r - square);
    let (ec, es) = (one - r / a, along / a.sqrt());
    let n = one / (a * a.sqrt());
    // E₁ − E₀ = d solves d − (e·cos E₀)·sin d + (e·sin E₀)·(1 − cos d) = n·t, less whole revolutions.
    let around = D::constant(PI_2, 2.0 * hamiltonian_symbolic::PI_LOW);
    let whole = (n * t / around).to_f64().round();
    let mean = n * t - D::from(whole) * around;
    let mut d = mean;
    let (mut low, mut high) = (mean - D::from(2.5), mean + D::from(2.5));
    for _ in 0..200 {
        let f = d - ec * d.sin() + es * (one - d.cos()) - mean;
        match f.to_f64() < 0.0 {
            true => low = d,
            false => high = d,
        }
        let next = d - f / (one - ec * d.cos() + es * d.sin());
        let is_inside = low.to_f64() < next.to_f64() && next.to_f64() < high.to_f64();
        d = match is_inside {
            true => next,
            false => (low + high) / two,
        };
    }
    let (sin, cos) = (d.sin(), d.cos());
    let r1 = a * (one - ec * cos + es * sin);
    let f = one - a / r * (one - cos);
    let g = (mean - d + sin) / n;
    let (fd, gd) = (-a.sqrt() * sin / (r * r1), one - a / r1 * (one - cos));
    let end = [
        f * x + g * u,
        f * y + g * v,
        fd * x + gd * u,
        fd * y + gd * v,
    ];
    // δn/n = 3δa/2a, and δa/a = a·(2/r + v²)·ε.
    let [a, r, n, r1] = [a, r, n, r1].map(|x| x.to_f64());
    let spread = a * (2.0 / r + square.to_f64());
    let late = 8.0 * EPSILON * spread * (1.0 + (n * time).abs()) / n;
    let speed = (2.0 / r1 - 1.0 / a).abs().sqrt();
    let moved = late * speed + 16.0 * EPSILON * spread * (r + r1);
    let turned = late / (r1 * r1) + 16.0 * EPSILON * spread * (speed + square.to_f64().sqrt());
    (end, [moved, turned])
}

/// The largest error in units of its bound.
fn off(found: State<f64>, exact: &(State<D>, [f64; 2])) -> f64 {
    let error = |at: usize| (D::from(found[at]) - exact.0[at]).to_f64().abs() / exact.1[at / 2];
    let errors: [f64; 4] = std::array::from_fn(error);
    match errors.iter().any(|x| x.is_nan()) {
        true => f64::INFINITY,
        false => errors.iter().copied().fold(0.0, f64::max),
    }
}

#[test]
fn long_times_lose_the_digits_of_the_period_alone() {
    let program = flow();
    let mut random = Random(38);
    let (mut worst, mut past) = (0.0_f64, 0);
    for _ in 0..common::cases(1_000, 100_000) {
        let z = start(&mut random);
        let [x, y, u, v] = z;
        let a = 1.0 / (2.0 / x.hypot(y) - u * u - v * v);
        let turns = match random.below(4) {
            0 => random.unit(),
            1 => (1.0 + random.unit()) * f64::from(random.below(3) as u32),
            _ => 10f64.powf(8.0 * random.unit()),
        };
        let turns = if random.chance(0.5) { turns } else { -turns };
        let time = turns * PI_2 * a * a.sqrt();
        let exact = by_elements(z, time);
        let error = off(moved(&program, z, time), &exact);
        assert!(error < 1.0, "{z:?} after {turns} turns: {error}");
        worst = worst.max(error);
        past += usize::from(off(unreduced(z, time), &exact) > 1.0);
    }
    println!("{worst} of the bound; {past} past it without reduction");
    assert!(past > 100, "{past}");
}

/// After a whole number of periods that is exact, nothing moves.
#[test]
fn no_time_is_left_after_whole_periods() {
    let program = flow();
    let z = [1.0, 0.0, 0.0, 1.0];
    for turns in [1.0, -3.0, 1000.0, 1e6] {
        let end = moved(&program, z, turns * PI_2);
        let bound = 4.0 * EPSILON * PI_2 * f64::abs(turns);
        assert!(
            end.iter().zip(z).all(|(a, b)| (a - b).abs() < bound),
            "{end:?}"
        );
    }
    // Past the last digit of the angle there is no state.
    assert!(moved(&program, z, 1e17).iter().all(|x| x.is_nan()));
    // A line through the centre is left at its first collision.
    let fall = [1.0, 0.0, 0.0, 0.0];
    assert!(moved(&program, fall, 0.5).iter().all(|x| x.is_finite()));
    for time in [1.2, 2.3, 5.0, 100.0, -7.0] {
        assert!(
            moved(&program, fall, time).iter().all(|x| x.is_nan()),
            "{time}"
        );
    }
}
