"""A whole function of a program, as rows: its state is taken apart, its lines are followed, what it returns is read.

``theta1, z1, theta2, z2 = y … return z1, a, z2, b`` says that z1 is the rate of theta1, and a its acceleration: what is
returned at a coordinate's place is its rate. Lines become definitions, so that the reader sees expressions alone.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...models.errors import InvalidInput
from .lines import BLANKS
from .names import plain_name
from .statements import function_of, is_program, split

WORDS = re.compile(
    r"(?<![\w.'\"])(?P<name>[A-Za-z_α-ωΑ-Ωϕ][A-Za-z0-9_α-ωΑ-Ωϕ₀-₉]*)(?P<of>(?:\.[A-Za-z_]\w*)*)(?P<at>\s*\[\s*['\"]?[\w:\s-]{1,24}['\"]?\s*\]|\(\s*\d\s*\))?"
)
MODULES = ("np", "numpy", "math", "Math", "std", "sp", "sympy", "jnp", "torch", "cmath")
FUNCTIONS = (
    "sin",
    "cos",
    "tan",
    "sqrt",
    "pow",
    "power",
    "square",
    "sign",
    "sgn",
    "abs",
    "inv",
    "solve",
    "linalg",
    "pi",
)
ARRAY = re.compile(r"^(?:np\.|numpy\.|jnp\.)?(?:array|asarray|hstack|concatenate|r_|vec!|list|tuple)?\s*(?=[\[(])")
TIMES = ("t", "time", "_", "_t", "~")  # what solvers give besides the state
ADVICE = "return the rates and the accelerations in the state's order, as in return w1, w2, a1, a2"


@dataclass(frozen=True)
class Place:
    """The place of the state that a name stands for, from 0."""

    at: int


@dataclass(frozen=True)
class Entry:
    """An entry of a vector that is an expression, as of solve(M, b)."""

    of: str
    at: int


Value = "str | Place | Entry | list[Value]"


@dataclass
class _Follower:
    """``here``: what each name stands for; ``labels``: the author's name of each place of the state."""

    size: int
    here: dict[str, Any] = field(default_factory=dict)
    labels: dict[int, str] = field(default_factory=dict)
    lines: dict[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    base: int = 0  # of what stands in square brackets
    prefix: str = "val"  # of the names of lines; no name of the author's begins so

    def assign(self, target: str, text: str) -> None:
        """Follow one assignment."""
        entry = re.fullmatch(r"(?P<name>\w{1,40})\s*(?P<open>[\[(])\s*(?P<k>\d)\s*[\])]", target.strip())
        if entry:
            first = 1 if entry["open"] == "(" else self.base
            self.put_entry(entry["name"], int(entry["k"]) - first, self.value(text))
            return
        names = _names(target)
        if self.is_quantity_of(target.strip(), text):  # m1 = par(1): the name is what matters
            self.here.pop(target.strip(), None)
            return
        if len(names) == 1 and not target.strip().endswith(","):
            self.put(names[0], self.value(text))
            return
        if text.strip() in self.parameters and not self.is_state(text.strip()):  # M, m, l, g = p
            for name in names:
                self.here.pop(name, None)
            return
        value = self.value(text)
        if isinstance(value, str) and not _is_list(value):
            value = [Entry(value, k) for k in range(len(names))]
        if not isinstance(value, list) or len(value) != len(names):
            raise InvalidInput(f"{target[:40]!r}: {len(names)} names, and not as many values behind the equals sign")
        for name, one in zip(names, value, strict=True):
            self.put(name, one)

    def is_quantity_of(self, name: str, text: str) -> bool:
        """Whether a name that says nothing of the state yet is an entry of a parameter besides the state."""
        found = re.fullmatch(r"(?P<of>\w{1,24})\s*[\[(]\s*\d{1,2}\s*[\])]", text.strip())
        is_new = re.fullmatch(r"[A-Za-z]\w{0,24}", name) is not None and name not in (*self.labels.values(), *self.here)
        return is_new and found is not None and found["of"] in self.parameters and not self.is_state(found["of"])

    def put_entry(self, name: str, at: int, value: Any) -> None:
        """dydx[0] = …: the entries of a list that is filled one after another."""
        if name in self.parameters:
            raise InvalidInput(f"{name}[{at}]: the state itself is changed; give each value a name of its own")
        values = self.here.get(name)
        if not isinstance(values, list) or (any(isinstance(v, Place) for v in values) and len(values) == self.size):
            values = []
        if at != len(values):
            raise InvalidInput(f"{name}: entry {at} is filled before those in front of it; fill them in order")
        if isinstance(value, list):
            raise InvalidInput(f"{name}[{at}]: a list stands where a number is needed")
        self.here[name] = [*values, value]

    def put(self, name: str, value: Any) -> None:
        if not re.fullmatch(r"(?:self\.)?[A-Za-z_α-ωΑ-Ωϕ][A-Za-z0-9_α-ωΑ-Ωϕ₀-₉]{0,40}", name):
            raise InvalidInput(f"{name[:40]!r}: a name is needed on the left of an assignment; entries are not changed")
        if isinstance(value, Place):
            self.labels.setdefault(value.at, name)
        if isinstance(value, list):  # th = y[:2]
            for k, one in enumerate(value, 1):
                if isinstance(one, Place):
                    self.labels.setdefault(one.at, f"{name}{k}")
        if isinstance(value, str):
            if value.strip() == name or (
                re.fullmatch(r"[0-9.]+(?:[eE][+-]?[0-9]+)?", value.strip()) and _is_quantity(name)
            ):
                self.here.pop(name, None)  # m1 = p['m1'], g = 9.81: what is right for every value is right for it
                return
            if not re.fullmatch(r"[A-Za-z]\w*|[0-9.]+", value.strip()):
                own = f"{self.prefix}{len(self.lines) + 1}"
                self.lines[own] = value
                value = own
        self.here[name] = value

    def value(self, text: str) -> Any:
        """What an expression is: a list, a place of the state, an entry of a vector, or text."""
        text = text.strip()
        inner = _inside(text)
        if inner is not None and ";" in inner:  # MATLAB's column; a matrix stays text, for the reader
            values = [self.value(part) for part in split(inner, ";")]
            if all(isinstance(v, Place) for v in values):
                return values
        elif inner is not None:
            values = [self.value(part) for part in split(inner, ",")]
            if not any(isinstance(v, list) for v in values):
                return values
        parts = split(text, ",")
        if len(parts) > 1:
            return [self.value(part) for part in parts]
        found = WORDS.fullmatch(text)
        if found:
            return self.word(found)
        return self.expression(text)

    def returned(self, text: str) -> Any:
        """What is returned, with all lists within it one behind another."""
        inner = _inside(text.strip())
        if inner is None:
            found = self.value(text)
            return self.flat(found) if isinstance(found, list) else found
        return self.flat([self.returned(part.removeprefix("*")) for part in split(inner, ",;")])

    def flat(self, values: list[Any]) -> list[Any]:
        return [one for v in values for one in (self.flat(v) if isinstance(v, list) else [v])]

    def expression(self, text: str) -> str:
        """The text with what its names stand for."""
        text = re.sub(r"\.(?=[*/^])", "", text).replace("\\", "⧵")  # MATLAB's division from the left
        text = re.sub(r"(?<=[\w)\]])\.dot\s*\(", "@(", text)
        return WORDS.sub(lambda found: self.written(self.word(found)), text)

    def word(self, found: re.Match[str]) -> Any:  # noqa: PLR0911 -- one for each kind of word
        name, of, at = found["name"], found["of"], (found["at"] or "").strip()
        if name in MODULES or (name in FUNCTIONS and name not in self.here and not of):
            return found[0]
        if name in ("self", "this") and of:
            return self.here.get("self" + of, of[1:]) if not at else of[1:] + at
        if name not in self.here:
            if name in self.parameters and (of or re.search(r"['\"]", at)):
                return of[1:] if of else re.sub(r"\W", "", at)
            if name in self.parameters and at and self.is_state(name):
                return _entry([Place(k) for k in range(self.size)], at, name, self.base)
            if name in self.parameters and self.is_state(name):
                return [Place(k) for k in range(self.size)]
            return found[0]
        value = self.here[name]
        if of:
            raise InvalidInput(f"{found[0][:40]!r}: this is not followed; write functions before arguments, and no .T")
        return _entry(value, at, name, self.base) if at else value

    def is_state(self, name: str) -> bool:
        """Whether a parameter is the state: it is no time, and the first besides that."""
        others = [p for p in self.parameters if p not in TIMES]
        return bool(others) and others[0] == name

    def written(self, value: Any) -> str:
        match value:
            case Place(at=at):
                return f"«{at}»"
            case Entry():
                raise InvalidInput("one entry of a vector within an expression; write out what it is")
            case list():
                return "[" + ", ".join(self.written(v) for v in value) + "]"
        return str(value)


def whole_functions(data: dict[str, Any], count: int, coordinates: Sequence[str]) -> dict[str, Any]:
    """The fields with rows in place of a function. ``count``: the angles; ``coordinates``: as they are declared."""
    table = data.get("equations")
    entries = list(table.values()) if isinstance(table, dict) else table if isinstance(table, list) else []
    if (
        len(entries) != 1
        or not isinstance(entries[0], str)
        or BLANKS.search(entries[0])
        or not is_program(entries[0])
        or not 1 <= count <= 8
    ):
        return data
    define = data.get("define", {})
    if not isinstance(define, dict) or not all(isinstance(v, str) for v in define.values()):
        return data
    try:
        return data | _rows(entries[0], count, coordinates, define)
    except InvalidInput as error:
        raise InvalidInput(f"equations.1: {error}") from None


def _rows(text: str, count: int, coordinates: Sequence[str], define: Mapping[str, str]) -> dict[str, Any]:
    function = function_of(text)
    follower = _Follower(2 * count)
    follower.prefix = next((word for word in ("val", "line", "part") if word not in text), "quantity")
    follower.parameters = tuple(p for p in function.parameters if not p.startswith("["))
    for parameter in function.parameters:
        if parameter.startswith("["):
            taken_apart = split(parameter[1:-1], ",")
            follower.here |= {name: Place(k) for k, name in enumerate(taken_apart)}
            follower.labels |= dict(enumerate(taken_apart))
    assigned, last = list(function.assigned), function.returned
    others = [name for name in function.parameters if name not in TIMES]
    if last in others and len(others) > 1:  # du of Julia, dydt[] of C
        follower.parameters = tuple(p for p in follower.parameters if p != last)
        places = [int(m[1]) for target, _ in assigned if (m := re.match(rf"{last}\s*\[\s*(\d)\s*\]$", target))]
        follower.base = 1 if min(places, default=0) == 1 else 0
    if assigned and assigned[-1][0] == last:
        last = assigned.pop()[1]
    for target, value in assigned:
        follower.assign(target, value)
    returned = follower.returned(last)
    pairs, accelerations = _paired(returned, count)
    names = _coordinates(follower.labels, define, [c for c, _ in pairs], coordinates, count)
    words = {c: names[c] for c, _ in pairs} | {r: f"({names[c]}')" for c, r in pairs}

    def said(line: str) -> str:
        return re.sub(r"«(\d+)»", lambda found: words[int(found[1])], line)

    if isinstance(accelerations, str):
        left = "[" + ", ".join(f"{names[c]}''" for c, _ in pairs) + "]"
        rows = {"1": f"{left} = {said(accelerations)}"}
    else:
        rows = {str(k): f"{names[c]}'' = {said(follower.written(accelerations[k - 1]))}"
                for k, (c, _) in enumerate(pairs, 1)}  # fmt: skip
    kept = {name: line for name, line in define.items() if not re.fullmatch(r"\w+\s*[\[(]\s*\d\s*[\])]", name)}
    made = {name: said(line) for name, line in _needed(follower.lines, " ".join(rows.values())).items()}
    return {"equations": rows, "define": {**kept, **made}}


def _needed(lines: Mapping[str, str], text: str) -> dict[str, str]:
    """The lines that the text uses, or that one of these does, in order."""
    kept: dict[str, str] = {}
    for name, line in reversed(list(lines.items())):
        if re.search(rf"\b{name}\b", text):
            kept[name] = line
            text += " " + line
    return dict(reversed(list(kept.items())))


def _paired(returned: Any, count: int) -> tuple[list[tuple[int, int]], Any]:
    """(place of a coordinate, place of its rate), and the accelerations in that order, or the text of their vector."""
    if not isinstance(returned, list):
        raise InvalidInput(f"what the function returns is no list; {ADVICE}")
    if len(returned) == count + 1 and isinstance(returned[count], str) and count > 1:
        returned = [*returned[:count], *(Entry(returned[count], k) for k in range(count))]
    if len(returned) != 2 * count:
        raise InvalidInput(f"the function returns {len(returned)} values for {count} coordinates; {ADVICE}")
    pairs = [(at, value.at) for at, value in enumerate(returned) if isinstance(value, Place)]
    places = sorted(p for pair in pairs for p in pair)
    if len(pairs) != count or places != list(range(2 * count)):
        raise InvalidInput(f"which values of the state are rates is not plain from what is returned; {ADVICE}")
    accelerations = [returned[rate] for _, rate in pairs]
    if any(isinstance(a, Entry) for a in accelerations):
        texts = {a.of for a in accelerations if isinstance(a, Entry)}
        if len(texts) != 1 or [getattr(a, "at", -1) for a in accelerations] != list(range(count)):
            raise InvalidInput("the entries of a vector are returned in another order than the state's; write them out")
        return pairs, texts.pop()
    return pairs, accelerations


def _coordinates(
    labels: Mapping[int, str], define: Mapping[str, str], places: list[int], coordinates: Sequence[str], count: int
) -> dict[int, str]:
    """The reader's name of the coordinate at each place. Raises InvalidInput where it is not certain."""
    said = dict(labels)
    for name, value in define.items():
        found = re.fullmatch(r"\w+\s*(?P<open>[\[(])\s*(?P<k>\d)\s*[\])]", name)
        if found:
            said[int(found["k"]) - (found["open"] == "(")] = value
    plain = {place: plain_name(said.get(place, "")) or "" for place in places}
    if coordinates:
        known = {plain_name(c) or c: c.replace("\\", "") for c in coordinates}
        made = {place: known[name] for place, name in plain.items() if name in known}
        left, free = [p for p in places if p not in made], [c for c in known.values() if c not in made.values()]
        if len(left) == len(free) == 1 and plain[left[0]]:
            made |= {left[0]: free[0]}
    else:
        made = {place: f"theta{name[-1]}" for place, name in plain.items()
                if re.fullmatch(r"(?:theta|th|t|phi|varphi|q|psi|alpha|a|x|angle)[1-9]", name)
                and int(name[-1]) <= count}  # fmt: skip
        if count == 1 and len(places) == 1:
            made = {places[0]: "theta1"}
    if len(set(made.values())) != count:
        unknown = ", ".join(said.get(p, f"place {p + 1} of the state") for p in places if p not in made)
        raise InvalidInput(
            f"which coordinate is {unknown or 'which'}? Give the function's state the names of the coordinates, as in "
            "theta1, theta2, w1, w2 = y, or say it, as in [define] 'y[0]' = \"theta1\""
        )
    return made


def _names(target: str) -> list[str]:
    bare = target.strip()
    if bare[:1] in "([{" and bare[-1:] in ")]}":
        bare = bare[1:-1]
    return split(bare, ",")


def _inside(text: str) -> str | None:
    """What stands between the brackets of a list, or of what makes an array of one."""
    found = ARRAY.match(text)
    start = found.end() if found else 0
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0:
            break
    else:
        return None
    if start >= len(text) or at != len(text) - 1:
        return None
    inner = text[start + 1 : at].strip()
    if text[start] == "[":
        return inner
    if start and inner[:1] in "[(":  # np.array([…]), with a type behind or not
        return _inside(split(inner, ",")[0])
    return inner if not start and len(split(inner, ",")) > 1 else None


def _is_list(text: str) -> bool:
    return text.startswith("[")


def _is_quantity(name: str) -> bool:
    """Whether a name with a number is a mass, a length or so: the number says nothing of the mechanics."""
    return re.fullmatch(r"(?:[mMlLgGIJkb]|lc|Lc)_?\d?", name) is not None


def _entry(value: Any, at: str, name: str, base: int = 0) -> Any:
    """x[0], x(1), x[:2] of a list."""
    inner = at[1:-1].strip()
    if isinstance(value, list):
        if re.fullmatch(r"-?\d", inner):
            k = int(inner) - (1 if at[0] == "(" else base)
            if (not base or k >= 0) and -len(value) <= k < len(value):
                return value[k]
        part = re.fullmatch(r"(\d?)\s*:\s*(\d?)", inner)
        if part and at[0] == "[" and not base:
            return value[int(part[1]) if part[1] else None : int(part[2]) if part[2] else None]
    elif isinstance(value, str) and re.fullmatch(r"\d", inner):
        return Entry(value, int(inner) - (1 if at[0] == "(" else base))
    if at[0] == "(":
        raise InvalidInput(f"{name}{at[:20]}: this is no entry of the state; write * for a product")
    raise InvalidInput(f"{name}{at[:20]}: this entry is not followed; write out what it is")
