"""Proven values: ball arithmetic, closed forms, and trajectories in quadruple precision."""
