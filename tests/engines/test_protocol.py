"""The example in the protocol's docstring is a working adapter."""

import subprocess
import sys
import textwrap

import numpy as np
import pytest

from furiko.engines import load_engine, protocol
from furiko.models import InvalidInput, NLegPendulum, RodChain


@pytest.fixture
def example(tmp_path, monkeypatch):
    _, _, code = protocol.__doc__.partition("::\n\n")
    (tmp_path / "my_adapter.py").write_text(textwrap.dedent(code), encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    return "my_adapter:MyMujoco"


@pytest.mark.parametrize("system", [RodChain((1.0, 0.5, 0.7)), NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))])
def test_the_example_is_an_adapter(example, system):
    theta, omega = np.random.default_rng(3).normal(size=(2, 4, system.n))
    found = load_engine(example, system).accelerations(theta, omega)
    assert found == pytest.approx(load_engine("mujoco", system).accelerations(theta, omega), rel=1e-9)


def test_its_missing_questions_are_refused_with_its_reason(example):
    engine = load_engine(example, RodChain((1.0, 1.0)))
    with pytest.raises(InvalidInput, match="this adapter computes accelerations only"):
        engine.energy([0.0, 0.0], [0.0, 0.0])


@pytest.mark.slow
def test_it_is_checked_from_the_folder_where_it_is_and_what_it_lacks_is_skipped(tmp_path):
    _, _, code = protocol.__doc__.partition("::\n\n")
    (tmp_path / "my_adapter.py").write_text(textwrap.dedent(code), encoding="utf-8")
    command = ["furiko", "check", "rods-2"]
    done = run([*command, "-e", "my_adapter:MyMujoco"], tmp_path)
    assert done.returncode == 0, done
    assert "this adapter computes accelerations only" in done.stdout
    assert "Failed" not in done.stdout
    missing = run([*command, "-e", "my_adaptor:MyMujoco"], tmp_path)
    assert missing.returncode == 2
    assert "cannot import 'my_adaptor'" in missing.stderr
    assert "looked for in the current folder" in missing.stderr


def run(command, folder):
    # As the installed command: the current folder is not on Python's path.
    start = "import sys; sys.path.remove(''); from furiko.cli import main; sys.exit(main())"
    return subprocess.run(
        [sys.executable, "-c", start, *command[1:]],
        capture_output=True,
        text=True,
        cwd=folder,
        check=False,
        timeout=120,
    )
