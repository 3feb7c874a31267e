"""uv or pip, whichever is there: makes virtual environments and installs into them, as the user has configured it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from .surveys import own_environment, same_python

LIMIT = 1800.0  # [s] for one installation: 400 MB over a slow line
_NOISE = re.compile(r"^(ERROR|error|hint|WARNING|notice)?:?\s*|[×╰─▶│├╭]+\s*", re.MULTILINE)


class NotInstalled(RuntimeError):
    """It could not be installed; why, in one line."""


@dataclass(frozen=True)
class Installer:
    """``uv``: the program, None where venv and pip are used."""

    uv: str | None

    @property
    def name(self) -> str:
        """In messages."""
        return "uv" if self.uv else "venv and pip"

    def create(self, folder: Path) -> None:
        """A virtual environment of this Python in a folder that is not there."""
        if self.uv:
            run([self.uv, "venv", "--quiet", "--no-project", "--python", sys.executable, str(folder)])
        else:
            run([sys.executable, "-m", "venv", str(folder)])

    def install(self, python: Path, requirements: Sequence[str]) -> None:
        """Install into the environment of a Python; wheels alone, so that nothing is built."""
        wheels = ["--only-binary", ":all:"]
        if self.uv:
            run([self.uv, "pip", "install", "--quiet", "--python", str(python), *wheels, *requirements])
        else:
            run([str(python), "-m", "pip", "install", "--quiet", "--no-input", *wheels, *requirements])

    def imports(self, python: Path, module: str) -> None:
        """See that the module can be imported there."""
        try:
            run([str(python), "-I", "-c", f"import {module}"], limit=120.0)
        except NotInstalled as error:
            raise NotInstalled(f"it is installed and cannot be imported: {error}") from None


def installer() -> Installer:
    """uv where it is there, else Python's own means."""
    beside = Path(sys.executable).with_name("uv")
    return Installer(shutil.which("uv") or (str(beside) if beside.is_file() else None))


def pip() -> list[str]:
    """A pip that answers questions about the index: this Python's."""
    if find_spec("pip") is None:
        raise NotInstalled("pip is not installed beside furiko")
    return [sys.executable, "-m", "pip"]


def run(command: Sequence[str], limit: float = LIMIT) -> str:
    """What the command prints. Raises :class:`NotInstalled` with its last words where it fails."""
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=limit, env=own_environment(), check=False
        )
    except OSError as error:
        raise NotInstalled(f"{command[0]} cannot be started: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        raise NotInstalled(f"no end within {limit:g} s") from None
    if done.returncode:
        raise NotInstalled(_words(done.stderr.decode("utf-8", "replace") or done.stdout.decode("utf-8", "replace")))
    return done.stdout.decode("utf-8", "replace")


def _words(text: str) -> str:
    """The part of an installer's message that says why, in one line."""
    lines = [_NOISE.sub("", line).strip() for line in text.splitlines()]
    lines = [re.sub(r" ?\(from versions: .*?\)", "", line) for line in lines if line and "[notice]" not in line]
    no_match = [line for line in lines if "no matching" in line.lower() or "could not find" in line.lower()]
    if no_match:
        return f"{no_match[0]} for Python {same_python()}"[:400]
    kept = [line for line in lines if not line.startswith(("Traceback", "File "))]
    return " ".join(kept[-4:])[-400:] or "it failed without a word"
