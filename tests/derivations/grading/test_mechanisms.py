"""Mechanisms that a file declares: textbooks' equations, and the documents' own as printed."""

import re
from pathlib import Path
from unicodedata import normalize

import pytest
from handwritten import SHIKI_2_10, TAKENO_19

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput


def body(**fields):
    return "[[bodies]]\n" + "\n".join(f"{name} = '{value}'" for name, value in fields.items())


def mechanism(bodies, rows, **fields):
    lines = ["system = 'mechanism'", *(f"{name} = '{value}'" for name, value in fields.items()), *bodies, "[equations]"]
    return "\n".join([*lines, *(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1))])


def preset(name, rows):
    return "\n".join([f"system = '{name}'", "[equations]", *(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1))])


def is_plain(answer):
    return answer.verdict == "correct" and answer.assumes == ()


# Angle from the downward vertical, counter-clockwise; the cart to the right
CART_POLE = [
    r"(M+m) \ddot{x} + m l \ddot\theta \cos\theta - m l \dot\theta^2 \sin\theta = 0",
    "ml^2 θ̈ + ml ẍ cos θ + mgl sin θ = 0",
]
# Kinetic energy of the bob: ½ m (ṙ² + r² θ̇²); spring of natural length l0
ELASTIC = ["r θ'' + 2 r' θ' + g sin θ = 0", "m r'' - m r θ'^2 + k (r - l0) - m g cos θ = 0"]
# Two links with the inertia about the joints, driven and damped (the acrobot's textbook form)
TWO_LINKS = [
    body(coordinate="q1", mass="m1", length="l1", centre="lc1", inertia="I1", about="pivot", drive="u1", damping="b1"),
    body(coordinate="q2", mass="m2", length="l2", centre="lc2", inertia="I2", about="pivot", drive="u2", damping="b2"),
]
ACROBOT = [
    "(I1 + I2 + m2*l1^2 + 2*m2*l1*lc2*cos(q2))*q1'' + (I2 + m2*l1*lc2*cos(q2))*q2'' - 2*m2*l1*lc2*sin(q2)*q1'*q2'"
    " - m2*l1*lc2*sin(q2)*q2'^2 + m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1+q2)) = u1 - b1*q1'",
    r"(I_2 + m_2 l_1 l_{c2} \cos q_2) \ddot{q}_1 + I_2 \ddot q_2 + m_2 l_1 l_{c2} \sin(q_2) \dot q_1^2"
    r" + m_2 g l_{c2} \sin(q_1+q_2) = u2 - b2 \dot{q}_2",
]
# A mass that slides on a fixed vertical spring, and the same hung on a cart that is driven
SPRING = [body(coordinate="y", joint="slide", along="down", mass="m", spring="k", rest="y0", damping="c")]
RIGHT = {
    "cart and pole": preset("cart-pole", CART_POLE),
    "cart and pole, solved": preset("cart-pole", [
        "x'' = (m l θ'^2 sin θ + m g sin θ cos θ)/(M + m sin^2 θ)",
        "θ'' = (-m l θ'^2 sin θ cos θ - (M+m) g sin θ)/(l (M + m sin^2 θ))"]),
    "cart and rod, half its length l": preset("cart-rod", [
        "(M+m) x'' + m l θ'' cos θ - m l θ'^2 sin θ = 0", "(I + m l^2) θ'' + m l x'' cos θ + m g l sin θ = 0"]),
    "cart and two bobs": preset("cart-double-pole", [
        "(M+m1+m2) x'' + (m1+m2) l1 (θ1'' cos θ1 - θ1'^2 sin θ1) + m2 l2 (θ2'' cos θ2 - θ2'^2 sin θ2) = 0",
        "(m1+m2) l1 θ1'' + m2 l2 θ2'' cos(θ1-θ2) + m2 l2 θ2'^2 sin(θ1-θ2) + (m1+m2) (x'' cos θ1 + g sin θ1) = 0",
        "l2 θ2'' + l1 θ1'' cos(θ1-θ2) - l1 θ1'^2 sin(θ1-θ2) + x'' cos θ2 + g sin θ2 = 0"]),
    "elastic pendulum": preset("elastic-pendulum", ELASTIC),
    "elastic pendulum, its Lagrangian":
        "system = 'elastic-pendulum'\nlagrangian = \"m/2*(r'^2 + r^2 θ'^2) + m g r cos θ - k/2 (r-l0)^2\"",
    "acrobot": mechanism(TWO_LINKS, ACROBOT, angles="relative"),
    "a spring": mechanism(SPRING, ["m y'' + c y' + k (y - y0) = m g"]),
    "three legs, as Shiki prints (2.10)": mechanism([
        body(name="one", coordinate="theta1", mass="m1", length="l1"),
        body(on="one", coordinate="theta2", mass="m2", length="l2"),
        body(on="one", coordinate="theta3", mass="m3", length="l3")], SHIKI_2_10),
    "two equal rods, as Takeno prints (19)": mechanism([
        body(coordinate="theta1", mass="m", length="l", centre="l/2", inertia="m l^2/12"),
        body(coordinate="theta2", mass="m", length="l", centre="l/2", inertia="m l^2/12")], TAKENO_19),
    "springs and dampers between absolute angles": mechanism([
        body(coordinate="theta1", mass="m", length="l", spring="k", damping="b"),
        body(coordinate="theta2", mass="m", length="l", spring="k", damping="b")], [
        "2 m l^2 θ1'' + m l^2 θ2'' cos(θ1-θ2) + m l^2 θ2'^2 sin(θ1-θ2) + 2 m g l sin θ1"
        " = -k θ1 + k (θ2 - θ1) - b θ1' + b (θ2' - θ1')",
        "m l^2 θ2'' + m l^2 θ1'' cos(θ1-θ2) - m l^2 θ1'^2 sin(θ1-θ2) + m g l sin θ2 = -k (θ2-θ1) - b (θ2'-θ1')"]),
    "a bob half-way down a rod": mechanism([
        body(name="rod", coordinate="theta", mass="M", length="l", centre="l/2", inertia="M l^2/12"),
        body(on="rod", at="l/2", coordinate="phi", mass="m", length="a")], [
        "(M/3 + m/4) l^2 θ'' + m a l/2 (φ'' cos(θ-φ) + φ'^2 sin(θ-φ)) + (M+m) g l/2 sin θ = 0",
        "a φ'' + l/2 (θ'' cos(θ-φ) - θ'^2 sin(θ-φ)) + g sin φ = 0"]),
}  # fmt: skip


