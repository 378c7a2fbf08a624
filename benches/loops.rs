//! Loops over arrays in one run, against loops by hand in lanes and against scalar loops by hand.
//!
//! `cargo bench --bench loops` prints ns per unit of work and the ratios of times, which are the
//! fastest of many short alternating rounds in one process. All compute the same functions, unfused but for
//! the runs in the columns `fused`: `/`, `sqrt` and the elementary functions of the library. With
//! `-- --check` nothing is timed, and it fails where they do not reach the same end. Any other argument selects the workloads whose names
//! contain it.
//!
//! `-- --threads` compares one thread with two instead, for 10 000 bodies and for fields of 1000 × 1000 sites: by wall
//! time, for which two cores must be free, and by CPU time. It fails if the ends differ in a bit.

#[path = "support/rounds.rs"]
mod harness;
#[path = "support/threads.rs"]
mod threads;

use hamiltonian::prelude::*;
use hamiltonian::schemes::author::Map;
use hamiltonian::{Scheme, Vector};
use hamiltonian_lanes::Pack;
use harness::{ByHand, Workload, add, by_hand, run, start};

hamiltonian::hamiltonian! {
    /// A periodic Toda lattice.
    pub struct Toda { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }
}

hamiltonian::hamiltonian! {
    /// A periodic FPUT chain.
    pub struct Fput { n: usize, alpha = 0.25 }
    let V(r) = r^2/2 + alpha*r^3/3;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + V(q[(i + 1) % n] - q[i]) }
}

hamiltonian::hamiltonian! {
    /// Point masses.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) }
}

hamiltonian::hamiltonian! {
    /// The φ⁴ field on a periodic square lattice.
    pub struct Phi4 { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + (u[i][j]^2 - 1)^2/4
            + ((u[(i + 1) % n][j] - u[i][j])^2 + (u[i][(j + 1) % m] - u[i][j])^2)/2
    }
}

hamiltonian::hamiltonian! {
    /// The sine-Gordon field on a periodic square lattice.
    pub struct SineGordon { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + 1 - cos(u[i][j])
            + ((u[(i + 1) % n][j] - u[i][j])^2 + (u[i][(j + 1) % m] - u[i][j])^2)/2
    }
}

/// A chain of equal bonds.
#[inline(always)]
fn chain<P: Pack, B: Bond>(q: &[f64], p: &mut [f64], work: &mut [f64], c: f64, bond: B) {
    let (n, lanes) = (q.len(), P::LANES as usize);
    let c = P::constant(c, 0.0);
    let work = &mut work[..n];
    let chunks = work[..n - 1].chunks_mut(lanes);
    for ((to, a), b) in chunks.zip(q.chunks(lanes)).zip(q[1..].chunks(lanes)) {
        (c * bond.slope(P::load(b, 0.0) - P::load(a, 0.0))).store(to);
    }
    work[n - 1] = (c * bond.slope(P::constant(q[0] - q[n - 1], 0.0))).lane(0);
    p[0] += work[0] - work[n - 1];
    let chunks = p[1..].chunks_mut(lanes);
    for ((to, a), b) in chunks.zip(work.chunks(lanes)).zip(work[1..].chunks(lanes)) {
        (P::load(to, 0.0) + (P::load(b, 0.0) - P::load(a, 0.0))).store(to);
    }
}

/// The derivative of the potential of a bond by its stretch r = q[i+1] − q[i].
trait Bond: Copy {
    fn slope<P: Pack>(self, r: P) -> P;
}

/// e^{−r}: Toda's bond.
#[derive(Clone, Copy)]
struct Exponential;

impl Bond for Exponential {
    #[inline(always)]
    fn slope<P: Pack>(self, r: P) -> P {
        -(-r).exp()
    }
}

/// r²/2 + r³/12: a bond of the FPUT chain.
#[derive(Clone, Copy)]
struct Cubic;

impl Bond for Cubic {
    #[inline(always)]
    fn slope<P: Pack>(self, r: P) -> P {
        r + P::constant(0.25, 0.0) * r * r
    }
}

