"""Functions graded from their accelerations alone; the functions are written here as their owners would write them."""

import sys

import numpy as np
import pytest

from furiko.derivations.algebra.symbols import symbols_of
from furiko.derivations.grading.grade_callable import grade_accelerations, grade_callable, samples
from furiko.derivations.mistakes.catalogue import catalogue
from furiko.derivations.steps.derivation import derive
from furiko.derivations.steps.motion import ParameterValues, RowMotion
from furiko.models.errors import InvalidInput

MODULE = """
import numpy as np

def double(theta, omega, p, slip=""):
    l1, l2 = p.lengths
    m1, m2 = p.masses
    t1, t2 = theta
    w1, w2 = omega
    c, s = np.cos(t1 - t2), np.sin(t1 - t2)
    print("something on standard output")
    A = [[(m1 + m2) * l1, m2 * l2 * c], [m2 * l1 * (s if "sine" in slip else c), m2 * l2]]
    sign = -1 if "sign" in slip else 1
    b = [-(m1 + m2) * p.gravity * np.sin(t1) - m2 * l2 * w2**2 * s,
         -m2 * p.gravity * np.sin(t2) + sign * m2 * l1 * w1**2 * s]
    return np.linalg.solve(A, b) * (1.001 if "odd" in slip else 1)

def sign(*a): return double(*a, slip="sign")
def two(*a): return double(*a, slip="sign sine")
def odd(*a): return double(*a, slip="odd")
def endless(*a):
    while True: pass
def greedy(*a): return bytearray(10**12)
def ends(*a): raise SystemExit(0)
def raises(*a): return 1 / 0
def short(*a): return [1.0]
def nan(*a): return [float("nan"), 1.0]
value = 3

class Rods:
    @staticmethod
    def f(theta, omega, p):
        n, l, rho, g = len(theta), p.lengths, p.density, p.gravity
        L = np.array([l[j] / 2 + l[j + 1:].sum() for j in range(n)])
        A, b = np.zeros((n, n)), np.zeros(n)
        for j in range(n):
            b[j] -= L[j] * g * np.sin(theta[j])
            for k in range(n):
                alpha = L[max(j, k)] - (l[j] / 6 if j == k else 0)
                A[j, k] = alpha * l[k] * np.cos(theta[j] - theta[k])
                b[j] -= alpha * l[k] * omega[k] ** 2 * np.sin(theta[j] - theta[k])
        return np.linalg.solve(A, b)
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    (tmp_path / "mine.py").write_text(MODULE)
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("module")
def test_a_right_function_is_correct_and_no_sandbox_is_claimed():
    graded = grade_callable("mine:double", "n-leg", 2)
    assert graded.verdict == "correct"
    assert "no sandbox" in graded.notes[0]
    assert "mine" not in sys.modules
    assert grade_callable("mine:Rods.f", "rod-chain", 4).verdict == "correct"


@pytest.mark.usefixtures("module")
def test_mistakes_are_named_from_accelerations():
    graded = grade_callable("mine:sign", "n-leg", 2)
    assert [named.name for named in graded.mistakes] == ["sign:2:3:3"]
    assert graded.findings[0].term == "B[2,1]"
    both = grade_callable("mine:two", "n-leg", 2)
    assert {named.cause for named in both.mistakes} == {"sign", "sin-for-cos"}


@pytest.mark.usefixtures("module")
def test_what_the_catalogue_does_not_have_is_still_wrong():
    graded = grade_callable("mine:odd", "n-leg", 2)
    assert graded.verdict == "wrong"
    assert not graded.mistakes


@pytest.mark.usefixtures("module")
@pytest.mark.parametrize(
    ("function", "why"),
    [
        ("greedy", "more than|ended"), ("ends", "SystemExit"), ("raises", "ZeroDivisionError"),
        ("short", "2 accelerations"),
        ("nan", "finite"), ("nothing", "no attribute"), ("value", "not a function"),
    ],
)  # fmt: skip
def test_failures_end_in_a_line(function, why):
    with pytest.raises(InvalidInput, match=why):
        grade_callable(f"mine:{function}", "n-leg", 2, megabytes=1024)


@pytest.mark.usefixtures("module")
def test_an_endless_function_is_stopped():
    with pytest.raises(InvalidInput, match="answer"):
        grade_callable("mine:endless", "n-leg", 2, seconds=1)


@pytest.mark.parametrize("spec", ["mine", "mine:", ":f", "a:b:c"])
def test_specifications_are_checked(spec):
    with pytest.raises(InvalidInput, match="module:function"):
        grade_callable(spec, "n-leg", 2)
    with pytest.raises(InvalidInput, match="n-leg"):
        grade_callable("mine:f", "cart", 2)
    with pytest.raises(InvalidInput, match="links"):
        grade_callable("mine:f", "n-leg", 1)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["n-leg", "rod-chain"])
def test_every_mistake_that_determines_the_motion_is_recognised(kind):
    """Accelerations of each wrong derivation of two links, solved in floats, given back as somebody's function."""
    m = symbols_of(kind, 2)
    drawn = samples(m)
    missed = []
    for mistake in catalogue(m):
        rows = derive(m, [mistake]).rows
        columns = [
            RowMotion(m, rows, _parameters(m, state)).accelerations(drawn.theta[:, [k]].T, drawn.values[2:4, [k]].T)[0]
            for k, state in enumerate(drawn.states())
        ]
        values = np.array(columns).T
        if not np.isfinite(values).all():
            continue  # a row has vanished
        graded = grade_accelerations(drawn, values)
        names = {named.name for named in graded.mistakes} | {x for named in graded.mistakes for x in named.also}
        if graded.verdict == "wrong" and mistake.name not in names:
            missed.append(mistake.name)
    assert missed == []


def _parameters(m, state):
    given = state["parameters"]
    masses = tuple(given["masses"]) if m.kind == "n-leg" else ()
    return ParameterValues(tuple(given["lengths"]), masses, given.get("density", 1.0), given["gravity"])
