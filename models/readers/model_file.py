"""A user's model file, MJCF or URDF, as furiko understands it: validated here before any engine reads it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InvalidInput
from ..mechanism import Mechanism
from ..projection import Plane, planar_mechanism
from ..spatial import Inertial
from ..spatial_mechanism import SpatialMechanism
from .attributes import Array
from .mjcf.document import Mjcf, read_mjcf
from .rules import AS_DOCUMENTED, Rules
from .urdf.document import Urdf, read_urdf
from .xml_file import Element, parse_xml, read_xml, write_xml


@dataclass(frozen=True, eq=False)
class ModelFile:
    """A model file that furiko has accepted.

    ``language``: ``mjcf`` or ``urdf``; ``spatial``: the mechanism that it describes, with every body of the file, also
    those that are fixed, in the document's order and depth first; bodies and joints without a name are called
    ``furiko_body_1``, ``furiko_joint_1`` and so on. ``planar``: the same as a planar tree of hinges, or None, and
    ``not_planar`` says why. ``rules``: how it was read.

    ``text``: the document that engines are given for the planar tree: the file's own elements with included files put
    in place, without those that cannot matter (meshes, sensors, cameras). ``notes``: sentences on what was passed over
    or assumed. ``without``: short names of what acts in the file besides bodies and joints. ``servos``: (actuator,
    joint) that pull without being told to. ``timestep`` [s] and ``integrator``: MJCF's options.

    By the name of a body: ``from_geoms``: bodies whose inertial is that of their geoms; ``geoms``: the inertial that
    its geoms have together; ``tensors``: its inertial before its rotation, and that rotation (3, 3). ``continuous``:
    URDF joints without limits, which have two coordinates in Pinocchio. ``own_text``: the text itself where it is in no
    file.
    """

    path: str
    language: str
    spatial: SpatialMechanism
    planar: Mechanism | None
    not_planar: str
    text: str
    notes: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    servos: tuple[tuple[str, str], ...] = ()
    rules: Rules = AS_DOCUMENTED
    integrator: str = ""
    timestep: float = 0.0
    from_geoms: tuple[str, ...] = ()
    geoms: Mapping[str, Inertial] = field(default_factory=dict)
    tensors: Mapping[str, tuple[Inertial, Array]] = field(default_factory=dict)
    continuous: tuple[str, ...] = ()
    own_text: str = ""

    @property
    def mechanism(self) -> Mechanism:
        """The planar tree of hinges. Raises :class:`InvalidInput` with the reason where the file is none."""
        if self.planar is None:
            raise InvalidInput(self.not_planar)
        return self.planar

    @property
    def plane(self) -> Plane:
        """The plane of a planar tree. Raises :class:`InvalidInput` where the file is none."""
        down, across = np.array(self.mechanism.down), np.array(self.mechanism.across)
        return Plane(down, across, np.cross(down, across))


def read_model(path: str | Path, rules: Rules = AS_DOCUMENTED, meshes: Sequence[Path] = ()) -> ModelFile:
    """Read an MJCF or URDF file as its format's documentation has it, or with the mistakes of ``rules``.

    Files that it names are looked for in its own folder and below, and in the folders ``meshes``. Raises
    :class:`InvalidInput` naming the file, the element, and what would be right.
    """
    where = Path(path)
    return _understand(read_xml(where), where, rules, meshes)


def model_from_text(text: str, name: str = "model", rules: Rules = AS_DOCUMENTED) -> ModelFile:
    """Read an MJCF or URDF text, called ``name`` in messages; includes are looked for in the current folder."""
    file = _understand(parse_xml(text.encode(), name), Path(name), rules, ())
    return replace(file, own_text=text)


def _understand(root: Element, path: Path, rules: Rules, meshes: Sequence[Path]) -> ModelFile:
    if root.tag == "mujoco":
        mjcf = read_mjcf(root, path, rules.mjcf, meshes)
        return _model("mjcf", mjcf, path, rules, _of_mjcf(mjcf))
    if root.tag == "robot":
        urdf = read_urdf(root, path, rules.urdf, meshes)
        return _model("urdf", urdf, path, rules, {"continuous": tuple(urdf.continuous)})
    raise InvalidInput(f"{path}: its root is <{root.tag[:40]}>; <mujoco> (MJCF) or <robot> (URDF) is needed")


def _of_mjcf(file: Mjcf) -> dict[str, Any]:
    return {"from_geoms": tuple(file.from_geoms), "geoms": file.geoms, "servos": tuple(file.servos)}


def _model(language: str, file: Mjcf | Urdf, path: Path, rules: Rules, more: Mapping[str, Any]) -> ModelFile:
    planar, not_planar = None, ""
    try:
        spatial = SpatialMechanism(tuple(file.bodies), file.gravity)
    except InvalidInput as error:
        raise InvalidInput(_with_path(path, error)) from None
    try:
        if isinstance(file, Mjcf) and file.attaches:
            raise InvalidInput("parts of other documents are attached: engines get the file itself alone")
        planar = planar_mechanism(spatial)
    except InvalidInput as error:
        not_planar = _with_path(path, error)
    return ModelFile(
        path=str(path),
        language=language,
        spatial=spatial,
        planar=planar,
        not_planar=not_planar,
        text=write_xml(file.root),
        notes=tuple(file.notes),
        without=tuple(file.without),
        rules=rules,
        integrator=file.integrator,
        timestep=file.timestep,
        tensors=file.tensors,
        **more,
    )


def _with_path(path: Path, error: InvalidInput) -> str:
    words = str(error)
    return words if words.startswith(str(path)) else f"{path}: {words}"
