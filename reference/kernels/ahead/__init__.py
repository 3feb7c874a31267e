"""Kernels written ahead as LLVM's instructions, so that a first call need not wait for numba.

May import numpy, and llvmlite where code is made; nothing of furiko but the kernels' ``native``.
"""
