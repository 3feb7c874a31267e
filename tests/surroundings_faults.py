"""The faults of the surroundings: standard streams, signals, disks, limits, files that are none, names, mistakes."""

from __future__ import annotations

import os
import resource
import signal
import socket
from collections.abc import Callable
from pathlib import Path

from surroundings import QUICK, SMALL, Ended, Fault, Place, broken, limited

import furiko

CHECK = ("check", "rods-1", "-e", "mujoco", "--profile", "smoke")
SCENE = '[system]\nkind = "rod-chain"\nlengths = [1.0]\n'
BENCH = ("bench", "bench-rods-2", "-e", "exudyn-redundant", "--budget", "20")
NASTY = "a\x1b[31mb\u202ec\x9b7m"


Content = (
    str | bytes | Callable[[], str | bytes | list[str]]
)  # large ones are made when they are needed: memory is measured


def _with(content: Content, *arguments: str, name: str = "file.toml", **options: object) -> Callable[[Place], Ended]:
    """Run on a file of this content, ``FILE`` among the arguments."""

    def run(place: Place) -> Ended:
        path = place.folder / name
        made = content() if callable(content) else content
        with path.open("wb") as file:  # piece by piece: what this process needs is counted for the command as well
            for piece in made if isinstance(made, list) else [made]:
                file.write(piece if isinstance(piece, bytes) else piece.encode())
        del made
        return place.run(*(name if word == "FILE" else word for word in arguments), **options)  # type: ignore[arg-type]

    return run


def _on(make: Callable[[Path], object], *arguments: str) -> Callable[[Place], Ended]:
    """Run on a path that something is made at, ``FILE`` among the arguments."""

    def run(place: Place) -> Ended:
        make(place.folder / "file.toml")
        (place.folder / "model.xml").write_text(furiko.to_mjcf(furiko.RodChain([1.0])))
        return place.run(*("file.toml" if word == "FILE" else word for word in arguments))

    return run


def _prepared(prepare: Callable[[Place], object], *arguments: str, **options: object) -> Callable[[Place], Ended]:
    def run(place: Place) -> Ended:
        prepare(place)
        return place.run(*arguments, **options)  # type: ignore[arg-type]

    return run


def _signal(number: int, *, again: bool = False, engine: str = "fake_engines:Hanging") -> Callable[[Place], Ended]:
    def run(place: Place) -> Ended:
        stream = place.folder / "furiko-report" / "report.jsonl"
        arguments = ("check", "rods-2", "-e", engine, "-e", "mujoco")

        def begun() -> bool:
            return stream.exists() and stream.read_text().count("\n") > 1

        ended = place.interrupt(number, *arguments, until=begun, again=again)
        if furiko.read_stream(stream).complete:
            ended.left.append("a stream that looks whole")
        return ended

    return run


def _signal_soon(number: int, seconds: float, *arguments: str) -> Callable[[Place], Ended]:
    """A signal that comes at a fixed time, whatever the command is doing by then."""
    return lambda place: place.interrupt(number, *arguments, until=lambda: False, wait=seconds)


def _socket(path: Path) -> None:
    here = os.getcwd()
    os.chdir(path.parent)  # a socket's path may not be long
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(path.name)
    os.chdir(here)


FILES: dict[str, tuple[str, ...]] = {
    "grade": ("grade", "FILE"),
    "check": ("check", "FILE"),
    "diagnose": ("diagnose", "FILE"),
    "diff": ("diff", "FILE", "FILE"),
    "baseline": ("check", "rods-1", "--baseline", "FILE"),
    "against": ("diagnose", "model.xml", "--against", "FILE"),
    "export": ("export", "FILE", "--mjcf"),
    "bench": ("bench", "FILE"),
}

STREAMS = [
    Fault(f"{command[0]}, {name}", lambda p, c=command, s=shell: p.run(*c, shell=s), statuses)
    for command in (CHECK, ("scenes",), ("--help",), ("engines", "--json"), ("cache",))
    for name, shell, statuses in (
        ("closed standard output", "{} >&-", (3,)),
        ("full standard output", "{} >/dev/full", (3,)),
        ("reader that is gone", "{} | true; exit ${{PIPESTATUS[0]}}", (141, 0)),
        ("closed standard error", "{} 2>&-", (0,)),
        ("no standard stream at all", "{} <&- >&- 2>&-", (3,)),
    )
]

