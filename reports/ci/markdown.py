"""The summary for a CI step (GITHUB_STEP_SUMMARY) or a comment: causes first, the table, details folded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ...records.check import Result
from ..causes import Explanation
from ..known import Known
from ..report import Report, TableCell, group_line
from ..words import GLYPHS, LEGEND, figure, last_line, listed, one_line, outcome_of

MOST_LISTED = 50  # a step summary may hold 1 MiB
LONGEST_REASON = 2000  # characters; none of furiko's own sentences is as long
_SAFE = frozenset(" .,;'()/+=-%–…·×≤≥²³√°✓✗≈") | frozenset("\n")


def to_markdown(report: Report, known: Known | None = None) -> str:
    """GitHub-flavoured Markdown; text from the stream never acts as markup. ``known``: its known differences."""
    sections = [
        _top(report),
        _known(known),
        _causes(report),
        _unexplained(report),
        _findings(report.having("error"), "Failures"),
        _loose(report),
        _table(report),
        _differences(report),
        _skips(report),
        _facts(report),
    ]
    return "\n\n".join(section for section in sections if section) + "\n"


def escape(text: str, longest: int = LONGEST_REASON) -> str:
    """One line of text that Markdown shows as it is: character references for all but letters, digits and a few signs.

    A reference never acts as markup (CommonMark 6.2), so one rule covers emphasis, links, tables, code and HTML.
    """
    return "".join(c if c.isalnum() or c in _SAFE else f"&#{ord(c)};" for c in one_line(text, longest))


def _top(report: Report) -> str:
    flaws = [f"> [!WARNING]\n> {escape(flaw)}" for flaw in report.flaws]
    outliers = [escape(sentence) for sentence in report.outliers]
    verdict = f"## furiko {GLYPHS[outcome_of(report.exit_status)]} {escape(report.verdict)}"
    advice = [escape(report.advice)] if report.advice else []
    return "\n\n".join([verdict, *flaws, *outliers, *advice])


def _known(known: Known | None) -> str:
    """How many differences are no news, and each entry of the file."""
    if known is None:
        return ""
    first, *entries = known.text().splitlines()
    return _section(escape(first), [f"- {escape(line.strip())}" for line in entries], 0) or f"### {escape(first)}"


def _causes(report: Report) -> str:
    """A list: each cause once, with its scenes."""
    items = [_cause(explanation) for explanation in report.causes.explanations[:MOST_LISTED]]
    more = len(report.causes.explanations) - MOST_LISTED
    return _section("Causes", items, more)


def _cause(explanation: Explanation) -> str:
    lines = [f"- {escape(explanation.headline)}"]
    lines += [f"  - {escape(line)}" for line in explanation.lines]
    return "\n".join([*lines, f"  - scenes: {escape(listed(explanation.scenes))}"])


def _unexplained(report: Report) -> str:
    causes = report.causes
    items = [f"- {escape(group_line(group))}" for group in causes.unexplained[:MOST_LISTED]]
    items += [
        f"  - {escape(engine)}, {escape(listed(scenes))}: {escape(sentence)}"
        for engine, sentence, scenes in causes.remarks[:MOST_LISTED]
    ]
    return _section("Differs without a known cause", items, max(0, len(causes.unexplained) - MOST_LISTED))


def _section(title: str, items: Sequence[str], more: int) -> str:
    if not items:
        return ""
    left = f"\n\n… and {more} more; report.html lists all." if more > 0 else ""
    return f"### {title}\n\n" + "\n".join(items) + left


def _loose(report: Report) -> str:
    if not report.loose:
        return ""
    rows = [
        [
            *map(escape, (result.scene, result.engine, result.check)),
            _measured(result.measured, result.unit),
            _measured(result.line, result.unit),
            _measured(result.allowed, result.unit),
            escape(last_line(result.reason)),
        ]
        for result in report.loose[:MOST_LISTED]
    ]
    table = _rows(["scene", "engine", "check", "measured", "rounding", "allowed", "reason"], rows)
    more = len(report.loose) - MOST_LISTED
    left = f"\n\n… and {more} more; report.html lists all." if more > 0 else ""
    says = "They agree, but with larger errors than rounding explains."
    return f"### {GLYPHS['loose']} Loose\n\n{says}\n\n{table}{left}"


def _differences(report: Report) -> str:
    """The largest differences one by one, folded: what they have in common is said above."""
    table = _findings(report.having("differs"), "")
    return _folded("Differences, the largest first", table.removeprefix("### \n\n")) if table else ""


def _findings(results: Sequence[Result], title: str) -> str:
    if not results:
        return ""
    rows = [
        [
            escape(result.scene),
            escape(result.engine),
            escape(result.check),
            _measured(result.measured, result.unit),
            _measured(result.allowed, result.unit),
            escape(result.cause or ""),
            escape(last_line(result.reason)),
        ]
        for result in results[:MOST_LISTED]
    ]
    table = _rows(["scene", "engine", "check", "measured", "allowed", "cause", "reason"], rows)
    more = len(results) - MOST_LISTED
    left = f"\n\n… and {more} more; report.html lists all." if more > 0 else ""
    return f"### {title}\n\n{table}{left}"


def _table(report: Report) -> str:
    if not report.results:
        return ""
    rows = [
        [escape(scene), *(_said(report.table[scene, engine]) for engine in report.engines)] for scene in report.scenes
    ]
    return f"### Scene × engine\n\n{_rows(['scene', *map(escape, report.engines)], rows)}\n\n{LEGEND}."


def _said(cell: TableCell) -> str:
    if cell.word is None:
        return "no result"
    said = f"{GLYPHS[cell.word]} {cell.word}"
    if cell.outcome == "differs":
        said = f"**{said}**"
    return f"{said} {cell.error}".rstrip()


def _skips(report: Report) -> str:
    skips = report.reasons("skipped")
    if not skips:
        return ""
    rows = [
        [
            str(len(results)),
            _names(result.engine for result in results),
            _names(result.check for result in results),
            escape(reason),
        ]
        for reason, results in skips[:MOST_LISTED]
    ]
    table = _rows(["skipped", "engines", "checks", "reason"], rows)
    return _folded(f"{report.counts['skipped']:,} skipped, with reasons", table)


def _facts(report: Report) -> str:
    header = report.header
    facts = {"command": header.command, "profile": header.profile, "started": header.started, "seed": header.seed}
    facts |= {"furiko": header.furiko} | header.versions | header.machine
    rows = [[escape(name), escape(value)] for name, value in facts.items() if value]
    return _folded("How this was run", _rows(["", ""], rows))


def _folded(title: str, inside: str) -> str:
    return f"<details><summary>{title}</summary>\n\n{inside}\n\n</details>"


def _rows(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [heading, ["---"] * len(heading), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _names(names: Iterable[str]) -> str:
    known = sorted(set(names))
    return escape(", ".join(known)) if len(known) <= 3 else str(len(known))


def _measured(value: float | None, unit: str) -> str:
    return "" if value is None else f"{figure(value)} {escape(unit)}".rstrip()
