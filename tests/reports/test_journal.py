"""A stream that is resumed: no whole line is lost, no torn line is kept, and no other file is changed."""

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from furiko.models import InvalidInput
from furiko.records.check import Diagnosis, Header, Result
from furiko.reports import StreamWriter, read_stream
from furiko.reports.journal import Journal

HEADER = Header(
    furiko="1", started="2026-01-01T00:00:00+00:00", command="furiko stress", profile="stress", seed="1",
    machine={}, versions={"numpy": "2"}, scenes=[], engines=[],
)  # fmt: skip


def result(number):
    details = {"theta": [0.1 * number], "says": 'θ\n"kind":"footer"'}
    return Result(scene="s", engine="e", check=f"c {number}", outcome="agrees", details=details)


def write(path, numbers, header=HEADER, finish=True):
    with Journal(path, header) as journal:
        before = [r.check for r in journal.results]
        for number in numbers:
            journal.write(result(number))
        if finish:
            journal.finish(1.0)
    return before


def test_what_was_written_is_there_when_it_goes_on(tmp_path):
    path = tmp_path / "stress.jsonl"
    assert write(path, [1, 2]) == []
    assert write(path, [3]) == ["c 1", "c 2"]
    report = read_stream(path)
    assert [r.check for r in report.results] == ["c 1", "c 2", "c 3"]
    assert report.results[2].details == result(3).details
    assert report.complete  # its one footer counts all three
    assert report.counts["agrees"] == 3


def test_loose_results_and_diagnoses_are_still_counted_when_it_goes_on(tmp_path):
    path = tmp_path / "stress.jsonl"
    with StreamWriter(path, HEADER) as stream:
        stream.write(msgspec.structs.replace(result(1), loose=True))
        stream.write_diagnosis(Diagnosis(scene="s", engine="e"))
        stream.finish()
    write(path, [2])
    report = read_stream(path)
    assert report.complete
    assert (report.footer.agrees, report.footer.loose, report.footer.diagnoses) == (2, 1, 1)


@given(cut=some.integers(1, 4000), finish=some.booleans())
@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_cut_off_anywhere_it_goes_on_from_the_last_whole_line(tmp_path, cut, finish):
    path = tmp_path / "stress.jsonl"
    path.unlink(missing_ok=True)
    write(path, range(9), finish=finish)
    content = path.read_bytes()[:cut]
    path.write_bytes(content)
    whole = max(0, sum(b'"kind":"result"' in line for line in content.split(b"\n")[:-1]))
    assert write(path, [9]) == [f"c {i}" for i in range(whole)]
    found = read_stream(path)
    assert found.complete
    assert [r.check for r in found.results] == [*(f"c {i}" for i in range(whole)), "c 9"]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"seed": "2"}, "has seed 1, this one 2"),
        ({"furiko": "2"}, "has furiko 1, this one 2"),
        ({"versions": {"numpy": "3"}}, "has numpy 2, this one 3"),
    ],
)
def test_another_run_is_not_resumed(tmp_path, change, told):
    path = tmp_path / "stress.jsonl"
    write(path, [1])
    before = path.read_bytes()
    with pytest.raises(InvalidInput, match=told):
        write(path, [2], msgspec.structs.replace(HEADER, **change))
    assert path.read_bytes() == before


def test_one_run_at_a_time(tmp_path):
    path = tmp_path / "stress.jsonl"
    with (
        Journal(path, HEADER) as journal,
        pytest.raises(InvalidInput, match="another run is writing it"),
        Journal(path, HEADER),
    ):
        pass
    assert journal.results == []


@pytest.mark.parametrize("content", ["my diary\n", "my diary", '{"kind":"header","format":99}\n{"kind":"footer"}\n'])
def test_a_file_that_is_no_stream_of_this_format_is_not_changed(tmp_path, content):
    path = tmp_path / "stress.jsonl"
    path.write_text(content)
    with pytest.raises(InvalidInput, match=r"line 1|not a result stream"):
        write(path, [1])
    assert path.read_text() == content


def test_a_finished_run_that_was_changed_by_hand_is_not_resumed(tmp_path):
    path = tmp_path / "stress.jsonl"
    write(path, [1, 2])
    kept = path.read_text()
    assert '"check":"c 1"' in kept
    path.write_text(kept.replace('"check":"c 1"', '"check":"c 9"'))
    with pytest.raises(InvalidInput, match=r"altered or damaged.*--fresh"):
        write(path, [3])
    path.write_text(kept)
    write(path, [3])
    assert read_stream(path).complete
