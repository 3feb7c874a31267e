"""The equations of motion from first principles, step by step, and a motion by any rows."""
