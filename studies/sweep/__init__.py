"""Sweeps: scenes and random mechanisms × parameters × seeds × engines × checks, declared in a file, run in chunks.

May import models, records, reference, engines, diagnosis and checks.
"""
