"""One run of ``furiko advise``: the scene, the study, its record."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

import msgspec

from . import __version__
from .bench import engines_to_measure, with_own_motions
from .engines import cannot, engine_info
from .models import InvalidInput, Scene, TreeScene, find_scene
from .records import provenance
from .records.bench import Advice, Advised, NotAdvised

# Parts of the time for an open mechanism with a motion: accelerations, steps; what is left, the long run.
TRUST, STEPS = 0.4, 0.4
# Methods that keep the error, those that do not, engines left out, the reference's error.
Studied = tuple[list[Advised], list[NotAdvised], list[str], float]


def advise(
    scene: str,
    *,
    error: float = 1e-6,
    until: float | None = None,
    engines: Sequence[str] | None = None,
    budget: float = 30.0,
    watch: Callable[[str], None] = lambda _: None,
) -> Advice:
    """Which engine, integrator and step to use for a scene, from runs of all of them in it.

    ``scene``: a name of the catalogue or a TOML file, with a state; an open mechanism without a state or a duration is
    asked for accelerations alone. ``error``: the largest that may be made, of θ [rad]
    and ω [rad/s], at half, three quarters and all of the time. ``until`` [s]: how long the motion is; None for the
    scene's own duration. ``engines``: names, None for those that differ in their motions. ``budget`` [s]: about how
    long to try.

    Raises :class:`InvalidInput` for a scene without a motion, or one that is not known well enough, and
    :class:`EngineMissing`.
    """
    from .studies.bench.advice import advise as study

    begun = time.monotonic()
    found = find_scene(scene)
    duration = until if until is not None else found.duration
    if isinstance(found, TreeScene):
        return _of_tree(replace(found, duration=duration), error, engines, budget, watch, begun)
    if found.theta is None or not duration:
        what = "give one (--until)" if found.theta is not None else "add [state] with theta, omega and duration"
        raise InvalidInput(f"scene {scene!r}: it has no [state] with a duration, so there is no motion: {what}")
    named = replace(found, duration=duration)
    names = engines_to_measure(engines)
    moving = names if engines is not None else with_own_motions(names)
    return _advice(named, error, begun, study(named, moving, error, budget, watch))


def _of_tree(
    scene: TreeScene,
    error: float,
    engines: Sequence[str] | None,
    budget: float,
    watch: Callable[[str], None],
    begun: float,
) -> Advice:
    """Of an open mechanism: whether accelerations are right, how far they stay so, and steps where it has a motion."""
    from .studies.bench.advice import advise as study
    from .studies.bench.methods import STEP
    from .studies.stress.tree_long_runs import Advisable, long_runs
    from .studies.stress.tree_trust import trust

    names = engines_to_measure(engines)
    infos = [replace(engine_info(name), name=name) for name in names]
    left_out = [f"{info.name}: {cannot(info, scene.system)}" for info in infos if info.tree is None]
    asked = [info for info in infos if info.tree is not None]
    if not asked:
        raise InvalidInput(f"{scene.name}: none of these engines takes open mechanisms: {', '.join(names)}")
    moves = scene.starts and scene.duration > 0
    found = trust(scene, asked, TRUST * budget if moves else budget, watch)
    still: Studied = ([], [], [], 0.0)
    studied = study(scene, [info.name for info in asked], error, STEPS * budget, watch) if moves else still
    advised = [Advisable(each.engine, each.scheme, each.setting) for each in studied[0] if each.by == STEP]
    lasting = long_runs(scene, advised, (1 - TRUST - STEPS) * budget, watch)
    given = _advice(replace(scene, duration=scene.duration if moves else 0.0), error, begun, studied)
    return msgspec.structs.replace(given, left_out=[*left_out, *given.left_out], trust=found, long_runs=lasting)


def _advice(scene: Scene | TreeScene, error: float, begun: float, studied: Studied) -> Advice:
    """The record of what a study of the scene's motion found."""
    advised, missed, left_out, truth = studied
    return Advice(
        furiko=__version__,
        command=provenance.command(),
        machine=provenance.machine(),
        versions=provenance.versions(),
        scene=scene.name,
        system=scene.system.kind,
        n=scene.system.n,
        duration=scene.duration,
        asked=error,
        truth=truth,
        seconds=time.monotonic() - begun,
        advised=advised,
        not_advised=missed,
        left_out=left_out,
    )
