"""``furiko map`` as a user meets it."""

import json
import math

import jsonschema
import numpy as np
import pytest

from furiko.cli.main import run
from furiko.records.schema import schema


@pytest.mark.slow
def test_a_map_of_flips_is_a_page_a_picture_and_numbers(tmp_path, capsys):
    assert run(["map", "double-pendulum", "--points", "24", "--until", "3", "--out", str(tmp_path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    jsonschema.validate(record, json.loads(schema("map")))
    values = np.array([[float(v) for v in line.split(",")] for line in (tmp_path / "map.csv").read_text().splitlines()])
    assert values.shape == (24, 24)
    assert np.isinf(values).sum() == record["none"]
    assert np.isfinite(values).any()
    np.testing.assert_allclose(values, values[::-1, ::-1], rtol=1e-6)  # a motion and its mirror image
    # At rest energy forbids flips where 2 cos θ1 + cos θ2 > 1 (equal masses and rods).
    sides = (np.arange(24) + 0.5) * 2 * math.pi / 24 - math.pi
    forbidden = 2 * np.cos(sides) + np.cos(sides[::-1, None]) > 1
    assert np.isinf(values[forbidden]).all()
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    assert "passes the upright" in (tmp_path / "map.html").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["stretching", "lyapunov"])
def test_maps_of_exponents(kind, tmp_path, capsys):
    assert run(["map", "double-pendulum", "--of", kind, "--points", "4", "--until", "1", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "4 × 4 starts of double-pendulum, 1 s each" in said
    assert "1/s" in said
    assert max(map(len, said.splitlines()[:2])) < 80


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["cart-pole"], "open mechanism"),
        (["rods-1"], "two different ones"),
        (["rods-3", "--links", "1", "4"], "two different ones from 1 to 3"),
        (["rods-3", "--links", "2", "2"], "two different ones"),
        (["rods-3", "--points", "1"], "points"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_a_line(arguments, says, tmp_path, capsys):
    assert run(["map", *arguments, "--out", str(tmp_path)]) == 2
    assert says in capsys.readouterr().err
