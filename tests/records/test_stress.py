"""The records of a stress summary are its JSON document."""

import msgspec
from stress_summaries import document, summary


def test_the_records_write_the_document_that_they_were_read_from():
    assert msgspec.to_builtins(summary()) == document()


def test_a_long_run_too_short_to_classify_has_no_exponent_in_the_document():
    (run,) = document()["long runs"]
    short = {key: value for key, value in run.items() if key not in ("exponent", "rate", "spread")} | {"kind": None}
    again = msgspec.to_builtins(summary(**{"long runs": [short]}))
    assert again["long runs"] == [short]
