"""furiko: cross-checks hand-derived equations of motion and physics engines, and names the cause where they differ.

Names are imported where they are first used: ``import furiko`` alone loads neither an engine nor numpy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .checks.diagnose import diagnose
    from .derivations.audit import audit
    from .derivations.diagnosis import Diagnosis
    from .derivations.grade import grade
    from .engines import engine_names, load_engine
    from .models import EngineMissing, InvalidInput, NLegPendulum, RodChain, to_mjcf, to_urdf
    from .reference.energies import energy
    from .reference.kernels import accelerations
    from .reference.taylor import simulate
    from .reports import Report, read_stream
    from .run import check

__version__ = "0.1.0"

_HOMES = {
    "Diagnosis": "derivations.diagnosis",
    "EngineMissing": "models",
    "InvalidInput": "models",
    "NLegPendulum": "models",
    "Report": "reports",
    "RodChain": "models",
    "accelerations": "reference.kernels",
    "audit": "derivations.audit",
    "check": "run",
    "diagnose": "checks.diagnose",
    "energy": "reference.energies",
    "engine_names": "engines",
    "grade": "derivations.grade",
    "load_engine": "engines",
    "read_stream": "reports",
    "simulate": "reference.taylor",
    "to_mjcf": "models",
    "to_urdf": "models",
}

__all__ = [
    "Diagnosis",
    "EngineMissing",
    "InvalidInput",
    "NLegPendulum",
    "Report",
    "RodChain",
    "accelerations",
    "audit",
    "check",
    "diagnose",
    "energy",
    "engine_names",
    "grade",
    "load_engine",
    "read_stream",
    "simulate",
    "to_mjcf",
    "to_urdf",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'furiko' has no attribute {name!r}")
    value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
