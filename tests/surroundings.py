"""What surrounds furiko goes wrong: closed pipes, full disks, signals, files that are none; and hostile inputs.

Run it from a checkout; pytest imports it too:

    python tests/surroundings.py faults            every fault, each in a process of its own
    python tests/surroundings.py inputs --count 2000 [--seed 0]    hostile inputs, each in a forked process

A run fails where a command shows a traceback, takes too long, needs more than 1 GB, ends with another status than it
should, or leaves a process or a temporary folder behind.
"""

from __future__ import annotations

import argparse
import os
import resource
import select
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

TESTS = Path(__file__).parent
sys.path.insert(0, str(TESTS.parent))  # this checkout's furiko, whichever is installed
LARGEST = 1 << 30  # bytes of memory that a command may need
SMALL = 300 << 20  # bytes, and
QUICK = 10.0  # [s] for what is refused before anything runs; most of it is Python's own start on a busy machine
MARK = "FURIKO_TEST_MARK"
PYTHON = [sys.executable, "-m", "furiko"]


@dataclass
class Ended:
    """A command that ended, and what it left."""

    status: int
    out: bytes
    err: bytes
    seconds: float
    memory: int  # bytes, the largest of the process and of those that it waited for
    left: list[str] = field(default_factory=list)

    def wrong(self, statuses: tuple[int, ...], seconds: float = 60.0, memory: int = LARGEST) -> list[str]:
        """What is not as it should be, in words."""
        found = list(self.left)
        if self.status not in statuses:
            found.append(f"status {self.status}, not {' or '.join(map(str, statuses))}")
        if b"Traceback" in self.out + self.err or b"Exception ignored" in self.err:
            found.append("a traceback")
        if b"\x1b" in self.out + self.err or "\u202e".encode() in self.out + self.err:
            found.append("a raw escape")
        if self.status in (2, 3, 70) and len(self.err.strip().splitlines()) > 1:
            found.append("more than one line on standard error")
        if self.seconds > seconds:
            found.append(f"{self.seconds:.1f} s")
        if self.memory > memory:
            found.append(f"{self.memory / 1e6:.0f} MB")
        return found


def marked_processes(mark: str) -> list[int]:
    """The processes that were started with this mark in their environment, directly or not."""
    found = []
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit() and int(folder.name) != os.getpid():
            try:
                environment = (folder / "environ").read_bytes()
                state = (folder / "stat").read_text().rpartition(")")[2].split()[0]
            except OSError:
                continue
            if f"{MARK}={mark}".encode() in environment and state != "Z":
                found.append(int(folder.name))
    return found


def ends_within(process: int, seconds: float) -> bool:
    """Whether a child process ends in time; it is not reaped."""
    descriptor = os.pidfd_open(process)
    try:
        return bool(select.select([descriptor], [], [], seconds)[0])
    finally:
        os.close(descriptor)


