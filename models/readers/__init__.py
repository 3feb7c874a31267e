"""Reads a user's MJCF or URDF file into a mechanism; files from outside are bounded and never run."""
