"""MuJoCo's extension of URDF, ``<mujoco>``: compiler options that change what a file says, honoured by MuJoCo alone."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...spatial import Inertial
from ..attributes import Array, not_negative, number, numbers, word, yes
from ..xml_file import Element
from .notes import Notes

# What bears on the dynamics, and what does not; the value after which nothing changes.
ACTS = {
    "inertiafromgeom": "auto",
    "inertiagrouprange": "0 5",
    "settotalmass": "-1",
    "balanceinertia": "false",
    "boundmass": "0",
    "boundinertia": "0",
    "alignfree": "false",
}
WHATEVER = ("gravity", "timestep", "integrator")


@dataclass(frozen=True)
class Extension:
    """The extension's values: without one, those with which MuJoCo reads URDF.

    ``from_geoms``: ``inertiafromgeom``; ``groups``: first and last group of geoms that weigh (collision geometry is of
    group 0); ``least_mass`` [kg], ``least_inertia`` [kg m²]; ``balance``; ``total_mass`` [kg], of all that moves, if
    positive; ``fuses``: links on fixed joints are made one with those above; ``align_free``: the frame of a free link
    that carries none is its inertial's; ``gravity`` (3,) [m/s²]; ``timestep`` [s].
    """

    from_geoms: str = "auto"
    groups: tuple[int, int] = (0, 5)
    least_mass: float = 0.0
    least_inertia: float = 0.0
    balance: bool = False
    total_mass: float = -1.0
    fuses: bool = True
    align_free: bool = False
    gravity: tuple[float, float, float] = (0.0, 0.0, -9.81)
    timestep: float = 0.0
    integrator: str = ""

    def bounded(self, inertial: Inertial) -> Inertial:
        """The inertial within the bounds, which act on its principal moments."""
        mass = max(inertial.mass, self.least_mass) if self.least_mass else inertial.mass
        tensor = inertial.tensor
        if self.least_inertia > 0 or self.balance:
            moments, turn = np.linalg.eigh(tensor)
            raised = np.maximum(moments, self.least_inertia)
            if self.balance and raised[0] + raised[1] < raised[2]:
                raised = np.full(3, raised.mean())
            if (raised != moments).any():
                isotropic = (raised == raised[0]).all()
                tensor = np.diag(raised) if isotropic else np.asarray((turn * raised) @ turn.T)
        return Inertial(mass, inertial.centre, tensor)


def read_extension(root: Element) -> Extension:
    """The values that the document's ``<mujoco>`` gives. Raises :class:`InvalidInput`."""
    found = Extension()
    for extension in root.all("mujoco"):
        for compiler in extension.all("compiler"):
            low, high = numbers(compiler, "inertiagrouprange", 2, found.groups)
            found = replace(
                found,
                from_geoms=word(compiler, "inertiafromgeom", ("true", "false", "auto"), found.from_geoms),
                groups=(int(low), int(high)),
                least_mass=not_negative(compiler, "boundmass", found.least_mass),
                least_inertia=not_negative(compiler, "boundinertia", found.least_inertia),
                balance=yes(compiler, "balanceinertia", found.balance),
                total_mass=number(compiler, "settotalmass", found.total_mass),
                fuses=yes(compiler, "fusestatic", found.fuses),
                align_free=yes(compiler, "alignfree", found.align_free),
            )
        for option in extension.all("option"):
            x, y, z = map(float, numbers(option, "gravity", 3, found.gravity))
            if any(flag.get("gravity") == "disable" for flag in option.all("flag")):
                x = y = z = 0.0
            found = replace(
                found,
                gravity=(x, y, z),
                timestep=number(option, "timestep", found.timestep),
                integrator=option.get("integrator", found.integrator),
            )
    return found


def tell(root: Element, notes: Notes) -> None:
    """Say what the extension changes, which URDF's own readers do not know of."""
    acting: list[str] = []
    for extension in root.all("mujoco"):
        for element in extension.all("compiler", "option"):
            for name, value in element.attributes.items():
                if name in WHATEVER or value != ACTS.get(name, value):
                    acting.append(f'{name}="{value[:40]}"')
    if acting:
        notes.add(
            f"{', '.join(acting)[:200]} in <mujoco> is honoured by MuJoCo alone; URDF does not know it, so it is not"
            " part of what the file says",
            root.first("mujoco"),
        )


def gravity_of(extension: Extension) -> Array:
    """Gravity (3,) [m/s²] as an array."""
    return np.array(extension.gravity)
