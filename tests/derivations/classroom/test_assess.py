"""A problem pins what a submission cannot change; points are counted by hand from the terms of Shiki's (1.9)."""

from dataclasses import replace

import pytest

from furiko import InvalidInput
from furiko.derivations.classroom.assess import assess_text
from furiko.derivations.classroom.folder import Worker
from furiko.derivations.classroom.problem import parse_problem, problem_of
from furiko.models.readers.toml_text import parse_toml

PROBLEM = """title = "Double pendulum"
system = "n-leg"
links = 2
angles = "absolute"
from = "down"
"""
# Shiki (1.9): four terms in each row: two accelerations, one squared rate, gravity
RIGHT = """[equations]
1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -(m1+m2)*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) + m2*l1*w1^2*sin(t1-t2)"
"""
WRONG_SIGN = RIGHT.replace("+ m2*l1*w1^2", "- m2*l1*w1^2")
LAGRANGIAN = """lagrangian = "m1*l1^2*w1^2/2 + m2/2*(l1^2*w1^2 + l2^2*w2^2 + 2*l1*l2*w1*w2*cos(t1-t2)) \
+ (m1+m2)*g*l1*cos(t1) + m2*g*l2*cos(t2)"
"""


def assessed(text, more="", problem=PROBLEM):
    return assess_text(parse_problem(problem + more), "ann", text)


def test_what_is_pinned_may_be_left_out():
    found = assessed(RIGHT, "points = 10")
    assert (found.outcome, found.points, found.of) == ("correct", 10, 10)
    assert found.feedback == ("Right. 10 of 10 points.",)


@pytest.mark.parametrize(
    "stated", ['system = "n-leg"', 'system = "double-pendulum"', "links = 2", 'angles = "absolute"']
)
def test_what_is_pinned_may_be_stated(stated):
    assert assessed(f"{stated}\n{RIGHT}").outcome == "correct"


@pytest.mark.parametrize(
    "stated",
    ['system = "rods"', 'system = "n-leg"\nlinks = 3', "links = 1", 'angles = "relative"', 'from = "up"',
     'system = "cart-pole"', 'system = "mechanism"\n[[bodies]]\ncoordinate = "x"\njoint = "slide"\nmass = "m"'],
)  # fmt: skip
def test_what_is_pinned_cannot_be_changed(stated):
    found = assessed(f"{stated}\n{RIGHT}")
    assert found.outcome == "not read"
    assert "cannot change it" in found.why


def test_right_equations_of_another_problem_are_wrong():
    upwards = RIGHT.replace("= -(m1", "= (m1").replace("= -m2*g", "= m2*g")  # right for angles from the upward vertical
    assert assessed(upwards).outcome == "wrong"


def test_one_mass_for_both_is_refused_unless_the_problem_says_so():
    merged = RIGHT.replace("(m1+m2)", "2*m").replace("m2", "m")
    found = assessed(merged)
    assert found.outcome == "not read"
    assert "m without an index" in found.why
    assert assessed(merged, 'equal = ["masses"]').outcome == "correct"
    assert assessed(merged.replace("2*m*l1", "m*l1"), 'equal = ["masses"]').outcome == "wrong"
    assert assessed(RIGHT, 'equal = ["masses"]').outcome == "correct"


def test_a_wrong_term_costs_its_share_of_its_row():
    found = assessed(WRONG_SIGN, "[points]\nrows = [4, 6]")
    assert [(p.name, p.outcome, p.points) for p in found.parts] == [("row 1", "right", 4), ("row 2", "wrong", 4.5)]
    assert found.points == 8.5  # one of four terms of a row that is worth 6
    two = WRONG_SIGN.replace("-m2*g*sin(t2)", "+m2*g*cos(t2)")  # its gravity: sin is missing, cos is one too many
    assert assessed(two, "[points]\nrows = [4, 6]").points == 4 + 6 - 3 * 1.5


