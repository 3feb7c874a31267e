"""The stream is read back as it was written; what was cut off, damaged or is foreign never passes for a whole run."""

import hashlib
import io
import json
import os
import re
import subprocess
import sys

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models.errors import InvalidInput
from furiko.records.check import FORMAT, OUTCOMES, Diagnosis, Result
from furiko.records.findings import Difference
from furiko.reports import StreamWriter, read_stream
from furiko.reports.stream import LARGEST_LINE, LONGEST_REASON

words = st.text(st.characters(exclude_categories=["Cs"]), max_size=30)
numbers = st.none() | st.floats(allow_nan=False, allow_infinity=False)
results = st.builds(
    Result,
    scene=words,
    engine=words,
    check=words,
    outcome=st.sampled_from(OUTCOMES),
    measured=numbers,
    allowed=numbers,
    unit=words,
    cause=st.none() | words,
    reason=words,
    seconds=st.floats(0, 1e6),
    details=st.dictionaries(
        words, words | numbers | st.integers(-(2**53), 2**53) | st.lists(words, max_size=3), max_size=3
    ),
)


def written(path, header, results, finish=True) -> bytes:
    with StreamWriter(path, header) as stream:
        for result in results:
            stream.write(result)
        if finish:
            stream.finish(2.5)
    return path.read_bytes()


@settings(deadline=None, max_examples=60)
@given(found=st.lists(results, max_size=6, unique_by=repr))
def test_what_is_written_is_read_back(make, tmp_path_factory, found):
    path = tmp_path_factory.mktemp("stream") / "report.jsonl"
    written(path, make.header(), found)
    report = read_stream(path)
    assert report.header == make.header()
    assert list(report.results) == found
    assert report.complete
    assert report.footer.seconds == 2.5


def test_cut_off_at_any_byte_it_is_never_complete(make, tmp_path):
    found = [make.result("differs", reason="θ differs"), make.result("skipped", check="energy", reason="日本")]
    whole = written(tmp_path / "report.jsonl", make.header(scenes=[], engines=[]), found)
    assert read_stream(io.BytesIO(whole)).complete
    first_line = whole.index(b"\n") + 1
    for end in range(len(whole)):
        if end < first_line:
            with pytest.raises(InvalidInput, match="cut off"):
                read_stream(io.BytesIO(whole[:end]))
        else:
            report = read_stream(io.BytesIO(whole[:end]))
            assert not report.complete, end
            assert report.footer is None
            assert len(report.results) == whole[first_line:end].count(b"\n")
            assert "cut off" in report.flaws[0]
            assert report.exit_status != 0


def test_every_result_is_on_disk_when_write_returns(make, tmp_path):
    path = tmp_path / "report.jsonl"
    with StreamWriter(path, make.header()) as stream:
        assert not read_stream(path).results
        stream.write(make.result())
        assert len(read_stream(path).results) == 1
        assert not read_stream(path).complete
        stream.finish()
        assert read_stream(path).complete


def test_the_footer_counts_what_was_written(make, tmp_path):
    found = [make.result(outcome, check=str(i)) for i, outcome in enumerate(OUTCOMES) for _ in range(i + 1)]
    written(tmp_path / "r", make.header(), found)
    footer = read_stream(tmp_path / "r").footer
    assert (footer.agrees, footer.differs, footer.skipped, footer.error) == (1, 2, 3, 4)


@pytest.mark.parametrize("failure", [KeyboardInterrupt, RuntimeError])
def test_an_interrupted_run_has_no_footer(make, tmp_path, failure):
    path = tmp_path / "report.jsonl"
    with pytest.raises(failure), StreamWriter(path, make.header()) as stream:
        interrupted(stream, make.result(), failure)
    report = read_stream(path)
    assert len(report.results) == 1
    assert not report.complete


def interrupted(stream, result, failure):
    stream.write(result)
    raise failure


def test_a_new_run_leaves_nothing_of_a_longer_one(make, tmp_path):
    path = tmp_path / "report.jsonl"
    written(path, make.header(), [make.result(check=str(i)) for i in range(50)])
    written(path, make.header(), [make.result()], finish=False)
    assert len(read_stream(path).results) == 1
    assert not read_stream(path).complete


def test_two_runs_do_not_write_one_file(make, tmp_path):
    path = tmp_path / "report.jsonl"
    with StreamWriter(path, make.header()) as stream:
        stream.write(make.result())
        with pytest.raises(InvalidInput, match="another run is writing it"), StreamWriter(path, make.header()):
            pass
        stream.finish()
    assert read_stream(path).complete


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full on this system")
def test_a_full_disk_is_said_with_the_path(make):
    with pytest.raises(InvalidInput, match=r"^/dev/full: cannot be written: No space left on device$"):
        written_to_full(make)


