"""Tables in the terminal.

May import models, records, reference, studies and the rest of reports.
"""
