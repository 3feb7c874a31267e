"""Whether a program's steps of coordinates and rates all have the step of time, omega += alpha*dt, or none has.

And whether a name may be an acceleration's, as alpha1 there, or is a part of other quantities: alpha1 + 2*beta*cos(q2).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass

from . import nodes
from .known import Known
from .library import JOINED, MADE, SAME
from .values import NotFollowed

STEP = re.compile(
    r"(?:self\.)?(?:dt|h|delta|deltaTime|timestep|timeStep|time_step|DT|dT|step|STEP|Time\.deltaTime|Time\.fixedDeltaTime|deltatime|elapsed|dt_|DELTA)"
)
LEAST = 3  # steps of which all but one have a factor, which is the step then
NUMBERS = frozenset(("pi", "PI", "Pi", "TWO_PI", "M_PI", "TAU"))
LOST = "{0} is stepped without {1}, which the other steps have; put it there, or give the equations alone"


def parts_in(part: object) -> Iterator[nodes.Node]:
    """An expression and all within it."""
    if isinstance(part, tuple | list):
        for one in part:
            yield from parts_in(one)
    elif is_dataclass(part) and not isinstance(part, type):
        yield part  # type: ignore[misc]
        for one in fields(part):
            yield from parts_in(getattr(part, one.name))


def require_steps(statements: Sequence[nodes.Statement], known: Known) -> None:
    """Raises NotFollowed where one of a program's steps has lost its dt."""
    found: dict[str, set[str]] = {}
    for one in parts_in(tuple(statements)):
        if isinstance(one, nodes.Assign):
            name, added = _added(one)
            if name and added is not None and _is_state(name, known):
                words = {_name(p) for p in parts_in(added) if isinstance(p, nodes.Word | nodes.Member)}
                words -= {"", *NUMBERS}
                if words and name not in words:  # theta - floor(theta/(2π))*2π is an angle that is wrapped
                    found.setdefault(name, set()).update(words)
    steps = {w for words in found.values() for w in words if _is_step(w, known)}
    if len(found) >= LEAST:
        counts = {w: sum(w in words for words in found.values()) for words in found.values() for w in words}
        steps |= {w for w, k in counts.items() if k >= len(found) - 1 and not known.is_quantity(w.rpartition(".")[2])}
    for name, words in found.items():
        if steps and not words & steps:
            raise NotFollowed(LOST.format(name, sorted(steps)[0]))


def is_a_part(name: str, statements: Sequence[nodes.Statement], known: Known) -> bool:
    """Whether a quantity that is no step and no acceleration is made of this name."""
    for one in parts_in(tuple(statements)):
        if not isinstance(one, nodes.Assign) or isinstance(one.value, nodes.Word) or _added(one)[0] == name:
            continue
        made = [x.rpartition(".")[2] for x in nodes.set_by(one.target)]
        if any(_is_state(x, known) or known.of_rate(x, 2) is not None for x in made) or stepped(one, known):
            continue
        terms = (p for p in parts_in(one.value) if isinstance(p, nodes.Binary | nodes.Unary))
        handed = [a for p in parts_in(one.value) if isinstance(p, nodes.Call) and _computes(p) for a in p.arguments]
        if any(_name(p) == name for x in (*terms, *handed) for p in parts_in(x) if isinstance(p, nodes.Word)):
            return True
    return False


def _computes(call: nodes.Call) -> bool:
    """Whether a function makes something else of its arguments than a list or a thing with parts."""
    name = (nodes.dotted(call.of) or "").rpartition(".")[2]
    return name not in MADE | JOINED | SAME and not name[:1].isupper()


def _is_step(word: str, known: Known) -> bool:
    last = word.rpartition(".")[2]
    return (STEP.fullmatch(word) or STEP.fullmatch(last)) is not None and not known.is_quantity(last)


def stepped(one: nodes.Assign, known: Known) -> tuple[str, str, nodes.Node] | None:
    """new_w, w and alpha of new_w = w + alpha*dt; None of other statements."""
    match one:
        case nodes.Assign(
            target=nodes.Word(name=new),
            value=nodes.Binary(sign="+", left=nodes.Word(name=old), right=added),
            sign="",
        ) if new != old:
            bare = _per_step(added, known)
            return None if bare is None else (new, old, bare)
    return None


def _per_step(node: nodes.Node, known: Known) -> nodes.Node | None:
    """alpha of alpha*dt or dt*alpha; None without a step."""
    if not isinstance(node, nodes.Binary) or node.sign != "*":
        return None
    if _is_step(nodes.dotted(node.right) or "", known):
        return node.left
    if _is_step(nodes.dotted(node.left) or "", known):
        return node.right
    left = _per_step(node.left, known)
    return None if left is None else nodes.Binary("*", left, node.right)


def _added(one: nodes.Assign) -> tuple[str, nodes.Node | None]:
    """The name that is stepped, and what is added."""
    name = _name(one.target)
    if one.sign in ("+", "-"):
        return name, one.value
    match one.value:
        case nodes.Binary(sign="+" | "-", left=left, right=right) if not one.sign and _name(left) == name:
            return name, right
        case nodes.Binary(sign="+", left=left, right=right) if not one.sign and _name(right) == name:
            return name, left
    return name, None


def _name(node: nodes.Node) -> str:
    """omega of self.omega; omega1 of omega1[i]."""
    if isinstance(node, nodes.At):
        node = node.of
    return (nodes.dotted(node) or "").removeprefix("self.").removeprefix("this.")


def _is_state(name: str, known: Known) -> bool:
    said = known.defined.get(name, name.rpartition(".")[2])
    return known.coordinate(said.replace("\\", "")) is not None or known.of_rate(said, 1) is not None
