"""Derivations as they are written, in no TOML file: LaTeX, plain text, programs; and such as name no mechanism."""

import json

import pytest

from furiko import grade_text
from furiko.derivations.grading.grade import grade
from furiko.derivations.reading.pinned import Pinned
from furiko.models import InvalidInput

# Shiki (1.10), (1.11): two point masses on massless rods.
RIGHT = """
(m1+m2) l1 th1'' + m2 l2 th2'' cos(th1-th2) + m2 l2 th2'^2 sin(th1-th2) + (m1+m2) g sin th1 = 0
l2 th2'' + l1 th1'' cos(th1-th2) - l1 th1'^2 sin(th1-th2) + g sin th2 = 0
"""
WRONG = RIGHT.replace("+ m2 l2 th2'^2", "- m2 l2 th2'^2")
CART = r"""
The equations of motion of a pole on a cart are
\begin{align}
(M+m)\ddot{x} + m l\ddot\theta\cos\theta - m l \dot\theta^2\sin\theta &= 0\\
l\ddot\theta + \ddot x\cos\theta - g\sin\theta &= 0
\end{align}
"""  # from m l² θ̈ + m l ẍ cos θ − m g l sin θ = 0, θ from above and towards +x
PROGRAM = """
def pendulum(t, y, g=9.81, l=1.0):
    theta, omega = y
    return [omega, -g/l*np.sin(theta)]
"""
DAMPED = r"\ddot\theta + \frac{b}{m l^2}\dot\theta + \frac{g}{l}\sin\theta = 0"
# Lagrange's equations of a cart, pulled by F against b ẋ, with a pole whose centre is at l.
DRIVEN = r"""
$$(M+m)\ddot{x}+b\dot{x}+ml\ddot{\theta}\cos\theta-ml\dot{\theta}^2\sin\theta=F$$
$$(I+ml^2)\ddot{\theta}+mgl\sin\theta=-ml\ddot{x}\cos\theta$$
"""
NAMED = """(m_c + m_p) x'' + m_p l theta'' cos(theta) - m_p l theta'^2 sin(theta) = f
m_p l x'' cos(theta) + m_p l^2 theta'' + m_p g l sin(theta) = 0"""
RODS = "(m1/3 + m2) l1^2 a1 + m2 l1 l2/2 a2 cos(t1-t2) + m2 l1 l2/2 w2^2 sin(t1-t2) + (m1/2 + m2) g l1 sin t1 = 0\n\
m2 l2^2/3 a2 + m2 l1 l2/2 a1 cos(t1-t2) - m2 l1 l2/2 w1^2 sin(t1-t2) + m2 g l2/2 sin t2 = 0"


def graded(folder, name, text, **says):
    (folder / name).write_text(text, encoding="utf-8")
    return grade(folder / name, pinned=Pinned(**says) if says else None)


@pytest.mark.parametrize(
    ("name", "text", "about"),
    [
        ("mine.txt", RIGHT, "a chain of 2 massless rods with a point mass at the end of each"),
        ("cart.tex", CART, "cart sliding to the right"),
        ("pendulum.py", PROGRAM, "a point mass on a massless rod"),
        ("rods.md", RODS, "a chain of 2 uniform rods"),
        ("damped.tex", DAMPED, "a pendulum (theta) with mass m, length l, damping b"),
        (
            "driven.md",
            DRIVEN,
            "a cart (x, to the right) with mass M, damping b, drive F; pole (theta) with mass m, length l, inertia I",
        ),
        ("named.txt", NAMED, "a cart (x, to the right) with mass m_c, drive f; pole (theta) with mass m_p, length l"),
        (
            "lagrangian.tex",
            r"\[ L = \frac12 m \ell^2 \dot\phi^2 + m g \ell \cos\phi \]",
            "a point mass on a massless rod",
        ),
    ],
)
def test_a_text_is_right_for_the_mechanism_that_is_said(tmp_path, name, text, about):
    found = graded(tmp_path, name, text)
    assert found.verdict == "correct"
    assert found.assumes[0].startswith(f"it is about {about}")
    assert found.text().splitlines()[0].startswith("Read: ")
    assert f"Right if it is about {about}" in found.text()


