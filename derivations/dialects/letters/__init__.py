"""Letters and names as authors set them: indices with fonts, in Greek, by rule (c_{ij}), units, and left sides.

May import models (for its errors), and lines, names and table of dialects.
"""
