"""Writes the page for a class: thirty mistakes, each with a question, the wrong and right lines, a map and a motion."""

from __future__ import annotations

import base64
import json
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.writers.whole_file import write_whole
from ..algebra.multiples import is_multiple
from ..algebra.notation import pretty, sub, text
from ..algebra.symbols import Symbols, symbols_of
from ..algebra.trig import NOTHING, Formula
from ..grading.grade_record import STAGES_EN, STAGES_JA
from ..mistakes.catalogue import catalogue
from ..steps.derivation import Derivation, Mistake, Stage, add, correct_derivation, derive
from ..steps.motion import ParameterValues, RowMotion
from .choices import CHOICES, Choice

Array = NDArray[np.float64]
TEMPLATES = Path(__file__).parent
LENGTHS, MASSES = (1.1, 0.8, 0.6), (1.0, 0.6, 0.8)  # unequal, so that no mistake hides
GRID = 61  # a map's points along each angle
DURATION, FRAMES, STEPS_A_FRAME = 6.0, 150, 4  # 10 ms a step
START = (1.2, 1.9, -0.7)  # rad; from rest
RATES = (1.5, -1.0, 0.5)  # rad/s, of the map


@dataclass(frozen=True)
class PageLine:
    """One line of a derivation: the name of a quantity, and its formula."""

    name: str
    formula: str


