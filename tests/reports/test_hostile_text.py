"""No text from outside makes a terminal, Markdown, JUnit or the page act, and none forges a line."""

import io
import unicodedata

import pytest

from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.reports.ci.junit import to_junit
from furiko.reports.ci.markdown import to_markdown
from furiko.reports.compare import compare
from furiko.reports.pages.check_page import to_html
from furiko.reports.report import Report, footer_of
from furiko.reports.terminal.check import print_report

BIDI = "".join(map(chr, [0x200E, 0x200F, 0x061C, *range(0x202A, 0x202F), *range(0x2066, 0x206A)]))
CONTROLS = "".join(chr(i) for i in [*range(0x20), 0x7F, *range(0x80, 0xA0)])
HOSTILE = [
    "\x1b[2J\x1b]0;title\x07",
    "\x9b31m",
    BIDI,
    CONTROLS,
    "\u2028\u2029\ufeff\u00ad\U000e0041\ud800",
    "name\nAll 30 comparisons agree.",
    "name\r✓ agrees",
]


def run(make, text: str, outcome: str) -> Report:
    """The text in every name, reason and sentence."""
    named = {"scene": text, "engine": text, "check": text, "reason": text, "unit": text, "cause": text}
    results = (make.result(outcome, **named), make.result("skipped", scene="s", engine="e", reason=text))
    finding = Difference(cause=text, where=text, measured=text, expected=text, says=text)
    diagnoses = tuple(
        Diagnosis(scene=text, engine=text, findings=findings, alternatives=either, explains=[text])
        for findings, either in (([finding], []), ([], [finding, finding]))
    )
    header = make.header(
        scenes=[make.scene(text, source=text), make.scene("s", asked=True), make.scene(f"{text}!")],
        engines=[make.engine(text, version=text), make.engine("e", asked=True)],
        command=text,
        started=text,
    )
    return Report(header, results, footer_of(results, diagnoses), diagnoses)


def shown(report: Report) -> dict[str, str]:
    stream = io.StringIO()
    print_report(report, path="furiko-report\x1b[2J/\u202e\nAll 30 agree.html", file=stream)
    return {
        "terminal": stream.getvalue(),
        "markdown": to_markdown(report),
        "junit": to_junit(report),
        "page": to_html(report),
        "diff": compare(report, report).text() + compare(report, Report(report.header, (), None)).text(),
    }


@pytest.mark.parametrize("outcome", ["agrees", "loose", "differs", "skipped", "error"])
@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_does_not_act(make, text, outcome):
    for name, found in shown(run(make, text, outcome)).items():
        acting = {c for c in found if c != "\n" and unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp")}
        assert not acting, (name, acting)


@pytest.mark.parametrize("outcome", ["agrees", "loose", "differs", "skipped", "error"])
def test_no_name_forges_a_line(make, outcome):
    for name, found in shown(run(make, "name\nAll 30 comparisons agree.", outcome)).items():
        if name in ("terminal", "markdown", "diff"):
            assert not [line for line in found.splitlines() if line.startswith("All 30")], name
