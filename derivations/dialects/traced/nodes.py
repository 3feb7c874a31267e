"""A program's text as a tree: expressions and statements, one kind for all languages. Nothing is run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Number:
    """A number as it is written."""

    text: str


@dataclass(frozen=True)
class Text:
    """A text in quotes."""

    text: str


@dataclass(frozen=True)
class Word:
    """A name."""

    name: str


@dataclass(frozen=True)
class Member:
    """``of.name``"""

    of: Node
    name: str


@dataclass(frozen=True)
class At:
    """Entries in square brackets, or in MATLAB's braces."""

    of: Node
    places: tuple[Node, ...]


@dataclass(frozen=True)
class Call:
    """A function of arguments; in MATLAB also the entries of a matrix."""

    of: Node
    arguments: tuple[Node, ...]
    named: tuple[tuple[str, Node], ...] = ()


@dataclass(frozen=True)
class Unary:
    """A sign in front."""

    sign: str
    of: Node


@dataclass(frozen=True)
class Binary:
    """Two values and an operator between them, as MATLAB writes it: * of arrays is ``.*`` where that is meant."""

    sign: str
    left: Node
    right: Node


@dataclass(frozen=True)
class Turned:
    """A transposed matrix."""

    of: Node


@dataclass(frozen=True)
class Listed:
    """A list or a tuple."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Block:
    """A matrix in MATLAB's brackets, of matrices too."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True)
class Span:
    """From here to there; both ends may be left out."""

    first: Node | None = None
    last: Node | None = None
    step: Node | None = None


@dataclass(frozen=True)
class Dots:
    """The ellipsis of x[..., 0]."""


@dataclass(frozen=True)
class Nameless:
    """A function without a name; ``body``: its statements in front of what it gives back."""

    parameters: tuple[str, ...]
    value: Node
    body: tuple[Statement, ...] = ()


@dataclass(frozen=True)
class Either:
    """One of two values, by a test."""

    test: Node
    value: Node
    otherwise: Node


@dataclass(frozen=True)
class Each:
    """The list of a value for each of some numbers, [value for name in over if tests]."""

    value: Node
    name: str
    over: Node
    tests: tuple[Node, ...] = ()


@dataclass(frozen=True)
class Fields:
    """A thing with named parts; ``base``: another one, whose parts it has besides."""

    names: tuple[str, ...]
    values: tuple[Node, ...]
    base: Node | None = None


@dataclass(frozen=True)
class Pairs:
    """Values by keys, {key: value}."""

    keys: tuple[Node, ...]
    values: tuple[Node, ...]
    text: str


@dataclass(frozen=True)
class Primed:
    """A derivative by time, written with primes behind."""

    of: Node
    order: int


@dataclass(frozen=True)
class Strange:
    """An expression of a kind that is not followed."""

    text: str


Node = (
    Number
    | Text
    | Word
    | Member
    | At
    | Call
    | Unary
    | Binary
    | Turned
    | Listed
    | Block
    | Span
    | Dots
    | Nameless
    | Either
    | Each
    | Fields
    | Pairs
    | Primed
    | Strange
)


@dataclass(frozen=True)
class Assign:
    """``targets`` = ``value``; ``sign``: of an assignment in place, as + of +=; ``outer``: of a name around it."""

    target: Node
    value: Node
    line: str
    sign: str = ""
    outer: bool = False


@dataclass(frozen=True)
class Return:
    """What a function gives back."""

    value: Node | None
    line: str


@dataclass(frozen=True)
class Do:
    """An expression that stands alone."""

    value: Node
    line: str


@dataclass(frozen=True)
class Define:
    """A function. ``outs``: the names of what it gives back, in MATLAB; ``is_method``: its first parameter is self."""

    name: str
    parameters: tuple[str, ...]
    outs: tuple[str, ...]
    body: tuple[Statement, ...]
    of: str = ""
    shared: tuple[str, ...] = ()  # parameters whose change the caller sees
    optional: tuple[str, ...] = ()  # parameters that need not be given


@dataclass(frozen=True)
class Repeat:
    """A loop that counts."""

    name: str
    over: Node
    body: tuple[Statement, ...]
    line: str


@dataclass(frozen=True)
class Loop:
    """A loop while a test holds; ``after``: what is done at the end of each turn."""

    test: Node
    after: tuple[Statement, ...]
    body: tuple[Statement, ...]
    line: str


@dataclass(frozen=True)
class Choice:
    """One body or another, by a test. ``names``: what either may change, as of a statement that is not followed."""

    test: Node
    body: tuple[Statement, ...]
    otherwise: tuple[Statement, ...]
    line: str
    names: tuple[str, ...]


@dataclass(frozen=True)
class Leave:
    """``kind``: "continue" with the loop's next number, "break" it off, or "" where a test that is not known says."""

    kind: str
    line: str


@dataclass(frozen=True)
class Unfollowed:
    """A statement of a kind that is not followed. ``names``: what it may change; refused where one is needed."""

    line: str
    names: tuple[str, ...] = ()


Statement = Assign | Return | Do | Define | Repeat | Loop | Choice | Leave | Unfollowed


def dotted(node: Node) -> str | None:
    """self.p.m of such names."""
    if isinstance(node, Word):
        return node.name
    if isinstance(node, Member):
        of = dotted(node.of)
        return None if of is None else f"{of}.{node.name}"
    return None


def set_by(target: Node) -> list[str]:
    """The names that an assignment sets."""
    match target:
        case Word(name=name):
            return [name]
        case Member():
            path = dotted(target)
            return [path] if path else []
        case Listed(items=items):
            return [name for item in items for name in set_by(item)]
        case At(of=of) | Call(of=of):
            return set_by(of)
    return []


def all_entries(targets: tuple[Node, ...], size: int) -> str:
    """The name whose entries, all of them and in order, are set at once; an empty text where that is not so."""
    found = {of.name if t.text == str(k) else "" for k, one in enumerate(targets) if isinstance(one, At)
             for of, t in ((one.of, one.places[0]),) if isinstance(of, Word) and isinstance(t, Number)}  # fmt: skip
    is_each = all(isinstance(one, At) and len(one.places) == 1 for one in targets)
    return found.pop() if len(found) == 1 and is_each and len(targets) == size else ""


SMALLEST = 1e-6  # below which a number is set against a division by zero alone


def is_guard(choice: Choice) -> bool:
    """if abs(den) < 1e-12: den = 1e-12, that says nothing of any other den."""
    match choice.test:
        case Binary(sign="<" | "<=", left=Call(of=of, arguments=(Word(name=name),)), right=Number(text=text)):
            is_small = (dotted(of) or "").rpartition(".")[2] in ("abs", "fabs", "absolute") and _below(text)
        case Binary(sign="==", left=Word(name=name), right=Number(text=text)):
            is_small = _below(text)
        case _:
            return False
    inner = [*choice.body, *choice.otherwise]
    sets = all(isinstance(s, Assign) and isinstance(s.target, Word) and s.target.name == name for s in inner)
    return is_small and not choice.otherwise and sets


def _below(text: str) -> bool:
    try:
        return float(text) <= SMALLEST
    except ValueError:
        return False
