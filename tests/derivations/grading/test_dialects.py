# ruff: noqa: E501 -- formulas stand on one line, as on their pages
"""What programs and computer algebra print is read as what it means there; what may mean two things is refused."""

import re
import time

import pytest

from furiko.derivations.dialects.sums import sums
from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

PENDULUM = "system = 'simple-pendulum'\n[equations]\n1 = "
ONE = "system = 'mechanism'\n[[bodies]]\ncoordinate = '{}'\nmass = 'm'\nlength = 'l'\n"

# Each says l θ̈ + g sin θ = 0, by hand
SAME = {
    "Mathematica": "l*θ''[t] + g*Sin[θ[t]] == 0",
    "Mathematica, full": "l*Derivative[2][θ][t] + g*Sin[θ[t]] == 0",
    "Maple": "l*diff(theta(t), t$2) + g*sin(theta(t)) = 0",
    "Maxima": "l*('diff(theta(t),t,2)) + g*sin(theta(t)) = 0",
    "Modelica": "l*der(der(theta)) + g*sin(theta) = 0;",
    "Julia": "l*D(D(θ)) ~ -g*sin(θ)",
    "Typst": "l dot.double(theta) + g sin(theta) = 0",
    "Word": "l θ ̈+g sin\u2061〖θ 〗=0",
    "Fortran": "alpha = -1.d0*g*dsin(theta) &\n   & / l",
    "C": "pow(l, 2)*alpha = -g*l*sin(theta); // of the arm",
    "numpy": "np.square(l)*alpha = -g*l*np.sin(theta)  # of the arm",
    "MATLAB": "l*diff(theta(t), t, t) == -g*sin(theta(t)) % of the arm",
    "before the derivative": r"\frac{d}{dt}\left(l^2 \dot\theta\right) = -g l \sin\theta",
    "with diff": "diff(l**2*diff(theta(t), t), t) = -g*l*sin(theta(t))",
    "a decimal comma": r"0{,}5\, l\,\ddot\theta = -0{,}5\, g\sin\theta \,, \nonumber",
    "no equals sign": "l*alpha + g*sin(theta)",
}


@pytest.mark.parametrize("how", SAME)
def test_a_pendulum_as_others_print_it(how):
    found = grade_text(f"{PENDULUM}'''{SAME[how]}'''")
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


@pytest.mark.parametrize("how", SAME)
def test_and_with_twice_gravity_it_is_wrong(how):
    line = re.sub(r"(?<![A-Za-z])g(?![A-Za-z])", "2*g", SAME[how], count=1)  # from wherever the angle is counted
    assert grade_text(f"{PENDULUM}'''{line}'''").verdict == "wrong"


@pytest.mark.parametrize(
    ("coordinate", "rows", "define"),
    [
        ("a1", ["a1_a = -g/l*Math.sin(a1);"], {}),
        ("theta", [r"\dot\theta = \omega", r"\dot\omega = -\frac{g}{l}\sin\theta"], {}),
        ("x_1", [r"\dot x_2 = -\frac{g}{l}\sin x_1"], {"x_2": r"\dot x_1"}),
        ("theta", [r"\ddot\theta(t) = -\tilde{k}_1\sin\theta(t)"], {r"\tilde{k}_1": "g/l"}),
        ("theta", [r"\ddot\theta = -\kappa\sin\theta, \quad\text{where } \kappa = g/l"], {}),
        ("theta", ["thetaacc = -grav*sin(y[0])"], {"y[0]": "theta", "grav": "g/l"}),
        ("theta", [r"\ddot\theta = 0"], {"g": "0"}),
        ("theta", ["l*theta_ddot = -g*sin(theta)"], {"g": "9.81"}),
    ],
)  # fmt: skip
def test_names_that_textbooks_and_programs_use(coordinate, rows, define):
    table = "[define]\n" + "".join(f"'{name}' = '''{value}'''\n" for name, value in define.items()) if define else ""
    text = ONE.format(coordinate) + table + "[equations]\n"
    text += "".join(f"{k} = '''{row}'''\n" for k, row in enumerate(rows, 1))
    found = grade_text(text)
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


