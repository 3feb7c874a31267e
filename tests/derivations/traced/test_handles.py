# ruff: noqa: E501 -- programs stand on one line
"""MATLAB's handles, drives of time, and accelerations in the order of the rates. The right one is correct, each slip wrong.

Two points on rods, both angles from down, by first principles: M [a1'', a2''] = b with M = [(m1 + m2) l1^2, m2 l1 l2 c;
m2 l1 l2 c, m2 l2^2], b = [-m2 l1 l2 s a2'^2 - (m1 + m2) g l1 sin(a1), m2 l1 l2 s a1'^2 - m2 g l2 sin(a2)], c and s of
a1 - a2; with momenta p = M a', p1' = -m2 l1 l2 s a1' a2' - (m1 + m2) g l1 sin(a1), p2' = m2 l1 l2 s a1' a2' - m2 g l2
sin(a2). A pendulum with a torque u: m l^2 theta'' = u - m g l sin(theta).
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

TWO = """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = '{0}'
mass = 'm1'
length = 'l1'
[[bodies]]
coordinate = '{1}'
mass = 'm2'
length = 'l2'
[define]
"""
ALONE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
drive = 'u'
[define]
'z(1)' = 'theta'
'z(2)' = "theta'"
'u(t)' = 'u'
"""
HANDLES = TWO.format("a1", "a2") + "'q(1)' = 'a1'\n'q(2)' = 'a2'\n'dq(1)' = \"a1'\"\n'dq(2)' = \"a2'\"\n"
MOMENTA = TWO.format("alfa", "beta") + "'z(1)' = 'alfa'\n'z(2)' = 'beta'\n'z(3)' = 'p1'\n'z(4)' = 'p2'\n"
RATES = TWO.format("a1", "a2") + "'s[1]' = 'a2'\n'v[0]' = \"a1'\"\n'v[1]' = \"a2'\"\n"
SPRUNG = """M = @(q) [(m1 + m2)*l1^2, m2*l1*l2*cos(q(1) - q(2)); m2*l1*l2*cos(q(1) - q(2)), m2*l2^2];
h = @(q, dq) m2*l1*l2*sin(q(1) - q(2))*[dq(2)^2; -dq(1)^2];
G = @(q) [(m1 + m2)*g*l1*sin(q(1)); m2*g*l2*sin(q(2))];
ddq = @(q, dq) -M(q)\\(h(q, dq) + G(q));"""
FOUR = """F1 = @(t,z) (l2*z(3) - l1*cos(z(1)-z(2))*z(4))/(l1^2*l2*(m1 + m2*sin(z(1)-z(2))^2));
F2 = @(t,z) (l1*(m1 + m2)*z(4) - l2*m2*cos(z(1)-z(2))*z(3))/(l1*l2^2*m2*(m1 + m2*sin(z(1)-z(2))^2));
F3 = @(t,z) -m2*l1*l2*sin(z(1)-z(2))*F1(t,z)*F2(t,z) - (m1 + m2)*g*l1*sin(z(1));
F4 = @(t,z) m2*l1*l2*sin(z(1)-z(2))*F1(t,z)*F2(t,z) - m2*g*l2*sin(z(2));
F = @(t,z) [F1(t,z); F2(t,z); F3(t,z); F4(t,z)];"""
TORQUE = (
    "function dz = swing(t, z, u)\ndz = zeros(2, 1);\ndz(1) = z(2);\ndz(2) = (u(t) - m*g*l*sin(z(1)))/(m*l^2);\nend"
)
ORDER = """def mass(s):
    d = delta
    return np.array([[(m1 + m2)*l1**2, m2*l1*l2*np.cos(d)], [m2*l1*l2*np.cos(d), m2*l2**2]])

def acceleration(s, v):
    b = np.array([-m2*l1*l2*np.sin(delta)*v[1]**2 - G1, m2*l1*l2*np.sin(delta)*v[0]**2 - m2*g*l2*np.sin(s[1])])
    return np.linalg.solve(mass(s), b)"""
ORDER = ORDER.replace("delta", "(a1 - s[1])").replace("G1", "(m1 + m2)*g*l1*np.sin(a1)")
PROGRAMS = {
    "a handle that calls others": (HANDLES, SPRUNG, [("+ G(q)", "- G(q)"), ("dq(2)^2; -dq(1)^2", "dq(1)^2; -dq(2)^2"), ("(m1 + m2)*g", "m1*g"), ("-M(q)", "M(q)")]),
    "four handles with momenta": (MOMENTA, FOUR, [("F4 = @(t,z) m2", "F4 = @(t,z) -m2"), ("l2*z(3)", "l2*z(4)"), ("F3(t,z); F4(t,z)", "F4(t,z); F3(t,z)"), ("*g*l2", "*g*l1")]),
    "a torque of time": (ALONE, TORQUE, [("u(t) -", "2*u(t) -"), ("- m*g", "+ m*g"), ("m*l^2", "m*l")]),
    "in the order of the rates": (RATES, ORDER, [("-m2*l1*l2*np.sin", "m2*l1*l2*np.sin"), ("v[0]**2", "v[0]"), ("m2*l2**2", "m2*l1**2")]),
}  # fmt: skip
SLIPS = [(about, text, *slip) for about, text, slips in PROGRAMS.values() for slip in slips]


def judged(about, text):
    return grade_text(f"{about}[equations]\n1 = '''\n{text}\n'''\n").verdict


@pytest.mark.parametrize(("about", "text"), [p[:2] for p in PROGRAMS.values()], ids=PROGRAMS)
def test_it_is_read(about, text):
    assert judged(about, text) == "correct"


@pytest.mark.parametrize(("about", "text", "old", "new"), SLIPS)
def test_each_slip_is_wrong(about, text, old, new):
    assert old in text
    assert judged(about, text.replace(old, new, 1)) == "wrong"


def test_rates_the_other_way_round_are_the_other_accelerations():
    about = RATES.replace("'v[0]' = \"a1'\"", "'v[0]' = \"a2'\"").replace("'v[1]' = \"a2'\"", "'v[1]' = \"a1'\"")
    assert judged(about, ORDER) == "wrong"


def test_rates_and_angles_in_two_orders_are_refused():
    about = RATES.replace("'s[1]' = 'a2'", "'s[0]' = 'a2'\n's[1]' = 'a1'")
    with pytest.raises(InvalidInput):
        judged(about, ORDER.replace("s[1]", "s[0]").replace("a1", "s[1]"))
