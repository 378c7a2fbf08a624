//! A sweep over a million starts of a forced pendulum, stored as Zarr.
//!
//! Processes with `HAMILTONIAN_SHARD=k/n`, tasks of Slurm, MPI or HyperQueue each compute a part; without
//! them one process computes all. Ctrl-C stops it; a process that was stopped or killed is started again as it
//! was. `-- N` computes N members.

use hamiltonian::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

hamiltonian! {
    /// A pendulum whose support moves.
    pub struct Forced { a = 0.6 }
    H(theta; p; t) = p^2/2 - (1 + a*cos(1.7*t))*cos(theta)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))?;

    let members = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let members: usize = members.unwrap_or(1_000_000);
    let start = move |member: Member| {
        let at = member.index as f64 / members as f64;
        (
            Forced::default(),
            State::new([3.0 * (2.0 * at - 1.0)], [0.0]),
        )
    };
    let sweep = Sweep::new(members, start, BlanesMoan4, 0.05)
        .until(100.0)
        .shard(Shard::from_env()?)
        .cancel(&stop)
        .progress(|done, of| eprint!("\r{done} of {of} members"))
        .record(["theta", "p"], |end| [end.state.q[0], end.state.p[0]]);
    let stored = sweep.store("target/sweep.zarr")?;
    eprintln!();
    match stored.missing.len() {
        0 => println!("target/sweep.zarr is complete"),
        ranges => println!("other shards have {ranges} ranges of chunks to do"),
    }
    Ok(())
}
