"""Mechanisms that a file declares: textbooks' equations, and the documents' own as printed."""

from unicodedata import normalize

import pytest
from declared_mechanisms import ACROBOT, CART_POLE, ELASTIC, RIGHT, SPRING, TWO_LINKS, body, mechanism, preset

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput


def is_plain(answer):
    return answer.verdict == "correct" and answer.assumes == ()


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
        ([body(coordinate="theta", mass="1/(2*m+3*M)")], "denominator"),
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
