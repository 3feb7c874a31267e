"""What a letter may stand for: masses, lengths, moments of inertia, forces, losses, springs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice, permutations

from .letters import Letters

Body = dict[str, str]
Bodies = list[Body]

MASS = re.compile(r"m(?!u$)\w{0,6}|M\w{0,5}|mass\w*|\w*mass")
LENGTH = re.compile(
    r"(?:[lLrRabdhs]|len|length|rope|ell)(?:\d|[pP]\w{0,4})?|len\w*|length\w*|half\w*|HALF\w*|LEN\w*|[lLr]\w"
)
CENTRE = re.compile(r"(?:[lLr]_?[cCgGm]\w{0,2}|[acdrsl]\d?|cog|com)")
INERTIA = re.compile(r"(?:[IJ]|Theta)\w{0,6}|i\d")
FORCE = re.compile(r"[FfuUP]\w{0,2}|force\w*|Force\w*|push|tau\w{0,2}|[TQ]\w?")
TORQUE = re.compile(r"(?:tau|T|u|U|Q|M|F|a|torque|motor|trq)\w{0,2}|torque\w*")
LOSS = re.compile(r"(?!cos)(?:[bcBCdDk]|mu|gamma|eta|delta|beta|nu|zeta)(?:\d|[a-zA-Z]\w{0,4})?|damp\w*|drag|fric\w*")
SPRING = re.compile(r"(?:[kKC]|kappa)\w{0,2}|stiff\w*")
REST = re.compile(r"(?:[lLrasd]|ell|rest)(?:_?[0on]|rest|nat)?|\w{0,3}[0o]|delta")
MOST_PAIRS = 12


def indexed(letters: Letters, pattern: re.Pattern[str], indices: Sequence[str]) -> list[tuple[str, ...]]:
    """The names of n quantities of one kind: m_1 and m_2, and one letter for all of them."""
    names = letters.like(pattern)
    found: list[tuple[str, ...]] = []
    for ends in dict.fromkeys([tuple(indices), *_ends(len(indices))]):
        bases = [
            name[: len(name) - len(ends[0])] for name in names if name.endswith(ends[0]) and len(name) > len(ends[0])
        ]
        found += [
            tuple(letters.names[base + end] for end in ends)
            for base in bases
            if all(base + end in letters.names for end in ends)
        ]
    found = list(dict.fromkeys(found))
    taken = {name for group in found for name in group}
    alone = [x for x in names if letters.names[x] not in taken and not x[-1].isdigit()]
    return [*found, *((letters.names[x],) * len(indices) for x in alone)]


def all_but_last(letters: Letters, pattern: re.Pattern[str], n: int) -> list[tuple[str, ...]]:
    """The lengths of a chain whose last link has a centre of mass and no length."""
    found = []
    for name in letters.like(pattern):
        first = [name[:-1] + str(k) for k in range(1, n)]
        if name.endswith("1") and all(x in letters.names for x in first) and f"{name[:-1]}{n}" not in letters.names:
            found.append((*(letters.names[x] for x in first), ""))
    return found


def _ends(n: int) -> Iterator[tuple[str, ...]]:
    yield tuple(str(k) for k in range(1, n + 1))
    yield tuple(str(k) for k in range(n))
    yield tuple("abcd"[:n])
    yield tuple("ABCD"[:n])


def pairs(letters: Letters, pattern: re.Pattern[str], usual: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    """Two different quantities of one kind, those that are usual first."""
    names = letters.like(pattern)
    found = [pair for pair in usual if all(x in letters.names for x in pair)]
    found += [pair for pair in permutations(names, 2) if pair not in found]
    return [(letters.names[x], letters.names[y]) for x, y in islice(found, MOST_PAIRS)]


def named(letters: Letters, pattern: re.Pattern[str], *, but: Sequence[str] = ()) -> list[str]:
    """The names of one kind, as they are written, those that have no value in the text first."""
    found = [name for name in letters.like(pattern) if letters.names[name] not in but]
    return [letters.names[name] for name in sorted(found, key=lambda name: name not in letters.unsaid)]


def used(bodies: Bodies) -> set[str]:
    """All quantities of bodies, their coordinates among them."""
    return {value for body in bodies for key, value in body.items() if key not in ("name", "on", "joint", "along")}
