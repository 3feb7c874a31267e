"""Messages over a socket: framed, bounded and checked, because an engine may write into any file of its process.

The content of a frame (:mod:`.frames`) is a pickled object: both ends are furiko's own. The parent reads what is there
and never waits for the rest of a frame, so that a worker that stops in the middle of one holds nobody up.
"""

from __future__ import annotations

import pickle
import socket

from .frames import BrokenChannel, Frames, framed

READ = 1 << 16  # bytes at a time: making room for a million takes longer than all the rest of a short message
SEND_TIMEOUT = 30.0  # [s] for a job to be taken: an idle worker reads at once

__all__ = ["SEND_TIMEOUT", "BrokenChannel", "Channel", "encode"]


def encode(message: object) -> bytes:
    """The frame of one message."""
    return framed(pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL))


class Channel:
    """One end of a connection. ``ready``: whether the worker at the other end has said so."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self.ready = False
        self._frames = Frames()
        self._held = bytearray()

    def send(self, message: object) -> None:
        """Send a message; raises ConnectionError or TimeoutError where the other end does not take it."""
        self.hold(message)
        self.flush()

    def hold(self, message: object) -> None:
        """Keep a message, as it is now, for the next that is sent."""
        self._held += encode(message)

    def flush(self) -> None:
        """Send what is held."""
        if self._held:
            held, self._held = self._held, bytearray()
            self.connection.sendall(held)

    def receive(self) -> object:
        """Wait for the next message; raises EOFError where the other end is closed."""
        while True:
            content = self._frames.next()
            if content is not None:
                return _decoded(content)
            self._read()

    def available(self) -> list[object]:
        """Read once, and return the messages that are complete by then.

        Raises EOFError where the other end is closed and :class:`BrokenChannel` for what is not a message.
        """
        self._read()
        found: list[object] = []
        while (content := self._frames.next()) is not None:
            found.append(_decoded(content))
        return found

    def close(self) -> None:
        """Close this end."""
        self.connection.close()

    def _read(self) -> None:
        part = self.connection.recv(READ)
        if not part:
            raise EOFError("the connection is closed")
        self._frames.add(part)


def _decoded(content: bytes) -> object:
    try:
        return pickle.loads(content)
    except Exception as error:
        raise BrokenChannel(f"a message cannot be read: {type(error).__name__}: {error}") from None
