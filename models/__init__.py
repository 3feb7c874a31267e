"""The mechanisms that are simulated, their scenes and states, and the model files read and written.

May import nothing else of furiko: everything else rests on it.
"""

from .errors import EngineMissing, InvalidInput, LibraryMissing
from .scene import Scene, catalogue, find_scene, find_scenes
from .systems import DocumentSystem, NLegPendulum, RodChain, System
from .tree import Link, PlanarTree
from .writers.mjcf import to_mjcf
from .writers.urdf import to_urdf

__all__ = [
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
    "catalogue",
    "find_scene",
    "find_scenes",
    "to_mjcf",
    "to_urdf",
]
