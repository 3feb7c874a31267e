"""What the page of a check gives its script: the run as plain data, every text once, all else by number.

Figures are written here, as all reports write them; the script shows them and compares only shares.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeGuard

import msgspec

from ...records.check import Result, SceneEntry
from ...records.entries import ENTRIES, Entries, entries_in
from ...records.printable import printable
from ..causes import Explanation
from ..known import Known
from ..report import Report, TableCell, share
from ..words import GLYPHS, WORDS, count, figure, list_of, listed, one_line, package_of, word
from .mechanism_drawing import draw_mechanism

HISTORY, MOTION = "errors over time", "motion"  # details that are drawn
MOST_PLACES = 3000  # sentences of causes in all: a page is to be read, the stream has every one
MOST_DRAWN = 30_000  # numbers in drawings of mechanisms: a sixth of a megabyte
LONGEST_DETAIL = 2000  # characters of a list or a table
MOST_TIMES = 400  # of one error over time, or of one motion
MOST_FRAMES = 200_000  # numbers in all motions: a megabyte
MOST_ENTRIES = 45_000  # numbers in all matrices: a quarter of a megabyte
HUGE = 1e308  # stands for infinity, which JSON does not have

SYSTEMS = {
    "n-leg": "N-leg pendulum: point masses, one rod from the support and legs from its end",
    "rod-chain": "chain of uniform rigid rods",
    "tree": "tree of links",
}


class Texts:
    """Every text once, by number."""

    def __init__(self) -> None:
        self.all: list[str] = []
        self._numbers: dict[str, int] = {}

    def number(self, text: str) -> int:
        """Its number; −1 for an empty one. What a browser might act on is written out."""
        if not text:
            return -1
        found = self._numbers.get(text)
        if found is None:
            found = self._numbers[text] = len(self.all)
            self.all.append(printable(text))
        return found


def page_data(report: Report, known: Known | None = None) -> tuple[str, bool, bool]:
    """The run as JSON for a script element; whether there is something to plot; whether there are matrices.

    No character of the JSON can end the element or begin another.
    """
    data = _data(report, known)
    encoded = msgspec.json.encode(data).decode()
    safe = encoded.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
    return safe, bool(data["histories"]), bool(data["matrices"])


def _data(report: Report, known: Known | None) -> dict[str, Any]:
    texts = Texts()
    explanations = report.causes.explanations
    entries = {} if known is None else {id(entry): i for i, entry in enumerate(known.entries)}
    by_result = {} if known is None else {key: entries[id(entry)] for key, entry in known.by_result.items()}
    rows = _Rows(report, texts, {id(e): i for i, e in enumerate(explanations)}, by_result)
    return {
        "words": WORDS,
        "glyphs": [GLYPHS[name] for name in WORDS],
        "scenes": _scenes(report, texts),
        "engines": [_engine(name, report, texts) for name in report.engines],
        "checks": [texts.number(check) for check in report.checks],
        "cells": [rows.cell(cell) for cell in report.table.values() if cell.results],
        "histories": rows.histories,
        "matrices": rows.matrices,
        "causes": _causes(explanations, texts),
        "known": known is not None,
        "grave": bool(report.counts["differs"] or report.counts["error"]),
        "text": texts.all,  # last: the others fill it
    }


class _Rows:
    """Results as rows of numbers; what is missing at the end of a row is left out."""

    def __init__(
        self,
        report: Report,
        texts: Texts,
        explanations: dict[int, int],
        known: dict[tuple[str, str, str], int],
    ) -> None:
        self._report, self._texts = report, texts
        self._explanations, self._known = explanations, known
        self._scenes = {name: i for i, name in enumerate(report.scenes)}
        self._engines = {name: i for i, name in enumerate(report.engines)}
        self._checks = {name: i for i, name in enumerate(report.checks)}
        self.histories: list[dict[str, Any]] = []
        self.matrices: list[dict[str, Any]] = []
        self._with_matrix = _with_matrix(report)
        self._frames = 0

    def cell(self, cell: TableCell) -> list[Any]:
        """Scene, engine, word, figure, share, results."""
        said = WORDS.index(cell.word) if cell.word else -1
        return [
            self._scenes[cell.scene],
            self._engines[cell.engine],
            said,
            self._texts.number(cell.error),
            _short(cell.share),
            [self._result(result) for result in cell.results],
        ]

    def _result(self, result: Result) -> list[Any]:
        explanation = self._report.causes.explanation_of(result)
        known = self._known.get((result.scene, result.engine, result.check), -1)
        row = [
            self._checks[result.check],
            WORDS.index(word(result)),
            self._figure(result.measured, result.unit),
            self._figure(result.allowed, result.unit),
            _short(share(result)),
            self._figure(result.line, result.unit) if result.loose else -1,
            self._texts.number(result.reason),
            self._texts.number(result.cause or ""),
            -1 if explanation is None else self._explanations[id(explanation)],
            known if result.outcome == "differs" else -1,
            self._details(result),
            self._history(result),
            self._matrix(result),
        ]
        while row[-1] in (-1, []):
            row.pop()
        return row

    def _figure(self, value: float | None, unit: str) -> int:
        return -1 if value is None else self._texts.number(f"{figure(value)} {unit}".rstrip())

    def _details(self, result: Result) -> list[int]:
        shown = [(key, value) for key, value in result.details.items() if key not in (HISTORY, MOTION, ENTRIES)]
        pairs = ((self._texts.number(key), self._texts.number(_detail(value))) for key, value in shown if key)
        return [number for pair in pairs for number in pair]

    def _matrix(self, result: Result) -> int:
        entries = self._with_matrix.get(id(result))
        if entries is None:
            return -1
        names = {
            "state": self._texts.number(entries.state),
            "rows": [self._texts.number(name) for name in entries.rows],
            "columns": [self._texts.number(name) for name in entries.columns],
        }
        self.matrices.append(msgspec.structs.asdict(entries) | names)
        return len(self.matrices) - 1

    def _history(self, result: Result) -> int:
        found = errors_over_time(result)
        if not found:
            return -1
        motion = motion_of(result, self._report.scene(result.scene))
        if motion is not None:
            self._frames += 2 * len(motion["times"]) * len(motion["lengths"])
        shown = motion if self._frames <= MOST_FRAMES else None
        self.histories.append({"errors": found, "motion": shown})
        return len(self.histories) - 1


def _with_matrix(report: Report) -> dict[int, Entries]:
    """The matrices that the page has room for, by their results: of those that differ first."""
    found: dict[int, Entries] = {}
    left = MOST_ENTRIES
    for result in sorted(report.results, key=lambda result: WORDS.index(word(result))):
        entries = entries_in(result.details)
        left -= 3 * len(entries.rows) * len(entries.columns) if entries else 0
        if entries and left >= 0:
            found[id(result)] = entries
    return found


def errors_over_time(result: Result) -> list[list[float | None]]:
    """Times [s], errors that were predicted, errors that were measured [rad]; empty where the result has none."""
    found = result.details.get(HISTORY)
    rows = [row for row in found if isinstance(row, list) and len(row) == 3] if isinstance(found, list) else []
    timed = [row for row in rows if _number(row[0])][:MOST_TIMES]
    if not timed:
        return []
    timed.sort(key=lambda row: float(row[0]))
    times, *errors = zip(*timed, strict=True)
    shown = [[_short(value) if _number(value) and value > 0 else None for value in column] for column in errors]
    end = max((k for column in shown for k, value in enumerate(column, start=1) if value is not None), default=0)
    return [[float(f"{time:.6g}") for time in times[:end]], *(column[:end] for column in shown)] if end else []


def motion_of(result: Result, scene: SceneEntry | None) -> dict[str, Any] | None:
    """Angles of theory and engine over time, with what is needed to draw them; None where the result has none."""
    found = result.details.get(MOTION)
    if not isinstance(found, dict) or scene is None or not scene.lengths:
        return None
    times, theory, engine = (found.get(name) for name in ("times", "theory", "engine"))
    if not _numbers(times) or len(times) > MOST_TIMES:
        return None
    if not all(_table(rows, len(times), len(scene.lengths)) for rows in (theory, engine)):
        return None
    fan = scene.system == "n-leg"
    return {"times": times, "theory": theory, "engine": engine, "lengths": scene.lengths, "fan": fan}


def _numbers(values: object) -> TypeGuard[list[float]]:
    return isinstance(values, list) and bool(values) and all(map(_number, values))


def _table(rows: object, height: int, width: int) -> bool:
    return isinstance(rows, list) and len(rows) == height and all(_numbers(row) and len(row) == width for row in rows)


def _number(value: object) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value)


def _short(value: float | None) -> float:
    """Three digits, as much as is shown or compared; −1 for nothing."""
    if value is None or math.isnan(value):
        return -1
    return float(f"{value:.3g}") if math.isfinite(value) else HUGE


def _detail(value: object) -> str:
    if isinstance(value, str):
        return value
    return one_line(_plain(value), LONGEST_DETAIL)


def _plain(value: object) -> str:
    if isinstance(value, float):
        return figure(value)
    if isinstance(value, dict):
        return ", ".join(f"{key} {_plain(entry)}" for key, entry in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(_plain(entry) for entry in value)
    return str(value)


def _scenes(report: Report, texts: Texts) -> list[dict[str, Any]]:
    drawn = 0
    found = []
    for name in report.scenes:
        entry = report.scene(name)
        drawing = _drawing(entry) if entry and drawn <= MOST_DRAWN else None
        drawn += 0 if drawing is None else len(drawing[4]) + len(drawing[5])
        results = [result for engine in report.engines for result in report.table[name, engine].results]
        found.append(
            {
                "name": texts.number(name),
                "again": texts.number(report.again(name)),
                "description": texts.number(entry.description if entry else ""),
                "about": [[label, texts.number(said)] for label, said in _about(entry, results)],
                "equations": [_equation(text, texts) for text in (entry.equations if entry else ())],
                "drawing": drawing,
                "side": bool(entry and entry.outline),
            }
        )
    return found


def _equation(text: str, texts: Texts) -> list[int]:
    """Name and, where the stream gives it, text of an equation: ``name: text``."""
    name, _, formula = text.partition(": ")
    return [texts.number(name), texts.number(formula)]


def _about(entry: SceneEntry | None, results: Sequence[Result]) -> list[tuple[str, str]]:
    """What the mechanism is, in labels and words."""
    if entry is None:
        return []
    size = count(entry.n, "angle")
    if entry.joints:
        size = f"{entry.n:,} degree{'' if entry.n == 1 else 's'} of freedom"
    about = [("system", f"{SYSTEMS.get(entry.system, entry.system)}, {size}")]
    about += [("your equations", "; ".join(entry.own))] if entry.own else []
    about += [("joints", listed(entry.joints, 12))] if entry.joints else []
    about += [("lengths", f"{list_of(entry.lengths)} m")] if entry.lengths else []
    about += [("masses", f"{list_of(entry.masses)} kg"), ("gravity", f"{entry.gravity} m/s²")]
    if entry.states:
        moving = f", trajectory of {entry.duration} s" if entry.duration else ""
        about.append(("compared in", count(entry.states, "state") + moving))
    times = (result.details.get("Lyapunov time") for result in results)
    lyapunov = next((time for time in times if isinstance(time, float)), None)
    if lyapunov is not None:
        about.append(("Lyapunov time", f"{figure(lyapunov)} s, in which a small difference grows e-fold"))
    about += [("tags", listed(entry.tags, 12))] if entry.tags else []
    return about


def _drawing(entry: SceneEntry) -> list[Any] | None:
    """Width, height, the support's place, lines and bobs, each as one row of numbers."""
    if not entry.lengths and not entry.outline:
        return None
    drawing = draw_mechanism(entry)
    lines = [round(value, 1) for line in drawing.lines for value in line]
    bobs = [round(value, 1) for bob in drawing.bobs for value in bob]
    across, down = drawing.support
    return [round(drawing.width, 1), round(drawing.height, 1), round(across, 1), round(down, 1), lines, bobs]


def _engine(name: str, report: Report, texts: Texts) -> dict[str, int]:
    return {
        "name": texts.number(name),
        "about": texts.number(package_of(report.engine(name))),
        "option": texts.number(report.engine_option(name)),
    }


def _causes(explanations: Sequence[Explanation], texts: Texts) -> list[dict[str, Any]]:
    """Title, number of results explained, and each place and value with its scenes where there are several."""
    left = MOST_PLACES
    found = []
    for explanation in explanations:
        places: list[list[int]] = []
        causes = (*explanation.together, *explanation.alternatives)
        if explanation.detailed:
            told = [(f"{cause.code}: {said}", where) for cause in causes for said, where in cause.every]
            places = [[texts.number(said), texts.number(listed(where, 200))] for said, where in told[:left]]
        left -= len(places)
        codes = ", ".join(cause.code for cause in causes)
        title = one_line(f"{explanation.engine}: {codes}", 60)
        found.append({"title": texts.number(title), "explained": len(explanation.explained), "places": places})
    return found
