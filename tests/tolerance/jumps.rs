//! Runs to a tolerance through places where H or its gradient jumps: they resolve the place, or end there with an error.

use hamiltonian::errors::{Error, StepError};
use hamiltonian::prelude::*;
use std::f64::consts::PI;

hamiltonian! {
    /// Soft walls, in which the derivative of the force jumps.
    pub struct Walls { w = 2.0 }
    let over = max(abs(x) - w, 0);
    H(x; p) = p^2/2 + 3*over^2/2
}

hamiltonian! {
    /// A ball on a soft floor, where the force jumps.
    pub struct Ball { floor_at = 0.5 }
    let x = height - floor_at;
    H(height; p) = p^2/2 + if x < 0 { 50*x^2 } else { 9.81*x }
}

hamiltonian! {
    /// An oscillator with a sill, where H jumps.
    pub struct Sill { a = 0.3 }
    H(x; p) = p^2/2 + x^2/2 + sign(x - a)/10
}

hamiltonian! {
    /// Stairs without another force, of an H that does not separate.
    pub struct Stairs {}
    H(x, y; p, p_y) = (1 + y^2)*p^2/2 + p_y^2/2 - floor(x)/10
}

hamiltonian! {
    /// An oscillator with dry friction, which comes to rest.
    pub struct Dry {}
    H(x; p) = p^2/2 + x^2/2;
    force(x; p) = -sign(p)/10
}

/// Free flight at the speed 1, and half an oscillation in each wall. Steps that see stages alone miss a wall that begins
/// between the last stage and the end: the error at 1e-9 was 1e-3 then.
#[test]
fn a_jump_of_the_derivative_of_a_force_is_resolved() {
    let exact = 3.0 - 2.0 * PI / 3.0_f64.sqrt();
    for (tolerance, bound) in [(1e-6, 1e-5), (1e-9, 1e-7), (1e-12, 1e-9)] {
        let start = State::new([1.0], [1.0]);
        let mut run = Integrator::to_tolerance(&Walls::default(), start, tolerance).unwrap();
        let end = run.advance_until(10.0).unwrap();
        println!(
            "{tolerance:e}: {:e}, {} steps",
            end.q[0] - exact,
            run.steps()
        );
        assert!((end.q[0] - exact).abs() < bound, "{end:?}");
        assert!((end.p[0] - 1.0).abs() < bound, "{end:?}");
    }
    // Walls that the orbit does not reach, as a negative control.
    let start = State::new([1.0], [1.0]);
    let mut run = Integrator::to_tolerance(&Walls { w: 20.0 }, start, 1e-9).unwrap();
    assert_eq!(run.advance_until(10.0).unwrap().q[0], 11.0);
    assert_eq!(run.refused_steps(), 0);
}

/// A run through a jump of the force has the right energy, or ends at a jump.
#[test]
fn a_jump_of_a_force_gives_no_wrong_number() {
    let system = Ball::default();
    for height in [1.5, 1.6, 1.73, 2.0] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let start = State::new([height], [0.0]);
            let energy = system.energy(&start);
            let mut run = Integrator::to_tolerance(&system, start, tolerance).unwrap();
            match run.advance_until(5.0) {
                Ok(end) => {
                    let error = system.energy(&end) / energy - 1.0;
                    println!("{height}, {tolerance:e}: {error:e}, {} steps", run.steps());
                    assert!(error.abs() < 1e-6, "{error:e}");
                }
                Err(error) => {
                    println!("{height}, {tolerance:e}: {error}");
                    assert!(matches!(error, Error::Step(StepError::Refused { .. })));
                    let x = run.state().q[0] - system.floor_at;
                    assert!(x.abs() < 1e-6, "{x:e}");
                }
            }
        }
    }
}

/// The gradient says nothing of a jump of H.
#[test]
fn a_jump_of_h_is_an_error_with_its_time() {
    fn refused<S>(system: &S, start: StateOf<S>) -> (Result<StateOf<S>, Error>, f64)
    where
        S: hamiltonian::schemes::ToTolerance,
        hamiltonian::schemes::Adaptive<S::Scheme>: Scheme<S>,
    {
        let mut run = Integrator::to_tolerance(system, start, 1e-9).unwrap();
        let end = run.advance_until(10.0);
        (end, run.time())
    }
    // cos t = 0.3 at first.
    let (end, time) = refused(&Sill::default(), State::new([1.0], [0.0]));
    let error = end.unwrap_err();
    println!("{error}");
    assert!((time - 0.3_f64.acos()).abs() < 1e-9, "{time}");
    let Error::Step(StepError::Jumped { before, after, .. }) = &error else {
        panic!("{error}")
    };
    assert!((before - 0.6).abs() < 1e-9 && (after - before).abs() > 0.09);
    assert!(error.to_string().contains("end the run at an event"));
    let (end, time) = refused(&Stairs {}, State::new([0.1, 0.0], [1.0, 0.0]));
    assert!(matches!(end, Err(Error::Step(StepError::Jumped { .. }))));
    assert!((time - 0.9).abs() < 1e-9, "{time}");
    // An orbit that stays on one side of the sill, as a negative control.
    let (end, _) = refused(&Sill::default(), State::new([0.2], [0.0]));
    assert!((end.unwrap().q[0] - 0.2 * 10.0_f64.cos()).abs() < 1e-8);
}

#[test]
fn friction_that_holds_is_an_error() {
    let start = State::new([1.0], [0.0]);
    let mut run = Integrator::to_tolerance(&Dry {}, start, 1e-9).unwrap();
    let error = run.advance_until(20.0).unwrap_err();
    assert!(error.to_string().contains("its gradient jumps"), "{error}");
    // A half-period takes 0.2 of the amplitude, until the spring no longer overcomes the friction.
    assert!(
        (run.time() / PI - (run.time() / PI).round()).abs() < 1e-3,
        "{error}"
    );
}

