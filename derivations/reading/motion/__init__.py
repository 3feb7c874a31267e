"""What rows say of the motion as a whole: steps that repeat a row, forces of joints, supports that move, conventions.

May import models (for its errors), algebra and steps.
"""
