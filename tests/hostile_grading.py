# ruff: noqa: E501 -- pieces of text stand on one line
"""Hostile derivations by the thousand, each in a process of its own: no traceback, at most 2 s and 300 MB.

    python tests/hostile_grading.py [--count 20000] [--seed 1] [--only KIND] [--seconds N]

Every input follows from its number and the seed. Time is the process's own (a machine that does other things is no
fault of an input), memory what it needs beyond its parent.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import signal
import string
import sys
import time
import tomllib
import traceback
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from declared_mechanisms import RIGHT
from hostile_derivations import FRAGMENTS, hostile

from furiko import InvalidInput
from furiko.derivations.grading.grade import grade_fields, grade_text
from furiko.derivations.reading.submission import fields_of
from furiko.derivations.robot.reading import read_robot
from furiko.models.scene import scene_from_toml

MOST_SECONDS, MOST_MEGABYTES = 2.0, 300
LIMIT = 20  # [s] until a process is ended
COLLECTION = [path.read_text() for path in sorted((Path(__file__).parent / "derivations/collection").glob("*.toml"))
              if path.name != "index.toml"]  # fmt: skip
ROWS = ["\n".join(map(str, rows.values())) for rows in (tomllib.loads(text).get("equations") for text in COLLECTION)
        if isinstance(rows, dict)]  # fmt: skip
PIECES = (
    *FRAGMENTS, "1e999999", "1e-999999", "x**x**x", "2**2**2**2", "^{99999999}", "**1e9", "_{999999999}", "theta99999999",
    "\u0000", "\u200b", "\ufeff", "\U0001d703", "\ud800", "a\u0307\u0307\u0307\u0307", "()" * 500, "[" * 200, "{" * 200,
    "|" * 50, "sgn(", "|x'|", "abs(", "\\operatorname{", "\\left|", "\\begin{bmatrix}" * 40, "Derivative(" * 60,
    "inv(" * 60, "0" * 3000, "1/3" * 400, "[[bodies]]\n", "[equations]\n", "[define]\n", "friction = 'F'\n", "\"\"\"", "#",
    "\\over" * 40, "d/dt" * 100, "'" * 300, "T = ", "sqrt(" * 70, "Add(Symbol('x')," * 50, "..." * 50, "&" * 200, "\\\\" * 200,
)  # fmt: skip


def mutated(draw: random.Random) -> str:
    """A file of the collection, or of the declared mechanisms, with a few changes."""
    text = draw.choice((*COLLECTION, *RIGHT.values()))
    for _ in range(draw.choice((1, 1, 2, 4, 12))):
        at, kind = draw.randrange(len(text) + 1), draw.randrange(8)
        if kind == 0:
            text = text[:at] + text[at + draw.randrange(1, 30) :]
        elif kind in (1, 2):
            text = text[:at] + draw.choice(PIECES) + text[at:]
        elif kind == 3:
            text = text[:at] + draw.choice(string.printable) + text[at + 1 :]
        elif kind == 4:
            begin = draw.randrange(len(text) + 1)
            text = text[:at] + text[begin : begin + draw.randrange(200)] * draw.choice((1, 2, 50)) + text[at:]
        elif kind == 5:
            lines = text.split("\n")
            draw.shuffle(lines)
            text = "\n".join(lines)
        elif kind == 6:
            figures = [k for k, c in enumerate(text) if c.isdigit()]
            if figures:
                k = draw.choice(figures)
                text = text[:k] + draw.choice(("0", "12", "99999999999", "1e400", "-1", "0.5", "²")) + text[k + 1 :]
        else:
            text = text.replace(
                draw.choice("()[]{}=+-*/^'\\_"), draw.choice(("", "(", ")", "^", "**", "/", "\\", "|")), 1
            )
    return text


def _equation(line: str) -> str:
    return f"system = 'point-masses'\nlinks = 2\n[equations]\n1 = '''{line}'''\n2 = 'a2 = 0'\n"


def long_lines(draw: random.Random) -> str:
    """Sums of 10⁵ terms, towers of powers, brackets thousands deep, numbers of 10⁵ figures."""
    size = draw.choice((300, 3000, 30_000, 100_000))
    term = draw.choice(
        ("a1", "l1*a1", "cos(t1-t2)", "m1*w1^2*sin(t2)", "1/m1", "1/(m1+m2)", "x", "(a1)", "1", "theta_1")
    )
    return _equation(draw.choice((
        "+".join([term] * size), "*".join([term] * size), "-" * size + term, "(" * size + term + ")" * size,
        "^".join([term] * min(size, 3000)), "**".join(["2"] * min(size, 3000)), f"{term}^{'9' * min(size, 4000)}",
        "1" + "0" * size + f"*{term}", f"1e{'9' * min(size, 300)}*{term}", f"cos({'+'.join(['t1'] * size)})",
        "\\frac{" * min(size, 3000) + term, "/".join([term] * size), "|" * size, f"m_{{{'9' * size}}}",
        " " * size + term, "\\" * size, "".join(draw.choices(string.printable, k=min(size, 20_000))),
        f"{term}" + "'" * size, "=".join([term] * size),
    )) + draw.choice(("", " = 0", " = a1", "=" + term)))  # fmt: skip


def large_algebra(draw: random.Random) -> str:
    """What is short to write, and long when it is multiplied out."""
    power = draw.choice((2, 5, 12, 13))
    terms = "+".join(draw.sample(["m1", "m2", "l1", "l2", "g", "w1", "w2", "cos(t1-t2)", "sin(t1)", "cos(2*t2)"], 7))
    body = draw.choice((
        f"({terms})^{power}", f"(({terms})^{power})^{power}", f"1/({terms})^{power}", f"({terms})^-{power}",
        "*".join([f"1/({terms})"] * power), f"({terms})/({terms.replace('m1', '3*m1')})^{power}",
        f"[[{terms}, 1], [1, {terms}]]^-1", "*".join([f"[[{terms}, g], [m1, {terms}]]"] * power),
        f"inv([[{terms}, m1, g], [l1, {terms}, 1], [1, 2, {terms}]])", f"cos({'+'.join(['t1-t2'] * 9)})^{power}",
        f"tan(t1)^{power}*tan(t2)^{power}/({terms})^{power}",
    ))  # fmt: skip
    kind = draw.randrange(4)
    if kind == 0:
        return f"system = 'rods'\nlinks = {draw.choice((2, 3, 8, 20))}\nlagrangian = '''{body}'''"
    if kind == 1:
        return f"system = 'point-masses'\nlinks = 2\nhamiltonian = '''{body} + p1^2*{body}'''"
    if kind == 2:
        return f"system = 'links'\nlinks = 2\nkinetic = '''{body}*w1^2'''\npotential = '''{body}'''"
    return _equation(f"{body}*a1 + a2*{body} = {body}")


def toml_tricks(draw: random.Random) -> str:
    """Fields of other kinds, tables in tables, arrays thousands deep, names that are no names."""
    value = draw.choice((
        "1", "-1", "1e999", "nan", "inf", "true", "[]", "{}", "''", "[[[[[[]]]]]]", "1979-05-27T07:32:00Z", "'\\u0000'",
        "[" * 400 + "]" * 400, "{a={b={c={d=1}}}}", "'" + "x" * 5000 + "'", "[1, 'a', {}]", "0x" + "f" * 400, "9" * 4500,
        '"\\ud800"', '"\\u0007\\u001b[2J"', "'" + "θ̈" * 300 + "'",
    ))  # fmt: skip
    field = draw.choice(("system", "links", "bodies", "angles", "from", "sense", "define", "title", "equations", "kinetic",
                         "lagrangian", "hamiltonian", "momenta", "positions", "velocities", "potential", "solved",
                         "a.b.c.d", "equations.1", "define.x", "bodies.mass", "momenta.p_1", "'\u202e'", '""'))  # fmt: skip
    base = draw.choice((_equation("a1 = 0"), draw.choice(COLLECTION), "[[bodies]]\ncoordinate = 'x'\nmass = 'm'\n",
                        "system = 'mechanism'\n" + "[[bodies]]\ncoordinate = 'x'\n" * draw.choice((1, 2, 8, 9, 300))))  # fmt: skip
    if draw.random() < 0.5:
        return f"{field} = {value}\n{base}"
    kept = "\n".join(line for line in base.split("\n") if not line.startswith(field))
    return f"{field} = {value}\n{kept}"


CART_POLE = """
[system]
kind = "tree"
[[system.links]]
name = "cart"
mass = 1.1
[[system.links.joints]]
name = "x"
kind = "slide"
axis = [1, 0, 0]
[[system.links]]
name = "pole"
parent = "cart"
mass = 0.3
centre = [0, 0, 0.7]
[[system.links.joints]]
name = "theta"
axis = [0, 1, 0]
"""
FUNCTION = """
def f(t, y, M=1.1, m=0.3):
    x, th, dx, dth = y
    s, c = np.sin(th), np.cos(th)
    a = (9.81 * s * (M + m) - 0.7 * m * dth ** 2 * s * c) / (0.7 * (M + m - m * c**2))
    return [dx, dth, (m * 0.7 * dth**2 * s - m * 0.7 * a * c) / (M + m), a]
