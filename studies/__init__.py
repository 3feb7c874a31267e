"""Measurements over many runs: the benchmark and the stress test."""
