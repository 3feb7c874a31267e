# ruff: noqa: E501 -- equations stand on one line, as they are handed in
"""What a derivation may mean: masses, moments of inertia, angles, numbers, matrices, combined rows.

The equations are textbooks' or worked out by hand from T and U beside them; none is printed by furiko.
"""

import pytest
from handwritten import RELATIVE, ROW_1, ROW_2, SHIKI_1_4, lagrangian, toml

from furiko.derivations.grading.grade import grade_text
from furiko.derivations.reading.pinned import Pinned
from furiko.models.errors import InvalidInput

LEFT_1, LEFT_2 = ROW_1.split("=")[0], ROW_2.split("=")[0]


def graded(system, rows, **fields):
    return grade_text(toml(system, rows, **fields))


def respelled(table):
    rows = []
    for line in (ROW_1, ROW_2):
        row = line
        for old, new in table:
            row = row.replace(old, new)
        rows.append(row)
    return rows


def is_plain(answer):
    return answer.verdict == "correct" and answer.assumes == ()


# Rows that were combined --------------------------------------------------------------------------------------------

COMBINED = {
    "a rate times row 2 added to row 1": [f"{LEFT_1} + w1*({LEFT_2}) = 0", ROW_2],
    "an angle's cosine and sums of rates": [f"cos(t1)*({LEFT_1}) - (w1+w2)^2*({LEFT_2}) = 0", ROW_2],
    "both rows combined": [f"({LEFT_1})*l1 + l2*({LEFT_2}) = 0", f"({LEFT_1})*w2 - sin(t2)*({LEFT_2}) = 0"],
    "all times a rate": [f"w1*({LEFT_1}) = 0", f"w2*({LEFT_2}) = 0"],
}


@pytest.mark.parametrize("rows", COMBINED.values(), ids=COMBINED.keys())
def test_rows_may_be_combined_with_any_factors(rows):
    assert is_plain(graded("n-leg", rows))


def test_energy_differentiated_is_right_only_while_it_moves():
    answer = graded("rod-chain", ["l1^2/3*w1*a1 + g*l1/2*sin(t1)*w1 = 0"])
    assert is_plain(answer)
    assert "only while the system moves" in answer.notes[0]


@pytest.mark.parametrize(
    "rows",
    [
        [f"{LEFT_1} + w1*({LEFT_2}) = 0", f"w1*({LEFT_2}) + {LEFT_1} = 0"],  # one row twice
        [f"{LEFT_1} + w1*({LEFT_2}) + w1 = 0", ROW_2],
        [f"{LEFT_1} + w1*({LEFT_2.replace('g*', '2*g*')}) = 0", ROW_2],
        [f"({LEFT_1})*a1 = 0", ROW_2],  # also solved by a1 = 0
        [f"({LEFT_1})*cos(t1) = 0", "0 = 0"],
    ],
)
def test_wrong_combinations_are_wrong(rows):
    assert graded("n-leg", rows).verdict == "wrong"


# Masses and moments of inertia --------------------------------------------------------------------------------------

# Uniform rods of independent masses: T = ½ (m1/3 + m2) l1² ω1² + ½ m2 l1 l2 ω1 ω2 cos + m2 l2² ω2²/6
OWN_1 = "(m1/3+m2)*l1^2*a1 + m2*l1*l2/2*(a2*cos(t1-t2)+w2^2*sin(t1-t2)) + (m1/2+m2)*g*l1*sin(t1) = 0"
OWN_2 = "m2*l2^2/3*a2 + m2*l1*l2/2*(a1*cos(t1-t2)-w1^2*sin(t1-t2)) + m2*g*l2/2*sin(t2) = 0"
ONE_DENSITY = [  # right only where m1 l2 = m2 l1
    [OWN_1.replace("m2*l1*l2/2", "m1*l2^2/2"), OWN_2],
    [OWN_1.replace("(m1/2+m2)*g*l1", "(m1*l1/2+m1*l2)*g"), OWN_2],
    [OWN_1, OWN_2.replace("m2*g*l2/2", "m1*g*l2^2/(2*l1)")],
]


def test_rods_of_independent_masses_are_right_without_a_condition():
    assert is_plain(graded("rod-chain", [OWN_1, OWN_2]))
    assert is_plain(graded("rods", [OWN_1, OWN_2]))


