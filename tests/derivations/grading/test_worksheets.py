# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""Sessions of computer algebra and Modelica models, in words that no collection has: right, wrong, and in doubt refused."""

import re

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

TWO = "system = 'mechanism'\nfrom = 'down'\n" + "".join(
    f"[[bodies]]\ncoordinate = 'q{k}'\nmass = 'm{k}'\nlength = 'l{k}'\n" for k in (1, 2)
) + "[equations]\n1 = '''\n{}\n'''\n"  # fmt: skip
# Two bobs, each row by hand; W has the other sign at the squared rate
R1 = "(m1+m2)*l1*q1'' + m2*l2*(q2''*cos(q1-q2) + q2'^2*sin(q1-q2)) + (m1+m2)*g*sin(q1)"
R2 = "l2*q2'' + l1*(q1''*cos(q1-q2) - q1'^2*sin(q1-q2)) + g*sin(q2)"
W2 = "l2*q2'' + l1*(q1''*cos(q1-q2) + q1'^2*sin(q1-q2)) + g*sin(q2)"


def two(text):
    return grade_text(TWO.format(text)).verdict


def of_mathematica(row):
    row = re.sub(r"q([12])(''?)", r"q\1\2[t]", row)
    row = re.sub(r"q([12])(?!['\d])", r"q\1[t]", row)
    row = re.sub(r"(sin|cos)\(([^()]*)\)", lambda m: f"{m[1].title()}[{m[2]}]", row)
    return row.replace("*", " ")


def of_maple(row):
    row = re.sub(r"(?<!\()q([12])(?!')|(?<=\()q([12])(?=[-)])", lambda m: f"q{m[1] or m[2]}(t)", row)
    row = re.sub(r"q([12])''", r"diff(q\1(t), t, t)", row)
    return re.sub(r"q([12])'", r"diff(q\1(t), t)", row)


def of_maxima(row):
    return of_maple(row).replace("diff(", "'diff(").replace("t, t)", "t, 2)")


def of_sympy(row):
    return of_maple(row).replace("t, t)", "(t, 2))").replace("diff(", "Derivative(").replace("^", "**")


def of_matlab(row):
    return of_maple(row).replace("t, t)", "t, 2)").replace("(t)", "")


def of_modelica(row):
    return re.sub(r"q([12])'", r"w\1", re.sub(r"q([12])''", r"der(w\1)", row))


MODEL = "model P\n  parameter Real m1=1, m2=1;\n  Real q1, q2, w1, w2;\n{}equation\n{}  der(q1)=w1;\n  der(q2)=w2;\n{}end P;"


def sessions(second):
    """A session of each, with the first row and this second one."""
    a, b = (of_mathematica(row) for row in (R1, second))
    yield f"eqns = {{{a} == 0, {b} == 0}};"
    yield f"{{{a} == 0,\n {b} == 0}}"
    yield f"eq1 = {a} == 0;\neq2 = {b} == 0;\nNDSolve[{{eq1, eq2, q1[0] == 1}}, {{q1, q2}}, {{t, 0, 5}}]"
    yield f"DSolve[{{{a} == 0, {b} == 0, q1[0] == 1, q2'[0] == 0}}, {{q1, q2}}, t]"
    a, b = (of_maple(row) for row in (R1, second))
    yield f"restart: with(plots):\nsys := {{{a} = 0, {b} = 0}};\ndsolve(sys, numeric);"
    yield f"e1 := {a} = 0;\ne2 := {b} = 0;"
    a, b = (of_maxima(row) for row in (R1, second))
    yield f"eq1: {a} = 0$\neq2: {b} = 0$"
    yield f"/* two bobs */ depends([q1,q2],t);\neq1: {a} = 0;\neq2: {b} = 0;"
    a, b = (of_sympy(row) for row in (R1, second))
    yield f"(Eq({a}, 0), Eq({b}, 0, evaluate=False))"
    yield f"Eq({a}, 0)\nEq({b}, 0)"
    yield f"import sympy as sp\nt = sp.symbols('t')\neq1 = sp.Eq({a}, 0)\neq2 = sp.Eq({b}, 0)\nprint(eq1)"
    a, b = (of_matlab(row) for row in (R1, second))
    yield f"syms q1(t) q2(t) m1 m2 l1 l2 g\nd = q1 - q2;\nc = cos(d);\neqs = [{a.replace('cos(q1-q2)', 'c')} == 0; {b} == 0];"
    yield f"syms q1(t) q2(t)\neqn1 = {a} == 0;\neqn2 = {b} == 0;\n[V, S] = odeToVectorField(eqn1, eqn2);"
    a, b = (of_modelica(row) for row in (R1, second))
    yield MODEL.format("", "", f'  {a} = 0 "row";\n  {b} = 0;\n')
    short = a.replace("cos(q1-q2)", "cos(d)")
    yield MODEL.format(
        "  Real d = q1 - q2;\n", "  // rows\n", f"  {short} = 0;\n  {b} = 0;\n  annotation(Icon(a=1));\n"
    )
    yield MODEL.format("  Real c;\n", "  c = cos(q1 - q2);\n", f"  {a.replace('cos(q1-q2)', 'c')} = 0;\n  {b} = 0;\n")


