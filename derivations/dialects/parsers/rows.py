"""Rows of equations of motion from a program that a parser of this folder reads."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Any

from ....models.errors import InvalidInput
from ..grammars.languages.language import Language
from ..grammars.rows import DOWN, GrammarReader
from ..traced import nodes
from ..traced.forms import Rows
from ..traced.meaning import Meaning
from ..traced.names import Scope
from ..traced.rows import LONGEST_TEXT, TOO_DEEP, one_text, prefix_for
from ..traced.values import Doubtful, Formula, NotFollowed, Record
from .fortran import FORTRAN, fortran_tree
from .lua import LUA, lua_tree
from .r import R, r_tree


def from_parsers(data: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]] | None:
    """The fields with rows in place of a program, and the line that each definition is from; None for other texts.

    Raises InvalidInput where it is a program and cannot be taken as it is meant.
    """
    one = one_text(data)
    if one is None or len(one[1]) > LONGEST_TEXT or "\\begin" in one[1] or "\\frac" in one[1]:
        return None
    label, text, found = one
    try:
        names = {
            *found.quantities,
            *found.coordinates,
            *found.written,
            *(re.sub(r"\W.*", "", str(k)) for k in found.defined),
            *found.free,
        }
        language, statements = tree_of(text, {name for name in names if name.isidentifier()})
    except NotFollowed as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    if language is None or not any(isinstance(s, nodes.Define) for s in statements):
        return None
    twice = next(
        (s.name for s in statements if isinstance(s, nodes.Define) and len(set(s.parameters)) < len(s.parameters)), None
    )
    if twice is not None:
        raise InvalidInput(
            f"equations.{label:.40}: two parameters of {twice} have one name; give each a name of its own"
        )
    if found.is_downwards(text):
        raise InvalidInput(f"equations.{label:.40}: {DOWN}")
    try:
        return ProgramReader(data, found, statements, language, prefix_for(text)).read()
    except NotFollowed as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    except RecursionError:
        raise InvalidInput(f"equations.{label:.40}: {TOO_DEEP}") from None


class ProgramReader(GrammarReader):
    """In R the state has names where it begins, state <- c(theta = 1, w = 0): its derivatives are in their order."""

    def _named_state(self) -> list[str]:
        """The names of the state, in its order; none where the text does not say them."""
        for value in self.follower.pristine.values():
            if isinstance(value, Record) and len(value.fields) == 2 * self.count:
                places = {self.known.coordinate(name) for name in value.fields} - {None}
                if len(places) == self.count:
                    return list(value.fields)
        return []

    def _from_record(self, value: Record, scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        names = self._named_state()
        if names and set(names) == value.fields.keys() and names != list(value.fields):
            raise Doubtful("the derivatives are given back in another order than the state has; names do not sort them")
        return super()._from_record(value, scope, parameters)

    def _of_state(self, entries: list[Formula], scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        names, paths = self._named_state(), self._paths(entries)
        if self.own_state is None and names and not any(isinstance(p, int) for path in paths for p in path):
            self.own_state = [next((path for path in paths if path[-1] == name), (name,)) for name in names]
        return super()._of_state(entries, scope, parameters)


def tree_of(text: str, names: Collection[str]) -> tuple[Language | None, Sequence[nodes.Statement]]:
    """The language of a text, and its statements. ``names``: as the file spells them."""
    for language, tree in ((R, r_tree(text)), (FORTRAN, fortran_tree(text, names)), (LUA, lua_tree(text))):
        if tree is not None:
            return language, tree
    return None, ()
