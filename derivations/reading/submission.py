"""Reads a derivation: fields with the equations of motion, or the Lagrangian, of a planar mechanism."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from ...models.errors import InvalidInput, nearest
from ...models.readers.toml_text import parse_toml
from ..algebra.quotient import Quotient
from ..algebra.signs import without_squares
from ..algebra.symbols import KINDS, Symbols, symbols_of
from ..algebra.trig import Formula, Space
from ..dialects.lines import LONGEST_LINE
from ..dialects.names import base_and_index, base_word, plain_name
from ..dialects.srepr import from_srepr
from ..dialects.worksheets.definitions import ordered
from ..dialects.worksheets.whole_texts import fields_of_text
from ..steps.conventions import Convention
from ..steps.declared import Declared
from ..steps.first_order import FirstOrder
from ..steps.stages import STAGES, Stages
from .declaration import declared, system_of
from .evaluation import Evaluation
from .forces import eliminated
from .layout import LEFT_SIDE, equations_of, laid_out, texts_of
from .matrices import Grid, added
from .meaning import Meaning, momentum_symbols, number_of_gravity, own_symbols
from .momenta import Variable, has_momenta, variable, with_variable
from .motion.convention import convention_of
from .motion.given_motion import rows_of_lagrangian
from .motion.joint_forces import bodies_of
from .motion.repeated import stated_once
from .nodes import Symbol
from .parser import Slashes, parse_equation, parse_expression
from .tokens import SIGNS
from .typeset import Typesetter
from .vocabulary import FUNCTIONS, Vocabulary, vocabulary

LARGEST_FILE = 200_000  # characters; a chain of twenty rods, every sum multiplied out, has 150 000
MOST_DEFINITIONS = 40
DEFINE = f'define: a table of at most {MOST_DEFINITIONS} names is needed, as in M = "m1 + m2"'
MOST_ROWS = 16  # of one motion, with the steps that lead to them
FIELDS = ("system", "links", "bodies", "angles", "from", "sense", *STAGES, "define", "title", "author")

T = TypeVar("T")


@dataclass(frozen=True)
class Submission:
    """A derivation that was read.

    ``rows``: each equation as (its label, left side minus right side, cleared of denominators); ``lagrangian``: in
    place of them, over its denominator. ``space``: of their symbols, the author's own among them. ``convention``: as
    declared, or the documents'; ``declared``: which of "angles", "from" and "sense" the file declares.
    ``used``: the symbols that occur, as (letter, index); ``lines``: as they were written, by label;
    ``doubtful``: where 3g/2l may mean two things; ``words``: how letters were read.
    """

    kind: str
    space: Space
    rows: tuple[tuple[str, Formula], ...]
    lagrangian: Formula | None
    convention: Convention
    declared: frozenset[str]
    used: frozenset[tuple[str, int]]
    equal_lengths: bool
    equal_masses: bool
    lines: tuple[tuple[str, str], ...] = ()
    doubtful: tuple[str, ...] = ()
    words: Vocabulary = field(default_factory=Vocabulary)
    defined: tuple[tuple[str, str], ...] = ()  # the file's own names, as they were read
    source: str = ""  # all lines of mathematics, as they were written
    mechanism: Declared | None = None  # where the file declares it body by body
    first_order: FirstOrder | None = None  # a Hamiltonian, or equations with momenta, as they were written
    stages: Stages | None = None  # a derivation stated stage by stage; then there is nothing else
    weight: Formula | None = None  # what g is said to be: 0 where it lies flat, a number, ω_0²
    cut: bool = False  # whether its rows were cut out of one text
    passed: tuple[str, ...] = ()  # what a note says besides, of which the verdict takes no notice

    @property
    def relative(self) -> bool:
        """Whether its angles are measured from the link above."""
        return self.convention.relative

    def renamed(self, places: dict[int, int]) -> Submission:
        """The same with one symbol in place of another: all lengths, or all masses, are equal."""
        space, n = self.space, self.space.n
        rows = tuple((label, space.rename(f, places)) for label, f in self.rows)
        lagrangian = None if self.lagrangian is None else space.rename(self.lagrangian, places)
        return replace(
            self, rows=rows, lagrangian=lagrangian,
            first_order=self.first_order.mapped(lambda f: space.rename(f, places)) if self.first_order else None,
            stages=self.stages.mapped(lambda f: space.rename(f, places)) if self.stages else None,
            equal_lengths=self.equal_lengths or 2 * n + 1 in places,
            equal_masses=self.equal_masses or 3 * n + 1 in places,
        )  # fmt: skip

    @property
    def uses_momenta(self) -> bool:
        """Whether it is a Hamiltonian, or equations of first order whose variables are meant as momenta."""
        return self.first_order is not None and self.first_order.canonical

    @property
    def symbols(self) -> Symbols:
        """The documents' mechanism that is nearest."""
        return symbols_of(self.kind if self.kind in KINDS else "n-leg" if self.kind == "point-masses" else "rod-chain",
                          self.space.n)  # fmt: skip


