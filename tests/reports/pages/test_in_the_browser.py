"""The page of a check in a real browser: every control, the keyboard, both themes, narrow windows, hostile text."""

import math
import re

import pytest
from browser import CHROMIUM, Browser
from hostile_pages import HOSTILE, everywhere

from furiko.records.check import Diagnosis
from furiko.records.entries import to_entries
from furiko.records.findings import Difference
from furiko.reports.known import Entry, known_in
from furiko.reports.pages.check_page import to_html
from furiko.reports.report import Report, footer_of

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")

CELL = "document.querySelector('[data-place=\"{}\"]')"
CHANGE = "{{ const e = document.getElementById('{}'); e.value = '{}'; e.dispatchEvent(new Event('input')) }}"
# Events come, plots are drawn and motions end when the browser gets to it, on a busy machine not at once: each is
# waited for. One that never comes ends the test, as the browser's own patience does.
UNTIL = "new Promise((kept) => {{ const look = () => {} ? kept() : setTimeout(look, 20); look(); }})"
TITLE = "document.getElementById('evidence-title').textContent"
ROWS = "[...document.querySelectorAll('#matrix-body tr')].map(r => r.cells[0].textContent)"
# Contrast as WCAG 2 defines it, of every element that has text of its own, against the first background behind it.
LOW_CONTRAST = """(() => {
  const channels = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const light = (colour) => { const [r, g, b] = channels(colour).map((c) => { c /= 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = (e) => { for (; e; e = e.parentElement) { const c = getComputedStyle(e).backgroundColor;
    if ((channels(c)[3] ?? 1) === 1) return c; } return 'rgb(255, 255, 255)'; };
  return [...document.querySelectorAll('body *')].filter((e) => e.checkVisibility()
    && [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())).map((e) => {
      const [a, b] = [light(getComputedStyle(e).color), light(behind(e))].sort((x, y) => y - x);
      return [(a + 0.05) / (b + 0.05), e.tagName, e.textContent.slice(0, 40)]; }).filter(([ratio]) => ratio < 4.5);
})()"""
NAMELESS = """[...document.querySelectorAll(
    'button, input, select, summary, [tabindex="0"], [role=img], dialog')].filter((e) => e.checkVisibility()
  && !(e.ariaLabel || e.labels?.length || document.getElementById(e.getAttribute('aria-labelledby'))?.textContent
    || (e.matches('button, summary') && e.textContent.trim()))).map((e) => e.outerHTML.slice(0, 80))"""
OUTSIDE = """[...document.body.children].map((e) => e.tagName.toLowerCase())
  .filter((name) => !['header', 'main', 'footer', 'dialog', 'script'].includes(name))"""
# The signs of a text, sorted, without those that are drawn otherwise: spaces, strokes of fractions, commas between
# formulas, bars; accents and sums under one name.
SIGNS = """((s) => [...[...s].map((c) => c.normalize('NFKD')).join('').replace(/[\\s\\/,;_\u2044|∨]/g, '')
  .replaceAll('˙', '\u0307').replaceAll('¨', '\u0308').replaceAll('^', '\u0302').replaceAll('∑', 'Σ')]
  .sort().join(''))"""


@pytest.fixture(scope="module")
def browser():
    with Browser() as opened:
        yield opened


@pytest.fixture
def page(browser, tmp_path):
    """Opens a report, or the text of a page, and gives the browser."""

    def opened(report, known=None, fragment=""):
        path = tmp_path / "report.html"
        path.write_text(report if isinstance(report, str) else to_html(report, known), encoding="utf-8")
        browser.view(1400)
        browser.open(path, fragment)
        return browser

    yield opened
    assert browser.errors == []
    assert [url for url in browser.requests if not url.startswith("file://")] == []


def go(shown, place):
    """Go to a place of the page's address, and wait until it is shown."""
    shown.run(f"""new Promise((kept) => {{
      if (location.hash.slice(1) === '{place}') return kept();
      addEventListener('hashchange', () => kept(), {{ once: true }}); // after the page's own, which was there before
      location.hash = '{place}';
    }})""")


