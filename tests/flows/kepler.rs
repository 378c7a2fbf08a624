//! Kepler's flow as it is emitted: every conic, long times, the bits of lanes, and the centre.

use super::pieces::{Case, Each, check, flat, point};
use crate::common::geometry::{defect, one_point};
use hamiltonian::VectorOf;
use hamiltonian::errors::StepError;
use hamiltonian::prelude::*;
use hamiltonian::schemes::Strang;
use hamiltonian::{DoubleDouble, Dual, Error, Real, Split, System, schemes::author::Point};

hamiltonian! {
    /// An orbit about a centre that attracts or repels, and a weak field.
    pub struct Orbit { m = 0.7, k = 1.3, g = 0.1 }
    H(x, y, z; px, py, pz) = (px^2 + py^2 + pz^2)/(2*m) - k/sqrt(x^2 + y^2 + z^2) + g*z;
    split {
        Free = (px^2 + py^2 + pz^2)/(2*m) - k/sqrt(x^2 + y^2 + z^2);
        Field = g*z;
    }
}

hamiltonian! {
    /// An orbit in a plane, and a weak field.
    pub struct Plane { k = 1.0, g = 0.1 }
    H(x, y; px, py) = (px^2 + py^2)/2 - k/hypot(x, y) + g*x;
    split {
        Free = (px^2 + py^2)/2 - k/hypot(x, y);
        Field = g*x;
    }
}

const ANY: (f64, f64) = (-2.0, 2.0);
const NEAR: (f64, f64) = (0.4, 2.5);

#[test]
fn orbits_are_those_of_the_equations() {
    for k in [1.3, -1.3] {
        let orbit = Orbit {
            k,
            ..Default::default()
        };
        let case = Case {
            signature: "x, y, z; px, py, pz",
            parameters: &[("m", &[0.7]), ("k", &[k]), ("g", &[0.1])],
            ranges: &[NEAR, ANY, NEAR, ANY, ANY, ANY],
        };
        check(&orbit.piece_free(), &case);
    }
    let plane = Plane::default();
    let case = Case {
        signature: "x, y; px, py",
        parameters: &[("k", &[1.0]), ("g", &[0.1])],
        ranges: &[NEAR, ANY, ANY, ANY],
    };
    check(&plane.piece_free(), &case);
}

/// The flow of the plane's free orbit for a time.
fn flow<T: Real>(z: &[T], t: T) -> Vec<T>
where
    Plane: Split,
    <Plane as Split>::Pieces<T>: Each<T, <Plane as System>::Prepared<T>, Point<VectorOf<Plane, T>>>,
{
    let plane = Plane::default();
    let prepared = System::prepare::<T>(&plane);
    let mut point = point::<T, Plane>(&plane, z);
    <Plane as Split>::pieces::<T>().apply(0, &prepared, t, &mut point);
    flat(&point)
}

fn exactly(z: &[f64]) -> Vec<DoubleDouble> {
    z.iter().copied().map(DoubleDouble::from).collect()
}

/// The largest |a − b|.
fn apart<T: Real>(a: &[T], b: &[T]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (*a - *b).magnitude());
    differences.fold(0.0, f64::max)
}

/// The tangent of the flow, column by column.
fn tangent(z: &[f64], t: f64) -> Vec<Vec<f64>> {
    let column = |k: usize| {
        let mut seeded: Vec<_> = z.iter().map(|x| Dual::fixed(*x)).collect();
        seeded[k].eps = 1.0;
        flow(&seeded, Dual::fixed(t))
            .iter()
            .map(|x| x.eps)
            .collect()
    };
    (0..z.len()).map(column).collect()
}

/// From the pericentre at distance 1: v² = 1 + e.
fn pericentre(e: f64) -> [f64; 4] {
    [1.0, 0.0, 0.0, (1.0 + e).sqrt()]
}

