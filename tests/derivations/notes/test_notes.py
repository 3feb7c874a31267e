"""Notes in which formulas stand among words: each shows equations that sympy proves, and a slip in one is noticed."""

import re
import tomllib
from pathlib import Path

import pytest
from mechanisms import (
    ANGLE,
    F,
    M,
    a1,
    a2,
    al,
    b,
    bobs,
    cart_pole,
    elastic,
    g,
    k,
    l,
    l1,
    l2,
    m,
    m1,
    m2,
    pendulum,
    r,
    r0,
    rd,
    rdd,
    th,
    th1,
    th2,
    w,
    w1,
    w2,
    x,
    xdd,
)
from sympy import cos, sin, symbols
from truth import Body, Mechanism, compare

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

HERE = Path(__file__).parent
NOTES = {
    name: note
    for file in ("notes.toml", "printed.toml", "sites.toml", "kinds.toml", "more_kinds.toml")
    for name, note in tomllib.loads((HERE / file).read_text(encoding="utf-8")).items()
}
DECLARED = tomllib.loads((HERE / "mechanisms.toml").read_text(encoding="utf-8"))
FIELDS = ("kinetic", "potential", "lagrangian", "hamiltonian")
NOTICED = ("wrong", "refused", "assumed")  # right on a condition that is said, as that the angle is counted otherwise
SLIP = re.compile(r"(?<= )[+-](?= )|\\(?:sin|cos)(?![a-z])|\\ddot(?![a-z])")
OTHER = {"+": "-", "-": "+", "\\sin": "\\cos", "\\cos": "\\sin", "\\ddot": "\\dot"}

s, c = sin(th), cos(th)
S, C = sin(th1 - th2), cos(th1 - th2)
BOBS = bobs((l1, m1), (l2, m2))
DRIVEN = {x: F}
mb, ma, la, lb, I0, d, tau, size, phase, speed = symbols("mb ma la lb I0 d tau size phase speed")
px, vx, ax, py, vy, ay = symbols("px vx ax py vy ay")
SOLVED_BELOW = l1 * (2 * m1 + m2 - m2 * cos(2 * th1 - 2 * th2))


def moved(right, up, phases):
    return Mechanism([ANGLE], [Body(m, right + l * s, up - l * c)], shifts=False, phases=phases)


def over_denominator():
    """δ = θ2 - θ1."""
    sine, cosine = -S, C
    below = (m1 + m2) * l1 - m2 * l1 * cosine**2
    first = m2 * l1 * w1**2 * sine * cosine + m2 * g * sin(th2) * cosine + m2 * l2 * w2**2 * sine
    second = -m2 * l2 * w2**2 * sine * cosine
    second += (m1 + m2) * (g * sin(th1) * cosine - l1 * w1**2 * sine - g * sin(th2))
    return [a1 - (first - (m1 + m2) * g * sin(th1)) / below, a2 - second / (l2 / l1 * below)]


def over_twice():
    first = -g * (2 * m1 + m2) * sin(th1) - m2 * g * sin(th1 - 2 * th2) - 2 * S * m2 * (w2**2 * l2 + w1**2 * l1 * C)
    second = 2 * S * (w1**2 * l1 * (m1 + m2) + g * (m1 + m2) * cos(th1) + w2**2 * l2 * m2 * C)
    return [a1 - first / SOLVED_BELOW, a2 - second / (SOLVED_BELOW * l2 / l1)]


def solved_cart(sign):
    """From down with sign 1, from up with -1."""
    below = M + m * s**2
    return [
        xdd - (F + m * l * w**2 * s + sign * m * g * s * c) / below,
        al + (F * c + m * l * w**2 * s * c + sign * (M + m) * g * s) / (l * below),
    ]


def cart(sign):
    return [(M + m) * xdd + m * l * al * c - m * l * w**2 * s - F, xdd * c + l * al + sign * g * s]


