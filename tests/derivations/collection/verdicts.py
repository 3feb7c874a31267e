"""What a proof says of a derivation, and a collection's verdicts printed beside those that its index says.

A proof is (mechanism, rows, …): further it may have a list of rates that must hold of themselves, and a dict of values
for which alone the rows are meant.
"""

import sys
import tomllib

from truth import compare, conventions, rates_hold


def parts(proof):
    """Mechanism, rows, rates, and values, or None for those."""
    mechanism, rows, *more = proof
    rates = next((part for part in more if isinstance(part, list)), [])
    return mechanism, rows, rates, next((part for part in more if isinstance(part, dict)), None)


def verdict(proof):
    """'correct', or 'wrong' and what differs at the first state at which it does."""
    mechanism, rows, rates, special = parts(proof)
    if not rates_hold(rates, mechanism):
        return "wrong", {"printed": "the rates do not follow from the momenta"}
    counterexample = compare(rows, mechanism, special)
    return ("wrong", counterexample) if counterexample else ("correct", None)


def right_in(proof):
    """The conventions of angles and slides in which the rows of a wrong derivation would be right."""
    mechanism, rows, rates, special = parts(proof)
    if rates or not mechanism.shifts:
        return []
    return [how for how, turned in conventions(rows, mechanism) if compare(turned, mechanism, special) is None]


def index_of(folder):
    """All entries of a collection, whatever number of files they stand in."""
    files = sorted(folder.glob("index*.toml"))
    return {name: entry for file in files for name, entry in tomllib.loads(file.read_text(encoding="utf-8")).items()}


def print_verdicts(folder, proofs, others=None):
    """Each verdict, or those of the names on the command line. ``others``: in place of :func:`right_in`, of a name."""
    index = index_of(folder)
    assert set(index) == set(proofs), set(index) ^ set(proofs)
    for name in sys.argv[1:] or index:
        found, state = verdict(proofs[name])
        said = "as said" if found == index[name]["verdict"] else "NOT AS SAID"
        right = [] if found == "correct" else others(name) if others else right_in(proofs[name])
        print(name, found, said, right, state and {key: state[key] for key in state if key != "state"})
