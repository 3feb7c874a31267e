"""Trajectories: Taylor series, textbook schemes, their tangent flow, and extrapolation.

Imports models, documents and kernels.
"""
