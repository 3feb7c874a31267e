"""Reads a derivation in any form: equations of motion, a Lagrangian, a Hamiltonian, equations with momenta, stages."""

from __future__ import annotations

from typing import Any

from ..dialects.table import translated
from .forms.hamilton import read_hamilton
from .forms.stages import is_staged, read_stages
from .submission import Submission, known_fields, opened, read_fields


def read_derivation(data: dict[str, Any], slashes: int = 0) -> Submission:
    """Read the fields of a derivation. ``slashes``: how 3g/2l is read, as in :class:`Slashes`.

    Raises InvalidInput, with the place, where it is none.
    """
    known_fields(data)
    data = translated(data)
    reader = opened(data, slashes)
    if is_staged(data, reader.evaluation.space.n):
        return read_stages(data, reader)
    if "hamiltonian" in data or (reader.variable is not None and reader.variable.kind == "momentum"):
        return read_hamilton(data, reader)
    return read_fields(data, reader)
