"""What an engine in an environment rests on: its Python, its code and NumPy's, and nothing else that is there."""

import sys

import pytest

from furiko.checks.foundations import place_foundation


@pytest.fixture
def site(tmp_path):
    """Two installed packages, an engine with a library and NumPy, and one that nothing needs."""
    for name, requires in (("eng", "Requires-Dist: numpy"), ("numpy", ""), ("other", "")):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "__init__.py").write_text("")
        (folder / "core.so").write_bytes(b"binary")
        info = tmp_path / f"{name}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n{requires}\n")
        (info / "RECORD").write_text(f"{name}/__init__.py,,\n{name}/core.so,,\n")
    return tmp_path


def digest(site, python=sys.executable):
    place_foundation.cache_clear()
    return place_foundation(python, (str(site),), "eng", "eng")


@pytest.mark.parametrize("changed", ["eng/core.so", "eng/__init__.py", "numpy/core.so"])
def test_a_binary_that_was_rebuilt_is_another_foundation(site, changed):
    before = digest(site)
    assert before == digest(site) != b""
    (site / changed).write_bytes(b"rebuilt")
    assert digest(site) not in {before, b""}


def test_what_the_engine_does_not_need_may_change(site):
    before = digest(site)
    (site / "other" / "core.so").write_bytes(b"rebuilt")
    assert digest(site) == before


def test_another_python_is_another_foundation(site, tmp_path):
    other = tmp_path / "python"
    other.write_text("")
    assert digest(site, str(other)) != digest(site)


def test_nothing_is_kept_of_what_is_not_known(site):
    (site / "eng-1.0.dist-info" / "direct_url.json").write_text('{"dir_info": {"editable": true}}')
    assert digest(site) == b""


def test_nothing_is_kept_without_numpy_or_the_engine(site):
    assert place_foundation(sys.executable, (str(site / "nowhere"),), "eng", "eng") == b""
