"""The O(n) kernels against the documents' equations solved in ball arithmetic, which shares no step with them."""

import contextlib
import math
import os
import platform
import subprocess
import sys

import flint
import numpy as np
import pytest
from flint import arb, arb_mat
from hypothesis import example, given, settings
from hypothesis import strategies as st

from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.reference.kernels import forward_dynamics as kernels

# Issue target. Rounding alone: about ten operations a rod, each 1.1e-16, mostly damped from rod to rod.
ALLOWED = 1e-14


@pytest.fixture(autouse=True)
def _restore_precision():
    before = flint.ctx.prec
    yield
    flint.ctx.prec = before


def solved_rods(system, theta, omega):
    """Takeno (22) as printed with L corrected, or for long chains the forces T_j of (3), (6) as unknowns."""
    solve = dense_rods if system.n <= 40 else forces_of_rods
    bits = [300]
    while bits[-1] < 300 + 16 * system.n:  # what the longest chains take where two rods are nearly straight
        bits.append(2 * bits[-1])
    for flint.ctx.prec in bits:
        with contextlib.suppress(ZeroDivisionError):  # too few bits to tell a pivot from none
            found = solve(system, theta, omega)
            if all(float(x.rad()) <= 1e-30 * abs(float(x.mid())) for x in found):
                break
    return found  # with a radius, where one of them nearly vanishes


def dense_rods(system, theta, omega):
    n = system.n
    l, t, w = ([arb(float(x)) for x in v] for v in (system.lengths, theta, omega))
    g = arb(system.gravity)
    below = [l[j] / 2 + sum(l[j + 1 :], arb(0)) for j in range(n)]
    alpha = [[below[max(j, k)] - (l[j] / 6 if j == k else 0) for k in range(n)] for j in range(n)]
    matrix = arb_mat([[l[k] * alpha[j][k] * (t[j] - t[k]).cos() for k in range(n)] for j in range(n)])
    right = arb_mat(
        [
            [-sum((l[k] * alpha[j][k] * (t[j] - t[k]).sin() * w[k] ** 2 for k in range(n)), g * below[j] * t[j].sin())]
            for j in range(n)
        ]
    )
    return matrix.solve(right).entries()


def forces_of_rods(system, theta, omega):
    """The joint forces from "rod k's lower end moves as rod k+1's upper end", block by block."""
    n = system.n
    m = [arb(float(x)) for x in system.lengths]  # at density 1
    t = [arb(float(x)) for x in theta]
    w = [l * arb(float(x)) ** 2 for l, x in zip(m, omega, strict=True)]
    p = [arb_mat([[x.sin()], [-x.cos()]]) for x in t]
    q = [arb_mat([[x.cos()], [x.sin()]]) for x in t]
    one = arb_mat([[1, 0], [0, 1]])
    same = [(one + 3 * (q[k] * q[k].transpose())) * (1 / m[k]) for k in range(n)]
    other = [(3 * (q[k] * q[k].transpose()) - one) * (1 / m[k]) for k in range(n)]
    half = [p[k] * (w[k] / 2) for k in range(n)]
    # row 0: upper end of rod 1 moves with gravity; row k: lower end of rod k less upper end of rod k+1
    zero = arb_mat([[0], [0]])
    right = [half[0] - arb_mat([[0], [system.gravity]])] + [half[k - 1] + half[k] for k in range(1, n)]
    pivots, sums = [same[0]], [right[0]]
    for k in range(1, n):
        factor = other[k - 1].transpose() * pivots[-1].inv()
        pivots.append(same[k - 1] + same[k] - factor * other[k - 1])
        sums.append(right[k] - factor * sums[-1])
    force = [zero] * (n + 1)
    for k in reversed(range(n)):
        known = sums[k] - (other[k] * force[k + 1] if k + 1 < n else zero)
        force[k] = pivots[k].inv() * known
    return [6 / (m[k] * m[k]) * (q[k].transpose() * (force[k + 1] + force[k]))[0, 0] for k in range(n)]


