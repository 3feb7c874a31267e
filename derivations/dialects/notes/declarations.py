r"""A mechanism's quantities as people write them: F(t), (l_1 (m_b + m_r/2))/(m_b + m_r)."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any

from ....models.errors import InvalidInput
from ..names import NO_QUANTITIES, WRITTEN, plain_name, require_one_meaning, spelling

OF_TIME = re.compile(r"\s*(?:\\left\s*)?\(\s*t\s*(?:\\right\s*)?\)")
SUM_BELOW = re.compile(r"/\s*\((?P<sum>[^()]*[+][^()]*)\)")
SUM_IN_FRACTION = re.compile(
    r"\\[dt]?frac\s*\{(?P<top>(?:[^{}]|\{[^{}]*\})*)\}\s*\{(?P<sum>(?:[^{}]|\{[^{}]*\})*\+(?:[^{}]|\{[^{}]*\})*)\}"
)
KEPT = (*NO_QUANTITIES, "coordinate")  # sums are looked for in quantities alone


def plain_declarations(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with quantities without (t), and a name for each sum in a denominator."""
    bodies = data.get("bodies")
    if not isinstance(bodies, list) or not all(isinstance(b, dict) for b in bodies):
        return data
    made = [{k: _without_time(k, v, bodies) for k, v in b.items()} for b in bodies]
    return without_sums_below(data | {"bodies": made})


def _without_time(field: str, value: Any, bodies: list[dict[str, Any]]) -> Any:
    if field in ("name", "on") or not isinstance(value, str) or not OF_TIME.search(value) or len(value) > 200:
        return value
    bare = OF_TIME.sub("", value)
    require_one_meaning(value, bare, bodies)
    return bare


def without_sums_below(data: dict[str, Any]) -> dict[str, Any]:
    """With s = a + b for a sum in a denominator, and a = s - b wherever a stands: the same, said otherwise.

    Raises InvalidInput where no part of the sum is a quantity alone that the file does not define itself.
    """
    define = data.get("define", {})
    if not isinstance(define, dict):
        return data
    bodies = [_changed(b, lambda text: SUM_IN_FRACTION.sub(r"((\g<top>)/(\g<sum>))", text)) for b in data["bodies"]]
    sums: dict[str, None] = {}
    for body in bodies:
        for field, value in body.items():
            if field not in KEPT and isinstance(value, str):
                sums |= {re.sub(r"\s", "", found["sum"]): None for found in SUM_BELOW.finditer(value)}
    new: dict[str, str] = {}
    for k, inner in enumerate(sums, 1):
        name = f"sigma_{{{k}}}"
        part, rest = _solved(name, inner, [*new, *map(str, define)])
        new[part] = rest
        bodies = [_changed(b, partial(_put, name, inner, part, rest)) for b in bodies]
    return data | {"bodies": bodies, "define": {**new, **define}} if new else data


def _changed(body: dict[str, Any], change: Callable[[str], str]) -> dict[str, Any]:
    return {k: v if k in KEPT or not isinstance(v, str) or len(v) > 200 else change(v) for k, v in body.items()}


def _put(name: str, inner: str, part: str, rest: str, text: str) -> str:
    """A quantity with the sum's name in place of the sum, and its part as what is left of that."""
    if re.sub(r"\s", "", text) == inner:
        return name
    text = SUM_BELOW.sub(lambda m: f"/{name}" if re.sub(r"\s", "", m["sum"]) == inner else m[0], text)
    return spelling(plain_name(part) or part).sub(f"({rest})", text)


def _solved(name: str, inner: str, taken: list[str]) -> tuple[str, str]:
    """A summand that is a name alone, and what it is in terms of the sum."""
    parts = inner.split("+")
    for k, part in enumerate(parts):
        own = plain_name(part)
        if own is None or WRITTEN.fullmatch(part) is None or own in map(plain_name, taken):
            continue
        others = [p for j, p in enumerate(parts) if j != k]
        if any("-" in p for p in others) or any(spelling(own).search(p) for p in others):
            continue
        return part, f"{name} - " + " - ".join(others)
    raise InvalidInput(
        "bodies: a sum in a denominator, of which no part is a quantity alone; give it a name of its own"
    )
