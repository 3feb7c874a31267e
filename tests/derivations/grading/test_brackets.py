"""A factor that multiplies a part of its bracket alone, or more than it: a cause of its own, in every form."""

import pytest

from furiko.derivations.classroom.in_python import grade_text

HEAD = """
system = "mechanism"
[[bodies]]
name = "cart"
coordinate = "x"
joint = "slide"
mass = "M"
[[bodies]]
name = "pole"
coordinate = "theta"
length = "l"
mass = "m"
"""
ROW_1 = "(M+m) x'' + m l (theta'' cos(theta) - theta'^2 sin(theta)) = 0"
ROW_2 = "m (l^2 theta'' + l x'' cos(theta) + g l sin(theta)) = 0"


def rows(one: str, two: str) -> str:
    return f"{HEAD}[equations]\n1 = '''{one}'''\n2 = '''{two}'''\n"


def lagrangian(text: str) -> str:
    return f"lagrangian = '''{text}'''\n{HEAD}"


BOBS = """
system = "mechanism"
[[bodies]]
coordinate = "theta1"
mass = "m1"
length = "l1"
[[bodies]]
coordinate = "theta2"
mass = "m2"
length = "l2"
[equations]
1 = '''l1 ((m1+m2) l1 theta1'' + m2 l2 theta2'' cos(theta1-theta2)) + m2 l2 theta2'^2 sin(theta1-theta2)
  + (m1+m2) g sin(theta1) = 0'''
2 = "l2 theta2'' + l1 theta1'' cos(theta1-theta2) - l1 theta1'^2 sin(theta1-theta2) + g sin(theta2) = 0"
"""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (rows("M + m x'' + m l (theta'' cos(theta) - theta'^2 sin(theta)) = 0", ROW_2),
         "In row 1, a bracket is closed too early: the factor x'' belongs to M x'' as well."),
        (BOBS, "In row 1, a bracket is closed too early: the factor l₁ belongs to "
               "l₁ l₂ m₂ theta2'² sin(theta1−theta2) + (m₁ + m₂) l₁ g sin(theta1) as well."),
        (rows(ROW_1, "m l (l theta'' + x'') cos(theta) + m g l sin(theta) = 0"),
         "In row 2, a bracket is closed too late: the factor cos(theta) does not belong to l² m theta''."),
        (lagrangian("M x'^2/2 + m/2 x'^2 + l^2 theta'^2 + 2 l x' theta' cos(theta) + m g l cos(theta)"),
         "In the Lagrangian, a bracket is closed too early: the factor 1/2 m belongs to "
         "l m x' theta' cos(theta) + 1/2 l² m theta'² as well."),
        (lagrangian("M x'^2/2 + m/2 (x'^2 + l^2 theta'^2 + 2 l x' theta') cos(theta) + m g l cos(theta)"),
         "In the Lagrangian, a bracket is closed too late: the factor cos(theta) does not belong to "
         "1/2 (x'² + l² theta'²) m."),
    ],
)  # fmt: skip
def test_a_bracket_that_is_closed_in_the_wrong_place_is_named(text, says):
    found = grade_text(text)
    assert found.verdict == "wrong"
    assert [(m.cause, m.says) for m in found.mistakes] == [("bracket-slip", says)]
    assert "括弧" in found.mistakes[0].says_ja


def test_a_minus_before_a_part_of_its_bracket_alone_is_named():
    # -(a + b + c) has become -a + b + c, in a cart with a damper, a spring and a pole
    head = HEAD.replace('mass = "M"', 'mass = "M"\ndamping = "b"\nspring = "k"')
    row_1 = "(M+m) x'' + m l theta'' cos(theta) = m l theta'^2 sin(theta) - (b x' + k x)"
    right = head + rows(row_1, ROW_2)[len(HEAD) :]
    assert grade_text(right).verdict == "correct"
    found = grade_text(right.replace("- (b x' + k x)", "+ b x' + k x"))
    assert [m.cause for m in found.mistakes] == ["bracket-slip"]


@pytest.mark.parametrize(
    ("row", "says"),
    [
        ("m1 + m2*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0",
         "In row 1, a bracket is closed too early: the factor l₁ θ̈₁ belongs to m₁ l₁² θ̈₁ as well."),
        ("(m1+m2)*l1*a1 + m2*l2*(a2 + w2^2*sin(t1-t2))*cos(t1-t2) + (m1+m2)*g*sin(t1) = 0",
         "In row 1, a bracket is closed too late: the factor cos(θ₁−θ₂) does not belong to "
         "m₂ l₁ l₂ θ̇₂² sin(θ₁−θ₂)."),
    ],
)  # fmt: skip
def test_the_documents_mechanisms_have_it_too(row, says):
    second = "2 = 'l2*a2 + l1*a1*cos(t1-t2) - l1*w1^2*sin(t1-t2) + g*sin(t2) = 0'"  # Shiki (1.9), over m2 l2
    found = grade_text(f"system = 'n-leg'\nlinks = 2\n[equations]\n1 = '{row}'\n{second}")
    assert [m.says for m in found.mistakes] == [says]


def test_momenta_and_matrices_have_it_too():
    momenta = (
        HEAD
        + """
[momenta]
p_x = "(M+m) x' + m l theta' cos(theta)"
p_theta = "m (l^2 theta' + l x' cos(theta))"
[equations]
1 = "p_x' = 0"
2 = "p_theta' = -m l x' theta' sin(theta) - g sin(theta)"
"""
    )
    right = momenta.replace("- m", "-m").replace(" - g sin", " - m g l sin")
    assert grade_text(right).verdict == "correct"
    (finding,) = grade_text(momenta).findings
    assert finding.says.endswith("it lacks the factor l m.")
    matrix = rows(
        "[[M + m, m l cos(theta)], [m l cos(theta), m l^2]] * [x'', theta''] + "
        "[-m l theta'^2 sin(theta), m g l sin(theta)] = [0, 0]",
        "0 = 0",
    ).replace("2 = '''0 = 0'''\n", "")
    assert grade_text(matrix).verdict == "correct"
    wrong = matrix.replace("[m l cos(theta), m l^2]", "[m l cos(theta), m l^2 cos(theta)]")
    assert [m.cause for m in grade_text(wrong).mistakes] == ["bracket-slip"]
