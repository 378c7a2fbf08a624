//! Loops of one run on several threads: the bits of one thread.

use crate::allocator::{allocations, calls};
use crate::common::bits::LEVEL;
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{Checkpoint, Member, Real, Scheme, Vector};
use std::sync::{Mutex, PoisonError};
use std::thread::{ThreadId, current};

hamiltonian! {
    /// Sites with two neighbours on each side, and numbers of sites.
    pub struct Chain { n: usize, c = 0.75 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n])/(i + 1) }
        + c*sum(i in 0..n - 2) { cos(q[i] - q[i + 2]) }
}

hamiltonian! {
    /// Sites with neighbours as far away as slabs may share elements, and one site further.
    pub struct Far { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n - 32) { exp(q[i] - q[i + 32])/(i + 1) }
        + sum(i in 0..n - 33) { cos(q[i] - q[i + 33]) }
}

hamiltonian! {
    /// A field with a mass for each column, and two values at each site.
    pub struct Field { n: usize, m: usize, w: [m] }
    H(u[n][m][2]; p[n][m][2]) = sum(i in 0..n, j in 0..m) {
        norm_squared(p[i][j])/2 + w[j]*(norm_squared(u[i][j]) - 1)^2/4
            + (norm_squared(u[(i + 1) % n][j] - u[i][j]) + norm_squared(u[i][(j + 1) % m] - u[i][j]))/2
    }
}