def written_to_full(make):
    with StreamWriter("/dev/full", make.header()):
        pass


# The limit on a file's size is the process's own: a process of its own fills its disk.
FILLING = """
import resource, signal, sys, msgspec
from furiko.models.errors import InvalidInput
from furiko.records.check import Header, Result
from furiko.reports import StreamWriter
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
path, header = sys.argv[1], msgspec.json.decode(sys.argv[2], type=Header)
resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))
with StreamWriter(path, header) as stream:
    try:
        while True:
            stream.write(Result(scene="s", engine="e", check="c", outcome="agrees"))
    except InvalidInput as error:
        print(error)
    try:
        stream.finish()
    except ValueError as error:
        print(error)
"""


def test_after_a_failed_write_there_is_no_footer(make, tmp_path):
    path = tmp_path / "report.jsonl"
    command = [sys.executable, "-c", FILLING, str(path), msgspec.json.encode(make.header()).decode()]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout.splitlines()
    assert said[0] == f"{path}: cannot be written: File too large"
    assert "could not be written" in said[1]
    report = read_stream(path)
    assert report.results
    assert not report.complete


@pytest.mark.parametrize("place", ["missing/report.jsonl", "", "file/report.jsonl"])
def test_a_place_that_cannot_be_written(make, tmp_path, place):
    (tmp_path / "file").write_text("in the way")
    path = tmp_path / place
    with pytest.raises(InvalidInput, match="cannot be written") as raised, StreamWriter(path, make.header()):
        pass
    assert str(path) in str(raised.value)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf"), np.float64("nan")])
@pytest.mark.parametrize("field", ["measured", "allowed"])
def test_json_never_holds_a_figure_that_is_not_finite(make, tmp_path, field, value):
    result = make.result("differs", reason="too large", details={"x": value}, **{field: value})
    content = written(tmp_path / "r", make.header(), [result])
    for line in content.splitlines():
        json.loads(line, parse_constant=lambda word: pytest.fail(f"{word} in JSON"))
    read = read_stream(tmp_path / "r").results[0]
    assert getattr(read, field) is None
    assert read.reason == f"{field} is {float(value)}; too large"
    assert read.outcome == "differs"
    assert read.details == {"x": None}


@pytest.mark.parametrize("field", ["measured", "allowed"])
def test_nothing_agrees_by_not_being_a_number(make, tmp_path, field):
    with StreamWriter(tmp_path / "r", make.header()) as stream:
        assert stream.write(make.result("agrees", **{field: float("nan")})).outcome == "error"
        assert stream.finish().error == 1
    assert read_stream(tmp_path / "r").exit_status == 3


def test_figures_of_numpy_are_written_as_numbers(make, tmp_path):
    details = {"scalar": np.float64(1.5), "array": np.arange(3), "flag": np.bool_(True)}
    written(tmp_path / "r", make.header(), [make.result(measured=np.float64(3.0), details=details)])
    result = read_stream(tmp_path / "r").results[0]
    assert result.measured == 3.0
    assert result.details == {"scalar": 1.5, "array": [0, 1, 2], "flag": True}


def test_names_that_are_not_unicode_are_written_escaped(make, tmp_path):
    written(tmp_path / "r", make.header(command="furiko check b\udcff.toml"), [make.result(scene="b\udcff")])
    report = read_stream(tmp_path / "r")
    assert report.results[0].scene == "b\\udcff"
    assert report.header.command == "furiko check b\\udcff.toml"


def test_a_long_reason_keeps_its_ends(make, tmp_path):
    written(tmp_path / "r", make.header(), [make.result("error", reason="begin" + "x" * 10_000_000 + "end")])
    reason = read_stream(tmp_path / "r").results[0].reason
    assert reason.startswith("begin")
    assert reason.endswith("end")
    assert "left out" in reason
    assert len(reason) < LONGEST_REASON + 100


def damaged(content: bytes, edit) -> bytes:
    """The stream with its lines edited."""
    lines = content.splitlines(keepends=True)
    return b"".join(edit(lines))


