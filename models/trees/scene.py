"""A scene of an open mechanism; :mod:`.tables` reads one."""

from __future__ import annotations

from dataclasses import dataclass

from .own import OwnEquations
from .system import TreeSystem, Vector

NAMED_STATES = ("reference", "small", "whirling")
RANDOM_STATES = 200


@dataclass(frozen=True)
class TreeScene:
    """A scene of an open mechanism, of the catalogue or of a user's file.

    ``q`` (nq,), ``v`` (nv,): the state that a trajectory starts from, or None where the file gives none; ``duration``
    [s], 0 for no trajectory; ``random``, ``named``: further states (:func:`furiko.models.trees.states.tree_states`).
    ``model``: the path of the model file that the mechanism was read from, empty where the scene file has it itself;
    ``own``: the user's own equations of it.
    """

    name: str
    system: TreeSystem
    q: Vector | None = None
    v: Vector | None = None
    duration: float = 0.0
    random: int = RANDOM_STATES
    named: tuple[str, ...] = NAMED_STATES
    tags: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    description: str = ""
    model: str = ""
    own: OwnEquations | None = None

    @property
    def starts(self) -> bool:
        """Whether the file gives a state."""
        return self.q is not None
