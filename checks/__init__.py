"""Compares each engine with the theory, quantity by quantity, and judges each difference by a derived bound.

May import models, records, reference, engines and diagnosis.
"""
