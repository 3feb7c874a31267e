"""Proves the verdict of every derivation of this folder: `python prove_ninth.py` prints each with what differs."""

from pathlib import Path

import prove_ninth_carts
import prove_ninth_pendulums
from verdicts import print_verdicts

PROOFS = prove_ninth_carts.PROOFS | prove_ninth_pendulums.PROOFS


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
