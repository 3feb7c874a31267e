"""Trajectories: Taylor series, textbook schemes, their tangent flow, and extrapolation.

May import models and the rest of reference.
"""
