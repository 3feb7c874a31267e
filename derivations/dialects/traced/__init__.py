"""Programs in Python and MATLAB, followed statement by statement as formulas: in-place changes, arrays, helpers.

Nothing is run: Python's own parser makes the tree of a Python text, a parser of this folder that of a MATLAB text.

May import models (for its errors), and letters, names and table of dialects.
"""