SHOWN = {
    "double": (
        BOBS,
        [
            (m1 + m2) * l1 * a1 + m2 * l2 * a2 * C + m2 * l2 * w2**2 * S + (m1 + m2) * g * sin(th1),
            l2 * a2 + l1 * a1 * C - l1 * w1**2 * S + g * sin(th2),
        ],
    ),
    "double, solved over a denominator": (BOBS, over_denominator()),
    "double, solved over 2 m1 + m2": (BOBS, over_twice()),
    "pendulum": (pendulum(), [al + g / l * s]),
    "damped": (pendulum(forces={th: -b * w}), [m * l**2 * al + b * w + m * g * l * s]),
    "damped and driven": (pendulum(forces={th: tau - b * w}), [m * l**2 * al + b * w + m * g * l * s - tau]),
    "elastic": (
        elastic(k * (r - r0) ** 2 / 2),
        [m * rdd - m * r * w**2 - m * g * c + k * (r - r0), r * al + 2 * rd * w + g * s],
    ),
    "cart": (cart_pole(forces=DRIVEN), cart(1)),
    "cart upwards": (cart_pole(up=True, forces=DRIVEN), cart(-1)),
    "cart, solved": (cart_pole(forces=DRIVEN), solved_cart(1)),
    "cart upwards, solved": (cart_pole(up=True, forces=DRIVEN), solved_cart(-1)),
    "two masses on a rod": (
        Mechanism([ANGLE], [Body(ma, la * s, -la * c), Body(mb, lb * s, -lb * c)]),
        [(ma * la**2 + mb * lb**2) * al + (ma * la + mb * lb) * g * s],
    ),
    "body about its pivot": (
        Mechanism([ANGLE], [Body(m, d * s, -d * c, I0 - m * d**2, th)]),
        [I0 * al + m * g * d * s],
    ),
    "circle": (
        moved(size * cos(phase), size * sin(phase), {phase: speed}),
        [l * al + g * s - size * speed**2 * cos(th - phase)],
    ),
    "support upwards": (
        moved(0, size * cos(phase), {phase: speed}),
        [l * al + (g - size * speed**2 * cos(phase)) * s],
    ),
    "moved support": (
        moved(px, py, {px: vx, vx: ax, py: vy, vy: ay}),
        [l * al + ax * c + (g + ay) * s],
    ),
}


def written(name, changed=None):
    """The note as a file; ``changed``: a field and its text in place of the note's."""
    note = NOTES[name]
    fields = {field: note[field] for field in (*FIELDS, "equations") if field in note} | (changed or {})
    declared, bodies, tables = DECLARED[note["mechanism"]].partition("[[bodies]]")
    energies = "".join(f"{field} = {quoted(text)}\n" for field, text in fields.items() if field != "equations")
    rows = f"\n[equations]\n1 = {quoted(fields['equations'])}\n" if "equations" in fields else ""
    return declared + energies + bodies + tables + rows


def quoted(text):
    return '"""' + text.replace("\\", "\\\\").replace('"', '\\"') + '"""'


def outcome(text):
    try:
        found = grade_text(text)
    except InvalidInput:
        return "refused"
    return "assumed" if found.assumes else found.verdict


@pytest.mark.slow
@pytest.mark.parametrize("shown", SHOWN)
def test_what_the_notes_show_is_right(shown):
    mechanism, rows = SHOWN[shown]
    assert compare(rows, mechanism) is None


@pytest.mark.parametrize("name", NOTES)
def test_a_note_is_read_and_right(name):
    assert NOTES[name]["shows"] in SHOWN
    found = grade_text(written(name))
    assert (found.verdict, tuple(found.assumes)) == ("correct", ())


def slips(name):
    """The note with one sign, wave or dot changed, each in turn."""
    for field in (*FIELDS, "equations"):
        text = NOTES[name].get(field, "")
        stated = text.partition(NOTES[name].get("mentions", "\0"))[0]  # what stands behind says nothing
        for found in SLIP.finditer(stated):
            if _is_mentioned(text, found.start()):
                continue
            yield written(name, {field: text[: found.start()] + OTHER[found[0]] + text[found.end() :]}), found.start()


def _is_mentioned(text, at):
    """Whether a letter with dots is only named in a sentence, as in "for $\\ddot x$ and"."""
    before = text[:at]
    inside = before.count("$") % 2 == 1
    return inside and "=" not in text[at : text.find("$", at)] + before[before.rfind("$") :]


@pytest.mark.slow
@pytest.mark.sweep
@pytest.mark.parametrize("name", NOTES)
def test_a_slip_in_a_note_is_noticed(name):
    accepted = [place for text, place in slips(name) if outcome(text) not in NOTICED]
    assert not accepted


PENDULUM = DECLARED["pendulum"] + "\n[equations]\n1 = '''{}'''\n"


@pytest.mark.parametrize(
    ("text", "passed"),
    [
        (r"Let $\lambda = m l$. Then $$\ddot\theta = -\frac{g}{l}\sin\theta$$", r"\lambda = m l"),
        (r"$$\ddot\theta = -\frac{g}{l}\sin\theta$$ where $c_1 = \sin\theta$", r"c_1 = \sin\theta"),
        (r"The equilibrium is $\theta = 0$. $$\ddot\theta = -\frac{g}{l}\sin\theta$$", "theta = 0"),
    ],
)
def test_what_no_equation_needs_is_passed_over_and_said(text, passed):
    found = grade_text(PENDULUM.format(text))
    assert found.verdict == "correct"
    assert any("Passed over" in note and passed in note for note in found.notes)
    assert grade_text(PENDULUM.format(text.replace(r"\frac{g}{l}", r"\frac{g}{2l}"))).verdict == "wrong"


