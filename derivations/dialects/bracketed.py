"""Computer algebra whose derivatives and indices stand in brackets: Mathematica, Maple, Maxima, Modelica, Julia."""

from __future__ import annotations

import re

from .names import GREEK, LOWS

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
WORD = rf"(?:[A-Za-z]+|[{''.join(GREEK.values())}])(?:_?[0-9]+|[{LOWS}]+)?"
_OF_TIME = r"(?:\s*[(\[]\s*t\s*[)\]])?"
GREEK_LETTER = re.compile(rf"\\\[(?:Curly|Capital)?(?P<word>{_GREEK.title()})\](?P<index>[0-9]*)")
SUBSCRIPT = re.compile(r"Subscript\[\s*(?P<x>[^\[\],]{1,12}?)\s*,\s*(?P<i>\w{1,3})\s*\]")
FUNCTION = re.compile(r"(?<![A-Za-z])(?P<name>Sin|Cos|Tan|Sqrt|Abs|Sign)\[")
OF_TIME = re.compile(r"(?P<primes>['′″]{0,2})\s*\[\s*t\s*\]")
ORDER = re.compile(rf"Derivative\[\s*(?P<order>[12])\s*\]\[\s*(?P<x>{WORD})\s*\]\s*(?:\[\s*t\s*\])?")
INDEX = re.compile(r"(?<![A-Za-z0-9_\\])(?P<x>[A-Za-z]+)\[\s*(?P<i>[0-9]{1,2})\s*\]")
ORDERED = re.compile(r"\bt\s*\$\s*2")
QUOTED = re.compile(r"'(?=diff\s*\()")
OPERATOR = re.compile(
    rf"(?<![A-Za-z\\])(?P<of>der(?=\s*\()|D(?=\())\s*\(\s*(?:(?P<two>(?P=of))\s*\(\s*(?P<x>{WORD}){_OF_TIME}\s*\)|(?P<y>{WORD}){_OF_TIME})\s*\)"
)
TWO_EQUALS = re.compile(r"(?<![=<>!])==(?!=)")
TILDE = re.compile(r"(?<=\s)~(?=\s)")
LONGEST_ARGUMENT = 1000  # characters between the brackets of a function
MOST_FUNCTIONS = 400  # of a line, that are rewritten
PAIRS = {"(": ")", "[": "]", "{": "}"}


def closing(line: str, opened: int) -> int:
    """The place of the bracket that closes the one at ``opened``; -1 where there is none."""
    stack = []
    for at in range(opened, min(len(line), opened + LONGEST_ARGUMENT)):
        c = line[at]
        if c in PAIRS:
            stack.append(PAIRS[c])
        elif c in ")]}":
            if not stack or stack.pop() != c:
                return -1
            if not stack:
                return at
    return -1


def padded(text: str, found: re.Match[str]) -> str:
    """As long as what was found."""
    return text.ljust(len(found[0]))


def in_brackets(line: str, names: frozenset[str]) -> str:
    """The line with primes for derivatives and round brackets behind functions. ``names``: the author's own."""
    line = GREEK_LETTER.sub(lambda m: padded(GREEK[m["word"].lower()][0] + m["index"], m), line)
    line = SUBSCRIPT.sub(lambda m: padded(f"{m['x']}_{m['i']}", m), line)
    line = _functions(line)
    line = ORDER.sub(lambda m: padded(m["x"] + "'" * int(m["order"]), m), line)
    line = OF_TIME.sub(lambda m: padded(m["primes"], m), line)
    line = INDEX.sub(lambda m: padded(f"{m['x']}_{m['i']}", m), line)
    line = ORDERED.sub(lambda m: padded("t,2", m), QUOTED.sub(" ", line))
    line = OPERATOR.sub(lambda m: m[0] if m["of"] in names else _primed(m), line)
    return TILDE.sub("=", TWO_EQUALS.sub("= ", line))


def _primed(found: re.Match[str]) -> str:
    return padded((found["x"] or found["y"]) + ("''" if found["two"] else "'"), found)


def _functions(line: str) -> str:
    """Sin[x] as sin(x)."""
    at = 0
    for _ in range(MOST_FUNCTIONS):
        found = FUNCTION.search(line, at)
        if found is None:
            break
        opened, at = found.end() - 1, found.end()
        end = closing(line, opened)
        if end > 0:
            inner = line[opened + 1 : end]
            line = f"{line[: found.start()]}{found['name'].lower()}({inner}){line[end + 1 :]}"
    return line
