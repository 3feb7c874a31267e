"""Accelerations in O(n), as plain numpy and as compiled code."""
