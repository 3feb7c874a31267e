"""Which engines can be trusted with one open mechanism, and how far it is from where they cannot.

The very mechanism climbs every axis that applies to it (:mod:`.trees.axes`): the first rung is the mechanism as it is.
So the evidence is of this scene, this engine and this release, and nothing is inferred from other mechanisms.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

from ...engines import EngineInfo
from ...models import TreeScene
from ...records.bench import Trust, TrustLimit
from ...records.check import Result
from .searches import Key, Results, TreeSearch, holds, key, run
from .trees.axes import TreeLadder, ladders_of

SEED = 2018
AS_IT_IS = "fast"  # an axis that applies to all mechanisms, and whose first rung changes nothing


def trust(
    scene: TreeScene, engines: Sequence[EngineInfo], budget: float, watch: Callable[[str], None] = lambda _: None
) -> list[Trust]:
    """What is found of each engine within about ``budget`` [s], the most trustworthy first."""
    base = replace(scene, own=None)
    ladders = ladders_of(base)
    searches = [TreeSearch(info.name, ladder, SEED, base) for ladder in ladders for info in engines]
    results: dict[Key, Result] = {}
    jobs = min(os.cpu_count() or 1, 8)
    cases = run(
        searches, results, budget=budget, jobs=jobs, watch=lambda case, _: watch(f"{case.engine}: {case.scene}")
    )
    for _ in cases:
        pass
    found = [of_engine(info.name, ladders, base, results) for info in engines]
    return sorted(found, key=lambda one: (ORDER.index(one.verdict), -(one.digits or 0.0)))


Verdict = Literal["right", "loses digits", "open", "wrong", "failed", "refused"]
ORDER: tuple[Verdict, ...] = ("right", "loses digits", "open", "wrong", "failed", "refused")


def of_engine(engine: str, ladders: Sequence[TreeLadder], base: TreeScene, results: Results) -> Trust:
    """What the results say of one engine."""
    as_it_is = next(ladder for ladder in ladders if ladder.axis.name == AS_IT_IS)
    first = results.get(key(TreeSearch(engine, as_it_is, SEED, base).case(0)))
    taken = first is None or first.details.get("failure") != "refused"
    return Trust(
        engine=engine,
        verdict=verdict(first),
        reason="" if first is None else first.reason,
        digits=None if first is None else first.details.get("digits"),
        error=None if first is None else first.measured,
        error_over_bound=None if first is None else first.details.get("error over bound"),
        limits=[_limit(TreeSearch(engine, ladder, SEED, base), results) for ladder in ladders] if taken else [],
    )


def verdict(first: Result | None) -> Verdict:
    """What the engine makes of the mechanism as it is, in a word of :data:`ORDER`."""
    if first is None:
        return "open"
    if holds(first):
        return "right"
    failure = first.details.get("failure")
    if failure in ("refused", "half its digits lost"):
        return "refused" if failure == "refused" else "loses digits"
    return "failed" if failure in ("exception", "hang", "crash") else "wrong"


def _limit(search: TreeSearch, results: Results) -> TrustLimit:
    found, ladder = search.frontier(results), search.ladder
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    return TrustLimit(
        axis=ladder.axis.name,
        says=ladder.axis.says,
        closed=found.closed,
        holds_at=ladder.label(found.holds) if found.holds >= 0 else None,
        fails_at=ladder.label(found.fails) if found.fails is not None else None,
        rung=found.fails,
        failure=None if failing is None else failing.details.get("failure"),
        reason="" if failing is None else failing.reason,
    )
