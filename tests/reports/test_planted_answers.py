"""Five planted faults: the cause stands in words on the first screen of page, terminal, Markdown and JUnit."""

import re
from pathlib import Path

import pytest
from browser import CHROMIUM, Browser
from planted_answers import FAULTS, shown, table

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytestmark = pytest.mark.slow
DOCUMENT = Path(__file__).parents[2] / "docs" / "reference" / "measured.md"
# Words of the fault as it was planted: in its own numbers, not in what furiko made of it.
WORDS = (
    ("gravity: found 9.8000, expected 9.8100", "every mass and inertia: found 1.0010 times"),
    ("length of link 1 to joint 2: found 1.0100, expected 1.0000 m",),
    ("the velocity terms: the sign is wrong", "in its accelerations alone"),
    ("the engine's process died of SIGABRT",),
    ("pos of a joint that comes from a default", "'elbow'", "the file says (0, 0, 0.1) m", "arm.xml, line 3"),
)
# What is said of causes and failures, and how far down it reaches [px].
TOLD = "[...document.querySelectorAll('[aria-labelledby=causes] li, [aria-labelledby=failed] li')]"
BOTTOM = f"Math.max(...{TOLD}.map((e) => e.getBoundingClientRect().bottom))"
SAID = f"{TOLD}.map((e) => e.innerText).join(' ')"


def without_numbers(text):
    return re.sub(r"[-\d.]+(e[-+]?\d+)?", "#", text)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """What each run shows, and its folder."""
    folders = [tmp_path_factory.mktemp("planted") for _ in FAULTS]
    return [(fault, shown(fault, folder), folder) for fault, folder in zip(FAULTS, folders, strict=True)]


def test_the_cause_is_on_the_first_screen_of_texts(found):
    for (_, one, _), words in zip(found, WORDS, strict=True):
        for word in words:
            assert word in one.junit
            assert word in one.terminal
            assert word in one.markdown


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
@pytest.mark.parametrize(("width", "height"), [(1400, 900), (390, 844)])
def test_the_cause_is_on_the_first_screen_of_the_page(found, width, height):
    with Browser() as browser:
        browser.view(width, height)
        for (_, _, folder), words in zip(found, WORDS, strict=True):
            browser.open(folder / "report.html")
            said = browser.run(SAID)
            assert all(word in said for word in words), said
            assert browser.run(BOTTOM) <= height


def test_the_table_in_the_documents_is_what_they_say(found):
    """Numbers of rounding are those of a machine; the words are not."""
    document = without_numbers(DOCUMENT.read_text(encoding="utf-8"))
    assert without_numbers(table([(fault, one) for fault, one, _ in found])) in document