hamiltonian! {
    /// A steep wall on one side, and a constant force on the other, where all steps are exact.
    pub struct Toda {}
    H(q; p) = p^2/2 + exp(q) - q
}

hamiltonian! {
    /// The same far from the origin.
    pub struct FarToda { a = 1e5 }
    H(q; p) = p^2/2 + exp(q - a) - (q - a)
}

/// The steps that come back from the side of the constant force are long, and may end in the wall, where no stage was.
#[test]
fn a_steep_wall_changes_no_energy() {
    for (start, tolerance, bound) in [(4.0, 1e-13, 1e-9), (7.0, 1e-10, 1e-7), (9.0, 1e-6, 1e-5)] {
        let start = State::new([start], [0.0]);
        let energy = Toda {}.energy(&start);
        let mut run = Integrator::to_tolerance(&Toda {}, start, tolerance).unwrap();
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            run.advance(100).unwrap();
            worst = worst.max((run.energy() / energy - 1.0).abs());
        }
        println!(
            "{tolerance:e}: {worst:e}, t = {}, {} refused of {}",
            run.time(),
            run.refused_steps(),
            run.steps()
        );
        assert!(worst < bound, "{worst:e}");
    }
    let system = FarToda::default();
    let start = State::new([1e5 + 7.0], [0.0]);
    let energy = system.energy(&start);
    let mut run = Integrator::to_tolerance(&system, start, 1e-10).unwrap();
    run.advance(20_000).unwrap();
    let error = run.energy() / energy - 1.0;
    println!("{error:e}, {} refused", run.refused_steps());
    assert!(error.abs() < 1e-6, "{error:e}");
}

hamiltonian! {
    /// An oscillator with a force that begins at t = 1.
    pub struct Begun {}
    H(q; p; t) = p^2/2 + q^2/2 - q*max(0, t - 1)
}

/// Nothing changes at rest: the slopes at the ends, and those tolerated, are 0.
#[test]
fn a_point_at_rest_is_no_error() {
    let mut run = Integrator::to_tolerance(&Begun {}, State::new([0.0], [0.0]), 1e-9).unwrap();
    let end = run.advance_until(4.0).unwrap();
    assert!((end.q[0] - (3.0 - 3.0_f64.sin())).abs() < 1e-7, "{end:?}");
    let mut run = Integrator::to_tolerance(&Dry {}, State::new([0.0], [0.0]), 1e-9).unwrap();
    assert_eq!(run.advance_until(4.0).unwrap().q[0], 0.0);
}

hamiltonian! {
    /// An oscillator that is pushed a little, and fast.
    pub struct Pushed { a = 1e-4 }
    H(q; p; t) = p^2/2 + q^2/2 - a*q*cos(5*t)
}

/// H(t) changes by a push, and ∂H/∂t may be 0 at both ends of a step.
#[test]
fn pushes_refuse_hardly_a_step() {
    let mut run =
        Integrator::to_tolerance(&Pushed::default(), State::new([1.0], [0.0]), 1e-8).unwrap();
    run.advance(2000).unwrap();
    println!("{} refused, steps of {}", run.refused_steps(), run.step());
    assert!(run.refused_steps() < 4);
}

hamiltonian! {
    /// The same with friction.
    pub struct Braked { friction = 1e-4 }
    H(q; p) = p^2/2 + exp(q) - q;
    force(q; p) = -friction*p
}

hamiltonian! {
    /// The same with a constant force that changes in time.
    pub struct Driven {}
    H(q; p; t) = p^2/2 + exp(q) - q*(1 + 0.3*sin(t))
}

/// Where H is not conserved, the slopes at the ends of a step are compared with those at its stages. The errors were 1e-5
/// and 5e-5 before.
#[test]
fn a_steep_wall_is_seen_without_a_conserved_h() {
    fn end<S>(system: &S, q: f64, tolerance: f64) -> f64
    where
        S: hamiltonian::schemes::ToTolerance<Shape = hamiltonian::nalgebra::SVector<(), 1>>,
        hamiltonian::schemes::Adaptive<S::Scheme>: Scheme<S>,
    {
        let start = State::new([q], [0.0]);
        let mut run = Integrator::to_tolerance(system, start, tolerance).unwrap();
        run.advance_until(100.0).unwrap().q[0]
    }
    let error = end(&Braked::default(), 4.0, 1e-12) - end(&Braked::default(), 4.0, 1e-14);
    println!("{error:e}");
    assert!(error.abs() < 1e-6);
    let error = end(&Driven {}, 7.0, 1e-10) - end(&Driven {}, 7.0, 1e-14);
    println!("{error:e}");
    assert!(error.abs() < 1e-6);
}

hamiltonian! {
    /// An oscillator in a form in which H has an error of 1e-10.
    pub struct Rounded { a = 1000.0 }
    H(x; p) = p^2/2 + a^2*(cosh(x/a) - 1)
}

/// A difference of H that is rounding does not end a run.
#[test]
fn the_rounding_of_h_is_no_jump() {
    let mut run =
        Integrator::to_tolerance(&Rounded::default(), State::new([1.0], [0.0]), 1e-12).unwrap();
    let end = run.advance_until(100.0).unwrap();
    println!(
        "{:e}, {} refused of {}",
        end.q[0] - 100.0_f64.cos(),
        run.refused_steps(),
        run.steps()
    );
    assert!((end.q[0] - 100.0_f64.cos()).abs() < 1e-5);
    assert_eq!(run.refused_steps(), 0);
}
