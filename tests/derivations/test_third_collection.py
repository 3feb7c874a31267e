"""Derivations pasted whole, as programs, pages and forums have them: none is misjudged."""

import tomllib
from functools import cache
from pathlib import Path

import prove_pasted
import pytest
from prove import rates_hold
from truth import compare, conventions

from furiko.derivations.grading.grade import grade
from furiko.models.errors import InvalidInput

HERE = Path(__file__).parent / "third_collection"
INDEX = tomllib.loads((HERE / "index.toml").read_text(encoding="utf-8"))
PROOFS = prove_pasted.PROOFS
# Nine of ten, as of the first collection; of 55 that describe a planar open mechanism, 50 are read today
READ_AS_PRINTED = 0.9


@cache
def judged(name):
    """The verdict and what it rests on, or None where the text is refused."""
    try:
        record = grade(HERE / f"{name}.toml")
    except InvalidInput:
        return None
    return record.verdict, record.assumes


def parts(name):
    """Mechanism, rows, rates that must hold of themselves, and values for which alone the rows are meant."""
    mechanism, rows, *more = PROOFS[name]
    rates = next((x for x in more if isinstance(x, list)), [])
    return mechanism, rows, rates, next((x for x in more if isinstance(x, dict)), None)


def test_every_file_is_in_the_index_and_every_entry_is_proved():
    assert {path.stem for path in HERE.glob("*.toml")} - {"index"} == set(INDEX) == set(PROOFS)
    assert all(("why" in entry) == (entry["verdict"] == "wrong") for entry in INDEX.values())


@pytest.mark.slow
@pytest.mark.parametrize("name", INDEX)
def test_the_verdict_said_is_proved(name):
    mechanism, rows, rates, special = parts(name)
    right = rates_hold(rates, mechanism) and compare(rows, mechanism, special) is None
    assert right == (INDEX[name]["verdict"] == "correct")


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, entry in INDEX.items() if entry["verdict"] == "wrong"])
def test_what_is_wrong_is_wrong_in_every_convention_that_its_file_leaves_open(name):
    mechanism, rows, rates, _ = parts(name)
    if rates or "from" in tomllib.loads((HERE / f"{name}.toml").read_text(encoding="utf-8")):
        return
    assert not [how for how, turned in conventions(rows, mechanism) if compare(turned, mechanism) is None]


@pytest.mark.slow
@pytest.mark.parametrize("name", INDEX)
def test_none_is_misjudged(name):
    found = judged(name)
    if found is not None and found[0] != INDEX[name]["verdict"]:
        assert found[0] == "correct"  # right on a condition that is said
        assert found[1]


@pytest.mark.parametrize("name", [name for name, entry in INDEX.items() if "outside" in entry])
def test_what_cannot_be_declared_is_refused_and_says_so(name):
    with pytest.raises(InvalidInput, match=r"cannot be declared|is not known; give one of"):
        grade(HERE / f"{name}.toml")


@pytest.mark.slow
def test_nine_of_ten_are_read_as_printed():
    inside = [name for name, entry in INDEX.items() if "outside" not in entry]
    read = [name for name in inside if judged(name) is not None]
    assert len(read) >= READ_AS_PRINTED * len(inside), f"{len(read)} of {len(inside)} are read as printed"