def parse_submission(text: str, slashes: int = 0) -> Submission:
    """Read the text of a TOML file. ``slashes``: how 3g/2l is read, as in :class:`Slashes`."""
    return read_table(table_of(text), slashes)


def table_of(text: str) -> dict[str, Any]:
    """The fields of a TOML text, as they stand there. Raises InvalidInput where it is too long, or no TOML."""
    if len(text) > LARGEST_FILE:
        raise InvalidInput(f"longer than {LARGEST_FILE} characters; a derivation is not")
    return parse_toml(text)


def is_toml(suffix: str) -> bool:
    """Whether a file with this ending has the fields of a derivation; any other is the text itself."""
    return suffix.lower() == ".toml"


def fields_of(text: str, suffix: str) -> dict[str, Any]:
    """The fields of a derivation's file, whose name ends in ``suffix``: of any but TOML, the text is what it states."""
    if is_toml(suffix):
        return table_of(text)
    if len(text) > LARGEST_FILE:
        raise InvalidInput(f"longer than {LARGEST_FILE} characters; a derivation is not")
    return fields_of_text(text, suffix)


def read_table(data: dict[str, Any], slashes: int = 0) -> Submission:
    """Read the fields of a derivation: equations of motion or a Lagrangian; other forms are read in ``derivation``."""
    known_fields(data)
    return read_fields(data, opened(data, slashes))


def known_fields(data: dict[str, Any]) -> None:
    """Raises InvalidInput where a field is not known, or definitions are no table."""
    for name in data:
        if name in ("gravity", "g"):
            raise InvalidInput(f"{name!r}: no such field; [define] says what g is called or worth, as in g = 'G'")
        if name not in FIELDS:
            raise InvalidInput(f"{name!r:.40}: no such field{nearest(name, FIELDS)}; known are {', '.join(FIELDS)}")
    if not isinstance(data.get("define", {}), dict):
        raise InvalidInput(DEFINE)


def read_fields(data: dict[str, Any], reader: Reader) -> Submission:
    """Equations of motion, or a Lagrangian."""
    has_equations = "equations" in data
    if has_equations == ("lagrangian" in data):
        raise InvalidInput('give either [equations], one row each, or lagrangian = "…"')
    rows = reader.rows(data["equations"]) if has_equations else ()
    lagrangian = None if has_equations else reader.lagrangian(data["lagrangian"])
    if lagrangian is not None and "moved" in data:
        return reader.submission(rows_of_lagrangian(reader, lagrangian, data["moved"]), None)
    return reader.submission(rows, lagrangian)


def opened(data: dict[str, Any], slashes: int = 0, constants: Sequence[str] = (), *, has_signs: bool = False,
           forces: Sequence[str] = ()) -> Reader:  # fmt: skip
    """A reader for the lines of these fields: mechanism, convention and the file's own names are read.

    ``constants``: names of quantities besides those that a declared mechanism has; ``has_signs``: signs of rates
    are read in every line of a declared mechanism; ``forces``: of constraints, names among the constants, which the
    rows are rid of.
    """
    texts = list(texts_of(data))
    own = declared(data, texts, constants, has_signs=has_signs or any(SIGNS.search(text) for text in texts))
    kind, n = system_of(data) if own is None else ("mechanism", len(own.mechanism.bodies))
    convention = convention_of(data, n)
    defined = data.get("define", {})
    if not isinstance(defined, dict) or len(defined) > MOST_DEFINITIONS:
        raise InvalidInput(DEFINE)
    if own is None:
        names = frozenset(map(str, defined))
        letter = variable(texts, n, momenta=has_momenta(data), taken=names | _letters(names))
        words = with_variable(vocabulary(texts, n, names), letter)
        momenta = momentum_symbols(letter, n)
        space = Space.general(n, (*own_symbols(n), *forces, *momenta))
        meaning = Meaning(kind, space, {name: space.own(name) for name in forces}, momenta=momenta)
    else:
        letter, words = own.variable, with_variable(own.words, own.variable)
        n = len(own.mechanism.bodies)
        meaning = Meaning(kind, own.mechanism.space, own.symbols, momenta=momentum_symbols(letter, n))
    reader = Reader(
        meaning, words, Slashes(slashes), convention,
        frozenset(name for name in ("angles", "from", "sense") if name in data), "\n".join(texts),
        None if own is None else own.mechanism, letter,
    )  # fmt: skip
    reader.forces = tuple(forces)
    reader.define(ordered(defined))
    return reader


