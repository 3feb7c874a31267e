"""Reads a derivation that is stated stage by stage: positions, velocities, energies, Lagrangian, rows, solved rows.

kinetic = "T = …"          # also potential, lagrangian, hamiltonian; all of them before the first table
[positions]                # of the centres of mass: x1, y1, x2, …; x, y where one body has mass
x1 = "l1 sin θ1"
[velocities]               # x1, y1, … as well, or v1^2, the square of a speed
[momenta]                  # p1, p2, …
[equations]
[solved]                   # rows again, solved for the accelerations
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from ....models.errors import InvalidInput
from ...algebra.quotient import Budget, TooLarge
from ...algebra.trig import Formula
from ...steps.first_order import WORK, substituted
from ...steps.stages import STAGES, Component, Stages
from ..submission import Reader, Submission
from .hamilton import read_hamilton, split_equations

COMPONENT = re.compile(r"v?(?P<axis>[xyXY])(?P<body>[1-9][0-9]?)?|v(?P<speed>[1-9][0-9]?)?(?:\^2|\*\*2|sq|²)")
DECORATION = re.compile(r"\\(?:left|right|dot|mathrm|vec)|dot|[{}_\\\s'′()]|d(?=[xyXY])|\bt\b")
MOST_COMPONENTS = 80
PLAIN = (["equations"], ["lagrangian"], ["hamiltonian"])


def is_staged(data: dict[str, Any], links: int) -> bool:
    """Whether these fields are more than one statement of the equations of motion."""
    found: list[str] = [stage for stage in STAGES if stage in data]
    if found == ["momenta", "equations"]:  # the momenta, and their derivatives
        return not isinstance(data["equations"], dict | list) or len(data["equations"]) > links
    return bool(found) and found not in PLAIN


def read_stages(data: dict[str, Any], reader: Reader) -> Submission:
    """Read the fields of such a derivation."""
    components = {name: _components(data.get(name, {}), name, reader) for name in ("positions", "velocities")}

    def energy(name: str, label: str) -> Formula | None:
        return reader.formula(name, label, data[name]) if name in data else None

    stated = Stages(
        components["positions"], components["velocities"], energy("kinetic", "T"), energy("potential", "U"),
        energy("lagrangian", "L"),
    )  # fmt: skip
    try:
        stated = _momenta(data, reader, stated)
    except TooLarge:
        raise InvalidInput("with the momenta eliminated, this has too many terms; leave the momenta out") from None
    solved = reader.rows(data["solved"], "solved") if "solved" in data else ()
    return replace(reader.submission((), None), stages=replace(stated, solved=solved))


def _momenta(data: dict[str, Any], reader: Reader, stated: Stages) -> Stages:
    """With the Hamiltonian, the momenta and the rows, all in coordinates and rates."""
    space = reader.evaluation.space
    if "hamiltonian" in data:
        # read by itself: what is said of the momenta besides is held against it
        found = read_hamilton({"hamiltonian": data["hamiltonian"]}, reader)
        stated = replace(stated, hamiltonian=found.lagrangian, first_order=found.first_order)
    if "momenta" in data:
        stated = replace(stated, momenta=tuple(reader.momenta(data["momenta"])))
    if "equations" not in data:
        return stated
    rows = reader.rows(data["equations"])
    if reader.variable is None or reader.variable.kind != "momentum":
        return replace(stated, equations=rows)
    made = split_equations(reader, rows, stated.momenta, stated.first_order)
    if made is None:  # rows without momenta
        return replace(stated, equations=rows)
    if not stated.momenta:  # the relations are what says what the momenta are
        return replace(stated, equations=made.rows)
    budget = Budget(WORK)
    values = dict(zip(made.at.momenta, made.momenta.above, strict=True))
    rates = tuple(
        (label, substituted(space, f, values, dict.fromkeys(values, 1), made.momenta.below, budget))
        for label, f in made.relations
    )
    return replace(stated, equations=made.rows, rates=rates)


def _components(table: object, where: str, reader: Reader) -> dict[Component, Formula]:
    if not isinstance(table, dict) or len(table) > MOST_COMPONENTS:
        raise InvalidInput(f'{where}: a table of components is needed, as in x1 = "l1*sin(t1)"')
    found: dict[Component, Formula] = {}
    for name, line in table.items():
        component = _component(name, where, reader)
        if component in found:
            raise InvalidInput(f"{where}.{name!s:.20}: given twice")
        found[component] = reader.formula(f"{where}.{name!s:.20}", str(name)[:20], line)
    return found


def _component(name: str, where: str, reader: Reader) -> Component:
    found = COMPONENT.fullmatch(DECORATION.sub("", name))
    squared = found is not None and found["axis"] is None
    if found is None or (squared and where == "positions"):
        raise InvalidInput(f"{where}.{name!s:.20}: not known; give x1, y1, x2, … of the centres of mass"
                           + (", or v1^2 for the square of a speed" if where == "velocities" else ""))  # fmt: skip
    massive = _massive(reader)
    written = found["body"] or found["speed"]
    if written is None and len(massive) > 1:
        raise InvalidInput(f"{where}.{name!s:.20}: which of the {len(massive)} bodies is it? They are counted from 1")
    bodies = massive if len(massive) == 1 else list(range(reader.evaluation.space.n))
    body = int(written or 1) - 1
    if body >= len(bodies):
        raise InvalidInput(f"{where}.{name!s:.20}: body {body + 1}, and there are {len(bodies)}")
    return ("v" if squared else str(found["axis"]).lower()), bodies[body]


def _massive(reader: Reader) -> list[int]:
    """The bodies that have mass."""
    if reader.mechanism is None:
        return list(range(reader.evaluation.space.n))
    return [k for k, body in enumerate(reader.mechanism.bodies) if body.mass]
