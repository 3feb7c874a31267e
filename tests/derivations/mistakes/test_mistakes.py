"""The catalogue: its names, what in it is right after all, and that each mistake does what its name says."""

import pytest
from handwritten import ROW_1, ROW_2, SHIKI_2_10, TAKENO_18, TAKENO_19, toml

from furiko.derivations.algebra.multiples import is_multiple
from furiko.derivations.algebra.symbols import KINDS, symbols_of
from furiko.derivations.mistakes.catalogue import catalogue
from furiko.derivations.mistakes.known_mistakes import known_mistakes
from furiko.derivations.reading.submission import parse_submission
from furiko.derivations.steps.derivation import correct_derivation, derive
from furiko.derivations.steps.views import View


@pytest.mark.parametrize("n", [2, 3, 4])
@pytest.mark.parametrize("kind", KINDS)
def test_names_are_unique_and_sentences_are_there(kind, n):
    mistakes = catalogue(symbols_of(kind, n))
    assert len({mistake.name for mistake in mistakes}) == len(mistakes)
    for mistake in mistakes:
        assert mistake.english.endswith((".", "nothing."))
        assert mistake.japanese.endswith(("。", "）。"))
        assert len(mistake.english) < 400


def test_the_catalogue_generates_thousands():
    assert sum(len(catalogue(symbols_of(kind, n))) for kind in KINDS for n in (2, 3, 4)) > 3000
    assert len({mistake.code for kind in KINDS for mistake in catalogue(symbols_of(kind, 4))}) > 100


