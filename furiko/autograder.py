"""Writes Gradescope's autograder.zip: setup.sh, run_autograder, the problem, and the part of furiko that grades.

As https://gradescope-autograders.readthedocs.io/en/latest/specs/ has it: setup.sh runs once when the image is built,
run_autograder for each submission; both stand at the root of the archive.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

from .derivations.classroom.problem import read_problem
from .models.readers.bounded_file import read_bytes
from .models.writers.whole_file import replace_file

PACKAGE = Path(__file__).parent
ROOMS = ("cli", "derivations", "models", "records", "reference", "reports")
NEEDED = {
    "click": "click",
    "msgspec": "msgspec",
    "numpy": "numpy",
    "python-flint": "flint",
}  # package: import
EXECUTABLE, PLAIN = 0o755, 0o644
WHEN = (2020, 1, 1, 0, 0, 0)  # the same archive from the same files

SETUP = """#!/usr/bin/env bash
# Runs once, when Gradescope builds the image: finds or installs a Python that can grade.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
[ -d "$here/source" ] && here="$here/source"
python=""
for candidate in python3 python3.13 python3.12 python3.11; do
    if command -v "$candidate" >/dev/null && "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
        python="$candidate"
        break
    fi
done
if [ -z "$python" ]; then
    apt-get install -y python3.11 python3.11-venv
    python=python3.11
fi
if ! "$python" -c 'import @IMPORTS@' 2>/dev/null; then
    if ! "$python" -m venv "$here/venv"; then
        apt-get install -y "$(basename "$python")-venv"
        "$python" -m venv "$here/venv"
    fi
    "$here/venv/bin/pip" install -r "$here/requirements.txt"
    python="$here/venv/bin/python"
fi
command -v "$python" > "$here/interpreter"
"""

RUN = """#!/usr/bin/env bash
# Runs for each submission: reads submission/, writes results/results.json.
set -uo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
results="$root/results/results.json"
mkdir -p "$root/results"
rm -f "$results"
cd "$root/source"
"$(cat interpreter)" -m furiko grade --problem problem.toml --gradescope "$results" "$root/submission"
status=$?
[ -s "$results" ] || exit "$status"
"""


def write_autograder(problem: Path, out: Path) -> Path:
    """Write the archive for one problem. Raises InvalidInput where the problem is none."""
    read_problem(problem)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        requirements = "".join(f"{name}=={version(name)}\\n" for name in NEEDED)
        _add(archive, "setup.sh", SETUP.replace("@IMPORTS@", ", ".join(NEEDED.values())).encode(), EXECUTABLE)
        _add(archive, "run_autograder", RUN.encode(), EXECUTABLE)
        _add(archive, "problem.toml", read_bytes(problem, 100_000), PLAIN)
        _add(archive, "requirements.txt", requirements.encode(), PLAIN)
        for name, path in _sources():
            _add(archive, f"furiko/{name}", path.read_bytes(), PLAIN)
    replace_file(out.resolve(), content.getvalue())
    return out


def _sources() -> Iterator[tuple[str, Path]]:
    for path in sorted(PACKAGE.glob("*.py")):
        yield path.name, path
    for room in ROOMS:
        folder = (PACKAGE / room).resolve()
        for path in sorted(folder.rglob("*.py")):
            yield f"{room}/{path.relative_to(folder)}", path


def _add(archive: zipfile.ZipFile, name: str, content: bytes, mode: int) -> None:
    entry = zipfile.ZipInfo(name, WHEN)
    entry.external_attr = mode << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, content)
