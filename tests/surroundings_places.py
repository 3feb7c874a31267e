"""More faults of the surroundings: environments, caches, clocks, folders that are read, and signals while it begins."""

from __future__ import annotations

import os
import resource
import signal
from collections.abc import Callable
from pathlib import Path

from surroundings import QUICK, SMALL, Ended, Fault, Place, broken, limited

CHECK = ("check", "rods-1", "-e", "mujoco", "--profile", "smoke")
SCENE = '[system]\nkind = "rod-chain"\nlengths = [1.0]\n'
KNOWN = '[[known]]\nscene = "*"\nengine = "*"\nreason = "r"\n'


def _set(*arguments: str, **variables: str | None) -> Callable[[Place], Ended]:
    """Run with these variables in the environment, None for none of that name."""

    def run(place: Place) -> Ended:
        for name, value in variables.items():
            if value is None:
                place.environment.pop(name, None)
            else:
                place.environment[name] = value
        return place.run(*arguments)

    return run


def _made(make: Callable[[Path], object], *arguments: str) -> Callable[[Place], Ended]:
    """Run after something is made in the folder."""

    def run(place: Place) -> Ended:
        make(place.folder)
        return place.run(*arguments)

    return run


def _entries(make: Callable[[Path], object]) -> Callable[[Place], Ended]:
    """Run twice, with something else in the place of every entry of the cache at the second time."""

    def run(place: Place) -> Ended:
        place.run(*CHECK)
        for entry in (place.folder / "cache").glob("*/??/*"):
            entry.unlink()
            make(entry)
        return place.run(*CHECK)

    return run


def _replaced(place: Place) -> Ended:
    """The file is another one every few milliseconds, whole each time."""
    path, process = place.folder / "file.toml", os.fork()
    path.write_text(SCENE)
    if process == 0:
        while True:
            for text in (SCENE, SCENE.replace("1.0", "2.0, 3.0"), SCENE * 2, ""):
                (place.folder / "other").write_text(text)
                os.replace(place.folder / "other", path)
    try:
        return place.run("check", "file.toml", "-e", "mujoco", "--profile", "smoke")
    finally:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)


def _sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(1 << 36)


def _loop(path: Path) -> None:
    path.mkdir()
    (path / "again").symlink_to(path)


def _soon(number: int, seconds: float, *arguments: str) -> Callable[[Place], Ended]:
    return lambda place: place.interrupt(number, *arguments, until=lambda: False, wait=seconds)


def _old_clock(place: Place) -> Ended:
    code = "import sys, time\ntime.time = lambda: 1e6\nsys.argv = ['furiko', *sys.argv[1:]]\n"
    return place.run_code(f"{code}from furiko.cli import main\nmain()\n", *CHECK)


ENVIRONMENTS = [
    Fault("no home", _set(*CHECK, HOME=None, XDG_CACHE_HOME=None, FURIKO_CACHE=None), (0,)),
    Fault("a home that is not there", _set(*CHECK, HOME="/nowhere", XDG_CACHE_HOME=None, FURIKO_CACHE=None), (0,)),
    Fault("a home that is a device", _set(*CHECK, HOME="/dev/null", XDG_CACHE_HOME=None, FURIKO_CACHE=None), (0,)),
    Fault("a home that is no name", _set(*CHECK, HOME="", XDG_CACHE_HOME="", FURIKO_CACHE=""), (0,)),
    Fault("a cache of a very long name", _set(*CHECK, FURIKO_CACHE="/tmp/" + "x" * 5000), (0,)),
    Fault("a cache that is furiko's own folder", _set(*CHECK, FURIKO_CACHE="."), (0,)),
    Fault("an environment of a megabyte", _set(*CHECK, **{f"V{i}": "x" * 100_000 for i in range(10)}), (0,)),
    Fault("10,000 variables", _set(*CHECK, **{f"V{i}": "x" for i in range(10_000)}), (0,)),
    *(
        Fault(f"{name}={value}", _set(*CHECK, **{name: value}), (0,))
        for name, value in (
            ("COLUMNS", "0"), ("COLUMNS", "-1"), ("COLUMNS", "wide"), ("COLUMNS", "1"), ("COLUMNS", "9" * 30),
            ("LINES", "nan"), ("TERM", "\u202e"), ("TERM", "dumb"), ("NO_COLOR", ""),
            ("TZ", "../../x"),
            ("LANG", "xx_YY.UTF-99"), ("LC_ALL", "C"), ("PYTHONHASHSEED", "0"), ("PYTHONOPTIMIZE", "2"),
            ("PYTHONWARNINGS", "error"), ("PYTHONMALLOC", "debug"), ("PYTHONDONTWRITEBYTECODE", "1"),
            ("GITHUB_STEP_SUMMARY", "/dev/full"), ("GITHUB_OUTPUT", "/nowhere/x"), ("SOURCE_DATE_EPOCH", "x"),
            ("OMP_NUM_THREADS", "x"), ("MUJOCO_GL", "nonsense"), ("PATH", ""), ("USER", "\x1b[31m"),
        )
    ),
    Fault("a clock that stands in 1970", _old_clock, (0,)),
]  # fmt: skip

