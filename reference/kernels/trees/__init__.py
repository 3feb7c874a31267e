"""Accelerations of any open mechanism in space, in O(n). May import kernels and models."""
