"""Exact formulas: trigonometric polynomials, quotients of them, and their notation as text.

May import models (for its errors) and nothing else of derivations.
"""
