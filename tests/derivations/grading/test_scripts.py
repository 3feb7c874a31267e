# ruff: noqa: E501 -- programs stand on one line
"""Scripts that derive the equations of motion by computer algebra: right ones are right, one slip is wrong, else refused.

``scripts/`` has the texts. Those of sympy are run here by sympy itself, and what they come to is held against first
principles: that is what furiko's verdict must be, of the script as it stands and of the script with a slip.
"""

import re
from pathlib import Path

import pytest
import sympy as sp
from mechanisms import bobs, cart_pole, l1, l2, m1, m2, pendulum
from test_programs_of_languages import slips_of
from truth import compare

from furiko.derivations.dialects.derived.derivatives import Derivatives
from furiko.derivations.dialects.traced.known import known
from furiko.derivations.dialects.traced.names import Names
from furiko.derivations.dialects.traced.values import Formula as Value
from furiko.derivations.grading.grade import grade, grade_text
from furiko.models.errors import InvalidInput

SCRIPTS = Path(__file__).parents[1] / "scripts"
NAMES = sorted(path.stem for path in SCRIPTS.glob("*.toml"))
TWO = bobs((l1, m1), (l2, m2))
F, c, x, th, w = sp.symbols("F c x th dth", real=True)
F, c = sp.symbols("F c")
# What a script of sympy comes to, its coordinates as it has them, and the mechanism
RUN = {
    "sympy-lambdify": ("[LE1, LE2]", ("the1", "the2"), TWO, {"l1": l1, "l2": l2}),
    "sympy-lagranges-method": ("list(LM.eom)", ("q1", "q2"), TWO, {}),
    "sympy-eq-loop": ("[e.lhs for e in eqs]", ("theta1", "theta2"), TWO, {}),
    "sympy-euler": ("[e.lhs for e in eqs]", ("theta1(t)", "theta2(t)"), TWO, {}),
    "sympy-mass-matrix": ("list(eom)", ("q1", "q2"), TWO, {}),
    "sympy-cart-pole": ("[eq1.lhs - eq1.rhs, eq2.lhs - eq2.rhs]", ("x", "theta"), cart_pole(forces={x: F}), {}),
    "sympy-drag": ("[eom]", ("theta",), pendulum(forces={th: -c * w}), {}),
}
MOST = 6


def parts_of(name):
    """The head of a file, its script and what stands behind it."""
    text = (SCRIPTS / f"{name}.toml").read_text(encoding="utf-8")
    head, script, rest = text.split("'''", 2)
    return head + "'''", script, "'''" + rest


def rows_by_sympy(name, script):
    """What sympy makes of a script, in the symbols of the mechanisms."""
    said, coordinates, mechanism, others = RUN[name]
    bare = re.sub(
        r"\.simplify\(\)|(?:sp\.)?simplify(?=\()", "", script.partition("sols =")[0].replace("import numpy as np", "")
    )
    bare = re.sub(r"(?m)^from scipy.*|, simplify$", "", bare)
    names = {}
    exec(bare, names)
    rows = eval(said, names)
    own = [eval(q, names) for q in coordinates]
    time = own[0].args[0] if own[0].args else None
    new = []
    for of, (q, v, a) in zip(own, mechanism.coordinates, strict=True):
        if of.args:
            new += [(sp.Derivative(of, (time, 2)), a), (sp.Derivative(of, time), v)]
        else:
            new += [(names["dd" + str(of)], a), (names["d" + str(of)], v)]
        new.append((of, q))
    positive = ("m1", "m2", "l1", "l2", "l", "m", "M")
    plain = {
        s: sp.Symbol(s.name, positive=True if s.name in positive else None)
        for s in sp.Matrix(rows).free_symbols
        if s != time
    }
    made = [sp.nsimplify(sp.expand(sp.sympify(row).doit())).subs(new) for row in rows]
    return [row.xreplace({k: v for k, v in plain.items() if k not in dict(new).values()}).subs(others) for row in made]