SIGNALS = [
    Fault("SIGINT in a check", _signal(signal.SIGINT), (130,), says="interrupted"),
    Fault("SIGTERM in a check", _signal(signal.SIGTERM), (143,), says="SIGTERM"),
    Fault("SIGHUP in a check", _signal(signal.SIGHUP), (129,), says="SIGHUP"),
    Fault("SIGTERM twice", _signal(signal.SIGTERM, again=True), (143,)),
    Fault("SIGINT twice", _signal(signal.SIGINT, again=True), (130,)),
    *(
        Fault(f"{signal.Signals(number).name} after {seconds} s of {' '.join(arguments)}",
              _signal_soon(number, seconds, *arguments), (status, -number, 0))
        for arguments in (BENCH, ("audit",), ("stress", "--budget", "20"))
        for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143))
        for seconds in (1.0, 4.0)
    ),
]  # fmt: skip

DISKS = [
    Fault("a disk that fills up at the end",
          lambda p: p.run(*CHECK, preexec_fn=limited(resource.RLIMIT_FSIZE, 12_000)), (3,), says="report.html"),
    Fault("a disk that fills up in the middle",
          lambda p: p.run("check", "rods-1", "rods-2", "--profile", "smoke", "--no-cache",
                          preexec_fn=limited(resource.RLIMIT_FSIZE, 10_000)), (3,), says="report.jsonl"),
    Fault("a disk that is full at the start", _prepared(
        lambda p: ((p.folder / "o").mkdir(), (p.folder / "o" / "report.jsonl").symlink_to("/dev/full")),
        *CHECK, "--out", "o"), (2,), says="report.jsonl"),
    Fault("a stream that is a pipe without a reader", _prepared(
        lambda p: ((p.folder / "o").mkdir(), os.mkfifo(p.folder / "o" / "report.jsonl")), *CHECK, "--out", "o"), (2,)),
    Fault("a journal that is a pipe", _prepared(
        lambda p: ((p.folder / "o").mkdir(), os.mkfifo(p.folder / "o" / "stress.jsonl")),
        "stress", "--budget", "1", "--out", "o"), (2,)),
    Fault("a journal that is a folder", _prepared(
        lambda p: (p.folder / "o" / "stress.jsonl").mkdir(parents=True),
        "stress", "--budget", "1", "--out", "o"), (2,)),
    Fault("no folder for temporary files",
          lambda p: (p.environment.update(TMPDIR="/nowhere"), p.run(*CHECK))[1], (0, 3)),
    Fault("a cache that is a file", _prepared(
        lambda p: ((p.folder / "c").write_text(""), p.environment.update(FURIKO_CACHE=str(p.folder / "c"))),
        *CHECK), (0,)),
    *(
        Fault(f"{command[0]} --out {out}", _prepared(
            lambda p: (p.folder / "file").write_text(""), *command, "--out", out),
            (2,), QUICK, says="cannot be written")
        for command in (CHECK, ("lesson",), ("export", "rods-1", "--mjcf"), ("stress", "--budget", "1"),
                        ("bench", "--budget", "1"))
        for out in ("/proc/furiko/x", "file/x", "/dev/null/x")
    ),
]  # fmt: skip

LIMITS = [
    *(
        Fault(f"{number} file handles", lambda p, n=number: p.run(*CHECK, shell=f"(ulimit -n {n}; {{}})"), (0, 3))
        for number in (5, 6, 8, 9, 12, 20)
    ),
    Fault("200 MB of memory", lambda p: p.run("grade", "/dev/null", shell="(ulimit -v 200000; {})"), (2, 3, 70)),
    Fault("a folder that is gone", lambda p: p.run(*CHECK, "--out", str(p.folder / "o"),
                                                  shell='mkdir x; cd x; rmdir "$PWD"; {}'), (0, 2, 3)),
    Fault("an encoding of ASCII", lambda p: p.run(
        *CHECK, shell="PYTHONIOENCODING=ascii PYTHONUTF8=0 LC_ALL=C {}"), (0,)),
    Fault("an encoding of Latin 1", lambda p: p.run("scenes", "--json", shell="PYTHONIOENCODING=latin-1 {}"), (0,)),
]  # fmt: skip

