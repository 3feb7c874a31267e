"""Every fault in the table of planted ones still fits the code, and what should notice it is there."""

import shlex

import pytest
from planted_code_faults import ROOT, Fault, misfits, table


@pytest.mark.slow
def test_every_fault_fits_the_code():
    faults = table()
    assert misfits(faults) == []
    assert len(faults) >= 120
    for fault in faults:
        for word in shlex.split(fault.noticed_by):
            assert not word.startswith("tests/") or (ROOT / word).exists(), fault.id


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [("absent", "x", "0 times"), ("a", "b", "2 times"), ("a = 1", "a = (", "never closed")],
)
def test_one_that_does_not_fit_is_told(old, new, says):
    fault = Fault("id", "file.py", old, new, "tests")
    with pytest.raises((ValueError, SyntaxError), match=says):
        fault.planted("a = 1\na == 2\n" if says == "2 times" else "a = 1\n")
