"""Names of a program: what each stands for where it is used, which quantity or place of the state it is."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from .known import GRAVITY, Known
from .values import Array, Broken, Formula, Local, NotFollowed, Outside, Value

SHORT = 48  # characters of a formula that needs no name of its own
MARK = re.compile(r"«([^«»]+)»")
DECIMAL = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?")
NUMBERS_ALONE = re.compile(r"(?:(?<![A-Za-z])(?:pi|sqrt|sin|cos|tan|abs)(?![A-Za-z])|[0-9.]e|[-+*/^()0-9.\s])+")


def _is_gravity(name: str) -> bool:
    """Whether a name is that of gravity, g_ of a class too."""
    return name.strip("_") in GRAVITY


@dataclass
class Scope:
    """The names of a function that is followed. ``around``: of the functions and the text that it stands in."""

    around: Scope | None = None
    names: dict[str, Value] = field(default_factory=dict)
    parameters: frozenset[str] = frozenset()
    shared: frozenset[str] = frozenset()  # parameters whose change the caller sees

    def find(self, name: str) -> Value | None:
        """What a name stands for."""
        if name in self.names:
            return self.names[name]
        if name in self.parameters or self.around is None:
            return None
        return self.around.find(name)

    @property
    def all(self) -> list[Scope]:
        """This one and those around it."""
        return [self, *(self.around.all if self.around is not None else [])]


def require_followed(parameters: Sequence[str], given: Sequence[Value], scope: Scope) -> None:
    """Raises NotFollowed where an array that a function was given is not known behind it: it is its caller's, too."""
    for name, value in zip(parameters, given, strict=False):
        found = scope.names.get(name)
        if isinstance(value, Array) and isinstance(found, Broken):
            raise NotFollowed(found.why)


@dataclass
class Names:
    """``labels``: the author's names of what comes from outside; ``lines``: formulas that have a name of their own."""

    known: Known
    prefix: str = "val"
    first: int = 0  # what the program counts entries from
    labels: dict[tuple[str | int, ...], list[str]] = field(default_factory=dict)
    aliases: dict[tuple[str | int, ...], str] = field(default_factory=dict)
    vectors: dict[tuple[str | int, ...], list[tuple[str, int]]] = field(default_factory=dict)  # q of q = x[:2]
    lines: dict[str, str] = field(default_factory=dict)
    said: dict[str, str] = field(default_factory=dict)  # the line of the program that each of these is from
    read: set[str] = field(default_factory=set)

    def kept(self, name: str, value: Value, line: str) -> Value:
        """The value that a name gets: a place of the state is labelled, a long formula becomes a line."""
        match value:
            case Outside():
                return self._outside(name, value)
            case Formula() if MARK.fullmatch(value.text):
                path = tuple(int(p) if p.isdigit() else p for p in value.text[1:-1].split("|"))
                return self._outside(name, Outside(path))
            case Formula():
                return self._formula(name, value, line)
            case Array():
                value.entries[:] = [self.line(e, line) for e in value.entries]
                self._label_entries(name, value)
                return value
            case Local():
                return value
        return value

    def _outside(self, name: str, value: Outside) -> Value:
        path = value.path
        if self.known.coordinate(name) is None and (self.known.is_quantity(name) or _is_gravity(name)):
            own = (name,)
            if path == own:
                return value
            last = value.path[-1]
            field_name = str(last)
            is_field = len(path) <= 2 and isinstance(last, str)
            if (
                is_field
                and field_name.strip("_") != name.strip("_")
                and self.known.is_quantity(field_name)
                and not _is_gravity(name)
            ):
                raise NotFollowed(f"{name} = {'.'.join(map(str, path))}: both names are quantities of the mechanism; "
                                  "give each the name that its body has")  # fmt: skip
            before = self.aliases.get(path)
            if before is not None and before != name:
                raise NotFollowed(f"{before} and {name} are one quantity here; declare the bodies with one name for it")
            self.aliases[path] = name
            return Outside(own)
        self.labels.setdefault(path, []).append(name)
        return value

    def _formula(self, name: str, value: Formula, line: str) -> Value:
        constant = NUMBERS_ALONE.fullmatch(value.text) is not None
        if constant and _is_gravity(name) and "-" in value.text.replace("e-", "") and not self.known.is_turned(name):
            raise NotFollowed("g is a negative number here; give it without its sign, and the sign in the rows")
        is_own = self.known.is_quantity(name) and self.known.coordinate(name) is None
        if (is_own or _is_gravity(name)) and name not in self.read:
            if not constant and any(m.split("|")[-1] == name for m in MARK.findall(value.text)):
                raise NotFollowed(f"{name} is computed from another {name} here; give each a name of its own")
            if constant or self._is_constant(value):
                return Outside((name,))  # m1 = 1.0, I = 7/12, m*l^2/12: what is right for every value is right for it
            if name.strip("_") in self.known.drives:
                return Outside((name,))
        return self.line(value, line)

    def _is_constant(self, value: Formula) -> bool:
        """Whether a formula has nothing in it but quantities of the mechanism and numbers."""
        bare = value.text
        for _ in range(60):
            name = next((n for n in self.lines if re.search(rf"\b{n}\b", bare)), None)
            if name is None:
                break
            line = self.lines[name]
            bare = re.sub(rf"\b{name}\b", lambda _, one=line: f"({one})", bare)  # type: ignore[misc]
            if len(bare) > 4000:
                return False
        marks = [m.split("|") for m in MARK.findall(bare)]
        fields = [m[-1] for m in marks]
        return bool(fields) and all(self.known.is_quantity(f) or f in GRAVITY for f in fields)

    def _label_entries(self, name: str, value: Array) -> None:
        """q = x[:2], and [define] 'q[0, 0]' = …, of an array of the program's own."""
        marks = [MARK.fullmatch(e.text) for e in value.entries]
        if value.is_vector and all(marks):
            for k, mark in enumerate(marks):
                assert mark is not None
                path = tuple(int(p) if p.isdigit() else p for p in mark[1].split("|"))
                if isinstance(path[-1], int):
                    self.vectors.setdefault(path, []).append((name, k))
        for key in self.known.defined:
            found = re.fullmatch(rf"{re.escape(name)}\s*(?P<open>[\[(])\s*(?P<i>\d)\s*(?:,\s*(?P<j>\d)\s*)?[\])]", key)
            if found is None:
                continue
            first = 1 if found["open"] == "(" else 0
            at = max(int(found["i"]) - first, int(found["j"] or first) - first)
            if 0 <= at < len(value.entries):
                mark = MARK.fullmatch(value.entries[at].text)
                if mark:
                    path = tuple(int(p) if p.isdigit() else p for p in mark[1].split("|"))
                    self.labels.setdefault(path, []).insert(0, self.known.defined[key])

    def line(self, value: Formula, line: str) -> Formula:
        """A name of its own for a long formula."""
        if len(value.text) <= SHORT or "«t»" in value.text:  # cosines of time stand in the rows
            return value
        for name, text in self.lines.items():
            if text == value.text:
                return Formula(name)
        own = f"{self.prefix}{len(self.lines) + 1}"
        if len(self.lines) >= 400:
            raise NotFollowed("more than 400 formulas; give the function with the equations of motion alone")
        self.lines[own] = value.text
        self.said[own] = line
        return Formula(own)
