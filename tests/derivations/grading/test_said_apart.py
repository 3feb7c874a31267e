# ruff: noqa: E501 -- formulas stand on one line, as in their notes
r"""What a text says apart from its rows: entries of matrices in a list, states of first order, drives of time, backticks."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

ARM = "system='mechanism'\nangles='relative'\nfrom='down'\n" + "".join(
    f"[[bodies]]\ncoordinate='q_{k}'\nmass='m_{k}'\nlength='l_{k}'\ndrive='\\tau_{k}'\n" for k in (1, 2)
) + "[equations]\n1='''\n{}\n'''\n"  # fmt: skip
ENTRIES = r"""$$M(q)\ddot{q} + C(q, \dot q)\dot{q} + g(q) = \tau$$

- inertia:
  $$M_{11} = (m_1 + m_2) l_1^2 + m_2 l_2^2 + 2 m_2 l_1 l_2 \cos q_2$$
  $$M_{12} = M_{21} = m_2 l_2^2 + m_2 l_1 l_2 \cos q_2$$
  $$M_{22} = m_2 l_2^2$$
- rates:
  $$C_{11} = -m_2 l_1 l_2 \sin(q_2) \dot q_2$$
  $$C_{12} = -m_2 l_1 l_2 \sin(q_2) (\dot q_1 + \dot q_2)$$
  $$C_{21} = m_2 l_1 l_2 \sin(q_2) \dot q_1$$
  $$C_{22} = 0$$
- weight:
  $$g_1 = (m_1 + m_2) g l_1 \sin q_1 + m_2 g l_2 \sin(q_1 + q_2)$$
  $$g_2 = m_2 g l_2 \sin(q_1 + q_2)$$"""
ONE = "system='mechanism'\nfrom='down'\n[[bodies]]\ncoordinate='θ'\nmass='m'\nlength='l'\n{}\n[equations]\n1='''\n{}\n'''\n"


@pytest.mark.parametrize("fonts", [
    ("", ""), (r"M(q)\ddot{q}", r"\mathbf{M}(\mathbf{q})\ddot{\mathbf{q}}"), (r"C(q, \dot q)", r"C(q, \dot{q})"), ("- ", "* "),
])  # fmt: skip
def test_entries_that_are_said_one_by_one(fonts):
    text = ARM.format(ENTRIES.replace(*fonts))
    assert grade_text(text).verdict == "correct"
    assert not grade_text(text).assumes


@pytest.mark.parametrize("slip", [
    (r"C_{21} = m_2", r"C_{21} = -m_2"), (r"M_{22} = m_2", r"M_{22} = 2 m_2"), (r"g_2 = m_2 g l_2 \sin", r"g_2 = m_2 g l_2 \cos"),
    (r"(\dot q_1 + \dot q_2)", r"(\dot q_1 - \dot q_2)"), (r"M_{12} = M_{21} = m_2 l_2^2 +", r"M_{12} = M_{21} = m_2 l_2^2 -"),
    (r"M(q)\ddot{q} +", r"M(q)\ddot{q} -"),
])  # fmt: skip
def test_a_slip_in_an_entry_is_noticed(slip):
    assert slip[0] in ENTRIES
    assert grade_text(ARM.format(ENTRIES.replace(*slip))).verdict == "wrong"


@pytest.mark.parametrize("lost", [r"  $$C_{22} = 0$$", r"  $$g_2 = m_2 g l_2 \sin(q_1 + q_2)$$"])
def test_an_entry_that_is_not_said_is_refused(lost):
    with pytest.raises(InvalidInput):
        grade_text(ARM.format(ENTRIES.replace(lost, "")))


def test_a_row_and_the_same_of_first_order():
    text = r"$\ddot\theta = -\frac{g}{l}\sin\theta$ ; $x_1 = \theta$, $x_2 = \dot\theta$, $\omega^2 = g/l$: $$\dot x_1 = x_2, \qquad \dot x_2 = -\omega^2\sin x_1.$$"
    assert grade_text(ONE.format("", text)).verdict == "correct"
    with pytest.raises(InvalidInput, match="contradicts"):
        grade_text(ONE.format("", text.replace(r"-\omega^2", r"\omega^2")))
    with pytest.raises(InvalidInput, match="contradicts"):
        grade_text(ONE.format("", text.replace("= g/l", "= l/g")))


@pytest.mark.parametrize("drive", ["τ(t)", "τ", "τ_1(t)", "M(t)"])
def test_a_drive_that_is_a_function_of_time(drive):
    row = f"m l² θ'' + m g l sin(θ) = {drive}"
    assert grade_text(ONE.format(f"drive='{drive}'", row)).verdict == "correct"
    assert grade_text(ONE.format(f"drive='{drive}'", row.replace("= ", "= -"))).verdict == "wrong"
    assert grade_text(ONE.format(f"drive='{drive}'", row.replace("+ m g", "- m g"))).verdict == "wrong"


@pytest.mark.parametrize("fence", ["```\n{}\n```", "```math\n{}\n```", "~~~\n{}\n~~~", "`{}`"])
def test_marks_of_markdown_around_a_row(fence):
    row = "m * l² * θ̈ + m * g * l * sin(θ) = 0"
    assert grade_text(ONE.format("", fence.format(row))).verdict == "correct"
    assert grade_text(ONE.format("", fence.format(row.replace("sin", "cos")))).verdict == "wrong"
    assert grade_text(ONE.format("", fence.format(row.replace("+", "-")))).verdict == "wrong"


PLACES = "system='mechanism'\nangles='relative'\nfrom='down'\n" + "".join(
    f"[[bodies]]\ncoordinate='{x}'\nmass='m'\nlength='r'\n" for x in ("theta", "alpha")
) + "[positions]\n{}"  # fmt: skip
ASCII = r"""x1 = '` x_1 = r\ sin theta `'
y1 = '` y_1 = - r\ cos theta `'
x2 = '` r\ (sin theta + sin(theta + alpha)) `'
y2 = '`-r (cos theta + cos(theta + alpha))`'
"""


def test_backticks_around_places():
    assert grade_text(PLACES.format(ASCII)).verdict == "correct"
    assert grade_text(PLACES.format(ASCII.replace("+ sin(", "- sin("))).verdict == "wrong"
    with pytest.raises(InvalidInput, match="give each its own field"):
        grade_text(PLACES.format(ASCII.replace("x_1 =", "x_2 =")))


def test_a_backslash_and_a_blank_is_no_division():
    r"""r\ sin theta: LaTeX's blank, which MATLAB would take for a division."""
    with pytest.raises(InvalidInput, match="a backslash with a blank"):
        grade_text(PLACES.format(ASCII.replace("`", "")))


