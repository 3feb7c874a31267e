"""Grades a derivation: right, or which term of which equation is wrong, and the mistake that produces it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from typing import Any

from ...models.errors import InvalidInput
from ...models.readers.bounded_file import read_text, shown
from ..algebra.fingerprint import RandomPoint
from ..dialects.statements import is_program
from ..reading.declaration import WORDS
from ..reading.derivation import read_derivation
from ..reading.pinned import Pinned
from ..reading.submission import LARGEST_FILE, Submission, fields_of, is_toml, table_of
from ..steps.families import family
from .differences import row_differences
from .forms.hamilton import scale_note
from .forms.named import is_own, is_text, is_told_apart
from .forms.passed import require_height, with_passed
from .forms.stages import StageJudge
from .forms.units import units_notes
from .forms.unnamed import is_unnamed, joints_of, refusal, said_of, says_all, usual
from .forms.usual.bodies import in_ones, said_of_bodies, usual_bodies
from .forms.values import require_motion
from .grade_record import Grade, Verdict
from .hypotheses import Hypothesis, Said, hypotheses, merged
from .judge import Judgement, judge
from .readback import readback
from .wrong import if_as_declared, named_in_stages, wrong

MOST_SECONDS = 1.0  # of the processor, in which usual mechanisms are tried, and then no more
MOST_ROLES = 6  # of a text's letters, in which its mistakes are looked for
MOST_NEAR = 2  # usual mechanisms that mistakes are looked for in, where a derivation does not say which it is about


def grade(source: str | os.PathLike[str], *, pinned: Pinned | None = None) -> Grade:
    """Grade the derivation in a file. Raises InvalidInput, with the place, where it is not one.

    A file that ends in .toml has a derivation's fields; any other is the text itself: LaTeX, Markdown, a program.
    ``pinned``: what a teacher fixes; a TOML file is held to it, and then nothing is assumed. It says what a text is
    about.
    """
    path = Path(source)
    text = read_text(path, 4 * LARGEST_FILE)
    try:
        data = fields_of(text, path.suffix)
        if not is_toml(path.suffix) and pinned is not None:
            data, pinned = data | pinned.fields(), None
        return grade_fields(data, pinned=pinned)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def grade_text(toml: str, *, pinned: Pinned | None = None) -> Grade:
    """Grade the text of a TOML file."""
    return grade_fields(table_of(toml), pinned=pinned)


def grade_fields(data: dict[str, Any], *, pinned: Pinned | None = None) -> Grade:
    """Grade a derivation's fields. Where they name no mechanism, it is right for the usual one that is said then."""
    if "bodies" in data and is_unnamed(data):
        data = data | {"system": "mechanism"}
    if pinned is None and is_unnamed(data):
        return _unnamed(data)
    try:
        return graded(_reader(data, pinned), pinned=pinned is not None)[0]
    except InvalidInput as error:
        if pinned is not None or not _may_have_letters(data):
            raise
        return _named(data, error)


def _may_have_letters(data: dict[str, Any]) -> bool:
    """Whether a usual mechanism is named that may be meant with other letters, or more, than its own.

    In rows that are given one by one, those that count their links have the letters of their links alone.
    """
    if "bodies" in data or joints_of(data) is None or is_program(str(data.get("equations"))):
        return False
    return is_text(data) or data["system"] not in WORDS


def _reader(data: dict[str, Any], pinned: Pinned | None = None) -> Callable[[int], Submission]:
    def read(slashes: int) -> Submission:
        s = read_derivation(data, slashes)
        if pinned is not None:
            pinned.check(s)
        return s

    return read


def _named(data: dict[str, Any], refused: InvalidInput) -> Grade:
    """The grade for the mechanism that is named, with what a derivation's other letters stand for.

    Raises ``refused``, what the plain mechanism lacks, where it is right for none of these. A text is wrong where it is
    so for all of them alike.
    """
    joints = joints_of(data)
    bare = {key: value for key, value in data.items() if key not in ("system", "links")}
    tried = _tried(bare, (about for about in usual_bodies(bare)[1] if joints_of(about) == joints))
    if tried.right is not None:
        return tried.right
    meant = next((why for why in tried.refused if "which is meant" in why), None)
    if meant is not None:
        raise InvalidInput(meant)
    own = [(about, s) for about, s in tried.near if is_own(about["bodies"]) and _is_whole(s)]
    if not own or not tried.all or not is_text(data):
        raise refused
    wrongs = [(with_passed(_wrong(s, pinned=False), s), about["bodies"]) for about, s in own[:MOST_ROLES]]
    fewest = min(len(made.findings) for made, _ in wrongs)
    nearest = [(made, bodies) for made, bodies in wrongs if len(made.findings) == fewest]
    if not is_told_apart(nearest):
        raise refused
    made, bodies = nearest[0]
    return _about(made, said_of_bodies(bodies))


def _about(made: Grade, said: Said) -> Grade:
    """The grade with the mechanism that it is about, as what it rests on."""
    return replace(made, assumes=(said[0], *made.assumes), assumes_ja=(said[1], *made.assumes_ja))


