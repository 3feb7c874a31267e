"""Audits both documents: each of their numbered equations, as printed, against first principles.

May import models, reference, algebra, steps, mistakes and grading; not lesson.
"""
