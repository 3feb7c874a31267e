"""The messages of the protocol: a JSON object, and arrays of float64 as bytes behind it.

The content of a frame is the length of the JSON text (4 bytes, highest first), the text in UTF-8, and the arrays one
after the other, row by row, 8 bytes a number, IEEE 754, lowest byte first. The object's ``arrays`` says their names
and shapes, in that order. Whatever comes is read as data and bounded before anything is allocated for it.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PROTOCOL = 1
LENGTH = struct.Struct(">I")
LONGEST_TEXT = 64 << 20  # bytes of JSON: a mechanism of 10,000 links takes two million
MOST_ARRAYS = 64
MOST_AXES = 4


class BrokenMessage(ConnectionError):
    """What came in a frame is no message of the protocol."""


@dataclass(frozen=True)
class Message:
    """``head``: the JSON object without its arrays; ``arrays`` by name."""

    head: Mapping[str, Any]
    arrays: Mapping[str, Array] = field(default_factory=dict)


def encode(head: Mapping[str, Any], arrays: Mapping[str, Any] | None = None) -> bytes:
    """The content of a message's frame. Raises ValueError for a number of ``head`` that is not finite."""
    held = {name: np.ascontiguousarray(values, dtype="<f8") for name, values in (arrays or {}).items()}
    shapes = [[name, list(values.shape)] for name, values in held.items()]
    text = json.dumps({**head, "arrays": shapes}, allow_nan=False, ensure_ascii=True).encode()
    return b"".join([LENGTH.pack(len(text)), text, *(values.tobytes() for values in held.values())])


def decode(content: bytes) -> Message:
    """The message in a frame. Raises :class:`BrokenMessage` for anything else."""
    head, rest = _head(content)
    shapes = head.pop("arrays", [])
    if not isinstance(shapes, list) or len(shapes) > MOST_ARRAYS:
        raise BrokenMessage(f"its arrays are no list of at most {MOST_ARRAYS}")
    arrays: dict[str, Array] = {}
    at = 0
    for entry in shapes:
        name, shape = _shape(entry)
        size = 8 * math.prod(shape)
        if at + size > len(rest):
            raise BrokenMessage(f"its array {name!r} of shape {shape} is longer than what came")
        arrays[name] = np.frombuffer(rest[at : at + size], dtype="<f8").astype(np.float64).reshape(shape)
        at += size
    if at != len(rest):
        raise BrokenMessage(f"{len(rest) - at} bytes are left over behind its arrays")
    return Message(head, arrays)


def _head(content: bytes) -> tuple[dict[str, Any], memoryview]:
    if len(content) < LENGTH.size:
        raise BrokenMessage("a message ends before its text begins")
    (length,) = LENGTH.unpack_from(content)
    if length > min(LONGEST_TEXT, len(content) - LENGTH.size):
        raise BrokenMessage(f"it announced a text of {length} bytes in a message of {len(content)}")
    try:
        head = json.loads(content[LENGTH.size : LENGTH.size + length].decode(), parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        raise BrokenMessage(f"its text is no JSON: {error}") from None
    if not isinstance(head, dict):
        raise BrokenMessage("its text is no JSON object")
    return head, memoryview(content)[LENGTH.size + length :]


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is no number of JSON")


def _shape(entry: Any) -> tuple[str, tuple[int, ...]]:
    if not (isinstance(entry, list) and len(entry) == 2):
        raise BrokenMessage("an array of it has no name and shape")
    name, shape = entry
    sound = isinstance(name, str) and isinstance(shape, list) and len(shape) <= MOST_AXES
    if not sound or not all(type(size) is int and 0 <= size <= 1 << 31 for size in shape):
        raise BrokenMessage(f"an array of it has no sound shape: {str(entry)[:80]}")
    return name, tuple(shape)
