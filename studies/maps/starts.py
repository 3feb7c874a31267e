"""``furiko map``: one quantity for each of a square of starts, two angles of which vary."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models import InvalidInput, Scene
from ...records.maps import Kind, MapRecord
from ...reference.integration.flips import flip_times
from ...reference.integration.tangents import lyapunov, stretching

Array = NDArray[np.float64]

TOLERANCE = 1e-10  # of a picture: no shade shows more, and steps are half as many as at the finest


@dataclass(frozen=True)
class Map:
    """``values``, (points, points), rows from the lowest angle up; not finite where nothing happens by the end."""

    record: MapRecord
    values: Array


def draw_map(
    scene: Scene, kind: Kind, until: float, points: int, links: tuple[int, int], threads: int | None = None
) -> Map:
    """The map of a scene's mechanism: angles of two links from -180° to 180°, all else as in the scene's own state.

    ``links``: numbers of those that vary across and up, from 0. Starts lie in the middle of their squares, so that none
    is at an upright. Raises InvalidInput for links that there are not.
    """
    begun = time.monotonic()
    n = scene.system.n
    if not all(0 <= link < n for link in links) or links[0] == links[1]:
        raise InvalidInput(f"links: two different ones from 1 to {n} are needed, got {links[0] + 1} and {links[1] + 1}")
    sides = (np.arange(points) + 0.5) * (2 * math.pi / points) - math.pi
    theta = np.tile(np.array(scene.theta if scene.theta is not None else [0.0] * n), (points, points, 1))
    omega = np.tile(np.array(scene.omega if scene.omega is not None else [0.0] * n), (points, points, 1))
    theta[..., links[1]] = sides[:, np.newaxis]
    theta[..., links[0]] = sides
    values, unit = _values(scene, kind, theta, omega, until, threads)
    known = values[np.isfinite(values)]
    low, middle, high = (float(f(known)) for f in (np.min, np.median, np.max)) if known.size else (None, None, None)
    record = MapRecord(
        scene=scene.name,
        kind=kind,
        unit=unit,
        until=until,
        points=points,
        across=links[0] + 1,
        up=links[1] + 1,
        least=low,
        median=middle,
        most=high,
        none=int(values.size - known.size),
        tolerance=TOLERANCE,
        seconds=round(time.monotonic() - begun, 3),
    )
    return Map(record, values)


def _values(
    scene: Scene, kind: Kind, theta: Array, omega: Array, until: float, threads: int | None
) -> tuple[Array, str]:
    """One value a start, and its unit."""
    system = scene.system
    if kind == "flips":
        return flip_times(system, theta, omega, until, TOLERANCE, threads=threads).times, "s"
    if kind == "stretching":
        return stretching(system, theta, omega, [0.0, until], TOLERANCE, threads=threads).exponent[..., 1], "1/s"
    return lyapunov(system, theta, omega, [0.0, until], TOLERANCE, threads=threads).exponents[..., 1, 0], "1/s"
