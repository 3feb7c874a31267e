"""Engines in a place of their own: another version, an environment that is there, a program in another language.

Each runs in a process of its own and is asked over one protocol (``docs/reference/engine-protocol.md``);
:mod:`.serve` is its other end in Python, which runs in the engine's environment with NumPy and the adapters alone.
May import models, records, and of engines what knows no engine (info, protocol, workers).
"""
