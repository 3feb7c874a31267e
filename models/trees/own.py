"""A user's own equations of motion in a scene file, held against its mechanism; plain texts, which nothing here reads.

A scene file with everything that they may have::

    model = "cart-pole.xml"              # or [system], with links and joints

    angles = "absolute"                  # or "relative"; without angles, from and sense: the joints' own coordinates
    from = "up"                          # down, up, right, left: what the angles are measured from
    sense = "clockwise"                  # seen with x to the right and z upwards; or a list, one a joint

    [symbols]
    x = "slider"                         # a coordinate of the equations: the joint that it is
    theta = "hinge"
    M = 1.0                              # a number of the equations

    [define]
    s = "sin(theta)"

    [equations]                          # or lagrangian = "…", or function = '''def …'''
    1 = "(M + m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*s = 0"
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..errors import InvalidInput, nearest
from .system import TreeSystem

OWN = "own equations"  # the name by which they take part in a run, like an engine
IN_MODEL = "model: "  # how the place of a cause begins that is in the mechanism, not in the equations
LARGEST = 200_000  # characters of all equations together
MOST = 200  # entries of a table
KINDS_OF_TEXT = ("equations", "lagrangian", "function")
FIELDS = (*KINDS_OF_TEXT, "define", "symbols", "angles", "from", "sense")
Texts = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class OwnEquations:
    """One of ``rows`` (label, text), ``lagrangian`` and ``function`` (a Python function's text) is there.

    ``define``: names and what they stand for; ``joints``: coordinate and joint; ``numbers``: constant and value, SI.
    ``angles``, ``origin``, ``senses``: how angles are counted, each empty where the file does not say.
    """

    rows: Texts = ()
    lagrangian: str = ""
    function: str = ""
    define: Texts = ()
    joints: Texts = ()
    numbers: tuple[tuple[str, float], ...] = ()
    angles: str = ""
    origin: str = ""
    senses: tuple[str, ...] = ()

    @property
    def texts(self) -> tuple[str, ...]:
        """All mathematics that the file has."""
        given = (self.lagrangian, self.function)
        return (*(text for _, text in (*self.define, *self.rows)), *(text for text in given if text))

    @property
    def declares_angles(self) -> bool:
        """Whether the file says how angles are counted."""
        return bool(self.angles or self.origin or self.senses)


def split_off(tables: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """A scene file's tables without the user's equations and what belongs to them, and these; empty if none is there.

    ``model`` at the top stands for a [system] of that file.
    """
    rest = dict(tables)
    if "model" in rest and "system" not in rest:
        rest["system"] = {"kind": "tree", "model": rest.pop("model")}
    given = [name for name in KINDS_OF_TEXT if name in rest and not isinstance(rest[name], list)]
    if not given:
        return rest, {}
    return rest, {name: rest.pop(name) for name in FIELDS if name in rest}


def own_equations(tables: dict[str, Any], system: TreeSystem) -> OwnEquations | None:
    """The equations in these tables; None where there are none. Raises :class:`InvalidInput` with the field."""
    if not tables:
        return None
    given = [name for name in KINDS_OF_TEXT if name in tables]
    if len(given) > 1:
        raise InvalidInput(f"{given[1]}: {given[0]} is given already; give one of {', '.join(KINDS_OF_TEXT)}")
    if "define" in tables and "function" in tables:
        raise InvalidInput("define: a function has its own names; write them in it")
    joints, numbers = _symbols(tables.get("symbols", {}), system)
    own = OwnEquations(
        rows=_texts("equations", tables.get("equations", {})),
        lagrangian=_text("lagrangian", tables.get("lagrangian", "")),
        function=_text("function", tables.get("function", "")),
        define=_texts("define", tables.get("define", {})),
        joints=joints,
        numbers=numbers,
        angles=_text("angles", tables.get("angles", "")),
        origin=_text("from", tables.get("from", "")),
        senses=_senses(tables.get("sense", [])),
    )
    if not own.texts:
        raise InvalidInput(f"{given[0]}: nothing is there")
    if sum(map(len, own.texts)) > LARGEST:
        raise InvalidInput(f"{given[0]}: longer than {LARGEST} characters; equations of motion are not")
    return own


def _text(field: str, value: object) -> str:
    if not isinstance(value, str):
        raise InvalidInput(f"{field}: a text in quotes is needed, got {value!r:.40}")
    return value


def _texts(field: str, table: object) -> Texts:
    if not isinstance(table, dict) or len(table) > MOST:
        raise InvalidInput(f"{field}: a table of at most {MOST} texts is needed")
    return tuple((str(name), _text(f"{field}.{name!s:.40}", value)) for name, value in table.items())


def _senses(value: object) -> tuple[str, ...]:
    senses = value if isinstance(value, list) else [value]
    if len(senses) > MOST:
        raise InvalidInput("sense: one for each joint is needed")
    return tuple(_text("sense", sense) for sense in senses)


def _symbols(table: object, system: TreeSystem) -> tuple[Texts, tuple[tuple[str, float], ...]]:
    if not isinstance(table, dict) or len(table) > MOST:
        raise InvalidInput(f'symbols: a table of at most {MOST} is needed, as in x = "slider", m = 0.2')
    names = [joint.name for joint in system.joints]
    joints: dict[str, str] = {}
    numbers: dict[str, float] = {}
    for name, value in table.items():
        where = f"symbols.{name!s:.40}"
        if isinstance(value, str):
            if value not in names:
                raise InvalidInput(f"{where}: no joint is called {value!r:.60}{nearest(value, names)}; "
                                   f"there are {', '.join(names[:20])}")  # fmt: skip
            if value in joints.values():
                raise InvalidInput(f"{where}: {value!r:.60} has a coordinate already")
            joints[name] = value
        elif isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= 1e9:
            numbers[name] = float(value)
        else:
            raise InvalidInput(f"{where}: the name of a joint, or a finite number, is needed, got {value!r:.40}")
    return tuple(joints.items()), tuple(numbers.items())
