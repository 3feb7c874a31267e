"""Reference values: enclosures in ball arithmetic, closed forms, and trajectories in quadruple precision.

Imports models, the arithmetic and documents: nothing is shared with the fast kernels.
"""
