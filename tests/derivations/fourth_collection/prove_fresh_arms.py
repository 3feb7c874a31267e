"""What the arms of this folder print, entered by hand from the text, and what each describes."""

from mechanisms import I1, I2, a1, a2, bobs, g, l1, l2, lc1, lc2, links, m1, m2, rods, tau, tau1, tau2, th1, th2, w1, w2
from sympy import Rational, cos, sin

half, third = Rational(1, 2), Rational(1, 3)
h = m2 * l1 * lc2 * sin(th2)
d11 = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * cos(th2)) + I1 + I2
d12 = m2 * (lc2**2 + l1 * lc2 * cos(th2)) + I2
d22 = m2 * lc2**2 + I2
g2 = m2 * lc2 * g * cos(th1 + th2)
g1 = (m1 * lc1 + m2 * l1) * g * cos(th1) + g2


def acrobot():
    coriolis = [-h * w2 * w1 - h * (w1 + w2) * w2, h * w1 * w1]
    true = links(False, relative=True, horizontal=True, forces={th2: tau})
    return true, [d11 * a1 + d12 * a2 + coriolis[0] + g1, d12 * a1 + d22 * a2 + coriolis[1] + g2 - tau]


def pendubot():
    true = links(False, relative=True, horizontal=True, forces={th1: tau})
    return true, [d11 * a1 + d12 * a2 - h * w2 * w1 - h * w2 * w2 + g1 - tau, d12 * a1 + d22 * a2 + h * w1 * w1 + g2]


ARM = bobs((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})


def arm(times):
    """times: how often the product of the rates counts."""
    c2, s2, reach = cos(th2), sin(th2), m2 * l1 * l2
    return [
        ((m1 + m2) * l1**2 + m2 * l2**2 + 2 * reach * c2) * a1
        + (m2 * l2**2 + reach * c2) * a2
        - reach * s2 * (times * w1 * w2 + w2**2)
        + (m1 + m2) * g * l1 * cos(th1)
        + m2 * g * l2 * cos(th1 + th2)
        - tau1,
        (m2 * l2**2 + reach * c2) * a1 + m2 * l2**2 * a2 + reach * s2 * w1**2 + m2 * g * l2 * cos(th1 + th2) - tau2,
    ]


def level_arm():
    true = rods((l1, m1), (l2, m2), relative=True, horizontal=True, forces={th1: tau1, th2: tau2})
    one, two, three = third * m1 * l1**2 + m2 * l1**2 + third * m2 * l2**2, half * m2 * l1 * l2, third * m2 * l2**2
    c2, s2 = cos(th2), sin(th2)
    return (
        true,
        [
            (one + 2 * two * c2) * a1 + (three + two * c2) * a2 - two * s2 * w2 * w1 - two * s2 * (w1 + w2) * w2 - tau1,
            (three + two * c2) * a1 + three * a2 + two * s2 * w1 * w1 - tau2,
        ],
        {g: 0},
    )
