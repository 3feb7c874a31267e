"""The document that every command prints with ``--json`` where it fails."""

from __future__ import annotations

import msgspec


class Error(msgspec.Struct, frozen=True, kw_only=True):
    """Why a command failed. ``where`` and ``help`` are empty where nothing is known."""

    what: str  # what is wrong, one sentence
    where: str  # the file and field, engine, option or signal
    help: str  # what would be right

    @property
    def said(self) -> str:
        """``where: what; help``, as far as each is known."""
        return f"{self.where}: {self.what}".removeprefix(": ") + (f"; {self.help}" if self.help else "")


class ErrorDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The one JSON document of a command that failed; the exit status says which kind of failure it is."""

    error: Error
