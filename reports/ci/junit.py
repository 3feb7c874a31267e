"""JUnit XML as GitHub, GitLab and Jenkins read it: a test suite a scene, a test case a comparison."""

from __future__ import annotations

from xml.etree import ElementTree as XML

from ...records.check import Outcome, Result
from ..causes import Explanation
from ..known import Entry, Known
from ..report import Report, against, against_line
from ..words import last_line, one_line, printable, word

# JUnit's element for an outcome, inside a test case. One that agrees has none.
ELEMENTS: dict[Outcome, str] = {"differs": "failure", "error": "error", "skipped": "skipped"}
COUNTED = {"failures": "failure", "errors": "error", "skipped": "skipped"}  # attribute of a suite, element in a case


def to_junit(report: Report, known: Known | None = None) -> str:
    """The XML document. A run that is not whole gets a failing suite of its own, so that no CI reports success.

    A difference that ``known`` accounts for is a skipped test with its reason: it does not fail a run.
    """
    accepted = known.by_result if known else {}
    suites = XML.Element("testsuites", {"name": "furiko"})
    by_scene: dict[str, list[Result]] = {scene: [] for scene in report.scenes}
    for result in report.results:
        by_scene[result.scene].append(result)
    for scene, results in by_scene.items():
        if results:
            suite = _suite(suites, scene, report)
            for result in results:
                entry = accepted.get((result.scene, result.engine, result.check))
                _case(suite, result, report.causes.explanation_of(result), entry)
    if report.flaws:
        suite = _suite(suites, "furiko", report)
        for flaw in report.flaws:
            case = XML.SubElement(
                suite, "testcase", {"classname": "furiko.run", "name": "the run is whole", "time": "0"}
            )
            XML.SubElement(case, "error", {"message": one_line(flaw), "type": "incomplete"})
    for suite in suites:
        suite.set("time", _seconds(sum(float(case.get("time", "0")) for case in suite)))
    suites.set("time", _seconds(sum(result.seconds for result in report.results)))
    return document(suites)


def document(suites: XML.Element) -> str:
    """The XML document, with the counts that readers of JUnit take from the attributes of each suite and of all."""
    for suite in suites:
        suite.set("tests", str(len(suite)))
        for field, element in COUNTED.items():
            suite.set(field, str(len(suite.findall(f"testcase/{element}"))))
    for field in ("tests", *COUNTED):
        suites.set(field, str(sum(int(suite.get(field, "0")) for suite in suites)))
    XML.indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + XML.tostring(suites, encoding="unicode") + "\n"


def _suite(suites: XML.Element, name: str, report: Report) -> XML.Element:
    started = report.header.started.removesuffix("Z").partition("+")[0].partition(".")[0]
    return XML.SubElement(suites, "testsuite", {"name": printable(name), "timestamp": printable(started)})


def _case(suite: XML.Element, result: Result, explanation: Explanation | None, known: Entry | None) -> None:
    where = {"classname": printable(f"{result.scene}.{result.engine}"), "name": printable(result.check)}
    case = XML.SubElement(suite, "testcase", where | {"time": _seconds(result.seconds)})
    if word(result) == "loose":
        loose = one_line(f"loose: {against_line(result)}: {last_line(result.reason)}".rstrip(": "))
        XML.SubElement(case, "system-out").text = loose
    if known is not None and result.outcome == "differs":
        message = one_line(f"known difference: {known.reason} {known.link}".rstrip())
        XML.SubElement(case, "skipped", {"message": message})
        return
    element = ELEMENTS.get(result.outcome)
    if element is None:
        return
    message = _message(result, explanation)
    said = XML.SubElement(case, element, {"message": message})
    if result.outcome != "skipped":
        found = [] if explanation is None else [explanation.headline, *explanation.lines]
        said.set("type", printable(_code(result, explanation)))
        text = [*found, result.reason, str(result.details.get("traceback", ""))]
        said.text = printable("\n".join(text).strip())


def _message(result: Result, explanation: Explanation | None) -> str:
    """The causes, then what was measured: readers of JUnit show this line, and the text below it on demand."""
    reason = last_line(result.reason) or "no reason was given"
    measured = against(result) if result.outcome == "differs" else ""
    causes = [] if explanation is None else [*explanation.together, *explanation.alternatives]
    told = all(sentence in reason for cause in causes for sentence in cause.sentences)
    cause = "" if explanation is None or told else explanation.in_words
    return one_line("; ".join(part for part in (cause, ": ".join(filter(None, (measured, reason)))) if part))


def _code(result: Result, explanation: Explanation | None) -> str:
    """The cause's code: the first of those that hold together."""
    if explanation is not None:
        return (explanation.together or explanation.alternatives)[0].code
    return result.cause or result.outcome


def _seconds(seconds: float) -> str:
    return f"{seconds:.6f}"
