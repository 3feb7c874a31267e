"""What adapters of trees say that links exert on what carries them: sign, axes and point, by hand."""

import numpy as np
import pytest

from furiko.engines import engine_version, load_tree_engine
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem

ENGINES = ("mujoco", "pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba")
G = 9.81


def arm():
    """A link of 2 kg that turns about z, its anchor beside its origin, far from the world's; and one of 3 kg on it.

    The second slides along the first's x axis, which is the world's y axis in the reference configuration.
    """
    quarter = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))
    turning = TreeJoint("turning", axis=(0.0, 0.0, 1.0), anchor=(0.25, 0.0, 0.0), armature=0.5)
    first = TreeLink("first", -1, (3.0, 4.0, 5.0), quarter, 2.0, (0.5, 0.0, 0.0), (0.1, 0.2, 0.3, 0, 0, 0), (turning,))
    slide = TreeJoint("slide", "slide", axis=(1.0, 0.0, 0.0), anchor=(0.0, 0.5, 0.0))
    second = TreeLink("second", 0, (1.0, 0.0, 0.0), mass=3.0, inertia=(0.1,) * 3 + (0.0,) * 3, joints=(slide,))
    return TreeSystem((first, second), (0.0, 0.0, -G))


@pytest.fixture(params=ENGINES)
def ask(request):
    if not engine_version(request.param):
        pytest.skip(f"{request.param} is not installed")
    engine = load_tree_engine(request.param, arm())
    return lambda q, v, a: engine.joint_forces(np.array([q]), np.array([v]), np.array([a]))[0]


def test_at_rest_they_carry_weights(ask):
    """In the world the first link lies along y. Moments about each link's origin: r × F, r along y, is about −x."""
    first, second = ask([0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
    assert second == pytest.approx([0, 0, -3 * G, 0, 0, 0], abs=1e-13)
    assert first == pytest.approx([0, 0, -5 * G, -(0.5 * 2 + 1.0 * 3) * G, 0, 0], abs=1e-13)


def test_in_motion_they_pull_outwards_and_push_back(ask):
    """ω = 2 about the anchor: the centres are 0.25 and 0.75 m from it, along y, and are pulled at by m ω² r.

    A slide's acceleration of 1.5 pushes back along −y; turning by 4 rad/s² along +x, as y turns to −x, and about z by
    (I + m r s) α, r from the anchor, s from the origin. Coriolis' force of the slide's 0.5 m/s, 2 m ω v, along +x, too.
    """
    first, second = ask([0.0, 0.0], [2.0, 0.5], [4.0, 1.5])
    outwards, across = 3 * (4 * 0.75 - 1.5), 3 * (4 * 0.75 + 2 * 2 * 0.5)
    assert second == pytest.approx([across, outwards, -3 * G, 0, 0, -0.1 * 4], abs=1e-13)
    whole = [across + 2 * 4 * 0.25, outwards + 2 * 4 * 0.25, -5 * G]
    about_z = -0.1 * 4 - 1.0 * across - 0.3 * 4 - 0.5 * 2 * 4 * 0.25
    assert first == pytest.approx([*whole, -(0.5 * 2 + 1.0 * 3) * G, 0, about_z], abs=1e-13)
