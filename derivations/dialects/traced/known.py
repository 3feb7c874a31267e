"""What a file says of the names in its program: coordinates, quantities, drives, and its own definitions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..names import base_and_index, plain_name
from ..statements import DOWNWARDS
from ..table import known_of

GRAVITY = frozenset((
    "g", "G", "gravity", "grav", "g0", "GRAVITY", "Gravity", "gravitational_acceleration", "grav_acc", "gr",
))  # fmt: skip
RATE_ENDS = ("dot", "d", "p", "prime", "vel", "velocity", "v", "t", "rate", "der", "D", "Dot", "1dot", "speed")
RATE_FRONTS = ("d", "D", "dot", "v", "vel", "r")
SECOND_ENDS = (
    "ddot",
    "dd",
    "dotdot",
    "2dot",
    "acc",
    "acceleration",
    "pp",
    "d2",
    "dd2",
    "accel",
    "a",
    "DDot",
    "dDot",
    "dprime",
    "Ddot",
)
SECOND_FRONTS = ("dd", "d2", "ddot", "acc", "D2", "dv", "dw")
TURNING = ("omega", "w", "om", "ω", "thetadot", "dtheta", "angvel", "Omega")
TURNING_TWICE = (
    "alpha",
    "omegadot",
    "wdot",
    "domega",
    "dw",
    "α",
    "angacc",
    "domegadt",
    "dwdt",
    "thetaacc",
    "thetadd",
    "ddtheta",
)
COUNTED_TWICE = ("acc", "accel", "acceleration")  # with an index, where no coordinate is a length
SLIDING = ("v", "vel", "velocity", "vx")
SLIDING_TWICE = ("a", "acc", "accel", "acceleration", "dv", "vdot", "dvdt", "ax")


OF_TIME = re.compile(r"\b(?:sin|cos)\b.*(?<![\w\\])t(?!\w)")
TWINS = (("theta", "th"), ("th", "theta"), ("phi", "varphi"), ("varphi", "phi"))  # where only one is declared


OF_MANY = re.compile(r"(?P<of>[\w.]+)\[\s*(?:\.\.\.|:)\s*,\s*(?P<k>[0-9]+)\s*(?::\s*(?P<last>[0-9]+)\s*)?\]")


@dataclass
class Known:
    """``coordinates``: as declared, plain; ``written``: as the rows name them; ``defined``: the file's own names."""

    coordinates: tuple[str, ...]
    written: tuple[str, ...]
    slides: tuple[bool, ...]
    quantities: frozenset[str]
    drives: tuple[str, ...]
    defined: Mapping[str, str]
    relative: bool = False
    free: frozenset[str] = field(default=frozenset())

    def is_turned(self, name: str) -> bool:
        """Whether [define] says that this gravity is counted upwards: g = '-G'."""
        return any(re.fullmatch(rf"-\s*{re.escape(name)}", text.strip()) for text in self.defined.values())

    def is_downwards(self, text: str) -> bool:
        """Whether a text has a gravity that is a negative number, and [define] does not say so."""
        found = DOWNWARDS.search(text)
        return found is not None and not any(self.is_turned(word) for word in re.findall(r"[A-Za-z_]+", found[0]))

    def is_quantity(self, name: str) -> bool:
        """Whether a body has it."""
        return (plain_name(name.strip("_")) or "") in self.quantities

    def coordinate(self, name: str) -> int | None:
        """The number of the coordinate of this name."""
        if name.endswith("_") and not name.startswith("_"):
            return None
        plain = plain_name(name.strip("_")) or ""
        for spelled in (plain, *(plain.replace(a, b, 1) for a, b in TWINS if plain.startswith(a))):
            if spelled in self.coordinates and plain not in self.quantities:
                return self.coordinates.index(spelled)
        return self.written.index(plain) if plain in self.written and plain not in self.quantities else None

    def of_rate(self, name: str, order: int) -> int | None:
        """The coordinate whose rate (order 1) or acceleration (order 2) is called so, by what stands in the name."""
        said = re.fullmatch(r"\(?\s*(?P<of>[^'()\s]+)(?P<primes>'+)\s*\)?", self.defined.get(name, name))
        if said:
            of, primes = said["of"].replace("\\", ""), len(said["primes"])
            if self.coordinate(of) is None and primes < order == 2:  # the rate of what is called a rate
                return self.of_rate(of, 1)
            return self.coordinate(of) if primes == order else None
        found = {k for k in range(len(self.coordinates)) if _is_derivative(name, self, k, order)}
        return found.pop() if len(found) == 1 else None

    def is_of_any(self, name: str) -> bool:
        """Whether a name says of no coordinate that it is its acceleration: alpha1, acc, that may mean other things."""
        return (plain_name(name.strip("_")) or name).rstrip("0123456789") in {
            *TURNING_TWICE,
            *COUNTED_TWICE,
            *SLIDING_TWICE,
        }

    def is_vector(self, name: str) -> tuple[int, tuple[int, ...]] | None:
        """The order of derivation (0, 1, 2) of a vector q, dq, ddq, and the coordinates in it; None of others."""
        parts = [base_and_index(c) or ("", "") for c in self.coordinates]
        letters = {_split(c)[0] for c in self.coordinates}
        indices = [_split(c)[1] or i for c, (_, i) in zip(self.coordinates, parts, strict=True)]
        if len(letters) != 1 or indices not in ([str(k + first) for k in range(len(parts))] for first in (0, 1)):
            return None
        letter = letters.pop()
        bare = name.replace("_", "")
        order = tuple(range(len(parts)))
        for base in (letter, "q", "theta", "th"):
            if bare == base:
                return 0, order
            if bare in {f"{base}{end}" for end in RATE_ENDS} | {f"{front}{base}" for front in RATE_FRONTS}:
                return 1, order
            if bare in {f"{base}{end}" for end in SECOND_ENDS} | {f"{front}{base}" for front in SECOND_FRONTS}:
                return 2, order
        return (1, order) if bare in ("omega", "w", "v", "qv") else None


