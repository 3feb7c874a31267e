# ruff: noqa: E501 -- formulas stand on one line, as in their programs
"""Programs of many languages, as their authors write them: right ones are right, one slip is wrong, and what is not plain is refused.

``programs/`` has the texts; all of them compute one of the families of formulas that are proved here with sympy.
"""

import re
from pathlib import Path

import pytest
from mechanisms import (  # fmt: skip
    I1,
    I2,
    F,
    M,
    a1,
    a2,
    al,
    b,
    bobs,
    cart_pole,
    g,
    l,
    l1,
    l2,
    lc1,
    lc2,
    links,
    m,
    m1,
    m2,
    pendulum,
    tau,
    th,
    th1,
    th2,
    w,
    w1,
    w2,
    x,
    xdd,
)
from sympy import cos, sin, symbols
from truth import compare

from furiko.derivations.grading.grade import grade, grade_text
from furiko.models.errors import InvalidInput

PROGRAMS = Path(__file__).parents[1] / "programs"
NAMES = sorted(path.stem for path in PROGRAMS.glob("*.toml"))
s, c = sin(th1 - th2), cos(th1 - th2)
DEN = m1 + m2 * s**2
BELOW = l1 * (2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2))
FAMILIES = {
    "eliminated": [
        a1 - (m2 * g * sin(th2) * c - m2 * s * (l1 * w1**2 * c + l2 * w2**2) - (m1 + m2) * g * sin(th1)) / (l1 * DEN),
        a2 - ((m1 + m2) * (l1 * w1**2 * s - g * sin(th2) + g * sin(th1) * c) + m2 * l2 * w2**2 * s * c) / (l2 * DEN),
    ],
    "num and den": [
        a1 - (-g * (2 * m1 + m2) * sin(th1) - m2 * g * sin(th1 - 2 * th2) - 2 * s * m2 * (w2**2 * l2 + w1**2 * l1 * c)) / BELOW,
        a2 - 2 * s * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * cos(th1) + w2**2 * l2 * m2 * c) / (BELOW * l2 / l1),
    ],
    "rows": [
        (m1 + m2) * l1 * a1 + m2 * l2 * a2 * c + m2 * l2 * w2**2 * s + (m1 + m2) * g * sin(th1),
        l2 * a2 + l1 * a1 * c - l1 * w1**2 * s + g * sin(th2),
    ],
}  # fmt: skip


@pytest.mark.parametrize("family", FAMILIES)
def test_the_formulas_that_the_programs_share_are_right(family):
    assert compare(FAMILIES[family], bobs((l1, m1), (l2, m2))) is None


def test_those_of_the_acrobot_are_right():
    """Links with centres in their middles and inertia about them, relative angles, torque at the elbow."""
    c2, tmp = cos(th2), l1 * l2 * m2 * sin(th2) / 2
    m11 = m1 * l1**2 / 4 + I1 + m2 * (l1**2 + l2**2 / 4 + l1 * l2 * c2) + I2
    m12, m22 = m2 * (l2**2 / 4 + l1 * l2 * c2 / 2) + I2, l2**2 * m2 / 4 + I2
    outer = g * m2 * l2 * sin(th1 + th2) / 2
    rows = [
        m11 * a1 + m12 * a2 - (2 * w1 * w2 + w2**2) * tmp + g * (m1 * l1 / 2 + m2 * l1) * sin(th1) + outer,
        m12 * a1 + m22 * a2 + tmp * w1**2 + outer - tau,
    ]
    halves = {lc1: l1 / 2, lc2: l2 / 2}
    assert compare(rows, links(False, relative=True, forces={th2: tau}), halves) is None


def test_that_of_the_motor_is_right():
    """J a'' = m g l sin a - (b + K²/R) a' + K/R u, from the upward vertical; J is about the pivot."""
    turn, drag, push = symbols("J b u")  # b for b + K²/R, u for K u/R: each stands for one quantity of its own
    rows = [al - (m * g * l * sin(th) - drag * w + push) / turn]
    assert compare(rows, pendulum(inertia=turn - m * l**2, up=True, forces={th: push - drag * w})) is None


