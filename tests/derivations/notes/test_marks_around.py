"""What stands around a row, bold words, lists, remarks, labels, says nothing of mechanics and takes nothing away."""

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

CART = """
system = "mechanism"
from = "up"
sense = "clockwise"
[[bodies]]
name = "cart"
coordinate = "x"
joint = "slide"
mass = "M"
[[bodies]]
coordinate = "theta"
mass = "m"
length = "l"
"""
LATEX = (
    r"(M + m)\ddot{x} + m l \ddot\theta \cos\theta - m l \dot\theta^2 \sin\theta = 0",
    r"m l^2 \ddot\theta + m l \ddot x \cos\theta - m g l \sin\theta = 0",
)
PLAIN = (
    "(M + m)*x'' + m*l*theta''*cos(theta) - m*l*theta'**2*sin(theta) = 0",
    "m*l**2*theta'' + m*l*x''*cos(theta) - m*g*l*sin(theta) = 0",
)
UNICODE = ("(M + m)ẍ + m l θ̈ cos θ - m l θ̇² sin θ = 0", "m l² θ̈ + m l ẍ cos θ - m g l sin θ = 0")
SOLVED = (
    "x'' = (m*l*theta'**2*sin(theta) - m*g*sin(theta)*cos(theta)) / (M + m*sin(theta)**2)",
    "theta'' = ((M + m)*g*sin(theta) - m*l*theta'**2*sin(theta)*cos(theta)) / (l*(M + m*sin(theta)**2))",
)
AROUND = {
    "bold headings": "**Cart:**\n\n{0}\n\n**Pole:**\n\n{1}",
    "bold words in front": "**Cart:** {0}\n\n**Pole:** {1}",
    "a list with bold words": "- **Cart**: {0}\n- **Pole**: {1}",
    "a list of stars": "* {0}\n* {1}",
    "stars of a comment": " * {0}\n * {1}",
    "remarks behind": "{0}    the row of the cart\n{1}    gravity against the cart's pull",
    "asides behind": "{0} (the row of the cart)\n{1} (gravity and the pull)",
}


def judged(rows):
    return grade_text(f"{CART}[equations]\n1 = '''\n{rows}\n'''\n").verdict


@pytest.mark.parametrize("rows", [PLAIN, UNICODE], ids=["powers with stars", "high figures"])
@pytest.mark.parametrize("how", AROUND)
def test_no_power_is_taken_for_the_mark_of_bold_words(how, rows):
    assert judged(AROUND[how].format(*rows)) == "correct"
    assert judged(AROUND[how].format(rows[0].replace("(M + m)", "M"), rows[1])) == "wrong"


@pytest.mark.parametrize("behind", ["theta' 2 sin(theta)", "theta'2 sin(theta)", "sin(theta) theta' 2"])
def test_a_figure_behind_a_factor_may_have_been_high(behind):
    with pytest.raises(InvalidInput, match=r"2 behind a factor: a power printed high, or a factor\?"):
        judged(f"(M + m) x'' + m l theta'' cos(theta) - m l {behind} = 0\n\n{PLAIN[1]}")


@pytest.mark.parametrize("rows", [PLAIN, UNICODE], ids=["powers with stars", "high figures"])
def test_dashes_in_front_of_all_rows_may_be_signs(rows):
    with pytest.raises(InvalidInput, match="a dash in front of every line: the mark of a list, or a minus sign"):
        judged("- {}\n- {}".format(*rows))


def test_a_dash_in_front_of_an_acceleration_alone_is_the_mark_of_a_list():
    assert judged("- {}\n- {}".format(*SOLVED)) == "correct"
    assert judged("- {}\n- {}".format(*SOLVED).replace("- m*l", "+ m*l")) == "wrong"