USUAL = {  # from the textbooks' formulas, in letters of many kinds
    "a link 1 (q_1) with mass m_1, length l_1, centre l_{c1}, inertia I_1 about the centre, drive tau_1": r"""
$$\tau_1 = (m_1 l_{c1}^2 + m_2(l_1^2 + l_{c2}^2 + 2 l_1 l_{c2} \cos q_2) + I_1 + I_2)\ddot q_1
 + (m_2(l_{c2}^2 + l_1 l_{c2} \cos q_2) + I_2)\ddot q_2 - m_2 l_1 l_{c2} \sin q_2 (2 \dot q_1 \dot q_2 + \dot q_2^2)
 + (m_1 l_{c1} + m_2 l_1) g \cos q_1 + m_2 l_{c2} g \cos(q_1 + q_2)$$
$$\tau_2 = (m_2(l_{c2}^2 + l_1 l_{c2} \cos q_2) + I_2)\ddot q_1 + (m_2 l_{c2}^2 + I_2)\ddot q_2
 + m_2 l_1 l_{c2} \sin q_2 \dot q_1^2 + m_2 l_{c2} g \cos(q_1 + q_2)$$""",
    "a cart (x, to the right) with mass M, spring k; pole (theta) with mass m, length l": r"""
$$(M + m)\ddot x + m l \ddot\theta\cos\theta - m l \dot\theta^2 \sin\theta + k x = 0$$
$$l\ddot\theta + \ddot x \cos\theta + g \sin\theta = 0$$""",
    "a spring (theta) with mass 0; bob (r, along the one before) with mass M, spring K, rest a": r"""
$$ M \ddot r = M r \dot\theta^2 + M g \cos\theta - K (r - a) $$
$$ r \ddot\theta + 2 \dot r \dot\theta + g \sin\theta = 0 $$""",
    "a support 1 (y_s, upwards) with mass 0, motion given; pendulum (phi) with mass 1, length L": r"""
$$ L \ddot\phi + (g + \ddot y_s) \sin\phi = 0 $$""",
    "a cart (x, to the right) with mass m_0, drive F; pole 1 (theta_1) with mass m_1, length l_1; pole 2 (theta_2": r"""
$$(m_0+m_1+m_2)\ddot x + (m_1+m_2)l_1(\ddot\theta_1\cos\theta_1 - \dot\theta_1^2\sin\theta_1)
 + m_2 l_2(\ddot\theta_2\cos\theta_2 - \dot\theta_2^2\sin\theta_2) = F$$
$$(m_1+m_2)\ddot x\cos\theta_1 + (m_1+m_2)l_1\ddot\theta_1 + m_2 l_2(\ddot\theta_2\cos(\theta_1-\theta_2)
 + \dot\theta_2^2\sin(\theta_1-\theta_2)) + (m_1+m_2) g \sin\theta_1 = 0$$
$$\ddot x\cos\theta_2 + l_1(\ddot\theta_1\cos(\theta_1-\theta_2) - \dot\theta_1^2\sin(\theta_1-\theta_2))
 + l_2\ddot\theta_2 + g\sin\theta_2 = 0$$""",
    "a link 1 (phi1) with mass mA, length len1; link 2 (phi2) with mass mB, length len2": """
def rhs(t, y):
    phi1, w1, phi2, w2 = y
    mA, mB, len1, len2, g = 1.0, 2.0, 0.5, 0.7, 9.81
    d = phi1 - phi2
    den = 2*mA + mB - mB*cos(2*phi1 - 2*phi2)
    a1 = (-g*(2*mA + mB)*sin(phi1) - mB*g*sin(phi1 - 2*phi2) - 2*sin(d)*mB*(w2**2*len2 + w1**2*len1*cos(d)))/(len1*den)
    a2 = 2*sin(d)*(w1**2*len1*(mA + mB) + g*(mA + mB)*cos(phi1) + w2**2*len2*mB*cos(d))/(len2*den)
    return [w1, a1, w2, a2]
""",
}


@pytest.mark.parametrize("about", USUAL)
def test_usual_mechanisms_are_tried_in_the_letters_of_the_text(about):
    assert grade_text({"equations": USUAL[about]}).assumes[0].startswith(f"it is about {about}")


