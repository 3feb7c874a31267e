"""HTML pages that open from disk, fetch nothing and run nothing: check, bench, stress and Takeno's chain.

Imports records, and of reports what all renderings share.
"""
