"""Hamiltonians and equations with momenta. One link and the cart and pole are derived by hand; H of two bobs is
Assencio's, whose proof in sympy is in the collection."""

import tomllib
from pathlib import Path

import pytest

from furiko.derivations.algebra.division import exact_quotient
from furiko.derivations.algebra.trig import Space, constant
from furiko.derivations.classroom.in_python import grade_text
from furiko.models.errors import InvalidInput

COLLECTION = Path(__file__).parents[1] / "collection"
ONE = 'system = "point-masses"\nlinks = 1\n'
ONE_H = ONE + 'hamiltonian = "p^2/(2 m l^2) - m g l cos(t1)"'
# T = (M+m)x'²/2 + m l x'θ' cos θ + m l²θ'²/2, so that p = M q' and q' = M⁻¹ p with det = m l² (M + m sin²θ)
CART = """system = "cart-pole"
[equations]
1 = "x' = (p_x - p_theta cos(theta)/l)/(M + m sin(theta)^2)"
2 = "theta' = ((M+m) p_theta/(m l) - p_x cos(theta))/(l (M + m sin(theta)^2))"
3 = "dp_x/dt = 0"
4 = "p_theta' = -m l x' theta' sin(theta) - m g l sin(theta)"
"""
MOMENTA = """system = "point-masses"
links = 2
[momenta]
p1 = "(m1+m2)*l1^2*w1 + m2*l1*l2*w2*cos(t1-t2)"
p2 = "m2*l2^2*w2 + m2*l1*l2*w1*cos(t1-t2)"
[equations]
1 = "p1' = -m2*l1*l2*w1*w2*sin(t1-t2) - (m1+m2)*g*l1*sin(t1)"
2 = "p2' = m2*l1*l2*w1*w2*sin(t1-t2) - m2*g*l2*sin(t2)"
"""


def printed(name):
    return tomllib.loads((COLLECTION / f"{name}.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    "text",
    [
        ONE_H,
        ONE + 'hamiltonian = "H = \\\\frac{p_\\\\theta^2}{2 m l^2} - m g l \\\\cos\\\\theta"',
        ONE + 'from = "up"\nhamiltonian = "p^2/(2 m l^2) + m g l cos(t1)"',
        ONE + '[equations]\n1 = "θ̇ = p_θ/(m l²)"\n2 = "ṗ_θ = −m g l sin θ"',
        ONE + "[equations]\n1 = '\\dot\\theta = p_\\theta/(m l^2)'\n2 = '\\dot{p}_{\\theta} = -m g l \\sin\\theta'",
        ONE + '[equations]\n1 = "theta_dot = omega"\n2 = "omega_dot = -g/l*sin(theta)"',
        ONE + '[equations]\n1 = "theta_dot = v"\n2 = "v_dot = -g/l*sin(theta)"',
        CART,
        MOMENTA,
    ],
)
def test_right_ones_are_right(text):
    found = grade_text(text)
    assert (found.verdict, found.assumes, found.notes) == ("correct", (), ())


@pytest.mark.parametrize(
    ("text", "row", "says"),
    [
        (ONE_H.replace("2 m l^2", "m l^2"), "", "numerator, the term with p1²: it has an extra factor 2"),
        (CART.replace("+m) p_theta/", "-m) p_theta/"), "2", "the part −2/l has the wrong sign"),
        (CART.replace("- p_x cos", "+ p_x cos"), "2", "the sign is wrong"),
        (CART.replace("= 0", "= m g"), "3", "no such term is expected"),
        (CART.replace("-m l x' theta'", "m l x' theta'"), "4", "the sign is wrong"),
        (MOMENTA.replace("l1^2*w1", "l1*w1"), "p1", "it lacks the factor l₁"),
        (MOMENTA.replace("= m2*l1*l2*w1*w2", "= -m2*l1*l2*w1*w2"), "2", "the sign is wrong"),
    ],
)  # fmt: skip
def test_one_slip_is_the_only_term_accused(text, row, says):
    found = grade_text(text)
    assert found.verdict == "wrong"
    (finding,) = found.findings
    assert finding.row == row
    assert says in finding.says


def test_the_published_misprint_is_named_alone():
    found = grade_text(printed("dr-zingale-hamilton"))
    (finding,) = found.findings
    assert (finding.row, finding.term) == ("2", "p2")
    assert "it lacks its factor 4" in finding.says  # 2 for 8


def test_a_denominator_and_a_height_are_told_apart():
    text = printed("dp-assencio-hamiltonian")
    assert grade_text(text).verdict == "correct"
    slips = {("m_1 + m_2 \\sin^2", "m_1 - m_2 \\sin^2"): "denominator", ("- m_2 g l_2", "+ m_2 g l_2"): "cos(θ₂)"}
    for (right, slip), where in slips.items():
        found = grade_text({**text, "hamiltonian": text["hamiltonian"].replace(right, slip)})
        assert found.verdict == "wrong"
        assert found.findings
        assert all(where in finding.says for finding in found.findings)


def test_momenta_of_another_scale_are_said():
    found = grade_text(ONE + 'hamiltonian = "p^2/(m l^2) - m g l cos(t1)/2"')  # of (T - U)/2
    assert (found.verdict, found.notes) == (
        "correct",
        ("The momenta are 1/2 times those of T − U; the motion is the same.",),
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (ONE + 'hamiltonian = "m l^2 w1^2/2 - m g l cos(t1)"', "it has rates"),
        (ONE + 'hamiltonian = "p - m g l cos(t1)"', "do not say what each momentum is"),
        (ONE + '[equations]\n1 = "dp/dt = -m g l sin(t1)"', "where 1 and 1 are needed"),
        (MOMENTA.replace('p2 = "m2', '# "'), "1 for the rates or momenta and 2 for the derivatives"),
        (ONE_H + '\n[momenta]\np = "m l^2 w1"', "leave them out"),
        ('system = "mechanism"\n[[bodies]]\ncoordinate = "x"\njoint = "slide"\nmass = "p"\n'
         '[momenta]\np = "p x\'"\n[equations]\n1 = "dp/dt = 0"', "give the quantity another letter"),
    ],
)  # fmt: skip
def test_what_cannot_be_taken_as_meant_is_refused(text, says):
    with pytest.raises(InvalidInput, match=says):
        grade_text(text)


def test_a_lagrangian_has_no_forces():
    body = '[[bodies]]\ncoordinate = "x"\njoint = "slide"\nmass = "M"\ndrive = "F"\ndamping = "b"\n'
    for energy, verdict in (("M x'^2/2", "correct"), ("M x'^2", "correct"), ("M x'^2/2 - M g x", "wrong")):
        assert grade_text(f'system = "mechanism"\nlagrangian = "{energy}"\n{body}').verdict == verdict


def test_division_of_formulas():
    space = Space.general(2)
    f = space.m(0) + space.m(1) * space.cos({0: 1, 1: -1})
    for g in (
        space.sin({0: 3}) + space.l(0).inverse_monomial(),
        space.cos({0: 1, 1: 2}) * space.sin({1: 1}),
        constant(3),
    ):
        assert exact_quotient(space, f * g, f) == g
    assert exact_quotient(space, f + constant(1), f) is None
    assert exact_quotient(space, f, space.sin({0: 1})) is None  # not one with sines, though it may be a formula
