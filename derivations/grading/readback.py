"""Says back what was read: the mechanism in words and as a small drawing, conventions, symbols and equations."""

from __future__ import annotations

from ..reading.submission import Submission
from ..steps.families import sentence
from .grade_record import Reading
from .hypotheses import Hypothesis

LETTERS = {
    "l": ("l", "length"), "m": ("m", "mass"), "g": ("g", "gravitational acceleration"), "r": ("ρ", "mass per length"),
    "I": ("I", "moment of inertia"), "c": ("l_c", "distance of the centre of mass from the joint"),
}  # fmt: skip
MOST_DRAWN = 8


def readback(s: Submission, h: Hypothesis | None) -> Reading:
    """What was read, in the meaning in which the derivation was judged."""
    convention = h.convention if h is not None else s.convention
    kind = s.kind
    if h is not None and kind in ("rod-chain", "rods"):
        own_inertia = h.variant.choices.inertia != "value" or h.variant.choices.centre
        kind = "links" if own_inertia else "rod-chain" if h.variant.choices.density else "rods"
    english, japanese = sentence(kind, s.space.n) if s.mechanism is None else s.mechanism.sentence()
    return Reading(
        english,
        japanese,
        drawing(s.kind, s.space.n),
        convention.words,
        convention.words_ja,
        tuple(_symbols(s, h)),
        s.lines,
    )


def _symbols(s: Submission, h: Hypothesis | None) -> list[tuple[str, str]]:
    out = [(written, f"read as {meant}") for written, meant in s.words.said]
    about = h.variant.choices.inertia if h is not None else "value"
    letters = {letter for letter, _ in s.used}
    for letter, (name, meaning) in LETTERS.items():
        if letter not in letters:
            continue
        more = ""
        if letter == "I" and about != "value":
            more = " about the centre of mass" if about == "centre" else " about the joint"
        if (letter == "l" and s.equal_lengths) or (letter == "m" and s.equal_masses):
            more = " of every link"
        out.append((name, meaning + more))
    return [*out, *s.defined]


def drawing(kind: str, n: int) -> str:
    """The mechanism in a line or two of characters: ▽ support, ○ joint, ● point mass, ━ rod with mass, ─ without."""
    if n > MOST_DRAWN or kind == "mechanism":
        return ""
    if kind in ("n-leg", "point-masses"):
        if kind == "n-leg" and n > 2:
            legs = ["▽───●" + "┬───● 2"] + ["     " + ("└" if k == n else "├") + f"───● {k}" for k in range(3, n + 1)]
            return "\n".join(legs)
        return "▽" + "".join(f"───● {k} " if k < n else f"───● {k}" for k in range(1, n + 1)).replace(" ─", "─")
    return "▽" + "○".join(f"━━{k}━━" for k in range(1, n + 1))
