"""A wheel built from the checkout, one built from the source archive, and the checkout hold the same files."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
LEFT_OUT = ("models/files",)  # written from the catalogue: for people and engines, not for the package
ALONE = (
    "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "CODE_OF_CONDUCT.md", "SECURITY.md",
    "action.yml", ".pre-commit-hooks.yaml", "Containerfile", ".containerignore",
)  # fmt: skip
# What the code reads at run time.
DATA = {".toml", ".json", ".j2", ".css", ".js", ".html", ".txt", ".yml", ".typed", ".xml", ".urdf", ".ll", ".xz"}


def links():
    """The folders at the root that are part of the package: furiko/ links to each."""
    return sorted(path.name for path in (ROOT / "furiko").iterdir() if path.is_symlink())


@pytest.fixture
def source(tmp_path):
    """A copy of what the build reads, links kept as links; nothing that an earlier build has left."""
    copy = tmp_path / "source"
    copy.mkdir()
    for name in ("furiko", *links()):
        shutil.copytree(ROOT / name, copy / name, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE", "MANIFEST.in", "Makefile", "constraints.txt"):
        shutil.copy(ROOT / name, copy / name)
    for name in ALONE:
        shutil.copy(ROOT / name, copy / name)
    for name in ("tests", "docs", "benchmarks", ".ci", ".github"):
        shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


@pytest.mark.slow
def test_wheel_sdist_and_checkout_hold_the_same_files(source, tmp_path):
    direct = build(source, tmp_path / "direct", "--wheel", "--sdist")
    archive = next((tmp_path / "direct").glob("furiko-*.tar.gz"))
    shutil.unpack_archive(archive, tmp_path / "unpacked", filter="data")
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    through_archive = build(unpacked, tmp_path / "through", "--wheel")
    assert direct == set(expected())
    assert through_archive == direct
    for name in ("tests", "docs", "benchmarks", ".github"):
        there = {path.relative_to(ROOT / name) for path in (ROOT / name).rglob("*") if path.is_file()}
        there = {path for path in there if "__pycache__" not in path.parts and ".asv" not in path.parts}
        assert there <= {path.relative_to(unpacked / name) for path in (unpacked / name).rglob("*")}
    for name in (*ALONE, "Makefile", "constraints.txt", ".ci/run"):
        assert (unpacked / name).is_file()


def build(source, out, *kinds):
    """Names of the files in the wheel."""
    command = [sys.executable, "-m", "build", *kinds, "--no-isolation", "--outdir", str(out), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (wheel,) = out.glob("furiko-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    scripts = [name for name in names if ".data/" in name]
    assert [Path(name).name for name in scripts] == ["furiko-ci"]
    return {name for name in names if ".dist-info/" not in name and name not in scripts}


def expected():
    for folder in ("furiko", *links()):
        home = "furiko" if folder == "furiko" else f"furiko/{folder}"
        for path in (ROOT / folder).rglob("*"):
            inside = path.relative_to(ROOT / folder)
            left_out = path.relative_to(ROOT).as_posix().startswith(LEFT_OUT)
            if path.is_file() and path.suffix in {".py", *DATA} and not left_out:
                yield f"{home}/{inside.as_posix()}"


def test_every_link_leads_to_the_folder_of_its_name():
    for name in links():
        link = ROOT / "furiko" / name
        assert link.readlink() == Path("..", name), "a relative link, so that it holds in every clone"
        assert (ROOT / name).is_dir()
        assert not (ROOT / name).is_symlink()