@pytest.mark.parametrize("name", NAMES)
def test_a_right_script_is_right(name):
    found = grade(SCRIPTS / f"{name}.toml")
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.slow
@pytest.mark.parametrize("name", RUN)
def test_what_sympy_makes_of_a_script_is_what_is_judged(name):
    head, script, rest = parts_of(name)
    assert compare(rows_by_sympy(name, script), RUN[name][2]) is None
    slips = slips_of(script)
    judged = 0
    for k in range(0, len(slips), max(1, len(slips) // MOST)):
        try:
            found = grade_text(head + slips[k] + rest)
        except InvalidInput:
            continue
        is_right = compare(rows_by_sympy(name, slips[k]), RUN[name][2]) is None
        assert is_right == (found.verdict == "correct") or found.assumes  # right in another convention, which is said
        judged += 1
    assert judged


# Of two links, where no slip is another convention
OF_TWO = [name for name in NAMES if re.search(r"coordinate = '\w*2'", "".join(parts_of(name)[::2]))]


@pytest.mark.slow
@pytest.mark.parametrize("name", OF_TWO)
def test_a_script_with_a_slip_is_never_right(name):
    head, script, rest = parts_of(name)
    slips = slips_of(script)
    verdicts = []
    for k in range(0, len(slips), max(1, len(slips) // MOST)):
        try:
            verdicts.append(grade_text(head + slips[k] + rest).verdict)
        except InvalidInput:
            verdicts.append("refused")
    assert "correct" not in verdicts
    assert verdicts.count("wrong") > len(verdicts) / 2


ONE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
{more}
[equations]
1 = '''
{text}
'''
"""
SYMPY = """from sympy import *
from sympy.physics.mechanics import dynamicsymbols, LagrangesMethod
m, l, g, t, a, w = symbols('m l g t a w')
theta = dynamicsymbols('theta')
L = m*l**2*theta.diff(t)**2/2 + m*g*l*cos(theta)
eq = L.diff(theta.diff(t)).diff(t) - L.diff(theta)
"""
COMES_TO = {
    "as it stands": ("correct", SYMPY),
    "put in for what is put in": ("refuse", SYMPY + "eq = eq.subs({theta.diff(t): theta, theta: w})\n"),
    "put in twice": ("refuse", SYMPY + "eq = eq.subs([(theta, w), (theta, a)])\n"),
    "a coordinate, and not its rates": ("refuse", SYMPY + "eq = eq.subs(theta, w)\n"),
    "no function of time": ("refuse", SYMPY.replace("dynamicsymbols('theta')", "symbols('theta')")),
    "a sign in Lagrange's equation": ("wrong", SYMPY.replace(" - L.diff(theta)", " + L.diff(theta)")),
    "its second part is lost": ("wrong", SYMPY.replace(" - L.diff(theta)", "")),
    "forces in the method": ("refuse", SYMPY.replace("eq = ", "LM = LagrangesMethod(L, [theta], forcelist=[a]) # ")),
    "not linear": ("wrong", SYMPY.replace("eq = ", "eq = theta.diff(t, 2)*") + "s = solve(eq, theta.diff(t, 2))\n"),
    "a number for a quantity": ("correct", SYMPY + "eq = eq.subs({m: 2, g: 9.81})\n"),
    "one side of it": ("refuse", SYMPY.replace("eq = L.diff(theta.diff(t)).diff(t) - L.diff(theta)", "eq_left = m*l**2*theta.diff(t, 2)")),
    "the wrong one for a solver": (
        "wrong",
        SYMPY + "acc = solve(eq, theta.diff(t, 2))[0]\nf = lambdify((theta, m, l, g), -acc)\n"
        "def rhs(t, y):\n    theta, v = y\n    return [v, f(theta, m, l, g)]\nodeint(rhs, y0, ts)\n",
    ),
    "a name twice in a function": (
        "refuse",
        SYMPY + "acc = solve(eq, theta.diff(t, 2))[0]\nf = lambdify((theta, l, l), acc)\n"
        "def rhs(t, y):\n    theta, v = y\n    return [v, f(theta, l, g)]\nodeint(rhs, y0, ts)\n",
    ),
    "a function that lacks an argument": (
        "refuse",
        SYMPY + "f = lambdify((w, m, l, g), solve(eq, theta.diff(t, 2))[0])\n"
        "def rhs(t, y):\n    theta, v = y\n    return [v, f(theta, m, l, g)]\nodeint(rhs, y0, ts)\n",
    ),
    "what integrates is not followed": (
        "refuse",
        SYMPY + "def rhs(t, y):\n    theta, v = y\n    if theta > 1:\n        v = 0\n    return [v, -g/l*sin(theta)]\nodeint(rhs, y0, ts)\n",
    ),
    "dynamicsymbols by their order": (
        "correct", SYMPY.replace("L = m*l**2*theta.diff(t)**2/2", "thd = dynamicsymbols('theta', level=1)\nL = m*l**2*thd**2/2"),
    ),
    "dynamicsymbols by another order": (
        "refuse", SYMPY.replace("L = m*l**2*theta.diff(t)**2/2", "thd = dynamicsymbols('theta', level=0)\nL = m*l**2*thd**2/2"),
    ),
    "a matrix by its size": (
        "correct", SYMPY.replace("L = ", "r = Matrix(2, 1, [l*sin(theta), -l*cos(theta)])\nv = r.diff(t)\nL = ").replace("m*l**2*theta.diff(t)**2/2", "m*v.dot(v)/2"),
    ),
    "a matrix by its size, sine for cosine": (
        "wrong", SYMPY.replace("L = ", "r = Matrix(2, 1, [l*sin(theta), -l*sin(theta)])\nv = r.diff(t)\nL = ").replace("m*l**2*theta.diff(t)**2/2", "m*v.dot(v)/2"),
    ),
    "in a class": (
        "correct",
        "import sympy as sp\nclass P:\n    def __init__(self):\n        self.t, self.m, self.l, self.g = sp.symbols('t m l g')\n"
        "        self.theta = sp.Function('theta')(self.t)\n    def energy(self):\n        w = self.theta.diff(self.t)\n"
        "        return self.m*self.l**2*w**2/2 + self.m*self.g*self.l*sp.cos(self.theta)\n    def equation(self):\n        L = self.energy()\n"
        "        return L.diff(self.theta.diff(self.t)).diff(self.t) - L.diff(self.theta)\np = P()\neq = p.equation()\n",
    ),
    "maxima, exponents": (
        "correct",
        "depends(theta, t)$\nL: m*(l*diff(theta,t))^2/2 + m*g*l*cos(theta)$\n"
        "eq: diff(diff(L, diff(theta,t)), t) - diff(L, theta)^1 = 0$\n",
    ),
    "maxima, a power of -1": (
        "wrong",
        "depends(theta, t)$\nL: m*l*2^-1*l*diff(theta,t)^2 + m*g*l^-1*cos(theta)$\n"
        "eq: diff(diff(L, diff(theta,t)), t) - diff(L, theta) = 0$\n",
    ),
    "mathematica, a quotient before a product": (
        "correct",
        "L = 1/2 m l^2 theta'[t]^2 + m g l Cos[theta[t]];\neq = D[D[L, theta'[t]], t] - D[L, theta[t]] == 0;\n",
    ),
    "mathematica, no equation of motion integrated": (
        "refuse",
        "L = 1/2 m l^2 theta'[t]^2 + m g l Cos[theta[t]];\neq = D[D[L, theta'[t]], t] - D[L, theta[t]] == 0;\n"
        "s = NDSolve[{theta[0] == 1, theta'[0] == 0}, theta, {t, 0, 1}]\n",
    ),
    "mathematica, another one integrated": (
        "wrong",
        "L = 1/2 m l^2 theta'[t]^2 + m g l Cos[theta[t]];\neq = D[D[L, theta'[t]], t] - D[L, theta[t]] == 0;\n"
        "s = NDSolve[{theta''[t] - g/l Sin[theta[t]] == 0, theta[0] == 1, theta'[0] == 0}, theta, {t, 0, 1}]\n",
    ),
    "matlab, a derivative by time that is not said": (
        "correct",
        "syms theta(t) m l g\nL = m*l^2*diff(theta)^2/2 + m*g*l*cos(theta);\n"
        "eq = diff(diff(L, diff(theta)), t) - diff(L, theta) == 0;\n",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("said", "text"), COMES_TO.values(), ids=COMES_TO)
def test_what_a_script_comes_to(said, text):
    text = ONE.format(more="", text=text)
    if said == "refuse":
        with pytest.raises(InvalidInput):
            grade_text(text)
    else:
        assert grade_text(text).verdict == said


def test_equations_behind_a_lagrangian_of_a_driven_mechanism_are_refused():
    """Whether the drive is forgotten there, or is left to its reader, is not known."""
    script = SYMPY.replace("eq = ", "eq = ")
    text = ONE.format(more="drive = 'tau'", text="").partition("[equations]")[0].replace(
        "[[bodies]]", f"lagrangian = '''\n{script}'''\n[[bodies]]")  # fmt: skip
    with pytest.raises(InvalidInput, match="driven or damped"):
        grade_text(text)


def test_a_length_that_is_called_l_is_no_lagrangian():
    script = (
        SYMPY.replace("l,", "L,")
        .replace(" l ", " L ")
        .replace("L = m*l**2", "lag = m*L**2")
        .replace("*l*", "*L*")
        .partition("eq =")[0]
        + "L = 1.5\n"
    )
    text = ONE.format(more="", text="").replace("'l'", "'L'").partition("[equations]")[0].replace(
        "[[bodies]]", f"lagrangian = '''\n{script}'''\n[[bodies]]")  # fmt: skip
    assert grade_text(text).verdict == "correct"


FORMULAS = ["sin(a*x) / (b + x^2)", "-(x - cos(x^2)^3)*tan(x)", "sqrt(a + x^2)*x^(-2)", "x*(a - b*(x - 1))^4/(2*x)"]


@pytest.mark.parametrize("text", FORMULAS)
def test_a_derivative_is_what_sympy_finds(text):
    names = Names(known({"bodies": [{"coordinate": "x"}]}))
    marked = re.sub(r"(?<![a-z])([abx])(?![a-z])", r"«\1»", text)
    found = Derivatives(names).by(Value(marked, 2), "x").text
    plain = [sp.sympify(re.sub(r"[«»]", "", one).replace("^", "**")) for one in (text, found)]
    assert sp.simplify(sp.diff(plain[0], sp.Symbol("x")) - plain[1]) == 0
