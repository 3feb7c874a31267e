"""The equations of motion from first principles, step by step, and a motion by any rows.

May import models, reference and the rest of derivations.
"""
