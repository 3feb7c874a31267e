"""Makes inputs that no grader should choke on: right files damaged at random, and things people do to break parsers."""

from __future__ import annotations

import random
import string

from rewritten_derivations import rewritten

from furiko.derivations.algebra.symbols import symbols_of
from furiko.derivations.steps.derivation import correct_derivation

FRAGMENTS = [
    "(", ")", "{", "}", "[", "]", "^", "**", "=", "==", "+", "-", "/", "*", "\\frac", "\\frac{", "\\ddot", "\\dot{",
    "\\left", "\\sum_{i=1}^{3}", "cos", "sin(", "tan", "t1", "w9", "a0", "l_", "m_{", "theta", "θ̈₁", "²", "⁻", "½",
    "1e9", "1e999", "0.0000000000001", "9" * 60, "__import__('os').system('true')", "eval(", "lambda:0", "#", ";",
    "\\\\",
    "\\input{/etc/passwd}", "\u0000", "\u202e", "𝜃", "٣", "＝", "'", '"', "'''", "\n", "\t", "%s", "{{7*7}}", "nan",
    "inf", "^9^9^9", "^(-12)", "^12)^12)^12", "1/0", "/(l1-l1)", "cos(cos(t1))", "cos(w1)", "sin(t1*t2)", "t1",
    "²²", "''''", "\\begin{bmatrix}", "\\end{bmatrix}", "&", "[", "]", ",", ";", "inv(", "[a1; a2]", "{x \\over y}",
    "Derivative(theta1(t), (t, 2))", "\\frac{d^2\\theta_1}{dt^2}", "Eq(", "θAB", "L1", "l1", "M", "I1", "lc1", "ẍ",
    "3g/2l",
]  # fmt: skip


def hostile(draw: random.Random) -> str:
    """One input: mostly malformed; a few are right files that were damaged in a place that does not matter."""
    return draw.choice((_damaged, _damaged, _damaged, _line, _nested, _large, _file, _noise, _bodies, _square))(draw)


def _valid(draw: random.Random) -> str:
    m = symbols_of(draw.choice(("n-leg", "rod-chain")), draw.choice((2, 3)))
    return rewritten(m, correct_derivation(m).rows, draw)


def _damaged(draw: random.Random) -> str:
    text = _valid(draw)
    for _ in range(draw.randrange(1, 5)):
        at, kind = draw.randrange(len(text) + 1), draw.randrange(4)
        if kind == 0:
            text = text[:at] + text[at + draw.randrange(1, 20) :]
        elif kind == 1:
            text = text[:at] + draw.choice(FRAGMENTS) + text[at:]
        elif kind == 2:
            text = text[:at] + draw.choice(string.printable) + text[at + 1 :]
        else:
            other = draw.randrange(len(text) + 1)
            text = text[:at] + text[other : other + draw.randrange(40)] + text[at:]
    return text


def _equations(line: str, links: int = 2) -> str:
    return f"system = 'n-leg'\nlinks = {links}\n[equations]\n1 = '''{line}'''\n"


def _line(draw: random.Random) -> str:
    return _equations("".join(draw.choice(FRAGMENTS) for _ in range(draw.randrange(1, 30))))


BODY = ("name", "on", "coordinate", "joint", "along", "about", "mass", "length", "centre", "inertia", "spring", "at")


def _bodies(draw: random.Random) -> str:
    """Declared mechanisms, mostly senseless."""
    words = ("m", "m1", "theta", "theta1", "x", "slide", "hinge", "link", "body 1", "support", "l/2", "m*l^2/12", "1/0",
             "(", "g", "pivot", "0", "M+m", "__import__", "(m+l)^12", "cos", "9" * 50)  # fmt: skip
    lines = ["system = 'mechanism'"]
    for _ in range(draw.choice((0, 1, 2, 3, 8, 9))):
        lines.append("[[bodies]]")
        lines += [f"{field} = '{draw.choice(words)}'" for field in draw.sample(BODY, draw.randrange(len(BODY)))]
    line = "".join(draw.choice((*FRAGMENTS, "x''", "θ''", "m", "l", "g")) for _ in range(draw.randrange(1, 12)))
    return "\n".join([*lines, "[equations]", f"1 = '{line}'"])


