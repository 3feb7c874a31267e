"""A derivation that does not say which mechanism it is about: the usual ones, and what its author is told.

It is right if it is right for one of these, and then that mechanism is said. It is never called wrong: which mechanism
was meant is not known then.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from ....models.errors import InvalidInput
from ...dialects.names import plain_name
from ...reading.declaration import PRESETS, WORDS
from ...reading.submission import Submission
from ..grade_record import Grade
from ..hypotheses import Said

# The likeliest first: of those for which a derivation is right without a condition, the first is meant.
NAMED: tuple[Mapping[str, Any], ...] = tuple({"system": name} for name in (*WORDS, *PRESETS))
COUNTED: tuple[Mapping[str, Any], ...] = (
    *({"system": "n-leg", "links": n} for n in (3, 4)),
    *({"system": kind, "links": n} for kind in ("rods", "rod-chain", "links", "point-masses") for n in (1, 2, 3, 4)),
)
MOST_SHOWN = 2  # mistakes, in a refusal
MOST_SAID = 240  # characters of what is wrong, or of why it cannot be read
SAY = (
    f"Say which: --system {', '.join((*WORDS, *PRESETS))}; or n-leg, rods, rod-chain, links or point-masses with "
    "--links N. Any other is declared in a TOML file."
)


def is_unnamed(data: Mapping[str, Any]) -> bool:
    """Whether these fields of a derivation do not say which mechanism it is about."""
    return "system" not in data and "links" not in data


def usual(counts: frozenset[int]) -> tuple[list[Mapping[str, Any]], list[Mapping[str, Any]]]:
    """Those that have a name and as many coordinates, if it is known how many; and the others."""
    first = [x for x in NAMED if not counts or _count(x) in counts]
    return first, [x for x in (*COUNTED, *NAMED) if x not in first]


def _count(about: Mapping[str, Any]) -> int:
    name = about["system"]
    return len(PRESETS[name]) if name in PRESETS else WORDS[name][1] if name in WORDS else about["links"]


def joints_of(about: Mapping[str, Any]) -> list[str] | None:
    """The joints of a usual mechanism, or of bodies that are declared; None of others."""
    name = str(about.get("system"))
    bodies = PRESETS.get(name) or about.get("bodies")
    if isinstance(bodies, list):
        return [_joint(body) for body in bodies if isinstance(body, dict)]
    return ["hinge "] * WORDS[name][1] if name in WORDS else None


def _joint(body: Mapping[str, Any]) -> str:
    joint = body.get("joint", "hinge")
    way = body.get("along", "right") if joint == "slide" else ""
    return f"{joint} {way}{' given' if 'motion' in body else ''}{body.get('on', '')}"


def says_all(s: Submission, data: Mapping[str, Any]) -> bool:
    """Whether no row, and no part of an energy, is left aside because a motion is taken as given."""
    given = () if s.mechanism is None else [s.mechanism.coordinates[k] for k in s.mechanism.given]
    if not given:
        return True
    said = {plain_name(str(name)) for name in data.get("define", {})}
    return said.issuperset(given) or (s.lagrangian is None and len(s.rows) == s.space.n - len(given))


def said_of(right: Grade) -> Said:
    """What a derivation is right for, as what its verdict rests on."""
    return (f"it is about {right.reading.mechanism}", f"{right.reading.mechanism_ja}についての式である")


def refusal(nearest: Grade | None, name: str, refused: Sequence[str]) -> InvalidInput:
    """Why there is no verdict, and what to write.

    ``nearest``: of the mechanisms that its symbols fit, called ``name``, the grade for that in which fewest terms are
    wrong; ``refused``: why the others cannot be read so.
    """
    unsaid = "system: which mechanism it is about is not said"
    if nearest is None:
        (why, _), *_ = Counter(refused).most_common(1)
        return InvalidInput(f"{unsaid}, and as none of the usual ones it can be read: {why[:MOST_SAID]}. {SAY}")
    says = [m.says for m in nearest.mistakes] or [f.says for f in nearest.findings]
    more = f"; and {len(says) - MOST_SHOWN} more" if len(says) > MOST_SHOWN else ""
    wrong = " ".join(says[:MOST_SHOWN])[:MOST_SAID] or "its equations are others"
    return InvalidInput(
        f"{unsaid}, and it is right for none of the usual ones. If it is about {nearest.reading.mechanism} "
        f"(--system {name}), it is wrong: {wrong}{more} {SAY}"
    )
