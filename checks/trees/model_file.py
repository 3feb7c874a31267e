"""Model fields: what the engine makes of the scene's model file, its bytes untouched, against what the file says.

As ``furiko diagnose`` does it: bodies, joints and inertias as the engine holds them, then mass matrix, bias and
accelerations against the truth of what it holds. The causes are its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ...diagnosis.robots.answer import Question, ask_robot
from ...engines.model_files.robot import ROBOT_READERS
from ...models.readers.model_file import read_model
from ...records.check import Result
from .cell import TreeCell

NAME = "model fields"


def compare(cell: TreeCell) -> Iterator[Result]:
    """One result; an engine that refuses the file, or is lost in it, has failed."""
    path = Path(cell.scene.model)
    answer = ask_robot(ROBOT_READERS[cell.info.name], Question(path, read_model(path)))
    details = {"file": path.name}
    if answer.status == "missing":
        yield cell.result(NAME, "skipped", reason=answer.says)
    elif answer.status in ("refused", "failed"):
        yield cell.result(NAME, "error", reason=f"{path.name}: {answer.says}", details=details)
    elif answer.status == "differs":
        cell.in_file.extend(answer.findings)
        yield cell.result(NAME, "differs", reason=answer.findings[0].says, details=details)
    else:
        yield cell.result(NAME, "agrees", details=details)
