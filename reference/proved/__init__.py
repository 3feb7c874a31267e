"""Proved trajectories: intervals that contain the exact motion, by Taylor series in ball arithmetic.

May import models, the arithmetic, limits and truth; nothing is shared with the fast kernels. Inside: numbers, form →
series → steps, wide → enclose → kept; trees → form, joints: open mechanisms in a plane and their coordinates.
"""
