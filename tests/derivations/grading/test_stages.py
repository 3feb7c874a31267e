"""A derivation stated stage by stage: the first wrong stage is named, what follows from it is not blamed again.

The double pendulum of point masses; what follows from a wrong stage is derived here by hand.
"""

import pytest

from furiko import InvalidInput
from furiko.derivations.classroom.in_python import grade_text

SYSTEM = 'system = "point-masses"\nlinks = 2\n'
T = 'kinetic = "T = m1/2*l1^2*w1^2 + m2/2*(l1^2*w1^2 + l2^2*w2^2 + 2*l1*l2*w1*w2*cos(t1-t2))"\n'
U = 'potential = "U = -(m1+m2)*g*l1*cos(t1) - m2*g*l2*cos(t2)"\n'
L = 'lagrangian = "L = (m1+m2)/2*l1^2*w1^2 + m2/2*l2^2*w2^2 + m2*l1*l2*w1*w2*cos(t1-t2) + (m1+m2)*g*l1*cos(t1) \
+ m2*g*l2*cos(t2)"\n'
POSITIONS = """[positions]
x1 = "l1*sin(t1)"
y1 = "-l1*cos(t1)"
x2 = "l1*sin(t1) + l2*sin(t2)"
y2 = "-l1*cos(t1) - l2*cos(t2)"
"""
VELOCITIES = """[velocities]
"vx1" = "l1*w1*cos(t1)"
"y1'" = "l1*w1*sin(t1)"
'\\dot{x}_2' = "l1*w1*cos(t1) + l2*w2*cos(t2)"
"y2_dot" = "l1*w1*sin(t1) + l2*w2*sin(t2)"
"v1^2" = "l1^2*w1^2"
"""
ROWS = """[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0"
2 = "l2*a2 + l1*a1*cos(t1-t2) - l1*w1^2*sin(t1-t2) + g*sin(t2) = 0"
"""
SOLVED = """[solved]
1 = "a1 = (m2*g*sin(t2)*cos(t1-t2) - m2*sin(t1-t2)*(l1*w1^2*cos(t1-t2) + l2*w2^2) - (m1+m2)*g*sin(t1)) \
/ (l1*(m1 + m2*sin(t1-t2)^2))"
2 = "a2 = ((m1+m2)*(l1*w1^2*sin(t1-t2) - g*sin(t2) + g*sin(t1)*cos(t1-t2)) + m2*l2*w2^2*sin(t1-t2)*cos(t1-t2)) \
/ (l2*(m1 + m2*sin(t1-t2)^2))"
"""
ALL = SYSTEM + T + U + L + POSITIONS + VELOCITIES + ROWS + SOLVED


def outcomes(text):
    found = grade_text(text)
    return found, {mark.stage: mark.outcome for mark in found.stages}


def test_all_stages_right():
    found, stages = outcomes(ALL)
    assert (found.verdict, found.assumes, found.notes) == ("correct", (), ())
    assert list(stages) == ["positions", "velocities", "kinetic", "potential", "lagrangian", "equations", "solved"]
    assert set(stages.values()) == {"right"}


# ½ is left out of the first body's T, and l1, L and the rows follow: 2 m1 stands for m1 wherever it has inertia
HALF = {"m1/2*l1^2*w1^2": "m1*l1^2*w1^2", "(m1+m2)/2*l1^2": "(2*m1+m2)/2*l1^2", "(m1+m2)*l1*a1": "(2*m1+m2)*l1*a1"}


def half_forgotten():
    text = ALL.replace(SOLVED, "")
    for right, wrong in HALF.items():
        assert right in text
        text = text.replace(right, wrong)
    return text


def test_what_follows_from_a_wrong_stage_is_not_blamed_again():
    found, stages = outcomes(half_forgotten())
    assert found.verdict == "wrong"
    assert [mistake.name for mistake in found.mistakes] == ["half-missing:1"]
    assert stages == {"positions": "right", "velocities": "right", "kinetic": "wrong", "potential": "right",
                      "lagrangian": "follows", "equations": "follows"}  # fmt: skip
    assert {finding.says.partition(",")[0] for finding in found.findings} == {"The kinetic energy"}


def test_a_later_mistake_of_its_own_is_named_too():
    found, stages = outcomes(half_forgotten().replace("- l1*w1^2*sin", "+ l1*w1^2*sin"))
    assert (stages["kinetic"], stages["lagrangian"], stages["equations"]) == ("wrong", "follows", "wrong")
    (finding,) = found.stages[-1].findings
    assert (finding.row, finding.cause) == ("2", "sign")


def test_a_slip_that_is_mended_in_the_next_stage_leaves_that_right():
    _, stages = outcomes(ALL.replace("T = m1/2*", "T = m1*"))
    assert [stage for stage, outcome in stages.items() if outcome != "right"] == ["kinetic"]


