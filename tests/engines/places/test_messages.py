"""Messages of the protocol: what is written is read, and whatever else comes is refused before it costs anything."""

import contextlib
import json
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from furiko.engines.places.messages import BrokenMessage, decode, encode


def content(head, tail=b"", length=None):
    text = head if isinstance(head, bytes) else json.dumps(head).encode()
    return struct.pack(">I", len(text) if length is None else length) + text + tail


def test_a_message_is_laid_out_as_the_page_says():
    # by hand: {"say":"x"} has the arrays' names and shapes added, 2.5 is 0x4004000000000000, lowest byte first
    found = encode({"say": "x"}, {"a": np.array([[2.5]])})
    (length,) = struct.unpack(">I", found[:4])
    assert json.loads(found[4 : 4 + length]) == {"say": "x", "arrays": [["a", [1, 1]]]}
    assert found[4 + length :] == bytes([0, 0, 0, 0, 0, 0, 4, 0x40])


def test_arrays_come_back_to_the_last_bit():
    values = {"nan": np.array([np.nan, np.inf, -0.0]), "none": np.zeros((0, 3)), "q": np.full((2, 3, 4), 0.1)}
    found = decode(encode({"say": "answer", "n": 3}, values))
    assert found.head == {"say": "answer", "n": 3}
    for name, array in values.items():
        assert found.arrays[name].shape == array.shape
        assert found.arrays[name].tobytes() == array.tobytes()


@pytest.mark.parametrize(
    "broken",
    [
        b"",
        b"\0\0\0",
        content({}, length=3_000_000_000),
        content(b"[1]"),
        content(b"nonsense"),
        content(b"\xff\xfe"),
        content(b'{"a": NaN}'),
        content(b"[" * 100_000),
        content({"arrays": 3}),
        content({"arrays": [["a"]]}),
        content({"arrays": [["a", [-1]]]}),
        content({"arrays": [["a", [1.5]]]}),
        content({"arrays": [["a", [True]]]}),
        content({"arrays": [["a", [2]]]}, b"\0" * 8),
        content({"arrays": [["a", [1 << 31, 1 << 31, 1 << 31, 1 << 31]]]}),
        content({"arrays": [["a", [1]]]}, b"\0" * 9),
        content({"arrays": [["a", [0]]] * 65}),
        content({"arrays": [["a", [1, 1, 1, 1, 1]]]}, b"\0" * 8),
    ],
)
def test_what_is_no_message_is_refused(broken):
    with pytest.raises(BrokenMessage):
        decode(broken)


@given(st.binary(max_size=200))
def test_any_bytes_are_a_message_or_are_refused(data):
    with contextlib.suppress(BrokenMessage):
        decode(data)


def test_a_number_that_is_none_is_not_sent():
    with pytest.raises(ValueError):
        encode({"step": float("nan")})
