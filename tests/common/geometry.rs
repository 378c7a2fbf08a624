//! The 2-form a scheme preserves, measured by exact tangents.

use super::state;
use hamiltonian::VectorOf;
use hamiltonian::schemes::walk::Visitor;
use hamiltonian::{
    Dual, Integrator, Scheme, State, System, Vector,
    schemes::author::{Clock, Entry, Form, Map, Scratch, Step},
};

/// MᵀJM − J, and ‖M‖², both in the maximum norm of entries; columns of M are `columns`.
pub fn defect(columns: &[Vec<f64>], form: impl Fn(usize, usize) -> f64) -> (f64, f64) {
    let n = columns.len();
    let (mut defect, mut size) = (0.0_f64, 0.0_f64);
    for i in 0..n {
        for j in 0..n {
            let mut sum = -form(i, j);
            for k in 0..n {
                for l in 0..n {
                    let weight = form(k, l);
                    if weight != 0.0 {
                        sum += columns[i][k] * weight * columns[j][l];
                    }
                }
            }
            defect = defect.max(sum.abs());
            size = size.max(columns[i][j].abs());
        }
    }
    (defect, size * size)
}

/// dq∧dp of one point with n coordinates, flat as q, p.
pub fn one_point(n: usize) -> impl Fn(usize, usize) -> f64 {
    move |i, j| match () {
        () if j == i + n => 1.0,
        () if i == j + n => -1.0,
        () => 0.0,
    }
}

/// dq_x∧dp_y + dq_y∧dp_x of two points, flat as x.q, x.p, y.q, y.p.
pub fn crossed(n: usize) -> impl Fn(usize, usize) -> f64 {
    move |i, j| {
        let partner = |k: usize| match k / n {
            0 => (k + 3 * n, 1.0),
            1 => (k + n, -1.0),
            2 => (k - n, 1.0),
            _ => (k - 3 * n, -1.0),
        };
        let (of, sign) = partner(i);
        if of == j { sign } else { 0.0 }
    }
}

/// dq_x∧dp_x + dq_y∧dp_y of two copies: two-point schemes do not preserve it.
pub fn uncrossed(n: usize) -> impl Fn(usize, usize) -> f64 {
    move |i, j| {
        let half = 2 * n;
        if i / half == j / half {
            one_point(n)(i % half, j % half)
        } else {
            0.0
        }
    }
}

/// Makes `n` steps after the first `made`: all steps are compiled in one place.
#[inline(never)]
fn steps<R: Map>(
    map: &R,
    clock: Clock<<R::Carried as Vector>::Scalar>,
    [made, n]: [u64; 2],
    z: &mut R::Carried,
    work: &mut R::Work,
) {
    map.run(clock, made, n, z, work);
}

/// The tangent of the visible state after `steps` steps, by dual numbers.
pub fn visible_tangent<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, Dual<f64>>>,
    h: f64,
    steps: u64,
) -> Vec<Vec<f64>>
where
    S: System,
    M: Scheme<S>,
{
    let n = start.q.len();
    (0..2 * n)
        .map(|seed| {
            let mut start = start.clone();
            let moved = if seed < n { &mut start.q } else { &mut start.p };
            moved.component_mut(seed % n).eps = 1.0;
            let run = Integrator::new(system, scheme.clone(), start, Dual::fixed(h));
            let mut run = run.expect("a good start");
            let end = run.advance(steps).expect("good steps");
            end.q
                .components()
                .chain(end.p.components())
                .map(|x| x.eps)
                .collect()
        })
        .collect()
}

/// The tangent of one step of the carried value, by dual numbers, at a carried point that the run
/// from `start` reaches after `made` steps.
pub fn carried_tangent<S, M>(
    system: &S,
    scheme: &M,
    start: &State<VectorOf<S, Dual<f64>>>,
    h: f64,
    made: u64,
) -> Vec<Vec<f64>>
where
    S: System,
    M: Scheme<S>,
{
    let prepared = system.prepare();
    let map = scheme.prepare(&prepared, Step::of(Dual::fixed(h)));
    let mut carried = scheme.start(&prepared, start, Dual::fixed(h));
    let mut work = Scratch::like(&carried);
    let duration = f64::from(scheme.entry().duration);
    let clock = Clock::new(start.t, Dual::fixed(h * duration));
    steps(&map, clock, [0, made], &mut carried, &mut work);
    (0..carried.len())
        .map(|seed| {
            let mut carried = carried.clone();
            *carried.component_mut(seed) = Dual::variable(carried.component(seed).re);
            steps(&map, clock, [made, 1], &mut carried, &mut work);
            carried.components().map(|x| x.eps).collect()
        })
        .collect()
}

/// A start at t = 0.3.
pub fn start<S: System>(system: &S, q: &[f64], p: &[f64]) -> State<VectorOf<S, Dual<f64>>> {
    let numbers = |v: &[f64]| v.iter().copied().map(Dual::fixed).collect::<Vec<_>>();
    state(system, Dual::fixed(0.3), numbers(q), numbers(p))
}

/// The form each visited scheme says it preserves, over the first, second and third step.
pub struct Geometry<S> {
    pub system: S,
    q: Vec<f64>,
    p: Vec<f64>,
    h: f64,
    pub measured: Vec<(Entry, f64)>,
}

impl<S> Geometry<S> {
    /// From (q, p) at t = 0.3, with the step `h`.
    pub fn new(system: S, q: &[f64], p: &[f64], h: f64) -> Geometry<S> {
        Geometry {
            system,
            q: q.to_vec(),
            p: p.to_vec(),
            h,
            measured: Vec::new(),
        }
    }
}

impl<S: System> Visitor<S> for Geometry<S> {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        // Exact up to the rounding of the tangents themselves: entries of M are sums of a few
        // products, wrong by some ulps of ‖M‖, and enter twice.
        const BOUND: f64 = 1e-13;
        let entry = scheme.entry();
        let n = self.q.len();
        let start = start(&self.system, &self.q, &self.p);
        for made in 0..3 {
            let (worst, size) = match entry.preserves {
                Form::TwoPoint => defect(
                    &carried_tangent(&self.system, &scheme, &start, self.h, made),
                    crossed(n),
                ),
                Form::TwoCopies => defect(
                    &carried_tangent(&self.system, &scheme, &start, self.h, made),
                    uncrossed(n),
                ),
                Form::CarriedPoint => defect(
                    &carried_tangent(&self.system, &scheme, &start, self.h, made),
                    one_point(n),
                ),
                Form::OnePoint | Form::Nearly | Form::Nothing => defect(
                    &visible_tangent(&self.system, &scheme, &start, self.h, made + 1),
                    one_point(n),
                ),
            };
            let name = format!("{entry} on {}", self.system.description().name);
            match entry.preserves {
                // Pseudo-symplectic steps are as long as to tell.
                Form::Nearly | Form::Nothing => {
                    assert!(worst > 1e3 * BOUND * size, "{name}: {worst:e} of {size:e}");
                }
                _ => assert!(worst <= BOUND * size, "{name}: {worst:e} of {size:e}"),
            }
            self.measured.push((entry, worst / size));
        }
    }
}
