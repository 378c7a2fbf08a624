#!/usr/bin/env python3
"""One sweep by one process, by two workers of HyperQueue and by two processes of MPI: equal stores.

Input: `examples/sweep.rs`, built for speed. Output: a line for each engine; the exit status says whether a
store differs from that of one process in any bit. What is not installed (PyPI: hyperqueue; mpirun) is
skipped, aloud.
"""

import filecmp
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

MEMBERS = "20000"
TASKS = 4


def files(store):
    """The files of a store, by their places in it."""
    return {path.relative_to(store): path for path in store.rglob("*") if path.is_file()}


def compare(engine, alone, folder):
    """Ends this script where two stores differ."""
    one, other = (files(folder / "target" / "sweep.zarr") for folder in (alone, folder))
    if one.keys() != other.keys():
        sys.exit(f"{engine}: other files than those of one process: {one.keys() ^ other.keys()}")
    for place, path in one.items():
        if not filecmp.cmp(path, other[place], shallow=False):
            sys.exit(f"{engine}: {place} differs from that of one process")
    print(f"{engine}: the store of one process, {len(one)} files")


def hyperqueue(program, folder):
    """A job of some tasks on two workers of one core."""
    from hyperqueue import Job, LocalCluster
    from hyperqueue.cluster import WorkerConfig

    server = folder / "server"
    server.mkdir()
    with LocalCluster(server_dir=str(server), worker_config=WorkerConfig(cores=1)) as cluster:
        cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        job = Job()
        for _ in range(TASKS):
            # Each finds its number in HQ_TASK_ID.
            job.program([program, MEMBERS], cwd=folder, env={"HAMILTONIAN_SHARDS": str(TASKS)})
        client.wait_for_jobs([client.submit(job)])


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    build = ["cargo", "build", "--release", "--quiet", "--example", "sweep"]
    subprocess.run(build, cwd=root, check=True)
    program = str(root / "target" / "release" / "examples" / "sweep")
    with tempfile.TemporaryDirectory() as work:
        alone, hq, mpi = (pathlib.Path(work) / name for name in ("alone", "hq", "mpi"))
        for folder in (alone, hq, mpi):
            folder.mkdir()
        quiet = {"stderr": subprocess.DEVNULL, "check": True}
        subprocess.run([program, MEMBERS], cwd=alone, **quiet)

        try:
            import hyperqueue as _
        except ImportError:
            print("skipped: HyperQueue is not installed (PyPI: hyperqueue)")
        else:
            hyperqueue(program, hq)
            compare("HyperQueue", alone, hq)

        if shutil.which("mpirun"):
            # Open MPI asks twice whether root may, and whether two processes may share a core (4, 5).
            allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
            allowed |= {"OMPI_MCA_rmaps_base_oversubscribe": "1"}
            allowed |= {"PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
            command = ["mpirun", "-n", "2", program, MEMBERS]
            subprocess.run(command, cwd=mpi, env=os.environ | allowed, **quiet)
            compare("mpirun", alone, mpi)
        else:
            print("skipped: mpirun is not installed")


main()
