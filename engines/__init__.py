"""Physics engines behind one protocol (:mod:`.protocol`), and the only place where an engine is imported.

May import models and records, and nothing of the theory. An engine's name and capabilities are known without importing
it or numpy: a plan is made while the workers are still importing them.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .info import EngineInfo, Integrator, Offer, Quantity, TreeInfo, TreeQuantity
from .known.usual import ENGINES
from .registry import (
    OWN_EQUATIONS,
    all_of,
    cannot,
    engine_adapter,
    engine_info,
    engine_names,
    engine_place,
    engine_version,
    environment_of,
    load_engine,
    load_tree_engine,
    names_on_request,
    plugin_names,
    runs_elsewhere,
    untested,
    why_missing,
)

if TYPE_CHECKING:
    from .protocol import BareCall, Engine, ModelFields, Native, TreeEngine
    from .shapes import AnyShape
    from .trees.shapes import TreeShape

_HOMES = {
    "AnyShape": "shapes",
    "BareCall": "protocol",
    "Engine": "protocol",
    "ModelFields": "protocol",
    "Native": "protocol",
    "TreeEngine": "protocol",
    "TreeShape": "trees.shapes",
}

__all__ = [
    "ENGINES",
    "OWN_EQUATIONS",
    "AnyShape",
    "BareCall",
    "Engine",
    "EngineInfo",
    "Integrator",
    "ModelFields",
    "Native",
    "Offer",
    "Quantity",
    "TreeEngine",
    "TreeInfo",
    "TreeQuantity",
    "TreeShape",
    "all_of",
    "cannot",
    "engine_adapter",
    "engine_info",
    "engine_names",
    "engine_place",
    "engine_version",
    "environment_of",
    "load_engine",
    "load_tree_engine",
    "names_on_request",
    "plugin_names",
    "runs_elsewhere",
    "untested",
    "why_missing",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'furiko.engines' has no attribute {name!r}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
