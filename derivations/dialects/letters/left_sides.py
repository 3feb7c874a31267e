# ruff: noqa: E501 -- patterns stand on one line
r"""What people write in front of a formula that a field asks for: E_{kin} =, \mathcal L = E_c - E_p =, x_1 =.

In front of a position or a velocity the name must be the field's own; anything else is refused, not dropped.
"""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..names import plain_name
from .every_text import is_fit

_FONT = r"(?:\\(?:mathcal|mathscr|mathrm|mathit|mathfrak|text)\s*)?"
_INDEX = r"(?:\s*_\s*(?:\{\s*\\?[A-Za-z., ]{1,12}\s*\}|[A-Za-z]))?"


def _letter(letters: str) -> str:
    return rf"(?:{_FONT}\{{\s*[{letters}]\s*\}}|{_FONT}[{letters}](?![A-Za-z])){_INDEX}"


_OF = r"\s*(?:\\left\s*)?(?:\([^=()]{0,200}(?:\([^=()]{0,40}\)[^=()]{0,80}){0,6}\))?\s*"
_BEGINS = r"^(?:\s|\\begin\s*\{(?:multline|equation|align|gather|split|aligned|gathered|eqnarray)\*?\}|\\\[|\$\$?|&|\\displaystyle)*"
_IS = r"\s*(?:&\s*)?(?::=|=|\\equiv|\\coloneqq)\s*(?:&\s*)?"
_T, _U = _letter("TKEW"), _letter("UVEWP")
FRONT = {
    "kinetic": re.compile(rf"{_BEGINS}(?:{_T}|KE|EK|Ekin){_OF}{_IS}"),
    "potential": re.compile(rf"{_BEGINS}(?:{_U}|PE|EP|Epot){_OF}{_IS}"),
    "lagrangian": re.compile(rf"{_BEGINS}{_letter('L')}{_OF}{_IS}(?:{_T}{_OF}\s*[-−]\s*{_U}{_OF}{_IS})?"),
    "hamiltonian": re.compile(rf"{_BEGINS}{_letter('H')}{_OF}{_IS}(?:{_T}{_OF}\s*\+\s*{_U}{_OF}{_IS})?"),
}
POTENTIAL_WORD = re.compile(r"pot|p\b", re.IGNORECASE)
KINETIC_WORD = re.compile(r"kin|k\b|c\b", re.IGNORECASE)
COMPONENT = re.compile(r"^\s*(?P<left>[^=]{1,40}?)\s*(?:&\s*)?=\s*(?P<rest>[^=]+)$", re.DOTALL)


def without_left_sides(data: dict[str, Any]) -> dict[str, Any]:
    """The fields without names in front of energies and components. Raises InvalidInput where a name is another's."""
    made = dict(data)
    for field, pattern in FRONT.items():
        if not is_fit(data.get(field)):
            continue
        found = pattern.match(data[field])
        other = {"kinetic": POTENTIAL_WORD, "potential": KINETIC_WORD}.get(field)
        if (
            found
            and other
            and other.search(re.sub(r"\\[a-z]+|[(].*", "", found[0].partition("=")[0]).partition("_")[2])
        ):
            raise InvalidInput(f"{field}: {found[0].strip()[:30]} stands in front; is it the {field} energy?")
        if found:
            made[field] = re.sub(r"^\\end\s*\{\w+\*?\}", "", data[field][found.end() :])
    for table in ("positions", "velocities"):
        entries = data.get(table)
        if isinstance(entries, dict):
            made[table] = {name: _component(table, str(name), line) for name, line in entries.items()}
    return made


def _component(table: str, name: str, line: Any) -> Any:
    found = COMPONENT.match(line) if is_fit(line) else None
    if found is None:
        return line
    said, asked = _short(found["left"]), _short(name)
    if said != asked:
        raise InvalidInput(
            f"{table}.{name:.20}: {found['left'].strip()[:20]} = stands in front; give each its own field"
        )
    return found["rest"]


def _short(name: str) -> str:
    """x1 of x_1, \\dot x_1, v_{x1} and vx1."""
    bare = re.sub(r"\\(?:left|right|dot|mathrm|text|vec)|dot|[{}_\\\s'′,&$\u0307]|\(\s*t\s*\)", "", name)
    return (plain_name(bare) or bare).lower().removeprefix("v").removeprefix("d")
