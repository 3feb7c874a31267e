"""A picture of numbers: shades of one scale, as a PNG file's bytes."""

from __future__ import annotations

import base64
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

# From dark to light, by about as much lightness each; what has no value is grey, which none of them is.
SHADES = ((20, 24, 66), (16, 74, 138), (24, 132, 140), (92, 184, 104), (208, 214, 74), (255, 245, 205))
NOTHING = (150, 150, 154)
DEPTH, PALETTE = 8, 3  # bits of a pixel, and the kind of picture: each pixel a number in a table of colours
MOST = 254  # the last shade's number; 255 is NOTHING's


def shade_numbers(values: NDArray[np.float64], low: float, high: float, *, log: bool) -> NDArray[np.uint8]:
    """The number of each value's shade, (rows, columns): 0 at ``low`` to 254 at ``high``; 255 where there is none."""
    known = np.isfinite(values)
    scaled, ends = np.where(known, values, low), np.array([low, high])
    if log:
        scaled, ends = np.log(np.maximum(scaled, np.finfo(float).tiny)), np.log(ends)
    span = ends[1] - ends[0]
    part = np.clip((scaled - ends[0]) / span if span > 0 else 0 * scaled, 0, 1)
    return np.where(known, np.rint(MOST * part), MOST + 1).astype(np.uint8)


def png(numbers: NDArray[np.uint8]) -> bytes:
    """A PNG file of shades' numbers (rows, columns), first row at the top."""
    rows, columns = numbers.shape
    lines = np.concatenate([np.zeros((rows, 1), np.uint8), numbers], axis=1)  # 0: a line without a filter
    header = struct.pack(">IIBBBBB", columns, rows, DEPTH, PALETTE, 0, 0, 0)
    chunks = (
        (b"IHDR", header),
        (b"PLTE", palette().tobytes()),
        (b"IDAT", zlib.compress(lines.tobytes(), 9)),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, content) for kind, content in chunks)


def as_link(picture: bytes) -> str:
    """A PNG as the address of an image in a page."""
    return f"data:image/png;base64,{base64.b64encode(picture).decode()}"


def palette() -> NDArray[np.uint8]:
    """The colours by number, (256, 3)."""
    places = np.linspace(0, len(SHADES) - 1, MOST + 1)
    shades = [np.interp(places, range(len(SHADES)), [shade[c] for shade in SHADES]) for c in range(3)]
    return np.vstack([np.rint(np.array(shades).T), NOTHING]).astype(np.uint8)


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
