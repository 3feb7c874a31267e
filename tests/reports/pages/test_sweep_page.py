"""The renderings of a sweep: what is in them, by hand, and that text from engines acts as nothing."""

import io
import re

import pytest

from furiko.records.sweep import SweepEngine, SweepFault, SweepGroup, SweepManifest, SweepSummary, SweepTally
from furiko.reports.ci.sweep_markdown import to_markdown
from furiko.reports.pages.sweep_page import to_html
from furiko.reports.sweeps import headline, varying
from furiko.reports.terminal.sweep import print_sweep

NASTY = "<script>alert(1)</script>\x1b[31m|`x`\u202e"


def group(engine, gravity, error, time=1e-5, **changes):
    fields = {"agrees": 2, "differs": 0, "skipped": 0, "errors": 0, "loose": 0, "share": 0.5, "worst": error}
    return SweepGroup(
        source="rods-2", n=2, parameters={"gravity": gravity}, engine=engine, check="accelerations", error=error,
        unit="of the largest acceleration", time=time, **(fields | changes),
    )  # fmt: skip


def summary(engine="b", missing=(), **changes):
    engines = ["a", engine]
    manifest = SweepManifest(
        furiko="1", code="", digest="", started="2026-11-27", command="furiko sweep s.toml", machine={}, versions={},
        file="s.toml", text=NASTY, checks=["accelerations"], parameters=["gravity"], cells=8, scenes=4, chunk=2,
        chunks=2,
        engines=[SweepEngine(name=name, formulation="", package="", version="1", folder="") for name in engines],
    )  # fmt: skip
    tallies = [
        SweepTally(engine=name, versions=["1"], cells=4, agrees=4, differs=0, skipped=0, errors=0, loose=1)
        for name in engines
    ]
    groups = [group("a", g, 1e-15 * g, 1e-5 / g) for g in (1.0, 10.0, 100.0)] + [group(engine, 1.0, 1e-3)]
    fields = {"flaws": [], "faults": [], "groups_left_out": 0}
    return SweepSummary(
        manifest=manifest, cells=8 - 2 * len(missing), complete=not missing, missing=list(missing), tallies=tallies,
        groups=groups, **(fields | changes),
    )  # fmt: skip


def test_the_page_has_a_line_for_each_engine_and_a_front():
    page = to_html(summary())
    assert "all 8 cells are there (4 scenes on 2 engines): 2 loose, 6 agree" in page
    assert "accelerations: typical error against gravity [m/s²]" in page
    # One front for accelerations; of a's points each is slower and more exact than the next, b's is beaten by none of
    # its time: three of a's and none of b's are on it, as b's error is larger than all and its time no smaller.
    assert page.count('class="front"') == 1
    assert len(re.findall(r"<title>(?:a|b): rods-2, gravity", page)) == 4
    assert varying(summary()) == ["gravity"]


def test_what_is_missing_is_said_first_everywhere():
    found = summary(missing=["results/a/0000001.parquet"])
    assert headline(found) == "incomplete: 6 of 8 cells are there (4 scenes on 2 engines)"
    told = io.StringIO()
    print_sweep(found, None, file=told)
    for text in (to_html(found), to_markdown(found), told.getvalue()):
        assert "incomplete: 6 of 8 cells" in text.replace("&#58;", ":")
        assert "0000001" in text
        assert text.index("incomplete") < text.index("gravity")


def hostile():
    fault = SweepFault(
        engine=NASTY, check=NASTY, outcome="error", cause=None, reason=NASTY, times=3, scene=NASTY, cell=0
    )
    return summary(engine=NASTY, faults=[fault], flaws=[NASTY])


def test_text_from_engines_is_no_markup_and_no_control_code():
    page, markdown, told = to_html(hostile()), to_markdown(hostile()), io.StringIO()
    print_sweep(hostile(), None, file=told)
    assert "<script>alert" not in page
    assert "<script>" not in markdown
    assert "`x`" not in markdown
    for text in (page, markdown, told.getvalue()):
        assert "\x1b" not in text
        assert "\u202e" not in text
    rows = [line for line in markdown.splitlines() if line.startswith("|")]
    assert len({line.count("|") for line in rows[:4]}) == 1  # no bar of a reason's own makes a column


@pytest.mark.parametrize("width", [80, 120])
def test_a_terminal_is_not_overrun(width, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setenv("TERM", "dumb")
    told = Terminal()
    long = SweepFault(
        engine="a", check="accelerations", outcome="error", cause=None, reason="word " * 100, times=3, scene="s", cell=0
    )
    print_sweep(summary(faults=[long]), None, file=told)
    assert max(map(len, told.getvalue().splitlines())) <= width
