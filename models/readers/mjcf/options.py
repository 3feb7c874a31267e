"""MJCF's ``<compiler>`` and ``<option>``: how the rest of the document is read, gravity, and disabled features."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from ..attributes import Array, not_negative, number, numbers, word, yes
from ..rules import MjcfRules
from ..xml_file import Element


@dataclass
class Compiler:
    """The attributes of ``<compiler>`` that change how the rest is read, with MuJoCo's defaults.

    ``degrees``: angles are in degrees; ``sequence``: the axes of ``euler``; ``autolimits``: a range alone makes a
    joint limited; ``from_geoms``: ``inertiafromgeom``; ``groups``: first and last group of geoms that have mass;
    ``least_mass`` [kg], ``least_inertia`` [kg m²]: lower bounds; ``balance``: ``balanceinertia``; ``total_mass`` [kg]:
    the mass of all bodies together, if positive; ``mesh_folder``, ``strip_path``: where meshes are; ``align_free``:
    ``alignfree``; ``fuses``: ``fusestatic``; ``fit_box``: ``fitaabb``; ``merges``: options of attached documents are
    merged (``conflict``). ``rules``: mistakes that are made on purpose.
    """

    rules: MjcfRules = field(default_factory=MjcfRules)
    degrees: bool = True
    sequence: str = "xyz"
    autolimits: bool = True
    from_geoms: str = "auto"
    groups: tuple[int, int] = (0, 5)
    least_mass: float = 0.0
    least_inertia: float = 0.0
    balance: bool = False
    total_mass: float = -1.0
    mesh_folder: str = ""
    strip_path: bool = False
    align_free: bool = False
    fuses: bool = False
    fit_box: bool = False
    merges: bool = False

    def angle(self, value: float) -> float:
        """An angle of the document in radians."""
        return math.radians(value) if self.degrees else value

    def read(self, element: Element) -> None:
        """Take over a ``<compiler>``; of several, later ones win. Raises :class:`InvalidInput`."""
        self.degrees = word(element, "angle", ("degree", "radian"), "degree" if self.degrees else "radian") == "degree"
        self.sequence = element.get("eulerseq", self.sequence)
        if len(self.sequence) != 3 or set(self.sequence) - set("xyzXYZ"):
            raise element.wrong(f"eulerseq={self.sequence[:20]!r}: three letters out of xyzXYZ needed")
        if element.get("coordinate", "local") != "local":
            raise element.wrong(
                "coordinate: only 'local' is supported, as in MuJoCo itself since 2.3.4; load the file in MuJoCo "
                "2.3.3 or older, and save it"
            )
        self.autolimits = yes(element, "autolimits", self.autolimits)
        self.from_geoms = word(element, "inertiafromgeom", ("true", "false", "auto"), self.from_geoms)
        low, high = numbers(element, "inertiagrouprange", 2, self.groups)
        self.groups = int(low), int(high)
        self.least_mass = not_negative(element, "boundmass", self.least_mass)
        self.least_inertia = not_negative(element, "boundinertia", self.least_inertia)
        self.balance = yes(element, "balanceinertia", self.balance)
        self.total_mass = number(element, "settotalmass", self.total_mass)
        self.mesh_folder = element.get("meshdir", element.get("assetdir", self.mesh_folder))
        self.strip_path = yes(element, "strippath", self.strip_path)
        self.align_free = yes(element, "alignfree", self.align_free)
        self.fuses = yes(element, "fusestatic", self.fuses)
        self.fit_box = yes(element, "fitaabb", self.fit_box)
        self.merges = element.get("conflict", "merge" if self.merges else "warning") == "merge"
        for name in ("meshdir", "texturedir", "assetdir", "strippath"):
            element.attributes.pop(name, None)  # nothing is loaded from there
        element.children.clear()
        self._make_mistakes()

    def _make_mistakes(self) -> None:
        rules = self.rules
        if rules.upper_euler_as_lower:
            self.sequence = self.sequence.lower()
        if rules.inertia_group_ignored:
            self.groups = (-(2**31), 2**31)
        if rules.balance_inertia_ignored:
            self.balance = False
        if rules.total_mass_ignored:
            self.total_mass = -1.0
        if rules.bound_ignored:
            self.least_mass = self.least_inertia = 0.0


@dataclass
class Options:
    """``<option>``: ``gravity`` (3,) [m/s²] in the world, also where a flag disables it; ``timestep`` [s]; the features
    that ``<flag>`` disables; ``fluid``: whether there is one."""

    gravity: Array = field(default_factory=lambda: np.array([0.0, 0.0, -9.81]))
    timestep: float = 0.002
    integrator: str = "Euler"
    disabled: set[str] = field(default_factory=set)
    fluid: bool = False

    def enabled(self, value: float, *flags: str) -> float:
        """``value``, or zero where one of these flags is disabled."""
        return 0.0 if self.disabled & set(flags) else value

    @property
    def acting_gravity(self) -> Array:
        """Gravity (3,) [m/s²]; zero where it is disabled."""
        return np.zeros(3) if "gravity" in self.disabled else self.gravity


def read_options(elements: Iterable[Element], rules: MjcfRules) -> Options:
    """All ``<option>`` of a document; later ones win. The fluid is taken out. Raises :class:`InvalidInput`."""
    options = Options()
    density = viscosity = 0.0
    for element in elements:
        options.gravity = numbers(element, "gravity", 3, tuple(options.gravity))
        options.timestep = number(element, "timestep", options.timestep)
        options.integrator = element.get("integrator", options.integrator)
        density = not_negative(element, "density", density)
        viscosity = not_negative(element, "viscosity", viscosity)
        for name in ("density", "viscosity", "wind"):
            element.attributes.pop(name, None)
        for flag in element.all("flag"):
            word(flag, "gravity", ("enable", "disable"), "enable")
            options.disabled |= {name for name, value in flag.attributes.items() if value == "disable"}
            options.disabled -= {name for name, value in flag.attributes.items() if value == "enable"}
    options.fluid = density > 0 or viscosity > 0
    if rules.gravity_not_read:
        options.gravity = np.array([0.0, 0.0, -9.81])
    if rules.gravity_not_read or rules.gravity_flag_ignored:
        options.disabled.discard("gravity")
    return options
