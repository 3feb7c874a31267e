"""A user's model file, MJCF or URDF, as furiko understands it: validated here before any engine reads it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InvalidInput
from ..mechanism import Mechanism
from ..projection import Body, Plane, planar_mechanism
from ..spatial import Inertial
from .attributes import Array
from .hinged import hinged
from .mjcf.document import Mjcf, read_mjcf
from .urdf import Urdf, read_urdf
from .xml_file import Element, parse_xml, read_xml, write_xml


@dataclass(frozen=True)
class ModelFile:
    """A model file that furiko has accepted.

    ``language``: ``mjcf`` or ``urdf``; ``mechanism``: the planar tree that it describes; ``bodies`` and ``plane``: the
    same in space. ``text``: the document that engines are given: the file's own elements with included files put in
    place, without those that cannot matter (meshes, sensors, cameras). ``notes``: sentences on what was left out or
    assumed. ``timestep`` [s] and ``integrator``: MJCF's options.

    By the name of a body: ``from_geoms``: bodies whose inertial is that of their geoms; ``geoms``: the inertial that
    its geoms have together; ``tensors``: its inertial before its rotation, and that rotation (3, 3). ``continuous``:
    URDF joints without limits, which have two coordinates in Pinocchio.
    """

    path: str
    language: str
    mechanism: Mechanism
    bodies: tuple[Body, ...]
    plane: Plane
    text: str
    notes: tuple[str, ...] = ()
    integrator: str = ""
    timestep: float = 0.0
    from_geoms: tuple[str, ...] = ()
    geoms: Mapping[str, Inertial] = field(default_factory=dict)
    tensors: Mapping[str, tuple[Inertial, Array]] = field(default_factory=dict)
    continuous: tuple[str, ...] = ()


def read_model(path: str | Path) -> ModelFile:
    """Read an MJCF or URDF file. Raises :class:`InvalidInput` naming the file, the element, and what would be right."""
    where = Path(path)
    return _understand(read_xml(where), where)


def model_from_text(text: str, name: str = "model") -> ModelFile:
    """Read an MJCF or URDF text, called ``name`` in messages; includes are looked for in the current folder."""
    return _understand(parse_xml(text.encode(), name), Path(name))


def _understand(root: Element, path: Path) -> ModelFile:
    if root.tag == "mujoco":
        file: Mjcf | Urdf = read_mjcf(root, path)
    elif root.tag == "robot":
        file = read_urdf(root)
    else:
        raise InvalidInput(f"{path}: its root is <{root.tag[:40]}>; <mujoco> (MJCF) or <robot> (URDF) is needed")
    try:
        bodies = hinged(file.bodies) if isinstance(file, Mjcf) else file.bodies
        mechanism = planar_mechanism(bodies, file.gravity)
    except InvalidInput as error:
        words = str(error)
        raise InvalidInput(words if words.startswith(str(path)) else f"{path}: {words}") from None
    down, across = np.array(mechanism.down), np.array(mechanism.across)
    common = {
        "path": str(path),
        "mechanism": mechanism,
        "bodies": tuple(bodies),
        "plane": Plane(down, across, np.cross(down, across)),
        "text": write_xml(file.root),
        "notes": tuple(file.notes),
        "tensors": file.tensors,
    }
    if isinstance(file, Mjcf):
        return ModelFile(
            **common,  # type: ignore[arg-type]
            language="mjcf",
            integrator=file.integrator,
            timestep=file.timestep,
            from_geoms=tuple(file.from_geoms),
            geoms=file.geoms,
        )
    return ModelFile(**common, language="urdf", continuous=tuple(file.continuous))  # type: ignore[arg-type]
