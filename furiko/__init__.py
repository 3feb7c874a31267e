"""furiko: cross-checks hand-derived equations of motion and physics engines."""

__version__ = "0.1.0"
