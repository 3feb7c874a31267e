"""Other spellings of derivatives and of functions of time, put into one, letter for letter of the same length.

So that the column of a refusal is a column of what the author wrote, each replacement is padded with blanks. Read here:
Leibniz' d²θ/dt² in one line or as a fraction, sympy's ``Derivative(theta1(t), (t, 2))`` and its LaTeX, ``diff(x, t)``,
``dtheta1``, ``theta1_ddot``, θ₁(t), and numpy's ``np.sin``.
"""

from __future__ import annotations

import re

ANGLE = (
    r"(?:\\(?:var)?(?:theta|phi)(?![A-Za-z])|\\(?:psi|alpha|beta|gamma)(?![A-Za-z])|theta|phi|psi|alpha|beta|gamma"
    r"|th(?![a-z])|[θϑφϕψαβγ𝜃]|(?<![A-Za-z\\])[qxyrst](?![A-Za-z]))"
)
RATE = r"(?:\\omega(?![A-Za-z])|omega|ω|(?<![A-Za-z\\])w(?![A-Za-z]))"
INDEX = (
    r"(?:\s*_\s*\{\s*[0-9A-Za-z]{1,3}\s*\}|_(?!dd?(?:ot)?(?![A-Za-z])|acc|vel)[0-9A-Za-z]|[0-9]{1,2}"
    r"|[A-Z](?![A-Za-z])|[₀-₉]{1,2})?"
)
OF_TIME = r"(?:\(\s*t\s*\)|\{\s*\\left\s*\(\s*t\s*\\right\s*\)\s*\}|\\left\s*\(\s*t\s*\\right\s*\))"
X = rf"(?P<x>{ANGLE}{INDEX})\s*{OF_TIME}?"
BEHIND_D = rf"(?P<x>(?:{ANGLE}|[qxyrsz](?![A-Za-z])){INDEX})\s*{OF_TIME}?"
D = r"(?:\\mathrm\s*\{\s*d\s*\}|\{\s*\\rm\s+d\s*\}|\\mathrm\s*d|\\partial|d|ｄ)"
TWO = r"(?:\^\s*\{\s*2\s*\}|\^\s*2|\*\*\s*2|²)"

