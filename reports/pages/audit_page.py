"""The page of an audit: sections with paragraphs and tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .rendering import render


def to_audit_page(prose: Mapping[str, Any]) -> str:
    """One HTML page. ``prose``: ``title``, ``language`` and ``sections``, each with ``title``, ``paragraphs`` and
    ``tables`` (``caption``, ``columns``, ``rows``)."""
    return render("audit.html.j2", prose=prose)
