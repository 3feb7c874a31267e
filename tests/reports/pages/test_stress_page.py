"""The stress test's pages: whole, offline, escaped, and saying what the summary says."""

from html.parser import HTMLParser

import msgspec
import pytest

from furiko.records.check import Header
from furiko.records.stress import StressSummary
from furiko.reports.pages.chain_page import chain_page
from furiko.reports.pages.stress_page import stress_page, write_pages

HEADER = Header(
    furiko="1", started="2026-01-01T00:00:00+00:00", command="furiko stress <script>", profile="stress", seed="1",
    machine={}, versions={"numpy": "2"}, scenes=[], engines=[],
)  # fmt: skip

POINT = {
    "at": "1e+04 m", "worst error": 1e-3, "digits": 15.5, "one ulp does": 1e-16, "condition": 10.0,
    "error over ε·cond": 0.25, "failure": None,
}  # fmt: skip


def frontier(**changes):
    return {
        "axis": "long-rods", "says": "longer & longer", "engine": "mujoco", "pair": False, "closed": True,
        "status": "fails", "holds": 7, "fails": 8, "holds at": "3160 m", "fails at": "1e+04 m", "top": 12,
        "failure": "half its digits lost", "reason": "a <b>bold</b> reason",
        "curve": [{"value": 1.0, "error": 1e-15, **POINT}, {"value": 1e4, "error": 1e-7, **POINT}],
    } | changes  # fmt: skip


def steps(**changes):
    return {
        "engine": "mujoco", "integrator": "RK4", "stress": "links", "value": 2.0, "unit": "rods", "closed": True,
        "rung": 17, "step": 0.18, "fails at": 0.25, "failure": "energy runs away", "reason": "energy",
        "cells": [{"rung": 0, "step": 0.0005, "failure": None}, {"rung": 18, "step": 0.25, "failure": "NaN"}],
    } | changes  # fmt: skip


def summary(**changes):
    """A summary from its JSON document, with these keys changed."""
    return msgspec.convert(document() | changes, StressSummary)


def document():
    return {
        "seed": 1, "cases": 12, "open": 2,
        "frontiers": [frontier(), frontier(engine="kernels", status="holds", failure=None)],
        "kernels": {"cases": 5, "promised": 1e-13, "worst": 9e-15, "broken": [], "exceptions": []},
        "condition": [
            {"posture": "legs", "coordinates": "relative", "n": [4, 8], "condition": [10.0, 20.0], "power": 1.0}
        ],
        "steps": [steps(), steps(value=4.0, closed=False)],
        "long runs": [{
            "engine": "mujoco", "integrator": "Euler", "steps": 1000, "of": 10_000, "closed": False,
            "kind": "random walk", "failure": None, "drift": [0.0, 0.1, 0.05], "largest": 0.1, "exponent": 0.5,
            "rate": 1e-9, "spread": 0.1,
        }],
        "failures": [{"engine": "mujoco", "failure": "NaN", "times": 3, "where": "here", "reason": "why"}],
        "chain": {
            "swings": [{"links": "rods", "n": [100, 200], "power": 2,
                        "rows": [{"k": 1, "errors": [3e-6, 7.5e-7], "order": 2.0, "coefficient": 0.03}]}],
            "usable step": [{"n": 5, "step": 0.07}, {"n": 10, "step": 0.03}],
            "memory": [{"n": 1000, "bytes": 1e6}], "motions": [motion(10), motion(20)], "in step": [],
            "convergence": [{"amplitude": 1.0, "n": 10, "times": [0.25], "apart": [1e-3], "order": [2.0],
                             "series": [0.0, 1e-3]}],
            "verdict": ["It is physics."],
        },
    }  # fmt: skip


def motion(n):
    return {
        "n": n, "amplitude": 1.0, "tolerance": 1e-13, "closed": True, "time": 0.5, "tip": [[0, -1]] * 3,
        "speed": [0.0, 1.0, 2.0], "fastest tip": 2.0, "fastest tip at": 0.5, "fastest turning": 40.0,
        "energy drift": 1e-15, "steps": 100, "mean step": 5e-3, "seconds": 0.1,
        "curves": {"0.25": [[0.1, -0.5], [0.2, -0.9]]},
    }  # fmt: skip


class Checker(HTMLParser):
    """Tags that are opened and closed, and anything that would be fetched."""

    def __init__(self):
        super().__init__()
        self.open, self.fetched, self.words = [], [], []

    def handle_starttag(self, tag, attrs):
        if tag != "meta":
            self.open.append(tag)
        self._note(attrs)

    def handle_startendtag(self, tag, attrs):
        self._note(attrs)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def _note(self, attrs):
        self.fetched += [v for k, v in attrs if k in ("src", "href") and v and ":" in v]

    def handle_data(self, data):
        self.words.append(data)


@pytest.mark.parametrize("render", [stress_page, chain_page])
@pytest.mark.parametrize("empty", [False, True])
def test_pages_are_whole_and_fetch_nothing(render, empty):
    nothing = {"frontiers": [], "condition": [], "steps": [], "long runs": [], "failures": []}
    nothing["chain"] = {key: [] for key in document()["chain"]}
    page = render(summary(**nothing) if empty else summary(), HEADER)
    checker = Checker()
    checker.feed(page)
    assert checker.open == []
    assert checker.fetched == []
    assert "<script" not in page
    assert "default-src 'none'" in page


def test_the_stress_page_says_what_was_found():
    page = stress_page(summary(), HEADER)
    for words in (
        "✗ from 1e+04 m",
        "✓ to 3160 m",
        "2 questions",
        "15.5 digits left, 0.25 ε·cond",
        "worst state 1.0e-3",
        "energy runs away",
        "random walk",
        "n<sup>1.00</sup>",
    ):
        assert words in page
    assert "a &lt;b&gt;bold&lt;/b&gt; reason" in page
    assert "No case exceeds the first bound" in page


def test_the_records_write_the_document_that_they_were_read_from():
    assert msgspec.to_builtins(summary()) == document()


def test_a_long_run_too_short_to_classify_has_no_exponent_in_the_document():
    (run,) = document()["long runs"]
    short = {key: value for key, value in run.items() if key not in ("exponent", "rate", "spread")} | {"kind": None}
    again = msgspec.to_builtins(summary(**{"long runs": [short]}))
    assert again["long runs"] == [short]


def test_a_broken_promise_is_not_hidden():
    told = {"axis": "legs", "at": "3 legs", "measured": 1e-9, "allowed": 1e-13, "reason": "too much"}
    kernels = {"cases": 5, "promised": 1e-13, "worst": 1e-9, "broken": [told], "exceptions": []}
    page = stress_page(summary(kernels=kernels), HEADER)
    assert "1 case exceeds both bounds" in page
    assert "No case exceeds the first bound" not in page


def test_the_chains_page_says_what_was_found():
    page = chain_page(summary(), HEADER)
    for words in ("It is physics.", "Bernoulli", "n<sup>−2.000</sup>", "20 rods", "0.25 s"):
        assert words in page


def test_both_pages_are_written(tmp_path):
    paths = write_pages(tmp_path, summary(), HEADER)
    assert [path.name for path in paths] == ["stress.html", "chain.html"]
    assert all(path.read_text(encoding="utf-8").rstrip().endswith("</html>") for path in paths)
