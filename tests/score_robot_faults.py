"""How often one small fault in an engine's model of a robot is detected, and the number named that is wrong.

    python tests/score_robot_faults.py [MODEL ...] [--engine mujoco --engine pinocchio-aba] [--every 1] [--first 0]

One fault a time is planted into the engine's own model (``tests/faults/robots.py``): into each mass, centre, moment and
product of inertia, axis, place, orientation, armature and damping of each link; then the engine is asked as ``furiko
diagnose`` asks it. Without MODEL: the robots of the catalogue. Printed by kind: how many were planted; how many of them
move an acceleration by more than rounding does; how many of those were detected; in how many of these the first cause
named is the planted number, at its link; and how many faults are named as something else or somewhere else besides.
"""

from __future__ import annotations

import argparse
import os
import time
from collections import Counter
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

import numpy as np
from faults.robots import FAULTS, planted

from furiko.diagnosis.robots.answer import Question, ask_robot
from furiko.diagnosis.robots.moving_links import moving_links
from furiko.diagnosis.robots.states import probe_states
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models.readers.model_file import read_model
from furiko.models.spatial import IDENTITY
from furiko.models.spatial_mechanism import WORLD

ROBOTS = ("arm-7", "quadruped", "humanoid", "hopper", "acrobot")
FILES = Path(__file__).parents[1] / "models" / "files"
# Of the movement that the last bit of a coordinate makes; the states differ, and a maximum of few is small.
BEYOND_ROUNDING = 100.0


@dataclass
class Score:
    """Of one kind of faults: how many were planted, matter, were detected, are named; and what was said instead."""

    planted: int = 0
    matter: int = 0
    detected: int = 0
    named: int = 0
    misleading: int = 0
    unnoticed: int = 0
    instead: Counter[str] = field(default_factory=Counter)


def robot_size(mechanism):
    """The largest distance of a body's frame from the first moving one's, in the reference configuration [m]."""
    poses = []
    for body in mechanism.bodies:
        outer = IDENTITY if body.parent == WORLD else poses[body.parent]
        poses.append(outer @ body.pose)
    points = np.array([pose.translation for pose in poses])
    first = next(k for k, body in enumerate(mechanism.bodies) if body.joints)
    return float(np.linalg.norm(points - points[first], axis=1).max()) or float(
        max(np.linalg.norm(body.inertial.centre) for body in mechanism.bodies)
    )


class ReadOnce(Question):
    """The question of a file that is read once with each mistake, not again for each fault."""

    @cached_property
    def read(self):
        return cache(super().read)


class Asked:
    """A robot's file, read once, in one engine."""

    def __init__(self, path, engine, states=4):
        self.path, self.reader = Path(path), ROBOT_READERS[engine]
        self.file = read_model(self.path)
        self.question = ReadOnce(self.path.resolve(), self.file)
        self.links = {name: link for link in moving_links(self.file.spatial) for name in link.bodies}
        loaded = self.reader.load(self.question.path, self.file.language)
        self.held = loaded.compiled(self.file.spatial)
        self.bound = loaded.bind(self.held)
        self.known = ask_robot(self.reader, self.question).findings
        self.q, self.v = probe_states(self.held, states)
        rows = [self.accelerations(self.bound, self.q, self.v)]
        # What rounding does: the same in states whose coordinates differ in the last bit.
        for seed in range(3):
            signs = np.random.default_rng(seed).choice([-1.0, 1.0], self.q.shape)
            rows.append(self.accelerations(self.bound, self.q * (1 + signs * 2.0**-52), self.v))
        self.moved = rows[0]
        moved_by_last_bits = np.abs(np.array(rows[1:]) - rows[0]).max(axis=(0, 2))
        self.noise = np.maximum(moved_by_last_bits, 2.0**-52 * np.abs(rows[0]).max(axis=1))
        # By the engine's names the file's, where the engine has none.
        self.joints = dict(zip(loaded.joints(), self.held.joint_names, strict=True))

    def accelerations(self, bound, q, v):
        return np.asarray(bound.accelerations(q, v, np.zeros_like(v)))

    def faults(self):
        loaded = self.reader.load(self.question.path, self.file.language)
        return list(FAULTS[self.reader.name](loaded, robot_size(self.file.spatial)))

    def matters(self, fault):
        """Whether an acceleration of the engine moves by more than the last bits of the state move it."""
        loaded = planted(self.reader, fault).load(self.question.path, self.file.language)
        moved = self.accelerations(loaded.bind(self.held), self.q, self.v)
        return bool((np.abs(moved - self.moved).max(axis=1) > BEYOND_ROUNDING * self.noise).any())

    def findings(self, fault):
        """What is found besides what is found without the fault, which the engine reads otherwise as it is."""
        found = ask_robot(planted(self.reader, fault), self.question).findings
        return [finding for finding in found if finding not in self.known]

    def right(self, fault, finding):
        """Whether a finding names the number, and the joint or the link."""
        link = self.links.get(fault.body)
        places = {fault.body, self.joints.get(fault.joint, ""), link.name if link is not None else ""} - {""}
        return finding.cause in fault.causes and any(repr(place) in finding.where for place in places)