def red(make) -> Report:
    """One engine with a wrong gravity in three scenes, which is known in one; another that crashes."""
    says = "mujoco: gravity is 9.8 m/s², asked for 9.81"
    gravity = Difference(cause="gravity", where="mujoco", measured=9.8, expected=9.81, says=says)
    scenes = ["rods-2", "rods-3", "n-leg-2"]
    results = [make.result(scene=scene, engine=engine) for scene in scenes for engine in ("pinocchio-aba",)]
    results += [
        make.result("differs", scene=scene, check=check, measured=10.0**size, reason="gravity")
        for size, scene in enumerate(scenes, start=3)
        for check in ("accelerations", "energy")
    ]
    results += [make.result("error", "rods-3", "exudyn-tree", reason="RuntimeError: no convergence")]
    results += [make.result("loose", "rods-2", "exudyn-tree")]
    diagnoses = tuple(
        Diagnosis(scene=scene, engine="mujoco", findings=[gravity], explains=["accelerations", "energy"])
        for scene in scenes
    )
    equation = "takeno 17: (lⱼ²/12) θ̈ⱼ" + " + Σₖ₌₁ⁿ lₖ sin(θⱼ − θₖ)" * 20 + " = 0"  # longer than any window is wide
    entries = [make.scene(name, equations=[equation], description=f"Chain {name}") for name in scenes]
    header = make.header(scenes=entries, engines=[make.engine(e) for e in ("mujoco", "pinocchio-aba", "exudyn-tree")])
    return Report(header, tuple(results), footer_of(results, diagnoses), diagnoses)


def test_what_is_not_looked_at_is_not_made(make, page):
    shown = page(make.large(links=range(1, 120), checks=("accelerations", "terms", "energy")))  # 4,284 results
    assert shown.run("document.querySelectorAll('*').length") < 6000
    assert shown.run(f"{ROWS}.length") == 100
    shown.run("document.getElementById('more').click()")
    assert shown.run(f"{ROWS}.length") == 200
    shown.run("document.getElementById('more').click()")
    assert shown.run(f"{ROWS}.length") == 238
    assert shown.run("document.getElementById('more').hidden")


def test_search_filters_and_sort(make, page):
    shown = page(red(make))
    assert shown.run(ROWS) == ["n-leg-2", "rods-3", "rods-2"]  # the worst first, where something differs
    shown.run(CHANGE.format("sort", "found"))
    assert shown.run(ROWS) == ["rods-2", "rods-3", "n-leg-2"]
    shown.run("document.querySelector('[data-sort=name]').click()")
    assert shown.run(ROWS) == ["n-leg-2", "rods-2", "rods-3"]
    assert shown.run("document.querySelector('#matrix-head th').ariaSort") == "ascending"
    shown.run("document.querySelector('[data-sort=\"0\"]').click()")
    assert shown.run(ROWS) == ["n-leg-2", "rods-3", "rods-2"]
    shown.run(CHANGE.format("query", "CHAIN rods"))
    assert shown.run(ROWS) == ["rods-3", "rods-2"]
    shown.run(CHANGE.format("show", "error"))
    assert shown.run(ROWS) == ["rods-3"]
    shown.run(CHANGE.format("query", "no such scene"))
    assert not shown.run("document.getElementById('nothing').hidden")
    shown.run("document.querySelector('#nothing button').click(); " + UNTIL.format(f"{ROWS}.length"))
    assert len(shown.run(ROWS)) == 3
    shown.run(CHANGE.format("engine", "2"))
    assert shown.run("document.querySelectorAll('#matrix-head th').length") == 2
    shown.run(CHANGE.format("engine", "-1") + CHANGE.format("check", "1"))
    assert shown.run(f"{CELL.format('0-0')}.textContent.trim()") == "✗ differs 1000 ε"
    assert shown.run(f"{CELL.format('0-1')}.textContent.trim()") == "no result"
    shown.run(CHANGE.format("check", "-1") + CHANGE.format("show", "cause0"))
    assert len(shown.run(ROWS)) == 3
    shown.run("document.querySelector('.counts [data-show=loose]').click()")
    assert shown.run(ROWS) == ["rods-2"]


