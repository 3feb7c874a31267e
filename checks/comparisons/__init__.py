"""One comparison of one quantity a file.

May import models, records, reference, engines, diagnosis and the rest of checks.
"""
