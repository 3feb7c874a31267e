"""Pages of maps: a picture of numbers, with its axes and scale.

May import records, and of reports the pages' own drawing.
"""
