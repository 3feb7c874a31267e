"""Writes the result stream, reads it back, and renders it: terminal, HTML, Markdown, JUnit; compares two runs."""

from .compare import Comparison, compare
from .report import Cell, Report
from .stream import StreamWriter, read_stream
from .write import open_report, prepare_reports, write_reports

__all__ = [
    "Cell",
    "Comparison",
    "Report",
    "StreamWriter",
    "compare",
    "open_report",
    "prepare_reports",
    "read_stream",
    "write_reports",
]
