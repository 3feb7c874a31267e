"""The catalogue of mistakes: every operator at every place of a derivation.

May import models, reference and the rest of derivations.
"""
