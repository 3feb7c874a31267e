"""``furiko.grade_text`` on texts, fields and sympy's objects, and what a notebook shows."""

from html.parser import HTMLParser

import pytest
import sympy as sp

import furiko

TEXT = """[equations]
1 = "l1*a1 + g*sin(t1) = 0"
"""
PROBLEM = {"system": "point-masses", "links": 1, "points": 4}
t = sp.symbols("t")
m, l, g = sp.symbols("m l g", positive=True)
theta = sp.Function("theta")(t)
LAGRANGIAN = m * l**2 * sp.diff(theta, t) ** 2 / 2 + m * g * l * sp.cos(theta)
ROW = sp.diff(sp.diff(LAGRANGIAN, sp.diff(theta, t)), t) - sp.diff(LAGRANGIAN, theta)  # Lagrange's, by sympy


def test_a_problem_is_a_file_or_its_fields(tmp_path):
    (tmp_path / "p.toml").write_text('system = "point-masses"\nlinks = 1\npoints = 4')
    for problem in (PROBLEM, tmp_path / "p.toml", str(tmp_path / "p.toml")):
        found = furiko.grade_text(TEXT, problem)
        assert (found.outcome, found.points, found.of) == ("correct", 4, 4)
    with pytest.raises(furiko.InvalidInput, match="cannot change it"):
        furiko.grade_text('system = "rods"\n' + TEXT, PROBLEM)


@pytest.mark.parametrize(
    "source",
    [ROW, [ROW], sp.Matrix([ROW]), sp.Eq(ROW, 0), [sp.Eq(sp.diff(theta, t, 2), -g / l * sp.sin(theta))], LAGRANGIAN],
)  # fmt: skip
def test_sympy_is_read(source):
    if source is ROW:  # alone it would be a Lagrangian
        with pytest.raises(furiko.InvalidInput, match="Eq"):
            furiko.grade_text(source, system="point-masses", links=1)
        return
    assert furiko.grade_text(source, system="point-masses", links=1).verdict == "correct"
    assert furiko.grade_text(source, PROBLEM).points == 4


def test_wrong_sympy_is_wrong():
    assert furiko.grade_text(sp.Eq(ROW, m * g * l * sp.sin(theta)), system="point-masses", links=1).verdict == "wrong"
    with pytest.raises(furiko.InvalidInput, match="int"):
        furiko.grade_text(3)


class Tags(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.open, self.seen, self.text = [], set(), ""
        self.feed(html)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.seen.add(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


def test_a_notebook_shows_mathematics():
    html = furiko.grade_text('system = "n-leg"\nlinks = 2\n[equations]\n1 = "l1*w1^2 = 0"\n2 = "a2 = 0"')._repr_html_()
    found = Tags(html)
    assert {"math", "msubsup", "msub", "mover"} <= found.seen
    assert '<msubsup><mover accent="true"><mi>θ</mi><mo>˙</mo></mover><mn>1</mn><mn>2</mn></msubsup>' in html


def test_nothing_of_a_submission_is_markup():
    label = "<img src=x onerror=alert(1)>"
    text = f'system = "point-masses"\nlinks = 1\n[equations]\n"{label}" = "l1*a1 = g*sin(t1)"'
    for shown in (furiko.grade_text(text), furiko.grade_text(text, PROBLEM)):
        assert Tags(shown._repr_html_()).seen <= {"p", "ul", "li", "strong", "math", "mrow", "mi", "mo", "mn", "msub",
                                                  "msup", "msubsup", "mover"}  # fmt: skip
    assert "&lt;img" in furiko.grade_text(text)._repr_html_()
