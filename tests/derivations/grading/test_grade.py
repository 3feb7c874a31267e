"""The grader on derivations written by hand."""

import itertools
import random
import time

import pytest
from handwritten import (
    RELATIVE,
    ROW_1,
    ROW_2,
    SHIKI_1_4,
    SHIKI_1_8,
    SHIKI_1_9,
    SHIKI_2_5,
    SHIKI_2_10,
    SOLVED,
    TAKENO_18,
    TAKENO_19,
    WRONG,
    lagrangian,
    toml,
)
from rewritten_derivations import plain

from furiko.derivations.algebra.symbols import symbols_of
from furiko.derivations.grading.grade import grade, grade_text
from furiko.derivations.mistakes.known_mistakes import known_mistakes
from furiko.derivations.steps.derivation import correct_derivation, derive
from furiko.derivations.steps.views import View
from furiko.models.errors import InvalidInput

RIGHT = {
    "Shiki (1.8)": toml("n-leg", SHIKI_1_8),
    "Shiki (1.9)": toml("n-leg", SHIKI_1_9),
    "Shiki (2.10)": toml("n-leg", SHIKI_2_10),
    "Takeno (18)": toml("rod-chain", TAKENO_18),
    "Takeno (19)": toml("rod-chain", TAKENO_19),
    "rows in another order": toml("n-leg", SHIKI_2_10[::-1]),
    "one row of one document's scaling, one of the other": toml("n-leg", [SHIKI_1_8[0], SHIKI_1_9[1]]),
    "solved for the accelerations": toml("n-leg", SOLVED),
    "relative angles": toml("n-leg", RELATIVE, angles="relative"),
    "absolute rows with a sum in place of row 1": toml(
        "n-leg", [f"{ROW_1.split('=')[0]} + 3*l1*({ROW_2.split('=')[0]}) = 0", ROW_2]
    ),
    "a Lagrangian": lagrangian("n-leg", 2, SHIKI_1_4),
    "a Lagrangian of two legs": lagrangian("n-leg", 3, "L = " + SHIKI_2_5),
    "a Lagrangian with another zero of height, and scaled": lagrangian("n-leg", 2, f"3*({SHIKI_1_4} - m1*g*l1)"),
    "a Lagrangian and the time derivative of sin(θ1) w1... added": lagrangian(
        "n-leg", 2, SHIKI_1_4 + " + g*m1*l1*w1*cos(t1)"
    ),
    "single rod": toml("rod-chain", ["l1^2/3*a1 + g*l1/2*sin(t1) = 0"]),
}


@pytest.mark.parametrize("text", RIGHT.values(), ids=RIGHT.keys())
def test_right_derivations_are_correct(text):
    graded = grade_text(text)
    assert graded.verdict == "correct", graded.text()
    assert graded.findings == ()
    assert graded.exit_status == 0


@pytest.mark.parametrize(("what", "system", "rows", "names", "terms"), WRONG, ids=[case[0] for case in WRONG])
def test_wrong_derivations_are_named(what, system, rows, names, terms):
    graded = grade_text(toml(system, rows))
    assert graded.verdict == "wrong"
    assert graded.mistakes, f"{what}: nothing named\n{graded.text()}"
    first = graded.mistakes[0]
    assert len(graded.mistakes) == 1
    assert {first.cause, *(name.split(":")[0] for name in first.also)} & names, graded.text()
    assert terms <= {finding.term for finding in graded.findings}
    assert all(finding.says and finding.says_ja for finding in graded.findings)
    assert graded.exit_status == 1


def test_found_and_expected_are_in_the_rows_own_scaling():
    scaled = "7*l2*(" + ROW_2.replace("a1*cos", "a1*sin").replace("= 0", ") = 0")
    (finding,) = grade_text(toml("n-leg", [ROW_1, scaled])).findings
    assert (finding.equation, finding.term, finding.row) == ("1.10", "A[2,1]", "2")
    assert (finding.found, finding.expected) == ("7*m2*l1*l2*sin(t1-t2)", "7*m2*l1*l2*cos(t1-t2)")


@pytest.mark.parametrize(("links", "rows", "number"), [(2, SHIKI_1_9, "1.10"), (3, SHIKI_2_10, "2.11")])
def test_findings_carry_the_documents_number(links, rows, number):
    graded = grade_text(toml("n-leg", [rows[0].replace("g", "*2*g"), *rows[1:]]))
    assert {finding.equation for finding in graded.findings} == {number}


