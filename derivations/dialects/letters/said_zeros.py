# ruff: noqa: E501 -- patterns stand on one line
r"""A sentence that says where an angle is zero: ``$\theta = 0$ is upright``, which is what ``from`` declares.

Where its words say it clearly, it declares that; else it is passed over, and said to be. A sentence that may be a
condition, ``for \theta = 0 …``, stays for the reader to refuse.
"""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..lines import DENIED
from ..statements import is_program
from .every_text import is_fit

TEXTS = ("equations", "lagrangian", "hamiltonian", "kinetic", "potential")
_NAME = (
    r"(?:\\?(?:theta|vartheta|phi|varphi|alpha|psi|beta|q)|[θϑφϕαψβxq])(?:\s*_\s*(?:\{\s*\w{1,2}\s*\}|\w)|[₀-₉]|[0-9])?"
)
_NUMBER = r"(?P<turned>(?:[-+−±]\s*|\\pm\s*)?(?:\\pi(?![A-Za-z])|π|180\s*(?:°|\^\s*\{?\s*\\circ\s*\}?)))|0(?![.\d])(?:\s*(?:°|\^\s*\{?\s*\\circ\s*\}?))?"
_SAID = rf"{_NAME}\s*(?:=\s*{_NAME}\s*)?=\s*(?:{_NUMBER})"
ZERO = re.compile(
    rf"(?<![\w\\$`=+−-])(?<!\w\()(?:\$`?\s*|\\\(\s*|``?\s*)?(?:{_SAID})\s*(?:`?\$|\\\)|``?)?(?![\w$`+*/^=−-])"
)
MEANS = re.compile(
    r"[\s*_,]*(?:(?:is|are|being|means?|denotes?|represents?|refers to|corresponds?(?: to)?|points?|pointing|ist|bedeutet|entspricht|est|représente|indica|correspond à|corrisponde a|corresponde a|es|è|é|significa|oznacza|to)\b"
    r"|表示|代表|对应|対応|意味|为|為|是|が|は|を|：|(?=(?:upright|upwards?|downwards?|hanging|down|inverted|pointing|straight)\b))"
)
POSITION = re.compile(
    r"\b(?:equilibrium|position|configuration|vertical|upright|downward|upward|Ruhelage|équilibre|równowag\w+)\b[\w\s]{0,20}(?:\b(?:is|at|being|corresponds to|ist|est|es)\b|\()[\s*_]*$",
    re.IGNORECASE,
)
CONDITION = re.compile(
    r"\b(?:if|when|whenever|for|at|near|around|about|close|small|with|für|wenn|bei|um|pour|si|para|con|per|se|quando|cuando|set|sets|setting|let|put|putting|assum\w*|suppos\w*|fix\w*|hold\w*|linear\w*|substitut\w*|start\w*|initial\w*|release\w*|special|case)\b"
    r"|初|当|時|とき|場合",
    re.IGNORECASE,
)
UP = re.compile(
    r"\b(?:upright|upwards?|inverted|balanced|(?:straight|pointing|points|standing|vertically|directly|is)\s+up(?!\s+to)|vers le haut|nach oben|aufrecht|hacia arriba|verso l.alto|para cima|do góry)\b"
    r"|向上|朝上|直立|倒立|鉛直上|真上|上向",
    re.IGNORECASE,
)
DOWN = re.compile(
    r"\b(?:downwards?|down|hanging|hangs|bottom|below|vers le bas|nach unten|hängend\w*|hacia abajo|verso il basso|para baixo|w dół)\b|向下|朝下|下垂|ぶら下|鉛直下|真下|下向",
    re.IGNORECASE,
)
MOVES = re.compile(r"\b(?:falls?|falling|drops?|swings?|starts?|released?|moves?|kick\w*)\b", re.IGNORECASE)
SENTENCE_ENDS = re.compile(r"[.。;；\n]|\$|\\\(|\\\[|`|=")
MOST_ZEROS = 8


def with_said_zeros(data: dict[str, Any]) -> dict[str, Any]:
    """The fields without such sentences' formulas; with ``from`` where one says it and none says otherwise."""
    origins: set[str] = set()
    passed: list[str] = []
    made = dict(data)
    for name in TEXTS:
        value = data.get(name)
        if isinstance(value, dict):
            made[name] = {key: _without(text, origins, passed) for key, text in value.items()}
        elif isinstance(value, list):
            made[name] = [_without(text, origins, passed) for text in value]
        elif value is not None:
            made[name] = _without(value, origins, passed)
    if not origins and not passed:
        return data
    if len(origins) > 1:
        raise InvalidInput("equations: what an angle is counted from is said in two ways; leave one out")
    if origins and data.get("from", *origins) not in origins:
        raise InvalidInput(
            f"from: {data['from']!r:.10} is declared, and a sentence says {origins.pop()!r}; leave one out"
        )
    if origins and not passed:
        return made | {"from": origins.pop()}
    return made | {"passed": [*passed, *(f"zero is {origin}" for origin in origins)]}


def _without(text: Any, origins: set[str], passed: list[str]) -> Any:
    """A text without the formulas that say where an angle is zero; what they say is added."""
    if not is_fit(text) or is_program(text):
        return text
    kept, at = "", 0
    for found in list(ZERO.finditer(text))[:MOST_ZEROS]:
        before = re.split(r"[.。;；\n]", text[max(0, found.start() - 160) : found.start()])[-1]
        behind = text[found.end() : found.end() + 160]
        behind = behind[: end.start()] if (end := SENTENCE_ENDS.search(behind)) else behind
        means, position = MEANS.match(behind), POSITION.search(before)
        if (not means and not position) or CONDITION.search(re.sub(r"\bat[\s(]*$", "", before) if position else before):
            continue
        origin = _origin(behind if means else before)
        if origin is None:
            passed.append(found[0].strip(" $`\\()"))
        else:
            origins.add({"up": "down", "down": "up"}[origin] if found["turned"] else origin)
        kept += text[at : found.start()] + " "
        at = found.end()
    return kept + text[at:]


def _origin(words: str) -> str | None:
    """Which vertical the words of a sentence say; None where that is not plain."""
    up, down = UP.search(words), DOWN.search(words)
    if (up is None) == (down is None) or MOVES.search(words) or DENIED.search(words):
        return None
    return "up" if up else "down"
