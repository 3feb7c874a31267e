# ruff: noqa: E501 -- formulas stand on one line, as on their pages
r"""Names and left sides as authors set them: each in words that no collection has, right, wrong, and in doubt refused."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

ONE = "system = 'mechanism'\nfrom = 'down'\n[[bodies]]\ncoordinate = '{q}'\nmass = '{m}'\nlength = '{l}'\n[equations]\n1 = '''{row}'''\n"
TWO = "system = 'mechanism'\nangles = '{angles}'\nfrom = 'down'\n" + "".join(
    f"[[bodies]]\ncoordinate = '\\theta_{k}'\nmass = 'm_{k}'\nlength = 'l_{k}'\n" for k in (1, 2)
)


def one(row, q="\\theta", m="m", l="l"):
    return grade_text(ONE.format(q=q, m=m, l=l, row=row)).verdict


@pytest.mark.parametrize(
    ("m", "l", "row"),
    [
        (
            r"m_\mathrm{bob}",
            r"L_\text{rod}",
            r"m_{\mathrm{bob}} L_{\text{rod}} \ddot\theta = -m_\mathrm{bob} {} g \sin\theta",
        ),
        (r"m_\beta", r"\ell_\Sigma", r"m_{\beta}\ell_\Sigma\ddot\theta = -{} m_\beta g\sin\theta"),
        (r"m_{\rm p}", "ell", r"m_{\rm p}\, \ell \ddot\theta + {} m_{\rm p} g \sin\theta = 0"),
    ],
)
def test_an_index_in_any_font_or_alphabet(m, l, row):
    assert one(row.replace("{}", ""), m=m, l=l) == "correct"
    assert one(row.replace("{}", "2"), m=m, l=l) == "wrong"


def test_words_for_an_energy():
    file = "system = 'simple-pendulum'\nkinetic = '''{}'''\npotential = '''{}'''\n"
    right = (r"E_\mathrm{kin} = \frac12 m l^2 \dot\theta^2", r"E_\text{pot} = -m g l\cos\theta")
    assert grade_text(file.format(*right)).verdict == "correct"
    assert grade_text(file.format(r"W_{k} = m l^2 \dot\theta^2", right[1])).verdict == "wrong"
    with pytest.raises(InvalidInput, match="is it the kinetic energy"):
        grade_text(file.format(right[1], right[0]))


def test_a_lagrangian_as_a_difference_of_letters():
    file = "system = 'simple-pendulum'\nlagrangian = '''{}'''\n"
    text = r"\begin{align*}\mathcal{L}(\theta,\dot\theta) = E_c - E_p = \frac12 m l^2\dot\theta^2 SIGN mgl\cos\theta\end{align*}"
    assert grade_text(file.format(text.replace("SIGN", "+"))).verdict == "correct"
    assert (
        grade_text(file.format(text.replace("SIGN", "-"))).verdict == "correct"
    )  # right from the upward vertical, which is said
    assert grade_text(file.format(text.replace("SIGN", "-"))).assumes
    assert grade_text(file.format(text.replace("SIGN", "+ 2"))).verdict == "wrong"


def test_a_position_says_its_own_name_or_is_refused():
    file = TWO.format(angles="absolute") + "[positions]\nx1 = '''{}'''\ny1 = '''{}'''\n"
    assert grade_text(file.format(r"x_{1} = l_1\sin\theta_1", r"y_1 = -l_1\cos\theta_1")).verdict == "correct"
    assert grade_text(file.format(r"x_1 = l_1\cos\theta_1", r"y_1 = -l_1\cos\theta_1")).verdict == "wrong"
    with pytest.raises(InvalidInput, match="its own field"):
        grade_text(file.format(r"y_1 = l_1\sin\theta_1", r"x_1 = -l_1\cos\theta_1"))


ROWS = (
    r"(m_1+m_2) l_1 \ddot\theta_1 + m_2 l_2 (\ddot\theta_2 C_{12} + \dot\theta_2^2 S_{12}) + (m_1+m_2) g S_1 = 0 \\ "
    r"l_2 \ddot\theta_2 + l_1(\ddot\theta_1 C_{12} - \dot\theta_1^2 S_{12}) + g S_2 = 0, \quad RULE"
)


@pytest.mark.parametrize(
    ("rule", "verdict"),
    [
        (r"C_{ij} = \cos(\theta_i - \theta_j),\ S_{ij} = \sin(\theta_i-\theta_j),\ S_i = \sin\theta_i", "correct"),
        (
            r"\text{where } C_{ij} := \cos(\theta_{i} - \theta_{j}),\quad S_{ij} := \sin(\theta_{i}-\theta_{j}),\quad S_k := \sin\theta_k",
            "correct",
        ),
        (r"C_{ij} = \cos(\theta_i - \theta_j),\ S_{ij} = \sin(\theta_j-\theta_i),\ S_i = \sin\theta_i", "wrong"),
        (r"C_{ij} = \cos(\theta_i - \theta_j),\ S_{ij} = \sin(\theta_i-\theta_k),\ S_i = \sin\theta_i", None),
    ],
)
def test_shorthand_by_a_rule(rule, verdict):
    text = TWO.format(angles="absolute") + "[equations]\n1 = '''" + ROWS.replace("RULE", rule) + "'''\n"
    if verdict is None:
        with pytest.raises(InvalidInput):
            grade_text(text)
    else:
        assert grade_text(text).verdict == verdict


def test_numbers_with_units_and_a_number_for_g():
    row = r"\qty{2}{\kilogram}\cdot\num{0,5} \ddot\theta + \SI{2}{kg} g \sin\theta = 0"
    assert one(row, m="2", l="0.5") == "correct"
    assert one(row.replace("0,5", "0,25"), m="2", l="0.5") == "wrong"
    text = ONE.format(q="\\theta", m="m", l="l", row=r"2 l\ddot\theta + 19.6 \sin\theta = 0") + "[define]\ng = '9.80'\n"
    assert grade_text(text).verdict == "correct"
    assert grade_text(text.replace("19.6", "9.80")).verdict == "wrong"
    earth = ONE.format(q="\\theta", m="m", l="l", row=r"l\ddot\theta + 9.80 \sin\theta = 0") + "[define]\ng = '9.80'\n"
    assert grade_text(earth).verdict == "correct"
    # What went into other numbers counts as well: 19.6/2 is 9.8, and 19.6 is not
    assert grade_text(earth.replace("9.80 ", "\\frac{19.6}{2} ")).verdict == "correct"
    assert grade_text(earth.replace("9.80 ", "19.6 ")).verdict == "wrong"


def test_coordinates_that_are_counted_from_nothing():
    file = TWO.format(angles="absolute").replace("\\theta_1", "a[0]").replace("\\theta_2", "a[1]")
    rows = (
        "[equations]\n1 = '''(m_1+m_2)*l_1*a[0]'' + m_2*l_2*(a[1]''*cos(a[0]-a[1]) + a[1]'^2*sin(a[0]-a[1])) + (m_1+m_2)*g*sin(a[0]) = 0'''\n"
        "2 = '''l_2*a[1]'' + l_1*(a[0]''*cos(a[0]-a[1]) - a[0]'^2*sin(a[0]-a[1])) + g*sin(a[1]) = 0'''\n"
    )
    assert grade_text(file + rows).verdict == "correct"
    assert grade_text(file + rows.replace("- a[0]'^2", "- a[1]'^2")).verdict == "wrong"


def test_a_unit_with_a_prefix_is_refused():
    for number in (r"\SI{50}{\centi\metre}", r"\qty{500}{mm}", r"\SI{500}{\gram}"):
        with pytest.raises(InvalidInput, match="without units"):
            one(number + r"\ddot\theta + g\sin\theta = 0", l="0.5")
