"""Derivations as they are written, in no TOML file: LaTeX, plain text, programs; and such as name no mechanism."""

import json
import re

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
    slip = CART_OF_OTHER_LETTERS.replace("+ g", "- 2 g")  # in a term that has none of the letters whose role is tried
    assert graded(tmp_path, "mine.md", slip, system="cart-pole").verdict == "wrong"
    with pytest.raises(InvalidInput, match="is not known here"):  # in one that has, which letter is which?
        graded(tmp_path, "mine.md", CART_OF_OTHER_LETTERS.replace("+ b", "- b"), system="cart-pole")


CELL = r"""%% Inverted pendulum
% $$ (M+m)\ddot{x} + m l\ddot\theta\cos\theta - m l\dot\theta^2\sin\theta = 0 $$
%
% $$ l\ddot\theta + \ddot x\cos\theta + g\sin\theta = 0 $$
M = 0.5;
m = 0.2;
"""


@pytest.mark.parametrize(
    ("name", "text", "system"),
    [
        ("cell.m", CELL, "cart-pole"),
        ("remark.py", "# theta_ddot = -g/l*sin(theta)\nm = 0.2\n", "simple-pendulum"),
        ("docstring.py", '"""theta_ddot = -g/l*sin(theta)"""\nm = 0.2\nl = 1.0\n', "simple-pendulum"),
        ("remark.jl", "# θ̈ = -g/l*sin(θ)\nm = 0.2\n", "simple-pendulum"),
        ("remark.c", "// theta_ddot = -g/l*sin(theta)\ndouble m = 0.2;\n", "simple-pendulum"),
    ],
)
def test_equations_in_the_remarks_of_a_program_without_any_are_what_it_states(tmp_path, name, text, system):
    assert graded(tmp_path, name, text, system=system).verdict == "correct"
    wrong = text.replace("-g/l", "g/(2*l)").replace("- m l", "+ m l")
    assert graded(tmp_path, name, wrong, system=system).verdict == "wrong"


@pytest.mark.parametrize(
    ("name", "text", "system"),
    [
        ("only.m", "% the pendulum\nm = 0.2;\n", "cart-pole"),
        ("only.py", "m1 = 1.0\nm2 = 1.0\n", "double-pendulum"),
        ("only.txt", "m = 0.2", "simple-pendulum"),
        ("only.md", "$$m = 0.2$$\n\n$$M = 1$$", "cart-pole"),
        ("only.txt", "x = 0.1\ntheta = 0.2", "cart-pole"),
        ("only.py", "theta_ddot = 0\n", "simple-pendulum"),
        ("hidden.tex", "% l\\ddot\\theta + g\\sin\\theta = 0\n$m = 0.2$", "simple-pendulum"),
        ("beside.txt", "l1 t1'' + g sin t1 = 0\nm1 = 0.2", "double-pendulum"),
    ],
)
def test_what_a_quantity_is_set_to_is_no_row_and_no_derivation_is_wrong_for_it(tmp_path, name, text, system):
    with pytest.raises(InvalidInput, match="no equation of motion"):
        graded(tmp_path, name, text, system=system)
    if name != "beside.txt":
        with pytest.raises(InvalidInput, match="which mechanism it is about is not said"):
            graded(tmp_path, name, text)


def test_a_value_beside_a_row_is_passed_over_where_the_mechanism_is_not_named(tmp_path):
    found = graded(tmp_path, "beside.txt", "l1 t1'' + g sin t1 = 0\nm1 = 0.2")
    assert found.verdict == "correct"
    assert any("m1 = 0.2" in note for note in found.notes)


def test_a_row_of_constants_alone_is_none_in_a_file_with_fields_either():
    with pytest.raises(InvalidInput, match="'m = 1/5' is a value"):
        grade_text({"system": "simple-pendulum", "equations": {"1": "m = 0.2"}})


ZERO = r"""
{}

$$(M+m)\ddot{{x}} + m l\ddot\theta\cos\theta - m l\dot\theta^2\sin\theta = 0$$

$$l\ddot\theta + \ddot x\cos\theta {} g\sin\theta = 0$$
"""  # Lagrange's equations with x_m = x + l sin θ: +, where θ is from below, and -, from above


