//! The order of a scheme, measured.

use super::reference::{difference, solution};
use super::state;
use hamiltonian::VectorOf;
use hamiltonian::schemes::walk::Visitor;
use hamiltonian::{DoubleDouble, Integrator, Real, Scheme, State, System, schemes::author::Entry};

/// The exponent of the error against the step, by least squares over all points.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<_> = points
        .iter()
        .map(|(h, error)| (h.ln(), error.ln()))
        .collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let covariance: f64 = logs.iter().map(|log| (log.0 - x) * (log.1 - y)).sum();
    covariance / logs.iter().map(|log| (log.0 - x).powi(2)).sum::<f64>()
}

/// The order of every visited scheme: errors at several times against the reference, with
/// `coarsest`, and four halvings of it.
///
/// The maximum over several times keeps a zero of the leading error term from passing for order;
/// double-double keeps rounding out of the errors.
pub struct Order<S: System> {
    pub system: S,
    exact: Vec<State<VectorOf<S, DoubleDouble>>>,
    between: DoubleDouble,
    coarsest: f64,
    pub measured: Vec<(Entry, f64)>,
}

impl<S: System> Order<S> {
    /// From (q, p) at t = 0.3, at eight times up to `span` after that.
    pub fn new(system: S, q: &[f64], p: &[f64], span: f64, coarsest: f64) -> Order<S> {
        const TIMES: u32 = 8;
        let between = DoubleDouble::from(span) / DoubleDouble::from(f64::from(TIMES));
        let numbers = |v: &[f64]| {
            v.iter()
                .copied()
                .map(DoubleDouble::from)
                .collect::<Vec<_>>()
        };
        let t = DoubleDouble::from(0.3);
        let mut exact = vec![state(&system, t, numbers(q), numbers(p))];
        for _ in 0..TIMES {
            let last = exact.last().expect("the start");
            exact.push(solution(&system, last, last.t + between));
        }
        Order {
            system,
            exact,
            between,
            coarsest,
            measured: Vec::new(),
        }
    }
}

impl<S: System> Visitor<S> for Order<S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let mut points = Vec::new();
        for halving in 0..5 {
            // An even number of steps to each time: some schemes advance by two of them.
            let steps =
                2 * (self.between.to_f64() / self.coarsest / 2.0).ceil() as u32 * (1 << halving);
            let h = self.between / DoubleDouble::from(f64::from(steps));
            let run = Integrator::new(&self.system, scheme.clone(), self.exact[0].clone(), h);
            let mut run = run.expect("a good start");
            let error = run
                .states(u64::from(steps / entry.duration))
                .zip(&self.exact[1..])
                .map(|(state, exact)| difference(&state.expect("a good step"), exact))
                .fold(0.0, f64::max);
            points.push((h.to_f64(), error));
        }
        let slope = slope(&points);
        let name = format!("{entry} on {}", self.system.description().name);
        assert!(
            (slope - f64::from(entry.order)).abs() <= 0.1,
            "{name}: slope {slope}, {points:?}"
        );
        self.measured.push((entry, slope));
    }
}
