"""A class's results for other programs: CSV for a spreadsheet, JUnit XML for CI, results.json for Gradescope.

The format of results.json: https://gradescope-autograders.readthedocs.io/en/latest/specs/
"""

from __future__ import annotations

import csv
import io
import json
from typing import Any
from xml.etree import ElementTree as XML

from ..records.classroom import Assessed, ClassDocument
from .words import one_line, printable

FORMULA = ("=", "+", "-", "@")  # a spreadsheet takes what starts so for a formula


def to_csv(found: ClassDocument) -> str:
    """One line a submission: who, outcome, points, the points of each part, and the reason or the mistakes."""
    names = list(dict.fromkeys(part.name for s in found.submissions for part in s.parts))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["who", "outcome", "points", "of", *names, "why"])
    for s in found.submissions:
        points = {part.name: f"{part.points:g}" for part in s.parts}
        mistakes = [m.says for m in found.mistakes if s.who in m.who]
        why = s.why or "; ".join(mistakes)
        row = [_inert(s.who), s.outcome, f"{s.points:g}", f"{s.of:g}", *(points.get(n, "") for n in names), _inert(why)]
        writer.writerow(row)
    return out.getvalue()


def _inert(text: str) -> str:
    line = one_line(text)
    return f"'{line}" if line.startswith(FORMULA) else line


def to_class_junit(found: ClassDocument) -> str:
    """A test case a submission: wrong is a failure, what has no verdict an error."""
    suites = XML.Element("testsuites", {"name": "furiko"})
    suite = XML.SubElement(suites, "testsuite", {"name": printable(found.title) or "problem"})
    for s in found.submissions:
        where = {"classname": "furiko.grade", "name": one_line(s.who), "time": f"{s.seconds:.4f}"}
        case = XML.SubElement(suite, "testcase", where)
        if s.outcome == "correct":
            continue
        kind = "failure" if s.outcome in ("wrong", "undecided") else "error"
        message = one_line(s.why or (s.feedback[0] if s.feedback else s.outcome))
        XML.SubElement(case, kind, {"message": message, "type": s.outcome}).text = printable("\n".join(s.feedback))
    for element in (suite, suites):
        element.set("tests", str(len(found.submissions)))
        element.set("failures", str(len(suite.findall("testcase/failure"))))
        element.set("errors", str(len(suite.findall("testcase/error"))))
        element.set("skipped", "0")
        element.set("time", f"{sum(s.seconds for s in found.submissions):.4f}")
    XML.indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + XML.tostring(suites, encoding="unicode") + "\n"


def to_gradescope(found: ClassDocument, submission: Assessed) -> str:
    """The results.json of one submission. Its author sees what the hints allow; the teacher a hidden test with all."""
    tests: list[dict[str, Any]] = []
    if found.hints >= 1:
        tests = [
            {"name": one_line(part.name), "score": part.points, "max_score": part.of,
             "status": "passed" if part.outcome == "right" else "failed", "visibility": "visible",
             "output": part.outcome, "output_format": "text"}
            for part in submission.parts if part.of
        ]  # fmt: skip
    tests.append({
        "name": "for the teacher", "max_score": 0, "score": 0, "visibility": "hidden",
        "output": _for_the_teacher(found, submission), "output_format": "text",
    })  # fmt: skip
    document = {
        "score": submission.points, "execution_time": round(submission.seconds, 3), "visibility": "visible",
        "output": printable("\n".join(submission.feedback)), "output_format": "text", "stdout_visibility": "hidden",
        "tests": tests, "extra_data": {"outcome": submission.outcome},
    }  # fmt: skip
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def _for_the_teacher(found: ClassDocument, s: Assessed) -> str:
    lines = [s.outcome, found.rule, s.why, *(m.says for m in found.mistakes if s.who in m.who)]
    lines += [f"{t.term}: found {t.found}, expected {t.expected}" for part in s.parts for t in part.terms]
    lines += [f"solution, {label}: {line}" for label, line in s.solution]
    return printable("\n".join(line for line in lines if line))
