"""The mechanisms that are simulated, their scenes and states, and the model files read and written.

May import nothing else of furiko: everything else rests on it.
"""

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
)
from .systems import DocumentSystem, NLegPendulum, RodChain, System
from .tree import Link, PlanarTree
from .trees.scene import TreeScene
from .trees.system import TreeSystem
from .writers.mjcf import to_mjcf
from .writers.urdf import to_urdf

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
    "to_mjcf",
    "to_urdf",
]
