"""Kernels written ahead: the same numbers as numba's to the last bit, and nothing is taken that does not fit."""

import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import furiko
from furiko.models import NLegPendulum, RodChain
from furiko.reference.kernels import forward_dynamics
from furiko.reference.kernels.ahead import load
from furiko.reference.kernels.ahead.kernels import KERNELS, place, source_stamp

pytest.importorskip("llvmlite")
SYSTEMS = RodChain((1.0, 0.8, 0.6)), RodChain((1.0, 9.0, 0.3)), NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))
here = pytest.mark.skipif(not load.is_ahead("start"), reason="written for another system, or a newer LLVM")


def states(shape, seed=20261128):
    rng = np.random.default_rng(seed)
    return rng.uniform(-3, 3, shape), rng.uniform(-4, 4, shape)


@pytest.mark.parametrize("name", KERNELS)
def test_each_is_written_for_its_present_text(name):
    """If not: ``make kernels``."""
    assert load.text(name).split()[1] == source_stamp()


@here
def test_each_is_taken_where_it_was_written():
    assert all(load.is_ahead(name) for name in KERNELS)


def answers(system):
    """All that compiled code computes, each kernel once."""
    theta, omega = states((37, 3))
    times = np.linspace(0.0, 1.0, 4)
    kernel = forward_dynamics.Kernel(system)
    yield kernel(theta[0], omega[0])
    yield kernel(theta[:, 1][:3], omega[::2, 2][:3])  # of any stride
    yield kernel.batch(theta, omega)
    for start in (theta[0], omega[0]), (theta, omega):
        motion = furiko.simulate(system, *start, times)
        yield from (motion.theta, motion.omega, motion.steps, motion.error)
    yield furiko.lyapunov(system, theta[:9], omega[:9], times, count=2).exponents
    yield furiko.flip_times(system, theta, omega, 5.0).times


def all_answers():
    """Of each system, in a row."""
    return np.concatenate([np.ravel(each) for system in SYSTEMS for each in answers(system)])


BY_NUMBA = """
import sys
import numpy as np
sys.path.insert(0, sys.argv[1])
import test_ahead
test_ahead.load.is_ahead = lambda name: False
np.save(sys.argv[2], test_ahead.all_answers())
"""


@here
@pytest.mark.slow
@pytest.mark.sweep
def test_the_numbers_are_numbas_to_the_last_bit(tmp_path):
    """Numba's of a second process: one that compiles several kernels shares functions among them, rounded otherwise."""
    pytest.importorskip("numba")
    command = [sys.executable, "-c", BY_NUMBA, str(Path(__file__).parent), str(tmp_path / "found.npy")]
    for _ in range(2):
        subprocess.run(command, check=True, env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)})
    np.testing.assert_array_equal(all_answers(), np.load(tmp_path / "found.npy"))
    assert set(KERNELS) <= set(load._loaded)


@here
def test_what_does_not_fit_is_refused():
    run = load.kernel("rods_batch")
    theta, omega = states((4, 2))
    row = np.ones(2)
    good = [theta, omega, np.empty((4, 2)), row, row, 9.81]
    assert run(*good) == 0
    wrongs = [
        (0, theta.astype(np.float32)),
        (0, theta.astype(np.int64)),
        (0, theta.T),
        (0, theta[0]),
        (0, theta.tolist()),
        (0, None),
        (0, theta.astype(">f8")),
        (0, theta.view(type("Own", (np.ndarray,), {}))),
        (2, np.empty((8, 2))[::2]),
        (5, "9.81"),
    ]
    for at, wrong in wrongs:
        with pytest.raises(TypeError):
            run(*good[:at], wrong, *good[at + 1 :])
    for count in (0, 5):
        with pytest.raises(TypeError):
            run(*good[:count])


@here
def test_memory_that_is_not_there_is_told():
    run = load.kernel("run_rods")
    row, table, counts = np.ones(2), np.zeros((2, 6)), np.zeros(2, np.int64)
    with pytest.raises(MemoryError):
        run(row, row, 9.81, row, 2**40, 1e-16, table, np.zeros(2), counts, np.empty((2, 2)), np.empty((2, 2)), 1)


@here
def test_nothing_is_kept_of_a_call():
    run = load.kernel("rods_batch")
    theta, omega = states((4, 2))
    given = [theta, omega, np.empty((4, 2)), np.ones(2), np.ones(2), 9.81]
    before = [sys.getrefcount(each) for each in given]
    for _ in range(1000):
        run(*given)
    assert [sys.getrefcount(each) for each in given] == before


@here
def test_arrays_that_were_pickled_are_arrays():
    """Their type is another object than numpy's own, and equal to it."""
    theta, omega = (pickle.loads(pickle.dumps(each)) for each in states((4, 3)))
    kernel = forward_dynamics.Kernel(SYSTEMS[0])
    np.testing.assert_array_equal(kernel.batch(theta, omega), kernel.batch(theta.copy(), omega.copy()))


@here
def test_neither_numba_is_needed_nor_is_it_imported():
    script = (
        "import sys; sys.modules['numba'] = None\n"
        "import numpy as np, furiko\n"
        "system = furiko.RodChain([1.0, 0.8])\n"
        "furiko.simulate(system, [1.0, 2.0], [0.0, 0.0], [0.0, 1.0])\n"
        "furiko.accelerations(system, np.ones((4000, 2)), np.ones((4000, 2)))\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


@pytest.mark.parametrize("other", ["0" * 64 + " {1} {2}", "{0} riscv64-unknown-linux-gnu {2}", "{0} {1} 15"])
def test_other_text_systems_and_older_llvm_leave_it_to_numba(other, monkeypatch):
    words = load.first_line().split()[1:]
    monkeypatch.setattr(load, "first_line", lambda: f"; {other.format(*words)}")
    assert not load.is_ahead.__wrapped__("run_rods")


def test_where_arrays_lie_otherwise_it_is_left_to_numba(monkeypatch):
    monkeypatch.setattr(load, "arrays_are_as_read", lambda: False)
    assert not load.is_ahead.__wrapped__("run_rods")


def test_where_a_file_is_missing_it_is_left_to_numba(monkeypatch, tmp_path):
    monkeypatch.setattr(load, "place", lambda name: tmp_path / place(name).name)
    assert not load.is_ahead.__wrapped__("run_rods")
