"""What a name of a followed program is in the mechanism: a coordinate, its rate, a momentum, or a quantity."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from ..names import base_and_index, plain_name
from .known import GRAVITY, Known
from .names import MARK, Names
from .values import Formula, NotFollowed

Path = tuple[str | int, ...]
MOMENTUM = re.compile(r"[pPL](?:_?(?P<of>\w*))?")
DRIVES = frozenset((
    "u", "U", "tau", "F", "f", "force", "torque", "T", "action", "input", "control", "Tau", "forces", "torques", "u1",
    "tau1", "in_", "Fx", "Q", "effort",
))  # fmt: skip
ADVICE = "return the rates and the accelerations in the state's order, as in return w1, w2, a1, a2"
UNCERTAIN = (
    "Give the function's state the names of the coordinates, as in theta1, theta2, w1, w2 = y, or say it, as in "
    "[define] 'y[0]' = \"theta1\""
)


def path_of(mark: str) -> Path:
    """The path that a mark stands for."""
    return tuple(int(p) if p.isdigit() else p for p in mark.split("|"))


def rendered(path: Path, first: int) -> str:
    """A path as [define] has it: bobs[0].m"""
    return "".join(f"[{p + first}]" if isinstance(p, int) else f".{p}" for p in path).removeprefix(".")


@dataclass
class Meaning:
    """``order``: what is known of the places of the state: 0 a coordinate, 1 its rate, 2 its acceleration, -1 its
    momentum, each with the number of the coordinate."""

    known: Known
    names: Names
    parameters: Sequence[str] = ()
    order: dict[Path, tuple[int, int]] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """The coordinates."""
        return len(self.known.coordinates)

    def said(self, path: Path) -> list[str]:
        """What is said of a place: in the file, then by the author's own names."""
        found: list[str] = []
        last = path[-1]
        whole = rendered(path, self.names.first)
        if whole in self.known.defined and len(path) > 1:
            found = [self.known.defined[whole]]
        elif self.names.first and isinstance(last, int) and len(path) > 1:
            keys = (f"{path[-2]}[{last + 1}]", f"{path[-2]}({last + 1})")
            found = [self.known.defined[k] for k in keys if k in self.known.defined]
        elif isinstance(last, int) and len(path) > 1:
            base, k = str(path[-2]), last
            found = [self.known.defined[key] for key in (f"{base}[{k}]", f"{base}({k + 1})", f"{base}{{{k + 1}}}")
                     if key in self.known.defined]  # fmt: skip
        elif len(path) > 2 and all(isinstance(p, int) for p in path[-2:]):
            found = [
                self.known.defined[key] for key in (f"{path[-3]}[{path[-2]}, {path[-1]}]",) if key in self.known.defined
            ]
        else:
            found = [str(last)]
        return [*found, *self.names.labels.get(path, [])]

    def by_names(self, paths: Iterable[Path]) -> None:
        """What the names of these places say."""
        for path in paths:
            if path in self.order:
                continue
            said = self.said(path)
            coordinates = [k for s in said if (k := self.known.coordinate(s.replace("\\", ""))) is not None]
            vector = self.in_vector(path)
            if coordinates:
                self.order[path] = (0, coordinates[0])
            elif vector is not None and vector[0] == 0 and vector not in self.order.values():
                self.order[path] = vector
        for path in paths:
            if path not in self.order:
                found = self.derivative(path)
                if found is not None and found not in self.order.values():
                    self.order[path] = found

    def derivative(self, path: Path) -> tuple[int, int] | None:
        """The order and the coordinate that the names of a place, or of its vector, say."""
        for s in self.said(path):
            for order in (1, 2):
                k = self.known.of_rate(s, order)
                if k is not None:
                    return order, k
        return self.in_vector(path)

    def in_vector(self, path: Path) -> tuple[int, int] | None:
        """The order and the coordinate of an entry of q, dq, or of x that has these names in part."""
        own = [(str(path[-2]), path[-1])] if isinstance(path[-1], int) and len(path) > 1 else []
        for name, k in [*self.names.vectors.get(path, []), *own]:
            vector = self.known.is_vector(name)
            if vector is not None and k < self.count:
                return vector[0], vector[1][k]
        return None

    def pair(self, state: Sequence[Path], derivatives: Sequence[Formula]) -> bool:
        """What a state's derivatives say: at a coordinate's place stands its rate. Whether all are paired so."""
        pairs = {}
        for place, formula in zip(state, derivatives, strict=True):
            mark = MARK.fullmatch(formula.text)
            if mark and path_of(mark[1]) in state and path_of(mark[1]) != place:
                pairs[place] = path_of(mark[1])
        for place in state:  # names of rates say nothing where the pairs say it
            if place in pairs.values():
                self.order.pop(place, None)
        self.by_labels(state)
        left = [p for p in pairs if self.order.get(p, (9, 0))[0] != 0]
        free = [k for k in range(self.count) if (0, k) not in self.order.values()]
        if len(pairs) == self.count and len(left) == len(free) == self.count:
            self.order |= self._in_one_vector(left)
        if len(pairs) == self.count and len(left) == len(free) == 1:
            self.order[left[0]] = (0, free[0])
        if len(pairs) != self.count or set(pairs) & set(pairs.values()):
            return False
        if len({self.order[p] for p in pairs if p in self.order}) != self.count:
            unknown = ", ".join(self.shown(p) for p in pairs if self.order.get(p, (9, 0))[0] != 0)
            raise NotFollowed(f"which coordinate is {unknown}? {UNCERTAIN}")
        for place, rate in pairs.items():
            order, k = self.order.get(place, (9, 0))
            if order != 0:
                raise NotFollowed(f"which coordinate is {self.shown(place)}? {UNCERTAIN}")
            self.order[rate] = (1, k)
        return True

    def _in_one_vector(self, places: Sequence[Path]) -> dict[Path, tuple[int, int]]:
        """All coordinates in their own order, of a = y[:n] with as many as there are of one letter; else nothing."""
        if self.count < 3 or self.known.is_vector("q") is None:
            return {}
        for name in {name for p in places for name, _ in self.names.vectors.get(p, [])}:
            found = {p: (0, k) for p in places for of, k in self.names.vectors.get(p, []) if of == name}
            if sorted(k for _, k in found.values()) == list(range(self.count)) and len(found) == self.count:
                return found
        return {}

    def by_labels(self, state: Sequence[Path]) -> None:
        """The coordinates among these places, by their names alone."""
        for path in state:
            found = [k for s in self.said(path) if (k := self.known.coordinate(s.replace("\\", ""))) is not None]
            vector = self.in_vector(path)
            if not found and vector is not None and vector[0] == 0:
                found = [vector[1]]
            if found and (0, found[0]) not in self.order.values():
                self.order[path] = (0, found[0])

    def momenta(self, state: Sequence[Path]) -> bool:
        """Whether what is no coordinate of a state is called a momentum, each of one coordinate."""
        self.by_labels(state)
        others = [p for p in state if self.order.get(p, (9, 0))[0] != 0]
        if len(others) != self.count or len(state) != 2 * self.count:
            return False
        made: dict[Path, tuple[int, int]] = {}
        for path in others:
            names = [s.replace("\\", "") for s in self.said(path)]
            found = next((m for s in names if (m := MOMENTUM.fullmatch(s.replace("{", "").replace("}", "")))), None)
            if found is None:
                return False
            k = self._of_momentum(found["of"] or "")
            if k is None:
                return False
            made[path] = (-1, k)
        if len(set(made.values())) != self.count:
            return False
        self.order |= made
        return True

    def _of_momentum(self, of: str) -> int | None:
        if self.count == 1:
            return 0
        if of.isdigit() and not any(re.search(r"[0-9]", c) for c in self.known.coordinates):
            return int(of) - 1 if 1 <= int(of) <= self.count else None  # p1 of alpha, beta
        for k, coordinate in enumerate(self.known.coordinates):
            index = (base_and_index(coordinate) or ("", ""))[1] or coordinate.lstrip("abcdefghijklmnopqrstuvwxyz")
            if plain_name(of) == coordinate or (index and of == index):
                return k
        return None

    def shown(self, path: Path) -> str:
        """A place as its author writes it."""
        labels = self.names.labels.get(path)
        if labels:
            return labels[0]
        if isinstance(path[-1], int) and len(path) > 1:
            return f"{path[-2]}[{path[-1]}]"
        return ".".join(map(str, path))

    def text(self, path: Path) -> str:
        """What stands for a place or a quantity in the rows."""
        if path in self.order:
            order, k = self.order[path]
            return self.written(order, k)
        return self.quantity(path)

    def written(self, order: int, k: int) -> str:
        """A coordinate, its rate, its acceleration, its momentum."""
        name = self.known.written[k].strip("_")
        if order == -1:
            base, index = base_and_index(name) or (name, "")
            figures = re.search(r"[0-9]+$", base)
            index = index or (figures[0] if figures else "")
            return "p" if self.count == 1 else f"p{index}" if index else f"p_{name}"
        return name if order == 0 else f"({name}{chr(39) * order})"

    def quantity(self, path: Path) -> str:  # noqa: PLR0911, PLR0912 -- one for each kind
        """A quantity of the mechanism, of the file, or a name that the reader will not know."""
        is_entry = isinstance(path[-1], int)
        said = self.said(path) if is_entry else [str(path[-1]), *self.names.labels.get(path, [])]
        whole = rendered(path, self.names.first)
        if len(path) > 1 and whole in self.known.defined:
            said.insert(0, self.known.defined[whole])
        if path in self.names.aliases:
            said.insert(0, self.names.aliases[path])
        for s in said:
            if s in self.known.defined and "[" not in s:
                return s
            if self.known.is_quantity(s):
                return plain_name(s.strip("_")) or s
        counted = self.counted(path)
        if counted is not None:
            return counted
        for s in said:
            if s.strip("_") in GRAVITY:
                return s if self.known.is_turned(s) else "g"
            if is_entry and not re.fullmatch(r"\w+", s):
                return f"({s})"  # [define] 'u[0]' = 'F - b*x'
        drive = self.drive(path)
        if drive is not None:
            return drive
        if path in {("t",), ("time",)}:
            return "t"
        shown = self.shown(path)
        if shown in self.known.free:
            return shown
        if re.fullmatch(r"\w+", shown):
            raise NotFollowed(f"'{shown}' is not known here; give it the name that a body has for it, or say in "
                              "[define] what it is")  # fmt: skip
        shown = shown.replace("(1)", "(…)")
        raise NotFollowed(f"what is {shown}? Say it in [define], or write the name that a body has for it")

    def counted(self, path: Path) -> str | None:
        """m[0] of a list of masses, where the bodies have m1, m2."""
        if not isinstance(path[-1], int) or len(path) < 2:
            return None
        base = str(path[-2])
        first = 0 if any(q.endswith("0") for q in self.known.quantities) else 1
        short = {"masses": "m", "mass": "m", "lengths": "l", "length": "l", "inertias": "I", "inertia": "I"}
        for name in (base, short.get(base.lower(), base), base.lower(), base.rstrip("s")):
            if self.known.is_quantity(f"{name}{path[-1] + first}") and not self.known.is_quantity(base):
                return f"{name}{path[-1] + first}"
        return None

    def drive(self, path: Path) -> str | None:
        """An entry of the vector of all drives; the only drive, where the text has another name for it."""
        drives = self.known.drives
        last = path[-1]
        base = str(path[-2] if isinstance(last, int) and len(path) > 1 else last)
        if isinstance(last, int) and len(path) > 1:
            vector = base in DRIVES or base.startswith(("tau", "u", "torq", "force", "contr", "act", "inp"))
            if vector and len(drives) == self.count and self.count > 1 and last < self.count:
                return drives[last]
            return drives[0] if vector and len(drives) == 1 and last == 0 else None
        return drives[0] if base in DRIVES and len(drives) == 1 and drives[0] not in self.names.read else None
