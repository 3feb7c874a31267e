"""A check: one record, from which the plan, the workers, the command line and the reports know it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from ..engines import EngineInfo, Quantity, TreeQuantity
from ..models import AnyScene, TreeScene

if TYPE_CHECKING:
    from ..records.check import Result
    from .cell import Cell
    from .trees.cell import TreeCell


def always(_scene: AnyScene, _info: EngineInfo) -> str:
    """For a check that every scene and engine has."""
    return ""


@dataclass(frozen=True)
class OfTrees:
    """The same check of an open mechanism: its file in ``checks/trees/``, and what it needs of the engine."""

    module: str
    needs: TreeQuantity


@dataclass(frozen=True)
class Check:
    """A comparison of one quantity, for one scene and one engine.

    ``name``: as results carry it in ``comparison``; ``needs``: what the engine must offer; ``module``: its file in
    ``checks/comparisons/``; ``meaning``: what it tells a reader; ``bound``: where its limit comes from;
    ``why_not``: the reason why it is not run on a scene and engine, an empty string where it is;
    ``long``: takes seconds rather than milliseconds, hence in a full run only; ``explained``: a difference is one of
    the model, for which :mod:`furiko.diagnosis` looks for the cause; ``trees``: how open mechanisms are compared, or a
    sentence why they are not.
    """

    name: str
    needs: Quantity
    module: str
    meaning: str
    bound: str
    trees: OfTrees | str
    why_not: Callable[[AnyScene, EngineInfo], str] = always
    long: bool = False
    explained: bool = False

    @property
    def moves(self) -> bool:
        """Whether it runs the engine's integrators: pointless where the accelerations differ already."""
        return self.needs == "trajectory"

    def skipped(self, scene: AnyScene, info: EngineInfo) -> str:
        """Why it is not run on this scene and engine, in a sentence; an empty string where it is."""
        if not isinstance(scene, TreeScene):
            return info.missing.get(self.needs, "") or self.why_not(scene, info)
        if isinstance(self.trees, str):
            return self.trees
        missing = info.tree.missing.get(self.trees.needs, "") if info.tree else ""
        return missing or self.why_not(scene, info)

    def compare(self, cell: Cell | TreeCell) -> Iterator[Result]:
        """The results, one a comparison; the comparison's module is imported now."""
        module = f".comparisons.{self.module}"
        if isinstance(self.trees, OfTrees) and isinstance(cell.scene, TreeScene):
            module = f".trees.{self.trees.module}"
        results: Iterator[Result] = import_module(module, __package__).compare(cell)
        return results
