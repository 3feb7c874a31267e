"""The pages of a class: one for the teacher with everything, one a student with what the hints allow."""

from __future__ import annotations

from ...records.classroom import Assessed, ClassDocument
from .rendering import render

GLYPHS = {"correct": "✓", "wrong": "✗", "undecided": "≈", "not read": "!", "not graded": "!"}
CLASSES = {"correct": "agrees", "wrong": "differs", "undecided": "loose", "not read": "error", "not graded": "error"}


def to_teachers_page(found: ClassDocument) -> str:
    """The table of all, who made which mistake, and each submission with its wrong terms and the solution."""
    ranked = sorted(found.mistakes, key=lambda m: -len(m.who))
    right = sum(s.outcome == "correct" for s in found.submissions)
    return render("class.html.j2", found=found, mistakes=ranked, right=right, glyphs=GLYPHS, classes=CLASSES)


def to_students_page(found: ClassDocument, submission: Assessed) -> str:
    """One submission, for its author."""
    return render("student.html.j2", found=found, s=submission, glyphs=GLYPHS, classes=CLASSES)
