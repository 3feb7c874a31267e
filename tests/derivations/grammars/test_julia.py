# ruff: noqa: E501 -- programs stand on one line
"""Functions of Julia that give back functions, with types of results and keyword arguments. The right one is correct,
each slip wrong.

By first principles: theta'' = -g/l sin(theta); of two points on rods, both angles from down,
(m1 + m2) l1 a1'' + m2 l2 a2'' cos(a1 - a2) + m2 l2 a2'^2 sin(a1 - a2) + (m1 + m2) g sin(a1) = 0 and
l2 a2'' + l1 a1'' cos(a1 - a2) - l1 a1'^2 sin(a1 - a2) + g sin(a2) = 0; with a pivot at y upwards, g + y'' for g.
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

ALONE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
w = "theta'"
[equations]
1 = '''
{}
'''
"""
TWO = """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = 'a1'
mass = 'm1'
length = 'l1'
[[bodies]]
coordinate = 'a2'
mass = 'm2'
length = 'l2'
[define]
w1 = "a1'"
w2 = "a2'"
[equations]
1 = '''
{}
'''
"""
SHAKEN = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'y'
joint = 'slide'
mass = '0'
along = 'up'
motion = 'given'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
y = 'A*sin(W*t + d)'
w = "theta'"
[equations]
1 = '''
{}
'''
"""
PENDULUM = "function maker(; l=1.0, g=9.81)\n    function swing(t, s)::Vector{Float64}\n        theta, w = s\n        [w, -g/l*sin(theta)]\n    end\nend"
RODS = """function two(m1, m2, l1, l2, g)
    function rhs(u, p, t)::Vector
        a1, a2, w1, w2 = u
        c, s = cos(a1 - a2), sin(a1 - a2)
        A = [(m1 + m2)*l1 m2*l2*c; l1*c l2]
        b = [-m2*l2*s*w2^2 - (m1 + m2)*g*sin(a1); l1*s*w1^2 - g*sin(a2)]
        [w1; w2; A \\ b]
    end
    rhs
end"""
PIVOT = 'function shaken(; A=0, W=1, d=0, l=1, g=9.81)\n    "the pivot is y(t) = A sin(W t + d)"\n    function f(t, s)\n        theta, w = s\n        [w, -(g - A*W^2*sin(W*t + d))*sin(theta)/l]\n    end\n    f\nend'
PROGRAMS = {
    "a closure alone": (ALONE, PENDULUM, [("-g/l", "g/l"), ("-g/l", "-g*l"), ("sin", "cos")]),
    "a closure by its name": (TWO, RODS, [("l1*s*w1^2", "-l1*s*w1^2"), ("m2*l2*c;", "m2*l1*c;"), ("(m1 + m2)*g", "m1*g"), ("s*w2^2", "s*w2")]),
    "a shaken pivot": (SHAKEN, PIVOT, [("g - A", "g + A"), ("W^2", "W"), ("sin(W*t + d)", "cos(W*t + d)")]),
}  # fmt: skip
SLIPS = [(about, text, *slip) for about, text, slips in PROGRAMS.values() for slip in slips]
REFUSED = {
    "another phase": (SHAKEN, PIVOT.replace("sin(W*t + d)", "sin(W*t + e)")),
    "the phase's other sign": (SHAKEN, PIVOT.replace("sin(W*t + d)", "sin(W*t - d)")),
}


@pytest.mark.parametrize(("about", "text"), [p[:2] for p in PROGRAMS.values()], ids=PROGRAMS)
def test_a_function_that_gives_back_a_function_is_read(about, text):
    assert grade_text(about.format(text)).verdict == "correct"


@pytest.mark.parametrize(("about", "text", "old", "new"), SLIPS)
def test_each_slip_is_wrong(about, text, old, new):
    body = text.index("function ", 5)  # the docstring says the motion, too
    changed = text[:body] + text[body:].replace(old, new, 1)
    assert changed != text
    assert grade_text(about.format(changed)).verdict == "wrong"


@pytest.mark.parametrize(("about", "text"), REFUSED.values(), ids=REFUSED)
def test_another_phase_is_not_called_right(about, text):
    with pytest.raises(InvalidInput):
        grade_text(about.format(text))
