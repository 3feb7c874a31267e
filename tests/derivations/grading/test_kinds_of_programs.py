# ruff: noqa: E501 -- programs stand on one line
"""Kinds of programs, each with one that is right and the same with single slips: Lua, R, Fortran, Modelica, arrays, time."""

import tomllib
from pathlib import Path

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

COLLECTION = Path(__file__).parents[1] / "seventh_programs"
PENDULUM = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
{more}
[define]
{define}
[equations]
1 = '''
{text}
'''
"""


def verdict(text, more="", define=""):
    """What is said of a pendulum's program; "refuse" where it is not read."""
    try:
        return grade_text(PENDULUM.format(text=text, more=more, define=define)).verdict
    except InvalidInput:
        return "refuse"


def changed(name, *pairs):
    """A text of the collection with other parts in it, and the verdict."""
    text = (COLLECTION / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in pairs:
        assert text.count(old) >= 1
        text = text.replace(old, new)
    return grade_text(text).verdict


# What was wrong in the collection is right once its mistake is mended, and wrong again with another
MENDED = {
    "np-python-first-masses": ([("range(n - i)", "range(i, n)")], ("-g*coeffs", "g*coeffs")),
    "dp-python-one-line": ([("np.cos( 2 * A - B )", "np.cos( 2 * (A - B) )")], ("p ** 2 * l1 * ( m1 + m2 )", "p ** 2 * l1 * m1")),
    "cp-python-other-rates": (
        [("mp * l * phi ** 2", "mp * l * phi_ ** 2"), ("s_ ** 2", "phi_ ** 2")], ("(4 / 3 * l", "(1 / 3 * l"),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MENDED)
def test_a_wrong_program_is_right_once_it_is_mended(name):
    mended, slip = MENDED[name]
    assert changed(name, *mended) == "correct"
    assert changed(name, *mended, slip) == "wrong"


# A slip in each of the collection's programs that were read last
SLIPS = {
    "tp-mathematica-sums": [("y[k_] := -Sum", "y[k_] := Sum"), ("{i, 1, k}];\ny", "{i, 2, k}];\ny"), ("- D[L,", "+ D[L,")],
    "dp-lua-global-names": [("bottom = -l1*", "bottom = l1*"), ("1+m1/m2", "1+m2/m1")],
    "dp-jax-energies": [("return K - P", "return K + P"), ("2 * l1 * l2", "l1 * l2"), ("h1 - l2", "h1 + l2")],
    "dp-maxima-loops": [("r*sin(alpha)+r*sin(beta)$", "r*sin(alpha)-r*sin(beta)$"), ("1/2*m", "m"), ("T - V$", "T + V$")],
    "dp-fortran77-common": [("(XL2/XL1)*bas1", "(XL1/XL2)*bas1"), ("dy(3) = yin(4)", "dy(3) = yin(2)"), ("- (XM1+XM2)*XG*sin(yin(1))", "+ (XM1+XM2)*XG*sin(yin(1))")],
    "cp-matlab-casadi-config": [("+ u + m2*g", "- u + m2*g"), ("(1 - cos(q2)^2));\nddq2", "(1 - cos(q2)));\nddq2")],
    "cp-r-desolve-friction": [("- cp * w", "+ cp * w"), ("m * L^2 / 3", "m * L^2 / 12"), ("v = acc[1], w = acc[2]", "v = acc[2], w = acc[1]")],
    "dc-sympy-jacobians": [("p1 = pc + r1/2", "p1 = pc + r1"), ("K2 - P1 - P2", "K2 - P1 + P2"), ("Matrix([s, a, b])", "Matrix([s, b, a])")],
    "el-maxima-two-springs": [("+m1*g*ya", "-m1*g*ya"), ("k1/2*(s1-s01)^2", "k1*(s1-s01)^2"), ("yb: ya+", "yb: ")],
    "sp-java-constants": [("+ (amplitude", "- (amplitude"), ("Math.cos(DRIVE", "Math.sin(DRIVE"), ("Math.pow(LENGTH, 2))) * rate", "LENGTH)) * rate")],
    "mv-c-gsl-reduced": [("(1. - 0.01", "(1. + 0.01"), ("0.01 * Omega * Omega", "0.01 * Omega"), ("sin(Omega*tau)) *", "cos(Omega*tau)) *")],
}  # fmt: skip


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_in_a_program_of_the_collection_is_never_right(name):
    head, mark, rest = (COLLECTION / f"{name}.toml").read_text(encoding="utf-8").partition("'''")
    script, end, behind = rest.partition("'''")
    found = []
    for old, new in SLIPS[name]:
        assert old in script
        try:
            found.append(grade_text(head + mark + script.replace(old, new) + end + behind).verdict)
        except InvalidInput:
            found.append("refuse")
    assert "wrong" in found
    assert set(found) <= {"wrong", "refuse"}


LUA = "local function f(t, y)\n local theta, w = y[1], y[2]\n if w > 1e9 then print('fast') end\n return { w, -g/l*math.sin(theta) }\nend"
R = "f <- function(t, y, p) {\n theta <- y[1]; w <- y[2]\n A <- matrix(c(m*l^2, 0, 0, 1), 2, 2)\n a <- solve(A) %*% c(-m*g*l*sin(theta), 0)\n list(c(w, a[1]))\n}"
NAMED = "f <- function(t, y, p) {\n with(as.list(c(y, p)), {\n  a <- -g/l*sin(theta)\n  list(c(w, a))\n })\n}"
FORTRAN = (
    "subroutine f(n, t, y, dy)\n integer n\n real(8) t, y(n), dy(n), a(2)\n if (n /= 2) stop 'no'\n call force(y, a)\n"
    " dy(1) = y(2)\n dy(2) = a(1)\nend subroutine\n"
    "subroutine force(y, a)\n real(8) y(2), a(2)\n integer i\n a = 0\n do i = 1, 1\n  a(i) = a(i) - g/l*sin(y(i))\n end do\nend subroutine"
)
Y1, Y0 = "'y(1)' = 'theta'", "'y[0]' = 'theta'"
MADE = "def make(m, l, g=9.81):\n    def sine(x):\n        return np.sin(x)\n    def rhs(t, y):\n        theta, w = y\n        return w, -g/l*sine(theta)\n    return rhs"
PARAMETERS = "p = {'m': 1.0, 'l': 0.5, 'g': 9.81}\ndef rhs(t, y):\n    theta, w = y\n    m, l, g = p['m'], p['l'], p['g']\n    return [w, -g/l*np.sin(theta)]"
CASES = {
    "a function that makes one": ("correct", MADE, "", ""),
    "a function that makes one, cosine": ("wrong", MADE.replace("np.sin", "np.cos"), "", ""),
    "parameters by their names": ("correct", PARAMETERS, "", ""),
    "parameters by their names, another": ("wrong", PARAMETERS.replace("-g/l", "-g/m"), "", ""),
    "a parameter of another name": ("refuse", PARAMETERS.replace("'l'", "'rod'"), "", ""),
    "a parameter under another's name": ("refuse", PARAMETERS.replace("= p['m'], p['l']", "= p['l'], p['m']"), "", ""),
    "lua": ("correct", LUA, "", ""),
    "lua, a sign": ("wrong", LUA.replace("-g/l", "g/l"), "", ""),
    "lua, places swapped": ("refuse", LUA.replace("{ w, -g/l*math.sin(theta) }", "{ -g/l*math.sin(theta), w }"), "", ""),
    "lua, a condition on what is returned": ("refuse", LUA.replace("print('fast')", "w = 0"), "", ""),
    "lua, two parameters": ("refuse", LUA.replace("f(t, y)", "f(y, y)"), "", ""),
    "r": ("correct", R, "", ""),
    "r, a factor": ("wrong", R.replace("m*l^2", "m*l"), "", ""),
    "r, columns first": ("wrong", R.replace("c(m*l^2, 0, 0, 1), 2, 2", "c(0, 1, m*l^2, 0), 2, 2"), "", ""),
    "r, rows first": ("correct", R.replace("c(m*l^2, 0, 0, 1), 2, 2", "c(m*l^2, 3, 0, 1), nrow = 2, byrow = FALSE").replace(
        "0)\n list", "-3*g/l*sin(theta))\n list"), "", ""),
    "r, a state with names": ("correct", "y0 <- c(theta = 1, w = 0)\n" + NAMED, "", ""),
    "r, a state with names in another order": ("refuse", "y0 <- c(w = 0, theta = 1)\n" + NAMED, "", ""),
    "r, derivatives with names in another order": (
        "refuse", "y0 <- c(w = 0, theta = 1)\n" + NAMED.replace("c(w, a)", "c(theta = w, w = a)"), "", ""),
    "r, names in brackets": ("correct", NAMED.replace("with(as.list(c(y, p)), {", "theta <- y[['theta']]; w <- y[[ 'w' ]]").replace("})", ""), "", ""),
    "r, a line that begins with a sign": ("refuse", R.replace("c(w, a[1])", "c(w, b)").replace(" list", " b <- a[1]\n  - 0*w\n list"), "", ""),
    "fortran": ("correct", FORTRAN, "", Y1),
    "fortran, a sign": ("wrong", FORTRAN.replace("a(i) - g/l", "a(i) + g/l"), "", Y1),
    "fortran, not called": ("refuse", FORTRAN.replace(" call force(y, a)\n", ""), "", Y1),
    "fortran, halves": ("refuse", FORTRAN.replace("g/l*sin", "(1/2)*2*g/l*sin"), "", Y1),
    "fortran, another entry": ("refuse", FORTRAN.replace("sin(y(i))", "sin(y(i+1))"), "", Y1),
    "fortran, capitals": ("correct", FORTRAN.upper(), "", Y1),
    "an array of the caller's": ("refuse", "def force(y, a):\n    a[0] = 0*y[0]\n    while a[0] < 1:\n        a[0] = -g/l*np.sin(y[0])\n\n"
                                 "def f(t, y):\n    a = np.zeros(2)\n    force(y, a)\n    return [y[1], a[0]]", "", Y0),
    "an array of the caller's, C": ("refuse", "void force(const double *y, double *a) { a[0] = 0; while (a[0] < y[1]) { a[0] = -g/l*sin(y[0]); } }\n"
                                    "void f(double t, const double *y, double *dy) { double a[2]; force(y, a); dy[0] = y[1]; dy[1] = a[0]; }", "", Y0),
    "time is tau": ("correct", "void f(double tau, double *y, double *dy) { dy[0] = y[1]; dy[1] = -g/l*sin(y[0]) + A*cos(w0*tau)/(m*l*l); }",
                    "drive = 'A*cos(w0*tau)'", Y0),
    "time is tau, sine": ("refuse", "void f(double tau, double *y, double *dy) { dy[0] = y[1]; dy[1] = -g/l*sin(y[0]) + A*sin(w0*tau)/(m*l*l); }",
                          "drive = 'A*cos(w0*tau)'", Y0),
    "tau is no time": ("refuse", "void f(double t, double *y, double *dy) { dy[0] = y[1]; dy[1] = -g/l*sin(y[0]) + A*cos(w0*tau)/(m*l*l); }",
                       "drive = 'A*cos(w0*tau)'", Y0),
    "modelica, parameters by others": (
        "correct", "model P \"a bob\"\n parameter Real m = 1 \"kg\";\n parameter Real l = 1 \"the rod's length\";\n constant Real g = 9.81;\n"
        " final parameter Real J = m*l^2 \"about the pivot\";\n Real theta(start = 1);\n Real w;\nequation\n w = der(theta);\n"
        " J*der(w) + m*g*l*sin(theta) = 0;\nend P;", "", ""),
    "modelica, another of these": (
        "wrong", "model P\n parameter Real m = 1;\n parameter Real l = 1;\n final parameter Real J = m*l^2/3;\n Real theta;\n Real w;\nequation\n"
        " w = der(theta);\n J*der(w) + m*g*l*sin(theta) = 0;\nend P;", "", ""),
    "all of the state at once": ("correct", "def f(t, y):\n    y[0], y[1] = y[1], -g/l*np.sin(y[0])\n    return y", "", Y0),
    "one of the state after another": ("refuse", "def f(t, y):\n    y[0] = y[1]\n    y[1] = -g/l*np.sin(y[0])\n    return y", "", Y0),
    "step": ("correct", "function step(dt) { const a = acc(theta); w += a*dt; theta += w*dt; }\nfunction acc(theta) { return -g/l*Math.sin(theta); }", "", ""),
    "step backwards": ("refuse", "function step(dt) { const a = acc(theta); w += a*dt; theta -= w*dt; }\nfunction acc(theta) { return -g/l*Math.sin(theta); }", "", ""),
    "step of nothing": ("refuse", "function step(dt) { const a = acc(theta); w += dt; theta += w*dt; }\nfunction acc(theta) { return -g/l*Math.sin(theta); }", "", ""),
}  # fmt: skip


@pytest.mark.parametrize(("said", "text", "more", "define"), CASES.values(), ids=CASES)
def test_what_a_program_comes_to(said, text, more, define):
    assert verdict(text, more, define) == said


def test_the_collections_programs_that_were_read_last_are_in_its_index():
    index = tomllib.loads((COLLECTION / "index.toml").read_text(encoding="utf-8"))
    assert {*SLIPS, *MENDED} <= index.keys()
    assert all(index[name]["verdict"] == "correct" for name in SLIPS)
    assert all(index[name]["verdict"] == "wrong" for name in MENDED)
