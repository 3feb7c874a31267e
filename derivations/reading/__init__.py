"""Reads a derivation as its author wrote it: notation, matrices, symbols; and says back what was read.

May import models (for its errors), algebra and steps.
"""