def known(data: Mapping[str, Any]) -> Known:
    """What the fields declare."""
    found = known_of(data)
    bodies = data.get("bodies")
    bodies = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    moving = [b for b in bodies if "motion" not in b]  # a motion that is given is no part of a state
    named = [str(b.get("coordinate", "")).replace("\\", "").strip("_") for b in moving]
    written = tuple(readable(name, found.quantities) for name in named)
    define = data.get("define")
    defined = {str(k): v for k, v in define.items() if isinstance(v, str)} if isinstance(define, dict) else {}
    defined = {k: as_written(v, named, written) for k, v in defined.items()}
    defined |= {plain: v for k, v in defined.items() if (plain := _one_entry(k)) not in defined}
    slides = tuple(b.get("joint") == "slide" for b in moving)
    given = {str(b["drive"]).strip() for b in bodies if "drive" in b}
    drives = tuple(d for d in found.drives if d) if all(map(plain_name, given)) else ()
    coordinates = tuple(plain_name(name) or "" for name in named)
    said = [str(v) for v in (*defined.values(), *defined, *(b.get("coordinate", "") for b in bodies))]
    free = frozenset(w for text in said for w in re.findall(r"[^\W\d]\w*", text))
    quantities = found.quantities | _of_motions(defined)
    return Known(coordinates, written, slides, quantities, drives, defined, found.relative, free)


def _of_motions(defined: Mapping[str, str]) -> frozenset[str]:
    """a and w of a motion that is given, [define] y_s = 'a*sin(w*t)': quantities, whatever numbers they have."""
    said = [text for text in defined.values() if OF_TIME.search(text)]
    words = {w for text in said for w in re.findall(r"[^\W\d]\w*", text)} - {"t", "sin", "cos", "pi"}
    return frozenset(plain for word in words if (plain := plain_name(word)))


def _one_entry(name: str) -> str:
    """q[0] of q[..., 0:1] and q[:, 0], entries along an axis of many states; any other name as it is."""
    found = OF_MANY.fullmatch(name)
    if found is None or (found["last"] and int(found["last"]) != int(found["k"]) + 1):
        return name
    return f"{found['of']}[{found['k']}]"


def readable(name: str, taken: frozenset[str]) -> str:
    """A coordinate's name for the rows: t1 is an angle here, and the reader's t is time."""
    found = re.fullmatch(r"t_?([1-9])", name)
    return f"theta{found[1]}" if found and f"theta{found[1]}" not in taken else name


def as_written(text: str, named: Sequence[str], written: Sequence[str]) -> str:
    """What [define] says, with the coordinates as the rows have them: theta1' of t1'."""
    for name, readable_name in zip(named, written, strict=True):
        if name != readable_name:
            text = re.sub(rf"(?<![\w\\]){re.escape(name)}(?!\w)", readable_name, text)
    return text


def _split(coordinate: str) -> tuple[str, str]:
    found = re.fullmatch(r"(.*?)([0-9]*)", coordinate)
    return (found[1], found[2]) if found else (coordinate, "")


def _is_derivative(name: str, all_known: Known, k: int, order: int) -> bool:
    """Whether a name says that it is this coordinate's derivative: q1_dot, dq1, qd1, omega1, theta_."""
    letter, index = _split(all_known.coordinates[k])
    own = {*all_known.coordinates, *all_known.quantities}
    twins = [b + letter.removeprefix(a) for a, b in TWINS if letter == a and b + index not in own]
    return any(_is_derivative_of(name, all_known, k, order, x, index) for x in (letter, *twins))


def _is_derivative_of(name: str, all_known: Known, k: int, order: int, letter: str, index: str) -> bool:
    low = name.strip("_")
    if name.endswith("_") and order == 1 and not name.endswith("__"):
        return (plain_name(low) or low) == letter + index
    bare = plain_name(low) or low.replace("_", "")
    ends, fronts = (RATE_ENDS, RATE_FRONTS) if order == 1 else (SECOND_ENDS, SECOND_FRONTS)
    spelled = {f"{letter}{index}{end}" for end in ends} | {f"{letter}{end}{index}" for end in ends}
    spelled |= {f"{front}{letter}{index}" for front in fronts} | {
        f"{front}{index}{letter}" for front in fronts if index
    }
    if order == 1:
        spelled |= {f"d{letter}{index}dt", f"dot{letter}{index}"}
    else:
        spelled |= {f"d{letter}{index}dotdt", f"d2{letter}{index}dt2", f"d{letter}dot{index}", f"d{letter}{index}dot",
                    f"{letter}{index}dotdt", f"d{letter}d{index}", f"d{letter}{index}d"}  # fmt: skip
    slide = all_known.slides[k]
    alone = sum(s == slide for s in all_known.slides) == 1
    words = (SLIDING if slide else TURNING) if order == 1 else (SLIDING_TWICE if slide else TURNING_TWICE)
    if not slide and index and not any(all_known.slides):
        spelled |= {f"{word}{index}" for word in (*words, *(COUNTED_TWICE if order == 2 else ()))}
    if alone:
        spelled |= set(words)
    if alone and order == 1 and not slide:
        spelled |= {"thetad", "thd"}
    taken = {*all_known.coordinates, *all_known.quantities}
    return bare in spelled - taken
