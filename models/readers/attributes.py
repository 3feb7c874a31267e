"""Reads numbers and words from the attributes of an element; errors name the file, the line and the attribute."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidInput, nearest
from .xml_file import Element

Array = NDArray[np.float64]

LARGEST = 1e50  # beyond it products of a few numbers overflow


def numbers(element: Element, attribute: str, count: int | tuple[int, int], otherwise: Sequence[float] = ()) -> Array:
    """The attribute's numbers: exactly ``count``, or between two counts; ``otherwise`` where it is not given.

    Like all functions here it raises :class:`InvalidInput` where the attribute is malformed.
    """
    text = element.attributes.get(attribute)
    if text is None:
        return np.array(otherwise, dtype=np.float64)
    least, most = (count, count) if isinstance(count, int) else count
    words = text.split()
    if not least <= len(words) <= most:
        wanted = str(least) if least == most else f"{least} to {most}"
        raise element.wrong(f"{attribute}={text[:60]!r}: {wanted} number{'s' * (most > 1)} needed, got {len(words)}")
    return np.array([_number(element, attribute, word) for word in words])


def number(element: Element, attribute: str, otherwise: float = 0.0) -> float:
    """The attribute's one number."""
    return float(numbers(element, attribute, 1, (otherwise,))[0])


def not_negative(element: Element, attribute: str, otherwise: float = 0.0) -> float:
    """The attribute's one number, zero or more."""
    value = number(element, attribute, otherwise)
    if value < 0:
        raise element.wrong(f"{attribute}={element.get(attribute)!r}: must not be negative")
    return value


def word(element: Element, attribute: str, known: Sequence[str], otherwise: str) -> str:
    """The attribute's word, one of those known."""
    given = element.get(attribute, otherwise)
    if given not in known:
        hint = nearest(given, known) or f"; one of {', '.join(known)} is"
        raise element.wrong(f"{attribute}={given[:60]!r} is not known{hint}")
    return given


def yes(element: Element, attribute: str, otherwise: bool) -> bool:
    """The attribute's ``true`` or ``false``."""
    return word(element, attribute, ("true", "false"), "true" if otherwise else "false") == "true"


def _number(element: Element, attribute: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise element.wrong(f"{attribute}: {text[:60]!r} is no number") from None
    if not abs(value) <= LARGEST or "_" in text:
        raise element.wrong(f"{attribute}: {text[:60]!r}: a finite number up to {LARGEST:g} is needed")
    return value


def axis(element: Element, attribute: str, otherwise: Sequence[float]) -> Array:
    """A direction (3,), scaled to unit length."""
    given = numbers(element, attribute, 3, otherwise)
    length = math.hypot(*given)
    if length < 1e-10:
        raise element.wrong(f"{attribute}={element.get(attribute)!r}: a direction is needed, not zero")
    return np.asarray(given / length)


def refuse(element: Element, says: str) -> InvalidInput:
    """The error for an element that no planar tree of hinges has, to be raised."""
    return element.wrong(f"{says}: not a planar tree of hinges")