@pytest.mark.parametrize("text", RIGHT.values(), ids=RIGHT.keys())
def test_textbooks_equations_are_correct(text):
    answer = grade_text(text)
    assert is_plain(answer), answer.text()


WRONG = [
    ("2 r' θ' halved", preset("elastic-pendulum", [ELASTIC[0].replace("2 r'", "r'"), ELASTIC[1]]),
     {("theta'*r'", "2*theta'*r'")}),
    ("centrifugal sign", preset("elastic-pendulum", [ELASTIC[0], ELASTIC[1].replace("- m r", "+ m r")]),
     {("m*r*theta'^2", "-m*r*theta'^2")}),
    ("the pole's mass forgotten", preset("cart-pole", [CART_POLE[0].replace("(M+m)", "M"), CART_POLE[1]]),
     {("M*x''", "(M + m)*x''")}),
    ("damping's sign", mechanism(SPRING, ["m y'' - c y' + k (y - y0) = m g"]), {("-c*y'", "c*y'")}),
    ("the drive of joint 2 with its sign wrong",
     mechanism(TWO_LINKS, [ACROBOT[0], ACROBOT[1].replace("u2", "-u2")], angles="relative"), None),
    ("virtual work: the drive of joint 2 in row 1 as well, in relative angles",
     mechanism(TWO_LINKS, [ACROBOT[0].replace("u1", "u1 - u2"), ACROBOT[1]], angles="relative"), None),
]  # fmt: skip