#[test]
fn every_conic_is_followed_to_rounding() {
    const TIMES: [f64; 9] = [1e-9, 1e-3, 0.1, 1.0, -0.3, 7.0, -50.0, 100.0, 3000.0];
    let eccentricities = [0.0, 0.5, 0.9, 0.999, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5, 20.0];
    let mut worst = [0.0_f64; 4];
    let mut late = 0.0_f64;
    for e in eccentricities {
        // From far in to far out on a hyperbola f and g cancel as no time does elsewhere.
        let times = if e > 2.0 { &TIMES[..6] } else { &TIMES[..] };
        for &t in times {
            // Off the pericentre, so that the orbit goes through it.
            let z = flow(&pericentre(e), -0.4 * t);
            let exact = flow(&exactly(&z), DoubleDouble::from(t));
            let (end, columns) = (flow(&z, t), tangent(&z, t));
            let (off, square) = defect(&columns, one_point(2));
            let size = 1.0 + square.sqrt();
            let twice = flow(&flow(&z, 0.25 * t), 0.75 * t);
            let energy = |z: &[f64]| (z[2] * z[2] + z[3] * z[3]) / 2.0 - 1.0 / z[0].hypot(z[1]);
            let steep = |z: &[f64]| (z[2].hypot(z[3])).max(1.0 / (z[0] * z[0] + z[1] * z[1]));
            let slope = 1.0 + steep(&z).max(steep(&end));
            let found = [
                apart(&exactly(&end), &exact) / size,
                apart(&end, &twice) / size,
                (energy(&end) - energy(&z)).abs() / (slope * size),
                off / square.max(1.0),
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                assert!(!found.is_nan(), "e = {e}, t = {t}: {end:?} {exact:?}");
                *worst = worst.max(found);
            }
            late = late.max(apart(&flow(&z, t * (1.0 + 1e-9)), &end) / size);
        }
    }
    println!("flow, group, energy, form: {worst:?}");
    assert!(worst.iter().all(|x| *x < 1e-13), "{worst:?}");
    // A flow a billionth too long would not pass.
    assert!(late > 1e-13, "{late:e}");
}

#[test]
fn an_orbit_closes_after_its_periods() {
    // e = 0.9, major semiaxis 10: the period is 2π·10^{3/2}.
    let start = pericentre(0.9);
    let thousand = DoubleDouble::from(1000.0);
    let ten = DoubleDouble::from(10.0);
    let period = (-DoubleDouble::one()).acos() * (ten + ten) * ten.sqrt();
    // v² = 1.9 and the semiaxis are those of a double's root to rounding only.
    let mut exact = exactly(&start);
    exact[3] = (DoubleDouble::from(19.0) / ten).sqrt();
    let end = flow(&exact, thousand * period);
    let off = apart(&end, &exact);
    println!("after 1000 periods: {off:e}");
    assert!(off < 1e-24, "{off:e}");
    // A hair less is another place.
    assert!(
        apart(
            &flow(&exact, thousand * period * DoubleDouble::from(1.0 - 1e-15)),
            &exact
        ) > 1e-12
    );
    // In doubles, the rounding of the start as it has grown in that time.
    let t = (thousand * period).to_f64();
    let size = defect(&tangent(&start, t), one_point(2)).1.sqrt();
    let off = apart(&flow(&start, t), &start) / size;
    println!("in doubles: {off:e} of {size:e}");
    assert!(off < 1e-15, "{off:e}");
}

#[test]
fn the_centre_is_an_error() {
    let slant = |r: f64, v: f64| [0.6 * r, -0.8 * r, 0.6 * v, -0.8 * v];
    let lost = |z: [f64; 4], t: f64| flow(&z, t).iter().all(|x| x.is_nan());
    // From rest at distance 1 the centre is π/√8 away, both ways in time.
    let fall = std::f64::consts::PI / 8f64.sqrt();
    for side in [1.0, -1.0] {
        assert!(!lost(slant(1.0, 0.0), side * 0.999 * fall));
        for later in [1.001, 1.5, 2.5, 40.0] {
            assert!(lost(slant(1.0, 0.0), side * later * fall), "{side} {later}");
        }
    }
    // Up and down again takes more than half of a period and does not meet it.
    let up = flow(&slant(1.0, 0.0), -0.9 * fall);
    let back = flow(&up, 1.8 * fall);
    assert!(
        (back[0] - up[0]).abs() < 1e-13 && (back[2] + up[2]).abs() < 1e-13,
        "{back:?} {up:?}"
    );
    assert!(lost([up[0], up[1], up[2], up[3]], 1.95 * fall));
    // Too fast to come back; inward it arrives.
    assert!(!lost(slant(1.0, 2.0), 100.0) && lost(slant(1.0, 2.0), -100.0));
    assert!(lost([0.0; 4], 0.1));
    // In a run it is an error with the piece's name, the place, and no value.
    let plane = Plane {
        g: 0.0,
        ..Default::default()
    };
    let start = State::new([1.0, 0.0], [0.0, 0.0]);
    let mut run = Integrator::new(&plane, Strang, start, 0.1).expect("a good start");
    let error = run.advance(100).expect_err("it falls into the centre");
    println!("{error}");
    assert!(
        matches!(&error, Error::Step(StepError::NotFinite { piece: Some(piece), .. }) if **piece == *"Free"),
        "{error:?}"
    );
}
