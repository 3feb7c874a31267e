"""Advice on engine, integrator and step, in the terminal."""

from __future__ import annotations

import sys
from typing import TextIO

from ...records.bench import Advice, Advised
from ..words import duration, figure, link_words
from .console import PlainConsole


def print_advice(found: Advice, file: TextIO | None = None) -> None:
    """Print what to use first, then every method, and those that do not reach the error."""
    console = PlainConsole(file or sys.stdout, None)
    motion = f"{found.scene} ({link_words(found.system, found.n)}) over {found.duration:g} s"
    best = next((each for each in found.advised if each.engine != "furiko"), None)
    if best is None:
        console.line(f"No engine's integrator keeps an error of {found.asked:g} in {motion}.", "bold")
    else:
        console.line(
            f"Use {best.engine} with {best.scheme}, {_setting(best)}: an error of {best.error:.1e} in {motion}, "
            f"computed in {duration(best.seconds)}.",
            "bold",
        )
    if found.advised:
        console.line()
        console.table(
            ("engine", "scheme", "largest setting", "error", "time", "error one coarser"),
            [
                (each.engine, each.scheme, _setting(each), f"{each.error:.1e}", duration(each.seconds), _coarser(each))
                for each in found.advised
            ],
        )
    if found.not_advised:
        console.line()
        console.line(f"Not within {found.asked:g}:")
        console.table(
            ("engine", "scheme", "smallest error", "why none smaller"),
            [(each.engine, each.scheme, figure(each.error), each.reason) for each in found.not_advised],
        )
    for left_out in found.left_out:
        console.line(f"left out: {left_out}", "dim")
    console.line()
    console.line(
        "Errors: the largest of θ [rad] and ω [rad/s] at half, three quarters and all of the time, measured against a "
        f"motion that is known to {found.truth:.0e}.",
        "dim",
    )


def _setting(each: Advised) -> str:
    kind, _, unit = each.by.partition(" [")
    return f"{kind} {each.setting:.4g}" + (f" {unit.rstrip(']')}" if unit else "")


def _coarser(each: Advised) -> str:
    if each.coarser_setting is None:
        return "nothing coarser was tried"
    return "failed" if each.coarser_error is None else f"{each.coarser_error:.1e}"
