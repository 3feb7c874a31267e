"""The page needs nothing but itself, says what a run was, and shows whatever came from outside as text."""

import itertools
import re
from html.parser import HTMLParser

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from furiko.reports.pages.check_page import load_templates, to_html
from furiko.reports.pages.rendering import environment
from furiko.reports.report import Report

VOID = {"meta", "br"}
OPTIONAL = {"td", "tr"}  # HTML lets a cell and a row end where the next begins
HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "' onmouseover='alert(1)",
    "</style></title></svg><script>1</script>",
    "]]>--><!--",
    "{{ 7*7 }}{% raw %}",
    "javascript:alert(1)",
    "\x00\x1b[2J\u202e\ud800\uffff",
    "<" * 5000,
]


class Page(HTMLParser):
    """Elements, attributes and text, and whether every element that must be closed was."""

    def __init__(self, html):
        super().__init__()
        self.elements, self.open, self.text = [], [], []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        while self.open[-1] != tag and self.open[-1] in OPTIONAL:
            self.open.pop()
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)

    def attributes(self, name):
        return [attrs[name] for _, attrs in self.elements if name in attrs]


def test_a_large_run_is_one_small_file_that_fetches_and_runs_nothing(make):
    html = to_html(make.large())
    page = Page(html)
    assert page.open == []
    assert len(html.encode()) < 1_000_000
    tags = {tag for tag, _ in page.elements}
    assert not tags & {"script", "link", "img", "iframe", "object", "embed", "form", "base", "image"}
    assert not page.attributes("src")
    assert all(target.startswith("#") for target in page.attributes("href"))
    assert not re.search(r"url\(|@import|https?://|file://", html)
    assert {"default-src 'none'; style-src 'unsafe-inline'"} <= set(page.attributes("content"))


def test_templates_loaded_ahead_are_those_that_the_page_uses(make):
    environment.cache_clear()
    load_templates()
    ahead = {name for _, name in environment().cache}
    environment.cache_clear()
    to_html(make.large())
    assert {name for _, name in environment().cache} == ahead


def test_every_link_leads_somewhere_and_every_id_is_one(make):
    page = Page(to_html(make.large()))
    ids = page.attributes("id")
    assert len(ids) == len(set(ids))
    assert {target[1:] for target in page.attributes("href")} <= set(ids)


def test_tables_have_headings_with_their_scope_and_pictures_a_text(make):
    page = Page(to_html(make.large(links=(1, 20, 64))))
    assert all(attrs.get("scope") in ("row", "col") for tag, attrs in page.elements if tag == "th")
    for tag, attrs in page.elements:
        if tag == "svg":
            assert attrs.get("aria-hidden") == "true" or (attrs.get("role") == "img" and attrs.get("aria-label"))
    headings = [tag for tag, _ in page.elements if re.fullmatch(r"h\d", tag)]
    assert headings[0] == "h1"
    assert headings.count("h1") == 1
    assert all(int(after[1]) <= int(before[1]) + 1 for before, after in itertools.pairwise(headings))


def test_it_says_what_was_run_and_what_came_out(make):
    html = to_html(make.large())
    for expected in (
        "2 of 1,135 comparisons differ; 35 failed; 1,133 agree; 90 skipped",
        "furiko check --profile full",
        "4.0.1",
        "an example",
        "takeno 22",
        "Σ_k M_jk θ̈_k = b_j",
        "furiko check rods-20 --profile full",
        "✗ differs 1.4e7 ×",
        "2.3e9 ε",
        "160 ε",
        "armature",
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


def skeleton(html):
    """Elements and the names of their attributes: what a text from outside must not change."""
    page = Page(html)
    assert page.open == []
    return [(tag, sorted(attrs)) for tag, attrs in page.elements]


def everywhere(make, text, outcome):
    """A run in which this text stands in every place that a stream has for text."""
    scene = make.scene(text, text, description=text, equations=[text, f"{text}: {text}"], tags=[text], source=text)
    engine = make.engine(text, formulation=text, package=text, version=text)
    named = {"scene": text, "engine": text}
    results = [
        make.result(
            outcome, check=text, unit=text, cause=text, reason=text, details={text: text, "l": [text]}, **named
        ),
        make.result("error", check=f"{text}!", reason=f"a\n{text}", details={"traceback": text}, **named),
    ]
    facts = {"command": text, "profile": text, "seed": text, "started": text, "furiko": text}
    tables = {"machine": {text: text}, "versions": {text: text}}
    return make.report(*results, scenes=[scene], engines=[engine], **facts, **tables)


@pytest.mark.parametrize("outcome", ["agrees", "differs", "skipped"])
@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_is_only_text(make, text, outcome):
    html = to_html(everywhere(make, text, outcome))
    assert skeleton(html) == skeleton(to_html(everywhere(make, "calm", outcome)))
    assert all(c.isprintable() or c == "\n" for c in html)


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
    for ink, paper in [("ink", "paper"), ("faint", "paper"), ("link", "paper"), ("ink", "panel")]:
        assert contrast(palette[ink], palette[paper]) >= 4.5
    for outcome in ("agrees", "differs", "error", "skipped", "loose"):
        assert contrast(palette[outcome], palette[f"{outcome}-paper"]) >= 4.5
    for i in range(8):
        assert contrast(palette[f"e{i}"], palette["paper"]) >= 3


def test_loose_results_are_shown_apart(make):
    html = to_html(make.report(make.result("loose", reason="Monte-Carlo rounding"), make.result(check="b")))
    assert '<li class="loose">≈ 1 loose</li>' in html
    assert '<td class="loose">' in html
    assert '<h2 id="loose">' in html
    assert "Monte-Carlo rounding" in html
    assert 'id="loose"' not in to_html(make.report(make.result()))
