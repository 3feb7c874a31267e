"""Five planted faults, and what each says on the first screen of page, terminal, Markdown and JUnit.

``PYTHONPATH=tests python tests/planted_answers.py`` prints the table in ``docs/reference/measured.md``. The first four
are MuJoCo, made of another mechanism than was asked for, or with its answers tampered with; the fifth is Pinocchio's
own.
"""

import os
from contextlib import chdir, redirect_stdout
from dataclasses import dataclass, replace
from html import unescape
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

import numpy as np

import furiko
from furiko.engines import engine_info
from furiko.engines.mujoco import Mujoco
from furiko.models import RodChain
from furiko.reports.terminal.check import print_report

# Pinocchio's reader of MJCF takes no joint's position from a default, so the elbow is 0.1 m too low.
ARM = """<mujoco><default><joint pos="0 0 0.1"/></default><worldbody><body name="upper">
<joint name="shoulder" axis="0 1 0" pos="0 0 0"/><inertial pos="0 0 -0.5" mass="1" diaginertia="0.1 0.1 0.01"/>
<body name="lower" pos="0 0 -1"><joint name="elbow" axis="0 1 0"/>
<inertial pos="0 0 -0.4" mass="1" diaginertia="0.1 0.1 0.01"/></body></body></worldbody></mujoco>
"""
SCREEN = 24  # lines of a terminal


def _info(name):
    return replace(engine_info("mujoco"), name=name, adapter=f"planted_answers:{name}", tree=None)


class GravityAndMasses(Mujoco):
    """Gravity is 9.80 and not 9.81, and every mass is a part in a thousand too large."""

    info = _info("GravityAndMasses")

    def __init__(self, system):
        heavier = (
            {"density": 1.001 * system.density}
            if isinstance(system, RodChain)
            else {"masses": tuple(1.001 * mass for mass in system.masses)}
        )
        super().__init__(replace(system, gravity=9.80, **heavier))


class Length(Mujoco):
    """The first link is a part in a hundred too long."""

    info = _info("Length")

    def __init__(self, system):
        super().__init__(replace(system, lengths=(1.01 * system.lengths[0], *system.lengths[1:])))


class Sign(Mujoco):
    """Its velocity terms have the wrong sign in the accelerations."""

    info = _info("Sign")

    def accelerations(self, theta, omega):
        at_rest = super().accelerations(theta, np.zeros_like(omega))
        return 2 * at_rest - super().accelerations(theta, omega)


class Crash(Mujoco):
    """Takes its process along."""

    info = _info("Crash")

    def accelerations(self, theta, omega):
        os.abort()


@dataclass(frozen=True)
class Planted:
    """A fault in words, the engine that has it, and the scene in which it is looked for."""

    says: str
    engine: str
    scene: str = "rods-3"


FAULTS = (
    Planted("gravity 9.80, not 9.81, and every mass 0.1 % too large", "planted_answers:GravityAndMasses"),
    Planted("the first link 1 % too long", "planted_answers:Length", "double-pendulum"),
    Planted("velocity terms of the wrong sign in the accelerations", "planted_answers:Sign"),
    Planted("the engine's process dies", "planted_answers:Crash"),
    Planted("Pinocchio reads a joint's default otherwise", "pinocchio-aba", "arm.toml"),
)


@dataclass(frozen=True)
class Shown:
    """Of one run: the lines of its causes or failures, the first message of JUnit, and the folder's first screens."""

    lines: tuple[str, ...]
    junit: str
    terminal: str
    markdown: str


def shown(fault: Planted, folder: Path) -> Shown:
    """Run ``furiko check`` with the fault beside an engine that is right; its files are left in the folder."""
    (folder / "arm.xml").write_text(ARM)
    (folder / "arm.toml").write_text('[system]\nkind = "tree"\nmodel = "arm.xml"\n')
    with chdir(folder):
        report = furiko.check([fault.scene], [fault.engine, "exudyn-tree"], out=".", use_cache=False)
        said = StringIO()
        with redirect_stdout(said):
            print_report(report, path=Path("report.html"))
    place = f"{folder}{os.sep}"  # a file's own folder says nothing
    explained = [line for e in report.causes.explanations for line in (e.headline, *e.lines)]
    failed = [reason for reason, _ in report.reasons("error")]
    elements = ElementTree.parse(folder / "junit.xml").iter()
    bad = next(element for element in elements if element.tag in ("failure", "error"))
    return Shown(
        tuple(line.replace(place, "") for line in (*explained, *failed)),
        bad.get("message", "").replace(place, ""),
        _screen(said.getvalue().replace(place, "")),
        _screen(unescape((folder / "report.md").read_text(encoding="utf-8")).replace(place, "")),
    )


def _screen(text: str) -> str:
    return "\n".join(text.splitlines()[:SCREEN])


def table(found: list[tuple[Planted, Shown]]) -> str:
    """Each fault, what page, terminal and Markdown say of it, and JUnit's message."""
    rows = [
        (fault.says, "<br>".join(one.lines).replace("planted_answers:", ""), one.junit.replace("planted_answers:", ""))
        for fault, one in found
    ]
    lines = [("planted", "first screen of page, terminal and Markdown", "first message of JUnit"), ("---",) * 3, *rows]
    return "\n".join(f"| {' | '.join(cell.replace('<joint', '&lt;joint') for cell in line)} |" for line in lines)


def main() -> None:
    found = []
    for fault in FAULTS:
        with TemporaryDirectory() as folder:
            found.append((fault, shown(fault, Path(folder))))
    print(table(found))


if __name__ == "__main__":
    main()
