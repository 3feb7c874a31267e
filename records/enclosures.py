"""The document of ``furiko enclose --json``."""

from __future__ import annotations

import msgspec


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
