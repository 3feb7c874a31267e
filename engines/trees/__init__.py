"""Engines with open mechanisms: one adapter an engine behind :class:`~furiko.engines.protocol.TreeEngine`.

May import models and the engines' own rooms.
"""
