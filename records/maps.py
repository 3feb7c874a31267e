"""The record of ``furiko map``: what was drawn, and what it ranges over."""

from __future__ import annotations

from typing import Literal

import msgspec

Kind = Literal["flips", "stretching", "lyapunov"]


class MapRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One quantity for a square of starts; ``furiko map --json`` prints it. The values are in the picture's numbers."""

    scene: str
    kind: Kind
    unit: str  # s or 1/s
    until: float  # how long each motion is followed [s]
    points: int  # a side of the square
    across: int  # number of the link whose angle varies across, from 1
    up: int  # and of the one whose angle varies upwards
    least: float | None  # of the values; None where there is none
    median: float | None
    most: float | None
    none: int  # starts without a value: those that do not flip by then
    tolerance: float
    seconds: float
