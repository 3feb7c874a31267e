"""What ``furiko diagnose`` found in several model files, as one Markdown summary and one JUnit file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as XML

from ...records.errors import Error
from ...records.findings import DiagnoseDocument
from ..words import count, one_line, printable
from .junit import document
from .markdown import escape

_ELEMENTS = {"differs": "failure", "refused": "failure", "failed": "error", "missing": "skipped"}


@dataclass(frozen=True)
class Answer:
    """What was found in one file: a diagnosis, or why there is none."""

    path: str
    found: DiagnoseDocument | Error

    @property
    def agrees(self) -> bool:
        """Whether every engine that was asked reads the file as it is meant."""
        return isinstance(self.found, DiagnoseDocument) and self.found.verdict == "agrees"

    @property
    def headline(self) -> str:
        """The answer in one sentence."""
        if isinstance(self.found, DiagnoseDocument):
            return self.found.headline
        return self.found.said.removeprefix(self.path).lstrip(",: ")

    @property
    def causes(self) -> list[str]:
        """One sentence for each finding."""
        if isinstance(self.found, Error):
            return []
        return [f"{one.cause} at {one.where}: {one.says}" for one in self.found.findings]

    @property
    def text(self) -> str:
        """For a log: one line, and one for each finding."""
        first = one_line(f"- {self.path}: {self.headline}")
        return "\n".join([first, *(f"    {one_line(one)}" for one in self.causes)])

    @property
    def without(self) -> list[str]:
        """What acts in the file and is left out of the comparison."""
        return [] if isinstance(self.found, Error) else self.found.without


def models_markdown(answers: Sequence[Answer]) -> str:
    """GitHub-flavoured Markdown, what is wrong first, its causes with it; text from the files never acts as markup."""
    wrong = [answer for answer in answers if not answer.agrees]
    right = [answer for answer in answers if answer.agrees]
    if wrong:
        verdict = f"✗ {len(wrong):,} of {count(len(answers), 'model file')}: {'; '.join(a.path for a in wrong)}"
    elif answers:
        verdict = f"✓ {count(len(answers), 'model file')}: every engine that was asked reads {_them(right)} alike"
    else:
        verdict = "– no model file was looked at"
    lines = [f"## furiko {escape(verdict)}", ""]
    for answer in wrong:
        lines += [f"### {escape(answer.path)}", "", f"{escape(answer.headline)}", ""]
        found = [f"- {escape(one)}" for one in (*answer.causes, *(f"without {one}" for one in answer.without))]
        lines += [*found, ""] if found else []
    for answer in right:
        lines += [f"- {escape(f'{answer.path}: {answer.headline}')}"]
        lines += [f"  - {escape(f'without {one}')}" for one in answer.without]
    return "\n".join(lines).rstrip("\n") + "\n"


def failure_markdown(message: str) -> str:
    """The summary of a command that failed before there was anything to sum up."""
    return f"## furiko ! {escape(message)}\n"


def _them(answers: Sequence[Answer]) -> str:
    return "it" if len(answers) == 1 else "each"


def models_junit(answers: Sequence[Answer]) -> str:
    """JUnit XML: a suite for each file, in it a test case for each engine and one for the file itself."""
    suites = XML.Element("testsuites", {"name": "furiko"})
    for answer in answers:
        suite = XML.SubElement(suites, "testsuite", {"name": printable(answer.path)})
        for name, status, message in _cases(answer):
            case = XML.SubElement(suite, "testcase", {"classname": printable(answer.path), "name": printable(name)})
            element = _ELEMENTS.get(status)
            if element is not None:
                said = XML.SubElement(case, element, {"message": one_line(message)})
                if element != "skipped":
                    said.set("type", status)
                    said.text = printable("\n".join([answer.headline, *answer.causes]))
    return document(suites)


def _cases(answer: Answer) -> list[tuple[str, str, str]]:
    """Name, status and message of each test case."""
    if isinstance(answer.found, Error):
        return [("the file", "failed", answer.headline)]
    first = "; ".join(answer.causes) or answer.headline
    engines = answer.found.engines
    cases = [(name, said.status, said.says or first) for name, said in engines.items()]
    blamed = not answer.agrees and not any(status in ("differs", "refused", "failed") for _, status, _ in cases)
    return [("the file", "differs" if blamed else "agrees", first), *cases]
