"""Programs in Python and MATLAB are followed statement by statement: in-place changes, arrays, helpers, structs."""

import re
import time

import pytest
from followed_programs import ARM, CP, DP, ONE, PROGRAMS, REFUSED

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

# What these slips come to is right in another convention, which their files leave open, and is said so
OF_ANOTHER_CONVENTION = {("lambda_ivp", "g/l*np.sin"), ("momentum_one", "m*g*l"), ("matlab_row", "+ (g/l)"),
                         ("octave", "g / l"), ("scipy_nested", "g*sin")}  # fmt: skip
SLIPS = [(name, was, now) for name, (_, _, slips) in PROGRAMS.items() for was, now in slips]


def graded(head, program):
    head, define, rest = head.partition("[define]")
    return grade_text(f"{head}{define}{rest}[equations]\n1 = '''{program}'''\n")


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_right_program_is_right(name):
    head, program, _ = PROGRAMS[name]
    assert graded(head, program).verdict == "correct"


@pytest.mark.parametrize(("name", "was", "now"), SLIPS)
def test_a_slip_is_found_or_the_program_is_refused(name, was, now):
    head, program, _ = PROGRAMS[name]
    assert was in program
    try:
        found = graded(head, program.replace(was, now, 1))
    except InvalidInput:
        return
    assert (found.verdict == "wrong") != ((name, now) in OF_ANOTHER_CONVENTION)
    assert found.verdict == "wrong" or found.assumes


@pytest.mark.slow
def test_nearly_all_slips_are_named_wrong():
    refused = 0
    for name, was, now in SLIPS:
        head, program, _ = PROGRAMS[name]
        try:
            graded(head, program.replace(was, now, 1))
        except InvalidInput:
            refused += 1
    assert refused <= 0.12 * len(SLIPS)  # those that make the program fail, or leave its state's order open


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_plain_is_refused_in_the_words_of_the_program(name):
    with pytest.raises(InvalidInput) as error:
        graded(*REFUSED[name])
    assert not re.search(r"\b(?:val|line|part)[0-9]", str(error.value))


def test_parameters_that_change_places_are_found():
    program = """
def f(y, t, p):
    m1, m2 = p['m2'], p['m1']
    l1, l2, g = p['l1'], p['l2'], p['g']
    theta1, theta2, w1, w2 = y
    d = theta1 - theta2
    A = np.array([[(m1+m2)*l1, m2*l2*np.cos(d)], [l1*np.cos(d), l2]])
    b = np.array([-m2*l2*w2**2*np.sin(d) - (m1+m2)*g*np.sin(theta1), l1*w1**2*np.sin(d) - g*np.sin(theta2)])
    return np.hstack((w1, w2, np.linalg.solve(A, b)))
"""
    right = program.replace("p['m2'], p['m1']", "p['m1'], p['m2']")
    assert graded(DP, right).verdict == "correct"
    try:
        assert graded(DP, program).verdict == "wrong"
    except InvalidInput as error:
        assert "m1" in str(error)  # noqa: PT017


def test_a_name_that_nobody_declared_is_told_in_its_line():
    program = (
        "def f(t, y):\n    theta, omega = y\n    a = -grr/l*np.sin(theta) - b/(m*l**2)*omega\n    return omega, a\n"
    )
    with pytest.raises(InvalidInput, match="'grr' is not known"):
        graded(ONE, program)


@pytest.mark.parametrize(
    ("program", "says"),
    [
        ("function [M, C] = f(q, dq)\nM = 1;\nend", "C is given back, and has no value"),
        ("def f(t, y):\n    while True:\n        pass\n    return y\n", r"rates|not plain|loop"),
        ("def f(t, y):\n    return f(t, y)\n", r"deep|rates|functions"),
        ("def f(t, y):\n    x = [0]\n" + "    x = x + x\n" * 30 + "    return x\n", None),
        ("def f(t, y):\n    a = y[0] + 1\n" + "    a = a*a + a*a\n" * 60 + "    return [a, a, a, a]\n", None),
        ("def f(t, y):\n" + "    for i in range(64):\n" + "        y = y + 1\n" + "    return y\n", None),
        ("def f(t, y):\n    for i in range(60):\n        for j in range(60):\n            for k in range(60):\n                z = i*j\n    return z\n", r"statements"),  # noqa: E501
        ("x = [" + "[" * 200 + "]" * 200 + "]; y = 1; z = 2; a = 3; b = 4; c = 5; d = 6", None),
        ("function f = a(x)\nf = " + "(" * 300 + "x" + ")" * 300 + ";\nend", None),
    ],
)  # fmt: skip
def test_hostile_programs_are_refused_soon(program, says):
    begun = time.process_time()
    with pytest.raises(InvalidInput, match=says):
        graded(ARM, program)
    assert time.process_time() - begun < 2  # s


def test_an_if_about_the_drive_alone_is_no_matter():
    """The drive is whatever it is."""
    program = """
def step(t, y):
    x, x_dot, theta, theta_dot = y
    if t < 1:
        F = 10.0
    else:
        F = 0.0
    d = M + m*np.sin(theta)**2
    a = (F + m*np.sin(theta)*(l*theta_dot**2 + g*np.cos(theta)))/d
    al = (-F*np.cos(theta) - m*l*theta_dot**2*np.cos(theta)*np.sin(theta) - (M + m)*g*np.sin(theta))/(l*d)
    return x_dot, a, theta_dot, al
"""
    assert graded(CP, program).verdict == "correct"
    assert graded(CP, program.replace("-F*np", "F*np")).verdict == "wrong"


def test_lines_of_a_readme_that_are_formulas():
    """A mass on a massless rod with a torque M(t): θ'' = -(g/l) sin θ + M/(m l²)."""
    head = "system = 'mechanism'\n[[bodies]]\ncoordinate = '\\theta'\nmass = 'm'\nlength = 'l'\ndrive = 'M(t)'\n"
    lines = r"""
$\frac{d\theta}{dt} = \omega$
$\frac{d\omega}{dt} = -\frac{g}{l} \sin(\theta) + \frac{1}{ml^2} M(t)$
"""
    assert graded(head, lines).verdict == "correct"
    assert graded(head, lines.replace("{ml^2}", "{ml}")).verdict == "wrong"
