"""Fortran's text as a tree. Nothing is run."""

from __future__ import annotations

import re
from collections.abc import Collection

from ..grammars.languages.language import Language
from ..traced import nodes
from .fortran_expressions import FortranExpressions
from .fortran_lines import lines_of, one_spelling
from .parser import NoProgram, changed_in, counted

CUE = re.compile(r"(?im)^\s*(?:\w[\w()=*, ]*\s)?(?:subroutine\s+\w+|function\s+\w+\s*\()")
MARKS = re.compile(
    r"(?i)\bimplicit\s+none\b|::|\bdimension\b|\bend\s*(?:subroutine|function)\b|\bdouble\s+precision\b|\breal\s*(?:\*|\()|\bsubroutine\b"
)
_KIND = r"(?:\s*\([^()]*(?:\([^()]*\))?[^()]*\)|\s*\*\s*\d+)?"
TYPE = rf"(?:real|integer|logical|complex|character|double\s+precision|type\s*\([^()]*\)|class\s*\([^()]*\)){_KIND}"
HEAD = re.compile(
    rf"(?i)^(?:(?:pure|recursive|elemental|impure|{TYPE})\s+)*(?P<of>subroutine|function)\s+(?P<name>\w+)\s*(?:\((?P<arguments>[^()]*)\))?"
    r"\s*(?:(?:result\s*\(\s*(?P<result>\w+)\s*\)|bind\s*\([^()]*\))\s*)*$"
)
DECLARED = re.compile(
    rf"(?i)^(?P<type>{TYPE})\s*(?P<more>(?:,\s*\w+\s*(?:\((?:[^()]|\([^()]*\))*\))?\s*)*)(?:::|\s)\s*(?P<names>[A-Za-z_].*)$"
)
DIMENSION = re.compile(r"(?i)^dimension\s*(?:::)?\s*(?P<names>.*)$")
SILENT = re.compile(
    r"(?i)^(?:implicit|use|save|external|intrinsic|contains|include|private|public|import|interface|end\s*interface|procedure|data"
    r"|format|write|print|open|close|continue|stop|program|module|end\s*(?:program|module)|logical|character|type\b(?!\s*\()|end\s*type)\b(?!\s*[=(]|\s*$)|^(?:contains|continue|stop|implicit\s+none|print\s*\*|write\s*\().*$"
    r"|^(?:end\s*(?:program|module|interface|type)|error\s+stop|public|private|save)\b"
)
COMMON = re.compile(r"(?i)^common\b\s*(?:/\s*\w*\s*/)?(?P<names>.*)$")
PARAMETER = re.compile(r"(?i)^parameter\s*\((?P<of>.*)\)$")
END = re.compile(r"(?i)^end(?:\s*(?:subroutine|function|procedure|do|if|associate|block|select|where|program)\b.*)?$")
IF = re.compile(r"(?i)^(?:else\s*)?if\s*\((?P<test>.*)\)\s*then$")
SHORT_IF = re.compile(r"(?i)^if\s*(?=\()")
DO = re.compile(r"(?i)^(?:\w+\s*:\s*)?do\s+(?P<name>[a-z]\w*)\s*=\s*(?P<of>.*)$")
ASSOCIATE = re.compile(r"(?i)^associate\s*\((?P<of>.*)\)$")
OTHER_BLOCK = re.compile(r"(?i)^(?:\w+\s*:\s*)?(?:do\b|select\b|where\s*\(.*\)$|forall\b|block$|critical$)")
FORTRAN = Language("Fortran", "own", re.compile("$^"), whole=True, powers=frozenset({"**"}), first=1, fills=True)