@pytest.mark.parametrize("text", list(sessions(R2)))
def test_a_right_session_is_right(text):
    assert two(text) == "correct"


@pytest.mark.parametrize("text", list(sessions(W2)))
def test_a_wrong_session_is_wrong(text):
    assert two(text) == "wrong"


A, B = of_mathematica(R1), of_mathematica(R2)
M, N = of_matlab(R1), of_matlab(R2)
REFUSED = [
    (f"eq1 = {A} == 0;\neq1 = {B} == 0;", "said twice"),
    (f"In[1]:= eq1 = {A} == 0\nIn[2]:= eq2 = {B} == 0\nOut[2]= {A} == 0", "with its answers"),
    (f"d[t_] := q1[t] - q2[t];\neq1 = {A} == 0;\neq2 = {B} == 0;", "neither an equation"),
    (f"[Eq({of_sympy(R1)}, 0), Ne({of_sympy(R2)}, 0)]", "neither an equation"),
    (f"syms q1(t) q2(t)\nd = q1 - q2;\nd = 2*d;\ne1 = {M} == 0;\ne2 = {N} == 0;", "said twice"),
    (f"syms q1(t) q2(t)\nm1 = 2*m2;\ne1 = {M} == 0;\ne2 = {N} == 0;", "said again by the session"),
    (
        MODEL.format("", "", f"  if time > 1 then {of_modelica(R1)} = 0; end if;\n  {of_modelica(R2)} = 0;\n"),
        "'if' in a Modelica",
    ),
]


@pytest.mark.parametrize(("text", "says"), REFUSED)
def test_what_may_change_the_meaning_is_refused(text, says):
    with pytest.raises(InvalidInput, match=says):
        two(text)


def test_what_a_letter_is_may_stand_behind_the_rows():
    rows = f"{R1.replace('cos(q1-q2)', 'c')} = 0\n{R2} = 0\nc = cos(d)\n"
    assert two(rows + "d = q1 - q2") == "correct"
    assert two(rows + "d = q1 + q2") == "wrong"
    with pytest.raises(InvalidInput):
        two(rows + "d = c")


def test_the_manipulators_equation_with_its_matrices_behind():
    """By hand, as R1 and R2 times l1, m2 l2."""
    latex = r"""\begin{gather*} M(q)\ddot q + h(q, \dot q) = 0, \\
M = \begin{bmatrix} (m1+m2) l1 & b \\ l1 \cos(q1-q2) & l2 \end{bmatrix}, \quad
h = \begin{bmatrix} m2 l2 \dot q2^2 s + (m1+m2) g \sin q1 \\ -l1 \dot q1^2 s + g \sin q2 \end{bmatrix}, \\
b = m2 l2 \cos(q1-q2), \qquad s = \sin(q1-q2). \end{gather*}"""
    text = TWO.format(latex)
    for k in "12":
        text = text.replace(f"q{k}", f"q_{k}").replace(f"\\dot q_{k}", f"\\dot q_{k}")
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("-l1 \\dot", "l1 \\dot")).verdict == "wrong"


def test_what_no_row_needs_is_passed_over_where_there_are_rows_enough():
    assert two(f"{R1} = 0\n{R2} = 0\nv = l1*q1'^2") == "correct"
    with pytest.raises(InvalidInput):  # it may be meant as the other row
        two(f"{R1} = 0\nv = l1*q1'^2")


@pytest.mark.parametrize(
    "text", ["{" * 4000 + "q1 == 0" + "}" * 4000, "NDSolve[]", "{} = {q1 == 0, }", "NDSolve[{}, q1]"]
)
def test_empty_and_deep_lists_are_refused(text):
    with pytest.raises(InvalidInput):
        grade_text(TWO.replace("{}", text))


def test_gravity_of_modelicas_own_constants():
    head = "  parameter Real g = Modelica.Constants.g_n;\n  constant Real k = 1e3;\n"
    rows = f"  {of_modelica(R1)} = 0;\n  {{}} = 0;\n"
    assert two(MODEL.format(head, "", rows.format(of_modelica(R2)))) == "correct"
    assert two(MODEL.format(head, "", rows.format(of_modelica(W2)))) == "wrong"
