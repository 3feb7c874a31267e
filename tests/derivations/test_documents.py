"""Whole documents of the tenth collection as they stand, with what each is about where its index says it: LaTeX,
Markdown, text, a notebook and programs. None is misjudged."""

from functools import cache
from pathlib import Path

import pytest
from verdicts import index_of

from furiko.derivations.grading.grade import grade
from furiko.derivations.reading.pinned import Pinned
from furiko.models.errors import InvalidInput

HERE = Path(__file__).parent
# As first tried, blind, 10 of 53 printed documents and 5 of 21 programs were read; what is read is not to become less.
READ_SO_FAR = {"tenth_collection": 30, "tenth_programs": 5}
DOCUMENTS = [(c, n) for c in READ_SO_FAR for n, entry in index_of(HERE / c).items() if "text" in entry]


@cache
def judged(collection, name):
    """The verdict and what it rests on, or None where the document is refused."""
    entry = index_of(HERE / collection)[name]
    says = Pinned(entry.get("system"), entry.get("links")) if {"system", "links"} & entry.keys() else None
    try:
        found = grade(HERE / collection / entry["text"], pinned=says)
    except InvalidInput:
        return None
    return found.verdict, found.assumes


@pytest.mark.slow
@pytest.mark.parametrize(("collection", "name"), DOCUMENTS, ids=[name for _, name in DOCUMENTS])
def test_no_document_is_misjudged(collection, name):
    found = judged(collection, name)
    if found is not None and found[0] != index_of(HERE / collection)[name]["verdict"]:
        assert found[0] == "correct"  # right on a condition that is said
        assert found[1]


@pytest.mark.slow
@pytest.mark.parametrize("collection", READ_SO_FAR)
def test_as_many_documents_are_read_as_before(collection):
    assert sum(judged(c, n) is not None for c, n in DOCUMENTS if c == collection) >= READ_SO_FAR[collection]
