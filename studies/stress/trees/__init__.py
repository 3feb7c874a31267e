"""Open mechanisms in space under stress: axes along which any of them can be made worse, and what a rung measures.

May import what :mod:`furiko.studies.stress` may; its cases and failures are those of the documents' mechanisms.
"""
