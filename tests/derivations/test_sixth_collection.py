"""Derivations as public notes and programs have them (the sixth collection): each verdict is proved. How furiko reads
them is not held here."""

import tomllib
from pathlib import Path

import pytest
from prove import rates_hold
from prove_sixth import PROOFS
from truth import compare, conventions

HERE = Path(__file__).parent / "sixth_collection"
INDEX = tomllib.loads((HERE / "index.toml").read_text(encoding="utf-8"))


def parts(name):
    """Mechanism, rows, rates that must hold of themselves, and values for which alone the rows are meant."""
    mechanism, rows, *more = PROOFS[name]
    rates = next((x for x in more if isinstance(x, list)), [])
    return mechanism, rows, rates, next((x for x in more if isinstance(x, dict)), None)


def test_every_file_is_in_the_index_and_every_entry_is_proved():
    files = {path.stem for path in HERE.glob("*.toml") if path.stem != "index"}
    assert files == set(INDEX) == set(PROOFS)
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