def solved_legs(system, theta, omega):
    """Shiki (3.12): the arrow matrix eliminated by hand at 600 bits."""
    flint.ctx.prec = 600
    l, m, t, w = ([arb(float(x)) for x in v] for v in (system.lengths, system.masses, theta, omega))
    g, legs = arb(system.gravity), range(1, system.n)
    c, s = [(t[0] - x).cos() for x in t], [(t[0] - x).sin() for x in t]
    row = [m[i] * l[0] * w[0] ** 2 * s[i] - m[i] * g * t[i].sin() for i in legs]
    right = -sum(m, arb(0)) * g * t[0].sin() - sum((m[i] * l[i] * w[i] ** 2 * s[i] for i in legs), arb(0))
    pivot = sum(m, arb(0)) * l[0] - sum((m[i] * l[0] * c[i] ** 2 for i in legs), arb(0))
    first = (right - sum((c[i] * row[i - 1] for i in legs), arb(0))) / pivot
    return [first] + [(row[i - 1] - m[i] * l[0] * c[i] * first) / (m[i] * l[i]) for i in legs]


def errors_of(system, theta, omega, forms, at_least=0.0):
    """The error of each of these forms of the accelerations."""
    exact = (solved_rods if system.kind == "rod-chain" else solved_legs)(system, theta, omega)
    return {form: error(exact, found, at_least) for form, found in forms.items()}


def error(exact, found, at_least=0.0):
    """Largest error over largest acceleration, or over ``at_least`` where all accelerations are smaller."""
    largest = max(at_least, *(abs(float(x.mid())) for x in exact))
    assert all(float(x.rad()) <= 1e-20 * largest for x in exact)  # the yardstick itself
    worst = max(abs(float((arb(float(f)) - x).mid())) for f, x in zip(found, exact, strict=True))
    return worst / largest if largest else worst


def all_forms(system, theta, omega):
    """The same accelerations by every way there is."""
    kernel = kernels.kernel_of(system)
    rows = np.tile(theta, (3, 1)), np.tile(omega, (3, 1))
    return {
        "plain": kernels.plain_accelerations(system, theta, omega),
        "single": kernel(theta, omega),
        "batch": kernel.batch(*rows)[1],
    }


def spread(rng, n, ratio):
    return tuple(float(x) for x in np.exp(rng.uniform(0, math.log(ratio), n)) / math.sqrt(ratio))


STATES = {
    "random": lambda rng, n: (rng.uniform(-math.pi, math.pi, n), rng.uniform(-3, 3, n)),
    "fast": lambda rng, n: (rng.uniform(-math.pi, math.pi, n), rng.uniform(-1e3, 1e3, n)),
    "nearly straight": lambda rng, n: (1.1 + 1e-4 * rng.uniform(-1, 1, n), rng.uniform(-1, 1, n)),
    "nearly folded": lambda rng, n: (0.4 + math.pi * (np.arange(n) % 2) + 1e-7 * rng.uniform(-1, 1, n), np.ones(n)),
    "straight and horizontal": lambda rng, n: (np.full(n, math.pi / 2), np.zeros(n)),
    "large angles": lambda rng, n: (1e3 * rng.uniform(-1, 1, n), rng.uniform(-3, 3, n)),
    "huge angles": lambda rng, n: (1e15 * rng.uniform(-1, 1, n), rng.uniform(-3, 3, n)),
}


@pytest.mark.slow
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("n", [1, 2, 3, 10, 100])
@pytest.mark.parametrize("ratio", [1, 1e3])
def test_rods_are_exact_to_rounding(n, ratio, state):
    rng = np.random.default_rng([n, int(ratio)])
    system = RodChain(spread(rng, n, ratio), density=0.3)
    theta, omega = STATES[state](rng, n)
    errors = errors_of(system, theta, omega, all_forms(system, theta, omega))
    assert max(errors.values()) <= ALLOWED, errors


