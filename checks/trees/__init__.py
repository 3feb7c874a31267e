"""The comparisons of open mechanisms: scenes of ``kind = "tree"``, in the coordinates of the spatial mechanism.

May import checks, and what checks may.
"""
