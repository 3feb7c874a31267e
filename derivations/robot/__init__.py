"""A user's own equations of a mechanism that a model file has: read, evaluated in balls, and explained where wrong.

May import the other rooms of derivations but audit, lesson and classroom, models and reference.
"""
