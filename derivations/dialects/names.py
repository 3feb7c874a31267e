"""Names as authors write them: a letter or a word, Greek, LaTeX or plain, with an index of letters and figures.

``I_p``, ``Ip`` and ``I_{p}`` are one name, and so are ``tau1``, ``\\tau_1`` and ``τ₁``: all are kept as letters and
figures alone. Only an index with other signs, as in ``s_{1+2}``, keeps them.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from ...models.errors import InvalidInput

LONGEST = 24  # characters of a name
NO_QUANTITIES = ("name", "on", "joint", "along", "about", "motion")  # fields of a body that are words
GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ϵ", "varepsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ𝜃", "vartheta": "ϑ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μµ", "nu": "ν", "xi": "ξ",
    "rho": "ρ", "sigma": "σς", "tau": "τ", "upsilon": "υ", "phi": "ϕ", "varphi": "φ", "chi": "χ", "psi": "ψ",
    "omega": "ω", "Gamma": "Γ", "Delta": "Δ∆", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ",
    "Phi": "Φ", "Psi": "Ψ", "Omega": "ΩΩ",
}  # fmt: skip
GLYPHS = {glyph: word for word, glyphs in GREEK.items() for glyph in glyphs} | {"ℓ": "l"}
LOW = dict(zip("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", strict=True))
HIGH = {low: c for c, low in LOW.items()}
LOWS = "".join(LOW.values())
FIGURES = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_GREEK_WORDS = "|".join(sorted(GREEK, key=len, reverse=True))
_LETTER = rf"(?:\\(?:{_GREEK_WORDS}|ell)(?![A-Za-z])|[A-Za-z]+|[{''.join(GLYPHS)}])"
_INDEX = rf"(?:\s*_\s*\{{[0-9A-Za-z+,\s_]{{1,16}}\}}|(?:_?[0-9A-Za-z])+|[{LOWS}]{{1,6}}|(?<=[^A-Za-z])_[0-9A-Za-z])"
WRITTEN = re.compile(rf"(?P<base>{_LETTER})(?P<index>{_INDEX})?")
JOINED = re.compile(r"[A-Za-z0-9]+")


@cache
def plain_name(written: str) -> str | None:
    """The letters and figures of a name, whatever way it is written; None where it is none."""
    text = _bare(written)
    found = WRITTEN.fullmatch(text) if len(text) <= LONGEST else None
    if found is None:
        return None
    return base_word(found["base"]) + _figures(found["index"] or "")


def base_word(base: str) -> str:
    """The word of a letter: theta of ``\\theta`` and θ, l of ℓ."""
    word = base.removeprefix("\\")
    return GLYPHS.get(word, "l" if word == "ell" else word)


def base_and_index(written: str) -> tuple[str, str] | None:
    """A coordinate's letter or word, and its index, "" for none; None where it is no name."""
    found = WRITTEN.fullmatch(_bare(written)) if len(written) <= LONGEST else None
    if found is None:
        return None
    base, index = found["base"], found["index"] or ""
    word = base_word(base)
    return word, _figures(index)


def _figures(index: str) -> str:
    return "".join(HIGH.get(c, c) for c in index if c not in "_{}, \t\n")


def _bare(written: str) -> str:
    """Without dollar signs and braces around the whole."""
    text = written.strip().strip("$").strip()
    while text.startswith("{") and text.endswith("}"):
        text = text[1:-1].strip()
    return text


def is_joined(written: str) -> bool:
    """Whether a name is written as one word: ``Ip``, not ``I_p``."""
    return JOINED.fullmatch(_bare(written)) is not None


@cache
def spelling(name: str, joined: bool = True) -> re.Pattern[str]:
    """How a name may be written. ``joined``: also as one word, which two names side by side would be as well."""
    word = next((w for w in sorted(GREEK, key=len, reverse=True) if name.startswith(w)), name[:1])
    rest = name[len(word) :]
    if word in GREEK:
        base = rf"(?:\\{word}(?![A-Za-z])|{word}|[{GREEK[word]}])"
    elif word == "l":
        base = r"(?:l|ℓ|\\ell(?![A-Za-z]))"
    else:
        base = re.escape(word)
    if not rest:
        return re.compile(rf"{base}(?!\s*_|[0-9{LOWS}])")
    inner = r"[\s,_]*".join(re.escape(c) for c in rest)
    forms = [rf"\s*_\s*\{{\s*{inner}\s*\}}"]
    if rest.isalnum():
        end = r"(?![0-9])" if rest[-1].isdigit() else ""
        low = "_?".join(rest)
        forms.append(rf"\s*_\s*{low}{end}")
        # A Greek word or more letters than one: the backslash or the figure ends what stands before it
        if joined or word in GREEK or not rest[0].isalpha():
            forms.append(low + end)
        if rest[0].isalpha() and rest[-1].isdigit():  # den₁
            forms.append("".join(f"[{c}{LOW[c]}]" if c.isdigit() else c for c in rest) + rf"(?![0-9{LOWS}])")
    if all(c in LOW for c in rest):
        forms.append("".join(LOW[c] for c in rest) + rf"(?![{LOWS}])")
    return re.compile(rf"{base}(?:{'|'.join(forms)})")


@cache
def splits(word: str, names: frozenset[str]) -> bool:
    """Whether a word is two names or more side by side."""
    known = [name for name in names if name != word]

    def rest(at: int, count: int) -> bool:
        if at == len(word):
            return count > 1
        return any(word.startswith(name, at) and rest(at + len(name), count + 1) for name in known)

    return len(word) <= LONGEST and rest(0, 0)


def require_one_meaning(written: str, bare: str, bodies: list[dict[str, Any]]) -> None:
    """Raises InvalidInput where F, for which a body has F(t), is another quantity of a body already."""
    own = plain_name(bare)
    others = (v for b in bodies for k, v in b.items() if k not in NO_QUANTITIES and isinstance(v, str) and v != written)
    if own is not None and own in map(plain_name, others):
        raise InvalidInput(f"bodies: {written} and {bare} are two quantities with one letter; give one of them another")