def score(asked, faults, verbose=False):
    """The scores of these faults by kind."""
    scores = {}
    for fault in faults:
        one = scores.setdefault(fault.kind, Score())
        one.planted += 1
        matters, found = asked.matters(fault), asked.findings(fault)
        right = [asked.right(fault, finding) for finding in found]
        one.matter += matters
        one.unnoticed += bool(found) and not matters
        one.detected += matters and bool(found)
        one.named += matters and right[:1] == [True]
        one.misleading += not all(right)
        if not all(right) or (matters and not found):
            one.instead[", ".join(finding.cause for finding in found) or "nothing"] += 1
            if verbose:
                print(f"  {fault.kind} {fault.which} of {fault.body!r}, {fault.joint!r}: {matters}")
                print("".join(f"    {finding.cause}: {finding.says}\n" for finding in found))
    return scores


def table(scores):
    """The scores as text."""
    lines = [f"{'fault':12}{'planted':>9}{'matter':>8}{'detected':>10}{'named':>7}{'misleading':>12}"]
    for kind, one in scores.items():
        instead = "; ".join(f"{words} {count}" for words, count in one.instead.most_common(3))
        lines.append(
            f"{kind:12}{one.planted:9}{one.matter:8}{one.detected:10}{one.named:7}{one.misleading:12}   {instead}"
        )
    total = [sum(getattr(one, name) for one in scores.values()) for name in ("planted", "matter", "detected", "named")]
    misleading = sum(one.misleading for one in scores.values())
    lines.append(f"{'all':12}{total[0]:9}{total[1]:8}{total[2]:10}{total[3]:7}{misleading:12}")
    return "\n".join(lines)


def added(total, scores):
    """The second scores added to the first."""
    for kind, one in scores.items():
        into = total.setdefault(kind, Score())
        for name, value in vars(one).items():
            setattr(into, name, getattr(into, name) + value)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path)
    parser.add_argument("--engine", action="append", choices=list(FAULTS))
    parser.add_argument("--every", type=int, default=1, help="only each so many-th fault")
    parser.add_argument("--first", type=int, default=0, help="from this one on, counted from 0")
    parser.add_argument("--verbose", action="store_true", help="every fault that is not named right")
    chosen = parser.parse_args()
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # engines announce instability there
    for engine in chosen.engine or list(FAULTS):
        total = {}
        for path in chosen.models or [FILES / f"{name}.xml" for name in ROBOTS]:
            begun = time.perf_counter()
            try:
                asked = Asked(path, engine)
            except (ValueError, RuntimeError) as error:
                print(f"{path.name}: {engine} refuses it: {error}\n")
                continue
            faults = asked.faults()[chosen.first :: chosen.every]
            without = ", ".join(finding.cause for finding in asked.known) or "nothing"
            print(f"{path.name}: {engine}, {len(faults)} faults; found without any: {without}", flush=True)
            scores = score(asked, faults, chosen.verbose)
            added(total, scores)
            print(f"{table(scores)}\n{time.perf_counter() - begun:.0f} s\n", flush=True)
        print(f"{engine}, all robots\n{table(total)}\n")


if __name__ == "__main__":
    main()
