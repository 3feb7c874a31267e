"""Grading in Python: a text, fields, or sympy's own objects; with a problem or without."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from typing import Any, overload

from ...models.errors import InvalidInput
from ..grading.grade import grade_fields
from ..grading.grade_record import Grade
from ..reading.pinned import Pinned
from ..reading.submission import FIELDS, fields_of
from .assess import Assessment, assess
from .problem import Problem, problem_of, read_problem

# A line that only a TOML file has: a table, a field with a text, a number or a list, or a row in quotes.
_FIELD = f"(?:{'|'.join(FIELDS)})"
_TABLE = rf"\[\[?{_FIELD}\]\]?\s*(?:#.*)?$"
IS_TOML = re.compile(rf"^\s*(?:{_TABLE}|{_FIELD}\s*=\s*[\"'\[{{0-9]|[0-9]+\s*=\s*[\"'])", re.MULTILINE)

AnyProblem = Problem | Mapping[str, Any] | str | os.PathLike[str]


@overload
def grade_text(source: Any, problem: None = None, *, pinned: Pinned | None = None, **fields: Any) -> Grade: ...


@overload
def grade_text(source: Any, problem: AnyProblem, *, pinned: Pinned | None = None, **fields: Any) -> Assessment: ...


def grade_text(
    source: Any, problem: AnyProblem | None = None, *, pinned: Pinned | None = None, **fields: Any
) -> Grade | Assessment:
    """Grade the text of a derivation's TOML file, its fields, a text (LaTeX, a program), or what sympy has.

    sympy: ``Eq``, or a list of them, or a list or a matrix of expressions that are zero, are equations of motion; one
    expression alone is a Lagrangian. ``fields``: of the file, as in ``system="n-leg", links=2``. ``problem``: a
    problem's file, its fields, or what :func:`read_problem` gives: the result has points then. Raises InvalidInput,
    with the place, where the derivation cannot be read, or states another problem.
    """
    data = {**_fields(source), **fields}
    if problem is not None:
        return assess(_problem(problem), "", data)

    return grade_fields(data, pinned=pinned)


def _problem(problem: AnyProblem) -> Problem:
    if isinstance(problem, Problem):
        return problem
    return problem_of(dict(problem)) if isinstance(problem, Mapping) else read_problem(problem)


def _fields(source: Any) -> dict[str, Any]:
    if isinstance(source, str):
        return fields_of(source, ".toml" if IS_TOML.search(source) else "")
    if isinstance(source, Mapping):
        return dict(source)
    if _is_sympy(source) and hasattr(source, "tolist"):  # a matrix
        source = [entry for row in source.tolist() for entry in row]
    if isinstance(source, Sequence):
        return {"equations": [_equation(entry) for entry in source]}
    if not _is_sympy(source):
        raise InvalidInput(f"a text, fields or sympy's Eq, expression or matrix is needed, got {type(source).__name__}")
    if hasattr(source, "lhs"):
        return {"equations": [str(source)]}
    if ", (t, 2))" in str(source):
        raise InvalidInput("an expression alone is taken as a Lagrangian, which has no accelerations; give Eq(…, 0)")
    return {"lagrangian": str(source)}


def _equation(entry: Any) -> str:
    return str(entry) if isinstance(entry, str) or hasattr(entry, "lhs") else f"{entry} = 0"


def _is_sympy(value: Any) -> bool:
    return type(value).__module__.partition(".")[0] == "sympy"
