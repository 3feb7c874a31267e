"""The page: one HTML file that opens from disk, offline, with nothing fetched and nothing to run."""

from __future__ import annotations

from .report import Report
from .words import GLYPHS, LEGEND, printable


def to_html(report: Report) -> str:
    """The whole page as text; everything from the stream is escaped, markup comes from the templates alone."""
    from jinja2 import Environment, PackageLoader

    environment = Environment(
        loader=PackageLoader("furiko.reports"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_finalize,
    )
    return environment.get_template("report.html.j2").render(report=report, glyphs=GLYPHS, legend=LEGEND)


def _finalize(value: object) -> object:
    return printable(value) if type(value) is str else value
