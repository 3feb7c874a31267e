"""How far sound engines are from the sharp line on random open mechanisms.

    python tests/score_trees.py [--first 1000] [--count 240]

Every third mechanism has links up to 10⁴ times heavier than others and up to 100 times as long. For each engine and
quantity: how many mechanisms, the median of an entry's 99th percentile over states, and the largest quotients |error| /
spread with the mechanism's number.
"""

import argparse
import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parent / "engines" / "trees"))

from test_tree_engines import pairs, random_tree

from furiko.checks.trees import terms
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.checks.trees.sharp import of_accelerations
from furiko.engines import engine_info, load_tree_engine
from furiko.models.trees.scene import TreeScene
from furiko.models.trees.states import tree_states


def mechanism(number):
    """A random one."""
    rng = np.random.default_rng(number)
    system = random_tree(rng, hinges_and_slides=number % 2 == 0)
    return wide(rng, system) if number % 3 == 2 else system


def wide(rng, system):
    """The same with sizes and masses far apart."""
    links = []
    for link in system.links:
        mass, inertia, size = 10 ** rng.uniform(-2, 2), 10 ** rng.uniform(-2, 2), 10 ** rng.uniform(-1, 1)
        links.append(
            replace(
                link,
                mass=link.mass * mass,
                inertia=tuple(x * inertia for x in link.inertia),
                position=tuple(size * x for x in link.position),
                centre=tuple(size * x for x in link.centre),
            )
        )
    return replace(system, links=tuple(links))


def quotients(cell):
    """|error| / spread of every entry in every state, by quantity; an entry that is exact has 0."""
    got = cell.engine.accelerations(cell.states.q, cell.states.v)
    usual = {"accelerations": of_accelerations(cell, cell.facts.error(got))}
    for part in ("M", "bias", "G"):
        answer, expected, _ = terms.ANSWERS[part](cell)
        usual[part] = terms._usual(cell, part, answer - expected)
    every = np.arange(len(cell.states))
    found = {}
    for name, one in usual.items():
        error = np.abs(one.error)
        spread = np.max([one.spread(way, every) for way in cell.info.ways], axis=0)
        found[name] = np.divide(error, spread, out=np.where(error > 0, np.inf, 0.0), where=spread > 0)
    return found


def cells(number, states=20):
    """The mechanism's cell on each engine that takes it."""
    system = mechanism(number)
    scene = TreeScene(f"random {number}", system)
    looked_at = tree_states(scene, states)
    facts = tree_facts(scene, looked_at, motion=False, slopes=False)
    for name in pairs(scene):
        yield TreeCell(scene, engine_info(name), load_tree_engine(name, system), looked_at, facts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=1000)
    parser.add_argument("--count", type=int, default=240)
    given = parser.parse_args()
    worst, usual = defaultdict(list), defaultdict(list)
    for number in range(given.first, given.first + given.count):
        for cell in cells(number):
            for name, each in quotients(cell).items():
                worst[cell.info.name, name].append((float(each.max()), number))
                usual[cell.info.name, name].append(np.median(np.quantile(each.reshape(len(each), -1), 0.99, axis=0)))
    for (engine, name), found in worst.items():
        largest = ", ".join(f"{value:.3g} ({number})" for value, number in sorted(found, reverse=True)[:3])
        middle = np.median(usual[engine, name])
        print(f"{engine:20}{name:15}{len(found):5} mechanisms  99 %: {middle:.2g}  largest: {largest}")


if __name__ == "__main__":
    main()
