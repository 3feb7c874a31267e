"""Proven values: ball arithmetic, closed forms, and trajectories in quadruple precision.

May import models and the rest of reference.
"""
