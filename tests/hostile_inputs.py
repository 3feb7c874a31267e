"""Hostile inputs for grade, check, diagnose and diff: random bytes, damaged right files, huge numbers, deep nesting.

Every input follows from its number and the seed. Each is given to the command line in a forked process, which is much
quicker than a fresh one; what it needs of memory is what it needs beyond its parent.
"""

from __future__ import annotations

import json
import os
import random
import resource
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from hostile_derivations import hostile as hostile_derivation
from surroundings import LARGEST, Ended, Place, ends_within

import furiko
from furiko.cli.main import run as run_furiko
from furiko.cli.process import open_standard_streams
from furiko.models.scene import CATALOGUE
from furiko.records.check import Header, Result
from furiko.reports import StreamWriter

LIMIT = 60.0  # [s]
NUMBERS = (
    "1e308", "-1e308", "1e-320", "nan", "inf", "-inf", "0", "-0.0", "1e999", "9" * 500, "9" * 5000, "0x" + "f" * 300,
    "1_000", "true", "1979-05-27", "''", "[]", "{}", "1e-300", "5e-324", "2.2250738585072014e-308", "[[1]]",
)  # fmt: skip
PIECES = (
    b"\0", b"\x1b[2J", b"\xff\xfe", "\u202e".encode(), b"\xed\xa0\x80", b"[" * 3000, b"{" * 3000, b"<a>" * 3000,
    b"a." * 3000, b'"', b"'''", b"\\", b"\r", b"\n", b"#", b"=", b"]]>", b"<!--", b"&lt;", b"&#0;", b"<!DOCTYPE x>",
    b"<include file='x'/>", b"1e400", b"-", b"0", b"," * 3000, b"9" * 3000, b"\xef\xbb\xbf", b"\xc0\x80",
)  # fmt: skip


def _damaged(draw: random.Random, content: bytes) -> bytes:
    for _ in range(draw.choice((1, 1, 2, 5, 20))):
        at, kind = draw.randrange(len(content) + 1), draw.randrange(7)
        if kind == 0:
            content = content[:at] + content[at + draw.randrange(1, 60) :]
        elif kind == 1:
            content = content[:at] + draw.choice(PIECES) + content[at:]
        elif kind == 2 and content:
            at = min(at, len(content) - 1)
            content = content[:at] + bytes([draw.randrange(256)]) + content[at + 1 :]
        elif kind == 3:
            begin = draw.randrange(len(content) + 1)
            content = content[:at] + content[begin : begin + 200] * draw.choice((1, 3, 40)) + content[at:]
        elif kind == 4:
            content = _other_number(draw, content)
        elif kind == 5:
            lines = content.split(b"\n")
            draw.shuffle(lines)
            content = b"\n".join(lines)
        else:
            content = content[:at]
    return content


def _other_number(draw: random.Random, content: bytes) -> bytes:
    places = [i for i, c in enumerate(content) if chr(c).isdigit()]
    if not places:
        return content
    begin = end = draw.choice(places)
    while end < len(content) and chr(content[end]) in "0123456789.e-+":
        end += 1
    return content[:begin] + draw.choice(NUMBERS).encode() + content[end:]


def _recoded(draw: random.Random, content: bytes) -> bytes:
    encoding = draw.choice(("utf-16", "utf-32", "utf-7", "cp037", "utf-8-sig", "latin-1"))
    return content.decode("utf-8", "replace").encode(encoding, "replace")


def _bytes(draw: random.Random) -> bytes:
    kind = draw.randrange(3)
    if kind == 0:
        return draw.randbytes(draw.choice((0, 1, 10, 1000, 50_000)))
    if kind == 1:
        return draw.choice(PIECES) * draw.choice((1, 10, 100))
    return b"".join(draw.choices(PIECES, k=draw.randrange(30)))


def _spoilt(draw: random.Random, right: bytes) -> bytes:
    kind = draw.randrange(10)
    if kind == 0:
        return _bytes(draw)
    return _recoded(draw, right) if kind == 1 else _damaged(draw, right)


def _scene(draw: random.Random) -> bytes:
    path = draw.choice(sorted(CATALOGUE.glob("*.toml")))
    return _spoilt(
        draw, path.read_bytes() if path.stat().st_size < 3000 else b"[system]\nkind='rod-chain'\nlengths=[1]"
    )


def _model(draw: random.Random) -> bytes:
    system = furiko.RodChain([1.0] * draw.randrange(1, 4))
    if draw.random() < 0.3:
        system = furiko.NLegPendulum([1.0, 0.5, 0.7], [1.0, 0.3, 0.2])
    return _spoilt(draw, draw.choice((furiko.to_mjcf, furiko.to_urdf))(system).encode())


def _derivation(draw: random.Random) -> bytes:
    text = hostile_derivation(draw).encode("utf-8", "surrogatepass")
    return text if draw.random() < 0.7 else _spoilt(draw, text)