impl<B: Bond> ByHand for B {
    #[inline(always)]
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], work: &mut [f64], c: f64) {
        chain::<P, B>(q, p, work, c, self);
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// A potential at each site of a square lattice, with linear springs to the four neighbours.
trait Site: Copy {
    /// V′(u).
    fn slope<P: Pack>(self, u: P) -> P;
}

/// (u² − 1)²/4.
#[derive(Clone, Copy)]
struct DoubleWell;

impl Site for DoubleWell {
    #[inline(always)]
    fn slope<P: Pack>(self, u: P) -> P {
        u * (u * u - P::constant(1.0, 0.0))
    }
}

/// 1 − cos u.
#[derive(Clone, Copy)]
struct Cosine;

impl Site for Cosine {
    #[inline(always)]
    fn slope<P: Pack>(self, u: P) -> P {
        u.sin()
    }
}

/// A field on a periodic square lattice.
#[derive(Clone, Copy)]
struct Field<S>(S);

impl<S: Site> Field<S> {
    /// The force on a site with a sum of neighbours.
    #[inline(always)]
    fn force<P: Pack>(self, u: P, neighbours: P) -> P {
        neighbours - P::constant(4.0, 0.0) * u - self.0.slope(u)
    }
}

impl<S: Site> ByHand for Field<S> {
    #[inline(always)]
    fn kick<P: Pack>(self, u: &[f64], p: &mut [f64], _: &mut [f64], c: f64) {
        let (lanes, rows, factor) = (P::LANES as usize, EDGE, P::constant(c, 0.0));
        let mut i = 0;
        while i < rows {
            let row = |i: usize| &u[i * EDGE..(i + 1) * EDGE];
            let (own, up, down) = (row(i), row((i + rows - 1) % rows), row((i + 1) % rows));
            let to = &mut p[i * EDGE..(i + 1) * EDGE];
            for (j, left, right) in [(0, EDGE - 1, 1), (EDGE - 1, EDGE - 2, 0)] {
                let neighbours = up[j] + down[j] + own[left] + own[right];
                to[j] += (factor
                    * self.force(P::constant(own[j], 0.0), P::constant(neighbours, 0.0)))
                .lane(0);
            }
            let inner = EDGE - 2;
            let chunks = to[1..=inner].chunks_mut(lanes);
            let beside = own[..inner].chunks(lanes).zip(own[2..].chunks(lanes));
            let across = (up[1..=inner].chunks(lanes)).zip(down[1..=inner].chunks(lanes));
            let here = own[1..=inner].chunks(lanes);
            for (((to, u), (left, right)), (up, down)) in chunks.zip(here).zip(beside).zip(across) {
                let across = P::load(up, 0.0) + P::load(down, 0.0);
                let neighbours = across + P::load(left, 0.0) + P::load(right, 0.0);
                let force = self.force(P::load(u, 0.0), neighbours);
                factor.fma(force, P::load(to, 0.0)).store(to);
            }
            i += 1;
        }
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// Bodies of mass 1/n.
#[derive(Clone, Copy)]
struct Gravitating;

impl ByHand for Gravitating {
    #[inline(always)]
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], m: &mut [f64], c: f64) {
        let (n, lanes) = (q.len() / 3, P::LANES as usize);
        let (x, yz) = q.split_at(n);
        let (y, z) = yz.split_at(n);
        let (px, pyz) = p.split_at_mut(n);
        let (py, pz) = pyz.split_at_mut(n);
        let mut i = 0;
        while i < n {
            let [xi, yi, zi] = [
                P::constant(x[i], 0.0),
                P::constant(y[i], 0.0),
                P::constant(z[i], 0.0),
            ];
            let ci = P::constant(c * m[i], 0.0);
            let mut sum = [P::zero(); 3];
            let mut rest = [0.0; 3];
            let mut k = 0;
            while k < i {
                let end = if k + lanes <= i { k + lanes } else { i };
                let dx = xi - P::load(&x[k..end], 0.0);
                let dy = yi - P::load(&y[k..end], 0.0);
                let dz = zi - P::load(&z[k..end], 0.0);
                let r2 = dx * dx + dy * dy + dz * dz;
                let f = ci * P::load(&m[k..end], 0.0) / (r2 * r2.sqrt());
                let (fx, fy, fz) = (f * dx, f * dy, f * dz);
                (P::load(&px[k..end], 0.0) + fx).store(&mut px[k..end]);
                (P::load(&py[k..end], 0.0) + fy).store(&mut py[k..end]);
                (P::load(&pz[k..end], 0.0) + fz).store(&mut pz[k..end]);
                if end - k == lanes {
                    sum = [sum[0] + fx, sum[1] + fy, sum[2] + fz];
                } else {
                    let mut lane = 0;
                    while lane < (end - k) as u32 {
                        rest[0] += fx.lane(lane);
                        rest[1] += fy.lane(lane);
                        rest[2] += fz.lane(lane);
                        lane += 1;
                    }
                }
                k += lanes;
            }
            let mut lane = 0;
            while lane < P::LANES {
                rest[0] += sum[0].lane(lane);
                rest[1] += sum[1].lane(lane);
                rest[2] += sum[2].lane(lane);
                lane += 1;
            }
            px[i] -= rest[0];
            py[i] -= rest[1];
            pz[i] -= rest[2];
            i += 1;
        }
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c * (q.len() / 3) as f64);
    }
}

