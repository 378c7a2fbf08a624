//! Deviations from orbits: exponents, alignment, monodromy.

use crate::common::systems::*;
use core::f64::consts::{FRAC_PI_2, TAU};
use hamiltonian_core::analysis::monodromy;
use hamiltonian_core::errors::StartError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::nalgebra::{Complex, DMatrix, DVector};
use hamiltonian_core::private::{Group, SVector};
use hamiltonian_core::{Scheme, analysis::multipliers};

type Heiles = Hand<HenonHeiles, 2>;
type Plane = State<SVector<f64, 2>>;

const HEILES: Heiles = Hand(HenonHeiles);

fn is_heavy() -> bool {
    std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1")
}

/// A regular orbit; its deviations grow 15 times in 100.
fn regular() -> Plane {
    State::new(
        [0.0, 0.2587703282931232],
        [-0.2525875586263492, -0.2178423952983717],
    )
}

/// The chaotic orbit, displaced by 1e-9 in the k-th of many directions.
fn chaotic(k: u32) -> Plane {
    let (a, b) = (f64::from(k), 1.7 * f64::from(k) + 1.0);
    let by = |x: f64| 1e-9 * x;
    State::new(
        [by(a.cos() * b.cos()), -0.25 + by(a.sin() * b.cos())],
        [0.42081 + by(a.cos() * b.sin()), by(a.sin() * b.sin())],
    )
}

#[test]
#[ignore = "many steps: `.ci/run` makes them with optimised code"]
fn lyapunov_exponents_of_henon_heiles() {
    // Over 48 starts, mean and standard deviation: T = 10⁴ .0482 ± .0103, T = 10⁵ .0443 ± .0059.
    let (end, expected, within) = match is_heavy() {
        true => (100_000, 0.0449, 0.004),
        false => (10_000, 0.0482, 0.008),
    };
    let mut sum = 0.0;
    for k in 0..24 {
        let mut tangent = Tangent::new(&HEILES, BlanesMoan4, chaotic(k), 0.125, 1).unwrap();
        sum += tangent.lyapunov(8 * end, 8).unwrap()[0];
    }
    let mean = sum / 24.0;
    println!("λ₁ = {mean} to T = {end}");
    assert!((mean - expected).abs() <= within, "{mean}");

    // Exponents come in pairs ±λ: two of them are those of the flow and of the energy, 0.
    let new = |start| Tangent::new(&HEILES, BlanesMoan4, start, 0.125, 4).unwrap();
    let spectrum = new(chaotic(0)).lyapunov(40_000, 8).unwrap();
    println!("{spectrum:?}");
    assert!((spectrum[0] + spectrum[3]).abs() < 1e-3, "{spectrum:?}");
    assert!((spectrum[1] + spectrum[2]).abs() < 1e-3, "{spectrum:?}");
    assert!(spectrum[0] > 0.03 && spectrum[1] < 0.01, "{spectrum:?}");
    // On a regular orbit all tend to 0, like ln T/T.
    let spectrum = new(regular()).lyapunov(40_000, 8).unwrap();
    println!("{spectrum:?}");
    assert!(
        spectrum.iter().all(|rate| rate.abs() < 4e-3),
        "{spectrum:?}"
    );
}

