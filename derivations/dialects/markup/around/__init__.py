r"""What stands around formulas: marks of comments, elements of JSX, tags and directives of sites, drawn matrices.

What is taken away says nothing of mechanics; what it holds stands as a display, $$…$$.
May import models (for its errors).
"""
