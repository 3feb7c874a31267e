"""Names as authors write them, in declarations, definitions and rows; and what two readings make ambiguous."""

import pytest
from declared_mechanisms import body, mechanism

from furiko.derivations.dialects.names import plain_name, splits
from furiko.derivations.grading.grade import grade_text
from furiko.derivations.reading.submission import parse_submission
from furiko.models.errors import InvalidInput

SAME = [
    ["theta_1", r"\theta_1", "θ₁", r"\theta_{1}", "theta1", "$θ_1$", r"{\theta_1}"],
    ["m_c", "m_{c}", "mc"],
    [r"\tau", "τ", "tau"],
    ["l0", r"\ell_0", "ℓ₀", "l_{0}"],
    ["lc1", "l_c1", "l_{c1}", "l_{c,1}"],
    ["s_{1+2}"],
    ["Delta", "Δ", r"\Delta"],
]


def test_one_name_is_one_however_it_is_written():
    names = [{plain_name(written) for written in group} for group in SAME]
    assert all(len(group) == 1 for group in names)
    assert len(set.union(*names)) == len(SAME)


@pytest.mark.parametrize("text", ["", "1x", "m_", "cos(x)", "__import__", "m^2", "a b", "a" * 5000, "a_" * 5000 + "!"])
def test_no_name(text):
    assert plain_name(text) is None


def test_two_names_side_by_side():
    assert splits("ml", frozenset({"m", "l"}))
    assert not splits("ml", frozenset({"m", "ml"}))


PENDULUM = {"coordinate": "theta", "mass": "m", "length": "l"}


@pytest.mark.parametrize(
    ("declared", "row"),
    [
        ({"coordinate": r"\vartheta", "mass": "m_p", "length": r"\ell"}, r"\ell \ddot\vartheta + g\sin\vartheta = 0"),
        ({"coordinate": "vartheta", "mass": "m", "length": "L0"}, "L_0 ϑ'' = -g sin ϑ"),
        ({"coordinate": "th", "mass": "m", "length": "l_p"}, "lp*th'' + g*sin(th) = 0"),
        ({"coordinate": "q_p", "mass": "m", "length": "l_p"}, r"l_{p}\ddot{q}_p = -g\sin q_p"),
        ({"coordinate": "φ", "mass": "masspole", "length": "length"}, "masspole*length*φ'' = -masspole*g*sin(φ)"),
        ({"coordinate": "theta", "mass": "m", "length": "l", "inertia": "I_p"},
         r"(I_p + ml^2)\ddot\theta + mgl\sin\theta = 0"),
        ({"coordinate": "theta", "mass": "m", "length": "l", "drive": r"\tau"},
         "ml²θ'' + mgl sinθ = τ"),
        ({"coordinate": "theta", "mass": "m", "length": "L", "inertia": "mL^2/3"}, "4 L θ''/3 + g sin θ = 0"),
        ({"coordinate": "theta", "mass": "m", "length": "l", "drive": "q1"}, "m l² θ'' + m g l sin θ = q1"),
    ],
)  # fmt: skip
def test_authors_names_are_read(declared, row):
    answer = grade_text(mechanism([body(**declared)], [row]))
    assert (answer.verdict, answer.assumes) == ("correct", ())
    assert grade_text(mechanism([body(**declared)], [f"{row} + g"])).verdict == "wrong"


def test_both_thetas_are_two_angles():
    bodies = [body(coordinate="theta", mass="m", length="l"), body(coordinate="vartheta", mass="m", length="l")]
    row = r"2 l \ddot\theta + l\ddot\vartheta \cos(\theta-\vartheta) + l\dot\vartheta^2 \sin(\theta-\vartheta)"
    other = r"l \ddot\vartheta + l\ddot\theta \cos(\theta-\vartheta) - l\dot\theta^2 \sin(\theta-\vartheta)"
    rows = [rf"{row} + 2 g \sin\theta = 0", rf"{other} + g \sin\vartheta = 0"]
    assert grade_text(mechanism(bodies, rows)).verdict == "correct"
    assert grade_text(mechanism(bodies, [rows[0].replace("2 g", "g"), rows[1]])).verdict == "wrong"


def test_a_name_with_an_index_is_not_the_product_of_two():
    """``ml`` is m times l where both are declared, also beside an m_l."""
    bodies = [body(coordinate="theta", mass="m", length="l", drive="m_l")]
    assert grade_text(mechanism(bodies, ["ml^2 θ'' + mgl sin θ = m_l"])).verdict == "correct"
    assert grade_text(mechanism(bodies, ["ml^2 θ'' + mgl sin θ = ml"])).verdict == "wrong"


@pytest.mark.parametrize(
    ("row", "why"),
    [
        ("l θ'' + g sin θ + m2 = 0", "not known"),  # m is declared, m2 is not, and is not 2 m
        ("l θ'' + g sin θ_1 = 0", "no index"),
        ("l θ2'' + g sin θ = 0", "no index"),
        (r"l\ddot\theta_1 + g\sin\theta = 0", "no index"),
        ("l θ'' + g sin ψ = 0", "not known"),
    ],
)
def test_what_is_not_declared_is_refused(row, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(mechanism([body(**PENDULUM)], [row]))


def defined(name, value, row="a1 = 0", links=2):
    return f"system = 'point-masses'\nlinks = {links}\n[define]\n'{name}' = '''{value}'''\n[equations]\n1 = '''{row}'''"


@pytest.mark.parametrize("name", ["δ", "Δ", r"\Delta", "m_{12}", "s_{1+2}", "c_{12}", "d_{11}", "H", "w_{rel}", "KE"])
def test_abbreviations_of_any_name(name):
    one = parse_submission(defined(name, "m_1 + l_2", f"a1 = {name} g"))
    assert one.rows[0][1] == parse_submission(defined("Z", "m1", "a1 = (m1 + l2)*g")).rows[0][1]


@pytest.mark.parametrize("name", ["θ", "ω", r"\theta_1", "m_1", "m_{2}", "l", "cos", "1x", "a b", "m^2", "θ₂"])
def test_what_has_a_meaning_is_no_abbreviation(name):
    with pytest.raises(InvalidInput, match="define"):
        parse_submission(defined(name, "2"))


def test_a_declared_symbol_is_no_abbreviation():
    text = mechanism([body(coordinate="theta", mass="m_p", length="l")], ["θ'' = 0"])
    with pytest.raises(InvalidInput, match="already has a meaning"):
        parse_submission(text + "\n[define]\nmp = '2'\n")


@pytest.mark.parametrize("define", ["3", "'x'", "[1, 2]", "true"])
def test_definitions_that_are_no_table_are_refused(define):
    text = f"system = 'simple-pendulum'\ndefine = {define}\n[equations]\n1 = 'x = 1'\n"
    with pytest.raises(InvalidInput, match="define: a table of at most"):
        grade_text(text)
