"""What came from outside is shown, and acts on nothing."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from furiko.records.printable import printable, printable_json, without_surrogates


@pytest.mark.slow
@given(st.text())
def test_nothing_that_acts_is_left(text):
    assert all(c.isprintable() or c == "\n" for c in printable(text))


@pytest.mark.slow
@pytest.mark.parametrize("ascii_only", [False, True])
@given(value=st.recursive(st.text(st.characters(exclude_categories=["Cs"])), st.lists))
def test_json_means_the_same(value, ascii_only):
    written = printable_json(json.dumps(value, ensure_ascii=False), ascii_only=ascii_only)
    assert json.loads(written) == value
    assert all(c.isprintable() or c == "\n" for c in written)
    assert written.isascii() or not ascii_only


def test_a_lone_surrogate_is_written_out():
    assert without_surrogates({"\udcff": ["a\udcff", 1, None]}) == {"\\udcff": ["a\\udcff", 1, None]}