def _unnamed(data: dict[str, Any]) -> Grade:
    """The grade for the usual mechanism that the derivation is right for. Raises InvalidInput where that is none."""
    counts, in_its_letters = usual_bodies(data)
    first_of_all, later = usual(counts)
    tried = _tried(data, chain(first_of_all, in_its_letters, later))
    if tried.right is not None:
        return tried.right
    refused = tried.refused
    wrongs: list[tuple[str, Grade]] = []
    for about, s in [(about, s) for about, s in tried.near if "bodies" not in about and _is_whole(s)][:MOST_NEAR]:
        try:
            wrongs.append((about["system"], _wrong(s, pinned=False)))
        except InvalidInput as error:
            refused.append(str(error))
    name, nearest = min(wrongs, key=lambda one: len(one[1].findings), default=("", None))
    raise refusal(nearest, name, refused)


@dataclass
class _Tried:
    """Mechanisms that a derivation may be about: the grade for the one that it is right for, those that it can be read
    for and is not right, why it cannot be read for others, and whether all were tried in good time."""

    right: Grade | None = None
    near: list[tuple[Mapping[str, Any], Submission]] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    all: bool = True


def _tried(data: dict[str, Any], abouts: Iterable[Mapping[str, Any]]) -> _Tried:
    """Try them, one after the other, to the first for which the derivation is right without a condition."""
    tried = _Tried()
    found: list[tuple[int, Grade]] = []
    started = time.process_time()
    for about in abouts:
        if time.process_time() - started > MOST_SECONDS:
            tried.all = False
            break
        read = _reader({**data, **about})
        try:
            first = read(0)
            right = _if_right(read, first, pinned=False) if says_all(first, data) else None
        except InvalidInput as error:
            tried.refused.append(str(error))
            continue
        if right is None:
            tried.near.append((about, first))
        elif right[0].verdict == "correct":
            made = with_passed(*right)
            said = said_of_bodies(about["bodies"]) if "bodies" in about else said_of(made)
            conditions = len(made.assumes) + in_ones(about)
            found.append((conditions, _about(made, said)))
            if not conditions:
                break
    tried.right = min(found, key=lambda one: one[0])[1] if found else None
    return tried


def _is_whole(s: Submission) -> bool:
    return s.stages is not None or s.lagrangian is not None or len(s.rows) == s.space.n


def graded(read: Callable[[int], Submission], *, pinned: bool) -> tuple[Grade, Submission]:
    """The grade of a derivation, and the derivation as it was read then.

    ``read``: reads it, with slashes as in :class:`Slashes`; ``pinned``: nothing is assumed.
    """
    first = read(0)
    found = _if_right(read, first, pinned=pinned)
    made, s = found if found is not None else (_wrong(first, pinned=pinned), first)
    return with_passed(made, s), s


def _if_right(read: Callable[[int], Submission], first: Submission, *, pinned: bool) -> tuple[Grade, Submission] | None:
    """The grade of a derivation that is right, or right as far as it goes; ``first``: it as it was read. Else None."""
    if first.stages is not None:
        return _if_stages_right(read, first, pinned=pinned)
    readings = [(first, judge(first, pinned=pinned))]
    if first.doubtful and readings[0][1].hypothesis is None:
        for mode in (1, 2, 3):
            s = read(mode)
            readings.append((s, judge(s, pinned=pinned)))
    right = [(s, j) for s, j in readings if j.hypothesis is not None]
    if not right:
        return None
    s, judgement = min(right, key=lambda pair: len(pair[1].assumes))
    if judgement.hypothesis is not None:
        require_height(s, judgement.hypothesis.convention)
    return _right(s, judgement, slashes=s is not first, pinned=pinned), s


def _if_stages_right(
    read: Callable[[int], Submission], first: Submission, *, pinned: bool
) -> tuple[Grade, Submission] | None:
    """A derivation that is stated stage by stage, in the meaning in which no stage is wrong; None if there is none."""
    readings = [first, *(read(mode) for mode in (1, 2, 3) if first.doubtful)]
    for s in readings:
        for h in hypotheses(s, pinned=pinned):
            found = StageJudge(s, h)
            if found.is_right():
                return _right_stages(s, h, found, slashes=s is not first), s
    return None


def _wrong(s: Submission, *, pinned: bool) -> Grade:
    """What is wrong, in the declared meaning: of stages the first, else terms and mistakes."""
    require_motion(s)
    if s.stages is None:
        return wrong(s, pinned=pinned)
    h = next(hypotheses(s, pinned=True))
    found = StageJudge(s, h)
    marks = found.marks()
    findings = tuple(term for mark in marks for term in mark.findings)
    notes = [*units_notes(s), *([found.frame_note] if found.frame_note else [])]
    return Grade(
        verdict="wrong", findings=findings, mistakes=named_in_stages(s, h, found, marks), system=s.kind,
        links=s.space.n, reading=readback(s, h), stages=marks,
        notes=tuple(en for en, _ in notes), notes_ja=tuple(ja for _, ja in notes),
    )  # fmt: skip


def _right_stages(s: Submission, h: Hypothesis, found: StageJudge, *, slashes: bool) -> Grade:
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
        verdict=verdict, system=s.kind, links=s.space.n, reading=readback(s, h), stages=found.marks(),
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
