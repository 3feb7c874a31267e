"""Derivations as computer algebra, programs, word processors and textbooks print them (the second collection), pasted
whole, as programs, pages and forums have them (the third), in notations that furiko had not been tried with (the
fourth), and as public notes and programs have them (from the fifth on): none is misjudged."""

import tomllib
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from truth import compare, conventions, rates_hold
from verdicts import index_of, parts

from furiko.derivations.grading.grade import grade, grade_fields
from furiko.models.errors import InvalidInput

HERE = Path(__file__).parent
# Where each collection is proved: modules that are imported for that alone, for they take half a minute to state.
PROVED_IN = {
    "second_collection": ("prove_strange_pendulums", "prove_strange_machines"),
    "third_collection": ("prove_pasted",),
    "fourth_collection": ("prove_fresh",),
    "fifth_collection": ("prove_fifth_code", "prove_fifth_notes"),
    "sixth_collection": ("prove_sixth",),
    "seventh_collection": ("prove_seventh",),
    "seventh_programs": ("prove_seventh_programs",),
    "eighth_collection": ("prove_eighth",),
    "eighth_programs": ("prove_eighth_programs",),
    "ninth_collection": ("prove_ninth",),
    "ninth_programs": ("prove_ninth_programs",),
    "tenth_collection": ("prove_tenth",),
    "tenth_programs": ("prove_tenth_programs",),
}


INDEX = {each: index_of(HERE / each) for each in PROVED_IN}
ENTRIES = {(collection, name): entry for collection, index in INDEX.items() for name, entry in index.items()}
# Nine of ten, as of the first collection. All of the second are read today, and one more refusal is to be looked at,
# not hidden; of the third's 55 that describe a planar open mechanism, 50; of the fourth's 63, 61.
READ_AS_PRINTED = 0.9
# Of the seventh's 49 programs, 12 were read at first; what is read now is not to become less. Of the eighth, gathered
# blind, 37 of 51 printed derivations and 20 of 35 programs were read at first; the printed ones are all read today. Of
# the ninth's 85 printed derivations 52 were read and judged right at first, and of its 59 programs 20; one of each was
# misjudged. Of the tenth, gathered blind as well, 59 of 78 printed derivations and 22 of 39 programs; one program was
# misjudged.
READ_SO_FAR = {
    "seventh_programs": 46,
    "eighth_programs": 33,
    "ninth_programs": 37,
    "tenth_collection": 70,
    "tenth_programs": 29,
}


def each(entries):
    return pytest.mark.parametrize(("collection", "name"), entries, ids=[name for _, name in entries])


@cache
def judged(collection, name):
    """The verdict and what it rests on, or None where the text is refused."""
    try:
        record = grade(HERE / collection / f"{name}.toml")
    except InvalidInput:
        return None
    return record.verdict, record.assumes


@pytest.mark.parametrize("collection", INDEX)
def test_every_file_is_in_the_index(collection):
    index = INDEX[collection]
    files = {path.stem for path in (HERE / collection).glob("*.toml") if not path.stem.startswith("index")}
    assert files == set(index)
    assert all(("why" in entry) == (entry["verdict"] == "wrong") for entry in index.values())


@cache
def proofs(collection):
    modules = [import_module(name) for name in PROVED_IN[collection]]
    return {name: proof for module in modules for name, proof in module.PROOFS.items()}


@pytest.mark.proof
@pytest.mark.slow
@pytest.mark.parametrize("collection", INDEX)
def test_every_entry_is_proved(collection):
    assert set(proofs(collection)) == set(INDEX[collection])


@pytest.mark.proof
@pytest.mark.slow
@each(list(ENTRIES))
def test_the_verdict_said_is_proved(collection, name):
    mechanism, rows, rates, special = parts(proofs(collection)[name])
    right = rates_hold(rates, mechanism) and compare(rows, mechanism, special) is None
    assert right == (ENTRIES[collection, name]["verdict"] == "correct")


@pytest.mark.proof
@pytest.mark.slow
@each([key for key, entry in ENTRIES.items() if entry["verdict"] == "wrong"])
def test_what_is_wrong_is_wrong_in_every_convention_that_its_file_leaves_open(collection, name):
    mechanism, rows, rates, _ = parts(proofs(collection)[name])
    if rates or "from" in tomllib.loads((HERE / collection / f"{name}.toml").read_text(encoding="utf-8")):
        return
    assert not [how for how, turned in conventions(rows, mechanism) if compare(turned, mechanism) is None]


@pytest.mark.slow
@each(list(ENTRIES))
def test_none_is_misjudged(collection, name):
    found = judged(collection, name)
    if found is not None and found[0] != ENTRIES[collection, name]["verdict"]:
        assert found[0] == "correct"  # right on a condition that is said
        assert found[1]


def fields_of(collection, name):
    return tomllib.loads((HERE / collection / f"{name}.toml").read_text(encoding="utf-8"))


INSIDE = [key for key, entry in ENTRIES.items() if "outside" not in entry]
OF_ANOTHER = {  # a uniform rod's rows, that their authors have for a massless rod with a mass at its end
    ("fifth_collection", "sp-readme-rod"): "centre l/2, inertia m*l^2/12",
    ("ninth_collection", "cp-docstring-four-thirds"): "length 2*L, centre L, inertia m*L^2/3",
}
FOUND_WITHOUT_A_NAME = 0.6  # of the right ones


@cache
def judged_without_a_name(collection, name):
    fields = {key: x for key, x in fields_of(collection, name).items() if key not in ("system", "links", "bodies")}
    try:
        return grade_fields(fields)
    except InvalidInput:
        return None


@pytest.mark.slow
@pytest.mark.parametrize(
    ("collection", "name"),
    [pytest.param(*key, id=key[1], marks=() if k % 8 == 0 else pytest.mark.sweep) for k, key in enumerate(INSIDE)],
)
def test_without_the_name_of_its_mechanism_none_is_misjudged(collection, name):
    """What is right is right for the mechanism that is said then, or refused; what is wrong is refused."""
    found = judged_without_a_name(collection, name)
    if found is None:
        return
    assert found.verdict == "correct"
    assert found.assumes[0].startswith("it is about ")
    about = OF_ANOTHER.get((collection, name))
    assert ENTRIES[collection, name]["verdict"] == "correct" if about is None else about in found.assumes[0]


@pytest.mark.slow
@pytest.mark.sweep
def test_most_right_ones_find_their_mechanism_without_its_name():
    right = [key for key in INSIDE if ENTRIES[key]["verdict"] == "correct"]
    found = [key for key in right if judged_without_a_name(*key) is not None]
    assert len(found) >= FOUND_WITHOUT_A_NAME * len(right), f"{len(found)} of {len(right)}"


@each([key for key, entry in ENTRIES.items() if "outside" in entry])
def test_what_cannot_be_declared_is_refused_and_says_so(collection, name):
    with pytest.raises(InvalidInput, match=r"cannot be declared|is not known; give one of"):
        grade(HERE / collection / f"{name}.toml")


@pytest.mark.slow
@pytest.mark.parametrize("collection", INDEX)
def test_nine_of_ten_are_read_as_printed(collection):
    inside = [name for name, entry in INDEX[collection].items() if "outside" not in entry]
    read = [name for name in inside if judged(collection, name) is not None]
    wanted = READ_SO_FAR.get(collection, READ_AS_PRINTED * len(inside))
    assert len(read) >= wanted, f"{len(read)} of {len(inside)} are read as printed"
