"""The result of grading: a verdict, the mistakes that explain it, and each wrong term, found and expected."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from html import escape
from typing import Any, Literal

from ..algebra.mathml import mathml
from ..algebra.notation import pretty
from ..steps.stages import StageName

Verdict = Literal["correct", "wrong", "undecided"]
EXIT_STATUS: dict[Verdict, int] = {"correct": 0, "wrong": 1, "undecided": 1}


@dataclass(frozen=True)
class WrongTerm:
    """One wrong term. ``equation``: the documents' number; ``row``: the label of the row in the derivation graded.

    ``found`` and ``expected`` are scaled like the row in that derivation, with every term on the left side.
    """

    equation: str
    term: str
    found: str
    expected: str
    cause: str
    says: str
    says_ja: str
    row: str = ""


@dataclass(frozen=True)
class NamedMistake:
    """One mistake that explains wrong terms; ``also``: other mistakes that lead to the same equations."""

    cause: str
    name: str
    stage: str
    says: str
    says_ja: str
    also: tuple[str, ...] = ()


@dataclass(frozen=True)
class StageMark:
    """One stage of a derivation that is stated stage by stage. ``of``: how many terms the right stage has.

    ``outcome``: "right"; "follows" from earlier stages that are wrong, and so not wrong again; or "wrong".
    """

    stage: StageName
    outcome: Literal["right", "follows", "wrong"]
    says: str
    says_ja: str
    findings: tuple[WrongTerm, ...] = ()
    of: int = 0


@dataclass(frozen=True)
class Reading:
    """What was read: the mechanism and its drawing, the convention of the angles, the symbols, and the equations.

    ``symbols``: what is written and what it is read as; ``equations``: label and text, in the author's letters.
    """

    mechanism: str = ""
    mechanism_ja: str = ""
    drawing: str = ""
    angles: str = ""
    angles_ja: str = ""
    symbols: tuple[tuple[str, str], ...] = ()
    equations: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Grade:
    """The grade of one derivation. ``alternatives``: other sets of mistakes that explain the wrong terms as well.

    ``assumes``: what the verdict "correct" rests on and the file does not say: the derivation is right if this holds.
    ``notes``, ``notes_ja``: remarks in English and Japanese; ``system``, ``links``: the mechanism; ``reading``: how the
    derivation was understood.
    """

    verdict: Verdict
    findings: tuple[WrongTerm, ...] = ()
    mistakes: tuple[NamedMistake, ...] = ()
    alternatives: tuple[tuple[str, ...], ...] = ()
    notes: tuple[str, ...] = ()
    notes_ja: tuple[str, ...] = ()
    system: str = ""
    links: int = 0
    assumes: tuple[str, ...] = ()
    assumes_ja: tuple[str, ...] = ()
    reading: Reading = Reading()
    right_for: str = ""  # another mechanism that these are the right equations of
    right_for_ja: str = ""
    stages: tuple[StageMark, ...] = ()  # of a derivation that is stated stage by stage

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)

    @property
    def exit_status(self) -> int:
        """0 when correct, 1 otherwise."""
        return EXIT_STATUS[self.verdict]

    def _repr_html_(self) -> str:
        """For a notebook: the mathematics as MathML, and all that was written escaped."""
        return _html(self)

    def text(self, language: Literal["en", "ja"] = "en") -> str:
        """For a terminal."""
        return _english(self) if language == "en" else _japanese(self)


def _english(d: Grade) -> str:
    head = {"correct": "Correct.", "wrong": "Wrong.", "undecided": "Undecided."}[d.verdict]
    if d.assumes and d.verdict == "correct":
        head = f"Right if {'; and if '.join(d.assumes)}."
    r = d.reading
    lines = [*_read(r, f"Read: {r.mechanism}; {r.angles}.", "  where ", ", ", " is "), head]
    if d.assumes and d.verdict != "correct":
        lines.append(f"  If {'; and if '.join(d.assumes)}:")
    if d.right_for:
        lines.append(f"  But right for {d.right_for}.")
    if d.mistakes and d.verdict == "correct":
        lines.append("  If they are not, and the angles are measured as the documents do:")
    for mistake in d.mistakes:
        also = f" (or, with the same equations: {', '.join(mistake.also)})" if mistake.also else ""
        lines.append(f"  {mistake.says}  [{mistake.cause}, made in the {STAGES_EN[mistake.stage]}]{also}")
    lines += [f"  {mark.says}" for mark in d.stages]
    for f in d.findings:
        said = "" if d.mistakes and any(f.says == m.says for m in d.mistakes) else f"  {f.says}"
        row = f" of row {f.row}" if f.row and " in row " not in f.term else ""
        number = f"({f.equation}) " if f.equation else ""
        lines.append(f"  {number}{f.term}{row}: found {f.found}, expected {f.expected}.{said}")
    lines += [f"  Or: {' and '.join(names)}" for names in d.alternatives]
    return "\n".join([*lines, *(f"  {note}" for note in d.notes)])


def _read(r: Reading, first: str, where: str, between: str, means: str) -> list[str]:
    """What was read, behind the line ``first``, in the words of one language."""
    if not r.mechanism:
        return []
    lines = [first, *(f"    {line}" for line in r.drawing.splitlines())]
    lines += [f"  {label}:  {text}" for label, text in r.equations]
    if r.symbols:
        lines.append(where + between.join(f"{written}{means}{meant}" for written, meant in r.symbols))
    return lines


def _japanese(d: Grade) -> str:
    head = {"correct": "正しい導出です。", "wrong": "誤りがあります。", "undecided": "判定できません。"}[d.verdict]
    if d.assumes_ja and d.verdict == "correct":
        head = f"次の条件のもとで正しい導出です：{'；'.join(d.assumes_ja)}。"
    r = d.reading
    lines = [*_read(r, f"読み取った内容：{r.mechanism_ja}。{r.angles_ja}。", "  記号：", "、", " = "), head]
    if d.assumes_ja and d.verdict != "correct":
        lines.append(f"  次の条件のもとで：{'；'.join(d.assumes_ja)}")
    if d.right_for_ja:
        lines.append(f"  ただし、次の機構の正しい式です：{d.right_for_ja}。")
    if d.mistakes and d.verdict == "correct":
        lines.append("  そうでなく、角を文献のとおりに測るなら：")
    for mistake in d.mistakes:
        also = f"（同じ式になる別の誤り：{'、'.join(mistake.also)}）" if mistake.also else ""
        lines.append(f"  {mistake.says_ja}  [{mistake.cause}、{STAGES_JA[mistake.stage]}の段階]{also}")
    lines += [f"  {mark.says_ja}" for mark in d.stages]
    for f in d.findings:
        said = "" if any(f.says_ja == m.says_ja for m in d.mistakes) else f"  {f.says_ja}"
        row = f"第{f.row}行 " if f.row else ""
        number = f"({f.equation}) " if f.equation else ""
        lines.append(f"  {number}{row}{f.term}：{f.found} → 正しくは {f.expected}{said}")
    lines += [f"  または：{'、'.join(names)}" for names in d.alternatives]
    return "\n".join([*lines, *(f"  {note}" for note in d.notes_ja)])


STAGES_EN = {
    "position": "positions", "velocity": "velocities", "speed": "squared speeds", "energy": "energies",
    "lagrangian": "Lagrangian", "momentum": "derivatives of the Lagrangian",
    "derivative": "derivatives of the Lagrangian",
    "force": "forces", "moment": "moments", "equation": "equations of motion", "matrix": "matrix form",
}  # fmt: skip
STAGES_JA = {
    "position": "位置", "velocity": "速度", "speed": "速度の2乗", "energy": "エネルギー",
    "lagrangian": "ラグランジアン",
    "momentum": "ラグランジアンの微分", "derivative": "ラグランジアンの微分", "force": "力", "moment": "モーメント",
    "equation": "運動方程式", "matrix": "行列形",
}  # fmt: skip


def _html(grade: Grade) -> str:
    """What was read, the verdict, and each wrong term."""
    r = grade.reading
    head = {"correct": "Correct.", "wrong": "Wrong.", "undecided": "Undecided."}[grade.verdict]
    if grade.assumes and grade.verdict == "correct":
        head = f"Right if {'; and if '.join(grade.assumes)}."
    parts = [f"<p><strong>{escape(head)}</strong></p>"]
    if r.mechanism:
        parts.insert(0, f"<p>Read: {escape(r.mechanism)}; {escape(r.angles)}.</p>")
        rows = "".join(f"<li>{escape(label)}: {mathml(line)}</li>" for label, line in r.equations)
        parts.insert(1, f"<ul>{rows}</ul>")
    said = [m.says for m in grade.mistakes] + ([f"Right for {grade.right_for}."] if grade.right_for else [])
    said += [mark.says for mark in grade.stages] + list(grade.notes)
    parts += [f"<p>{escape(line)}</p>" for line in said]
    terms = "".join(
        f"<li>{escape(f.says)} Found {mathml(pretty(f.found))}, expected {mathml(pretty(f.expected))}.</li>"
        for f in grade.findings
    )
    if terms:
        parts.append(f"<ul>{terms}</ul>")
    return "".join(parts)
