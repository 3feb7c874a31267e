"""The command line: one file for each command, imported when that command is asked for.

May import everything else of the package.
"""

from .main import main

__all__ = ["main"]
