"""The command line: one file for each command, imported when that command is asked for."""

from .main import main

__all__ = ["main"]
