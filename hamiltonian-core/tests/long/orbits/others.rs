//! Orbits of Kepler's problem, all of which close, and of the system of Hénon and Heiles, some of which do.
//!
//! Input: random places, energies, periods and settings. Output: orbits and errors. Each orbit is followed by another
//! scheme, and Kepler's third law has the period.

use super::*;
use hamiltonian::errors::SearchError;

/// The width of a path, half a period forwards and half backwards: coordinates, then momenta.
fn widths(system: &Hand<Planar, 2>, guess: &Place, period: f64) -> Option<[f64; 2]> {
    let mut states = vec![guess.clone()];
    for step in [period / 1_000.0, -period / 1_000.0] {
        let scheme = Gauss::<2>::default();
        let mut run = Integrator::new(system, scheme, guess.clone(), step).ok()?;
        for _ in 0..100 {
            states.push(run.advance(5).ok()?.clone());
        }
    }
    let of = |number: &dyn Fn(&Place) -> f64| {
        let all = states.iter().map(number);
        let most = all.clone().fold(f64::NEG_INFINITY, f64::max);
        most - all.fold(f64::INFINITY, f64::min)
    };
    let wide = |i| (of(&|state| state.q[i]), of(&|state| state.p[i]));
    let ((x, p_x), (y, p_y)) = (wide(0), wide(1));
    Some([x.max(y), p_x.max(p_y)])
}

/// A guess with an energy, and a guess of the period, at some place on an orbit.
fn rough(planar: &Planar, random: &mut Random) -> (Place, f64) {
    let mut off = |x: f64| x * random.between(0.93, 1.07);
    match planar {
        Planar::Kepler => {
            // At an end of an ellipse, on either side, in either direction.
            let a = off(1.0) * 2f64.powf(random.between(-1.0, 1.0));
            let e = random.between(0.0, 0.3) * if random.below(2) == 0 { 1.0 } else { -1.0 };
            let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let (x, speed) = (a * (1.0 - e), ((1.0 + e) / (a * (1.0 - e))).sqrt());
            let mut by = || 0.05 * random.between(-1.0, 1.0);
            let state = State::new([side * x, by() * x], [by() * speed, speed + by() * speed]);
            (state, a)
        }
        _ => {
            let size = random.between(0.05, 0.5);
            let angle = TAU * random.below(3) as f64 / 3.0 + PI / 2.0;
            let (q, p) = match random.below(4) {
                // Round the origin, in either direction.
                0 => ([size, 0.0], [0.0, size]),
                1 => ([size, 0.0], [0.0, -size]),
                // Along the three axes.
                2 => ([0.0; 2], [size * angle.cos(), size * angle.sin()]),
                _ => ([size, 0.0], [0.0, random.between(-0.5, 0.5)]),
            };
            let mut by = || 0.07 * size * random.between(-1.0, 1.0);
            let state = State::new([q[0] + by(), by()], [p[0] + by(), p[1] + by()]);
            (
                state,
                TAU * [1.0, 1.0, 1.0, 2.0, 3.0][random.below(5) as usize],
            )
        }
    }
}

/// Kepler's ellipses, which all close, and orbits of Hénon and Heiles, some of which do: what is found is one.
#[test]
fn orbits_of_kepler_and_of_henon_and_heiles_are_periodic() {
    let mut found = [0; 2];
    let mut unclosed = 0;
    for seed in 0..cases(300, 3_000) {
        let mut random = Random(30_000 + seed);
        let is_kepler = seed.is_multiple_of(4);
        let planar = if is_kepler {
            Planar::Kepler
        } else {
            Planar::HenonHeiles
        };
        let (guess, mut near) = rough(&planar, &mut random);
        let system = Hand(planar);
        let energy = System::energy(&system, &guess);
        // Kepler's third law.
        let third = |energy: f64| TAU * (-2.0 * energy).powf(-1.5);
        if is_kepler {
            near = third(energy);
        } else if !(0.0..0.165).contains(&energy) {
            // Orbits escape.
            continue;
        }
        let section = "axis";
        let is_by_energy = random.below(3) > 0;
        let closing = match is_by_energy {
            true => Closing::OfEnergy {
                near: near * random.between(0.95, 1.05),
                section,
            },
            false => Closing::OfPeriod {
                period: near * random.between(0.98, 1.05),
                section,
            },
        };
        let mut search = OrbitSearch::new(closing, if is_kepler { 160 } else { 40 })
            .with_arcs(1 + random.below(8) as usize);
        if is_kepler && random.below(2) == 0 {
            search = search.with_symmetry(&MIRROR);
        }
        let place = format!("seed {seed}: {system:?}, {guess:?}, {search:?}");
        let Some(guessed) = widths(&system, &guess, near) else {
            continue;
        };
        // Control: guesses that do not close.
        let orbit = PeriodicOrbit {
            start: guess.clone(),
            period: near,
            gap: 0.0,
            monodromy: nalgebra::DMatrix::zeros(0, 0),
        };
        let apart = |a: &Place, b: &Place| {
            let largest = |by: SVector<f64, 2>| by[0].abs().max(by[1].abs());
            [largest(a.q - b.q), largest(a.p - b.p)]
        };
        let (end, width) = followed(&system, &orbit);
        unclosed += usize::from(!is_kepler && apart(&end, &guess)[0] > 1e-3 * width);
        let orbit = match search.find(&system, Gauss::<4>::default(), guess.clone()) {
            Ok(orbit) => orbit,
            Err(
                Error::Search(
                    SearchError::NoPeriodicOrbit { .. }
                    | SearchError::FarOrbit { .. }
                    | SearchError::PointOrbit { .. },
                )
                | Error::Step(_),
            ) => continue,
            Err(error) => panic!("{place}: {error}"),
        };
        found[usize::from(is_kepler)] += 1;
        let (end, width) = followed(&system, &orbit);
        let growth = orbit
            .monodromy
            .iter()
            .fold(1.0, |most: f64, x| most.max(x.abs()));
        let gap = apart(&end, &orbit.start);
        assert!(
            gap[0] < 1e-4 * width + 1e-8 * growth,
            "{gap:?} {width} {place}: {orbit:?}"
        );
        // It moves, as far as the guess does, and begins near it.
        assert!(
            width > guessed[0] / 32.0,
            "{width} {guessed:?} {place}: {orbit:?}"
        );
        let far = apart(&orbit.start, &guess);
        for half in 0..2 {
            assert!(
                far[half] < 0.55 * guessed[half] + 1e-9,
                "{far:?} {guessed:?} {place}: {orbit:?}"
            );
        }
        assert!(orbit.start.q[1].abs() < 1e-9, "{place}: {orbit:?}");
        let reached = System::energy(&system, &orbit.start);
        match is_by_energy {
            true => assert!((reached - energy).abs() < 1e-11, "{place}: {orbit:?}"),
            false => assert!(
                closing
                    == Closing::OfPeriod {
                        period: orbit.period,
                        section
                    },
                "{place}"
            ),
        }
        if is_kepler {
            let known = third(reached);
            assert!(
                (orbit.period - known).abs() < 1e-4 * known,
                "{known} {place}: {orbit:?}"
            );
        }
    }
    assert!(
        found[0] > 100 && found[1] > 30 && unclosed > 100,
        "{found:?} {unclosed}"
    );
}
