# ruff: noqa: E501 -- patterns stand on one line
"""Steps of a simulation among a function's statements: theta += omega*dt says what the rate is, omega += … what moves it."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence

from ....models.errors import InvalidInput
from ..languages.program import RETURN, Statement
from ..markup.calls import closing, parts_of

STEP = r"(?:dt|h|delta|deltaTime|timestep|timeStep|time_step|DT|dT|step|Time\.deltaTime|Time\.fixedDeltaTime|deltatime|elapsed|tau)"
Steps = dict[str, list[str]]


def steps_of(statements: Sequence[Statement]) -> Steps:
    """What is added to each name, as it is written."""
    made: Steps = {}
    for s in statements:
        added = {"+": s.added, "-": f"-({s.added})"}.get(s.op, "")
        if not s.op:
            found = re.fullmatch(rf"{re.escape(s.target)}\s*\+\s*(?P<added>.+)", s.value, re.DOTALL)
            added = found["added"] if found else ""
        if added:
            made.setdefault(s.target, []).append(added)
    return made


def per_step(added: str, known: Collection[str]) -> str:
    """omega of omega*dt. Raises InvalidInput for a sum, of which not every part may have the step."""
    bare, minus = added.strip(), ""
    if re.match(r"-\s*\(", bare) and closing(bare, bare.index("(")) == len(bare) - 1:
        minus, bare = "-", bare[bare.index("(") :]
    while bare[:1] == "(" and closing(bare, 0) == len(bare) - 1:
        bare = bare[1:-1].strip()
    step = rf"(?!(?:{'|'.join(map(re.escape, sorted(known))) or '$^'})\b){STEP}"
    behind = re.fullmatch(rf"(?P<x>.+?)\s*\*\s*{step}", bare, re.DOTALL)
    before = re.fullmatch(rf"{step}\s*\*\s*(?P<x>.+)", bare, re.DOTALL)
    inner = behind["x"] if behind else before["x"] if before else bare
    sums = parts_of(re.sub(r"(?<=[\w)\]])\s*[-+]\s*", ",", inner), ",")
    if (behind or before) and len(sums) > 1:
        raise InvalidInput(f"{added[:30]!r}: a step of a sum; give the acceleration a name of its own")
    return f"-({inner.strip()})" if minus else inner.strip()


def without_steps(statements: Sequence[Statement], steps: Mapping[str, list[str]], rates: Sequence[str],
                  changed: Collection[str], known: Collection[str]) -> list[Statement]:  # fmt: skip
    """The statements with a name for each acceleration where its rate is changed, and without what else changes.

    Raises InvalidInput where something is computed from a coordinate or a rate that was changed before.
    """
    made: list[Statement] = []
    stale: set[str] = set()
    for s in statements:
        is_step = s.target in steps and s.target in changed
        used = set(re.findall(r"[^\W\d]\w*", steps[s.target][0] if is_step else s.value))
        if is_step and s.target in rates:
            if used & stale:
                raise InvalidInput(
                    f"{s.target} is computed from {min(used & stale)} after that was changed; compute first, step then"
                )
            made.append(Statement(f"moves{s.target}", per_step(steps[s.target][0], known)))
        if is_step:
            stale.add(s.target)
        elif s.target in changed:
            continue
        elif used & stale and s.target != RETURN:
            stale.add(s.target)  # of the next step, or of what is drawn
        else:
            stale.discard(s.target)
            made.append(s)
    return made


def check_changes(statements: Sequence[Statement], steps: Mapping[str, list[str]], changed: Collection[str]) -> None:
    """Raises InvalidInput where a coordinate or a rate is given anything but its own step, a start, or a name."""
    for s in statements:
        if s.target not in changed:
            continue
        if s.target in steps:
            if len(steps[s.target]) > 1 or not (
                s.op in ("+", "-") or re.match(rf"{re.escape(s.target)}\s*\+", s.value)
            ):
                raise InvalidInput(f"{s.target} is changed more than once; give the equations alone")
            continue
        value = s.value.strip()
        last = re.split(r"->|\.", value)[-1]
        says_name = last.isidentifier() and (
            last == s.target or last not in {*changed, *(o.target for o in statements)}
        )
        if not (re.fullmatch(r"[-+0-9.]+", value) or says_name or re.fullmatch(r"\w+\s*[\[(]\s*\w+\s*[\])]", value)):
            raise InvalidInput(f"{s.target} = {value[:30]}: a coordinate or a rate is changed besides its equation; "
                               "leave that line out")  # fmt: skip
