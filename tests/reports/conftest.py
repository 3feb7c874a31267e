"""Made-up runs: small ones to order, and one as large as the catalogue's, with something of every outcome."""

import random

import pytest

from furiko.records.check import EngineEntry, Footer, Header, Result, SceneEntry
from furiko.reports.report import Report

ENGINES = {
    "mujoco": ("tree, relative angles", "mujoco", "4.0.1"),
    "pinocchio-aba": ("articulated-body algorithm", "pin", "4.0.0"),
    "pinocchio-mjcf": ("articulated-body algorithm, model from MJCF", "pin", "4.0.0"),
    "pinocchio-crba": ("composite-rigid-body matrix and a solve", "pin", "4.0.0"),
    "exudyn-tree": ("kinematic tree, minimal coordinates", "exudyn", "1.13.0"),
    "exudyn-redundant": ("bodies and revolute joints, redundant coordinates", "exudyn", ""),
}
CHECKS = ("model-fields", "accelerations", "terms", "joint-forces", "energy", "trajectory", "symmetries")
LINKS = (1, 2, 3, 4, 5, 8, 10, 16, 20, 32, 50, 64, 80, 90, 100)


def scene_entry(name: str = "rods-2", system: str = "rod-chain", n: int = 2, **fields) -> SceneEntry:
    given = {"lengths": [0.8 + 0.1 * (i % 3) for i in range(n)], "masses": [1.0] * n, "gravity": 9.81} | fields
    return SceneEntry(name=name, system=system, n=n, **given)


def engine_entry(name: str = "mujoco", **fields) -> EngineEntry:
    formulation, package, version = ENGINES.get(name, ("", name, "1.0"))
    return EngineEntry(**({"name": name, "formulation": formulation, "package": package, "version": version} | fields))


def header(scenes=None, engines=None, **fields) -> Header:
    given = {
        "furiko": "0.1.0",
        "started": "2026-11-23T04:45:00Z",
        "command": "furiko check --profile full",
        "profile": "full",
        "seed": "sha256 of the scene's name",
        "machine": {"system": "Linux 6.8 x86_64", "cpu": "an example", "cores": "2"},
        "versions": {"python": "3.11.9", "numpy": "2.3.1", "mujoco": "4.0.1", "pin": "4.0.0"},
        "scenes": [scene_entry()] if scenes is None else scenes,
        "engines": [engine_entry()] if engines is None else engines,
    } | fields
    return Header(**given)


def result(outcome="agrees", scene="rods-2", engine="mujoco", check="accelerations", **fields) -> Result:
    if outcome == "loose":
        return result("agrees", scene, engine, check, **({"measured": 50.0, "line": 4.0, "loose": True} | fields))
    given = {"measured": 3.1, "allowed": 64.0, "unit": "ε"} if outcome in ("agrees", "differs") else {}
    return Result(scene=scene, engine=engine, check=check, outcome=outcome, **(given | fields))


def report(*results: Result, footer: bool = True, **fields) -> Report:
    """A run of these results, whole unless ``footer`` is false."""
    outcomes = [r.outcome for r in results]
    counted = {outcome: outcomes.count(outcome) for outcome in ("agrees", "differs", "skipped", "error")}
    loose = sum(r.loose for r in results)
    return Report(header(**fields), results, Footer(**counted, loose=loose, seconds=1.5) if footer else None)


def large_run(links=LINKS, checks=CHECKS, seed: int = 1) -> Report:
    """Two systems × sizes × six engines × seven checks, of every outcome."""
    draw = random.Random(seed)
    scenes = [
        scene_entry(
            f"{'rods' if system == 'rod-chain' else 'n-leg'}-{n}",
            system,
            n if system == "rod-chain" else n + 1,
            description=f"{'Chain of' if system == 'rod-chain' else 'N-leg pendulum, N ='} {n}",
            equations=["takeno 17", "takeno 21", "takeno 22: Σ_k M_jk θ̈_k = b_j"]
            if system == "rod-chain"
            else ["shiki 3.12"],
            tags=["documents"],
            states=206,
            duration=2.0,
        )
        for n in links
        for system in ("n-leg", "rod-chain")
    ]
    results = [_drawn(draw, scene, engine, check) for scene in scenes for engine in ENGINES for check in checks]
    return report(*results, scenes=scenes, engines=[engine_entry(name) for name in ENGINES])


def _drawn(draw: random.Random, scene: SceneEntry, engine: str, check: str) -> Result:
    where = {"scene": scene.name, "engine": engine, "check": check, "seconds": draw.random() / 100}
    if engine == "exudyn-redundant" and check in ("terms", "joint-forces"):
        return result("skipped", **where, reason="its inverse dynamics are not reachable from Python")
    if engine == "exudyn-redundant" and scene.n > 64:
        reason = (
            'Traceback (most recent call last):\n  File "exudyn.py", line 7, in solve\nRuntimeError: no convergence'
        )
        return result("error", **where, reason=reason)
    if engine == "pinocchio-crba" and check == "trajectory":
        return result("skipped", **where, reason="it has no integrator of its own")
    if engine == "mujoco" and scene.name == "rods-20" and check in ("accelerations", "energy"):
        return result(
            "differs",
            **where,
            measured=2.3e9,
            allowed=8.0 * scene.n,
            cause="armature",
            reason="the diagonal of M is larger by 0.01 kg m² in every state, and nothing else differs",
        )
    allowed = 8.0 * scene.n
    details = {"states": 206, "worst state": "whirling", "forward error": 1.3e-14, "inexact side": "neither"}
    return result(
        "agrees",
        **where,
        measured=allowed * draw.random() ** 3,
        allowed=allowed,
        details=details,
        reason="rounding of n products in each row",
    )


@pytest.fixture(scope="session")
def make():
    """The makers of this file, by name: ``make.report(make.result("differs"))``."""
    import types

    return types.SimpleNamespace(
        header=header, result=result, report=report, scene=scene_entry, engine=engine_entry, large=large_run
    )