def test_a_fraction_in_brackets_over_two_lines_is_no_matrix():
    rows = (
        "x'' = [m*l*theta'^2*sin(theta) - m*g*sin(theta)*cos(theta)] /\n      [M + m*sin(theta)^2]\n\n"
        "theta'' = [(M + m)*g*sin(theta) - m*l*theta'^2*sin(theta)*cos(theta)] /\n          [l*(M + m*sin(theta)^2)]"
    )
    assert judged(rows) == "correct"
    assert judged(rows.replace("(M + m)*g", "M*g")) == "wrong"


@pytest.mark.parametrize("heading", ["### Non-Linear System Equations", "Non-linear model of the cart"])
def test_non_linear_denies_nothing(heading):
    assert judged(f"{heading}\n1. **Cart:** ${LATEX[0]}$\n2. **Pole:** ${LATEX[1]}$") == "correct"


def test_linear_denies():
    with pytest.raises(InvalidInput, match="'Linear'"):
        judged(f"### Linear System Equations\n1. **Cart:** ${LATEX[0]}$\n2. **Pole:** ${LATEX[1]}$")


@pytest.mark.parametrize(
    "how",
    [
        r"\begin{{align}} {0}, \quad \text{{(of \eqref{{a}})}}\\ {1}. \quad \text{{(of \eqref{{b}})}} \end{{align}}",
        r"$${0} \quad \text{{(Eq. 1)}}$$ $${1} \quad \text{{(Eq. 2)}}$$",
        r"$$(Eq.\; 1)\qquad {0}$$" + "\n" + r"$$(Eq.\; 2)\qquad {1}$$",
        "${{e.block`\\begin{{aligned}} {0} \\\\ {1} \\end{{aligned}}`}}",
        "1. $x : {0}$ \\\n2. $\\theta : {1}$",
    ],
    ids=["where from", "numbers in words", "numbers in front", "Observable", "labels within the dollars"],
)
def test_numbers_and_labels_of_rows(how):
    assert judged(how.format(*LATEX)) == "correct"
    assert judged(how.format(LATEX[0].replace("(M + m)", "M"), LATEX[1])) == "wrong"


def test_an_equation_in_two_displays():
    one, two = LATEX[0].split("=")
    assert judged(f"$${one}$$$$={two}$$\n$${LATEX[1]}$$") == "correct"
    assert judged(f"$${one}$$$$={two} + m g$$\n$${LATEX[1]}$$") == "wrong"


def test_displays_without_fractions_are_no_program():
    rows = "1.  **(a)**:\n    $$\n    {}\n    $$\n2.  **(b)**:\n    $$\n    {}\n    $$"
    assert judged(rows.format(*LATEX)) == "correct"


def test_a_sentence_says_what_a_letter_is():
    rows = (
        "we derive two coupled equations for the accelerations (where S = sin θ):\n"
        "• x'' = (m*l*theta'^2*S - m*g*S*cos(theta)) / (M + m*S^2)\n"
        "• theta'' = ((M + m)*g*S - m*l*theta'^2*S*cos(theta)) / (l*(M + m*S^2))"
    )
    assert judged(rows) == "correct"
    assert judged(rows.replace("S = sin", "S = cos")) == "wrong"


MATRICES = {
    "over two lines": "| M+m   m*l*cos(theta) | | x''     |   | {}*l*theta'^2*sin(theta) |\n"
    "| m*l*cos(theta)  m*l^2 | | theta'' | = | m*g*l*sin(theta)            |",
    "in one line": "|M+m, m*l*cos(theta); m*l*cos(theta), m*l^2| |x''; theta''| = "
    "|{}*l*theta'^2*sin(theta); m*g*l*sin(theta)|",
    "with blanks": "|M+m m*l*cos(θ); m*l*cos(θ) m*l²| |ẍ; θ̈| = |{} l θ̇² sin θ; m g l sin θ|",
}


@pytest.mark.parametrize("how", MATRICES)
def test_matrices_in_plain_bars(how):
    assert judged(MATRICES[how].format("m")) == "correct"
    assert judged(MATRICES[how].format("2*m")) == "wrong"


