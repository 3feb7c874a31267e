"""How both reports of a benchmark write times, ratios and batches."""

from __future__ import annotations

from ..records.bench import Speed

SAME = {True: "the same {}", False: "NOT the same ({})"}
UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def duration(seconds: float) -> str:
    """Three significant digits in the unit that suits: ``8.71 ns``, ``1.2 µs``, ``340 ms``, ``12 s``."""
    size, unit = next(((size, unit) for size, unit in UNITS if seconds >= size), UNITS[-1])
    return f"{_three(seconds / size)} {unit}"


def times(ratio: float) -> str:
    """A ratio: ``0.82×``, ``134×``, ``9,400×``."""
    return f"{ratio:,.0f}×" if ratio >= 99.95 else f"{_three(ratio)}×"


def batch(speed: Speed) -> str:
    """States in a call, and threads where there are several."""
    return f"{speed.states:,}" + (f", {speed.threads} threads" if speed.threads > 1 else "")


def link_words(system: str, n: int) -> str:
    """The mechanism: ``100 rods``, ``1 leg``."""
    count, noun = (n - 1, "leg") if system == "n-leg" else (n, "rod")
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _three(value: float) -> str:
    return f"{value:.0f}" if value >= 99.95 else f"{value:.3g}"
