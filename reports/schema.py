"""The JSON Schema of a line of a result stream, from the records; ``python -m furiko.reports.schema`` writes it."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec

from ..models.result import FORMAT, Footer, Header, Result

FILE = Path(__file__).parent / "schema.json"


def schema() -> str:
    """The schema as text: a line is a header, a result or a footer, told apart by ``kind``."""
    described = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"furiko result stream, format {FORMAT}: one line of report.jsonl",
        **msgspec.json.schema(Header | Result | Footer),
    }
    return json.dumps(described, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    FILE.write_text(schema(), encoding="utf-8")
