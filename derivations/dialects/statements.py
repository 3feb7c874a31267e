"""A program's text as statements: what is assigned to what, and what is returned. Nothing is run.

Python, MATLAB, JavaScript, C and Rust differ in keywords, comments and line ends; an expression in each is one that the
reader knows.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from ...models.errors import InvalidInput

STARTS = re.compile(
    r"\s*(?:(?:#|//|%)[^\n]{0,200}\n\s*){0,8}(?:def\s|class\s|function\b|import\s|from\s+\w+\s+import|(?:pub\s+)?fn\s"
    r"|(?:static\s+|inline\s+){0,2}(?:int|void)\s+\w+\s*\("
    r"|(?:(?:const|let|var)\s+)?\w{1,24}\s*=\s*(?:lambda\b|@\s*\(|\([\w\s,\[\]]{0,80}\)\s*=>))"
)
MOST_STATEMENTS = 200
LONGEST_PROGRAM = 20_000  # characters
STRINGS = re.compile(r'"""(?:[^"]|"(?!"")){0,2000}"""|\'\'\'(?:[^\']|\'(?!\'\')){0,2000}\'\'\'')
BLOCK_COMMENT = re.compile(r"/\*(?:[^*]|\*(?!/)){0,2000}\*/")
GOES_ON = re.compile(r"\.\.\.[^\n]{0,200}\n|(?<!\\)\\\n")
DOWNWARDS = re.compile(r"(?<![\w])(?:g|G|gravity)\s*[:=]\s*-\s*[0-9]")
PLAIN_VALUE = re.compile(r"[\s\w.,()\[\]+-]*")
NESTED = re.compile(r"(?<![\w.])(?:if|elif|else|for|while|switch|try|with|match|loop)\b")
HEAD = re.compile(
    r"(?:(?:export|async|pub|static|private|public)\s+){0,3}(?:inline\s+)?(?:def|fn|function|(?:int|void)(?=\s+\w+\s*\())\b\s*"
    r"(?:(?:\[[^\]]{0,80}\]|(?P<out>\w{1,24}))\s*=\s*)?(?P<name>\w{0,40})!?\s*\((?P<arguments>.{0,400}?)\)"
    r"\s*(?:->\s*[^{:]{1,60})?\s*[:{]?\s*(?P<rest>.*)$",
    re.DOTALL,
)
ANONYMOUS = re.compile(
    r"(?:(?:const|let|var)\s+)?\w{1,24}\s*=\s*(?:lambda\s+(?P<python>[^:]{0,200}):|@\s*\((?P<matlab>[^()]{0,200})\)"
    r"|\((?P<js>[\w\s,\[\]]{0,80})\)\s*=>)\s*(?P<body>.+)$",
    re.DOTALL,
)
KEYWORDS = re.compile(r"^(?:(?:const|let|var|mut|auto|double|float|f64|real)\s+){1,3}")
ASSIGNED = re.compile(r"^(?P<target>[^=<>!+*/^]{1,120}?)(?::\s*\w{1,12}\s*)?=(?![=>])\s*(?P<value>.+)$", re.DOTALL)
LAST = re.compile(r"\[[^=]+\]$", re.DOTALL)


@dataclass(frozen=True)
class Function:
    """Its parameters, its assignments in order, as (target, expression), and what it returns."""

    parameters: tuple[str, ...]
    assigned: tuple[tuple[str, str], ...]
    returned: str


def is_program(text: str) -> bool:
    """Whether a text begins as a function, or a class with one, does."""
    return STARTS.match(text) is not None


def function_of(text: str) -> Function:  # noqa: PLR0912, PLR0915 -- one for each way to say what is returned
    """The one function of a text that returns something. Raises InvalidInput where that is not plain."""
    if len(text) > LONGEST_PROGRAM:
        raise InvalidInput(f"this program is longer than {LONGEST_PROGRAM} characters; give the function alone")
    if DOWNWARDS.search(text):
        raise InvalidInput("g is a negative number here; give it without its sign, and the sign in the rows")
    lines = _lines(text)
    if len(lines) > MOST_STATEMENTS:
        raise InvalidInput(f"this program has more than {MOST_STATEMENTS} lines; give the function alone")
    functions: list[Function] = []
    parameters: tuple[str, ...] = ()
    assigned: list[tuple[str, str]] = []
    out, is_open = "", False
    outside: list[
        tuple[str, str]
    ] = []  # what a module or __init__ says of a quantity, as in self.I = self.m*self.l**2/3
    for statement in lines:
        line = statement
        found = ANONYMOUS.match(line)
        if found:
            names = _parameters(found["python"] or found["matlab"] or found["js"] or "")
            functions.append(Function(names, (), found["body"].strip()))
            continue
        head = HEAD.match(line)
        if head:
            if out and is_open:
                functions.append(Function(parameters, tuple(assigned), out))
            parameters, assigned, out = _parameters(head["arguments"]), [], head["out"] or ""
            is_open = head["name"] != "__init__"
            line = head["rest"].strip()
        if not is_open and not functions:
            outside += _said_outside(line)
        if not is_open or not line or line in ("}", "});") or (line == "end" and not _filled(assigned, parameters)):
            continue
        returned = re.match(r"return\b\s*(.*)$", line, re.DOTALL)
        filled = _filled(assigned, parameters)
        if filled and (returned or line == "end") and not (returned and re.search(r"[,\[(]", returned[1])):
            functions.append(Function(parameters, tuple(assigned), filled))
            is_open, out = False, ""
            continue
        if returned:
            functions.append(Function(parameters, tuple(assigned), returned[1].strip()))
            is_open, out = False, ""
            continue
        if LAST.match(line) and not out:  # Julia's function gives back its last expression
            functions.append(Function(parameters, tuple(assigned), line))
            is_open = False
            continue
        assigned += _assignments(line)
    out = out or _filled(assigned, parameters)
    if out and is_open:
        functions.append(Function(parameters, tuple(assigned), out))
    if len(functions) != 1:
        raise InvalidInput(
            f"{len(functions)} functions that return something; give the text of the one with the equations of motion"
        )
    only = functions[0]
    used = " ".join([*(value for _, value in only.assigned), only.returned])
    kept = [
        (t, v)
        for t, v in outside
        if re.fullmatch(r"(?:self\.)?\w+", t) and re.search(rf"(?<![\w.]){re.escape(t)}\b", used)
    ]
    return Function(only.parameters, (*kept, *only.assigned), only.returned)


def _said_outside(line: str) -> list[tuple[str, str]]:
    """An assignment that is more than a name or a number."""
    said = ASSIGNED.match(KEYWORDS.sub("", line))
    if said is None or PLAIN_VALUE.fullmatch(said["value"].replace("self.", "")):
        return []
    return [(said["target"].strip(), said["value"].strip())]


def _filled(assigned: list[tuple[str, str]], parameters: tuple[str, ...]) -> str:
    """The parameter whose entries are assigned, du[1] = …; an empty text where there is none."""
    if len([name for name in parameters if name not in ("t", "time")]) < 2:
        return ""  # it is the state itself
    found = [m[1] for target, _ in assigned if (m := re.match(r"(\w+)\s*\[\s*\d\s*\]$", target))]
    return next((name for name in found if name in parameters), "")


def _assignments(line: str) -> list[tuple[str, str]]:
    if NESTED.match(line):
        raise InvalidInput(
            f"{line[:40]!r}: assignments and one return are followed; write out what a loop or a condition comes to"
        )
    bare = KEYWORDS.sub("", line)
    several = split(bare, ",") if bare != line else [bare]  # const c = …, s = …
    pairs = [ASSIGNED.match(part) for part in several]
    if len(pairs) == 1 or None in pairs:
        pairs = [ASSIGNED.match(bare)]
    if None in pairs:
        raise InvalidInput(f"{line[:40]!r}: assignments and one return are followed, and nothing else")
    return [(found["target"].strip(), found["value"].strip()) for found in pairs if found]


def _parameters(text: str) -> tuple[str, ...]:
    """Names without types and values; what is taken apart at once, [a, b], as it stands."""
    bare = [
        re.sub(r"^&?mut\s+|(?<!:)[:=](?!:).*$", "", part.strip(), flags=re.DOTALL).strip() for part in split(text, ",")
    ]
    bare = [
        re.sub(r"^.*[\s&*](\w+)(?:\s*\[\d?\])?$", r"\1", part, flags=re.DOTALL) if part[:1] != "[" else part
        for part in bare
    ]  # double y[4], const state_type &x
    named = tuple(name for name in bare if name and name not in ("self", "this", "*", "/"))
    twice = next((name for name in named if name not in ("~", "_") and named.count(name) > 1), None)
    if twice is not None:
        raise InvalidInput(f"{twice} is the name of two parameters; give each its own")
    return named


def _lines(text: str) -> list[str]:
    """Statements, each on a line of its own, without comments."""
    braces = re.search(r"\)\s*(?:->[^{]{1,60})?\{|=>\s*\{", text) is not None
    python = not braces and re.search(r"^\s*(?:def|class|import|from)\s|\blambda\b", text, re.MULTILINE) is not None
    remark = "//" if braces else "#" if python else "%"  # // is a division in Python, and % in C
    text = BLOCK_COMMENT.sub(" ", STRINGS.sub(" ", text))
    text = "\n".join(line.partition(remark)[0] for line in GOES_ON.sub(" ", text).split("\n"))
    other = re.search(r"//|%" if python else r"%" if braces else r"//", text)
    if other:
        raise InvalidInput(f"{other[0]} is no remark here, and no operation of mechanics; leave it out")
    found: list[str] = []
    depth, start = 0, 0
    for at, c in enumerate(text):
        if c in "([":
            depth += 1
        elif c in ")]":
            depth -= 1
        # C and its kin end a statement by a semicolon, or a brace; others at the end of a line
        ends = c in ";{}" if braces else c in ";\n"
        if ends and depth <= 0:
            found.append(text[start:at])
            start, depth = at + 1, 0
    found.append(text[start:])
    if not braces:
        found = [_without_keyword_line(line) for line in found]
    return [line.strip() for line in found if line.strip()]


def _without_keyword_line(line: str) -> str:
    is_none = re.match(r"""\s*(?:(?:import|from|class|pass|global)\b|@\w+\s*$|"[^"]*"\s*$|'[^']*'\s*$)""", line)
    return "" if is_none else line


def split(text: str, at: str) -> list[str]:
    """The parts of a text between these characters, outside all brackets."""
    parts, depth, start = [], 0, 0
    for place, c in enumerate(text):
        if c in "([{":
            depth += 1
        elif c in ")]}":
            depth -= 1
        elif c in at and depth == 0:
            parts.append(text[start:place])
            start = place + 1
    return [part.strip() for part in [*parts, text[start:]] if part.strip()]
