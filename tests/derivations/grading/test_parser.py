"""The reader of derivations: every spelling, and every refusal with its place."""

import tomllib

import pytest
from handwritten import toml

from furiko.derivations.reading.declaration import MOST_LINKS
from furiko.derivations.reading.submission import parse_submission
from furiko.models.errors import InvalidInput


def row(line, system="n-leg", links=2, **fields):
    return parse_submission(toml(system, [line], links=links, **fields)).rows[0][1]


SPELLINGS = [
    ("m2*l1*a1*cos(t1-t2)", "m₂ l₁ θ̈₁ cos(θ₁−θ₂)"),
    ("m2*l1*a1*cos(t1-t2)", r"m_2 l_1 \ddot{\theta}_1 \cos\left(\theta_1 - \theta_2\right)"),
    ("m2*l1*a1*cos(t1-t2)", r"m_{2}l_{1}\ddot\theta_{1}\,\cos(\theta_{1}-\theta_{2})"),
    ("m2*l1*a1*cos(t1-t2)", r"m_2\cdot l_1\times\ddot{\theta_1}\cos[\theta_1-\theta_2]"),
    ("m2*l1*a1*cos(t1-t2)", "m2l1α1cos(θ1-θ2)"),
    ("m2*l1*a1*cos(t1-t2)", "m2 l1 theta1'' cos(theta1 - theta2)"),
    ("m2*l1*a1*cos(t1-t2)", "m2 l1 omega_1' cos(-t2 + t1)"),
    ("m2*l1*a1*cos(t1-t2)", "ｍ２＊ｌ１＊ａ１＊ｃｏｓ（ｔ１－ｔ２）"),
    ("w1^2*sin(t1)", r"\dot{\theta}_1^2 \sin\theta_1"),
    ("w1^2*sin(t1)", r"(\dot{\theta}_1)^{2}\sin \theta_1"),
    ("w1^2*sin(t1)", "θ̇₁² sin θ₁"),
    ("w1^2*sin(t1)", "w1**2*sin t1"),
    ("w1^2*sin(t1)", "ω1·ω1·sin(θ1)"),
    ("m1*g/2", r"\frac{1}{2} m_1 g"),
    ("m1*g/2", r"\frac12 m_1g"),
    ("m1*g/2", "½ m₁ g"),
    ("m1*g/2", "0.5m1g"),
    ("m1*g/2", "m1g/2"),
    ("m1*g/2", "5e-1*m1*g"),
    ("cos(t1)^2", r"\cos^2\theta_1"),
    ("cos(t1)^2", "cos²(t1)"),
    ("cos(2*t1)", "cos 2t1"),
    ("sin(t1)", "cos(t1 - pi/2)"),
    ("-sin(t1)", "cos(t1 + π/2)"),
    ("sin(t1)", "2*sin(t1/2)*cos(t1/2)"),
    ("(m1+m2)*l1", "{m1+m2}[l1]"),
    ("m1^-1", "1/m1"),
    ("m1*l1", "--m1*l1"),
    ("-m1*l1^2", "-m1*(-l1)^2"),
]


@pytest.mark.parametrize(("one", "other"), SPELLINGS)
def test_spellings_mean_the_same(one, other):
    assert row(f"a1 = {one}") == row(f"a1 = {other}")


def test_division_takes_one_factor_as_in_python():
    assert row("a1 = 1/2*m1") == row("a1 = m1/2")
    assert row("a1 = m1/l1*l2") == row("a1 = m1*l2/l1")


def test_a_tangent_is_sine_over_cosine():
    over = row("a1 = tan(t1)")
    assert over == row("a1*cos(t1) = sin(t1)")


def test_sides_may_be_swapped_and_terms_moved():
    assert row("a1 + g*sin(t1) = 0") == -row("0 = a1 + g*sin(t1)")
    assert row("a1 = -g*sin(t1)") == row("a1 + g*sin(t1) = 0")


def test_the_authors_own_symbols_stay_apart():
    """A rod's mass is not silently its density times its length, nor its moment of inertia m l²/12."""
    assert row("a1 = m1", "rod-chain") != row("a1 = rho*l1", "rod-chain")
    assert row("a1 = I2", "rod-chain") != row("a1 = m2*l2^2/12", "rod-chain")
    assert row("a1 = l_{c1}", "rod-chain") == row("a1 = lc1", "rod-chain") != row("a1 = l1", "rod-chain")


def test_definitions_are_put_in():
    text = toml("n-leg", ["M*l1*a1 = -M*g*sin(t1)"], links=2) + "\n[define]\nM = 'm1 + m2'\n"
    assert parse_submission(text).rows[0][1] == row("(m1+m2)*l1*a1 = -(m1+m2)*g*sin(t1)")
    angles = toml("n-leg", ["a1 = cos(d)"], links=2) + "\n[define]\nd = 't1 - t2'\n"
    assert parse_submission(angles).rows[0][1] == row("a1 = cos(t1-t2)")


