"""Writes the result stream, reads it back, renders it (terminal, HTML, Markdown, JUnit) and compares two runs.

Imports records, and of models the errors and the readers and writers of whole files; nothing else of furiko.
"""

from .compare import Comparison, compare
from .known import Known, known_in, read_known
from .report import Report, TableCell, footer_of
from .stream import StreamWriter, read_stream
from .write import open_report, prepare_reports, write_reports

__all__ = [
    "Comparison",
    "Known",
    "Report",
    "StreamWriter",
    "TableCell",
    "compare",
    "footer_of",
    "known_in",
    "open_report",
    "prepare_reports",
    "read_known",
    "read_stream",
    "write_reports",
]
