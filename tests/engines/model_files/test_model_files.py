"""The committed model files load in each engine that reads their language, and in MuJoCo's viewer."""

import mujoco
import numpy as np
import pinocchio
import pytest

from furiko.models import NLegPendulum, document_catalogue, find_scene, to_mjcf
from furiko.models.writers.catalogue_files import FOLDER


@pytest.mark.parametrize("name", document_catalogue())
def test_mjcf_loads_in_mujoco_and_can_be_drawn(name):
    model = mujoco.MjModel.from_xml_path(str(FOLDER / f"{name}.xml"))
    system = find_scene(name).system
    assert model.nv == system.n
    np.testing.assert_array_equal(model.body_mass[1:], system.masses)
    # What the viewer does with a model: fill a scene with what is to be seen.
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = mujoco.MjvScene(model, maxgeom=10_000)
    camera = mujoco.MjvCamera()
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), mujoco.MjvPerturb(), camera, mujoco.mjtCatBit.mjCAT_ALL.value, scene
    )
    assert scene.ngeom >= system.n, "every link is drawn"
    assert data.ncon == 0


@pytest.mark.parametrize("name", document_catalogue())
def test_urdf_loads_in_mujoco_and_pinocchio(name):
    path = str(FOLDER / f"{name}.urdf")
    system = find_scene(name).system
    assert mujoco.MjModel.from_xml_path(path).nv == system.n
    model = pinocchio.buildModelFromUrdf(path)
    assert model.nq == model.nv == system.n
    assert [inertia.mass for inertia in model.inertias][1:] == list(system.masses)


@pytest.mark.parametrize("length", [1e-7, 1e-12, 1e-30])
def test_mjcf_of_short_links_loads_in_mujoco(length):
    system = NLegPendulum((1.0, length), (1.0, 1.0))
    model = mujoco.MjModel.from_xml_string(to_mjcf(system))
    np.testing.assert_array_equal(model.body_ipos[1:, 2], [-1.0, -length])


@pytest.mark.parametrize("name", document_catalogue())
def test_mjcf_loads_in_pinocchio(name):
    model = pinocchio.buildModelFromMJCF(str(FOLDER / f"{name}.xml"))
    assert model.nv == find_scene(name).system.n
