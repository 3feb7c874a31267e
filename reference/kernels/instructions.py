"""LLVM's instructions that kernels share, whoever compiles them. Needs llvmlite, not numba."""

from __future__ import annotations

from typing import Any

from llvmlite import ir

# Fused multiply-add and reciprocals of constants, but no reassociation: compensated sums stay exact.
FAST = ("arcp", "contract", "nsz")


def declared(builder: Any, name: str, kind: Any) -> Any:
    """One of LLVM's own functions."""
    return builder.module.globals.get(name) or ir.Function(builder.module, kind, name)


def in_quadrants(builder: Any, rounded: Any, sine: Any, cosine: Any) -> tuple[Any, Any]:
    """Sine and cosine of an angle from those of what is left of it within its quadrant.

    The quadrant stands in the lowest two bits of ``rounded``. For numbers and for vectors of any length.
    """
    numbers = rounded.type
    word = ir.IntType(64)
    words = ir.VectorType(word, numbers.count) if isinstance(numbers, ir.VectorType) else word

    def constant(value: int) -> Any:
        return ir.Constant(words, [value] * numbers.count if words is not word else value)

    def flipped(x: Any, quadrant: Any) -> Any:
        sign = builder.shl(builder.and_(quadrant, constant(2)), constant(62))
        return builder.bitcast(builder.xor(builder.bitcast(x, words), sign), numbers)

    quadrant = builder.bitcast(rounded, words)
    swap = builder.icmp_signed("!=", builder.and_(quadrant, constant(1)), constant(0))
    return (
        flipped(builder.select(swap, cosine, sine), quadrant),
        flipped(builder.select(swap, sine, cosine), builder.add(quadrant, constant(1))),
    )
