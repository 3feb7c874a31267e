# ruff: noqa: E501 -- equations and messages stand on one line
"""Equations from textbooks, held against the truth in space of mechanisms that scene files have."""

import numpy as np
import pytest
from flint import arb

from furiko.derivations.robot.plane import plane_of
from furiko.derivations.robot.reading import read_robot
from furiko.derivations.robot.rows import _factor, alignment, true_terms
from furiko.derivations.robot.why import reasons
from furiko.models import InvalidInput
from furiko.models.scene import scene_from_toml
from furiko.models.trees.states import random_states

CART_POLE = """
[system]
kind = "tree"
[[system.links]]
name = "cart"
mass = 1.1
[[system.links.joints]]
name = "slider"
kind = "slide"
axis = [1, 0, 0]
DAMPING
[[system.links]]
name = "pole"
parent = "cart"
mass = 0.3
centre = [0, 0, 0.7]
INERTIA
[[system.links.joints]]
name = "hinge"
axis = [0, 1, 0]
"""
# Two point masses that hang; the elbow turns the other way round, and is at 0.3 rad where the arm is straight.
ARM = """
[system]
kind = "tree"
[[system.links]]
name = "upper"
mass = 1.5
position = [0, 0, 2]
centre = [0, 0, -0.7]
[[system.links.joints]]
name = "shoulder"
axis = [0, -1, 0]
[[system.links]]
name = "lower"
parent = "upper"
position = [0, 0, -0.7]
mass = 0.5
centre = [0, 0, -0.4]
[[system.links.joints]]
name = "elbow"
axis = [0, 1, 0]
ref = 0.3
"""
# Turned about the vertical, then about a horizontal axis: a spherical pendulum, q2 from the downward vertical.
SPHERICAL = """
[system]
kind = "tree"
[[system.links]]
name = "yoke"
[[system.links.joints]]
name = "q1"
axis = [0, 0, 1]
armature = 0.25
[[system.links]]
name = "rod"
parent = "yoke"
mass = 2.0
centre = [0, 0, -0.5]
[[system.links.joints]]
name = "q2"
axis = [0, -1, 0]
"""
ELASTIC = """
[system]
kind = "tree"
[[system.links]]
name = "guide"
[[system.links.joints]]
name = "pivot"
axis = [0, -1, 0]
[[system.links]]
name = "bob"
parent = "guide"
mass = 0.8
[[system.links.joints]]
name = "spring"
kind = "slide"
axis = [0, 0, -1]
stiffness = 40.0
springref = 0.6
"""

FIXED = """
[system]
kind = "tree"
[[system.links]]
name = "rod"
mass = 2.0
centre = [0, 0, -1]
[[system.links.joints]]
name = "hinge"
axis = [0, 1, 0]
[[system.links]]
name = "weight"
parent = "rod"
position = [0, 0, -3]
quaternion = [0, 1, 0, 0]
mass = 1.0
centre = [0, 0, 1]
inertia = [0.4, 0.5, 0.2]
"""


def cart_pole(head, rows, *, damping="", inertia=""):
    return head + CART_POLE.replace("DAMPING", damping).replace("INERTIA", inertia) + rows


