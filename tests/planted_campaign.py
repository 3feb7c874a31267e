"""Single mistakes planted in a derivation by sympy: 13 mechanisms, 6 forms, 4 conventions; how many are named.

    python tests/planted_campaign.py [--count 300] [--seed 1] [--only NAME] [--pairs] [--right]

Nothing of furiko derives what is graded: positions, energies and Lagrange's equations are sympy's, from the same
declaration that the file has. A mistake is planted at its step, and what follows is written in one of the forms.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp
from sympy.simplify.fu import TR8

from furiko.derivations.grading.grade import grade_text
from furiko.derivations.grading.grade_record import Grade
from furiko.models.errors import InvalidInput

g = sp.Symbol("g")
CONVENTIONS = [("down", "absolute"), ("up", "absolute"), ("horizontal", "absolute"), ("down", "relative")]
FORMS = ("rows", "solved", "matrix", "lagrangian", "energies", "momenta")


def link(name: str, mass: str, length: str, **more: str) -> dict[str, str]:
    return {"coordinate": name, "mass": mass, "length": length, **more}


ROD1 = {"centre": "l1/2", "inertia": "m1*l1**2/12"}
ROD2 = {"centre": "l2/2", "inertia": "m2*l2**2/12"}
OWN1, OWN2 = {"centre": "c1", "inertia": "I1"}, {"centre": "c2", "inertia": "I2"}
CART = {"coordinate": "x", "joint": "slide", "mass": "M"}
DAMPED1, DAMPED2 = {"damping": "b1"}, {"damping": "b2"}
MECHANISMS: dict[str, list[dict[str, str]]] = {
    "pendulum": [link("theta", "m", "l", damping="b", drive="u")],
    "physical pendulum": [link("theta", "m", "l", centre="c", inertia="I", damping="b")],
    "two bobs": [link("theta1", "m1", "l1"), link("theta2", "m2", "l2")],
    "two rods": [link("theta1", "m1", "l1", **ROD1), link("theta2", "m2", "l2", **ROD2)],
    "two links, damped": [link("theta1", "m1", "l1", **OWN1, **DAMPED1), link("theta2", "m2", "l2", **OWN2, **DAMPED2)],
    "two links, driven": [
        link("theta1", "m1", "l1", **OWN1, drive="u1"), link("theta2", "m2", "l2", **OWN2, drive="u2")
    ],
    "bobs and springs": [link("theta1", "m1", "l1", spring="k1"), link("theta2", "m2", "l2", spring="k2")],
    "three bobs": [link("theta1", "m1", "l1"), link("theta2", "m2", "l2"), link("theta3", "m3", "l3")],
    "cart and bob": [CART, link("theta", "m", "l")],
    "cart and rod, driven": [{**CART, "drive": "F", "damping": "b"}, link("theta", "m", "l", centre="c", inertia="I")],
    "cart and two bobs": [CART, link("theta1", "m1", "l1"), link("theta2", "m2", "l2")],
    "elastic pendulum": [
        {"coordinate": "theta", "mass": "0"},
        {"coordinate": "r", "joint": "slide", "along": "link", "mass": "m", "spring": "k", "rest": "r0"},
    ],
    "bob on a rod's middle": [
        link("theta", "M", "L", centre="L/2", inertia="M*L**2/12"), link("phi", "m", "l", at="L/2")
    ],
}  # fmt: skip


@dataclass
class Steps:
    """One derivation; a mistake replaces functions or values before they are used."""

    bodies: list[dict[str, str]]
    origin: str
    angles: str
    q: list[Any] = field(default_factory=list)
    v: list[Any] = field(default_factory=list)
    a: list[Any] = field(default_factory=list)
    segments: list[list[tuple[Any, Any, Any, Any]]] = field(default_factory=list)  # length, angle, rate, rate of length
    kinetic: list[Any] = field(default_factory=list)
    spin: list[Any] = field(default_factory=list)
    potential: list[Any] = field(default_factory=list)
    elastic: Any = 0
    forces: list[Any] = field(default_factory=list)
    rows: list[Any] | None = None

    @property
    def n(self) -> int:
        return len(self.bodies)


def expression(text: str) -> Any:
    return sp.sympify(text, locals={c: sp.Symbol(c) for c in "IFMLQSNE"})


def rate_of(f: Any, s: Steps) -> Any:
    return sum(sp.diff(f, x) * y for x, y in (*zip(s.q, s.v, strict=True), *zip(s.v, s.a, strict=True)))


TURN = {"down": 0, "up": sp.pi, "horizontal": sp.pi / 2}


def start(bodies: list[dict[str, str]], origin: str, angles: str) -> Steps:
    """Coordinates, ways to the centres of mass, forces."""
    s = Steps(bodies, origin, angles)
    names = [body["coordinate"] for body in bodies]
    s.q, s.v, s.a = ([sp.Symbol(prefix + name) for name in names] for prefix in ("", "R", "A"))
    for k in range(len(bodies)):
        way: list[tuple[Any, Any, Any, Any]] = []
        angle: Any = None
        rate: Any = 0
        for j in range(k + 1):
            other = bodies[j]
            if other.get("joint") == "slide":
                if other.get("along") == "link":
                    way.append((s.q[j], angle, rate, s.v[j]))
                else:
                    way.append((s.q[j], sp.pi / 2, sp.Integer(0), s.v[j]))
                continue
            relative = angles == "relative" and angle is not None
            angle = angle + s.q[j] if relative else s.q[j] + TURN[origin]
            rate = rate + s.v[j] if relative else s.v[j]
            length = other.get("length", "0")
            if j == k:
                length = other.get("centre", length)
            elif "at" in bodies[j + 1]:
                length = bodies[j + 1]["at"]
            if length != "0":
                way.append((expression(length), angle, rate, sp.Integer(0)))
        s.segments.append(way)
    s.forces = [sp.Integer(0)] * s.n
    for k, body in enumerate(bodies):
        form = own_motion(s, k)
        motion = sum(c * s.v[i] for i, c in form.items())
        at = sum(c * s.q[i] for i, c in form.items()) - expression(body.get("rest", "0"))
        s.elastic += expression(body.get("spring", "0")) * at**2 / 2
        for i, c in form.items():
            s.forces[i] += c * (expression(body.get("drive", "0")) - expression(body.get("damping", "0")) * motion)
    return s


def own_motion(s: Steps, k: int) -> dict[int, int]:
    hinges = [j for j in range(k + 1) if s.bodies[j].get("joint") != "slide"]
    if s.bodies[k].get("joint") == "slide" or s.angles == "relative" or len(hinges) < 2:
        return {k: 1}
    return {k: 1, hinges[-2]: -1}


def velocity(length: Any, angle: Any, rate: Any, slow: Any) -> tuple[Any, Any]:
    return (slow * sp.sin(angle) + length * rate * sp.cos(angle), -slow * sp.cos(angle) + length * rate * sp.sin(angle))


def energies(s: Steps) -> None:
    """Kinetic, rotational and potential energy of each body."""
    for body, way in zip(s.bodies, s.segments, strict=True):
        mass = expression(body.get("mass", "0"))
        vs = [velocity(*x) for x in way]
        s.kinetic.append(mass / 2 * (sum(x for x, _ in vs) ** 2 + sum(y for _, y in vs) ** 2))
        turning = way[-1][2] if way and body.get("joint") != "slide" else 0
        s.spin.append(expression(body.get("inertia", "0")) / 2 * turning**2)
        s.potential.append(-mass * g * sum(x[0] * sp.cos(x[1]) for x in way))


def lagrangian(s: Steps) -> Any:
    return sum(s.kinetic) + sum(s.spin) - sum(s.potential) - s.elastic


def lagrange(s: Steps) -> None:
    f = lagrangian(s)
    s.rows = [rate_of(sp.diff(f, v), s) - sp.diff(f, q) - Q for q, v, Q in zip(s.q, s.v, s.forces, strict=True)]


# Mistakes: the step before which each is made, the codes that name it, and what it does (False: not possible here) ----

Planted = tuple[str, tuple[str, ...], Callable[[Steps, random.Random], bool]]


def any_body(s: Steps, draw: random.Random, fits: Callable[[int], bool]) -> int | None:
    found = [b for b in range(s.n) if fits(b)]
    return draw.choice(found) if found else None


def half_missing(s: Steps, draw: random.Random) -> bool:
    b = any_body(s, draw, lambda b: s.kinetic[b] != 0)
    assert b is not None
    s.kinetic[b] *= 2
    return True


def inertia_missing(s: Steps, draw: random.Random) -> bool:
    b = any_body(s, draw, lambda b: s.spin[b] != 0)
    if b is None:
        return False
    s.spin[b] = 0
    return True


def inertia_own_rate(s: Steps, draw: random.Random) -> bool:
    b = any_body(s, draw, lambda b: b > 0 and s.spin[b] != 0 and len(s.segments[b]) > 1 and s.segments[b][0][2] != 0)
    if b is None:
        return False
    rate = s.v[b] if s.angles == "relative" else s.v[b] - s.v[b - 1]
    s.spin[b] = expression(s.bodies[b]["inertia"]) / 2 * rate**2
    return True


def cross_term(factor: Callable[[Any, Any, Any], Any]) -> Callable[[Steps, random.Random], bool]:
    def make(s: Steps, draw: random.Random) -> bool:
        b = any_body(s, draw, lambda b: len(s.segments[b]) > 1 and s.bodies[b].get("mass") != "0")
        if b is None:
            return False
        one, two = draw.sample(s.segments[b], 2)
        (ax, ay), (bx, by) = velocity(*one), velocity(*two)
        mass, cross = expression(s.bodies[b]["mass"]), ax * bx + ay * by
        s.kinetic[b] += mass * (factor(cross, one, two) - cross)
        return combined(factor(cross, one, two) - cross) != 0

    return make


def added_speeds(cross: Any, one: Any, two: Any) -> Any:
    return (one[0] * one[2] + one[3]) * (two[0] * two[2] + two[3])


def change_rate(relative: bool) -> Callable[[Steps, random.Random], bool]:
    def make(s: Steps, draw: random.Random) -> bool:
        if relative != (s.angles == "relative"):
            return False
        places = [(b, k) for b in range(s.n) for k, x in enumerate(s.segments[b])
                  if x[2] != 0 and (x[2] not in s.v) == relative]  # fmt: skip
        if not places:
            return False
        b, k = draw.choice(places)
        length, angle, rate, slow = s.segments[b][k]
        angles = [v for v, body in zip(s.v, s.bodies, strict=True) if body.get("joint") != "slide" and v != rate]
        if relative:
            angles = [v for v in angles if sp.diff(rate, v)]
        if not angles:
            return False
        s.segments[b][k] = (length, angle, draw.choice(angles), slow)
        return True

    return make


def potential_sign(s: Steps, draw: random.Random) -> bool:
    b = any_body(s, draw, lambda b: sp.diff(s.potential[b], g) != 0 and any(sp.diff(s.potential[b], q) for q in s.q))
    assert b is not None
    s.potential[b] = -s.potential[b]
    return True


def height_sine(s: Steps, draw: random.Random) -> bool:
    places = [
        (b, k) for b in range(s.n) for k, x in enumerate(s.segments[b]) if x[2] != 0 and s.bodies[b]["mass"] != "0"
    ]
    b, k = draw.choice(places)
    length, angle, *_ = s.segments[b][k]
    weight = expression(s.bodies[b]["mass"]) * g
    s.potential[b] += weight * length * (sp.cos(angle) - sp.sin(angle))
    return True


def gravity_without_length(s: Steps, draw: random.Random) -> bool:
    assert s.rows is not None
    rows = [
        i for i in range(s.n) if sp.diff(s.rows[i], g) != 0 and len(s.segments[i]) == 1 and s.segments[i][0][2] != 0
    ]
    if not rows:
        return False
    i = draw.choice(rows)
    part = g * sp.diff(s.rows[i], g)
    s.rows[i] += part / s.segments[i][0][0] - part
    return True


def per_row(change: Callable[[Steps, int], Any]) -> Callable[[Steps, random.Random], bool]:
    """A change of one row, computed from the energies."""

    def make(s: Steps, draw: random.Random) -> bool:
        assert s.rows is not None
        changes = {i: f for i in range(s.n) if (f := combined(change(s, i))) != 0}
        if not changes:
            return False
        i = draw.choice(sorted(changes))
        s.rows[i] += changes[i]
        return True

    return make


def convection(s: Steps, i: int) -> Any:
    momentum = sp.diff(lagrangian(s), s.v[i])
    return sum(sp.diff(momentum, q) * v for q, v in zip(s.q, s.v, strict=True))


def kinetic_slope(s: Steps, i: int) -> Any:
    return sp.diff(sum(s.kinetic) + sum(s.spin), s.q[i])


def inner_forgotten(s: Steps, i: int) -> Any:
    """d/dt cos(φ) = -sin φ, without φ̇."""
    momentum = combined(sp.diff(lagrangian(s), s.v[i]))
    total, x = sp.Integer(0), sp.Symbol("X")
    for f in momentum.atoms(sp.sin, sp.cos):
        stand_in = sp.Dummy()
        outer = sp.diff(momentum.subs(f, stand_in), stand_in)
        total += outer * sp.diff(f.func(x), x).subs(x, f.args[0]) * (1 - rate_of(f.args[0], s))
    return total


def combined(f: Any) -> Any:
    """Products of cos and sin as sums, as people write them: cos(θ1 - θ2)."""
    return sp.expand(TR8(sp.expand(f)))


def force_sign(field_: str) -> Callable[[Steps, random.Random], bool]:
    def make(s: Steps, draw: random.Random) -> bool:
        b = any_body(s, draw, lambda b: field_ in s.bodies[b])
        if b is None:
            return False
        symbol = expression(s.bodies[b][field_])
        s.forces = [f.subs(symbol, -symbol) for f in s.forces]
        return True

    return make


def damping_rate(s: Steps, draw: random.Random) -> bool:
    b = any_body(s, draw, lambda b: "damping" in s.bodies[b] and len(own_motion(s, b)) > 1)
    if b is None:
        return False
    form = own_motion(s, b)
    above = next(i for i in form if i != b)
    for i, c in form.items():
        s.forces[i] += c * expression(s.bodies[b]["damping"]) * -s.v[above]
    return True


def reaction_missing(field_: str) -> Callable[[Steps, random.Random], bool]:
    def make(s: Steps, draw: random.Random) -> bool:
        b = any_body(s, draw, lambda b: field_ in s.bodies[b] and len(own_motion(s, b)) > 1)
        if b is None:
            return False
        above = next(i for i in own_motion(s, b) if i != b)
        s.forces[above] = s.forces[above].subs(expression(s.bodies[b][field_]), 0)
        return True

    return make


def carried_missing(s: Steps, draw: random.Random) -> bool:
    assert s.rows is not None
    if any(len(x) != k + 1 for k, x in enumerate(s.segments)) or s.n < 2:
        return False
    i = draw.randrange(s.n - 1)
    own = s.kinetic[i] + s.spin[i] - s.potential[i]
    s.rows[i] += rate_of(sp.diff(own - lagrangian(s) - s.elastic, s.v[i]), s) - sp.diff(
        own - lagrangian(s) - s.elastic, s.q[i]
    )
    return True


def term_slip(kind: str) -> Callable[[Steps, random.Random], bool]:
    """One term, as it is written, with another sign, a factor, or left out."""

    def make(s: Steps, draw: random.Random) -> bool:
        assert s.rows is not None
        i = draw.randrange(s.n)
        row = combined(s.rows[i])
        parts = list(sp.Add.make_args(row))
        if len(parts) < 2:
            return False
        part = draw.choice(sorted(parts, key=str))
        s.rows[i] = row + {"sign": -2 * part, "missing": -part, "double": part}[kind]
        return True

    return make


def bracket(s: Steps, draw: random.Random) -> bool:
    """A factor that terms have in common is lost by some of them: l (a + b + c) has become l a + b + c."""
    assert s.rows is not None
    i = draw.randrange(s.n)
    row = combined(s.rows[i])
    parts = sorted(sp.Add.make_args(row), key=str)
    factors = {f for part in parts for f in part.as_powers_dict() if f.is_Symbol or isinstance(f, sp.sin | sp.cos)}
    factor = draw.choice(sorted(factors, key=str))
    having = [part for part in parts if factor in part.as_powers_dict()]
    if len(having) < 3:
        return False
    lost = draw.sample(having, draw.randrange(2, len(having)))
    s.rows[i] = row + sum(part / factor - part for part in lost)
    return True


def small_angle(s: Steps, draw: random.Random) -> bool:
    assert s.rows is not None
    if s.origin != "down" or s.angles != "absolute":
        return False
    for i in range(s.n):
        part = g * sp.diff(sp.expand(s.rows[i]), g)
        s.rows[i] += part.replace(sp.sin, lambda x: x) - part
    return any(sp.diff(row, g) for row in s.rows)


SLIP = ("sign", "term-missing", "factor-two", "part-sign", "part-missing", "part-factor", "factor-half", "factor-wrong")
MISTAKES: dict[str, Planted] = {
    "half missing in T": ("lagrangian", ("half-missing",), half_missing),
    "rotation missing": ("lagrangian", ("inertia-missing",), inertia_missing),
    "rotation with own rate": ("lagrangian", ("inertia-relative-rate",), inertia_own_rate),
    "cross term missing": ("lagrangian", ("cross-term-missing", "binomial-without-middle"),
                           cross_term(lambda cross, one, two: 0)),
    "cross term's sign": ("lagrangian", ("cross-term-sign",), cross_term(lambda cross, one, two: -cross)),
    "speeds added": ("lagrangian", ("speeds-added",), cross_term(added_speeds)),
    "rate of the other link": ("energies", ("wrong-rate-in-velocity",), change_rate(False)),
    "rates not summed": ("energies", ("rate-sum-forgotten",), change_rate(True)),
    "potential's sign": ("lagrangian", ("potential-energy-sign",), potential_sign),
    "sine in a height": ("lagrangian", ("height-sine",), height_sine),
    "velocity terms forgotten": ("rows", ("velocity-terms-forgotten",), per_row(lambda s, i: -convection(s, i))),
    "kinetic slope missing": ("rows", ("kinetic-slope-missing",), per_row(kinetic_slope)),
    "kinetic slope's sign": ("rows", ("kinetic-slope-sign",), per_row(lambda s, i: 2 * kinetic_slope(s, i))),
    "inner derivative forgotten": ("rows", ("inner-derivative-of-cosine",), per_row(inner_forgotten)),
    "drive's sign": ("forces", ("drive-sign",), force_sign("drive")),
    "damping's sign": ("forces", ("damping-sign",), force_sign("damping")),
    "damping's rate": ("forces", ("damping-rate",), damping_rate),
    "drive's reaction": ("forces", ("drive-reaction-missing",), reaction_missing("drive")),
    "damping's reaction": ("forces", ("damping-reaction-missing",), reaction_missing("damping")),
    "next link's force": ("rows", ("carried-force-missing",), carried_missing),
    "gravity lost a length": ("rows", ("factor-missing", "units"), gravity_without_length),
    "sign of a term": ("rows", SLIP, term_slip("sign")),
    "a term left out": ("rows", SLIP, term_slip("missing")),
    "a factor of two": ("rows", SLIP, term_slip("double")),
    "a bracket closed early": ("rows", ("bracket-slip",), bracket),
    "small angle early": ("rows", ("small-angle-early",), small_angle),
}  # fmt: skip


def derive(
    bodies: list[dict[str, str]], origin: str, angles: str, planted: Sequence[Planted], draw: random.Random
) -> Steps | None:
    """The derivation with the mistakes; None where one cannot be made here."""
    s = start(bodies, origin, angles)
    for step, work in (("energies", energies), ("lagrangian", None), ("forces", lagrange), ("rows", None)):
        if not all(make(s, draw) for at, _, make in planted if at == step):
            return None
        if work is not None:
            work(s)
    return s


def written(s: Steps, form: str) -> str | None:
    """The derivation in a form; None where nobody would write it so."""
    head = [f"system = 'mechanism'\nfrom = '{s.origin}'\nangles = '{s.angles}'\nsense = 'counter-clockwise'"]
    tables = ["[[bodies]]\n" + "\n".join(f"{k} = '{v.replace('**', '^')}'" for k, v in b.items()) for b in s.bodies]
    assert s.rows is not None
    rows: list[str] = []
    if form == "lagrangian":
        head.append(f"lagrangian = '''{shown(lagrangian(s))}'''")
    elif form == "energies":
        head.append(f"kinetic = '''{shown(sum(s.kinetic) + sum(s.spin))}'''")
        head.append(f"potential = '''{shown(sum(s.potential) + s.elastic)}'''")
    elif form == "rows":
        rows = [f"{shown(combined(row))} = 0" for row in s.rows]
    else:
        if s.n > 2:
            return None
        matrix = sp.Matrix([[sp.expand(sp.diff(row, a)) for a in s.a] for row in s.rows])
        rest = [sp.expand(row).subs(dict.fromkeys(s.a, 0)) for row in s.rows]
        if form == "matrix":
            entries = ", ".join("[" + ", ".join(shown(x) for x in matrix.row(i)) + "]" for i in range(s.n))
            vector = "[" + ", ".join(shown(a) for a in s.a) + "]"
            if s.n < 2:
                return None
            rows = [
                f"[{entries}] * {vector} + [{', '.join(shown(x) for x in rest)}] = [{', '.join('0' for _ in rest)}]"
            ]
        elif form == "solved":
            if matrix.det() == 0:
                return None
            solution = matrix.adjugate() * -sp.Matrix(rest)
            rows = [f"{shown(a)} = ({shown(x)})/({shown(matrix.det())})" for a, x in zip(s.a, solution, strict=True)]
        else:
            f = lagrangian(s)
            momenta = "\n".join(f"p_{q} = '''{shown(sp.diff(f, v))}'''" for q, v in zip(s.q, s.v, strict=True))
            tables.append("[momenta]\n" + momenta)
            rows = [f"p_{q}' = {shown(sp.diff(f, q) + Q)}" for q, Q in zip(s.q, s.forces, strict=True)]
    if rows:
        tables.append("[equations]\n" + "\n".join(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1)))
    return "\n".join([*head, *tables])


def shown(f: Any) -> str:
    text = re.sub(r"\bA([a-z]+[0-9]?)\b", r"\1''", str(sp.expand(f)))
    return re.sub(r"\bR([a-z]+[0-9]?)\b", r"\1'", text)


MADE_AFTER = {"lagrangian": ("forces", "rows"), "energies": ("forces", "rows"), "momenta": ("rows",)}


def named(found: Grade, planted: Planted) -> str:
    """How the answer names the mistake."""
    causes = [m.cause for m in found.mistakes] + [also for m in found.mistakes for also in m.also]
    first = [m.cause for m in found.mistakes[:1]] or [f.cause for f in found.findings]
    if set(first) & set(planted[1]):
        return "named first"
    if set(causes) & set(planted[1]):
        return "named with others for the same equations"
    if len(found.findings) == 1:
        return "one term named, which is all that differs"
    return "another mistake for the same equations" if found.mistakes else "terms alone"


def named_both(found: Grade, planted: Sequence[Planted]) -> str:
    """How the answer names two mistakes."""
    causes = [{m.cause, *m.also} for m in found.mistakes]
    wanted = [set(codes) for _, codes, _ in planted]
    terms_ = {f.cause for f in found.findings}
    if len(causes) == 2:
        pairs = [(causes[0], causes[1]), (causes[1], causes[0])]
        if any(one & wanted[0] and other & wanted[1] for one, other in pairs):
            return "both named"
        return "two others for the same equations"
    if len(causes) == 1:
        return "one mistake for the same equations"
    if len(found.findings) <= 2 and all(codes & terms_ for codes in wanted):
        return "the two terms named, which are all that differs"
    return "terms alone, no more than two" if len(found.findings) <= 2 else "terms alone"


def campaign(count: int, seed: int, only: str = "", size: int = 1) -> tuple[Counter[str], list[str], float]:
    """Random mechanisms, forms, conventions and mistakes, ``size`` in each derivation."""
    draw, tally, missed, slowest = random.Random(seed), Counter[str](), [], 0.0
    while sum(tally.values()) < count:
        name, form = draw.choice(list(MECHANISMS)), draw.choice(FORMS)
        origin, angles = draw.choice(CONVENTIONS)
        what = draw.sample(list(MISTAKES), size)
        planted = [MISTAKES[x] for x in what]
        if any(p[0] in MADE_AFTER.get(form, ()) for p in planted) or (only and not any(only in x for x in what)):
            continue
        s = derive(MECHANISMS[name], origin, angles, planted, draw)
        text = written(s, form) if s is not None else None
        if text is None:
            continue
        where = f"{name}, {form}, {origin} {angles}: {' and '.join(what)}"
        started = time.perf_counter()
        try:
            found = grade_text(text)
        except InvalidInput as error:
            tally["REFUSED"] += 1
            missed.append(f"{where}: {str(error)[:150]}")
            continue
        slowest = max(slowest, time.perf_counter() - started)
        if found.verdict != "wrong":
            right = derive(MECHANISMS[name], origin, angles, (), draw)
            same = right is not None and equivalent(s, right)
            said = "equivalent to right" if same else f"NOT DETECTED ({'; '.join(found.assumes)})"
        else:
            said = named(found, planted[0]) if size == 1 else named_both(found, planted)
        tally[said.partition(" (")[0]] += 1
        if said.startswith(("NOT", "terms", "another", "one mistake", "two others")):
            missed.append(f"{where}: {said} {[m.cause for m in found.mistakes]} {[f.says for f in found.findings][:3]}")
    return tally, missed, slowest


def equivalent(one: Steps | None, two: Steps) -> bool:
    """Whether both have the same accelerations."""
    if one is None or one.rows is None or two.rows is None:
        return False
    draw = random.Random(0)
    values = {x: sp.Rational(draw.randrange(1, 99), 7) for row in (*one.rows, *two.rows) for x in row.free_symbols}
    values = {x: f for x, f in values.items() if x not in one.a}
    solutions = []
    for s in (one, two):
        assert s.rows is not None
        rows = [row.subs(values).evalf(40) for row in s.rows]
        matrix = sp.Matrix([[sp.diff(row, a) for a in s.a] for row in rows])
        solutions.append(matrix.LUsolve(-sp.Matrix([row.subs(dict.fromkeys(s.a, 0)) for row in rows])))
    return all(abs(x - y) < 1e-25 * (1 + abs(x)) for x, y in zip(*solutions, strict=True))


def right_ones(seed: int = 1) -> list[str]:
    """Every mechanism, form and convention without a mistake: what is not called correct."""
    draw, bad = random.Random(seed), []
    for name, bodies in MECHANISMS.items():
        for origin, angles in CONVENTIONS:
            for form in FORMS:
                s = derive(bodies, origin, angles, (), draw)
                text = written(s, form) if s is not None else None
                if text is None:
                    continue
                found = grade_text(text)
                if (found.verdict, found.assumes) != ("correct", ()):
                    bad.append(f"{name}, {form}, {origin} {angles}: {found.verdict} {found.assumes}")
    return bad


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="mistakes with this in their name")
    parser.add_argument("--pairs", action="store_true", help="two mistakes in each derivation")
    parser.add_argument("--right", action="store_true", help="every right one instead")
    options = parser.parse_args()
    if options.right:
        bad = right_ones()
        print("\n".join(bad) or "every right one is called correct")
        sys.exit(bool(bad))
    tally, missed, slowest = campaign(options.count, options.seed, options.only, 2 if options.pairs else 1)
    total = sum(tally.values())
    for what, count in sorted(tally.items()):
        print(f"{count:6d}  {100 * count / total:5.1f} %  {what}")
    print(f"slowest verdict {slowest:.2f} s")
    print("\n".join(missed[:60]))


if __name__ == "__main__":
    main()