@pytest.mark.slow
def test_light_rods_between_heavy_ones():
    """Without refinement one state in seven of this chain (found by search) errs by more than 1e-14, up to 7e-14."""
    system = RodChain(spread(np.random.default_rng(31), 20, 1e3))
    rng = np.random.default_rng(0)
    for _ in range(40):
        theta, omega = STATES["random"](rng, 20)
        errors = errors_of(system, theta, omega, all_forms(system, theta, omega))
        assert max(errors.values()) <= ALLOWED, errors


@pytest.mark.slow
@pytest.mark.parametrize("state", ["random", "fast", "nearly straight"])
@pytest.mark.parametrize("ratio", [1, 1e3])
def test_a_thousand_rods_are_exact_to_rounding(ratio, state):
    rng = np.random.default_rng(int(ratio))
    system = RodChain(spread(rng, 1000, ratio))
    theta, omega = STATES[state](rng, 1000)
    errors = errors_of(system, theta, omega, all_forms(system, theta, omega))
    assert max(errors.values()) <= ALLOWED, errors


@pytest.mark.slow
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("n", [2, 3, 9, 60, 1001])
@pytest.mark.parametrize("heavy", [1, 1e6])
def test_legs_are_exact_to_rounding(n, heavy, state):
    rng = np.random.default_rng([n, int(heavy)])
    system = NLegPendulum(spread(rng, n, 1e3), spread(rng, n, heavy))
    theta, omega = STATES[state](rng, n)
    errors = errors_of(system, theta, omega, all_forms(system, theta, omega))
    assert max(errors.values()) <= ALLOWED, errors


@pytest.mark.slow
@pytest.mark.parametrize("apart", [1e-2, 1e-5, 1e-8])
def test_nearly_aligned_heavy_legs(apart):
    """Where the printed matrix loses ten digits: light first mass, legs a hair apart, masses 1e6 times heavier."""
    system = NLegPendulum((1.0, 1e-3, 0.7, 1.0), (1e-3, 1e3, 7e2, 2e2))
    theta = 0.8 + apart * np.array([0.0, 1.0, -2.0, 3.0])
    omega = np.array([1.0, -2.0, 0.5, 3.0])
    errors = errors_of(system, theta, omega, all_forms(system, theta, omega))
    assert max(errors.values()) <= ALLOWED, errors


def test_small_components_of_a_straight_chain_are_exact_too():
    """A straight horizontal chain at rest: θ'' falls by 3.7 a rod, and each component keeps its digits."""
    system = RodChain((1.0,) * 60)
    theta, omega = np.full(60, math.pi / 2), np.zeros(60)
    exact = solved_rods(system, theta, omega)
    for form, found in all_forms(system, theta, omega).items():
        worst = max(abs(float((arb(float(f)) - x) / x)) for f, x in zip(found, exact, strict=True))
        assert worst <= 60 * 1.2e-16, form  # rounding grows by at most one unit a rod


def test_extended_precision_uses_its_digits():
    system = RodChain((1.0, 0.3, 2.0))
    theta, omega = np.array([0.3, -1.2, 2.9]), np.array([1.0, -2.0, 0.7])
    found = kernels.plain_accelerations(system, theta.astype(np.longdouble), omega.astype(np.longdouble))
    assert found.dtype == np.longdouble
    exact = solved_rods(system, theta, omega)
    high = found.astype(float)
    low = (found - high).astype(float)
    worst = max(abs(float(arb(float(h)) + arb(float(e)) - x)) for h, e, x in zip(high, low, exact, strict=True))
    assert worst <= 1e-17  # eps of longdouble is 1.1e-19; accelerations are about 10


SYSTEMS = (RodChain((1.0, 0.5, 2.0)), NLegPendulum((1.0, 0.8, 0.3), (1.0, 0.5, 2.0)))
LONG = (RodChain((0.1,) * 70), NLegPendulum((0.5,) * 70, (1.0,) * 70))