# In the joints' own coordinates: the pole stands up at zero, and turns to +x.
UPRIGHT = """
[symbols]
x = "slider"
theta = "hinge"
M = 1.1
m = 0.3
l = 0.7
[equations]
1 = "(M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = 0"
2 = "m*l*cos(theta)*x'' + m*l^2*theta'' - m*g*l*sin(theta) = 0"
"""
# Wikipedia, Inverted pendulum: from the upward vertical, counter-clockwise.
WIKIPEDIA = (
    UPRIGHT[: UPRIGHT.index("1 =")]
    + r"""
1 = '''(M+m)\ddot x - m\ell\ddot\theta\cos\theta + m\ell\dot\theta^2\sin\theta = 0'''
2 = '''\ell\ddot\theta - g\sin\theta = \ddot x\cos\theta'''
"""
)
# The double pendulum as it is printed everywhere, from the downward vertical; and the same in relative angles.
ABSOLUTE = r"""
[symbols]
theta1 = "shoulder"
theta2 = "elbow"
[equations]
1 = "(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2) + (m1+m2)*g*sin(theta1) = 0"
2 = '''l_2\ddot\theta_2 + l_1\ddot\theta_1\cos(\theta_1-\theta_2) - l_1\dot\theta_1^2\sin(\theta_1-\theta_2) + g\sin\theta_2 = 0'''
"""
RELATIVE = """
[symbols]
q1 = "shoulder"
q2 = "elbow"
[define]
c2 = "cos(q2)"
s2 = "sin(q2)"
[equations]
1 = "(m1*l1^2 + m2*(l1^2 + 2*l1*l2*c2 + l2^2))*q1'' + m2*(l1*l2*c2 + l2^2)*q2'' - m2*l1*l2*s2*(2*q1'*q2' + q2'^2) + (m1+m2)*g*l1*sin(q1) + m2*g*l2*sin(q1+q2) = 0"
2 = "m2*(l1*l2*c2 + l2^2)*q1'' + m2*l2^2*q2'' + m2*l1*l2*s2*q1'^2 + m2*g*l2*sin(q1+q2) = 0"
"""
FUNCTION = """
function = '''
import numpy as np

def cartpole(t, y, M=1.1, m=0.3):
    "Accelerations of a cart and its pole."
    x, th, dx, dth = y
    l, total = 0.7, M + m
    s, c = np.sin(th), np.cos(th)
    force = m * l * dth ** 2 * s
    det = l * (total - m * c**2)
    a_th = (total * g * s - force * c) / det
    return [dx, dth, (force - m * l * a_th * c) / total, a_th]
'''
"""
RIGHT = {
    "cart-pole": cart_pole("", UPRIGHT),
    "cart-pole, from up": cart_pole('from = "up"\nsense = "counter-clockwise"\n', WIKIPEDIA),
    "cart-pole, a Lagrangian and a damper": cart_pole(
        'lagrangian = "(M+m)*x\'^2/2 + m*l*x\'*theta\'*cos(theta) + m*l^2*theta\'^2/2 - m*g*l*cos(theta)"\n'
        + UPRIGHT[: UPRIGHT.index("[equations]")], "", damping="damping = 0.4"),
    "cart-pole, a damper": cart_pole("", UPRIGHT.replace("sin(theta) = 0", "sin(theta) + b*x' = 0", 1), damping="damping = 0.4"),
    "cart-pole, a function": cart_pole(FUNCTION, ""),
    "cart-pole, combined rows": cart_pole("", UPRIGHT.replace("1 = \"(M+m)*x''", "1 = \"M*x''", 1).replace(
        "- m*l*theta'^2*sin(theta) = 0", "- m*l*theta'^2*sin(theta) - (m*l*cos(theta)*x'' + m*l^2*theta'' - m*g*l*sin(theta)) = -m*x''")),
    "arm, absolute": 'angles = "absolute"\n' + ARM + ABSOLUTE,
    "arm, relative": 'angles = "relative"\nfrom = "down"\n' + ARM + RELATIVE,
    "spherical": SPHERICAL + """
[equations]
1 = "(J + m*lc^2*sin(q2)^2)*q1'' + 2*m*lc^2*sin(q2)*cos(q2)*q1'*q2' = 0"
2 = "lc*q2'' - lc*sin(q2)*cos(q2)*q1'^2 + g*sin(q2) = 0"
[symbols]
J = 0.25
m = 2.0
lc = 0.5
""",
    "elastic": ELASTIC + """
[symbols]
theta = "pivot"
r = "spring"
[equations]
1 = "m*r^2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0"
2 = "m*r'' - m*r*theta'^2 - m*g*cos(theta) + k*(r - 0.6) = 0"
""",
}  # fmt: skip


def read(text):
    scene = scene_from_toml(text, "mine")
    d = read_robot(scene.system, scene.own)
    states = random_states("robot", scene.system, 4)
    q, v = (np.array([state[k] for state in states]) for k in (0, 1))
    return d, scene.system, true_terms(scene.system.mechanism(), q, v)