@pytest.mark.parametrize("rows", ONE_DENSITY)
def test_what_rests_on_one_density_says_so(rows):
    answer = graded("rod-chain", rows)
    assert answer.verdict == "correct"
    assert "m = ρ l" in answer.assumes[0]
    assert "m = ρ l" in answer.text()
    assert "m = ρ l" in answer.text("ja")
    own = graded("rods", rows)
    assert own.verdict == "wrong"


def test_the_term_that_rests_on_one_density_is_named():
    own = graded("rods", ONE_DENSITY[0])
    assert {(f.found, f.expected) for f in own.findings} == {
        ("1/2*m1*l2^2*a2*cos(t1-t2)", "1/2*m2*l1*l2*a2*cos(t1-t2)"),
        ("1/2*m1*l2^2*w2^2*sin(t1-t2)", "1/2*m2*l1*l2*w2^2*sin(t1-t2)"),
    }
    assert "1/2*m1*l2^2" in " ".join(graded("rod-chain", ONE_DENSITY[0]).notes)


def test_with_a_density_in_the_text_nothing_is_assumed():
    assert is_plain(graded("rod-chain", [OWN_1.replace("m1", "(rho*l1)").replace("m2", "(rho*l2)"), OWN_2]))


# The acrobot: I about the joints; and the same with I about the centres of mass
PIVOT = [
    "(I1 + I2 + m2*l1^2 + 2*m2*l1*lc2*cos(t2))*a1 + (I2 + m2*l1*lc2*cos(t2))*a2 - 2*m2*l1*lc2*sin(t2)*w1*w2"
    " - m2*l1*lc2*sin(t2)*w2^2 + m1*g*lc1*sin(t1) + m2*g*(l1*sin(t1) + lc2*sin(t1+t2)) = 0",
    "(I2 + m2*l1*lc2*cos(t2))*a1 + I2*a2 + m2*l1*lc2*sin(t2)*w1^2 + m2*g*lc2*sin(t1+t2) = 0",
]
CENTRE = [row.replace("I1", "(I1 + m1*lc1^2)").replace("I2", "(I2 + m2*lc2^2)") for row in PIVOT]


@pytest.mark.slow
@pytest.mark.parametrize("system", ["rod-chain", "rods", "links"])
def test_moments_of_inertia_and_centres_stay_the_authors(system):
    answer = graded(system, PIVOT, angles="relative")
    assert answer.verdict == "correct"
    assert "about the joints" in answer.assumes[0]
    assert is_plain(graded(system, CENTRE, angles="relative"))
    wrong = [PIVOT[0].replace("2*m2*l1*lc2*cos", "m2*l1*lc2*cos"), PIVOT[1]]
    assert graded(system, wrong, angles="relative").verdict == "wrong"


def test_a_moment_of_inertia_may_be_the_one_of_a_uniform_rod():
    answer = graded("rod-chain", ["(I1 + m1*l1^2/6 - m1*l1^2/6)*4*a1 + m1*g*l1/2*sin(t1) = 0"])
    assert answer.verdict == "correct"  # 4 I = m l²/3 only with I = m l²/12
    assert "m l²/12" in answer.assumes[0]


# Angles -------------------------------------------------------------------------------------------------------------

UP = [ROW_1.replace("+ (m1+m2)*g", "- (m1+m2)*g"), ROW_2.replace("+ m2*g", "- m2*g")]
HORIZONTAL = [row.replace("sin(t1)", "cos(t1)").replace("sin(t2)", "cos(t2)") for row in (ROW_1, ROW_2)]
CONVENTIONS = {
    "from the upward vertical": (UP, "upward vertical", {"from": "up"}),
    "from the horizontal": (HORIZONTAL, "horizontal", {"from": "horizontal"}),
    "from the horizontal, downwards": (
        [row.replace("+ (m1+m2)*g", "- (m1+m2)*g").replace("+ m2*g", "- m2*g") for row in HORIZONTAL],
        "downwards positive", {"from": "horizontal", "sense": "clockwise"},
    ),
    "relative": (RELATIVE, "from the link above", {"angles": "relative"}),
    "the second the other way round": (
        # the same with t2 → -t2, and the second row times -1
        [row.replace("a2", "(-a2)").replace("w2", "(-w2)").replace("sin(t2)", "(-sin(t2))").replace("t1+t2", "t1-t2")
         for row in RELATIVE], "clockwise", {},
    ),
}  # fmt: skip