@pytest.mark.parametrize("system", SYSTEMS + LONG, ids=lambda s: f"{s.kind}-{s.n}")
@pytest.mark.parametrize("shape", [(0,), (1,), (31,), (32,), (33,), (64,), (65,), (200,), (2, 3), (4, 0, 2), (1, 1, 1)])
def test_a_state_does_not_depend_on_the_rest_of_its_batch(system, shape):
    rng = np.random.default_rng(0)
    theta, omega = rng.uniform(-9, 9, (2, *shape, system.n))
    found = kernels.accelerations(system, theta, omega)
    assert found.shape == theta.shape
    assert found.dtype == np.float64
    kernel = kernels.kernel_of(system)
    for place in np.ndindex(shape):
        np.testing.assert_array_equal(found[place], kernel.batch(theta[place], omega[place]))


def test_threads_change_nothing():
    system = SYSTEMS[0]
    rng = np.random.default_rng(0)
    theta, omega = rng.uniform(-9, 9, (2, 60_000, 3))
    one = kernels.accelerations(system, theta, omega, threads=1)
    np.testing.assert_array_equal(one, kernels.accelerations(system, theta, omega))
    np.testing.assert_array_equal(one, kernels.accelerations(system, theta, omega, threads=7))


def test_accepts_lists_other_types_and_strides():
    system = SYSTEMS[1]
    theta, omega = [0.5, 1.5, -0.25], [1, 2, 3]
    expected = kernels.accelerations(system, np.array(theta), np.array(omega, float))
    np.testing.assert_array_equal(expected, kernels.accelerations(system, theta, omega))
    np.testing.assert_array_equal(expected, kernels.accelerations(system, np.array(theta, np.float32), omega))
    np.testing.assert_array_equal(expected, kernels.accelerations(system, np.array(theta)[::-1][::-1], omega))
    columns = np.asfortranarray(np.tile(theta, (5, 1)))
    np.testing.assert_array_equal(
        kernels.accelerations(system, columns, np.tile(omega, (5, 1)).astype(float))[3],
        kernels.kernel_of(system).batch(np.array(theta), np.array(omega, float)),
    )


@pytest.mark.parametrize(
    ("theta", "omega", "says"),
    [
        ([0.0, 1.0], [0.0, 1.0, 2.0], "theta: the last axis"),
        (1.0, 1.0, "theta: the last axis"),
        ([0.0] * 3, [[0.0] * 3], "omega: must have theta's shape"),
        ([0.0, math.nan, 0.0], [0.0] * 3, r"theta\[1\]: must be finite"),
        ([0.0] * 3, [0.0, 0.0, math.inf], r"omega\[2\]: must be finite"),
        ([0.0, 0.0, 2e15], [0.0] * 3, r"theta\[2\]: must be finite and at most 1e\+15"),
        ([0.0] * 3, [0.0, -1e101, 0.0], r"omega\[1\]"),
        (["a", "b", "c"], [0.0] * 3, "theta: an array of numbers"),
        ([0.0, 1.0, 1j], [0.0] * 3, "theta: an array of numbers"),
    ],
)
@pytest.mark.parametrize("system", SYSTEMS, ids=lambda s: s.kind)
def test_refuses_what_is_no_state(system, theta, omega, says):
    with pytest.raises(InvalidInput, match=says):
        kernels.accelerations(system, theta, omega)
    kernels.kernel_of(system)  # and again on the compiled way
    with pytest.raises(InvalidInput, match=says):
        kernels.accelerations(system, np.array(theta), np.array(omega))


@pytest.mark.parametrize("system", SYSTEMS + LONG, ids=lambda s: f"{s.kind}-{s.n}")
def test_a_bad_state_in_a_batch_is_found(system):
    theta, omega = np.zeros((2, 150, system.n))
    omega[137, system.n - 1] = math.nan
    with pytest.raises(InvalidInput, match=rf"omega\[137, {system.n - 1}\]"):
        kernels.accelerations(system, theta, omega)


