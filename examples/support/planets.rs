//! The Sun and the outer planets on 5 September 1994: E. Hairer, C. Lubich, G. Wanner, Geometric
//! Numerical Integration (2006), table I.2.2; astronomical units, days, masses of the Sun.

use hamiltonian::nalgebra::{Const, Dyn, OMatrix};
use hamiltonian::prelude::*;

/// A planet.
#[allow(dead_code)]
pub struct Body {
    pub name: &'static str,
    pub mass: f64,
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    /// Sidereal period in days (NASA planetary fact sheets); of Pluto, which is pushed about, its
    /// mean, 3/2 of Neptune's.
    pub period: f64,
}

/// The mass of the Sun and the inner planets.
pub const SUN: f64 = 1.00000597682;

#[rustfmt::skip]
pub const PLANETS: [Body; 5] = [
    Body { name: "Jupiter", mass: 0.000954786104043, period: 4_332.589,
        position: [-3.5023653, -3.8169847, -1.5507963],
        velocity: [0.00565429, -0.00412490, -0.00190589] },
    Body { name: "Saturn", mass: 0.000285583733151, period: 10_759.22,
        position: [9.0755314, -3.0458353, -1.6483708],
        velocity: [0.00168318, 0.00483525, 0.00192462] },
    Body { name: "Uranus", mass: 0.0000437273164546, period: 30_685.4,
        position: [8.3101420, -16.2901086, -7.2521278],
        velocity: [0.00354178, 0.00137102, 0.00055029] },
    Body { name: "Neptune", mass: 0.0000517759138449, period: 60_189.0,
        position: [11.4707666, -25.7294829, -10.8169456],
        velocity: [0.00288930, 0.00114527, 0.00039677] },
    Body { name: "Pluto", mass: 1.0/1.3e8, period: 1.5*60_189.0,
        position: [-15.5387357, -25.2225594, -3.1902382],
        velocity: [0.00276725, -0.00170702, -0.00136504] },
];

/// The masses, and the state with the Sun at rest in the middle.
pub fn start() -> (Vec<f64>, State<OMatrix<f64, Dyn, Const<3>>>) {
    let mut masses = vec![SUN];
    let mut positions = vec![[0.0; 3]];
    let mut momenta = vec![[0.0; 3]];
    for planet in &PLANETS {
        masses.push(planet.mass);
        positions.push(planet.position);
        momenta.push(planet.velocity.map(|v| planet.mass * v));
    }
    (masses, State::new(positions, momenta))
}
