"""The notebooks run from the first cell to the last, and print what they show."""

import re
import sys

import pytest
from package_rooms import ROOT

sys.path.insert(0, str(ROOT / "docs"))

import notebooks

ENGINES_DIGITS = re.compile(r"\d[\d.]*e[+-]\d+ ε|± \d[\d.]*e-\d+|expected -?\d[\d.]*, got -?\d[\d.]* rad")


@pytest.mark.slow  # engines' processes, and proofs
@pytest.mark.parametrize("path", sorted(notebooks.FOLDER.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_prints_what_it_shows(path):
    ran = 0
    for cell, printed in notebooks.run(path):
        assert ENGINES_DIGITS.sub("#", printed) == ENGINES_DIGITS.sub("#", notebooks.shown(cell))
        ran += 1
    assert ran >= 4
