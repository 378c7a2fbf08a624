//! The language with scalar coordinates, end to end: the definition is the system that runs.

use hamiltonian::prelude::*;
use hamiltonian::{
    Autonomous, DoubleDouble, Dual, QuadraticKinetic, Separable,
    schemes::author::{Dynamics, Observable},
};

hamiltonian! {
    /// Defaults that are expressions of numbers.
    pub struct Exact {
        a = 0.9,
        third = 2/3 - 1/3,
        angle = -pi/4,
        root = sqrt(2)/2,
        m: [2] = [1/10, 3],
    }
    H(q, x; p, y) = p^2/(2*m[0]) + y^2/(2*m[1]) + a*q + third*x + angle*q*x + root*q^2
}

#[test]
fn defaults_are_exact_in_every_scalar() {
    let of_f64 = Exact::default();
    assert_eq!((of_f64.a, of_f64.third), (0.9, 1.0 / 3.0));
    assert_eq!(of_f64.angle, -std::f64::consts::FRAC_PI_4);
    assert_eq!(of_f64.root, std::f64::consts::FRAC_1_SQRT_2);
    assert_eq!((of_f64.m[0], of_f64.m[1]), (0.1, 3.0));
    assert_eq!(
        Exact::<f64>::with_defaults().energy(&State::new([1.0, 2.0], [3.0, 4.0])),
        of_f64.energy(&State::new([1.0, 2.0], [3.0, 4.0]))
    );
    let exact = Exact::<DoubleDouble>::with_defaults();
    let tiny = DoubleDouble::from(1e-31);
    let is = |value: DoubleDouble, expected: DoubleDouble| {
        assert!(
            (value - expected).abs() < tiny,
            "{value:?} is not {expected:?}"
        );
    };
    let number = |value: f64| DoubleDouble::from(value);
    is(exact.a * number(10.0), number(9.0));
    is(exact.third * number(3.0), number(1.0));
    is(exact.root * exact.root, number(0.5));
    is(exact.m[0] * number(10.0), number(1.0));
    is((exact.angle + exact.angle).cos(), number(0.0));
    // The f64 nearest to 9/10 is another number.
    assert!((number(of_f64.a) * number(10.0) - number(9.0)).abs() > number(1e-17));
    // The scalar of one field is that of all.
    let other = Exact {
        a: number(2.0),
        ..Exact::with_defaults()
    };
    is(other.third, exact.third);
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * (1.0 + a.abs()), "{a} is not {b}");
}

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum {
        /// Mass of the bob.
        m = 1.0,
        l = 10.0,
        g = 9.81,
    }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

hamiltonian! {
    /// A driven oscillator with a function of its own.
    pub struct Driven { a = 0.1, omega = 1.0 }
    let U(r) = r^2/2 + r^4/4;
    H(q; p; t) = p^2/2 + U(q) - a*q*cos(omega*t);
    /// The power the drive puts in, times −1.
    monitor power = -a*p*cos(omega*t);
    event crossing = q - sin(t)
}

hamiltonian! {
    /// A charge whose mass has no default.
    pub struct Charge { m, e = -1.0, B = 0.5 }
    H(x, y; p_x, p_y) = ((p_x + e*B*y/2)^2 + (p_y - e*B*x/2)^2)/(2*m)
}

hamiltonian! {
    /// H of the paper's equation (34).
    pub struct Paper34 {}
    H = 0.5*(q^2 + 1)*(p^2 + 1)
}

fn separable<T: Real, S: Separable>(_: &S) {}
fn quadratic<S: QuadraticKinetic>(_: &S) {}
fn autonomous<S: Autonomous>(_: &S) {}

#[test]
fn item_form_is_a_type_with_defaults() {
    let pendulum = Pendulum {
        l: 2.0,
        ..Default::default()
    };
    let state = State::new([0.7], [0.3]);
    close(
        pendulum.energy(&state),
        0.3 * 0.3 / 8.0 - 9.81 * 2.0 * 0.7f64.cos(),
    );
    let gradient = pendulum.gradient(&state);
    close(gradient.q[0], 9.81 * 2.0 * 0.7f64.sin());
    close(gradient.p[0], 0.3 / 4.0);
    let by_parameters = pendulum.parameter_gradient(&state);
    close(by_parameters.g, -2.0 * 0.7f64.cos());
    close(
        by_parameters.m,
        -0.3 * 0.3 / 8.0 - 9.81 * 2.0 * 0.7f64.cos(),
    );
    assert_eq!(
        pendulum.to_string(),
        "H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)"
    );
    assert_eq!(
        format!("{:?}", pendulum.clone()),
        "Pendulum { m: 1.0, l: 2.0, g: 9.81 }"
    );
    separable::<f64, _>(&pendulum);
    quadratic(&pendulum);
    autonomous(&pendulum);
    fn shared<T: Send + Sync>(_: &T) {}
    shared(&pendulum);
}

