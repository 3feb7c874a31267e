"""Writes the kernels ahead: ``python -m furiko.reference.write_kernels [NAME …]``, once their text has changed.

numba turns a kernel's Python text into LLVM's instructions and optimises them, for seconds; to make machine code of
these takes a tenth of that. So they are kept as files, and :mod:`.kernels.ahead.load` makes machine code of them,
without numba. Written once, they give the same numbers wherever they run with the same kinds of instructions.
"""

from __future__ import annotations

import lzma
import re
import sys
from pathlib import Path
from typing import Any

from llvmlite import binding
from numba import types

from .kernels.ahead import kernels, load
from .kernels.ahead.kernels import KERNELS, Parameter, Written, place
from .kernels.ahead.load import ENTRY, OBJECTS, TYPES
from .kernels.native import processor

CONTIGUOUS, ALIGNED = 0x1, 0x100  # numpy's flags
# The function that Python calls (METH_FASTCALL): it looks at what it is given, and hands it to the kernel, whose status
# is 0, or -2 where it returns None.
WAY_IN = """
declare i1 @fits(ptr, i32, i32, i32)
declare ptr @data(ptr)
declare i64 @size(ptr, i64)
declare i64 @stride(ptr, i64)
declare ptr @refused()
declare ptr @PyErr_Occurred()
declare ptr @PyErr_NoMemory()
declare double @PyFloat_AsDouble(ptr)
declare i64 @PyLong_AsLongLong(ptr)
declare ptr @PyLong_FromLongLong(i64)
declare ptr @PyEval_SaveThread()
declare void @PyEval_RestoreThread(ptr)
declare i32 @{entry}(ptr, ptr, {kinds})

define ptr @{way_in}(ptr %self, ptr %given, i64 %count) {{
  %found = alloca i64
  %exception = alloca ptr
  store i64 0, ptr %found
  %counted = icmp eq i64 %count, {count}
  br i1 %counted, label %look, label %wrong
look:
  {looks}
  %error = call ptr @PyErr_Occurred()
  %ok = icmp eq ptr %error, null
  br i1 %ok, label %run, label %wrong
run:
  {reads}
  {before}
  %status = call i32 @{entry}(ptr %found, ptr %exception, {words})
  {after}
  %right = icmp eq i32 %status, 0
  %nothing = icmp eq i32 %status, -2
  %done = or i1 %right, %nothing
  br i1 %done, label %answer, label %failed
answer:
  %value = load i64, ptr %found
  %number = call ptr @PyLong_FromLongLong(i64 %value)
  ret ptr %number
failed:
  %none = call ptr @PyErr_NoMemory()
  ret ptr %none
wrong:
  %refused = call ptr @refused()
  ret ptr %refused
}}
"""
RUNTIME = (kernels.HERE / "runtime.ll").read_text(encoding="utf-8")
OWN = re.compile(r"define linkonce_odr void @(NRT_\w+)\([^\n]*\{\n.*?\n\}\n", re.DOTALL)  # instead of numba's


def main(names: list[str]) -> None:
    """Write the files of these kernels, or of all."""
    for name in names or KERNELS:
        place(name).parent.mkdir(exist_ok=True)
        place(name).write_bytes(lzma.compress(written(name).encode(), preset=9 | lzma.PRESET_EXTREME))
        sys.stdout.write(f"{Path(place(name)).name}: {place(name).stat().st_size // 1024} KB\n")


def written(name: str) -> str:
    """The kernel as optimised instructions with one way in, ``kernel``."""
    kernel = KERNELS[name]
    kept = load.by_numba(name)
    compiled = _compiled(kept, kernel)
    module = binding.parse_assembly(OWN.sub(r"declare void @\1(ptr)\n", compiled.library.get_llvm_str()))
    entry = compiled.fndesc.llvm_func_name
    module.link_in(binding.parse_assembly(RUNTIME))
    way_in = _way_in(entry, kernel, releases_gil=kept.targetoptions.get("nogil", False))
    module.link_in(binding.parse_assembly(way_in))
    for each in (*module.functions, *module.global_variables):
        if not each.is_declaration and each.name not in (ENTRY, OBJECTS):
            each.linkage = "internal"
    _drop_unused(module)
    module.verify()
    return f"{load.first_line()}\n{module}"


