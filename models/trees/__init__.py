"""Scenes of open mechanisms, and the states in which they are looked at.

May import the other models.
"""