@pytest.mark.parametrize(
    ("sentence", "sign"),
    [
        (r"$\theta = 0$ is upright.", "-"),
        (r"In this convention, $\theta=0$ corresponds to hanging down.", "+"),
        (r"where \(\theta = 0\) is the vertical upright position, clockwise positive", "-"),
        ("`θ = 0` means the pole points straight down.", "+"),
        (r"$\theta = \pi$ is upright", "+"),
        (r"$\theta = 0$ 表示摆杆竖直向下。", "+"),
        (r"The upright position ($\theta = 0$) is unstable.", "-"),
    ],
)
def test_a_sentence_says_where_an_angle_is_zero(tmp_path, sentence, sign):
    """And then nothing else is taken to be meant."""
    right = graded(tmp_path, "cart.md", ZERO.format(sentence, sign), system="cart-pole")
    assert right.verdict == "correct"
    assert not any("vertical" in said and "clockwise" not in said for said in right.assumes)
    other = {"+": "-", "-": "+"}[sign]
    assert graded(tmp_path, "cart.md", ZERO.format(sentence, other), system="cart-pole").verdict == "wrong"


@pytest.mark.parametrize(
    "sentence",
    [
        r"The equilibrium is $\theta = 0$.",
        r"$\theta = 0$ is where it falls down from upright.",
        r"$\theta = 0$ is the reference.",
        r"$\theta = 0$ is not upright.",
    ],
)
def test_a_sentence_that_does_not_say_it_plainly_decides_nothing(tmp_path, sentence):
    for sign in "+-":
        text = ZERO.format(sentence, sign)
        if "not" in sentence:  # a sentence that denies something is asked about
            with pytest.raises(InvalidInput, match="not"):
                graded(tmp_path, "cart.md", text, system="cart-pole")
            continue
        found = graded(tmp_path, "cart.md", text, system="cart-pole")
        assert found.verdict == "correct"
        assert any("theta = 0" in note for note in found.notes)


@pytest.mark.parametrize("sentence", [r"For $\theta = 0$ upright:", r"If $\theta = 0$ is upright, then"])
def test_what_may_be_a_condition_is_asked_about(tmp_path, sentence):
    with pytest.raises(InvalidInput, match="what a coordinate is"):
        graded(tmp_path, "cart.md", ZERO.format(sentence, "+"), system="cart-pole")


def test_a_height_that_is_said_besides_is_not_contradicted_by_what_is_assumed(tmp_path):
    said = "$$y_p = -l\\cos\\theta$$"
    assert graded(tmp_path, "cart.md", ZERO.format(said, "+"), system="cart-pole").verdict == "correct"
    with pytest.raises(InvalidInput, match="which is meant"):
        graded(tmp_path, "cart.md", ZERO.format(said, "-"), system="cart-pole")
    said = "$$y_p = l\\cos\\theta$$"
    assert graded(tmp_path, "cart.md", ZERO.format(said, "-"), system="cart-pole").verdict == "correct"


@pytest.mark.parametrize(
    ("text", "system", "about"),
    [
        (
            DRIVEN,
            "cart-pole",
            "a cart (x, to the right) with mass M, damping b, drive F; pole (theta) with mass m, length l",
        ),
        (NAMED, "cart-pole", "a cart (x, to the right) with mass m_c, drive f; pole (theta) with mass m_p, length l"),
        (DAMPED, "simple-pendulum", "a pendulum (theta) with mass m, length l, damping b"),
    ],
)
def test_a_named_mechanism_may_have_the_letters_of_a_force_a_loss_and_an_inertia(tmp_path, text, system, about):
    """It is right for that, and every letter is said; what the plain mechanism is right for is as before."""
    found = graded(tmp_path, "mine.md", text, system=system)
    assert found.verdict == "correct"
    assert found.assumes[0].startswith(f"it is about {about}")


def test_it_is_wrong_where_a_term_without_these_letters_is_wrong_whatever_they_stand_for(tmp_path):
    found = graded(tmp_path, "mine.md", NAMED.replace("- m_p l theta'^2", "+ m_p l theta'^2"), system="cart-pole")
    assert found.verdict == "wrong"
    assert found.assumes[0].startswith("it is about a cart (x, to the right) with mass m_c, drive f")
    (only,) = found.findings
    assert only.cause == "sign"


@pytest.mark.parametrize(
    ("text", "system"),
    [
        (DRIVEN.replace("+b", "-b"), "cart-pole"),
        (DRIVEN.replace("=F", "=-2F"), "cart-pole"),
        (DRIVEN.replace("(I+ml^2)", "(I-ml^2)"), "cart-pole"),
        (DAMPED.replace("l^2", "l"), "simple-pendulum"),
        (NAMED, "simple-pendulum"),  # another mechanism's name
        (DRIVEN.replace("F", "F + K"), "cart-pole"),
    ],
)
def test_what_may_be_another_mechanism_than_its_letters_say_is_not_called_wrong(tmp_path, text, system):
    with pytest.raises(InvalidInput, match=r"not known here|the index c"):
        graded(tmp_path, "mine.md", text, system=system)