@pytest.mark.parametrize(("rows", "said", "declared"), CONVENTIONS.values(), ids=CONVENTIONS.keys())
def test_another_convention_is_right_on_that_condition(rows, said, declared):
    answer = graded("n-leg", rows)
    assert answer.verdict == "correct"
    assert said in answer.assumes[0]
    assert answer.text().splitlines()[-1] != "Correct."
    assert grade_text(toml("n-leg", rows), pinned=Pinned("n-leg", 2)).verdict == "wrong"
    if declared:
        written = "\n".join(f"{name} = '{value}'" for name, value in declared.items())
        assert is_plain(grade_text(f"{written}\n{toml('n-leg', rows)}"))


def test_gravity_with_the_wrong_sign_is_said_beside_the_other_convention():
    """T + U for T - U gives the equations from the upward vertical: both are said."""
    answer = graded("n-leg", UP)
    assert {answer.mistakes[0].cause, *(x.split(":")[0] for x in answer.mistakes[0].also)} >= {"sum-for-difference"}
    formula = SHIKI_1_4.replace("+ m_1gl_1", "- m_1gl_1").replace("+ m_2g(", "- m_2g(")
    assert "upward" in grade_text(lagrangian("n-leg", 2, formula)).assumes[0]


def test_a_declared_convention_is_not_exchanged():
    assert grade_text("from = 'down'\n" + toml("n-leg", UP)).verdict == "wrong"
    assert graded("n-leg", RELATIVE, angles="absolute").verdict == "wrong"


# Numbers ------------------------------------------------------------------------------------------------------------


def numbers(l1, l2, m1, m2, g):
    return respelled([("l1", l1), ("l2", l2), ("m1", m1), ("m2", m2), ("g", g)])


SPECIAL = {
    "all one but gravity": (numbers("1", "1", "1", "1", "g"), ["l1 = l2 = 1", "m1 = m2"]),
    "all numbers": (numbers("0.7", "1.2", "2", "0.5", "9.81"), ["g = 9.81", "l1 = 0.7", "l2 = 1.2", "m1 : m2 = 4 : 1"]),
    "masses one": (numbers("l1", "l2", "1", "1", "g"), ["m1 = m2"]),
    "gravity one too": (numbers("1", "1", "1", "1", "1"), ["g = 1"]),
    "masses of three to one": (numbers("l1", "l2", "3", "1", "g"), ["m1 : m2 = 3 : 1"]),
    "the second as long as the first": (numbers("l1", "l1", "m1", "m1", "g"), ["l2 = l1", "m2 = m1"]),
}


@pytest.mark.slow
@pytest.mark.parametrize(("rows", "said"), SPECIAL.values(), ids=SPECIAL.keys())
def test_numbers_are_a_special_case_that_is_said(rows, said):
    answer = graded("n-leg", rows)
    assert answer.verdict == "correct", answer.text()
    assert all(part in answer.assumes[0] for part in said), answer.assumes
    assert grade_text(toml("n-leg", rows), pinned=Pinned()).verdict == "wrong"


@pytest.mark.slow
@pytest.mark.parametrize(
    "rows",
    [
        [numbers("1", "1", "1", "1", "g")[0].replace("2^2", "2*w1"), numbers("1", "1", "1", "1", "g")[1]],
        [numbers("0.7", "1.2", "2", "0.5", "9.81")[0], numbers("0.8", "1.2", "2", "0.5", "9.81")[1]],
        numbers("1", "1", "1", "-1", "g"),  # a negative mass
        ["a1 + 3*g/(2*l1)*sin(t1) = 0", "a2 + g*sin(t2) = 0"],
    ],
)
def test_numbers_that_no_mechanism_has_are_wrong(rows):
    assert graded("n-leg", rows).verdict == "wrong"


# Notation -----------------------------------------------------------------------------------------------------------

