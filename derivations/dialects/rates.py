r"""Rates that programs and textbooks name: a1_v and a1_a, L_ddot, and \dot\theta = \omega as a row of its own."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from .names import plain_name

FIRST = ("dot", "_dot", "_d", "_vel", "vel", "_v", "_prime")
SECOND = ("ddot", "_ddot", "dotdot", "_dot_dot", "_dd", "_acc", "acc", "_a", "_double_prime")
LONE = ("_v", "_a")  # read only where both are there
BEFORE = ("d", "dd", "d2")
NAME = r"\\?[A-Za-zα-ωΑ-Ω]+(?:\s*_\s*(?:\{\s*\w{1,4}\s*\}|\w))?[0-9₀-₉]{0,2}"
D = r"(?:\\mathrm\s*\{?\s*d\s*\}?|\\rm d|d)"
SPACE = r"(?:\s|\\[,;!]|&)*"
ROW = re.compile(
    rf"^{SPACE}(?:\\dot\s*\{{?\s*(?P<a>\\?[A-Za-z]+)\s*(?P<ai>_\s*(?:\{{\s*\w+\s*\}}|\w))?\s*\}}?\s*(?P<aj>_\s*(?:\{{\s*\w+\s*\}}|\w))?"
    rf"|(?P<b>{NAME})\s*'|d\s*(?P<c>{NAME})\s*/\s*d\s*t|(?P<d>{NAME})_?dot"
    rf"|\\[dt]?frac\s*\{{\s*{D}\s*(?P<f>{NAME})\s*(?:\(\s*t\s*\))?\s*\}}\s*\{{\s*{D}\s*t\s*\}}"
    rf"|\\[dt]?frac\s*\{{\s*{D}\s*\}}\s*\{{\s*{D}\s*t\s*\}}{SPACE}(?P<g>{NAME})"
    rf"|(?P<e>[A-Za-zα-ω]_?[0-9]?)\u0307(?P<ei>_?[0-9]?))"
    rf"{SPACE}={SPACE}(?P<rate>{NAME}){SPACE}(?:\\\\)?{SPACE}[,;.]?{SPACE}$"
)


def suffixed(line: str, coordinates: Sequence[str], taken: Iterable[str]) -> str:
    """The line with primes for what programs append to a declared coordinate's name."""
    in_use = {plain_name(name) or name for name in taken} | set(taken)
    for coordinate in coordinates:
        if not coordinate:
            continue
        both = all(re.search(rf"(?<![A-Za-z0-9_\\]){coordinate}{end}(?![A-Za-z0-9_])", line) for end in LONE)
        for primes, endings in (("'", FIRST), ("''", SECOND)):
            for end in endings:
                if end in LONE and not (both or line.lstrip().startswith(coordinate + "_a") or "_v" in line):
                    continue
                word = coordinate + end
                if word not in line or word in in_use or (plain_name(word) or word) in in_use:
                    continue
                line = re.sub(rf"(?<![A-Za-z0-9_\\]){re.escape(word)}(?![A-Za-z0-9_(])",
                              lambda found: (coordinate + primes).ljust(len(found[0])), line)  # noqa: B023 # fmt: skip
    return line


OTHERWISE = re.compile(
    r"['′″\u0307\u0308]|dot|Derivative|diff|\\[dt]?frac\s*\{\s*\\?(?:mathrm\s*\{\s*)?d|/\s*d|\bd\s*/"
)


def prefixed(lines: Sequence[str], coordinates: Sequence[str], taken: Iterable[str]) -> Callable[[str], str]:
    """What puts primes for dx and ddx where a file writes the rates of all its coordinates so, and none otherwise."""
    in_use = {plain_name(name) or name for name in taken} | set(taken)
    text = "\n".join(lines)
    words = {f"{front}{c}": f"({c}{primes})" for c in coordinates for front, primes in (("d", "'"), ("dd", "''"))}
    there = [re.search(rf"(?<![A-Za-z0-9_\\])dd?{re.escape(c)}(?![A-Za-z0-9_])", text) for c in coordinates]
    if not coordinates or not all(coordinates) or not all(there) or in_use & {"d", *words} or "t" in coordinates:
        return lambda line: line
    if OTHERWISE.search(text):
        return lambda line: line
    longest = sorted(map(re.escape, words), key=len, reverse=True)
    word = re.compile(rf"(?<![A-Za-z0-9_\\])(?:{'|'.join(longest)})(?![A-Za-z0-9_(])")
    return lambda line: word.sub(lambda found: words[found[0]], line)


def named_rates(data: dict[str, Any], coordinates: Sequence[str], taken: frozenset[str]) -> dict[str, Any]:
    r"""Rows \dot\theta = \omega of a declared mechanism become what \omega is: a name for the rate."""
    equations, define = data.get("equations"), data.get("define", {})
    if not coordinates or not isinstance(equations, dict | list) or not isinstance(define, dict):
        return data
    entries = list(equations.items()) if isinstance(equations, dict) else list(enumerate(equations, 1))
    rates: dict[str, str] = {}
    kept: list[tuple[Any, Any]] = []
    for label, line in entries:
        found = ROW.match(line) if isinstance(line, str) and len(line) < 200 else None
        own = plain_name(_coordinate(found)) if found else None
        rate = plain_name(found["rate"]) if found else None
        new = own in coordinates and rate is not None and rate not in {*coordinates, *taken}
        if new and rate not in {plain_name(str(name)) for name in (*define, *rates)}:
            assert found is not None
            rates[found["rate"]] = f"{_coordinate(found)}'"
        else:
            kept.append((label, line))
    if not rates or not kept:
        return data
    kept = [(label, _bracketed(line, rates) if isinstance(line, str) else line) for label, line in kept]
    kept = [(label, _second(line, rates)) for label, line in kept]
    rows: Any = dict(kept) if isinstance(equations, dict) else [line for _, line in kept]
    return data | {"equations": rows, "define": {**rates, **define}}


def _second(line: Any, rates: dict[str, str]) -> Any:
    r"""\frac{d\omega}{dt} of a rate with a name as the acceleration that it is."""
    for name, rate in rates.items():
        spelled = re.escape(name.strip())
        over = rf"\\[dt]?frac\s*\{{\s*{D}\s*{spelled}\s*(?:\(\s*t\s*\))?\s*\}}\s*\{{\s*{D}\s*t\s*\}}"
        beside = rf"(?<![A-Za-z\\])d\s*{spelled}\s*/\s*d\s*t(?![A-Za-z0-9_])"
        line = re.sub(rf"{over}|{beside}", lambda _, r=rate: f" {r}' ", line) if isinstance(line, str) else line  # type: ignore[misc]
    return line


def _bracketed(line: str, rates: Iterable[str]) -> str:
    r"""\frac{d}{dt} \omega_1 with brackets around a name for a rate, which is all that the derivative acts on there."""
    for rate in map(re.escape, rates):
        over, below = rf"\\[dt]?frac\s*\{{\s*{D}\s*", rf"\s*\{{\s*{D}\s*t\s*\}}"
        line = re.sub(rf"(?P<d>{over}\}}{below}){SPACE}(?P<x>{rate})(?=\s*=)", r"\g<d>(\g<x>)", line)
    return line


def _coordinate(found: re.Match[str]) -> str:
    if found["a"]:
        return found["a"] + (found["ai"] or found["aj"] or "")
    if found["e"]:
        return found["e"] + (found["ei"] or "")
    return str(found["b"] or found["c"] or found["d"] or found["f"] or found["g"])