def test_threads_must_be_positive():
    with pytest.raises(InvalidInput, match="threads"):
        kernels.accelerations(SYSTEMS[0], np.zeros((9000, 3)), np.zeros((9000, 3)), threads=0)


@settings(deadline=None, max_examples=60)
@given(
    st.integers(2, 6).flatmap(
        lambda n: st.tuples(
            *(st.lists(st.floats(low, high), min_size=n, max_size=n) for low, high in ((1e-3, 1), (-50, 50), (-9, 9)))
        )
    ),
    st.sampled_from([0.0, 9.81, 1e3]),
)
@example(([1.0, 1.0], [0.0, 1.0], [0.0, 4.3601874202292895e-156]), 0.0)  # its square, 1.9e-311, has 38 bits
def test_any_small_system(lists, gravity):
    lengths, theta, omega = lists
    for system in (RodChain(lengths, gravity=gravity), NLegPendulum(lengths, lengths[::-1], gravity)):
        found = all_forms(system, np.array(theta), np.array(omega))
        # Searched states find accelerations that nearly vanish as sums of terms that do not, where one unit in the
        # last place of an angle already changes them by more. The scale is then that of the terms of l θ''; and below
        # the smallest normal number, where doubles lie evenly spaced and no operation is relatively exact, that number.
        largest = max(l * w * w for l in lengths for w in omega)
        terms = (gravity + max(largest, sys.float_info.min)) / min(lengths)
        errors = errors_of(system, theta, omega, found, terms)
        assert max(errors.values()) <= ALLOWED, errors


def test_a_few_small_calls_do_not_import_numba():
    script = (
        "import sys, numpy as np; from furiko.models import RodChain\n"
        "from furiko.reference.kernels.forward_dynamics import accelerations\n"
        "for _ in range(5): accelerations(RodChain((1.0, 1.0)), np.ones((50, 2)), np.ones((50, 2)))\n"
        "assert 'numba' not in sys.modules and 'scipy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_compiled_kernels_once_loaded_serve_every_system():
    kernel = kernels.kernel_of(RodChain((1.0, 0.5)))
    state = np.array([0.3, 0.4]), np.array([0.1, 0.2])
    found = kernel(*state)
    np.testing.assert_array_equal(kernels.accelerations(RodChain((1.0, 0.5)), *state), found)
    assert kernels._is_compiled(RodChain((2.0, 0.5, 1.0)), np.zeros(3))


def test_compiles_where_no_cache_can_be_written(tmp_path):
    """An installation and a home that are read-only: slower to start, not broken."""
    script = (
        "import numpy as np; from furiko.models import RodChain\n"
        "from furiko.reference.kernels.forward_dynamics import kernel_of\n"
        "print(kernel_of(RodChain((1.0,)))(np.array([0.5]), np.array([0.0]))[0])"
    )
    nowhere = tmp_path / "nowhere"
    nowhere.touch()  # a file where a folder would have to be made
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(nowhere / "cache")}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) == pytest.approx(-1.5 * 9.81 * math.sin(0.5), rel=1e-14)