def test_each_term_and_each_mistake_can_have_a_price():
    assert assessed(WRONG_SIGN, "[points]\ntotal = 10\neach_term = 2").points == 8
    assert assessed(WRONG_SIGN, "[points]\ntotal = 10\neach_term = 99").points == 5  # never more than the row's worth
    halved = LAGRANGIAN.replace("2*l1*l2", "l1*l2")
    priced = assessed(halved, "[points]\ntotal = 10\neach_mistake = 3")
    assert (priced.outcome, priced.points) == ("wrong", 7)
    # the right Lagrangian has θ̇₁², θ̇₂², θ̇₁θ̇₂ cos, cos θ₁, cos θ₂: one of five is wrong
    assert assessed(halved, "points = 10").points == 8


def test_rows_that_were_combined_or_multiplied_are_right_rows():
    times = RIGHT.splitlines()
    left, right = times[2].split(' = "')[1].rstrip('"').split(" = ")
    multiplied = f'[equations]\n1 = "w1*({left}) = w1*({right})"\n2 = "a1 = 0"'
    found = assessed(multiplied, "[points]\nrows = [4, 6]")
    assert found.outcome == "wrong"
    assert [p.outcome for p in found.parts] == ["wrong", "right"]  # row 2, times θ̇₁


def test_a_missing_row_has_no_points_and_a_repeated_one_does_not_count_twice():
    one = "\n".join(RIGHT.splitlines()[:2])
    found = assessed(one, "[points]\nrows = [4, 6]")
    assert (found.outcome, found.points) == ("undecided", 4)
    again = one + "\n2 = " + one.splitlines()[1].partition(" = ")[2]
    assert assessed(again, "[points]\nrows = [4, 6]").points < 10
    assert assessed(again).outcome == "wrong"


def test_forms_are_pinned():
    assert assessed(LAGRANGIAN).outcome == "correct"
    refused = assessed(LAGRANGIAN, 'forms = ["equations"]')
    assert (refused.outcome, "asks for the equations of motion" in refused.why) == ("not read", True)
    assert assessed(RIGHT, 'forms = ["solved"]').outcome == "not read"
    solved = '[equations]\n1 = "a1 = -g/l1*sin(t1)"'
    one = PROBLEM.replace("links = 2", "links = 1")
    assert assessed(solved, 'forms = ["solved"]', one).outcome == "correct"
    assert assessed(solved, 'forms = ["equations"]', one).outcome == "correct"


@pytest.mark.parametrize(
    ("hints", "told", "kept"),
    [
        (0, "Wrong.", "Row 2"),
        (1, "Row 2: wrong", "θ̇₁²"),
        (2, "the term with θ̇₁² sin(θ₁−θ₂)", "sign"),
        (3, "the sign is wrong", "expected"),
        (4, "Solution, 2", "nothing is kept back"),
    ],
)
def test_hints_tell_so_much_and_no_more(hints, told, kept):
    lines = "\n".join(assessed(WRONG_SIGN, f"[feedback]\nhints = {hints}").feedback)
    assert told in lines
    assert kept not in lines


def test_the_solution_is_shown_where_the_problem_says_so():
    lines = assessed(WRONG_SIGN, "[feedback]\nhints = 0\nsolution = true").feedback
    assert lines[0].startswith("Wrong.")
    assert lines[1].startswith("Solution, 1")


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ('system = "n-leg"', "links"),
        ("links = 2", "system"),
        (PROBLEM + "hint = 2", "hint: no such field"),
        (PROBLEM + "[feedback]\nhints = 5", "feedback.hints"),
        (PROBLEM + "[points]\nrows = [1]", "points.rows"),
        (PROBLEM + "[points]\ntotal = 9\nrows = [4, 6]", "points.total"),
        (PROBLEM + "points = -1", "points.total"),
        (PROBLEM + "[points]\nrows = [4, 6]\nstages = { kinetic = 1 }", "rows or stages"),
        (PROBLEM + "[points]\nstages = { poem = 1 }", "points.stages.poem"),
        (PROBLEM + "points = nan", "points.total"),
        (PROBLEM + 'forms = ["poem"]', "forms"),
        (PROBLEM + "forms = []", "forms"),
        (PROBLEM + "[limits]\nseconds = 0", "limits.seconds"),
    ],
)
def test_a_problem_that_is_none_is_refused(wrong, says):
    with pytest.raises(InvalidInput, match=says):
        parse_problem(wrong)