ENTRIES = ("(m1+m2)*l1", "m2*l2*cos(t1-t2)", "l1*cos(t1-t2)", "l2")
FORCES = ("-m2*l2*w2^2*sin(t1-t2) - (m1+m2)*g*sin(t1)", "l1*w1^2*sin(t1-t2) - g*sin(t2)")
A, B, C, D = ENTRIES
MATRICES = {
    "LaTeX": rf"\begin{{bmatrix}} {A} & {B} \\ {C} & {D} \end{{bmatrix}} \begin{{pmatrix}} a1 \\ a2 \end{{pmatrix}}"
    rf" = \begin{{pmatrix}} {FORCES[0]} \\ {FORCES[1]} \end{{pmatrix}}",
    "an array": rf"\left[\begin{{array}}{{cc}} {A} & {B} \\ {C} & {D} \end{{array}}\right]"
    rf"\left[\begin{{array}}{{c}} a1 \\ a2 \end{{array}}\right] - \begin{{bmatrix}} {FORCES[0]} \\ {FORCES[1]} \end{{bmatrix}} = 0",
    "MATLAB": f"[{A}, {B}; {C}, {D}]*[a1; a2] = [{FORCES[0]}; {FORCES[1]}]",
    "numpy": f"np.array([[{A}, {B}], [{C}, {D}]]) @ np.array([a1, a2]) = np.array([{FORCES[0]}, {FORCES[1]}])",
    "an inverse": f"[a1; a2] = inv([{A}, {B}; {C}, {D}])*[{FORCES[0]}; {FORCES[1]}]",
    "an inverse as a power": rf"\begin{{pmatrix}} a1 \\ a2 \end{{pmatrix}} = \begin{{bmatrix}} {A} & {B} \\ {C} & {D} \end{{bmatrix}}^{{-1}}"
    rf" \begin{{pmatrix}} {FORCES[0]} \\ {FORCES[1]} \end{{pmatrix}}",
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("line", MATRICES.values(), ids=MATRICES.keys())
def test_matrices_are_multiplied_out(line):
    assert is_plain(graded("n-leg", [line], links=2))
    assert graded("n-leg", [line.replace("- g*sin(t2)", "+ g*sin(t2)")], links=2).verdict == "wrong"
    swapped = line.replace("a1; a2", "a2; a1").replace("a1, a2", "a2, a1").replace(r"a1 \\ a2", r"a2 \\ a1")
    assert graded("n-leg", [swapped], links=2).verdict == "wrong"


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("[m1*l1 m2*l2; l1 l2]*[a1; a2] = [g; g]", "write \\* or a comma"),
        ("[m1, m2; l1]*[a1; a2] = 0", "entries"),
        ("[m1, m2]*[a1, m2; l1, l2] = 0", "columns is multiplied"),
        ("[m1; m2] + l1 = [a1; a2]", "a number and a matrix"),
        (r"\begin{bmatrix} m1 & m2 = a1", "missing"),
        (r"m1 \end{bmatrix} = a1", "never begun"),
        ("inv([m1, m2; m1, m2])*[g; g] = [a1; a2]", "singular"),
        ("cos([m1; m2]) = a1", "angles"),
    ],
)
def test_matrices_that_are_none_are_refused(line, why):
    with pytest.raises(InvalidInput, match=why):
        graded("n-leg", [line], links=2)


