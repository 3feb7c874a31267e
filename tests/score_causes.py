"""Score of the named causes: recall and precision over planted faults, false alarms over sound models, sensitivity.

Run it from a checkout, where pytest imports it too:

    python tests/score_causes.py [--plants 25] [--sound 500] [--pairs 600] [--json FILE]

``--plants``: how many of each fault; ``--pairs``: how many engines with two faults, and as many with one of the same
kinds; 0 for all but pairs: ``--plants 0 --sound 0``. Every random number follows from its index, so that
a run can be repeated.
"""

from __future__ import annotations

import argparse
import json
import os
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from faults.engines import NAMES, OF_ENGINES, WrappedEngine
from faults.mechanisms import Shape, free, with_link
from faults.model_files import IN_FILES, diagnosed, planted_in_file, sound_model
from faults.pairs import drawn
from faults.readers import OF_READERS, misreading
from faults.runs import OF_RUNS

from furiko import diagnose
from furiko.diagnosis.explain import explain, explanation
from furiko.diagnosis.explain_motion import explain_motion
from furiko.engines import load_engine
from furiko.models import Link, PlanarTree

SEED = 20_000


@dataclass
class Score:
    """Of one cause: how many were planted, detected, named first, named at all; and what came first instead."""

    planted: int = 0
    detected: int = 0
    first: int = 0
    named: int = 0
    instead: Counter[str] = field(default_factory=Counter)

    def add(self, cause, findings):
        self.planted += 1
        self.detected += bool(findings)
        self.named += any(f.cause == cause for f in findings)
        if findings and findings[0].cause == cause:
            self.first += 1
        else:
            self.instead[findings[0].cause if findings else "nothing"] += 1


def findings_of(place, cause, seed):
    """What is found where this cause is planted with this seed."""
    rng = np.random.default_rng(seed)
    if place == "file":
        plant = planted_in_file(cause, rng)
        return diagnosed(plant.text, plant.language, plant.wanted).findings
    if place == "reader":
        file, readers = misreading(cause, rng)
        return diagnose(file, None, readers).findings
    if place == "run":
        engine, wanted, integrator, diverged = OF_RUNS[cause](rng)
        return explain_motion(engine, wanted, integrator, diverged=diverged)
    engine, wanted = OF_ENGINES[cause](rng)
    return explain(engine, wanted)


PLACES = {"file": tuple(IN_FILES), "engine": tuple(OF_ENGINES), "reader": OF_READERS, "run": tuple(OF_RUNS)}


def score(plants, places=PLACES, seed=SEED):
    """A score for every place and cause, from ``plants`` of each."""
    scores = {}
    for place, causes in places.items():
        for cause in causes:
            one = scores[place, cause] = Score()
            for k in range(plants):
                one.add(cause, findings_of(place, cause, seed + k))
    return scores


def precision(scores):
    """Of all findings that came first with a cause, the share that were planted with it."""
    first, right = Counter(), Counter()
    for (_, cause), one in scores.items():
        first[cause] += one.first
        right[cause] += one.first
        for other, count in one.instead.items():
            first[other] += count
    return {cause: right[cause] / first[cause] for cause in first if cause != "nothing"}


# What engines really do with sound files: MuJoCo refuses point masses in URDF, Pinocchio reads one root of an MJCF.
OF_SOUND_FILES = {"inertia-rejected", "first-root-only"}


def false_alarms(count, seed=SEED):
    """(how many sound models got a finding, their seeds)."""
    alarmed = []
    for k in range(count):
        text, style, wanted = sound_model(np.random.default_rng(seed + k))
        if {found.cause for found in diagnosed(text, style.language, wanted).findings} - OF_SOUND_FILES:
            alarmed.append(seed + k)
    return alarmed


# --- Pairs ------------------------------------------------------------------------------------------------------------


@dataclass
class PairScore:
    """Of engines with one or two faults: how many, how many of which every fault is named, how many with a cause that
    is said to be certain and is not one of them, and the seeds of those that are not right."""

    drawn: int = 0
    named: int = 0
    misleading: list[int] = field(default_factory=list)
    missed: dict[int, tuple[tuple[str, ...], list[str]]] = field(default_factory=dict)


def score_of_pairs(seeds, how_many=2):
    """The score over engines drawn with these seeds, with so many faults each."""
    total = PairScore()
    for seed in seeds:
        planted = drawn(np.random.default_rng(seed), how_many)
        found = explanation(planted.engine, planted.wanted)
        causes = [finding.cause for finding in found.all]
        total.drawn += 1
        if set(planted.causes) <= set(causes):
            total.named += 1
        else:
            total.missed[seed] = planted.causes, causes
        if found.explained and {finding.cause for finding in found.findings} - set(planted.causes):
            total.misleading.append(seed)
    return total


