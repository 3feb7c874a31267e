"""An audit for a reader, in English or Japanese: sections with paragraphs and tables, for a page and a terminal."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal

from msgspec import Struct

from .audit_record import Audit, JudgedEquation
from .file_record import FileAudit
from .japanese import DOCUMENTS, SENTENCES, WORDS

Language = Literal["en", "ja"]
MARKS = {"holds": "✓", "holds-if": "?", "misprint": "✗", "wrong": "✗"}
WIDEST = 60  # columns of a cell in a terminal; longer ones end their row


class Table(Struct, frozen=True):
    """A table of texts: one for each of ``columns`` in each of ``rows``."""

    caption: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class Section(Struct, frozen=True):
    """A heading, paragraphs, and tables below them."""

    title: str
    paragraphs: tuple[str, ...] = ()
    tables: tuple[Table, ...] = ()


class Prose(Struct, frozen=True):
    """All of an audit; ``language``: of its words."""

    title: str
    language: Language
    sections: tuple[Section, ...]

    def text(self) -> str:
        """For a terminal."""
        return "\n".join(_text(self))


def of_documents(found: Audit, language: Language, stress: Sequence[str] = ()) -> Prose:
    """The audit of both documents. ``stress``: what a stress run says of the chain's tip, in English."""
    t = _translator(language)
    counts = found.counts
    summary = t(
        "{n} numbered equations: {holds} hold, {holds-if} hold with a condition left unsaid, {misprint} are misprinted"
        ". Of {m} displays of Takeno's without a number {right} hold."
    ).format_map(
        {str(k): v for k, v in counts.items()}
        | {
            "n": len(found.equations),
            "m": len(found.unnumbered),
            "right": sum(x.judgement == "holds" for x in found.unnumbered),
        }
    )
    sections = [Section(t("Summary"), (summary, t(HOW)))]
    sections += [_misprint(judged, t) for judged in found.equations if judged.judgement == "misprint"]
    sections.append(Section(t("Every numbered equation"), (), (_equations(found.equations, t, numbered=True),)))
    sections.append(
        Section(t("Takeno's displays without a number"), (), (_equations(found.unnumbered, t, numbered=False),))
    )
    columns = tuple(map(t, ("document", "place", "printed", "right", "why")))
    slips = [(_document(s.document, t), *map(t, (s.where, s.printed, s.right, s.says))) for s in found.slips]
    sections.append(Section(t("Slips outside the formulas, found by reading"), (), (Table("", columns, tuple(slips)),)))
    for question in found.open_questions:
        told = tuple(_table(name, value, t) for name, value in question.numbers.items())
        more = tuple(stress) if question.numbers and "from rest in one bow" in question.numbers else ()
        more = (t("And in the stress test (furiko stress -a chain):"), *more) if more else ()
        paragraphs = (t(question.answer), t(question.argument), *more)
        sections.append(Section(t(question.question), paragraphs, told))
    return Prose(t("The documents against first principles"), language, tuple(sections))


HOW = (
    "Each is held against first principles as it is printed: in symbols for two to four angles, and in ball arithmetic "
    "at random points for six and ten. What fails is refuted by a proof at a point, and its correction is proved."
)


def of_file(found: FileAudit, language: Language) -> Prose:
    """The audit of a user's list of equations."""
    t = _translator(language)
    counts = found.counts
    summary = t("{n} entries: {holds} hold, {holds-if} hold on a condition, {wrong} are wrong.").format_map(
        {"n": len(found.entries)} | counts
    )
    rows = tuple((MARKS[e.judgement], e.number, t(e.judgement), e.says) for e in found.entries)
    table = Table("", ("", *map(t, ("number", "verdict", "what it is"))), rows)
    sections = [Section(t("Summary"), (summary,), (table,))]
    for entry in found.entries:
        said = entry.told_ja if language == "ja" else entry.told
        if said:
            sections.append(Section(f"{entry.number} {entry.says}".strip(), said))
    return Prose(found.title, language, tuple(sections))


def _translator(language: Language) -> Callable[[str], str]:
    if language == "en":
        return lambda english: english
    return lambda english: SENTENCES.get(english, WORDS.get(english, english))


def _name(judged: JudgedEquation, t: Callable[[str], str]) -> str:
    return f"{_document(judged.document, t)} ({judged.number})"


