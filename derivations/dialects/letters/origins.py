r"""Sentences that say where an angle is counted from: $\theta = 0$ is upright."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from ....models.errors import InvalidInput
from ..names import plain_name
from .every_text import is_fit, rows_of

SAID = re.compile(
    r"(?P<open>\$\$?|\\\(|`|(?<=[\s(%#*])|^)\s*(?P<x>\\?[^\W\d_]{1,9}(?:\s*_\s*(?:\{\w{1,4}\}|\w)|[₀-₉]|[0-9])?)\s*=\s*(?P<value>0|\\pi|π|pi|180\s*°)\s*(?P<close>\$\$?|\\\)|`|(?=[\s:,]))"
    r"(?P<words>[^.。$=\n`\\]{2,90})",
    re.MULTILINE,
)
VERB = re.compile(
    r"^\s*\(?(?:is|means|being|denotes?|corresponds|when|points?|represents|ist|bedeutet|entspricht|est|représente|correspond|es|è|é|indica|corresponde|:|,?\s*表示|为|是|は|が|对应|のとき)",
    re.IGNORECASE,
)
ABOVE = re.compile(
    r"\b(?:up|upright|upwards?|inverted|oben|aufrecht|haut|arriba|alto|cima|su)\b|向上|直立|倒立|鉛直上|真上|上向",
    re.IGNORECASE,
)
BELOW = re.compile(
    r"\b(?:hang\w*|down|downwards?|bottom|unten|hängt|hängend\w*|bas|abajo|basso|baixo)\b|向下|下垂|鉛直下|真下|下向|ぶら下",
    re.IGNORECASE,
)
CASE = re.compile(  # of which the equations beside it may be meant
    r"\b(?:for|when|if|near|around|about|close|small|linear\w*|set|setting|let|with|at|für|wenn|bei|um|pour|si|para|con|per|se|quando|cuando)\W*$|(?:当|令|设|若|のとき|とする)\W*$",
    re.IGNORECASE,
)


def with_origin(data: dict[str, Any], coordinates: Collection[str]) -> dict[str, Any]:
    """The fields without such sentences, and with what they say. Raises InvalidInput where they contradict the fields.

    ``coordinates``: their plain names.
    """
    rows = rows_of(data)
    if not rows or not all(is_fit(text) for _, text in rows):
        return data
    said: set[str] = set()
    texts = {label: _without(text, coordinates, said) for label, text in rows}
    if len(said) > 1:
        raise InvalidInput("equations: what a coordinate is counted from is said in two ways; leave one out")
    if not said:
        return data
    origin = said.pop()
    if data.get("from", origin) != origin:
        raise InvalidInput(f"from: {data['from']!r:.10} is declared, and a sentence says {origin!r}; leave one out")
    return data | {"equations": texts, "from": origin}


def _without(text: str, coordinates: Collection[str], said: set[str]) -> str:
    def one(found: re.Match[str]) -> str:
        origin = _origin(found, text, coordinates)
        if origin is None:
            return found[0]
        said.add(origin)
        return found["words"].replace(":", " ", 1)

    return SAID.sub(one, text)


def _origin(found: re.Match[str], text: str, coordinates: Collection[str]) -> str | None:
    """Where the angle is counted from by this sentence; None where it may say something else."""
    words = found["words"].replace("*", "")
    above, below = ABOVE.search(words), BELOW.search(words)
    if plain_name(found["x"]) not in coordinates or not VERB.match(words) or bool(above) == bool(below):
        return None
    if bool(found["open"].strip()) != bool(found["close"].strip()):
        return None
    before = re.split(r"[.。\n]", text[max(0, found.start() - 80) : found.start()])[-1]
    if CASE.search(before):
        return None
    return "up" if (above is not None) == (found["value"] == "0") else "down"
