"""R, as deSolve and phaseR have it: function(t, state, parms) { with(as.list(c(state, parms)), {…; list(c(…)) }) }."""

from __future__ import annotations

import re
from dataclasses import replace

from ..markup.calls import closing, parts_of
from .braces import from_braces
from .by_words import no_leading_signs
from .program import Program

R = re.compile(r"(?:<-|=)\s*function\s*\(|^\s*function\s*\(", re.MULTILINE)
ARROW = re.compile(r"<-|\blist\s*\(|\bc\s*\(")
WITH = re.compile(r"\b(?:with|within)\s*\((?P<of>[^{}]*?),\s*(?=\{)")
ENTRY = re.compile(r"(?P<x>\w+)\s*(?:\[\[?\s*[\"'](?P<a>[\w.]+)[\"']\s*\]\]?|\$(?P<b>[\w.]+))")
MOST = 100


def from_r(text: str) -> Program | None:
    """A program of R; None for any other."""
    if not R.search(text) or not ARROW.search(text) or re.search(r"\b(?:const|let|var|local|end)\b|=>|//", text):
        return None
    text = re.sub(r"#[^\n]*", "", text)
    text = ENTRY.sub(lambda m: m["a"] or m["b"], text)
    text = re.sub(r"(\w+)\[\[\s*(\d)\s*\]\]", r"\1[\2]", text)
    text = re.sub(r"\bas\.(?:list|numeric|vector)\s*\(", "aslist(", text)
    for _ in range(6):
        text = re.sub(r"(?<![\w.])([A-Za-z]\w*)\.(?=[A-Za-z])", r"\1_", text)
    text = re.sub(r"<<?-", " = ", text).replace("%*%", "*")
    text = WITH.sub("", text)
    text = _calls(text, "return", lambda parts: "return " + ", ".join(parts))
    text = _calls(text, "invisible", lambda parts: parts[0])
    text = _calls(text, "matrix", _matrix)
    text = _calls(text, "aslist", lambda parts: parts[0])
    text = _calls(text, "(?:numeric|rep|vector|double)", lambda parts: "new Array(4)")
    text = _calls(text, "(?:cbind|rbind)", lambda parts: "columns(" + ", ".join(parts) + ")")
    text = _calls(text, "c", lambda parts: "[" + ", ".join(_unnamed(part) for part in parts) + "]")
    text = _calls(text, "list", lambda parts: _unnamed(parts[0]) if parts else "[]")
    text = re.sub(r"\[\s*\[(.*)\]\s*\](?=\s*(?:\n|\}|$))", r"[\1]", text)
    no_leading_signs(text)
    return replace(from_braces(text, by_lines=True), first=1, whole=False, powers=("^", "**"))


def _unnamed(part: str) -> str:
    """dtheta = w of c(dtheta = w) as w."""
    return re.sub(r"^\s*[\w.]+\s*=(?!=)\s*", "", part)


def _matrix(parts: list[str]) -> str:
    """matrix(c(…), nrow = 2), column by column unless it says byrow."""
    inner = re.sub(r"^\s*(?:data\s*=\s*)?c\s*\(|\)\s*$", "", parts[0])
    entries = parts_of(inner, ",")
    size = {4: 2, 9: 3, 16: 4}.get(len(entries))
    if size is None:
        return "[" + ", ".join(entries) + "]"
    rows = [entries[k : k + size] for k in range(0, len(entries), size)]
    if not any(re.search(r"byrow\s*=\s*T", part) for part in parts[1:]):
        rows = [list(column) for column in zip(*rows, strict=True)]
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in rows) + "]"


def _calls(text: str, word: str, made) -> str:  # type: ignore[no-untyped-def]
    pattern = re.compile(rf"(?<![\w.]){word}\s*\(")
    at = 0
    for _ in range(MOST):
        found = pattern.search(text, at)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        parts = [part for part in parts_of(text[found.end() : end], ",") if part]
        text = text[: found.start()] + made(parts or [""]) + text[end + 1 :]
        at = found.start() + (len(word) if word == "return" else 0)
    return text