ARM = r"""system = 'mechanism'
angles = 'relative'
from = 'horizontal'
[[bodies]]
coordinate = 'q_1'
mass = 'm_1'
length = 'l_1'
drive = '\tau_1'
[[bodies]]
coordinate = 'q_2'
mass = 'm_2'
length = 'l_2'
drive = '\tau_2'
[define]
'M(q)' = '''\begin{bmatrix} (m_1+m_2)l_1^2+m_2l_2^2+2m_2l_1l_2c_2 & m_2l_2^2+m_2l_1l_2c_2\\ m_2l_2^2+m_2l_1l_2c_2 & m_2l_2^2\end{bmatrix}'''
'C(q,\dot{q})' = '''\begin{bmatrix} -m_2l_1l_2s_2\dot q_2 & -m_2l_1l_2s_2(\dot q_1+\dot q_2)\\ m_2l_1l_2s_2\dot q_1&0\end{bmatrix}'''
'G(q)' = '''\begin{bmatrix} (m_1+m_2)gl_1c_1+m_2gl_2c_{12}\\ m_2gl_2c_{12}\end{bmatrix}'''
[equations]
1 = '''\boldsymbol{M}(\boldsymbol q)\ddot{\boldsymbol q}+\boldsymbol{C}(\boldsymbol q,\dot{\boldsymbol q})\dot{\boldsymbol q}+\boldsymbol{G}(\boldsymbol q)=\boldsymbol\tau'''
"""


def test_a_robot_in_vectors_with_the_short_waves_of_robotics():
    assert grade_text(ARM).verdict == "correct"
    # The link's own gravity turned with the first joint alone: wrong by hand
    assert grade_text(ARM.replace(r"m_2gl_2c_{12}\end", r"m_2gl_2c_{2}\end")).verdict == "wrong"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # c_1 with a rate is a damper rather than a cosine
        (ONE.format("theta_1") + "[equations]\n1 = 'm*l^2*theta_1\\'\\' + c_1*theta_1\\' + m*g*l*sin(theta_1) = 0'"
         .replace("'m*", '"m*').replace("= 0'", '= 0"').replace("\\'", "'"), "'c' is not known here"),
        # a right-hand side alone is no row, though it has the other row's acceleration
        ("system = 'double-pendulum'\n[equations]\n1 = 'a2*l2/l1*cos(t1-t2)'\n2 = '-a1*l1/l2 - g*sin(t2)'", "equals sign"),
        ("system = 'double-pendulum'\n[equations]\n1 = 'l1*a1 + w^2*sin(t1) = 0'\n2 = 'a2 = 0'", "has no index"),
        (PENDULUM + r"'\sum_{k=1}^3 l \ddot\theta = 0'", "write the sum out"),
        (ONE.format("theta") + '[equations]\n1 = "l*theta\'\' + m\'*sin(theta) = 0"', "which is no coordinate"),
        (PENDULUM + r"'\frac{d}{dt}\left(l \ddot\theta\right) = 0'", "third time derivative"),
    ],
)  # fmt: skip
def test_what_may_mean_something_else_is_refused_and_says_what_to_write(text, said):
    with pytest.raises(InvalidInput, match=said):
        grade_text(text)


TWO = r"""system = 'double-pendulum'
[define]
{}
[equations]
1 = '''\begin{{aligned}}{}\end{{aligned}}'''
"""
ROWS = (
    r"(m_1+m_2)L_1{\ddot{\theta}}_{1}+m_2L_2[{\ddot{\theta}}_{2}\cos(\theta_1-\theta_2)+{\omega_2}^{2}\sin(\theta_1-\theta_2)]"
    r"+(m_1+m_2)g\sin\theta_1&=0\\L_2{\ddot{\theta}}_{2}+L_1[{\ddot{\theta}}_{1}\cos(\theta_1-\theta_2)"
    r"-{\dot{\theta}}_{1}^{2}\sin(\theta_1-\theta_2)]+g\sin\theta_2&=0"
)


def test_capital_lengths_in_an_aligned_environment_dots_in_braces_and_a_rate_that_is_said_to_be_one():
    """The l of \\begin{aligned} is no length, and ω_1 = θ̇_1 says nothing new."""
    rates = r"'\omega_1' = '\dot\theta_1'" + "\n" + r"'\omega_2' = '\dot\theta_2'"
    assert grade_text(TWO.format(rates, ROWS)).verdict == "correct"
    assert grade_text(TWO.format(rates, ROWS.replace("-{", "+{"))).verdict == "wrong"