def test_a_cell_opens_its_evidence_and_the_keyboard_does_all(make, page):
    shown = page(red(make))
    assert shown.run("document.getElementById('evidence-body').children.length") == 0
    shown.run(f"{CELL.format('2-0')}.focus()")
    shown.key("ArrowRight")
    assert shown.run("document.activeElement.dataset.place") == "2-1"
    shown.key("ArrowDown")
    assert shown.run("document.activeElement.dataset.place") == "1-1"
    shown.key("ArrowLeft")
    shown.key("Enter")
    shown.run(UNTIL.format("document.getElementById('evidence').open"))
    assert shown.run("location.hash") == "#1-0"
    said = shown.run("document.getElementById('evidence').innerText")
    for expected in (
        "rods-3 × mujoco",
        "mujoco: gravity is 9.8 m/s², asked for 9.81 [gravity]: explains 6 of 6 differences in 3 scenes",
        "1.0e4 ε",
        "64 ε",
        "furiko check rods-3 --profile full --no-cache -e mujoco",
    ):
        assert expected in said, expected
    shown.key("Escape")
    shown.run(UNTIL.format("location.hash === ''"))
    assert not shown.run("document.getElementById('evidence').open")
    assert shown.run("document.activeElement.dataset.place") == "1-0"
    assert shown.run("location.hash") == ""
    shown = page(red(make), fragment="#0")
    assert shown.run(TITLE) == "rods-2"
    shown.run(
        "document.querySelector('#evidence [data-place=\"0-2\"]').click(); " + UNTIL.format(f"{TITLE} !== 'rods-2'")
    )
    assert shown.run(TITLE) == "rods-2 × exudyn-tree≈ loose"
    assert "rounding gives at most 4 ε" in shown.run("document.getElementById('evidence-body').innerText")


def test_a_motion_plays_and_its_errors_are_said_at_every_time(make, page):
    history = [[t / 10, 10.0 ** (t - 8), 2 * 10.0 ** (t - 8)] for t in range(1, 6)]
    angles = [[0.1 * t, 0.2 * t] for t in range(6)]
    motion = {"times": [t / 10 for t in range(6)], "theory": angles, "engine": [[a, b + 0.1] for a, b in angles]}
    details = {"errors over time": history, "motion": motion}
    shown = page(make.report(make.result(check="horizon RK4", details=details)), fragment="#0-0")
    shown.run(
        "document.querySelector('#evidence details').open = true; "
        + UNTIL.format("document.querySelector('#evidence canvas')")
    )
    assert shown.run("document.querySelector('#evidence canvas').width") > 200
    shown.run("document.querySelector('#evidence [type=range]').focus()")
    for _ in range(2):
        shown.key("ArrowRight")
    shown.run("{ const s = document.activeElement; s.value = 400; s.dispatchEvent(new Event('input')) }")
    said = "0.20 s: predicted 1.0e-6 rad, measured 2.0e-6 rad"
    assert (
        shown.run("document.activeElement.ariaValueText ?? document.activeElement.getAttribute('aria-valuetext')")
        == said
    )
    # At 0.2 s the first link is at 0.2 rad, 0.8 m long, in a picture of 300 with 1.7 m to 136.
    end = shown.run("document.querySelector('.motion .body.theory').getAttribute('d')").split("L")[1]
    x, y = 150 + 80 * 0.8 * math.sin(0.2), 150 + 80 * 0.8 * math.cos(0.2)
    assert [float(v) for v in end.split()] == pytest.approx([x, y], abs=0.06)
    button = "document.querySelector('.player button')"
    shown.run(f"{button}.click(); " + UNTIL.format(f"{button}.textContent === 'Play'"))
    assert shown.run("document.querySelector('.player output').textContent").startswith("0.50 s")
    assert shown.run("document.querySelector('.player button').textContent") == "Play"