@pytest.mark.parametrize(("what", "text", "pairs"), WRONG, ids=[case[0] for case in WRONG])
def test_wrong_terms_are_told_in_the_authors_symbols(what, text, pairs):
    answer = grade_text(text)
    assert answer.verdict == "wrong"
    assert answer.findings
    if pairs is not None:
        assert {(f.found, f.expected) for f in answer.findings} == pairs, what


def test_the_angle_may_be_counted_from_above_there_too():
    rows = CART_POLE
    upwards = [rows[0].replace("+ m l \\ddot", "- m l \\ddot").replace("- m l \\dot\\", "+ m l \\dot\\"),
               rows[1].replace("+ ml ẍ", "- ml ẍ").replace("+ mgl", "- mgl")]  # fmt: skip
    answer = grade_text(preset("cart-pole", upwards))
    assert answer.verdict == "correct"
    assert "upward" in answer.assumes[0]


def test_it_is_said_back_in_the_authors_words():
    answer = grade_text(RIGHT["elastic pendulum"])
    assert "bob sliding along spring" in answer.reading.mechanism
    said = normalize("NFC", answer.reading.equations[0][1])
    assert said == normalize("NFC", "r θ̈ + 2 ṙ θ̇ + g sin θ = 0")


@pytest.mark.parametrize(
    ("bodies", "why"),
    [
        ([], "bodies: from 1"),
        ([body(coordinate="theta", mass="m")] * 9, "bodies: from 1"),
        ([body(mass="m")], "coordinate"),
        ([body(coordinate="theta", mas="m")], "did you mean 'mass'"),
        ([body(coordinate="theta", mass="1/(m+M)")], "denominator"),
        ([body(coordinate="theta", mass="m("), ], "bodies 1: mass"),
        ([body(coordinate="theta", on="nobody")], "no body before it"),
        ([body(coordinate="theta", joint="ball")], "'hinge' or 'slide'"),
        ([body(coordinate="theta", mass="theta")], "a name of its own"),
        ([body(coordinate="theta", mass="m"), body(coordinate="theta1", mass="m")], "with a number and without"),
        ([body(coordinate="__import__", mass="m")], "not known"),
    ],
)  # fmt: skip
def test_declarations_that_are_none_are_refused(bodies, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(mechanism(bodies, ["theta'' = 0"]))


@pytest.mark.parametrize(
    ("row", "why"),
    [("z'' = 0", "not known"), ("M x'' = F", "not known"), ("ω x = 0", "not known"), ("cos(M) = 0", "no angle")],
)
def test_symbols_that_are_not_declared_are_refused(row, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(preset("cart-pole", [row]))


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("simple-pendulum", ["l θ'' + g sin θ = 0"]),
        ("physical-pendulum", ["(I + m l_c^2) θ'' + m g l_c sin θ = 0"]),
        ("double-rod-pendulum", [
            "(m1/3+m2) l1 a1 + m2 l2/2 (a2 cos(t1-t2) + w2^2 sin(t1-t2)) + (m1/2+m2) g sin t1 = 0",
            "l2/3 a2 + l1/2 (a1 cos(t1-t2) - w1^2 sin(t1-t2)) + g/2 sin t2 = 0"]),
    ],
)  # fmt: skip
def test_usual_names_are_known(name, rows):
    assert is_plain(grade_text(preset(name, rows)))
    doubled = [row.replace("g", "g*2", 1) for row in rows]
    assert grade_text(preset(name, doubled)).verdict == "wrong"


def test_the_example_of_the_front_page_is_right():
    text = (Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r'```toml\n(system = "mechanism".*?)```', text, re.DOTALL)
    assert is_plain(grade_text(example))
