"""Where results come from: when, by which command, on which machine, with which versions."""

from __future__ import annotations

import os
import platform
import shlex
import sys
from datetime import UTC, datetime

PACKAGES = ("numpy", "scipy", "mujoco", "pin", "exudyn", "python-flint", "heyoka", "numba")


def now() -> str:
    """The time now in UTC, to the second, as ISO 8601 writes it."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def command() -> str:
    """The command line of this process, as one would type it."""
    return shlex.join(["furiko", *sys.argv[1:]])


def machine() -> dict[str, str]:
    """Operating system, processor and number of cores of this machine."""
    return {
        "system": f"{platform.system()} {platform.machine()}",
        "processor": _processor(),
        "cores": str(os.cpu_count() or 1),
    }


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as lines:
            names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.processor() or "unknown"


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that results depend on; ``not installed`` for a missing package."""
    return {
        "python": platform.python_version(),
        **{name: installed_version(name) or "not installed" for name in PACKAGES},
    }


def installed_version(package: str) -> str:
    """The version of an installed package; empty where it is not installed, or where ``package`` is empty.

    Read off the head of its metadata: what ``importlib.metadata`` does takes six times as long, for it reads all of it.
    """
    from importlib.metadata import PackageNotFoundError, distribution  # takes 20 ms, and workers never ask

    if not package:
        return ""
    try:
        found = distribution(package)
    except PackageNotFoundError:
        return ""
    head = (found.read_text("METADATA") or found.read_text("PKG-INFO") or "").partition("\n\n")[0]
    lines = (line.partition(":") for line in head.splitlines())
    return next((value.strip() for name, _, value in lines if name == "Version"), "")