def heat_map(make):
    """A mass matrix with one entry that is off by 1e-10, an ε being 1e-16 of it."""
    entries = to_entries(
        "random 7", ["1", "2"], ["1", "2"], [[2.0, 0.5], [0.5, 1.0]], [[0.0, 1e-17], [1e-10, 0.0]],
        [[0.0, 0.05], [1e6, 0.0]], 50.0,
    )  # fmt: skip
    return make.report(make.result("differs", check="terms M", details=entries), make.result(engine="exudyn-tree"))


def test_a_matrix_is_a_heat_map_that_says_every_entry(make, page):
    shown = page(heat_map(make), fragment="#0-0")
    cells = "[...document.querySelectorAll('.heat tbody td')]"
    assert shown.run(f"{cells}.map((e) => e.className)") == ["h0", "h1", "h3", "h0"]
    assert shown.run(f"{cells}.map((e) => e.textContent)") == ["0", "2.0e-17", "2.0e-10", "0"]
    said = "document.querySelector('.entry').textContent"
    worst = "M[2, 1]: engine 0.5, theory 0.5: off by 1.0e-10, 2.0e-10 of the entry; 1.0e6 ε, rounding explains 50 ε"
    assert shown.run(said) == worst
    shown.run(f"{cells}[2].focus()")
    shown.key("ArrowUp")
    assert shown.run(said).startswith("M[1, 1]: engine 2, theory 2: no error")
    shown.key("ArrowRight")
    assert shown.run(f"document.activeElement === {cells}[1]")
    shown.run(f"{cells}[2].click()")  # a finger
    assert shown.run(said) == worst
    way = "document.querySelector('.heat').closest('details').querySelector('select')"
    shown.run(f"{{ const s = {way}; s.value = 'roundings'; s.dispatchEvent(new Event('input')) }}")
    assert shown.run(f"{cells}.map((e) => e.textContent)") == ["0", "0.05", "1.0e6", "0"]


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1400, 390])
def test_a_heat_map_fits_and_can_be_read(make, page, width, dark):
    shown = page(heat_map(make))
    shown.view(width, 844, dark=dark)
    go(shown, "0-0")
    assert shown.run("document.getElementById('evidence').scrollWidth") <= width
    assert shown.run(LOW_CONTRAST) == []
    assert shown.run(NAMELESS) == []


def test_known_differences_are_marked_and_can_be_left_out(make, page):
    report = red(make)
    shown = page(report, known_in(report, [Entry("n-leg-*", "mujoco", "issue 12")]))
    assert shown.run(f"{CELL.format('2-0')}.ariaLabel").endswith("known, n-leg-2, mujoco")
    shown.run(CHANGE.format("show", "new"))
    assert shown.run(ROWS) == ["rods-3", "rods-2"]


