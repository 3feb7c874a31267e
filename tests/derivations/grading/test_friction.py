"""Dry friction at joints: by virtual work its force is -F sgn(joint rate), and on the carrier the other way round."""

import pytest

from furiko import InvalidInput
from furiko.derivations.classroom.in_python import grade_text

CART = """
system = "mechanism"
[[bodies]]
name = "cart"
coordinate = "x"
joint = "slide"
mass = "M"
friction = "F"
[[bodies]]
name = "pole"
coordinate = "theta"
length = "l"
mass = "m"
[equations]
1 = '''(M+m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) FRICTION = 0'''
2 = "l theta'' + x'' cos(theta) + g sin(theta) = 0"
"""
BOBS = """
system = "mechanism"
angles = "ANGLES"
[[bodies]]
coordinate = "theta1"
mass = "m1"
length = "l1"
friction = "f1"
[[bodies]]
coordinate = "theta2"
mass = "m2"
length = "l2"
friction = "f2"
[equations]
"""
# Absolute angles. Row 1 less row 2's friction: the elbow's torque acts on the first link the other way round.
ABSOLUTE = (
    BOBS.replace("ANGLES", "absolute")
    + """
1 = '''(m1+m2) l1^2 theta1'' + m2 l1 l2 (theta2'' cos(theta1-theta2) + theta2'^2 sin(theta1-theta2))
  + (m1+m2) g l1 sin(theta1) = -f1 sgn(theta1') + f2 sgn(theta2' - theta1')'''
2 = '''m2 l2^2 theta2'' + m2 l1 l2 (theta1'' cos(theta1-theta2) - theta1'^2 sin(theta1-theta2)) + m2 g l2 sin(theta2)
  = -f2 sgn(theta2' - theta1')'''
"""
)


def cart(friction: str) -> str:
    return CART.replace("FRICTION", friction)


@pytest.mark.parametrize(
    "friction",
    [
        "+ F sgn(x')", r"+ F \operatorname{sgn}(\dot x)", r"+ F \operatorname{sgn}\dot x", r"+ F \mathrm{sgn}(\dot{x})",
        "+ F*sign(xdot)", "+ F*np.sign(x_dot)", "+ F*sign(Derivative(x(t), t))", r"+ F \frac{|\dot x|}{\dot x}",
        r"+ F \frac{\left|\dot x\right|}{\dot x}", "+ F x'/|x'|", r"+ F\,\lvert\dot x\rvert/\dot x",
        "+ F*abs(x')/x'", "- F sgn(-3 x')", "+ F sgn(x')^3", "+ F/sgn(x')",
    ],
)  # fmt: skip
def test_every_way_to_write_it_is_read(friction):
    found = grade_text(cart(friction))
    assert (found.verdict, found.assumes) == ("correct", ())


def test_it_is_said_back_as_it_is_written():
    assert grade_text(cart("+ F x'/|x'|")).reading.equations[0][1].endswith("F x\u0307/|x\u0307| = 0")


@pytest.mark.parametrize(
    ("friction", "cause"),
    [("- F sgn(x')", "friction-sign"), ("", "friction-missing"), ("+ F", "friction-without-sign")],
)
def test_mistakes_with_it_are_named(friction, cause):
    assert [m.cause for m in grade_text(cart(friction)).mistakes] == [cause]


def test_between_links_it_is_the_joints_own_rate_and_acts_on_both():
    assert grade_text(ABSOLUTE).verdict == "correct"
    for wrong, cause in (
        ({" + f2 sgn(theta2' - theta1')": ""}, "friction-reaction-missing"),
        ({"f2 sgn(theta2' - theta1')": "f2 sgn(theta2')"}, "friction-rate"),
    ):
        text = ABSOLUTE
        for right, other in wrong.items():
            text = text.replace(right, other)
        assert [m.cause for m in grade_text(text).mistakes] == [cause]


def test_in_relative_angles_each_joint_has_its_own():
    # θ1 = q1, θ2 = q1 + q2: the rows of the absolute angles, and their sum, are those of the joints
    text = (
        BOBS.replace("ANGLES", "relative")
        + """
1 = '''((m1+m2) l1^2 + m2 l2^2 + 2 m2 l1 l2 cos(theta2)) theta1'' + (m2 l2^2 + m2 l1 l2 cos(theta2)) theta2''
  - m2 l1 l2 sin(theta2) (2 theta1' theta2' + theta2'^2) + (m1+m2) g l1 sin(theta1) + m2 g l2 sin(theta1+theta2)
  + f1 sgn(theta1') = 0'''
2 = '''(m2 l2^2 + m2 l1 l2 cos(theta2)) theta1'' + m2 l2^2 theta2'' + m2 l1 l2 sin(theta2) theta1'^2
  + m2 g l2 sin(theta1+theta2) + f2 sgn(theta2') = 0'''
"""
    )
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("f2 sgn(theta2')", "f2 sgn(theta2' - theta1')")).verdict == "wrong"


@pytest.mark.parametrize(
    ("friction", "says"),
    [
        ("+ F tanh(x')", "smoothed friction"), ("+ F sgn(x)", "only the sign of a rate"),
        ("+ F sgn(M x')", "only the sign of a rate"), ("+ F |x'", "is not closed"), ("+ F sgn(x' theta')", "only the"),
    ],
)  # fmt: skip
def test_what_is_not_read_is_refused(friction, says):
    with pytest.raises(InvalidInput, match=says):
        grade_text(cart(friction))
