"""Calls a user's function in a process of its own: ``python -m furiko.derivations.grading.callable_process``.

Reads one JSON document (the function, limits, states) from standard input and writes one, the accelerations or a line
saying what went wrong, to standard output; what the function itself prints goes to standard error. The limits on time
and memory keep an endless loop or a runaway array from harming the machine. They are no sandbox: the function can read
and write files as its owner can, so that only functions that are trusted should be graded.
"""

from __future__ import annotations

import importlib
import json
import os
import signal
import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any


def main() -> None:
    """Do what the document on standard input asks."""
    task = json.load(sys.stdin)
    answer_to = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what the function prints must not end up in the answer
    _limit(task["seconds"], task["megabytes"])
    sys.path.insert(0, os.getcwd())
    try:
        function = _load(task["function"])
        answer: dict[str, Any] = {"accelerations": [_call(function, state) for state in task["states"]]}
    except MemoryError:
        answer = {"error": f"needs more than {task['megabytes']} MB of memory"}
    except BaseException as error:  # whatever it is, it is the function's own
        answer = {"error": f"{type(error).__name__}: {error}"[:300].replace("\n", " ")}
    json.dump(answer, answer_to)
    answer_to.flush()
    os._exit(0)  # threads or handlers that the function left behind are not waited for


def _limit(seconds: float, megabytes: int) -> None:
    if sys.platform == "win32":
        return  # it has none of these: whoever called ends this process when its time is over
    import resource

    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
    resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.alarm(int(seconds) + 10)  # a function that sleeps uses no time; whoever called may be gone by then


def _load(spec: str) -> Callable[..., Any]:
    module, _, name = spec.partition(":")
    found: Any = importlib.import_module(module)
    for part in name.split("."):
        found = getattr(found, part)
    if not callable(found):
        raise TypeError(f"{spec} is not a function")
    return found  # type: ignore[no-any-return]


def _call(function: Callable[..., Any], state: dict[str, Any]) -> list[float]:
    import numpy as np

    theta, omega = np.array(state["theta"]), np.array(state["omega"])
    parameters = SimpleNamespace(**{
        name: np.array(value) if isinstance(value, list) else value for name, value in state["parameters"].items()
    })  # fmt: skip
    values = np.asarray(function(theta, omega, parameters), dtype=np.float64).reshape(-1)
    if values.shape != (len(theta),):
        raise ValueError(f"{len(theta)} accelerations are expected, got {values.shape[0]}")
    return [float(value) for value in values]


if __name__ == "__main__":
    main()