def _stream(draw: random.Random, folder: Path) -> bytes:
    path = folder / "right.jsonl"
    header = Header(
        furiko="1", started="", command="", profile="smoke", seed="", machine={}, versions={"a": "1"}, scenes=[],
        engines=[],
    )  # fmt: skip
    with StreamWriter(path, header) as stream:
        for number in range(draw.randrange(6)):
            outcome = draw.choice(("agrees", "differs", "skipped", "error"))
            stream.write(
                Result(scene=f"s{number}", engine="e", check="c", outcome=outcome, measured=1.0, allowed=2.0,
                       unit="ε", reason="x\x1b[31my\u202e", details={"a": [1, {"b": None}]})
            )  # fmt: skip
        stream.finish()
    return _spoilt(draw, path.read_bytes())


def arguments(number: int, seed: int, folder: Path) -> list[str]:
    """Write the input of this number into the folder; returns the command line that reads it."""
    draw = random.Random(f"{seed} {number}")
    json_too = ["--json"] if draw.random() < 0.3 else []
    command = draw.choices(("grade", "check", "diagnose", "diff", "export"), (30, 20, 25, 20, 5))[0]
    if command == "grade":
        (folder / "file.toml").write_bytes(_derivation(draw))
        return ["grade", "file.toml", *json_too]
    if command == "check":
        (folder / "file.toml").write_bytes(_scene(draw))
        baseline: list[str] = []
        if draw.random() < 0.2:
            (folder / "before.jsonl").write_bytes(_stream(draw, folder))
            baseline = ["--baseline", "before.jsonl"]
        return ["check", "file.toml", "-e", "mujoco", "--profile", "smoke", "-j", "1", *baseline, *json_too]
    if command == "diagnose":
        name = draw.choice(("model.xml", "model.urdf"))
        (folder / name).write_bytes(_model(draw))
        return ["diagnose", name, *json_too]
    if command == "diff":
        for name in ("a.jsonl", "b.jsonl"):
            (folder / name).write_bytes(_stream(draw, folder))
        return ["diff", "a.jsonl", "b.jsonl"]
    (folder / "file.toml").write_bytes(_scene(draw))
    return ["export", "file.toml", draw.choice(("--mjcf", "--urdf"))]


def forked(place: Place, words: list[str], limit: float = LIMIT) -> Ended:
    """Run a command line in a forked process, its memory counted from that of this one."""
    out, err = place.folder / "out", place.folder / "err"
    begun = time.monotonic()
    child = os.fork()
    if child == 0:
        os.setsid()
        os.environ.update(place.environment)
        tempfile.tempdir = None
        os.chdir(place.folder)
        for number, path in ((1, out), (2, err)):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        open_standard_streams()
        status = 99
        try:
            status = run_furiko(words)
            sys.stdout.flush()
        finally:
            os._exit(status)
    late = not ends_within(child, limit)
    if late:
        os.kill(child, signal.SIGKILL)
    _, state, usage = os.wait4(child, 0)
    seconds = time.monotonic() - begun
    own = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    ended = Ended(os.waitstatus_to_exitcode(state), out.read_bytes(), err.read_bytes(), seconds,
                  max(0, 1024 * usage.ru_maxrss - own), place.left())  # fmt: skip
    if late:
        ended.left.append("it hangs")
    return ended


def wrong(words: list[str], ended: Ended) -> list[str]:
    """What is not as it should be, in words."""
    found = ended.wrong((0, 1, 2, 3), LIMIT, LARGEST)
    if "--json" in words:
        try:
            document = json.loads(ended.out)
        except ValueError:
            found.append("standard output is not one JSON document")
        else:
            if (ended.status == 2) != (set(document) == {"error"}):
                found.append("no error document")
    return found


def report(count: int, seed: int, say: Callable[..., None] = print) -> int:
    """Try so many inputs; prints those that are not borne, and how many ended how. Returns their number."""
    for module in ("derivations.grading.grade", "diagnosis.model_files.diagnose", "run"):
        import_module(f"furiko.{module}")  # here, so that not every process imports it
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    kinds: Counter[tuple[str, int]] = Counter()
    failed, slowest, largest = 0, 0.0, 0
    with tempfile.TemporaryDirectory(prefix="hostile-") as folder:
        os.environ["FURIKO_TEST_CACHE"] = f"{folder}/cache"
        for number in range(count):
            here = Path(folder) / str(number)
            here.mkdir()
            words = arguments(number, seed, here)
            ended = forked(Place(here), words)
            found = wrong(words, ended)
            kinds[words[0], ended.status] += 1
            slowest, largest = max(slowest, ended.seconds), max(largest, ended.memory)
            if found:
                failed += 1
                say(
                    f"FAILED  {number}, seed {seed}: {' '.join(words)}:",
                    *found,
                    ended.err[-300:].decode("ascii", "replace"),
                )
    for (command, status), times in sorted(kinds.items()):
        say(f"{command}: status {status}: {times}")
    say(f"{count} hostile inputs, {failed} not borne; slowest {slowest:.1f} s, largest {largest / 1e6:.0f} MB more")
    return failed