class Place:
    """A folder for one command, with a folder for its temporary files and a cache of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.temporary, self.mark = folder, folder / "tmp", uuid.uuid4().hex
        self.temporary.mkdir(parents=True, exist_ok=True)
        path = os.pathsep.join([str(TESTS), str(TESTS.parent), *filter(None, [os.environ.get("PYTHONPATH")])])
        self.environment = os.environ | {
            "PYTHONPATH": path, "TMPDIR": str(self.temporary), MARK: self.mark,
            "FURIKO_CACHE": os.environ.get("FURIKO_TEST_CACHE", str(folder / "cache")),
        }  # fmt: skip

    def start(self, command: list[str], shell: str = "{}", **options: object) -> subprocess.Popen[bytes]:
        """Start a command; ``shell``: what a shell makes of it, as in ``{} >&-``."""
        line = shell.format('"$@"')
        limit = options.pop("preexec_fn", None)

        def prepare() -> None:
            signal.signal(signal.SIGHUP, signal.SIG_DFL)  # ignored under nohup, and so by all that is started from it
            if callable(limit):
                limit()

        with (self.folder / "out").open("wb") as out, (self.folder / "err").open("wb") as err:
            return subprocess.Popen(
                ["bash", "-c", f"exec {line}" if shell == "{}" else line, "bash", *command],
                cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                preexec_fn=prepare, **options,  # noqa: PLW1509 (no threads here)
            )  # type: ignore[call-overload]  # fmt: skip

    def end(self, process: subprocess.Popen[bytes], begun: float, limit: float = 120.0) -> Ended:
        """Wait for it, and look at what it left."""
        late = not ends_within(process.pid, limit)
        if late:
            for number in marked_processes(self.mark):
                os.kill(number, signal.SIGKILL)
        _, state, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(state)
        seconds = time.monotonic() - begun
        left = [*(["it hangs"] if late else []), *self.left()]
        out, err = ((self.folder / name).read_bytes() for name in ("out", "err"))
        # A process begins with the memory of the one that it was started from: less than that cannot be seen.
        own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        memory = 1024 * usage.ru_maxrss if usage.ru_maxrss > own else 0
        return Ended(process.returncode, out, err, seconds, memory, left)

    def left(self) -> list[str]:
        """What is left: processes, and temporary files other than an internal error's traceback."""
        for _ in range(40):  # a killed process takes a moment
            processes = marked_processes(self.mark)
            if not processes:
                break
            time.sleep(0.05)
        files = [path.name for path in self.temporary.iterdir() if not path.name.startswith("furiko-error-")]
        return [f"process {number} left" for number in processes] + [f"{name} left" for name in files]

    def run(self, *arguments: str, shell: str = "{}", limit: float = 120.0, **options: object) -> Ended:
        """Run ``furiko`` with these arguments."""
        begun = time.monotonic()
        return self.end(self.start([*PYTHON, *arguments], shell, **options), begun, limit)

    def run_code(self, code: str, *arguments: str, shell: str = "{}") -> Ended:
        """Run a Python program that changes something in furiko and then calls its command line."""
        begun = time.monotonic()
        return self.end(self.start([sys.executable, "-c", code, *arguments], shell), begun)

    def interrupt(
        self, number: int, *arguments: str, until: Callable[[], bool], again: bool = False, wait: float = 60.0
    ) -> Ended:
        """Run ``furiko``, and send it a signal as soon as ``until`` holds."""
        # What runs in the background may have been told to ignore interrupts, and hands that on.
        process = self.start(
            [*PYTHON, *arguments], preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler)
        )
        deadline = time.monotonic() + wait
        while time.monotonic() < deadline and not until() and not ends_within(process.pid, 0.02):
            pass
        begun = time.monotonic()
        for _ in range(1 + again):
            os.kill(process.pid, number)  # not process.send_signal, which reaps one that has ended
        return self.end(process, begun, 30.0)


BREAK = """
import sys
import {module} as broken
def fail(*_, **__):
    raise {error}
broken.{name} = fail
sys.argv = ["furiko", *sys.argv[1:]]
from furiko.cli import main
main()
"""


def broken(module: str, name: str, error: str) -> str:
    """A program in which one function of furiko raises."""
    return BREAK.format(module=module, name=name, error=error)


@dataclass(frozen=True)
class Fault:
    """One fault: how it is brought about, and how the command may end."""

    name: str
    run: Callable[[Place], Ended]
    statuses: tuple[int, ...]
    seconds: float = 60.0
    memory: int = LARGEST
    says: str = ""  # in what it prints

    def wrong(self, place: Place) -> list[str]:
        """What is not as it should be."""
        ended = self.run(place)
        found = ended.wrong(self.statuses, self.seconds, self.memory)
        if self.says and self.says.encode() not in ended.out + ended.err:
            found.append(f"{self.says!r} is not said: {ended.err[-200:]!r}")
        return found


def limited(what: int, most: int) -> Callable[[], None]:
    """For ``preexec_fn``: a limit of the system on the process."""
    return lambda: resource.setrlimit(what, (most, most))


def report(faults: list[Fault], only: str = "") -> int:
    """Bring about each fault; print those that are not borne. Returns their number."""
    failed = 0
    chosen = [fault for fault in faults if only in fault.name]
    for fault in chosen:
        with tempfile.TemporaryDirectory(prefix="surroundings-") as folder:
            begun = time.monotonic()
            wrong = fault.wrong(Place(Path(folder)))
        failed += bool(wrong)
        took = f"{time.monotonic() - begun:5.1f} s"
        print(f"{'FAILED' if wrong else 'borne '} {took}  {ascii(fault.name)[1:-1]}", *wrong, sep="; ")
    print(f"{len(chosen)} faults of the surroundings, {failed} not borne")
    return failed


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("what", choices=("faults", "inputs"))
    parser.add_argument("--only", default="", help="faults whose name has this")
    parser.add_argument("--count", type=int, default=2000, help="number of hostile inputs")
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    if chosen.what == "faults":
        from surroundings_faults import FAULTS
        from surroundings_places import FAULTS as FAULTS_OF_PLACES

        sys.exit(report([*FAULTS, *FAULTS_OF_PLACES], chosen.only) > 0)
    from hostile_inputs import report as report_inputs

    sys.exit(report_inputs(chosen.count, chosen.seed) > 0)


if __name__ == "__main__":
    main()
