"""Where results come from: when, by which command, on which machine, with which versions."""

from __future__ import annotations

import os
import platform
import shlex
import sys
from datetime import UTC, datetime

from ..models.installed import installed_version

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