def _letters(names: Iterable[str]) -> frozenset[str]:
    """The letters of names with an index: u of u_1, which its author defines himself."""
    return frozenset(found[0] for name in names if (found := base_and_index(name)) and found[1])


ACCELERATION = re.compile("\\\\ddot|''|″|ddot|\u0308")
RATE = re.compile("\\\\d?dot|['′″]|dot|[\u0307\u0308]")


class Reader:
    """The lines of one file, read one after another."""

    def __init__(
        self, meaning: Meaning, words: Vocabulary, slashes: Slashes, convention: Convention, stated: frozenset[str],
        source: str, mechanism: Declared | None, letter: Variable | None = None,
    ) -> None:  # fmt: skip
        self.evaluation = Evaluation(meaning)
        self.words, self.slashes = words, slashes
        self.convention, self.stated, self.source, self.mechanism = convention, stated, source, mechanism
        self.variable = letter
        self.lines: list[tuple[str, str]] = []
        self.defined: list[tuple[str, str]] = []
        self.doubtful: list[str] = []
        self.weight: Formula | None = None
        self.forces: tuple[str, ...] = ()
        self.typesetter = Typesetter(words)

    def submission(self, rows: tuple[tuple[str, Formula], ...], lagrangian: Formula | None) -> Submission:
        """These rows, or this Lagrangian, as a derivation; after all lines have been read."""
        meaning = self.evaluation.meaning
        for letter in "lm" if meaning.space.n > 1 else "":
            indices = {index for used, index in meaning.used if used == letter}
            if 0 in indices and len(indices) > 1:
                raise InvalidInput(f"both {letter} and {letter}{max(indices)} are used; say what {letter} is, "
                                   f"or give every {letter} its index")  # fmt: skip
        return Submission(
            meaning.kind, meaning.space, rows, lagrangian, self.convention, self.stated, frozenset(meaning.used),
            meaning.equal_lengths, meaning.equal_masses, tuple(self.lines), tuple(dict.fromkeys(self.doubtful)),
            self.words, tuple(self.defined), self.source, self.mechanism, weight=self.weight,
        )  # fmt: skip

    @property
    def names(self) -> frozenset[str]:
        """What is defined so far."""
        return frozenset(self.evaluation.definitions) | frozenset(self.evaluation.meaning.named)

    def define(self, table: dict[str, Any]) -> None:
        """Read the file's own names."""
        for name, line in table.items():
            if name == "g" and isinstance(line, str) and plain_name(line.strip()) != "g":
                self.weight = number_of_gravity(line)  # with its unit
                if self.weight is None:
                    node = _located("define.g", self._expression, line)
                    self.weight = _located("define.g", self.evaluation.weight, node)
                    self.defined.append((name, self.typesetter.equation((node,))))
                else:
                    self.defined.append((name, line.strip()))
                continue
            if self._says_the_same(name, line):
                continue
            self._check_name(name)
            node = _located(f"define.{name}", self._expression, line)
            self.evaluation.definitions[name] = node
            self.defined.append((name, self.typesetter.equation((node,))))

    def _says_the_same(self, name: str, line: object) -> bool:
        """Whether ω_1 = θ̇_1 is all that is said: what the reader knows."""
        try:
            both = [parse_expression(self.written(x), self.names, self.words) for x in (name, line)]
        except InvalidInput:
            return False
        return all(isinstance(x, Symbol) and x.letter == "w" for x in both) and both[0] == replace(
            both[1], at=both[0].at
        )

    def _check_name(self, name: str) -> None:
        """Raises InvalidInput where a name is none, or means something already."""
        short, n = plain_name(name), self.evaluation.space.n
        if short is None or short in FUNCTIONS or not self._is_free(name, short):
            raise InvalidInput(f"define.{name!s:.40}: a name is a letter, then letters and digits, and not one in use")
        own = {plain_name(other) for other in self.names}
        base, index = base_and_index(name) or ("", "")
        figures = re.search(r"[0-9]+$", base)
        if not index and figures:
            base, index = base[: figures.start()], figures[0]
        counted = self.words.kind(base) is not None and base not in self.words.fixed and base != "g"
        numbers = self.words.numbers.get(base)
        taken = index in numbers if numbers else index.isdigit() and 1 <= int(index[:6]) <= n
        if base_word(base) == "alpha" and ACCELERATION.search(self.source):
            counted = False  # accelerations are written with dots or primes
        if short in own or (counted and taken):
            raise InvalidInput(f"define.{name!s:.40}: already has a meaning")

    def _is_free(self, name: str, short: str) -> bool:
        """Whether no convention has this letter for something else that the text may mean by it."""
        kinds = {kind for word in (name, short) if (kind := self.words.kind(word))}
        if self.words.declared:  # x, where the coordinate is x_t
            return not kinds or (short in self.words.numbers and kinds == {"t"})
        free = {"a": ACCELERATION, "w": RATE}
        if any(kind in free and free[kind].search(self.source) for kind in kinds):
            return True  # accelerations and rates are written with dots or primes
        return kinds <= ({"I"} if self.evaluation.meaning.kind == "rod-chain" else {"I", "r"})

    def _expression(self, line: object) -> Any:
        written = self.written(line)
        node = parse_expression(written, self.names, self.words, self.slashes)
        self._doubts(written)
        return node

    def written(self, line: object) -> str:
        """The line without layout, and with one spelling for the author's own variables."""
        plain = _line(line)
        return self.variable.rewritten(plain) if self.variable else plain

    def _doubts(self, written: str) -> None:
        self.doubtful += [written[start:end] for start, end in self.slashes.doubtful]
        self.slashes.doubtful.clear()

    def rows(self, table: object, name: str = "equations") -> tuple[tuple[str, Formula], ...]:
        """The rows of the field ``name``; one in matrices is as many as it has rows."""
        n = self.evaluation.space.n
        if isinstance(table, list):
            table = {str(i): line for i, line in enumerate(table, 1)}
        if isinstance(table, dict) and len(table) == 1 and n > 1:  # all rows in one text
            ((_, line),) = table.items()
            several = equations_of(_line(line)) if isinstance(line, str) and len(line) <= LONGEST_LINE else []
            table = {str(i): row for i, row in enumerate(several, 1)} if len(several) > 1 else table
        if not isinstance(table, dict) or not table:
            raise InvalidInput(f'{name}: a table of rows is needed, as in 1 = "m1*l1^2*a1 = -m1*g*l1*sin(t1)"')
        most = n if self.variable is None else 2 * n  # of first order: two for each angle
        most = n + len(self.forces) if self.forces and name == "equations" else most
        if len(table) > (most if self.variable else max(most, MOST_ROWS)):
            raise InvalidInput(f"{name}: {self._too_many(len(table))}")
        rows = self._read_rows(name, table, most)
        count = len(rows)
        given = len(self.mechanism.given) if self.mechanism else 0
        if len(rows) > most - given and self.variable is None:
            rows = stated_once(self.evaluation.space, rows, self.forces)
            if not most - given <= len(rows) <= most:
                raise InvalidInput(f"{name}: {self._too_many(count)}; {len(rows)} of them say different things")
        if self.forces and name == "equations":
            space, kind = self.evaluation.space, self.evaluation.meaning.kind
            return eliminated(space, rows, self.forces, bodies_of(self.mechanism, kind, space, self.convention))
        if len(rows) > n and self.variable and self.variable.kind == "rate":
            rows = [(label, f) for label, f in rows if f]  # θ̇ = ω, where both are the rate
            if len(rows) > n:
                raise InvalidInput(f"{name}: {self._too_many(len(rows))}")
        return tuple(rows)

    def _read_rows(self, name: str, table: dict[str, Any], most: int) -> list[tuple[str, Formula]]:
        rows: list[tuple[str, Formula]] = []
        for label, line in table.items():
            where = f"{name}.{label!s:.40}"
            try:
                found, text = _located(where, self._row, line)
            except InvalidInput as error:
                if len(table) <= most:
                    raise
                raise InvalidInput(f"{error}. And there are {self._too_many(len(table))}") from None
            self.lines.append((str(label)[:40], text))
            labels = [str(label)[:40]] if len(found) == 1 else [str(len(rows) + k) for k in range(1, len(found) + 1)]
            rows += zip(labels, found, strict=True)
            if len(rows) > (most if self.variable else max(most, MOST_ROWS)):
                raise InvalidInput(f"{where}: {self._too_many(len(rows))}")
        return rows

    def _too_many(self, count: int) -> str:
        return f"{count} rows for {self.evaluation.space.n} angles; one row for each angle is needed"

    def momenta(self, table: object) -> list[tuple[str, Formula]]:
        """What each momentum is said to be, as (its name, the momentum minus that)."""
        n = self.evaluation.space.n
        if not isinstance(table, dict) or not 1 <= len(table) <= n:
            raise InvalidInput('momenta: a table of one for each coordinate is needed, as in p1 = "m1*l1^2*w1"')
        rows = []
        for name, line in table.items():
            found, text = _located(f"momenta.{name!s:.20}", self._row, f"{name} = {line}")
            self.lines.append((str(name)[:20], text.partition(" = ")[2]))
            rows += [(str(name)[:20], f) for f in found]
        return rows

    def hold(self, steps: Mapping[str, str]) -> None:
        """Raises InvalidInput where the sides of a step, which a note writes as equal, are not."""
        for where, line in steps.items():
            if any(_located(where, self._row, line)[0]):
                raise InvalidInput(f"{where}: {line.strip()[:80]!r}: not equal; correct the step, or leave it out")

    def _row(self, line: object) -> tuple[list[Formula], str]:
        written = self.written(line)
        left, right = parse_equation(written, self.names, self.words, self.slashes, alone=self.evaluation.space.n == 1)
        self._doubts(written)
        other = self.evaluation.value(right)
        column = self.evaluation.column(left) if isinstance(other, Grid) else None
        value = self.evaluation.value(left) if column is None else column
        self.evaluation.budget.at = right.at
        difference = added(value, other, -1, self.evaluation.budget)
        text = self.typesetter.equation((left, right))
        if isinstance(difference, Grid):
            found = [entry.numerator for row in difference.rows for entry in row]
        else:
            found = [difference.numerator]
        space = self.evaluation.space
        return [without_squares(space, self._weighed(f)) for f in found], text

    def _weighed(self, f: Formula) -> Formula:
        space = self.evaluation.space
        return f if self.weight is None else space.replace(f, {4 * space.n: self.weight})

    def lagrangian(self, line: object) -> Formula:
        """The Lagrangian."""
        return self.formula("lagrangian", "L", line)

    def formula(self, where: str, label: str, line: object) -> Formula:
        """An expression without a sum in a denominator. ``label``: under which it is said back."""
        value = self.quotient(where, label, line)
        if value.denominator:
            raise InvalidInput(f"{where}: column 1: a sum in a denominator; here there is none")
        return self._weighed(value.numerator)

    def quotient(self, where: str, label: str, line: object) -> Quotient:
        """An expression; what people write in front of an energy is left out."""

        def read() -> Quotient:
            written = self.written(line)
            if where in LEFT_SIDE:
                written = LEFT_SIDE[where].sub(lambda m: " " * len(m[0]), written)
            node = parse_expression(written, self.names, self.words, self.slashes)
            self._doubts(written)
            self.lines.append((label, self.typesetter.equation((node,))))
            found = self.evaluation.scalar(node)
            return replace(found, numerator=self._weighed(found.numerator))

        return _located(where, read)


def _line(line: object) -> str:
    if not isinstance(line, str):
        raise InvalidInput(f"column 1: a text in quotes is needed, got {line!r:.40}")
    return laid_out(from_srepr(line))


def _located(where: str, read: Callable[..., T], *arguments: Any) -> T:
    """The result of ``read``; where it raises InvalidInput, the field is put before the message."""
    try:
        return read(*arguments)
    except InvalidInput as error:
        raise InvalidInput(f"{where}: {error}") from None
