"""Plots that can be asked: filter by engine and line, every point by mouse, touch and keyboard."""

import pytest
from browser import CHROMIUM, Browser
from stress_summaries import HEADER, summary

from furiko.records.bench import Bench, Motion, Point
from furiko.reports.pages.bench_page import to_html
from furiko.reports.pages.chain_page import chain_page
from furiko.reports.pages.stress_page import stress_page

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
SAID = "document.querySelector('{} .said').textContent"
SLIDER = "document.querySelector('{} input[type=range]')"
CHOOSE = "{{ const s = document.querySelector('{}'); s.value = '{}'; s.dispatchEvent(new Event('input')) }}"
MIDDLE = """(() => { scrollTo(0, 0); const m = document.querySelector('g.series use').getBoundingClientRect();
  return [m.x + m.width / 2, m.y + m.height / 2]; })()"""
TURNED = "the time falls from step 0.5 s to step 0.25 s"


@pytest.fixture(scope="module")
def browser():
    with Browser() as opened:
        yield opened


@pytest.fixture
def page(browser, tmp_path):
    def opened(html, width=1400):
        (tmp_path / "page.html").write_text(html, encoding="utf-8")
        browser.view(width, 844)
        browser.open(tmp_path / "page.html")
        return browser

    yield opened
    assert browser.errors == []
    assert [url for url in browser.requests if not url.startswith("file://")] == []


def bench(schemes=("Euler", "RK4")):
    """Two engines, two schemes each, two steps each; the finer step has a tenth of the error and half the time."""
    points = [
        Point(engine=engine, scheme=scheme, setting=step, by="step [s]", error=error, minimum=time, median=time,
              rounds=3, front=False)
        for engine in ("mujoco", "furiko") for scheme in schemes
        for step, error, time in ((0.5, 1e-2, 2e-3), (0.25, 1e-3, 1e-3))
    ]  # fmt: skip
    motion = Motion(
        scene="rods-2", system="rod-chain", n=2, duration=1, truth=0, points=points, reaches=[], left_out=[]
    )
    reaches = [
        {"error": 1e-6, "engine": engine, "scheme": scheme, "seconds": None, "reason": "rounding"}
        for engine in ("mujoco", "furiko")
        for scheme in schemes
    ]
    import msgspec

    motion = msgspec.convert(msgspec.to_builtins(motion) | {"reaches": reaches}, Motion)
    return Bench(
        furiko="1", started="now", command="furiko bench", machine={"cpu": "x"}, threads={}, versions={}, budget=1,
        seconds=1, notes=[], motions=[motion],
    )  # fmt: skip


def test_an_engine_is_shown_alone_and_its_points_are_said_by_the_keyboard(page):
    shown = page(to_html(bench()))
    shown.run(CHOOSE.format("figure.chart select", "furiko"))
    hidden = shown.run("[...document.querySelectorAll('g.series')].map((g) => getComputedStyle(g).display === 'none')")
    assert hidden == [True, True, False, False]
    assert shown.run("[...document.querySelectorAll('.legend button')].map((b) => b.ariaPressed)") == [
        "false",
        "false",
        "true",
        "true",
    ]
    shown.run(f"{SLIDER.format('figure.chart')}.focus()")
    shown.key("ArrowRight")
    expected = "furiko, Euler: step [s] 0.5: error 0.01 in 2 ms (fastest 2 ms, timed 3×)"
    assert shown.run(SAID.format("figure.chart")) == expected
    assert shown.run("document.activeElement.getAttribute('aria-valuetext')") == expected
    shown.run("document.querySelectorAll('.legend button')[2].click()")
    assert shown.run(f"{SLIDER.format('figure.chart')}.max") == "1"
    shown.run("document.querySelectorAll('.legend button')[3].click()")
    assert shown.run(SAID.format("figure.chart")) == "nothing is shown"


def test_a_finger_on_the_plot_finds_the_nearest_point(page):
    shown = page(to_html(bench(("Euler",))), 390)
    place = shown.run(MIDDLE)
    event = f"new PointerEvent('pointerdown', {{ clientX: {place[0] + 3}, clientY: {place[1] + 3}, bubbles: true }})"
    shown.run(f"document.querySelector('figure.chart svg').dispatchEvent({event})")
    assert shown.run(SAID.format("figure.chart")).startswith("mujoco, Euler: step [s] 0.25: error 1.0e-3 in 1 ms")
    assert shown.run("document.documentElement.scrollWidth") <= 390


def test_a_curve_that_turns_back_says_why(page):
    shown = page(to_html(bench()))
    said = shown.run("document.querySelector('details li').parentElement.textContent")
    assert shown.run(f"document.body.textContent.includes('{TURNED}')"), said


def test_a_line_without_marks_is_read_from_its_axes(page):
    """The energy of the made-up long run: 0, 0.1, 0.05 after 0, 500 and 1000 steps."""
    shown = page(stress_page(summary(), HEADER))
    number = shown.run(
        "[...document.querySelectorAll('figure.chart')].findIndex((f) => f.textContent.includes('mujoco Euler'))"
    )
    figure = f"document.querySelectorAll('figure.chart')[{number}]"
    shown.run(f"{figure}.querySelector('input').focus()")
    shown.key("ArrowRight")
    assert shown.run(f"{figure}.querySelector('.said').textContent") == "energy: steps 500, ΔE / E 0.1"


def test_a_stability_map_is_walked_square_by_square(page):
    shown = page(stress_page(summary(), HEADER))
    shown.run(f"{SLIDER.format('.maps figure')}.focus()")
    shown.key("ArrowUp")
    assert shown.run(SAID.format(".maps figure")).startswith("2, step 7.1e-04 s: holds (follows)")
    shown.key("ArrowRight")
    assert shown.run(SAID.format(".maps figure")).startswith("4, step 7.1e-04 s: holds (follows)")
    shown.key("ArrowRight")
    assert shown.run(SAID.format(".maps figure")).startswith("4, ")


def test_the_page_of_the_chain_can_be_asked_too(page):
    shown = page(chain_page(summary(), HEADER))
    figures = shown.run("document.querySelectorAll('figure.chart').length")
    assert figures > 0
    assert shown.run("document.querySelectorAll('figure.chart input[type=range]').length") == figures
