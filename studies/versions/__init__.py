"""Releases of one engine side by side: what each computes and reads, and which release changed what.

May import models, records, reference, engines, diagnosis and checks.
"""