def _document(name: str, t: Callable[[str], str]) -> str:
    return DOCUMENTS[name] if t("document") != "document" else name.title()


def _misprint(judged: JudgedEquation, t: Callable[[str], str]) -> Section:
    costs = [
        (
            t(c.reading),
            f"{c.median_error:.1%}",
            f"{c.largest_error:.1%}",
            _time(c.divergence_small, t),
            _time(c.divergence_large, t),
        )
        for c in judged.costs
    ]
    columns = ("read as", "median", "most", "small swing", "large swing")
    table = Table(
        t("Programmed as printed: error of the accelerations, and when the motion is 0.1 rad off"),
        tuple(map(t, columns)),
        tuple(costs),
    )
    paragraphs = (
        f"{t('Printed')}: {judged.printed}",
        f"{t('Right')}: {judged.formula}",
        f"{t(judged.correction)}{'。' if t('Right') != 'Right' else '.'}",
    )
    title = f"{t('Misprint')}: {_name(judged, t)}, {t(_what(judged))}"
    return Section(title, paragraphs, (table,) if costs else ())


def _what(judged: JudgedEquation) -> str:
    """What an equation is about: its sentence ends in the verdict."""
    return judged.says.rpartition(": holds")[0] or judged.says.partition(": misprint")[0]


def _time(seconds: float | None, t: Callable[[str], str]) -> str:
    return t("more than 20 s") if seconds is None else f"{seconds:.2f} s"


def _equations(judged: Sequence[JudgedEquation], t: Callable[[str], str], *, numbered: bool) -> Table:
    rows = []
    for x in judged:
        verdict = t(x.judgement) + (f": {t(x.condition)}" if x.condition else "")
        place = f"({x.number})" if numbered else _place(x.number, t)
        shown = () if numbered else (x.formula,)
        rows.append((MARKS[x.judgement], _document(x.document, t), place, t(_what(x)), verdict, *shown))
    columns = (
        "document",
        "number" if numbered else "place",
        "what it is",
        "verdict",
        *(() if numbered else ("formula",)),
    )
    return Table("", ("", *map(t, columns)), tuple(rows))


def _place(number: str, t: Callable[[str], str]) -> str:
    """ "before 15, k < j" as "before (15), k < j"."""
    where, _, rest = number.partition(" ")
    which, _, more = rest.partition(", ")
    said = f"{where} ({which})" if t("document") == "document" else f"({which}) {t(where)}"
    return f"{said}, {t(more)}" if more else said


def _table(name: str, value: Any, t: Callable[[str], str]) -> Table:
    """A measurement: records of the same fields, or one."""
    records: list[Mapping[str, Any]] = list(value) if isinstance(value, list) else [value]
    columns = tuple(records[0]) if records else ()
    rows = tuple(tuple(_cell(record[column], t) for column in columns) for record in records)
    return Table(t(name), tuple(map(t, columns)), rows)


def _cell(value: Any, t: Callable[[str], str]) -> str:
    match value:
        case None:
            return "–"
        case bool():
            return t("yes" if value else "no")
        case float():
            return f"{value:.4g}"
        case list() | tuple():
            return ", ".join(_cell(one, t) for one in value)
    return t(str(value))


# A terminal ----------------------------------------------------------------------------------------------------------


def _text(prose: Prose) -> Iterator[str]:
    yield prose.title
    for section in prose.sections:
        yield ""
        yield section.title
        yield "─" * min(_columns(section.title), 100)
        yield from section.paragraphs
        for table in section.tables:
            if table.caption:
                yield f"{table.caption}:"
            yield from _aligned(table)


def _aligned(table: Table) -> Iterator[str]:
    rows = [table.columns, *table.rows]
    widths = [min(WIDEST, max(_columns(row[k]) for row in rows)) for k in range(len(table.columns))]
    for row in rows:
        yield "  " + "  ".join(_padded(cell, width) for cell, width in zip(row, widths, strict=True)).rstrip()


def _padded(text: str, width: int) -> str:
    return text + " " * (width - _columns(text))


def _columns(text: str) -> int:
    """How wide a text is: a Japanese character is two columns, what is set above another none."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(bool(unicodedata.combining(c)) for c in text)