# --- Sensitivity ----------------------------------------------------------------------------------------------------


def uneven_chain(n):
    lengths = [1.0, 0.8, 0.6, 0.9, 0.7, 1.1, 0.5, 0.75, 0.65, 0.85][:n]
    links, before = [], 0.0
    for i, l in enumerate(lengths):
        m = 1.0 + 0.3 * i
        links.append(Link(i - 1, (before, 0.0), l, (l / 2, 0.0), m, m * l * l / 12))
        before = l
    return PlanarTree(tuple(links), 9.81)


def changed_by(mechanism, kind, i, delta):
    link = mechanism.links[i]
    if kind == "mass":
        return with_link(mechanism, i, mass=link.mass * (1 + delta))
    if kind == "inertia":
        return with_link(mechanism, i, inertia=link.inertia * (1 + delta))
    if kind == "length":
        return with_link(mechanism, i + 1, hinge=(mechanism.links[i + 1].hinge[0] * (1 + delta), 0.0))
    return replace(mechanism, gravity=(mechanism.gravity[0] * (1 + delta), 0.0))


def estimated(mechanism, kind, i, delta, name):
    """Whether a change is detected, and its size told within a tenth, by an engine that hides what it compiled."""
    other = changed_by(mechanism, kind, i, delta)
    engine = WrappedEngine(load_engine(name, Shape(PlanarTree(other.links, other.gravity[0]))), shows=False)
    for finding in explain(engine, mechanism):
        if finding.cause != kind or not isinstance(finding.measured, float) or not finding.expected:
            continue
        if abs(finding.measured / finding.expected - 1 - delta) <= 0.1 * delta:
            return True
    return False


def sensitivity(n, kind, name="pinocchio-aba"):
    """The smallest relative change 10^-k of the link that shows it least that is detected and estimated."""
    mechanism = free(uneven_chain(n))
    places = [0] if kind == "gravity" else range(n - 1) if kind == "length" else range(n)
    found = None
    for exponent in range(8, 16):
        if not all(estimated(mechanism, kind, i, 10.0**-exponent, name) for i in places):
            break
        found = 10.0**-exponent
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plants", type=int, default=25)
    parser.add_argument("--sound", type=int, default=500)
    parser.add_argument("--pairs", type=int, default=0)
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # engines announce instability there
    scores = score(given.plants)
    precise = precision(scores)
    print(f"{'where':8}{'cause':34}{'planted':>8}{'detected':>9}{'first':>7}{'named':>7}{'precision':>10}")
    for (place, cause), one in scores.items():
        instead = ", ".join(f"{other} {count}" for other, count in one.instead.items())
        print(
            f"{place:8}{cause:34}{one.planted:8}{one.detected:9}{one.first:7}{one.named:7}"
            f"{precise.get(cause, 0):10.3f}  {instead}"
        )
    planted, detected, first = (sum(getattr(s, a) for s in scores.values()) for a in ("planted", "detected", "first"))
    print(f"{planted} planted, {detected} detected, {first} named first ({first / max(planted, 1):.1%})")
    alarms = false_alarms(given.sound)
    print(f"{given.sound} sound models, {len(alarms)} false alarms {alarms[:5] or ''}")
    for how_many in (1, 2) if given.pairs else ():
        total = score_of_pairs(range(given.pairs), how_many)
        print(
            f"{total.drawn} engines with {how_many} faults: all named in {total.named / total.drawn:.1%}, misleading "
            f"{len(total.misleading)} {total.misleading[:10] or ''}"
        )
        for seed, (causes, instead) in total.missed.items():
            print(f"  {seed}: {' and '.join(causes)}: {', '.join(instead) or 'nothing'}")
    if not given.plants:
        return
    kinds = ("mass", "length", "inertia", "gravity")
    print("smallest relative change that is detected and estimated within a tenth (worst link)")
    print(f"{'engine':16}{'n':>3}" + "".join(f"{kind:>10}" for kind in kinds))
    table = {}
    for name in NAMES[:3]:
        for n in (1, 2, 3, 5, 10):
            row = [sensitivity(n, kind, name) if n > 1 or kind != "length" else None for kind in kinds]
            table[f"{name} {n}"] = dict(zip(kinds, row, strict=True))
            print(f"{name:16}{n:3}" + "".join(f"{value:10.0e}" if value else f"{'-':>10}" for value in row))
    if given.json:
        rows = [{"where": p, "cause": c, **vars(s), "precision": precise.get(c)} for (p, c), s in scores.items()]
        content = {"causes": rows, "sound": given.sound, "false alarms": len(alarms), "sensitivity": table}
        given.json.write_text(json.dumps(content, indent=1))


if __name__ == "__main__":
    main()
