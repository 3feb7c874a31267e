"""Assesses submissions in a process of its own: ``python -m furiko.derivations.classroom.worker``.

Reads one JSON document a line from standard input, the problem first, then each submission, and writes one a line.
Limits on memory and time keep one submission from harming the others or the machine; nothing of a submission is run.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys

from .assess import assess_text, unread
from .problem import problem_of

MEGABYTES = 1024
STUCK = 5  # [s] after its limit in which a process that nobody ends any more ends itself


def main() -> None:
    """Assess what comes until standard input ends."""
    answer_to = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    problem = problem_of(json.loads(sys.stdin.readline()))
    print("ready", file=answer_to, flush=True)
    for line in sys.stdin:
        task = json.loads(line)
        signal.alarm(int(problem.seconds) + STUCK)
        try:
            found = assess_text(problem, task["who"], task["text"])
        except MemoryError:
            found = unread(problem, task["who"], "not graded", f"it needs more than {MEGABYTES} MB of memory")
        except Exception as error:
            why = f"a mistake in furiko: {type(error).__name__}: {str(error)[:200]}"
            found = unread(problem, task["who"], "not graded", why)
        signal.alarm(0)
        print(json.dumps(found.to_dict()), file=answer_to, flush=True)


if __name__ == "__main__":
    main()
