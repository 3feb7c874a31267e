"""Proves the verdict of every derivation of the collection: `python prove.py` prints each with its counterexample."""

import sys
import tomllib
from pathlib import Path

import prove_machines
import prove_pendulums
from truth import compare, conventions, rates_hold

HERE = Path(__file__).parent
INDEX = tomllib.loads((HERE / "index.toml").read_text(encoding="utf-8"))
PROOFS = prove_pendulums.PROOFS | prove_machines.PROOFS


def verdict(name):
    """'correct', or 'wrong' and the first state at which the printed rows have other accelerations."""
    mechanism, rows, *rates = PROOFS[name]
    if rates and not rates_hold(rates[0], mechanism):
        return "wrong", {"printed": "the rates do not follow from the momenta"}
    counterexample = compare(rows, mechanism)
    return ("wrong", counterexample) if counterexample else ("correct", None)


def right_in(name):
    """The conventions of angles and slides in which the rows of a wrong derivation would be right: none."""
    mechanism, rows, *rates = PROOFS[name]
    if rates:
        return []
    return [how for how, turned in conventions(rows, mechanism) if compare(turned, mechanism) is None]


if __name__ == "__main__":
    for name in sys.argv[1:] or INDEX:
        found, state = verdict(name)
        said = "as said" if found == INDEX[name]["verdict"] else "NOT AS SAID"
        others = right_in(name) if found == "wrong" else []
        print(name, found, said, others, state and {k: state[k] for k in state if k != "state"})
