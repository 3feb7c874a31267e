"""``furiko engine-test``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES, DIFFERS
from .options import engine_names, found_here, json_option
from .output import print_json, print_text

if TYPE_CHECKING:
    from ..records.listings import ConformanceStep

SIGNS = {"right": "✓", "wrong": "✗", "note": "!", "skipped": "-"}


@click.command(name="engine-test")
@click.argument("engine", metavar="ENGINE", callback=found_here, shell_complete=engine_names)
@click.option("--timeout", type=click.FloatRange(min=1), default=60.0, show_default=True, help="Seconds for each step.")
@json_option
def engine_test(engine: str, timeout: float, as_json: bool) -> int:
    """Test an adapter, step by step, before its engine is judged.

    Tests shapes, buffers, order, signs, units, coordinates and runs. ENGINE: a name that `furiko engines`
    lists, a file with one adapter (./my_adapter.py), or module:Class. The exit status is 1 where the adapter is wrong.

    An adapter is a class with one method; what it leaves out is skipped, with that reason. In place of furiko's own
    equations put what your engine computes:

    \b
        # my_engine.py
        from furiko import accelerations
        from furiko.engines import EngineInfo
        class MyEngine:
            info = EngineInfo(
                name="mine", formulation="", adapter="my_engine:MyEngine", module="",
                package="", homepage="",
                coordinates="absolute",  # it solves in: or "relative", "maximal"
            )
            def __init__(self, system):  # system.tree() has its links, in SI units
                self.system = system
            def accelerations(self, theta, omega):  # absolute angles, a state a row
                return accelerations(self.system, theta, omega)  # your engine's here
    """
    from ..checks.conformance.kit import engine_test as test

    def say(step: ConformanceStep) -> None:
        if not as_json:
            print_text(f"{SIGNS[step.outcome]} {step.step}: {step.says}")
            if step.help:
                print_text(f"    {step.help}")

    found = test(engine, timeout, say)
    if as_json:
        print_json(found)
    elif found.conforms:
        print_text(f"The adapter conforms. What the engine is worth: furiko check -e {engine}")
    else:
        wrong = sum(step.outcome == "wrong" for step in found.steps)
        print_text(f"The adapter is wrong in {wrong} step{'s' * (wrong > 1)}: mend the first one first.")
    return AGREES if found.conforms else DIFFERS
