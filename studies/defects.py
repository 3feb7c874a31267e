"""Defects of engines, each measured anew on what is installed, with the smallest input that shows it.

The text of the input is the program that is run: what stands in the table is what was measured. A defect that is gone
is not reported.
"""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from dataclasses import dataclass

LONGEST = 120.0  # seconds


@dataclass(frozen=True)
class Probe:
    """``program``: prints the engine's version, what is expected and what it gives, as JSON [version, [...], [...]].

    ``module``: the engine's; ``derivation``: of what is expected; ``close``: what both may differ by, relative to the
    largest, where there is no defect.
    """

    engine: str
    module: str
    title: str
    what: str
    program: str
    derivation: str
    close: float


@dataclass(frozen=True)
class Measured:
    """A probe's outcome on the installed version."""

    probe: Probe
    version: str
    expected: tuple[float, ...]
    got: tuple[float, ...]

    @property
    def shows(self) -> bool:
        """Whether the defect is there."""
        size = max(map(abs, self.expected), default=0.0)
        off = (abs(a - b) for a, b in zip(self.expected, self.got, strict=True))
        return not all(difference <= self.probe.close * size for difference in off)


PROBES = (
    Probe(
        engine="Pinocchio",
        module="pinocchio",
        title="derivatives of a JointModelComposite are not those of its accelerations",
        what="`computeABADerivatives` differentiates a composite joint as if the columns of its motion subspace stood "
        "still in the moved frame; those of its first joints do not, when a later joint moves. So `ddq_dq` and "
        "`ddq_dv` are wrong, silently, wherever the MJCF reader meets several joints on one body, while `aba` is "
        "right. Two joints in a row, in the place of one composite, give the right derivatives.",
        program="""
import json

import numpy as np
import pinocchio as pin

joint = pin.JointModelComposite()
joint.addJoint(pin.JointModelRX(), pin.SE3.Identity())
joint.addJoint(pin.JointModelRY(), pin.SE3.Identity())
model = pin.Model()
index = model.addJoint(0, joint, pin.SE3.Identity(), "universal")
body = pin.Inertia(1.0, np.array([0.1, 0.2, -0.5]), np.diag([0.1, 0.2, 0.3]))
model.appendBodyToJoint(index, body, pin.SE3.Identity())
data, q, v, tau, h = model.createData(), np.array([0.3, 0.4]), np.array([1.0, 2.0]), np.zeros(2), 1e-5
pin.computeABADerivatives(model, data, q, v, tau)
got = data.ddq_dq.copy()
step = h * np.eye(2)
columns = [(pin.aba(model, data, q + e, v, tau) - pin.aba(model, data, q - e, v, tau)) / (2 * h) for e in step]
print(json.dumps([pin.__version__, np.array(columns).T.ravel().tolist(), got.ravel().tolist()]))
""",
        derivation="∂a/∂q by central differences of the engine's own `aba`, good to nine digits; two joints RX, RY in "
        "a row give the same by `computeABADerivatives`, and so does furiko's proof in ball arithmetic",
        close=1e-6,  # central differences with a step of 1e-5
    ),
    Probe(
        engine="roboticstoolbox-python",
        module="roboticstoolbox",
        title="bias forces have the wrong sign for a URDF joint whose axis is −y",
        what="`rne` of a robot from URDF gives Coriolis and gravity terms with the opposite sign where a joint's axis "
        'is `"0 -1 0"`, while the mass matrix is right. So `accel` is wrong, silently. With `"0 1 0"` all is right.',
        program='''
import json
import tempfile
from importlib.metadata import version
from pathlib import Path

import numpy as np
import roboticstoolbox as rtb

LINK = """<link name="{name}"><inertial><origin xyz="0 0 -1"/><mass value="1"/>
  <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
JOINT = """<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 -1 0"/>
  <origin xyz="0 0 {z}"/><limit lower="-9" upper="9" effort="1" velocity="1"/></joint>"""
text = "<robot name='two'><link name='base'/>" + LINK.format(name="a") + LINK.format(name="b")
text += JOINT.format(name="j1", parent="base", child="a", z=0)
text += JOINT.format(name="j2", parent="a", child="b", z=-1) + "</robot>"
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder, "two.urdf")
    path.write_text(text)
    robot = rtb.Robot.URDF(str(path))
q, v = np.array([0.3, 0.5]), np.array([1.0, 2.0])
got = robot.rne(q, v, np.zeros(2), gravity=[0, 0, 0])
s = np.sin(q[1])  # two point masses of 1 kg on rods of 1 m: by hand, from Lagrange's equations
expected = [-s * (2 * v[0] * v[1] + v[1] ** 2), s * v[0] ** 2]
print(json.dumps([version("roboticstoolbox-python"), expected, np.asarray(got).ravel().tolist()]))
''',
        derivation="by hand, of two point masses: −m l² sin q₂ (2 v₁ v₂ + v₂²) and m l² sin q₂ v₁²; Christoffel's "
        "symbols of the robot's own `inertia` give the same",
        close=1e-9,
    ),
)


def measured(python: str = sys.executable) -> list[Measured]:
    """The defects that are there, of the engines that ``python`` has. Each runs in a process of its own."""
    found = []
    for probe in PROBES:
        if python == sys.executable and importlib.util.find_spec(probe.module) is None:
            continue
        outcome = run(probe, python)
        if outcome is not None and outcome.shows:
            found.append(outcome)
    return found


def run(probe: Probe, python: str = sys.executable) -> Measured | None:
    """A probe's outcome; None where its engine does not run there."""
    command = [python, "-c", probe.program]
    made = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
    if made.returncode:
        return None
    try:
        version, expected, got = json.loads(made.stdout.strip().splitlines()[-1])
        return Measured(probe, str(version), tuple(map(float, expected)), tuple(map(float, got)))
    except (ValueError, IndexError, TypeError):
        return None
