"""What ``furiko-ci`` leaves in its folder: ``python -m furiko.ci FOLDER STATUS...``, and annotations for GitHub.

The statuses are those of each command that ran; the exit status is the gravest of them.

After ``furiko check`` the folder has a run's reports; where it failed before there were any, they say why. After
``furiko diagnose`` it has ``models/1.json`` and so on, one a file, of which the summary and the JUnit file are made.
"""

from __future__ import annotations

import os
import sys
import traceback
from pathlib import Path

import msgspec

from ..models import InvalidInput
from ..models.readers.bounded_file import read_text
from ..models.writers.whole_file import write_whole
from ..records.errors import Error, ErrorDocument
from ..records.exit_status import AGREES, INCOMPLETE, INTERNAL_ERROR, gravest
from ..records.findings import DiagnoseDocument
from ..reports import read_stream
from ..reports.ci import github
from ..reports.ci.model_files import Answer, failure_markdown, models_junit, models_markdown
from ..reports.write import JUNIT, SUMMARY

LARGEST = 50_000_000  # bytes of one answer: a robot of hundreds of links has a few
LONGEST_MESSAGE = 10_000  # bytes of what a command says where it fails; it is one line


def main(folder: Path, status: int) -> None:
    """Write what is missing in the folder, and print the annotations. ``status``: the exit status of all."""
    if (folder / "models").is_dir():
        lines = _of_models(folder)
    elif (folder / SUMMARY).is_file():
        report = read_stream(folder)
        lines = github.of_report(report) if status != AGREES else []
    else:
        lines = _of_failure(folder, status)
    if os.environ.get("GITHUB_ACTIONS") == "true":
        sys.stdout.write("".join(f"{line}\n" for line in lines[: github.MOST]))


def _of_models(folder: Path) -> list[str]:
    paths = sorted((folder / "models").glob("*.path"), key=lambda path: int(path.stem))
    answers = [_answer(path) for path in paths]
    write_whole(folder / SUMMARY, models_markdown(answers))
    write_whole(folder / JUNIT, models_junit(answers))
    sys.stdout.write("".join(f"{answer.text}\n" for answer in answers))
    return [line for answer in answers for line in _annotations(answer)]


def _answer(path: Path) -> Answer:
    model = read_text(path, LONGEST_MESSAGE)
    text = read_text(path.with_suffix(".json"), LARGEST).encode()
    try:
        return Answer(model, msgspec.json.decode(text, type=DiagnoseDocument))
    except msgspec.MsgspecError:
        pass
    try:
        return Answer(model, msgspec.json.decode(text, type=ErrorDocument).error)
    except msgspec.MsgspecError:  # it was ended before it could answer
        return Answer(model, Error(what="there is no answer: furiko was ended", where=model, help=""))


def _annotations(answer: Answer) -> list[str]:
    if isinstance(answer.found, Error):
        return [github.of_error(answer.found, answer.path)]
    return github.of_model(answer.path, answer.found)


def _of_failure(folder: Path, status: int) -> list[str]:
    """The summary and the JUnit file of a check that never began, from what it said."""
    errors = folder / "errors.txt"
    said = read_text(errors, LONGEST_MESSAGE) if errors.is_file() else ""
    last = (said.strip().splitlines() or [f"furiko ended with status {status}"])[-1].removeprefix("furiko: ")
    path, line, message = github.place_of(last)
    error = Error(what=message, where=f"{path}, line {line}" if line else path, help="")
    write_whole(folder / SUMMARY, failure_markdown(last))
    write_whole(folder / JUNIT, models_junit([Answer(path or "furiko", error)]))
    return [github.of_error(error, path)]


def _run(arguments: list[str]) -> int:
    statuses = [int(status) for status in arguments[1:]]
    try:
        main(Path(arguments[0]), gravest(statuses))
    except (InvalidInput, OSError) as error:
        sys.stderr.write(f"furiko-ci: {error}\n")
        statuses.append(INCOMPLETE)
    except Exception:
        traceback.print_exc()
        statuses.append(INTERNAL_ERROR)
    return gravest(statuses)


if __name__ == "__main__":
    sys.exit(_run(sys.argv[1:]))
