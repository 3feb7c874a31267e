"""A compiled kernel by its name: from the instructions that are written ahead, or else from numba.

Machine code of these instructions is made in a fraction of a second, in each process, and nothing is kept on disk. They
are for the kind of system that they were written on, and for LLVM of that version or newer; for any other, and where a
kernel's text has changed since, numba compiles the text.
"""

from __future__ import annotations

import ctypes
import lzma
import sys
import threading
from collections.abc import Callable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from .announcing import announced
from .kernels import KERNELS, place, source_stamp

ENTRY, OBJECTS = "kernel", "objects"  # names in the instructions: the function, and what it knows of Python
METH_FASTCALL = 0x80
SYMBOLS = (
    "PyErr_NoMemory",
    "PyErr_Occurred",
    "PyErr_SetString",
    "PyEval_RestoreThread",
    "PyEval_SaveThread",
    "PyFloat_AsDouble",
    "PyLong_AsLongLong",
    "PyLong_FromLongLong",
)
TYPES = {"f": np.dtype(np.float64), "i": np.dtype(np.int64)}
_REFERENCE = __name__.removesuffix(".kernels.ahead.load")
_lock = threading.RLock()
_loaded: dict[str, Callable[..., int]] = {}
_alive: list[Any] = []  # code, and what its functions are described by
_new_function = ctypes.pythonapi.PyCFunction_NewEx
_new_function.restype, _new_function.argtypes = ctypes.py_object, (ctypes.c_void_p,) * 3


class _Method(ctypes.Structure):
    """Python's PyMethodDef."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("function", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


def kernel(name: str) -> Callable[..., int]:
    """The kernel, a function of contiguous arrays and numbers; made once in a process. Raises LibraryMissing."""
    found = _loaded.get(name)
    if found is None:
        with _lock:
            found = _loaded[name] = _loaded.get(name) or _first(name)
    return found


def _first(name: str) -> Callable[..., int]:
    if not is_ahead(name):
        found: Callable[..., int] = by_numba(name)
        return found
    with announced(f"machine code is made for {KERNELS[name].what}, about a second in each process"):
        return made(name)


def is_loaded(name: str) -> bool:
    """Whether the kernel has been asked for."""
    return name in _loaded


def can_load(name: str) -> bool:
    """Whether what the kernel needs is installed."""
    return is_ahead(name) or find_spec("numba") is not None


def by_numba(name: str) -> Any:
    """The kernel as numba compiles its text: numba's dispatcher."""
    return getattr(import_module(f"{_REFERENCE}.{KERNELS[name].module}"), name)


@cache
def is_ahead(name: str) -> bool:
    """Whether its instructions are there, for its present text, and can be used here."""
    if find_spec("llvmlite") is None or not place(name).is_file() or not arrays_are_as_read():
        return False
    with lzma.open(place(name), "rt") as lines:
        words = next(lines, "").split()
    stamp, system, version = first_line().split()[1:4]
    return words[1:3] == [stamp, system] and int(words[3]) <= int(version)


def first_line() -> str:
    """Of a file that fits here: the text it was made of, the kind of system, and LLVM's version."""
    from llvmlite import binding

    return f"; {source_stamp()} {binding.get_process_triple()} {binding.llvm_version_info[0]}"


def text(name: str) -> str:
    """The instructions."""
    return lzma.decompress(place(name).read_bytes()).decode()


def made(name: str, processor_name: str | None = None) -> Callable[..., int]:
    """The kernel from its instructions: a function as those of Python's extension modules are.

    For another processor than this one if it is named. Called, it raises TypeError for an array of another type or
    number of axes, or that is not contiguous, and MemoryError where there is no memory for what it works with.
    """
    from llvmlite import binding

    from ..native import loaded, processor

    for symbol in SYMBOLS:
        binding.add_symbol(symbol, ctypes.cast(getattr(ctypes.pythonapi, symbol), ctypes.c_void_p).value)
    engine = loaded(binding.parse_assembly(text(name)), processor(processor_name))
    objects = (ctypes.c_void_p * 2).from_address(engine.get_global_value_address(OBJECTS))
    objects[:] = [id(np.ndarray), id(TypeError)]
    method = _Method(name.encode(), engine.get_function_address(ENTRY), METH_FASTCALL, None)
    _alive.append((engine, method))
    found: Callable[..., int] = _new_function(ctypes.addressof(method), None, None)
    return found


@cache
def arrays_are_as_read() -> bool:
    """Whether Python's objects and numpy's arrays lie in memory as ``runtime.ll`` reads them."""
    if sys.implementation.name != "cpython" or object.__basicsize__ != 16:
        return False
    array = np.zeros((2, 3))
    words = (ctypes.c_int64 * 9).from_address(id(array))
    sizes, strides = ((ctypes.c_int64 * 2).from_address(words[k]) for k in (4, 5))
    return (
        words[1:3] == [id(np.ndarray), array.__array_interface__["data"][0]]
        and words[3] & 0xFFFFFFFF == array.ndim
        and (*sizes, *strides) == (*array.shape, *array.strides)
        and words[7] == id(array.dtype)
        and words[8] & 0x101 == 0x101
        and ctypes.c_char.from_address(words[7] + 26).value == b"="
        and ctypes.c_int.from_address(words[7] + 28).value == array.dtype.num
    )