@pytest.mark.parametrize(
    ("edit", "says"),
    [
        (lambda lines: lines[:3] + lines[4:], "agrees 3 \\(found 2\\)"),  # a result lost on the way
        (lambda lines: lines[:2] + lines[1:], "agrees 3 \\(found 4\\)"),  # a line twice
        (lambda lines: lines[:2] + lines[1:3] + lines[4:], "1 result in it twice"),  # one twice, another lost
        (lambda lines: lines[:-1], "cut off"),
        (lambda lines: [*lines[:-1], lines[-1][:-1]], "cut off"),  # half a footer
        (lambda lines: [*lines[:-1], lines[-1][:30]], "cut off"),
        (lambda lines: [*lines[:-2], lines[-2][:30]], "cut off"),  # half a result
        (lambda lines: [*lines[:4], *lines[5:]], "diagnoses 1 \\(found 0\\)"),
    ],
)
def test_a_stream_that_is_not_as_it_was_written_has_a_flaw(make, tmp_path, edit, says):
    path = tmp_path / "r"
    with StreamWriter(path, make.header()) as stream:
        for i in range(3):
            stream.write(make.result(check=str(i), seconds=0.5 + i))
        stream.write_diagnosis(Diagnosis(scene="rods-2", engine="mujoco"))
        stream.finish()
    assert read_stream(path).exit_status == 0
    report = read_stream(io.BytesIO(damaged(path.read_bytes(), edit)))
    assert not report.complete
    assert report.exit_status == 3
    assert re.search(says, report.flaws[0])


def test_half_a_line_after_the_footer_is_refused(make, tmp_path):
    content = written(tmp_path / "r", make.header(), [make.result()])
    with pytest.raises(InvalidInput, match="line 4: something follows the footer"):
        read_stream(io.BytesIO(content + GOOD[:20]))


def test_a_diagnosis_is_read_back_as_it_was_written(make, tmp_path):
    found = Difference(cause="gravity", where="mujoco", measured=9.8, expected=9.81, says="mujoco: gravity is 9.8")
    odd = Difference(cause="mass", where="link 1", measured=float("nan"), expected="a point", says="x" * 10**6)
    diagnosis = Diagnosis(scene="s", engine="e", findings=[found], alternatives=[odd], explains=["energy"])
    with StreamWriter(tmp_path / "r", make.header()) as stream:
        back = stream.write_diagnosis(diagnosis)
        stream.finish()
    report = read_stream(tmp_path / "r")
    assert report.diagnoses == (back,)
    assert back.findings == [found]
    assert back.alternatives[0].measured == "nan"
    assert len(back.alternatives[0].says) < LONGEST_REASON + 100
    assert report.footer.diagnoses == 1


def test_loose_results_are_counted_in_the_footer(make, tmp_path):
    found = [make.result("loose"), make.result(check="b"), make.result("loose", check="c", measured=float("nan"))]
    written(tmp_path / "r", make.header(), found)
    report = read_stream(tmp_path / "r")
    assert report.complete
    assert (report.footer.agrees, report.footer.loose, report.footer.error) == (2, 1, 1)
    assert report.results[0].line == 4.0


HEADER = object()
GOOD = b'{"kind":"result","scene":"s","engine":"e","check":"c","outcome":"agrees"}'
FOOTER = b'{"kind":"footer","agrees":0,"differs":0,"skipped":0,"error":0}'


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        ([], "r.jsonl: empty, or cut off within its header"),
        ([GOOD], "r.jsonl, line 1: .*begins with its header"),
        ([HEADER, HEADER], "line 2: a second header"),
        ([HEADER, FOOTER, GOOD], "line 3: something follows the footer"),
        ([HEADER, FOOTER, FOOTER], "line 3: something follows the footer"),
        ([HEADER, b""], "line 2: empty"),
        ([HEADER, GOOD, b"{"], "line 3: not a record .*truncated"),
        ([HEADER, b"[]"], "line 2: not a record .*expected 'object', got 'array'"),
        ([HEADER, b'{"kind":"nope"}'], "line 2: not a record .*'nope'"),
        ([HEADER, GOOD.replace(b"agrees", b"agree")], r"line 2: .*'agree' - at '\$.outcome'"),
        ([HEADER, GOOD.replace(b'"c"', b"3")], r"line 2: .*expected 'str', got 'int' - at '\$.check'"),
        ([HEADER, GOOD.replace(b'"s"', b'"\xff"')], "line 2: not UTF-8"),
        ([HEADER, GOOD.replace(b'"agrees"', b'"agrees","measured":NaN')], "line 2: not a record"),
        ([HEADER, GOOD.replace(b'"agrees"', b'"agrees","measured":1e400')], "line 2: .*out of range"),
        (
            [HEADER, GOOD.replace(b'"agrees"', b'"agrees","details":{"x":' + b"[" * 10**5 + b"]" * 10**5 + b"}")],
            "nested",
        ),
        (
            [b'{"kind":"header","format":99,"other":"fields"}'],
            f"line 1: .* format 99, .* reads format {FORMAT}; read it",
        ),
        ([b'{"kind":"header","format":99,"furiko":"7.1"}', b"[]"], r"line 1: .* with furiko 7\.1 that wrote it"),
        ([b'{"kind":"header","format":"new"}'], "line 1: this stream has format 'new'"),
        ([b'{"kind":"header","format":null}'], "line 1: this stream has format None"),
        ([HEADER, b"x" * (LARGEST_LINE + 1)], "line 2: longer than 8 MB"),
    ],
)
def test_what_is_no_stream_is_refused_by_line(make, tmp_path, lines, says):
    path = tmp_path / "r.jsonl"
    header = msgspec.json.encode(make.header())
    path.write_bytes(b"".join((header if line is HEADER else line) + b"\n" for line in lines))
    with pytest.raises(InvalidInput, match=says) as raised:
        read_stream(path)
    assert str(path) in str(raised.value)
    assert "\n" not in str(raised.value)


