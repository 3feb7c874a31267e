"""The documents of commands on a scene's motions: ``furiko enclose --json`` and ``furiko map --json``."""

from __future__ import annotations

from typing import Literal

import msgspec

Kind = Literal["flips", "stretching", "lyapunov"]


class EnclosureRow(msgspec.Struct, frozen=True, kw_only=True):
    """Where the motion is at one time: proved."""

    time: float  # [s]
    theta: list[str]  # a decimal ball a coordinate [rad, m]: [middle +/- radius], which contains the exact one
    omega: list[str]  # the same of the rates [rad/s, m/s]
    theta_low: list[float]  # doubles that the coordinates [rad, m] are not below
    theta_high: list[float]  # nor above
    omega_low: list[float]  # the same of the rates [rad/s, m/s]
    omega_high: list[float]
    radius: float  # the largest of all coordinates' and rates' radii, rounded up


class EnclosureDocument(msgspec.Struct, frozen=True, kw_only=True):
    """Intervals that are proved to contain a scene's motion; ``furiko enclose --json`` prints it."""

    scene: str
    coordinates: list[str]  # an open mechanism's joints; the numbers of a chain's or legs' angles
    units: list[str]  # of each coordinate: rad or m
    until: float  # the last time that was asked for [s]
    proved_until: float  # the last time up to which the motion is proved as narrowly as asked [s]
    complete: bool  # whether that is all of it
    why: str  # what ended it, if it is not complete
    digits: int  # decimals wanted
    bits: int  # of a step's own error
    steps: int
    seconds: float  # that it took
    rows: list[EnclosureRow]  # of the times that were reached


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
