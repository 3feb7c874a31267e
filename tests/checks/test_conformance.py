"""``furiko engine-test``: sound adapters conform, and each broken one is told what is wrong with it."""

import json
import math
from types import SimpleNamespace

import fake_engines
import pytest
from broken_adapters import BROKEN, IN_A_PROCESS
from click.testing import CliRunner

from furiko.checks.conformance.kit import PARTS, engine_test, steps
from furiko.checks.conformance.slopes import derivatives
from furiko.checks.conformance.subject import MECHANISMS, Wrong
from furiko.cli.main import cli
from furiko.engines import ENGINES, elsewhere, engine_info, load_engine, plugin_names
from furiko.models import InvalidInput, RodChain

ADAPTER = """
import numpy as np
from furiko.engines import EngineInfo

class Rod:
    info = EngineInfo(
        name="rod", formulation="closed form of one rod", adapter="", module="", package="", homepage="",
        coordinates="absolute", largest_n=1, largest_n_reason="it is a closed form of one rod",
        missing=dict.fromkeys(
            ("fields", "inverse_dynamics", "joint_forces", "energy", "trajectory"), "accelerations only"
        ),
    )

    def __init__(self, system):
        self.rate = -1.5 * system.gravity / system.lengths[0]

    def accelerations(self, theta, omega):
        return self.rate * np.sin(theta)
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["fake_engines:Right", *ENGINES])
def test_sound_adapters_conform(name):
    pytest.importorskip(engine_info(name).module or "numpy")
    found = list(steps(name))
    assert [step.step for step in found] == [part.step for part in PARTS]
    assert [step for step in found if step.outcome == "wrong"] == []
    assert {step.step: step.outcome for step in found}["accelerations"] == "right"


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in BROKEN if name not in IN_A_PROCESS])
def test_each_broken_adapter_is_told_what_is_wrong(name):
    step, word = BROKEN[name]
    found = {each.step: each for each in steps(f"broken_adapters:{name}")}
    assert found[step].outcome == "wrong", found
    assert word in found[step].says + found[step].help, found[step]
    earlier = [part.step for part in PARTS][: [part.step for part in PARTS].index(step)]
    assert all(found[before].outcome in ("right", "skipped") for before in earlier), found


@pytest.mark.slow
@pytest.mark.parametrize("name", IN_A_PROCESS)
def test_a_crash_or_a_hang_is_its_step_s_outcome(name):
    step, _ = BROKEN[name]
    found = engine_test(f"broken_adapters:{name}", timeout=5)
    assert not found.conforms
    assert (found.steps[-1].step, found.steps[-1].outcome) == (step, "wrong"), found


def test_a_file_is_an_engine(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rod.py").write_text(ADAPTER, encoding="utf-8")
    answer = CliRunner().invoke(cli, ["engine-test", "rod.py", "--json"], standalone_mode=False)
    document = json.loads(answer.output)
    assert document["conforms"] is True, document
    assert answer.return_value == 0
    assert engine_info("rod.py:Rod").name == "rod"
    with pytest.raises(InvalidInput, match="did you mean 'Rod'"):
        engine_info("rod.py:Rode")


def test_a_file_with_two_adapters_needs_a_name(tmp_path):
    path = tmp_path / "two.py"
    path.write_text(ADAPTER + "\n\nclass Other(Rod):\n    pass\n", encoding="utf-8")
    with pytest.raises(InvalidInput, match="several adapters"):
        engine_info(str(path))
    assert engine_info(f"{path}:Other").name == "rod"


@pytest.mark.parametrize(
    ("text", "says"),
    [("import nowhere_at_all\n", "nowhere_at_all"), ("x = 1\n", "no class"), ("1/0\n", "ZeroDivisionError")],
)
def test_a_file_that_is_no_adapter_is_one_line(tmp_path, text, says):
    path = tmp_path / "bad.py"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInput, match=says):
        engine_info(str(path))


def test_a_plug_in_is_an_engine_by_its_name(tmp_path, monkeypatch):
    """As an installed package declares it; what its info calls the adapter is its own affair."""
    (tmp_path / "rod_package.py").write_text(ADAPTER, encoding="utf-8")
    metadata = tmp_path / "rod_package-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: rod-package\nVersion: 1.0\n", encoding="utf-8")
    points = "[furiko.engines]\nplugged-rod = rod_package:Rod\nmujoco = rod_package:Rod\n"
    (metadata / "entry_points.txt").write_text(points, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    elsewhere._plugins.cache_clear()
    try:
        assert plugin_names() == ["plugged-rod"]  # furiko's own engines keep their names
        found = list(steps("plugged-rod"))
        assert [step for step in found if step.outcome == "wrong"] == []
        assert [step.outcome for step in found if step.step == "accelerations"] == ["right"]
        rod = load_engine("plugged-rod", RodChain([0.5]))
        # θ̈ = −(3/2)(g/l) sin θ
        assert rod.accelerations([1.0], [0.0])[0] == pytest.approx(-1.5 * 9.81 / 0.5 * math.sin(1.0), rel=1e-15)
    finally:
        elsewhere._plugins.cache_clear()


def test_own_equations_are_refused_in_one_line():
    (found,) = steps("own equations")
    assert found.outcome == "wrong"
    assert "no engine of their own" in found.says


def test_rounding_of_a_derivative_that_is_zero_is_no_mistake_of_an_adapter():
    """∂θ̈/∂θ̇ of one rod: held beside the rod's natural rate, since there is no other number of its unit."""

    class Rounds(fake_engines.Right):
        more = 1e-20

        def derivatives(self, theta, omega):
            by_angles, by_rates = super().derivatives(theta, omega)
            return by_angles, by_rates + self.more

    engine = Rounds(MECHANISMS["one rod"])
    assert derivatives(SimpleNamespace(engines={"one rod": engine})).outcome == "right"
    engine.more = 1e-3
    with pytest.raises(Wrong, match="by rates"):
        derivatives(SimpleNamespace(engines={"one rod": engine}))
