"""Puts what computer algebra, programs and word processors print into the notation that the reader knows.

Each line keeps its length wherever it can, so that the column of a refusal is a column of what the author wrote.

May import models (for its errors).
"""
