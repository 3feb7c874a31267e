"""Grading for a class: problems that a teacher pins, points, hints, and whole folders of submissions.

May import all other folders of derivations but audit and lesson.
"""