@pytest.mark.slow
def test_a_process_that_was_ended_is_started_again(tmp_path):
    ann = tmp_path / "ann.toml"
    ann.write_text(RIGHT)
    fields = parse_toml(PROBLEM)
    worker = Worker(replace(problem_of(fields), seconds=1e-4), fields)
    late = worker.assess("ann", RIGHT, ".toml")
    assert (late["outcome"], late["why"]) == ("not graded", "it takes longer than 0.0001 s")
    worker.problem = replace(worker.problem, seconds=30.0)
    assert worker.assess("ann", RIGHT, ".toml")["outcome"] == "correct"
    assert worker.process is not None
    worker.process.kill()
    ended = worker.assess("ann", RIGHT, ".toml")
    assert (ended["outcome"], ended["why"]) == ("not graded", "the process that graded it ended")
    assert worker.assess("ann", RIGHT, ".toml")["outcome"] == "correct"
    worker.end()


STAGED = """potential = "-(m1+m2)*g*l1*cos(t1) - m2*g*l2*cos(t2)"
kinetic = "m1*l1^2*w1^2 + m2/2*(l1^2*w1^2 + l2^2*w2^2 + 2*l1*l2*w1*w2*cos(t1-t2))"
[equations]
1 = "(2*m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -(m1+m2)*g*sin(t1) - m2*l2*w2^2*sin(t1-t2)"
2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) = -m2*g*sin(t2) + m2*l1*w1^2*sin(t1-t2)"
"""
STAGES = "[points]\nstages = { kinetic = 3, potential = 2, equations = 5 }"


def test_stages_have_points_of_their_own_and_a_mistake_costs_once():
    # T lacks a ½: one of its three terms, θ̇₁², θ̇₂², θ̇₁θ̇₂ cos; the equations follow from it
    found = assessed(STAGED, STAGES)
    assert [(p.name, p.outcome, p.points) for p in found.parts] == [
        ("kinetic energy", "wrong", 2), ("potential energy", "right", 2), ("equations of motion", "right", 5)
    ]  # fmt: skip
    assert (found.outcome, found.points) == ("wrong", 9)
    assert any("follows from your earlier stages" in line for line in found.feedback)
    assert "Cause: The kinetic energy of mass 1 is missing its factor ½: it is ½ m v²." in found.feedback
    # and a mistake of its own in a row: one of the eight terms of both
    again = assessed(STAGED.replace("+ m2*l1*w1^2", "- m2*l1*w1^2"), STAGES)
    assert again.points == 2 + 2 + 5 * 7 / 8


def test_a_stage_that_is_not_there_has_no_points():
    found = assessed(RIGHT, STAGES)
    assert (found.outcome, found.points) == ("undecided", 5)
    assert assessed(LAGRANGIAN, STAGES).points == 0


def test_without_points_by_stage_each_stage_is_worth_the_same():
    assert assessed(STAGED, "points = 9").points == 3 * 2 / 3 + 3 + 3


def test_a_hamiltonian_is_a_form_with_points_by_term():
    hamiltonian = """hamiltonian = "(m2*l2^2*p1^2 + (m1+m2)*l1^2*p2^2 - 2*m2*l1*l2*p1*p2*cos(t1-t2))\
/(2*m2*l1^2*l2^2*(m1+m2*sin(t1-t2)^2)) - (m1+m2)*g*l1*cos(t1) - m2*g*l2*cos(t2)"\n"""
    hamiltonian = hamiltonian.replace("\\\n", "")
    assert assessed(hamiltonian, "points = 10").points == 10
    wrong = assessed(hamiltonian.replace("- m2*g", "+ m2*g"), "points = 10")
    assert (wrong.outcome, wrong.points) == ("wrong", 8)  # one of p₁², p₂², p₁p₂, cos θ₁, cos θ₂
    assert assessed(hamiltonian, 'forms = ["lagrangian"]').outcome == "not read"
