"""Reads a derivation, decides whether it is right, and names the mistakes and the terms where it is wrong.

May import models (for its errors), algebra, steps, reading and mistakes.
"""
