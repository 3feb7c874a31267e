"""Tables of check, bench and stress in the terminal.

Imports records, and of reports what all renderings share.
"""