SINGLE = [case for case in WRONG if case[1] == "n-leg" and len(case[2]) == 2 and case[2][0] == ROW_1]
OTHER = [case for case in WRONG if case[1] == "n-leg" and len(case[2]) == 2 and case[2][1] == ROW_2]


PAIRS = list(itertools.product(OTHER, SINGLE))


@pytest.mark.parametrize(("one", "two"), PAIRS, ids=[f"{one[0]} & {two[0]}" for one, two in PAIRS])
def test_two_mistakes_at_once_are_both_found(one, two):
    graded = grade_text(toml("n-leg", [one[2][0], two[2][1]]))
    assert graded.verdict == "wrong"
    told = {named.cause for named in graded.mistakes}
    told |= {name.split(":")[0] for named in graded.mistakes for name in named.also}
    assert told & one[3], graded.text()
    assert told & two[3], graded.text()
    assert one[4] | two[4] <= {finding.term for finding in graded.findings}


# Two mistakes that meet in a term, so that their changes do not add; worked out by hand.
MEETING = [
    (  # L counts m₁ twice; the derivative of θ̇₁² is not doubled
        [
            "(2*m1+m2)/2*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) + (2*m1+m2)*g*sin(t1) = 0",
            ROW_2,
        ],
        {"mass-counted-twice"},
        {"square-not-doubled", "factor-half"},
    ),
    (  # L counts m₂ twice; the velocity term of row 1 is forgotten
        ["(m1+2*m2)*l1*a1 + 2*m2*l2*a2*cos(t1-t2) + (m1+2*m2)*g*sin(t1) = 0", ROW_2],
        {"mass-counted-twice"},
        {"term-missing", "other-angles-held"},
    ),
    (  # the cross term of v₂² is halved in both rows, and one of the four terms that it makes is right all the same
        [
            "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2)/2 + m2*l2*w2^2*sin(t1-t2)/2 + (m1+m2)*g*sin(t1) = 0",
            "m2*l2*a2 + m2*l1*a1*cos(t1-t2) - m2*l1*w1^2*sin(t1-t2)/2 + m2*g*sin(t2) = 0",
        ],
        {"cross-term-halved", "cross-terms-halved"},
        {"factor-two", "cross-term-halved", "cross-terms-halved"},
    ),
]


@pytest.mark.parametrize(("rows", "one", "two"), MEETING, ids=["halved", "forgotten", "doubled again"])
def test_two_mistakes_that_meet_in_a_term_are_both_found(rows, one, two):
    graded = grade_text(toml("n-leg", rows))
    assert graded.verdict == "wrong"
    told = {named.cause for named in graded.mistakes}
    told |= {name.split(":")[0] for named in graded.mistakes for name in named.also}
    assert told & one, graded.text()
    assert told & two, graded.text()
    assert len(graded.mistakes) == 2, graded.text()


def test_three_slips_are_all_told():
    rows = [
        SHIKI_2_10[0].replace(r"m_2l_2\ddot{\theta}_2 \cos", r"m_2l_2\ddot{\theta}_2 \sin"),
        SHIKI_2_10[1].replace("-m_2g", "+m_2g"),
        SHIKI_2_10[2].replace(r"\dot{\theta}_1^2", r"\cdot 2\dot{\theta}_1^2"),
    ]
    graded = grade_text(toml("n-leg", rows))
    assert {finding.term for finding in graded.findings} == {"A[1,2]", "B[2,2]", "B[3,1]"}
    assert {named.cause for named in graded.mistakes} >= {"sin-for-cos", "factor-two"}


def test_a_mistake_that_nobody_listed_is_told_by_its_term():
    graded = grade_text(toml("n-leg", [ROW_1, ROW_2.replace("m2*g*sin(t2)", "m2*g*sin(t2) + 5*m2*g*cos(3*t1)")]))
    assert graded.verdict == "wrong"
    (finding,) = graded.findings
    assert finding.term == "B[2,2]"
    assert "5" in finding.found


def test_a_slip_in_the_solved_form_is_found_where_it_stands():
    graded = grade_text(toml("n-leg", [SOLVED[0].replace("- m2*g*sin(t1-2*t2)", "+ m2*g*sin(t1-2*t2)"), SOLVED[1]]))
    (finding,) = graded.findings
    assert finding.equation == "1.11"
    assert finding.term == "a1: g"
    assert finding.cause == "part-sign"


