"""HTML pages that open from disk: nothing fetched, nothing run.

May import models, records, reference, studies and the rest of reports.
"""