def _square(draw: random.Random) -> str:
    """Matrices of many sizes, products and inverses of them."""
    size = draw.choice((1, 2, 3, 4, 5, 40))
    entry = draw.choice(("m1", "cos(t1-t2)", "(m1+m2*cos(t1))", "a1", "0"))
    rows = "; ".join(", ".join([entry] * size) for _ in range(draw.choice((size, 1, 2))))
    factor = draw.choice((f"[{rows}]", f"inv([{rows}])", "*".join([f"[{rows}]"] * 6), f"[{rows}]^-1"))
    return _equations(f"{factor}*[{'; '.join(['a1'] * size)}] = [{'; '.join(['g'] * size)}]")


def _nested(draw: random.Random) -> str:
    depth = draw.choice((10, 60, 61, 500, 5000))
    opening, closing = draw.choice(
        (
            ("(", ")"),
            ("{", "}"),
            ("[", ",g]"),
            ("\\begin{matrix}", "\\end{matrix}"),
            ("\\frac{", "}{2}"),
            ("cos(", ")"),
            ("-", ""),
            ("sin", ""),
        )
    )
    return _equations(opening * depth + "t1" + closing * depth + draw.choice(("", "=0", "=a1")))


def _large(draw: random.Random) -> str:
    size = draw.choice((50, 400, 3000, 30000))
    return draw.choice((
        _equations("*".join(["(m1+m2+l1+l2+g+w1+w2+cos(t1-t2))"] * min(size, 900)) + "=a1"),
        _equations("((((m1+m2+l1)^12)^12)^12)^12=a1"),
        _equations("+".join(["a1*cos(t1)"] * size) + "=0"),
        _equations("1/(" + "+1/(".join(["m1+l1"] * min(size, 55)) + ")" * min(size, 55) + "=a1"),
        _equations("*".join(["(1/(m1+l1)+1/(m2+l2)+cos(t1)/sin(t2))"] * min(size, 300)) + "=a1"),
        _equations("a1 = " + "9" * size),
        _equations("a1 = cos(" + "+".join(["t1"] * size) + ")"),
        _doublings(draw, "A", "+"),
        _doublings(draw, "A", "*"),
        "x" * size,
        "[" * size,
        "system = 'n-leg'\nlinks = " + "9" * size,
    ))  # fmt: skip


def _doublings(draw: random.Random, name: str, sign: str) -> str:
    count = draw.choice((5, 20, 39))
    start = draw.choice(("m1", "(m1+l1)", "cos(t1)", "w1"))
    lines = [f"{name}0 = '{start}'"] + [f"{name}{i} = '{name}{i - 1}{sign}{name}{i - 1}'" for i in range(1, count)]
    return "system = 'n-leg'\nlinks = 2\n[define]\n" + "\n".join(lines) + f"\n[equations]\n1 = 'a1 = {name}{count - 1}'"


def _file(draw: random.Random) -> str:
    system = draw.choice(("'n-leg'", "'rod-chain'", "'cart'", "3", "true", "[]", "{}", "''"))
    links = draw.choice(("2", "3", "0", "-1", "1e9", "'2'", "true", "10000000000", "2.0", "[2]", "20"))
    body = draw.choice((
        "[equations]", "[equations]\n1 = 3", "[equations]\n1 = ['a1=0']", "equations = []", "equations = 'a1=0'",
        "equations = ['a1=0', 'a2=0']", "lagrangian = 1", "lagrangian = ''", "lagrangian = 'a1'",
        "lagrangian = '1/(m1+m2)'",
        "[equations]\n1 = 'a1=0'\n[define]\ncos = '1'", "[equations]\n1 = 'a1=0'\n[define]\nM = 'M'",
        "angles = 'sideways'\n[equations]\n1 = 'a1=0'", "surprise = 1", "a.a.a.a.a.a = 1",
        "[[equations]]\n1 = 'a1 = 0'",
        "[equations]\n1 = 'a1^2 = 0'\n2 = 'a1*a2 = 0'", "[equations]\n1 = '0 = 0'\n2 = '0 = 0'",
        "[equations]\n1='1/a1=0'",
        "[equations]\n1='1/w1=a1'", "[equations]\n1='a1=cos(t1)^12*sin(t1)^12'",
    ))  # fmt: skip
    return f"system = {system}\nlinks = {links}\n{body}\n"


def _noise(draw: random.Random) -> str:
    alphabet = draw.choice((string.printable, "".join(FRAGMENTS), "".join(map(chr, range(1, 0x3000)))))
    return "".join(draw.choice(alphabet) for _ in range(draw.randrange(300)))
