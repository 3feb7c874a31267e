"""Advice on engine, integrator and step, in the terminal."""

from __future__ import annotations

import sys
from typing import TextIO

from ...records.bench import Advice, Advised, TrustLimit
from ..words import count, duration, figure, link_words
from .console import PlainConsole


def print_advice(found: Advice, file: TextIO | None = None) -> None:
    """Print what to use first, then every method, and those that do not reach the error."""
    console = PlainConsole(file or sys.stdout, None)
    if found.trust:
        _print_trust(console, found)
    if found.trust and not found.duration:
        return
    mechanism = f"{count(found.n, 'degree')} of freedom" if found.trust else link_words(found.system, found.n)
    motion = f"{found.scene} ({mechanism}) over {found.duration:g} s"
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
    _print_long_runs(console, found)
    for left_out in found.left_out:
        console.line(f"left out: {left_out}", "dim")
    console.line()
    numbers = "coordinates and rates" if found.trust else "θ [rad] and ω [rad/s]"
    console.line(
        f"Errors: the largest of {numbers} at half, three quarters and all of the time, measured against a motion that "
        f"is known to {found.truth:.0e}.",
        "dim",
    )


def _print_long_runs(console: PlainConsole, found: Advice) -> None:
    """What the advised integrators keep in the long run, of the scene and of motions that are known for ever."""
    if not found.long_runs:
        return
    console.line()
    console.line("In the long run, with these steps, of the scene itself and of motions known for ever:", "bold")
    console.table(
        ("engine", "scheme", "motion", "after", "phase error", "energy drift", "quaternion length", ""),
        [
            (
                each.engine,
                each.scheme,
                each.says,
                f"{each.time:g} s",
                figure(each.phase_error),
                figure(each.energy_drift),
                figure(each.length_drift),
                each.failure or "",
            )
            for each in found.long_runs
        ],
    )


def _print_trust(console: PlainConsole, found: Advice) -> None:
    """Whether engines' accelerations are right in the scene, and along each axis how far they stay so."""
    console.line(
        f"Accelerations of {found.scene} ({count(found.n, 'degree')} of freedom), against proven ones:", "bold"
    )
    console.line()
    console.table(
        ("engine", "accelerations", "correct digits", "error, of its bound", "why"),
        [
            (
                each.engine,
                each.verdict,
                figure(each.digits),
                "" if each.error_over_bound is None else f"{each.error_over_bound:.1g}",
                each.reason,
            )
            for each in found.trust
        ],
    )
    taken = [each for each in found.trust if each.limits]
    axes = {limit.axis: limit.says for each in taken for limit in each.limits}
    limits = {(each.engine, limit.axis): limit for each in taken for limit in each.limits}
    if axes:
        console.line()
        console.table(
            ("not to be trusted from", "", *(each.engine for each in taken)),
            [(axis, says, *(_limit(limits.get((each.engine, axis))) for each in taken)) for axis, says in axes.items()],
        )
    unanswered = sum(not limit.closed for each in taken for limit in each.limits)
    if unanswered:
        console.line(f"{count(unanswered, 'question')} open: a larger --budget answers them", "bold")
    if not found.duration:
        for left_out in found.left_out:
            console.line(f"left out: {left_out}", "dim")
    console.line()


def _limit(limit: TrustLimit | None) -> str:
    """The first value that fails, and how unless it is digits that are lost."""
    if limit is None or not limit.closed:
        return "open" if limit is None or limit.fails_at is None else f"open, fails at {limit.fails_at}"
    if limit.fails_at is None:
        return f"right to {limit.holds_at}"
    return limit.fails_at if limit.failure == "half its digits lost" else f"{limit.fails_at}: {limit.failure}"


def _setting(each: Advised) -> str:
    kind, _, unit = each.by.partition(" [")
    return f"{kind} {each.setting:.4g}" + (f" {unit.rstrip(']')}" if unit else "")


def _coarser(each: Advised) -> str:
    if each.coarser_setting is None:
        return "nothing coarser was tried"
    return "failed" if each.coarser_error is None else f"{each.coarser_error:.1e}"
