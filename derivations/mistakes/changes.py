"""Changes of a derivation that several kinds of mistake share: replace, drop, scale, or do so for every mass."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from ..algebra.symbols import Symbols
from ..algebra.trig import Formula
from ..steps.derivation import Derivation, Mistake, Stage

K = TypeVar("K")
V = TypeVar("V")


def put(parts: list[dict[K, V]], b: int, key: K, value: V) -> None:
    """Replace one part of mass b, leaving the shared original as it is."""
    parts[b] = {**parts[b], key: value}


def drop(parts: list[dict[K, V]], b: int, key: K) -> None:
    """Leave one part of mass b out."""
    parts[b] = {k: v for k, v in parts[b].items() if k != key}


def at(change: Callable[[Derivation, int], None], b: int) -> Callable[[Derivation], None]:
    """A change made at one place."""
    return lambda d: change(d, b)


def times(factor: Formula) -> Callable[[Formula], Formula]:
    """Multiplication by a factor."""
    return lambda f: f * factor


def instead(value: Formula) -> Callable[[Formula], Formula]:
    """Replacement by a value."""
    return lambda f: value


def body(m: Symbols, b: int) -> tuple[str, str]:
    """The name of mass b in English and Japanese."""
    return (f"rod {b + 1}", f"棒{b + 1}") if m.kind == "rod-chain" else (f"mass {b + 1}", f"質点{b + 1}")


def everywhere(
    code: str, stage: Stage, english: str, japanese: str, change: Callable[[Derivation, int], None]
) -> Mistake:
    """The same change made for every mass (or row)."""

    def apply(d: Derivation) -> None:
        for b in range(d.n):
            change(d, b)

    return Mistake(code, stage, (), english, japanese, apply)