@pytest.mark.parametrize(
    ("right", "slip"),
    [
        ("- K (r - a)", "+ K (r - a)"),
        ("+ 2 \\dot r \\dot\\theta", "+ \\dot r \\dot\\theta"),
        ("(g + \\ddot y_s)", "(g - \\ddot y_s)"),
        ("+ k x = 0", "- k x = 0"),
        ("(2 \\dot q_1", "(\\dot q_1"),
        ("(m_1+m_2)l_1(", "m_1 l_1("),
        ("g*(2*mA + mB)", "g*(mA + mB)"),
    ],
)
def test_a_slip_in_the_letters_of_the_text_makes_it_right_for_none(right, slip):
    (text,) = (x for x in USUAL.values() if right in x)
    with pytest.raises(InvalidInput, match="which mechanism it is about is not said"):
        grade_text({"equations": text.replace(right, slip)})


def test_what_is_right_for_no_usual_mechanism_is_not_judged_but_told_the_nearest(tmp_path):
    with pytest.raises(InvalidInput, match=r"mine\.txt: system: which mechanism it is about is not said") as refusal:
        graded(tmp_path, "mine.txt", WRONG)
    words = str(refusal.value)
    assert "(--system double-pendulum), it is wrong: Row 1, the θ̇₂² term" in words
    assert "the sign is wrong" in words
    assert "--system simple-pendulum" in words


@pytest.mark.parametrize(
    "text",
    [
        DAMPED.replace("l^2", "l"),  # b θ̇ is a torque
        DRIVEN.replace("+b", "-b"),  # a motor, not a loss: no damping is negative
        DRIVEN.replace("(I+ml^2)", "(I-ml^2)"),
        NAMED.replace("(m_c + m_p)", "m_c"),
        r"\[ L = \frac12 m \ell^2 \dot\phi^2 - 2 m g \ell \cos\phi \]",
    ],
)
def test_a_slip_makes_no_text_right(text):
    with pytest.raises(InvalidInput, match="which mechanism it is about is not said"):
        grade_text(text)


def test_what_can_be_read_as_no_usual_mechanism_says_why(tmp_path):
    with pytest.raises(InvalidInput, match=r"as none of the usual ones it can be read: .*Say which: --system"):
        graded(tmp_path, "mine.txt", "y = 2 x + @")


def test_a_text_may_be_told_what_it_is_about(tmp_path):
    assert graded(tmp_path, "mine.txt", RIGHT, system="double-pendulum").assumes == ()
    assert graded(tmp_path, "wrong.txt", WRONG, system="point-masses", links=2).verdict == "wrong"
    # and what it does not say is found as in a file that names its mechanism
    (only,) = graded(tmp_path, "cart.tex", CART, system="cart-pole").assumes
    assert "from the upward vertical" in only


def test_a_file_may_name_its_mechanism_by_a_usual_word_and_be_held_to_it(tmp_path):
    text = f'system = "double-pendulum"\nequations = """{RIGHT}"""'
    assert graded(tmp_path, "mine.toml", text, system="double-pendulum").verdict == "correct"
    with pytest.raises(InvalidInput, match="it cannot change that"):
        graded(tmp_path, "mine.toml", text, system="triple-pendulum")


def test_fields_without_a_mechanism_are_fields_too():
    assert grade_text({"equations": RIGHT}).assumes == (
        "it is about a chain of 2 massless rods with a point mass at the end of each",
    )
    bodies = [{"coordinate": "theta", "mass": "m", "length": "l"}]
    assert grade_text({"bodies": bodies, "equations": ["l θ'' + g sin θ = 0"]}).assumes == ()


def test_a_condition_more_is_said_behind_the_mechanism():
    """Only where l = 1."""
    found = grade_text({"equations": "theta'' = -g sin theta"})
    assert found.assumes[0] == "it is about a point mass on a massless rod"
    assert "l1 = 1" in found.assumes[1]


@pytest.mark.parametrize("text", [RIGHT, CART, PROGRAM, RODS])
def test_a_text_is_taken_in_python_too(text):
    assert grade_text(text).verdict == "correct"


@pytest.mark.parametrize(
    "text", ["[equations]\n1 = 'l1*a1", "system = 'n-leg\nlinks = 2", "equations = [", "links = 2.2.2"]
)
def test_a_toml_file_with_a_slip_is_told_the_slip(text):
    with pytest.raises(InvalidInput, match="TOML"):
        grade_text(text)


