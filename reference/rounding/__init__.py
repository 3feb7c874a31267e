"""Bounds of an algorithm's rounding errors, derived from its arithmetic.

Imports models, documents and the maximal coordinates; knows no engine.
"""