NO_FILES = [
    Fault(f"{name} of {what}", _on(make, *arguments), (2,), QUICK, SMALL)
    for name, arguments in FILES.items()
    for what, make in (
        ("a pipe", os.mkfifo),
        ("/dev/zero", lambda path: path.symlink_to("/dev/zero")),
        ("a folder", Path.mkdir),
        ("a socket", _socket),
        ("a link to itself", lambda path: path.symlink_to(path)),
    )
] + [
    Fault(f"{name} of a path of 5,000 characters",
          lambda p, a=arguments: p.run(*("x" * 4995 + ".toml" if w == "FILE" else w for w in a)), (2,), QUICK, SMALL)
    for name, arguments in FILES.items()
]  # fmt: skip

LARGE_FILES = [
    Fault(f"{name} of {what}", _with(content, *FILES[name]), (2,), QUICK, SMALL)
    for name in ("grade", "check", "export")
    for what, content in (
        ("a key of 20,000 dots", lambda: "a" + ".a" * 20_000 + " = 1\n"),
        ("10,000 keys of 15 dots", lambda: "".join(f"k{i}" + ".a" * 15 + " = 1\n" for i in range(10_000))),
        ("a table's name of 20,000 dots", lambda: "[a" + ".a" * 20_000 + "]\n"),
        ("nested arrays", lambda: "a = " + "[" * 100_000),
        ("nested tables", lambda: "a = " + "{a = " * 30_000),
        ("100,000 tables", lambda: "".join(f"[t{i}]\n" for i in range(100_001))),
        ("a number of 150,000 digits", lambda: "a = " + "1" * 150_000),
        ("a hexadecimal number of 150,000 digits", lambda: SCENE.replace("1.0", "0x" + "f" * 150_000)),
        ("a string without an end", lambda: 'a = """' + '"" ' * 50_000),
        ("zeros", lambda: b"\0" * 700_000),
        ("UTF-16", lambda: SCENE.encode("utf-16")),
    )
]

HEADER = (
    '{"kind":"header","furiko":"1","started":"","command":"","profile":"","seed":"","machine":{},"versions":{},'
    '"scenes":[],"engines":[]}\n'
)


def _result(fields: str) -> str:
    return f'{{"kind":"result","scene":"s","engine":"e","check":"c","outcome":"agrees",{fields}}}\n'


LARGE_STREAMS = [
    Fault(f"diff of {what}", _with(lambda f=fields, t=times: [HEADER, *[_result(f())] * t], *FILES["diff"]), statuses)
    for what, fields, times, statuses in (
        ("half a million results", lambda: '"unit":"x"', 500_000, (2, 3)),
        ("a million lists", lambda: f'"details":{{"a":[{"[]," * 500_000}[]]}}', 2, (2, 3)),
        ("eight million lists", lambda: f'"details":{{"a":[{"[]," * 2_000_000}[]]}}', 4, (2, 3)),
        ("long reasons", lambda: f'"reason":"{"x" * 4_000_000}𝜃"', 15, (3,)),
        ("reasons without end", lambda: f'"reason":"{"x" * 4_000_000}𝜃"', 40, (2,)),
    )
]

MODEL = furiko.to_mjcf(furiko.RodChain([1.0]))
LARGE_MODELS = [
    Fault(f"diagnose of {what}", _with(content, "diagnose", "FILE", name="m.xml"), (2,))
    for what, content in (
        ("half a million attributes", lambda: "<mujoco " + "".join(f"a{i}='' " for i in range(500_000)) + "/>"),
        ("nested elements", lambda: "<mujoco>" + "<body>" * 900_000),
        ("a million elements", lambda: "<mujoco>" + "<a/>" * 1_000_000 + "</mujoco>"),
        ("entities", lambda: '<!DOCTYPE a [<!ENTITY b "' + "x" * 1000 + '">]><mujoco>' + "&b;" * 100_000 + "</mujoco>"),
        ("a file that includes itself", lambda: MODEL.replace("<worldbody>", '<include file="m.xml"/><worldbody>')),
        ("a long name to include", lambda: MODEL.replace("<worldbody>", f'<include file="{"x" * 5000}"/><worldbody>')),
        ("zeros", lambda: b"\0" * 7_000_000),
        ("UTF-32", lambda: MODEL.encode("utf-32")),
    )
]

