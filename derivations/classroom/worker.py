"""Assesses submissions in a process of its own: ``python -m furiko.derivations.classroom.worker``.

Reads one JSON document a line from standard input, the problem first, then each submission, and writes one a line.
Limits on memory and time keep one submission from harming the others or the machine; nothing of a submission is run.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from typing import NoReturn

from .assess import assess_text, unread
from .problem import Problem, problem_of

MEGABYTES = 1024
STUCK = 5  # [s] after its limit in which a process that nobody ends any more ends itself


def main() -> None:
    """Assess what comes until standard input ends."""
    answer_to = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    problem = problem_of(json.loads(sys.stdin.readline()))
    _limit()
    print("ready", file=answer_to, flush=True)
    for line in sys.stdin:
        task = json.loads(line)
        print(_assessed(problem, task["who"], task["text"], task["suffix"]), file=answer_to, flush=True)


def answer_in(descriptor: int, problem: Problem, who: str, text: str, suffix: str) -> NoReturn:
    """Write the assessment to a pipe and end this process, which is a fork."""
    try:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGALRM):
            signal.signal(number, signal.SIG_DFL)
        _limit()
        with os.fdopen(descriptor, "w", encoding="utf-8") as answer_to:
            answer_to.write(_assessed(problem, who, text, suffix))
    finally:
        os._exit(0)


def _limit() -> None:
    if sys.platform == "win32":
        return  # it has none of these; whoever called ends this process when its time is over
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _alarm(seconds: int) -> None:
    if sys.platform != "win32":
        signal.alarm(seconds)


def _assessed(problem: Problem, who: str, text: str, suffix: str) -> str:
    _alarm(int(problem.seconds) + STUCK)
    try:
        found = assess_text(problem, who, text, suffix)
    except MemoryError:
        found = unread(problem, who, "not graded", f"it needs more than {MEGABYTES} MB of memory")
    except Exception as error:
        why = f"a mistake in furiko: {type(error).__name__}: {str(error)[:200]}"
        found = unread(problem, who, "not graded", why)
    _alarm(0)
    return json.dumps(found.to_dict())


if __name__ == "__main__":
    main()
