"""sympy's srepr is read as what it stands for, and never run."""

from __future__ import annotations

import pytest
import sympy

from furiko.derivations.dialects.srepr import EXPECTED, from_srepr
from furiko.models import InvalidInput

t, m, g = sympy.symbols("t m g", positive=True)
x = sympy.Function("theta1")(t)
EXPRESSIONS = (
    sympy.Eq(m * x.diff(t, 2) + sympy.Rational(3, 2) * g * sympy.sin(x), 0),
    sympy.Eq(x.diff(t) ** 2 / (m - g) ** 3, -sympy.sqrt(m) * sympy.pi),
    2 * m * sympy.Float("9.81") + g ** sympy.Rational(-1, 3) * x,
)


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
def test_it_says_what_sympy_says(expression):
    """Against sympy's own reading of the text that is made."""
    text = from_srepr(sympy.srepr(expression))
    names = {"theta1": sympy.Function("theta1"), "t": t, "m": m, "g": g}
    left, _, right = text.partition(" = ")
    sides = [sympy.sympify(side, locals=names) for side in (left, right or "0")]
    expected = expression.lhs - expression.rhs if isinstance(expression, sympy.Equality) else expression
    assert sympy.simplify(sides[0] - sides[1] - expected) == 0


def test_a_matrix():
    assert from_srepr(sympy.srepr(sympy.Matrix([[m, 1], [0, m * g]]))) == "Matrix([[m, 1], [0, (g*m)]])"


@pytest.mark.parametrize("line", ["a = b", "Eq(a, b)", "Add(a, b)", "m*theta'' = 0", "x" * 100_000])
def test_other_lines_stay_as_they_are(line):
    assert from_srepr(line) == line


@pytest.mark.parametrize(
    "line",
    [
        "Add(Symbol('a'), __import__('os').system('true'))",
        "Add(Symbol('a'), Integer(10**10**10))",
        "Mul(Symbol('a b'), Symbol('c'))",
        "Mul(Symbol('a'), Lambda(Symbol('x'), Symbol('x')))",
        "Mul(Symbol('a'), *Symbol('b'))",
        "Add(Symbol('a'),",
        "Add(" * 90 + "Symbol('a')" + ")" * 90,
    ],
)
def test_what_is_not_known_is_refused(line):
    with pytest.raises(InvalidInput, match="column"):
        from_srepr(line)


def test_the_refusal_says_what_would_be_read():
    with pytest.raises(InvalidInput, match=EXPECTED):
        from_srepr("Mul(Symbol('a'), Heaviside(Symbol('b')))")
