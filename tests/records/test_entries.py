"""A matrix among a result's details: what is written is read again, and nothing else is."""

import math

import msgspec
import pytest

from furiko.records.entries import ENTRIES, LARGEST, entries_in, to_entries

ROW = [[1.0, 2.0]]


def made(**changes):
    details = to_entries("given", ["a"], ["b", "c"], ROW, [[0.0, math.inf]], [[0.0, math.inf]], 50.0)
    details[ENTRIES] |= changes
    return msgspec.json.decode(msgspec.json.encode(details))


def test_what_is_written_is_read_again():
    found = entries_in(made())
    assert (found.state, found.rows, found.columns, found.theory) == ("given", ["a"], ["b", "c"], ROW)
    assert found.roundings[0][1] == 1e300  # JSON has no infinity


def test_a_large_matrix_is_left_out():
    names = ["x"] * (LARGEST + 1)
    assert to_entries("given", names, names, [], [], [], 1.0) == {}


@pytest.mark.parametrize(
    "changes",
    [
        {"theory": [[1.0]]},
        {"error": [[1.0, 2.0], [1.0, 2.0]]},
        {"roundings": [[1.0, "x"]]},
        {"rows": []},
        {"allowed": 0.0},
        {"state": 7},
        {"rows": ["x"] * 50},
    ],
)
def test_what_is_something_else_is_not_read(changes):
    assert entries_in(made(**changes)) is None


@pytest.mark.parametrize("details", [{}, {ENTRIES: None}, {ENTRIES: []}, {ENTRIES: "x"}])
def test_nothing_is_nothing(details):
    assert entries_in(details) is None
