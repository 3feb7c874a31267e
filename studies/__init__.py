"""Measurements over many runs: the benchmark, the stress test, maps of starts, releases.

May import models, records, reference, engines and checks.
"""
