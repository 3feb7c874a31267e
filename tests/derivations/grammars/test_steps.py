# ruff: noqa: E501 -- programs stand on one line
"""Steps of a simulation whose step has a name of its own: H, tau, a field. The right program is correct, each slip wrong.

theta'' = -g/l sin(theta), by first principles; a cart of mass M that a force f drives, with a point m on a rod from up,
clockwise, by its two equations solved by hand: (M + m) x'' + m l cos(theta) theta'' = f + m l sin(theta) theta'^2 and
cos(theta) x'' + l theta'' = g sin(theta).
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
CART = """system = 'mechanism'
from = 'up'
sense = 'clockwise'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'f'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
vx = "x'"
w = "theta'"
[equations]
1 = '''
{}
'''
"""
SKETCH = "float theta = 1, w = 0;\nfloat H = 0.02;\nvoid draw() {\n  float a = -g/l*sin(theta);\n  w += a*H;\n  theta += w*H;\n}"
STRUCT = (
    "void tick(Swing* s) {\n  double a = -g/l*sin(s->theta);\n  s->theta += s->tau * s->w;\n  s->w += s->tau * a;\n}"
)
DRIVEN = """let x = 0, vx = 0, theta = 0.1, w = 0;
const T = 1/60;
function update(f) {
  const s = Math.sin(theta), c = Math.cos(theta);
  const ax = (f + m*l*w*w*s - m*g*s*c)/(M + m*s*s);
  const aw = (g*s - ax*c)/l;
  vx += T*ax;
  w += T*aw;
  x += T*vx;
  theta += T*w;
}"""
PROGRAMS = {
    "a sketch": (ALONE, SKETCH, [("-g/l", "g/l"), ("sin(theta)", "cos(theta)"), ("-g/l", "-g*l")]),
    "a struct's field": (ALONE, STRUCT, [("-g/l", "g/l"), ("sin(s->theta)", "cos(s->theta)")]),
    "a cart": (CART, DRIVEN, [("f + m*l", "f - m*l"), ("m*s*s)", "m*c*c)"), ("g*s - ax*c", "g*s + ax*c"), ("- m*g*s*c", "+ m*g*s*c")]),
}  # fmt: skip
SLIPS = [(about, text.replace(old, new)) for about, text, slips in PROGRAMS.values() for old, new in slips]
NOT_RIGHT = {
    "backwards": (ALONE, SKETCH.replace("theta += w*H", "theta -= w*H")),
    "half a step": (ALONE, SKETCH.replace("w += a*H", "w += a*H/2")),
    "two steps": (ALONE, SKETCH.replace("theta += w*H", "theta += w*K")),
    "a step that changes": (ALONE, SKETCH.replace("  theta +=", "  H = 2*H;\n  theta +=")),
    "a mass for a step": (ALONE, SKETCH.replace("H", "m")),
    "another's rate": (CART, DRIVEN.replace("x += T*vx", "x += T*w")),
}


@pytest.mark.parametrize(("about", "text"), [p[:2] for p in PROGRAMS.values()], ids=PROGRAMS)
def test_what_steps_by_a_name_of_its_own_is_read(about, text):
    assert grade_text(about.format(text)).verdict == "correct"


@pytest.mark.parametrize(("about", "text"), SLIPS)
def test_each_slip_is_wrong(about, text):
    assert grade_text(about.format(text)).verdict == "wrong"


@pytest.mark.parametrize(("about", "text"), NOT_RIGHT.values(), ids=NOT_RIGHT)
def test_what_does_not_step_forwards_is_not_called_right(about, text):
    with pytest.raises(InvalidInput):
        grade_text(about.format(text))
