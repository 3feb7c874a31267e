"""What differs between versions of MuJoCo, in the plainest objects that have it."""

import numpy as np
import pytest

pytest.importorskip("mujoco")
import mujoco

from furiko.engines.trees.mujoco import _keep_tensor


def test_a_tensor_that_was_not_turned_to_the_end_is_turned_anew():
    """MuJoCo 3.3.7 leaves products of 1e-7; here the frame is off by 1e-4, and the moments are those of before."""
    body = "<body><joint/><inertial pos='0 0 0' mass='1' fullinertia='2 3 4 0.3 0.2 0.1'/></body>"
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{body}</worldbody></mujoco>")
    tensor = np.array([[2, 0.3, 0.2], [0.3, 3, 0.1], [0.2, 0.1, 4.0]])

    def held():
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, model.body_iquat[1])
        axes = turn.reshape(3, 3)
        return axes @ np.diag(model.body_inertia[1]) @ axes.T

    before = model.body_iquat[1].copy()
    _keep_tensor(model, 1, tensor)
    if mujoco.mj_version() >= 400:
        assert (model.body_iquat[1] == before).all()
    model.body_iquat[1, 1] += 1e-4
    assert np.abs(held() - tensor).max() > 1e-5
    _keep_tensor(model, 1, tensor)
    assert np.abs(held() - tensor).max() < 1e-14
    assert np.linalg.norm(model.body_iquat[1]) == pytest.approx(1, abs=1e-15)
