//! Systems with check values that were made in quadruple precision by independent programs.
//!
//! Each is integrated twice. In double-doubles, from the exact decimals of the start, by the
//! reference of the order tests: the emitted gradient alone decides, and every printed digit must
//! come out. In `f64` by the library's fourth-order scheme: the error must fall with the fourth
//! power of the step, down to what the condition number κ of the end on the start allows.

// Check values stand as they were computed.
#![allow(clippy::excessive_precision)]

use crate::common::case::{Case, exactly, unit};
use crate::common::reference::{difference, quarter_period, solution};
use crate::common::systems::*;
use crate::common::{assert_digits, is_heavy, state};
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{DoubleDouble, Dual, Real, Vector};
use std::f64::consts::FRAC_PI_4;

hamiltonian! {
    /// The Kepler problem in the plane.
    pub struct Kepler {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/hypot(x, y);
    invariant angular_momentum = x*p_y - y*p_x
}

hamiltonian! {
    /// The predator–prey equations in logarithms.
    pub struct LotkaVolterra {}
    H(x; y) = exp(x) - x + exp(y) - y
}

hamiltonian! {
    /// A periodic Toda lattice of N particles.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] };
    monitor third = sum(i in 0..N) {
        p[i]^3/3 + (p[i] + p[(i + 1) % N])*exp(q[i] - q[(i + 1) % N])
    }
}

hamiltonian! {
    /// Equal masses in the plane under Newtonian gravity.
    pub struct Bodies<const N: usize> {}
    H(q[N][2]; p[N][2]) = sum(i in 0..N) { norm_squared(p[i])/2 }
        - sum(i in 0..N, j in 0..i) { 1/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..N) { p[i] };
    invariant angular_momentum = sum(i in 0..N) { q[i][0]*p[i][1] - q[i][1]*p[i][0] }
}

hamiltonian! {
    /// The planar restricted three-body problem in the rotating frame.
    pub struct RestrictedThreeBody { mu = 0.012277471 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y
        - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - 1 + mu, y)
}

hamiltonian! {
    /// A charge in the field of a magnetic dipole.
    pub struct Dipole { mu = 1.0 }
    let r = norm([x, y, z]);
    H(x, y, z; p_x, p_y, p_z) = ((p_x + mu*y/r^3)^2 + (p_y - mu*x/r^3)^2 + p_z^2)/2;
    invariant axial = x*p_y - y*p_x
}

hamiltonian! {
    /// Point vortices: Γ times the second coordinate is the momentum of the first.
    pub struct Vortices { Gamma: [4] }
    H(x[4]; p[4]) = -sum(i in 0..4, j in 0..i) {
        Gamma[i]*Gamma[j]*ln((x[i] - x[j])^2 + (p[i]/Gamma[i] - p[j]/Gamma[j])^2)
    }/(4*pi);
    invariant impulse = sum(i in 0..4) { Gamma[i]*x[i] }
}

/// (π/4; 0), which no decimal is.
fn lifted<E: System>(system: &E) -> State<VectorOf<E, DoubleDouble>> {
    let angle = DoubleDouble::new(FRAC_PI_4, hamiltonian_symbolic::PI_LOW / 4.0);
    state(
        system,
        DoubleDouble::zero(),
        [angle],
        [DoubleDouble::zero()],
    )
}

/// 1.
#[test]
fn pendulum() {
    let [m, l, g] = ["1", "10", "9.81"].map(exactly);
    let system = Pendulum { m, l, g };
    let start = lifted(&system);
    let period = "6.597320339363501885";
    // The closed form: 4 K(sin²(θ₀/2)) √(l/g).
    let half = (start.q[0] * exactly("0.5")).sin();
    let exact = exactly("4") * quarter_period(half * half) * (l / g).sqrt();
    assert!(
        (exact - exactly(period)).magnitude() <= unit(period),
        "{exact}"
    );
    assert!(difference(&solution(&system, &start, exact), &start) <= 1e-22 * 62.0);
    let start = FRAC_PI_4.to_string();
    let case = Case {
        // The start in `f64` is off by less than the printed digits show after κ.
        q: &[&start],
        p: &["0"],
        t: "10",
        end: &["-0.781647728717349456", "7.20650538496944192"],
        kappa: 62.0,
        steps: 1000,
    };
    let end = solution(&system, &lifted(&system), exactly(case.t));
    for (found, printed) in [end.q[0], end.p[0]].into_iter().zip(case.end) {
        assert!(
            (found - exactly(printed)).magnitude() <= unit(printed),
            "{found} {printed}"
        );
    }
    case.converges(&Pendulum::default(), &end);
}

/// 2.
#[test]
fn paper34() {
    let case = Case {
        q: &["-3"],
        p: &["0"],
        t: "10",
        end: &["-2.40223831310082726", "0.690609507457253471"],
        kappa: 8.0,
        steps: 2000,
    };
    case.check(&Paper34::default(), &Paper34::default());
    let period = "3.261057238358885321";
    let exact = exactly("4") * quarter_period(exactly("0.9")) / exactly("10").sqrt();
    assert!(
        (exact - exactly(period)).magnitude() <= unit(period),
        "{exact}"
    );
    let start = case.start(&Paper34::default(), |x| x);
    assert!(
        difference(&solution(&Paper34::default(), &start, exact), &start) <= 1e-22 * case.kappa
    );
}

/// 3.
#[test]
fn kepler() {
    let case = Case {
        q: &["0.4", "0"],
        p: &["0", "2"],
        t: "10",
        end: &[
            "-1.53502359190981369",
            "-0.283668406499780862",
            "0.227150732077498338",
            "-0.479187758203219565",
        ],
        kappa: 88.0,
        steps: 4000,
    };
    case.check(&Kepler::default(), &Kepler::default());
    let end = case.ends(&Kepler::default());
    let moved = Kepler::default().angular_momentum(&end) - exactly("0.8");
    assert!(moved.magnitude() <= 1e-24 * case.kappa);
}

/// 4: the regular orbit and the chaotic one.
#[test]
fn henon_heiles() {
    let system = HenonHeiles::default();
    Case {
        q: &["0", "0.2587703282931232"],
        p: &["-0.2525875586263492", "-0.2178423952983717"],
        t: "100",
        end: &[
            "-0.120505861737461384",
            "-0.221927867217970471",
            "0.0494084540741289",
            "-0.315610143448945754",
        ],
        kappa: 15.0,
        steps: 8000,
    }
    .check(&system, &system);
    let chaotic = Case {
        q: &["0", "-0.25"],
        p: &["0.42081", "0"],
        t: "50",
        end: &[
            "-0.196204160257133",
            "-0.102748174463813",
            "-0.455520585384375",
            "-0.0251616188198766",
        ],
        kappa: 43.0,
        steps: 2000,
    };
    chaotic.check(&system, &system);
    let energy = system.energy(&chaotic.start(&system, Real::to_f64));
    assert_digits("H of the chaotic orbit", energy, 0.1249988614, 10);
}

/// 4: a symplectic run keeps the regular orbit regular for long: 306 crossings to t = 2000.
#[test]
fn crossings_of_henon_heiles() {
    let system = HenonHeiles::default();
    for h in [0.02, 0.05, 0.1, 0.2] {
        let start = State::new(
            [0.0, 0.2587703282931232],
            [-0.2525875586263492, -0.2178423952983717],
        );
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, h).unwrap();
        let (mut crossings, mut before) = (0, run.state().q[0]);
        while run.time() < 2000.0 {
            let x = run.advance(1).unwrap().q[0];
            crossings += u32::from(before < 0.0 && x >= 0.0);
            before = x;
        }
        assert_eq!(crossings, 306, "h = {h}");
    }
}

