"""Writes a page for a class: thirty mistakes, with a question before each.

May import models (for its errors), algebra, steps, mistakes and grading; not audit.
"""
