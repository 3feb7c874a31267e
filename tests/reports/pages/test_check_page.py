"""The page needs nothing but itself, says what a run was, and shows whatever came from outside as text."""

import base64
import hashlib
import itertools
import json
import re
from html.parser import HTMLParser

import pytest
from hostile_pages import HOSTILE, everywhere
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from furiko.reports.known import Entry, known_in
from furiko.reports.pages.check_page import load_templates, to_html
from furiko.reports.pages.rendering import environment
from furiko.reports.report import Report

VOID = {"meta", "br", "input"}


class Page(HTMLParser):
    """Elements, attributes and text, whether every element that must be closed was, and the data for the script."""

    def __init__(self, html):
        super().__init__()
        self.elements, self.open, self.scripts = [], [], []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            self.scripts.append(data)

    def attributes(self, name):
        return [attrs[name] for _, attrs in self.elements if name in attrs]

    @property
    def data(self):
        return json.loads(self.scripts[0])


def test_a_large_run_is_one_small_file_that_fetches_nothing_and_runs_its_own_script_alone(make):
    html = to_html(make.large())
    page = Page(html)
    assert page.open == []
    assert len(html.encode()) < 300_000  # 1,260 results: 3,000 stay under half a megabyte
    assert len(page.elements) < 400  # what is not looked at is no element
    tags = [tag for tag, _ in page.elements]
    assert not set(tags) & {"link", "img", "iframe", "object", "embed", "base", "image"}
    assert not page.attributes("src")
    assert not page.attributes("href")
    assert not page.attributes("action")
    assert not re.search(r"url\(|@import|file://|https?://(?!www\.w3\.org/)", html)  # names of MathML and SVG
    assert tags.count("script") == 2
    digest = base64.b64encode(hashlib.sha256(page.scripts[1].encode()).digest()).decode()
    (policy,) = [content for content in page.attributes("content") if "default-src" in content]
    assert policy == f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"


@pytest.mark.parametrize("never", ["innerHTML", "outerHTML", "insertAdjacent", "document.write", "eval(", "Function("])
def test_the_script_makes_no_markup_of_text(make, never):
    assert never not in Page(to_html(make.report())).scripts[1]


def test_templates_loaded_ahead_are_those_that_the_page_uses(make):
    environment.cache_clear()
    load_templates()
    ahead = {name for _, name in environment().cache}
    environment.cache_clear()
    to_html(make.large())
    assert {name for _, name in environment().cache} == ahead


def test_every_id_is_one_and_every_name_of_another_leads_somewhere(make):
    page = Page(to_html(make.large()))
    ids = page.attributes("id")
    assert len(ids) == len(set(ids))
    assert set(page.attributes("aria-labelledby")) <= set(ids)


def test_headings_are_in_order_and_table_headings_have_their_scope(make):
    page = Page(to_html(make.large(links=(1, 20, 64))))
    assert all(attrs.get("scope") in ("row", "col") for tag, attrs in page.elements if tag == "th")
    headings = [tag for tag, _ in page.elements if re.fullmatch(r"h\d", tag)]
    assert headings[0] == "h1"
    assert headings.count("h1") == 1
    assert all(int(after[1]) <= int(before[1]) + 1 for before, after in itertools.pairwise(headings))


def test_every_result_is_in_the_data_once_with_its_figures(make):
    report = make.large()
    data = Page(to_html(report)).data
    text, words = data["text"], data["words"]
    found = {
        (text[data["scenes"][scene]["name"]], text[data["engines"][engine]["name"]], text[data["checks"][row[0]]]): row
        for scene, engine, *_, rows in data["cells"]
        for row in rows
    }
    assert len(found) == len(report.results)
    differs = found["rods-20", "mujoco", "accelerations"]
    assert words[differs[1]] == "differs"
    assert [text[number] for number in differs[2:4]] == ["2.3e9 ε", "160 ε"]
    assert differs[4] == pytest.approx(2.3e9 / 160, rel=5e-3)  # three digits
    assert text[differs[7]] == "armature"
    assert text[data["scenes"][0]["equations"][0][0]] == "shiki 3.12"
    assert data["grave"] is True


def test_it_says_what_was_run_and_what_came_out(make):
    html = to_html(make.large())
    for expected in (
        "2 of 1,135 comparisons differ; 35 failed; 1,133 agree; 90 skipped",
        "furiko check --profile full",
        "4.0.1",
        "an example",
        "Σ_k M_jk θ̈_k = b_j",
        "furiko check rods-20 --profile full --no-cache",
        "-e exudyn-tree",
        "its inverse dynamics are not reachable from Python",
        "not installed",
    ):
        assert expected in html, expected


def test_a_run_that_was_cut_off_has_a_banner(make):
    whole = make.report(make.result())
    assert "cut off" not in to_html(whole)
    html = to_html(Report(whole.header, whole.results))
    assert re.search(r'role="alert">This run was cut off', html)
    assert "cut off" in to_html(Report(whole.header, ()))


