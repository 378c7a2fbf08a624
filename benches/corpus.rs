//! Shapes of loops in one run: each against a straight lane loop by hand that gathers, at a site, the force
//! of all its neighbours.
//!
//! Loops that stay scalar: those that compute more than 300 values in an iteration, that have loops inside, that
//! read no element that moves on by one (they gain nothing), that call a function which is a parameter of the
//! type or use a condition from outside (neither has a form in lanes), and flows in place, whose iterations
//! follow from each other.
//!
//! `cargo bench --bench corpus` prints the table of `loops`; `-- --check` compares the ends of runs alone.

#[path = "support/rounds.rs"]
mod harness;

use hamiltonian_lanes::{Pack, Real};
use harness::{ByHand, Timed, Workload, add, by_hand, noise, run, start};

hamiltonian::hamiltonian! {
    /// Neighbours two sites away.
    pub struct Two { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + V(q[(i + 2) % n] - q[i]) }
}

hamiltonian::hamiltonian! {
    /// Neighbours five sites away.
    pub struct Five { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + V(q[(i + 5) % n] - q[i]) }
}

hamiltonian::hamiltonian! {
    /// Neighbours and next-nearest neighbours.
    pub struct Next { n: usize, a = 0.25 }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) {
        p[i]^2/2 + V(q[(i + 1) % n] - q[i]) + a*V(q[(i + 2) % n] - q[i])
    }
}

hamiltonian::hamiltonian! {
    /// Open ends.
    pub struct Open { n: usize }
    let V(r) = r^2/2 + r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 1..n) { V(q[i] - q[i - 1]) }
}

hamiltonian::hamiltonian! {
    /// Beads that push and do not pull.
    pub struct Beads { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^2/2 }
        + sum(i in 1..n) { if q[i] < q[i - 1] { (q[i] - q[i - 1])^4/4 } else { 0 } }
}

hamiltonian::hamiltonian! {
    /// A weight and a depth for each site, rows of one array.
    pub struct Weights { n: usize, w: [2][n] }
    H(q[n]; p[n]) = sum(i in 0..n) {
        p[i]^2/2 + w[0][i]*q[i]^2/2 + w[1][i]*(q[i]^2 - 1)^2/4
    }
}

