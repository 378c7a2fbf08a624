//! Exact flows as they are emitted: each piece of each system against a solution of its own equations
//! in 32 digits, at random points and for times of both signs.
//!
//! The equations are derived from the piece's name, `Description::pieces`, by the reader of the engine's
//! tests: the flow and its reference share the text alone.

#[path = "flows/kepler.rs"]
mod kepler;
#[path = "flows/pieces.rs"]
mod pieces;
#[path = "flows/shapes.rs"]
mod shapes;

use crate::common::systems::Paper34;
use crate::splits::{Body, Dipole, Explodes, Ring, Saddle, Schwarzschild, Vortices};
use hamiltonian::prelude::*;
use pieces::{Case, Each, check};

hamiltonian! {
    /// Orbits of a charge about a black hole in a magnetic field.
    pub struct Magnetised { E = 0.995, L = 4.6, B = 8.9e-4 }
    H(r, th; pr, pt) = (1 - 2/r)*pr^2/2 + pt^2/(2*r^2) - E^2/(2*(1 - 2/r))
        + (L - B*r^2*sin(th)^2/2)^2/(2*r^2*sin(th)^2)
}

hamiltonian! {
    /// Orbits about a rotating black hole in Mino's time.
    pub struct Mino { a = 0.9, E = 0.95, L = 2.5 }
    H(r, th; pr, pt) = (r^2 - 2*r + a^2)*pr^2/2 + pt^2/2 + (a*E*sin(th) - L/sin(th))^2/2
        - ((r^2 + a^2)*E - a*L)^2/(2*(r^2 - 2*r + a^2)) + (r^2 + a^2*cos(th)^2)/2
}

hamiltonian! {
    /// A charge in a uniform field.
    pub struct Gyrating { B = 1.3 }
    H(x, y; px, py) = (px + B*y/2)^2/2 + (py - B*x/2)^2/2
}

hamiltonian! {
    /// A charge in a uniform field, and a potential.
    pub struct Trapped { B = 1.3 }
    H(x, y; px, py) = (px + B*y/2)^2/2 + (py - B*x/2)^2/2 + x^4
}

hamiltonian! {
    /// Oscillators of three frequencies that pull each other, one of them off its centre.
    pub struct Coupled { a = 1.1, b = 2.3, k = 0.4 }
    H(x, y, z; u, v, w) = (u^2 + v^2 + w^2/a)/2 + a*x^2/2 + b*y^2/2 + z^2 + k*(x - y)^2
        + k*(y - z)^2/3 + x*v/5 - k*z
}

hamiltonian! {
    /// A trap that turns, of other strength each way, and a disturbance.
    pub struct Turning { a = 1.1, b = 2.3, w = 0.4 }
    H(x, y; u, v) = (u^2 + v^2)/2 + a*x^2/2 - b*y^2/2 - w*(x*v - y*u) + sin(x*y)
}

hamiltonian! {
    /// Eight oscillators, each with a frequency of its own, on a string.
    pub struct Beads {}
    H(q[8]; p[8]) = (p[0]^2 + p[1]^2 + p[2]^2 + p[3]^2 + p[4]^2 + p[5]^2 + p[6]^2 + p[7]^2)/2
        + q[0]^2/2 + q[1]^2 + 3*q[2]^2/2 + 2*q[3]^2 + 5*q[4]^2/2 + 3*q[5]^2 + 7*q[6]^2/2 + 4*q[7]^2
        + (q[0]*q[1] + q[1]*q[2] + q[2]*q[3] + q[3]*q[4] + q[4]*q[5] + q[5]*q[6] + q[6]*q[7])/2
}

hamiltonian! {
    /// A charge in a dipole, in cylindrical coordinates.
    pub struct Cylindrical {}
    H(r, z, f; pr, pz, pf) = (pr^2 + pz^2)/2 + (pf/r - r/sqrt(r^2 + z^2)^3)^2/2
}

