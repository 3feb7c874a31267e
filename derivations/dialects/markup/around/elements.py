# ruff: noqa: E501 -- patterns stand on one line
r"""Elements of JSX and MDX that show a formula: <MathJax>{`$$…$$`}</MathJax>, <BlockMath math={String.raw`…`} />.

In a string of JavaScript a backslash is written twice, \\ddot; in an attribute of plain quotes, and behind String.raw, once.
"""

from __future__ import annotations

import re

_NAME = r"(?:MathJax|InlineMath|BlockMath|MathFormula|MathBlock|MathDisplay|Math|Latex|LaTeX|TeX|Tex|Katex|KaTeX|Formula|Equation|M|Eq)"
_OTHER = r"(?:\s+(?!math|formula|tex|latex|expression|children|code)[\w-]{1,20}(?:=(?:\"[^\"]{0,60}\"|'[^']{0,60}'|\{[^{}]{0,60}\}))?)*"
_STRING = r"(?:(?P<raw>String\.raw)?\s*`(?P<{0}t>[^`]*)`|\"(?P<{0}d>[^\"\n]*)\"|'(?P<{0}s>[^'\n]*)')"
ATTRIBUTE = re.compile(
    rf"<{_NAME}{_OTHER}\s+(?:math|formula|tex|latex|expression|children|code)=(?:\"(?P<plain>[^\"]*)\"|'(?P<quoted>[^']*)'|\{{\s*{_STRING.format('a')}\s*\}}){_OTHER}\s*(?:/>|>\s*</{_NAME}>)"
)
WITHIN = re.compile(rf"<(?P<of>{_NAME}){_OTHER}\s*>\s*\{{\s*{_STRING.format('b')}\s*\}}\s*</(?P=of)>")
AROUND = re.compile(rf"<(?P<of>{_NAME}){_OTHER}\s*>(?P<inner>[^<>`]*)</(?P=of)>")
BARE = re.compile(r"^\s*(?:\{\s*)?(?P<raw>String\.raw)?`(?P<inner>[^`]*\\[^`]*)`\s*\}?\s*;?\s*$")
INLINE = re.compile(r"<(?:InlineMath|M)\b")


def without_elements(text: str) -> str:
    """The text with a display in place of each such element; any other text as it is."""
    bare = BARE.match(text)
    if bare and (bare["raw"] or "\\\\" in bare["inner"]):
        return _display(bare["inner"] if bare["raw"] else _unescaped(bare["inner"]), inline=False)
    if "<" not in text:
        return text
    text = ATTRIBUTE.sub(_of_attribute, text)
    text = WITHIN.sub(lambda m: _display(_read(m, "b"), inline=INLINE.match(m[0]) is not None), text)
    return AROUND.sub(lambda m: _display(m["inner"], inline=INLINE.match(m[0]) is not None), text)


def _of_attribute(found: re.Match[str]) -> str:
    plain = found["plain"] if found["plain"] is not None else found["quoted"]
    inner = plain if plain is not None else _read(found, "a")
    return _display(inner, inline=INLINE.match(found[0]) is not None)


def _read(found: re.Match[str], which: str) -> str:
    """What a string of JavaScript holds."""
    inner = next(x for x in (found[f"{which}{kind}"] for kind in "tds") if x is not None)
    return inner if found["raw"] else _unescaped(inner)


def _unescaped(inner: str) -> str:
    r"""\\ddot as \ddot; a text with a single backslash before a letter has no such strings, and stays."""
    rest = inner.replace("\\\\", "")
    return inner if "\\" in rest else inner.replace("\\\\", "\\")


def _display(inner: str, *, inline: bool) -> str:
    inner = inner.strip()
    if re.search(r"\$|\\\[|\\\(|\\begin\s*\{(?:equation|align|gather|eqnarray|multline)", inner):
        return f"\n{inner}\n"
    return f"${inner}$" if inline else f"\n$${inner}$$\n"
