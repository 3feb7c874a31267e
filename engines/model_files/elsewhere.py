"""Readers of users' own files that run in a place of their own: another version, an environment that is there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, cast

from ...models import InvalidInput
from ..places import engines
from ..places.names import place_of
from ..places.remote import RemoteRobot
from ..registry import base_of
from .robot import ROBOT_READERS, RobotEngine, RobotReader


@dataclass(frozen=True)
class ReaderElsewhere(RobotReader):
    """``place``: the name of the engine in its place."""

    place: str = ""

    def load(self, path: Path, language: str, folders: Sequence[Path] = ()) -> RobotEngine:
        """Have the engine read the file in its place. Raises :class:`furiko.EngineMissing` where it is not there."""
        place = place_of(self.place)
        assert place is not None
        info = base_of(place)
        module = self.adapter if not self.adapter.startswith(".") else f"furiko.engines.model_files{self.adapter}"
        # It does all that is asked of a RobotEngine, but is made from a connection besides.
        return cast("RobotEngine", RemoteRobot(engines.connection(place, info, module), path, language, folders))


def reader_at(name: str) -> RobotReader | None:
    """The reader of the engine that a name says, in its place or here; None where it reads no files itself.

    The name of a package's engine that shares its reader with others is that one's, ``pinocchio-aba``.
    """
    place = place_of(name)
    own = name if place is None else base_of(place).name
    reader = ROBOT_READERS.get(own)
    if reader is None or place is None:
        return reader
    if place.kind == "program":
        raise InvalidInput(f"engine: {name}: a program reads no model files")
    held: dict[str, Any] = {field.name: getattr(reader, field.name) for field in fields(RobotReader)}
    return ReaderElsewhere(**held, place=name)
