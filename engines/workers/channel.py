"""Messages over a socket: framed, bounded and checked, because an engine may write into any file of its process.

A frame is MAGIC, the length of the content and its CRC-32, and the pickled content. The parent reads what is there and
never waits for the rest of a frame, so that a worker that stops in the middle of one holds nobody up.
"""

from __future__ import annotations

import pickle
import socket
import struct
import zlib

HEADER = struct.Struct(">8sQI")
MAGIC = b"furiko\x01\n"
LARGEST = 1 << 30  # bytes of one message: the proven values of the largest scene take a hundredth
SEND_TIMEOUT = 30.0  # [s] for a job to be taken: an idle worker reads at once


class BrokenChannel(ConnectionError):
    """The bytes that came are not a frame: the worker wrote something else into its connection."""


def encode(message: object) -> bytes:
    """The frame of one message."""
    content = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
    return HEADER.pack(MAGIC, len(content), zlib.crc32(content)) + content


class Channel:
    """One end of a connection."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self._buffer = bytearray()

    def send(self, message: object) -> None:
        """Send a message; raises ConnectionError or TimeoutError where the other end does not take it."""
        self.connection.sendall(encode(message))

    def receive(self) -> object:
        """Wait for the next message; raises EOFError where the other end is closed."""
        while True:
            complete, message = self._next()
            if complete:
                return message
            self._read()

    def available(self) -> list[object]:
        """Read once, and return the messages that are complete by then.

        Raises EOFError where the other end is closed and :class:`BrokenChannel` for what is not a message.
        """
        self._read()
        found: list[object] = []
        while True:
            complete, message = self._next()
            if not complete:
                return found
            found.append(message)

    def close(self) -> None:
        """Close this end."""
        self.connection.close()

    def _read(self) -> None:
        part = self.connection.recv(1 << 20)
        if not part:
            raise EOFError("the connection is closed")
        self._buffer += part

    def _next(self) -> tuple[bool, object]:
        """Whether a whole frame is in the buffer, and its content."""
        buffer = self._buffer
        if not MAGIC.startswith(bytes(buffer[: len(MAGIC)])):
            raise BrokenChannel("it wrote something else into its connection to furiko")
        if len(buffer) < HEADER.size:
            return False, None
        _, length, check = HEADER.unpack_from(buffer)
        if length > LARGEST:
            raise BrokenChannel(f"it announced a message of {length} bytes; {LARGEST} are the limit")
        if len(buffer) < HEADER.size + length:
            return False, None
        content = bytes(buffer[HEADER.size : HEADER.size + length])
        del buffer[: HEADER.size + length]
        if zlib.crc32(content) != check:
            raise BrokenChannel("a message arrived damaged")
        try:
            return True, pickle.loads(content)
        except Exception as error:
            raise BrokenChannel(f"a message cannot be read: {type(error).__name__}: {error}") from None
