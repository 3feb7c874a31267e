# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""A function of a program, pasted whole: its text is followed and never run; what is not plain is refused."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

CART = """system = 'cart-pole'
from = 'up'
sense = 'clockwise'
[equations]
1 = '''{}'''
"""
# (M + m sin² θ) ẍ = m sin θ (l θ̇² − g cos θ), l θ̈ = g sin θ − ẍ cos θ: by hand, θ from the upward vertical, clockwise
SAME = {
    "odeint": """
import numpy as np
g = 9.81
def f(y, t, M, m, l):
    "derivatives"
    x, theta, v, w = y
    s, c = np.sin(theta), np.cos(theta)
    acc = m*s*(l*w**2 - g*c)/(M + m*s**2)   # cart
    return [v, w, acc, (g*s - acc*c)/l]
sol = odeint(f, y0, t)""",
    "another order": """def f(t, y):
    x, v, theta, w = y
    a = m*np.sin(theta)*(l*w**2 - g*np.cos(theta))/(M + m*np.sin(theta)**2)
    return np.array([v, a, w, (g*np.sin(theta) - a*np.cos(theta))/l])""",
    "filled in order": """def f(state, t):
    x, theta, v, w = state
    dydx = np.zeros_like(state)
    dydx[0] = state[2]
    dydx[1] = state[3]
    dydx[2] = m*sin(theta)*(l*w*w - g*cos(theta))/(M + m*sin(theta)**2)
    dydx[3] = (g*sin(theta) - dydx[2]*cos(theta))/l
    return dydx""",
    "a class": """class CartPole:
    def __init__(self, M, m, l):
        self.M, self.m, self.l = M, m, l
    def rhs(self, t, y):
        x, theta, v, w = y
        A = np.array([[self.M + self.m, self.m*self.l*np.cos(theta)], [np.cos(theta), self.l]])
        b = np.array([self.m*self.l*w**2*np.sin(theta), g*np.sin(theta)])
        acc, alpha = np.linalg.solve(A, b)
        return v, w, acc, alpha""",
    "MATLAB": """function dy = f(t, y, p)
% cart and pole
x = y(1); th = y(2); v = y(3); w = y(4);
A = [p.M + p.m, p.m*p.l*cos(th); cos(th), p.l];
dy = [v; w; A \\ [p.m*p.l*w^2*sin(th); p.g*sin(th)]];
end""",
    "JavaScript": """const f = (t, [x, th, v, w]) => [v, w, m*Math.sin(th)*(l*w*w - g*Math.cos(th))/(M + m*Math.sin(th)**2),
  (g*Math.sin(th) - m*Math.sin(th)*(l*w*w - g*Math.cos(th))/(M + m*Math.sin(th)**2)*Math.cos(th))/l];""",
    "Julia, in place": """function cartpole!(du, u, p, t)
    x, θ, v, ω = u
    M, m, l, g = p
    du[1] = v
    du[2] = ω
    du[3] = m*sin(θ)*(l*ω^2 - g*cos(θ))/(M + m*sin(θ)^2)
    du[4] = (g*sin(θ) - du[3]*cos(θ))/l
end""",
    "C": """static void rhs(double t, const double y[], double dydt[]) {
  const double theta = y[1], v = y[2], w = y[3]; /* y[0] is x */
  double s = sin(theta), c = cos(theta), x = y[0];
  dydt[0] = v;
  dydt[1] = w;
  dydt[2] = m*s*(l*w*w - g*c)/(M + m*pow(s, 2)); // cart
  dydt[3] = (g*s - dydt[2]*c)/l;
}""",
    "the inverse's product": """def f(t, z):
    x, th, v, w = z
    A = np.array([[M + m, m*l*np.cos(th)], [np.cos(th), l]])
    b = np.array([m*l*w**2*np.sin(th), g*np.sin(th)])
    acc = np.linalg.inv(A).dot(b)
    return [v, w, acc[0], acc[1]]""",
    "a name more than once": """def f(t, y):
    x, theta, v, w = y
    a = l*w**2 - g*np.cos(theta)
    a = m*np.sin(theta)*a
    a = a/(M + m*np.sin(theta)**2)
    return v, w, a, (g*np.sin(theta) - a*np.cos(theta))/l""",
}


