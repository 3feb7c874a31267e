"""A support whose motion is given: in its accelerated frame gravity is g and the negative of its acceleration."""

import pytest

from furiko import InvalidInput
from furiko.derivations.classroom.in_python import grade_text

# A point mass on a rod, from the upward vertical, its support at height f: l φ'' = (g + f'') sin φ
KAPITZA = """system = "mechanism"
from = "up"
{0}
[[bodies]]
name = "support"
coordinate = "f"
joint = "slide"
along = "up"
mass = "0"
{1}
[[bodies]]
on = "support"
coordinate = "varphi"
mass = "m"
length = "l"
{2}
"""
ROW = "[equations]\n1 = '\\ddot\\varphi = (w_0^2 + \\ddot f/l) \\sin\\varphi'\n[define]\nw_0 = '\\sqrt{g\\over l}'"
GIVEN, DRIVEN = 'motion = "given"', 'drive = "P"'
MOTION = ("the motion of f is given: its own equation, which is not here, would say what drives it",)


@pytest.mark.parametrize(
    ("support", "verdict", "assumes"), [(GIVEN, "correct", ()), (DRIVEN, "correct", MOTION), ("", "undecided", ())]
)
def test_the_row_of_the_pendulum_alone(support, verdict, assumes):
    found = grade_text(KAPITZA.format("", support, ROW))
    assert (found.verdict, found.assumes) == (verdict, assumes)
    wrong = grade_text(KAPITZA.format("", support, ROW.replace("+ \\ddot f", "- \\ddot f")))
    assert (wrong.verdict, [finding.cause for finding in wrong.findings]) == ("wrong", ["sign"])


def test_a_drive_that_is_used_is_no_given_motion():
    used = KAPITZA.format("", DRIVEN, ROW.replace("\\sin\\varphi'", "\\sin\\varphi + P - P'"))
    assert grade_text(used).verdict == "correct"  # it cancels, and so is not there
    spring = KAPITZA.format("", DRIVEN + '\nspring = "P"', ROW)
    assert grade_text(spring).verdict == "undecided"  # P is in the mechanism besides


def test_a_lagrangian_needs_nothing_that_the_given_motion_alone_has():
    # v² = l²φ'² + f'² - 2 l f' φ' sin φ; f'² and m g f are functions of time
    right = r"m/2 (l^2 \dot\varphi^2 - 2 l \dot f \dot\varphi \sin\varphi) - m g l \cos\varphi"
    for line, verdict in ((right, "correct"), (right.replace("- 2 l", "+ 2 l"), "wrong")):
        assert grade_text(KAPITZA.format(f"lagrangian = '{line}'", GIVEN, "")).verdict == verdict


@pytest.mark.parametrize(
    ("support", "says"), [('motion = "known"', "motion: 'given'"), (GIVEN + "\n" + DRIVEN, "a drive besides")]
)
def test_what_is_said_otherwise_is_refused(support, says):
    with pytest.raises(InvalidInput, match=says):
        grade_text(KAPITZA.format("", support, ROW))


def test_a_root_is_read_where_it_is_squared():
    row = '[equations]\n1 = "{}"\n[define]\nw_0 = "sqrt(g/l)"'
    head = 'system = "point-masses"\nlinks = 1\n'
    assert grade_text(head + row.format("theta'' = -w_0^2 sin(theta)")).verdict == "correct"
    with pytest.raises(InvalidInput, match="read where it is squared"):
        grade_text(head + row.format("theta'' = -w_0 sin(theta)"))