# By hand: the sign of x squared away (link 1 alone; its y in the speed), the zero of height, terms that are zero anyway
EQUIVALENT = {
    "n-leg": {
        "x-sign:1:1", "cosine-derivative-sign:1:1", "zero-of-height-moved", "centripetal-missing:1",
        "centripetal-sign:1",
    },
    "rod-chain": {
        "x-sign:1:1", "cosine-derivative-sign:1:1", "zero-of-height-moved", "centripetal-missing:1",
        "centripetal-sign:1",
        "inertia-relative-rate:1", "carriers-halved:1",
    },
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_right_after_all_is_just_what_must_be(kind):
    known = known_mistakes(View(symbols_of(kind, 3)))
    assert {mistake.name for mistake in known.equivalent} == EQUIVALENT[kind]


@pytest.mark.parametrize("kind", KINDS)
def test_wrong_means_wrong_exactly(kind):
    """The known are taken at one random point; exactly, each wrong one has rows that are no multiples."""
    m = symbols_of(kind, 3)
    for entry in known_mistakes(View(m)).wrong:
        rows = derive(m, [entry.mistake]).rows
        wrong = [i for i in range(3) if not is_multiple(rows[i], correct_derivation(m).rows[i])]
        assert wrong == sorted(entry.rows)


# (name, n, what it must lead to, by hand)
BY_HAND = [
    ("n-leg", "segment-missing:2:1", ["m1*l1*a1 = -m1*g*sin(t1)", "l2*a2 = -g*sin(t2)"]),
    ("n-leg", "cross-term-halved:2:1:2", [
        ROW_1.replace("m2*l2*a2", "m2*l2/2*a2").replace("m2*l2*w2", "m2*l2/2*w2"),
        ROW_2.replace("m2*l1*a1", "m2*l1/2*a1").replace("m2*l1*w1", "m2*l1/2*w1")]),
    ("n-leg", "relative-angle:2", [
        "(m1+m2)*l1^2*a1 + m2*l2^2*(a1+a2) + m2*l1*l2*((2*a1+a2)*cos(t2) - w2*(2*w1+w2)*sin(t2))"
        " + (m1+m2)*g*l1*sin(t1) + m2*g*l2*sin(t1+t2) = 0",
        "m2*l2^2*(a1+a2) + m2*l1*l2*(a1*cos(t2) + w1^2*sin(t2)) + m2*g*l2*sin(t1+t2) = 0"]),
    ("n-leg", "sine-cosine-swapped:2:2", [
        "(m1+m2)*l1*a1 - m2*l2*(a2*sin(t1+t2) + w2^2*cos(t1+t2)) + (m1+m2)*g*sin(t1) = 0",
        "l2*a2 - l1*(a1*sin(t1+t2) + w1^2*cos(t1+t2)) - g*cos(t2) = 0"]),
    ("n-leg", "height-sine:2:2", [ROW_1, ROW_2.replace("+ m2*g*sin(t2)", "- m2*g*cos(t2)")]),
    ("n-leg", "wrong-length-in-height:2:1:2", [ROW_1.replace("(m1+m2)*g", "(m1+m2*l2/l1)*g"), ROW_2]),
    ("n-leg", "potential-not-differentiated:1", [
        ROW_1.replace("(m1+m2)*g*sin(t1)", "-(m1+m2)*g*cos(t1)").replace("+ -", "-"), ROW_2]),
    ("n-leg", "wrong-rate-in-velocity:2:2:1", [
        "(m1+m2)*l1*a1 + m2*l2*(2*a1*cos(t1-t2) - w1^2*sin(t1-t2)) + m2*l2^2/l1*a1 + m2*l2*w1*w2*2*sin(t1-t2)"
        " + (m1+m2)*g*sin(t1) = 0",
        "-m2*l1*w1^2*sin(t1-t2) + m2*g*sin(t2) = 0"]),
    ("n-leg", "centripetal-missing:2", [
        ROW_1.replace("m2*l2*w2^2*sin(t1-t2)", "0"), ROW_2.replace("m2*l1*w1^2*sin(t1-t2)", "0")]),
    ("n-leg", "velocity-terms-forgotten", [ROW_1.replace("w2^2", "w1*w2"), ROW_2.replace("w1^2", "w1*w2")]),
    ("n-leg", "other-angles-held:1", [ROW_1.replace("m2*l2*w2^2*sin(t1-t2)", "0"), ROW_2]),
    ("n-leg", "kinetic-slope-missing", [
        ROW_1.replace("w2^2", "(w2^2-w1*w2)"), ROW_2.replace("w1^2", "(w1^2-w1*w2)")]),
    ("n-leg", "lagrange-sign:2", [
        ROW_1, "m2*l2*a2 + m2*l1*a1*cos(t1-t2) - m2*l1*(w1^2-2*w1*w2)*sin(t1-t2) - m2*g*sin(t2)=0"]),
    ("n-leg", "square-not-doubled:1", [ROW_1.replace("(m1+m2)*l1*a1", "(m1+m2)/2*l1*a1"), ROW_2]),
    ("n-leg", "gravity-on-one-mass-only:2", [ROW_1.replace("(m1+m2)*g", "m2*g"), ROW_2]),
    ("n-leg", "divided-on-the-right-only:2", [
        ROW_1, ROW_2.replace("m2*l2*a2 + m2*l1*a1*cos(t1-t2)", "m2*l2^2*a2 + m2*l1*l2*a1*cos(t1-t2)")]),
    ("n-leg", "mass-left-out:1", [ROW_1.replace("(m1+m2)", "m2"), ROW_2]),
    ("n-leg", "mass-counted-twice:1", [ROW_1.replace("(m1+m2)", "(2*m1+m2)"), ROW_2]),
    ("n-leg", "mass-counted-twice:2", [
        ROW_1.replace("(m1+m2)", "(m1+2*m2)").replace(" m2*", " 2*m2*"), ROW_2]),
    ("n-leg", "inertia-counted-twice", [
        ROW_1.replace("(m1+m2)*l1*a1", "(2*m1+m2)*l1*a1"), ROW_2.replace("m2*l2*a2", "2*m2*l2*a2")]),
    ("n-leg", "hung-from-a-leg:3", [
        SHIKI_2_10[0] + " - m3*(l2*a2*cos(t1-t2) + l2*w2^2*sin(t1-t2))",
        "(m2+m3)*(l2*a2 + l1*a1*cos(t1-t2) - l1*w1^2*sin(t1-t2) + g*sin(t2))"
        " + m3*l3*(a3*cos(t2-t3) + w3^2*sin(t2-t3)) = 0",
        "l3*a3 + l1*a1*cos(t1-t3) - l1*w1^2*sin(t1-t3) + l2*a2*cos(t2-t3) - l2*w2^2*sin(t2-t3) + g*sin(t3) = 0"]),
    ("rod-chain", "inertia-missing:3", [*TAKENO_18[:2], TAKENO_18[2].replace("l3/3*l3*a3", "l3/4*l3*a3")]),
    ("rod-chain", "centre-at-end:3", [
        TAKENO_18[0].replace("l3/2*l3", "l3*l3"), TAKENO_18[1].replace("l3/2*l3", "l3*l3"),
        TAKENO_18[2].replace("l3/2", "l3").replace("l3/3*l3", "(1+1/12)*l3*l3")]),
    ("rod-chain", "weight-missing:3", [
        TAKENO_18[0].replace("(l1/2 + l2 + l3)*g", "(l1/2 + l2)*g"), TAKENO_18[1].replace("(l2/2 + l3)*g", "l2/2*g"),
        TAKENO_18[2].replace("l3/2*g*sin(t3)", "0")]),
    ("rod-chain", "arm-whole-length:3", [*TAKENO_18[:2],
        "l3*l1*(a1*cos(t3-t1) + w1^2*sin(t3-t1)) + l3*l2*(a2*cos(t3-t2) + w2^2*sin(t3-t2))"
        " + (1/12+1/2)*l3*l3*a3 + l3*g*sin(t3) = 0"]),
    ("rod-chain", "sum-index-own", [
        "(l1/2+2*l1-l1/6)*l1*a1 + (l2/2+l2)*l2*(a2*cos(t1-t2)+w2^2*sin(t1-t2))"
        " + l3/2*l3*(a3*cos(t1-t3)+w3^2*sin(t1-t3)) + (l1/2+2*l1)*g*sin(t1) = 0",
        "(l2/2+l2)*l1*(a1*cos(t2-t1)+w1^2*sin(t2-t1)) + (l2/2+l2-l2/6)*l2*a2 + l3/2*l3*(a3*cos(t2-t3)+w3^2*sin(t2-t3))"
        " + (l2/2+l2)*g*sin(t2) = 0", TAKENO_18[2]]),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "name", "rows"), BY_HAND, ids=[case[1] for case in BY_HAND])