def fortran_tree(text: str, known: Collection[str]) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no Fortran. ``known``: names as the file spells them."""
    if not CUE.search(text) or not MARKS.search(text) or "{" in text or "\\" in text:
        return None
    lines = [one_spelling(line, known) for line in lines_of(text)]
    try:
        return tuple(_Fortran(lines).units())
    except (NoProgram, RecursionError, IndexError):
        return None


class _Fortran:
    """``arrays``, ``whole``: names of the unit that is read; ``outs``: what its function gives back."""

    def __init__(self, lines: list[str]) -> None:
        self.lines, self.at = lines, 0
        heads = [m for line in lines if (m := HEAD.match(line))]
        self.expressions = FortranExpressions(frozenset(m["name"] for m in heads))
        self.outs = ""
        self.given: frozenset[str] = frozenset()

    def units(self) -> list[nodes.Statement]:
        """Functions, and what modules say besides."""
        made: list[nodes.Statement] = []
        while self.at < len(self.lines):
            head = HEAD.match(self.lines[self.at])
            if head is not None:
                self.at += 1
                made.append(self.unit(head))
            elif END.match(self.lines[self.at]):
                self.at += 1
            else:
                made += self.statement()
        return made

    def unit(self, head: re.Match[str]) -> nodes.Define:
        """A subroutine or a function."""
        is_function = head["of"].lower() == "function"
        parameters = tuple(p.strip() for p in (head["arguments"] or "").split(",") if p.strip())
        around = self.outs, self.given, self.expressions.whole
        self.outs = (head["result"] or head["name"]) if is_function else ""
        self.given = frozenset(parameters)
        self.expressions.whole = frozenset()
        body = self.body()
        self.at += 1
        if self.outs:
            body.append(nodes.Return(nodes.Word(self.outs), head[0][:60]))
        shared = tuple(p for p in parameters if p in changed_in(body))
        self.outs, self.given, self.expressions.whole = around
        return nodes.Define(head["name"], parameters, (), tuple(body), "", shared)

    def body(self) -> list[nodes.Statement]:
        """Statements up to what ends their block."""
        made: list[nodes.Statement] = []
        while self.at < len(self.lines):
            line = self.lines[self.at]
            if END.match(line) or re.match(r"(?i)else\b|elseif\b|case\b", line):
                return made
            head = HEAD.match(line)
            if head is not None:  # behind contains
                self.at += 1
                made.append(self.unit(head))
            else:
                made += self.statement()
        return made

    def statement(self) -> list[nodes.Statement]:  # noqa: PLR0911 -- one for each kind
        line = self.lines[self.at]
        self.at += 1
        if re.match(r"(?i)return$", line):
            return [nodes.Return(nodes.Word(self.outs) if self.outs else None, line)]
        if (found := IF.match(line)) is not None:
            return [self.choice(found["test"], line)]
        if SHORT_IF.match(line):
            return [self.short_choice(line)]
        if (found := DO.match(line)) is not None:
            return [self.loop(found, line)]
        if (found := ASSOCIATE.match(line)) is not None:
            made = [self.assigned(part.replace("=>", "="), line) for part in self.expressions.parts(found["of"])]
            made += self.body()
            self.at += 1
            return made
        if OTHER_BLOCK.match(line):
            return [self.unfollowed(line)]
        if (found := PARAMETER.match(line)) is not None:
            return [self.assigned(part, line) for part in self.expressions.parts(found["of"])]
        if re.match(r"(?i)call\s", line):
            return [nodes.Do(self.expressions.read(re.sub(r"(?i)^call\s+", "", line), is_call=True), line[:60])]
        if (found := COMMON.match(line)) is not None:
            self.given |= {re.sub(r"\(.*", "", part).strip() for part in self.expressions.parts(found["names"])}
            return []
        if (found := DECLARED.match(line) or DIMENSION.match(line)) is not None and not re.match(r"(?i)\w+\s*=", line):
            return self.declared(found, line)
        if SILENT.match(line):
            return []
        if re.match(r"(?i)read\b|exit$|cycle$|go\s*to\b", line):
            kind = {"exit": "break", "cycle": "continue"}.get(line.lower())
            return [nodes.Leave(kind, line) if kind else nodes.Unfollowed(line, self.expressions.words(line))]
        return [self.assigned(line, line)]

    def assigned(self, text: str, line: str) -> nodes.Statement:
        """name = value; a(1) on the left is an entry, whatever a is."""
        target, value = self.expressions.sides(text)
        return nodes.Assign(target, value, " ".join(line.split())[:60])

    def declared(self, found: re.Match[str], line: str) -> list[nodes.Statement]:
        """Values of names, and arrays that are not filled yet."""
        groups = found.groupdict()
        more = groups.get("more") or ""
        if (groups.get("type") or "").lower().startswith("integer"):
            names = {re.sub(r"[(=].*", "", p).strip() for p in self.expressions.parts(found["names"])}
            self.expressions.whole |= names
        size = re.search(r"(?i)dimension\s*\((?P<of>[^()]*)\)", more)
        made: list[nodes.Statement] = []
        for part in self.expressions.parts(found["names"]):
            if re.match(r"\w+(?:\([^()]*\))?\s*=(?!=|>)", part):
                made.append(self.assigned(re.sub(r"^(\w+)\([^()]*\)", r"\1", part), line))
                continue
            array = re.match(r"(?P<name>\w+)\s*(?:\((?P<of>[^()]*(?:\([^()]*\))?)\))?$", part)
            if array is None or array["name"] in self.given or re.search(r"(?i)pointer|intent", more):
                continue
            sizes = array["of"] or (size["of"] if size else "")
            made += self.array(array["name"], sizes, line)
        return made

    def array(self, name: str, sizes: str, line: str) -> list[nodes.Statement]:
        """real :: dy(4): as long as it says, or as the last place that is filled."""
        if not sizes:
            return []
        shape = [s.strip() for s in sizes.split(",")]
        if not all(s.isdigit() for s in shape):
            places = [
                int(k)
                for text in self.lines
                for k in re.findall(rf"(?<!\w){name}\s*\(\s*([0-9]{{1,2}})\s*\)\s*=", text)
            ]
            if len(shape) != 1 or not places:
                return []
            shape = [str(max(places))]
        zeros = nodes.Call(nodes.Word("zeros"), tuple(nodes.Number(s) for s in shape))
        return [
            nodes.Assign(nodes.Word(name), nodes.Call(nodes.Word("unfilled·"), (nodes.Text(name), zeros)), line[:60])
        ]

    def choice(self, test: str, line: str) -> nodes.Statement:
        """From if to the end that closes it."""
        read = self.expressions.read(test)
        body = self.body()
        otherwise: list[nodes.Statement] = []
        behind = self.lines[self.at]
        self.at += 1
        if (found := IF.match(behind)) is not None:
            otherwise = [self.choice(found["test"], behind)]
        elif re.match(r"(?i)else$", behind):
            otherwise = self.body()
            self.at += 1
        names = changed_in([*body, *otherwise])
        return nodes.Choice(read, tuple(body), tuple(otherwise), line[:60], names)

    def short_choice(self, line: str) -> nodes.Statement:
        """if (test) statement"""
        test, rest = self.expressions.bracket(SHORT_IF.sub("", line))
        self.lines.insert(self.at, rest)
        body = self.statement()
        return nodes.Choice(test, tuple(body), (), line[:60], changed_in(body))

    def loop(self, found: re.Match[str], line: str) -> nodes.Statement:
        """do i = 1, n"""
        ends = [self.expressions.read(part) for part in self.expressions.parts(found["of"])]
        whole, self.expressions.whole = self.expressions.whole, self.expressions.whole | {found["name"]}
        body = self.body()
        self.expressions.whole = whole
        self.at += 1
        if len(ends) != 2:
            return nodes.Unfollowed(line[:60], changed_in(body))
        return nodes.Repeat(found["name"], counted(ends[0], ends[1]), tuple(body), line[:60])

    def unfollowed(self, line: str) -> nodes.Statement:
        """A block of another kind: past its end."""
        depth, names = 1, list(self.expressions.words(line))
        while depth and self.at < len(self.lines):
            here = self.lines[self.at]
            names += self.expressions.words(here)
            depth += bool(IF.match(here) and not here.lower().startswith("else")) or bool(
                DO.match(here) or OTHER_BLOCK.match(here)
            )
            depth -= bool(END.match(here))
            self.at += 1
        return nodes.Unfollowed(line[:60], tuple(dict.fromkeys(names)))