def _compiled(kept: Any, kernel: Written) -> Any:
    """What numba makes of the kernel, nothing of it from numba's cache."""
    fresh = type(kept)(kept.py_func, targetoptions=kept.targetoptions)
    given = tuple(_numba_type(parameter) for parameter in kernel.parameters)
    fresh.compile((types.Tuple(given),) if kernel.packed else given)
    (compiled,) = fresh.overloads.values()
    return compiled


def _numba_type(parameter: Parameter) -> Any:
    number = types.float64 if parameter.kind == "f" else types.int64
    return types.Array(number, parameter.axes, "A" if parameter.strided else "C") if parameter.axes else number


def _drop_unused(module: Any) -> None:
    """numba's ways in from Python and C, and what only they use."""
    passes = binding.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, binding.create_pass_builder(processor(), binding.create_pipeline_tuning_options(0)))


def _way_in(entry: str, kernel: Written, *, releases_gil: bool) -> str:
    """The function that Python calls. Raises TypeError for what does not fit, MemoryError where the kernel fails."""
    numbers = [_number(i, each) if not each.axes else _array(i, each) for i, each in enumerate(kernel.parameters)]
    looks, reads, words = ([line for each in numbers for line in each[k]] for k in range(3))
    return WAY_IN.format(
        entry=entry,
        way_in=ENTRY,
        count=len(kernel.parameters),
        kinds=", ".join(word.split()[0] for word in words),
        looks="\n  ".join(looks),
        reads="\n  ".join(reads),
        words=", ".join(words),
        before="%thread = call ptr @PyEval_SaveThread()" if releases_gil else "",
        after="call void @PyEval_RestoreThread(ptr %thread)" if releases_gil else "",
    )


def _given(i: int) -> list[str]:
    return [f"%p{i} = getelementptr ptr, ptr %given, i64 {i}", f"%g{i} = load ptr, ptr %p{i}"]


def _number(i: int, parameter: Parameter) -> tuple[list[str], list[str], list[str]]:
    """Lines that look at a number, lines that read it, and what is handed on."""
    kind, reader = ("double", "PyFloat_AsDouble") if parameter.kind == "f" else ("i64", "PyLong_AsLongLong")
    return [*_given(i), f"%n{i} = call {kind} @{reader}(ptr %g{i})"], [], [f"{kind} %n{i}"]


def _array(i: int, parameter: Parameter) -> tuple[list[str], list[str], list[str]]:
    """The same of an array: numba's kernels take two owners, count, bytes of a number, place, sizes and strides."""
    looks = [*_given(i), f"%ok{i} = call i1 @fits(ptr %g{i}, {_expected(parameter)})"]
    looks += [f"br i1 %ok{i}, label %good{i}, label %wrong", f"good{i}:"]
    lines, count = [f"%d{i} = call ptr @data(ptr %g{i})"], "1"
    for axis in range(parameter.axes):
        lines += [
            f"%s{i}a{axis} = call i64 @size(ptr %g{i}, i64 {axis})",
            f"%t{i}a{axis} = call i64 @stride(ptr %g{i}, i64 {axis})",
            f"%c{i}a{axis} = mul i64 {count}, %s{i}a{axis}",
        ]
        count = f"%c{i}a{axis}"
    words = ["ptr null", "ptr null", f"i64 {count}", "i64 8", f"ptr %d{i}"]
    words += [f"i64 %{which}{i}a{axis}" for which in "st" for axis in range(parameter.axes)]
    return looks, lines, words


def _expected(parameter: Parameter) -> str:
    """What ``fits`` compares with: numpy's number of the type, axes and flags."""
    flags = ALIGNED if parameter.strided else ALIGNED | CONTIGUOUS
    return f"i32 {TYPES[parameter.kind].num}, i32 {parameter.axes}, i32 {flags}"


if __name__ == "__main__":
    main(sys.argv[1:])
