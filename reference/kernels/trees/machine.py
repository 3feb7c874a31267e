"""A table's program as machine code, on several states at a time, one a lane of a vector. Needs llvmlite, not numba.

One function serves every mechanism: it goes through the program and calls a piece after the other, for so many states
as a vector has lanes. LLVM compiles it in half a second of a processor, once in a process: what numba needs to import
itself and to load a kernel that it kept. Nothing is kept on disk.
"""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np

from ....models.errors import missing
from ..native import loaded, processor
from .table import PIECES, WIDTH, Array, Table

try:
    from llvmlite import binding, ir

    from .writing import BYTES, DOUBLE, INDEX, WORD, Memory, Numbers, constant
except ImportError as error:
    raise missing("llvmlite", error) from error

LINE = 64  # bytes of a line of the cache
NUMBERS, INDICES = DOUBLE.as_pointer(), INDEX.as_pointer()
LEAST = -np.inf  # below every pivot's negative
# In the order of the function's parameters
ARRAYS = ("q", "v", "torque", "out", "numbers", "memory", "program")
COUNTS = ("instructions", "states", "nq", "nv", "at_q", "at_v", "at_torque", "signs")
_lock = threading.Lock()
_made: dict[int, Machine] = {}


class Machine:
    """The compiled function for so many lanes."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        target = processor()
        module = binding.parse_assembly(str(written(lanes)))
        module.verify()
        options = binding.create_pipeline_tuning_options(speed_level=2)
        options.loop_vectorization = options.slp_vectorization = False  # all is in vectors already
        passes = binding.create_pass_builder(target, options)
        passes.getModulePassManager().run(module, passes)
        self._engine = loaded(module, target)  # the code lives as long as this
        kinds = [ctypes.c_void_p] * len(ARRAYS) + [ctypes.c_int64] * len(COUNTS)
        self._run = ctypes.CFUNCTYPE(None, *kinds)(self._engine.get_function_address("run"))

    def run(self, table: Table, q: Array, v: Array, torque: Array | None, out: Array) -> tuple[float, float, float]:
        """The accelerations of states a row each into ``out``, all contiguous; returns the signs."""
        states, lanes = len(out), self.lanes
        memory = aligned(table.size * lanes)
        signs = memory[table.signs * lanes :][: 3 * lanes].reshape(3, lanes)
        signs[...] = [[0.0], [0.0], [LEAST]]
        if torque is None:
            torque = memory[:0]  # not read from where there are none
        arrays = (q, v, torque, out, table.numbers, memory, table.program)
        sizes = len(table.program), states, table.nq, table.nv, table.at_q, table.at_v, table.at_torque, table.signs
        addresses = [array.__array_interface__["data"][0] if array.size else None for array in arrays]
        self._run(*addresses, *sizes)  # other threads of Python run meanwhile
        finite, largest, pivot = signs.tolist()
        return sum(finite), max(largest), max(pivot)


def machine(lanes: int | None = None) -> Machine:
    """The compiled function, for as many lanes as the processor's vectors have, or two at a time where they are few."""
    lanes = lanes or usual_lanes()
    with _lock:
        if lanes not in _made:
            _made[lanes] = Machine(lanes)
        return _made[lanes]


@cache
def usual_lanes() -> int:
    """Eight where vectors have 512 bits; where they have 256, four: eight would take twice the memory, which counts."""
    return 8 if binding.get_host_cpu_features().get("avx512f") else 4


