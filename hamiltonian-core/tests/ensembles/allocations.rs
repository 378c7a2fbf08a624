//! Ensembles and sweeps hold little memory: bytes are counted over all threads of a process.

use super::*;
use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::env;
use std::process::Command;
use std::sync::atomic::{AtomicIsize, Ordering::SeqCst};

/// The allocator of this process, which counts the bytes that it holds.
struct Counting;

/// The bytes that are allocated and not freed, and the most there have been.
static NOW: AtomicIsize = AtomicIsize::new(0);
static MOST: AtomicIsize = AtomicIsize::new(0);

fn count(bytes: isize) {
    let now = NOW.fetch_add(bytes, SeqCst) + bytes;
    MOST.fetch_max(now, SeqCst);
}

// SAFETY: all is passed on to the allocator of the system.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { Heap.alloc(layout) }
    }
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        unsafe { Heap.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// The bytes that are still held after some work, and the most that were held on the way.
fn bytes<A>(work: impl FnOnce() -> A) -> (A, [isize; 2]) {
    let before = NOW.load(SeqCst);
    MOST.store(before, SeqCst);
    let made = work();
    (made, [&NOW, &MOST].map(|bytes| bytes.load(SeqCst) - before))
}

/// Returns true in a process that makes this test alone. In others it starts such a process: other tests allocate, too.
fn alone(name: &str) -> bool {
    const ALONE: &str = "HAMILTONIAN_TEST_ALONE";
    if env::var_os(ALONE).is_some() {
        return true;
    }
    let mut process = Command::new(env::current_exe().expect("this program"));
    let process = process.args(["--exact", name, "--test-threads=1"]);
    let output = process.env(ALONE, "1").output().expect("a process");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("1 passed"), "{said}");
    false
}

/// Members enough for several chunks.
const MANY: usize = 8 * 1024;

/// One pendulum for all, or one for each.
fn many(each: bool) -> impl Fn(Member) -> (Pendulum, StateOf<Pendulum>) {
    move |member| {
        let at = (member.index as f64 / MANY as f64).fract();
        let l = if each { 1.0 + at } else { 1.0 };
        (
            Pendulum {
                l,
                ..Default::default()
            },
            State::new([at], [0.1]),
        )
    }
}

#[test]
fn an_ensemble_holds_what_members_carry() {
    if !alone("allocations::an_ensemble_holds_what_members_carry") {
        return;
    }
    let swarm = |count, each| {
        Ensemble::new(count, many(each), StormerVerlet::default(), 0.01)
            .expect("there are members")
            .with_threads(1)
    };
    // The bytes that a member adds.
    let adds = |held: &dyn Fn(usize) -> isize| {
        // A thread's own allocations, when it first waits or prints, are not a member's.
        held(MANY);
        let more = held(2 * MANY) - held(MANY);
        more as f64 / MANY as f64
    };
    // q and p, and chunks themselves.
    let plain = adds(&|count| bytes(|| swarm(count, false)).1[0]);
    assert!((16.0..18.0).contains(&plain), "{plain} bytes a member");
    let parameters = size_of::<<Pendulum as System>::Prepared<f64>>() as f64;
    let each = adds(&|count| bytes(|| swarm(count, true)).1[0]);
    assert!(
        (each - plain - parameters).abs() < 2.0,
        "{each} bytes a member"
    );
    let drift = size_of::<EnergyDrift>() as f64;
    let observed = adds(&|count| {
        let held = bytes(|| swarm(count, false).observe(|_| EnergyDrift::new()));
        held.1[0]
    });
    assert!(
        (observed - plain - drift).abs() < 2.0,
        "{observed} bytes a member"
    );
    // Steps need the memory of a pack, whatever the number of members.
    let steps = |count| {
        let mut swarm = swarm(count, false).observe(|_| EnergyDrift::new());
        swarm.advance(3);
        bytes(|| {
            swarm.advance(100);
        })
        .1
    };
    let [after, most] = steps(MANY);
    assert_eq!(after, 0);
    assert!(most < 70_000, "{most} bytes for steps");
    let [_, of_more] = steps(4 * MANY);
    assert!(
        (of_more - most).abs() < 1_000,
        "{most} bytes, and {of_more} for more members"
    );
}

#[test]
fn a_sweep_holds_its_chunks_in_work() {
    if !alone("allocations::a_sweep_holds_its_chunks_in_work") {
        return;
    }
    let most = |count| {
        let sweep = Sweep::new(count, many(true), StormerVerlet::default(), 0.01)
            .with_steps(5)
            .with_chunk(256)
            .with_threads(1)
            .observe(|_| EnergyDrift::new())
            .record(["q"], |end| [end.state.q[0]]);
        let sum = |sum: f64, row: &hamiltonian::Row<'_>| sum + row.values[0];
        bytes(|| sweep.fold(0.0, sum).expect("there are members")).1[1]
    };
    let few = most(MANY);
    assert!(few < 165_000, "{few} bytes");
    let many = most(8 * MANY);
    assert!(
        (many - few).abs() < 20_000,
        "{few} bytes, and {many} for more members"
    );
}