@pytest.mark.parametrize("name", RIGHT)
def test_right_equations_give_the_true_accelerations_and_terms(name):
    d, _, true = read(RIGHT[name])
    motion = d.motion()
    got = motion.accelerations(true.q, true.v)
    # The equations have decimals where the mechanism has the nearest doubles: some ε of the largest number, and the
    # truth is rounded once.
    assert np.abs(got - true.accelerations).max() <= 1e-14 * np.abs(true.accelerations).max()
    scale = alignment(motion, true)
    if "function" in name or "combined" in name:
        assert scale is None
        return
    matrix, rest = motion.floats(true.q, true.v)
    assert np.abs(scale @ matrix - true.mass_matrix).max() <= 1e-13 * np.abs(true.mass_matrix).max()
    assert np.abs(rest @ scale.T - true.rest).max() <= 1e-13 * np.abs(true.rest).max()


def test_what_is_taken_from_the_model_is_said():
    d, *_ = read('angles = "absolute"\n' + ARM + ABSOLUTE)
    assert d.values == {"m1": 1.5, "m2": 0.5, "l1": 0.7, "l2": 0.4}
    assert d.said == (
        "theta1 is joint 'shoulder', theta2 is joint 'elbow'",
        "angles are measured from the downward vertical",
        "taken from the model: m1 = 1.5 kg, the mass of 'upper'; m2 = 0.5 kg, the mass of 'lower'; "
        "l1 = 0.7 m, the length of 'upper'; l2 = 0.4 m, the length of 'lower'",
    )


WRONG_EQUATIONS = [
    ("- m*l*theta'^2", "+ m*l*theta'^2", "sign", "Row 1, the term with theta'² sin(theta): the sign is wrong."),
    ("m*l^2*theta''", "m*l*theta''", "factor-missing", "Row 2, the term with theta'': it lacks the factor l."),
    ("(M+m)*x''", "M*x''", "part-missing", "Row 1, the term with x'': the part m is missing."),
    ("m*l*cos(theta)*x''", "2*m*l*cos(theta)*x''", "factor-two", "Row 2, the term with x'' cos(theta)"),
    ("- m*l*theta'^2*sin(theta)", "", "velocity-terms-forgotten", "In row 1 (x), in d/dt ∂T/∂q̇"),
    ("theta'^2", "theta'", "inner-derivative", "In row 1 (x), the inner derivative is forgotten"),
]


@pytest.mark.parametrize(("there", "wrong", "cause", "says"), WRONG_EQUATIONS)
def test_a_wrong_term_is_named_in_the_authors_letters(there, wrong, cause, says):
    d, system, true = read(cart_pole("", UPRIGHT.replace(there, wrong, 1)))
    first, *_ = reasons(d, system, true)
    assert not first.in_model
    assert first.says.startswith(says)
    assert cause in first.cause


def test_gravity_of_the_other_sign_may_be_another_zero_of_the_angle():
    d, system, true = read(cart_pole("", UPRIGHT.replace("- m*g*l*sin", "+ m*g*l*sin")))
    (found,) = reasons(d, system, true)
    assert found.cause == "angle-convention"
    assert 'write angles = "absolute", from = "down", sense = "counter-clockwise"' in found.says
    assert found.says.endswith("if not: The potential energy of hinge has the wrong sign.")
    declared = 'from = "up"\nsense = "clockwise"\n'
    d, system, true = read(cart_pole(declared, UPRIGHT.replace("- m*g*l*sin", "+ m*g*l*sin")))
    assert [x.cause for x in reasons(d, system, true)] == ["potential-energy-sign"]


def test_a_slide_on_a_hinge_is_along_its_link_and_numbers_are_as_printed():
    d, system, true = read(RIGHT["elastic"].replace("- m*r*theta'^2", "+ m*r*theta'^2"))
    assert [(x.cause, x.says) for x in reasons(d, system, true)] == [
        ("sign", "Row 2, the term with theta'²: the sign is wrong.")
    ]


def test_where_letters_are_missing_the_wrong_term_is_named_in_numbers():
    rows = RIGHT["spherical"].replace("+ g*sin", "- g*sin")
    d, system, true = read(rows)
    assert [(x.cause, x.says) for x in reasons(d, system, true)] == [
        ("sign", "in the row of 'q2' the term of gravity has the wrong sign")
    ]


