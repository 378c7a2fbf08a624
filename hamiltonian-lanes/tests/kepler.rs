//! Kepler's equation and Stumpff's functions against 32 digits.

use hamiltonian_lanes::{DoubleDouble, Dual, Real};

/// A generator of numbers in [0, 1).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    /// Of either sign, sizes of many powers of ten.
    fn wide(&mut self, decades: f64) -> f64 {
        let size = 10f64.powf(decades * (2.0 * self.unit() - 1.0));
        if self.unit() < 0.5 { -size } else { size }
    }
}

#[test]
fn stumpff_functions_are_accurate() {
    let mut random = Random(3);
    let mut worst = [0.0_f64; 2];
    for _ in 0..20_000 {
        let psi = random.wide(3.0);
        if psi < -1e3 {
            continue;
        }
        let exact = DoubleDouble::from(psi);
        let exact = [exact.stumpff_2(), exact.stumpff_3()];
        // The angle is rounded once: what that does to its sine counts.
        let sizes = [
            exact[0].to_f64() + 2.0 / psi.abs().max(2.0).sqrt(),
            exact[1].to_f64(),
        ];
        for (at, found) in [psi.stumpff_2(), psi.stumpff_3()].into_iter().enumerate() {
            let off = (DoubleDouble::from(found) - exact[at]).to_f64().abs();
            worst[at] =
                worst[at].max(off / (f64::EPSILON * sizes[at] * (1.0 + (-psi).max(0.0).sqrt())));
        }
    }
    println!("c₂, c₃: {worst:?} ε");
    assert!(worst.iter().all(|x| *x < 6.0), "{worst:?}");
    // dc₃/dψ = ½(3c₅ − c₄)
    let slope = Dual::variable(2.0).stumpff_3().eps;
    let c4 = (0.5 - 2f64.stumpff_2()) / 2.0;
    let c5 = (1.0 / 6.0 - 2f64.stumpff_3()) / 2.0;
    assert!((slope - 0.5 * (3.0 * c5 - c4)).abs() < 1e-16);
}

#[test]
fn every_orbit_has_its_anomaly() {
    let mut random = Random(5);
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        // r₀ = 1; the angle between r₀ and v₀, its size, the time, attraction of either sign.
        let (angle, speed, t) = (
            core::f64::consts::PI * random.unit(),
            random.wide(2.0).abs(),
            random.wide(3.0),
        );
        let mu = if random.unit() < 0.2 {
            -random.unit()
        } else {
            1.0
        };
        let mut v = speed * (2.0 * f64::abs(mu)).sqrt();
        if random.unit() < 0.3 {
            // Nearly a parabola.
            v = (2.0 * f64::abs(mu)).sqrt() * (1.0 + 1e-8 * random.wide(6.0));
        }
        let (a, b) = (t * v * angle.cos(), mu * t * t);
        let c = 2.0 * b - v * v * t * t;
        let [x, y, z] = [a, b, c].map(DoubleDouble::from);
        let exact = x.universal_anomaly(y, z);
        let found = a.universal_anomaly(b, c);
        assert!(found > 0.0, "{a} {b} {c}: {found}");
        let psi = z * exact * exact;
        let (two, three) = (psi.stumpff_2(), psi.stumpff_3());
        let one = DoubleDouble::one();
        let g1 = exact * (one - psi * three);
        let (g2, g3) = (exact * exact * two, exact * exact * exact * three);
        // It solves the equation in 32 digits.
        let terms = [g1, x * g2, y * g3, -one];
        let sum = terms
            .iter()
            .fold(DoubleDouble::from(0.0), |sum, term| sum + *term);
        let size = terms
            .iter()
            .fold(0.0, |sum, term| sum + term.to_f64().abs());
        let turns = 1.0 + psi.to_f64().abs().sqrt();
        let slope = (one - psi * two + x * g1 + y * g2).to_f64();
        let spread =
            (psi.to_f64() * two.to_f64()).abs() + (x * g1).to_f64().abs() + (y * g2).to_f64().abs();
        let bound = size * turns / slope + exact.to_f64() * spread / slope;
        assert!(
            sum.to_f64().abs() < 1e-29 * (size * turns + slope * exact.to_f64()),
            "{a} {b} {c}: {:e} of {size:e}",
            sum.to_f64()
        );
        let off = (DoubleDouble::from(found) - exact).to_f64().abs();
        worst = worst.max(off / (f64::EPSILON * bound));
    }
    println!("y: {worst} ε of the terms");
    assert!(worst < 6.0, "{worst}");
}

#[test]
fn whole_revolutions_are_taken_off() {
    let mut random = Random(7);
    for _ in 0..1_000 {
        let turns = 10f64.powf(6.0 * random.unit() - 1.0);
        let (size, tau) = (random.wide(3.0).abs(), 2.0 * core::f64::consts::PI);
        // c^{3/2} = 2πb·turns
        let b = size;
        let c = (tau * b * turns).cbrt() * (tau * b * turns).cbrt();
        let part = b.orbit_remainder(c);
        let exact = DoubleDouble::from(b).orbit_remainder(DoubleDouble::from(c));
        let off = (DoubleDouble::from(part) - exact).to_f64().abs();
        assert!(off < 8.0 * f64::EPSILON, "{b} {c}: {part}");
        let left = part * turns;
        assert!((turns - left).fract().min(1.0 - (turns - left).fract()) < 1e-9 * turns);
        assert!(if turns < 0.999 {
            part == 1.0
        } else {
            turns < 1.001 || left.abs() <= 0.501
        });
        // Between the jumps it is 1 − n·2πb/c^{3/2}.
        let (by_b, by_c) = (
            Dual::variable(b).orbit_remainder(Dual::fixed(c)).eps,
            Dual::fixed(b).orbit_remainder(Dual::variable(c)).eps,
        );
        let gone = 1.0 - part;
        assert!((by_b + gone / b).abs() <= 1e-14 * gone / b);
        assert!((by_c - 1.5 * gone / c).abs() <= 1e-14 * gone / c);
    }
    for (b, c) in [(1.0, -1e6), (-1.0, 1e6), (1.0, 0.0), (1.0, f64::NAN)] {
        assert_eq!(b.orbit_remainder(c), 1.0);
    }
    assert!(1.0_f64.orbit_remainder(1e12).is_nan());
}

#[test]
fn what_is_no_orbit_has_no_anomaly() {
    for [a, b, c] in [
        [f64::NAN, 1.0, 1.0],
        [0.0, f64::INFINITY, 1.0],
        [0.0, 1.0, f64::NEG_INFINITY],
    ] {
        assert!(a.universal_anomaly(b, c).is_nan());
        let [a, b, c] = [a, b, c].map(DoubleDouble::from);
        assert!(a.universal_anomaly(b, c).to_f64().is_nan());
    }
    // In no time the time is the anomaly.
    assert_eq!(0.0.universal_anomaly(0.0, 0.0), 1.0);
}
