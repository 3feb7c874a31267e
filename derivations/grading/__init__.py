"""Reads a derivation, decides whether it is right, and names the mistakes where it is wrong.

May import models, reference and the rest of derivations.
"""
