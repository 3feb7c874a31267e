"""What a value of a followed program says: a state's derivative, accelerations, M, C and G, an equation."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from .arrays import product
from .follow import Follower
from .known import Known
from .lost_steps import is_a_part
from .meaning import ADVICE, Meaning, Path, path_of
from .names import MARK, Scope
from .values import Array, Broken, Doubtful, Formula, NotFollowed, Outside, Several, Value, formula

ACCELERATION = re.compile(r"(?i)acc|ddot|_dd|dd_|^dd|dd$|dynamics|alpha|forward|dotdot|2dot")
MASS = ("M", "D", "H", "B", "Mq", "M_q", "mass", "mass_matrix", "M_mat", "Mmat", "I", "inertia", "M_matrix", "A")
CORIOLIS = (
    "C", "V", "h", "c", "Cq", "C_mat", "Cmat", "coriolis", "C_matrix", "N", "H", "Cqd", "cor", "C_vec", "Vm",
)  # fmt: skip
INPUT = ("B", "B_mat", "Bu", "Bq")
WEIGHT = ("G", "g", "Gq", "grav", "gravity", "G_vec", "G_mat", "g_q", "gq", "Gvec", "gvec", "g_vec", "G_matrix")
NEGATIVE_WEIGHT = ("tau_g", "taug", "tauG", "tau_G")
Rows = list[tuple[str, str]]


class Forms:
    """``data``: the fields of the file; ``refused``: why parts of the program are not what is looked for."""

    data: dict[str, Any]
    known: Known
    follower: Follower
    refused: list[str]
    kept_state: list[Path] | None = None  # the places of the state without a support whose motion is given

    @property
    def count(self) -> int:
        return len(self.known.coordinates)

    def _try(self, read: Any) -> tuple[Rows, Meaning] | None:
        try:
            return read()  # type: ignore[no-any-return]
        except Doubtful:
            raise
        except NotFollowed as error:
            self.refused.append(str(error))
            return None

    # what a value says

    def _from_value(
        self, value: Value, scope: Scope, parameters: Sequence[str], names: Sequence[str] = ()
    ) -> tuple[Rows, Meaning] | None:
        """``names``: what the program calls the value, its parts, or the function that gives it back."""
        entries, self.kept_state = self._own(self._flat(value), parameters)
        if len(entries) == 2 * self.count:
            return self._residual(entries, scope, parameters) or self._of_state(entries, scope, parameters)
        if len(entries) == self.count:
            meaning = self._meaning(parameters, entries, scope)
            each = [self.known.of_rate(name, 2) for name in names]
            named = [k for k in each if k is not None]
            if len(each) == self.count == len(set(named)):
                order = named
                natural = self._try(lambda: (self._order(meaning, scope, parameters, value), meaning))
                if natural is not None and list(natural[0]) != named:  # type: ignore[comparison-overlap]
                    raise Doubtful("the accelerations are given back in another order than the coordinates come in; "
                                      "which is which? Give them back in that order")  # fmt: skip
            elif any(self._is_acceleration(name) for name in names):
                order = self._order(meaning, scope, parameters, value)
            else:
                raise NotFollowed(f"are these {self.count} values the accelerations? Then call them so; or {ADVICE}")
            for k, entry in zip(order, entries, strict=True):
                if MARK.fullmatch(entry.text):
                    return None
                if any(meaning.order.get(p) == (2, k) for p in self._paths([entry])):  # ddt = diff(p, t)
                    raise NotFollowed("an acceleration stands in what it is; give the equations, or solve for it")
            rows = [(self._second(k), e.text) for k, e in zip(order, entries, strict=True)]
            return self._checked(rows, meaning)
        raise NotFollowed(f"the function returns {len(entries)} values for {self.count} coordinates; {ADVICE}")

    def _own(self, entries: list[Formula], parameters: Sequence[str]) -> tuple[list[Formula], list[Path] | None]:
        """The entries without those of a support whose motion is given, where [define] says all of the state."""
        bodies = self.data.get("bodies")
        given = [str(b.get("coordinate")) for b in bodies or () if isinstance(b, dict) and "motion" in b]
        size = 2 * (self.count + len(given))
        if not given or len(entries) != size:
            return entries, None
        first, said = self.follower.names.first, self.known.defined
        for name in parameters:
            keys = [(f"{name}[{k + first}]", f"{name}({k + 1})") for k in range(size)]
            state = [next((said[key].replace(" ", "") for key in pair if key in said), "") for pair in keys]
            if not all(state) or not all(f"{of}{rate}" in state for of in given for rate in ("", "'")):
                continue
            kept = [k for k in range(size) if state[k].rstrip("'") not in given]
            for k in sorted({*range(size)} - {*kept}):
                mark = MARK.fullmatch(entries[k].text)
                means = said.get(str(path_of(mark[1])[-1]), "") if mark and len(path_of(mark[1])) == 1 else ""
                at = path_of(mark[1])[-1] if mark and path_of(mark[1])[:-1] == (name,) else None
                means = state[at] if isinstance(at, int) and at < size else means.replace(" ", "")
                if means != f"{state[k]}'":
                    raise NotFollowed(
                        f"{name}: what is given back for {state[k]}, whose motion is given, is not its rate"
                    )
            return [entries[k] for k in kept], [(name, k) for k in kept]
        return entries, None

    def _residual(self, entries: list[Formula], scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        """M*zdot + V of an implicit solver, where [define] says the entries of zdot: what is left over is 0."""
        meaning = self._meaning(parameters, entries, scope)
        own = [p for p, o in meaning.order.items() if o[0] == 2 and p[0] in parameters and isinstance(p[-1], int)]
        second = [e for e in entries if set(self._paths([e])) & set(own)]
        if len(second) != self.count or any(MARK.fullmatch(e.text) for e in second):
            return None
        for rest in (e for e in entries if e not in second):  # zdot(1) - z(3) says that a rate is itself
            sides = re.fullmatch(r"(.+?)\+?\(?-(.+)", self._said(rest.text, meaning).replace(" ", ""))
            if sides is None or sides[1].strip("()") != sides[2].strip("()"):
                raise NotFollowed("which of these are equations of motion is not plain; give these alone")
        return self._checked([(e.text, "0") for e in second], meaning, needs_second=False)

    def _is_acceleration(self, name: str) -> bool:
        """Whether a name says that it is of accelerations."""
        vector = self.known.is_vector(name)
        return (vector is not None and vector[0] == 2) or ACCELERATION.search(name) is not None

    def _second(self, k: int) -> str:
        return f"{self.known.written[k].strip('_')}''"

    def _flat(self, value: Value) -> list[Formula]:
        """All entries, one behind another; the accelerations may be a vector at the end."""
        if isinstance(value, Array):
            return value.entries
        if isinstance(value, Several):
            return [e for item in value.items for e in self._flat(item)]
        if isinstance(value, Outside) and value.path and isinstance(value.path[-1], str):
            vector = self.known.is_vector(value.path[-1])
            if vector is not None and self.count > 1:
                return [Formula(Outside((*value.path, k)).mark) for k in range(self.count)]
        return [formula(value)]

    def _of_state(self, entries: list[Formula], scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        meaning = self._meaning(parameters, entries, scope)
        state = self._known_state(meaning, parameters, entries)
        if state is not None:
            blank = Meaning(self.known, self.follower.names, parameters)
            try:
                paired = blank.pair(state, entries)
            except NotFollowed:
                blank = Meaning(self.known, self.follower.names, parameters)
                if not blank.momenta(state):
                    raise
                paired = False
            if paired:
                rows = []
                for place, entry in zip(state, entries, strict=True):
                    order, k = blank.order.get(place, (9, 0))
                    if order == 1:
                        rows.append((self._second(k), entry.text))
                blank.by_names(self._paths(entries))
                return self._checked(rows, blank)
            blank = Meaning(self.known, self.follower.names, parameters)
            if blank.momenta(state):
                rows = []
                for place, entry in zip(state, entries, strict=True):
                    order, k = blank.order[place]
                    rows.append((f"{blank.written(order, k)}'", entry.text))
                return self._checked(rows, blank)
        rates = [k for k, e in enumerate(entries) if MARK.fullmatch(e.text)]
        found: Rows = []
        for at, entry in enumerate(entries):  # rates by their names, in the order of what is returned
            mark = MARK.fullmatch(entry.text)
            if mark and meaning.order.get(path_of(mark[1]), (9, 0))[0] == 1:
                k = meaning.order[path_of(mark[1])][1]
                half = at + self.count if rates == list(range(self.count)) else at + 1
                if half < len(entries) and half not in rates:
                    found.append((self._second(k), entries[half].text))
        is_by_names = state is None or all(len(place) == 1 and place[0] in parameters for place in state)
        if is_by_names and len({left for left, _ in found}) == self.count == len(rates):
            return self._checked(found, meaning)
        raise NotFollowed(f"which values of the state are rates is not plain from what is returned; {ADVICE}")

    def _known_state(
        self, meaning: Meaning, parameters: Sequence[str], entries: Sequence[Formula]
    ) -> list[Path] | None:
        """None, too, where [define] says all rates that are given back, and they are of another vector, q_dot."""
        state = self._state(meaning, parameters, entries)
        if state is None:
            return None
        marks = [MARK.fullmatch(e.text) for e in entries]
        paths = [path_of(m[1]) for m in marks if m]
        is_said = all(meaning.order.get(p, (9, 0))[0] == 1 and isinstance(p[-1], int) for p in paths)
        is_apart = is_said and not {p[:-1] for p in paths} & {p[:-1] for p in state}
        return None if len(paths) == self.count and is_apart else state

    def _state(self, meaning: Meaning, parameters: Sequence[str], entries: Sequence[Formula]) -> list[Path] | None:
        """The places of the state, in its order; None where that is not plain."""
        if self.kept_state is not None:
            return self.kept_state
        size = 2 * self.count
        bases: dict[Path, set[int]] = {}
        own = self._paths(entries)
        known_paths = {*own, *meaning.names.labels, *meaning.names.vectors}
        if any(isinstance(p[-1], int) and len(p) > 1 for p in own):
            heads = {p[:-1] for p in own if isinstance(p[-1], int)}
            known_paths = {p for p in known_paths if p[:-1] in heads}
        for path in known_paths:
            if isinstance(path[-1], int) and len(path) > 1:
                bases.setdefault(path[:-1], set()).add(path[-1])
        scores = {}
        for base, places in bases.items():
            if max(places) >= size:
                if any(meaning.order.get((*base, k), (9, 0))[0] == 0 for k in places):
                    raise Doubtful(f"{base[-1]} has more than the {size} values that two for each coordinate are")
                continue
            said = [meaning.order.get((*base, k)) for k in range(size)]
            scores[base] = sum(o is not None and o[0] == 0 for o in said) * 10 + len(places)
        best = max(scores, key=lambda b: scores[b], default=None)
        if best is not None and (scores[best] >= 10 or (self.count == 1 and len(bases[best]) >= 1)):
            halves = self._halves(meaning, bases, best, parameters)
            return halves or [(*best, k) for k in range(size)]
        names = [p for p in parameters if p not in ("t", "time", "_")]
        alone: list[Path] = [(p,) for p in names]
        known_ones = [p for p in alone if meaning.order.get(p, (9, 0))[0] in (0, 1)]
        return known_ones if len(known_ones) == size and known_ones == alone[:size] else None

    def _halves(
        self, meaning: Meaning, bases: Mapping[Path, set[int]], best: Path, parameters: Sequence[str]
    ) -> list[Path] | None:
        """q and dq as two vectors."""
        if max(bases[best]) >= self.count or len(best) != 1 or self.count < 2:
            return None
        other = next((b for b in bases if b != best and len(b) == 1 and max(bases[b]) < self.count
                      and (v := self.known.is_vector(str(b[0]))) is not None and v[0] == 1), None)  # fmt: skip
        if other is None:
            return None
        return [(*b, k) for b in (best, other) for k in range(self.count)]

    def _meaning(self, parameters: Sequence[str], entries: Iterable[Formula], scope: Scope) -> Meaning:
        meaning = Meaning(self.known, self.follower.names, parameters)
        paths = [*self._paths(entries), *meaning.names.labels, *meaning.names.vectors, *((p,) for p in parameters)]
        meaning.by_names(list(dict.fromkeys(paths)))
        return meaning

    def _paths(self, entries: Iterable[Formula]) -> list[Path]:
        """All that comes from outside in these formulas, and in the lines that they use."""
        text = " ".join(e.text for e in entries)
        used = needed(self.follower.names.lines, text)
        return list(dict.fromkeys(path_of(m) for t in (text, *used.values()) for m in MARK.findall(t)))

    def _order(self, meaning: Meaning, scope: Scope, parameters: Sequence[str], value: Value) -> list[int]:
        """The coordinates in the order of n accelerations."""
        n = self.count
        if n == 1:
            return [0]
        meaning.by_names(self._declared_entries(parameters))
        places = {o[1]: path for path, o in meaning.order.items() if o[0] == 0}
        entries = self._by_entries(meaning)
        if entries is not None:
            return entries
        if len(places) == n and all(len(p) == 1 and p[0] in parameters for p in places.values()):
            return sorted(range(n), key=lambda k: list(parameters).index(str(places[k][0])))
        for found in _all_names(scope).values():  # q = [x; theta]
            if isinstance(found, Array) and len(found.entries) == n:
                marks = [MARK.fullmatch(e.text) for e in found.entries]
                orders = [meaning.order.get(path_of(m[1])) if m else None for m in marks]
                if all(o is not None and o[0] in (0, 1) for o in orders) and len({o[0] for o in orders if o}) == 1:
                    made = [o[1] for o in orders if o]
                    if len(set(made)) == n:
                        return made
        if self.known.is_vector("q") is not None:
            return list(range(n))
        raise NotFollowed(f"which acceleration is which coordinate's is not plain; {ADVICE}")

    def _declared_entries(self, parameters: Sequence[str]) -> list[Path]:
        """The entries of parameters that [define] says, v[0] or v(1), whether or not they are used."""
        said = self.known.defined
        return [(name, k) for name in parameters for k in range(2 * self.count)
                if f"{name}[{k + self.follower.names.first}]" in said or f"{name}({k + 1})" in said]  # fmt: skip

    def _by_entries(self, meaning: Meaning) -> list[int] | None:
        """The coordinates as the entries of one vector come, of all coordinates or else of all rates.

        Raises NotFollowed where another vector has them in another order.
        """
        vectors: dict[tuple[int, Path], dict[int, int]] = {}
        for path, (order, k) in meaning.order.items():
            if order in (0, 1) and isinstance(path[-1], int):
                vectors.setdefault((order, path[:-1]), {})[k] = path[-1]
        whole = [places for _, places in sorted(vectors.items(), key=lambda v: v[0][0]) if len(places) == self.count]
        if not whole:
            return None
        made = sorted(whole[0], key=lambda k: whole[0][k])
        for places in vectors.values():
            kept = [places[k] for k in made if k in places]
            if kept != sorted(kept):
                raise NotFollowed(f"the angles and the rates come in two orders; {ADVICE}")
        return made

    def _by_matrices(
        self, named: Mapping[str, Value], scope: Scope, parameters: Sequence[str]
    ) -> tuple[Rows, Meaning] | None:
        """return M, C, G: M q̈ + C + G, C times the rates where it is a matrix, is what drives the joints."""
        n = self.count
        mass = next((x for x in MASS if isinstance(named.get(x), Array) and len(named[x].entries) == n * n), None)  # type: ignore[union-attr]
        if mass is None or n < 2:
            return None
        rest = {name: v for name, v in named.items() if name != mass}
        names = list(rest)
        if not names or len(names) > 3:
            return None
        meaning = self._meaning(parameters, [e for v in named.values() for e in self._flat_or_none(v)], scope)
        order = self._order(meaning, scope, parameters, named[mass])
        second = Array([Formula(self._second(k)) for k in order], (n,), "loose")
        first = Array([Formula(f"({self.known.written[k].strip('_')}')") for k in order], (n,), "loose")
        total: Value = product(named[mass], second)
        combined = self.follower.expressions.combined
        driven: Value | None = None
        for name, value in rest.items():
            if not isinstance(value, Array):
                return None
            is_square = len(value.entries) == n * n and n > 1
            if name in INPUT and all(e.whole is not None for e in value.entries) and not driven:
                driven = self._driven(value, order)
                total = combined("-", total, driven)
            elif name in CORIOLIS or (name in ("D", "B", "F") and is_square):
                part = product(value, first) if is_square else value
                total = combined("+", total, _loose(part))
            elif name in WEIGHT and not is_square:
                total = combined("+", total, _loose(value))
            elif name in NEGATIVE_WEIGHT and not is_square:
                total = combined("-", total, _loose(value))
            else:
                return None
        drives = ["0"] * n if driven else self._drives(order)
        assert isinstance(total, Array)
        rows = [(drive, e.text) for drive, e in zip(drives, total.entries, strict=True)]
        return self._checked(rows, meaning, needs_second=False)

    def _driven(self, value: Array, order: Sequence[int]) -> Value:
        """B u, of a column for the only drive or a matrix for all of them."""
        given = [d for d in self._drives(order) if d != "0"]
        n = self.count
        if len(value.entries) == n and len(given) == 1:
            return _loose(self.follower.expressions.combined("*", value, Formula(given[0])))
        if len(value.entries) == n * len(given) and value.shape == (n, len(given)):
            return _loose(product(value, Array([Formula(d) for d in given], (len(given),), "loose")))
        raise NotFollowed("B and the drives of the bodies do not fit; give the line that solves for accelerations")

    def _drives(self, order: Sequence[int]) -> list[str]:
        bodies = self.data.get("bodies")
        given = (
            [str(b.get("drive", "0")) if isinstance(b, dict) else "0" for b in bodies]
            if isinstance(bodies, list)
            else []
        )
        if any("motion" in b for b in bodies or () if isinstance(b, dict)):
            raise NotFollowed("a support that is moved, and matrices alone; write the rows")
        if (
            not self.known.relative
            and sum("drive" in b for b in bodies or () if isinstance(b, dict))
            and not any(self.known.slides)
        ):
            pass
        return [given[k] for k in order]

    def _flat_or_none(self, value: Value) -> list[Formula]:
        return value.entries if isinstance(value, Array) else [value] if isinstance(value, Formula) else []

    def _has_accelerations(self, value: Value) -> bool:
        entries = self._flat_or_none(value)
        meaning = self._meaning((), entries, self.follower.top)
        return any(meaning.order.get(p, (0, 0))[0] == 2 for p in self._paths(entries))

    def _said(self, text: str, meaning: Meaning) -> str:
        return MARK.sub(lambda m: meaning.text(path_of(m[1])), text)

    def _equations(self, found: Sequence[tuple[Value, Value, str]]) -> tuple[Rows, Meaning]:
        """tau = M*ddq + C, or eq1 == eq2."""
        rows: list[tuple[Formula, Formula]] = []
        for left, right, _line in found:
            if isinstance(right, Array):
                other = self.follower.expressions.combined("-", right, left) if not isinstance(left, Outside) else None
                lefts = self._flat_or_none(left)
                if isinstance(left, Outside):
                    lefts = [Formula(Outside((*left.path, k)).mark) for k in range(len(right.entries))]
                elif isinstance(other, Array) and len(lefts) != len(other.entries):
                    raise NotFollowed("an equation of vectors of different length")
                rows += list(zip(lefts, right.entries, strict=True))
            else:
                rows.append((formula(left), formula(right)))
        if len(rows) != self.count:
            raise NotFollowed(f"{len(rows)} equations for {self.count} coordinates; one for each is needed")
        meaning = self._meaning((), [f for row in rows for f in row], self.follower.top)
        made = [(left.text, right.text) for left, right in rows]
        return self._checked(made, meaning, needs_second=False)

    def _by_names(self, scope: Scope, parameters: Sequence[str] = ()) -> tuple[Rows, Meaning] | None:
        """The accelerations that the program has by their names, theta_ddot = …"""
        names = _all_names(scope) | self.follower.expressions.members
        found: dict[int, Formula] = {}
        for name, value in names.items():
            bare = name.split(".")[-1]
            vector = self.known.is_vector(bare)
            if isinstance(value, Array) and vector is not None and vector[0] == 2 and len(value.entries) == self.count:
                return self._from_value(value, scope, parameters, (bare,))
            k = self.known.of_rate(bare, 2)
            if k is None:
                continue
            if isinstance(value, Broken):
                raise NotFollowed(value.why)
            if isinstance(value, Formula) or (isinstance(value, Array) and len(value.entries) == 1):
                if k in found and found[k] != formula(value):
                    return None
                found[k] = formula(value)
            if self.known.is_of_any(bare) and is_a_part(bare, self.follower.statements, self.known):
                raise NotFollowed(f"{bare}: an acceleration, or a part of others? {ADVICE[0].upper()}{ADVICE[1:]}")
        if len(found) != self.count:
            return None
        meaning = self._meaning(parameters, found.values(), scope)
        return self._checked([(self._second(k), f.text) for k, f in sorted(found.items())], meaning)

    def _checked(self, rows: Rows, meaning: Meaning, *, needs_second: bool = True) -> tuple[Rows, Meaning]:
        """The rows with the words of the reader. Raises NotFollowed where a name cannot be told."""
        if len(rows) != self.count and not any(o[0] == -1 for o in meaning.order.values()):
            raise NotFollowed(f"{len(rows)} accelerations for {self.count} coordinates; {ADVICE}")
        meaning.by_names(self._paths(Formula(f"{left} {right}") for left, right in rows))
        made = [(self._said(left, meaning), self._said(right, meaning)) for left, right in rows]
        same = next((left for left, right in made if left.strip("() ") == right.strip("() ")), None)
        if same is not None:
            raise NotFollowed(f"what {same} comes to is not said; give the line that computes it")
        return made, meaning


def _loose(value: Value) -> Value:
    return Array(value.entries, (len(value.entries),), "loose") if isinstance(value, Array) else value


def _all_names(scope: Scope) -> dict[str, Value]:
    return {**(_all_names(scope.around) if scope.around is not None else {}), **scope.names}


def needed(lines: Mapping[str, str], text: str) -> dict[str, str]:
    """The lines that the text uses, or that one of these does, in order."""
    wanted = set(re.findall(r"[A-Za-z]+[0-9]+", text))
    kept: dict[str, str] = {}
    for name, line in reversed(list(lines.items())):
        if name in wanted:
            kept[name] = line
            wanted |= set(re.findall(r"[A-Za-z]+[0-9]+", line))
    return dict(reversed(list(kept.items())))
