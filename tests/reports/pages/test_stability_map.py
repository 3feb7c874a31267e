"""A map shows which runs were made, and what follows from them."""

from furiko.reports.pages.stress_page import Column, draw_map


def test_a_map_tells_what_was_run_from_what_follows():
    found = draw_map("m", [Column("1", {0: 0, 4: 1}, 2)], [f"{i}" for i in range(6)], ["holds", "NaN"])
    assert [square.measured for square in found.squares] == [True, False, False, False, True, False]
    assert [square.kind for square in found.squares][0:3] == [0, 0, 0]
    assert [square.kind for square in found.squares][4:] == [1, 1]
