"""Reads a user's MJCF or URDF file into a mechanism; files are limited in size, and nothing in them is executed.

May import models alone.
"""
