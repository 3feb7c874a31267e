"""Why an engine's motion is not the scene's: asked of every engine that is timed, since a fast wrong run is no result.

``furiko check`` looks for these causes where a run differs. A benchmark has no verdict, so that they are asked for
without one: first of the accelerations, then, where these agree, of a few steps of each integrator.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ...diagnosis.explain import explanation
from ...diagnosis.explain_motion import explain_motion
from ...diagnosis.finding import Finding
from ...engines import engine_info, load_engine
from ...models import Scene
from ...records.findings import Difference
from .methods import why_not

MOST_LINKS = 20  # of a hundred links one integrator takes ten seconds, of twenty less than one and a half


def motion_causes(
    scene: Scene, engines: Sequence[str], watch: Callable[[str], None] = lambda _: None
) -> list[Difference]:
    """What was found of these engines; empty where their runs follow the scene, or it has too many links to ask."""
    found: list[Difference] = []
    for name in engines:
        if scene.system.n <= MOST_LINKS and not why_not(name, scene):
            watch(f"{scene.name} {name}: causes")
            found += [Difference(**finding.to_json()) for finding in _causes(scene, name)]
    return found


def _causes(scene: Scene, name: str) -> Iterator[Finding]:
    info, engine = engine_info(name), load_engine(name, scene.system)
    differs = explanation(engine, scene.system, who=name, accuracy=info.accuracy).all
    yield from differs
    if differs or "trajectory" in info.missing:
        return
    for integrator in info.integrators:
        yield from explain_motion(engine, scene.system, integrator, who=name)