def test_mistakes_lead_to_what_is_worked_out_by_hand(kind, name, rows):
    m = symbols_of(kind, len(rows))
    mistake = next(mistake for mistake in catalogue(m) if mistake.name == name)
    made = derive(m, [mistake]).rows
    for (_, written), row in zip(parse_submission(toml(kind, rows)).rows, made, strict=True):
        assert is_multiple(m.space.split(written), row), m.space.split(written)


def test_the_old_encyclopedia_rods_are_those_without_inertia():
    """Takeno's (19) with 5/4 and 1/4 on the diagonal."""
    m = symbols_of("rod-chain", 2)
    mistake = next(mistake for mistake in catalogue(m) if mistake.name == "inertia-missing")
    rows = [
        TAKENO_19[0].replace(r"\frac{4\ddot{\theta}_1}{3}", r"\frac{5}{4}\ddot{\theta}_1"),
        TAKENO_19[1].replace(r"\frac{\ddot{\theta}_2}{3}", r"\frac{1}{4}\ddot{\theta}_2"),
    ]
    merged = {2 * m.n + 1: 2 * m.n}
    written_rows = parse_submission(toml("rod-chain", rows)).rows
    for (_, written), row in zip(written_rows, derive(m, [mistake]).rows, strict=True):
        assert is_multiple(m.space.split(written), {q: m.space.rename(f, merged) for q, f in row.items()})
