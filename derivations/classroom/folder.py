"""Assesses many submissions, each within its time, in processes that none of them can spoil for another."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...models.errors import InvalidInput
from ...models.readers.bounded_file import read_text, shown
from ..reading.submission import LARGEST_FILE, is_toml
from .assess import Outcome, unread
from .problem import Problem
from .worker import answer_in

MOST_SUBMISSIONS = 5000
# What a derivation is handed in as: its fields, a text, or a program's text.
ENDINGS = (
    ".toml", ".tex", ".md", ".txt", ".html", ".ipynb", ".py", ".m", ".jl", ".c", ".cpp", ".js", ".ts", ".java", ".cs",
    ".rs", ".go", ".f90", ".r", ".lua", ".wl", ".mac", ".mo", ".hs", ".swift", ".kt",
)  # fmt: skip
START = 60.0  # [s] in which a process must be ready


@dataclass(frozen=True)
class Handed:
    """A submission's file, and whose it is."""

    who: str
    path: Path


def handed_in(paths: Sequence[Path]) -> list[Handed]:
    """The submissions in these files and folders, in the order of their names.

    In a folder each file that may be a derivation (``ENDINGS``) is one, named by its file; in a folder of folders, by
    the folder it is in. Where a student has a TOML file, that is the submission, and texts beside it are not. Raises
    InvalidInput where there is none.
    """
    found: list[Handed] = []
    for path in paths:
        if not path.is_dir():
            found.append(Handed(path.stem, path))
            continue
        alone = _written_in(path)
        stems = {p.stem for p in alone if is_toml(p.suffix)}
        inside = [Handed(p.stem, p) for p in alone if is_toml(p.suffix) or p.stem not in stems]
        for folder in sorted(p for p in path.iterdir() if p.is_dir() and not p.name.startswith(".")):
            files = _written_in(folder)
            files = [p for p in files if is_toml(p.suffix)] or files
            name = folder.name
            inside += [Handed(name if len(files) == 1 else f"{name}/{p.stem}", p) for p in files]
        if not inside:
            raise InvalidInput(
                f"{shown(path)}: no submission; a folder with files that end in {', '.join(ENDINGS)}, or of folders "
                "with one each, is needed"
            )
        found += sorted(inside, key=lambda one: one.path)
    if len(found) > MOST_SUBMISSIONS:
        raise InvalidInput(f"{len(found)} submissions; at most {MOST_SUBMISSIONS} at a time")
    names = [x.who for x in found]
    return [x if names.count(x.who) == 1 else Handed(str(x.path), x.path) for x in found]


def _written_in(folder: Path) -> list[Path]:
    """The files of a folder that may be derivations, in the order of their names."""
    return sorted(
        p for p in folder.iterdir()
        if p.suffix.lower() in ENDINGS and not p.name.startswith(".") and p.stem.lower() != "readme"
        and (p.is_file() or p.is_symlink())  # a link to nothing is told as one
    )  # fmt: skip


def assess_all(
    problem: Problem, fields: dict[str, Any], submissions: Sequence[Handed], *, jobs: int | None = None,
    watch: Callable[[int], None] = lambda _: None,
) -> list[dict[str, Any]]:  # fmt: skip
    """The assessments, as JSON has them, in the order of the submissions. ``fields``: of the problem's file.

    ``watch``: called with how many are done.
    """
    if len(submissions) == 1 and threading.active_count() == 1 and sys.platform != "win32":
        return [_alone(problem, submissions[0])]
    lock = threading.Lock()
    waiting: Iterator[tuple[int, Handed]] = iter(enumerate(submissions))
    results: list[dict[str, Any]] = [{}] * len(submissions)
    done = 0

    def work() -> None:
        nonlocal done
        worker = Worker(problem, fields)
        try:
            while True:
                with lock:
                    place, handed = next(waiting, (-1, None))
                if handed is None:
                    return
                results[place] = _one(worker.assess, problem, handed)
                with lock:
                    done += 1
                    watch(done)
        finally:
            worker.end()

    count = max(1, min(len(submissions), jobs or os.cpu_count() or 1))
    if count == 1:
        work()
        return results
    with ThreadPoolExecutor(count) as pool:
        for future in [pool.submit(work) for _ in range(count)]:
            future.result()
    return results


def _alone(problem: Problem, handed: Handed) -> dict[str, Any]:
    """One submission in a fork of this process, which has no threads: that starts at once."""

    def assess(who: str, text: str, suffix: str) -> dict[str, Any]:
        reads, writes = os.pipe()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads that numpy's library may have
            child = os.fork()
        if not child:
            answer_in(writes, problem, who, text, suffix)
        os.close(writes)
        content, late = b"", False
        with os.fdopen(reads, "rb") as stream:
            end = time.monotonic() + problem.seconds
            while select.select([stream], [], [], max(0.0, end - time.monotonic()))[0]:
                more = os.read(stream.fileno(), 1 << 16)
                content += more
                if not more:
                    break
            else:
                late = True
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return _answer(problem, who, None if late else content.decode() or None, late)

    return _one(assess, problem, handed)


def _answer(problem: Problem, who: str, answer: str | None, late: bool) -> dict[str, Any]:
    if answer is not None:
        found: dict[str, Any] = json.loads(answer)
        return found
    why = f"it takes longer than {problem.seconds:g} s" if late else "the process that graded it ended"
    return unread(problem, who, "not graded", why).to_dict()


def _one(assess: Callable[[str, str, str], dict[str, Any]], problem: Problem, handed: Handed) -> dict[str, Any]:
    outcome: Outcome = "not read"
    try:
        if handed.path.is_symlink():
            raise InvalidInput("it is a link to another file; hand in the file itself")
        text = read_text(handed.path, 4 * LARGEST_FILE)
    except InvalidInput as error:
        return unread(problem, handed.who, outcome, str(error)).to_dict()
    return assess(handed.who, text, handed.path.suffix)


class Worker:
    """One process; it is started when it is first needed, and again after it was ended."""

    def __init__(self, problem: Problem, fields: dict[str, Any]) -> None:
        self.problem, self.fields = problem, fields
        self.process: subprocess.Popen[str] | None = None

    def assess(self, who: str, text: str, suffix: str) -> dict[str, Any]:
        """The assessment of one text, as JSON has it; "not graded" where it takes too long or the process ends."""
        if self.process is None and self._ask(json.dumps(self.fields), START) is None:
            self.end()
            return unread(self.problem, who, "not graded", "the process that grades could not be started").to_dict()
        answer = self._ask(json.dumps({"who": who, "text": text, "suffix": suffix}), self.problem.seconds)
        if answer is None:
            self.end()
        return _answer(self.problem, who, answer, self.late)

    def _ask(self, line: str, seconds: float) -> str | None:
        """The answer to a line; None where none comes in time."""
        self.late = False
        if self.process is None:
            command = [sys.executable, "-m", "furiko.derivations.classroom.worker"]
            pipe = subprocess.PIPE
            self.process = subprocess.Popen(
                command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, text=True, encoding="utf-8"
            )
        process = self.process
        assert process.stdin is not None
        assert process.stdout is not None

        def stop() -> None:
            self.late = True
            process.kill()

        timer = threading.Timer(seconds, stop)
        timer.start()
        try:
            process.stdin.write(line + "\n")
            process.stdin.flush()
            return process.stdout.readline() or None
        except OSError:
            return None
        finally:
            timer.cancel()

    def end(self) -> None:
        """End the process."""
        process, self.process = self.process, None
        if process is not None:
            process.kill()
            process.communicate()