#[test]
fn alignment_tells_regular_orbits_from_chaotic_ones() {
    // GALI₂ at t = 1000, and the time at which it falls below 1e-12.
    let gali = |start: Plane| {
        let mut tangent = Tangent::new(&HEILES, BlanesMoan4, start, 0.125, 2).unwrap();
        let mut aligned = None;
        for _ in 0..1000 {
            tangent.advance(8).unwrap();
            tangent.normalise();
            // Half of SALI's two lengths' product; |a + b|² + |a − b|² = 4.
            let (gali, sali) = (tangent.gali(), tangent.sali());
            let other = (4.0 - sali * sali).sqrt();
            assert!((gali - sali * other / 2.0).abs() < 1e-14, "{gali} {sali}");
            if gali < 1e-12 {
                aligned = aligned.or(Some(tangent.time()));
            }
        }
        (tangent.gali(), aligned)
    };
    for start in [
        State::new([0.0, 0.295456], [0.407308431, 0.0]),
        State::new([0.0, 0.483], [0.27898039, 0.0]),
    ] {
        let (end, aligned) = gali(start);
        println!("regular: GALI₂ = {end} at t = 1000");
        assert!(end > 0.01 && aligned.is_none(), "{end} {aligned:?}");
    }
    let (_, aligned) = gali(State::new([0.0, -0.25], [0.42081, 0.0]));
    println!("chaotic: GALI₂ < 1e-12 at t = {aligned:?}");
    let t = aligned.expect("it falls");
    // Like exp(−(λ₁ − λ₂)t), with the exponents of that stretch.
    let start = State::new([0.0, -0.25], [0.42081, 0.0]);
    let mut tangent = Tangent::new(&HEILES, BlanesMoan4, start, 0.125, 2).unwrap();
    let rates = tangent.lyapunov((8.0 * t) as u64, 8).unwrap();
    let (falls, expected) = (-1e-12_f64.ln() / t, rates[0] - rates[1]);
    println!("GALI₂ falls at the rate {falls}, λ₁ − λ₂ = {expected}");
    assert!((falls / expected - 1.0).abs() < 0.1, "{falls} {expected}");
}

/// A pendulum with both frequencies 1.
fn unit_pendulum() -> Hand<Pendulum, 1> {
    Hand(Pendulum {
        m: 1.0,
        l: 1.0,
        g: 1.0,
        from_bottom: true,
    })
}

#[test]
#[ignore = "many steps: `.ci/run` makes them with optimised code"]
fn megno_tells_order_from_chaos() {
    let heiles = |start: Plane, steps| megno(&HEILES, BlanesMoan4, start, 0.125, steps, 8).unwrap();
    // Neighbours on a torus drift apart linearly, as do those of a pendulum that swings: 2, less a multiple of
    // (ln t)²/t.
    for (steps, within) in [(80_000, 0.05), (800_000, 0.01)] {
        let ordered = heiles(regular(), steps);
        let start = State::new([1.0], [0.0]);
        let swinging = megno(&unit_pendulum(), Strang, start, 0.125, steps, 8).unwrap();
        println!("{steps} steps: on a torus {ordered}, of a pendulum {swinging}");
        assert!((ordered - 2.0).abs() < within, "{ordered}");
        assert!((swinging - 2.0).abs() < within, "{swinging}");
    }
    // On the section of symmetry x = 0, p_y = 0 too, where neighbours in x do not drift apart.
    let symmetric = heiles(State::new([0.0, 0.25], [0.44, 0.0]), 80_000);
    println!("on the section of symmetry {symmetric}");
    assert!((symmetric - 2.0).abs() < 0.05, "{symmetric}");
    // Those of springs stay where they are: 0.
    let start = State::new([1.0, 0.3], [0.0, 0.2]);
    let system = Hand(Springs { w: 2_f64.sqrt() });
    let springs = megno(&system, Gauss::<2>::default(), start, 0.125, 80_000, 8).unwrap();
    assert!(springs.abs() < 0.01, "{springs}");
    // A pendulum that stands on its head has the exponent 1: t/2.
    let head = State::new([core::f64::consts::PI], [0.0]);
    let standing = megno(&unit_pendulum(), Strang, head, 0.125, 160, 8).unwrap();
    println!("standing {standing} at t = 20");
    assert!((standing - 10.0).abs() < 0.3, "{standing}");
    // In the chaotic sea λ ≈ 0.048: about 240 at t = 10⁴, and four times as much as at a quarter of it.
    let sea = |steps| (0..8).map(|k| heiles(chaotic(k), steps)).sum::<f64>() / 8.0;
    let (quarter, whole) = (sea(20_000), sea(80_000));
    println!("in the sea {quarter} at t = 2500, {whole} at t = 10⁴");
    assert!((150.0..350.0).contains(&whole), "{whole}");
    assert!((2.5..6.0).contains(&(whole / quarter)), "{quarter} {whole}");
}

