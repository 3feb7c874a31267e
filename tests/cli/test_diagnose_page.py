"""The page of ``furiko diagnose --out``: what it says and draws, and that nothing in it is ever run."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from furiko.cli.main import run
from furiko.models.readers.model_file import read_model
from furiko.models.trees.system import tree_of
from furiko.reference.outline import outline

# Two hinges about z: the mechanism lies in x-y and reaches nowhere along z, so that it is seen along z.
FLAT = """<mujoco model="flat"><worldbody><body name="{name}"><joint name="a" axis="0 0 1"/>
<inertial pos="0.5 0 0" mass="1" diaginertia="0.1 0.1 0.1"/>
<body name="lower" pos="1 0 0"><joint name="b" axis="0 0 1"/>
<inertial pos="0 0.5 0" mass="2" diaginertia="0.1 0.1 0.1"/></body></body></worldbody></mujoco>"""


class Tags(HTMLParser):
    """Names of the tags of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.append(tag)


def page_of(tmp_path: Path, text: str) -> str:
    model, page = tmp_path / "model.xml", tmp_path / "page.html"
    model.write_text(text, encoding="utf-8")
    assert run(["diagnose", str(model), "-e", "mujoco", "--out", str(page)]) == 0
    return page.read_text(encoding="utf-8")


def test_page_says_the_verdict_and_draws_the_mechanism(tmp_path: Path) -> None:
    page = page_of(tmp_path, FLAT.format(name="upper"))
    assert "<h1>Agrees: mujoco does what the file says</h1>" in page
    lines = [tuple(map(float, found)) for found in re.findall(r'x1="(.+?)" y1="(.+?)" x2="(.+?)" y2="(.+?)"', page)]
    spans = sorted((round(abs(u - x), 1), round(abs(w - y), 1)) for x, y, u, w in lines)
    # The upper link is 1 m to the right, the lower one's centre of mass 0.5 m up: the box is 300 - 2 x 12 wide.
    assert spans == [(0.0, 138.0), (276.0, 0.0)]


def test_names_in_the_file_are_never_markup(tmp_path: Path) -> None:
    hostile = "&lt;script&gt;alert(1)&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;"
    page = page_of(tmp_path, FLAT.format(name=hostile))
    assert not {"script", "img", "iframe", "link"} & set(Tags(page).tags)
    assert "&lt;script&gt;alert(1)" in page


@pytest.mark.parametrize(("across_least", "ends"), [(False, [(0, 0, 1, 0)]), (True, [(0, 0, 1, 0), (1, 0, 1, 0.5)])])
def test_a_mechanism_is_seen_along_the_axis_of_its_least_reach(
    tmp_path: Path, across_least: bool, ends: list[tuple[float, ...]]
) -> None:
    """Seen along y the second link is a point, and left out."""
    path = tmp_path / "model.xml"
    path.write_text(FLAT.format(name="upper"), encoding="utf-8")
    mechanism = read_model(path).spatial
    assert mechanism is not None
    found = outline(mechanism, tree_of(mechanism).reference, across_least=across_least)
    np.testing.assert_allclose(found, ends, atol=1e-12)  # numbers of order 1, added once or twice
