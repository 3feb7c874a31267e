"""What a bare installation does, and what it says where an extra is missing."""

import ast
import os
import re
import subprocess
import sys
import tomllib

import pytest
from package_rooms import MODULES, ROOT, parsed

from furiko.models.errors import EXTRAS

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OPTIONAL = ("mujoco", "pinocchio", "exudyn", "pydrake", "numba", "llvmlite", "heyoka", "scipy", "sympy")
POSIX = {"fcntl", "resource", "termios", "pty", "pwd", "grp"}


def bare(code, cwd):
    """Run Python in a process in which every optional library is missing."""
    hidden = f"import sys; sys.modules.update(dict.fromkeys({OPTIONAL!r})); "
    # Versions come from metadata: an engine that cannot be imported must not look installed either.
    absent = (
        "import importlib.metadata as m; known = m.distribution\n"
        "def distribution(name):\n"
        "    if name in ('mujoco', 'pin', 'exudyn'): raise m.PackageNotFoundError(name)\n"
        "    return known(name)\n"
        "m.distribution = distribution\n"
    )
    return subprocess.run(
        [sys.executable, "-c", hidden + absent + code], capture_output=True, text=True, cwd=cwd, check=False,
        timeout=300, env=os.environ | {"PYTHONPATH": str(ROOT)},
    )  # fmt: skip


def needs(requirement):
    return re.match(r"[A-Za-z0-9-]+", requirement)[0]


def test_each_message_names_an_extra_that_brings_the_package():
    extras = PROJECT["optional-dependencies"]
    for package, extra in EXTRAS.items():
        assert package in [needs(requirement) for requirement in extras[extra]]


def test_the_core_needs_no_engine_and_nothing_large():
    assert {needs(requirement) for requirement in PROJECT["dependencies"]} == {
        "numpy", "python-flint", "click", "rich", "jinja2", "platformdirs", "msgspec",
        "tree-sitter",  # small abi3 wheels without dependencies: programs are graded from the plain install
        *(f"tree-sitter-{of}" for of in ("cpp", "typescript", "java", "c-sharp", "go", "rust", "julia", "kotlin")),
    }  # fmt: skip


def test_engines_have_no_upper_bound():
    extras = PROJECT["optional-dependencies"]
    for engine in ("mujoco", "pin", "exudyn"):
        assert "<" not in extras[engine][0]
        assert "==" not in extras[engine][0]


@pytest.mark.parametrize(
    ("call", "library", "extra"),
    [
        ("furiko.simulate(furiko.RodChain([1.0]), [0.1], [0.0], [0.0, 1.0])", "numba", "fast"),
        ("from furiko.reference.truth.quadruple import quadruple_trajectory as q; "
         "q(furiko.RodChain([1.0]), [0.1], [0.0], [0.0, 1.0])", "heyoka", "truth"),
        ("from furiko.reference.chain import small_swings; small_swings(3, 'rods', 2)", "scipy", "scipy"),
    ],
)  # fmt: skip
def test_a_missing_library_is_one_sentence(tmp_path, call, library, extra):
    code = f"import furiko\ntry:\n  {call}\nexcept furiko.LibraryMissing as error: print(error)"
    done = bare(code.replace("; ", "\n  "), tmp_path)
    assert done.stdout == f"this needs {library}: pip install 'furiko[{extra}]'\n", done.stderr


def test_many_accelerations_need_no_compiler(tmp_path):
    # A rod's closed form, (l²/3) θ̈ + (l/2) g sin θ = 0: θ̈ = -3/2 (g/l) sin θ; some roundings are allowed.
    code = (
        "import furiko, numpy as np\ntheta = np.linspace(-3, 3, 5000)[:, None]\n"
        "found = furiko.accelerations(furiko.RodChain([2.0]), theta, 0 * theta)\n"
        "print(np.abs(found + 0.75 * 9.81 * np.sin(theta)).max() < 1e-14)"
    )
    assert bare(code, tmp_path).stdout == "True\n"


@pytest.mark.parametrize("engine", [(), ("-e", "mujoco")])
def test_a_bare_installation_says_in_one_line_which_extra_to_add(tmp_path, engine):
    done = bare(f"from furiko.cli.main import run; sys.exit(run(['check', *{engine!r}]))", tmp_path)
    assert done.returncode == 3
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert line.startswith("furiko: no engine to check is installed: pip install 'furiko[mujoco]'")
    assert not list(tmp_path.iterdir())


def test_a_derivation_is_graded_without_any_extra(tmp_path):
    (tmp_path / "d.toml").write_text('system = "rod-chain"\nlinks = 1\n[equations]\n1 = "l1*a1/3 + g*sin(t1)/2 = 0"\n')
    done = bare("from furiko.cli.main import run; sys.exit(run(['grade', 'd.toml']))", tmp_path)
    assert done.returncode == 0, done.stderr


def test_a_check_whose_library_is_missing_is_skipped_with_the_reason(run_cell, monkeypatch):
    monkeypatch.setitem(sys.modules, "heyoka", None)
    found = run_cell("mujoco", "double-pendulum", profile="full", random_states=2)
    result = found["horizon"]
    assert (result.outcome, result.reason) == ("skipped", "this needs heyoka: pip install 'furiko[truth]'")
    assert found["accelerations"].outcome == "agrees"


@pytest.mark.parametrize("module", sorted(MODULES))
def test_what_only_posix_has_is_imported_under_a_condition(module):
    tree = parsed(MODULES[module])
    at_the_top = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    named = {a.name for node in at_the_top if isinstance(node, ast.Import) for a in node.names}
    named |= {node.module for node in at_the_top if isinstance(node, ast.ImportFrom)}
    assert not named & POSIX
