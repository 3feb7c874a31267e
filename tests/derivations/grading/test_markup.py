# ruff: noqa: E501 -- formulas stand on one line, as on their pages
r"""Formulas in pages, markups, mails and sentences: each in words that no collection has, right, wrong, and hostile."""

import time

import pytest

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

ONE = "system = 'mechanism'\nfrom = 'down'\n[[bodies]]\ncoordinate = 'theta'\nmass = 'm'\nlength = 'l'\n[equations]\n1 = '''\n{}\n'''\n"
TWO = "system = 'mechanism'\nfrom = 'down'\n" + "".join(
    f"[[bodies]]\ncoordinate = 'q{k}'\nmass = 'm{k}'\nlength = 'l{k}'\n" for k in (1, 2)
) + "[equations]\n1 = '''\n{}\n'''\n"  # fmt: skip
R1 = "(m1+m2) l1 q1'' + m2 l2 (q2'' cos(q1-q2) + q2'^2 sin(q1-q2)) + (m1+m2) g sin q1 = 0"
R2 = "l2 q2'' + l1 (q1'' cos(q1-q2) - q1'^2 sin(q1-q2)) + g sin q2 = 0"
W2 = R2.replace("- q1'", "+ q1'")
MATH = '<math xmlns="http://www.w3.org/1998/Math/MathML">{}</math>'
SECOND = "<mfrac><mrow><msup><mi>d</mi><mn>2</mn></msup><mi>θ</mi></mrow><mrow><mi>d</mi><msup><mi>t</mi><mn>2</mn></msup></mrow></mfrac>"
G_OVER_L = "<mfrac><mi>g</mi><mi>l</mi></mfrac><mi>sin</mi><mo>(</mo><mi>θ</mi><mo>)</mo><mo>=</mo><mn>0</mn>"
HAMILTON = r"\dot\theta = SIGN\frac{\partial H}{\partial p} = \frac{p}{ml^2} \\ \dot p = -\frac{\partial H}{\partial \theta} = -mgl\sin\theta"


def one(text):
    return grade_text(ONE.format(text)).verdict


def two(text):
    return grade_text(TWO.format(text)).verdict


RIGHT = [
    "<div>l<sup>2</sup> &theta;'' + g l sin&nbsp;&theta; = 0</div>",
    MATH.format(SECOND + "<mo>+</mo>" + G_OVER_L),
    MATH.format(
        "<mi>l</mi><msup><mi>&theta;</mi><mo>″</mo></msup><mo>=</mo><mo>−</mo><mi>g</mi><mi>sin</mi><mi>&theta;</mi>"
    ),
    MATH.format(
        "<mi>l</mi><mover><mi>θ</mi><mo>¨</mo></mover><mo>+</mo><mn>2</mn><mfrac><mi>g</mi><mn>2</mn></mfrac><mi>sin</mi><mi>θ</mi><mo>=</mo><mn>0</mn>"
    ),
    "$ l dot.double(theta) = -g sin(theta) $",
    "$ dot.double(theta) + frac(g, l) sin theta = 0 $ <pendulum>",
    "`l ddot theta + g sin theta = 0`",
    "`ddot(theta) = - frac(g)(l) sin(theta)`",
    "l theta^(..) + g sin theta = 0",
    "> l theta''\n>   + g sin(theta) = 0",
    "> > l theta'' = - g sin(theta)",
    "Newton gives us\n\\[ ml\\ddot\\theta = -mg\\sin\\theta. \\]",
    "運動方程式は\n$$ l\\ddot\\theta + g\\sin\\theta = 0 $$\nとなる。",
    "Bewegungsgleichung:\nl theta'' + g sin(theta) = 0",
    r"ml^2\ddot\theta = -mgl\sin\theta \iff \ddot\theta = -\frac{g}{l}\sin\theta",
    HAMILTON.replace("SIGN", ""),
    r"{\displaystyle l{\ddot {\theta }}+g\sin \theta =0}",
    r"\overset{\curvearrowright}{O}: -ml^2\ddot\theta = mgl\sin\theta",
]
WRONG = [
    "<div>l &theta;'' &minus; g sin &theta; = 0</div>",
    MATH.format(SECOND + "<mo>-</mo>" + G_OVER_L),
    "$ dot.double(theta) + frac(l, g) sin theta = 0 $",
    "`l ddot theta = g sin theta`",
    "l theta^(..) = g sin theta",
    "> l theta'' = g sin(theta)",
    "We find $$l\\ddot\\theta = g\\sin\\theta$$",
    r"ml^2\ddot\theta = -mgl\sin\theta \Rightarrow \ddot\theta = -\frac{l}{g}\sin\theta",
    r"ml^2\ddot\theta = mgl\sin\theta \Rightarrow \ddot\theta = -\frac{g}{l}\sin\theta",
    HAMILTON.replace("SIGN", "").replace("-mgl", "mgl"),
    r"{\displaystyle l{\ddot {\theta }}-g\sin \theta =0}",
]
REFUSED = [
    ("<p>l &theta;'' + <s>2</s> g sin &theta; = 0</p>", "<s> of a page is not read"),
    ("<p>l &theta;'' + <span style='display:none'>2</span> g sin &theta; = 0</p>", "hidden"),
    ("<p>l<sup>2<sub>1</sub></sup> &theta;'' + g sin &theta; = 0</p>", "inside <sup>"),
    ("<script>alert(1)</script><p>l &theta;'' + g sin &theta; = 0</p>", "<script> of a page"),
    ("<!DOCTYPE m [<!ENTITY a 'x'>]>" + MATH.format("<mi>&a;</mi><mo>=</mo><mn>0</mn>"), "document type"),
    (
        MATH.format("<menclose notation='updiagonalstrike'><mn>2</mn></menclose><mi>l</mi><mo>=</mo><mn>0</mn>"),
        "<menclose>",
    ),
    (MATH.format("<mfrac linethickness='0'><mi>g</mi><mi>l</mi></mfrac><mo>=</mo><mn>0</mn>"), "without a line"),
    (MATH.format("<mi>l</mi"), "not well-formed"),
    (MATH.format("<mrow>" * 300 + "<mi>l</mi>" + "</mrow>" * 300), "in one another"),
    ('$ dot.double(theta) + frac(g, l) sin theta = 0 "for small angles" $', "words or code in a Typst equation"),
    ("`l ddot theta + g sin theta = 0` if `theta` is small", "words between the formulas"),
    ("I wrote\n> l theta'' = -g sin(theta)", "is not known here"),
    ("This is wrong: $$l\\ddot\\theta = -g\\sin\\theta$$", "a sentence says 'wrong'"),
    ("With $g=0$ we find $$l\\ddot\\theta = -g\\sin\\theta$$", "has formulas too"),
    ("For small angles:\nl theta'' + g sin(theta) = 0", "a heading says 'small'"),
    (HAMILTON.replace("SIGN", "-"), "partial is not read"),
]


