"""The inertial of an MJCF body: given by ``<inertial>``, or that of its geoms, within the compiler's bounds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...errors import InvalidInput
from ...spatial import ZERO_INERTIAL, Inertial, symmetric, to_quaternion
from ...spatial_mechanism import RigidBody
from ..attributes import Array, not_negative, numbers
from ..placement import Placement
from ..xml_file import Element
from .attach import Source
from .defaults import REFERENCES
from .frames import ROTATIONS, placement_of
from .geoms import FROM_FILES, geom_inertial, geom_placement, weighs
from .notes import Notes
from .options import Compiler

POINT_MASS_BOUND = 1e-14  # kg m²; a boundinertia up to here only makes MuJoCo's compiler accept a point mass
IMPOSSIBLE = 1e-9  # of the largest moment: by so much the sum of the others may fall short of it in rounding


@dataclass(frozen=True)
class PlacedGeom:
    """A geom as it is written, the same with its defaults (``full``), and where its ``frame`` is in the body.

    ``holder``: the body or frame that it is a child of; ``source``: how its document is read.
    """

    given: Element
    full: Element
    frame: Placement
    holder: Element
    source: Source

    @property
    def from_file(self) -> bool:
        """Whether its shape is that of an asset."""
        return self.full.get("type", "sphere") in FROM_FILES or bool(self.full.get("mesh"))


@dataclass
class Inertials:
    """Reads the inertials of a document's bodies, and keeps how each came about, by the body's name.

    ``from_geoms``: bodies whose inertial is that of their geoms; ``geoms``: the inertial that each body's geoms have
    together; ``tensors``: a given inertial before its rotation, and that rotation (3, 3); ``axes``: principal axes that
    the document writes, columns (3, 3) in the body's frame; ``meshes``: the largest moments [kg m²] of the meshes that
    it is weighed by, added up.
    """

    notes: Notes
    from_geoms: list[str] = field(default_factory=list)
    geoms: dict[str, Inertial] = field(default_factory=dict)
    tensors: dict[str, tuple[Inertial, Array]] = field(default_factory=dict)
    axes: dict[str, Array] = field(default_factory=dict)
    meshes: dict[str, float] = field(default_factory=dict)

    def of_body(
        self,
        name: str,
        position: Array,
        compiler: Compiler,
        given: tuple[Element, Placement, Source] | None,
        geoms: Sequence[PlacedGeom],
    ) -> Inertial:
        """The inertial of the body ``name`` at ``position`` in its own frame. Raises :class:`InvalidInput`.

        ``compiler``: that of the body's document; its geoms and ``given``, with the frame that it is in and how it is
        read, may be of others.
        """
        from_geoms = compiler.from_geoms == "true" or (compiler.from_geoms == "auto" and given is None)
        of_geoms = self._of_geoms(name, geoms, from_geoms, compiler.groups)
        if of_geoms is not None:
            self.geoms[name] = of_geoms
        if from_geoms:
            self.from_geoms.append(name)
            found = of_geoms or self._weightless(name, position, compiler)
        else:
            found = self._weightless(name, position, compiler) if given is None else self._given(*given, name)
        if not found.tensor.any() and 0 < compiler.least_inertia <= POINT_MASS_BOUND:
            self.notes.add(
                f"boundinertia={compiler.least_inertia:g} is ignored: it is there to let MuJoCo compile a point mass"
            )
            return replace(found, mass=max(found.mass, compiler.least_mass))
        if compiler.rules.bound_inertia_on_given_axes:
            return found  # such an engine bounds what <inertial> gives, and has done so
        bounded = _bounded(found, compiler)
        if _impossible(bounded.tensor):
            self.notes.add(
                f"body {name!r}: the largest of its moments of inertia exceeds the sum of the others, which no body's "
                "does; MuJoCo refuses it unless balanceinertia is set"
            )
        return bounded

    def _weightless(self, name: str, position: Array, compiler: Compiler) -> Inertial:
        if compiler.least_mass > 0 and position.any():
            self.notes.add(
                f"body {name!r} weighs nothing; the mass that boundmass gives it is not at its own origin in MuJoCo, "
                "but at the body's pos once more, seen from there"
            )
            return Inertial(0.0, position, np.zeros((3, 3)))
        return ZERO_INERTIAL

    def _given(self, given: Element, frame: Placement, source: Source, name: str) -> Inertial:
        compiler = source.compiler
        if "pos" not in given.attributes or "mass" not in given.attributes:
            raise given.wrong("pos and mass are needed")
        pose = placement_of(given, compiler).pose
        mass = not_negative(given, "mass")
        if "fullinertia" in given.attributes:
            tensor = symmetric(*numbers(given, "fullinertia", 6))
            if any(rotation in given.attributes for rotation in ROTATIONS):
                raise given.wrong("fullinertia and an orientation: only one of them can be given")
            if np.linalg.eigvalsh(tensor)[0] < -1e-12 * abs(np.trace(tensor)) and not compiler.least_inertia:
                raise given.wrong("fullinertia: no body has an inertia with a negative principal moment")
        else:
            unit = compiler.rules.inertial_without_inertia_is_unit
            moments = numbers(given, "diaginertia", 3, (1.0, 1.0, 1.0) if unit else (0.0, 0.0, 0.0))
            if (moments < 0).any():
                raise given.wrong(f"diaginertia={given.get('diaginertia')!r}: must not be negative")
            tensor = np.diag(moments)
            self.axes[name] = frame.pose.rotation @ pose.rotation
        if compiler.rules.bound_inertia_on_given_axes:
            mass = max(mass, compiler.least_mass)
            tensor = tensor + np.diag(np.maximum(compiler.least_inertia - np.diag(tensor), 0.0))
        self.tensors[name] = (Inertial(mass, pose.translation, tensor), pose.rotation)
        return Inertial(mass, np.zeros(3), tensor).transformed(pose).transformed(frame.pose)

    def _of_geoms(
        self, name: str, geoms: Sequence[PlacedGeom], needed: bool, groups: tuple[int, int]
    ) -> Inertial | None:
        """The inertial of all the body's geoms together; None where they have no mass.

        Shapes in other files are loaded only where the inertial is ``needed``.
        """
        total: Inertial | None = None
        weighed: list[PlacedGeom] = []
        low, high = groups
        for geom in geoms:
            if geom.from_file and not needed:
                continue
            if low <= _group(geom.full) <= high:
                part = self._of_geom(geom, needed)
                if part is not None:
                    weighed.append(geom)
                    part = part.transformed(geom.frame.pose)
                    total = part if total is None else total + part
                    if geom.full.get("mesh"):
                        self.meshes[name] = self.meshes.get(name, 0.0) + float(np.linalg.norm(part.tensor, 2))
        if needed:
            self._keep_axes(name, weighed)
        return total

    def _keep_axes(self, name: str, weighed: Sequence[PlacedGeom]) -> None:
        """Those of the only geom that weighs, unless a mesh says them; none where several do."""
        self.axes.pop(name, None)
        if len(weighed) == 1 and not weighed[0].from_file:
            (geom,) = weighed
            placement = geom_placement(geom.full, geom.source.compiler, geom.source.assets)
            self.axes[name] = geom.frame.pose.rotation @ placement.pose.rotation

    def _of_geom(self, geom: PlacedGeom, needed: bool) -> Inertial | None:
        try:
            part = geom_inertial(geom.full, geom.source.compiler, geom.source.assets)
        except InvalidInput:
            if needed:
                raise
            return None
        if part is not None and geom.from_file and weighs(geom.full):
            _put_box(geom, part)
        return part


def scaled_to_total_mass(bodies: Sequence[RigidBody], compiler: Compiler) -> tuple[RigidBody, ...]:
    """The bodies with the masses and inertias that ``settotalmass`` gives them."""
    total = sum(body.inertial.mass for body in bodies)
    if compiler.total_mass <= 0 or total <= 0:
        return tuple(bodies)
    scale = compiler.total_mass / total
    return tuple(
        replace(
            b,
            inertial=Inertial(b.inertial.mass * scale, b.inertial.centre, b.inertial.tensor * scale),
            meshes=b.meshes * scale,
        )
        for b in bodies
    )


def _group(full: Element) -> int:
    return int(numbers(full, "group", 1, (0.0,))[0])


def _put_box(geom: PlacedGeom, part: Inertial) -> None:
    """Write a box of the same inertial in the place of a geom that is loaded from a file.

    A uniform box has the moments m/3·(b² + c²) …: half sides √(3/2·(sum of the moments − 2·its own)/m).
    """
    moments, turn = np.linalg.eigh(part.tensor)
    half = np.sqrt(np.maximum(1.5 * (moments.sum() - 2 * moments) / part.mass, 1e-18))
    if np.linalg.det(turn) < 0:
        turn[:, 0] *= -1
    written = {"size": half, "pos": part.centre, "quat": to_quaternion(turn), "mass": np.array([part.mass])}
    attributes = {k: v for k, v in geom.given.attributes.items() if k not in (*ROTATIONS, *REFERENCES, "density")}
    attributes |= {name: " ".join(repr(float(v)) for v in values) for name, values in written.items()}
    box = Element("geom", attributes | {"type": "box"}, geom.given.file, geom.given.line)
    at = next(i for i, child in enumerate(geom.holder.children) if child is geom.given)
    geom.holder.children[at] = box


def _bounded(inertial: Inertial, compiler: Compiler) -> Inertial:
    """The inertial within the compiler's bounds, which act on the principal moments."""
    mass = max(inertial.mass, compiler.least_mass)
    tensor = inertial.tensor
    if compiler.least_inertia > 0 or compiler.balance:
        moments, turn = np.linalg.eigh(tensor)
        raised = np.maximum(moments, compiler.least_inertia)
        if compiler.balance and raised[0] + raised[1] < raised[2] * (1 - IMPOSSIBLE):
            raised = np.full(3, raised.mean())
        if (raised != moments).any():
            isotropic = (raised == raised[0]).all()
            tensor = np.diag(raised) if isotropic else (turn * raised) @ turn.T
    return inertial if mass == inertial.mass and tensor is inertial.tensor else Inertial(mass, inertial.centre, tensor)


def _impossible(tensor: Array) -> bool:
    if not tensor.any():
        return False
    moments = np.linalg.eigvalsh(tensor)
    return bool(moments[0] + moments[1] < moments[2] * (1 - IMPOSSIBLE))