#[test]
fn expression_form_captures_scalars() {
    let simple = hamiltonian! { H = 0.5*(q^2 + 1)*(p^2 + 1) };
    close(simple.energy(&State::new([1.0], [2.0])), 5.0);
    let (m, k) = (1.0, 4);
    let spring = hamiltonian! { H(x; p_x) = p_x^2/(2*m) + k*x^2/2 };
    close(spring.energy(&State::new([0.5], [1.0])), 1.0);
    close(spring.gradient(&State::new([0.5], [1.0])).q[0], 2.0);
    let mut run = Integrator::new(
        &spring,
        StormerVerlet::default(),
        State::new([1.0], [0.0]),
        1e-3,
    )
    .unwrap();
    run.advance_to(1.0).unwrap();
    assert!((run.state().q[0] - 2.0f64.cos()).abs() < 1e-5);
}

#[test]
fn time_monitors_and_events() {
    let driven = Driven {
        a: 0.2,
        ..Default::default()
    };
    let state = State::new([0.5], [1.5]).at(0.25);
    let expected = 1.125 + 0.125 + 0.5f64.powi(4) / 4.0 - 0.2 * 0.5 * 0.25f64.cos();
    close(driven.energy(&state), expected);
    close(driven.power(&state), -0.2 * 1.5 * 0.25f64.cos());
    close(driven.crossing(&state), 0.5 - 0.25f64.sin());
    let prepared = System::prepare::<f64>(&driven);
    close(
        prepared.time_derivative(0.25, &state.q, &state.p),
        0.2 * 0.5 * 0.25f64.sin(),
    );
    close(
        prepared.observable(0, 0.25, &state.q, &state.p),
        driven.power(&state),
    );
    let observables = driven.description().observables.iter();
    let names: Vec<&str> = observables.map(|o: &Observable| &*o.name).collect();
    assert_eq!(names, ["power", "crossing"]);
    separable::<f64, _>(&driven);
}

#[test]
fn parameters_without_default_are_arguments_of_new() {
    let charge = Charge::new(2.0);
    assert_eq!((charge.m, charge.e, charge.B), (2.0, -1.0, 0.5));
    let state = State::new([1.0, 2.0], [0.5, -0.5]);
    let (a, b) = (0.5 - 0.25 * 2.0, -0.5 + 0.25);
    close(charge.energy(&state), (a * a + b * b) / 4.0);
    let groups = charge.description().groups.iter();
    let names: Vec<_> = groups.map(|g| (&*g.coordinate, &*g.momentum)).collect();
    assert_eq!(names, [("x", "p_x"), ("y", "p_y")]);
}

#[test]
fn gradients_and_hessians_are_those_of_duals() {
    let paper = Paper34::default();
    let charge = Charge::new(1.5);
    let driven = Driven::default();
    check(&paper, [0.4], [-1.2]);
    check(&charge, [0.4, -0.3], [-1.2, 0.7]);
    check(&driven, [0.4], [-1.2]);
}

/// The memory of scalar coordinates.
/// The gradient against duals of H, the Hessian times a direction against duals of the gradient,
/// and the accumulating flow against the gradient.
fn check<S, const N: usize>(system: &S, q: [f64; N], p: [f64; N])
where
    S: System<Shape = hamiltonian::nalgebra::SVector<(), N>>,
{
    use hamiltonian::schemes::author::VectorField;
    let t = 0.3;
    let state = State::new(q, p).at(t);
    let gradient = System::gradient::<f64>(system, &state);
    let lift = |values: [f64; N]| values.map(Dual::fixed);
    for at in 0..2 * N {
        let (mut dq, mut dp) = (lift(q), lift(p));
        let expected = if at < N {
            dq[at].eps = 1.0;
            gradient.q[at]
        } else {
            dp[at - N].eps = 1.0;
            gradient.p[at - N]
        };
        let state = State::over(dq, dp).at(Dual::fixed(t));
        close(System::energy::<Dual<f64>>(system, &state).eps, expected);
        let derivative = System::gradient::<Dual<f64>>(system, &state);
        let (mut vq, mut vp) = ([0.0; N], [0.0; N]);
        if at < N {
            vq[at] = 1.0
        } else {
            vp[at - N] = 1.0
        }
        let direction = State::new(vq, vp);
        let (mut hq, mut hp) = (direction.q, direction.q);
        let prepared = System::prepare::<f64>(system);
        let here = State::new(q, p);
        prepared.hessian_vector(
            t,
            &here.q,
            &here.p,
            &direction.q,
            &direction.p,
            &mut hq,
            &mut hp,
        );
        for k in 0..N {
            close(hq[k], derivative.q[k].eps);
            close(hp[k], derivative.p[k].eps);
        }
    }
    let prepared = System::prepare::<f64>(system);
    let (mut to_q, mut to_p) = (state.q, state.p);
    prepared
        .field(0.125)
        .add(t, &state.q, &state.p, &mut to_q, &mut to_p);
    for k in 0..N {
        close(to_q[k], q[k] + 0.125 * gradient.p[k]);
        close(to_p[k], p[k] - 0.125 * gradient.q[k]);
    }
    let (mut dq, mut dp) = (state.q, state.p);
    let energy = prepared.energy_and_gradient(t, &state.q, &state.p, &mut dq, &mut dp);
    close(energy, System::energy::<f64>(system, &state));
    for k in 0..N {
        close(dq[k], gradient.q[k]);
        close(dp[k], gradient.p[k]);
    }
}

