"""Writes equations down in many ways that all mean the same, as people and books do; to try the grader with.

Each rewriting is a random choice among: scaling a row, reordering rows and terms, moving terms across the equals sign,
expanding and collecting sums, trigonometric identities, and three spellings (ASCII, Unicode, LaTeX).
"""

from __future__ import annotations

import random
import re
from collections.abc import Sequence

from flint import fmpq

from furiko.derivations.algebra.notation import angle_text, sub
from furiko.derivations.algebra.symbols import Symbols
from furiko.derivations.algebra.trig import COS, Formula, digits
from furiko.derivations.steps.derivation import Row

Term = tuple[bool, str]  # negative, and the text of its magnitude


def rewritten(m: Symbols, rows: Sequence[Row], draw: random.Random) -> str:
    """A TOML file with these rows, written down in a random way."""
    spelling = draw.choice(("ascii", "unicode", "latex"))
    order = list(range(m.n))
    draw.shuffle(order)
    lines = [f'system = "{m.kind}"', f"links = {m.n}", "[equations]"]
    for place, i in enumerate(order, 1):
        lines.append(f"{place} = '{_spelled(_equation(m, rows[i], draw), spelling)}'")
    return "\n".join(lines)


def plain(m: Symbols, rows: Sequence[Row], draw: random.Random) -> str:
    """The same with scaled and reordered rows, but every term as it is: how wrong derivations are handed in."""
    order = list(range(m.n))
    draw.shuffle(order)
    lines = [f'system = "{m.kind}"', f"links = {m.n}", "[equations]"]
    for place, i in enumerate(order, 1):
        terms = [term for q, f in rows[i].items() for term in _terms(m, q, f)]
        scale = _factor(m, draw)
        lines.append(f"{place} = '({_sum(terms)})*{scale} = 0'")
    return "\n".join(lines)


def _terms(m: Symbols, q: int, f: Formula) -> list[Term]:
    out: list[Term] = []
    for (e, h, phase), c in f.terms.items():
        out.append(_term(m, e + q, h, phase, c))
    return out


def _term(m: Symbols, e: int, h: int, phase: int, c: fmpq) -> Term:
    s = m.space
    parts = [f"{s.names[k]}^{p}" if p != 1 else s.names[k] for k, p in enumerate(digits(e, s.symbol_count)) if p]
    if h:
        parts.append(f"{'cos' if phase == COS else 'sin'}({angle_text(digits(h, s.n))})")
    if abs(c) != 1 or not parts:
        parts.insert(0, str(abs(c)))
    return c < 0, "*".join(parts)


def _equation(m: Symbols, row: Row, draw: random.Random) -> str:
    terms: list[Term] = []
    for q, f in row.items():
        for (e, h, phase), c in f.terms.items():
            terms.append(_waved(m, e + q, h, phase, c, draw))
    draw.shuffle(terms)
    if draw.random() < 0.3:  # a pair that cancels
        extra = f"{_factor(m, draw)}*w1^2*cos(t1)"
        terms += [(False, extra), (True, extra)]
        draw.shuffle(terms)
    scale = _factor(m, draw) if draw.random() < 0.7 else ""
    if scale and draw.random() < 0.5:  # the factor goes into every term
        terms = [(negative, f"{scale}*{body}") for negative, body in terms]
        scale = ""
    cut = draw.randrange(len(terms) + 1)
    left, right = terms[:cut], [(not negative, body) for negative, body in terms[cut:]]
    sides = [_sum(left), _sum(right)]
    if scale:
        sides = [f"({side})*{scale}" if draw.random() < 0.5 else f"{scale}*({side})" for side in sides]
    if draw.random() < 0.3:
        divisor = _factor(m, draw)
        sides = [f"({side})/({divisor})" for side in sides]
    draw.shuffle(sides)
    return " = ".join(sides)


def _sum(terms: Sequence[Term]) -> str:
    if not terms:
        return "0"
    text = " ".join(("- " if negative else "+ ") + body for negative, body in terms)
    return text.removeprefix("+ ")