@pytest.mark.parametrize("text", RIGHT)
def test_right_ones_are_right(text):
    assert one(text) == "correct"


@pytest.mark.parametrize("text", WRONG)
def test_wrong_ones_are_wrong(text):
    assert one(text) == "wrong"


@pytest.mark.parametrize(("text", "says"), REFUSED)
def test_what_may_change_the_meaning_is_refused(text, says):
    begun = time.perf_counter()
    with pytest.raises(InvalidInput, match=says):
        one(text)
    assert time.perf_counter() - begun < 2  # s, of a hostile input


@pytest.mark.parametrize("numbers", [("(1)", "(2)"), ("1.", "2."), ("(i)", "(ii)"), ("(a)", "(b)"), ("(I)", "(II)")])
def test_numbers_in_front_of_rows(numbers):
    assert two(f"{numbers[0]} {R1}\n{numbers[1]} {R2}") == "correct"
    assert two(f"{numbers[0]} {R1}\n{numbers[1]} {W2}") == "wrong"


def test_a_number_that_may_be_a_factor_is_refused():
    with pytest.raises(InvalidInput, match="or a factor"):
        two(f"(2) {R1}\n(2) {R2}")
    file = TWO.replace("'m1'", "'a'").replace("'m2'", "'b'")
    with pytest.raises(InvalidInput, match="its number, or the quantity a"):
        grade_text(file.format(f"(a) {R1}\n(b) {R2}".replace("m1", "a").replace("m2", "b")))


def test_headings_above_rows():
    assert two(f"Upper bob:\n{R1}\nLower bob:\n{R2}") == "correct"
    assert two(f"Upper bob:\n{R1}\nLower bob:\n{W2}") == "wrong"


def test_indices_of_a_page_and_a_matrix_of_typst():
    page = [row.replace("'^2", "'<sup>2</sup>").replace("-", "&minus;") for row in (R1, R2, W2)]
    for k in "12":
        page = [
            row.replace(f"q{k}", f"<i>q</i><sub>{k}</sub>")
            .replace(f"l{k}", f"l<sub>{k}</sub>")
            .replace(f"m{k}", f"m<sub>{k}</sub>")
            for row in page
        ]
    assert two(f"<ol><li>{page[0]}</li><li>{page[1]}</li></ol>") == "correct"
    assert two(f"<p>{page[0]}<br/>{page[2]}</p>") == "wrong"
    matrix = "$ mat((m1+m2) l1, m2 l2 cos(q_1 - q_2); l1 cos(q_1-q_2), l2) vec(dot.double(q)_1, dot.double(q)_2) = "
    matrix += "vec(-m2 l2 dot(q)_2^2 sin(q_1-q_2) - (m1+m2) g sin q_1, l1 dot(q)_1^2 sin(q_1-q_2) - g sin q_2) $"
    assert two(matrix) == "correct"
    assert two(matrix.replace("l1 dot(q)_1^2", "l1 dot(q)_2^2")) == "wrong"