NAMES = [
    Fault(f"a name that acts on a terminal, {arguments[0]}", lambda p, a=arguments: p.run(*a), (2,), QUICK)
    for arguments in (
        ("check", NASTY), ("check", f"{NASTY}.toml"), ("check", "-e", NASTY), ("check", "--profile", NASTY),
        ("grade", NASTY), ("diagnose", NASTY), ("diff", NASTY, NASTY), ("export", NASTY, "--mjcf"), (NASTY,),
        ("check", f"--{NASTY}"), ("stress", "-a", NASTY), ("bench", NASTY), ("check", "-e", f"{NASTY}:{NASTY}"),
        ("check", "\udcff.toml", "--json"),
    )
] + [
    Fault("a scene's name that acts on a terminal", _with(
        SCENE, "check", "FILE", "-e", "mujoco", "--profile", "smoke", name=f"{NASTY}.toml"), (0,)),
    Fault("a scene's name that acts on a terminal, JSON", _with(
        SCENE, "check", "FILE", "-e", "mujoco", "--profile", "smoke", "--json", name=f"{NASTY}.toml"), (0,)),
    Fault("a scene's name that is not UTF-8, JSON", _with(
        SCENE, "check", "FILE", "-e", "mujoco", "--profile", "smoke", "--json", name="\udcff.toml"), (0,)),
    Fault("a model's names that act on a terminal", _with(
        furiko.to_mjcf(furiko.RodChain([1.0])).replace('name="hinge1"', 'name="\u202ehinge1\x9b" armature="0.1"'),
        "diagnose", "FILE", name="m.xml"), (0, 1, 2)),
]  # fmt: skip

MISTAKES = [
    Fault("a mistake in furiko", lambda p: p.run_code(
        broken("furiko.models", "find_scenes", "ZeroDivisionError('x')"), "scenes"), (70,), says="furiko-error-"),
    Fault("a mistake in furiko, JSON", lambda p: p.run_code(
        broken("furiko.models", "find_scenes", "KeyError('x')"), "scenes", "--json"), (70,), says='"error"'),
    Fault("a library that ends the process", lambda p: p.run_code(
        broken("furiko.models", "find_scenes", "SystemExit(0)"), "scenes"), (70,)),
    Fault("a pipe within furiko that breaks", lambda p: p.run_code(
        broken("furiko.models", "find_scenes", "BrokenPipeError(32, 'x')"), "scenes"), (70,)),
    Fault("no memory left", lambda p: p.run_code(
        broken("furiko.models", "find_scenes", "MemoryError"), "scenes"), (3,)),
    Fault("a mistake while the report is written", lambda p: p.run_code(
        broken("furiko.run", "write_reports", "IndexError('x')"), *CHECK), (70,)),
    Fault("a mistake while the plan is made", lambda p: p.run_code(
        broken("furiko.run", "make_plan", "IndexError('x')"), *CHECK), (70,)),
    Fault("no word at all", lambda p: p.run(), (0,), says="Usage"),
    *(
        Fault(f"engine that is {name}", lambda p, n=name: p.run(
            "check", "rods-1", "-e", f"fake_engines:{n}"), (3,))
        for name in ("Crashing", "Raising", "CannotStart", "Nan", "WrongShape", "NotNumbers")
    ),
]  # fmt: skip

FAULTS = [
    *STREAMS,
    *SIGNALS,
    *DISKS,
    *LIMITS,
    *NO_FILES,
    *LARGE_FILES,
    *LARGE_STREAMS,
    *LARGE_MODELS,
    *NAMES,
    *MISTAKES,
]
