//! The outer solar system for 100 000 years, and the resonance of Pluto with Neptune.
//!
//! The number of bodies is set at run time; `support/planets.rs` has the sources of the masses.
//!
//! The program counts revolutions and prints the periods beside those of the real planets. Neptune makes three
//! revolutions while Pluto makes two. The two would meet if the resonant angle passed 0°. It swings about 180° with
//! a period of 20 000 years (C. J. Cohen and E. C. Hubbard, Astronomical Journal 70, 10, 1965). Picture:
//! `target/solar_system/resonance.svg`, the resonant angle against time.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use planets::{PLANETS, SUN, start};
use std::f64::consts::TAU;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/planets.rs"]
mod planets;

hamiltonian! {
    /// Point masses under Newtonian gravity.
    pub struct Gravity {
        n: usize,
        /// The constant of gravity in AU³/(day² solar masses).
        G = 2.95912208286e-4,
        m: [n],
    }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..n) { p[i] };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) }
}

const YEAR: f64 = 365.25;
const END: f64 = 100_000.0 * YEAR;
/// 217 steps to a revolution of Jupiter.
const STEP: f64 = 20.0;
/// Steps between two samples: twelve samples in a revolution of Jupiter.
const LOOK: u64 = 18;

type Vector3 = [f64; 3];

fn dot(a: Vector3, b: Vector3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector3, b: Vector3) -> Vector3 {
    let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// The angle of `x` along the ecliptic, which is tilted by 23.44° against the table's equator.
fn longitude(x: Vector3) -> f64 {
    let (sin, cos) = 23.4393_f64.to_radians().sin_cos();
    (cos * x[1] + sin * x[2]).atan2(x[0])
}

/// The longitude of the perihelion and the mean longitude, of a planet at `x` with velocity `v`
/// relative to the Sun, where μ = G(m + M).
fn longitudes(mu: f64, x: Vector3, v: Vector3) -> (f64, f64) {
    let r = dot(x, x).sqrt();
    let a = 1.0 / (2.0 / r - dot(v, v) / mu);
    // The Runge–Lenz vector points to the perihelion; its length is the eccentricity.
    let kick = cross(v, cross(x, v));
    let lenz: Vector3 = std::array::from_fn(|c| kick[c] / mu - x[c] / r);
    let (e_sin, e_cos) = (dot(x, v) / (mu * a).sqrt(), 1.0 - r / a);
    let mean_anomaly = e_sin.atan2(e_cos) - e_sin;
    let perihelion = longitude(lenz);
    (perihelion, perihelion + mean_anomaly)
}

/// The angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (masses, start) = start();
    let system = Gravity::new(masses.len(), masses.clone())?;
    // H is separable and the run is long: the explicit symplectic scheme, whose energy error stays.
    let mut run = Integrator::new(&system, StormerVerlet::default(), start, STEP)?
        .observe(every(97, (EnergyDrift::new(), Monitors::new())));

    let mut angles = PLANETS.map(|planet| longitude(planet.position));
    let mut turned = [0.0; PLANETS.len()];
    let mut resonance = Vec::new();
    let looks = (END / STEP) as usize / LOOK as usize;
    for (number, state) in run.states(LOOK).take(looks).enumerate() {
        let state = state?;
        let from_sun =
            |i| -> Vector3 { std::array::from_fn(|c| state.q[(i, c)] - state.q[(0, c)]) };
        for i in 0..PLANETS.len() {
            let angle = longitude(from_sun(i + 1));
            turned[i] += wrapped(angle - angles[i]);
            angles[i] = angle;
        }
        if number % 200 == 0 {
            let velocity = |i: usize| -> Vector3 {
                std::array::from_fn(|c| state.p[(i, c)] / masses[i] - state.p[(0, c)] / masses[0])
            };
            let of = |i| longitudes(system.G * (SUN + masses[i]), from_sun(i), velocity(i));
            let ((_, neptune), (perihelion, pluto)) = (of(4), of(5));
            // From 0 to 2π, since it swings about π.
            let angle = (3.0 * pluto - 2.0 * neptune - perihelion).rem_euclid(TAU);
            resonance.push((state.t / YEAR, angle.to_degrees()));
        }
    }

    println!("{system}");
    let time = looks as f64 * LOOK as f64 * STEP;
    let mut checks = Checks::default();
    for (planet, turned) in PLANETS.iter().zip(turned) {
        let period = time * TAU / turned;
        let what = format!("period of {} in days", planet.name);
        checks.compare(what, period, planet.period, 5e-4 * planet.period);
    }
    let angle = |pick: fn(f64, f64) -> f64| resonance.iter().map(|(_, a)| *a).reduce(pick);
    println!(
        "3λ(Pluto) − 2λ(Neptune) − ϖ(Pluto) stays between {:.0}° and {:.0}°",
        angle(f64::min).unwrap_or(f64::NAN),
        angle(f64::max).unwrap_or(f64::NAN)
    );
    // Each swing crosses the middle once upwards and once downwards.
    let crossings: Vec<f64> = resonance
        .windows(2)
        .filter(|pair| (pair[0].1 < 180.0) != (pair[1].1 < 180.0))
        .map(|pair| pair[0].0)
        .collect();
    let swing = match (crossings.first(), crossings.last()) {
        (Some(first), Some(last)) => 2.0 * (last - first) / (crossings.len() - 1) as f64,
        _ => f64::NAN,
    };
    checks.compare("period of that swing in years", swing, 20_000.0, 500.0);
    let (drift, monitors) = run.observer().inner();
    checks.compare("max |ΔH/H₀|", drift.max_relative(), 0.0, 1e-4);
    for monitor in monitors.all() {
        checks.compare(
            format!("max |Δ {}|", monitor.name),
            monitor.drift.max_absolute(),
            0.0,
            1e-14,
        );
    }
    Figure {
        title: "Neptune and Pluto: the angle that would have to pass 0° for them to meet".into(),
        x: "time in years".into(),
        y: "3λ(Pluto) − 2λ(Neptune) − ϖ(Pluto) in degrees".into(),
        range: Some(0.0..360.0),
        curves: vec![Curve {
            name: String::new(),
            points: resonance,
        }],
        ..Default::default()
    }
    .write(Path::new("target/solar_system/resonance.svg"))?;
    println!("Written to target/solar_system/resonance.svg");
    checks.finish()
}
