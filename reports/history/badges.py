"""Badges of the latest run: a picture (SVG), and JSON as the endpoint badge of shields.io takes it."""

from __future__ import annotations

import json
import re
from xml.sax.saxutils import escape

from ..words import count, one_line, outcome_of
from .runs import OfEngine, Run

# Name of a colour for shields, the colour itself: white on each of them has a contrast of 4.5 and more.
COLOURS = {"agrees": ("blue", "#0a4f9e"), "differs": ("orange", "#8f3300"), "error": ("critical", "#8a1a6b")}
NOTHING = ("inactive", "#57606a")
CHARACTER, PADDING, HEIGHT = 6.6, 10, 20  # pixels: of 11 px Verdana
SVG = "http://www.w3.org/2000/svg"
LONGEST = 60  # characters


def badges(run: Run) -> dict[str, str]:
    """The files by name: ``badge.svg`` and ``.json`` of the run, ``badge-ENGINE.svg`` and ``.json`` of each engine."""
    state = outcome_of(run.exit_status)
    files = _files("badge", "furiko", "incomplete" if state == "error" else state, COLOURS[state])
    for engine in run.engines.values():
        label = f"furiko · {engine.engine} {engine.version}".rstrip()
        name = _name(f"badge-{engine.engine}", files)
        files |= _files(name, label, _message(engine), COLOURS.get(engine.outcome or "", NOTHING))
    return files


def _message(engine: OfEngine) -> str:
    if engine.outcome == "differs":
        return f"{engine.counts['differs']:,} differ" if engine.counts["differs"] > 1 else "1 differs"
    if engine.outcome == "error":
        return f"{engine.counts['error']:,} failed"
    agreeing = engine.counts["agrees"] + engine.counts["loose"]
    return f"{count(agreeing, 'comparison')} agree{'s' if agreeing == 1 else ''}" if agreeing else "not compared"


def _name(wanted: str, taken: dict[str, str]) -> str:
    """A file's name of letters, digits, points and hyphens, that no other has."""
    plain = re.sub(r"[^A-Za-z0-9._-]+", "-", wanted)[:100]
    number, name = 1, plain
    while f"{name}.svg" in taken:
        number += 1
        name = f"{plain}-{number}"
    return name


def _files(name: str, label: str, message: str, colour: tuple[str, str]) -> dict[str, str]:
    label, message = one_line(label, LONGEST), one_line(message, LONGEST)
    endpoint = {"schemaVersion": 1, "label": label, "message": message, "color": colour[0]}
    return {
        f"{name}.svg": _svg(label, message, colour[1]),
        f"{name}.json": json.dumps(endpoint, ensure_ascii=False) + "\n",
    }


def _svg(label: str, message: str, colour: str) -> str:
    left, right = (round(CHARACTER * len(text) + PADDING) for text in (label, message))
    said = escape(f"{label}: {message}", {'"': "&quot;"})
    return f"""<svg xmlns="{SVG}" width="{left + right}" height="{HEIGHT}" role="img" aria-label="{said}">
<title>{said}</title>
<rect width="{left}" height="{HEIGHT}" fill="#444"/>
<rect x="{left}" width="{right}" height="{HEIGHT}" fill="{colour}"/>
<g fill="#fff" text-anchor="middle" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">
{_text(left / 2, left, label)}
{_text(left + right / 2, right, message)}
</g>
</svg>
"""


def _text(middle: float, width: int, text: str) -> str:
    fitted = f'textLength="{width - PADDING}" lengthAdjust="spacingAndGlyphs"'
    return f'<text x="{middle:g}" y="14" {fitted}>{escape(text)}</text>'