def test_a_slip_in_relative_angles_is_told_in_them():
    graded = grade_text(toml("n-leg", [RELATIVE[0].replace("2*w1*w2", "w1*w2"), RELATIVE[1]], angles="relative"))
    (finding,) = graded.findings
    assert finding.found == "-m2*l1*l2*w1*w2*sin(t2)"
    assert finding.expected == "-2*m2*l1*l2*w1*w2*sin(t2)"


def test_what_is_missing_is_said_and_not_judged():
    graded = grade_text(toml("n-leg", [ROW_1], links=2))
    assert graded.verdict == "undecided"
    assert "θ2" in graded.notes[0]


def test_the_same_row_twice_is_no_system():
    graded = grade_text(toml("n-leg", [ROW_1, "2*(" + ROW_1.replace("= 0", ") = 0")]))
    assert graded.verdict == "wrong"
    assert graded.findings[0].cause == "row-repeated"


def test_an_empty_row_is_told():
    graded = grade_text(toml("n-leg", [ROW_1.replace("l2", "l1"), "a1 = a1"]))
    assert graded.verdict == "wrong"


WRONG_LAGRANGIANS = [
    ("half of T2", SHIKI_1_4.replace(r"\frac{1}{2}m_2(", "m_2("), "half-missing"),
    ("l1² forgotten, as (3.4) prints", SHIKI_1_4.replace(r"m_1l_1^2\dot{\theta}_1^2 +", r"m_1\dot{\theta}_1^2 +"),
     "length-missing-in-speed"),
    ("2 of the cross term", SHIKI_1_4.replace("2l_1l_2", "l_1l_2"), "cross-term-halved"),
    ("U of mass 2", SHIKI_1_4.replace(r"+ m_2g(l_1 \cos \theta_1 + l_2 \cos \theta_2)", ""),
     "potential-energy-missing"),
]  # fmt: skip


@pytest.mark.parametrize(("what", "formula", "cause"), WRONG_LAGRANGIANS, ids=[case[0] for case in WRONG_LAGRANGIANS])
def test_wrong_lagrangians_are_named(what, formula, cause):
    graded = grade_text(lagrangian("n-leg", 2, formula))
    assert graded.verdict == "wrong"
    named = graded.mistakes[0]
    assert cause in {named.cause, *(name.split(":")[0] for name in named.also)}, graded.text()
    assert all(finding.term.startswith("L: ") and finding.equation == "1.4" for finding in graded.findings)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["n-leg", "rod-chain"])
def test_a_wrong_derivation_of_four_links_is_graded_within_two_seconds(kind):
    """From nothing, with the catalogue derived; processor time, so that a busy machine does not decide."""
    known_mistakes.cache_clear()
    m = symbols_of(kind, 4)
    known = known_mistakes(View(m))
    text = plain(m, derive(m, [known.wrong[5].mistake, known.wrong[-7].mistake]).rows, random.Random(1))
    known_mistakes.cache_clear()
    start = time.process_time()
    assert grade_text(text).verdict == "wrong"
    assert time.process_time() - start < 2.0


def test_many_links_are_graded_term_by_term_and_at_once():
    m = symbols_of("rod-chain", 12)
    text = plain(m, correct_derivation(m).rows, random.Random(5))
    assert grade_text(text).verdict == "correct"
    start = time.process_time()
    graded = grade_text(text.replace("g*sin(t7)", "g*sin(t8)"))
    assert graded.verdict == "wrong"
    assert {finding.term for finding in graded.findings} == {"G[7]"}
    assert "one by one" in graded.notes[0]
    assert time.process_time() - start < 2


def test_a_file_is_read_and_its_name_told(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(toml("n-leg", SHIKI_1_9), encoding="utf-8")
    assert grade(path).verdict == "correct"
    path.write_text("system = 'n-leg'\nlinks = 2\n[equations]\n1 = 'a1 = ('", encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"mine\.toml: equations\.1: column 7"):
        grade(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InvalidInput, match="UTF-8"):
        grade(path)
    for missing in (tmp_path / "nothing.toml", tmp_path, "\0"):
        with pytest.raises(InvalidInput):
            grade(missing)


def test_the_answer_is_plain_data_and_two_languages():
    graded = grade_text(toml("n-leg", WRONG[0][2]))
    answer = graded.to_dict()
    assert answer["verdict"] == "wrong"
    assert set(answer["findings"][0]) >= {"equation", "term", "found", "expected", "cause", "says"}
    assert "A[2,1]" in graded.text("en")
    assert "誤り" in graded.text("ja")
