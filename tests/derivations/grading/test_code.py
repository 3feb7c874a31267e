# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""Programs with loops, matrices filled entry by entry, pointers, structs and Julia's own words: right, wrong, hostile."""

import time

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

# Two equal bobs: [2 l, l c; l c, l] a = [-l w2² s - 2 g sin q1; l w1² s - g sin q2], s and c of q1 - q2
EQUAL = "system = 'mechanism'\nfrom = 'down'\n" + "".join(
    f"[[bodies]]\ncoordinate = 'q{k}'\nmass = 'm'\nlength = 'l'\n" for k in (1, 2)
) + "[equations]\n1 = '''\n{}\n'''\n"  # fmt: skip
CART = """system = 'mechanism'
from = 'up'
sense = 'clockwise'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'F'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[equations]
1 = '''
{}
'''
"""
LOOPS = """
import numpy as np
def rhs(t, y):
    n = 2
    q = y[0:n]
    w = y[n:2*n]
    M = np.zeros((n, n))
    f = np.zeros(n)
    for i in range(n):
        for j in range(n):
            c = n - max(i, j)
            M[i][j] = c * l * np.cos(q[i] - q[j])
            f[i] += -(n - max(i, j)) * l * w[j]**2 * np.sin(q[i] - q[j])
        f[i] -= (n - i) * g * np.sin(q[i])
    a = np.linalg.solve(M, f)
    return np.concatenate((w, a))
"""
ENTRIES = """
def f(t, y):
    q1, q2, w1, w2 = y
    A = np.zeros((2,2))
    d = q1 - q2
    A[0,0] = 2*l
    A[0,1] = l*np.cos(d)
    d = q2 + q1
    A[1,0] = A[0,1]
    A[1,1] = l
    s = np.sin(q1 - q2)
    b = np.array([-l*w2**2*s - 2*g*np.sin(q1), l*w1**2*s - g*np.sin(q2)])
    a = np.linalg.solve(A, b)
    return [w1, w2, a[0], a[1]]
"""
MATLAB = """function dx = f(~, x, p)
l = p(1); g = p(2);
q1 = x(1); q2 = x(2); w1 = x(3); w2 = x(4);
M = zeros(2,2);
M(1,1) = 2*l; M(1,2) = l*cos(q1-q2);
M(2,1) = M(1,2);
M(2,2) = l;
b = [-l*w2^2*sin(q1-q2) - 2*g*sin(q1); l*w1^2*sin(q1-q2) - g*sin(q2)];
dx = [w1; w2; M\\\\b];
end""".replace("\\\\", "\\")
STRUCT = """struct dp { double l, g;
 void operator()(const std::vector<double> &y, std::vector<double> &dy, double t) const {
  const double q1 = y[0], q2 = y[1], w1 = y[2], w2 = y[3];
  const double c = std::cos(q1 - q2), s = std::sin(q1 - q2);
  dy[0] = w1; dy[1] = w2;
  dy[2] = (-w2*w2*s*l - 2*g*std::sin(q1) - c*(l*w1*w1*s - g*std::sin(q2))) / (l*(2 - c*c));
  dy[3] = (2*(l*w1*w1*s - g*std::sin(q2)) + c*(l*w2*w2*s + 2*g*std::sin(q1))) / (l*(2 - c*c));
 } };"""
JULIA = """@inbounds function f!(du, u, p, t)
    (; m, l, g) = p
    q1, q2, w1, w2 = u
    s, c = sincos(q1 - q2)
    a1 = (-l*w2^2*s - 2g*sin(q1) - c*(l*w1^2*s - g*sin(q2))) / (l*(2 - c^2))
    a2 = (2*(l*w1^2*s - g*sin(q2)) + c*(l*w2^2*s + 2g*sin(q1))) / (l*(2 - c^2))
    du[:] .= [w1, w2, a1, a2]
    return nothing
end"""
STATIC = JULIA.replace("f!(du, u", "f(u").replace(
    "du[:] .= [w1, w2, a1, a2]\n    return nothing", "return SA[w1, w2, a1, a2]"
)
POINTERS = """void accel(const double x, double xd, double theta, double theta_dot, double F, double *xacc, double *theta_acc)
{
  double s = sin(theta), c = cos(theta);
  const double d = M + m*s*s; // below
  *xacc = (F + m*l*pow(theta_dot, 2)*s - m*g*s*c) / d;
  *theta_acc = (g*s - *xacc * c) / l;
}"""
PROGRAMS = {"loops": LOOPS, "entries": ENTRIES, "matlab": MATLAB, "struct": STRUCT, "julia": JULIA, "static": STATIC,
            "pointers": POINTERS}  # fmt: skip
