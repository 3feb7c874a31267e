"""Maps of many starts: when each flips, how much it stretches, how chaotic it is.

May import models, records and reference.
"""