/// 4: the largest Lyapunov exponent of the chaotic orbit, a mean over 48 starts, by exact tangents.
#[test]
fn exponent_of_henon_heiles() {
    const STARTS: usize = 48;
    const SPAN: f64 = 1000.0;
    let system = HenonHeiles::default();
    let mut random = 0x2545_F491_4F6C_DD1D_u64;
    let mut displacement = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        ((random >> 11) as f64 / (1u64 << 52) as f64 - 1.0) * 1e-9
    };
    let mut runs: Vec<_> = (0..STARTS)
        .map(|_| {
            let mut number = |x: f64| Dual::new(x + displacement(), displacement());
            (
                State::over([number(0.0), number(-0.25)], [number(0.42081), number(0.0)]),
                0.0,
            )
        })
        .collect();
    let known = [
        (1e4, 0.0482, 0.0103),
        (1e5, 0.0443, 0.0059),
        (1e6, 0.0449, 0.0018),
    ];
    let mut t = 0.0;
    for (end, mean, deviation) in known.into_iter().take(if is_heavy() { 3 } else { 1 }) {
        while t < end {
            for (state, growth) in &mut runs {
                // The exponent counts from a tangent of length 1.
                let parts = state.q.iter_mut().chain(state.p.iter_mut());
                let mut parts: Vec<_> = parts.collect();
                let length = parts.iter().map(|x| x.eps * x.eps).sum::<f64>().sqrt();
                parts.iter_mut().for_each(|x| x.eps /= length);
                *growth += if t > 0.0 { length.ln() } else { 0.0 };
                let scheme = StormerVerlet::default();
                let run = Integrator::new(&system, scheme, state.clone(), Dual::fixed(0.1));
                *state = run
                    .unwrap()
                    .advance_to(Dual::fixed(SPAN))
                    .unwrap()
                    .clone()
                    .at(Dual::fixed(0.0));
            }
            t += SPAN;
        }
        let exponents = runs.iter().map(|(state, growth)| {
            let parts = state.q.iter().chain(state.p.iter());
            let length = parts.map(|x| x.eps * x.eps).sum::<f64>().sqrt();
            (growth + length.ln()) / t
        });
        let found = exponents.sum::<f64>() / STARTS as f64;
        // Two means of 48 each; four standard deviations.
        let bound = 4.0 * deviation * (2.0 / STARTS as f64).sqrt();
        println!("T = {end:e}: {found}");
        assert!(
            (found - mean).abs() <= bound,
            "T = {end:e}: {found} is not {mean}"
        );
    }
}

