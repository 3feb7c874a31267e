"""Grades a function θ̈ = f(θ, ω, parameters) from its accelerations alone, by comparing them with the catalogue.

In random states of random mechanisms, the accelerations are put into the right equations; a row that they do not
satisfy is wrong by a residual, and a mistake explains it if its own equations are satisfied instead. Two mistakes are
named where their residuals add up.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput, nearest
from ..algebra.symbols import KINDS, Symbols, symbols_of
from ..algebra.trig import COS, NOTHING, digits, unit
from ..mistakes.catalogue import catalogue
from ..mistakes.known_mistakes import MOST_LINKS, KnownMistakes, known_mistakes
from ..steps.derivation import Mistake, Row, correct_derivation, derive
from ..steps.views import View
from .explain import ranked
from .grade_record import Grade
from .wrong import answer, named, same_equations
from .wrong_terms import WrongTermFinder

Array = NDArray[np.float64]
STATES = 12
# Residuals of right equations at double-precision accelerations: rounding times the conditioning of mechanisms whose
# lengths and masses differ by less than a factor 3, below 1e-12 here. A mistake changes a term by a per cent or more.
ALLOWED = 1e-9
NO_SANDBOX = (
    "The function ran in a process of its own with limits on time and memory. That is no sandbox: "
    "it could read and write files. Grade only functions that you trust."
)
NO_SANDBOX_JA = (
    "関数は時間とメモリを制限した別プロセスで実行しましたが、サンドボックスではありません。"
    "信頼できる関数だけを採点してください。"
)


@dataclass(frozen=True)
class Samples:
    """Random mechanisms and states: ``values`` of all symbols but the accelerations, shape (symbols, STATES)."""

    m: Symbols
    values: Array
    theta: Array

    def states(self) -> list[dict[str, Any]]:
        """As the function gets them."""
        n = self.m.n
        out = []
        for k in range(STATES):
            parameters: dict[str, Any] = {"lengths": self.values[2 * n : 3 * n, k].tolist()}
            parameters["gravity"] = float(self.values[4 * n, k])
            if self.m.kind == "rod-chain":
                parameters["density"] = float(self.values[4 * n + 1, k])
                masses = self.values[2 * n : 3 * n, k] * self.values[4 * n + 1, k]
            else:
                masses = self.values[3 * n : 4 * n, k]
            parameters["masses"] = masses.tolist()
            out.append({
                "theta": self.theta[:, k].tolist(), "omega": self.values[n : 2 * n, k].tolist(),
                "parameters": parameters,
            })  # fmt: skip
        return out


def samples(m: Symbols, seed: int = 0) -> Samples:
    """Lengths and masses from 0.5 to 1.5, angles all round, rates up to 3 rad/s; the same every time."""
    draw = random.Random(f"furiko callable {m.kind} {m.n} {seed}")
    n = m.n
    values = np.ones((m.space.symbol_count, STATES))
    for place in range(n, m.space.symbol_count):
        low, high = (-3.0, 3.0) if place < 2 * n else (0.5, 1.5)
        values[place] = [draw.uniform(low, high) for _ in range(STATES)]
    values[4 * n] *= 9.0
    theta = np.array([[draw.uniform(-np.pi, np.pi) for _ in range(STATES)] for _ in range(n)])
    return Samples(m, values, theta)


def grade_callable(function: str, system: str, links: int, *, seconds: float = 10.0, megabytes: int = 2048) -> Grade:
    """Grade ``module:function``. Raises InvalidInput where it cannot be called, or exceeds its limits."""
    if system not in KINDS:
        raise InvalidInput(f"system: {system!r:.40} is not known{nearest(system, KINDS)}; give 'n-leg' or 'rod-chain'")
    least = 2 if system == "n-leg" else 1
    if not least <= links <= MOST_LINKS[system]:
        raise InvalidInput(f"links: from {least} to {MOST_LINKS[system]} for a function of this system, got {links}")
    m = symbols_of(system, links)
    drawn = samples(m)
    accelerations = _call(function, drawn, seconds, megabytes)
    return grade_accelerations(drawn, accelerations)


def _call(function: str, drawn: Samples, seconds: float, megabytes: int) -> Array:
    if function.count(":") != 1 or not all(function.split(":")):
        raise InvalidInput(f"--callable {function!r:.60}: give module:function")
    task = {"function": function, "states": drawn.states(), "seconds": seconds, "megabytes": megabytes}
    try:
        done = subprocess.run(
            [sys.executable, "-m", "furiko.derivations.grading.callable_process"],
            input=json.dumps(task), capture_output=True, text=True, timeout=seconds + 5, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise InvalidInput(f"{function}: no answer within {seconds:g} s") from None
    try:
        result = json.loads(done.stdout)
    except ValueError:
        raise InvalidInput(f"{function}: its process ended (status {done.returncode}) without an answer; "
                           f"the limits are {seconds:g} s and {megabytes} MB") from None  # fmt: skip
    if "error" in result:
        raise InvalidInput(f"{function}: {result['error']}")
    values = np.array(result["accelerations"], dtype=np.float64).T
    if not np.isfinite(values).all():
        raise InvalidInput(f"{function}: an acceleration is not a finite number")
    return values


def grade_accelerations(drawn: Samples, accelerations: Array) -> Grade:
    """The verdict on accelerations, shape (n, STATES), in the drawn states."""
    m = drawn.m
    known = known_mistakes(View(m))
    values = _Values(drawn, accelerations)
    base = [values.row(row) for row in correct_derivation(m).rows]
    residual = np.array([value for value, _ in base])
    scale = np.array([size for _, size in base])
    notes = {"notes": (NO_SANDBOX,), "notes_ja": (NO_SANDBOX_JA,)}
    if np.all(np.abs(residual) <= ALLOWED * scale):
        return answer(known, "correct", **notes)
    found = _explanations(m, known, values, residual, scale)
    if not found:
        wrong = [i + 1 for i in range(m.n) if np.any(np.abs(residual[i]) > ALLOWED * scale[i])]
        rows = ", ".join(map(str, wrong))
        note = f"The accelerations do not satisfy row {rows}; no mistake in the catalogue explains it."
        return answer(known, "wrong", notes=(note, NO_SANDBOX), notes_ja=(NO_SANDBOX_JA,))
    groups = same_equations(known, found)
    mistakes = groups[0][0]
    alternatives = tuple(tuple(x.name for x in others) for others, _ in groups[1:])
    findings = WrongTermFinder(known).explained(mistakes, ())
    return answer(known, "wrong", findings=findings, mistakes=named(*groups[0]), alternatives=alternatives, **notes)


def _explanations(
    m: Symbols, known: KnownMistakes, values: _Values, residual: Array, scale: Array
) -> list[tuple[Mistake, ...]]:
    wrong = {entry.mistake.name for entry in known.wrong}
    mistakes = [mistake for mistake in catalogue(m) if mistake.name in wrong]
    changes = np.array([values.changes(mistake) for mistake in mistakes])  # (mistakes, n, STATES)
    left = (residual + changes) / scale
    single = [mistakes[k] for k in np.flatnonzero(np.all(np.abs(left) <= ALLOWED * 10, axis=(1, 2)))]
    confirmed: list[tuple[Mistake, ...]] = [(mistake,) for mistake in single if values.give(derive(m, [mistake]).rows)]
    if confirmed:
        return ranked(confirmed)
    flat = (changes / scale).reshape(len(mistakes), -1)
    pairs = []
    for k, rest in enumerate(left.reshape(len(mistakes), -1)):
        close = np.flatnonzero(np.abs(flat[k + 1 :] + rest).max(axis=1) <= ALLOWED * 10)
        pairs += [(mistakes[k], mistakes[k + 1 + j]) for j in close]
    return ranked([pair for pair in pairs if values.give(derive(m, pair).rows)])[:8]


class _Values:
    """Formulas in double precision at all samples at once."""

    def __init__(self, drawn: Samples, accelerations: Array) -> None:
        self.m = drawn.m
        self.numbers = drawn.values.copy()
        self.numbers[: self.m.n] = accelerations
        self.theta = drawn.theta
        self._products: dict[int, Array] = {}
        self._waves: dict[tuple[int, int], Array] = {}
        self._right = [self.row(row)[0] for row in correct_derivation(self.m).rows]

    def changes(self, mistake: Mistake) -> Array:
        """By how much a mistake changes each row's value, shape (n, STATES)."""
        rows = derive(self.m, [mistake]).rows
        known = correct_derivation(self.m).rows
        changes = np.zeros((self.m.n, STATES))
        for i, row in enumerate(rows):
            if row is not known[i]:
                changes[i] = self.row(row)[0] - self._right[i]
        return changes

    def give(self, rows: Sequence[Row]) -> bool:
        """Whether these rows, solved, really give the accelerations (a row that vanishes is satisfied by all)."""
        n = self.m.n
        matrix = np.array([[self.row({0: row.get(unit(j), NOTHING)})[0] for j in range(n)] for row in rows])
        rest = [{q: f for q, f in row.items() if q not in map(unit, range(n))} for row in rows]
        right_side = -np.array([self.row(row)[0] for row in rest])
        try:
            solved = np.linalg.solve(matrix.transpose(2, 0, 1), right_side.T[..., None])[..., 0].T
        except np.linalg.LinAlgError:
            return False
        return bool(np.allclose(solved, self.numbers[:n], rtol=1e-6, atol=1e-6))

    def row(self, row: Row) -> tuple[Array, Array]:
        """Value of a row, and the sum of its terms' magnitudes."""
        value, size = np.zeros(STATES), np.zeros(STATES)
        for q, f in row.items():
            for (e, h, phase), c in f.terms.items():
                term = float(c.p) / float(c.q) * self._product(e + q) * self._wave(h, phase)
                value += term
                size += np.abs(term)
        return value, size

    def _product(self, e: int) -> Array:
        found = self._products.get(e)
        if found is None:
            found = np.ones(STATES)
            for place, power in enumerate(digits(e, self.m.space.symbol_count)):
                if power:
                    found = found * self.numbers[place] ** power
            self._products[e] = found
        return found

    def _wave(self, h: int, phase: int) -> Array:
        found = self._waves.get((h, phase))
        if found is None:
            angle = np.array(digits(h, self.m.n)) @ self.theta / 2
            found = self._waves[h, phase] = np.cos(angle) if phase == COS else np.sin(angle)
        return found