def test_those_of_one_bob_and_of_the_cart_are_right():
    assert compare([al + g / l * sin(th) + b / (m * l**2) * w], pendulum(forces={th: -b * w})) is None
    st, ct = sin(th), cos(th)
    rows = [
        xdd - (F + m * st * (l * w**2 - g * ct)) / (M + m * st**2),
        al - (-F * ct - m * l * w**2 * st * ct + (M + m) * g * st) / (l * (M + m * st**2)),
    ]
    assert compare(rows, cart_pole(up=True, forces={x: F})) is None


@pytest.mark.parametrize("name", NAMES)
def test_a_right_program_is_right(name):
    found = grade(PROGRAMS / f"{name}.toml")
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


DRAWN = re.compile(r"\b[xy]1 =|line\(|^\s*(?:IMPLICIT|//|#|--|!|C )")
MOST = 6


def slips_of(body):
    """The program with each of the slips in its formulas, lines that draw or declare left alone."""
    made, start = [], 0
    for line in body.split("\n"):
        if re.search(r"sin|cos", line, re.IGNORECASE) and not DRAWN.search(line):
            for found in re.finditer(r"(?<=[\w)\]}]) ?[-+] ?(?=[\w(\\])", line):
                signs = found[0].translate(str.maketrans("+-", "-+"))
                made.append(body[: start + found.start()] + signs + body[start + found.end() :])
            for found in re.finditer(r"(?<![A-Za-z])d?(sin|cos)(?=f? ?[({]|\(\)| th|\\| ?q)", line, re.IGNORECASE):
                other = {"sin": "cos", "cos": "sin"}[found[1].lower()]
                other = other.upper() if found[1].isupper() else other.title() if found[1][0].isupper() else other
                made.append(body[: start + found.start(1)] + other + body[start + found.end(1) :])
        start += len(line) + 1
    return made


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [name if i % 5 == 0 else pytest.param(name, marks=pytest.mark.sweep) for i, name in enumerate(NAMES)]
)
def test_a_program_with_a_slip_is_never_right(name):
    text = (PROGRAMS / f"{name}.toml").read_text(encoding="utf-8")
    head, mark, body = text.partition("1 = '''")
    slips = slips_of(body)
    verdicts = []
    for k in range(0, len(slips), max(1, len(slips) // MOST)):
        try:
            verdicts.append(grade_text(head + mark + slips[k]).verdict)
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
{define}[equations]
1 = '''
{}
'''
"""
TWO = "".join(
    ["system = 'mechanism'\nangles = 'absolute'\nfrom = 'down'\n"]
    + [f"[[bodies]]\ncoordinate = 'theta{k}'\nmass = 'm{k}'\nlength = 'l{k}'\n" for k in (1, 2)]
    + ["[equations]\n1 = '''\n{}\n'''\n"]
)


def one(body, define=""):
    return ONE.replace("{define}", f"[define]\n{define}" if define else "").replace("{}", body)


# l θ̈ = -g sin θ, by hand: what each text comes to in its own language
CASES = [
    (
        "0-based masses",
        "refuse",
        TWO.replace(
            "{}",
            "void f(double t, double *y, double *dy, double *m, double *l) { double s = sin(y[0]-y[1]); dy[0]=y[2]; dy[1]=y[3]; dy[2]=m[1]*s; dy[3]=m[0]*s;}",
        ),
    ),
    (
        "1/2 int",
        "refuse",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta)*(1/2)*2;\n}"
        ),
    ),
    (
        "m*1/2",
        "correct",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta)*1/2*2;\n}"
        ),
    ),
    (
        "^ in C",
        "refuse",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l^1*sin(theta);\n}"
        ),
    ),
    (
        "plain",
        "correct",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta);\n}"
        ),
    ),
    (
        "plain wrong",
        "wrong",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g*l*sin(theta);\n}"
        ),
    ),
    (
        "ifdef",
        "refuse",
        one(
            "#ifdef UP\nconst int k = 1;\n#endif\nvoid f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta);\n}"
        ),
    ),
    (
        "guard",
        "correct",
        one(
            "#ifndef PEND_H\n#define PEND_H\n#include <math.h>\nvoid f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta);\n}\n#endif"
        ),
    ),
    (
        "macro sum",
        "refuse",
        one(
            "#define K g + g\nvoid f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -K*0.5/l*sin(theta);\n}"
        ),
    ),
    (
        "macro (sum)",
        "correct",
        one(
            "#define K (g + g)\nvoid f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -K*0.5/l*sin(theta);\n}"
        ),
    ),
    (
        "macro SQ bad",
        "refuse",
        one(
            "#define SQ(x) x*x\nvoid f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta)*SQ(1+0);\n}"
        ),
    ),
    (
        "R leading sign",
        "refuse",
        one(
            "pend <- function(t, y, p) {\n theta <- y[1]\n w <- y[2]\n a <- -g/l*sin(theta)\n   - 0*w\n list(c(w, a))\n}"
        ),
    ),
    (
        "R 1",
        "correct",
        one("pend <- function(t, y, p) {\n theta <- y[1]\n w <- y[2]\n a <- -g/l*sin(theta)\n list(c(w, a))\n}"),
    ),
    ("stale", "refuse", one("void step() { omega += -g/l*sin(theta)*dt; theta += omega*dt; omega += 0*dt; }")),
    ("place first", "correct", one("void step() { theta += omega*dt; alpha = -g/l*sin(theta); omega += alpha*dt; }")),
    ("place first, lost", "wrong", one("void step() { theta += omega*dt; alpha = -g*sin(theta); omega += alpha*dt; }")),
    (
        "friction hack",
        "refuse",
        one("void step() { alpha = -g/l*sin(theta); omega += alpha*dt; theta += omega*dt; omega *= 0.99; }"),
    ),
    (
        "friction ok",
        "wrong",
        one("void step() { alpha = -g/l*sin(theta); omega += (alpha - 0.1*omega)*dt; theta += omega*dt; }"),
    ),
    ("minus", "correct", one("void step() { double a = g/l*sin(theta); omega -= a*dt; theta += omega*dt; }")),
    ("minus wrong", "wrong", one("void step() { double a = g/l*sin(theta); omega += a*dt; theta += omega*dt; }")),
    (
        "reassigned local",
        "correct",
        one("void step() { double a = -g/l*sin(theta); omega += a*dt; a = 3; theta += omega*dt; draw(a); }"),
    ),
    (
        "if",
        "refuse",
        one(
            "void f(double t, double *y, double *dy) { dy[0] = y[1]; if (t > 1) dy[1] = 0; dy[1] = -g/l*sin(y[0]); }",
            "'y[0]'='theta'\n",
        ),
    ),
    (
        "two functions",
        "refuse",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta);\n}\nvoid h(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = g/l*sin(theta);\n}"
        ),
    ),
    (
        "comment old",
        "correct",
        one(
            "void f(double t, const double *y, double *dy) {\n double theta = y[0], w = y[1];\n dy[0] = w;\n dy[1] = -g/l*sin(theta);\n}\n// dy[1] = g*sin(theta);\n/* dy[1] = 3; */"
        ),
    ),
    (
        "p.l and l",
        "refuse",
        one(
            "double f(double theta, double w) {return 0;}\nvoid rhs(double *y, double *dy, P *p) { double theta = y[0]; double l = 2*p->l; dy[0]=y[1]; dy[1] = -g/l*sin(theta); }"
        ),
    ),
    (
        "p.l alone, where l is another thing",
        "correct",
        one(
            "double f(double theta, double w) {return 0;}\nvoid rhs(double *y, double *dy, P *p) { double theta = y[0]; double l = 2*p->l; dy[0]=y[1]; dy[1] = -g/p->l*sin(theta); }"
        ),
    ),
    (
        "state changed",
        "refuse",
        one(
            "void f(double *y, double *dy) { y[0] = 2*y[0]; dy[0] = y[1]; dy[1] = -g/l*sin(y[0]); }", "'y[0]'='theta'\n"
        ),
    ),
    (
        "entry before",
        "refuse",
        one("void f(double *y, double *dy) { dy[0] = y[1]; dy[1] = -g/l*sin(y[0]) + 0*dy[2]; }", "'y[0]'='theta'\n"),
    ),
    (
        "read early",
        "refuse",
        one("void step() { double b = a*2; double a = -g/l*sin(theta); omega += a*dt + 0*b; theta += omega*dt; }"),
    ),
    ("js 1/2", "correct", one("const f = (t, [theta, w]) => [w, -1/2*2*g/l*Math.sin(theta)];")),
    (
        "js unused default",
        "correct",
        one("export default function rhs(t, y) {\n const [theta, w] = y\n return [w, -g / l * Math.sin(theta)]\n}"),
    ),
    (
        "degrees",
        "refuse",
        one("void step() { double a = -g/l*sin(radians(theta)); omega += a*dt; theta += omega*dt; }"),
    ),
    (
        "wrong order",
        "refuse",
        TWO.replace(
            "{}",
            "function acc(theta1, theta2, omega1, omega2) { const s = Math.sin(theta1 - theta2); return [alpha2, alpha1]; }",
        ),
    ),
    (
        "wrong order2",
        "wrong",
        TWO.replace(
            "{}",
            "\nfunction accelerations(theta1: number, theta2: number, omega1: number, omega2: number): [number, number] {\n  const s = Math.sin(theta1 - theta2)\n  const c = Math.cos(theta1 - theta2)\n  const den = m1 + m2 * s ** 2\n  const a1 = (m2*g*Math.sin(theta2)*c - m2*s*(l1*omega1**2*c + l2*omega2**2)\n    - (m1 + m2)*g*Math.sin(theta1)) / (l1*den)\n  const a2 = ((m1 + m2)*(l1*omega1**2*s - g*Math.sin(theta2) + g*Math.sin(theta1)*c)\n    + m2*l2*omega2**2*s*c) / (l2*den)\n  return [a2, a1]\n}\n",
        ),
    ),
    (
        "julia leading",
        "refuse",
        one("function f!(du,u,p,t)\n theta, w = u\n du[1] = w\n du[2] = -g/l*sin(theta)\n  - 0*w\nend"),
    ),
    ("julia 2x", "correct", one("f(u, p, t) = [u[2], -2g/(2l)*sin(u[1])]\nfunction k(x)\n x\nend", "'u[1]'='theta'\n")),
    (
        "fortran half",
        "refuse",
        one(
            "subroutine f(y, dy)\n real(8) :: y(2), dy(2)\n dy(1) = y(2)\n dy(2) = -(1/2)*2*g/l*sin(y(1))\nend subroutine",
            "'y(1)'='theta'\n",
        ),
    ),
    (
        "fortran 1.d0",
        "correct",
        one(
            "subroutine f(y, dy)\n real(8) :: y(2), dy(2)\n dy(1) = y(2)\n dy(2) = -0.5d0*2.d0*g/l*dsin(y(1))\nend subroutine",
            "'y(1)'='theta'\n",
        ),
    ),
    (
        "haskell guard",
        "refuse",
        one(
            "f :: [Double] -> [Double]\nf [theta, w] = [w, a]\n  where a | theta > 1 = 0\n          | otherwise = -g / l * sin theta"
        ),
    ),
    ("haskell", "correct", one("f :: [Double] -> [Double]\nf [theta, w] = [w, a]\n  where a = -g / l * sin theta")),
    ("haskell prec", "wrong", one("f :: [Double] -> [Double]\nf [theta, w] = [w, a]\n  where a = -g / l * cos theta")),
    (
        "kwargs same entry",
        "refuse",
        one(
            "void f(double *y, double *dy, double *p) { double g = p[0], l = p[0]; dy[0] = y[1]; dy[1] = -g/l*sin(y[0]); }",
            "'y[0]'='theta'\n",
        ),
    ),
    ("g=G latex wrong", "wrong", one("\\ddot\\theta = \\frac{G}{l}\\sin\\theta", "g='G'\n")),
    ("modelica der (", "correct", one("der (theta) = w; der (w) = -g/l*sin(theta);")),
    ("modelica wrong", "wrong", one("der (theta) = w; der (w) = -g*l*sin(theta);")),
    (
        "shadowing block",
        "refuse",
        one(
            "void f(double *y, double *dy) { double theta = y[0]; double k = 1.0; { double k = 2.0; } dy[0]=y[1]; dy[1] = -k*g/l*sin(theta); }"
        ),
    ),
    (
        "lambda c++ name",
        "correct",
        one(
            "auto rhs = [](const std::vector<double>& y, std::vector<double>& dy, double) {\n dy[0] = y[1];\n dy[1] = -g/l*std::sin(y[0]);\n};",
            "'y[0]'='theta'\n",
        ),
    ),
]


@pytest.mark.parametrize(("said", "text"), [case[1:] for case in CASES], ids=[case[0] for case in CASES])
def test_what_a_text_comes_to_in_its_own_language(said, text):
    if said == "refuse":
        with pytest.raises(InvalidInput):
            grade_text(text)
    else:
        found = grade_text(text)
        assert (found.verdict, tuple(found.assumes)) == (said, ())


CHANGES = {
    "cp-julia-view": [("-model.mp*x[2]*", "-model.mp*x[4]*"), ("view(x,1:2)", "view(x,3:4)")],
    "dc-eigen-members": [
        ("L1_*L1_/3", "L1_*L1_/12"),
        ("L2_*L2_/3", "L2_*L2_/12"),
        ("angles = 'absolute'", "angles = 'absolute'\nfrom = 'up'\nsense = 'clockwise'"),
    ],
    "dp-fortran-uses-first": [
        (" - 2*dsin(funcin(1)-funcin(2))*funcin(3)**2*dcos", " - dsin(funcin(1)-funcin(2))*funcin(3)**2*dcos"),
        ("- (g/l)*dsin(funcin(1)))/(1-2*(", "- 2*(g/l)*dsin(funcin(1)))/(2-("),
        ("-2*dcos(funcin(1)-funcin(2))*dyoutput", "-dcos(funcin(1)-funcin(2))*dyoutput"),
        ("+ 2*dsin(funcin(1)-funcin(2))*funcin(3)**2-", "+ dsin(funcin(1)-funcin(2))*funcin(3)**2-"),
    ],
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_wrong_ones_of_the_collection_are_right_once_their_mistake_is_mended(name):
    text = (PROGRAMS.parent / "fifth_collection" / f"{name}.toml").read_text(encoding="utf-8")
    assert grade_text(text).verdict == "wrong"
    for was, now in CHANGES[name]:
        assert was in text
        text = text.replace(was, now)
    assert grade_text(text).verdict == "correct"


RIGHT = ("cp-modelica-trolley", "dp-gsl-ccode", "dp-processing-method", "dp-feenox", "dp-latex-generated",
         "sp-toolkit-operators", "sp-haskell-hamilton", "sp-r-desolve")  # fmt: skip


@pytest.mark.parametrize("name", RIGHT)
def test_the_right_ones_of_the_collection_are_right(name):
    assert grade(PROGRAMS.parent / "fifth_collection" / f"{name}.toml").verdict == "correct"


@pytest.mark.parametrize(
    ("said", "define", "row"),
    [
        ("correct", "g = 'G'", "l*theta'' = -G*sin(theta)"),
        ("wrong", "g = 'G'", "l*theta'' = -2*G*sin(theta)"),
        ("correct", "g = 'ω_0^2*l'", "theta'' = -ω_0^2*sin(theta)"),
        ("wrong", "g = 'ω_0^2*l'", "theta'' = -ω_0*sin(theta)"),
        ("correct", "'ω_0^2' = 'g/l'", "theta'' = -ω_0^2*sin(theta)"),
        ("correct", "g = '9.8'", "l*theta'' = -9.8*sin(theta)"),
        ("correct", "g = '9.8'", "l*theta'' = -19.6*sin(theta)/2"),
        ("wrong", "g = '9.8'", "l*theta'' = -9.81*sin(theta)"),
        (None, "g = '2*g'", "l*theta'' = -g*sin(theta)"),
        (None, "g = 'm + q'", "l*theta'' = -k*sin(theta)"),
    ],
)
def test_what_g_is_in_the_authors_letters(said, define, row):
    text = ONE.replace("{define}", f"[define]\n{define}\n").replace("{}", row)
    if said is None:
        with pytest.raises(InvalidInput):
            grade_text(text)
    else:
        assert grade_text(text).verdict == said
