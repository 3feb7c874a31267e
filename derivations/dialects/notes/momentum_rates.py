r"""Momenta and their rates: p_1 = ∂L/∂θ̇_1 = … and \dot p_1 = … as the row d/dt(…) = …."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .displays import Statement
from .letters import Names

_INDEX = r"(?:_\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[a-z]+|\w))?"
MOMENTUM = re.compile(rf"^\s*(?P<p>[pP]\s*{_INDEX})\s*$")
RATE = re.compile(rf"^\s*\\dot\s*(?:\{{\s*(?P<in>[pP]\s*{_INDEX})\s*\}}|(?P<bare>[pP]))\s*(?P<behind>{_INDEX})\s*$")
MOVES = re.compile(r"\\dot|[\u0307]|(?<=[\w}])['′]")


def with_momentum_rates(statements: Sequence[Statement], names: Names) -> list[Statement]:
    """The statements with rows for momenta and their rates, where every coordinate has both; else as they are.

    What stands between the equals signs, ∂L/∂θ̇, only names what is said behind.
    """
    said = {_key(m["p"]): sides[-1] for sides in statements if len(sides) > 1 and (m := MOMENTUM.match(sides[0]))}
    rates = {_key((m["in"] or m["bare"]) + m["behind"]): sides[-1] for sides in statements
             if len(sides) > 1 and (m := RATE.match(sides[0]))}  # fmt: skip
    if set(said) != set(rates) or len(said) != len(names.coordinates) or not all(map(MOVES.search, said.values())):
        return list(statements)
    kept = [sides for sides in statements if not (MOMENTUM.match(sides[0]) or RATE.match(sides[0]))]
    rows = [(rf"\frac{{d}}{{dt}}\left( {value} \right)", rates[key]) for key, value in said.items()]
    return kept + rows


def _key(name: str) -> str:
    return re.sub(r"[\s{}]", "", name)