OTHER_MODELS = [
    (cart_pole("", UPRIGHT.replace("m = 0.3", "m = 0.2")), "mass", "the mass of 'pole' is 0.3 kg in the model, where m is 0.2 kg"),
    (cart_pole("", UPRIGHT.replace("l = 0.7", "l = 0.5")), "com-displaced", "'pole' is 0.7 m in the model, where l is 0.5 m"),
    (cart_pole("", UPRIGHT, damping="damping = 0.4"), "damping", "the model has damping at 'slider' (0.4 N s/m)"),
    (cart_pole("", UPRIGHT, inertia="inertia = [0.02, 0.02, 0.001]"), "inertia", "the model has a moment of inertia at 'pole' (0.02 kg m²)"),
    (cart_pole("", UPRIGHT.replace("M = 1.1", "M = 1.0").replace("m = 0.3", "m = 0.2")), "mass", "the mass of 'cart' is 1.1 kg in the model, where M is 1 kg"),
]  # fmt: skip


def test_dampers_and_springs_that_are_both_left_out_are_both_named():
    d, system, true = read(cart_pole("", UPRIGHT, damping="damping = 0.4\nstiffness = 3.0"))
    found = reasons(d, system, true)
    assert [(x.in_model, x.cause, x.measured) for x in found] == [(True, "damping", 0.4), (True, "stiffness", 3.0)]


def test_what_is_fixed_to_a_link_is_counted_to_it():
    # 2 kg 1 m and 1 kg 4 m below the hinge, the second fixed and turned: 3 kg at 2 m; about that 2·1² + 1·2² + 0.5
    plane = plane_of(scene_from_toml(FIXED, "mine").system)
    (body,) = plane.bodies
    assert (body.mass, body.centre, body.inertia) == (3.0, pytest.approx((0, -2)), pytest.approx(6.5))


def test_the_length_of_a_rod_is_not_taken_from_its_centre():
    rod = cart_pole("", UPRIGHT.replace("l = 0.7\n", ""), inertia="inertia = [0.02, 0.02, 0.001]")
    with pytest.raises(InvalidInput, match="'l' is not known here"):
        read(rod)
    d, *_ = read(cart_pole("", UPRIGHT.replace("l = 0.7\n", "")))  # of a point mass it is
    assert d.values["l"] == 0.7


@pytest.mark.parametrize(("text", "cause", "says"), OTHER_MODELS)
def test_right_equations_of_another_mechanism_are_told_from_wrong_ones(text, cause, says):
    d, system, true = read(text)
    first, *rest = reasons(d, system, true)
    assert all(x.in_model for x in (first, *rest))
    assert first.cause == cause
    assert says in first.says


REFUSED = [
    (cart_pole("", UPRIGHT.replace("M = 1.1\n", "")), "equations.1: column 2: 'M' is not known here"),
    (cart_pole("", UPRIGHT.replace('theta = "hinge"', "")), "which coordinate is joint 'hinge'"),
    (cart_pole("", UPRIGHT.replace('"hinge"', '"hinges"')), "symbols.theta: no joint is called 'hinges' (did you mean 'hinge'?); there are slider, hinge"),
    (cart_pole("", UPRIGHT[: UPRIGHT.index("2 =")]), "equations: 1 row for 2 joints; one for each joint is needed"),
    (cart_pole("", UPRIGHT.replace("x'' +", "x''*theta'' +")), "accelerations are multiplied by one another"),
    (cart_pole("", UPRIGHT.replace("M = 1.1", '"M-1" = 1.1')), "symbols.M-1: a letter or a word, with an index"),
    (cart_pole("", UPRIGHT.replace("m = 0.3", "m = 0.3\nm_1 = 0.3\nm1 = 0.4")), "symbols.m1: m_1 and m1 are one symbol"),
    (cart_pole("", UPRIGHT.replace("M = 1.1", '"" = 1.1')), "symbols.: a letter or a word, with an index"),
    (cart_pole("", UPRIGHT.replace("M = 1.1", "M = nan")), "symbols.M: the name of a joint, or a finite number"),
    (cart_pole('lagrangian = "x"\n', UPRIGHT), "lagrangian: equations is given already"),
    (cart_pole('from = "upwards"\n', UPRIGHT), "from: 'upwards' is not known"),
    ('from = "up"\n' + RIGHT["spherical"], "its hinges' axes are not parallel"),
    (cart_pole(FUNCTION.replace("s, c = np.sin(th), np.cos(th)", "import os; os.system('true')"), ""), "function: line 7: Import"),
    (cart_pole(FUNCTION.replace("np.sin(th)", "open('x')"), ""), "is not followed"),
    (cart_pole(FUNCTION.replace("[dx, dth,", "[dth, dx,"), ""), "number 1 of what it returns is not the rate"),
    (cart_pole("function = '''def f(q, v):\n    return " + "-" * 4000 + "q[0], 0'''\n", ""), "function"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "says"), REFUSED)
