"""The page of two runs: verdict and causes first, each change once, hostile text as text, long lists cut and told."""

import pytest
from browser import CHROMIUM, LOW_CONTRAST, NAMELESS, OUTSIDE, Browser
from hostile_pages import HOSTILE, everywhere

from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.reports.compare import compare
from furiko.reports.pages.diff_page import MOST, to_diff_page
from furiko.reports.report import Report, footer_of

NARROW = 390


def runs(make):
    """A run in which all agrees, and one with the next version: a wrong gravity, another error, one thing mended."""
    says = "mujoco: gravity is 9.8 m/s², asked for 9.81"
    gravity = Difference(cause="gravity", where="mujoco", measured=9.8, expected=9.81, says=says)
    before = make.report(
        make.result(check="a"), make.result(check="b", measured=2.0), make.result("differs", check="c"),
        engines=[make.engine(version="4.0.0")],
    )  # fmt: skip
    results = (
        make.result("differs", check="a", measured=900.0, reason="gravity"),
        make.result(check="b", measured=9.0),
        make.result(check="c"),
    )
    diagnoses = (Diagnosis(scene="rods-2", engine="mujoco", findings=[gravity], explains=["a"]),)
    header = make.header(engines=[make.engine(version="4.1.0")])
    return before, Report(header, results, footer_of(results, diagnoses), diagnoses)


def test_the_verdict_comes_first_then_the_cause_then_each_change(make):
    page = to_diff_page(compare(*runs(make)))
    body = page[page.index("<body>") :]
    places = [
        body.index(words)
        for words in (
            "<h1>1 broke; 1 error grew; 1 fixed; 0 comparisons unchanged.</h1>",
            "gravity is 9.8 m/s², asked for 9.81",
            "<td>4.0.0</td><td>4.1.0</td>",
            "broke (1)",
            "<td>differs 900 ε</td>",
            "error grew (1)",
            "<td>4.5 ×</td>",
            "fixed (1)",
        )
    ]
    assert places == sorted(places)
    assert "<script" not in page


def test_a_cause_of_an_engine_that_did_not_change_is_not_told(make):
    _, after = runs(make)
    assert "gravity is 9.8" not in to_diff_page(compare(after, after))


def test_a_long_list_is_cut_and_says_so(make):
    names = [f"rods-{number}" for number in range(MOST + 5)]
    scenes = [make.scene(name) for name in names]
    before, after = (make.report(*(make.result(o, name) for name in names), scenes=scenes) for o in ("agrees", "error"))
    page = to_diff_page(compare(before, after))
    assert page.count('<th scope="row">rods-') == MOST
    assert "… and 5 more" in page


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
def test_on_paper_it_is_a_summary(make, tmp_path):
    names = [f"rods-{number}" for number in range(MOST)]
    scenes = [make.scene(name) for name in names]
    before, after = (make.report(*(make.result(o, name) for name in names), scenes=scenes) for o in ("agrees", "error"))
    path = tmp_path / "diff.html"
    path.write_text(to_diff_page(compare(before, after)), encoding="utf-8")
    with Browser() as browser:
        browser.open(path)
        assert browser.pages_on_paper() <= 4


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_is_text(make, text):
    page = to_diff_page(compare(everywhere(make, text, "agrees"), everywhere(make, text, "differs")))
    for markup in ("<script", "<img", "onmouseover='", "\x1b", "\u202e"):
        assert markup not in page.replace("&#39; onmouseover=&#39;", "")


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
def test_it_fits_and_can_be_read(make, tmp_path):
    path = tmp_path / "diff.html"
    path.write_text(to_diff_page(compare(*runs(make))), encoding="utf-8")
    with Browser() as browser:
        browser.open(path)
        for width in (1400, 800, NARROW):
            for dark in (False, True):
                browser.view(width, dark=dark)
                assert browser.run("document.documentElement.scrollWidth") <= width
                assert browser.run(LOW_CONTRAST) == []
        assert browser.run(NAMELESS) == []
        assert browser.run(OUTSIDE) == []
        assert browser.errors == []
        assert browser.requests == [path.as_uri()]
