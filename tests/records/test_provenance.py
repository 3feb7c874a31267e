"""Versions of installed packages, against what importlib.metadata reads."""

from importlib.metadata import version

import pytest

from furiko.records.provenance import installed_version


@pytest.mark.parametrize("package", ["numpy", "scipy", "msgspec", "furiko", "python-flint", "pytest"])
def test_the_version_is_the_one_that_the_whole_metadata_has(package):
    assert installed_version(package) == version(package)


@pytest.mark.parametrize("package", ["", "no-such-package-anywhere"])
def test_what_is_not_installed_has_none(package):
    assert installed_version(package) == ""


def test_a_line_of_the_description_is_no_version(tmp_path, monkeypatch):
    folder = tmp_path / "odd-1.2.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: odd\n\nVersion: 9\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    assert installed_version("odd") == ""