SPELLINGS = {
    "capitals": respelled([("m", "M"), ("l", "L")]),
    "letters for links": respelled([("t1-t2", "θA-θB"), ("a1", "ddθA"), ("a2", "ddθB"), ("w1", "dθA"), ("w2", "dθB"), ("t1", "θA"), ("t2", "θB")]),
    "low letters": respelled([("t1", r"\theta_a"), ("t2", r"\theta_b"), ("a1", r"\ddot\theta_a"), ("a2", r"\ddot\theta_b"),
                              ("w1", r"\dot\theta_{a}"), ("w2", r"\dot{\theta}_b")]),
    "sympy": respelled([("a1", "Derivative(theta1(t), (t, 2))"), ("a2", "Derivative(theta2(t), (t, 2))"),
                        ("w1", "Derivative(theta1(t), t)"), ("w2", "Derivative(theta2(t), t)"),
                        ("(t1-t2)", "(theta1(t) - theta2(t))"), ("(t1)", "(theta1(t))"), ("(t2)", "(theta2(t))"), ("^", "**")]),
    "sympy's LaTeX": respelled([
        ("a1", r"\frac{d^{2}}{d t^{2}} \theta_{1}{\left(t \right)}"), ("a2", r"\frac{d^{2}}{d t^{2}} \theta_{2}{\left(t \right)}"),
        ("w1", r"\left(\frac{d}{d t} \theta_{1}{\left(t \right)}\right)"), ("w2", r"\left(\frac{d}{d t} \theta_{2}{\left(t \right)}\right)"),
        ("(t1-t2)", r"{\left(\theta_{1}{\left(t \right)} - \theta_{2}{\left(t \right)} \right)}"),
        ("(t1)", r"{\left(\theta_{1}{\left(t \right)} \right)}"), ("(t2)", r"{\left(\theta_{2}{\left(t \right)} \right)}"),
        ("cos", r"\cos"), ("sin", r"\sin"), ("*", " ")]),
    "Leibniz": respelled([("a1", r"\frac{d^2\theta_1}{dt^2}"), ("a2", "d²θ₂/dt²"), ("w1", "(dθ₁/dt)"), ("w2", r"\frac{\mathrm{d}\theta_2}{\mathrm{d}t}")]),
    "phi": respelled([("t1", "φ1"), ("t2", "φ2"), ("a1", r"\ddot\phi_1"), ("a2", "φ̈₂"), ("w1", "φ1'"), ("w2", r"\dot{\varphi}_2")]),
    "two letters": respelled([("t1", "θ"), ("t2", "φ"), ("a1", "θ''"), ("a2", "φ''"), ("w1", "θ'"), ("w2", r"\dot\phi")]),
    "alpha and beta": respelled([("t1", "α"), ("t2", "β"), ("a1", "α''"), ("a2", "β''"), ("w1", "α'"), ("w2", "β'")]),
    "q": respelled([("t1", "q1"), ("t2", "q2"), ("a1", "ddq1"), ("a2", "q2''"), ("w1", "dq1"), ("w2", "dq2")]),
    "code": respelled([("a1", "theta1_ddot"), ("a2", "theta2_ddot"), ("w1", "theta1_dot"), ("w2", "theta2_dot"),
                       ("t1", "theta1"), ("t2", "theta2"), ("cos", "np.cos"), ("sin", "np.sin"), ("^", "**")]),
    "power before index": respelled([("w1^2", r"\dot\theta^2_1"), ("w2^2", r"\dot{\theta}^{2}_{2}")]),
    "Eq": [f"Eq({LEFT_1}, 0)", f"Eq(0, {LEFT_2})"],
    "over": [r"{(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) \over l1} = -{(m1+m2) g \sin(t1) \over l1}", ROW_2],
}  # fmt: skip


@pytest.mark.parametrize("rows", SPELLINGS.values(), ids=SPELLINGS.keys())
def test_spellings_are_read(rows):
    answer = graded("n-leg", rows)
    assert is_plain(answer), answer.text()


@pytest.mark.parametrize(
    ("rows", "why"),
    [
        ([ROW_1.replace("l2", "L2"), ROW_2], "both l and L"),
        ([ROW_1.replace("m2", "M2"), ROW_2], "both m and M"),
        ([r"\ddot{\theta}_i + g = 0", ROW_2], "index"),
    ],
)
def test_what_is_not_clear_is_refused(rows, why):
    with pytest.raises(InvalidInput, match=why):
        graded("n-leg", rows)


TAKENO_19 = [
    "4/3*a1 + (a2*cos(t1-t2) + w2^2*sin(t1-t2))/2 + FIRST*sin(t1) = 0",
    "(a1*cos(t1-t2) - w1^2*sin(t1-t2))/2 + a2/3 + SECOND*sin(t2) = 0",
]


def test_a_slash_that_may_mean_two_things_is_said():
    answer = graded("rod-chain", [TAKENO_19[0].replace("FIRST", "3g/2l"), TAKENO_19[1].replace("SECOND", "g/2l")])
    assert answer.verdict == "correct"
    assert "3g/2l as 3g/(2l)" in answer.assumes[0]
    assert is_plain(
        graded("rod-chain", [TAKENO_19[0].replace("FIRST", "3/2*g/l"), TAKENO_19[1].replace("SECOND", "g/(2l)")])
    )
    assert is_plain(graded("n-leg", [ROW_1.replace("m2*l2", "2m2l2/2"), ROW_2.replace("m2*g", "1/2m2g*2")]))
    assert (
        graded("rod-chain", [TAKENO_19[0].replace("FIRST", "5g/2l"), TAKENO_19[1].replace("SECOND", "g/2l")]).verdict
        == "wrong"
    )


# What is wrong ------------------------------------------------------------------------------------------------------


def test_one_wrong_term_is_accused_before_three_right_ones():
    first = "(m1+m2)*l1^2*a1 + m2*l1*l2*a2*cos(t1-t2) + m2*l1*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0"
    (finding,) = graded("n-leg", [first, ROW_2]).findings
    assert (finding.row, finding.expected) == ("1", "(m1 + m2)*l1*g*sin(t1)")
    assert "lacks the factor l₁" in finding.says


