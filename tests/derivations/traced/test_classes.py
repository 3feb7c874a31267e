# ruff: noqa: E501 -- programs stand on one line
"""Classes of casadi that do all at their start, and of torch with parameters behind a property. The right one is correct,
each slip wrong.

By first principles: m l^2 theta'' = u - m g l sin(theta), and L = m l^2 theta'^2/2 + m g l cos(theta), from down.
"""

import pytest

from furiko.derivations.grading.grade import grade_text

FILE = """system = 'mechanism'
from = 'down'
{equation}
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
{drive}
[define]
w = "theta'"
'q[...,0:1]' = 'theta'
'v[...,0:1]' = "theta'"
{rows}
"""
CASADI = """import casadi as cs

class Swing:
    def __init__(self, m, l, g=9.81):
        theta, w = cs.SX.sym("theta"), cs.SX.sym("w")
        u = cs.SX.sym("u")
        x = cs.vertcat(theta, w)
        a = (u - m*g*l*cs.sin(theta))/(m*l**2)
        rhs = [w, a]
        self.f = cs.Function("f", [x, u], [cs.vertcat(*rhs)])"""
TORCH = """import torch
from torch import nn

class Swing(Base, nn.Module):
    def __init__(self, m, l, g):
        Base.__init__(self, qdim=1)
        nn.Module.__init__(self)
        self._m = nn.Parameter(torch.tensor([m]))
        self._l = nn.Parameter(torch.tensor([l]))
        self._g = g

    @property
    def _all(self):
        return (self._m, self._l, self._g)

    def lagrangian(self, q, v):
        m, l, g = self._all
        theta = q[...,0:1]
        w = v[...,0:1]
        T = 0.5*m*(l*w)**2
        V = -m*g*l*torch.cos(theta)
        return T - V"""
PROGRAMS = {
    "casadi": (CASADI, [("u - m*g", "u + m*g"), ("m*l**2", "m*l"), ("cs.sin", "cs.cos"), ("(u -", "(2*u -")]),
    "torch": (TORCH, [("-m*g", "m*g"), ("0.5*m*(l*w)**2", "m*(l*w)**2"), ("(l*w)**2", "l*w**2"), ("torch.cos", "torch.sin"), ("return T - V", "return T + V")]),
}  # fmt: skip
SLIPS = [(text, *slip) for text, slips in PROGRAMS.values() for slip in slips]


def judged(text):
    if "lagrangian" in text:
        return grade_text(FILE.format(equation=f"lagrangian = '''\n{text}\n'''", drive="", rows="")).verdict
    rows = f"[equations]\n1 = '''\n{text}\n'''"
    return grade_text(FILE.format(equation="", drive="drive = 'u'", rows=rows)).verdict


@pytest.mark.parametrize("text", [p[0] for p in PROGRAMS.values()], ids=PROGRAMS)
def test_it_is_read(text):
    assert judged(text) == "correct"


@pytest.mark.parametrize(("text", "old", "new"), SLIPS)
def test_each_slip_is_wrong(text, old, new):
    assert old in text
    assert judged(text.replace(old, new, 1)) == "wrong"


def test_parameters_that_change_places_behind_a_property_are_wrong():
    two = TORCH.replace("return (self._m, self._l, self._g)", "return (self._l, self._m, self._g)")
    assert judged(two.replace("m, l, g = self._all", "l, m, g = self._all")) == "correct"
