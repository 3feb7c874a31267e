"""A line of mathematics as MathML, for notebooks; everything that was written is escaped."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape

SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789−")
TOKEN = re.compile(
    r"(?P<number>[0-9]+(?:\.[0-9]+)?)|(?P<name>cos|sin|tan|l_c|[^\W\d_](?:[A-Za-z]+|[0-9]+)?)(?P<dots>[\u0307\u0308]?)"
    r"|(?P<operator>[-+−=/·()\[\];,])|(?P<space>\s+)|(?P<other>.)",
    re.DOTALL,
)
INDICES = re.compile(r"(?P<low>[₀-₉]*)(?P<high>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]*)")
DOTS = {"\u0307": "˙", "\u0308": "¨"}


def mathml(text: str) -> str:
    """One line of mathematics, as furiko writes it for people: θ̇₁² sin(θ₁ − θ₂)."""
    out, at = [], 0
    while at < len(text):
        found = TOKEN.match(text, at)
        assert found is not None
        at = found.end()
        if found["space"]:
            continue
        if found["name"]:
            base = f"<mi>{escape(found['name'])}</mi>"
            if found["dots"]:
                base = f'<mover accent="true">{base}<mo>{DOTS[found["dots"]]}</mo></mover>'
        elif found["number"]:
            base = f"<mn>{found['number']}</mn>"
        elif found["operator"]:
            base = f"<mo>{found['operator'].replace('-', '−')}</mo>"
        else:
            base = f"<mtext>{escape(found['other'])}</mtext>"
        indices = INDICES.match(text, at)
        assert indices is not None
        at = indices.end()
        out.append(_indexed(base, indices["low"].translate(SUBSCRIPTS), indices["high"].translate(SUPERSCRIPTS)))
    return f"<math><mrow>{''.join(out)}</mrow></math>"


def _indexed(base: str, low: str, high: str) -> str:
    if low and high:
        return f"<msubsup>{base}<mn>{low}</mn><mn>{high}</mn></msubsup>"
    if low:
        return f"<msub>{base}<mn>{low}</mn></msub>"
    return f"<msup>{base}<mn>{high}</mn></msup>" if high else base


def lines_html(lines: Iterable[str]) -> str:
    """Lines of text as paragraphs."""
    return "".join(f"<p>{escape(line)}</p>" for line in lines)