FORMULAS = {
    "θ̇₁² sin(θ₁ − θ₂)": "<msubsup><mover accent=true><mi>θ</mi><mo>˙</mo></mover><mn>1</mn><mn>2</mn></msubsup>"
    "<mspace width=0.17em></mspace><mi>sin</mi>"
    "<mrow><mo>(</mo><msub><mi>θ</mi><mn>1</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>2</mn></msub><mo>)</mo></mrow>",
    "lⱼ²/12": "<mfrac><msubsup><mi>l</mi><mi>j</mi><mn>2</mn></msubsup><mn>12</mn></mfrac>",
    "d/dt ∂L/∂q": "<mfrac><mi>d</mi><mrow><mi>d</mi><mi>t</mi></mrow></mfrac>"
    "<mfrac><mrow><mi>∂</mi><mi>L</mi></mrow><mrow><mi>∂</mi><mi>q</mi></mrow></mfrac>",
    "Σᵢ₌₂ⁿ⁺¹ M_jk": "<munderover><mo>∑</mo><mrow><mi>i</mi><mo>=</mo><mn>2</mn></mrow>"
    "<mrow><mi>n</mi><mo>+</mo><mn>1</mn></mrow></munderover><msub><mi>M</mi><mrow><mi>j</mi><mi>k</mi></mrow></msub>",
    "[a, 0; b, c]": "<mrow><mo>[</mo><mtable><mtr><mtd><mi>a</mi></mtd><mtd><mn>0</mn></mtd></mtr>"
    "<mtr><mtd><mi>b</mi></mtd><mtd><mi>c</mi></mtd></mtr></mtable><mo>]</mo></mrow>",
    "Lⱼ∨ₖ": "<msub><mi>L</mi><mrow><mi>j</mi><mo>∨</mo><mi>k</mi></mrow></msub>",
    "2 < 3)": "<mn>2</mn><mo>&lt;</mo><mn>3</mn><mo>)</mo>",
}


def test_equations_are_typeset(make, page):
    shown = page(red(make))
    for formula, expected in FORMULAS.items():
        found = shown.run(f"furikoFormula({formula!r}).map((m) => m.innerHTML).join()").replace('"', "")
        assert found == f"<mrow>{expected}</mrow>", formula
    assert shown.run("furikoFormula('x = 1, y = Σᵢ₌₂,₃ mᵢ').length") == 2
    assert shown.run("furikoFormula('(['.repeat(900)).length") == 1


def test_every_equation_of_the_documents_is_typeset_whole(page, make):
    """No sign is lost but spaces, strokes of fractions, and commas between formulas and in matrices."""
    from furiko.reference import EQUATIONS

    shown = page(red(make))
    for equation in EQUATIONS:
        said = f"furikoFormula({equation.formula!r}).map((m) => m.textContent).join(' ')"
        assert shown.run(f"{SIGNS}({said})") == shown.run(f"{SIGNS}({equation.formula!r})"), equation.formula


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_stays_text_when_it_is_looked_at(make, page, text):
    shown = page(everywhere(make, text, "differs"))
    go(shown, "0-0")
    shown.run("document.querySelectorAll('details').forEach((d) => { d.open = true })")
    go(shown, "0")
    assert shown.run("document.querySelectorAll('img, iframe, object, embed, form:not(#filters)').length") == 0
    assert shown.run("document.querySelectorAll('script').length") == 2
    assert shown.run("document.querySelector('[onerror], [onmouseover]')") is None


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1400, 800, 390])
def test_it_fits_and_can_be_read(make, page, width, dark):
    shown = page(red(make), known_in(red(make), [Entry("n-leg-*", "mujoco", "issue 12")]))
    shown.view(width, 844, dark=dark)
    for place in ("", "1-0", "1"):
        go(shown, place)
        assert shown.run("document.documentElement.scrollWidth") <= width, place
        assert shown.run("document.getElementById('evidence').scrollWidth") <= width, place
        assert shown.run(LOW_CONTRAST) == [], place
        assert shown.run(NAMELESS) == [], place
    assert shown.run(OUTSIDE) == []


def test_on_paper_it_is_a_summary(make, page):
    shown = page(make.large(links=range(1, 120)))
    assert shown.pages_on_paper() <= 4


def test_without_javascript_it_is_a_summary(make, page):
    html = re.sub(r"<script>.*?</script>", "", to_html(red(make)), flags=re.S)
    shown = page(html)
    said = shown.run("document.body.innerText")
    assert "6 of 10 comparisons differ; 1 failed; 1 is loose; 3 agree." in said
    assert "mujoco: gravity is 9.8 m/s²" in said
    assert "By engine" in said


def test_a_run_without_results_opens(make, page):
    shown = page(Report(make.header(scenes=[], engines=[]), ()))
    assert shown.run(ROWS) == []