def aligned(count: int) -> Array:
    """``count`` uninitialised numbers, aligned to a line of the cache."""
    numbers = np.empty(count + LINE // BYTES)
    start = (-numbers.ctypes.data % LINE) // BYTES
    return numbers[start : start + count]


def written(lanes: int) -> Any:
    """The module: a function for each piece, and ``run``."""
    module = ir.Module("furiko")
    pieces = [_piece(module, formulas, lanes) for formulas in PIECES]
    kinds = [NUMBERS] * 6 + [INDICES] + [INDEX] * len(COUNTS)
    function = ir.Function(module, ir.FunctionType(ir.VoidType(), kinds), "run")
    _wide(function)
    builder = ir.IRBuilder(function.append_basic_block())
    given: dict[str, Any] = dict(zip((*ARRAYS, *COUNTS), function.args, strict=True))
    memory = Memory(builder, given["memory"], lanes)
    with _loop(builder, given["states"], lanes) as first:
        _read(builder, memory, given, first)
        with _loop(builder, given["instructions"]) as k:
            at = builder.gep(given["program"], [builder.mul(k, INDEX(WIDTH))])
            _step(builder, pieces, given["memory"], given["numbers"], at)
        rows = _rows(builder, memory.vector.count, given["out"], given["nv"], given["states"], first)
        with _loop(builder, given["nv"]) as j:
            found = builder.load(memory.at(builder.add(given["at_torque"], j)))
            for i, row in enumerate(rows):
                builder.store(builder.extract_element(found, WORD(i)), builder.gep(row, [j]))
    builder.ret_void()
    return module


def _piece(module: Any, formulas: Callable[..., None], lanes: int) -> Any:
    """The function ``piece(memory, numbers, places)`` of one piece."""
    kind = ir.FunctionType(ir.VoidType(), [NUMBERS, NUMBERS, INDICES])
    function = ir.Function(module, kind, formulas.__name__)
    function.linkage = "internal"
    _wide(function)
    for argument in function.args:
        argument.add_attribute("noalias")
    builder = ir.IRBuilder(function.append_basic_block())
    memory, numbers, program = function.args
    places = [builder.load(builder.gep(program, [INDEX(i)])) for i in range(formulas.__code__.co_argcount - 2)]
    states = Memory(builder, memory, lanes)
    formulas(states, Numbers(builder, numbers, lanes), *places)
    states.finish()
    builder.ret_void()
    return function


def _wide(function: Any) -> None:
    """Let a function use vectors of 512 bits where there are some; LLVM alone stops at 256 on most processors."""
    for attribute in ('"prefer-vector-width"="512"', '"min-legal-vector-width"="512"'):
        set.add(function.attributes, attribute)  # llvmlite's own add() knows only attributes without a value


def _step(builder: Any, pieces: list[Any], memory: Any, numbers: Any, at: Any) -> None:
    """Call the piece that the instruction names, with its places."""
    after = builder.append_basic_block()
    unknown = builder.append_basic_block()
    places = builder.gep(at, [INDEX(1)])
    choice = builder.switch(builder.load(at), unknown)
    builder.position_at_end(unknown)
    builder.unreachable()
    for number, piece in enumerate(pieces):
        block = builder.append_basic_block()
        choice.add_case(INDEX(number), block)
        builder.position_at_end(block)
        builder.call(piece, [memory, numbers, places])
        builder.branch(after)
    builder.position_at_end(after)


def _read(builder: Any, memory: Memory, given: dict[str, Any], first: Any) -> None:
    """Coordinates, rates and torques of the states from the first on, of the last one where there are no more."""
    none = builder.icmp_unsigned("==", builder.ptrtoint(given["torque"], INDEX), INDEX(0))
    for name, width in (("q", "nq"), ("v", "nv")):
        _columns(builder, memory, given, first, name, width)
    with builder.if_else(none) as (still, driven):
        with still, _loop(builder, given["nv"]) as j:
            builder.store(constant(memory.vector, 0.0), memory.at(builder.add(given["at_torque"], j)))
        with driven:
            _columns(builder, memory, given, first, "torque", "nv")


def _columns(builder: Any, memory: Memory, given: dict[str, Any], first: Any, name: str, width: str) -> None:
    lanes = memory.vector.count
    rows = _rows(builder, lanes, given[name], given[width], given["states"], first)
    with _loop(builder, given[width]) as j:
        vector = ir.Constant(memory.vector, ir.Undefined)
        for i, row in enumerate(rows):
            vector = builder.insert_element(vector, builder.load(builder.gep(row, [j])), WORD(i))
        builder.store(vector, memory.at(builder.add(given[f"at_{name}"], j)))


def _rows(builder: Any, lanes: int, data: Any, width: Any, states: Any, first: Any) -> list[Any]:
    """Where the rows of the lanes begin."""
    last = builder.sub(states, INDEX(1))
    rows = []
    for i in range(lanes):
        row = builder.add(first, INDEX(i))
        row = builder.select(builder.icmp_signed("<", row, last), row, last)
        rows.append(builder.gep(data, [builder.mul(row, width)]))
    return rows


@contextmanager
def _loop(builder: Any, end: Any, step: int = 1) -> Iterator[Any]:
    """Instructions that are repeated for 0, step, … below ``end``."""
    before = builder.block
    head, body, after = (builder.append_basic_block() for _ in range(3))
    builder.branch(head)
    builder.position_at_end(head)
    index = builder.phi(INDEX)
    index.add_incoming(INDEX(0), before)
    builder.cbranch(builder.icmp_signed("<", index, end), body, after)
    builder.position_at_end(body)
    yield index
    index.add_incoming(builder.add(index, INDEX(step)), builder.block)
    builder.branch(head)
    builder.position_at_end(after)
