"""Lines as papers and programs lay them out: each is read as the plain line beside it, or refused."""

import pytest
from declared_mechanisms import body, mechanism, preset
from handwritten import ROW_1, ROW_2, toml

from furiko.derivations.grading.grade import grade_text
from furiko.derivations.reading.layout import equations_of, laid_out
from furiko.derivations.reading.submission import parse_submission
from furiko.models.errors import InvalidInput


def row(line, links=2, define=""):
    return parse_submission(f"{toml('n-leg', [line], links=links)}\n{define}").rows[0][1]


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("m2*w2^2*sin(t1-t2)", r"m_2\dot{\theta_2^{2}}\sin(\theta_1-\theta_2)"),
        ("m2*w2^2*sin(t1-t2)", r"m_{\mathrm{2}} \dot{\theta}_2^{\,2} \text{sin}(\theta_1-\theta_2) ."),
        ("m2*w2^2*sin(t1-t2)", r"m_2 {\mathop{\theta_2}\limits^{.}}^2 \operatorname{sin}(\theta_1 - \theta_2), \qquad"),
        ("m2*a2", r"m_2 \overset{..}{\theta_2};"),
        ("m2*a2", r"m_2 \stackrel{\cdot\cdot}{\theta_2} \\ && \ \ "),
        ("m2*a2", "m2 θ¨₂"),
        ("m2*w2", "m2 θ˙2"),
        ("m2*a2 + m1", "m2*th2'' ... theta\n + m1"),
        ("m2*a2 + m1", "m2*theta2_acc \\\n + m1"),
        ("m2*w2^2*l2", "m2*om2^2*l2"),
    ],
)
def test_layout_does_not_matter(one, other):
    assert row(f"a1 = {one}") == row(f"a1 = {other}")


def test_a_box_around_a_row():
    assert row(r"\boxed{\;\ddot\theta_1 = m_2 g.\;}") == row("a1 = m2*g")
    with pytest.raises(InvalidInput):
        row(r"\boxed{a1 = m2*g")


@pytest.mark.parametrize(
    "line", [r"a1 = \text{cos}(t1) + X", "a1 = ... as\n X", r"\boxed{a1 = X}", r"\overset{..}{y}+X"]
)
def test_columns_stay_those_of_what_was_written(line):
    assert laid_out(line).index("X") == line.index("X")


def test_all_rows_in_one_text():
    cases = rf"\begin{{cases}} {ROW_1} \\ {ROW_2} \end{{cases}}"
    for text in (cases, f"{ROW_1}\n{ROW_2}"):
        assert parse_submission(toml("n-leg", [text], links=2)).rows == tuple(
            (str(i), f) for i, (_, f) in enumerate(parse_submission(toml("n-leg", [ROW_1, ROW_2], links=2)).rows, 1)
        )
    with pytest.raises(InvalidInput, match="second equals sign"):
        row("a1 = m1 = m2")
    assert equations_of(r"M \begin{pmatrix} a = 1 \\ b = 2 \end{pmatrix}") == [
        r"M \begin{pmatrix} a = 1 \\ b = 2 \end{pmatrix}"
    ]


MATLAB = "[define]\nA = '[m1*l1 0; 0 m2*l2]'\nB = '[m1*g; -m2*g - l1*w1^2*m2]'"


def test_matlabs_matrices_and_its_division():
    found = parse_submission(toml("n-leg", [r"[a1; a2] = A \ B"], links=2) + "\n" + MATLAB)
    plain = parse_submission(toml("n-leg", ["a1 = g/l1", "a2 = -g/l2 - l1*w1^2/l2"], links=2))
    assert [f for _, f in found.rows] == [f for _, f in plain.rows]
    listed = toml("n-leg", ["[a1; a2] = H"], links=2) + '\n[define]\nH = "[1, m1].\'"'
    assert [f for _, f in parse_submission(listed).rows] == [row("a1 = 1"), row("a2 = m1")]


@pytest.mark.parametrize("matrix", ["[m1 l1; 0]", "[m1*l1 0; m2]", "[m1 - l1*g 0; 0]"])
def test_blanks_that_may_be_products_are_refused(matrix):
    with pytest.raises(InvalidInput):
        row(f"[a1; a2] = {matrix}")


def test_a_spring_has_the_authors_length_at_rest():
    for name in ("L0", "l", "l_0"):
        rows = [f"r'' = r θ'^2 - (k/m)(r - {name}) + g cos θ", "θ'' = -(2 r' θ')/r - (g/r) sin θ"]
        assert grade_text(preset("elastic-pendulum", rows)).verdict == "correct"
    with pytest.raises(InvalidInput, match="not known"):
        grade_text(preset("elastic-pendulum", ["r'' = r θ'^2 - (k/m)(r - L0 + l) + g cos θ", "θ'' = 0"]))


def test_leibniz_and_programs_rates():
    spring = [body(name="m", coordinate="r", joint="slide", along="down", mass="m", spring="k")]
    for line in ("m r'' = m g - k r", "m*r_ddot = m*g - k*r", "racc = g - k*r/m", "d^2r/dt^2 = g - k*r/m"):
        assert grade_text(mechanism(spring, [line])).verdict == "correct", line


def test_a_rate_that_the_author_defines_is_his():
    text = mechanism([body(coordinate="theta", mass="m", length="l")], ["θ'' = thetaacc"])
    assert grade_text(f"{text}\n[define]\nthetaacc = '-g/l*sin(theta)'").verdict == "correct"
