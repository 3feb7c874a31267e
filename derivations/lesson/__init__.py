"""A page for a class: thirty mistakes, a question before each.

May import models, reference and the rest of derivations.
"""
