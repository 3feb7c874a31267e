"""Exact formulas: trigonometric polynomials, fractions of them, and how they are written.

May import models and reference.
"""