REFUSALS = [
    ("m1*a1", "column 6", "equals sign"),
    ("m1*a1 = l1 = 0", "column 12", "second equals sign"),
    ("m1*a1 == 0", "column 8", "expected"),
    ("a1 = (l1 + l2", "column 14", "missing"),
    ("a1 = l1)", "column 8", "never opened"),
    ("a1 = (l1]", "column 9", "missing"),
    ("a1 = ", "column 5", "line ends"),
    ("a1 = * l1", "column 6", "expected"),
    ("a1 = l1 l2 +", "column 13", "line ends"),
    ("a1 = l3", "column 6", "links = 2"),
    ("a1 = l0", "column 6", "counted from 1"),
    ("a1 = a", "column 6", "no index"),
    ("a1 = velocity", "column 6", "not known"),
    ("a1 = sinn(t1)", "column 9", "not known"),
    (r"a1 = \summ l1", "column 6", "not known"),
    ("a1 = t1", "column 6", "outside cos and sin"),
    ("a1 = cos(w1)", "column 10", "a sum or difference of angles is expected"),
    ("a1 = cos(t1*t2)", "column 10", "multiplied by a number"),
    ("a1 = cos(t1/3)", "column 10", "halves"),
    ("a1 = cos(100*t1)", "column 10", "up to 16"),
    ("a1 = cos()", "column 10", "between the brackets"),
    ("a1 = l1/0", "column 9", "division by zero"),
    ("a1 = l1/(m1-m1)", "column 10", "division by zero"),
    ("a1 = 0^-1", "column 7", "zero"),
    ("a1 = 9^9^9^9", "column 9", "power of a power"),
    ("a1 = 9^99999999999", "column 8", "power beyond"),
    ("a1 = l1^l2", "column 9", "whole number"),
    ("a1 = l1^1.5", "column 9", "not a whole number"),
    ("a1 = 2 3", "column 8", "side by side"),
    ("a1 = " + "9" * 100, "column 6", "too long"),
    ("a1 = 1e99", "column 6", "too long"),
    ("a1 = " + "(" * 100 + "l1" + ")" * 100, "column", "brackets within"),
    ("a1 = (((m1+m2)^12)^12)^12", "column", "multiplied out"),
    ("a1 = " + "*".join(["(m1+m2+l1+l2+g+w1+w2)"] * 30), "column", "too many terms"),
    ("a1 = rho*l1", "column 6", "line density"),
    ("a1 = I1", "column 6", "none"),
    ("a1 = __import__('os')", "column 6", "not known"),
    (r"a1 = \dddot{\theta}_1", "column 6", "not known"),
    (r"a1 = \ddot{\omega}_1", "column 6", "third time derivative"),
    ("a1 = l1'", "column 6", "time derivative"),
    ("a1 = l1 \u0660", "column 9", "not known"),
]


@pytest.mark.parametrize(("line", "where", "why"), REFUSALS, ids=[line[:30] for line, _, _ in REFUSALS])
def test_refusals_are_one_line_with_the_place(line, where, why):
    with pytest.raises(InvalidInput) as refused:
        parse_submission("system = 'n-leg'\nlinks = 2\n[equations]\n1 = '''" + line.replace("'''", "") + "\n'''")
    message = str(refused.value)
    assert message.startswith("equations.1: ")
    assert where in message
    assert why in message
    assert "\n" not in message


FILES = [
    ("", "system"),
    ("system = 'nleg'\nlinks = 2", "did you mean 'n-leg'"),
    ("system = 'n-leg'\nlinks = 0", "from 1 to"),
    (f"system = 'n-leg'\nlinks = {MOST_LINKS + 1}", "from 1 to"),
    ("system = 'n-leg'\nlinks = true", "from 1 to"),
    ("system = 'n-leg'\nlinks = 2\nfrom = 'side'\n[equations]\n1 = 'a1=0'", "from: 'side'"),
    ("system = 'n-leg'\nlinks = 2\nsense = ['clockwise']\n[equations]\n1 = 'a1=0'", "sense"),
    ("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 'l*a1 = l1'", "both l and l1"),
    ("system = 'n-leg'\nlinks = 2", "either"),
    ("system = 'n-leg'\nlinks = 2\nlagrangian = 'm1'\n[equations]\n1 = 'a1 = 0'", "either"),
    ("system = 'n-leg'\nlinks = 2\nequation = 'a1 = 0'", "did you mean 'equations'"),
    ("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 'a1=0'\n2 = 'a1=0'\n3 = 'a1=0'", "3 rows for 2 angles"),
    ("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 5", "text in quotes"),
    ("system = 'n-leg'\nlinks = 2\nangles = 'up'\n[equations]\n1 = 'a1=0'", "absolute"),
    ("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 'a1=0'\n[define]\ncos = 'l1'", "define.cos"),
    ("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 'a1=0'\n[define]\nm1 = 'l1'", "already has a meaning"),
    ("system = 'n-leg'\nlinks = 2\nlagrangian = '1/(m1+m2)'", "denominator"),
    ("system = ", "not TOML"),
    ("a = " + "[" * 10000, "not TOML"),
    ("x" * 300_000, "longer than"),
]


@pytest.mark.parametrize(("text", "why"), FILES, ids=range(len(FILES)))
def test_bad_files_are_refused(text, why):
    with pytest.raises(InvalidInput, match=why):
        parse_submission(text)


def test_the_example_of_the_format_is_toml():
    assert tomllib.loads(toml("n-leg", ["a1 = 0"]))["links"] == 1
