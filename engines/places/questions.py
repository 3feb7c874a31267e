"""What an engine in a place of its own can be asked, as data: the arrays that go, and those that come.

The names are those of :mod:`furiko.engines.protocol`; both ends of the protocol read this table.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Question:
    """``takes``: arrays; ``words``: further arguments by name; ``gives``: arrays; ``value``: a number besides them."""

    takes: tuple[str, ...]
    gives: tuple[str, ...]
    words: tuple[str, ...] = ()
    value: bool = False


_STATE, _RUN = ("theta", "omega"), ("integrator", "step", "steps")
FIELDS = ("hinges", "centres", "masses", "inertias", "gravity", "armature", "damping")

PLANAR: dict[str, Question] = {
    "accelerations": Question(_STATE, ("accelerations",)),
    "fields": Question((), FIELDS),
    "inverse_dynamics": Question((*_STATE, "alpha"), ("forces",), ("gravity",)),
    "joint_forces": Question((*_STATE, "alpha"), ("forces",)),
    "derivatives": Question(_STATE, ("of_positions", "of_rates")),
    "inverse_mass": Question(("theta",), ("inverse_mass",)),
    "energy": Question(_STATE, ("energy",)),
    "trajectory": Question(_STATE, _STATE, _RUN),
    "path": Question(_STATE, _STATE, _RUN),
    "adaptive": Question(_STATE, _STATE, ("scheme", "duration", "tolerance")),
    "gap": Question((), (), value=True),
}
# Of a mechanism in space. "compiled": what an engine holds of a file, as a mechanism; "bind": it is asked in a
# mechanism's coordinates from then on. Both are of a model that was made from a file.
SPATIAL: dict[str, Question] = {
    "accelerations": Question(("q", "v"), ("accelerations",)),
    "driven_accelerations": Question(("q", "v", "torque"), ("accelerations",)),
    "mass_matrix": Question(("q",), ("mass_matrix",)),
    "bias": Question(("q", "v"), ("forces",)),
    "passive": Question(("q", "v"), ("forces",)),
    "derivatives": Question(("q", "v"), ("of_positions", "of_rates")),
    "inverse_mass": Question(("q",), ("inverse_mass",)),
    "joint_forces": Question(("q", "v", "a"), ("forces",)),
    "energy": Question(("q", "v"), ("energy",)),
    "trajectory": Question(("q", "v"), ("q", "v"), _RUN),
}
