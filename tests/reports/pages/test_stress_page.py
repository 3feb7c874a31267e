"""The pages of stress and chain are whole, offline and escaped, and show the summary."""

import base64
import hashlib
import re
from html.parser import HTMLParser

import pytest
from stress_summaries import HEADER, POINT, document, frontier, summary

from furiko.reports.pages.chain_page import chain_page
from furiko.reports.pages.stress_page import stress_page, write_pages
from furiko.reports.words import figure


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
    (script,) = re.findall(r"<script>(.*?)</script>", page, flags=re.S)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'" in page


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


def test_open_mechanisms_have_a_table_of_their_own_with_the_share_of_the_bound():
    point = {**POINT, "value": 4.0, "error": 1e-9, "error over bound": 3e4, "at": "4"}
    tree = frontier(axis="arm-7: fast", mechanism="arm-7", engine="pinocchio-aba", curve=[point], **{"fails at": "4"})
    page = stress_page(summary(frontiers=[frontier(), tree]), HEADER)
    documents, trees = page.split('<h2 id="trees">Open mechanisms</h2>')
    assert "arm-7: fast" not in documents.partition("<h3>Errors")[0]
    assert "pinocchio-aba" not in documents.partition("<h3>Errors")[0]
    assert "arm-7: fast" in trees
    assert f"{figure(3e4)} of the bound" in trees
    assert 'id="trees"' not in stress_page(summary(), HEADER)
