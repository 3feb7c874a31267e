"""Writes a mechanism as MJCF or URDF, for engines and for people.

May import models alone.
"""
