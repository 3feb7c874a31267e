"""Typed rows that every command writes and reports read. Imports nothing of furiko."""
