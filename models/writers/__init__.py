"""Writes a mechanism as MJCF or URDF."""
