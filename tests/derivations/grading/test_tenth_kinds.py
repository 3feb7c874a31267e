"""Kinds that the tenth collection showed: names that are no accelerations though they could be, rows where nothing
moves."""

import pytest

from furiko.derivations.grading.grade import grade_fields
from furiko.models.errors import InvalidInput

ARM = {
    "system": "mechanism",
    "bodies": [
        {"coordinate": "theta1", "mass": "m1", "length": "L1"},
        {"coordinate": "theta2", "mass": "m2", "length": "L2", "drive": "u"},
    ],
}
NOT_FOLLOWED = {  # alpha1 and alpha2 are parts of the inertias; how the accelerations come about is not followed
    "python": """
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    m11 = alpha1 + alpha2 + 2*m2*L1*L2*np.cos(theta2)
    dd = odd.backsolve(np.array([[m11, alpha2], [alpha2, alpha2]]), y)
    return np.vstack((w1, w2, dd))
""",
    "handed over": """
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    dd = backsolve(alpha1, alpha2, y)
    return np.vstack((w1, w2, dd))
""",
    "c": """
void deriv(const double x[4], double u, double dx[4]) {
  double theta1 = x[0], theta2 = x[1], w1 = x[2], w2 = x[3];
  double alpha1 = (m1 + m2)*L1*L1;
  double alpha2 = m2*L2*L2;
  double m11 = alpha1 + alpha2 + 2*m2*L1*L2*cos(theta2);
  solve_somehow(m11, alpha2, w1, w2, u, dx);
}""",
    "javascript": """
function step(s, u) {
  const { theta1, theta2, omega1, omega2 } = s;
  const alpha1 = (m1 + m2)*L1*L1;
  const alpha2 = m2*L2*L2;
  const m11 = alpha1 + alpha2 + 2*m2*L1*L2*Math.cos(theta2);
  const dd = math.lusolve([[m11, alpha2],[alpha2, alpha2]], [u, omega1]);
  return rk(dd);
}""",
    "julia": """
function rhs!(du, u, p, t)
    theta1, theta2, w1, w2 = u
    alpha1 = (m1 + m2)*L1^2
    alpha2 = m2*L2^2
    M = [alpha1 + alpha2 alpha2; alpha2 alpha2]
    dd = special_solve(M, [w1, w2])
    du .= vcat([w1, w2], dd)
end""",
    "matlab": """
function dx = rhs(t, x)
  theta1 = x(1); theta2 = x(2); w1 = x(3); w2 = x(4);
  alpha1 = (m1 + m2)*L1^2;
  alpha2 = m2*L2^2;
  M = [alpha1 + alpha2, alpha2; alpha2, alpha2];
  dd = mysolve(M, [w1; w2]);
  dx = [w1; w2; dd];
end""",
}


@pytest.mark.parametrize("language", NOT_FOLLOWED)
def test_parts_of_an_inertia_are_no_accelerations_whatever_they_are_called(language):
    with pytest.raises(InvalidInput):
        grade_fields({"equations": NOT_FOLLOWED[language], **ARM})


@pytest.mark.parametrize("inverse", ["inv", "pinv", "pinv2", "pinvh"])
def test_accelerations_by_a_pseudo_inverse_are_followed_beside_such_names(inverse):
    text = f"""
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    alpha3 = m2*L1*L2*np.cos(theta1 - theta2)
    M = np.array([[alpha1, alpha3], [alpha3, alpha2]])
    h = np.array([[m2*L1*L2*w2**2*np.sin(theta1 - theta2) + (m1 + m2)*g*L1*np.sin(theta1) + u],
                  [-m2*L1*L2*w1**2*np.sin(theta1 - theta2) + m2*g*L2*np.sin(theta2) - u]])
    dd = -np.dot(scipy.linalg.{inverse}(M), h)
    return np.vstack((np.array([[w1], [w2]]), dd))
"""
    assert grade_fields({"equations": text, **ARM, "angles": "absolute"}).verdict == "correct"


@pytest.mark.parametrize("row", ["m = 0.2", "0 = 1", "l^2 = 4 m/g"])
def test_a_row_in_which_nothing_moves_is_no_wrong_equation_of_motion(row):
    with pytest.raises(InvalidInput, match="no equation of motion"):
        grade_fields({"system": "simple-pendulum", "equations": {"1": row}})
    with pytest.raises(InvalidInput, match="no equation of motion"):
        grade_fields({"system": "simple-pendulum", "equations": [f"{row};"]})