hamiltonian! {
    /// A heavy top without symmetry.
    pub struct Top { A = 1.0, B = 1.4, C = 2.1, m = 0.8 }
    H(f, th, ps; pf, pt, pp) = ((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/(2*A)
        + ((pf - pp*cos(th))*cos(ps)/sin(th) - pt*sin(ps))^2/(2*B) + pp^2/(2*C)
        + m*sin(th)*sin(ps)
}

hamiltonian! {
    /// The restricted problem of three bodies in the frame that turns.
    pub struct ThreeBody { m = 0.0121505856 }
    H(x, y; px, py) = (px^2 + py^2)/2 - x*py + y*px - (1 - m)/sqrt((x + m)^2 + y^2)
        - m/sqrt((x - 1 + m)^2 + y^2)
}

hamiltonian! {
    /// Particles that a wave pushes, which they push back: no component meets its own momentum in
    /// the sum that joins all of them.
    pub struct Beam { n: usize, k: [n], eps = 0.1 }
    H(x[n], f; p[n], w) = sum(i in 0..n) { p[i]^2/2 } + w^2/2 + eps*w*sum(i in 0..n) { sin(k[i]*x[i]) }
}

hamiltonian! {
    /// Hénon and Heiles's system in polar coordinates.
    pub struct Polar { a = 1.0 }
    H(r, th; pr, pt) = pr^2/2 + pt^2/(2*r^2) + r^2/2 + a*r^3*sin(3*th)/3
}

hamiltonian! {
    /// A hydrogen atom in a magnetic field.
    pub struct Zeeman { B = 0.7 }
    H(x, y, z; px, py, pz) = (px^2 + py^2 + pz^2)/2 + B*(x*py - y*px)/2 + 1/sqrt(x^2 + y^2 + z^2)
}

hamiltonian! {
    /// A fast charge in a uniform field, and a potential.
    pub struct Fast { B = 1.3 }
    H(x, y; px, py) = sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2) + x^3*y
}

hamiltonian! {
    /// Two spins.
    pub struct Spins { J = 1.0, D = 0.6 }
    H(a, b; z, w) = J*sqrt(1 - z^2)*sqrt(1 - w^2)*cos(a)*cos(b)
        + J*sqrt(1 - z^2)*sqrt(1 - w^2)*sin(a)*sin(b) + D*z*w
}

hamiltonian! {
    /// A charge in a field whose potential is a polynomial.
    pub struct Sheared {}
    H(x, y, z; px, py, pz) = (px - y^2*z)^2/2 + (py - x*z^2)^2/2 + (pz - x^2*y)^2/2
}

hamiltonian! {
    /// A symmetric heavy top.
    pub struct Lagrange { A = 1.0, C = 0.6, m = 0.8 }
    H(th, f, s; pt, pf, ps) = pt^2/(2*A) + (pf - ps*cos(th))^2/(2*A*sin(th)^2) + ps^2/(2*C)
        + m*cos(th)
}

const ANY: (f64, f64) = (-2.0, 2.0);
/// Radii outside of the forbidden region.
const FAR: (f64, f64) = (2.5, 12.0);
const NEAR: (f64, f64) = (0.4, 2.5);
/// Between the poles.
const POLAR: (f64, f64) = (0.3, 2.8);

macro_rules! flows {
    ($($test:ident: $system:expr, $signature:literal, [$($name:ident = $value:expr),*], $ranges:expr;)*) => {$(
        #[test]
        fn $test() {
            let parameters: &[(&str, &[f64])] = &[$((stringify!($name), &$value)),*];
            check(&$system, &Case { signature: $signature, parameters, ranges: &$ranges });
        }
    )*};
}

flows! {
    paper_34: Paper34::default(), "q; p", [], [ANY, ANY];
    schwarzschild: Schwarzschild::default(), "r, theta; p_r, p_theta", [E = [0.995], L = [4.6]],
        [FAR, POLAR, (-0.5, 0.5), (-4.0, 4.0)];
    magnetised: Magnetised::default(), "r, th; pr, pt", [E = [0.995], L = [4.6], B = [8.9e-4]],
        [FAR, POLAR, (-0.5, 0.5), (-4.0, 4.0)];
    mino: Mino::default(), "r, th; pr, pt", [a = [0.9], E = [0.95], L = [2.5]],
        [FAR, POLAR, (-0.2, 0.2), (-4.0, 4.0)];
    gyrating: Gyrating::default(), "x, y; px, py", [B = [1.3]], [ANY; 4];
    trapped: Trapped::default(), "x, y; px, py", [B = [1.3]], [ANY; 4];
    coupled: Coupled::default(), "x, y, z; u, v, w", [a = [1.1], b = [2.3], k = [0.4]], [ANY; 6];
    turning: Turning::default(), "x, y; u, v", [a = [1.1], b = [2.3], w = [0.4]], [ANY; 4];
    beads: Beads::default(), "q[8]; p[8]", [], [ANY; 16];
    dipole: Dipole::default(), "x, y, z; p_x, p_y, p_z", [],
        [NEAR, ANY, NEAR, ANY, ANY, ANY];
    cylindrical: Cylindrical::default(), "r, z, f; pr, pz, pf", [],
        [NEAR, ANY, ANY, ANY, ANY, ANY];
    body: Body::default(), "l, g; p_l, p_g", [A = [1.0], B = [2.0], C = [3.0]],
        [(-7.0, 7.0), (-7.0, 7.0), (-1.2, 1.2), (1.3, 2.5)];
    top: Top::default(), "f, th, ps; pf, pt, pp", [A = [1.0], B = [1.4], C = [2.1], m = [0.8]],
        [(-7.0, 7.0), POLAR, (-7.0, 7.0), ANY, ANY, ANY];
    lagrange: Lagrange::default(), "th, f, s; pt, pf, ps", [A = [1.0], C = [0.6], m = [0.8]],
        [POLAR, ANY, ANY, ANY, ANY, ANY];
    three_body: ThreeBody::default(), "x, y; px, py", [m = [0.0121505856]], [ANY, NEAR, ANY, ANY];
    polar: Polar::default(), "r, th; pr, pt", [a = [1.0]], [NEAR, (-7.0, 7.0), ANY, ANY];
    zeeman: Zeeman::default(), "x, y, z; px, py, pz", [B = [0.7]],
        [NEAR, ANY, ANY, ANY, ANY, ANY];
    fast: Fast::default(), "x, y; px, py", [B = [1.3]], [ANY; 4];
    spins: Spins::default(), "a, b; z, w", [J = [1.0], D = [0.6]],
        [(-7.0, 7.0), (-7.0, 7.0), (-0.9, 0.9), (-0.9, 0.9)];
    sheared: Sheared::default(), "x, y, z; px, py, pz", [], [(-1.2, 1.2); 6];
    explodes: Explodes::default(), "q; p", [], [ANY; 2];
    saddle: Saddle::default(), "q; p", [], [(-7.0, 7.0), ANY];
    // Two sites are one bond, two vortices one pair: a loop of flows that is a flow.
    ring: Ring::<2>::default(), "q[2]; p[2]", [g = [1.0]], [ANY; 4];
    vortices: Vortices::new(2, vec![1.0, 1.5]).expect("two strengths"), "x[2]; y[2]",
        [k = [1.0, 1.5]], [ANY; 4];
    beam: Beam::new(2, vec![1.0, 1.5]).expect("two charges"), "x[2], f; p[2], w",
        [k = [1.0, 1.5], eps = [0.1]], [ANY; 6];
}

/// Two flows of a quadratic form are one, to the rounding of the numbers they are made in; the whole of H
/// is one piece, whose step is exact however long it is.
#[test]
fn exponentials_are_made_in_the_precision_of_the_scalar() -> Result<(), Error> {
    fn apart<T: Real>(c: f64) -> f64 {
        let system = Coupled::default();
        let prepared = System::prepare::<T>(&system);
        let z: Vec<T> = [0.3, -0.7, 1.1, 0.9, -0.2, 0.4]
            .map(|x| T::constant(x, 0.0))
            .to_vec();
        let start = pieces::point(&system, &z);
        let after = |durations: &[f64]| {
            let mut point = start.clone();
            for c in durations {
                let c = T::constant(*c, 0.0);
                <Coupled as Split>::pieces::<T>().apply(0, &prepared, c, &mut point);
            }
            pieces::flat(&point)
        };
        let (once, twice) = (after(&[1.5 * c]), after(&[2.0 * c, -0.5 * c]));
        let off = once
            .iter()
            .zip(&twice)
            .map(|(a, b)| (*a - *b).to_f64().abs());
        off.fold(0.0, f64::max)
    }
    for (c, size) in [(1e-3, 1.0), (0.5, 1.0), (16.0, 10.0)] {
        let (double, quadruple) = (apart::<f64>(c), apart::<DoubleDouble>(c));
        assert!(double < 2e-15 * size, "{c}: {double:e}");
        assert!(quadruple < 4e-31 * size, "{c}: {quadruple:e}");
    }
    assert_eq!(Coupled::default().description().pieces.len(), 1);
    // Half a million steps lose as much as half a million roundings.
    let system = Coupled::default();
    let start = State::new([0.3, -0.7, 1.1], [0.9, -0.2, 0.4]);
    let mut run = Integrator::new(&system, Strang, start.clone(), 0.01)?;
    let end = run.advance_to(5000.0)?;
    let moved = (system.energy(end) / system.energy(&start) - 1.0).abs();
    assert!(moved < 1e-11, "{moved:e}");
    let mut run = Integrator::new(&system, Strang, start, 5000.0)?;
    let at_once = run.advance_to(5000.0)?;
    let off = (end.q - at_once.q).norm();
    assert!(off < 1e-9, "{off:e}");
    Ok(())
}
