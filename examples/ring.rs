//! A ring of magnets by its elements: the tune of a lattice of quadrupoles, and the dynamic aperture with a sextupole.
//!
//! In an element of constant strength k, H = (p_x² + p_y²)/2 + k(x² − y²)/2; the time is the length along the ring. The run
//! goes through the elements one after the other by `set_system`. The phase advance μ of a cell is known from the trace of
//! the product of the elements' matrices, cos μ = trace/2.
//!
//! With a thin sextupole, a kick of x² once a turn, the motion in x is the map of Hénon (M. Hénon, 1969,
//! doi:10.1090/qam/253513): a rotation by ω and the kick. A sweep over starts finds those that stay for 1000 turns. No
//! stable start lies beyond the unstable fixed point at x = 2·tan(ω/2), p = −x·tan(ω/2).

use checks::Checks;
use hamiltonian::prelude::*;
use std::f64::consts::TAU;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// A magnet of the ring, or a straight.
    pub struct Element {
        /// The gradient: positive focuses in x.
        k = 0.0,
    }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + k*(x^2 - y^2)/2
}

hamiltonian! {
    /// The rest of the ring as a rotation of the phase space of x.
    pub struct Arc {
        /// The phase of a turn, in a turn of length 1.
        omega = 1.0,
    }
    H(x; p) = omega*(x^2 + p^2)/2
}

/// The steps in an element, and in a turn of the arc.
const STEPS: u64 = 20;

/// A cell: focusing and defocusing magnets of length 0.5, with straights of length 1 between.
const CELL: [(f64, f64); 4] = [(0.5, 0.8), (1.0, 0.0), (0.5, -0.8), (1.0, 0.0)];

/// The matrix of an element in x.
fn matrix((length, k): (f64, f64)) -> [[f64; 2]; 2] {
    let root = k.abs().sqrt();
    let phase = root * length;
    match k {
        0.0 => [[1.0, length], [0.0, 1.0]],
        k if k > 0.0 => [
            [phase.cos(), phase.sin() / root],
            [-root * phase.sin(), phase.cos()],
        ],
        _ => [
            [phase.cosh(), phase.sinh() / root],
            [root * phase.sinh(), phase.cosh()],
        ],
    }
}

/// cos μ of a cell by the run: half the trace of its matrix, from two orbits.
fn half_trace() -> Result<f64, Error> {
    let mut trace = 0.0;
    for column in 0..2 {
        let mut start = State::new([0.0, 0.0], [0.0, 0.0]);
        match column {
            0 => start.q[0] = 1.0,
            _ => start.p[0] = 1.0,
        }
        let first = Element { k: CELL[0].1 };
        let mut run = Integrator::new(&first, BlanesMoan6, start, 1.0)?;
        for (length, k) in CELL {
            run.set_system(&Element { k })?;
            run.change_step(length / STEPS as f64)?;
            run.advance(STEPS)?;
        }
        trace += if column == 0 {
            run.state().q[0]
        } else {
            run.state().p[0]
        };
    }
    Ok(trace / 2.0)
}

/// Starts on a grid, in x and p.
const GRID: usize = 60;
const TURNS: u64 = 1000;

fn start(member: Member) -> [f64; 2] {
    let place = |index: usize| 2.0 * (index as f64 + 0.5) / GRID as f64 - 1.0;
    [place(member.index % GRID), place(member.index / GRID)]
}

/// The kick of the sextupole. Where the orbit is lost, it stays where it is.
fn kick([x, p]: [f64; 2]) -> [f64; 2] {
    if x.abs() < 10.0 {
        [x, p + x * x]
    } else {
        [x, p]
    }
}

/// The number of starts that stay, by Hénon's map itself.
fn by_the_map(omega: f64) -> usize {
    let (sin, cos) = omega.sin_cos();
    let stays = |index: &usize| {
        let mut z = start(Member::new(*index, 0));
        for turn in 0..TURNS {
            let [x, p] = if turn == 0 { z } else { kick(z) };
            z = [x * cos + p * sin, p * cos - x * sin];
        }
        z[0].hypot(z[1]) < 10.0
    };
    (0..GRID * GRID).filter(stays).count()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let product = CELL.into_iter().map(matrix).reduce(|before, next| {
        let entry = |i: usize, j: usize| next[i][0] * before[0][j] + next[i][1] * before[1][j];
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    });
    let product = product.unwrap_or_default();
    checks.compare(
        "cos of the phase advance",
        half_trace()?,
        (product[0][0] + product[1][1]) / 2.0,
        1e-10,
    );

    let omega = 0.2114 * TAU;
    let table = Sweep::new(
        GRID * GRID,
        |member| {
            let [x, p] = start(member);
            (Arc { omega }, State::new([x], [p]))
        },
        BlanesMoan6,
        1.0 / STEPS as f64,
    )
    .with_steps(TURNS * STEPS)
    .each(STEPS, |_, state| {
        let [x, p] = kick([state.q[0], state.p[0]]);
        (state.q[0], state.p[0]) = (x, p);
    })
    .record(["radius"], |end| [end.state.q[0].hypot(end.state.p[0])])
    .collect()?;
    let radius: Vec<f64> = table.column("radius").into_iter().flatten().collect();
    let stays = |index: usize| radius[index] < 10.0;
    let stable = (0..GRID * GRID).filter(|index| stays(*index)).count();
    println!("{stable} of {} starts stay for {TURNS} turns:", GRID * GRID);
    for row in (0..GRID).rev().step_by(3) {
        let mark = |column| if stays(row * GRID + column) { '#' } else { '.' };
        println!("    {}", (0..GRID).map(mark).collect::<String>());
    }
    // Orbits at the border are chaotic: rounding decides some of them.
    let known = by_the_map(omega) as f64;
    checks.compare("starts that stay", stable as f64, known, 0.02 * known);
    let limit = 2.0 * (omega / 2.0).tan();
    let beyond =
        (0..GRID * GRID).filter(|index| stays(*index) && start(Member::new(*index, 0))[0] > limit);
    checks.compare(
        "of these beyond the fixed point",
        beyond.count() as f64,
        0.0,
        0.0,
    );
    checks.finish()
}
