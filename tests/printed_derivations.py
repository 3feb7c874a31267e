# ruff: noqa: E501 -- messages stand on one line
"""Right and wrong derivations printed by printers that are not furiko's, and rewritten at random: none is misjudged.

    python tests/printed_derivations.py [--count 3000] [--seed 1] [--wrong] [--seconds N]

What is derived, and the mistakes, are those of ``planted_campaign.py``, by sympy alone. Printers: sympy's str, srepr,
latex, octave_code and pycode. Rewritten: rows combined with factors, expanded, factored, collected, with other cos and
sin, and moved across the equals sign. A wrong one is one whose accelerations sympy finds to be others.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter
from collections.abc import Callable
from functools import cache
from typing import Any

import planted_campaign as planted
import sympy as sp
from sympy.printing.octave import octave_code
from sympy.printing.pycode import pycode
from sympy.simplify.fu import TR5, TR6, TR8

from furiko import InvalidInput
from furiko.derivations.grading.grade import grade_text

GREEK = ("theta", "phi")


def _names(f: Any) -> dict[Any, tuple[str, int]]:
    """Coordinates, rates and accelerations in a formula: their name, and how often they are derived."""
    found = {}
    for x in f.free_symbols:
        for k, prefix in enumerate(("R", "A"), 1):
            if x.name[:1] == prefix and x.name[1:].rstrip("0123456789") in ("theta", "phi", "x", "r"):
                found[x] = (x.name[1:], k)
    return found


def _latex(f: Any) -> str:
    def dotted(name: str, times: int) -> str:
        base = name.rstrip("0123456789")
        letter = f"\\{base}" if base in GREEK else base
        index = name[len(base) :]
        return f"\\{'d' * times}ot{{{letter}}}" + (f"_{{{index}}}" if index else "")

    return str(sp.latex(f, symbol_names={x: dotted(*of) for x, of in _names(f).items()}))


def _of_time(f: Any) -> Any:
    t = sp.Symbol("t")
    values = {x: sp.Derivative(sp.Function(name)(t), (t, k)) for x, (name, k) in _names(f).items()}
    return f.subs(values)


def _coded(printer: Callable[..., Any]) -> Callable[[Any], str]:
    def show(f: Any) -> str:
        names = {x: sp.Symbol(f"{name}_{'d' * k}ot") for x, (name, k) in _names(f).items()}
        return str(printer(f.subs(names)))

    return show


PRINTERS: dict[str, Callable[[Any], str]] = {
    "str": planted.shown, "latex": _latex, "srepr": lambda f: str(sp.srepr(_of_time(f))),
    "str of Derivative": lambda f: str(_of_time(f)), "octave": _coded(octave_code), "python": _coded(pycode),
}  # fmt: skip


def rewritten(f: Any, draw: random.Random) -> Any:
    """The same in another shape."""
    change = draw.choice((sp.expand, sp.expand, sp.factor_terms, _collected, TR5, TR6, lambda x: TR8(sp.expand(x)), sp.expand_trig,
                          lambda x: x))  # fmt: skip
    return change(f)


def _collected(f: Any) -> Any:
    return sp.collect(sp.expand(f), [x for x in f.free_symbols if x in _names(f)])


def combined_rows(s: Any, draw: random.Random) -> list[Any]:
    """Rows that have the same solutions: a regular matrix of factors times them."""
    factors = [0, 0, 1, -1, 2, sp.Rational(3, 7), *(planted.expression(body["mass"]) for body in s.bodies if body["mass"] != "0"),
               sp.cos(s.q[-1]), sp.Symbol("g")]  # fmt: skip
    n = s.n
    while True:
        a = sp.Matrix(n, n, lambda i, j: draw.choice((1, 2, 3)) if i == j else draw.choice(factors))
        point = {x: sp.Rational(draw.randrange(2, 40), 7) for x in a.free_symbols}
        if abs(a.subs(point).evalf(30).det()) > 1e-9:
            return [sum(a[i, j] * s.rows[j] for j in range(n)) for i in range(n)]


def text_of(s: Any, form: str, draw: random.Random) -> tuple[str, str] | None:
    """The derivation in a form, by a printer; None where nobody would write it so."""
    printer = draw.choice([x for x in PRINTERS if x != "srepr" or form in ("rows", "lagrangian", "energies")])
    kept, rows = planted.shown, s.rows
    planted.shown = lambda f: PRINTERS[printer](rewritten(sp.sympify(f), draw))  # type: ignore[assignment]
    try:
        if form == "rows" and draw.random() < 0.5:
            s.rows = combined_rows(s, draw)
        text = planted.written(s, form)
    finally:
        planted.shown, s.rows = kept, rows
    return None if text is None else (text, printer)


@cache
def right(name: str, origin: str, angles: str) -> Any:
    """The derivation of a mechanism without a mistake."""
    return planted.derive(planted.MECHANISMS[name], origin, angles, (), random.Random(0))


def campaign(
    count: int, seed: int, *, wrong: bool, seconds: float = float("inf")
) -> tuple[Counter[str], list[str], float]:
    """What came of all, those that are misjudged, and the slowest verdict [s]."""
    draw, tally, bad, slowest = random.Random(f"{seed} {wrong}"), Counter[str](), [], 0.0
    begun = time.monotonic()
    while sum(tally.values()) < count and time.monotonic() - begun < seconds:
        name, form = draw.choice(list(planted.MECHANISMS)), draw.choice(planted.FORMS)
        origin, angles = draw.choice(planted.CONVENTIONS)
        s, what = right(name, origin, angles), ""
        if wrong:
            mistakes = draw.sample(list(planted.MISTAKES), draw.choice((1, 1, 2)))
            made = [planted.MISTAKES[x] for x in mistakes]
            if any(p[0] in planted.MADE_AFTER.get(form, ()) for p in made):
                continue
            s, what = planted.derive(planted.MECHANISMS[name], origin, angles, made, draw), " and ".join(mistakes)
        found = text_of(s, form, draw) if s is not None else None
        if found is None:
            continue
        text, printer = found
        started = time.process_time()
        try:
            grade = grade_text(text)
            said = grade.verdict if not grade.assumes else f"{grade.verdict} if …"
        except InvalidInput as error:
            said, grade = f"REFUSED {str(error)[:100]}", None
        slowest = max(slowest, time.process_time() - started)
        if wrong and said.startswith("correct"):
            said = "equivalent to right" if planted.equivalent(s, right(name, origin, angles)) else f"ACCEPTED ({said})"
        misjudged = said.startswith(("ACCEPTED", "REFUSED")) or (not wrong and said != "correct")
        tally[f"{printer}: {said[:40]}"] += 1
        if misjudged:
            bad.append(
                f"{printer}, {name}, {form}, {origin} {angles} {what}: {said}\n{text if len(text) < 1500 else ''}"
            )
    return tally, bad, slowest


def main() -> None:
    """Print the table; the exit status is 1 where something is misjudged."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--wrong", action="store_true", help="wrong ones, none of which may be accepted")
    parser.add_argument(
        "--seconds", type=float, default=float("inf"), help="stop after so long, and say how many there were"
    )
    options = parser.parse_args()
    tally, bad, slowest = campaign(options.count, options.seed, wrong=options.wrong, seconds=options.seconds)
    for what, found in sorted(tally.items()):
        print(f"{found:6d}  {what}")
    print(f"{sum(tally.values())} derivations, {len(bad)} misjudged or refused; slowest verdict {slowest:.2f} s")
    print("\n".join(bad[:20]))
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