@pytest.mark.slow
@pytest.mark.skipif(platform.machine() != "x86_64", reason="the processors named here are x86-64")
@pytest.mark.parametrize("processor", ["x86-64", "haswell"])  # without fused multiply-add; with it, in 256 bits
@pytest.mark.parametrize("way", ["made", "by_numba"])
def test_other_processors_are_as_exact(processor, way, tmp_path):
    script = (
        "import sys, numpy as np; from furiko.models import NLegPendulum\n"
        "from furiko.reference.kernels.ahead import load\n"
        "from furiko.reference.kernels.forward_dynamics import kernel_of\n"
        "load.is_ahead = lambda name: sys.argv[2] == 'made'\n"
        "made = load.made\n"
        "load.made = lambda name: made(name, sys.argv[3])\n"
        "lengths, masses, theta, omega = np.load(sys.argv[1])\n"
        "kernel = kernel_of(NLegPendulum(tuple(lengths.tolist()), tuple(masses.tolist())))\n"
        "batch = kernel.batch(np.tile(theta, (3, 1)), np.tile(omega, (3, 1)))[1]\n"
        "np.save(sys.argv[1], [kernel(theta, omega), batch])"
    )
    rng = np.random.default_rng([1001, 1_000_000])
    system = NLegPendulum(spread(rng, 1001, 1e3), spread(rng, 1001, 1e6))
    theta, omega = STATES["huge angles"](rng, 1001)
    np.save(tmp_path / "state.npy", [system.lengths, system.masses, theta, omega])
    named = {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": "", "NUMBA_CACHE_DIR": str(tmp_path)}
    subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "state.npy"), way, processor], env=os.environ | named, check=True
    )
    errors = errors_of(system, theta, omega, dict(enumerate(np.load(tmp_path / "state.npy"))))
    assert max(errors.values()) <= ALLOWED, errors


def test_writes_into_an_array_that_is_given():
    system = SYSTEMS[0]
    theta, omega = np.ones((5, 3)), np.zeros((5, 3))
    out = np.empty((5, 3))
    assert kernels.accelerations(system, theta, omega, out=out) is out
    np.testing.assert_array_equal(out, kernels.accelerations(system, theta, omega))
    for wrong in (np.empty((5, 2)), np.empty((5, 3), np.float32), np.empty((10, 3))[::2]):
        with pytest.raises(InvalidInput, match="out"):
            kernels.accelerations(system, theta, omega, out=wrong)


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda s: s.kind)
def test_a_single_state_may_have_any_stride(system):
    states = np.random.default_rng(0).uniform(-3, 3, (3, 10))
    kernels.kernel_of(system)
    theta, omega = states[:, 4], states[::-1, 7]
    expected = kernels.accelerations(system, theta.copy(), omega.copy())
    np.testing.assert_array_equal(kernels.accelerations(system, theta, omega), expected)


UNIT = 2.0**-160  # of masses and lengths, 7e-49: the smallest that a system may have are 1e-50


@pytest.mark.parametrize("slower", [1.0, 2.0**-200, 2.0**-380, 2.0**-420])
@pytest.mark.parametrize("form", ["plain", "single", "batch"])
def test_units_in_which_torques_are_subnormal_lose_no_digit(form, slower):
    """By dimensions: with masses, lengths and times in other units, accelerations are the same times a power of two.

    Powers of two round nothing, and no acceleration here is below the normal range: not a bit may change, though
    m l² ω², a torque, is 1e-397 in the smallest unit.
    """
    draw = np.random.default_rng(7)
    lengths, masses = draw.uniform(0.5, 2, 4), draw.uniform(0.5, 2, 4)
    theta, omega = draw.uniform(-3, 3, (3, 4)), draw.uniform(-5, 5, (3, 4))
    small, slow = UNIT * lengths, slower**2 * UNIT * 9.81
    pairs = [
        (RodChain(tuple(lengths)), RodChain(tuple(small), gravity=slow)),
        (NLegPendulum(tuple(lengths), tuple(masses)), NLegPendulum(tuple(small), tuple(UNIT * masses), slow)),
    ]
    for usual, other in pairs:
        before = answered(form, usual, theta, omega)
        after = answered(form, other, theta, slower * omega)
        assert (after == before * slower**2).all()


def answered(form, system, theta, omega):
    if form == "plain":
        return kernels.plain_accelerations(system, theta, omega)
    kernel = kernels.kernel_of(system)
    return kernel.batch(theta, omega) if form == "batch" else np.array(list(map(kernel, theta, omega)))
