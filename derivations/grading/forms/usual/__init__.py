"""Usual mechanisms in the letters that a text has for them.

Nothing is concluded from a letter: each mechanism is tried, and what a derivation is right for is said, with every
letter. May import derivations/reading, derivations/dialects, derivations/grading and models.
"""