CART = {
    "system": "mechanism",
    "bodies": [
        {"name": "cart", "coordinate": "x", "joint": "slide", "mass": "m_c", "drive": "F"},
        {"coordinate": "\\theta", "mass": "m_p", "length": "2*l", "centre": "l", "inertia": "m_p*l^2/3"},
    ],
}
TEMP = r"""$$\WORD{temp} = \frac{F + m_p l \dot\theta^2 \sin\theta}{m_c + m_p}$$
$$\ddot\theta = \frac{g\sin\theta - \cos\theta \,\WORD{temp}}{l (4/3 - m_p\cos^2\theta/(m_c + m_p))}$$
$$\ddot x = \WORD{temp} - \frac{m_p l \ddot\theta\cos\theta}{m_c + m_p}$$"""


@pytest.mark.parametrize("word", ["text", "operatorname", "mathrm", "textit"])
def test_a_word_that_the_text_says_the_value_of_is_a_name(word):
    text = TEMP.replace("WORD", word)
    assert grade_fields({"equations": {"1": text}, **CART}).verdict == "correct"
    slip = text.replace(rf"- \cos\theta \,\{word}", rf"+ \cos\theta \,\{word}")
    assert grade_fields({"equations": {"1": slip}, **CART}).verdict == "wrong"


PENDULUM = {"system": "mechanism", "bodies": [{"coordinate": "\\theta", "mass": "m", "length": "l"}]}


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        (r"$\frac{\partial\omega}{\partial t} = -\frac{g}{l}\sin\theta$, where $\omega = \dot\theta$.", "correct"),
        (r"$\frac{\partial\omega}{\partial t} = -\frac{2g}{l}\sin\theta$, where $\omega = \dot\theta$.", "wrong"),
        ("Równanie:\\\n$l\\ddot\\theta + g \\sin\\theta = 0$\\\n", "correct"),
        ("Równanie:\\\n$l\\ddot\\theta + g \\cos\\theta = 0$\\\n", "wrong"),
        ("m l^2 theta'' + m g l sin(theta) = 0  => theta'' = -g/l sin(theta)", "correct"),
        ("m l^2 theta'' + m g l sin(theta) = 0  => theta'' = -g/(2 l) sin(theta)", "wrong"),
    ],
)
def test_other_ways_to_write_a_row(text, verdict):
    assert grade_fields({"equations": {"1": text}, "from": "down", **PENDULUM}).verdict == verdict


def test_matrices_with_two_marks_between_columns_and_arguments_behind_the_power():
    bodies = [
        {"coordinate": "q_1", "mass": "m_1", "length": "l_1"},
        {"coordinate": "q_2", "mass": "m_2", "length": "l_2"},
    ]
    text = r"""$$\mathbf{M}(\mathbf{q}) = \begin{bmatrix} (m_1 + m_2) l_1^2 && m_2 l_1 l_2 \cos(q_1 - q_2) \\
m_2 l_1 l_2 \cos(q_1 - q_2) && m_2 l_2^2 \end{bmatrix}$$
$$\mathbf{h} = \begin{bmatrix} m_2 l_1 l_2 \sin(q_1 - q_2) \dot q_2^2 + (m_1 + m_2) g l_1 \sin q_1 \\
-m_2 l_1 l_2 \sin(q_1 - q_2) \dot q_1^2 + m_2 g l_2 \sin q_2 \end{bmatrix}$$
$$\begin{bmatrix} \ddot q_1 \\ \ddot q_2 \end{bmatrix} = -\mathbf{M}^{-1}(\mathbf{q}) \mathbf{h}$$"""
    fields = {"system": "mechanism", "bodies": bodies, "angles": "absolute"}
    assert grade_fields({"equations": {"1": text}, **fields}).verdict == "correct"
    assert grade_fields({"equations": {"1": text.replace("-m_2 l_1", "m_2 l_1")}, **fields}).verdict == "wrong"


def test_spaces_of_latex_alone_make_no_text_a_program_with_left_divisions():
    text = {"define": {"G": r"m \, l \, g"}, "equations": {"1": r"m l^2 \ddot\theta + G \sin\theta = 0"}}
    assert grade_fields({**text, **PENDULUM}).verdict == "correct"


