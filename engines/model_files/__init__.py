"""A user's own model file in each engine that reads it."""