def test_a_bob_is_no_rod():
    answer = graded("n-leg", ["a1 = -3*g/(2*l1)*sin(t1)"])
    assert answer.verdict == "wrong"
    assert "uniform rod" in answer.right_for
    assert (answer.findings[0].found, answer.findings[0].expected) == ("3/2*g*sin(t1)/l1", "g*sin(t1)/l1")
    assert is_plain(graded("n-leg", ["a1 = -g/l1*sin(t1)"]))


def test_the_right_equations_of_another_mechanism_are_said_first():
    answer = graded("rods", [ROW_1, ROW_2])
    assert "point mass" in answer.right_for
    lines = answer.text().splitlines()
    assert lines[lines.index("Wrong.") + 1].startswith("  But right for")
    assert "uniform rods" in graded("n-leg", [OWN_1, OWN_2]).right_for


# T = ½ m1 l1² ω1² + ½ m2 (l1² ω1² + l2² (ω1+ω2)² + 2 l1 l2 ω1 (ω1+ω2) cos θ2), the 2 of the last term forgotten
RELATIVE_L = (
    "1/2*m1*l1^2*w1^2 + 1/2*m2*(l1^2*w1^2 + l2^2*(w1+w2)^2 + l1*l2*w1*(w1+w2)*cos(t2))"
    " + m1*g*l1*cos(t1) + m2*g*(l1*cos(t1)+l2*cos(t1+t2))"
)


def test_a_relative_lagrangian_is_corrected_in_relative_angles():
    answer = grade_text("angles = 'relative'\n" + lagrangian("n-leg", 2, RELATIVE_L))
    assert "l₁ l₂ θ̇₁ (θ̇₁ + θ̇₂) cos(θ₂)" in answer.mistakes[0].says
    assert {(f.found, f.expected) for f in answer.findings} == {
        ("1/2*m2*l1*l2*w1^2*cos(t2)", "m2*l1*l2*w1^2*cos(t2)"),
        ("1/2*m2*l1*l2*w1*w2*cos(t2)", "m2*l1*l2*w1*w2*cos(t2)"),
    }
    right = RELATIVE_L.replace("l1*l2*w1*(w1", "2*l1*l2*w1*(w1")  # followed literally, it is right
    assert is_plain(grade_text("angles = 'relative'\n" + lagrangian("n-leg", 2, right)))


def test_the_scale_of_a_lagrangian_is_said():
    formula = (
        "m1*l1^2*w1^2 + m2*(l1^2*w1^2 + l2^2*w2^2 + 2*l1*l2*w1*w2*cos(t1-t2)) + (m1+m2)*g*l1*cos(t1)"
        " + 1/3*m2*g*l2*cos(t2)"
    )
    answer = grade_text(lagrangian("n-leg", 2, formula))
    assert "2 times T − U" in answer.notes[0]
    assert [f.term for f in answer.findings] == ["cos(t1)", "cos(t2)"]
    assert "Or it is T − U itself" in answer.notes[1]


# What is said back --------------------------------------------------------------------------------------------------


def test_what_was_read_is_said_back():
    answer = graded("n-leg", SPELLINGS["letters for links"])
    reading = answer.reading
    assert "point mass at the end of each" in reading.mechanism
    assert "downward vertical" in reading.angles
    assert "cos(θA − θB)" in reading.equations[0][1]
    assert ("index A", "read as 1") in reading.symbols
    assert answer.to_dict()["reading"]["drawing"]
    assert "(m₁ + m₂) l₁ θ̈A" in answer.text()
    capitals = graded("n-leg", SPELLINGS["capitals"])
    assert "M₂ L₂" in capitals.reading.equations[0][1]


def test_a_pinned_problem_cannot_be_changed():
    text = toml("rod-chain", ["l1^2/3*a1 + g*l1/2*sin(t1) = 0"])
    with pytest.raises(InvalidInput, match="the problem is 'n-leg'"):
        grade_text(text, pinned=Pinned("n-leg", 2))
    with pytest.raises(InvalidInput, match="links: the problem is 2"):
        grade_text(text, pinned=Pinned(links=2))
    assert grade_text(text, pinned=Pinned("rod-chain", 1)).verdict == "correct"
