"""How every report writes figures, counts, times, and text that came from outside."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal

from ..records.check import EngineEntry, Outcome, Result
from ..records.exit_status import AGREES, DIFFERS
from ..records.printable import printable as printable  # noqa: PLC0414 (reports take it from here)

if TYPE_CHECKING:
    from ..records.bench import Speed

# How a report calls a result: its outcome, or "loose" where it agrees only loosely.
Word = Outcome | Literal["loose"]
WORDS: tuple[Word, ...] = ("differs", "error", "loose", "agrees", "skipped")  # the gravest first
# A glyph beside the word, so that no outcome is told by colour alone.
GLYPHS: dict[Word, str] = {"agrees": "✓", "loose": "≈", "differs": "✗", "skipped": "–", "error": "!"}
LEGEND = "ε: worst error as a multiple of rounding; ×: as a multiple of what is allowed"

LONGEST_LINE = 20_000  # characters: a sentence is never cut, a runaway text is

# A benchmark: whether a target is met, and whether verdicts are the same with a skip and without.
SAME = {True: "the same {}", False: "NOT the same ({})"}
UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def figure(value: float | None) -> str:
    """Two significant digits, as many as an error has: ``0.031``, ``3.1``, ``340``, ``1.2e-14``; ``∞`` and ``NaN``."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if 1e-2 <= abs(value) < 9999.5:
        return f"{value:.2g}" if abs(value) < 99.5 else f"{value:.0f}"
    if not math.isfinite(value):
        return "∞" if value > 0 else "−∞" if value < 0 else "NaN"
    mantissa, _, exponent = f"{value:.1e}".partition("e")
    return f"{mantissa}e{int(exponent)}"


def package_of(engine: EngineEntry | None) -> str:
    """An engine's package and its version; empty for an adapter that has none, and for one that is not known."""
    return f"{engine.package} {engine.version or 'not installed'}" if engine and engine.package else ""


def count(number: int, noun: str) -> str:
    """``1 check``, ``3 checks``, ``1,200 checks``."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def word(result: Result) -> Word:
    """The result's outcome, or ``loose`` where it agrees only loosely."""
    return "loose" if result.loose and result.outcome == "agrees" else result.outcome


def outcome_of(exit_status: int) -> Outcome:
    """The outcome whose glyph and colour a run with this exit status has: one that is not whole, an error's."""
    outcomes: dict[int, Outcome] = {AGREES: "agrees", DIFFERS: "differs"}
    return outcomes.get(exit_status, "error")


def tally(number: int, outcome: Word) -> str:
    """``1 agrees``, ``2 agree``, ``1 error``, ``2 errors``, ``3 skipped``, ``4 loose``."""
    plural = {"agrees": "agree", "differs": "differ", "error": "errors"}
    return f"{number:,} {outcome if number == 1 else plural.get(outcome, outcome)}"


def duration(seconds: float) -> str:
    """Three significant digits, in s, ms, µs or ns: ``8.71 ns``, ``1.2 µs``, ``340 ms``, ``12 s``."""
    size, unit = next(((size, unit) for size, unit in UNITS if seconds >= size), UNITS[-1])
    return f"{_three(seconds / size)} {unit}"


def multiple(ratio: float) -> str:
    """A ratio: ``0.82×``, ``134×``, ``9,400×``."""
    return f"{ratio:,.0f}×" if ratio >= 99.95 else f"{_three(ratio)}×"


def batch(speed: Speed) -> str:
    """States in a call, and threads where there are several."""
    return f"{speed.states:,}" + (f", {speed.threads} threads" if speed.threads > 1 else "")


def link_words(system: str, n: int) -> str:
    """The mechanism: ``100 rods``, ``1 leg``."""
    count, noun = (n - 1, "leg") if system == "n-leg" else (n, "rod")
    return f"{count} {noun}{'' if count == 1 else 's'}"


def speed_words(speed: Speed) -> str:
    """The mechanism of a row: as :func:`link_words`, or ``cart-pole, 2 degrees of freedom``."""
    return f"{speed.scene}, {count(speed.n, 'degree')} of freedom" if speed.scene else link_words(speed.system, speed.n)


def one_line(text: str, longest: int = LONGEST_LINE) -> str:
    """:func:`printable`, on one line, at most ``longest`` characters long."""
    line = " ".join(printable(text[: 8 * longest]).split())
    return line if len(line) <= longest else line[: longest - 1] + "…"


def last_line(reason: str) -> str:
    """The line of a traceback that names the exception; another reason as it is."""
    return reason.strip().splitlines()[-1] if reason.startswith("Traceback") else reason


def listed(names: Iterable[str], most: int = 40) -> str:
    """The names in the order in which they first come; of more than ``most``, how many are left out."""
    known = list(dict.fromkeys(names))
    shown = ", ".join(one_line(name, 80) for name in known[:most])
    return shown if len(known) <= most else f"{shown} and {len(known) - most} more"


def list_of(values: Sequence[float], longest: int = 8) -> str:
    """``1, 0.8, 0.6``; of more than ``longest``, how many there are."""
    shown = ", ".join(f"{value:.6g}" for value in values[:longest])
    return shown if len(values) <= longest else f"{shown}, … ({len(values)} in all)"


def few(names: Iterable[str], noun: str) -> str:
    """Up to three names in full, more as their number."""
    known = sorted(set(names))
    return ", ".join(one_line(name, 40) for name in known) if len(known) <= 3 else count(len(known), noun)


def _three(value: float) -> str:
    return f"{value:.0f}" if value >= 99.95 else f"{value:.3g}"