const SITES: usize = 1024;
const BODIES: usize = 1000;
/// The sites of a square lattice along an edge.
const EDGE: usize = 256;

fn masses() -> Vec<f64> {
    vec![1.0 / BODIES as f64; BODIES]
}

const ALL: &[Workload] = &[
    Workload {
        name: "Toda, 1024 sites",
        units: SITES as f64,
        steps: 400,
        library: |steps, fused| run(&Toda::new(SITES).unwrap(), start(SITES, 1), steps, fused),
        lanes: |steps| by_hand(Exponential, start(SITES, 1), vec![0.0; SITES], steps, true),
        scalar: |steps| by_hand(Exponential, start(SITES, 1), vec![0.0; SITES], steps, false),
    },
    Workload {
        name: "FPUT, 1024 sites",
        units: SITES as f64,
        steps: 1600,
        library: |steps, fused| run(&Fput::new(SITES).unwrap(), start(SITES, 1), steps, fused),
        lanes: |steps| by_hand(Cubic, start(SITES, 1), vec![0.0; SITES], steps, true),
        scalar: |steps| by_hand(Cubic, start(SITES, 1), vec![0.0; SITES], steps, false),
    },
    // Steps enough that what `advance` does once (copies of the state, a check of all numbers and of H) takes little of the
    // time: an evaluation of H takes as long as a step.
    Workload {
        name: "gravity, 1000 bodies (pairs)",
        units: (BODIES * (BODIES - 1) / 2) as f64,
        steps: 64,
        library: |steps, fused| {
            let bodies = Gravity::new(BODIES, masses()).unwrap();
            run(&bodies, start(BODIES, 3), steps, fused)
        },
        lanes: |steps| by_hand(Gravitating, start(BODIES, 3), masses(), steps, true),
        scalar: |steps| by_hand(Gravitating, start(BODIES, 3), masses(), steps, false),
    },
    // As above.
    Workload {
        name: "φ⁴, 256 × 256 sites",
        units: (EDGE * EDGE) as f64,
        steps: 48,
        library: |steps, fused| {
            run(
                &Phi4::new(EDGE, EDGE).unwrap(),
                start(EDGE, EDGE),
                steps,
                fused,
            )
        },
        lanes: |steps| {
            by_hand(
                Field(DoubleWell),
                start(EDGE, EDGE),
                Vec::new(),
                steps,
                true,
            )
        },
        scalar: |steps| {
            by_hand(
                Field(DoubleWell),
                start(EDGE, EDGE),
                Vec::new(),
                steps,
                false,
            )
        },
    },
    Workload {
        name: "sine-Gordon, 256 × 256 sites",
        units: (EDGE * EDGE) as f64,
        steps: 48,
        library: |steps, fused| {
            run(
                &SineGordon::new(EDGE, EDGE).unwrap(),
                start(EDGE, EDGE),
                steps,
                fused,
            )
        },
        lanes: |steps| by_hand(Field(Cosine), start(EDGE, EDGE), Vec::new(), steps, true),
        scalar: |steps| by_hand(Field(Cosine), start(EDGE, EDGE), Vec::new(), steps, false),
    },
];

/// Two threads against one, for a system.
fn share<S>(name: &str, system: &S, steps: u64)
where
    S: System,
    StormerVerlet: Scheme<S, Map<f64>: Sync>,
    <<StormerVerlet as Scheme<S>>::Map<f64> as Map>::Work: Send,
{
    let mut start = State {
        q: system.zeros(),
        p: system.zeros(),
        t: 0.0,
    };
    for k in 0..start.q.len() {
        *start.q.component_mut(k) = harness::noise(k);
    }
    let mut runs = [1, 2].map(|threads| {
        let run = Integrator::new(system, StormerVerlet::default(), start.clone(), harness::H);
        run.unwrap().with_threads(threads)
    });
    threads::compare(name, 20, |k| _ = runs[k].advance(steps).unwrap());
    let [one, two] = runs;
    assert!(one.state() == two.state(), "the ends of {name} differ");
}

fn main() {
    if !std::env::args().any(|argument| argument == "--threads") {
        return harness::main(ALL);
    }
    const BODIES: usize = 10_000;
    let bodies = Gravity::new(BODIES, vec![1.0 / BODIES as f64; BODIES]).unwrap();
    share("gravity, 10 000 bodies", &bodies, 2);
    let field = SineGordon::new(1000, 1000).unwrap();
    share("sine-Gordon, 1000 × 1000 sites", &field, 10);
    share("φ⁴, 1000 × 1000 sites", &Phi4::new(1000, 1000).unwrap(), 20);
}
