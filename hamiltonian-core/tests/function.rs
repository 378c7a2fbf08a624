//! Splines and grids: the conditions that define them, packs against single numbers, bad knots.

use hamiltonian_core::{
    Dual, Real,
    errors::KnotError,
    systems::function::{Function, Grid, Spline},
};
use hamiltonian_lanes::{Nf, W};

const KNOTS: [f64; 7] = [-1.0, -0.4, 0.1, 0.2, 1.3, 2.0, 3.5];

fn values() -> Vec<f64> {
    KNOTS.iter().map(|x| (1.3 * x).sin() + 0.1 * x).collect()
}

/// Value, slope and curvature.
fn jet<F: Function<1>>(f: &F, x: f64) -> [f64; 3] {
    let y = f.value([Dual::new(Dual::variable(x), Dual::fixed(1.0))]);
    [y.re.re, y.re.eps, y.eps.eps]
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * (1.0 + b.abs())
}

/// The spline passes through the values, and is twice continuously differentiable at inner knots.
fn is_spline(spline: &Spline, values: &[f64]) {
    const AWAY: f64 = 1e-9;
    for (i, (knot, value)) in KNOTS.iter().zip(values).enumerate() {
        assert!(near(spline.value([*knot]), *value), "knot {i}");
        if i == 0 || i + 1 == KNOTS.len() {
            continue;
        }
        let (left, right) = (jet(spline, knot - AWAY), jet(spline, knot + AWAY));
        for k in 0..3 {
            assert!(
                (left[k] - right[k]).abs() < 1e-7,
                "derivative {k} at knot {i}"
            );
        }
    }
}

#[test]
fn splines_satisfy_their_conditions() -> Result<(), KnotError> {
    let values = values();
    let [first, last] = [KNOTS[0], KNOTS[6]];
    let natural = Spline::natural(&KNOTS, &values)?;
    is_spline(&natural, &values);
    for end in [first, last] {
        assert!(jet(&natural, end)[2].abs() < 1e-12);
    }
    let clamped = Spline::clamped(&KNOTS, &values, [0.7, -2.0])?;
    is_spline(&clamped, &values);
    assert!(near(jet(&clamped, first)[1], 0.7) && near(jet(&clamped, last)[1], -2.0));
    let mut around = values.clone();
    around[6] = around[0];
    let periodic = Spline::periodic(&KNOTS, &around)?;
    is_spline(&periodic, &around);
    for k in 0..3 {
        let (start, end) = (jet(&periodic, first), jet(&periodic, last - 1e-9));
        assert!(
            (start[k] - end[k]).abs() < 1e-7,
            "derivative {k} at the seam"
        );
    }
    for x in [-0.9, 0.15, 3.4] {
        let turned = jet(&periodic, x - 3.0 * (last - first));
        for (a, b) in turned.iter().zip(jet(&periodic, x)) {
            assert!((a - b).abs() < 1e-12);
        }
    }
    Ok(())
}

/// A cubic polynomial is its own clamped spline, a line its own natural spline.
#[test]
fn splines_reproduce_polynomials() -> Result<(), KnotError> {
    let cubic = |x: f64| ((0.5 * x - 1.0) * x + 2.0) * x + 0.25;
    let slope = |x: f64| (1.5 * x - 2.0) * x + 2.0;
    let spline = Spline::clamped(&KNOTS, &KNOTS.map(cubic), [slope(-1.0), slope(3.5)])?;
    let line = Spline::natural(&KNOTS[..2], &[1.0, 4.0])?;
    for k in 0..=90 {
        let x = -1.0 + 0.05 * f64::from(k);
        let [value, first, second] = jet(&spline, x);
        assert!(near(value, cubic(x)) && near(first, slope(x)), "{x}");
        assert!((second - (3.0 * x - 2.0)).abs() < 1e-11, "{x}");
    }
    assert!(near(line.value([-0.7]), 2.5));
    Ok(())
}

/// The error falls with the fourth power of the spacing.
#[test]
fn splines_are_of_fourth_order() -> Result<(), KnotError> {
    let error = |n: usize| -> Result<f64, KnotError> {
        let knots: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
        let values: Vec<f64> = knots.iter().map(|x| x.exp()).collect();
        let spline = Spline::clamped(&knots, &values, [1.0, 1f64.exp()])?;
        let off = |k: i32| {
            let x = f64::from(k) / 1000.0;
            (spline.value([x]) - x.exp()).abs()
        };
        Ok((0..=1000).map(off).fold(0.0, f64::max))
    };
    let slope = (error(8)? / error(64)?).log2() / 3.0;
    assert!((3.8..4.2).contains(&slope), "{slope}");
    Ok(())
}

fn table() -> Vec<Vec<f64>> {
    let at = |i: i32, j: i32| (0.4 * f64::from(i)).sin() + 0.2 * f64::from(i * j) - f64::from(j);
    (0..6).map(|i| (0..5).map(|j| at(i, j)).collect()).collect()
}

