"""Ctrl-C and threads: what is done is kept, and other threads run."""

import multiprocessing
import os
import signal
import threading
import time

import hamiltonian as hm
import numpy as np
import pytest

SPRING = hm.define("H(x; p) = p^2/2 + x^2/2")
pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")


@pytest.fixture
def ctrl_c():
    """Sends Ctrl-C to this process in 0.3 s."""
    # A script that runs in the background (`.ci/run &`) hands down that Ctrl-C is ignored, and Python leaves it so.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    yield
    timer.join()
    signal.signal(signal.SIGINT, before)


def test_ensembles_keep_what_is_done(ctrl_c):
    swarm = SPRING.ensemble(np.linspace(0.1, 1, 1000)[:, None], 0.0)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        swarm.advance(10**12, step=0.01)
    assert time.monotonic() - start < 5 and swarm.t > 0
    state = swarm.state
    assert len(set(state.t.tolist())) == 1 and state.t[0] == swarm.t
    steps = round(swarm.t / 0.01)
    again = SPRING.ensemble(np.linspace(0.1, 1, 1000)[:, None], 0.0)
    assert np.array_equal(again.advance(steps, step=0.01).q, state.q)
    swarm.advance(10)


def test_runs_keep_what_is_done(ctrl_c):
    run = SPRING.run(1.0, 0.0, scheme="StormerVerlet", step=0.01)
    with pytest.raises(KeyboardInterrupt):
        run.advance(10**12)
    assert run.steps > 0 and abs(run.energy - 0.5) < 1e-4
    run.advance(10)


def test_solutions_keep_what_is_done(ctrl_c):
    with pytest.raises(KeyboardInterrupt) as raised:
        SPRING.solve(1.0, 0.0, np.arange(10**5) * 1.0, scheme="StormerVerlet", step=0.0001)
    assert 0 < len(raised.value.solution) < 10**5


def test_indicators_stop(ctrl_c):
    swarm = SPRING.ensemble(np.linspace(0.1, 1, 100)[:, None], 0.0)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        swarm.lyapunov(1e7, step=0.01)
    assert time.monotonic() - start < 5


def test_sweeps_continue_after_ctrl_c(ctrl_c, tmp_path):
    swarm = SPRING.ensemble(np.linspace(0.1, 1, 2000)[:, None], 0.0)
    path = tmp_path / "springs.zarr"
    with pytest.raises(KeyboardInterrupt):
        swarm.sweep(path, t=1e7, record=["x"], step=0.01)
    assert (path / "zarr.json").exists() and swarm.t == 0


def test_an_ignored_ctrl_c_is_ignored():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        swarm = SPRING.ensemble([[0.5]], 0.0)
        # As many steps as take several blocks, between which the interpreter is asked.
        swarm.advance(10**5, step=0.01)
        os.kill(os.getpid(), signal.SIGINT)
        assert swarm.advance(10**5).t[0] == pytest.approx(2000)
    finally:
        signal.signal(signal.SIGINT, before)


def test_other_threads_run():
    run = SPRING.run(1.0, 0.0, scheme="StormerVerlet", step=0.01)
    thread = threading.Thread(target=run.advance, args=(30_000_000,))
    thread.start()
    ticks = 0
    while thread.is_alive():
        time.sleep(0.001)
        ticks += 1
    thread.join()
    assert ticks >= 10 and run.steps == 30_000_000


def advanced(run):
    """The run after some steps, in another process."""
    run.advance(10)
    return run


def test_runs_go_to_other_processes():
    run = SPRING.run(1.0, 0.0, scheme="Gauss4", step=0.1)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        (other,) = pool.map(advanced, [run])
    run.advance(10)
    assert other.steps == 10 and np.array_equal(other.q, run.q)


def test_a_run_in_use_is_refused():
    run = SPRING.run(1.0, 0.0, scheme="StormerVerlet", step=0.01)
    thread = threading.Thread(target=run.advance, args=(30_000_000,))
    thread.start()
    time.sleep(0.01)
    with pytest.raises(RuntimeError, match="another thread advances this run"):
        run.advance(1)
    thread.join()
    assert run.steps == 30_000_000
