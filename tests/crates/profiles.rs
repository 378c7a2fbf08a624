//! Runs over each driver of loops, and the stages of implicit schemes, for programs that are compiled with
//! different optimisations.

use mechanics::prelude::*;
use mechanics::schemes::DiscreteGradient;
use mechanics::{Scheme, Vector};

hamiltonian! {
    /// Neighbours, periodic and with an open end.
    pub struct Ring { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }
        + sum(i in 1..n) { if q[i] < q[i - 1] { (q[i] - q[i - 1])^4/4 } else { sin(q[i])*q[i - 1] } }
}

hamiltonian! {
    /// Bodies with those before them.
    pub struct Bodies { n: usize }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2 + i) }
        - sum(i in 0..n, j in 0..i) { (j + 1)/sqrt(norm_squared(q[i] - q[j]) + 1) }
}

hamiltonian! {
    /// Rows of a matrix, and a sum inside a function.
    pub struct Rows { n: usize }
    H(q[n]; p[n]) = sqrt(1 + sum(i in 0..n) { p[i]^2 }) + sum(i in 0..n, j in 0..n) { cos(q[i] - 2*q[j])/n }
}

hamiltonian! {
    /// A field on two axes.
    pub struct Field { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + u[i][j]^4/4 + ((u[(i + 1) % n][j] - u[i][j])^2 + (u[i][(j + 1) % m] - u[i][j])^2)/2
    }
}

hamiltonian! {
    /// A field on three axes, with two values at each site.
    pub struct Solid { n: usize, m: usize, k: usize }
    H(u[n][m][k][2]; p[n][m][k][2]) = sum(a in 0..n, b in 0..m, c in 0..k) {
        norm_squared(p[a][b][c])/2 + norm_squared(u[a][b][c])^2/4 + norm_squared(u[a][b][(c + 2) % k] - u[a][b][c])/2
    } + sum(a in 1..n, b in 0..m, c in 0..k) { dot(u[a][b][c], u[a - 1][b][c]) }
}

hamiltonian! {
    /// Functions and a division, without loops.
    pub struct Pendulum { l = 10.0 }
    H(theta; p) = p^2/(2*l^2) - l*cos(theta)
}

hamiltonian! {
    /// The paper's equation (34).
    pub struct Product {}
    H = 0.5*(q^2 + 1)*(p^2 + 1)
}

/// A number in which each bit of the ends of some runs counts.
struct Ends {
    step: f64,
    number: u64,
}

impl Ends {
    /// Adds the end of a run and H there.
    fn add<S, M>(&mut self, system: S, scheme: M)
    where
        S: System,
        M: Scheme<S>,
    {
        let mut start = State {
            q: system.zeros(),
            p: system.zeros(),
            t: 0.0,
        };
        for k in 0..start.q.len() {
            // Exact, so that no function of a library comes in.
            *start.q.component_mut(k) = ((7 * k % 16) as f64 - 7.5) / 16.0;
            *start.p.component_mut(k) = ((5 * k % 32) as f64 - 15.5) / 64.0;
        }
        let mut run = Integrator::new(&system, scheme, start, self.step)
            .expect("the start and the step are good");
        let end = run.advance(4).expect("the run stays finite");
        let energy = system.energy(end);
        for x in end.q.components().chain(end.p.components()).chain([energy]) {
            let mixed = (self.number ^ x.to_bits()).wrapping_mul(0x0000_0100_0000_01b3);
            self.number = mixed.rotate_left(17);
        }
    }
}

/// A number for each kind of run with this step, in which each bit of each end counts.
pub fn ends(step: f64) -> Vec<(&'static str, u64)> {
    let mut ends = Vec::new();
    let mut of = |name, runs: &dyn Fn(&mut Ends)| {
        let mut of_kind = Ends { step, number: 0 };
        runs(&mut of_kind);
        ends.push((name, of_kind.number));
    };
    let sizes = || (1..=40).chain(95..=104);
    of("neighbours", &|ends| {
        for n in sizes() {
            ends.add(Ring::new(n).expect("a size"), StormerVerlet::default());
        }
    });
    of("pairs", &|ends| {
        for n in sizes() {
            ends.add(Bodies::new(n).expect("a size"), StormerVerlet::default());
        }
    });
    of("rows", &|ends| {
        for n in sizes() {
            ends.add(Rows::new(n).expect("a size"), StormerVerlet::default());
        }
    });
    of("two axes", &|ends| {
        for n in sizes() {
            ends.add(
                Field::new(n, 3).expect("two sizes"),
                StormerVerlet::default(),
            );
            ends.add(
                Field::new(3, n).expect("two sizes"),
                StormerVerlet::default(),
            );
        }
    });
    of("three axes", &|ends| {
        for n in sizes() {
            ends.add(
                Solid::new(2, 3, n).expect("three sizes"),
                StormerVerlet::default(),
            );
        }
    });
    of("stages", &|ends| {
        ends.add(Pendulum::default(), Gauss::<4>::default());
        ends.add(Pendulum::default(), GaussNystrom::<8>::default());
        ends.add(Product {}, Gauss::<8>::default());
        ends.add(Ring::new(5).expect("a size"), Gauss::<4>::default());
    });
    of("implicit schemes", &|ends| {
        ends.add(Product {}, ImplicitMidpoint::default());
        ends.add(Product {}, DiscreteGradient::default());
    });
    of("exact flows", &|ends| {
        ends.add(Product {}, Strang);
        ends.add(Pendulum::default(), BlanesMoan4);
    });
    ends
}
