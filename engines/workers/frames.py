"""Frames: the bytes that carry one message, the same between furiko's own processes and to an engine elsewhere.

A frame is MAGIC, the length of the content and its CRC-32, both with the highest byte first, and the content. Who reads
never waits for the rest of a frame in here: a frame that has not arrived is simply not there yet.
"""

from __future__ import annotations

import struct
import zlib

HEADER = struct.Struct(">8sQI")
MAGIC = b"furiko\x01\n"
LARGEST = 1 << 30  # bytes of one message: the proven values of the largest scene take a hundredth


class BrokenChannel(ConnectionError):
    """The bytes that came are not a frame: the other end wrote something else into its connection."""


def framed(content: bytes) -> bytes:
    """The frame of a content."""
    return HEADER.pack(MAGIC, len(content), zlib.crc32(content)) + content


class Frames:
    """The frames in a stream of bytes, of contents up to ``largest`` bytes."""

    def __init__(self, largest: int = LARGEST) -> None:
        self._buffer = bytearray()
        self._largest = largest

    def add(self, part: bytes) -> None:
        """Bytes that have arrived."""
        self._buffer += part

    def next(self) -> bytes | None:
        """The content of the next frame, None where it has not arrived; :class:`BrokenChannel` for what is no frame."""
        buffer = self._buffer
        if not MAGIC.startswith(bytes(buffer[: len(MAGIC)])):
            raise BrokenChannel("it wrote something else into its connection to furiko")
        if len(buffer) < HEADER.size:
            return None
        _, length, check = HEADER.unpack_from(buffer)
        if length > self._largest:
            raise BrokenChannel(f"it announced a message of {length} bytes; {self._largest} are the limit")
        if len(buffer) < HEADER.size + length:
            return None
        content = bytes(buffer[HEADER.size : HEADER.size + length])
        del buffer[: HEADER.size + length]
        if zlib.crc32(content) != check:
            raise BrokenChannel("a message arrived damaged")
        return content
