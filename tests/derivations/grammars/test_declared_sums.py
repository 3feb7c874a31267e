# ruff: noqa: E501 -- programs stand on one line
"""Programs of a body whose declared centre has a sum of masses below the line. The right one is correct, each slip wrong.

A rod of mass mr and a point md at its end about a pivot, theta from down, by first principles:
(mr l^2/3 + md l^2) theta'' = -g (mr/2 + md) l sin(theta).
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

FILE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'mr + md'
length = 'l'
centre = '(mr/2 + md)*l/(mr + md)'
inertia = 'mr*l^2/3 + md*l^2'
about = 'pivot'
[define]
{define}
[equations]
1 = '''
{text}
'''
"""
PROGRAMS = {
    "Python": "def f(theta, w):\n    J = (mr/3 + md)*l**2\n    M = g*(mr/2 + md)*l*sin(theta)\n    theta_ddot = -M/J\n    return w, theta_ddot",
    "C": "double acc(double theta) {\n  double J = (mr/3 + md)*l*l;\n  double M = g*(mr/2 + md)*l*sin(theta);\n  return -M/J;\n}",
    "MATLAB": "function dx = f(t, x)\nJ = (mr/3 + md)*l^2;\nM = g*(mr/2 + md)*l*sin(x(1));\ndx = [x(2); -M/J];\nend",
    "Modelica": "model Rod\n  parameter Real mr = 1;\n  parameter Real md = 2;\n  Real theta(start = 1);\n  Real w;\nequation\n  der(theta) = w;\n  (mr/3 + md)*l^2*der(w) = -g*(mr/2 + md)*l*sin(theta);\nend Rod;",
}
SLIPS = (("mr/3", "mr/2"), ("mr/2", "mr"), ("mr/2 + md", "mr/2 - md"), ("g*(mr/2 + md)", "g*(mr + md)/2"))


def file_of(text, define=""):
    return FILE.format(text=text, define=define)


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=PROGRAMS)
def test_a_declared_sum_below_the_line_is_read(text):
    assert grade_text(file_of(text)).verdict == "correct"


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=PROGRAMS)
@pytest.mark.parametrize(("old", "new"), SLIPS)
def test_each_slip_is_wrong(text, old, new):
    changed = text.replace(old, new)
    assert changed != text
    assert grade_text(file_of(changed)).verdict == "wrong"


def test_a_part_that_the_file_defines_itself_is_not_solved_for():
    with pytest.raises(InvalidInput, match="sum in a denominator"):
        grade_text(file_of(PROGRAMS["C"], "mr = '3*q'\nmd = 'q'"))
