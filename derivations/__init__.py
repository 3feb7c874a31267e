"""Derivations of equations of motion: exact algebra, the catalogue of mistakes, the grader, the audit and the lesson.

May import models and reference; inside, imports run one way: algebra ← steps ← reading ← mistakes ← grading ← robot,
audit, lesson and classroom.
A derivation is read by :mod:`.reading.submission`, judged by :mod:`.grading.judge` and, where it is wrong, explained
by mistakes of :mod:`.mistakes.catalogue` in :mod:`.grading.explain`; :mod:`.grading.grade` does it all. Nothing is
imported here, so that each part costs only what it needs.
"""