@pytest.mark.parametrize("wave", [r"\sec(\theta)", r"\sec\theta", r"\frac{1}{\sin\theta}\tan\theta"])
def test_the_secant_is_one_over_the_cosine(wave):
    row = rf"{wave}\cos\theta ((M + m)\ddot{{x}} + m l \ddot\theta \cos\theta - m l \dot\theta^2 \sin\theta) = 0"
    assert judged(f"$${row}$$\n$${LATEX[1]}$$") == "correct"
    assert judged(f"$${row.replace('(M + m)', 'M')}$$\n$${LATEX[1]}$$") == "wrong"


def test_the_cosecant_and_the_cotangent():
    rows = [
        r"\csc\theta \left( m l \ddot\theta + m \ddot x \cos\theta \right) = m g",
        r"(M + m)\ddot{x} \cot\theta + m l \ddot\theta \cos\theta \cot\theta - m l \dot\theta^2 \cos\theta = 0",
    ]
    assert judged(f"$${rows[1]}$$\n$${rows[0]}$$") == "correct"
    assert judged(f"$${rows[1]}$$\n$${rows[0]} \\cot\\theta$$") == "wrong"


def test_strings_that_a_program_puts_together():
    rows = '"law": (\n    "{};"\n    " {}   (倒立摆两体方程)"\n),'
    assert judged(rows.format(*PLAIN)) == "correct"
    assert judged(rows.format(PLAIN[0].replace("(M + m)", "M"), PLAIN[1])) == "wrong"


def test_an_index_at_once_before_a_letter_is_no_force_of_a_hinge():
    rows = (
        r"$$N_x = m\ddot{x} + ml\ddot\theta\cos\theta - ml\dot\theta^2\sin\theta$$"
        "\n"
        r"$$N_y = mg - ml(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)$$"
        "\n"
        r"$$\begin{align} M\ddot{x} &= -N_x \\ &= -m\ddot{x} - ml\ddot\theta\cos\theta + ml\dot\theta^2\sin\theta"
        r" \end{align}$$"
        "\n"
        r"$$0 = N_yl\sin\theta - N_xl\cos\theta$$"
    )
    assert judged(rows) == "correct"
    assert judged(rows.replace("= N_yl", "= 2N_yl")) == "wrong"


DRAWN = """
       m l (θ'^2 sin θ - θ'' cos θ)
x'' = ---------------------------------
                   M + m

      g sin θ - x'' cos θ
θ'' = -------------------
               l
"""
NESTED = """
//                          ( m l θ'^2 sin θ )
//        g sin θ - cos θ   |----------------|
//                          (      M + m     )
// θ'' = --------------------------------------
//                 (      m cos^2 θ  )
//               l | 1 - ------------|
//                 (        M + m    )

//        m l (θ'^2 sin θ - θ'' cos θ)
// x'' = -----------------------------
//                  M + m
"""


def test_fractions_drawn_over_lines():
    assert judged(DRAWN) == "correct"
    assert judged(DRAWN.replace("M + m", "M - m")) == "wrong"


def test_fractions_within_fractions_and_tall_brackets():
    assert judged(NESTED) == "correct"
    assert judged(NESTED.replace("1 - ---", "2 - ---")) == "wrong"


@pytest.mark.parametrize(
    "drawn",
    [
        "          2\n      θ'  m l\nx'' = -----------\n        M + m",
        "               2\n      m l θ'  sin θ\nx'' = -------------\n          M + m",
        "                   2\n      m l sin θ   θ'\nx'' = ----------\n          M + m",
    ],
    ids=["a power above", "a power above its rate", "more than the bar covers"],
)
def test_what_else_stands_above_a_bar_is_refused(drawn):
    with pytest.raises(InvalidInput, match="printed on several lines"):
        judged(f"{drawn}\n\nθ'' = (g sin θ - x'' cos θ)/l")
