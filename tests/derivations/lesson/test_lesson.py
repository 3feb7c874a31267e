"""The lesson's page: complete in itself, thirty mistakes, each with all its parts."""

import base64
import json
import struct
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from browser import CHROMIUM, LOW_CONTRAST, NAMELESS, Browser

from furiko.derivations.algebra.symbols import symbols_of
from furiko.derivations.lesson.choices import CHOICES
from furiko.derivations.lesson.lesson import GRID, changed_lines, lesson, write_lesson
from furiko.derivations.mistakes.catalogue import catalogue
from furiko.derivations.steps.derivation import correct_derivation, derive
from furiko.models.errors import InvalidInput


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.tags, self.text = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.text.append(data)

    def all(self, tag):
        return [attributes for found, attributes in self.tags if found == tag]


@pytest.fixture(scope="module")
def page():
    return Page(lesson())


@pytest.mark.slow
def test_it_needs_nothing_but_itself(page):
    for tag, attributes in page.tags:
        for name in ("src", "href"):
            assert attributes.get(name, "data:").startswith(("data:", "#")), (tag, attributes)
    assert not page.all("link")
    assert "http" not in "".join(page.text)


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
def test_it_can_be_read_in_both_themes(tmp_path):
    path = tmp_path / "lesson.html"
    path.write_text(lesson(), encoding="utf-8")
    papers = []
    with Browser() as browser:
        for dark in (False, True):
            browser.view(390, dark=dark)
            browser.open(path)
            browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true })")
            assert browser.run(LOW_CONTRAST) == []
            assert browser.run(NAMELESS) == []
            assert browser.run("document.documentElement.scrollWidth") <= 390
            papers.append(browser.run("getComputedStyle(document.body).backgroundColor"))
        assert browser.errors == []
    assert len(set(papers)) == 2


@pytest.mark.slow
def test_thirty_mistakes_with_a_question_before_the_answer(page):
    assert len(page.all("section")) == len(page.all("details")) == len(page.all("canvas")) == 30
    order = [tag for tag, attributes in page.tags if tag == "details" or attributes.get("class") == "question"]
    assert order == ["p", "details"] * 30


def test_maps_are_pictures_and_not_empty(page):
    for image in page.all("img"):
        data = base64.b64decode(image["src"].partition(",")[2])
        assert data.startswith(b"\x89PNG")
        assert struct.unpack(">II", data[16:24]) == (GRID, GRID)


def test_motions_start_alike_and_part(page):
    for canvas in page.all("canvas"):
        motion = json.loads(canvas["data-motion"])
        true, false = np.array(motion["right"]), np.array(motion["wrong"])
        assert np.isfinite(true).all()
        assert (true[0] == false[0]).all()
        shown = min(len(true), len(false))
        assert np.abs(true[:shown] - false[:shown]).max() > 0.05


@pytest.mark.parametrize("choice", CHOICES, ids=[choice.name for choice in CHOICES])
def test_each_has_a_wrong_and_a_right_line(choice):
    m = symbols_of(choice.kind, choice.n)
    mistake = next(mistake for mistake in catalogue(m) if mistake.name == choice.name)
    lines = list(changed_lines(m, mistake, derive(m, [mistake])))
    assert lines
    assert all(wrong.name == good.name and wrong.formula != good.formula for wrong, good in lines)
    assert correct_derivation(m).rows != derive(m, [mistake]).rows


def test_no_mistake_stands_there_twice():
    assert len({(choice.kind, choice.n, choice.name) for choice in CHOICES}) == len(CHOICES) == 30


LESSON = "furiko.derivations.lesson.lesson.lesson"


def test_the_page_is_written_over_an_older_one(tmp_path, monkeypatch):
    monkeypatch.setattr(LESSON, lambda: "the page")
    path = tmp_path / "lesson.html"
    path.write_text("older")
    assert write_lesson(path) == path
    assert path.read_text() == "the page"
    assert list(tmp_path.iterdir()) == [path]


def test_a_page_that_is_not_finished_leaves_the_older_one(tmp_path, monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr(LESSON, interrupted)
    path = tmp_path / "lesson.html"
    path.write_text("older")
    with pytest.raises(KeyboardInterrupt):
        write_lesson(path)
    assert path.read_text() == "older"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("place", ["missing/lesson.html", "file/lesson.html", "folder", "x" * 300])
def test_a_place_that_cannot_be_written_is_refused_in_one_line(tmp_path, monkeypatch, place):
    monkeypatch.setattr(LESSON, lambda: "the page")
    (tmp_path / "file").write_text("")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InvalidInput) as refused:
        write_lesson(tmp_path / place)
    assert str(refused.value).startswith(str(tmp_path / place)[:80])  # a path of hundreds of characters is shortened
    assert "\n" not in str(refused.value)


def test_a_device_is_written_and_stays_a_device(monkeypatch):
    monkeypatch.setattr(LESSON, lambda: "the page")
    assert write_lesson(Path("/dev/null")).is_char_device()
