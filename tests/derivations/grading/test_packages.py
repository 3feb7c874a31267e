# ruff: noqa: E501 -- formulas stand on one line, as in their papers
r"""Commands of LaTeX's packages, braces over matrices, names like \det(\mathbf M), and what a page has around formulas."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

ONE = "system='mechanism'\nfrom='down'\n[[bodies]]\ncoordinate='\\theta'\nmass='m'\nlength='l'\n[equations]\n1='''\n{}\n'''\n"
TWO = "system='mechanism'\nangles='absolute'\nfrom='down'\n" + "".join(
    f"[[bodies]]\ncoordinate='\\theta_{k}'\nmass='m_{k}'\nlength='l_{k}'\n" for k in (1, 2)
) + "[equations]\n1='''\n{}\n'''\n"  # fmt: skip
SECOND = [
    r"\dv[2]{\theta}{t}", r"\derivative[2]{\theta}{t}", r"\odv[order=2]{\theta}{t}", r"\odv[2]{\theta}{t}", r"\od[2]{\theta}{t}",
    r"\dod[2]{\theta}{t}", r"\odd{\theta}{t}", r"\od{\od{\theta}{t}}{t}", r"\od[2]{}{t}\theta", r"\dv{t}\qty(\dv{\theta}{t})",
    r"\dv[2]{t}\theta", r"\diff[2]{\theta}{t}", r"\deriv[2]{\theta(t)}{t}", r"\frac{\dd^2\theta}{\dd t^2}", r"\frac{\dd[2]{\theta}}{\dd{t}^2}",
    r"\frac{\dif^2\theta}{\dif t^2}", r"\Ddot{\theta}", r"\Ddot\theta", r"\overset{..}{\theta}", r"\stackrel{\cdot\cdot}{\theta}", r"\theta^{\prime\prime}",
]  # fmt: skip


@pytest.mark.parametrize("second", SECOND)
def test_a_second_derivative_of_a_package(second):
    assert grade_text(ONE.format(rf"l{second} + g\sin\theta = 0")).verdict == "correct"
    assert grade_text(ONE.format(rf"l{second} - g\sin\theta = 0")).verdict == "wrong"


@pytest.mark.parametrize("first", [r"\dv{\theta}{t}", r"\od{\theta}{t}", r"\Dot{\theta}", r"\derivative{\theta}{t}"])
def test_a_first_derivative_is_none_of_second_order(first):
    """With a damper b; the rate is no acceleration."""
    text = ONE.replace("length='l'", "length='l'\ndamping='b'")
    assert grade_text(text.format(rf"m l^2\ddot\theta + b{first} + m g l\sin\theta = 0")).verdict == "correct"
    assert grade_text(text.format(rf"m l^2\ddot\theta - b{first} + m g l\sin\theta = 0")).verdict == "wrong"


def test_a_law_in_a_packages_derivatives():
    law = r"\dv{t}\pdv{L}{\dot\theta} - \pdv{L}{\theta} = m l^2\ddot\theta {} m g l\sin\theta = 0"
    assert grade_text(ONE.format(law.replace("{}", "+"))).verdict == "correct"
    assert grade_text(ONE.format(law.replace("{}", "-"))).verdict == "wrong"


@pytest.mark.parametrize("unknown", [r"\dv{\theta}{t}{x}", r"\dv[n]{\theta}{t}", r"\dv[3]{\theta}{t}", r"\od{\theta}"])
def test_other_arguments_are_refused(unknown):
    with pytest.raises(InvalidInput):
        grade_text(ONE.format(rf"l{unknown} + g\sin\theta = 0"))


@pytest.mark.parametrize("row", [
    r"\nicefrac{1}{2} l\ddot\theta = -\sfrac{1}{2} g\sin\qty(\theta)", r"\mleft(l\ddot\theta\mright) = -g\sin\lparen\theta\rparen",
    r"\underbrace{m l^2}_{I}\ddot\theta = \overbrace{-m g l\sin\theta}^{\text{weight}}",
])  # fmt: skip
def test_brackets_and_fractions_of_packages(row):
    assert grade_text(ONE.format(row)).verdict == "correct"
    assert grade_text(ONE.format(row.replace("-", ""))).verdict == "wrong"


MASSES = r"\begin{pmatrix} (m_1+m_2)l_1^2 & m_2 l_1 l_2\cos(\theta_1-\theta_2) \\ m_2 l_1 l_2\cos(\theta_1-\theta_2) & m_2 l_2^2 \end{pmatrix}"
RATES = r"\begin{pmatrix} m_2 l_1 l_2\dot\theta_2^2\sin(\theta_1-\theta_2) + (m_1+m_2) g l_1\sin\theta_1 \\ -m_2 l_1 l_2\dot\theta_1^2\sin(\theta_1-\theta_2) + m_2 g l_2\sin\theta_2 \end{pmatrix}"
COLUMN = r"\begin{pmatrix} \ddot\theta_1 \\ \ddot\theta_2 \end{pmatrix}"


def test_braces_under_matrices():
    row = rf"$$\underbrace{{{MASSES}}}_{{M(q)}} {COLUMN} + \underbrace{{{RATES}}}_{{h(q, \dot q)}} = 0$$"
    assert grade_text(TWO.format(row)).verdict == "correct"
    for slip in (("-m_2 l_1", "+m_2 l_1"), (r"m_2 l_2^2 \end", r"m_1 l_2^2 \end"), ("+ (m_1+m_2) g", "- (m_1+m_2) g")):
        assert grade_text(TWO.format(row.replace(*slip))).verdict == "wrong"


@pytest.mark.parametrize(
    "around", ["<div>\n{}\n</div>", '<p align="center">\n{}\n</p><br/>', '<span class="math">{}</span>']
)
def test_tags_around_formulas(around):
    note = around.format(rf"$$ M = {MASSES}, \qquad F = {RATES} $$")
    text = TWO.format(r"$M(\theta)\,\ddot\theta + F(\theta, \dot\theta) = 0$ with" + "\n\n" + note)
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("-m_2 l_1", "+m_2 l_1")).verdict == "wrong"


@pytest.mark.parametrize("around", ['<div style="display:none">{}</div>', "<del>{}</del>", "<s>{}</s>"])
def test_what_a_page_hides_or_strikes_out_is_refused(around):
    with pytest.raises(InvalidInput):
        grade_text(ONE.format(around.format(r"$$l\ddot\theta + g\sin\theta = 0$$")))


SOLVED = (
    r"\ddot\theta_1 = \frac{1}{\det(\mathbf{M})}\left[-m_2 l_2^2 (m_2 l_1 l_2\dot\theta_2^2\sin(\theta_1-\theta_2) + (m_1+m_2) g l_1\sin\theta_1) - m_2 l_1 l_2\cos(\theta_1-\theta_2)(m_2 l_1 l_2\dot\theta_1^2\sin(\theta_1-\theta_2) - m_2 g l_2\sin\theta_2)\right]"
    "\n"
    r"\ddot\theta_2 = \frac{1}{\det(\mathbf{M})}\left[(m_1+m_2) l_1^2 (m_2 l_1 l_2\dot\theta_1^2\sin(\theta_1-\theta_2) - m_2 g l_2\sin\theta_2) + m_2 l_1 l_2\cos(\theta_1-\theta_2)(m_2 l_1 l_2\dot\theta_2^2\sin(\theta_1-\theta_2) + (m_1+m_2) g l_1\sin\theta_1)\right]"
    "\n"
    r"\det(\mathbf{M}) = (m_1+m_2) l_1^2 m_2 l_2^2 - (m_2 l_1 l_2\cos(\theta_1-\theta_2))^2"
)


@pytest.mark.parametrize("name", [r"\det(\mathbf{M})", r"\det(M)", r"\det M", r"\det\mathbf{M}"])
def test_a_determinant_that_is_said(name):
    text = TWO.format(SOLVED.replace(r"\det(\mathbf{M})", name))
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("l_2^2 - (m_2", "l_2^2 + (m_2")).verdict == "wrong"


def test_a_determinant_that_is_not_said_is_refused():
    with pytest.raises(InvalidInput):
        grade_text(TWO.format(SOLVED.rpartition("\n")[0]))


def test_a_difference_of_angles_with_a_name_of_two_letters():
    row = SOLVED.replace(r"\theta_1-\theta_2", r"\Delta\theta").replace(r"\det(\mathbf{M})", "D")
    text = TWO.format("$$" + row.replace("\n", "$$\n$$") + "$$\nwith $\\Delta\\theta = \\theta_1 - \\theta_2$.")
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace(r"\theta_1 - \theta_2$", r"\theta_2 - \theta_1$")).verdict == "wrong"
    assert grade_text(text.replace(r"\theta_1 - \theta_2$", r"\theta_1 + \theta_2$")).verdict == "wrong"
