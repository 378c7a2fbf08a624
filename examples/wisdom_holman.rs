//! The outer planets in steps of a third of a year: Kepler motion round the Sun, with kicks by the other planets.
//!
//! In inertial coordinates H is not a sum of Kepler problems and a small rest. It is in heliocentric positions with
//! barycentric momenta (M. J. Duncan, H. F. Levison, M. H. Lee, Astronomical Journal 116, 2067, 1998) and in C. G.
//! J. Jacobi's coordinates, in which each body is measured from the centre of mass of the bodies inside its orbit
//! (J. Wisdom, M. Holman, Astronomical Journal 102, 1528, 1991). `split` names the pieces there. The flow of a
//! Kepler problem is exact for any time, so the error comes from the interactions of the planets alone, a
//! thousandth of the attraction of the Sun.
//!
//! The program prints the drift of H in 10 000 years beside schemes without Kepler flows, and the error against the
//! masses of the planets. Picture: `target/wisdom_holman/energy.svg`.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::nalgebra::{SMatrix, SVector};
use hamiltonian::prelude::*;
use planets::start;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;
#[path = "support/planets.rs"]
mod planets;

hamiltonian! {
    /// Planets around a star; positions are measured from the star.
    pub struct Heliocentric {
        n: usize,
        /// The constant of gravity in AU³/(day² solar masses).
        G = 2.95912208286e-4,
        m: [n],
    }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    // Row 0 of the new momenta is the total one, so that the first piece is that of the star.
    split {
        Star = norm_squared(p_heliocentric[0] - sum(i in 1..n) { p_heliocentric[i] })/(2*m[0]);
        Pulls = -G*sum(i in 1..n, j in 1..i) {
            m[i]*m[j]/norm(q_heliocentric[i] - q_heliocentric[j])
        };
        Ellipses = sum(i in 1..n) {
            norm_squared(p_heliocentric[i])/(2*m[i]) - G*m[0]*m[i]/norm(q_heliocentric[i])
        };
    };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) }
}

hamiltonian! {
    /// The Sun and five planets, each measured from the centre of mass of those before it.
    pub struct Jacobi {
        /// The constant of gravity in AU³/(day² solar masses).
        G = 2.95912208286e-4,
        m: [6],
    }
    let inside(i) = sum(j in 0..i) { m[j] };
    H(q[6][3]; p[6][3]) = sum(i in 0..6) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..6, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates jacobi(q, m);
    split {
        Pulls = norm_squared(p_jacobi[0])/(2*inside(6))
            + G*m[0]*sum(i in 1..6) { m[i]*(1/norm(q_jacobi[i]) - 1/norm(q[i] - q[0])) }
            - G*sum(i in 1..6, j in 1..i) { m[i]*m[j]/norm(q[i] - q[j]) };
        Ellipses = sum(i in 1..6) {
            norm_squared(p_jacobi[i])*(1/m[i] + 1/inside(i))/2 - G*m[0]*m[i]/norm(q_jacobi[i])
        };
    }
}

const YEAR: f64 = 365.25;
/// 36 steps to a revolution of Jupiter.
const STEP: f64 = YEAR / 3.0;
const END: f64 = 10_000.0 * YEAR;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let (masses, first) = start();
    let system = Heliocentric::new(masses.len(), masses.clone())?;
    let begin = system.from_declared(&first);
    let energy = system.energy(&begin);
    print_pieces(&system);
    let mut contest = Contest::new(&system, begin.clone(), STEP, END);
    contest.every = 3;
    let [_, midpoint] = contest.enter_others()?;
    let verlet = contest.enter("Störmer–Verlet", StormerVerlet::default())?;
    let ellipses = contest.enter("ellipses round the Sun", Strang)?;
    contest.enter("the same, Blanes–Moan 4", BlanesMoan4)?;

    let jacobi = Jacobi::new(SVector::from_column_slice(&masses));
    let fixed = State {
        t: first.t,
        q: SMatrix::<f64, 6, 3>::from_fn(|i, c| first.q[(i, c)]),
        p: SMatrix::<f64, 6, 3>::from_fn(|i, c| first.p[(i, c)]),
    };
    print_pieces(&jacobi);
    let mut inner = Contest::new(&jacobi, jacobi.from_declared(&fixed), STEP, END);
    inner.every = 3;
    let wisdom = inner.enter("ellipses of Jacobi", Strang)?;
    contest.curves.append(&mut inner.curves);
    contest.draw(
        "The outer planets in steps of a third of a year",
        "target/wisdom_holman/energy.svg",
    )?;
    checks.compare(
        "from the Sun: max |ΔH/H₀|",
        ellipses / energy.abs(),
        0.0,
        1e-5,
    );
    checks.compare("Jacobi: max |ΔH/H₀|", wisdom / energy.abs(), 0.0, 2e-6);
    checks.compare("of Störmer–Verlet's error", ellipses / verlet, 0.0, 1e-2);
    checks.compare("of the midpoint's error", ellipses / midpoint, 0.0, 1e-2);

    // Planets a tenth as heavy pull a hundredth as hard on each other; of H itself, a tenth is theirs.
    println!("planets times   max |ΔH/H₀| in 1000 years");
    let mut errors = Vec::new();
    for scale in [1.0, 0.1, 0.01] {
        let mut lighter = masses.clone();
        lighter[1..].iter_mut().for_each(|m| *m *= scale);
        let mut start = first.clone();
        start.p *= scale;
        let system = Heliocentric::new(lighter.len(), lighter)?;
        let start = system.from_declared(&start);
        let mut run = Integrator::new(&system, Strang, start, STEP)?.observe(EnergyDrift::new());
        run.advance_to(1000.0 * YEAR)?;
        errors.push(run.observer().max_relative());
        println!("{scale:13}   {:.3e}", run.observer().max_relative());
    }
    for pair in errors.windows(2) {
        checks.compare(
            "planets a tenth as heavy: the error",
            pair[1] / pair[0],
            0.1,
            0.02,
        );
    }
    checks.finish()
}
