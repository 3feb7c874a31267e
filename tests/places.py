"""Environments and programs for tests of engines in places of their own. None of them needs a network."""

import subprocess
import sys
import sysconfig
import venv
from pathlib import Path


def environment(folder: Path) -> Path:
    """A virtual environment in ``folder`` that sees the packages installed here, furiko not among its own."""
    venv.create(folder, symlinks=True, with_pip=False)
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    (folder / "lib" / version / "site-packages" / "here.pth").write_text(
        f"import site; site.addsitedir({sysconfig.get_paths()['purelib']!r})\n"
    )
    return folder


# The start of a program that speaks the protocol by hand, with nothing of furiko's: the test's own reading of the page.
SPEAKS = """#!{python}
import json, os, struct, sys, time, zlib

def receive():
    head = sys.stdin.buffer.read(20)
    if len(head) < 20:
        raise SystemExit
    magic, length, check = struct.unpack(">8sQI", head)
    content = sys.stdin.buffer.read(length)
    (size,) = struct.unpack(">I", content[:4])
    return json.loads(content[4 : 4 + size]), content[4 + size :]

def frame(content):
    return struct.pack(">8sQI", b"furiko\\x01\\n", len(content), zlib.crc32(content)) + content

def message(head, numbers=()):
    text = json.dumps(head).encode()
    return frame(struct.pack(">I", len(text)) + text + struct.pack("<%dd" % len(numbers), *numbers))

def send(data):
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()

HELLO = dict(say="hello", protocol=1, version="7", questions=["accelerations"])

def serve(ask, hello=HELLO):
    while True:
        head, rest = receive()
        if head["say"] == "hello":
            send(message(hello))
        elif head["say"] == "ask":
            ask(head, rest)
        else:
            send(message(dict(say="built" if head["say"] == "build" else "dropped")))
"""


def program(path: Path, text: str) -> Path:
    """An executable program at ``path``: :data:`SPEAKS`, then ``text``."""
    path.write_text(SPEAKS.replace("{python}", sys.executable) + text, encoding="utf-8")
    path.chmod(0o755)
    return path


def compiler() -> str | None:
    """A C compiler, None where there is none."""
    for name in ("cc", "gcc", "clang"):
        try:
            subprocess.run([name, "--version"], capture_output=True, check=True)
        except (OSError, subprocess.CalledProcessError):
            continue
        return name
    return None
