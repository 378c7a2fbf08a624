//! Kepler's problem in the plane, and in even steps of the distance.

use super::systems::{Formula, Halves, Hand};
use hamiltonian_core::private::SVector;
use hamiltonian_core::{
    Autonomous, QuadraticKinetic, Real, State, TimeTransformed, schemes::author::Group,
};

/// Kepler's problem in the plane.
#[derive(Debug, Clone)]
pub struct Kepler;

impl Formula<2> for Kepler {
    const NAME: &'static str = "Kepler";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let half = T::constant(0.5, 0.0);
        half * (*px * *px + *py * *py) - T::one() / (*x * *x + *y * *y).sqrt()
    }
}

impl Halves<2> for Kepler {
    fn force<T: Real>(&self, _: T, [x, y]: &[T; 2]) -> [T; 2] {
        let square = *x * *x + *y * *y;
        let cube = square * square.sqrt();
        [*x / cube, *y / cube]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 2]) -> [T; 2] {
        *p
    }
}

/// g = √(x² + y²), and a term of p_y where it is asked for.
#[derive(Debug, Clone)]
pub struct Radius {
    with_momentum: bool,
}

impl Formula<2> for Radius {
    const NAME: &'static str = "Radius";
    const GROUPS: &'static [Group] = Kepler::GROUPS;
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], p: &[T; 2]) -> T {
        let radius = (*x * *x + *y * *y).sqrt();
        if self.with_momentum {
            radius + T::constant(0.125, 0.0) * p[1] * p[1]
        } else {
            radius
        }
    }
}

impl Autonomous for Hand<Kepler, 2> {}
impl Autonomous for Hand<Radius, 2> {}
impl QuadraticKinetic for Hand<Kepler, 2> {}

pub type InRadius = TimeTransformed<Hand<Kepler, 2>, Hand<Radius, 2>>;

pub fn in_radius(with_momentum: bool) -> InRadius {
    TimeTransformed::new(Hand(Kepler), Hand(Radius { with_momentum }))
}

/// An ellipse of eccentricity e from its pericentre; H = −1/2.
pub fn pericentre<T: Real>(e: f64) -> State<SVector<T, 2>> {
    let number = |x: f64| T::constant(x, 0.0);
    let speed = (number(1.0 + e) / number(1.0 - e)).sqrt();
    State::over([number(1.0 - e), T::zero()], [T::zero(), speed])
}
