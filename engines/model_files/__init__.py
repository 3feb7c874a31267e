"""Adapters that load a user's own model file, MJCF or URDF, into an engine.

May import models and the rest of engines.
"""