def test_known_differences_are_told_and_marked(make):
    run = make.report(make.result("differs", measured=900.0), make.result("differs", check="b", measured=900.0))
    known = known_in(run, [Entry("rods-*", "mujoco", "issue 12", check="b", link="https://example.org/12")])
    page = to_html(run, known)
    assert "Known differences: 1 of 2 differences; 1 not known" in page
    assert "1 difference: issue 12 https://example.org/12" in page
    assert '<span class="differs mark"' in page
    (cell,) = Page(page).data["cells"]
    assert [row[9] if len(row) > 9 else None for row in cell[5]] == [None, 0]
    every = known_in(run, [Entry("rods-*", "mujoco", "issue 12")])
    assert '<span class="agrees mark"' in to_html(run, every)  # as `furiko check --known` ends with 0
    assert "Known differences" not in to_html(run)


HISTORY = [[1.0, 1e-6, 2e-6], [0.5, 1e-7, 2e-7], [2.0, 1e-3, None], [3.0, 0.0, "x"], ["no", 1, 1], 7]


def test_errors_over_time_are_data_of_their_own_and_bring_the_plots(make):
    details = {"errors over time": HISTORY, "step": 0.01, "Lyapunov time": 0.5}
    html = to_html(make.report(make.result(check="horizon RK4", details=details)))
    data = Page(html).data
    errors = [[0.5, 1, 2], [1e-7, 1e-6, 1e-3], [2e-7, 2e-6, None]]  # a logarithmic axis has no zero
    assert data["histories"] == [{"errors": errors, "motion": None}]
    assert "errors over time" not in data["text"]
    assert "0.5 s, in which a small difference grows e-fold" in data["text"]
    assert "var uPlot=" in html
    assert "The MIT License (MIT)" in html  # wherever uPlot goes
    assert "uPlot" not in to_html(make.report(make.result(details={"step": 0.01})))


MOVING = {"times": [0.0, 0.1], "theory": [[0.1, 0.2], [0.3, 0.4]], "engine": [[0.1, 0.2], [0.3, 0.5]]}


@pytest.mark.parametrize(
    "given",
    [7, {}, MOVING | {"times": [0.0]}, MOVING | {"times": [0.0, None]}, MOVING | {"engine": [[0.1, 0.2], [0.3]]}],
)
def test_a_motion_is_shown_only_where_it_is_whole(make, given):
    def motion(given):
        details = {"errors over time": HISTORY, "motion": given}
        return Page(to_html(make.report(make.result(details=details)))).data["histories"][0]["motion"]

    assert motion(MOVING) == MOVING | {"lengths": [0.8, 0.9], "fan": False}
    assert motion(given) is None


def skeleton(html):
    """Elements and the names of their attributes: what a text from outside must not change."""
    page = Page(html)
    assert page.open == []
    page.data  # noqa: B018 (it is still JSON)
    return [(tag, sorted(attrs)) for tag, attrs in page.elements]


@pytest.mark.parametrize("outcome", ["agrees", "differs", "skipped"])
@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_is_only_text(make, text, outcome):
    html = to_html(everywhere(make, text, outcome))
    assert skeleton(html) == skeleton(to_html(everywhere(make, "calm", outcome)))
    assert all(c.isprintable() or c == "\n" for c in html)
    data = html[html.index('id="data">') + 10 : html.rindex("<script>")].removesuffix("</script>\n")
    assert not set(data) & set("<>&")


@settings(deadline=None, max_examples=25, suppress_health_check=[HealthCheck.too_slow])
@given(text=st.text(min_size=1).filter(lambda text: "\n" not in text and ": " not in text))
def test_any_text_is_only_text(make, text):
    assert skeleton(to_html(everywhere(make, text, "differs"))) == skeleton(
        to_html(everywhere(make, "calm", "differs"))
    )


def colours(block):
    return dict(re.findall(r"--([\w-]+): (#[0-9a-f]{3,6});", block))


def luminance(colour):
    """Relative luminance as WCAG 2 defines it."""
    digits = colour[1:] if len(colour) == 7 else "".join(2 * c for c in colour[1:])
    channels = [int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_contrast_in_both_themes(make, theme):
    palette = colours(re.findall(r":root \{(.*?)\}", to_html(make.report()), flags=re.S)[theme])
    # WCAG AA: 4.5 for text, 3 for the parts of a picture.
    for ink, paper in [("ink", "paper"), ("faint", "paper"), ("link", "paper"), ("ink", "panel"), ("link", "panel")]:
        assert contrast(palette[ink], palette[paper]) >= 4.5
    for outcome in ("agrees", "differs", "error", "skipped", "loose"):
        assert contrast(palette[outcome], palette[f"{outcome}-paper"]) >= 4.5
    for i in range(8):
        assert contrast(palette[f"e{i}"], palette["paper"]) >= 3


def test_loose_results_are_shown_apart(make):
    html = to_html(make.report(make.result("loose", reason="Monte-Carlo rounding"), make.result(check="b")))
    assert '<li class="loose" data-word="loose">≈ 1 loose</li>' in html
    assert '<h2 id="loose">' in html
    assert "rounding gives at most 4 ε: Monte-Carlo rounding" in html
    assert 'id="loose"' not in to_html(make.report(make.result()))


def test_how_own_equations_were_read_is_told_once(make):
    said = "x is the joint 'slider'"
    page = Page(to_html(make.report(make.result(), scenes=[make.scene(own=[said])])))
    labels = [label for label, _ in page.data["scenes"][0]["about"]]
    assert labels.count("your equations") == 1
    assert len(labels) == len(set(labels))
    assert said in page.data["text"]
