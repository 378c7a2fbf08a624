//! Periodic orbits against known ones.

use hamiltonian::errors::SearchError;
use hamiltonian::prelude::*;

hamiltonian! {
    /// The circular restricted three-body problem in the turning frame.
    pub struct ThreeBody { mu = 1/82.45 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y
        - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - 1 + mu, y);
    event axis = y
}

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    event level = y
}

hamiltonian! {
    /// An oscillator under a force of period 2π: x = a·cos(t)/(k − 1) comes back.
    pub struct Driven { a = 0.3, k = 2.5 }
    H(x; p; t) = p^2/2 + k*x^2/2 - a*x*cos(t)
}

/// R. F. Arenstorf's orbit from x = 1.2 (L. F. Shampine and M. K. Gordon, *Computer Solution of Ordinary
/// Differential Equations*, 1975).
#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn the_orbit_of_arenstorf_is_found() -> Result<(), Error> {
    let (speed, period) = (-1.049_357_509_830_319_9, 6.192_169_331_319_64);
    let guess = State::new([1.199, 0.0], [1e-3, 1.2 + speed - 1e-3]);
    let closing = Closing::OfPeriod {
        period,
        section: "axis",
    };
    let orbit = PeriodicOrbit::find(
        &ThreeBody::default(),
        Gauss::<6>::default(),
        guess,
        closing,
        2_000,
    )?;
    let (q, p) = (orbit.start.q, orbit.start.p);
    for (found, known) in [(q[0], 1.2), (q[1], 0.0), (p[0], 0.0), (p[1], 1.2 + speed)] {
        assert!((found - known).abs() < 1e-8, "{found} {known}");
    }
    Ok(())
}

/// The orbit along the axis x = 0, whose period is an integral.
#[test]
fn the_straight_orbit_of_henon_heiles_is_found() -> Result<(), Error> {
    let guess = State::new([2e-3, 0.0], [-1e-3, 0.5]);
    let system = HenonHeiles {};
    let energy = system.energy(&guess);
    let closing = Closing::OfEnergy {
        near: 7.55,
        section: "level",
    };
    let orbit = PeriodicOrbit::find(&system, KahanLi8.of(Strang), guess, closing, 400)?;
    let (x, p_x) = (orbit.start.q[0], orbit.start.p[0]);
    assert!(x.abs() < 1e-9 && p_x.abs() < 1e-9, "{x} {p_x}");
    assert!((system.energy(&orbit.start) - energy).abs() < 1e-14);
    // E − y²/2 + y³/3 = (y − a)(b − y)(c − y)/3: the roots by Newton's method.
    let root = |mut y: f64| {
        for _ in 0..50 {
            y -= (energy - y * y / 2.0 + y * y * y / 3.0) / (y * y - y);
        }
        y
    };
    let (a, b, c) = (root(-0.4), root(0.6), root(1.4));
    let points = 400;
    let mut period = 0.0;
    for i in 0..points {
        let angle = std::f64::consts::PI * ((i as f64 + 0.5) / points as f64 - 0.5);
        let y = (a + b) / 2.0 + (b - a) / 2.0 * angle.sin();
        period += 2.0 * std::f64::consts::PI / points as f64 / (2.0 / 3.0 * (c - y)).sqrt();
    }
    assert!(
        (orbit.period - period).abs() < 1e-9,
        "{} {period}",
        orbit.period
    );
    // One pair of multipliers is 1.
    let near = |mu: &&hamiltonian::nalgebra::Complex<f64>| (mu.re - 1.0).abs() + mu.im.abs() < 1e-4;
    assert_eq!(orbit.multipliers().iter().filter(near).count(), 2);
    Ok(())
}

#[test]
fn a_driven_orbit_is_found() -> Result<(), Error> {
    let system = Driven::default();
    let closing = Closing::Driven {
        period: std::f64::consts::TAU,
    };
    let guess = State::new([-1.0], [0.7]);
    let orbit = PeriodicOrbit::find(&system, BlanesMoan6, guess, closing, 400)?;
    assert!((orbit.start.q[0] - system.a / (system.k - 1.0)).abs() < 1e-9);
    assert!(orbit.start.p[0].abs() < 1e-9 && orbit.gap < 1e-12);
    Ok(())
}

#[test]
fn an_unknown_section_and_rest_are_errors() {
    let system = HenonHeiles {};
    let find = |section, near| {
        let closing = Closing::OfEnergy { near, section };
        PeriodicOrbit::find(
            &system,
            BlanesMoan4,
            State::new([0.1, 0.0], [0.0, 0.3]),
            closing,
            20,
        )
    };
    let error = find("levle", 6.3).unwrap_err().to_string();
    let expected =
        "`HenonHeiles` declares no monitor, invariant or event `levle`\nhelp: it declares `level`";
    assert_eq!(error, expected);
    // With a period of 0 every start would be an orbit.
    let error = find("level", 1.0).unwrap_err();
    let Error::Search(SearchError::NoPeriodicOrbit { gap, period, .. }) = error else {
        panic!("{error}");
    };
    assert!(gap > 1e-3 && period >= 0.5, "{gap}, {period}");
    let closing = Closing::Driven { period: 1.0 };
    // After a time shorter than all periods only rest is back.
    let error = PeriodicOrbit::find(
        &system,
        BlanesMoan4,
        State::new([0.1, 0.0], [0.0, 0.3]),
        closing,
        20,
    );
    let error = error.unwrap_err();
    assert!(
        matches!(error, Error::Search(SearchError::PointOrbit { .. })),
        "{error}"
    );
}

hamiltonian! {
    /// An oscillator whose strength changes: the point of rest has multipliers (Mathieu's equation).
    pub struct Swung { a = 0.3 }
    H(q; p; t) = p^2/2 + (1 + a*cos(t))*q^2/2
}

#[test]
fn a_point_of_a_driven_system_is_an_orbit() -> Result<(), Error> {
    let closing = Closing::Driven {
        period: std::f64::consts::TAU,
    };
    for q in [0.1, 0.0] {
        let guess = State::new([q], [0.0]);
        let search = OrbitSearch::new(closing, 200).with_reach(2.0);
        let orbit = search.find(&Swung::default(), BlanesMoan4, guess)?;
        assert!(orbit.start.q[0].abs() < 1e-12);
        let product = orbit
            .multipliers()
            .iter()
            .map(|mu| mu.re.hypot(mu.im))
            .product::<f64>();
        assert!((product - 1.0).abs() < 1e-9);
    }
    Ok(())
}
