"""Reads derivations in other forms than equations of motion or a Lagrangian: Hamilton's, and stage by stage.

May import models (for its errors), algebra, steps, and the reader of lines of reading.
"""
