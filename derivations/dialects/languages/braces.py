# ruff: noqa: E501 -- patterns stand on one line
"""Languages with braces, C, C++, Java, Processing, C#, JavaScript, TypeScript, Go, Rust, Swift, Kotlin: blocks and heads."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ....models.errors import InvalidInput
from ..markup.calls import closing
from ..statements import BLOCK_COMMENT, STRINGS
from .heads import function_head, is_class, is_control
from .lines import statements_of
from .program import LONGEST_PROGRAM, MOST_STATEMENTS, Function, Parameter, Program, Statement

REMARK = re.compile(r"//[^\n]*")
DEFINED = re.compile(r"(?m)^[ \t]*#[ \t]*define[ \t]+(?P<name>\w{1,30})[ \t]+(?P<value>[^\n]{1,200})$")
MACRO = re.compile(
    r"(?m)^[ \t]*#[ \t]*define[ \t]+(?P<name>\w{1,30})\((?P<of>[\w\s,]{1,60})\)[ \t]+(?P<value>[^\n]{1,200})$"
)
DIRECTIVE = re.compile(r"(?m)^[ \t]*#(?:\[[^\n]*\]|[^\n]*)$")
ANNOTATION = re.compile(r"@\w+(?:\([^()\n]{0,80}\))?[ \t]*(?=\n|(?:public|private|protected|static|final)\b)")
LAMBDA = re.compile(
    r"(?:=>|\|[^|{}]{0,200}\|\s*(?:->\s*[^={};]{1,60})?|\[[&=\w\s,*]{0,60}\]\s*\([^{}]*\)\s*(?:(?:mutable|noexcept|const)\s*|->\s*[\w:<>,\s]{1,60})*|\bfunction\s*\w*\s*\([^{}]*\)\s*|\bfunc\s*\([^{}]*\)[^{}]{0,60})$"
)
TAIL = re.compile(
    r"(?:\)\s*(?:(?:const|noexcept|override|final|mutable|async|rethrows)\s*|where\b[^{]*|throws\s+[\w.,\s]+)*(?:(?:->|:)\s*[^={};]*)?|=>\s*)$"
)
GOES_ON = re.compile(r"[-+*/%=,(\[{|&?:<>.]\s*$|\breturn\s*$")
FOLLOWS = re.compile(r"\s*(?:[-+*/%=,.?:|&)\]]|\{)")
CHOICE = re.compile(
    r"(?m)^[ \t]*#[ \t]*(?:if\b|elif\b|else\b|ifdef[ \t]+(?!__cplusplus)\w+|ifndef[ \t]+(?!\w*(?:_H|_HPP|_H_|_HPP_|_INCLUDED|_H__|M_PI)\b)\w+)[^\n]*"
)
SCALA = re.compile(r"(?P<head>\bdef\s+\w+\s*\([^(){}]*\)\s*(?::\s*[\w\[\]]+)?)\s*=\s*\{")
MAIN = re.compile(
    r"\)\s*(?:const\s*|noexcept\s*|override\s*)*(?:(?:->|:|throws\b)[^{};=()]{1,80})?\s*\{|=>|\|\s*\{|\bfunc\s*\(|\b(?:func?|fn)\s+\w+|\bdef\s+\w+\s*\([^(){}]*\)[^(){}=]*=\s*\{|\b(?:struct|class)\s+\w+[^;{}()]{0,80}\{"
)

_INNER = r"(?P<of>(?:[^()\n;]|\([^()\n;]*\)){1,80})"
BOTH_WAVES = (
    re.compile(rf"(?P<s>\w+)\s*,\s*(?P<c>\w+)\s*(?P<is>:?=)\s*math\.Sincos\({_INNER}\)"),
    re.compile(
        r"let\s*\(\s*(?P<s>\w+)\s*,\s*(?P<c>\w+)\s*\)\s*(?P<is>=)\s*(?P<of>[\w.]+(?:\[\d\])?|\([^()\n;]{1,80}\))\.sin_cos\(\)"
    ),
)


@dataclass(frozen=True)
class _Node:
    """A statement, or a block with what stands in front of it."""

    text: str
    inner: tuple[_Node, ...] | None = None


def is_braced(text: str) -> bool:
    """Whether a text has functions in braces."""
    bare = without_remarks(text)
    return "{" in bare and "\\begin" not in text and "\\frac" not in text and MAIN.search(bare) is not None


def _both_waves(text: str) -> str:
    """Go's s, c := math.Sincos(x) and Rust's let (s, c) = x.sin_cos() as two statements."""
    text = BOTH_WAVES[0].sub(r"\g<s> \g<is> math.Sin(\g<of>); \g<c> \g<is> math.Cos(\g<of>)", text)
    return BOTH_WAVES[1].sub(r"let \g<s> = sin(\g<of>); let \g<c> = cos(\g<of>)", text)


def without_remarks(text: str) -> str:
    """The program without remarks and texts in quotes."""
    text = re.sub(r"\[\s*[\"'](\w{1,30})[\"']\s*\]", r".\1", text)  # p["m1"]
    text = BLOCK_COMMENT.sub(" ", STRINGS.sub(" ", text))
    text = re.sub(r'"(?:[^"\\\n]|\\.){0,200}"|`[^`]{0,200}`|\'(?:[^\'\\\n]|\\.){0,2}\'', '""', text)
    return re.sub(r"\(\s*\*\s*([A-Za-z]\w*)\s*\)\s*\.\s*(?=[A-Za-z])", r"\1->", REMARK.sub("", text))


def from_braces(text: str, by_lines: bool = False) -> Program:
    """The program. ``by_lines``: a statement ends with its line. Raises InvalidInput where blocks are not plain."""
    if len(text) > LONGEST_PROGRAM:
        raise InvalidInput(f"this program is longer than {LONGEST_PROGRAM} characters; give the function alone")
    is_rust = re.search(r"\bfn\s+\w+|\blet\s+mut\b", text) is not None
    bare = _both_waves(without_remarks(text))
    _check_directives(bare)
    defined = [Statement(m["name"], m["value"].strip()) for m in DEFINED.finditer(bare)]
    macros = [
        Function(m["name"], _names(m["of"]), (Statement("return", m["value"].strip()),)) for m in MACRO.finditer(bare)
    ]
    bare = ANNOTATION.sub("", DIRECTIVE.sub("", re.sub(r"\\\n", " ", bare)))
    bare = SCALA.sub(r"\g<head> {", bare)
    bare = re.sub(r"\boperator\s*\(\s*\)", "operatorcall", bare)
    lines = sum(1 for line in bare.split("\n") if line.strip(" \t{}"))
    by_lines = by_lines or bare.count(";") < 0.3 * lines
    nodes, _ = _nodes(bare, 0, by_lines)
    functions: list[Function] = list(macros)
    outside = list(defined)
    _gathered(nodes, functions, outside, is_class_level=True)
    if len(outside) > MOST_STATEMENTS or any(len(f.statements) > MOST_STATEMENTS for f in functions):
        raise InvalidInput(f"this program has more than {MOST_STATEMENTS} lines; give the function alone")
    return Program(tuple(functions), tuple(outside), 0, whole=_divides_whole(bare) or is_rust,
                   powers=_powers(bare))  # fmt: skip


def _check_directives(bare: str) -> None:
    """Raises InvalidInput for code on a condition, and for macros whose text is not what it looks like."""
    choice = CHOICE.search(bare)
    if choice:
        raise InvalidInput(f"{choice[0].strip()[:30]!r}: code on a condition; give the one that is meant")
    for found in DEFINED.finditer(bare):
        inner = re.sub(r"\([^()]*(?:\([^()]*\)[^()]*)*\)", "x", found["value"].strip())
        if re.search(r"(?<![eE(])\s*[-+*/](?!$)", inner[1:]) and re.search(
            rf"(?<!\w){found['name']}(?!\w)", bare[found.end() :]
        ):
            raise InvalidInput(f"#define {found['name']} {found['value'].strip()[:30]}: put brackets around it; without, "
                               "what stands beside it binds first")  # fmt: skip
    for found in MACRO.finditer(bare):
        of = [part.strip() for part in found["of"].split(",")]
        inner, used = found["value"].strip(), rf"(?<!\w){found['name']}\s*\("
        bare_one = next(
            (x for x in of if re.search(rf"(?<![\w(]){x}(?!\w)|(?<!\w){x}(?![\w)])", re.sub(r"\s", "", inner))), None
        )
        if bare_one and re.search(rf"{used}[^()]*[-+*/]", bare[found.end() :]):
            raise InvalidInput(f"#define {found['name']}({found['of']}): put brackets around {bare_one}; without, what "
                               "stands beside it binds first")  # fmt: skip


def _powers(bare: str) -> tuple[str, ...]:
    """How powers are written: nowhere by ^, which is another operation in all of these."""
    if re.search(r"\bvector\s*\[", bare):
        return ("^",)  # Stan
    return ("**",) if re.search(r"\b(?:const|let|var|function)\b|=>", bare) else ()


def _divides_whole(bare: str) -> bool:
    """Whether 1/2 is 0: in all of these languages but JavaScript and its kin, and Swift."""
    script = re.search(r"\bfunction\b|\bconst\s+\w+\s*=|\blet\s+(?!mut)\w+|\bMath\.(?:sin|cos)|===", bare)
    typed = re.search(r"\b(?:double|float|float64|f64|fn)\b", bare)
    return typed is not None or script is None


def _names(text: str) -> tuple[Parameter, ...]:
    return tuple(Parameter(part.strip()) for part in text.split(","))


def _nodes(text: str, at: int, by_lines: bool, level: int = 0) -> tuple[list[_Node], int]:
    """The statements and blocks from here to the brace that closes them, and where that is behind."""
    if level > 12:
        raise InvalidInput("blocks within blocks, more than twelve deep; give the function alone")
    found: list[_Node] = []
    start, depth = at, 0
    while at < len(text):
        c = text[at]
        depth += (c in "([") - (c in ")]")
        if c == "{":
            head = text[start:at]
            if _opens_block(head, depth):
                inner, at = _nodes(text, at + 1, by_lines, level + 1)
                found.append(_Node(head.strip(), tuple(inner)))
                start, depth = at, 0
                continue
            end = closing(text, at)
            if end < 0:
                raise InvalidInput("a brace is opened and not closed")
            at = end
        elif c == "}":
            found.append(_Node(text[start:at].strip()))
            return [node for node in found if node.text or node.inner is not None], at + 1
        elif depth <= 0 and (c == ";" or (c == "\n" and by_lines and _ends(text, start, at))):
            found.append(_Node(text[start:at].strip()))
            start, depth = at + 1, 0
        at += 1
    found.append(_Node(text[start:].strip()))
    return [node for node in found if node.text or node.inner is not None], at


def _ends(text: str, start: int, at: int) -> bool:
    return not GOES_ON.search(text[start:at]) and not FOLLOWS.match(text, at)


def _opens_block(head: str, depth: int) -> bool:
    bare = re.sub(r"\s+", " ", head).strip()
    if LAMBDA.search(bare):
        return True
    if depth > 0:
        return False
    if not bare or is_class(bare) or is_control(bare):
        return True
    if re.match(r"(?:[a-z]+ )*(?:func|fn|fun|def)\b", bare):
        return True
    return TAIL.search(bare) is not None and "(" in bare and re.match(r"return\b", bare) is None


def _gathered(nodes: list[_Node], functions: list[Function], outside: list[Statement], is_class_level: bool) -> None:
    for node in nodes:
        if node.inner is None:
            made, own = statements_of(node.text)
            functions += own
            outside += made or []
            continue
        head = None if is_class(node.text) or is_control(node.text) else function_head(node.text)
        if head is None:
            _gathered(list(node.inner), functions, outside, is_class_level)
            continue
        name, parameters = head
        functions.append(_function(name, parameters, list(node.inner), functions))


def _function(name: str, parameters: tuple[Parameter, ...], nodes: list[_Node], functions: list[Function]) -> Function:
    made: list[Statement] = []
    refused = ""
    for place, node in enumerate(nodes):
        if node.inner is not None:
            if is_control(node.text):
                refused = refused or (f"{node.text[:40]!r}: assignments and one return are followed, and nothing else; "
                                      "write out what a loop or a condition comes to")  # fmt: skip
                continue
            head = function_head(node.text)
            if head:
                functions.append(_function(head[0], head[1], list(node.inner), functions))
            elif node.text in ("", "namespace inner"):
                inside = _function(name, (), list(node.inner), functions).statements
                twice = {one.target for one in inside} & {one.target for one in made}
                if twice and not node.text:
                    refused = (
                        refused or f"{min(twice)} is another thing in a block of its own; give it a name of its own"
                    )
                made += inside
            continue
        if is_control(node.text):
            refused = (
                refused
                or f"{node.text[:40]!r}: assignments and one return are followed; and nothing else; write out what it comes to"
            )
            continue
        found, own = statements_of(node.text, is_last=place == len(nodes) - 1)
        functions += own
        if found is None:
            refused = refused or f"{node.text[:40]!r}: assignments and one return are followed, and nothing else"
        else:
            made += found
    return Function(name, parameters, tuple(made), refused)
