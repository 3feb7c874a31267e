"""Grades a derivation: right, or which term of which equation is wrong, and the mistake that produces it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from ...models.errors import InvalidInput
from ...models.readers.bounded_file import read_text, shown
from ..algebra.fingerprint import RandomPoint
from ..reading.derivation import read_derivation
from ..reading.pinned import Pinned
from ..reading.submission import LARGEST_FILE, Submission, table_of
from ..steps.families import family
from .differences import row_differences
from .forms.hamilton import scale_note
from .forms.stages import StageJudge, none_wrong
from .grade_record import Grade, StageMark, Verdict
from .hypotheses import Hypothesis, Said, hypotheses, merged
from .judge import Judgement, judge
from .readback import readback
from .wrong import if_as_declared, named_in_stages, wrong


def grade(source: str | os.PathLike[str], *, pinned: Pinned | None = None) -> Grade:
    """Grade the derivation in a TOML file. Raises InvalidInput, with the place, where it is not one.

    ``pinned``: what a teacher fixes; the file is held to it, and then nothing is assumed.
    """
    path = Path(source)
    text = read_text(path, 4 * LARGEST_FILE)
    try:
        return grade_text(text, pinned=pinned)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def grade_text(toml: str, *, pinned: Pinned | None = None) -> Grade:
    """Grade the text of such a file."""
    data = table_of(toml)

    def read(slashes: int) -> Submission:
        s = read_derivation(data, slashes)
        if pinned is not None:
            pinned.check(s)
        return s

    return graded(read, pinned=pinned is not None)[0]


def graded(read: Callable[[int], Submission], *, pinned: bool) -> tuple[Grade, Submission]:
    """The grade of a derivation, and the derivation as it was read then.

    ``read``: reads it, with slashes as in :class:`Slashes`; ``pinned``: nothing is assumed.
    """
    first = read(0)
    if first.stages is not None:
        return _staged(read, first, pinned=pinned)
    readings = [(first, judge(first, pinned=pinned))]
    if first.doubtful and readings[0][1].hypothesis is None:
        for mode in (1, 2, 3):
            s = read(mode)
            readings.append((s, judge(s, pinned=pinned)))
    right = [(s, j) for s, j in readings if j.hypothesis is not None]
    if right:
        s, judgement = min(right, key=lambda pair: len(pair[1].assumes))
        return _right(s, judgement, slashes=s is not first, pinned=pinned), s
    return wrong(first, pinned=pinned), first


def _staged(read: Callable[[int], Submission], first: Submission, *, pinned: bool) -> tuple[Grade, Submission]:
    """A derivation that is stated stage by stage, in the meaning in which no stage is wrong, else in the declared."""
    readings = [first, *(read(mode) for mode in (1, 2, 3) if first.doubtful)]
    for s in readings:
        for h in hypotheses(s, pinned=pinned):
            found = StageJudge(s, h)
            marks = found.marks()
            if none_wrong(marks):
                return _right_stages(s, h, found, marks, slashes=s is not first), s
    h = next(hypotheses(first, pinned=True))
    found = StageJudge(first, h)
    marks = found.marks()
    findings = tuple(term for mark in marks for term in mark.findings)
    note = found.frame_note
    return Grade(
        verdict="wrong", findings=findings, mistakes=named_in_stages(first, h, found, marks), system=first.kind,
        links=first.space.n, reading=readback(first, h), stages=marks,
        notes=(note[0],) if note else (), notes_ja=(note[1],) if note else (),
    ), first  # fmt: skip


def _right_stages(
    s: Submission, h: Hypothesis, found: StageJudge, marks: tuple[StageMark, ...], *, slashes: bool
) -> Grade:
    """No stage is wrong."""
    assert s.stages is not None
    notes = [note for note in (found.frame_note,) if note]
    assumes = [*h.assumes, *([_slashes(s)] if slashes else [])]
    rows = s.stages.equations or s.stages.solved
    verdict: Verdict = "correct"
    if rows and len(rows) < s.space.n:
        verdict = "undecided"
        notes.append((f"The given equations are right, but they are {len(rows)} of {s.space.n}.",
                      f"書かれている式は正しいですが、{s.space.n} 本中 {len(rows)} 本です。"))  # fmt: skip
    if h.convention != s.convention:
        declared = StageJudge(s, next(hypotheses(s, pinned=True))).marks()
        wrong_there = next((mark for mark in declared if mark.outcome == "wrong"), None)
        if wrong_there is not None:
            notes.append((f"If they are not: {wrong_there.says}", f"そうでなければ：{wrong_there.says_ja}"))
    return Grade(
        verdict=verdict, system=s.kind, links=s.space.n, reading=readback(s, h), stages=marks,
        notes=tuple(en for en, _ in notes), notes_ja=tuple(ja for _, ja in notes),
        assumes=tuple(en for en, _ in assumes), assumes_ja=tuple(ja for _, ja in assumes),
    )  # fmt: skip


def _slashes(s: Submission) -> Said:
    examples = ", ".join(f"{x} as {_with_brackets(x)}" for x in s.doubtful[:3])
    return (f"all that stands at once behind a slash is below it: {examples}",
            f"斜線の直後に続く文字はすべて分母にある：{examples}")  # fmt: skip


def _right(s: Submission, judgement: Judgement, *, slashes: bool, pinned: bool) -> Grade:
    """Right, or right as far as it goes."""
    h, comparison = judgement.hypothesis, judgement.comparison
    assert h is not None
    notes: list[Said] = []
    if comparison.answer == "not proved":
        notes.append((
            "Too large to be multiplied out: that the rows are combinations of the right ones was checked at a random "
            "point of a field of 2⁶¹ numbers.",
            "大きすぎて展開できないため、2⁶¹ 個の数の体のランダムな点で確かめました。",
        ))  # fmt: skip
    if comparison.needs_motion:
        notes.append((
            "The rows determine the accelerations only while the system moves: a rate is a factor of them.",
            "各式に角速度が掛かっているので、加速度が決まるのは動いている間だけです。",
        ))  # fmt: skip
    notes += scale_note(s, h.mechanism)
    if s.kind == "rod-chain" and h.variant.choices.density and h.variant.assumes:
        notes += _of_independent_masses(s, h)
    assumes = list(h.assumes)
    if slashes:
        assumes.append(_slashes(s))
    verdict: Verdict = "correct"
    if comparison.answer == "incomplete":
        given = _given_motions(s, assume=not pinned)
        if given is None:
            verdict = "undecided"
            notes.append(_incomplete(s, h))
        else:
            assumes += given
    mistakes = if_as_declared(s) if verdict == "correct" and _other_zero(s, h) else ()
    return Grade(
        verdict=verdict, system=s.kind, links=s.space.n, reading=readback(s, h), mistakes=mistakes,
        notes=tuple(en for en, _ in notes), notes_ja=tuple(ja for _, ja in notes),
        assumes=tuple(en for en, _ in assumes), assumes_ja=tuple(ja for _, ja in assumes),
    )  # fmt: skip


def _of_independent_masses(s: Submission, h: Hypothesis) -> list[Said]:
    """Which terms are wrong for rods with masses of their own."""
    if s.lagrangian is not None:
        return []
    own = family("rods", s.space, h.convention, replace(h.variant.choices, density=False))
    return [
        (f"For rods with masses of their own: in row {f.row}, {f.found} in place of {f.expected}.",
         f"質量が独立な棒では：第{f.row}行の {f.found} は {f.expected} でなければなりません。")
        for f in row_differences(s, own.with_values(merged(s, h.variant)))
    ]  # fmt: skip


def _with_brackets(text: str) -> str:
    top, _, bottom = text.rpartition("/")
    return f"{top}/({bottom.strip()})"


def _other_zero(s: Submission, h: Hypothesis) -> bool:
    """Whether it is right with angles from elsewhere alone: then gravity may be wrong in place of them."""
    return h.convention.origin != s.convention.origin and h.convention.relative == s.convention.relative


def _given_motions(s: Submission, *, assume: bool) -> list[Said] | None:
    """What is assumed where the rows that are not there belong to coordinates whose motion is given; None elsewhere."""
    rows = [f for _, f in s.rows]
    if s.mechanism is None or not rows:
        return None
    if len(rows) == s.space.n - len(s.mechanism.given):
        return []
    free = s.mechanism.free_drives(rows)
    if not assume or len(rows) != s.space.n - len(free):
        return None
    names = " and ".join(s.mechanism.coordinates[k] for k in free)
    return [(f"the motion of {names} is given: its own equation, which is not here, would say what drives it",
             f"{names} の運動が与えられている（その式は駆動力を定めるだけなので省かれている）")]  # fmt: skip


def _incomplete(s: Submission, h: Hypothesis) -> Said:
    """Every row is right, but not all are there: which are missing, where that can be told."""
    point = RandomPoint(s.space)
    right = [point.projective(point.vector(s.space.split(f))) for f in h.mechanism.rows]
    there = {point.projective(point.vector(s.space.split(f))) for _, f in s.rows}
    missing = [f"θ{i + 1}" for i, number in enumerate(right) if number not in there]
    return (
        f"The given equations are right; the equation of {' and '.join(missing)} is missing.",
        f"書かれている式は正しいですが、足りない式があります：{'、'.join(missing)}",
    )