NOTE = r"""
# Double pendulum

Positions: $x_1 = l_1\sin\theta_1$, $y_1=-l_1\cos\theta_1$, $x_2 = x_1 + l_2 \sin\theta_2$, $y_2 = y_1 - l_2\cos\theta_2$.

$$T = \tfrac12 m_1 l_1^2\dot\theta_1^2 + \tfrac12 m_2\left(l_1^2\dot\theta_1^2 + l_2^2\dot\theta_2^2 + 2 l_1 l_2\dot\theta_1\dot\theta_2\cos(\theta_1-\theta_2)\right)$$

$$V = -(m_1+m_2) g l_1\cos\theta_1 - m_2 g l_2\cos\theta_2$$

$$L = T - V$$
"""  # noqa: E501 -- as it stands


def notebook(*cells):
    made = [{"cell_type": kind, "metadata": {}, "source": text.splitlines(keepends=True)} for kind, text in cells]
    return json.dumps({"cells": made, "metadata": {}, "nbformat": 4, "nbformat_minor": 5})


def test_a_note_is_held_against_every_stage_that_it_states(tmp_path):
    """A position may be written in another one."""
    assert graded(tmp_path, "note.md", NOTE, system="double-pendulum").verdict == "correct"
    wrong = graded(
        tmp_path, "wrong.md", NOTE.replace(r"\theta_1-\theta_2", r"\theta_1+\theta_2"), system="double-pendulum"
    )
    assert wrong.verdict == "wrong"
    (wrong_place,) = [mark.stage for mark in wrong.stages if mark.outcome == "wrong"]
    assert wrong_place in ("kinetic", "lagrangian")
    lost = graded(tmp_path, "lost.md", NOTE.replace("y_2 = y_1 - l_2", "y_2 = - l_2"), system="double-pendulum")
    assert (lost.stages[0].stage, lost.stages[0].outcome) == ("positions", "wrong")


def test_a_notebook_is_its_formulas_or_else_its_code(tmp_path):
    both = notebook(
        ("code", "import numpy as np\n"), ("markdown", f"# Pole on a cart\n{CART}"), ("code", "theta = 0.1\n")
    )
    assert graded(tmp_path, "cart.ipynb", both).verdict == "correct"
    code = notebook(("markdown", "A simple pendulum."), ("code", "import numpy as np\n"), ("code", PROGRAM))
    assert graded(tmp_path, "pendulum.ipynb", code).verdict == "correct"
    for text in ("{}", "[]", '{"cells": 1}', '{"cells": [{}]}', "no JSON", "[" * 100_000):
        with pytest.raises(InvalidInput, match="not a notebook"):
            graded(tmp_path, "bad.ipynb", text)


CART_OF_OTHER_LETTERS = """$$(m_c + m_p)\\ddot x + m_p l \\ddot\\theta\\cos\\theta
 - m_p l \\dot\\theta^2 \\sin\\theta + b \\dot x = F$$
$$l\\ddot\\theta + \\ddot x\\cos\\theta + g \\sin\\theta = 0$$"""


def test_a_mechanism_that_is_named_may_have_other_letters_and_what_else_the_text_has(tmp_path):
    found = graded(tmp_path, "mine.md", CART_OF_OTHER_LETTERS, system="cart-pole")
    assert found.verdict == "correct"
    assert found.assumes == (
        "it is about a cart (x, to the right) with mass m_c, damping b, drive F; pole (theta) with mass m_p, length l",
    )
    with pytest.raises(
        InvalidInput, match="the index c is not a number"
    ):  # and no other mechanism than the one that is named
        graded(tmp_path, "mine.md", CART_OF_OTHER_LETTERS, system="double-pendulum")
    with pytest.raises(InvalidInput, match="is not known here"):  # nor is a slip called wrong: which letter is which?
        graded(tmp_path, "mine.md", CART_OF_OTHER_LETTERS.replace("+ g", "- 2 g"), system="cart-pole")


def test_two_letters_are_not_taken_for_one_angle():
    with pytest.raises(InvalidInput, match="which mechanism it is about is not said"):
        grade_text({"equations": ["l θ2'' + g sin θ = 0"]})