UP = r"""$$\ddot\theta = \frac{g}{l}\sin\theta$$"""


@pytest.mark.parametrize(
    ("sentence", "origin"),
    [
        (r"$\theta = 0$ is upright.", "up"),
        (r"In this convention, $\theta=0$ is hanging down, and $l$ is the length.", "down"),
        (r"$\theta = \pi$ corresponds to the upright rod.", "down"),
        (r"$\theta = 0$ 表示摆杆竖直向下。", "down"),
        (r"\(\theta = 0\) bedeutet senkrecht nach oben.", "up"),
    ],
)
def test_a_sentence_says_where_the_angle_is_counted_from_and_is_held_to_it(sentence, origin):
    fields = {"equations": {"1": f"{sentence}\n\n{UP}\n"}, **PENDULUM}
    found = grade_fields(fields)
    assert (found.verdict, found.assumes) == (("correct", ()) if origin == "up" else ("wrong", ()))
    other = {"up": "down", "down": "up"}[origin]
    with pytest.raises(InvalidInput, match="is declared, and a sentence says"):
        grade_fields(fields | {"from": other})


@pytest.mark.parametrize(
    "sentence", [r"For $\theta = 0$ up there it is this:", r"Near $\theta = 0$, upright:", r"If $\theta=0$ is up:"]
)
def test_a_case_is_no_such_sentence(sentence):
    with pytest.raises(InvalidInput):
        grade_fields({"equations": {"1": f"{sentence}\n\n{UP}\n"}, **PENDULUM})


DOUBLE = """
def rhs(t, y, p):
    th1, th2, w1, w2 = y
    m1, m2 = p.m1, p.m2
    d = th1 - th2
    den = m1 + m2*np.sin(d)**2
    if abs(den) < GUARD:
        den = 1e-9
    a1 = (-m2*p.L1*w1**2*np.sin(d)*np.cos(d) - m2*p.L2*w2**2*np.sin(d) - (m1 + m2)*p.g*np.sin(th1)
          + m2*p.g*np.sin(th2)*np.cos(d))/(p.L1*den)
    a2 = ((m1 + m2)*(p.L1*w1**2*np.sin(d) - p.g*np.sin(th2) + p.g*np.sin(th1)*np.cos(d))
          + m2*p.L2*w2**2*np.sin(d)*np.cos(d))/(p.L2*den)
    return [w1, w2, a1, a2]
"""
OWNED = {
    "system": "mechanism",
    "angles": "absolute",
    "bodies": [
        {"coordinate": "th1", "mass": "p.m1", "length": "p.L1"},
        {"coordinate": "th2", "mass": "p.m2", "length": "p.L2"},
    ],
    "define": {"g": "p.g"},
}


def test_bodies_may_have_what_a_program_has_with_dots():
    text = DOUBLE.replace("GUARD", "1e-12")
    assert grade_fields({"equations": text, **OWNED}).verdict == "correct"
    assert grade_fields({"equations": text.replace("+ p.g*", "- p.g*"), **OWNED}).verdict == "wrong"


def test_two_owners_of_one_name_are_two_quantities():
    bodies = [{**body, "mass": f"{owner}.m"} for body, owner in zip(OWNED["bodies"], ("a", "b"), strict=True)]
    text = DOUBLE.replace("GUARD", "1e-12").replace("m1, m2 = p.m1, p.m2", "m1 = 2*a.m; m2 = 2*b.m")
    with pytest.raises(InvalidInput, match=r"a\.m and b\.m are two quantities; say in \[define\]"):
        grade_fields({"equations": text, **OWNED, "bodies": bodies})


def test_a_name_among_several_is_the_one_at_its_place():
    text = DOUBLE.replace("GUARD", "1e-12").replace("m1, m2 = p.m1, p.m2", "m2, m1 = p.m1, p.m2")
    with pytest.raises(InvalidInput, match="both names are quantities"):  # never taken for the other
        grade_fields({"equations": text, **OWNED})


def test_a_guard_against_a_division_by_zero_says_nothing_and_any_other_choice_is_not_followed():
    with pytest.raises(InvalidInput):
        grade_fields({"equations": DOUBLE.replace("GUARD", "0.5"), **OWNED})
    equal = DOUBLE.replace("abs(den) < GUARD", "den == 0")
    assert grade_fields({"equations": equal, **OWNED}).verdict == "correct"
