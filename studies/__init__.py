"""Measurements over many runs: the benchmark and the stress test.

May import models, records, reference, engines and checks.
"""