SLIPS = {
    "loops": [("f[i] += -", "f[i] += "), ("(n - i) * g", "n * g"), ("np.cos(q[i]", "np.cos(-q[i]")],
    "entries": [
        ("d = q2 + q1\n    A[1,0] = A[0,1]", "d = q2 + q1\n    A[1,0] = l*np.cos(d)"),
        ("A[1,1] = l", "A[1,1] = 2*l"),
        ("A[1,1] = l", "A[1,1] = l\n    A[1,1] = 2*l"),  # what is given last counts
        ("d = q2 + q1", "A = 2*A"),
    ],
    "matlab": [
        ("M(2,2) = l;", "M(2,2) = l;\nM(1,1) = 3*l;"),
        ("2*g*sin", "g*sin"),
        ("M(2,1) = M(1,2)", "M(2,1) = M(1,1)"),
    ],
    "struct": [("std::sin(q1) - c*", "std::sin(q1) + c*")],
    "julia": [("(2*(l", "((l"), ("sincos(q1 - q2)", "sincos(q1 + q2)")],
    "static": [("2g*sin(q1))", "2g*cos(q1))")],
    "pointers": [("(g*s -", "(-g*s -"), ("*xacc * c", "*xacc * s")],
}
REFUSED = [
    ("loops", "n = 2", "n = 3", "returns 6 values for 2 coordinates"),
    ("loops", "for j in range(n)", "for j in range(10**9)", "something else than whole numbers"),
    ("loops", "        for j", "        if t > 1: continue\n        for j", "what a loop or condition comes to"),
    ("loops", "max(i, j)", "__import__('os').getpid()", None),
    ("loops", "for j in range(n)", "for j in q", "something else than whole numbers"),
    ("entries", "A[1,1] = l", "A[2,1] = l", "it is not there"),
    ("julia", "s, c = sincos", "if t > 1 w1 = 2*w1 end\n    s, c = sincos", None),
    ("pointers", "  *xacc = (F", "  F = 2*F;\n  *xacc = (F", "F is changed"),
    ("pointers", "  *xacc = (F", "  if (x > 1) F = 0;\n  *xacc = (F", "what a loop or condition comes to"),
]


def verdict(name, text):
    return grade_text((CART if name == "pointers" else EQUAL).replace("{}", text)).verdict


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_right_program_is_right(name):
    assert verdict(name, PROGRAMS[name]) == "correct"


@pytest.mark.parametrize(("name", "was", "now"), [(name, *slip) for name, slips in SLIPS.items() for slip in slips])
def test_a_wrong_program_is_wrong(name, was, now):
    assert was in PROGRAMS[name]
    assert verdict(name, PROGRAMS[name].replace(was, now)) == "wrong"


@pytest.mark.parametrize(("name", "was", "now", "says"), REFUSED)
def test_what_is_not_plain_is_refused(name, was, now, says):
    assert was in PROGRAMS[name]
    begun = time.perf_counter()
    with pytest.raises(InvalidInput, match=says):
        verdict(name, PROGRAMS[name].replace(was, now))
    assert time.perf_counter() - begun < 2  # s, of a hostile input


def test_a_count_that_no_loop_has_may_be_a_force():
    text = LOOPS.replace("def rhs(t, y):", "def rhs(t, y, N):").replace("2*n]", "4]")
    assert verdict("loops", text) == "correct"
    with pytest.raises(InvalidInput, match="'N'"):
        verdict("loops", text.replace("(n - i) * g", "N * g"))


def test_an_acceleration_that_is_read_too_early_is_refused():
    with pytest.raises(InvalidInput, match="read before it is written"):
        verdict("pointers", POINTERS.replace("*xacc = (F", "*xacc = (F + *theta_acc"))


def test_an_entry_over_two_lines():
    text = ENTRIES.replace("A[1,1] = l", "A[1,1] = (l\n      )")
    assert verdict("entries", text) == "correct"
    assert verdict("entries", text.replace("(l\n", "(l +\n l")) == "wrong"