@pytest.mark.parametrize(
    ("stage", "right", "wrong", "says"),
    [
        ("positions", 'x2 = "l1*sin(t1) + ', 'x2 = "', "The position x2, the term with sin(θ₁): it is missing"),
        ("velocities", "\"y1'\" = \"", "\"y1'\" = \"-", "The velocity y1, the term with θ̇₁ sin(θ₁): the sign"),
        ("velocities", 'vx1" = "l1*w1', 'vx1" = "l1', "cos(θ₁)"),
        ("kinetic", "2*l1*l2*w1*w2*cos(t1-t2))", "2*l1*l2*w1*w2)", "θ̇₁ θ̇₂"),
        ("potential", "U = -(m1+m2)", "U = (m1+m2)", "cos(θ₁): the sign is wrong"),
        ("lagrangian", "l2*w1*w2*cos(t1-t2) +", "l2*w1*w2*cos(t1+t2) +", "cos(θ₁+θ₂)"),
        ("equations", "+ g*sin(t2)", "+ g*cos(t2)", "Row 2"),
        ("solved", "(l2*(m1", "(l1*(m1", "Row 2"),
    ],
)  # fmt: skip
def test_a_mistake_at_each_stage_is_named_there(stage, right, wrong, says):
    text = ALL.replace(right, wrong, 1)
    assert text != ALL
    found, stages = outcomes(text)
    assert [name for name, outcome in stages.items() if outcome == "wrong"] == [stage]
    assert any(says in finding.says for finding in found.findings)


def test_bodies_carried_by_a_wrong_one_are_not_blamed_again():
    swapped = ALL.replace("l1*sin(t1)", "l1*cos(t1)", 2).replace(VELOCITIES, "")  # x of mass 1, and in x of mass 2
    found, stages = outcomes(swapped)
    assert stages["positions"] == "wrong"
    assert {finding.row for finding in found.findings} == {"x1"}


def test_axes_are_the_authors_choice_and_heights_keep_to_it():
    down = POSITIONS.replace('y1 = "-', 'y1 = "').replace('y2 = "-l1*cos(t1) -', 'y2 = "l1*cos(t1) +')
    found, stages = outcomes(SYSTEM + U + down)
    assert (found.verdict, found.notes) == ("correct", ("x is counted to the right and y downwards.",))
    found, stages = outcomes(
        SYSTEM + 'from = "down"\n' + U.replace("-(m1+m2)", "(m1+m2)").replace("- m2", "+ m2") + down
    )
    assert stages == {"positions": "right", "potential": "wrong"}


def test_constants_are_the_authors_choice():
    found, _ = outcomes(SYSTEM + T + U.replace("U = ", "U = (m1+m2)*g*l1 + m2*g*l2 "))
    assert (found.verdict, found.notes) == ("correct", ())


def test_another_convention_is_a_condition():
    up = SYSTEM + T + U.replace("-(m1+m2)", "(m1+m2)").replace("- m2", "+ m2")
    found, _ = outcomes(up)
    assert (found.verdict, found.assumes) == ("correct", ("angles are measured from the upward vertical",))
    assert found.notes == ("If they are not: The potential energy: a mistake is made here.",)


CART = """system = "cart-pole"
kinetic = "M/2 x'^2 + m/2 (x'^2 + 2 l x' θ' cos θ + l^2 θ'^2)"
potential = "- m g l cos θ"
hamiltonian = "(m l^2 p_x^2 - 2 m l cos(θ) p_x p_θ + (M+m) p_θ^2)/(2 m l^2 (M + m sin(θ)^2)) - m g l cos θ"
[positions]
x1 = "x"
x2 = "x + l sin θ"
y2 = "- l cos θ"
[momenta]
p_x = "(M+m) x' + m l θ' cos θ"
"p_θ" = "m l x' cos θ + m l^2 θ'"
[equations]
1 = "x' = (l p_x - p_θ cos θ)/(l (M + m sin(θ)^2))"
2 = "θ' = ((M+m) p_θ - m l p_x cos θ)/(m l^2 (M + m sin(θ)^2))"
3 = "p_x' = 0"
4 = "p_θ' = -m l x' θ' sin θ - m g l sin θ"
"""


def test_hamiltons_way_from_positions_to_its_equations():
    found, stages = outcomes(CART)
    assert (found.verdict, set(stages.values())) == ("correct", {"right"})
    for right, wrong, stage in (
        ("p_x = \"(M+m) x'", "p_x = \"M x'", "momenta"),
        ("(M+m) p_θ^2", "m p_θ^2", "hamiltonian"),
        ("(l p_x - p_θ", "(l p_x + p_θ", "equations"),
        ("- m g l sin θ", "+ m g l sin θ", "equations"),
    ):
        _, stages = outcomes(CART.replace(right, wrong))
        assert next(name for name, outcome in stages.items() if outcome == "wrong") == stage


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (SYSTEM + '[positions]\nx = "0"', "which of the 2 bodies"),
        (SYSTEM + '[positions]\nx3 = "0"', "body 3, and there are 2"),
        (SYSTEM + '[positions]\nr1 = "0"', "give x1, y1, x2"),
        (SYSTEM + 'positions = "x1"', "a table of components"),
        (SYSTEM + T + '[equations]\n1 = "a1 = 0"\n[solved]\n1 = "a1"', "solved.1"),
    ],
)
def test_what_cannot_be_read_is_refused_with_its_place(text, says):
    with pytest.raises(InvalidInput, match=says):
        grade_text(text)
