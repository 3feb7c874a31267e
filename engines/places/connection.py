"""A process with an engine in it, and what it answers.

It is started when it is first asked and again after it has died; a model that was built before is then built anew. An
answer that does not come within the limit, or is none, ends the process: who asked gets an exception, and no later
answer can be taken for that of another question.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time
import weakref
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...models.errors import EngineMissing, InvalidInput
from ..workers.frames import BrokenChannel, Frames, framed
from ..workers.limits import LIMITS
from ..workers.processes import ENVIRONMENT
from .messages import PROTOCOL, BrokenMessage, Message, decode, encode

LARGEST = 256 << 20  # bytes of one answer: 10,000 states of 1,000 links are 80 MB
LAUNCH = str(Path(__file__).with_name("launch.py"))
# Of this process alone: what it says of the search path of Python does not hold for another one.
OF_THIS_PYTHON = ("PYTHONPATH", "PYTHONHOME", "PYTHONSTARTUP", "VIRTUAL_ENV", "__PYVENV_LAUNCHER__")
LAST_WORDS = 2000  # characters of what it wrote to standard error


class EngineFailed(RuntimeError):
    """The engine's own code raised an exception, or its process died, hung, or answered with what is no answer."""


@dataclass(eq=False)
class Connection:
    """A process that is started by ``command``; ``name``: what it is called in messages."""

    name: str
    command: Sequence[str]
    hello: Mapping[str, Any] = field(default_factory=dict)  # what it said when it was last started
    started: int = 0  # how many times
    _process: subprocess.Popen[bytes] | None = None
    _socket: socket.socket | None = None
    _frames: Frames = field(default_factory=Frames)
    _words: deque[bytes] = field(default_factory=deque)
    _listener: threading.Thread | None = None
    _models: int = 0
    _dropped: list[tuple[int, int]] = field(default_factory=list)  # which start, which model

    def __post_init__(self) -> None:
        self._processes: list[subprocess.Popen[bytes]] = []
        weakref.finalize(self, _end_all, self._processes)

    def running(self) -> None:
        """Start it where it does not run. Raises :class:`EngineMissing` where it cannot, or has not what it needs."""
        if self._process is not None and self._process.poll() is None and self._socket is not None:
            return
        self.end()
        self._start()
        try:
            hello = self._exchange({"say": "hello", "protocol": PROTOCOL}, {}).head
        except (EngineFailed, EngineMissing, InvalidInput) as error:
            self.end()
            raise EngineMissing(f"{self.name}: it cannot be started: {error}") from error
        if hello.get("say") != "hello" or hello.get("protocol") != PROTOCOL:
            self.end()
            spoken = str(hello.get("protocol"))[:20]
            raise EngineMissing(f"{self.name}: it speaks protocol {spoken}, where {PROTOCOL} is needed")
        self.hello = hello

    def model(self, mechanism: Mapping[str, Any]) -> Model:
        """A model of the mechanism, which is built at once."""
        model = Model(self, mechanism)
        model.built()
        return model

    def next_model(self) -> int:
        """A number for another model."""
        self._models += 1
        return self._models

    def ask(self, head: Mapping[str, Any], arrays: Mapping[str, Any] | None = None) -> Message:
        """The answer to a request.

        Raises :class:`EngineFailed`, :class:`InvalidInput` and :class:`EngineMissing` as the engine's side says.
        """
        self.running()
        while self._dropped:
            start, model = self._dropped.pop()
            if start == self.started:
                self._exchange({"say": "drop", "model": model}, {})
        return self._exchange(head, arrays or {})

    def forget(self, start: int, model: int) -> None:
        """Nobody needs this model any more; it is told so before the next request."""
        self._dropped.append((start, model))

    def end(self) -> None:
        """End the process, whatever it is doing."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            if self._process in self._processes:
                self._processes.remove(self._process)
        if self._socket is not None:
            self._socket.close()
        self._process = self._socket = None

    def _start(self) -> None:
        ours, theirs = socket.socketpair()
        environment = {name: value for name, value in os.environ.items() if name not in OF_THIS_PYTHON} | ENVIRONMENT
        launch = [sys.executable, "-I", "-S", LAUNCH, str(os.getpid()), str(LIMITS.memory or 0)]
        try:
            process = subprocess.Popen(
                [*launch, *self.command],
                stdin=theirs.fileno(),
                stdout=theirs.fileno(),
                stderr=subprocess.PIPE,
                env=environment,
                start_new_session=True,  # Ctrl-C is the parent's to handle
            )
        except OSError as error:
            ours.close()
            raise EngineMissing(f"{self.name}: it cannot be started: {error}") from error
        finally:
            theirs.close()
        self._process, self._socket = process, ours
        self._processes.append(process)
        self._frames, self._words = Frames(LARGEST), deque(maxlen=8)
        self.started += 1
        self._listener = threading.Thread(target=_drain, args=(process, self._words), daemon=True)
        self._listener.start()

    def _exchange(self, head: Mapping[str, Any], arrays: Mapping[str, Any]) -> Message:
        assert self._socket is not None
        limit = LIMITS.seconds
        end = None if limit is None else time.monotonic() + limit
        try:
            self._timed(end)
            self._socket.sendall(framed(encode(head, arrays)))
            answer = decode(self._content(end))
        except TimeoutError:
            self.end()
            raise EngineFailed(f"no answer within {limit:g} s: it hangs") from None
        except (BrokenMessage, BrokenChannel) as error:
            self.end()
            raise EngineFailed(f"its process cannot be understood: {error}") from None
        except (EOFError, ConnectionError):
            raise EngineFailed(self._how_it_died()) from None
        except BaseException:  # an interrupt, say: the answer that may still come is nobody's
            self.end()
            raise
        if answer.head.get("say") == "error":
            raise _error(answer.head)
        return answer

    def _timed(self, end: float | None) -> None:
        assert self._socket is not None
        left = None if end is None else end - time.monotonic()
        if left is not None and left <= 0:
            raise TimeoutError
        self._socket.settimeout(left)

    def _content(self, end: float | None) -> bytes:
        assert self._socket is not None
        while (content := self._frames.next()) is None:
            self._timed(end)
            part = self._socket.recv(1 << 16)
            if not part:
                raise EOFError
            self._frames.add(part)
        return content

    def _how_it_died(self) -> str:
        assert self._process is not None
        process = self._process
        try:
            status = process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self.end()
            return "it closed its connection"
        if self._listener is not None:
            self._listener.join(timeout=1.0)  # what it wrote last may still be on its way
        self.end()
        words = b"".join(self._words).decode("utf-8", "replace").split("\n")
        last = " ".join(" ".join(words[-4:]).split())[-LAST_WORDS:]
        said = f" ({last})" if last else ""
        if status < 0:
            return f"its process died of {signal.Signals(-status).name}{said}"
        return f"its process ended with status {status}{said}"


@dataclass(eq=False)
class Model:
    """A model in the engine's process; built again where that is another one than it was."""

    connection: Connection
    mechanism: Mapping[str, Any]
    of: Model | None = None  # the model of a file that it is bound to
    number: int = 0
    start: int = 0

    def built(self) -> int:
        """Its number in the process that runs now."""
        connection = self.connection
        connection.running()
        if self.number and self.start == connection.started:
            return self.number
        base = None if self.of is None else self.of.built()
        number = connection.next_model()
        if base is None:
            connection.ask({"say": "build", "model": number, "mechanism": self.mechanism})
        else:
            connection.ask({"say": "bind", "model": base, "bound": number, "mechanism": self.mechanism})
        self.number, self.start = number, connection.started
        weakref.finalize(self, connection.forget, self.start, number)
        return number

    def ask(self, question: str, arrays: Mapping[str, Any], **words: Any) -> Message:
        """What the engine answers to a question about it."""
        number = self.built()
        return self.connection.ask({"say": "ask", "model": number, "question": question, **words}, arrays)

    def compiled(self, like: Mapping[str, Any] | None) -> Message:
        """What the engine holds of the file that it was made of."""
        return self.connection.ask({"say": "compiled", "model": self.built(), "like": like})


def _error(head: Mapping[str, Any]) -> Exception:
    what = " ".join(str(head.get("what", "")).split())[:2000] or "it answered with an error"
    kind = head.get("kind")
    error = (
        InvalidInput(what) if kind == "invalid" else EngineMissing(what) if kind == "missing" else EngineFailed(what)
    )
    trace = str(head.get("trace", ""))[-8000:]
    if trace:
        error.add_note(f"In the engine's own process:\n{trace}")
    return error


def _drain(process: subprocess.Popen[bytes], words: deque[bytes]) -> None:
    """Keep the last of what it writes to standard error, so that it never waits for a reader."""
    assert process.stderr is not None
    with contextlib.suppress(OSError, ValueError), process.stderr as stream:
        while part := stream.read1(1024):  # type: ignore[attr-defined]
            words.append(part)


def _end_all(processes: list[subprocess.Popen[bytes]]) -> None:
    for process in processes:
        process.kill()
        with contextlib.suppress(OSError):
            process.wait()
