"""One slip planted in the right equations of declared mechanisms, in every convention: found, and alone accused."""

import random

import pytest
from declared_mechanisms import RIGHT

from furiko.derivations.algebra.notation import text
from furiko.derivations.algebra.trig import Formula
from furiko.derivations.grading.differences import authors
from furiko.derivations.grading.grade import grade_text
from furiko.derivations.reading.submission import parse_submission
from furiko.derivations.steps.conventions import Convention

MECHANISMS = [
    "cart and pole", "cart and rod, half its length l", "cart and two bobs", "elastic pendulum",
    "springs and dampers between absolute angles", "a bob half-way down a rod", "three legs, as Shiki prints (2.10)",
]  # fmt: skip
ORIGINS = {"down": "down", "up": "up", "horizontal": "right"}


@pytest.mark.slow
@pytest.mark.parametrize("name", MECHANISMS)
def test_a_planted_slip_is_the_only_term_accused(name):
    draw = random.Random(name)
    source = RIGHT[name]
    head = source[: source.index("[equations]")]
    read = parse_submission(source)

    def written(rows, origin, angles):
        lines = [f'{i} = "{authors(read, text(read.space, f))} = 0"' for i, f in enumerate(rows, 1)]
        return "\n".join(
            [f"from = '{origin}'\nangles = '{angles}'\nsense = 'counter-clockwise'", head, "[equations]", *lines]
        )

    for angles in ("absolute", "relative"):
        for origin, side in ORIGINS.items():
            rows = read.mechanism.mechanism(Convention(angles == "relative", side)).rows
            right = grade_text(written(rows, origin, angles))
            assert (right.verdict, right.assumes) == ("correct", ())
            for _ in range(4):
                row, factor = draw.randrange(len(rows)), draw.choice((0, -1, 2, 3))
                key = draw.choice(sorted(rows[row].terms))
                terms = {k: c * (factor if k == key else 1) for k, c in rows[row].terms.items()}
                slipped = list(rows)
                slipped[row] = Formula({k: c for k, c in terms.items() if c})
                answer = grade_text(written(slipped, origin, angles))
                assert answer.verdict == "wrong"
                (finding,) = answer.findings
                assert finding.row == str(row + 1)
