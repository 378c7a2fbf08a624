//! Ensembles and sweeps: every member is what a single run of it is.

mod allocations;
mod changes;
mod domain;
mod events;
mod exponents;
mod gathering;
mod kinds;
mod layouts;
mod members;
mod observers;
mod panics;
mod stores;
mod sweeps;
mod switched;
mod tables;
mod times;

use hamiltonian::Status;
use hamiltonian::lanes::Cpu;
use hamiltonian::prelude::*;
use std::sync::{PoisonError, RwLock};

hamiltonian! {
    /// A pendulum whose weight sways.
    pub struct Pendulum { l = 1.0, g = 1.0, a = 0.2 }
    H(q; p; t) = p^2/(2*l^2) - g*l*(1 + a*cos(3*t))*cos(q);
    monitor angular = p;
    event bottom = q
}

hamiltonian! {
    /// Hénon–Heiles.
    pub struct HenonHeiles { e = 1.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + e*(x^2*y - y^3/3)
}

hamiltonian! {
    /// Not separable, with exact flows.
    pub struct Mixture { a = 0.5 }
    H(q; p) = a*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// A chain whose length is set at run time.
    pub struct Chain { n: usize, m = 1.0 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m) + exp(q[i] - q[(i + 1) % n]) }
}

hamiltonian! {
    /// A particle in a hole, where its potential ends.
    pub struct Hole { k = 1.0 }
    H(q; p) = p^2/2 + k*sqrt(q)
}

hamiltonian! {
    /// A particle above a floor of one of several kinds, below which H is not defined or overflows.
    pub struct Floor { kind = 0.0, g = 0.1, k = 0.01, big = 1e308 }
    H(x; p) = p^2/2 + g*x
        + if kind < 1 { -k*ln(x) } else if kind < 2 { k*sqrt(x)^2 } else if kind < 3 { k*x^2.5 }
        else if kind < 4 { k*asin(1 - x/8) } else if kind < 5 { k*atanh(1 - x/8) }
        else { big*if x < 0 { 4 } else { 0.25 } }
}

/// More than a pack of the widest level, and no multiple of one.
const COUNT: usize = 203;

fn part(index: usize) -> f64 {
    (index as f64 + 0.5) / COUNT as f64
}

fn pendulum(member: Member) -> (Pendulum, StateOf<Pendulum>) {
    let at = part(member.index);
    let system = Pendulum {
        l: 1.0 + 0.3 * at,
        ..Default::default()
    };
    (system, State::new([2.0 * at - 1.0], [0.4 - at]).at(at))
}

fn henon_heiles(member: Member) -> (HenonHeiles, StateOf<HenonHeiles>) {
    let at = part(member.index);
    let system = HenonHeiles { e: 1.0 - 0.2 * at };
    (system, State::new([0.2 * at, 0.1], [0.1, 0.3 * at]))
}

fn mixture(member: Member) -> (Mixture, StateOf<Mixture>) {
    let at = part(member.index);
    (Mixture::default(), State::new([at], [0.5 - at]))
}

fn chain(member: Member) -> (Chain, StateOf<Chain>) {
    let at = part(member.index);
    let chain = Chain::new(5).expect("five sites");
    (
        chain,
        State::new(vec![at, 0.0, -at, 0.1, 0.2], vec![0.0, 0.3, at, 0.0, -0.1]),
    )
}

/// Every seventh falls into the hole; one starts outside of it, one cannot be made.
fn holes(member: Member) -> Result<(Hole, StateOf<Hole>), Error> {
    let q = match member.index {
        11 => -1.0,
        13 => return Err(Error::other("it cannot be made")),
        index if index % 7 == 0 => 0.5 + 0.1 * part(index),
        _ => 100.0,
    };
    Ok((Hole::default(), State::new([q], [0.0])))
}

/// A path for a store, where there is none.
fn place(name: &str) -> std::path::PathBuf {
    let name = format!("hamiltonian-{name}-{}.zarr", std::process::id());
    let path = std::env::temp_dir().join(name);
    let _ = std::fs::remove_dir_all(&path);
    path
}

/// All files of a directory, with their bytes.
fn files(root: &std::path::Path) -> std::collections::BTreeMap<std::path::PathBuf, Vec<u8>> {
    let mut all = std::collections::BTreeMap::new();
    let mut left = vec![root.to_owned()];
    while let Some(directory) = left.pop() {
        for entry in std::fs::read_dir(directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                left.push(path);
            } else {
                let name = path.strip_prefix(root).expect("inside").to_owned();
                all.insert(name, std::fs::read(path).expect("a file"));
            }
        }
    }
    all
}

/// The bits of a state.
fn bits<V: Vector<Scalar = f64>>(state: &State<V>) -> Vec<u64> {
    let numbers = state.q.components().chain(state.p.components());
    core::iter::once(state.t)
        .chain(numbers)
        .map(f64::to_bits)
        .collect()
}

/// Held to write while levels are hidden from this process, and to read by each test whose bits or whose
/// stores depend on the level.
static LEVEL: RwLock<()> = RwLock::new(());

/// Keeps the level of this process as it is.
fn one_level() -> std::sync::RwLockReadGuard<'static, ()> {
    LEVEL.read().unwrap_or_else(PoisonError::into_inner)
}

/// Sizes of chunks for the layouts of a level: one that is not a multiple of its lanes, and at the least level the smallest
/// and one for all members as well, since what divides members among threads does not depend on lanes.
fn chunks(cpu: Cpu) -> &'static [usize] {
    if cpu > Cpu::Sse2 { &[7] } else { &[7, 1, 4096] }
}

/// Runs a test on each level of this CPU that has code of its own: on x86-64 the least is SSE2.
fn at_each_level(test: impl Fn(Cpu)) {
    let _alone = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
    let is_reached = |cpu: &Cpu| *cpu != Cpu::Portable || !cfg!(target_arch = "x86_64");
    for cpu in Cpu::available().filter(is_reached) {
        Cpu::limit_to(cpu);
        test(cpu);
    }
    Cpu::limit_to(Cpu::Avx512);
}

/// Each row of a sweep, by bits.
fn rows<M: Scheme<Pendulum>, O: Observer<f64, Pendulum>, A: hamiltonian::Rounding>(
    sweep: &Sweep<'_, Pendulum, M, O, hamiltonian::Record<'_, Pendulum, O>, A>,
) -> Vec<(usize, Status, u64, Vec<u64>)> {
    let add = |mut all: Vec<_>, row: &hamiltonian::Row<'_>| {
        let values = row.values.iter().map(|value| value.to_bits()).collect();
        all.push((row.index, row.status, row.steps, values));
        all
    };
    sweep.fold(vec![], add).expect("there are members")
}