/// ∫ s d ln δ = t ln δ(t) − ∫ ln δ ds, from the lengths of deviations that nothing makes orthonormal.
#[test]
fn megno_is_the_mean_of_its_integral() {
    let megno = |steps, every| megno(&HEILES, BlanesMoan4, chaotic(0), 0.125, steps, every);
    // 1 and the fractional part of k times the golden ratio.
    let golden = (5_f64.sqrt() - 1.0) / 2.0;
    let begin = DVector::from_fn(4, |k, _| 1.0 + ((k + 1) as f64 * golden).fract());
    for (steps, every) in [(400, 1), (400, 8), (397, 8)] {
        let mut tangent = Tangent::new(&HEILES, BlanesMoan4, chaotic(0), 0.125, 4).unwrap();
        let (mut made, mut integral, mut last, mut present, mut area) = (0, 0.0, 0.0, 0.0, 0.0);
        while made < steps {
            let n = every.min(steps - made);
            tangent.advance(n).unwrap();
            made += n;
            let logarithm = ((tangent.matrix() * &begin).norm() / begin.norm()).ln();
            integral += n as f64 * (last + logarithm) / 2.0;
            last = logarithm;
            let before = present;
            present = 2.0 * (logarithm - integral / made as f64);
            area += n as f64 * (before + present) / 2.0;
        }
        let (found, expected) = (megno(steps, every).unwrap(), area / steps as f64);
        println!("{steps} steps, every {every}: {found}");
        assert!((found - expected).abs() < 1e-11, "{found} {expected}");
    }
    assert!(matches!(
        megno(0, 1),
        Err(Error::Start(StartError::NoSteps { .. }))
    ));
}

/// The complete elliptic integrals K and E of parameter m, by the arithmetic-geometric mean.
fn elliptic(m: f64) -> (f64, f64) {
    let (mut a, mut b, mut sum, mut power) = (1.0_f64, (1.0 - m).sqrt(), 1.0 - m / 2.0, 1.0);
    while (a - b).abs() > 1e-15 {
        let c = (a - b) / 2.0;
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        sum -= power * c * c;
        power *= 2.0;
    }
    let k = FRAC_PI_2 / a;
    (k, k * sum)
}

/// H = (p_x² + p_y² + x² + w²y²)/2.
#[derive(Debug, Clone)]
struct Springs {
    w: f64,
}

impl Formula<2> for Springs {
    const NAME: &'static str = "Springs";
    const GROUPS: &'static [Group] = HenonHeiles::GROUPS;
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let wy = T::constant(self.w, 0.0) * *y;
        T::constant(0.5, 0.0) * (*px * *px + *py * *py + *x * *x + wy * wy)
    }
}

