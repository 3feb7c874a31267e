# ruff: noqa: E501 -- formulas stand on one line, as on their pages
r"""Explicit time: a support that moves as a cos Ωt, a torque F cos ωt. By hand, θ from the downward vertical:

l θ̈ + (g + ÿ) sin θ = 0 of a support that moves up by y, l θ̈ + ẍ cos θ + g sin θ = 0 to the right by x.
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

SUPPORT = """system = 'mechanism'
from = 'down'
sense = 'counter-clockwise'
[[bodies]]
coordinate = '{0}'
joint = 'slide'
along = '{1}'
mass = '0'
motion = 'given'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
{0} = '''{2}'''
[equations]
1 = '''{3}'''
"""
RIGHT = [
    ("y_s", "up", r"a\cos\Omega t", r"l\ddot\theta + (g - a\Omega^2\cos\Omega t)\sin\theta = 0"),
    ("y_s", "up", r"a\sin(\Omega t)", r"l\ddot\theta + (g - a\Omega^2\sin(\Omega t))\sin\theta = 0"),
    ("y", "down", "-A*cos(w*t)", "l*theta'' + (g - A*w**2*np.cos(w*t))*sin(theta) = 0"),
    ("x_s", "right", r"A\cos\left(\omega t\right)", r"l\ddot\theta - A\omega^2\cos\left(\omega t\right)\cos\theta + g\sin\theta = 0"),
    ("X", "right", "D sin(Ω t)", "l θ'' - D Ω² sin(Ω t) cos θ + g sin θ = 0"),
]  # fmt: skip


@pytest.mark.parametrize("parts", RIGHT)
def test_a_support_that_is_moved_as_a_cosine(parts):
    found = grade_text(SUPPORT.format(*parts))
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize("parts", RIGHT)
def test_with_a_lost_square_or_another_sign_it_is_wrong(parts):
    name, along, motion, row = parts
    for old, new in (("^2", ""), ("**2", ""), ("²", ""), ("g ", "3g "), ("- a", "+ a"), ("- A", "+ A"), ("- D", "+ D")):
        if old in row:
            assert grade_text(SUPPORT.format(name, along, motion, row.replace(old, new, 1))).verdict == "wrong"


DRIVEN = """system = 'mechanism'
[[bodies]]
coordinate = 'phi'
mass = 'm'
length = 'l'
damping = 'c'
drive = 'K cos(w t)'
[equations]
1 = '''{}'''
"""


def test_a_torque_that_is_a_function_of_time():
    row = "m l^2 phi'' + c phi' + m g l sin(phi) = K cos(w t)"
    assert grade_text(DRIVEN.format(row)).verdict == "correct"
    assert grade_text(DRIVEN.format(row.replace("K cos", "2 K cos"))).verdict == "wrong"


def test_what_moves_so_has_to_be_said():
    with pytest.raises(InvalidInput, match="function of time; say what moves so"):
        grade_text(DRIVEN.format("m l^2 phi'' + c phi' + m g l sin(phi) = K sin(w t)"))
    with pytest.raises(InvalidInput, match="amplitude times a cosine"):
        grade_text(SUPPORT.format("y", "up", "a*cos(w*t) + b", "l*theta'' + (g - a*w^2*cos(w*t))*sin(theta) = 0"))
    with pytest.raises(InvalidInput, match="write it with the support"):
        grade_text(SUPPORT.format("y", "up", "a*cos(w*t)", "").split("[equations]")[0].replace(
            "system", "kinetic = 'm*l^2*theta_dot^2/2 + cos(w*t)'\nsystem", 1))  # fmt: skip
    with pytest.raises(InvalidInput, match="fixed in direction"):
        grade_text(SUPPORT.format("y", "up", "a*cos(w*t)", "l*theta'' + cos(w*t) = 0").replace("joint = 'slide'\n", "")
                   .replace("along = 'up'\n", ""))  # fmt: skip


TWO_WAYS = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'xp'
joint = 'slide'
mass = '0'
along = 'right'
motion = 'given'
[[bodies]]
coordinate = 'yp'
joint = 'slide'
mass = '0'
along = 'up'
motion = 'given'
[[bodies]]
coordinate = 'th'
mass = 'm'
length = 'l'
[define]
xp = 'ax*cos(omegax*t + phix)'
yp = 'ay*cos(omegay*t + phiy)'
[equations]
1 = "l*th'' = {} - (g - ay*omegay^2*cos(omegay*t + phiy))*sin(th)"
"""


def test_a_support_without_mass_that_moves_in_two_directions():
    """l θ'' = -x_p'' cos θ - (g + y_p'') sin θ, with both motions put in."""
    right = "ax*omegax^2*cos(omegax*t + phix)*cos(th)"
    assert grade_text(TWO_WAYS.format(right)).verdict == "correct"
    assert grade_text(TWO_WAYS.format(f"2*{right}")).verdict == "wrong"
    with pytest.raises(InvalidInput, match="function of time"):
        grade_text(TWO_WAYS.format(right.replace("+ phix", "- phix")))


def test_a_torque_cos_t():
    row = "m l^2 phi'' + c phi' + m g l sin(phi) = cos(t)"
    assert grade_text(DRIVEN.replace("K cos(w t)", "cos(t)").format(row)).verdict == "correct"
    assert grade_text(DRIVEN.replace("K cos(w t)", "cos(t)").format(row.replace("= cos", "= 2*cos"))).verdict == "wrong"
