"""The stress summary in a pipe: frontiers, step sizes, long runs, the chain, and what is open."""

from pathlib import Path

from stress_summaries import frontier, summary

from furiko.reports.terminal.stress import print_stress


def test_every_part_of_the_summary_is_printed(capsys):
    pair = frontier(axis="long-rods x fast-rods", pair=True, failure="NaN")
    print_stress(summary(frontiers=[frontier(), pair]), Path("out/stress.html"))
    lines = capsys.readouterr().out.splitlines()
    for words in (
        ["long-rods", "1e+04", "m"],
        ["mujoco", "long-rods", "x", "fast-rods", "1e+04", "m", "NaN"],
        ["legs", "relative", "n^1.00"],
        ["mujoco", "RK4", "0.18", "s", "open"],
        ["mujoco", "Euler", "1,000", "random", "walk", "0.50", "0.1"],
        ["-", "It", "is", "physics."],
    ):
        assert words in [line.split() for line in lines]
    assert lines[-1] == "12 cases; 2 questions open: run again with the same folder to resume; page: out/stress.html"


def test_text_from_an_engine_is_only_text(capsys):
    print_stress(summary(frontiers=[frontier(engine="[red]\x1b[2J")]), Path("out/stress.html"))
    assert "[red]\\x1b[2J" in capsys.readouterr().out
