# ruff: noqa: E501 -- formulas stand on one line, as on their pages
r"""Several equations in one text are cut into rows; what may be cut in two ways, or is an implication, is refused."""

import pytest

from furiko.derivations.dialects.blocks import equations_in
from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

CART = """system = 'mechanism'
from = 'down'
[[bodies]]
name = 'cart'
coordinate = 'x'
joint = 'slide'
mass = 'M'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[equations]
1 = '''{}'''
"""
# (M + m) ẍ + m l θ̈ cos θ − m l θ̇² sin θ = 0 and l θ̈ + ẍ cos θ + g sin θ = 0: by hand, θ from the downward vertical
A = r"(M+m)\ddot x + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta = 0"
B = r"l\ddot\theta + \ddot x\cos\theta + g\sin\theta = 0"
SAME = {
    "gather": rf"\begin{{gather}} {A}, \tag{{1}} \\ {B}. \tag{{2}} \end{{gather}}",
    "cases": rf"\begin{{cases}} {A} & \text{{(cart)}} \\ {B} & \text{{(bob, along the arc)}} \end{{cases}}",
    "a brace before an array": rf"\left\{{ \begin{{array}}{{l}} {A}, \\[1ex] {B}. \end{{array}} \right.",
    "quad": rf"{A}, \qquad {B}",
    "a row twice": rf"{A} \\ {B} \\ {A}",
    "and in LaTeX": rf"{A} \quad\text{{and}}\quad {B}.",
    "and": "(M+m) x'' + m l θ'' cos θ - m l θ'^2 sin θ = 0 and l θ'' + x'' cos θ + g sin θ = 0",
    "eqnarray, a row that goes on": r"""\begin{eqnarray*} (M+m)\ddot x + ml\ddot\theta\cos\theta && \\
        {} - ml\dot\theta^2\sin\theta &=& 0, \\ """ + B.replace("=", "&=&") + r". \end{eqnarray*}",
    "braces under terms": A.replace(r"(M+m)\ddot x", r"\underbrace{(M+m)\ddot x}_{\text{both bodies}}") + r" \\ " + B,
    "therefore": rf"{A} \\ \therefore\; {B}",
    "rules": "{{x''[t] -> m Sin[θ[t]] (l θ'[t]^2 + g Cos[θ[t]])/(M + m Sin[θ[t]]^2), "
             "θ''[t] -> -Sin[θ[t]] (m l θ'[t]^2 Cos[θ[t]] + (M + m) g)/(l (M + m Sin[θ[t]]^2))}}",
    "a list of Mathematica's": "{(M+m) x''[t] + m l θ''[t] Cos[θ[t]] - m l θ'[t]^2 Sin[θ[t]] == 0, "
                               "l θ''[t] + x''[t] Cos[θ[t]] + g Sin[θ[t]] == 0}",
    "bullets": "• (M+m) ẍ + m l (θ̈ cos θ − θ̇² sin θ) = 0\n• l θ̈ + ẍ cos θ + g sin θ = 0",
    "numbers behind": "(M+m) x'' + m l θ'' cos θ - m l θ'^2 sin θ = 0    (12)\nl θ'' + x'' cos θ = -g sin θ    (2)",
    "with two abbreviations": r"(M+m)\ddot x + mlc\ddot\theta - mls\dot\theta^2 = 0 \\ "
                              r"l\ddot\theta + \ddot x c + gs = 0, \quad \text{with } s = \sin\theta, \; c = \cos\theta",
    "Modelica": """model CartPole "pole on a cart"
  Real x, v, theta, w;
equation
  der(x) = v;
  der(theta) = w;
  (M+m)*der(v) + m*l*der(w)*cos(theta) - m*l*w^2*sin(theta) = 0;
  l*der(w) + der(v)*cos(theta) + g*sin(theta) = 0;
end CartPole;""",
    "remarks of the source": A.replace("- ml", "% centrifugal\n - ml") + "\\\\ % the pole\n" + B,
}  # fmt: skip


@pytest.mark.parametrize("how", SAME)
def test_both_rows_of_a_cart_and_a_bob(how):
    found = grade_text(CART.format(SAME[how]))
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize("how", SAME)
def test_and_with_another_gravity_they_are_wrong(how):
    text = SAME[how].replace(r"g\sin", r"2g\sin").replace("g sin", "2 g sin").replace("g*sin", "2*g*sin")
    text = text.replace("+ gs", "+ 2gs").replace("g Sin[θ[t]] == 0", "2 g Sin[θ[t]] == 0")
    text = text.replace("(M + m) g", "2 (M + m) g")
    assert text != SAME[how]
    assert grade_text(CART.format(text)).verdict == "wrong"


@pytest.mark.parametrize(
    "text",
    [
        rf"{A} \Rightarrow {B}",  # is the first a premise, or a result?
        r"\begin{pmatrix} M+m & ml\cos\theta \\ \cos\theta & l \end{pmatrix} \begin{pmatrix} \ddot x = 0 \\ 1 \end{pmatrix} = 0",
    ],
)
def test_what_is_not_plain_is_refused(text):
    with pytest.raises(InvalidInput):
        grade_text(CART.format(text))


def test_a_matrix_and_what_stands_behind_where_are_not_cut():
    matrix = r"\left[\begin{array}{cc} a & b \\ c & d \end{array}\right] x = y"
    assert equations_in(matrix) == [matrix]
    said = r"I\ddot\theta = -mgd\sin\theta, \quad\text{where } I = I_G + md^2"
    assert equations_in(said) == [said]
    assert equations_in("f(a, b) = c") == ["f(a, b) = c"]


def test_a_number_close_behind_a_row_may_be_a_factor():
    with pytest.raises(InvalidInput, match="number of the equation, or a factor"):
        equations_in("l θ'' = -g sin θ (2)")


@pytest.mark.parametrize("row", [r"a = g \cdot (0)", "a = b *  (2)", "a = (0)", "a = b -\t(1)"])
def test_a_number_behind_an_operator_is_an_operand(row):
    assert equations_in(row) == [row]


def test_a_number_behind_a_comma_is_the_equation_s():
    assert equations_in(r"a = b, \qquad (12)") == ["a = b, "]


def test_an_expression_on_several_lines_says_how_to_print_it():
    with pytest.raises(InvalidInput, match="str"):
        equations_in("  d\n───(θ(t))\n dt")


@pytest.mark.parametrize(
    "text",
    [
        r"M\ddot x = 2\underbrace{F + N}_{\text{pull}}",  # does the brace bind?
        r"M\ddot x = -\underbrace{F + N}_{\text{pull}}",
        r"\text{mass}\,\ddot x = F",
        r"M \mathrm{tanh}(x) = F",
        r"M \text{load} = F",
    ],
)
def test_a_brace_or_a_word_that_may_be_part_of_the_mathematics_stays(text):
    assert equations_in(text) == [text]


def test_numbers_in_front_are_numbers_where_they_count():
    assert equations_in("(1) x = y\n(2) z = w") == ["x = y", "z = w"]
    with pytest.raises(InvalidInput, match="number of the equation, or a factor"):
        equations_in("(2) x = y")
