"""Cramer's rule with determinants, as printed and as programs have them: right is right, and a slip is wrong.

The rows are the double pendulum's, m l1 θ1'' + m2 l2 θ2'' cos Δ = b1 and l1 θ1'' cos Δ + l2 θ2'' = b2, which textbooks
have; their solution by Cramer's rule is right whatever wrote it.
"""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

HEAD = 'system = "n-leg"\nlinks = 2\n'
A, B = r"(m_1+m_2) l_1", r"m_2 l_2 \cos\Delta"
C, D = r"l_1 \cos\Delta", "l_2"
B1 = r"-m_2 l_2 \dot\theta_2^2 \sin\Delta - (m_1+m_2) g \sin\theta_1"
B2 = r"l_1\dot\theta_1^2 \sin\Delta - g\sin\theta_2"
SPELLINGS = {
    "vmatrix": (r"\begin{vmatrix} ", r" \end{vmatrix}"),
    "bars": (r"\left|\begin{matrix} ", r" \end{matrix}\right|"),
    "det": (r"\det\begin{pmatrix} ", r" \end{pmatrix}"),
    "det in brackets": (r"\det\left(\begin{bmatrix} ", r" \end{bmatrix}\right)"),
}


def cramer(spelling, second=B2):
    begun, ended = SPELLINGS[spelling]

    def of(a, b, c, d):
        return f"{begun}{a} & {b} \\\\ {c} & {d}{ended}"

    return [
        r"\ddot\theta_1 = \frac{D_1}{D}, \quad \ddot\theta_2 = \frac{D_2}{D}",
        f"D = {of(A, B, C, D)}",
        f"D_1 = {of(B1, B, second, D)}",
        f"D_2 = {of(A, B1, C, second)}",
        r"\Delta = \theta_1 - \theta_2",
    ]


def one_text(lines):
    return HEAD + "equations = '''\n" + "\n".join(lines) + "\n'''\n"


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_cramers_rule_is_right_in_every_spelling(spelling):
    assert grade_text(one_text(cramer(spelling))).verdict == "correct"


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_a_slip_in_a_determinant_is_wrong(spelling):
    slip = cramer(spelling, second=B2.replace("- g", "+ g"))
    assert grade_text(one_text(slip)).verdict == "wrong"


def test_columns_changed_for_one_another_are_another_sign():
    lines = cramer("vmatrix")
    lines[1] = f"D = \\begin{{vmatrix}} {B} & {A} \\\\ {D} & {C} \\end{{vmatrix}}"
    assert grade_text(one_text(lines)).verdict == "wrong"


PROGRAM = (
    HEAD
    + """equations = ["a1 = D1/D", "a2 = D2/D"]
[define]
D1 = "det([[-A - (m1+m2)*g*sin(t1), m2*l2*C], [B - g*sin(t2), l2]])"
D2 = "det([(m1+m2)*l1, -A - (m1+m2)*g*sin(t1); l1*C, B - g*sin(t2)])"
D = "det([(m1+m2)*l1, m2*l2*C; l1*C, l2])"
A = "m2*l2*w2**2*sin(t1-t2)"
B = "l1*w1**2*sin(t1-t2)"
C = "cos(t1-t2)"
"""
)


def test_definitions_stand_in_any_order():
    assert grade_text(PROGRAM).verdict == "correct"


@pytest.mark.parametrize(
    ("determinant", "why"),
    [
        ("det(m1)", "the determinant of a number"),
        ("det([l1, l2])", "the determinant of a 2×1 matrix"),
        ("det l1", "det needs a matrix"),
    ],
)
def test_what_has_no_determinant_is_refused(determinant, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(HEAD + f'[equations]\n1 = "a1 = {determinant}"\n2 = "a2 = 0"\n')


def test_a_backslash_behind_a_sum_is_no_division():
    """MATLAB divides by a matrix so; behind a sum it ends a line, and a verdict would be of another equation."""
    other = "l1*a1*cos(t1-t2) + l2*a2 = l1*w1^2*sin(t1-t2) - g*sin(t2)"
    row = r"(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) \ + m2*l2*w2^2*sin(t1-t2) = -(m1+m2)*g*sin(t1)".replace(" \\ ", "\\")
    with pytest.raises(InvalidInput, match="a backslash behind what is no matrix"):
        grade_text(HEAD + f"[equations]\n1 = '{row}'\n2 = '{other}'\n")


ROWS = [
    r"(m_1 + m_2) l_1 dot.double(theta)_1 + m_2 l_2 dot.double(theta)_2 cos(theta_1 - theta_2) \
  + m_2 l_2 dot(theta)_2^2 sin(theta_1 - theta_2) + (m_1 + m_2) g sin(theta_1) = 0",
    r"l_2 dot.double(theta)_2 + l_1 dot.double(theta)_1 cos(theta_1 - theta_2) \
  - l_1 dot(theta)_1^2 sin(theta_1 - theta_2) + g sin(theta_2) = 0",
]


@pytest.mark.parametrize("around", ["#boxed[$ {} $]", "#box(stroke: 1pt, $ {} $)", "#text(12pt)[$ {} $]", "$ {} $"])
def test_a_row_of_typst_goes_on_behind_its_backslash(around):
    one, two = (around.format(row) for row in ROWS)
    assert grade_text(HEAD + f"[equations]\n1 = '''{one}'''\n2 = '''{two}'''\n").verdict == "correct"
    wrong = two.replace("- l_1 dot", "+ l_1 dot")
    assert grade_text(HEAD + f"[equations]\n1 = '''{one}'''\n2 = '''{wrong}'''\n").verdict == "wrong"
