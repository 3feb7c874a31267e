"""Accelerations in O(n), as plain numpy and as compiled code.

May import models and the rest of reference.
"""
