"""The picture of a map: read back by hand, pixel by pixel, and the page around it."""

import struct
import zlib

import numpy as np
import pytest

from furiko.records.maps import MapRecord
from furiko.reports.pages.map_page import map_page, picture
from furiko.reports.pages.raster import NOTHING, SHADES, palette, png, shade_numbers


def read(content):
    """Rows of a PNG of a table of colours, by the format's specification."""
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(content):
        (size,) = struct.unpack(">I", content[at : at + 4])
        kind, body = content[at + 4 : at + 8], content[at + 8 : at + 8 + size]
        assert struct.unpack(">I", content[at + 8 + size : at + 12 + size])[0] == zlib.crc32(kind + body)
        chunks[kind] = body
        at += 12 + size
    width, height, depth, kind, *rest = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert (depth, kind, rest) == (8, 3, [0, 0, 0])
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, width + 1)
    assert (lines[:, 0] == 0).all()
    colours = np.frombuffer(chunks[b"PLTE"], np.uint8).reshape(-1, 3)
    return colours[lines[:, 1:]]


def record(kind="flips", least=0.1, most=10.0, none=1):
    middle = None if least is None else (least + most) / 2
    return MapRecord(
        scene="<b>", kind=kind, unit="s", until=10.0, points=2, across=1, up=2, least=least, median=middle, most=most,
        none=none, tolerance=1e-10, seconds=1.0,
    )  # fmt: skip


def test_shades_go_from_the_least_to_the_largest_by_logarithm():
    values = np.array([[0.1, 1.0], [10.0, np.inf]])
    assert shade_numbers(values, 0.1, 10.0, log=True).tolist() == [[0, 127], [254, 255]]
    assert shade_numbers(values, 0.0, 10.0, log=False)[0].tolist() == [3, 25]
    # the first row of the values is the lowest: at the bottom of the picture
    pixels = read(picture(record(), values))
    assert pixels[1, 0].tolist() == [*SHADES[0]]
    assert pixels[0, 0].tolist() == [*SHADES[-1]]
    assert pixels[0, 1].tolist() == [*NOTHING]


def test_shades_grow_lighter_all_along():
    light = palette()[:255] @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light) > -1).all()  # a whole number's rounding
    assert light[-1] - light[0] > 180


def test_one_value_and_none_are_pictures_too():
    assert read(png(np.zeros((1, 1), np.uint8))).shape == (1, 1, 3)
    same, nothing = np.full((2, 2), 3.0), np.full((2, 2), np.inf)
    assert read(picture(record(least=3.0, most=3.0, none=0), same)).shape == (2, 2, 3)
    assert (read(picture(record(least=None, most=None, none=4), nothing)) == NOTHING).all()
    assert "none within" in map_page(record(least=None, most=None, none=4), nothing)


@pytest.mark.parametrize("kind", ["flips", "stretching", "lyapunov"])
def test_the_page_says_what_it_shows_and_runs_nothing(kind):
    page = map_page(record(kind), np.array([[0.1, 1.0], [10.0, np.inf]]))
    assert "&lt;b&gt;" in page
    assert "<b>" not in page
    assert "<script" not in page
    assert "angle of link 1 at the start" in page
    ticks = [">0.1<", ">1<", ">10<"] if kind == "flips" else [">2<", ">10<"]
    assert all(tick in page for tick in ticks)
