"""Holds derivations in other forms than equations of motion to the truth: Hamilton's, and stage by stage.

May import models (for its errors), algebra, steps, reading, and of grading what judges rows and lists their terms.
"""
