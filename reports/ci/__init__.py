"""What a CI reads of a run: JUnit, a Markdown summary, GitHub's annotations.

May import records, and of reports what all renderings share.
"""
