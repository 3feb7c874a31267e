"""What tells one language from another, as data."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Language:
    """``wraps``: what a fragment may stand in; ``whole``: 1/2 is 0; ``powers``: its signs for powers; ``first``: what
    entries are counted from; ``declares``: whether a name has to be declared before it is set; ``copies``: whether a
    struct is copied when it is given another name; ``blank``: words of its texts that say nothing of values."""

    name: str
    grammar: str
    cue: re.Pattern[str]
    function: str = "language"
    not_if: re.Pattern[str] | None = None
    wraps: tuple[tuple[str, str], ...] = (("", ""),)
    whole: bool = True
    powers: frozenset[str] = frozenset()
    first: int = 0
    declares: bool = True
    copies: bool = False
    is_linear: bool = False  # * of two arrays is a product of matrices
    by_columns: bool = False  # mat2(a, b, c, d) has the columns (a, b) and (c, d)
    blank: re.Pattern[str] | None = None
    spaced: re.Pattern[str] | None = None  # a sign that its grammar takes for another thing without blanks
    fills: bool = False  # a = [b, c] fills the array that a function was given