def test_a_matrix_of_numbered_entries_needs_no_commas():
    rows = "M11 = '(m1+m2)*l1'\nM12 = 'm2*l2*cos(t1-t2)'\nM21 = 'l1*cos(t1-t2)'\nM22 = 'l2'\nM = '[M11 M12; M21 M22]'\n"
    right = "[-m2*l2*w2^2*sin(t1-t2) - (m1+m2)*g*sin(t1); l1*w1^2*sin(t1-t2) - g*sin(t2)]"
    text = f"system = 'double-pendulum'\n[define]\n{rows}[equations]\n1 = '[a1; a2] = inv(M)*{right}'\n"
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("M21 M22", "M12 M22")).verdict == "wrong"


@pytest.mark.parametrize(
    "text",
    [
        PENDULUM + f"'{' ' * 19000}'",
        PENDULUM + f"'a{',' * 19000}'",
        "system = 3\nlinks = 10000000000\n[equations]\n1 = 'a = 0'\n",
        PENDULUM + f"'{'Sin[' * 4000}'",
        PENDULUM + f"'{'pow(' * 4000}'",
        PENDULUM + f"'{'np.square(' * 1900}'",
        "system = 'simple-pendulum'\n[define]\n" + f"'{'M' * 5000}(q)' = '[1, 2]'\n[equations]\n1 = 'a = 0'",
    ],
    ids=["blanks", "commas", "links", "Sin", "pow", "square", "name"],
)
def test_a_hostile_file_is_refused_at_once(text):
    begun = time.process_time()
    with pytest.raises(InvalidInput):
        grade_text(text)
    assert time.process_time() - begun < 2.0  # what a hostile input may cost at most, here as anywhere


# Each says l θ̈ + g sin θ = 0, by hand
PRINTED = {
    "Rust": "let alpha = -g * theta.sin() / l;",
    "Rust, powers": "let alpha = -g * (2.0 * theta / 2.0).sin() * l.powi(2) / (l * 1.0).powi(3);",
    "JavaScript": "const alpha = -g * Math.sin(theta) / l;",
    "Lagrange's operator in front": r"\frac{d}{dt}\left(\frac{\partial L}{\partial\dot\theta}\right) - \frac{\partial L}{\partial\theta} = l\ddot\theta + g\sin\theta = 0",
    "a sum over the links": r"\sum_{i=1}^{1} l_i\ddot\theta_i + g\sin\theta_1 = 0",
    "a sum to n": r"\sum\limits_{k=1}^n \left(l_{k}\ddot\theta_k + g \sin\theta_k\right) = 0",
    "another slash": "θ̈ = − g sin θ ∕ l",
}  # fmt: skip


@pytest.mark.parametrize("how", PRINTED)
def test_a_pendulum_as_programs_and_lectures_print_it(how):
    assert grade_text(f"{PENDULUM}'''{PRINTED[how]}'''").verdict == "correct"
    line = re.sub(r"(?<![A-Za-z.\\])g(?![A-Za-z])", "2*g", PRINTED[how], count=1)
    assert line != PRINTED[how]
    assert grade_text(f"{PENDULUM}'''{line}'''").verdict == "wrong"


def test_sums_go_as_far_as_a_product_and_no_farther():
    assert sums(r"\sum_{i=1}^{2} m_i x_i + c", 2).replace(" ", "") == "((m_{1}x_{1})+(m_{2}x_{2}))+c"
    nested = sums(r"\sum_{i=1}^{2} m_i \sum_{j=1}^{i} y_{j}", 2).replace(" ", "")
    assert nested == "((m_{1}((y_{1})))+(m_{2}((y_{1})+(y_{2}))))"
    assert sums(r"\sum_{i=1}^{2} l_i i = 0", 2).replace(" ", "") == "((l_{1}i)+(l_{2}i))=0"  # i: refused by the reader
    assert (
        sums(r"\sum_{i=1}^{8} \sum_{j=1}^{8} \sum_{k=1}^{8} \sum_{h=1}^{8} x_{i}x_{j}x_{k}x_{h}", 8).count("\\sum") > 1
    )


def test_an_operator_with_one_equals_sign_says_nothing_of_the_right_side():
    line = r"\frac{d}{dt}\frac{\partial L}{\partial\dot\theta} - \frac{\partial L}{\partial\theta} = l\ddot\theta + g\sin\theta"
    with pytest.raises(InvalidInput, match="partial is not read"):
        grade_text(f"{PENDULUM}'''{line}'''")


def test_what_is_not_known_where_bodies_are_declared_is_asked_for():
    with pytest.raises(InvalidInput, match="springs between two bodies cannot be declared"):
        grade_text(ONE.format("x") + "[equations]\n1 = \"m l x'' = -k x\"")
