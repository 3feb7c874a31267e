"""Reads URDF: links, joints of every type, inertials, MuJoCo's extension, and what engines weigh besides.

May import models and their MJCF reader.
"""
