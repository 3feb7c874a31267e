"""The benchmark: time against error of engines, their integrators and furiko; what a check skips.

May import: models, records, reference, engines, diagnosis, checks.
"""