CACHES = [
    Fault("a cache whose entries are pipes", _entries(os.mkfifo), (0,)),
    Fault("a cache whose entries are /dev/zero", _entries(lambda path: path.symlink_to("/dev/zero")), (0,)),
    Fault("a cache whose entries are folders", _entries(Path.mkdir), (0,)),
    Fault("a cache whose entries are links to themselves", _entries(lambda path: path.symlink_to(path)), (0,)),
    Fault("a cache whose entries are 64 GB of nothing", _entries(_sparse), (0,)),
    Fault("a cache that is a link to itself",
          lambda p: (p.environment.update(FURIKO_CACHE=str(p.folder / "c")), (p.folder / "c").symlink_to("c"),
                     p.run(*CHECK))[-1], (0,)),
    Fault("furiko cache of pipes", _made(lambda f: ((f / "cache/results/ab").mkdir(parents=True),
                                                    os.mkfifo(f / "cache/results/ab/cd")), "cache", "--json"), (0,)),
    Fault("furiko cache --clear of what is a file", lambda p: (p.environment.update(FURIKO_CACHE="/dev/null"),
                                                           p.run("cache", "--clear"))[1], (0, 2)),
]  # fmt: skip

FOLDERS = [
    Fault(f"{what} as {name}", _made(make, *arguments), statuses)
    for name, arguments, statuses in (
        ("a folder for reports", (*CHECK, "--out", "o"), (0, 2, 3)),
        ("a run to compare with", ("diff", "o", "o"), (2,)),
        ("a folder of runs", ("history", "o"), (0, 1, 2, 3)),
        ("known differences", (*CHECK, "--known", "o"), (2,)),
        ("a class of submissions", ("grade", "o"), (0, 1, 2, 3)),
    )
    for what, make in (
        ("a folder that is in itself", lambda f: _loop(f / "o")),
        ("a folder of pipes", lambda f: ((f / "o").mkdir(), *(os.mkfifo(f / "o" / n) for n in (
            "report.html", "report.md", "junit.xml", "a.toml", "b.xml")))),
        ("a folder of devices", lambda f: ((f / "o").mkdir(), *((f / "o" / n).symlink_to("/dev/full") for n in (
            "report.html", "report.md", "junit.xml", "a.toml")))),
        ("a folder of folders", lambda f: [(f / "o" / n).mkdir(parents=True) for n in (
            "report.html", "report.md", "junit.xml", "report.jsonl", "a.toml")]),
        ("64 GB of nothing", lambda f: _sparse(f / "o")),
        ("/proc/self/mem", lambda f: (f / "o").symlink_to("/proc/self/mem")),
        ("/dev/stdin", lambda f: (f / "o").symlink_to("/dev/stdin")),
    )
] + [
    Fault("a file that is replaced while it is read", _replaced, (0, 2)),
    Fault("a known file that is a pipe", _made(
        lambda f: os.mkfifo(f / "k"), *CHECK, "--known", "k"), (2,), QUICK, SMALL),
    Fault("20,000 scenes by name", lambda p: p.run(
        "check", *["rods-1"] * 20_000, "-e", "mujoco", "--profile", "smoke"), (0, 2)),
]  # fmt: skip

LIMITS = [
    Fault("one second of processor time", lambda p: p.run(
        "check", "rods-5", "-e", "mujoco", "--no-cache", preexec_fn=limited(resource.RLIMIT_CPU, 1)),
        (-signal.SIGXCPU, -signal.SIGKILL, 3, 0)),
    Fault("a stack of 256 kB", lambda p: p.run(*CHECK, shell="(ulimit -s 256; {})"), (0, 3)),
    Fault("files of no size at all", lambda p: p.run(*CHECK, shell="(ulimit -f 0; {})"), (2, 3)),
    Fault("a mask of everything", lambda p: p.run(*CHECK, shell="(umask 777; {})"), (0, 2, 3)),
    Fault("JSON to a full disk", lambda p: p.run(*CHECK, "--json", shell="{} >/dev/full"), (3,)),
    Fault("JSON to a reader of ten bytes", lambda p: p.run(
        "scenes", "--json", shell="{} | head -c 10 >/dev/null; exit ${{PIPESTATUS[0]}}"), (141, 0)),
    Fault("a closed pipe that is ignored", lambda p: p.run(
        "scenes", "--json", shell="trap '' PIPE; {} | head -c 10 >/dev/null; exit ${{PIPESTATUS[0]}}"), (141, 0, 3)),
]  # fmt: skip

BEGINNINGS = [
    Fault(f"{signal.Signals(number).name} after {seconds} s of {arguments[0]}",
          _soon(number, seconds, *arguments), (status, -number, 0))
    for arguments in (("check", "rods-2", "n-leg-3", "--no-cache"), ("scenes",), ("diff", "x", "y"))
    for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129))
    for seconds in (0.05, 0.3, 0.8, 1.5, 2.5)
    if arguments[0] == "check" or seconds < 0.5
]  # fmt: skip

MISTAKES = [
    Fault(f"{error.partition('(')[0]} of {name}", lambda p, m=module, n=name, e=error: p.run_code(
        broken(m, n, e), *CHECK), statuses)
    for module, name, error, statuses in (
        ("furiko.run", "make_header", "OSError(24, 'Too many open files')", (3, 70)),
        ("furiko.run", "open_report", "OSError(28, 'No space left on device')", (2, 3, 70)),
        ("furiko.run", "prepare_reports", "KeyboardInterrupt()", (130,)),
        ("furiko.run", "make_plan", "KeyboardInterrupt()", (130,)),
        ("furiko.run", "write_reports", "KeyboardInterrupt()", (130,)),
        ("furiko.run", "write_reports", "MemoryError()", (3,)),
        ("furiko.run", "write_reports", "BrokenPipeError(32, 'x')", (70,)),
        ("furiko.run", "_footer", "RecursionError('x')", (70,)),
        ("furiko.run", "run", "GeneratorExit()", (70,)),
        ("furiko.run", "user_cache", "UnicodeError('x')", (70,)),
    )
]  # fmt: skip

FAULTS = [*ENVIRONMENTS, *CACHES, *FOLDERS, *LIMITS, *BEGINNINGS, *MISTAKES]