def test_what_cannot_be_taken_as_meant_is_refused_with_its_place(text, says):
    with pytest.raises(InvalidInput) as refused:
        read(text)[0].motion()
    assert says in str(refused.value)


def test_dry_friction_in_the_equations_is_said_to_be_theirs_alone():
    with_friction = UPRIGHT.replace("(theta) = 0", "(theta) + F*sgn(x') = 0", 1).replace("l = 0.7", "l = 0.7\nF = 0.25")
    d, system, true = read(cart_pole("", with_friction))
    (found,) = reasons(d, system, true)
    assert found.in_model
    assert found.cause == "dry-friction"
    # The cart is pushed against its motion by 0.25 N: M(θ) (s̈ - s̈ without friction) = (-0.25 sgn ẋ, 0)
    change = d.motion().accelerations(true.q, true.v) - true.accelerations
    pushed = np.einsum("bij,bj->bi", true.mass_matrix, change)
    assert np.abs(pushed - np.stack([-0.25 * np.sign(true.v[:, 0]), 0 * true.v[:, 0]], axis=1)).max() <= 1e-12  # ~ 4 N
    d, system, true = read(cart_pole("", with_friction.replace("- m*l*theta'^2", "+ m*l*theta'^2", 1)))
    assert [r.cause for r in reasons(d, system, true)] == ["dry-friction", "sign"]


def test_dry_friction_in_a_function_is_followed():
    function = FUNCTION.replace("dth ** 2 * s", "dth ** 2 * s - 0.25 * np.sign(dx)")
    d, system, true = read(cart_pole(function, ""))
    assert [r.cause for r in reasons(d, system, true)] == ["dry-friction"]


# The arm's rows in its relative angles, summed over the masses by loops: v_b = Σ_k≤b l_k q̇-sum_k (cos, sin)
LOOPS = """
angles = "relative"
from = "down"
function = '''
import numpy as np

def arm(q, v):
    m, l = [1.5, 0.5], np.array([0.7, 0.4])
    angle = [sum(q[k] for k in range(j + 1)) for j in range(2)]
    rate = []
    for j in range(2):
        rate.append(sum(v[: j + 1]))
    # rows of the absolute angles; what i and j both carry hangs on the larger of them, (i + j + 1)//2 of 0 and 1
    A, b = np.zeros((2, 2)), [0.0] * 2
    for i in range(len(m)):
        for j in range(len(m)):
            carried = sum(m[k] for k in range((i + j + 1) // 2, 2))
            A[i, j] += carried * l[i] * l[j] * np.cos(angle[i] - angle[j])
            b[i] -= carried * l[i] * l[j] * np.sin(angle[i] - angle[j]) * rate[j] ** 2
        for k in range(i, 2):
            b[i] -= m[k] * g * l[i] * np.sin(angle[i])
    det = A[0][0] * A[1][1] - A[0][1] * A[1][0]
    first = (A[1][1] * b[0] - A[0][1] * b[1]) / det
    second = (A[0][0] * b[1] - A[1][0] * b[0]) / det
    return [first, second - first]
'''
"""


def test_loops_in_a_function_are_followed():
    d, _, true = read(LOOPS + ARM)
    got = d.motion().accelerations(true.q, true.v)
    assert np.abs(got - true.accelerations).max() <= 1e-14 * np.abs(true.accelerations).max()  # as above


