"""Hypotheses about an engine's code: a sign, a factor or another function in one term, or in all terms of a kind.

They have the names that the grader of derivations has for the same mistakes. ``A[i,j]`` multiplies θ̈_j in row i, in
absolute angles, ``B[i,j]`` θ̇_j², and ``G[i]`` is the row's gravity term.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ...models.mechanism import Mechanism
from ...reference.planar_tree import Parameters
from ..finding import Finding, rounded
from ..measurement import Array, Measurement
from .hypotheses import Hypothesis
from .terms import Terms, terms_of

MOST_LINKS_BY_ENTRY = 12  # up to which every entry is looked at
MOST_LINKS_BY_SHAPE = 6  # up to which other functions in each entry are, and entries of forward dynamics alone
KNOWN = 1e-6  # relative; a factor this close to a known one is that
EVERYWHERE, FORWARD, INVERSE = "", "accelerations", "inverse dynamics"
OTHER = {FORWARD: INVERSE, INVERSE: FORWARD}

Rows = Callable[[Terms, Measurement], Array]


@dataclass(frozen=True)
class TermFault:
    """A fault of one kind: ``rows`` is what a factor of 2 in place of 1 would add (S, n) [N m], ``what`` names the
    term, ``scope`` where it shows. ``cause``: the code of another function (``wanted`` is then its size), or of any
    factor that has no code of its own."""

    what: str
    where: str
    rows: Rows
    cause: str = "term-wrong"
    says: str = ""
    scope: str = EVERYWHERE
    whole: bool = False


def term_hypotheses(m: Mechanism, scopes: bool, shapes: bool = True) -> list[Hypothesis]:
    """Every hypothesis, likelier ones first.

    ``scopes``: forward and inverse dynamics, both of which the engine has, may differ in them; ``shapes``: also other
    functions in a term.
    """
    return [_hypothesis(fault, m) for fault in _faults(m, scopes, shapes)]


def _faults(m: Mechanism, scopes: bool, shapes: bool) -> Iterator[TermFault]:
    n, partners = m.n, [len(_on_one_way(m, i)) - 1 for i in range(m.n)]
    every = (EVERYWHERE, FORWARD, INVERSE) if scopes else (EVERYWHERE,)
    for scope in every:
        yield TermFault("the velocity terms", "velocity terms", _velocity, scope=scope, whole=True)
    for scope in every[1:]:
        yield TermFault("the gravity terms", "gravity terms", lambda t, _: t.gravity, scope=scope)
    yield TermFault(
        "the accelerations",
        "accelerations",
        _inertia,
        "accelerations-scaled",
        scope=every[min(1, len(every) - 1)],
    )
    if n > MOST_LINKS_BY_ENTRY:
        return
    for i in range(n):
        for scope in every:
            yield TermFault(f"row {i + 1}, G[{i + 1}]", f"G[{i + 1}]", _only(lambda t, _: t.gravity, i), scope=scope)
            if partners[i] > 1:
                yield TermFault(
                    f"row {i + 1}, the velocity terms", f"row {i + 1}", _only(_velocity, i), scope=scope, whole=True
                )
    yield from _of_one_acceleration(n, every)
    for scope in every if n <= MOST_LINKS_BY_SHAPE else every[:1]:
        yield from _entries(n, scope)
        if shapes and n <= MOST_LINKS_BY_SHAPE:
            yield from _shapes(n, scope)


def _of_one_acceleration(n: int, every: tuple[str, ...]) -> Iterator[TermFault]:
    """One acceleration is wrong and the others are right: no equation of motion has that, a solved formula has."""
    scope = every[min(1, len(every) - 1)]
    if n < 2:
        return
    for k in range(n):
        for part, word in (("by_gravity", "gravity"), ("by_rates", "velocity")):
            yield TermFault(
                f"θ̈{k + 1} alone, the {word} terms",
                f"θ̈{k + 1}",
                _response(part, k),
                scope=scope,
                whole=word == "velocity",
            )
        yield TermFault(f"θ̈{k + 1} alone", f"θ̈{k + 1}", _response("", k), "accelerations-scaled", scope=scope)


def _on_one_way(m: Mechanism, i: int) -> set[int]:
    """The links whose motion is in row i: itself, those on the way to it and those that it carries."""
    ways: list[set[int]] = []
    for k, parent in enumerate(m.parents):
        ways.append({k} | (ways[parent] if parent >= 0 else set()))
    return {k for k in range(m.n) if i in ways[k]} | ways[i]


def _entries(n: int, scope: str) -> Iterator[TermFault]:
    for i in range(n):
        for j in range(n):
            yield TermFault(f"row {i + 1}, A[{i + 1},{j + 1}]", f"A[{i + 1},{j + 1}]", _mass(i, j), scope=scope)
            if i != j:
                yield TermFault(f"row {i + 1}, B[{i + 1},{j + 1}]", f"B[{i + 1},{j + 1}]", _rate(i, j), scope=scope)


def _shapes(n: int, scope: str) -> Iterator[TermFault]:
    for i in range(n):
        yield TermFault(
            f"row {i + 1}, G[{i + 1}]", f"G[{i + 1}]", _only(lambda t, _: t.gravity_turned - t.gravity, i),
            "cos-for-sin", "cos found, sin expected", scope,
        )  # fmt: skip
        for j in range(n):
            if i == j:
                continue
            a, b = f"A[{i + 1},{j + 1}]", f"B[{i + 1},{j + 1}]"
            row = f"row {i + 1}, "
            for sign in (1.0, -1.0):
                yield TermFault(row + a, a, _swapped_mass(i, j, sign), "sin-for-cos", "sin found, cos expected", scope)
                yield TermFault(row + b, b, _swapped_rate(i, j, sign), "cos-for-sin", "cos found, sin expected", scope)
            says = "the angles are added, their difference is expected"
            yield TermFault(row + a, a, _mass_of_sum(i, j), "angle-sum", says, scope)
            for sign in (1.0, -1.0):
                yield TermFault(row + b, b, _rate_of_sum(i, j, sign), "angle-sum", says, scope)
            product = f"θ̇{min(i, j) + 1} θ̇{max(i, j) + 1} found, θ̇{j + 1}² expected"
            yield TermFault(row + b, b, _other_rate(i, j, _product(i, j)), "rate-product", product, scope)
            missing = f"θ̇{j + 1} found, θ̇{j + 1}² expected"
            yield TermFault(row + b, b, _other_rate(i, j, _itself(j)), "square-missing", missing, scope)
            wrong = f"θ̇{i + 1}² found, θ̇{j + 1}² expected"
            yield TermFault(row + b, b, _other_rate(i, j, _product(i, i)), "wrong-rate", wrong, scope)
            wrong = f"θ̈{i + 1} found, θ̈{j + 1} expected"
            yield TermFault(row + a, a, _other_acceleration(i, j), "wrong-acceleration", wrong, scope)


# --- What each adds to the rows


def _velocity(t: Terms, measured: Measurement) -> Array:
    return np.asarray((t.velocity @ (measured.omega**2)[..., None])[..., 0])


def _inertia(t: Terms, measured: Measurement) -> Array:
    return np.asarray((t.mass @ measured.alpha[..., None])[..., 0])


def _only(rows: Rows, i: int) -> Rows:
    def one(t: Terms, measured: Measurement) -> Array:
        found = np.zeros_like(measured.theta)
        found[:, i] = rows(t, measured)[:, i]
        return found

    return one


def _in_row(i: int, values: Callable[[Terms, Measurement], Array]) -> Rows:
    def one(t: Terms, measured: Measurement) -> Array:
        found = np.zeros_like(measured.theta)
        found[:, i] = values(t, measured)
        return found

    return one


def _mass(i: int, j: int) -> Rows:
    return _in_row(i, lambda t, s: t.mass[:, i, j] * s.alpha[:, j])


def _rate(i: int, j: int) -> Rows:
    return _in_row(i, lambda t, s: t.velocity[:, i, j] * s.omega[:, j] ** 2)


def _swapped_mass(i: int, j: int, sign: float) -> Rows:
    return _in_row(i, lambda t, s: (sign * t.velocity[:, i, j] - t.mass[:, i, j]) * s.alpha[:, j])


def _swapped_rate(i: int, j: int, sign: float) -> Rows:
    return _in_row(i, lambda t, s: (sign * t.mass[:, i, j] - t.velocity[:, i, j]) * s.omega[:, j] ** 2)


def _mass_of_sum(i: int, j: int) -> Rows:
    return _in_row(i, lambda t, s: (t.sums[0][:, i, j] - t.mass[:, i, j]) * s.alpha[:, j])


def _rate_of_sum(i: int, j: int, sign: float) -> Rows:
    return _in_row(i, lambda t, s: (sign * t.sums[1][:, i, j] - t.velocity[:, i, j]) * s.omega[:, j] ** 2)


def _other_rate(i: int, j: int, rate: Callable[[Array], Array]) -> Rows:
    return _in_row(i, lambda t, s: t.velocity[:, i, j] * (rate(s.omega) - s.omega[:, j] ** 2))


def _product(i: int, j: int) -> Callable[[Array], Array]:
    return lambda omega: omega[:, i] * omega[:, j]


def _itself(i: int) -> Callable[[Array], Array]:
    return lambda omega: omega[:, i]


def _other_acceleration(i: int, j: int) -> Rows:
    return _in_row(i, lambda t, s: t.mass[:, i, j] * (s.alpha[:, i] - s.alpha[:, j]))


def _response(part: str, k: int) -> Rows:
    """The torques of the true equations that a change of one acceleration leaves."""

    def rows(t: Terms, measured: Measurement) -> Array:
        change = (getattr(t, part) if part else t.by_gravity + t.by_rates)[:, k]
        return -t.mass[:, :, k] * change[:, None]

    return rows


# --- As hypotheses ----------------------------------------------------------------------------------------------------


def _hypothesis(fault: TermFault, m: Mechanism) -> Hypothesis:
    def basis(p: Parameters, measured: Measurement) -> Array:
        rows = fault.rows(terms_of(measured, p), measured)
        if fault.scope:
            rows = rows * (measured.forward if fault.scope == FORWARD else ~measured.forward)[:, None]
        return np.asarray(rows[None])

    def tell(value: float, spread: float, p: Parameters, who: str) -> list[Finding]:
        return _findings(fault, 1 + value, spread, m, p, who)

    return Hypothesis(
        cause=fault.cause,
        apply=lambda base, x: base,
        names=(fault.where,),
        links=(-1,),
        sizes=np.ones(1),
        basis=basis,
        tell=tell,
        wanted=1.0 if fault.says else None,
        place=f"{fault.where} {fault.scope}",
        within=tuple(f"{where} {fault.scope}" for where in _within(fault.where)),
        known=lambda value, p: any(_named(fault, sign * (1 + value), 0.0, m, p) is not None for sign in (1, -1)),
    )


def _within(where: str) -> tuple[str, ...]:
    """The places that this one is a part of."""
    row = where.partition("[")[2].partition(",")[0]
    kind = where[:1] if row else "row" if where.startswith("row ") else ""
    return {
        "A": ("accelerations",),
        "B": ("velocity terms", f"row {row}"),
        "G": ("gravity terms",),
        "row": ("velocity terms",),
    }.get(kind, ())


def _findings(fault: TermFault, factor: float, spread: float, m: Mechanism, p: Parameters, who: str) -> list[Finding]:
    """One finding; two where a factor has a name but for its sign: two faults in one term."""
    if fault.says or fault.cause == "accelerations-scaled" or _named(fault, factor, spread, m, p) is not None:
        return [_finding(fault, factor, spread, m, p, who)]
    if _named(fault, -factor, spread, m, p) is None:
        return [_finding(fault, factor, spread, m, p, who)]
    return [_finding(fault, each, spread, m, p, who) for each in (-1.0, -factor)]


def _finding(fault: TermFault, factor: float, spread: float, m: Mechanism, p: Parameters, who: str) -> Finding:
    only = f" (in its {fault.scope} alone; its {OTHER[fault.scope]}: as expected)" if fault.scope in OTHER else ""
    if fault.says:
        return Finding(fault.cause, fault.where, None, None, f"{who}: {fault.what}: {fault.says}{only}")
    if fault.cause == "accelerations-scaled":
        factor = factor if "alone" in fault.what else 1 / factor
        sign = ": the sign is wrong" if abs(factor + 1) < KNOWN else ""
        says = f"{who}: {fault.what}{sign}: found {rounded(factor, spread)} times the expected value{only}"
        return Finding(fault.cause, fault.where, factor, 1.0, says)
    named = _named(fault, factor, spread, m, p)
    cause, words = named if named is not None else ("term-wrong", "")
    words = f"{words}: " if words else ""
    says = f"{who}: {fault.what}: {words}found {rounded(factor, spread)} times the expected value{only}"
    return Finding(cause, fault.where, factor, 1.0, says)


def _named(fault: TermFault, factor: float, spread: float, m: Mechanism, p: Parameters) -> tuple[str, str] | None:
    """The code and words of a factor; None for one that has no name."""
    if fault.says or fault.cause == "accelerations-scaled":
        return fault.cause, fault.says
    off = max(KNOWN, 30 * spread)
    known = ((value, code, says) for value, code, says in _known_factors(fault, m, p) if abs(factor / value - 1) < off)
    _, code, says = next(known, (0.0, "", ""))
    if abs(factor) < off:
        code, says = ("velocity-terms-forgotten", "they are missing") if fault.whole else ("term-missing", "missing")
    return (code, says) if code else None


def _known_factors(fault: TermFault, m: Mechanism, p: Parameters) -> Iterator[tuple[float, str, str]]:
    """Factors that have a name: their value, code and words."""
    yield -1.0, "velocity-terms-sign" if fault.whole else "sign", "the sign is wrong"
    yield 2.0, "factor-two", "there is a factor 2 too many"
    yield 0.5, "factor-half", "there is a factor ½ too many"
    size = float(np.hypot(p.gravity_along[0], p.gravity_across[0]))
    if size and "G[" in fault.what:
        yield 1 / size, "g-missing", "g is missing"
    for word, letter, values in (("length", "l", _lengths(m)), ("mass", "m", [float(x) for x in p.mass])):
        for k, value in enumerate(values):
            if value > 0 and abs(value - 1) > KNOWN:
                yield 1 / value, f"{word}-missing", f"{letter}{k + 1} is missing"
                yield value, f"{word}-too-many", f"there is one {letter}{k + 1} too many"


def _lengths(m: Mechanism) -> list[float]:
    return [link.length for link in m.links]
