//! A sweep over a million starts of a forced pendulum, stored as Zarr.
//!
//! Processes with `HAMILTONIAN_SHARD=k/n`, tasks of Slurm, MPI or HyperQueue each compute a part; without
//! them one process computes all. Ctrl-C stops it; a process that was stopped or killed is started again as it
//! was. `-- N` computes N members. When the store is complete, `target/sweep/ends.svg` shows the momenta at the end
//! against the starts.

use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Members of the picture, at most.
const DRAWN: usize = 8000;

hamiltonian! {
    /// A pendulum whose support moves.
    pub struct Forced { a = 0.6 }
    H(theta; p; t) = p^2/2 - (1 + a*cos(1.7*t))*cos(theta)
}

/// A start of so many: at rest, at an angle between −3 and 3.
fn start(index: usize, members: usize) -> (Forced, StateOf<Forced>) {
    let at = index as f64 / members as f64;
    let theta = 3.0 * (2.0 * at - 1.0);
    (Forced::default(), State::new([theta], [0.0]))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))?;

    let members = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let members: usize = members.unwrap_or(1_000_000);
    let sweep = Sweep::new(
        members,
        |member| start(member.index, members),
        BlanesMoan4,
        0.05,
    )
    .with_end(100.0)
    .with_shard(Shard::from_env()?)
    .with_cancel(&stop)
    .with_progress(|done, of| eprint!("\r{done} of {of} members"))
    .record(["theta", "p"], |end| [end.state.q[0], end.state.p[0]]);
    let stored = sweep.store("target/sweep.zarr")?;
    eprintln!();
    match stored.missing.len() {
        0 => println!("target/sweep.zarr is complete"),
        ranges => println!("other shards have {ranges} ranges of chunks to do"),
    }
    if stored.is_complete() {
        draw(members.min(DRAWN))?;
    }
    Ok(())
}

/// Draws fewer members, evenly spaced, without a store.
fn draw(members: usize) -> Result<(), Error> {
    let sweep = Sweep::new(
        members,
        |member| start(member.index, members),
        BlanesMoan4,
        0.05,
    )
    .with_end(100.0)
    .record(["theta", "p"], |end| [end.state.q[0], end.state.p[0]]);
    let points = sweep.fold(Vec::new(), |mut points, row| {
        let (_, begin) = start(row.index, members);
        points.push((begin.q[0], row.values[1]));
        points
    })?;
    Figure {
        title: "A forced pendulum, let go at rest: momentum at t = 100".into(),
        x: "θ at t = 0".into(),
        y: "p at t = 100".into(),
        dots: true,
        curves: vec![Curve {
            name: String::new(),
            points,
        }],
        ..Default::default()
    }
    .write("target/sweep/ends.svg")
}
