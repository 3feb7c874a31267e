import subprocess
import sys
import types

import numpy as np
import pytest

from furiko.engines import ENGINES, cannot, engine_info, engine_names, engine_version, load_engine
from furiko.models import EngineMissing, InvalidInput, NLegPendulum, RodChain


def test_the_six_formulations():
    assert engine_names() == [
        "mujoco",
        "pinocchio-aba",
        "pinocchio-aba-mjcf",
        "pinocchio-crba",
        "exudyn-tree",
        "exudyn-redundant",
    ]
    assert all(engine_info(name).name == name for name in engine_names())


def test_nothing_but_asking_for_an_engine_imports_one():
    seen = "import sys; print([m for m in ('mujoco', 'pinocchio', 'exudyn') if m in sys.modules])"
    asked = "import furiko.engines as e; [(e.engine_info(n), e.engine_version(n)) for n in e.engine_names()]; "
    ran = subprocess.run([sys.executable, "-c", asked + seen], capture_output=True, text=True, check=True)
    assert ran.stdout == "[]\n"


@pytest.mark.parametrize(("asked", "meant"), [("mujoko", "mujoco"), ("exudyn-tre", "exudyn-tree"), ("", "there are")])
def test_an_unknown_engine(asked, meant):
    with pytest.raises(InvalidInput, match=meant):
        load_engine(asked, RodChain((1.0,)))


@pytest.mark.parametrize("name", ["mujoco", "exudyn-tree", "pinocchio-crba"])
def test_an_engine_that_is_not_installed(name, monkeypatch):
    info = engine_info(name)
    monkeypatch.setitem(sys.modules, info.module, None)
    with pytest.raises(EngineMissing, match=rf"pip install 'furiko\[{info.package}\]'"):
        load_engine(name, RodChain((1.0,)))


def test_the_unrelated_package_called_pinocchio(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", types.ModuleType("pinocchio"))
    with pytest.raises(EngineMissing, match=r"pip install 'furiko\[pin\]' \(.*unrelated.*pip uninstall pinocchio"):
        load_engine("pinocchio-aba", RodChain((1.0,)))


def test_an_engine_whose_library_the_system_lacks(monkeypatch):
    """What a slim container says of Pinocchio: to install it again would not help."""

    def fails(name):
        raise ImportError("libgomp.so.1: cannot open shared object file: No such file or directory")

    monkeypatch.setattr("furiko.engines.registry.importlib.import_module", fails)
    with pytest.raises(EngineMissing) as caught:
        load_engine("pinocchio-aba", RodChain((1.0,)))
    version = engine_version("pinocchio-aba")
    assert str(caught.value).startswith(
        f"pinocchio-aba: pin {version} is installed and cannot be imported: libgomp.so.1"
    )
    assert "the system lacks the library libgomp.so.1" in str(caught.value)
    assert "pip install" not in str(caught.value)


def test_versions_without_importing():
    import importlib.metadata

    assert engine_version("pinocchio-aba") == importlib.metadata.version("pin")


def test_the_version_of_what_is_not_installed_is_empty(monkeypatch):
    import dataclasses

    absent = dataclasses.replace(ENGINES["mujoco"], package="furiko-no-such-package")
    monkeypatch.setitem(ENGINES, "mujoco", absent)
    assert engine_version("mujoco") == ""


def test_too_many_links_are_refused_before_the_engine_is_touched(engine, monkeypatch):
    monkeypatch.setitem(sys.modules, engine_info(engine).module, None)  # an import would raise EngineMissing
    n = engine_info(engine).largest_n + 1
    with pytest.raises(InvalidInput, match=rf"at most {n - 1} links, not {n}: \w"):
        load_engine(engine, RodChain((0.1,) * n))


def test_what_mujoco_cannot_weigh():
    mujoco = engine_info("mujoco")
    assert "1e-16 (link 2)" in cannot(mujoco, NLegPendulum((1.0, 1.0), (1.0, 1e-16)))
    assert "kg m²" in cannot(mujoco, RodChain((1.0, 1e-5)))  # mass 1e-5 kg, inertia about the hinge 3e-16 kg m²
    assert cannot(mujoco, RodChain((1.0, 1e-4))) is None
    with pytest.raises(InvalidInput, match="link 2"):
        load_engine("mujoco", RodChain((1.0, 1e-5)))


@pytest.mark.parametrize("name", ["pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba"])
def test_what_pinocchio_cannot_weigh(name):
    light = NLegPendulum((1.0, 1.0), (1.0, 1e-16))
    assert "2.22045e-16 kg, not 1e-16 (link 2): it divides" in cannot(engine_info(name), light)
    # The least that it takes, and there it compiles what it was asked for.
    least = NLegPendulum((1.0, 0.5), (1.0, 2.0**-52))
    np.testing.assert_array_equal(load_engine(name, least).fields().centres[:, 0], least.lengths)


OWN_ENGINE = """
from furiko.engines import EngineInfo
class Still:
    info = EngineInfo("still", "does nothing", "", "", "", "", "absolute")
    def __init__(self, system): pass
    def accelerations(self, theta, omega): return 0 * theta
class Bare:
    pass
"""


@pytest.fixture
def own_engine(tmp_path, monkeypatch):
    (tmp_path / "own_engine.py").write_text(OWN_ENGINE)
    monkeypatch.syspath_prepend(str(tmp_path))
    yield "own_engine"
    sys.modules.pop("own_engine", None)


def test_an_engine_of_ones_own(own_engine):
    still = load_engine(f"{own_engine}:Still", RodChain((1.0, 2.0)))
    assert still.info.name == "still"
    assert engine_version(f"{own_engine}:Still") == ""
    np.testing.assert_array_equal(still.accelerations([1.0, 2.0], [0.0, 0.0]), [0.0, 0.0])


@pytest.mark.parametrize(
    ("path", "says"),
    [("own_engine:Bare", "info"), ("own_engine:Nobody", "Nobody"), ("no_such_module:X", "no_such_module"), (":X", "X")],
)
def test_what_is_no_engine_of_ones_own(own_engine, path, says):
    with pytest.raises(InvalidInput, match=says):
        engine_info(path)