def lesson() -> str:
    """The page, complete in itself: no other file and no network is needed to show it."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined)
    return environment.get_template("lesson.html").render(
        entries=[_entry(number, choice) for number, choice in enumerate(CHOICES, 1)],
        duration=DURATION,
        lengths=LENGTHS,
    )


def write_lesson(path: Path) -> Path:
    """Write the page to a file, completely or not at all. Raises :class:`InvalidInput` where it cannot be written."""
    return write_whole(path, lesson())


def _entry(number: int, choice: Choice) -> dict[str, Any]:
    m = symbols_of(choice.kind, choice.n)
    mistake = next(x for x in catalogue(m) if x.name == choice.name)
    wrong = derive(m, [mistake])
    pairs = list(changed_lines(m, mistake, wrong))
    rows = [
        tuple(PageLine(f"row {i + 1}", _shown(m, _sum_of_row(m, d, i))) for d in (wrong, correct_derivation(m)))
        for i in range(m.n)
        if not is_multiple(wrong.rows[i], correct_derivation(m).rows[i])
    ]  # fmt: skip
    true, false = _true_motion(m), RowMotion(m, wrong.rows, _parameters(m))
    right_frames, wrong_frames = _true_frames(m), _frames(false)
    return {
        "number": number, "code": mistake.code, "kind": choice.kind, "links": m.n,
        "stage": STAGES_EN[mistake.stage], "stage_ja": STAGES_JA[mistake.stage],
        "question": choice.question, "question_ja": choice.question_ja,
        "says": mistake.english, "says_ja": mistake.japanese, "lines": pairs, "rows": rows,
        "map": _map(true, false), "motion": json.dumps({
            "star": m.kind == "n-leg", "lengths": LENGTHS[: m.n], "right": right_frames, "wrong": wrong_frames,
        }),
        "plot": _plot(right_frames, wrong_frames),
    }  # fmt: skip


# The wrong line and the right one -------------------------------------------------------------------------------------


def changed_lines(m: Symbols, mistake: Mistake, wrong: Derivation) -> Iterator[tuple[PageLine, PageLine]]:
    """The lines of the stage at which a mistake is made that it changes, wrong and right; at most four."""
    shown = 0
    for (name, formula), (_, other) in zip(
        _lines(m, wrong, mistake.stage), _lines(m, correct_derivation(m), mistake.stage), strict=True
    ):
        if formula != other and shown < 4:
            shown += 1
            yield PageLine(name, _shown(m, formula)), PageLine(name, _shown(m, other))


def _lines(  # noqa: PLR0911 -- one for each stage
    m: Symbols, d: Derivation, stage: Stage
) -> list[tuple[str, Formula]]:
    """The quantities of a stage, one a line."""
    every = range(m.n)
    match stage:
        case "position":
            return [(f"{'xy'[c]}{sub(b)}", add(s[c] for s in d.position[b].values())) for b in every for c in (0, 1)]
        case "velocity":
            return [(f"{'ẋẏ'[c]}{sub(b)}", add(s[c] for s in d.velocity[b].values())) for b in every for c in (0, 1)]
        case "speed":
            return [(f"|v{sub(b)}|²", add(d.square[b].values())) for b in every]
        case "energy" | "lagrangian":
            kinetic = [(f"T{sub(b)}", add(d.kinetic[b].values()).times(d.share[b][0])) for b in every]
            potential = [(f"L has −U{sub(b)} =", add(d.potential[b].values()).times(-d.share[b][1])) for b in every]
            return kinetic + potential
        case "momentum":
            return [(f"∂L/∂θ̇{sub(i)}", d.momentum[i]) for i in every]
        case "derivative":
            return [
                line
                for i in every
                for line in (
                    (f"d/dt ∂L/∂θ̇{sub(i)}", d.inertial[i] + add(d.convective[i].values())),
                    (f"∂L/∂θ{sub(i)}", d.kinetic_slope[i] - d.potential_slope[i]),
                )
            ]
        case "force":
            return [(f"m{sub(b)}(r̈{sub(b)} + g e)", d.force[b][c]) for b in every for c in (0, 1)]
        case "moment":
            return [(f"moment on {i + 1}", d.lower[i] + d.upper[i]) for i in every]
    return [(f"0 = (row {i + 1})", _sum_of_row(m, d, i)) for i in every]


def _sum_of_row(m: Symbols, d: Derivation, i: int) -> Formula:
    return m.space.join(d.rows[i]) if d.rows[i] else NOTHING


def _shown(m: Symbols, f: Formula) -> str:
    return pretty(text(m.space, f))


# Map of the error -----------------------------------------------------------------------------------------------------


def _map(true: RowMotion, false: RowMotion) -> str:
    """Relative error of the accelerations over θ₁ (right) and θ₂ (up): a PNG in a data URI, white none, dark 100 %."""
    axis = np.linspace(-np.pi, np.pi, GRID)
    first, second = np.meshgrid(axis, axis[::-1])
    theta = np.zeros((GRID * GRID, true.n))
    theta[:, 0], theta[:, 1] = first.ravel(), second.ravel()
    omega = np.broadcast_to(np.array(RATES[: true.n]), theta.shape)
    expected, found = true.accelerations(theta, omega), false.accelerations(theta, omega)
    size = np.linalg.norm(expected, axis=1)
    error = np.linalg.norm(found - expected, axis=1) / np.maximum(size, 1e-3 * size.max())
    share = np.clip(np.nan_to_num(error, nan=1.0, posinf=1.0), 0, 1).reshape(GRID, GRID)
    return _png(share)


def _png(share: Array) -> str:
    """A picture of numbers from 0 to 1."""
    low, high = np.array([255, 255, 255]), np.array([140, 20, 40])
    pixels = np.rint(low + np.sqrt(share)[..., None] * (high - low)).astype(np.uint8)
    raw = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    parts = b"".join(
        _chunk(kind, data) for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(raw, 9)), (b"IEND", b""))
    )
    return "data:image/png;base64," + base64.b64encode(b"\x89PNG\r\n\x1a\n" + parts).decode()


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


# The motion -----------------------------------------------------------------------------------------------------------


def _parameters(m: Symbols) -> ParameterValues:
    return ParameterValues(LENGTHS[: m.n], MASSES[: m.n] if m.kind == "n-leg" else ())


@cache
def _true_motion(m: Symbols) -> RowMotion:
    return RowMotion(m, correct_derivation(m).rows, _parameters(m))


@cache
def _true_frames(m: Symbols) -> list[list[float]]:
    return _frames(_true_motion(m))


def _frames(motion: RowMotion) -> list[list[float]]:
    """Angles at each frame; they end where the wrong equations diverge or determine no accelerations."""
    n = motion.n
    angles = motion.trajectory(np.array(START[:n]), np.zeros(n), DURATION, FRAMES * STEPS_A_FRAME)[::STEPS_A_FRAME]
    sound = np.isfinite(angles).all(axis=1) & (np.abs(angles) < 1e4).all(axis=1)
    end = int(np.argmin(sound)) if not sound.all() else len(angles)
    return [[round(float(x), 3) for x in row] for row in angles[:end]]


def _plot(true: list[list[float]], false: list[list[float]]) -> dict[str, str]:
    """θ of the last link against time, as two polylines in a box of 300 by 90."""
    values = [row[-1] for row in true + false]
    low, high = min(values), min(max(values), min(values) + 60)
    height = max(high - low, 1e-6)

    def line(frames: list[list[float]]) -> str:
        return " ".join(
            f"{300 * k / FRAMES:.1f},{90 - 90 * (min(row[-1], high) - low) / height:.1f}"
            for k, row in enumerate(frames)
        )

    return {"right": line(true), "wrong": line(false)}
