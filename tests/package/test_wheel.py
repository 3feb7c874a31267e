"""The wheel holds every folder of the package, and only the package."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
FOLDERS = ("furiko", "models", "reference", "engines", "checks", "derivations", "reports")
DATA = {".toml", ".json", ".j2", ".css", ".html", ".typed"}  # what the code reads at run time


@pytest.mark.slow
def test_the_wheel_holds_what_the_checkout_holds(tmp_path):
    source = tmp_path / "source"
    source.mkdir()
    for name in (*FOLDERS, "pyproject.toml", "README.md", "LICENSE"):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, source / name)
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(tmp_path), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (wheel,) = tmp_path.glob("furiko-*.whl")
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert held == set(expected())


def expected():
    for folder in FOLDERS:
        home = "furiko" if folder == "furiko" else f"furiko/{folder}"
        for path in (ROOT / folder).rglob("*"):
            inside = path.relative_to(ROOT / folder)
            if path.is_file() and path.suffix in {".py", *DATA} and inside.parts[0] != "files":
                yield f"{home}/{inside.as_posix()}"