/// 7.
#[test]
fn driven() {
    let [a, omega] = ["0.1", "1"].map(exactly);
    Case {
        q: &["1"],
        p: &["0"],
        t: "50",
        end: &["0.675915315318476552", "0.919206393040409427"],
        kappa: 31.0,
        steps: 4000,
    }
    .check(&Driven { a, omega }, &Driven::default());
}

/// 9.
#[test]
fn lotka_volterra() {
    let system = LotkaVolterra::default();
    Case {
        q: &["1"],
        p: &["0"],
        t: "20",
        end: &["-0.311930229695628724", "0.973879655552336453"],
        kappa: 11.0,
        steps: 1000,
    }
    .check(&system, &system);
    let closing = Case {
        q: &["1"],
        p: &["0"],
        t: "7.055976428503791037",
        end: &[],
        kappa: 11.0,
        steps: 0,
    };
    // Half a unit of the period times the speed at the start, e − 1.
    let gap = closing.gap(&system);
    assert!(gap <= 0.5e-18 * 1.72, "{gap:e}");
}

/// 10: N = 3 and 8.
#[test]
fn toda() {
    let three = Toda::<3>::default();
    let case = Case {
        q: &["0.3", "-0.1", "-0.2"],
        p: &["0.5", "-0.4", "-0.1"],
        t: "50",
        end: &[
            "0.162565434054066971",
            "-0.0673143166769255302",
            "-0.0952511173771414",
            "0.602729718152292172",
            "-0.58693025979637511",
            "-0.0157994583559170621",
        ],
        kappa: 17.0,
        steps: 4000,
    };
    case.check(&three, &three);
    let (start, end) = (case.start(&three, |x| x), case.ends(&three));
    let third = "-0.140790725388643411";
    for at in [&start, &end] {
        assert!((three.third(at) - exactly(third)).magnitude() <= unit(third));
        assert!(three.total_momentum(at).magnitude() <= 1e-24);
    }
    let eight = Toda::<8>::default();
    let case = Case {
        q: &["0.1", "-0.2", "0.3", "0.15", "-0.05", "0.2", "0.4", "-0.3"],
        p: &["0.1", "0.2", "0.3", "-0.1", "-0.2", "0.05", "0.3", "-0.4"],
        t: "20",
        end: &["1.08239013443417624"],
        kappa: 3.0,
        steps: 2000,
    };
    case.check(&eight, &eight);
    let end = case.ends(&eight);
    let (p, h) = ("0.308462841002275787", "8.84248075783259203");
    assert!((end.p[0] - exactly(p)).magnitude() <= unit(p));
    assert!((eight.energy(&end) - exactly(h)).magnitude() <= unit(h));
}

