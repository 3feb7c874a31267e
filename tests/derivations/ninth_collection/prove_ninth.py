"""Proves the verdict of every derivation of this folder: `python prove_ninth.py` prints each with what differs."""

import sys
import tomllib
from pathlib import Path

import prove_ninth_carts
import prove_ninth_pendulums
from prove import rates_hold
from truth import compare, conventions

HERE = Path(__file__).parent
PROOFS = prove_ninth_carts.PROOFS | prove_ninth_pendulums.PROOFS


def verdict(name):
    """'correct', or 'wrong' and the first state at which the printed rows have other accelerations."""
    mechanism, rows, *more = PROOFS[name]
    special = next((part for part in more if isinstance(part, dict)), None)
    rates = next((part for part in more if isinstance(part, list)), [])
    if not rates_hold(rates, mechanism):
        return "wrong", {"printed": "the rates do not follow from the momenta"}
    counterexample = compare(rows, mechanism, special)
    return ("wrong", counterexample) if counterexample else ("correct", None)


def right_in(name):
    """The conventions of angles and slides in which the rows of a wrong derivation would be right."""
    mechanism, rows, *_ = PROOFS[name]
    if not mechanism.shifts:
        return []
    return [how for how, turned in conventions(rows, mechanism) if compare(turned, mechanism) is None]


if __name__ == "__main__":
    INDEX = {}
    for file in sorted(HERE.glob("index*.toml")):
        INDEX |= tomllib.loads(file.read_text(encoding="utf-8"))
    assert set(INDEX) == set(PROOFS), set(INDEX) ^ set(PROOFS)
    for name in sys.argv[1:] or INDEX:
        found, state = verdict(name)
        said = "as said" if found == INDEX[name]["verdict"] else "NOT AS SAID"
        others = right_in(name) if found == "wrong" else []
        print(name, found, said, others, state and {key: state[key] for key in state if key != "state"})
