"""Assertions for other projects' tests: an acceleration function, or two model files, held to what is proven.

Nothing of pytest is needed here; the plugin that is, is :mod:`furiko.pytest_plugin`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from .models import InvalidInput, Scene
from .models.systems import DocumentSystem

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from .checks.cell import Cell
    from .diagnosis.finding import Finding
    from .models.states import States

    Array = NDArray[np.float64]

RANDOM_STATES = 50  # besides the six named ones; proving them takes some tenths of a second for a few links
MOST_CAUSES = 5  # of the causes found, so many are in the message


def assert_accelerations(
    system: DocumentSystem,
    fn: Callable[[Array, Array], ArrayLike],
    *,
    states: tuple[ArrayLike, ArrayLike] | None = None,
    rtol: float | None = None,
    coordinates: Literal["absolute", "relative"] = "absolute",
) -> None:
    """Assert that ``fn`` computes a system's accelerations, within what rounding explains.

    ``fn(theta, omega)`` → θ̈ [rad/s²]; all (B, n), absolute angles [rad] from the downward vertical and rates [rad/s].
    ``states``: θ and ω, (B, n) or (n,) each; None for the named and random states that ``furiko check`` looks at.
    ``rtol``: None for the bound of ``furiko check``, proven for the coordinates in which ``fn`` solves the equations of
    motion (``coordinates``: joint angles are ``relative``); a number for errors up to rtol × the state's largest.

    Raises AssertionError with the state, the link, what was expected and what came, and where it is known the cause;
    :class:`furiko.InvalidInput` for bad arguments, and for states in which no acceleration has a digit that is sure.
    Exceptions of ``fn`` pass through.
    """
    from .checks.cell import EngineFault, array_of

    if rtol is not None and not 0 < rtol < 1:
        raise InvalidInput(f"rtol: a number between 0 and 1 is needed, got {rtol!r}")
    cell = _cell(system, fn, states, coordinates)
    asked = cell.states
    answer = fn(asked.theta.copy(), asked.omega.copy())
    try:
        got = array_of("accelerations", answer, asked.theta.shape, asked.labels)
    except EngineFault as fault:
        raise AssertionError(str(fault)) from None
    wrong = _beyond_rounding(cell, got) if rtol is None else _beyond_tolerance(cell, got, rtol)
    if wrong is not None:
        state, why = wrong
        raise AssertionError("\n".join([*_where(cell, got, state), why, *_causes(cell.explanation.all)]))


def assert_model_matches(
    a: str | Path,
    b: str | Path,
    *,
    engines: Sequence[str] = (),
    meshes: Sequence[str | Path] = (),
    limits: bool = False,
) -> None:
    """Assert that two model files, MJCF or URDF, are the same mechanism, as ``furiko diagnose A --against B`` compares.

    ``engines``: these must read ``a`` as it is written, too; ``meshes``: folders in which meshes may lie; ``limits``:
    whether joints' ranges count. URDF gives no gravity: a URDF file is held against the other one's.

    Raises AssertionError with each number that differs, :class:`furiko.InvalidInput` for a file that cannot be read.
    """
    from .diagnosis.model_files.diagnose import diagnose

    if str(b).endswith(".urdf") and not str(a).endswith(".urdf") and not engines:
        a, b = b, a
    folders = [Path(folder) for folder in meshes]
    found = diagnose(Path(a), str(b), list(engines) or {}, meshes=folders, limits=limits, isolated=bool(engines))
    if found.findings or (engines and found.verdict != "agrees"):
        says = [f"  {finding.cause} at {finding.where}: {finding.says}" for finding in found.findings]
        without = [f"  {name} {said['status']}" for name, said in found.engines.items() if said["status"] != "agrees"]
        raise AssertionError("\n".join([f"{a} does not match {b}:", *says, *without]))


def _cell(
    system: DocumentSystem, fn: Callable[..., Any], states: tuple[ArrayLike, ArrayLike] | None, coordinates: Any
) -> Cell:
    """What ``furiko check`` would look at, the function being the engine."""
    from .checks.cell import Cell
    from .checks.facts import scene_facts
    from .engines import AnyShape, EngineInfo

    if coordinates not in ("absolute", "relative"):
        raise InvalidInput(f"coordinates: 'absolute' or 'relative' is needed, got {coordinates!r}")
    name = getattr(fn, "__name__", None) or type(fn).__name__
    missing = ("fields", "inverse_dynamics", "joint_forces", "energy", "trajectory")
    info = EngineInfo(
        name=name,
        formulation="a function",
        adapter="",
        module="",
        package="",
        homepage="",
        coordinates=coordinates,
        missing=dict.fromkeys(missing, "a function of accelerations alone"),
    )
    scene = Scene(name="assert_accelerations", system=system)
    looked_at = _states(scene, states)
    engine = AnyShape(_Function(fn), info, system.n)  # type: ignore[arg-type]
    cell = Cell(scene, info, engine, looked_at, scene_facts(scene, looked_at))
    regular = cell.regular
    if states is not None and len(regular.states) < len(looked_at):
        lost = next(label for label in looked_at.labels if label not in regular.states.labels)
        raise InvalidInput(f"states: in {lost} the mass matrix is singular but for rounding: no digit is sure")
    if not len(regular.states):
        raise InvalidInput("states: in each the mass matrix is singular but for rounding: no digit is sure")
    return regular


def _states(scene: Scene, given: tuple[ArrayLike, ArrayLike] | None) -> States:
    import numpy as np

    from .models.states import States, states

    if given is None:
        return states(scene, RANDOM_STATES)
    n = scene.system.n
    theta, omega = (np.atleast_2d(np.array(values, dtype=np.float64)) for values in given)
    if theta.ndim != 2 or theta.shape[1] != n or theta.shape != omega.shape or not len(theta):
        raise InvalidInput(f"states: θ and ω of shape (B, {n}) are needed, B ≥ 1, got {theta.shape} and {omega.shape}")
    if not (np.isfinite(theta).all() and np.isfinite(omega).all()):
        raise InvalidInput("states: must be finite")
    return States(tuple(f"states[{row}]" for row in range(len(theta))), theta, omega)


class _Function:
    """A function where an engine is expected."""

    def __init__(self, fn: Callable[..., Any]) -> None:
        self.accelerations = fn


def _beyond_rounding(cell: Cell, got: Array) -> tuple[int, str] | None:
    """The state that is furthest beyond the bound of ``furiko check``, and why; None where none is."""
    from .checks.cell import worst
    from .checks.comparisons.accelerations import backward_error
    from .reference.rounding.bounds import allowed

    error, _ = backward_error(cell, got, cell.amplitude)
    found, bound = worst(error), allowed(cell.scene.system.n, cell.info.accuracy)
    if found.value <= bound:
        return None
    return found.index[0], (
        f"  a residual of {found.value:.3g} ε of the terms of equation {found.index[1] + 1}; "
        f"rounding explains {bound:.3g} ε"
    )


def _beyond_tolerance(cell: Cell, got: Array, rtol: float) -> tuple[int, str] | None:
    """The same for a relative tolerance of each state's accelerations."""
    import numpy as np

    from .checks.cell import quotient, worst

    size = np.abs(cell.facts.high).max(axis=-1, keepdims=True)
    found = worst(quotient(cell.facts.error(got), np.broadcast_to(size, got.shape)))
    if found.value <= rtol:
        return None
    return found.index[0], f"  off by {found.value:.3g} of the state's largest acceleration; rtol is {rtol:g}"


def _where(cell: Cell, got: Array, state: int) -> list[str]:
    """The link that is furthest off in this state, and the state itself."""
    import numpy as np

    link = int(np.abs(cell.facts.error(got)[state]).argmax())
    theta, omega = cell.states.theta[state].tolist(), cell.states.omega[state].tolist()
    return [
        f"{cell.info.name}: acceleration of link {link + 1} of {cell.scene.system.n} in state "
        f"{cell.states.labels[state]!r}: expected {float(cell.facts.high[state, link])!r}, "
        f"got {float(got[state, link])!r} rad/s²",
        f"  theta = {theta}",
        f"  omega = {omega}",
    ]


def _causes(findings: Sequence[Finding]) -> list[str]:
    return [f"  {finding.cause} at {finding.where}: {finding.says}" for finding in findings[:MOST_CAUSES]]
