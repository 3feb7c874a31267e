"""Bounds of an algorithm's rounding errors, derived from its arithmetic.

Imports models, documents, the maximal coordinates and motion in space; knows no engine.
"""
