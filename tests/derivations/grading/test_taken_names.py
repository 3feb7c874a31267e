# ruff: noqa: E501 -- formulas stand on one line, as in their notes
r"""Names in [define], or said in a note, that a convention or the mechanism has for something else: x of x_t, ω² = g/l.

What is right follows by hand: a support that moves up by h adds h'' to g; the cart-pole's rows are Lagrange's.
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

PUSHED = (
    "system='mechanism'\nfrom='down'\n[[bodies]]\ncoordinate='h'\njoint='slide'\nmass='0'\nalong='up'\nmotion='given'\n"
    "[[bodies]]\ncoordinate='\\theta'\nmass='m'\nlength='l'\n[define]\n{}\n[equations]\n1='''{}'''\n"
)
UP = r"l\ddot\theta + (g + \ddot h)\sin\theta = 0"
CART = (
    "system='mechanism'\nfrom='down'\n[[bodies]]\ncoordinate='x_c'\njoint='slide'\nmass='M'\n[[bodies]]\n"
    "coordinate='\\theta_p'\nmass='m'\nlength='l'\n[define]\nx='x_c'\n'{}'='\\theta_p'\n[equations]\n1='''{}'''\n2='''{}'''\n"
)
LOW = r"\ddot{x}_c\cos\theta_p + l\ddot\theta + g\sin\theta = 0"
SIMPLE = "system='simple-pendulum'\n[equations]\n1='''\n{}\n'''\n"
TWO = "system='double-pendulum'\n[equations]\n1='''\n{}\n'''\n"
GREEK = (
    r"$$\alpha \equiv (m_1+m_2)l_1^2, \quad \beta \equiv m_2 l_1 l_2\cos(\theta_1-\theta_2), \quad \gamma \equiv m_2 l_2^2$$"
    "\n"
    r"$$\alpha\ddot\theta_1 + \beta\ddot\theta_2 + m_2 l_1 l_2\dot\theta_2^2\sin(\theta_1-\theta_2) + (m_1+m_2) g l_1\sin\theta_1 = 0$$"
    "\n"
    r"$$\beta\ddot\theta_1 + \gamma\ddot\theta_2 - m_2 l_1 l_2\dot\theta_1^2\sin(\theta_1-\theta_2) + m_2 g l_2\sin\theta_2 = 0$$"
)


@pytest.mark.parametrize("motion", [
    r"h = 'h_0\cos(\omega t)'", r"h = '-\frac{a}{2} \sin(\Omega t + \phi)'", "h = 'h(t)'", "'h(t)' = 'a*cos(w*t)'",
    r"h = '2 a_0 \cos \omega_0 t'",
])  # fmt: skip
def test_a_given_motion_may_be_said_of_rows_in_its_rates(motion):
    assert grade_text(PUSHED.format(motion, UP)).verdict == "correct"
    assert grade_text(PUSHED.format(motion, UP.replace("g +", "g -"))).verdict == "wrong"
    assert grade_text(PUSHED.format(motion, UP.replace("sin", "cos"))).verdict == "wrong"


@pytest.mark.parametrize(("motion", "row"), [
    (r"a\cos(\omega t)", r"l\ddot\theta + (g - \omega^2 h)\sin\theta = 0"),  # right, as h'' = -ω² h
    (r"a\cos(\omega_0 t)", r"l\ddot\theta + (g - \omega_0^2 h)\sin\theta = 0"),
    (r"a\cos(t)", r"l\ddot\theta + (g - h)\sin\theta = 0"),  # right
    ("v t", r"l\ddot\theta + g\sin\theta = 0"),  # right, as h'' = 0
    (r"\cos(\omega t)", UP),
])  # fmt: skip
def test_what_a_given_motion_may_make_right_is_refused(motion, row):
    with pytest.raises(InvalidInput, match=r"define\.h: "):
        grade_text(PUSHED.format(f"h = '{motion}'", row))


@pytest.mark.parametrize(("angle", "row"), [
    (r"\theta", r"(M+m)\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta_p^2\sin\theta = 0"),
    ("theta", "(M+m)x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) = 0"),
])  # fmt: skip
def test_a_letter_may_stand_for_a_coordinate_with_an_index(angle, row):
    assert grade_text(CART.format(angle, row, LOW)).verdict == "correct"
    for slip in (("- ml", "+ ml"), ("- m l", "+ m l")):
        if slip[0] in row:
            assert grade_text(CART.format(angle, row.replace(*slip), LOW)).verdict == "wrong"
    assert grade_text(CART.format(angle, row, LOW.replace("cos", "sin"))).verdict == "wrong"


@pytest.mark.parametrize("note", [
    r"$$\ddot\theta + \omega^2\sin\theta = 0, \quad \omega^2 = g/l$$", r"$$\alpha \equiv g/l$$ $$\ddot\theta = -\alpha\sin\theta$$",
    r"$$I = ml^2$$ $$I\ddot\theta = -mgl\sin\theta$$", r"$$\rho = g/l$$ $$\ddot\theta = -\rho\sin\theta$$",
    r"$$\ddot\theta + a \sin\theta = 0, \qquad a = \frac{g}{l}$$",
])  # fmt: skip
def test_a_letter_of_a_convention_that_is_not_used_is_the_authors(note):
    assert grade_text(SIMPLE.format(note)).verdict == "correct"
    slipped = note.replace("g/l", "l/g").replace("ml^2", "2ml^2").replace(r"\frac{g}{l}", r"\frac{g}{2l}")
    assert slipped != note
    assert grade_text(SIMPLE.format(slipped)).verdict == "wrong"


def test_greek_letters_for_the_parts_of_two_rows():
    assert grade_text(TWO.format(GREEK)).verdict == "correct"
    assert not grade_text(TWO.format(GREEK)).assumes
    for slip in ((r"\cos(", r"\sin("), (r"\gamma \equiv m_2", r"\gamma \equiv m_1"), (r"- m_2 l_1", "+ m_2 l_1")):
        assert grade_text(TWO.format(GREEK.replace(*slip))).verdict == "wrong"


@pytest.mark.parametrize("note", [
    r"$$\omega = \sqrt{g/l}$$ $$\dot\theta = \omega, \quad \dot\omega = -\omega^2\sin\theta$$",  # ω of two things
    r"$\alpha = \ddot\theta$, $$\alpha = -\frac{g}{l}\sin\theta$$ $$l\alpha = -g\sin\theta$$",
])  # fmt: skip
def test_a_letter_for_two_things_is_refused(note):
    with pytest.raises(InvalidInput):
        grade_text(SIMPLE.format(note))


def test_a_rate_keeps_its_letter():
    """ω is the rate where no rate is written otherwise."""
    text = "system='simple-pendulum'\n[define]\nw='g/l'\n[equations]\n1='l a = -g sin(t)'\n"
    with pytest.raises(InvalidInput, match="not one in use"):
        grade_text(text)
