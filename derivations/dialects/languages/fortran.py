"""Fortran, free and fixed form: subroutines and functions, declarations, continued lines, arrays counted from 1."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

from ..markup.calls import parts_of
from .braces import from_braces
from .program import Program

HEAD = re.compile(
    r"^\s*(?:(?:pure|recursive|elemental|impure|real|double\s+precision|integer)(?:\s*\([^()]*(?:\([^()]*\))?[^()]*\)|\s*\*\s*\d+)?\s+)*(?P<of>subroutine|function)\s+(?P<name>\w+)\s*(?:\((?P<arguments>[^()]*)\))?\s*(?:result\s*\(\s*(?P<result>\w+)\s*\)|bind\s*\([^()]*\)|\s)*$",
    re.IGNORECASE,
)
FORTRAN = re.compile(r"(?im)^\s*(?:\w[\w()=*, ]*\s)?(?:subroutine\s+\w+|function\s+\w+\s*\()")
MARKS = re.compile(
    r"(?i)\bimplicit\s+none\b|::|\bdimension\b|\bend\s*(?:subroutine|function)\b|\bdouble\s+precision\b|\breal\s*(?:\*|\()|\bsubroutine\b"
)
DECLARED = re.compile(
    r"^\s*(?:implicit|integer|real|double\s+precision|logical|character|complex|dimension|common|external|intrinsic|intent|use|save|data|contains|include|type|class|private|public|import|interface|end\s+interface|procedure|block\s+data|format|write|print|read|open|close|continue)\b(?!\s*=)",
    re.IGNORECASE,
)
PARAMETER = re.compile(r"^\s*parameter\s*\((?P<of>.*)\)\s*$", re.IGNORECASE)
BEGINS = re.compile(
    r"^\s*(?:(?P<label>\w+)\s*:)?\s*(?P<of>do\b|if\s*\(.*\)\s*then\s*$|select\s+case|where\s*\(|program\s+\w+|module\s+(?!procedure)\w+|block\s*$|associate\b)",
    re.IGNORECASE,
)
ASSOCIATE = re.compile(r"^\s*associate\s*\((?P<of>.*)\)\s*$", re.IGNORECASE)
ENDS = re.compile(
    r"^\s*end\s*(?:(?P<of>do|if|subroutine|function|program|module|select|where|block|associate|type|interface)\b.*)?$",
    re.IGNORECASE,
)


def from_fortran(text: str, known: Collection[str]) -> Program | None:  # noqa: PLR0912 -- one for each kind of line
    """A program of Fortran; None for any other. ``known``: names as the file spells them."""
    if not FORTRAN.search(text) or not MARKS.search(text) or "{" in text or "\\" in text:
        return None
    made: list[str] = []
    results: list[str] = []
    for line in _lines(text):
        head = HEAD.match(line)
        if head:
            is_function = head["of"].lower() == "function"
            results.append((head["result"] or head["name"]) if is_function else "")
            made.append(f"function {head['name']}({head['arguments'] or ''}) {{")
        elif (given := PARAMETER.match(line)) is not None:
            made += [part + ";" for part in parts_of(given["of"], ",")]
        elif (ended := ENDS.match(line)) is not None:
            of = ended["of"]
            if of is None or of.lower() in ("subroutine", "function", "program", "module", "block", "associate"):
                out = results.pop() if results else ""
                made.append(f"return {out};\n}}" if out else "}")
            elif of.lower() not in ("type", "interface"):
                made.append("}")
        elif (renamed := ASSOCIATE.match(line)) is not None:
            results.append("")
            made += ["namespace inner {", *(part.replace("=>", "=") + ";" for part in parts_of(renamed["of"], ","))]
        elif (begun := BEGINS.match(line)) is not None:
            is_open = re.match(r"(?i)program|module|block|associate", begun["of"])
            if is_open:
                results.append("")
            made.append("namespace inner {" if is_open else "for (…) {")
        elif DECLARED.match(line):
            made += _with_values(line)
        elif re.match(r"(?i)\s*else\b", line):
            made.append("} else {")
        elif not re.match(r"(?i)\s*return\s*$", line):
            made.append(line.strip() + ";")
    bare = "\n".join(made + ["}"] * (sum("{" in m for m in made) - sum(m.count("}") for m in made)))
    bare = re.sub(r"\(/", "[", re.sub(r"/\)", "]", bare)).replace("%", ".")
    return replace(from_braces(_one_spelling(bare, known)), first=1, whole=True, powers=("**",))


def _lines(text: str) -> list[str]:
    """Statements without remarks; continued lines as one."""
    is_fixed = re.search(r"(?m)^     [^ 0\n]", text) is not None and re.search(r"&[ \t]*(?:![^\n]*)?\n", text) is None
    made: list[str] = []
    goes_on = False
    for raw in text.split("\n"):
        if re.match(r"[cC*][ \t]|[cC*]$|[cC*][-=*]", raw) and not re.match(r"(?i)c\s*=", raw):
            continue
        line = raw.partition("!")[0].rstrip()
        if not line.strip():
            continue
        if is_fixed and re.match(r"     [^ 0]", line) and made:
            made[-1] += " " + line[6:]
            continue
        bare = line.strip()
        if goes_on and made:
            made[-1] += " " + bare.removeprefix("&").removesuffix("&")
        else:
            made.append(bare.removesuffix("&"))
        goes_on = bare.endswith("&")
    return [part for line in made for part in parts_of(re.sub(r"^\d+\s+(?=[A-Za-z])", "", line), ";") if part]


def _with_values(line: str) -> list[str]:
    """What a declaration gives values to: real, parameter :: g = 9.81."""
    _, colons, names = line.partition("::")
    return [part + ";" for part in parts_of(names, ",") if re.match(r"\w+\s*=", part)] if colons else []


def _one_spelling(text: str, known: Collection[str]) -> str:
    """Each name in one spelling, the file's own where it has one: Fortran's capitals are small letters."""
    said: dict[str, str] = {}
    for name in sorted(known):
        said.setdefault(name.lower(), name)
    doubled = {name.lower() for name in known if sum(other.lower() == name.lower() for other in known) > 1}
    words = ("return", "function", "namespace", "for", "else", "if", "inner")

    def one(found: re.Match[str]) -> str:
        word = found[0]
        if word in words:
            return word
        return word if word.lower() in doubled and word in known else said.setdefault(word.lower(), word.lower())

    return re.sub(r"(?<![\w.])[A-Za-z_]\w*", one, text)
