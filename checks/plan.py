"""The plan: which comparisons run, and which do not and why, decided before anything runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..engines import OWN_EQUATIONS, EngineInfo, all_of, cannot, engine_info, engine_names, why_missing
from ..models import AnyScene, InvalidInput, TreeScene, find_scenes, tagged_scenes
from ..models.errors import nearest
from ..records.check import Outcome, Result
from .registry import CHECKS

LINKS = 10  # of the longest mechanism that is looked at in all of a profile's random states
SHORT = tuple(name for name, check in CHECKS.items() if not check.long)


@dataclass(frozen=True)
class Profile:
    """How thorough a run is: which scenes by default, which checks, how many random states at most.

    ``few_steps``: no longer time is looked at in trajectories of ten links than so many steps reach, of the finest run.
    """

    name: str
    says: str
    checks: tuple[str, ...]
    random_states: int
    few_steps: int = 1 << 8
    tag: str | None = None


PROFILES = {
    profile.name: profile
    for profile in (
        Profile(
            "smoke", "one scene of each document's system, accelerations alone", ("accelerations",), 20, tag="smoke"
        ),
        Profile("quick", "the whole catalogue, every check that is quick", SHORT, 200),
        Profile("full", "every check, in five times as many random states", tuple(CHECKS), 1000, few_steps=1 << 10),
    )
}


@dataclass(frozen=True)
class Task:
    """The checks of one scene on one engine that are to run, and as in its :class:`Profile` how thoroughly."""

    scene: AnyScene
    engine: str
    checks: tuple[str, ...]
    random_states: int
    few_steps: int = 1 << 10


@dataclass(frozen=True)
class Plan:
    """``tasks`` run; ``settled`` holds the results known beforehand: what is skipped, and engines that are missing."""

    profile: Profile
    scenes: tuple[AnyScene, ...]
    engines: tuple[EngineInfo, ...]
    tasks: tuple[Task, ...]
    settled: tuple[Result, ...]
    absent: Mapping[str, str] = field(default_factory=dict)  # by name of an engine: why it cannot run, or ""


def make_plan(scenes: Sequence[str] | None, engines: Sequence[str] | None, profile: str) -> Plan:
    """Decide. Names as on the command line; None for all. Raises :class:`InvalidInput` where one is unknown."""
    if profile not in PROFILES:
        raise InvalidInput(f"profile {profile!r}: one of {', '.join(PROFILES)} is needed{nearest(profile, PROFILES)}")
    chosen = PROFILES[profile]
    found = tagged_scenes(chosen.tag) if scenes is None and chosen.tag else find_scenes(scenes)
    # An engine from elsewhere goes by the path that finds it again, in a worker and on the next command line.
    infos = tuple(
        replace(engine_info(name), name=name) for name in all_of(engine_names() if engines is None else engines)
    )
    if OWN_EQUATIONS not in infos and any(map(_has_own, found)):
        infos = (*infos, OWN_EQUATIONS)
    return plan_of(found, infos, chosen, asked=engines is not None)


def plan_of(
    scenes: tuple[AnyScene, ...],
    infos: tuple[EngineInfo, ...],
    chosen: Profile,
    *,
    asked: bool = True,
    absent: Mapping[str, str] | None = None,
) -> Plan:
    """Decide for these scenes and engines. ``asked``: the user named the engines, so that a missing one is an error.

    ``absent``: why each engine cannot run, or an empty string, where that has been looked up already.
    """
    tasks: list[Task] = []
    settled: list[Result] = []
    if absent is None:
        absent = {info.name: why_missing(info.name) for info in infos}
    outcome: Outcome = "error" if asked else "skipped"
    for scene in scenes:
        for info in infos:
            if info == OWN_EQUATIONS and not asked and not _has_own(scene):
                continue
            reasons = {check: reason for check in chosen.checks if (reason := skip(check, scene, info))}
            if absent[info.name]:
                settled += [_settled(scene, info, check, outcome, absent[info.name]) for check in chosen.checks]
                continue
            settled += [_settled(scene, info, check, "skipped", reason) for check, reason in reasons.items()]
            runs = tuple(check for check in chosen.checks if check not in reasons)
            if runs:
                tasks.append(Task(scene, info.name, runs, random_states(scene, chosen), chosen.few_steps))
    return Plan(chosen, scenes, infos, tuple(tasks), tuple(settled), absent)


def _has_own(scene: AnyScene) -> bool:
    return isinstance(scene, TreeScene) and scene.own is not None


def random_states(scene: AnyScene, profile: Profile) -> int:
    """How many random states of a scene a run looks at, at most: a state of a tree costs ten times as much.

    Of more than ten links so many that as many accelerations are compared as of ten: each state is judged by itself, at
    a cost that grows with the square of the links.
    """
    if isinstance(scene, TreeScene):
        return profile.random_states // 10
    return min(profile.random_states, max(1, LINKS * profile.random_states // scene.system.n))


def skip(check: str, scene: AnyScene, info: EngineInfo) -> str:
    """Why this check is not run on this scene and engine, in a sentence; an empty string where it is."""
    too_much = cannot(info, scene.system)
    if too_much:
        return too_much
    if info == OWN_EQUATIONS and not _has_own(scene):
        return "the scene has no equations of a user's own"
    return CHECKS[check].skipped(scene, info)


def _settled(scene: AnyScene, info: EngineInfo, check: str, outcome: Outcome, reason: str) -> Result:
    return Result(scene=scene.name, engine=info.name, check=check, comparison=check, outcome=outcome, reason=reason)
