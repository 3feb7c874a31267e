"""A usual mechanism by its name, and a text that has other letters, or more: of a force, a loss, a moment of inertia.

A cart-pole whose rows have F, b and I is the named one with a force, a loss and an inertia, where it is right for that;
what it is right for is said then, with every letter. It is wrong only where it is wrong for all that its letters may
stand for, and in terms that have none of them in it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ...dialects.names import plain_name
from ..grade_record import Grade

ADDED = ("inertia", "damping", "drive", "spring")
NAME = re.compile(r"[A-Za-z]\w*")


def is_text(data: Mapping[str, Any]) -> bool:
    """Whether these fields are one text about a mechanism that has a name."""
    in_one = isinstance(data.get("equations"), str) or isinstance(data.get("lagrangian"), str)
    return in_one and not {"bodies", "links"} & data.keys()


def is_own(bodies: Sequence[Mapping[str, Any]]) -> bool:
    """Whether it is the named mechanism and no kin: point masses, but where the text has a letter of an inertia."""
    quantities = [body[name] for body in bodies for name in ("mass", "length", "centre", "inertia") if name in body]
    return all(plain_name(value) is not None for value in quantities)


def is_told_apart(nearest: Sequence[tuple[Grade, Sequence[Mapping[str, Any]]]]) -> bool:
    """Whether all of these grades say the same mistakes, in terms with none of the letters whose role is tried."""
    causes = {tuple(sorted({f.cause for f in made.findings})) for made, _ in nearest}
    added = {plain_name(body[name]) for _, bodies in nearest for body in bodies for name in ADDED if name in body}
    terms = [f"{f.term} {f.found} {f.expected}" for made, _ in nearest for f in made.findings]
    used = {plain_name(word) for term in terms for word in NAME.findall(term)}
    return bool(terms) and len(causes) == 1 and not used & added
