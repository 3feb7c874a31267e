"""Trajectories: Taylor series, textbook schemes, their tangent flow, and extrapolation."""
