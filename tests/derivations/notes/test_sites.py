# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""What sites and programs wrap around formulas may deny them, strike them out or hide them: such a text is refused."""

import tomllib
from pathlib import Path

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

DECLARED = tomllib.loads((Path(__file__).parent / "mechanisms.toml").read_text(encoding="utf-8"))
ROW = r"l\ddot\theta + g\sin\theta = 0"
PLAIN = "l θ'' + g sin θ = 0"
SAID = "wrong|Wrong|Not|words between"


def pendulum(text):
    return grade_text(f"{DECLARED['pendulum']}\n[equations]\n1 = '''\n{text}\n'''\n")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (f"~~$${ROW}$$~~", "struck out"),
        (f"~~`{PLAIN}`~~", "struck out"),
        (f':::{{admonition}} A wrong equation\n$${ROW}$$\n:::', SAID),
        (f'!!! note "Wrong"\n    $${ROW}$$', SAID),
        ("This is wrong:\n$ l dot.double(theta) + g sin(theta) = 0 $ <a>", SAID),
        (f".Not the equation\n[latexmath]\n++++\n{ROW}\n++++", SAID),
        (".A wrong equation\n[stem]\n++++\nl ddot theta + g sin theta = 0\n++++", SAID),
        (f"/// This equation is wrong:\n/// @f[ {ROW} @f]", SAID),
        (f"/**\n * @warning wrong\n * \\f[ {ROW} \\f]\n */", SAID),
        (f"#+caption: the wrong equation\n$${ROW}$$", SAID),
        (r'{"wrong": "l \\ddot\\theta + g \\sin\\theta = 0"}', "not known here"),
        (r"![This is wrong](https://latex.codecogs.com/svg.latex?l\ddot{\theta}+g\sin\theta=0)", SAID),
        (r"\newcommand{\no}[1]{\cancel{#1}}" + "\n$$l\\ddot\\theta \\no{- 2 g\\sin\\theta} + g\\sin\\theta = 0$$", "struck out"),
        (r"\newcommand{\a}{\b}\newcommand{\b}{\a}" + f"\n$${ROW} \\a$$", "again and again"),
        ("          g\n  θ'' = - - sin θ\n          l", "printed on several lines"),
        (r"$$l \frac{d}{dt}\dot\theta \cos\theta + g \sin\theta = 0$$", "put brackets around what d/dt acts on"),
        (f"{ROW.replace('ddot', 'dot')}\n\n$c_1 = \\sin\\theta$", "no equation needs it|not known here|a value"),
    ],
)  # fmt: skip
def test_what_is_denied_struck_out_or_unsaid_is_refused(text, why):
    with pytest.raises(InvalidInput, match=why):
        pendulum(text)


@pytest.mark.parametrize(
    "text",
    [
        r"$$l\ddot\theta - g\sin\theta = 0 !$$",
        r"<MathJax>{`$$l\\ddot{\\theta} - g\\sin\\theta = 0$$`}</MathJax>",
        r'"""l*theta_ddot - g*sin(theta) = 0"""',
        "dθ/dt = θ̇\ndθ̇/dt = (g/l) sin θ",
        r"\newcommand{\w}{-g}" + "\n" + r"$$l\ddot\theta + \w\sin\theta = 0$$",
        r"$$\theta_{tt} = \frac{g}{l}\sin\theta, \quad t \geq 0$$",
    ],
)
def test_a_slip_in_them_is_called_wrong(text):
    assert pendulum(text).verdict == "wrong"


TWO = DECLARED["double"] + "\n"
POINTS = """x1 = l1 sin(θ1)
y1 = -l1 cos(θ1)
x2 = x1 + l2 sin(θ2)
y2 = y1 - l2 cos(θ2)
T = 1/2 m1 (ẋ1² + ẏ1²) + 1/2 m2 (ẋ2² + ẏ2²)
V = m1 g y1 + m2 g y2
L = T - V
"""


@pytest.mark.parametrize(
    ("old", "new", "verdict"),
    [
        ("", "", "correct"),
        ("x1 + l2", "x1 - l2", "wrong"),
        ("ẏ2²", "ẏ1²", "wrong"),
        ("m1 g y1 +", "m1 g y1 -", "wrong"),
    ],
)
def test_a_dot_above_a_point_is_its_rate(old, new, verdict):
    """ẋ1 of a point x1 was taken as the rate of an angle, and what is right was called wrong."""
    head, bodies = TWO.split("[[bodies]]", 1)
    text = f"{head}lagrangian = '''\n{POINTS.replace(old, new)}'''\n[[bodies]]{bodies}"
    assert grade_text(text).verdict == verdict


@pytest.mark.parametrize("apart", ["\n", "\n\n"])
def test_two_equations_in_lines_of_one_display_are_two(apart):
    """They were read as one chain, A = F l θ'' + … = 0, and called wrong."""
    rows = (
        r"(M + m)\ddot x + m l\ddot\theta\cos\theta - m l\dot\theta^2\sin\theta = F",
        r"l\ddot\theta + \ddot x\cos\theta + g\sin\theta = 0",
    )
    text = f"{DECLARED['cart']}\n[equations]\n1 = '''\nWe find that\n$$\n{apart.join(rows)}\n$$\n'''\n"
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("g\\sin", "2 g\\sin")).verdict == "wrong"