# Each with what tells the second derivative from the first: a group that is then not empty.
RULES = [
    rf"(?:Derivative|diff)\(\s*{X}\s*,\s*(?:t(?:\s*,\s*1)?|\(\s*t\s*,\s*1\s*\)|(?P<two>\(\s*t\s*,\s*2\s*\)|t\s*,\s*t|t\s*,\s*2))\s*\)",
    rf"{X}\.diff\(\s*t\s*(?P<two>,\s*(?:2|t)\s*)?\)(?:\.diff\(\s*t\s*\))?",
    rf"\\[dt]?frac\s*\{{\s*{D}\s*(?P<two>{TWO})?\s*{X}\s*\}}\s*\{{\s*{D}\s*t\s*{TWO}?\s*\}}",
    rf"\\[dt]?frac\s*\{{\s*{D}\s*(?P<two>{TWO})?\s*\}}\s*\{{\s*{D}\s*t\s*{TWO}?\s*\}}\s*{X}",
    rf"(?<![A-Za-z]){D}\s*(?P<two>{TWO})?\s*{BEHIND_D}\s*/\s*{D}\s*t\s*{TWO}?(?![A-Za-z])",
    rf"(?<![A-Za-z\\]){D}\s*(?P<two>2|{TWO})?\s*\(\s*{BEHIND_D}\s*\)\s*/\s*{D}\s*t\s*(?:2|{TWO})?(?![A-Za-z0-9])",
    rf"(?<![A-Za-z\\]){D}\s*(?P<two>2)\s*{BEHIND_D}\s*/\s*{D}\s*t\s*2(?![A-Za-z0-9])",
    rf"(?<![A-Za-z\\])(?:d(?P<two>d|2)?)(?P<x>(?:theta|phi|psi|th(?![a-z])|[θϑφϕψ]|q(?![a-z])|\\theta|\\phi){INDEX})",
    rf"(?P<x>(?:theta|phi|psi|th|[θφϕψ]|(?<![A-Za-z])[qx]){INDEX})_?d(?P<two>d)?(?:ot)?(?![A-Za-z0-9])",
    r"(?P<x>theta|phi|psi|th)_?d(?P<two>d)?ot_?(?P<index>[0-9]{1,2})?(?![A-Za-z])",
    rf"(?P<x>{ANGLE}{INDEX})_?d(?P<two>d)?ot(?![A-Za-z0-9])",
    rf"(?P<x>{RATE}{INDEX})_?dot(?![A-Za-z0-9])",
    rf"(?<![A-Za-z]){D}\s*(?P<x>{RATE}{INDEX})\s*{OF_TIME}?\s*/\s*{D}\s*t(?![A-Za-z])",
    rf"(?P<x>(?:theta|phi|psi|th|[θφϕψ]|(?<![A-Za-z])[a-z]){INDEX})_?(?:vel|(?P<two>acc))(?![A-Za-z0-9])",
]
PATTERNS = [re.compile(rule) for rule in RULES]
FUNCTION_OF_TIME = re.compile(
    rf"(?P<x>{ANGLE}{INDEX}|\\d{{1,2}}ot\s*\{{\s*{ANGLE}{INDEX}\s*\}}{INDEX}|(?:omega|[ωΩ]|\\omega){INDEX})\s*{OF_TIME}"
)
TWICE = re.compile(r"\.diff\(\s*t\s*\)\s*\.diff\(\s*t\s*\)")
POWER_FIRST = re.compile(r"(?P<power>\^(?:\{\s*\d\s*\}|\d))(?P<index>_(?:\{\s*[0-9A-Za-z]{1,3}\s*\}|[0-9A-Za-z]))")
MODULES = re.compile(r"\b(?:np|numpy|math|Math|sp|sympy|jnp|torch)\.(?:linalg\.)?(?=[A-Za-z])")
CONTAINERS = re.compile(r"\b(?:array|Matrix|ImmutableMatrix|MutableDenseMatrix|ImmutableDenseMatrix)(?=\s*\()")
DOTTED_OPERATOR = re.compile(r"\.(?=[*/^])")
EQUATION = re.compile(r"^\s*(?:Eq|Equation)\((?P<body>.*)\)\s*$", re.DOTALL)


def plain(line: str, names: frozenset[str] = frozenset()) -> str:
    """The line with one spelling for derivatives, of the same length. ``names``: the author's own, which stay."""
    if "Eq" in line:
        line = _equation(line)
    for pattern in (MODULES, CONTAINERS, DOTTED_OPERATOR):
        line = pattern.sub(lambda found: " " * len(found[0]), line)
    for pattern in PATTERNS:
        line = pattern.sub(lambda found: found[0] if found[0].strip() in names else _primed(found), line)
    line = FUNCTION_OF_TIME.sub(lambda found: found["x"].ljust(len(found[0])), line)
    return POWER_FIRST.sub(lambda found: found["index"] + found["power"], line)


def _primed(found: re.Match[str]) -> str:
    groups = found.groupdict()
    primes = "''" if groups.get("two") or TWICE.search(found[0]) else "'"
    written = found["x"] + (groups.get("index") or "") + primes
    return written.ljust(len(found[0])) if len(written) <= len(found[0]) else found[0]


def _equation(line: str) -> str:
    """sympy's Eq(left, right) with an equals sign."""
    found = EQUATION.match(line)
    if found is None:
        return line
    depth = 0
    for at, c in enumerate(found["body"]):
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            start = found.start("body") + at
            inner = line[: found.start("body")], line[found.start("body") : start], line[start + 1 : found.end("body")]
            return " " * len(inner[0]) + inner[1] + "=" + inner[2]
    return line
