"""The JSON Schema of a line of a result stream, from the records; ``python -m furiko.records.schema`` writes it."""

from __future__ import annotations

import json
from inspect import cleandoc
from pathlib import Path
from typing import Any

import msgspec

from .check import FORMAT, Footer, Header, Result

FILE = Path(__file__).parent / "schemas" / "check.json"


def schema() -> str:
    """The schema as text: a line is a header, a result or a footer, told apart by ``kind``."""
    described = _one_wording(
        {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": f"furiko result stream, format {FORMAT}: one line of report.jsonl",
            **msgspec.json.schema(Header | Result | Footer),
        }
    )
    return json.dumps(described, indent=2, ensure_ascii=False) + "\n"


def _one_wording(value: Any) -> Any:
    """Descriptions as Python 3.13 has docstrings, without the source's indentation, in every Python."""
    if isinstance(value, dict):
        return {
            key: cleandoc(v) if key == "description" and isinstance(v, str) else _one_wording(v)
            for key, v in value.items()
        }
    return [_one_wording(v) for v in value] if isinstance(value, list) else value


if __name__ == "__main__":
    FILE.write_text(schema(), encoding="utf-8")