hamiltonian::hamiltonian! {
    /// A stiffness for each pair of sites, row by row.
    pub struct Stiff { n: usize, w: [n][n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^4/4 }
        + sum(i in 0..n, j in 0..n) { w[i][j]*q[i]*q[j] }/2
}

hamiltonian::hamiltonian! {
    /// A cubic lattice.
    pub struct Cube { n: usize }
    H(u[n][n][n]; p[n][n][n]) = sum(i in 0..n, j in 0..n, k in 0..n) {
        p[i][j][k]^2/2 + (u[i][j][k]^2 - 1)^2/4
            + ((u[(i + 1) % n][j][k] - u[i][j][k])^2 + (u[i][(j + 1) % n][k] - u[i][j][k])^2
                + (u[i][j][(k + 1) % n] - u[i][j][k])^2)/2
    }
}

hamiltonian::hamiltonian! {
    /// A square lattice with open ends.
    pub struct Plate { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 + (u[i][j]^2 - 1)^2/4 }
        + sum(i in 1..n, j in 0..m) { (u[i][j] - u[i - 1][j])^2/2 }
        + sum(i in 0..n, j in 1..m) { (u[i][j] - u[i][j - 1])^2/2 }
}

/// The force on a site from its element and those at some distances.
trait Force<const N: usize>: Copy {
    /// The distances.
    const AT: [isize; N];
    /// True if the first site is a neighbour of the last.
    const IS_PERIODIC: bool = true;
    /// The force.
    fn force<T: Real>(self, own: T, at: [T; N]) -> T;
}

/// A chain of sites.
#[derive(Clone, Copy)]
struct Chain<F, const N: usize>(F);

impl<F: Force<N>, const N: usize> ByHand for Chain<F, N> {
    #[inline(always)]
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], _: &mut [f64], c: f64) {
        let (n, lanes, factor) = (q.len() as isize, P::LANES as usize, P::constant(c, 0.0));
        let reach = F::AT
            .map(isize::unsigned_abs)
            .into_iter()
            .max()
            .unwrap_or(0);
        let end = n as usize - reach;
        for i in (0..reach as isize).chain(end as isize..n) {
            // A missing neighbour stands where the site does: no bond has a force there.
            let at = F::AT.map(|by| match F::IS_PERIODIC || (0..n).contains(&(i + by)) {
                true => q[((i + by + n) % n) as usize],
                false => q[i as usize],
            });
            p[i as usize] += c * self.0.force(q[i as usize], at);
        }
        // No closures: a call in a lane loop would not have the instructions of the level.
        let mut i = reach;
        while i < end {
            let to = if i + lanes < end { i + lanes } else { end };
            let mut at = [P::zero(); N];
            let mut k = 0;
            while k < N {
                let from = i.wrapping_add_signed(F::AT[k]);
                at[k] = P::load(&q[from..from + (to - i)], 0.0);
                k += 1;
            }
            let force = self.0.force(P::load(&q[i..to], 0.0), at);
            factor
                .fma(force, P::load(&p[i..to], 0.0))
                .store(&mut p[i..to]);
            i = to;
        }
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// V′(r) = r + r³.
#[inline(always)]
fn slope<T: Real>(r: T) -> T {
    r + r * r * r
}

/// Bonds over one distance.
#[derive(Clone, Copy)]
struct Over<const D: isize>;

impl<const D: isize> Force<2> for Over<D> {
    const AT: [isize; 2] = [-D, D];
    #[inline(always)]
    fn force<T: Real>(self, own: T, [before, after]: [T; 2]) -> T {
        slope(after - own) - slope(own - before)
    }
}

/// Bonds over two distances.
#[derive(Clone, Copy)]
struct Both;

impl Force<4> for Both {
    const AT: [isize; 4] = [-2, -1, 1, 2];
    #[inline(always)]
    fn force<T: Real>(self, own: T, [far, before, after, beyond]: [T; 4]) -> T {
        let a = T::constant(0.25, 0.0);
        let near = slope(after - own) - slope(own - before);
        a.fma(slope(beyond - own) - slope(own - far), near)
    }
}

/// Bonds between neighbours that exist.
#[derive(Clone, Copy)]
struct Ends;

impl Force<2> for Ends {
    const AT: [isize; 2] = [-1, 1];
    const IS_PERIODIC: bool = false;
    #[inline(always)]
    fn force<T: Real>(self, own: T, [before, after]: [T; 2]) -> T {
        slope(after - own) - slope(own - before)
    }
}

/// Beads in wells.
#[derive(Clone, Copy)]
struct Pushed;

impl Force<2> for Pushed {
    const AT: [isize; 2] = [-1, 1];
    const IS_PERIODIC: bool = false;
    #[inline(always)]
    fn force<T: Real>(self, own: T, [before, after]: [T; 2]) -> T {
        push(after - own) - push(own - before) - own
    }
}

/// V′(r) = r³ below 0.
#[inline(always)]
fn push<T: Real>(r: T) -> T {
    T::select(r.lt(T::zero()), r * r * r, T::zero())
}

/// Two weights of each site.
#[derive(Clone, Copy)]
struct Weighed;

impl ByHand for Weighed {
    #[inline(always)]
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], w: &mut [f64], c: f64) {
        let (n, lanes) = (q.len(), P::LANES as usize);
        let (a, b) = w.split_at(n);
        let (c, one) = (P::constant(-c, 0.0), P::constant(1.0, 0.0));
        let sites = p.chunks_mut(lanes).zip(q.chunks(lanes));
        let weights = a.chunks(lanes).zip(b.chunks(lanes));
        for ((p, q), (a, b)) in sites.zip(weights) {
            let (q, a, b) = (P::load(q, 0.0), P::load(a, 0.0), P::load(b, 0.0));
            c.fma(q * (a + b * (q * q - one)), P::load(p, 0.0)).store(p);
        }
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// A matrix of stiffnesses, column by column, and its transpose.
#[derive(Clone, Copy)]
struct Matrix;

impl ByHand for Matrix {
    #[inline(always)]
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], w: &mut [f64], c: f64) {
        let (n, lanes) = (q.len(), P::LANES as usize);
        // ½(W + Wᵀ)q: a column of W changes all sites and is a sum for its own.
        let mut j = 0;
        while j < n {
            let column = &w[j * n..(j + 1) * n];
            let factor = P::constant(-0.5 * c * q[j], 0.0);
            let mut sum = P::zero();
            let mut i = 0;
            while i + lanes <= n {
                let w = P::load(&column[i..i + lanes], 0.0);
                sum = w.fma(P::load(&q[i..i + lanes], 0.0), sum);
                factor
                    .fma(w, P::load(&p[i..i + lanes], 0.0))
                    .store(&mut p[i..i + lanes]);
                i += lanes;
            }
            let mut total = 0.0;
            while i < n {
                total += column[i] * q[i];
                p[i] -= 0.5 * c * q[j] * column[i];
                i += 1;
            }
            let mut lane = 0;
            while lane < P::LANES {
                total += sum.lane(lane);
                lane += 1;
            }
            p[j] -= c * (0.5 * total + q[j] * q[j] * q[j]);
            j += 1;
        }
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// Rows of a lattice, each beside some others; `None` beyond an open end.
#[inline(always)]
fn rows<P: Pack, const N: usize>(
    u: &[f64],
    p: &mut [f64],
    c: f64,
    is_periodic: bool,
    beside: impl Fn(usize) -> [Option<usize>; N],
) {
    let (lanes, factor) = (P::LANES as usize, P::constant(c, 0.0));
    let one = P::constant(1.0, 0.0);
    let (m, mut i) = (EDGE, 0);
    while i * m < u.len() {
        let row = |i: usize| &u[i * m..(i + 1) * m];
        let own = row(i);
        let others = beside(i).map(|other| other.map_or(own, row));
        let to = &mut p[i * m..(i + 1) * m];
        for j in [0, m - 1] {
            let end = |beyond: usize| if is_periodic { own[beyond] } else { own[j] };
            let left = if j == 0 { end(m - 1) } else { own[j - 1] };
            let right = if j == m - 1 { end(0) } else { own[j + 1] };
            let mut force = (left - own[j]) + (right - own[j]) - own[j] * (own[j] * own[j] - 1.0);
            for other in others {
                force += other[j] - own[j];
            }
            to[j] += c * force;
        }
        let mut j = 1;
        while j < m - 1 {
            let end = if j + lanes < m - 1 { j + lanes } else { m - 1 };
            let here = P::load(&own[j..end], 0.0);
            // Differences as in H. The sum of all neighbours less a multiple would be fewer operations, and
            // round in proportion to u.
            let [left, right] = [&own[j - 1..end - 1], &own[j + 1..end + 1]];
            let mut force = (P::load(left, 0.0) - here) + (P::load(right, 0.0) - here);
            let mut k = 0;
            while k < N {
                force += P::load(&others[k][j..end], 0.0) - here;
                k += 1;
            }
            let force = force - here * (here * here - one);
            factor
                .fma(force, P::load(&to[j..end], 0.0))
                .store(&mut to[j..end]);
            j = end;
        }
        i += 1;
    }
}

/// A cubic lattice.
#[derive(Clone, Copy)]
struct Cubic;

impl ByHand for Cubic {
    #[inline(always)]
    fn kick<P: Pack>(self, u: &[f64], p: &mut [f64], _: &mut [f64], c: f64) {
        rows::<P, 4>(u, p, c, true, |row| {
            let (i, j) = (row / EDGE, row % EDGE);
            let at = |i: usize, j: usize| Some(i % EDGE * EDGE + j % EDGE);
            [
                at(i + EDGE - 1, j),
                at(i + 1, j),
                at(i, j + EDGE - 1),
                at(i, j + 1),
            ]
        });
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

/// A square lattice with open ends.
#[derive(Clone, Copy)]
struct Square;

impl ByHand for Square {
    #[inline(always)]
    fn kick<P: Pack>(self, u: &[f64], p: &mut [f64], _: &mut [f64], c: f64) {
        rows::<P, 2>(u, p, c, false, |i| {
            [i.checked_sub(1), Some(i + 1).filter(|i| *i < EDGE)]
        });
    }
    #[inline(always)]
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64) {
        add::<P>(q, p, c);
    }
}

const SITES: usize = 1024;
/// The sites whose pairs have a stiffness.
const FEW: usize = 300;
/// The sites of lattices along an edge.
const EDGE: usize = 64;

fn chain<F: Force<N>, const N: usize>(force: F, steps: usize, lanes: bool) -> Timed {
    by_hand(Chain(force), start(SITES, 1), Vec::new(), steps, lanes)
}

/// A workload of a chain: the library's type and the force by hand.
macro_rules! chain {
    ($name:literal, $system:ident, $force:expr) => {
        Workload {
            name: $name,
            units: SITES as f64,
            steps: 800,
            library: |steps, fused| {
                run(&$system::new(SITES).unwrap(), start(SITES, 1), steps, fused)
            },
            lanes: |steps| chain($force, steps, true),
            scalar: |steps| chain($force, steps, false),
        }
    };
}

fn weights(n: usize, rows: usize) -> Vec<Vec<f64>> {
    let row = |i| (0..n).map(|j| 1.0 + noise(i * n + j)).collect();
    (0..rows).map(row).collect()
}

fn stiffness() -> Vec<Vec<f64>> {
    let small = |row: Vec<f64>| row.into_iter().map(|x| x / FEW as f64).collect();
    weights(FEW, FEW).into_iter().map(small).collect()
}

/// The elements column by column.
fn by_columns(rows: Vec<Vec<f64>>) -> Vec<f64> {
    let columns = rows[0].len();
    (0..columns)
        .flat_map(|j| rows.iter().map(move |row| row[j]).collect::<Vec<_>>())
        .collect()
}

const ALL: &[Workload] = &[
    chain!("shift of 2", Two, Over::<2>),
    chain!("shift of 5", Five, Over::<5>),
    chain!("next-nearest", Next, Both),
    chain!("open ends", Open, Ends),
    chain!("`if` in a bond", Beads, Pushed),
    Workload {
        name: "rows of parameters",
        units: SITES as f64,
        steps: 800,
        library: |steps, fused| {
            let system = Weights::new(
                SITES,
                [weights(SITES, 2).remove(0), weights(SITES, 2).remove(1)],
            );
            run(&system.unwrap(), start(SITES, 1), steps, fused)
        },
        lanes: |steps| {
            by_hand(
                Weighed,
                start(SITES, 1),
                weights(SITES, 2).concat(),
                steps,
                true,
            )
        },
        scalar: |steps| {
            by_hand(
                Weighed,
                start(SITES, 1),
                weights(SITES, 2).concat(),
                steps,
                false,
            )
        },
    },
    Workload {
        name: "matrix of parameters",
        units: (FEW * FEW) as f64,
        steps: 20,
        library: |steps, fused| {
            run(
                &Stiff::new(FEW, stiffness()).unwrap(),
                start(FEW, 1),
                steps,
                fused,
            )
        },
        lanes: |steps| by_hand(Matrix, start(FEW, 1), by_columns(stiffness()), steps, true),
        scalar: |steps| by_hand(Matrix, start(FEW, 1), by_columns(stiffness()), steps, false),
    },
    // Steps enough that what `advance` does once (copies of the state, a check of all numbers) takes little of the time.
    Workload {
        name: "three axes",
        units: (EDGE * EDGE * EDGE) as f64,
        steps: 80,
        library: |steps, fused| {
            run(
                &Cube::new(EDGE).unwrap(),
                start(EDGE, EDGE * EDGE),
                steps,
                fused,
            )
        },
        lanes: |steps| by_hand(Cubic, start(EDGE, EDGE * EDGE), Vec::new(), steps, true),
        scalar: |steps| by_hand(Cubic, start(EDGE, EDGE * EDGE), Vec::new(), steps, false),
    },
    Workload {
        name: "two axes, open ends",
        units: (EDGE * EDGE) as f64,
        steps: 200,
        library: |steps, fused| {
            run(
                &Plate::new(EDGE, EDGE).unwrap(),
                start(EDGE, EDGE),
                steps,
                fused,
            )
        },
        lanes: |steps| by_hand(Square, start(EDGE, EDGE), Vec::new(), steps, true),
        scalar: |steps| by_hand(Square, start(EDGE, EDGE), Vec::new(), steps, false),
    },
];

fn main() {
    harness::main(ALL);
}
