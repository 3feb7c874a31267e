"""The mechanisms that are simulated, their scenes and states, and the model files read and written.

May import nothing else of furiko: everything else rests on it.

A name is imported when it is first used: an adapter in an environment of its own needs few of them, and none of the
libraries that the others need.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .errors import EngineMissing, InvalidInput, LibraryMissing
    from .scene import (
        AnyScene,
        Scene,
        catalogue,
        document_catalogue,
        document_scenes,
        find_document_scene,
        find_scene,
        find_scenes,
        tagged_scenes,
    )
    from .systems import DocumentSystem, NLegPendulum, RodChain, System
    from .tree import Link, PlanarTree
    from .trees.scene import TreeScene
    from .trees.system import TreeSystem
    from .writers.mjcf import to_mjcf
    from .writers.urdf import to_urdf

_HOMES = {
    "AnyScene": "scene",
    "DocumentSystem": "systems",
    "EngineMissing": "errors",
    "InvalidInput": "errors",
    "LibraryMissing": "errors",
    "Link": "tree",
    "NLegPendulum": "systems",
    "PlanarTree": "tree",
    "RodChain": "systems",
    "Scene": "scene",
    "System": "systems",
    "TreeScene": "trees.scene",
    "TreeSystem": "trees.system",
    "catalogue": "scene",
    "document_catalogue": "scene",
    "document_scenes": "scene",
    "find_document_scene": "scene",
    "find_scene": "scene",
    "find_scenes": "scene",
    "tagged_scenes": "scene",
    "to_mjcf": "writers.mjcf",
    "to_urdf": "writers.urdf",
}

__all__ = [
    "AnyScene",
    "DocumentSystem",
    "EngineMissing",
    "InvalidInput",
    "LibraryMissing",
    "Link",
    "NLegPendulum",
    "PlanarTree",
    "RodChain",
    "Scene",
    "System",
    "TreeScene",
    "TreeSystem",
    "catalogue",
    "document_catalogue",
    "document_scenes",
    "find_document_scene",
    "find_scene",
    "find_scenes",
    "tagged_scenes",
    "to_mjcf",
    "to_urdf",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'furiko.models' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    return value