#[test]
fn monodromy_is_that_of_closed_forms() {
    // δz ↦ δz − T′(E) δE J∇H after a period T(E) = 4K(m), m = sin²(θ₀/2) = (E + 1)/2.
    let amplitude = 1.2_f64;
    let m = (amplitude / 2.0).sin().powi(2);
    let (k, e) = elliptic(m);
    let slope = 4.0 * (e - (1.0 - m) * k) / (2.0 * m * (1.0 - m)) / 2.0;
    let (theta, steps) = (0.7_f64, 2_000);
    let p = (2.0 * (theta.cos() - amplitude.cos())).sqrt();
    let start = State::new([theta], [p]);
    let swing = Hand(Pendulum {
        m: 1.0,
        l: 1.0,
        g: 1.0,
        from_bottom: false,
    });
    let matrix = monodromy(&swing, KahanLi8, start, 4.0 * k, steps).unwrap();
    let (flow, gradient) = ([p, -theta.sin()], [theta.sin(), p]);
    for i in 0..2 {
        for j in 0..2 {
            let expected = f64::from(u8::from(i == j)) - slope * flow[i] * gradient[j];
            let off = (matrix[(i, j)] - expected).abs();
            assert!(off < 1e-11, "{i} {j}: {matrix} {expected}");
        }
    }
    assert!(symplectic_defect(&matrix) < 1e-12, "{matrix}");

    // Once round in x: y has turned by w·2π. Floquet multipliers are 1, 1, exp(±2πiw).
    let w = 2_f64.sqrt();
    let start = State::new([1.0, 0.0], [0.0, 0.0]);
    let matrix = monodromy(&Hand(Springs { w }), Gauss::<6>::default(), start, TAU, 200).unwrap();
    let mut found = multipliers(&matrix);
    found.sort_by(|a, b| a.im.total_cmp(&b.im));
    let turn = (w * TAU).sin_cos();
    for (mu, (im, re)) in found.iter().zip([
        (-turn.0.abs(), turn.1),
        (0.0, 1.0),
        (0.0, 1.0),
        (turn.0.abs(), turn.1),
    ]) {
        assert!(
            (mu.re - re).abs() < 1e-6 && (mu.im - im).abs() < 1e-6,
            "{found:?}"
        );
    }
}

/// The largest distance of one of `expected` to the nearest of `found` that is not yet another's.
fn distance(expected: &[Complex<f64>], mut found: Vec<Complex<f64>>) -> f64 {
    assert_eq!(expected.len(), found.len());
    expected.iter().fold(0.0, |worst: f64, mu| {
        let off = |k: &usize| (found[*k] - mu).norm();
        let nearest = (0..found.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
        let nearest = nearest.expect("as many are found");
        let off = off(&nearest);
        found.swap_remove(nearest);
        worst.max(off)
    })
}

#[test]
fn multipliers_are_the_eigenvalues() {
    let mut bits = 7_u64;
    let mut random = || {
        bits = bits.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
        (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    assert!(multipliers(&DMatrix::zeros(0, 0)).is_empty());
    for n in 1..=20 {
        let matrix = DMatrix::from_fn(n, n, |_, _| random());
        let expected: Vec<_> = matrix.complex_eigenvalues().iter().copied().collect();
        let off = distance(&expected, multipliers(&matrix));
        assert!(off < 1e-12, "{n}: {off:e}");
        // A wrong eigenvalue is seen.
        let off = distance(&expected, multipliers(&(matrix * 1.001)));
        assert!(off > 1e-5, "{n}: {off:e}");
    }
    // Roots of unity, whose shifts go round in a circle: the companion of xⁿ − 1.
    for n in 3..=12 {
        let matrix = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i == (j + 1) % n)));
        let turn = |k: usize| (TAU * k as f64 / n as f64).sin_cos();
        let expected: Vec<_> = (0..n).map(turn).map(|(y, x)| Complex::new(x, y)).collect();
        let off = distance(&expected, multipliers(&matrix));
        assert!(off < 1e-14, "{n}: {off:e}");
    }
    // A real pair whose smaller number the sum of both would lose.
    let matrix = DMatrix::from_row_slice(2, 2, &[1e9, 1.0, 0.0, 1e-9]);
    let expected = [Complex::new(1e9, 0.0), Complex::new(1e-9, 0.0)];
    assert_eq!(multipliers(&matrix), expected);
    let found = multipliers(&DMatrix::from_element(3, 3, f64::NAN));
    assert!(found.iter().all(|mu| mu.re.is_nan()), "{found:?}");
}

