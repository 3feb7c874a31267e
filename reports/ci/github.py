"""Lines that GitHub's runner shows beside the change they are about, or above all where no file is to blame."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from ...records.errors import Error
from ...records.findings import DiagnoseDocument
from ..report import Report
from ..words import one_line

MOST = 10  # of one kind that GitHub shows of a step
_PLACE = re.compile(r"(?P<path>[^:]+?)(?:, line (?P<line>\d{1,9}))?(?:, [^:]*)?:(?P<rest>.*)")
_LINE = re.compile(r"\(at line (\d{1,9}), column \d+\)")


def annotation(message: str, *, title: str, path: str = "", line: int = 0) -> str:
    """One ``::error`` line. ``path``: relative to the repository, empty for none; ``line``: from 1, 0 for none.

    A sign that would end the message or a property is written as GitHub's own escape.
    """
    places = {"file": path, "line": str(line or ""), "title": title}
    properties = ",".join(f"{name}={_property(value)}" for name, value in places.items() if value)
    return f"::error {properties}::{_data(one_line(message))}"


def of_report(report: Report) -> list[str]:
    """Each cause of a run once, the one that explains most first; failures, and differences without a known cause.

    No file is blamed: an engine is built from the scene's numbers, and differs from the same numbers' theory.
    """
    return [annotation(said, title=title) for title, said in _of_report(report)][:MOST]


def _of_report(report: Report) -> Iterator[tuple[str, str]]:
    for explanation in report.causes.explanations:
        yield "an engine differs", "; ".join([explanation.headline, *explanation.lines])
    for group in report.causes.unexplained:
        worst = group.results[0]
        found = f"{len(group.results)} differ without a known cause; the largest in {worst.scene}: {worst.reason}"
        yield "an engine differs", f"{group.engine}, {group.check}: {found}"
    for result in report.having("error"):
        yield "an engine failed", f"{result.engine}, {result.scene}, {result.check}: {result.reason}"
    for flaw in report.flaws:
        yield "the run is not whole", flaw


def of_model(path: str, found: DiagnoseDocument) -> list[str]:
    """Each finding of a model file, at the file: it is what its owner can write otherwise."""
    if found.verdict == "agrees":
        return []
    if not found.findings:
        return [annotation(found.headline, title=f"furiko diagnose: {found.verdict}", path=path)]
    return [
        annotation(one.says, title=f"furiko: {one.cause} at {one.where}", path=path, line=_line(one.says, path))
        for one in found.findings
    ]


def _line(says: str, path: str) -> int:
    """The line of the file that a finding names in brackets, as ``(arm.xml, line 6, <joint name='j'>)``; 0 for none."""
    named = re.search(rf"\({re.escape(Path(path).name)}, line (\d{{1,9}})\b", says)
    return int(named[1]) if named else 0


def of_error(error: Error, path: str = "") -> str:
    """A command that failed, at its file, at the line that its message names. ``path``: the file; empty for none."""
    _, line, _ = place_of(error.said)
    return annotation(error.said, title="furiko", path=path, line=line)


def place_of(message: str) -> tuple[str, int, str]:
    """File, line and the rest of a message ``FILE, line 3, <joint>: what``; an empty file and 0 where it names none."""
    place = _PLACE.fullmatch(one_line(message))
    if place is None or not Path(place["path"]).is_file():
        return "", 0, message
    line = place["line"] or next(iter(_LINE.findall(place["rest"])), 0)  # TOML's own messages have it behind
    return place["path"], int(line), place["rest"].strip()


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(one_line(text)).replace(":", "%3A").replace(",", "%2C")
