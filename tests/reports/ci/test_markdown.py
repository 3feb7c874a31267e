"""The step summary: what differs comes first, and nothing from outside acts as markup."""

import re
from html.parser import HTMLParser

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.reports.ci.markdown import escape, to_markdown
from furiko.reports.known import Entry, known_in
from furiko.reports.report import Report

HOSTILE = "a|b `c` <img src=x onerror=alert(1)> [l](javascript:x) **b** @you #1 https://x.y \n## h\n| x |"


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, attrs))


def rows_of(text):
    return [line for line in text.splitlines() if line.startswith("|")]


def test_every_row_of_every_table_has_its_columns(make):
    text = to_markdown(make.large(links=(1, 20, 64)))
    for table in re.findall(r"(?:^\|.*\n)+", text, flags=re.M):
        assert len({line.count("|") for line in table.splitlines()}) == 1


def test_what_differs_stands_before_the_table(make):
    text = to_markdown(make.large())
    assert text.startswith("## furiko ✗ 2 of")
    assert text.index("### Causes") < text.index("### Failures") < text.index("### Scene × engine")
    assert text.count("<details>") == text.count("</details>") == 3


def test_it_fits_a_step_summary_however_much_differs(make):
    results = [make.result("differs", check=str(i), reason="long " * 200) for i in range(3000)]
    text = to_markdown(make.report(*results))
    assert len(text.encode()) < 2**20
    assert "… and 2950 more" in text


def test_cut_off_is_said_first(make):
    whole = make.report(make.result())
    text = to_markdown(Report(whole.header, whole.results))
    assert "[!WARNING]\n> This run was cut off" in text
    assert "cut off" not in to_markdown(whole)


@pytest.mark.parametrize("field", ["scene", "engine", "check", "reason", "unit", "cause"])
@pytest.mark.parametrize("outcome", ["agrees", "differs", "skipped", "error"])
def test_hostile_text_is_inert(make, field, outcome):
    result = make.result(outcome, **({"reason": "r"} | {field: HOSTILE}))
    calm = to_markdown(make.report(make.result(outcome, **({"reason": "r"} | {field: "calm"})), command="calm"))
    text = to_markdown(make.report(result, command=HOSTILE))
    assert len(rows_of(text)) == len(rows_of(calm))
    assert [row.count("|") for row in rows_of(text)] == [row.count("|") for row in rows_of(calm)]
    tags = Tags()
    tags.feed(text)
    assert {tag for tag, _ in tags.found} <= {"details", "summary"}
    for sign in ("`", "**b", "[l]", "](", "@you", "https://", " #1"):
        assert sign not in text


@settings(deadline=None)
@given(st.text())
def test_escaped_text_has_no_sign_that_marks_up(text):
    assert re.fullmatch(r"(?:[^\W_]|[^\x00-\x7f]|[ .,;'()/+=%-]|&#\d+;)*", escape(text))


def test_loose_results_are_rows_of_their_own(make):
    text = to_markdown(make.report(make.result("loose", reason="Monte-Carlo"), make.result(check="b")))
    assert "### ≈ Loose" in text
    assert "| rods-2 | mujoco | accelerations | 50 ε | 4 ε | 64 ε | Monte-Carlo |" in text.replace("&#949;", "ε")
    assert "| rods-2 | ≈ loose 50 ε |" in text
    assert "Loose" not in to_markdown(make.report(make.result()))


def test_what_has_no_cause_and_what_is_known_are_told(make):
    run = make.report(make.result("differs"), make.result("differs", check="energy"))
    text = to_markdown(run, known_in(run, [Entry("*", "*", "it is a fake", check="energy")])).replace("&#58;", ":")
    assert "### Known differences: 1 of 2 differences; 1 not known\n" in text
    assert ": 1 difference: it is a fake\n" in text
    assert "### Differs without a known cause\n\n- " in text