@pytest.mark.parametrize("how", SAME)
def test_a_cart_and_a_pole_as_a_function(how):
    found = grade_text(CART.format(SAME[how]))
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize("how", SAME)
def test_and_with_gravity_the_other_way_it_is_wrong(how):
    text = SAME[how].replace("g*c)", "-g*c)").replace("(g*", "(-g*").replace("- g*", "+ g*").replace("p.g", "-p.g")
    text = text.replace(
        "b = np.array([self.m*self.l*w**2*np.sin(theta), g", "b = np.array([self.m*self.l*w**2*np.sin(theta), -g"
    )
    text = text.replace("np.sin(th), g*", "np.sin(th), -g*")
    assert text != SAME[how]
    assert grade_text(CART.format(text)).verdict == "wrong"


ROD = """system = 'mechanism'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
centre = 'l/2'
inertia = 'm*l^2/12'
[equations]
1 = '''
{}
'''
"""
INSIDE = """class Rod:
    def __init__(self, m, l):
        self.m, self.l = m, l
        self.I = self.m*self.l**2/{}
    def rhs(self, t, y):
        theta, w = y
        return w, -self.m*g*self.l/2*np.sin(theta)/self.I"""


def test_what_is_said_outside_of_the_function_counts():
    assert grade_text(ROD.format(INSIDE.format(3))).verdict == "correct"
    assert grade_text(ROD.format(INSIDE.format(12))).verdict == "wrong"
    module = "I = m*l**2/3\ndef f(y, t):\n    theta, w = y\n    return [w, -m*g*l/2*sin(theta)/I]"
    assert grade_text(ROD.format("import math\n" + module)).verdict == "correct"
    assert grade_text(ROD.format("import math\n" + module.replace("/3", "/12"))).verdict == "wrong"


@pytest.mark.parametrize("text", ["import math\ng = -9.81\n{}", "{}"])
def test_a_negative_g_is_refused(text):
    body = "def f(y, t, g=-9.8):\n    theta, w = y\n    return [w, 3*g/(2*l)*sin(theta)]"
    with pytest.raises(InvalidInput, match="without its sign"):
        grade_text(ROD.format(text.format(body if "=" not in text else body.replace("=-9.8", ""))))


TWO = "system = 'double-pendulum'\n[equations]\n1 = '''{}'''\n"
REFUSED = [
    ("def f(y, t):\n    x, th, v, w = y\n    if w > 0:\n        v = 0\n    return v, w, 0, 0", "write out what a loop or a con"),
    ("def f(y, t):\n    x, th, v, w = y\n    return 0, 0, v, w", "is not plain"),
    ("def f(y, t):\n    x, th, v, w = y\n    return w, v, th, x", "is not plain|which coordinate"),
    ("def f(y, t):\n    x, th, v, w = y\n    return v, 2*w, 0, 0", "is not plain"),
    ("def f(y, t):\n    x, th, v, w = y\n    return v, w", "returns 2 values for 2 coordinates"),
    ("def f(y, t):\n    y[0] = 3\n    return y", "the state itself is changed"),
    ("def f(y, t):\n    x, th, v, w = y\n    d = zeros(4)\n    d[1] = w\n    return d", "fill them in order"),
    ("def f(y, t):\n    x, th, v, w = y\n    w += 1\n    return v, w, 0, 0", "assignments and one return"),
    ("def f(y, t):\n    return y[1], 0, y[3], 0", r"y\[0\]"),
    ("def f(y):\n    return 1\ndef h(y):\n    return 2", "2 functions"),
    ("def f(y, t):\n    a, b, c, d, e = y\n    return a", "5 names"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "says"), REFUSED)
def test_what_is_not_plain_is_refused_with_what_to_write(text, says):
    with pytest.raises(InvalidInput, match=says):
        grade_text(CART.format(text))


def test_a_state_without_names_is_said_in_define():
    body = "def f(t, y):\n    return [y[2], y[3], -g/l1*sin(y[0]), 0]"
    with pytest.raises(InvalidInput, match="which coordinate is place 1 of the state"):
        grade_text(TWO.format(body))
    said = TWO.format(body) + "[define]\n'y[0]' = 'theta1'\n'y[1]' = 'theta2'\n"
    assert grade_text(said).verdict == "wrong"


def test_a_division_of_whole_numbers_is_no_remark():
    with pytest.raises(InvalidInput):
        grade_text(TWO.format("def f(y, t):\n    t1, t2, w1, w2 = y\n    return w1, w2, g*sin(t1) // l1, 0"))