hamiltonian! {
    /// Angles with a coupling that no polynomial is, to the right in rows and, without an end, below.
    pub struct Angles { n: usize, m: usize }
    H(a[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 - cos(a[i][(j + 1) % m] - a[i][j]) - (i + 1)*cos(a[i][j])/n
    } - sum(i in 0..n, j in 0..m) { cos(a[(i + 1) % n][j] - a[i][j]) }
}

hamiltonian! {
    /// Fields on two lattices, and a sum over each row.
    pub struct Two { n: usize, m: usize, k: usize }
    H(u[n][m], v[n][k]; pu[n][m], pv[n][k]) = sum(i in 0..n, j in 0..m) { pu[i][j]^2/2 + u[i][j]^4/4 }
        + sum(i in 0..n, j in 0..k) { pv[i][j]^2/2 + v[i][j]^2/2 }
        + sum(i in 0..n) { sum(j in 0..m) { u[i][j] }*sum(j in 0..k) { v[i][j] }/(m + k) }
}

hamiltonian! {
    /// Bodies with those before them.
    pub struct Bodies { n: usize, m: [n] }
    H(q[n][2]; p[n][2]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt(norm_squared(q[i] - q[j]) + 1) }
}

hamiltonian! {
    /// Rotors with those after them, each in a field of its own.
    pub struct Rotors { n: usize }
    H(a[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 - (i + 1)*cos(a[i])/n }
        + sum(i in 0..n, j in i + 1..n) { (1 - cos(a[i] - a[j]))/n }
}

/// A start of which no two components are the same.
fn start<S: System>(system: &S) -> State<VectorOf<S>> {
    let mut start = State {
        q: system.zeros(),
        p: system.zeros(),
        t: 0.0,
    };
    for k in 0..start.q.len() {
        *start.q.component_mut(k) = (k as f64).sin();
        *start.p.component_mut(k) = (k as f64 + 0.5).cos();
    }
    start
}

/// The bits of a state.
fn bits<V: Vector<Scalar = f64>>(state: &State<V>) -> Vec<u64> {
    let all = state.q.components().chain(state.p.components());
    all.map(f64::to_bits).collect()
}

/// The ends of runs on 1, 2, 3 and 7 threads have the same bits.
fn check<S, M>(system: &S, scheme: M)
where
    S: System,
    M: Scheme<S, Map<f64>: Sync>,
    <M::Map<f64> as hamiltonian::schemes::author::Map>::Work: Send,
{
    let _level = LEVEL.read().unwrap_or_else(PoisonError::into_inner);
    for fused in [false, true] {
        let end = |threads| {
            let run = Integrator::new(system, scheme.clone(), start(system), 0.01).unwrap();
            let mut run = if fused { run.fused() } else { run }.with_threads(threads);
            bits(run.advance(3).unwrap())
        };
        let one = end(1);
        assert_ne!(one, bits(&start(system)));
        for threads in [0, 2, 3, 7] {
            assert!(one == end(threads), "{threads} threads, fused: {fused}");
        }
    }
}

#[test]
fn chains_have_the_bits_of_one_thread() {
    // Below two slabs, at two, and tails of slabs and of packs.
    for n in [40, 16_383, 16_384, 16_387, 24_577, 70_001] {
        check(&Chain::new(n).unwrap(), StormerVerlet::default());
        check(&Far::new(n).unwrap(), StormerVerlet::default());
    }
    check(&Chain::new(33_333).unwrap(), Gauss::<4>::default());
}

#[test]
fn lattices_have_the_bits_of_one_thread() {
    for (n, m) in [
        (1, 20_000),
        (2, 9_001),
        (3, 31_003),
        (129, 131),
        (257, 64),
        (6_001, 5),
    ] {
        check(
            &Field::new(n, m, vec![0.5; m]).unwrap(),
            StormerVerlet::default(),
        );
        check(&Angles::new(n, m).unwrap(), StormerVerlet::default());
        check(
            &Two::new(n, m, m / 2 + 1).unwrap(),
            StormerVerlet::default(),
        );
    }
}

#[test]
fn pairs_have_the_bits_of_one_thread() {
    // Around the least number of rows that has tiles, with a last tile that is whole and one that is not.
    for n in [4095, 4096, 4097, 5000] {
        let masses: Vec<f64> = (0..n).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
        check(&Bodies::new(n, masses).unwrap(), StormerVerlet::default());
    }
    check(&Rotors::new(4099).unwrap(), StormerVerlet::default());
    let masses = vec![0.5; 4098];
    let system = Bodies::new(4098, masses).unwrap();
    let end = |threads| {
        let run = Integrator::new(&system, Gauss::<2>::default(), start(&system), 0.01).unwrap();
        let mut run = run.with_threads(threads);
        bits(run.advance(1).unwrap())
    };
    assert!(end(1) == end(2), "an implicit scheme");
}

#[test]
fn a_member_has_the_tiles_of_its_run() {
    let system = Rotors::new(4097).unwrap();
    let new = || Integrator::new(&system, StormerVerlet::default(), start(&system), 0.01).unwrap();
    let mut run = new().with_threads(2);
    run.advance(1).unwrap();
    let each = |_: Member| (system.clone(), start(&system));
    let mut members = Ensemble::new(2, each, StormerVerlet::default(), 0.01)
        .unwrap()
        .reproducible();
    members.advance(1);
    for state in members.states() {
        assert_eq!(state.unwrap(), *run.state());
    }
    let mut alone = new().with_lanes(false);
    assert_eq!(alone.advance(1).unwrap(), run.state());
}

#[test]
fn members_and_saved_runs_have_the_bits_of_threads() {
    let system = Field::new(128, 129, vec![0.5; 129]).unwrap();
    let new = || Integrator::new(&system, StormerVerlet::default(), start(&system), 0.01).unwrap();
    let mut run = new().with_threads(2);
    run.advance(4).unwrap();
    let each = |_: Member| (system.clone(), start(&system));
    let mut members = Ensemble::new(2, each, StormerVerlet::default(), 0.01)
        .unwrap()
        .reproducible()
        .with_threads(2);
    members.advance(4);
    for state in members.states() {
        assert_eq!(state.unwrap(), *run.state());
    }
    let saved = Checkpoint::from_bytes(&run.checkpoint().to_bytes()).unwrap();
    let mut again: Run<Field, StormerVerlet> =
        Integrator::resume(&system, StormerVerlet::default(), saved).unwrap();
    assert_eq!(again.advance(2).unwrap(), run.advance(2).unwrap());
    // A copy has the threads of the first, and so has a run with an observer.
    let mut copy = run.clone().observe(EnergyDrift::new());
    assert_eq!(copy.advance(2).unwrap(), run.advance(2).unwrap());
}

/// The threads that have computed a force, and the number of allocations of each until it did so last.
static SEEN: Mutex<[Option<(ThreadId, u64)>; 4]> = Mutex::new([None; 4]);

/// r, and a note of the thread.
fn seen<T: Real>(r: T) -> T {
    let now = current().id();
    let mut seen = SEEN.lock().unwrap();
    let mut slots = seen.iter_mut();
    let own = slots.find(|slot| slot.is_none_or(|(thread, _)| thread == now));
    *own.expect("a run has two threads") = Some((now, calls()));
    r
}

/// The threads that have computed a force since this was asked last, with the numbers of allocations.
fn take() -> Vec<(ThreadId, u64)> {
    let taken = std::mem::take(&mut *SEEN.lock().unwrap());
    let mut taken: Vec<_> = taken.into_iter().flatten().collect();
    taken.sort_by_key(|(thread, _)| format!("{thread:?}"));
    taken
}

hamiltonian! {
    /// A field whose forces note their threads.
    pub struct Seen { n: usize, m: usize }
    fn V(r) = seen;
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { p[i][j]^2/2 + V(u[i][j])
        + (u[(i + 1) % n][j] - u[i][j])^2/2 }
}

hamiltonian! {
    /// Pairs whose rows note their threads.
    pub struct SeenPairs { n: usize }
    fn V(r) = seen;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + V(q[i]) }
        + sum(i in 0..n, j in 0..i) { (q[i] - q[j])^2/n }
}

#[test]
fn steps_on_threads_are_made_on_both_and_do_not_allocate() {
    on_both(&Seen::new(64, 256).unwrap());
    on_both(&SeenPairs::new(4096).unwrap());
}

fn on_both<S>(system: &S)
where
    S: System + Clone,
    StormerVerlet: Scheme<S, Map<f64>: Sync>,
    <<StormerVerlet as Scheme<S>>::Map<f64> as hamiltonian::schemes::author::Map>::Work: Send,
{
    let mut run = Integrator::new(system, StormerVerlet::default(), start(system), 0.01).unwrap();
    take();
    run.advance(1).unwrap();
    let one: Vec<ThreadId> = take().into_iter().map(|(thread, _)| thread).collect();
    assert_eq!(one, [current().id()]);
    let mut run = run.with_threads(2);
    // The caller evaluates H at the end of a block, and makes no step. The second thread takes rows when the machine
    // lets it run.
    let both = |run: &mut Run<S, StormerVerlet>| {
        take();
        let is_other = |(thread, _): &(ThreadId, u64)| *thread != current().id();
        let count = || {
            SEEN.lock()
                .unwrap()
                .iter()
                .flatten()
                .filter(|seen| is_other(seen))
                .count()
        };
        while count() < 2 {
            run.advance(1).unwrap();
            assert!(run.steps() < 100_000, "one thread computes all");
        }
        take().into_iter().filter(is_other).collect::<Vec<_>>()
    };
    let before = both(&mut run);
    let count = allocations(|| {
        run.advance(20).unwrap();
    });
    assert_eq!(count, 0);
    let after = both(&mut run);
    assert_eq!(before.len(), 2);
    assert_eq!(before, after);
}
