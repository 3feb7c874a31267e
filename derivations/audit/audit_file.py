"""Judges any document's list of equations: a TOML file with one entry an equation, each held against first principles.

    title = "My lecture notes"
    system = "double-pendulum"        # fields of a derivation that all entries have

    [[entry]]
    number = "(2.4)"
    says = "the Lagrangian"
    lagrangian = '…'

    [[entry]]
    number = "(2.7)"
    equations = ['…']                 # one row is enough: it is judged by itself

An entry may have fields of its own in place of the shared ones. Each is graded as a derivation.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...models.errors import InvalidInput
from ...models.readers.bounded_file import read_text, shown
from ..grading.grade import graded
from ..grading.grade_record import Grade
from ..reading.derivation import read_derivation
from ..reading.submission import LARGEST_FILE, table_of
from .file_record import FileAudit, FileJudgement, JudgedEntry

MOST_ENTRIES = 200
OWN = ("number", "says")


def audit_file(path: Path) -> FileAudit:
    """Judge a file's entries. Raises :class:`InvalidInput`, with the entry, where one cannot be read."""
    try:
        return audit_entries(table_of(read_text(path, 4 * LARGEST_FILE)), path.stem)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def audit_entries(data: dict[str, Any], name: str) -> FileAudit:
    """The same of the file's fields; ``name``: its title where it gives none."""
    entries = data.get("entry")
    if not isinstance(entries, list) or not 1 <= len(entries) <= MOST_ENTRIES:
        raise InvalidInput(f"entry: from 1 to {MOST_ENTRIES} tables [[entry]] are needed")
    shared = {field: value for field, value in data.items() if field not in ("entry", "title")}
    judged = tuple(_judged(entry, place, shared) for place, entry in enumerate(entries, 1))
    return FileAudit(str(data.get("title", name))[:200], judged)


def _judged(entry: object, place: int, shared: dict[str, Any]) -> JudgedEntry:
    if not isinstance(entry, dict):
        raise InvalidInput(f"entry {place}: a table is needed")
    number, says = (str(entry.get(field, ""))[:200] for field in OWN)
    number = number or f"({place})"
    fields = shared | {field: value for field, value in entry.items() if field not in OWN}
    try:
        grade, _ = graded(lambda slashes: read_derivation(fields, slashes), pinned=False)
    except InvalidInput as error:
        raise InvalidInput(f"entry {number:.40}: {error}") from None
    judgement = _judgement(grade)
    return JudgedEntry(
        number, says, judgement, _told(grade, judgement, "en"), _told(grade, judgement, "ja"), grade.to_dict()
    )


def _judgement(grade: Grade) -> FileJudgement:
    """A row that is right by itself holds, whatever other rows its document has elsewhere: it is then "undecided"."""
    if grade.verdict == "wrong":
        return "wrong"
    return "holds-if" if grade.assumes else "holds"


def _told(grade: Grade, judgement: FileJudgement, language: str) -> tuple[str, ...]:
    english = language == "en"
    if judgement == "holds":
        return ()
    if judgement == "holds-if":
        assumes = grade.assumes if english else grade.assumes_ja
        return (f"Right if {'; and if '.join(assumes)}." if english else f"{'、かつ'.join(assumes)} ならば正しい。",)
    said = [x.says if english else x.says_ja for x in grade.mistakes or grade.findings]
    terms = [
        f"{f.found or '0'} in place of {f.expected or '0'}" if english
        else f"{f.found or '0'} は誤り、正しくは {f.expected or '0'}"
        for f in grade.findings
    ]  # fmt: skip
    notes = grade.notes if english else grade.notes_ja
    return tuple(dict.fromkeys([*said, *terms, *notes]))
