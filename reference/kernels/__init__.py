"""Accelerations and energy in O(n), as plain numpy and as compiled code. Imports models and limits."""
