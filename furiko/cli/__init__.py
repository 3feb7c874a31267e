"""The command line: one file for each command, imported when that command is asked for.

May import everything else of the package.
"""

from __future__ import annotations

import sys
from importlib import import_module


def main() -> None:
    """Run the command line of this process, and end the process with its exit status."""
    from .process import Stopped, catch_signals

    catch_signals()  # first of all: imports take a while, and may be interrupted as well
    try:
        import_module(".main", __package__).main()
    except Stopped as error:
        sys.exit(error.status)
