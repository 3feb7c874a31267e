"""Proves the verdict of every derivation of this folder: `python prove_eighth.py` prints each with what differs."""

from pathlib import Path

import prove_eighth_carts
import prove_eighth_pendulums
from verdicts import print_verdicts

PROOFS = prove_eighth_carts.PROOFS | prove_eighth_pendulums.PROOFS


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