#[test]
fn tangents_of_symplectic_schemes_are_symplectic_and_others_are_not() {
    fn defect<M>(scheme: M) -> f64
    where
        M: Scheme<Heiles>,
    {
        let mut tangent = Tangent::new(&HEILES, scheme, regular(), 0.1, 4).unwrap();
        tangent.advance(1000).unwrap();
        symplectic_defect(&tangent.matrix())
    }
    // To T = 100; κ = 15.
    for (name, defect) in [
        ("StormerVerlet", defect(StormerVerlet::default())),
        ("BlanesMoan6", defect(BlanesMoan6)),
        ("Gauss 2", defect(Gauss::<2>::default())),
        ("ImplicitMidpoint", defect(ImplicitMidpoint::default())),
    ] {
        println!("{name}: {defect:e}");
        assert!(defect < 1e-12, "{name}: {defect:e}");
    }
    let runge_kutta = defect(RungeKutta4);
    println!("RungeKutta4: {runge_kutta:e}");
    assert!(runge_kutta > 1e-6, "{runge_kutta:e}");
}

/// Orthonormal deviations are the same orbit's, and span the same space.
#[test]
fn renormalising_changes_neither_orbit_nor_span() {
    let new = || Tangent::new(&HEILES, BlanesMoan4, chaotic(0), 0.1, 3).unwrap();
    let (mut plain, mut often) = (new(), new());
    let mut product = [1.0; 3];
    for _ in 0..30 {
        plain.advance(5).unwrap();
        often.advance(5).unwrap();
        for (product, grown) in product.iter_mut().zip(often.orthonormalise()) {
            *product *= grown;
        }
        let (a, b) = (plain.state(), often.state());
        for (a, b) in a.q.iter().chain(&a.p).zip(b.q.iter().chain(&b.p)) {
            assert_eq!(a.re, b.re);
        }
    }
    for (product, grown) in product.iter().zip(plain.orthonormalise()) {
        assert!((product / grown - 1.0).abs() < 1e-10, "{product} {grown}");
    }
    let (a, b) = (plain.matrix(), often.matrix());
    assert!((a - b).norm() < 1e-10);
}

/// The rates of a finite stretch belong to the deviations, one by one; on a regular orbit the first need not
/// be the greatest.
#[test]
fn rates_are_in_the_order_of_the_deviations() {
    let rates = |deviations| {
        let start = State::new([0.1], [1.0]);
        let mut tangent = Tangent::new(&unit_pendulum(), Strang, start, 0.1, deviations).unwrap();
        tangent.lyapunov(1_000, 10).unwrap()
    };
    let (one, two) = (rates(1), rates(2));
    assert!(two[0] < two[1], "{two:?}");
    assert_eq!(one[0], two[0]);
    // Areas stay.
    assert!((two[0] + two[1]).abs() < 1e-12, "{two:?}");
}

/// H = p²/2 + q^(3/2): finite at q = 0, with a derivative that the product rule does not find there.
#[derive(Debug, Clone)]
struct Edge;

impl Formula<1> for Edge {
    const NAME: &'static str = "Edge";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
        p[0] * p[0] * T::constant(0.5, 0.0) + q[0] * q[0].sqrt()
    }
}

#[test]
fn a_start_without_derivative_parts_is_refused() {
    let start = || State::new([0.0], [1.0]);
    let refused = Tangent::new(&Hand(Edge), RungeKutta4, start(), 0.1, 1).err();
    assert_eq!(
        refused.expect("it has no derivative").to_string(),
        "the derivative part of H is NaN at the start t = 0, q = [0.0], p = [1.0]: choose a start and parameters at \
         which H and its first and second derivatives are finite"
    );
    // The control: values themselves.
    let refused = Integrator::new(&Hand(Edge), RungeKutta4, start(), 0.1).err();
    assert_eq!(
        refused.expect("it has no derivative").to_string(),
        "∂H/∂q is NaN at the start t = 0, q = [0.0], p = [1.0]: choose a start and parameters at which H and its first \
         derivatives are finite"
    );
}

#[test]
fn deviations_that_there_are_not_are_refused() {
    for (deviations, end) in [(0, "found 0"), (5, "found 5")] {
        let tangent = Tangent::new(&HEILES, BlanesMoan4, regular(), 0.1, deviations);
        let error = tangent.err().expect("it is refused").to_string();
        let begin = "the number of deviations must be from 1 to 4";
        assert!(error.starts_with(begin) && error.ends_with(end), "{error}");
    }
}
