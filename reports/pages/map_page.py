"""The page of ``furiko map``: the picture with its axes and scale, and what it shows in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...records.maps import MapRecord
from .axes import Tick, linear_axis, log_axis
from .raster import MOST, as_link, png, shade_numbers
from .rendering import render

SIDE, LEFT, TOP = 560, 64, 10  # the square, in the drawing's units
SCALE_LEFT, SCALE_WIDTH = LEFT + SIDE + 26, 18
DEGREES = (-180, -90, 0, 90, 180)
TICKS = 6
TITLES = {
    "flips": "When a link first passes the upright",
    "stretching": "Finite-time stretching",
    "lyapunov": "Largest Lyapunov exponent, of a finite time",
}
WHAT = {
    "flips": "time to the first flip [s]",
    "stretching": "finite-time Lyapunov exponent, ln of the largest growth over the time [1/s]",
    "lyapunov": "finite-time Lyapunov exponent of one general direction [1/s]",
}


def map_page(record: MapRecord, values: NDArray[np.float64]) -> str:
    """One HTML page; ``values``: (points, points), rows from the lowest angle up."""
    scale = _ticks(record)
    return render(
        "map.html.j2",
        record=record,
        title=TITLES[record.kind],
        what=WHAT[record.kind],
        picture=as_link(picture(record, values)),
        scale=as_link(png(np.arange(MOST + 1, dtype=np.uint8)[::-1, np.newaxis])),
        ticks=scale,
        degrees=[
            (LEFT + SIDE * (d + 180) / 360, TOP + SIDE * (180 - d) / 360, f"{d}°".replace("-", "−")) for d in DEGREES
        ],
        side=SIDE,
        left=LEFT,
        top=TOP,
        scale_left=SCALE_LEFT,
        scale_width=SCALE_WIDTH,
    )


def picture(record: MapRecord, values: NDArray[np.float64]) -> bytes:
    """The values alone, as a PNG: one pixel a start."""
    low, high = record.least, record.most
    if low is None or high is None:
        low, high = 1.0, 1.0
    return png(shade_numbers(values[::-1], low, high, log=logarithmic(record)))


def logarithmic(record: MapRecord) -> bool:
    """Times to flips range over powers of ten, and are above zero."""
    return record.kind == "flips" and record.least is not None and record.least > 0


def _ticks(record: MapRecord) -> tuple[Tick, ...]:
    """Of the scale, whose ends are the least and the largest value."""
    if record.least is None or record.most is None or record.least == record.most:
        return ()
    ends = [record.least, record.most]
    bottom, top = float(TOP + SIDE), float(TOP)
    if not logarithmic(record):
        axis = linear_axis([0.0, 1.0], bottom, top)
        marks = linear_axis(ends, 0.0, 1.0).ticks(TICKS)
        span = linear_axis(ends, 0.0, 1.0)
        return tuple(
            Tick(axis.at((span.low + (span.high - span.low) * one.place - ends[0]) / (ends[1] - ends[0])), one.base)
            for one in marks
            if span.low + (span.high - span.low) * one.place >= ends[0]
        )
    decades = log_axis(ends, 0.0, 1.0)
    low, high = (float(np.log10(end)) for end in ends)
    found = []
    for exponent in range(int(decades.low), int(decades.high) + 1):
        for digit in (1, 2, 5):
            place = exponent + float(np.log10(digit))
            if low <= place <= high:
                found.append(
                    Tick(bottom + (top - bottom) * (place - low) / (high - low), f"{digit * 10.0**exponent:g}")
                )
    return tuple(found)
