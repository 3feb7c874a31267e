"""Every snippet of the documentation does what it shows: files are written, commands run, Python's answers compared.

In a page, in order: a toml, xml, tex or python block whose first line is a comment with a file's name is written as
that file; of a console block each command is run and what it prints compared, where "…" stands for any text, and on a
line of its own for any lines; a command without output must succeed; python with >>> is a doctest, without it is run.
What a page tells a reader to do to his machine (sh) is not done.
"""

import doctest
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parent.parent.parent
PAGES = [ROOT / "README.md", ROOT / "README.ja.md", *sorted((ROOT / "docs").rglob("*.md"))]
# test_howto.py runs two, and what they say of mistakes; the programs in the table of engines run when it is made.
OWN = {"add-an-engine.md", "my-equations-my-robot.md", "engines.md"}
PAGES = [page for page in PAGES if "generated" not in page.parts and page.name not in OWN]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"(?:# |% |<!-- )([\w./-]+\.(?:toml|py|xml|urdf|tex))(?: -->)?\n")
LEFT_ALONE = {"sh", "text", "mermaid"}
# Over 5 s: engines' processes, and what compiles.
SLOW = {
    "tutorial.md", "engine-in-ci.md", "grade-a-class.md", "robot-files.md", "README.md", "README.ja.md",
    "how-chaotic.md", "sweep.md", "scene-files.md",
}  # fmt: skip


def page(path):
    marks = [pytest.mark.slow] if path.name in SLOW else []
    return pytest.param(path, id=path.relative_to(ROOT).as_posix(), marks=marks)


@pytest.fixture
def shell(tmp_path, monkeypatch):
    """A folder with nothing in it, and the commands of this checkout."""
    home = tmp_path / "page"
    home.mkdir()
    programs = {"furiko": "-m furiko", "pytest": "-m pytest -q --no-header -p no:cacheprovider"}
    for name, words in programs.items():
        program = tmp_path / name
        program.write_text(f'#!/bin/sh\nexec "{sys.executable}" {words} "$@"\n')
        program.chmod(0o755)
    path = os.pathsep.join([str(tmp_path), str(ROOT / "furiko" / "ci"), os.environ["PATH"]])
    for name, value in {"PATH": path, "PYTHONPATH": str(ROOT), "PYTHON": sys.executable, "COLUMNS": "120"}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.chdir(home)
    monkeypatch.syspath_prepend(str(home))
    return home


@pytest.mark.parametrize("path", [page(path) for path in PAGES if BLOCK.search(path.read_text(encoding="utf-8"))])
def test_a_page_does_what_it_says(path, shell):
    names: dict = {}
    for kind, text in BLOCK.findall(path.read_text(encoding="utf-8")):
        named = NAMED.match(text)
        if named:
            Path(named[1]).parent.mkdir(parents=True, exist_ok=True)
            Path(named[1]).write_text(text, encoding="utf-8")
        if kind == "console":
            run(text)
        elif kind == "toml":
            tomllib.loads(text)
        elif kind == "yaml":
            yaml.safe_load(text)
        elif kind == "python" and ">>>" in text:
            test = doctest.DocTestParser().get_doctest(text, names, path.name, str(path), 0)
            told: list[str] = []
            runner = doctest.DocTestRunner(verbose=False, optionflags=doctest.ELLIPSIS)
            failed = runner.run(test, out=told.append, clear_globs=False).failed
            names |= test.globs
            assert not failed, "".join(told)
        elif kind == "python" and not named:
            exec(compile(text, path.name, "exec"), names)
        else:
            assert named or kind in LEFT_ALONE, f"a block of {kind} is looked at by nobody"


def run(text):
    """Each command of a console block, with what it prints."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition("\n")
        done = subprocess.run(
            ["sh", "-c", f"{command} 2>&1"], capture_output=True, text=True, encoding="utf-8", check=False, timeout=300
        )
        printed = "".join(f"{alike(line)}\n" for line in done.stdout.splitlines())
        if shown.strip():
            assert re.fullmatch(pattern(shown), printed), f"$ {command}\nshown:\n{shown}\nprinted:\n{printed}"
        else:
            assert done.returncode == 0, f"$ {command}\n{printed}"


def alike(line):
    """The line with what depends on the processor left open: how many roundings, and so how wide a column is."""
    return re.sub("[ ─]+", " ", re.sub(r"\d[\d.e]* ε *", "# ε ", line)).rstrip()


def pattern(shown):
    """What may be printed."""
    lines = [alike(line) for line in shown.rstrip("\n").splitlines()]
    whole = [f"{'.*?'.join(map(re.escape, line.split('…')))}\n" for line in lines]
    return "".join("(?:.*\n)*?" if line == "…" else one for line, one in zip(lines, whole, strict=True))


def test_a_line_that_is_not_printed_is_seen():
    assert re.fullmatch(pattern("a …\n…\nb\n"), "a 1\nx\ny\nb\n")
    assert not re.fullmatch(pattern("a …\n…\nb\n"), "a 1\nx\ny\nc\n")
    assert re.fullmatch(pattern("a\n…\n"), "a\nx\ny\n")
    assert re.fullmatch(pattern("a\n…\n"), "a\n")
    assert not re.fullmatch(pattern("a\n"), "a\nx\n")