# Shiki (1.10), (1.11) with what stands for θ₁ - θ₂, as pages write it.
ROWS = """θ1'' = [ {}m2 g sinθ2 cosδ - m2 sinδ (L1 ω1² cosδ + L2 ω2²) - (m1+m2) g sinθ1 ] / [ L1 (m1 + m2 sin²δ) ]
θ2'' = [ (m1+m2)( L1 ω1² sinδ + g sinθ1 cosδ - g sinθ2 ) + m2 L2 ω2² sinδ cosδ ] / [ L2 (m1 + m2 sin²δ) ]"""
ALPHA = r"""
\[ \alpha_1 = \frac{SIGN m_2 g \sin\theta_2\cos\delta - m_2\sin\delta (L_1\omega_1^2\cos\delta + L_2\omega_2^2) - (m_1+m_2) g\sin\theta_1}{L_1 (m_1+m_2\sin^2\delta)} \]
\[ \alpha_2 = \frac{(m_1+m_2)(L_1\omega_1^2\sin\delta + g\sin\theta_1\cos\delta - g\sin\theta_2) + m_2 L_2\omega_2^2\sin\delta\cos\delta}{L_2 (m_1+m_2\sin^2\delta)} \]
"""  # noqa: E501 -- as it stands


@pytest.mark.parametrize(
    "text",
    [
        "# The physics\n\nState `θ1, ω1, θ2, ω2`, angles from the vertical, `δ = θ1 - θ2`:\n\n```\nROWS\n```\n",
        "Double pendulum. State: θ₁, ω₁ = θ̇₁, θ₂, ω₂ = θ̇₂\n\nδ = θ1 - θ2\n\nROWS\n",
        "- `θ1, θ2` angles (from the vertical)\n- `ω1, ω2` the angular velocities\n\nwith $\\delta = "
        "\\theta_1 - \\theta_2$\nALPHA"
        "\n```text\nω_i^{t+Δt} = ω_i^t + α_i^t Δt\n```\n",
        "Double pendulum\n===============\n\nWith :math:`\\delta = \\theta_1 - \\theta_2`:\nRST",
        "$\\theta_1$ and $\\theta_2$ are the angles, $$m_1$$ and $$m_2$$ the masses, $\\delta = "
        "\\theta_1 - \\theta_2$.\nDDOT",
    ],
    ids=["fence", "unicode", "alpha", "rst", "letters"],
)  # fmt: skip
def test_letters_and_lists_among_words_are_no_rows(tmp_path, text):
    for sign, verdict in (("", "correct"), ("-", "wrong")):
        alpha = ALPHA.replace("SIGN", sign)
        ddot = alpha.replace(r"\alpha", r"\ddot\theta").replace(r"\omega", r"\dot\theta")
        rst = re.sub(r"\\\[ (.*) \\\]", r"\n.. math::\n    \1\n", ddot)
        whole = text.replace("ROWS", ROWS.format(sign)).replace("ALPHA", alpha)
        whole = whole.replace("DDOT", ddot).replace("RST", rst)
        assert graded(tmp_path, "mine.md", whole, system="double-pendulum").verdict == verdict


def test_names_in_greek_are_accelerations_only_where_nothing_else_is(tmp_path):
    inertias = r"$$\alpha_1 = (m_1+m_2) l_1^2$$ and $$\alpha_2 = m_2 l_2^2$$"
    with pytest.raises(InvalidInput, match="no equation of motion"):
        graded(tmp_path, "mine.md", inertias, system="double-pendulum")


LENGTH_L = r"""
- Lagrangian: $$L = \frac{1}{2} m L^2 \dot\theta^2 - m g L (1 - \cos\theta)$$
- so $$m L^2 \ddot\theta + m g L \sin\theta = 0$$
- or $$\ddot\theta + \frac{g}{L}\sin\theta = 0$$
"""


def test_a_letter_is_a_length_and_the_lagrangian(tmp_path):
    assert graded(tmp_path, "mine.md", LENGTH_L, system="simple-pendulum").verdict == "correct"
    wrong = graded(tmp_path, "mine.md", LENGTH_L.replace("m g L (1", "2 m g L (1"), system="simple-pendulum")
    assert [mark.stage for mark in wrong.stages if mark.outcome == "wrong"] == ["lagrangian"]


def test_a_lagrangian_of_names_alone_is_passed_over(tmp_path):
    found = graded(tmp_path, "mine.md", f"$$L = T - V$$\n{CART}", system="cart-pole")
    assert found.verdict == "correct"
    assert any("L = T - V" in note for note in found.notes)


def test_two_letters_are_not_taken_for_one_angle():
    with pytest.raises(InvalidInput, match="which mechanism it is about is not said"):
        grade_text({"equations": ["l θ2'' + g sin θ = 0"]})
