"""Reads MJCF, MuJoCo's model format: bodies, joints, inertials, geoms, defaults, frames, options and includes.

May import models alone.
"""
