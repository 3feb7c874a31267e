"""The command line: one file for each command, imported when that command is asked for.

May import everything else of the package.
"""

from __future__ import annotations

import sys
from importlib import import_module


def main() -> None:
    """Run the command line of this process, and end the process with its exit status."""
    try:
        from .process import catch_signals, release_signals

        catch_signals()  # first of all: imports take a while, and may be interrupted as well
        status = import_module(".main", __package__).main()
        release_signals()
    except KeyboardInterrupt as error:  # Stopped, or Python's own
        status = getattr(error, "status", 130)
    sys.exit(status)