/// 14: the start of the table closes to 9e-14 only. With its x₁ and y₁ the orbit closes for the
/// velocity and the period here (found by Newton's method in 40 digits), which differ from the
/// table's in the fourteenth digit and beyond.
#[test]
fn figure_eight() {
    let (x, y) = ("0.97000435669734", "-0.24308753153583519555");
    let (v, w, period) = (
        "0.46620368572051902083892531720245",
        "0.43236573046050924427823931111280",
        "6.32591398292624053522779125822487",
    );
    for (here, printed) in [
        (v, "0.46620368572052510016"),
        (w, "0.43236573046050078442"),
        (period, "6.32591398292627919383"),
    ] {
        let moved = (exactly(here) - exactly(printed)).magnitude();
        assert!(moved <= 4e-14, "{here} is not {printed}");
    }
    let system = Bodies::<3>::default();
    let twice = |x| format!("-{}", exactly(x) + exactly(x));
    let case = Case {
        q: &[x, &format!("-{x}"), "0", y, &y[1..], "0"],
        p: &[v, v, &twice(v), w, w, &twice(w)],
        t: period,
        end: &[],
        // The table rounds it up to 18.
        kappa: 17.5,
        steps: 1000,
    };
    let end = case.ends(&system);
    let gap = difference(&end, &case.start(&system, |x| x));
    assert!(gap <= 1e-24 * case.kappa, "{gap:e}");
    case.converges(&system, &end);
    let momentum = system.total_momentum(&end);
    assert!(momentum.magnitude() <= 1e-24 * case.kappa);
    assert!(system.angular_momentum(&end).magnitude() <= 1e-24 * case.kappa);
}

/// 15.
#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn arenstorf() {
    let exact = RestrictedThreeBody {
        mu: exactly("0.012277471"),
    };
    // p_y = y′ + x.
    let speed = "-2.00158510637908252240537862224";
    let momentum = (exactly(speed) + exactly("0.994")).to_string();
    let p: &[&str] = &["0", &momentum];
    let case = |t, end, kappa, steps| Case {
        q: &["0.994", "0"],
        p,
        t,
        end,
        kappa,
        steps,
    };
    // The table's κ, 2e6, is that of the period.
    case(
        "5",
        &[
            "0.0226887836479771",
            "0.866540140171247",
            "-0.984276618812112",
            "-0.399097020514901",
        ],
        2085.0,
        50_000,
    )
    .check(&exact, &RestrictedThreeBody::default());
    let closing = case("17.0652165601579625588917206249", &[], 2e6, 200_000);
    // The speed is printed to half of 1e-29; a few hundred steps of double-doubles keep 1e-28.
    let gap = closing.gap(&exact);
    assert!(gap <= 1e-28 * closing.kappa, "{gap:e}");
    closing.kappa_of(&RestrictedThreeBody::default());
}

/// 18.
#[test]
fn dipole() {
    let exact = Dipole { mu: exactly("1") };
    let case = Case {
        q: &["1.2", "0.3", "0.2"],
        p: &["0.1", "-0.2", "0.3"],
        t: "20",
        end: &[
            "12.0858038550027373",
            "-9.394898242086061",
            "10.6415607929386452",
            "0.562364308794907454",
            "-0.459494090979350999",
            "0.531397816453916211",
        ],
        kappa: 23.0,
        steps: 1000,
    };
    case.check(&exact, &Dipole::default());
    // The momentum about the axis.
    let moved = exact.axial(&case.ends(&exact)) - exactly("-0.27");
    assert!(moved.magnitude() <= 1e-23 * case.kappa, "{moved}");
}

/// 20.
#[test]
fn vortices() {
    let exact = Vortices::new(["1", "2", "-0.5", "1"].map(exactly));
    let rounded = Vortices::new([1.0, 2.0, -0.5, 1.0]);
    let y = [
        "-1.68024455047966369",
        "-0.911136728730642",
        "-2.3756202781469246",
        "0.814707868867485986",
    ];
    let case = Case {
        q: &["1", "-1", "0", "0.2"],
        p: &["0", "0.2", "-0.6", "-1.1"],
        t: "20",
        end: &[
            "0.774832009367877881",
            "-0.0931317109357303",
            "0.828126867039044758",
            "-0.974505153976894857",
        ],
        // In x and y it is the table's 7.
        kappa: 8.7,
        steps: 1000,
    };
    case.check(&exact, &rounded);
    let (start, end) = (case.start(&exact, |x| x), case.ends(&exact));
    for ((p, strength), y) in end.p.iter().zip(exact.Gamma.iter()).zip(y) {
        assert!(
            (*p / *strength - exactly(y)).magnitude() <= unit(y),
            "{p} {y}"
        );
    }
    let h = "-0.273164118829138630";
    assert!((exact.energy(&start) - exactly(h)).magnitude() <= unit(h));
    let moved = exact.impulse(&end) - exact.impulse(&start);
    assert!(moved.magnitude() <= 1e-24 * case.kappa);
}
