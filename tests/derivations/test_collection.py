"""Public derivations as their authors print them: none is misjudged, and how many can be read as they stand."""

import tomllib
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from verdicts import index_of

from furiko.derivations.grading.grade import grade
from furiko.models.errors import InvalidInput

HERE = Path(__file__).parent / "collection"
INDEX = index_of(HERE)
# Nine of ten: what somebody may expect who pastes a derivation and has read no manual
READ_AS_PRINTED = 0.9


@cache
def judged(name):
    """The verdict and what it rests on, or None where the text is refused."""
    try:
        record = grade(HERE / f"{name}.toml")
    except InvalidInput:
        return None
    return record.verdict, record.assumes


def proofs():
    """The module that proves this collection: it takes seconds to state, and other tests do without."""
    return import_module("prove")


@pytest.mark.proof
@pytest.mark.slow
def test_every_entry_is_proved():
    assert set(proofs().PROOFS) == set(INDEX)


def test_every_file_is_in_the_index():
    assert {path.stem for path in HERE.glob("*.toml")} - {"index"} == set(INDEX)
    assert len(INDEX) >= 60
    for name, entry in INDEX.items():
        assert entry["verdict"] in {"correct", "wrong"}, name
        assert ("why" in entry) == (entry["verdict"] == "wrong"), name
        assert {"source", "mechanism", "coordinates", "form"} <= set(entry), name


@pytest.mark.proof
@pytest.mark.slow
@pytest.mark.parametrize("name", INDEX)
def test_the_verdict_said_is_proved(name):
    found, counterexample = proofs().verdict(name)
    assert found == INDEX[name]["verdict"], counterexample
    assert (counterexample is None) == (found == "correct")


@pytest.mark.proof
@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, entry in INDEX.items() if entry["verdict"] == "wrong"])
def test_what_is_wrong_is_wrong_in_every_convention_that_its_file_leaves_open(name):
    file = tomllib.loads((HERE / f"{name}.toml").read_text(encoding="utf-8"))
    assert not proofs().right_in(name) or "from" in file


@pytest.mark.slow
@pytest.mark.parametrize("name", INDEX)
def test_none_is_misjudged(name):
    found = judged(name)
    if found is None:
        return  # refused: no judgement, and no false one
    what, assumes = found
    if what != INDEX[name]["verdict"]:
        # Right on a condition that is said is no false verdict on what is wrong without it
        assert what == "correct"
        assert assumes
    elif "assumes" in INDEX[name]:
        assert assumes, "right only on a condition, which is not said"


@pytest.mark.slow
def test_nine_of_ten_are_read_as_printed():
    read = [name for name in INDEX if judged(name) is not None]
    assert len(read) >= READ_AS_PRINTED * len(INDEX), f"{len(read)} of {len(INDEX)} are read as printed"
