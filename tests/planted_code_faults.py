"""Faults planted in furiko's own code and in its adapters, one at a time: each has to be noticed, by a test or a run.

Run it from a checkout:

    python tests/planted_code_faults.py [--only TEXT]... [--list] [--unplanted]

``tests/faults/planted_code/`` has the table: the file, what stands there, what is put in its place, and what has to
notice it: tests that fail, or a command whose exit status becomes another. A copy of the checkout is changed, never the
checkout. ``--unplanted`` runs what has to notice them without any fault, to see that it is silent then.

The exit status is 1 where a fault is not noticed, or one that is known to hide is; 2 where one no longer fits the code.
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "tests" / "faults" / "planted_code"
PATIENCE = 600.0  # s for what has to notice one fault: a run that hangs has noticed nothing
FAILED = 1  # pytest: some tests failed; every other status is a fault of the call


@dataclass(frozen=True)
class Fault:
    """``noticed_by``: paths of tests, or a command of furiko, which then ends with ``status``.

    ``hides``: why nothing notices it, for one that is known to be no fault to anybody, or not to be told.
    """

    id: str
    file: str
    old: str
    new: str
    noticed_by: str
    status: int = FAILED
    slow: bool = False
    hides: str = ""

    @property
    def command(self) -> list[str]:
        first, *rest = shlex.split(self.noticed_by)
        if first == "furiko":
            return [sys.executable, "-m", "furiko", *rest, "--out", os.devnull + "/none"]
        chosen = [] if self.slow else ["-m", "not slow"]
        return [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *chosen, first, *rest]

    def planted(self, text: str) -> str:
        """The file's text with the fault in it. Raises ValueError where it does not fit, or is no Python."""
        if text.count(self.old) != 1:
            raise ValueError(f"{self.id}: {self.file} has {text.count(self.old)} times, not once: {self.old!r}")
        changed = text.replace(self.old, self.new)
        if self.file.endswith(".py"):
            compile(changed, self.file, "exec", dont_inherit=True)
        return changed


def table() -> list[Fault]:
    """Every fault, in the files' order."""
    found = []
    for path in sorted(TABLE.glob("*.toml")):
        found += [Fault(**entry) for entry in tomllib.loads(path.read_text(encoding="utf-8"))["fault"]]
    return found


def misfits(faults: list[Fault]) -> list[str]:
    """What is wrong with each that does not fit the code."""
    said = [f"{name}: twice in the table" for name in {f.id for f in faults if [g.id for g in faults].count(f.id) > 1}]
    for fault in faults:
        try:
            fault.planted((ROOT / fault.file).read_text(encoding="utf-8"))
        except (OSError, ValueError, SyntaxError) as error:
            said.append(f"{fault.id}: {error}")
    return said


def copied(folder: Path) -> Path:
    """The files of the checkout that git knows or does not ignore."""
    listed = ["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, check=True, capture_output=True).stdout.decode().split("\0")
    for name in filter(None, names):
        place = folder / name
        if os.path.lexists(ROOT / name):
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, place, follow_symlinks=False)
    return folder


def ended(fault: Fault, copy: Path, cache: Path) -> tuple[int | None, str]:
    """The exit status of what has to notice the fault, None where it took too long, and its last words."""
    surroundings = dict(os.environ, PYTHONPATH=str(copy), FURIKO_CACHE=str(cache), PYTHONDONTWRITEBYTECODE="1")
    command = [word.replace(os.devnull + "/none", str(cache / "report")) for word in fault.command]
    try:
        run = subprocess.run(
            command, cwd=copy, env=surroundings, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
    except subprocess.TimeoutExpired:
        return None, "no end"
    lines = [line for line in (run.stdout + run.stderr).splitlines() if line.startswith(("FAILED", "ERROR", "E  "))]
    return run.returncode, lines[-1] if lines else ""


def noticed(fault: Fault, copy: Path) -> tuple[bool, str]:
    """Whether a fault is noticed, and by what."""
    path = copy / fault.file
    sound = path.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as cache:
        path.write_text(fault.planted(sound), encoding="utf-8")
        try:
            status, said = ended(fault, copy, Path(cache))
        finally:
            path.write_text(sound, encoding="utf-8")
    return status == fault.status, f"status {status} {said}"


def silent(faults: list[Fault], copy: Path) -> list[str]:
    """What fails though no fault is planted."""
    loud = []
    for fault in {(fault.noticed_by, fault.slow): fault for fault in faults}.values():
        with tempfile.TemporaryDirectory() as cache:
            status, said = ended(fault, copy, Path(cache))
        print(f"{'silent' if status == 0 else 'LOUD  '}  {fault.noticed_by}", flush=True)
        if status != 0:
            loud.append(f"{fault.noticed_by}: status {status} {said}")
    return loud


def main() -> int:
    """Plant them, and print what noticed each."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", help="those with this in their name; may be given several times")
    parser.add_argument("--list", action="store_true", help="only say which there are, and whether each fits the code")
    parser.add_argument("--unplanted", action="store_true", help="run what has to notice them, without a fault")
    options = parser.parse_args()
    faults = [f for f in table() if not options.only or any(text in f.id for text in options.only)]
    wrong = misfits(faults)
    if wrong or not faults:
        print("\n".join(wrong) or "no such fault")
        return 2
    if options.list:
        print("\n".join(f"{fault.id:44} {fault.file:40} {fault.noticed_by}" for fault in faults))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        copy = copied(Path(folder))
        if options.unplanted:
            loud = silent(faults, copy)
            print("\n".join(loud))
            return bool(loud)
        missed, hidden = [], 0
        for fault in faults:
            begun = time.monotonic()
            found, how = noticed(fault, copy)
            word = "noticed" if found else "hides" if fault.hides else "MISSED"
            print(f"{word:8} {time.monotonic() - begun:5.0f} s  {fault.id}: {fault.hides or how[:120]}", flush=True)
            hidden += bool(fault.hides) and not found
            if found == bool(fault.hides):
                missed.append(fault.id)
    print(
        f"{len(faults) - len(missed) - hidden} of {len(faults)} noticed; {hidden} known to hide; "
        f"{len(missed)} otherwise than the table says: {', '.join(missed)}"
    )
    return bool(missed)


if __name__ == "__main__":
    sys.exit(main())
