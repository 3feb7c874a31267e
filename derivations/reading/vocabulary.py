"""Which letters an author uses for what: found in all his lines together, before any is read.

A capital stands for its small letter where the small one does not occur; φ, ψ, q or α are angles where there is no θ;
letters that count links (θ_A, θ_B) are put in order. What cannot be decided is refused where it stands.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

from ..dialects.names import plain_name, spelling

# Letters of the symbols: t angle, w rate, a acceleration, l, m, g, r density, I a link's own inertia, c its centre.
LETTERS = {
    "theta": "t", "th": "t", "t": "t", "θ": "t", "ϑ": "t", "\\theta": "t", "\\vartheta": "t", "𝜃": "t",
    "omega": "w", "om": "w", "w": "w", "ω": "w", "\\omega": "w",
    "alpha": "a", "a": "a", "α": "a", "\\alpha": "a",
    "l": "l", "ℓ": "l", "\\ell": "l", "m": "m", "g": "g",
    "rho": "r", "ρ": "r", "\\rho": "r", "I": "I", "pi": "p", "π": "p", "\\pi": "p",
}  # fmt: skip
FUNCTIONS = {"cos": "cos", "sin": "sin", "tan": "tan", "\\cos": "cos", "\\sin": "sin", "\\tan": "tan",
             "\\sec": "sec", "\\csc": "csc", "\\cot": "cot", "inv": "inv",
             "det": "det", "\\det": "det", "solve": "solve", "sqrt": "sqrt", "\\sqrt": "sqrt"}  # fmt: skip
# Families of letters that are angles where they are used: the likeliest first, which is also their order.
ANGLES: dict[str, tuple[str, ...]] = {
    "α": ("\\alpha", "alpha", "α"),
    "β": ("\\beta", "beta", "β"),
    "γ": ("\\gamma", "gamma", "γ"),
    "θ": ("\\theta", "\\vartheta", "theta", "θ", "ϑ", "𝜃"),
    "φ": ("\\phi", "\\varphi", "phi", "φ", "ϕ"),
    "ψ": ("\\psi", "psi", "ψ"),
    "q": ("q",),
}
GREEK = r"(?:\\(?:var)?(?:theta|phi)|\\psi|theta|phi|psi|[θϑφϕψ])"
LETTER_INDEX = re.compile(
    rf"{GREEK}\s*\}}?\s*(?:_\s*\{{?\s*(?P<low>[A-Za-z]{{1,2}})(?![A-Za-z])|(?P<direct>[A-Z]{{1,2}})(?![a-z]))"
)
ENVIRONMENT = re.compile(r"\\(?:begin|end)\s*\{[a-zA-Z]+\*?\}")  # aligned has no l that is a length
WORDS = re.compile(
    r"\\[A-Za-z]+|theta|omega|alpha|beta|gamma|phi|psi|rho|pi|cos|sin|tan|inv|sqrt|lambda|Derivative|diff|array|Matrix|Eq|sgn|sign|abs"
)


@dataclass(frozen=True)
class Vocabulary:
    """``letters``: word to kind of symbol; ``fixed``: word to (kind, index) of one symbol; ``indices``: A to 1.

    ``said``: what was decided, as (what is written, what it is read as).
    """

    letters: dict[str, str] = field(default_factory=lambda: dict(LETTERS))
    fixed: dict[str, tuple[str, int]] = field(default_factory=dict)
    indices: dict[str, int] = field(default_factory=dict)
    said: tuple[tuple[str, str], ...] = ()
    doubtful: dict[str, str] = field(default_factory=dict)  # word: why it is not read
    numbers: dict[str, dict[str, int]] = field(default_factory=dict)  # word: which coordinate each index is
    declared: bool = False  # the mechanism is declared body by body, with names of its own
    apart: frozenset[str] = frozenset()  # names that as one word, ml for m_l, are two side by side

    @cached_property
    def words(self) -> tuple[str, ...]:
        """All words that are not LaTeX commands, the longest first."""
        known = {*self.letters, *self.fixed, *FUNCTIONS, *self.doubtful}
        return tuple(sorted((w for w in known if w[0] != "\\"), key=len, reverse=True))

    def kind(self, word: str) -> str | None:
        """The kind of symbol that a word is, or None."""
        return self.letters.get(word) or (self.fixed[word][0] if word in self.fixed else None)


def vocabulary(lines: Iterable[str], links: int, names: frozenset[str] = frozenset()) -> Vocabulary:
    """What the letters of these lines stand for. ``names``: those that the file itself defines."""
    text = ENVIRONMENT.sub(" ", "\n".join(lines))
    for name in sorted(names, key=len, reverse=True):
        pattern = spelling(plain_name(name) or name).pattern
        text = re.sub(rf"(?<![A-Za-z0-9_\\])(?:{pattern})(?![A-Za-z0-9_])", " ", text)
    letters, said, doubtful = dict(LETTERS), [], {}
    bare = set(WORDS.sub(" ", text))
    for capital, small, twins in (("L", "l", "lℓ"), ("M", "m", "m"), ("J", "I", "I"), ("G", "g", "g")):
        if capital not in bare:
            continue
        if bare.isdisjoint(twins) and not (small == "l" and "\\ell" in text):
            letters[capital] = letters[small]
            said.append((capital, small))
        else:
            doubtful[capital] = (
                f"both {small} and {capital} are used here, and only {small} is known; "
                f'say what {capital} is, as in [define] {capital} = "…"'
            )
    fixed = _angles(text, links, letters, said)
    return Vocabulary(letters, fixed, _indices(text, links, said), said=tuple(said), doubtful=doubtful)


def _angles(text: str, links: int, letters: dict[str, str], said: list[tuple[str, str]]) -> dict[str, tuple[str, int]]:
    """Adds the words that are angles to ``letters``, or gives each an angle of its own."""
    present = [name for name, words in ANGLES.items() if any(_occurs(word, text) for word in words)]
    certain = [name for name in present if name in ("θ", "φ", "ψ", "q")]
    if len(certain) < links and not ("θ" in certain and _is_indexed("θ", text)):
        moving = [name for name in present if name in ("α", "β", "γ") and _moves(name, text)]
        certain = [name for name in present if name in certain or name in moving]
    if certain in ([], ["θ"]):
        return {}
    if len(certain) == 1:
        letters.update(dict.fromkeys(ANGLES[certain[0]], "t"))
        said.append((certain[0], "angle"))
        return {}
    if len(certain) == links and not any(_is_indexed(name, text) for name in certain):
        for k, name in enumerate(certain, 1):
            for word in ANGLES[name]:
                letters.pop(word, None)
            said.append((name, f"θ{k}"))
        return {word: ("t", k) for k, name in enumerate(certain, 1) for word in ANGLES[name]}
    return {}


def _occurs(word: str, text: str) -> bool:
    if word == "q":
        return re.search(r"(?<![A-Za-z\\])d{0,2}q(?![A-Za-z])", text) is not None
    return re.search(re.escape(word) + (r"(?![A-Za-z])" if word[0] == "\\" else ""), text) is not None


def _is_indexed(name: str, text: str) -> bool:
    return any(re.search(re.escape(word) + r"\s*\}?\s*(?:_|[0-9₀-₉])", text) for word in ANGLES[name])


def _moves(name: str, text: str) -> bool:
    """Whether a letter has a dot, a prime, or stands at once behind cos or sin."""
    for word in ANGLES[name]:
        w = re.escape(word)
        if re.search(rf"dot\s*\{{?\s*{w}|{w}\s*_?\{{?[0-9]?\}}?['′\u0307\u0308]|(?:cos|sin)\s*\(?\s*{w}", text):
            return True
    return False


def _indices(text: str, links: int, said: list[tuple[str, str]]) -> dict[str, int]:
    """Letters in place of the numbers of links, in the order of the alphabet; none unless there is one for each."""
    found: set[str] = set()
    pairs: set[str] = set()
    for match in LETTER_INDEX.finditer(text):
        letters = match["low"] or match["direct"]
        found |= set(letters)
        pairs |= {letters} if len(letters) == 2 else set()
    if len(found) != links or not found:
        return {}
    said.extend((f"θ{pair}", f"θ{pair[0]} − θ{pair[1]}") for pair in sorted(pairs))
    said.extend((f"index {letter}", str(k)) for k, letter in enumerate(sorted(found), 1))
    return {letter: k for k, letter in enumerate(sorted(found), 1)}
