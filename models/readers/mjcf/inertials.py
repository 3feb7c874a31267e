"""The inertial of an MJCF body: given by ``<inertial>``, or that of its geoms, within the compiler's bounds."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ...errors import InvalidInput
from ...projection import Body
from ...spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose, symmetric
from ..attributes import Array, not_negative, number, numbers
from ..xml_file import Element
from .defaults import Defaults, strip
from .frames import ROTATIONS, pose_of
from .geoms import geom_inertial
from .options import Compiler

POINT_MASS_BOUND = 1e-14  # kg m²; a boundinertia up to here only makes MuJoCo's compiler accept a point mass


@dataclass
class Inertials:
    """Reads the inertials of a document's bodies, and keeps how each came about, by the body's name.

    ``from_geoms``: bodies whose inertial is that of their geoms; ``geoms``: the inertial that each body's geoms have
    together; ``tensors``: a given inertial before its rotation, and that rotation (3, 3); ``notes``: sentences on what
    was left out.
    """

    compiler: Compiler
    defaults: Defaults
    from_geoms: list[str] = field(default_factory=list)
    geoms: dict[str, Inertial] = field(default_factory=dict)
    tensors: dict[str, tuple[Inertial, Array]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def of_body(self, element: Element, name: str, childclass: str) -> Inertial:
        """The inertial of the body ``element`` in its own frame. Raises :class:`InvalidInput`."""
        compiler = self.compiler
        given = element.first("inertial")
        from_geoms = compiler.from_geoms == "true" or (compiler.from_geoms == "auto" and given is None)
        of_geoms = self._of_geoms(element, childclass, from_geoms)
        if of_geoms is not None:
            self.geoms[name] = of_geoms
        if from_geoms:
            self.from_geoms.append(name)
            found = of_geoms or ZERO_INERTIAL
        else:
            found = self._given(given, name) if given is not None else ZERO_INERTIAL
        if not found.tensor.any() and 0 < compiler.least_inertia <= POINT_MASS_BOUND:
            self._note(
                f"boundinertia={compiler.least_inertia:g} is ignored: it is there to let MuJoCo compile a point mass"
            )
            return Inertial(max(found.mass, compiler.least_mass), found.centre, found.tensor)
        return _bounded(found, compiler)

    def _given(self, given: Element, name: str) -> Inertial:
        if "pos" not in given.attributes or "mass" not in given.attributes:
            raise given.wrong("pos and mass are needed")
        pose = pose_of(given, self.compiler)
        mass = not_negative(given, "mass")
        if "fullinertia" in given.attributes:
            tensor = symmetric(*numbers(given, "fullinertia", 6))
            if any(rotation in given.attributes for rotation in ROTATIONS):
                raise given.wrong("fullinertia and an orientation: only one of them can be given")
            if np.linalg.eigvalsh(tensor)[0] < -1e-12 * abs(np.trace(tensor)):
                raise given.wrong("fullinertia: no body has an inertia with a negative principal moment")
        else:
            moments = numbers(given, "diaginertia", 3, (0.0, 0.0, 0.0))
            if (moments < 0).any():
                raise given.wrong(f"diaginertia={given.get('diaginertia')!r}: must not be negative")
            tensor = np.diag(moments)
        unrotated = Inertial(mass, np.zeros(3), tensor)
        self.tensors[name] = (Inertial(mass, pose.translation, tensor), pose.rotation)
        return unrotated.transformed(pose)

    def _of_geoms(self, element: Element, childclass: str, needed: bool) -> Inertial | None:
        """The inertial of all the body's geoms together; None where they have no mass, or a shape that is not loaded
        while none is ``needed``."""
        total: Inertial | None = None
        low, high = self.compiler.groups
        pending: list[tuple[Element, Pose, str]] = [(element, IDENTITY, childclass)]
        while pending:
            at, frame, inherited = pending.pop()
            pending.extend(
                (nested, frame @ pose_of(nested, self.compiler), nested.get("childclass", inherited))
                for nested in at.all("frame")
            )
            for geom in list(at.all("geom")):
                full = self.defaults.applied(geom, inherited)
                strip(geom)
                if low <= number(full, "group") <= high:
                    part = self._of_geom(full, needed)
                    if part is not None:
                        part = part.transformed(frame)
                        total = part if total is None else total + part
                if full.get("type", "sphere") in ("mesh", "sdf", "hfield"):
                    remove(at, geom)
                    self._note("geoms that are meshes are left out: they are not loaded, and do not collide")
        return total

    def _of_geom(self, geom: Element, needed: bool) -> Inertial | None:
        try:
            return geom_inertial(geom, pose_of(geom, self.compiler))
        except InvalidInput:
            if needed:
                raise
            return None

    def _note(self, says: str) -> None:
        if says not in self.notes:
            self.notes.append(says)


def scaled_to_total_mass(bodies: list[Body], compiler: Compiler) -> list[Body]:
    """The bodies with the masses and inertias that ``settotalmass`` gives them."""
    total = sum(body.inertial.mass for body in bodies)
    if compiler.total_mass <= 0 or total <= 0:
        return bodies
    scale = compiler.total_mass / total
    return [
        replace(b, inertial=Inertial(b.inertial.mass * scale, b.inertial.centre, b.inertial.tensor * scale))
        for b in bodies
    ]


def remove(parent: Element, child: Element) -> None:
    """Take an element out of its parent, or out of one of the parent's frames."""
    for holder in [parent, *parent.all("frame")]:
        holder.children = [c for c in holder.children if c is not child]


def _bounded(inertial: Inertial, compiler: Compiler) -> Inertial:
    """The inertial within the compiler's bounds, which act on the principal moments."""
    mass = max(inertial.mass, compiler.least_mass)
    tensor = inertial.tensor
    if compiler.least_inertia > 0 or compiler.balance:
        moments, turn = np.linalg.eigh(tensor)
        raised = np.maximum(moments, compiler.least_inertia)
        if compiler.balance and raised[0] + raised[1] < raised[2]:
            raised = np.full(3, raised.mean())
        if (raised != moments).any():
            isotropic = (raised == raised[0]).all()
            tensor = np.diag(raised) if isotropic else (turn * raised) @ turn.T
    return inertial if mass == inertial.mass and tensor is inertial.tensor else Inertial(mass, inertial.centre, tensor)
