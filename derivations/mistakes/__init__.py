"""The catalogue of mistakes: every kind of mistake at every place of a derivation, one file a subject.

May import algebra and steps.
"""
