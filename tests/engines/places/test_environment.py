"""Engines in an environment that is there: the same answers as here, told apart by version, and their failures."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from places import environment

import furiko
from furiko.engines import (
    all_of,
    engine_adapter,
    engine_info,
    engine_place,
    engine_version,
    load_tree_engine,
    why_missing,
)
from furiko.engines.places.connection import EngineFailed
from furiko.engines.places.names import place_of
from furiko.models import EngineMissing, InvalidInput, find_scene

pytest.importorskip("mujoco")
ROOT = Path(furiko.__file__).parent


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return environment(tmp_path_factory.mktemp("places") / "venv")


STATES = np.array([[0.3, -1.2], [2.0, 2.5], [0.0, 0.0]]), np.array([[0.5, 1.0], [0.0, 0.0], [3.0, -2.0]])


def test_a_double_pendulum_falls_as_by_hand(folder):
    # Two equal point masses, l = m = 1, both rods level and at rest: the first rod's end falls freely, and the second
    # turns with it: M = [[2, 1], [1, 1]], forces [-2 g, -g] → accelerations (-g, 0).
    engine = furiko.load_engine(f"{folder}:mujoco", furiko.NLegPendulum((1.0, 1.0), (1.0, 1.0)))
    found = engine.accelerations([np.pi / 2, np.pi / 2], [0.0, 0.0])
    assert found == pytest.approx([-9.81, 0.0], abs=1e-13)  # a few ε of 2 g


@pytest.mark.parametrize("name", ["mujoco", "pinocchio-aba", "pinocchio-aba-mjcf", "exudyn-tree", "exudyn-redundant"])
def test_every_question_has_the_answer_that_it_has_here(folder, name):
    pytest.importorskip(engine_info(name).module)
    system = furiko.RodChain((0.8, 0.5), 1.3)
    here, there = furiko.load_engine(name, system), furiko.load_engine(f"{folder}:{name}", system)
    theta, omega = STATES
    alpha = here.accelerations(theta, omega)
    assert np.array_equal(there.accelerations(theta, omega), alpha)
    missing = here.info.missing
    if "fields" not in missing:
        for field, value in vars(here.fields()).items():
            assert np.array_equal(getattr(there.fields(), field), value), field
    if "inverse_dynamics" not in missing:
        for gravity in (True, False):
            ours = here.inverse_dynamics(theta, omega, alpha, gravity=gravity)
            assert np.array_equal(there.inverse_dynamics(theta, omega, alpha, gravity=gravity), ours)
    if "joint_forces" not in missing:
        assert np.array_equal(there.joint_forces(theta, omega, alpha), here.joint_forces(theta, omega, alpha))
    if "energy" not in missing:
        assert np.array_equal(there.energy(theta, omega), here.energy(theta, omega))
    for scheme in here.info.integrators:
        for run in ("trajectory", "path"):
            ours, theirs = (getattr(e, run)(theta[0], omega[0], scheme.name, 1e-3, 5) for e in (here, there))
            assert np.array_equal(theirs, ours), (scheme.name, run)
    for scheme in here.info.adaptive:
        ours, theirs = (e.adaptive(theta[0], omega[0], scheme, 0.1, 1e-9) for e in (here, there))
        assert np.array_equal(theirs, ours)
    assert there.gap() == here.gap()


def test_open_mechanisms_too(folder):
    scene = find_scene("acrobot")
    here, there = (load_tree_engine(name, scene.system) for name in ("mujoco", f"{folder}:mujoco"))
    q, v = np.array([[0.3, -0.4]]), np.array([[1.0, 2.0]])
    for question in ("accelerations", "bias", "passive", "energy"):
        assert np.array_equal(getattr(there, question)(q, v), getattr(here, question)(q, v)), question
    assert np.array_equal(there.mass_matrix(q), here.mass_matrix(q))
    ends = (e.trajectory(q[0], v[0], "RK4", 1e-3, 5) for e in (here, there))
    assert np.array_equal(next(ends), next(ends))


def test_its_version_and_place_are_those_of_the_environment(folder):
    name = f"{folder}:mujoco"
    assert engine_version(name) == engine_version("mujoco")
    assert f"Python {sys.version_info.major}.{sys.version_info.minor}" in engine_place(name)
    assert str(folder) in engine_place(name)
    assert engine_place("mujoco") == ""
    assert engine_info(name).name == name


def test_nothing_of_furiko_is_needed_there(folder):
    # With NumPy and the engine alone: whatever else is installed cannot be imported.
    script = (
        "import sys; names = ('msgspec', 'flint', 'scipy', 'click', 'rich', 'jinja2', 'platformdirs');"
        "sys.modules.update(dict.fromkeys(names));"
        "start = sys.argv.pop(1); exec(compile(open(start).read().replace('__file__', repr(start)), start, 'exec'))"
    )
    start = str(ROOT / "engines" / "places" / "start.py")
    for adapter in ("furiko.engines.mujoco:Mujoco", "furiko.engines.trees.mujoco:MujocoTree"):
        command = [str(folder / "bin" / "python"), "-I", "-c", script, start, str(ROOT), "mujoco", adapter]
        from furiko.engines.places.messages import decode, encode
        from furiko.engines.workers.frames import HEADER, framed

        done = subprocess.run(
            command, input=framed(encode({"say": "hello", "protocol": 1})), capture_output=True, check=False
        )
        answer = decode(done.stdout[HEADER.size :])
        assert answer.head["say"] == "hello", done.stderr


def test_an_engine_that_died_is_started_again(folder):
    engine = furiko.load_engine(f"{folder}:mujoco", furiko.RodChain((0.8, 0.5)))
    before = engine.accelerations(*STATES)
    process = engine._engine.connection._process
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert np.array_equal(engine.accelerations(*STATES), before)
    assert engine._engine.connection._process.pid != process.pid


def test_models_that_nobody_needs_are_dropped(folder):
    engine = furiko.load_engine(f"{folder}:mujoco", furiko.RodChain((0.8, 0.5)))
    for length in (0.1, 0.2, 0.3):
        engine.of(furiko.RodChain((length, 0.5))).accelerations(*STATES)
    engine.accelerations(*STATES)
    assert engine._engine.connection._dropped == []


def test_refusals_of_the_adapter_arrive_as_they_are(folder):
    engine = furiko.load_engine(f"{folder}:mujoco", furiko.RodChain((0.8, 0.5)))
    with pytest.raises(InvalidInput) as ours:
        furiko.RodChain((-1.0,))
    with pytest.raises(InvalidInput) as theirs:
        engine._engine.connection.model({"kind": "rod-chain", "lengths": [-1.0], "density": 1.0, "gravity": 9.81})
    assert str(theirs.value) == str(ours.value)


def test_what_is_not_there_is_told(folder, tmp_path):
    assert "no environment" in why_missing(f"{tmp_path}/nowhere:mujoco")
    assert "has no bin/python" in why_missing(f"{tmp_path}:mujoco")
    with pytest.raises(InvalidInput, match="did you mean 'mujoco'"):
        engine_info(f"{folder}:mujocoo")
    with pytest.raises(InvalidInput, match=r"name one, .*pinocchio-aba@3.9, .*pinocchio-crba@3.9"):
        engine_info("pin@3.9")
    with pytest.raises(InvalidInput, match="is no version"):
        engine_info("mujoco@new")


def test_a_python_without_the_engine_is_told(tmp_path):
    import venv

    venv.create(tmp_path / "bare", symlinks=True, with_pip=False)
    why = why_missing(f"{tmp_path}/bare:mujoco")
    assert why.startswith("not installed: mujoco is not in ")
    with pytest.raises(EngineMissing):
        engine_adapter(f"{tmp_path}/bare:mujoco")


def test_a_python_that_is_none_is_told(tmp_path):
    fake = tmp_path / "odd" / "bin" / "python"
    fake.parent.mkdir(parents=True)
    for text, words in (("#!/bin/sh\necho nonsense", "no Python that answers"), ("", "cannot be started")):
        fake.write_text(text)
        fake.chmod(0o755)
        from furiko.engines.places.surveys import survey

        survey.cache_clear()
        assert words in why_missing(f"{tmp_path}/odd:mujoco")


def test_an_old_python_is_told(tmp_path):
    fake = tmp_path / "old" / "bin" / "python"
    fake.parent.mkdir(parents=True)
    fake.write_text('#!/bin/sh\necho \'{"version": "3.8.18", "path": [], "packages": {}}\'\n')
    fake.chmod(0o755)
    assert "its Python is 3.8.18; the adapters need 3.10 or newer" in why_missing(f"{tmp_path}/old:mujoco")


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("mujoco@3.3.7", "version"),
        ("pinocchio-aba@4", "version"),
        ("./venv:mujoco", "environment"),
        ("/opt/x:mujoco", "environment"),
        ("./program", "program"),
        ("package.module:Class", None),
        ("./adapter.py", None),
        ("./adapter.py:Class", None),
        ("mujoco", None),
        ("my-plugin", None),
    ],
)
def test_names(name, kind):
    place = place_of(name)
    assert (place.kind if place else None) == kind


def test_a_package_means_all_its_formulations():
    aba, mjcf, crba = "pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba"
    assert all_of(["pin@3.9", "mujoco"]) == [f"{aba}@3.9", f"{mjcf}@3.9", f"{crba}@3.9", "mujoco"]
    assert all_of(["./venv:pin"]) == [f"./venv:{aba}", f"./venv:{mjcf}", f"./venv:{crba}"]
    assert all_of(["exudyn", "exudyn-tree"]) == ["exudyn-tree", "exudyn-redundant"]
    assert all_of(["mujoco@3.3.7", "./x.py", "a:B"]) == ["mujoco@3.3.7", "./x.py", "a:B"]


def test_failures_over_there_bring_their_traceback(folder):
    engine = furiko.load_engine(f"{folder}:mujoco", furiko.RodChain((0.8, 0.5)))
    with pytest.raises(EngineFailed, match="KeyError") as found:
        engine._engine.connection.ask({"say": "ask", "model": 10**6, "question": "accelerations"})
    assert any("in _ask" in note for note in found.value.__notes__)