FREE = "system='mechanism'\nfrom='down'\n[[bodies]]\ncoordinate='t'\nmass='0'\nlength='l'\n[[bodies]]\ncoordinate='e'\njoint='slide'\nalong='link'\nmass='m'\nspring='k'\n{}[equations]\n1='{}'\n2='{}'\n"
ALONG, ACROSS = "edd = (l + e)*td*td + g*cos(t) - k*e/m", "tdd = -(2*ed*td + g*sin(t))/(l + e)"


def test_an_angle_that_is_called_t():
    assert grade_text(FREE.format("", ALONG, ACROSS)).verdict == "correct"
    assert grade_text(FREE.format("", ALONG.replace("cos", "sin"), ACROSS)).verdict == "wrong"
    assert grade_text(FREE.format("", ALONG, ACROSS.replace("2*", ""))).verdict == "wrong"


@pytest.mark.parametrize(("more", "row"), [
    ("drive='F(t)'\n", ALONG + " + F(t)/m"), ("drive='F*cos(w*t)'\n", ALONG + " + F*cos(w*t)/m"), ("", ALONG.replace("edd", "d^2e/dt^2")),
])  # fmt: skip
def test_an_angle_that_is_called_t_besides_time_is_refused(more, row):
    with pytest.raises(InvalidInput):
        grade_text(FREE.format(more, row, ACROSS))


@pytest.mark.parametrize("second", ["d 2(theta)/ dt2", "d2(theta)/dt2", "d2theta/dt2", "d^2(theta)/dt^2", "theta''"])
def test_a_drive_with_a_cosine_of_an_angle_that_is_no_coordinate(second):
    text = ONE.replace("'θ'", "'theta'")
    row = f"l {second} = -g sin(theta) + A cos(phi)/(m l)"
    assert grade_text(text.format("drive='A cos(phi)'", row)).verdict == "correct"
    assert grade_text(text.format("drive='A cos(phi)'", row.replace("+ A", "- A"))).verdict == "wrong"
    with pytest.raises(InvalidInput):
        grade_text(text.format("drive='A cos(phi)'", row.replace("cos(phi)", "sin(phi)")))


PARTS = r"""
\begin {align*} T_1 &= \frac {1}{2} m_1 L^2\dot {\theta}_1^2 \\ V_1 &= -m_1 g L\cos\theta_1 \end {align*}

\begin {align*} T_2 &= \frac {1}{2} m_2 L^2\left ( \dot\theta_1^2 + \dot\theta_2^2 + 2\dot\theta_1\dot\theta_2\cos(\theta_1-\theta_2)\right ) \\ V_2 &= -m_2 g L(\cos\theta_1 + \cos\theta_2) \end {align*}

$\mathcal {L} = (T_1 + T_2) - (V_1 + V_2)$
"""


@pytest.mark.parametrize(
    ("slip", "verdict"), [(("", ""), "correct"), (("_1 + \\cos", "_1 - \\cos"), "wrong"), (("+ 2", "+ "), "wrong")]
)
def test_a_lagrangian_of_parts_beside_a_length_with_its_letter(slip, verdict):
    bodies = "".join(f"[[bodies]]\ncoordinate='\\theta_{k}'\nmass='m_{k}'\nlength='L'\n" for k in (1, 2))
    parts = PARTS.replace(*slip) if slip[0] else PARTS
    text = f"system='mechanism'\nangles='absolute'\nfrom='down'\nlagrangian='''{parts}'''\n{bodies}"
    assert grade_text(text).verdict == verdict