@pytest.mark.parametrize("name", ["german-mit", "newton-radial", "kinetic-parts", "stage-lagrangian", "circle-rows"])
def test_the_first_slip_in_a_note_is_noticed(name):
    text, _ = next(slips(name))
    assert outcome(text) in NOTICED


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (r"Linearised, $\theta'' = -g/l \sin\theta$.", "'Linearised'"),
        (r"This is wrong: $$\ddot\theta = -\frac{g}{l}\sin\theta$$", "'wrong'"),
        (r"With $l = 1$ we get $$\ddot\theta = -g\sin\theta$$", "l is declared already"),
        (r"Let $\lambda = m l$. Then $$\dot\theta = \omega$$", "no equation needs it"),
        (r"For $\theta = 0$ we get $$\ddot\theta = -\frac{g}{l}\sin\theta$$", "what a coordinate is"),
        (r"$$m l^2\ddot\theta = -m g l\sin\theta$$ so $$\ddot\theta = -\frac{g}{2l}\sin\theta$$", "contradicts"),
        (
            r"$$\frac{\partial L}{\partial\dot\theta} = m l^2\dot\theta$$ $$\ddot\theta = -\frac{g}{l}\sin\theta$$",
            "give both",
        ),
        (r"$$T + m g\cos\theta = m l\dot\theta^2$$ $$\ddot\theta = -\frac{g}{l}\sin\theta$$", "force T is in row"),
    ],
)
def test_what_may_be_meant_otherwise_is_refused(text, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(PENDULUM.format(text))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("#strike[$ dot.double(theta) = -frac(g, l) sin(theta) $]", "not known here|words or code"),
        (
            r"$y_1 = \theta$, $y_2 = \dot\theta$ and $y_1 = \dot\theta$. "
            r"$$\dot{\mathbf{y}} = \begin{bmatrix} y_2 \\ -g/l \sin y_1 \end{bmatrix}$$",
            "y1 of the state is said to be two things",
        ),
        (
            r"$$\mathbf{y} = \begin{bmatrix} \theta \\ \dot\theta \end{bmatrix}$$ "
            r"$$\dot{\mathbf{y}} = \begin{bmatrix} y_1 \\ -g/l \sin y_1 \end{bmatrix}$$",
            "contradicts",
        ),
        (
            r"$$\begin{bmatrix} Q \\ Q \end{bmatrix} = \begin{bmatrix} m \\ l \end{bmatrix}$$",
            "stands twice in one column",
        ),
    ],
)
def test_what_a_state_or_code_leaves_open_is_refused(text, why):
    with pytest.raises(InvalidInput, match=why):
        grade_text(PENDULUM.format(text))


def test_a_force_function_is_refused_and_said_how_to_write():
    text = DECLARED["pendulum"].replace(
        "'down'", "'down'\nlagrangian = '$L = T + U = \\frac{1}{2} m l^2 \\dot\\theta^2 + m g l \\cos\\theta$'"
    )
    with pytest.raises(InvalidInput, match="Where U is a force's function, -V, leave this side out"):
        grade_text(text)


def test_gravity_is_no_field_and_what_to_write_is_said():
    with pytest.raises(InvalidInput, match=r"'gravity': no such field; \[define\] says what g is called"):
        grade_text("gravity = 'G'\n" + PENDULUM.format(r"\ddot\theta = -\frac{G}{l}\sin\theta"))


def test_two_quantities_with_one_letter_are_refused():
    text = DECLARED["damped and driven"].replace("'m'", "'M'").replace("damping = 'b'", "")
    with pytest.raises(InvalidInput, match="two quantities with one letter"):
        grade_text(text + "\n[equations]\n1 = '''M l^2 φ̈ + M g l sin φ = M(t)'''\n")


NO_NOTE = """system = "mechanism"
[[bodies]]
coordinate = "theta1"
mass = "m1"
length = "l1"
[[bodies]]
coordinate = "theta2"
mass = "m2"
length = "l2"
[equations]
1 = "theta1'' = -g/(l1**2*cos(theta1)**2*cos(theta2)**2 + l1**2*sin(theta1)**2*cos(theta2)**2 - l1**2*cos(theta2)**2)"
2 = "theta2'' = (-theta2'**2*l1**2*l2**2*m2**2*sin(theta1)**2*sin(theta2))/(l1**2*l2**2)"
"""


def test_powers_in_rows_are_no_bold_words_of_a_note():
    """A row that cannot be read is refused as the row that it is, whatever it lacks as a note."""
    with pytest.raises(InvalidInput, match="a division by zero"):
        grade_text(NO_NOTE)
