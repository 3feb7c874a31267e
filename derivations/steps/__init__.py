"""The equations of motion derived step by step from first principles, and the motion that any rows give.

May import algebra.
"""