#[test]
fn grids_pass_through_their_values() -> Result<(), KnotError> {
    let rows = table();
    let natural = Grid::natural([1.0, -2.0], [0.5, 0.25], &rows)?;
    let periodic = Grid::periodic([1.0, -2.0], [0.5, 0.25], &rows)?;
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let at = [1.0 + 0.5 * i as f64, -2.0 + 0.25 * j as f64];
            assert!(near(natural.value(at), *value), "natural {i} {j}");
            assert!(near(periodic.value(at), *value), "periodic {i} {j}");
            let turned = [at[0] + 3.0 * 6.0 * 0.5, at[1] - 5.0 * 0.25];
            assert!(
                near(periodic.value(turned), *value),
                "a period away {i} {j}"
            );
        }
    }
    // Straight across the edge, and continuous across the lines of the grid.
    let second = |grid: &Grid, x: f64, y: f64| {
        let x = Dual::new(Dual::variable(x), Dual::fixed(1.0));
        let y = Dual::fixed(Dual::fixed(y));
        grid.value([x, y]).eps.eps
    };
    assert!(second(&natural, 1.0, -1.6).abs() < 1e-12);
    for grid in [&natural, &periodic] {
        let [left, right] = [-1e-9, 1e-9].map(|away| second(grid, 2.0 + away, -1.6));
        assert!((left - right).abs() < 1e-6);
    }
    assert!(natural.value([0.99_f64, -1.6]).is_nan() && natural.value([1.0_f64, -0.99]).is_nan());
    Ok(())
}

/// Every lane of a pack has the bits of its number alone, derivatives too.
#[test]
fn packs_look_up_lane_by_lane() -> Result<(), KnotError> {
    type Eight = W<Nf<f64>, 8>;
    let spline = Spline::natural(&KNOTS, &values())?;
    let grid = Grid::periodic([0.0; 2], [0.5; 2], &table())?;
    let x = [-0.9, 3.4, 0.15, -5.0, 0.1, f64::NAN, 2.0, -1.0];
    let y = [0.3, 100.0, -7.7, 0.0, 2.5, 1.0, f64::INFINITY, 1e300];
    let pack = |numbers: [f64; 8]| W(numbers.map(Nf));
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    let of_spline = spline.value([Dual::<Eight>::variable(pack(x))]);
    let of_grid = grid.value([Dual::<Eight>::fixed(pack(x)), Dual::variable(pack(y))]);
    for k in 0..8 {
        let lane = k as u32;
        let one = spline.value([Dual::variable(x[k])]);
        assert!(same(of_spline.re.lane(lane), one.re), "spline {k}");
        assert!(same(of_spline.eps.lane(lane), one.eps), "slope {k}");
        let one = grid.value([Dual::fixed(x[k]), Dual::variable(y[k])]);
        assert!(same(of_grid.re.lane(lane), one.re), "grid {k}");
        assert!(
            same(of_grid.eps.lane(lane), one.eps),
            "slope of the grid {k}"
        );
    }
    Ok(())
}

#[test]
fn bad_knots_are_refused() {
    let refused = |knots: &[f64], values: &[f64]| Spline::natural(knots, values).unwrap_err();
    assert_eq!(
        refused(&[0.0], &[1.0]).to_string(),
        "1 knots are too few: at least 2 are needed"
    );
    assert_eq!(
        refused(&[0.0, 1.0], &[1.0]).to_string(),
        "2 knots have 1 values"
    );
    assert_eq!(
        refused(&[0.0, 2.0, 2.0], &[1.0; 3]).to_string(),
        "knot 2 is 2, and must be above knot 1, which is 2"
    );
    assert_eq!(
        refused(&[0.0, 1.0], &[1.0, f64::NAN]).to_string(),
        "value 1 is NaN, and must be finite"
    );
    let clamped = Spline::clamped(&[0.0, 1.0], &[1.0; 2], [f64::INFINITY, 0.0]);
    assert_eq!(
        clamped.unwrap_err().to_string(),
        "slope 0 is inf, and must be finite"
    );
    assert!(matches!(
        Spline::periodic(&[0.0, 1.0, 2.0], &[1.0; 3]),
        Err(KnotError::TooFew {
            needed: 4,
            found: 3,
            ..
        })
    ));
    assert!(matches!(
        Grid::natural([0.0; 2], [1.0, 0.0], &table()),
        Err(KnotError::Spacing { index: 1, .. })
    ));
    let mut ragged = table();
    ragged[3].pop();
    assert!(matches!(
        Grid::natural([0.0; 2], [1.0; 2], &ragged),
        Err(KnotError::Lengths {
            knots: 5,
            values: 4,
            ..
        })
    ));
    let none: [[f64; 4]; 0] = [];
    assert!(matches!(
        Grid::periodic([0.0; 2], [1.0; 2], &none),
        Err(KnotError::TooFew { found: 0, .. })
    ));
}

#[test]
fn fingerprints_tell_data_apart() -> Result<(), KnotError> {
    let mut values = values();
    let one = Spline::natural(&KNOTS, &values)?;
    assert_eq!(one.fingerprint(), one.clone().fingerprint());
    let clamped = Spline::clamped(&KNOTS, &values, [0.0; 2])?;
    assert_ne!(one.fingerprint(), clamped.fingerprint());
    values[3] = f64::from_bits(values[3].to_bits() + 1);
    let other = Spline::natural(&KNOTS, &values)?;
    assert_ne!(one.fingerprint(), other.fingerprint());
    let grids = [
        Grid::natural([0.0; 2], [1.0; 2], &table())?,
        Grid::periodic([0.0; 2], [1.0; 2], &table())?,
    ];
    assert_ne!(grids[0].fingerprint(), grids[1].fingerprint());
    Ok(())
}