def test_an_unknown_format_of_the_same_shape_is_refused_too(make):
    content = msgspec.json.encode(make.header(format=99)) + b"\n"
    with pytest.raises(InvalidInput, match=r"^stream, line 1: this stream has format 99"):
        read_stream(io.BytesIO(content))


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InvalidInput, match=r"none\.jsonl: cannot be read: No such file"):
        read_stream(tmp_path / "none.jsonl")


def test_a_folder_stands_for_the_stream_in_it(make, tmp_path):
    written(tmp_path / "report.jsonl", make.header(), [])
    assert read_stream(tmp_path).complete


@settings(deadline=None, max_examples=200)
@given(content=st.binary(max_size=200), place=st.integers(0, 3))
def test_no_bytes_crash_the_reader(make, content, place):
    lines = [msgspec.json.encode(make.header()), GOOD, FOOTER]
    lines.insert(place, content)
    try:
        report = read_stream(io.BytesIO(b"\n".join(lines) + b"\n"))
    except InvalidInput:
        return
    assert not (report.complete and place < 3)


# --- the digest


def test_every_byte_that_is_changed_by_hand_is_noticed(make, tmp_path):
    """Each digit that stands in a line becomes another digit, so that the line is still a record."""
    found = [make.result(measured=1.5, allowed=3.25), make.result("skipped", check="energy", reason="since 1931")]
    whole = written(tmp_path / "report.jsonl", make.header(scenes=[], engines=[]), found)
    assert read_stream(io.BytesIO(whole)).complete
    first = whole.index(b"\n") + 1
    digits = [at for at in range(first, len(whole)) if whole[at : at + 1].isdigit()]
    assert len(digits) > 20
    for at in digits:
        other = b"%d" % ((int(whole[at : at + 1]) + 1) % 10 or 1)
        changed = whole[:at] + other + whole[at + 1 :]
        if changed == whole:
            continue
        report = read_stream(io.BytesIO(changed))
        assert not report.complete, changed[at - 20 : at + 20]
        assert "altered or damaged" in report.flaws[0]
        assert report.exit_status == 3


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda text: text.replace('"measured":1.5', '"measured":0.5'), "not those that the run wrote"),
        (lambda text: text.replace('"seconds":2.5', '"seconds":0.5'), "not those that the run wrote"),
        (lambda text: text.replace("rods", "legs"), "not those that the run wrote"),
        (lambda text: text.replace("\n", " \n", 1), "not those that the run wrote"),
        (lambda text: re.sub(r'"digest":"\w+"', '"digest":""', text), "not those that the run wrote"),
        (lambda text: re.sub(r',"digest":"\w+"', "", text), "not those that the run wrote"),
        (lambda text: re.sub(r'("digest":"\w+")}', r'\1,"digest":"00"}', text), "not those that the run wrote"),
    ],
)
def test_what_was_changed_says_so_and_is_no_whole_run(make, tmp_path, change, says):
    path = tmp_path / "report.jsonl"
    text = written(path, make.header(), [make.result(measured=1.5, allowed=3.0)]).decode()
    assert change(text) != text
    path.write_text(change(text), encoding="utf-8")
    report = read_stream(path)
    assert says in " ".join(report.flaws)
    assert not report.complete
    assert report.exit_status == 3
    assert report.verdict.startswith("Incomplete: ")


def test_the_digest_is_that_of_the_bytes_before_it(make, tmp_path):
    whole = written(tmp_path / "report.jsonl", make.header(), [make.result()])
    before, _, rest = whole.rpartition(b'"digest":"')
    assert rest == hashlib.sha256(before + b'"digest":"').hexdigest().encode() + b'"}\n'
