# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""Newton's equations with a rod's force: by hand, the cart pulled by T sin θ, the bob by T along the rod, its weight down."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

CART = """system = 'cart-pole'
from = 'down'
sense = 'counter-clockwise'
[equations]
1 = '''{}'''
"""
CART_ROW = r"M\ddot{x} = T\sin\theta"
ACROSS = r"m\left(\ddot{x} + l\ddot\theta\cos\theta - l\dot\theta^2\sin\theta\right) = -T\sin\theta"
UPWARDS = r"m\left(l\ddot\theta\sin\theta + l\dot\theta^2\cos\theta\right) = T\cos\theta - mg"


def graded(*rows):
    return grade_text(CART.format(r" \\ ".join(rows)))


def test_the_force_is_eliminated():
    for rows in ((CART_ROW, ACROSS, UPWARDS), (UPWARDS, ACROSS, CART_ROW)):
        found = graded(*rows)
        assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize(
    "rows",
    [
        (CART_ROW.replace("T", "-T"), ACROSS, UPWARDS),
        (CART_ROW, ACROSS.replace("-T", "T"), UPWARDS),
        (CART_ROW, ACROSS, UPWARDS.replace("- mg", "+ mg")),
        (CART_ROW, ACROSS, UPWARDS.replace(r"T\cos", r"T\sin")),
        (CART_ROW, ACROSS.replace(r"- l\dot", r"+ l\dot"), UPWARDS),
    ],
)
def test_a_force_or_a_component_with_a_mistake_is_wrong(rows):
    assert graded(*rows).verdict == "wrong"


def test_a_pendulum_with_two_tensions():
    rows = (r"m_1 l_1 \ddot\theta_1 = -m_1 g\sin\theta_1 - T_2\sin(\theta_1-\theta_2)",
            r"m_1 l_1 \dot\theta_1^2 = T_1 - m_1 g\cos\theta_1 - T_2\cos(\theta_1-\theta_2)",
            r"m_2(l_2\ddot\theta_2 + l_1\ddot\theta_1\cos(\theta_1-\theta_2) - l_1\dot\theta_1^2\sin(\theta_1-\theta_2)) = -m_2 g\sin\theta_2",
            r"m_2(l_2\dot\theta_2^2 + l_1\ddot\theta_1\sin(\theta_1-\theta_2) + l_1\dot\theta_1^2\cos(\theta_1-\theta_2)) = T_2 - m_2 g\cos\theta_2")  # fmt: skip

    def of(rows):
        return grade_text(
            "system = 'double-pendulum'\n[equations]\n" + "\n".join(f"{k} = '''{r}'''" for k, r in enumerate(rows, 1))
        )

    assert of(rows).verdict == "correct"
    assert of((rows[0].replace("- T_2", "+ T_2"), *rows[1:])).verdict == "wrong"


def test_a_force_that_is_not_linear_or_one_row_too_few_is_refused():
    with pytest.raises(InvalidInput, match="not linear"):
        graded(CART_ROW.replace("T", "T^2"), ACROSS, UPWARDS)
    with pytest.raises(InvalidInput, match="rows for 2 angles"):
        graded(CART_ROW, ACROSS + " + N", UPWARDS)
