r"""Fractions drawn over lines, as plain e-mails and comments have them, as ((a)/(b)) in the line of their bar.

What stands above and below the bar is a line, or is drawn so itself; brackets may be drawn as tall as a fraction. What
stands anywhere else above or below the line, as a power does that computer algebra prints high, is none of these, and
the text stays as it is.
"""

from __future__ import annotations

import re

DASHES = "-−–─—"
LONG = re.compile(rf"[{DASHES}]{{3,}}")
MOST_LINES, DEEPEST = 12, 4


def from_fractions(text: str) -> str:
    """The text with each drawn equation in one line; any other text as it is."""
    if "\\" in text or not LONG.search(text):
        return text
    made: list[str] = []
    block: list[str] = []
    for line in [*text.expandtabs(8).split("\n"), ""]:
        if line.strip():
            block.append(line)
            continue
        made += [_equation(block) or "\n".join(block)] if block else []
        made.append(line)
        block = []
    return "\n".join(made[:-1])


def _equation(block: list[str]) -> str | None:
    """An equation of several lines in one; None where it is not drawn so."""
    bases = [k for k, line in enumerate(block) if "=" in line]
    if len(bases) != 1 or not 3 <= len(block) <= MOST_LINES or not LONG.search(block[bases[0]]):
        return None
    width = max(map(len, block))
    return _rendered([line.ljust(width) for line in block], bases[0], DEEPEST)


def _rendered(rows: list[str], base: int, depth: int) -> str | None:
    """The line ``base`` with its fractions; None where anything else stands above or below it."""
    line, others = rows[base], rows[:base] + rows[base + 1 :]
    made, used, at = "", set[int](), 0
    while at < len(line):
        end = at
        while end < len(line) and line[end] in DASHES:
            end += 1
        top, bottom = ([row[at:end] for row in part] for part in (rows[:base], rows[base + 1 :]))
        if (
            end > at
            and _is_fraction(line, others, at, end)
            and any(map(str.strip, top))
            and any(map(str.strip, bottom))
        ):
            parts = [_whole(part, depth - 1) for part in (top, bottom)]
            if None in parts:
                return None
            made += f"(({parts[0]})/({parts[1]}))"
            used |= set(range(at, end))
        elif line[at] == "|" and len(tall := {row[at] for row in others} - {" "}) == 1 and tall <= {"(", ")", "[", "]"}:
            made += tall.pop()
            used.add(at)
            end = at + 1
        else:
            end = max(end, at + 1)
            made += line[at:end]
        at = end
    alone = all(row[k] == " " for row in others for k in range(len(row)) if k not in used)
    return made if used and alone and not LONG.search(made) else None


def _is_fraction(line: str, others: list[str], at: int, end: int) -> bool:
    """Whether a run of dashes is a bar: long, or a single one with figures at once above and below it."""
    sides = [k for k in (at - 1, end) if 0 <= k < len(line) and line[k] != "|"]
    apart = all(row[k] == " " for row in others for k in sides)
    return apart and (end - at > 2 or (end - at == 1 and all(row[at].isdigit() for row in others if row.strip())))


def _whole(rows: list[str], depth: int) -> str | None:
    """What stands above or below a bar."""
    rows = [row for row in rows if row.strip()]
    if len(rows) == 1:
        return rows[0].strip()
    found = [made for k in range(len(rows)) if depth and (made := _rendered(rows, k, depth))]
    return found[0].strip() if len(found) == 1 else None
