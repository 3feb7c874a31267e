"""How many numbers compiled code takes at a time."""

EIGHT = 8  # numbers in a vector, trajectories in its lanes