def _factor(m: Symbols, draw: random.Random) -> str:
    n = m.n
    i, j = draw.randrange(n) + 1, draw.randrange(n) + 1
    mass = "m" if m.kind == "n-leg" else draw.choice(("m", "rho*l"))
    choices = [
        "1", "2", "3/7", "0.25", "(-1)", f"l{i}", f"l{i}^2", f"({mass}{i})", f"1/({mass}{i})", f"({mass}{i}*l{j})",
        f"(l{i}+l{j})", f"(2*l{i}+3*l{j})", f"1/({mass}{i}+3*{mass}{j})", "g", f"({mass}{i}*l{i}^2+{mass}{j}*l{j}^2)",
    ]  # fmt: skip
    return draw.choice(choices)


def _waved(m: Symbols, e: int, h: int, phase: int, c: fmpq, draw: random.Random) -> Term:
    """One term; its cos or sin by an identity, its power of a rate in pieces, a rod's ρ l as m."""
    negative, body = _term(m, e, 0, COS, c)
    if h:
        body += "*" + _wave(m, digits(h, m.n), phase, draw)
    if draw.random() < 0.2:
        k = draw.randrange(m.n) + 1
        body += f"*(sin(t{k})^2+cos(t{k})^2)"
    for k in range(1, m.n + 1):
        if draw.random() < 0.2:
            body = body.replace(f"w{k}^2", f"w{k}*w{k}")
    return negative, body


def _wave(m: Symbols, halves: tuple[int, ...], phase: int, draw: random.Random) -> str:
    name = "cos" if phase == COS else "sin"
    angle = angle_text(halves)
    back = angle_text(tuple(-h for h in halves))
    used = [k for k, h in enumerate(halves) if h]
    forms = [f"{name}({angle})", f"{name}({angle})"]
    forms.append(f"cos({back})" if phase == COS else f"(-sin({back}))")
    forms.append(f"sin({angle}+pi/2)" if phase == COS else f"(-cos({angle}+pi/2))")
    forms.append(f"(1-2*sin(({angle})/2)^2)" if phase == COS else f"2*sin(({angle})/2)*cos(({angle})/2)")
    if len(used) == 2 and all(abs(halves[k]) == 2 for k in used):
        one, two = (f"t{k + 1}" for k in used)
        plus = halves[used[0]] == halves[used[1]]
        sign = 1 if halves[used[0]] > 0 else -1
        if phase == COS:
            forms += [f"(cos({one})*cos({two}){'-' if plus else '+'}sin({one})*sin({two}))"] * 2
        else:
            inner = f"(sin({one})*cos({two}){'+' if plus else '-'}cos({one})*sin({two}))"
            forms += [inner if sign > 0 else f"(-{inner})"] * 2
    return draw.choice(forms)


def _spelled(equation: str, spelling: str) -> str:
    if spelling == "ascii":
        return equation
    return _unicode(equation) if spelling == "unicode" else _latex(equation)


def _unicode(equation: str) -> str:
    """Greek letters and subscripts; products side by side where that is not ambiguous."""
    equation = re.sub(r"(?<=[0-9)])\*(?=[a-zA-Z(])", "", equation)
    for ascii_letter, letter in (("t", "θ"), ("w", "ω"), ("a", "α"), ("l", "l"), ("m", "m")):
        for k in range(9, 0, -1):
            equation = re.sub(rf"(?<![a-z]){ascii_letter}{k}", letter + sub(k - 1), equation)
    return equation.replace("rho", "ρ").replace("-", "−").replace("*", "·").replace("^2", "²")


def _latex(equation: str) -> str:
    for k in range(9, 0, -1):
        equation = (
            equation.replace(f"t{k}", rf"\theta_{k}")
            .replace(f"w{k}", rf"\dot{{\theta}}_{k}")
            .replace(f"a{k}", rf"\ddot{{\theta}}_{{{k}}}")
            .replace(f"l{k}", f"l_{k}")
            .replace(f"m{k}", f"m_{k}")
        )
    equation = equation.replace("cos(", r"\cos\left(").replace("sin(", r"\sin \left(")
    # every bracket that a function opened was given \left; its partner needs no \right for the reader
    return equation.replace("*", r" \cdot ").replace("rho", r"\rho ").replace("pi", r"\pi ")
