"""roboticstoolbox-python as an engine of furiko: an exhibit, for its bias forces are wrong where an axis is along −y.

    pip install roboticstoolbox-python==1.5.0 furiko
    furiko check -e roboticstoolbox_engine.py double-pendulum rods-3

furiko's hinges turn about (0, −1, 0). There ``rne`` gives Coriolis and gravity terms with the opposite sign, and the
mass matrix as it is; so both differ, and accelerations. The cause is named as angles of the opposite sign, which is
the same: M is even in the angles, and both other terms are odd.
"""

import tempfile
from pathlib import Path

import numpy as np
import roboticstoolbox

from furiko.engines import EngineInfo
from furiko.engines.coordinates import RelativeCoordinates
from furiko.models import to_urdf

OTHERS = ("fields", "joint_forces", "energy", "trajectory")


class RoboticsToolbox:
    """Accelerations by the library's own mass matrix and bias forces."""

    info = EngineInfo(
        name="roboticstoolbox",
        formulation="recursive Newton-Euler, and the mass matrix from it; model from URDF",
        adapter="roboticstoolbox_engine:RoboticsToolbox",
        module="roboticstoolbox",
        package="roboticstoolbox-python",
        homepage="https://github.com/petercorke/robotics-toolbox-python",
        coordinates="relative",
        interchanges=True,
        algorithm="other",
        missing=dict.fromkeys(OTHERS, "this adapter asks for dynamics alone"),
        largest_n=5,
        largest_n_reason="a state takes milliseconds",
    )

    def __init__(self, system):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "mechanism.urdf")
            path.write_text(to_urdf(system), encoding="utf-8")
            self._robot = roboticstoolbox.Robot.URDF(str(path))
        names = [link.name for link in self._robot.links if link.isjoint]
        tree = system.tree()
        self._gravity = system.gravity * np.sign(self._robot.gravity)  # along z, counted as the library counts it
        self._coordinates = RelativeCoordinates(tree.parents, [names.index(name) for name in tree.names("link")])

    def accelerations(self, theta, omega):
        found = np.empty_like(theta)
        for row, (q, v) in enumerate(self._coordinates.rows(theta, omega)):
            bias = self._robot.rne(q, v, np.zeros_like(q), gravity=self._gravity)
            found[row] = np.linalg.solve(self._robot.inertia(q), -np.asarray(bias).ravel())
        return self._coordinates.absolute(found)

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        found = np.empty_like(theta)
        pull = self._gravity if gravity else np.zeros(3)
        for row, (q, v, a) in enumerate(self._coordinates.rows(theta, omega, alpha)):
            found[row] = np.asarray(self._robot.rne(q, v, a, gravity=pull)).ravel()
        return self._coordinates.absolute_forces(found)