@pytest.mark.parametrize(
    ("there", "other", "says"),
    [
        ("for k in range(i, 2):", "while True:", "how often a while loop runs"),
        ("for k in range(i, 2):", "for k in range(10**9):", "bounds of this range are not known"),
        ("for k in range(i, 2):", "for k in range(q[0]):", "bounds of this range are not known"),
        ("for k in range(i, 2):", "for k in range(1999):\n          for n in range(1999):", "more than 2000 steps"),
        ("A[i, j] +=", "q[i] +=", "only those of lists that the function makes"),
        ("A[i, j] +=", "A[i, 5] =", "only those of lists"),
        ("for j in range(2)]", "for j in range(2) if j]", "a condition in a list"),
        ("det = A", "if det: det = A", "line 18: If: assignments, loops"),
    ],
)  # fmt: skip
def test_loops_that_cannot_be_followed_are_refused(there, other, says):
    assert there in LOOPS
    with pytest.raises(InvalidInput, match=says):
        read(LOOPS.replace(there, other, 1) + ARM)


def numbers(rows):
    """Rows whose terms are given as numbers in 3 states: (B, row, terms) of 2 accelerations and 3 parts."""
    return np.array(rows, dtype=float).transpose(2, 0, 1)


def test_a_row_belongs_to_a_joint_only_with_half_of_its_terms():
    # Joint 1's row has 4 terms: factor 2 is borne out by 2 of them, which is half, and by 1, which is less than half.
    term = np.array([1.0, -0.4, 2.5])
    right = [[term, 2 * term, 3 * term, 4 * term, 0 * term]]
    half = [[2 * term, 4 * term, term, -term, 0 * term]]
    fewer = [[2 * term, 5 * term, term, -term, 0 * term]]
    votes, found = _factor(numbers(half)[:, 0], numbers(right)[:, 0])
    assert (votes, found) == (2, 0.5)
    assert _factor(numbers(fewer)[:, 0], numbers(right)[:, 0]) == (0, 0.0)


@pytest.mark.parametrize(
    ("terms", "paired"),
    [
        ("m*l*theta'^2*sin(theta)", True),  # one of three terms of row 1 is wrong: two bear the factor out
        ("2*m*l*theta''*cos(theta) - 2*m*l*theta'^2*sin(theta)", False),  # 1, 3 and 2 times the right ones
    ],
)
def test_wrong_rows_are_told_apart_by_the_terms_that_agree(terms, paired):
    text = UPRIGHT.replace("- m*l*theta'^2*sin(theta) = 0", f"+ {terms} = 0", 1)
    d, _, true = read(cart_pole("", text))
    assert (alignment(d.motion(), true) is not None) == paired


@pytest.mark.parametrize("ref", [0.0, 0.3, -1.2])
def test_a_joints_ref_is_where_its_coordinate_starts(ref):
    # MuJoCo: q is ref in the configuration that the file draws. The arm drawn straight down has absolute angle
    # 2 = angle 1 - (q2 - ref), the elbow turning the other way round (axis +y).
    text = 'angles = "absolute"\n' + ARM.replace("ref = 0.3", f"ref = {ref}") + ABSOLUTE
    d, _, true = read(text)
    got = d.motion().accelerations(true.q, true.v)
    assert np.abs(got - true.accelerations).max() <= 1e-14 * np.abs(true.accelerations).max()  # as above
    q1, q2 = true.q[:, 0], true.q[:, 1]
    angles = np.array([[float(x) for x in d.coordinates.positions([arb(x) for x in state])] for state in true.q])
    assert np.abs(angles - np.stack([q1, q1 - (q2 - ref)], axis=1)).max() <= 4e-15  # some roundings of numbers below 10


def test_a_ref_is_in_the_graded_mechanism_too():
    # of a wrong row the grader says the term in the author's letters, whatever the elbow's ref
    wrong = ABSOLUTE.replace(r"+ g\sin", r"- g\sin")
    assert wrong != ABSOLUTE
    for ref in ("0.3", "0.0", "-1.2"):
        d, system, true = read('angles = "absolute"\n' + ARM.replace("ref = 0.3", f"ref = {ref}") + wrong)
        assert [r.says for r in reasons(d, system, true)] == ["Row 2, the term with sin(theta2): the sign is wrong."]
