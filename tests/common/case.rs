//! The end of a run from exact decimals, against printed figures: by a reference of high precision
//! and by Runge–Kutta in `f64`, which has to come down on it.

use super::geometry::visible_tangent;
use super::order::slope;
use super::reference::{difference, solution};
use super::{assert_digits, state};
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{DoubleDouble, Dual, Real, Vector, schemes::author::Dynamics};

pub fn exactly(text: &str) -> DoubleDouble {
    text.parse().expect("a number")
}

/// One unit in the last place of a printed number.
pub fn unit(text: &str) -> f64 {
    let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    10f64.powi(-(digits as i32))
}

/// The end of a run from exact decimals in a given time.
pub struct Case<'a> {
    pub q: &'a [&'a str],
    pub p: &'a [&'a str],
    pub t: &'a str,
    /// The printed digits of the end, components in flat order.
    pub end: &'a [&'a str],
    /// The largest entry of the derivative of the end with respect to the start.
    pub kappa: f64,
    /// The steps of the coarsest of three runs in `f64`.
    pub steps: u32,
}

impl Case<'_> {
    pub fn start<T: Real, S: System>(
        &self,
        system: &S,
        of: impl Fn(DoubleDouble) -> T,
    ) -> State<VectorOf<S, T>> {
        let numbers = |texts: &[&str]| texts.iter().map(|x| of(exactly(x))).collect::<Vec<_>>();
        state(system, T::zero(), numbers(self.q), numbers(self.p))
    }

    /// Integrates both ways. `exact` has the parameters as decimals, `rounded` in `f64`.
    pub fn check<E, S>(&self, exact: &E, rounded: &S)
    where
        E: System,
        S: System,
    {
        let end = self.ends(exact);
        for (found, printed) in end.q.components().chain(end.p.components()).zip(self.end) {
            // Half a unit for the rounding of the printed digits; what the reference leaves
            // (1e-24·κ) is less than another half.
            let error = (found - exactly(printed)).magnitude();
            assert!(
                error <= unit(printed),
                "{}: {found} is not {printed}",
                exact.description().name
            );
        }
        self.converges(rounded, &end);
    }

    /// The end by the reference; H is the same there unless it depends on time.
    pub fn ends<E: System>(&self, system: &E) -> State<VectorOf<E, DoubleDouble>> {
        let start = self.start(system, |x| x);
        let end = solution(system, &start, exactly(self.t));
        let prepared = system.prepare();
        if prepared.time_derivative(end.t, &end.q, &end.p).magnitude() == 0.0 {
            let gradient = system.gradient(&end);
            let slope = gradient.q.magnitude().max(gradient.p.magnitude());
            let moved = (system.energy(&end) - system.energy(&start)).magnitude();
            let bound = 1e-24 * self.kappa * slope.max(1.0);
            assert!(
                moved <= bound,
                "{}: H moves by {moved:e} of {bound:e}",
                system.description().name
            );
        }
        end
    }

    /// RK4 in `f64` comes down on the end as h⁴; extrapolated in h⁴ and h⁵, to the floor of
    /// rounding.
    pub fn converges<V: Vector<Scalar = DoubleDouble>, S>(&self, system: &S, end: &State<V>)
    where
        S: System,
    {
        let kappa = self.kappa_of(system);
        let start: State<VectorOf<S>> = self.start(system, Real::to_f64);
        let numbers = |v: &V| v.components().map(Real::to_f64).collect::<Vec<_>>();
        let end = state(system, end.t.to_f64(), numbers(&end.q), numbers(&end.p));
        let mut ends = Vec::new();
        for halving in 0..3 {
            let steps = self.steps << halving;
            let h = end.t / f64::from(steps);
            let run = Integrator::new(system, RungeKutta4, start.clone(), h);
            let mut run = run.expect("a good start");
            ends.push((
                h,
                run.advance(u64::from(steps)).expect("good steps").clone(),
            ));
        }
        let points: Vec<_> = ends
            .iter()
            .map(|(h, z)| (*h, difference(z, &end)))
            .collect();
        let measured = slope(&points);
        let name = &system.description().name;
        // Each of n steps is wrong by an ulp or so of the state, in a direction of its own, and
        // the end by κ times that: κ ε √n; four standard deviations.
        let size = end.q.magnitude().max(end.p.magnitude()).max(1.0);
        let last = f64::from(self.steps << 2);
        let floor = 4.0 * kappa * f64::EPSILON * size * last.sqrt();
        let error = difference(&extrapolated(&ends), &end);
        println!(
            "{name}: slope {measured:.3}, errors {points:?}, extrapolated {error:e} of {floor:e}"
        );
        assert!(
            (measured - 4.0).abs() <= 0.1,
            "{name}: slope {measured}, {points:?}"
        );
        assert!(
            error <= floor,
            "{name}: {error:e}, rounding allows {floor:e}"
        );
    }

    /// The largest entry of the derivative of the end with respect to the start, which is the
    /// table's.
    pub fn kappa_of<S: System>(&self, system: &S) -> f64 {
        let start = self.start(system, |x| Dual::fixed(x.to_f64()));
        let (h, steps) = (
            exactly(self.t).to_f64() / f64::from(self.steps),
            self.steps.into(),
        );
        let columns = visible_tangent(system, &RungeKutta4, &start, h, steps);
        let kappa = columns
            .iter()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let digits = self
            .kappa
            .to_string()
            .trim_end_matches('0')
            .replace('.', "")
            .len() as i32;
        assert_digits(
            &format!("κ of {}", system.description().name),
            kappa,
            self.kappa,
            digits,
        );
        kappa
    }

    /// The distance of the system's end from its start.
    pub fn gap<E: System>(&self, system: &E) -> f64 {
        difference(&self.ends(system), &self.start(system, |x| x))
    }
}

/// The limit of ends at steps h, h/2, h/4 whose errors are h⁴ and h⁵.
fn extrapolated<V: Vector<Scalar = f64>>(ends: &[(f64, State<V>)]) -> State<V> {
    let mut column: Vec<_> = ends.iter().map(|(_, end)| end.clone()).collect();
    for power in [16.0, 32.0] {
        let pairs = column.windows(2).map(|pair| {
            let mut better = pair[1].clone();
            for (to, fine, coarse) in [
                (&mut better.q, &pair[1].q, &pair[0].q),
                (&mut better.p, &pair[1].p, &pair[0].p),
            ] {
                to.accumulate(1.0 / (power - 1.0), fine);
                to.accumulate(-1.0 / (power - 1.0), coarse);
            }
            better
        });
        column = pairs.collect();
    }
    column.pop().expect("three ends")
}