hamiltonian! {
    /// Another system where k is 1.
    pub struct Exceptional { k = 1.0 }
    H(q; p) = p^2/2 + if k == 1 { q^2/2 + q*p } else { cos(q) }
}

hamiltonian! {
    /// 0⁰ of a sign.
    pub struct Signed { k = 0.0 }
    H(q; p) = (p^2 + q^2)/2 + sign(k)^2*q*p - q*p
}

/// A structure that holds at one value of a parameter only: users do set that value.
#[test]
fn conditions_on_parameters_count_at_single_values() {
    let at = State::new([0.5], [0.25]);
    let one = Exceptional::default();
    assert_eq!(one.energy(&at), 0.03125 + 0.125 + 0.125);
    assert_eq!(one.gradient(&at).q[0], 0.5 + 0.25);
    let two = Exceptional { k: 2.0 };
    assert_eq!(two.energy(&at), 0.03125 + 0.5f64.cos());
    assert_eq!(two.gradient(&at).q[0], -0.5f64.sin());
    assert_eq!(Signed { k: 0.0 }.energy(&at), 0.15625 - 0.125);
    assert_eq!(Signed { k: -3.0 }.energy(&at), 0.15625);
}

/// T and V are as written: 10⁻³⁰ is not the rounding of its expansion.
#[test]
fn what_does_not_couple_is_not_multiplied_out() {
    let h = hamiltonian! { H = p*(p + q) - p*q + (q - 1)^10 };
    let at = State::new([1.001], [0.0]);
    let (energy, expected) = (h.energy(&at), (1.001f64 - 1.0).powi(10));
    assert!((energy - expected).abs() <= 1e-14 * expected, "{energy:e}");
    let mut run = Integrator::new(&h, StormerVerlet::default(), at, 1e-3).unwrap();
    run.advance(1).unwrap();
}

hamiltonian! {
    /// A particle in a periodic box, with remainders of each kind.
    pub struct Boxed { L = 2.0 }
    let place = x % L;
    H(x; p) = p^2/2 + (place*(L - place))^2 + (L^2/4 - remainder(x, L)^2)^2/8;
    monitor cell = floor(x/L);
    monitor nearest = round(x/L)
}

/// Values, slopes and a run across cells; names of one's own hide the functions.
#[test]
fn whole_numbers_and_remainders() {
    let boxed = Boxed::default();
    for (x, place, image, cell, nearest) in [
        (-0.5, 1.5, -0.5, -1.0, -0.0),
        (3.5, 1.5, -0.5, 1.0, 2.0),
        (0.75, 0.75, 0.75, 0.0, 0.0),
        (-3.25, 0.75, 0.75, -2.0, -2.0),
    ] {
        let at = State::new([x], [0.0]);
        let (bump, dip) = (place * (2.0 - place), 1.0 - image * image);
        assert_eq!(boxed.energy(&at), bump * bump + dip * dip / 8.0);
        let slope = 2.0 * bump * (2.0 - 2.0 * place) - dip * image / 2.0;
        assert_eq!(boxed.gradient(&at).q[0], slope);
        assert_eq!((boxed.cell(&at), boxed.nearest(&at)), (cell, nearest));
        assert_eq!(boxed.cell_gradient(&at).q[0], 0.0);
    }
    // H and its slopes are continuous across the borders of cells, so a run over several of them preserves H.
    let start = State::new([0.25], [1.5]);
    let mut run = Integrator::new(&boxed, StormerVerlet::default(), start, 1e-3)
        .unwrap()
        .observe(EnergyDrift::new());
    run.advance(20_000).unwrap();
    assert!(run.state().q[0] > 4.0 && run.observer().max_relative() < 1e-5);
    let (floor, remainder) = (2.0, 3.0);
    let named = hamiltonian! {
        let round(x) = x + floor;
        H = p^2/2 + round(q)*remainder
    };
    assert_eq!(named.energy(&State::new([1.0], [0.0])), 9.0);
}
