"""Proves the verdict of every derivation of this folder: `python prove_tenth.py` prints each with what differs."""

from pathlib import Path

import prove_tenth_carts
import prove_tenth_pendulums
from verdicts import print_verdicts

PROOFS = prove_tenth_carts.PROOFS | prove_tenth_pendulums.PROOFS


if __name__ == "__main__":
    print_verdicts(Path(__file__).parent, PROOFS)