"""
PYTHON = ("while True: pass\n", "for i in range(10**9): x = x + i\n", "exec('1')", "__import__('os')", "lambda: 0", "y[10**9]",
          "**9**9**9", "x = x * x\n    " * 40, "[y for y in y for y in y]", "(" * 300, "9" * 5000, "1e999", "y[:-1:2]", "yield",
          "@", "\t", "\0", "def g(): return g()\n", "assert 0", "range(y)", "for i in range(3):\n        s = s * s + c\n    ",
          "import os\n", "open('/etc/passwd')", "f'{x}'", "x if x else y", "s @ c", "[*y]", "y.T", "self.m", "x: int = 3", "1j")  # fmt: skip


def robots(draw: random.Random) -> str:
    """Own equations of a robot: rows, a Lagrangian, a function."""
    kind = draw.randrange(3)
    if kind == 0:
        lines = ["".join(draw.choice((*PIECES, "x''", "theta''", "0.3", "(M+m)", "*", "+", "=")) for _ in range(draw.randrange(1, 9)))
                 for _ in range(2)]  # fmt: skip
        text = f"[equations]\n1 = '''{lines[0]} = 0'''\n2 = '''{lines[1]} = 0'''\n[symbols]\nM = 1.1\nm = 0.3\n"
        return text + CART_POLE if draw.random() < 0.2 else CART_POLE + text
    if kind == 1:
        return f"lagrangian = '''{'*'.join(draw.choices((*PIECES, 'x', 'theta', '(x+theta)^12', 'm'), k=4))}'''\n{CART_POLE}"
    text = FUNCTION
    for _ in range(draw.choice((1, 2, 5))):
        at = draw.randrange(len(text) + 1)
        piece = draw.choice((*PYTHON, *PIECES))
        text = text[:at] + piece + text[at + draw.choice((0, 0, 1, 8)) :]
    return f"function = '''{text}'''\n{CART_POLE}"


def texts(draw: random.Random) -> str:
    """No TOML file, and no word of which mechanism it is about: rows, Lagrangians and programs with a few changes."""
    text = draw.choice((*ROWS, FUNCTION))
    for _ in range(draw.choice((0, 1, 2, 5))):
        at = draw.randrange(len(text) + 1)
        text = text[:at] + draw.choice((*PYTHON, *PIECES)) + text[at + draw.choice((0, 0, 1, 8)) :]
    return text


KINDS: dict[str, tuple[int, Callable[[random.Random], str]]] = {
    "mutated": (40, mutated), "hostile": (15, hostile), "long": (10, long_lines), "algebra": (10, large_algebra),
    "toml": (12, toml_tricks), "robot": (13, robots), "text": (10, texts),
}  # fmt: skip


def one(kind: str, text: str) -> str:
    """Read it and judge it; what came of it."""
    try:
        if kind == "robot":
            scene = scene_from_toml(text, "mine")
            if scene.own is None:
                return "no equations"
            read_robot(scene.system, scene.own)
            return "read"
        return (grade_fields(fields_of(text, ".txt")) if kind == "text" else grade_text(text)).verdict
    except InvalidInput as error:
        said = str(error)
        return "refused in one line" if "\n" not in said and len(said) < 800 else f"NOT ONE LINE: {said[:200]!r}"


def forked(kind: str, text: str) -> tuple[str, float, float]:
    """The same in a process of its own: what came of it, seconds, megabytes."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        signal.alarm(10 * LIMIT)
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 1))
        try:
            said = one(kind, text)
        except MemoryError:
            said = "MEMORY"
        except BaseException:  # the measurement is of just this
            said = "TRACEBACK: " + traceback.format_exc()[-400:]
        os.write(writing, said.encode("utf-8", "replace")[:2000])
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        said = pipe.read().decode("utf-8", "replace")
    _, status, usage = os.wait4(child, 0)
    if not said:
        said = f"ENDED with {os.waitstatus_to_exitcode(status)}"
    return said, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def campaign(
    count: int, seed: int, only: str = "", seconds: float = float("inf")
) -> tuple[Counter[str], list[str], float, float]:
    """What came of all; failures; the slowest [s]; the largest beyond an empty process [MB]. It ends after ``seconds``."""
    begun = time.monotonic()
    for text in (COLLECTION[0], *RIGHT.values()):  # what is kept from one input to the next is there from the start
        grade_text(text)
    _, _, base = forked("hostile", "")
    tally, failures, slowest, largest = Counter[str](), [], 0.0, 0.0
    names, weights = [*KINDS], [weight for weight, _ in KINDS.values()]
    for number in range(count):
        draw = random.Random(f"{seed} {number}")
        kind = only or draw.choices(names, weights)[0]
        text = KINDS[kind][1](draw)
        said, spent, megabytes = forked(kind, text)
        megabytes -= base
        slowest, largest = max(slowest, spent), max(largest, megabytes)
        tally[f"{kind}: {said.partition(':')[0][:30]}"] += 1
        bad = said.startswith(("TRACEBACK", "NOT ONE", "ENDED", "MEMORY"))
        if bad or spent > MOST_SECONDS or megabytes > MOST_MEGABYTES:
            failures.append(f"{kind} {number}: {spent:.1f} s, {megabytes:.0f} MB: {said[-300:]}")
        if time.monotonic() - begun > seconds:
            break
    return tally, failures, slowest, largest


def main() -> None:
    """Print the table; the exit status is 1 where something failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", choices=("", *KINDS))
    parser.add_argument(
        "--seconds", type=float, default=float("inf"), help="stop after so long, and say how many were tried"
    )
    options = parser.parse_args()
    begun = time.monotonic()
    tally, failures, slowest, largest = campaign(options.count, options.seed, options.only, options.seconds)
    for what, found in sorted(tally.items()):
        print(f"{found:6d}  {what}")
    print(
        f"{sum(tally.values())} inputs in {time.monotonic() - begun:.0f} s; slowest {slowest:.2f} s, largest {largest:.0f} MB"
    )
    print("\n".join(failures[:60]))
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
