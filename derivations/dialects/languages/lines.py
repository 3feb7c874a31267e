"""One statement of a language with braces: a declaration, an assignment, what is returned, or a call without effect."""

from __future__ import annotations

import re

from ..markup.calls import closing, parts_of
from .heads import function_head
from .program import ALLOCATED, CALL, RETURN, Function, Statement

WORDS = re.compile(
    r"^(?:(?:const|constexpr|static|final|let|var|val|mut|auto|public|private|protected|internal|readonly|volatile|inline|register|unsigned|local|extern|mutable|export|default|pub|override|lateinit|thread_local|consteval|constinit|lazy|declare|global)\b(?:\s*\(crate\))?[\s&*]*)+"
)
TYPED = re.compile(
    r"^(?P<type>(?:(?:const|unsigned|struct)\s+)*[A-Za-z_]\w*(?:(?:::|\.)\w+)*(?:\s*<[^=;]*?>)?(?:\s*\[[\d,]*\])*(?:\s+const)?\s*[&*]*\s*(?:const\s+)?(?:__restrict\s+)?)(?<=[\s&*>\]])(?P<rest>[A-Za-z_]\w*\s*(?:[=,:({\[].*)?)$",
    re.DOTALL,
)
NO_TYPE = (
    "return",
    "new",
    "delete",
    "throw",
    "goto",
    "typedef",
    "using",
    "import",
    "package",
    "include",
    "case",
    "else",
    "in",
    "yield",
    "await",
    "go",
    "defer",
)
SILENT = re.compile(
    r"^(?:using\b|import\b|package\b|typedef\b|include\b|use\s|mod\s|extern\b|export\s*\{|module\b|friend\b|type\s+\w+|typealias\b|throw\b|precision\b|go\s|defer\s|suspend\b|uniform\b"
    r"|\(void\)\s*\(?\s*\w+\s*\)?$|\w+$|this$|(?:[\w.]+(?:->|\.|::))?(?:resize|reserve|assert|debug_assert|printf|print|println|log|setZero|clear|assign|memset|UNUSED|Q_UNUSED|UNUSED_PARAMETER|unused|check_\w*|require|precondition|static_assert|cout|info|debug|write|WriteLine|Log)!?\s*\(.*\)$"
    r"|std::cout\b.*|\#.*)",
    re.DOTALL,
)
ASSIGNED = re.compile(
    r"^(?P<target>[^=<>!]{1,160}?)\s*(?P<op>\*\*|[-+*/%]|<<|\||&)?(?<![=<>!]):?=(?![=>])\s*(?P<value>.+)$", re.DOTALL
)
FILLED = re.compile(r"^(?P<target>\(?\*?\s*[A-Za-z_][\w.>-]*(?:\[\d+\])?\)?)\s*<<\s*(?P<value>.+)$", re.DOTALL)
PUSHED = re.compile(
    r"^(?P<name>[A-Za-z_]\w*)\s*(?:\.|->)(?:push_back|push|append|add|emplace_back|Add|unshift)\s*\((?P<value>.+)\)$",
    re.DOTALL,
)
SET = re.compile(
    r"^(?P<name>[A-Za-z_]\w*)\s*(?:\.|->)(?:set|setEntry|setElement|put|insert|at_put)\s*\(\s*(?P<at>[0-9](?:\s*,\s*[0-9])?)\s*,\s*(?P<value>[^,].*)\)$",
    re.DOTALL,
)
ARROW = re.compile(
    r"^(?:export\s+|default\s+)*(?:(?:const|let|var)\s+)?(?P<name>\w{1,40})\s*(?::[^=]+)?=\s*(?P<head>(?:async\s*)?(?:\([^()]*\)|\w+)\s*(?::[^=>]+)?)\s*=>\s*(?P<body>(?!\s*\{).+)$",
    re.DOTALL,
)
SHARP = re.compile(r"^[\w<>\[\]\s,.]+?\b(?P<head>\w+\s*\([^()]*\))\s*=>\s*(?P<body>.+)$", re.DOTALL)
KOTLIN = re.compile(r"^(?:\w+\s+)*fun\s+(?P<head>\w+\s*\(.*?\))\s*(?::[^=]+)?=\s*(?P<body>.+)$", re.DOTALL)
ALLOCATES = re.compile(
    r"^(?:new\s+[\w.]+(?:<[^<>]*>)?\s*(?:\[[^\[\]]*\](?:\[[^\[\]]*\])?|\(\s*\w*\s*\))(?:\.fill\([^()]*\))?|(?:Array|DoubleArray|FloatArray|Float64Array|List|MutableList|doubleArrayOf|mutableListOf)(?:<[^<>]*>)?\(\s*\w*\s*\)(?:\s*\.fill\([^()]*\))?|\[\s*0(?:\.0*)?(?:_?f(?:64|32))?\s*;\s*\w+\s*\]"
    r"|vec!\[\s*0\.?0*(?:_?f(?:64|32))?\s*;[^\[\]]*\]|make\s*\(\s*\[\][\w\[\]]+\s*,[^()]*(?:\([^()]*\))?[^()]*\)|\[\w*\]\w+\s*\{\s*\}|\{\s*(?:0(?:\.0*)?f?)?\s*\}|\[\s*\]|(?:Self|[\w:]*[Vv]ec(?:tor|tor\w+|\d\w*)?|[\w:]*Matrix\w*|Vec)(?:::<[^<>]*>)?::(?:Zero|zeros|with_capacity|new|zero|default|from_element)\s*\([^()]*\)"
    r"|Default::default\(\)|(?:[\w.]*(?:Vector|Matrix|zeros|Zeros|Create\w*|numeric|zero)\w*)(?:<[^<>]*>)?\s*\(\s*[\d,\s]*\)|\[\s*(?:Double|Float|CGFloat)\s*\]\s*\(.*\)|Array\(repeating:.*\)|[\w:]+\(\s*\)|malloc\(.*\)|calloc\(.*\)|\w+\.(?:length|len|size)\b.*|(?:\w+\.)?(?:clone|copy|similar|slice|to_vec|copyOf)\(\s*\))$",
    re.DOTALL,
)
CHAINED = re.compile(r"(?P<target>[\w.>-]+\s*(?:[\[(][\d,\s\]\[()]*[\])])?)\s*=(?![=>])")
CALLED = re.compile(r"(?:[\w.:]+(?:->|\.|::))?\w+!?\s*\((?P<of>.*)\)", re.DOTALL)
MOST_PARTS = 40
Statements = list[Statement]


def statements_of(  # noqa: PLR0911 -- one for each kind of statement
    text: str, is_last: bool = False
) -> tuple[Statements | None, list[Function]]:
    """What a statement sets, and functions that it says; None for what is not followed."""
    text = re.sub(r"^[)\],\s]+(?=$|;)", "", text).strip().rstrip(";").strip()
    text = re.sub(r"^(?:public|private|protected)\s*:\s*(?!:)", "", text).strip()
    text = re.sub(r"^(?:default|case\s+\w+)\s*:\s*", "", text)
    if not text or re.fullmatch(r"[)\]},;]+", text):
        return [], []
    made = _as_function(text)
    if made:
        return [], [made]
    if re.match(r"return\b", text):
        return [Statement(RETURN, text[6:].strip())], []
    if SILENT.match(text) and not (is_last and re.fullmatch(r"[A-Za-z_]\w*", text)):
        return [], []
    for read in (_pushed, _filled, _declared, _assigned):
        found = read(text)
        if found is not None:
            return found, []
    if (is_last and not re.match(r"[\w.:>-]+!?\s*\(.*\)$", text)) or (is_last and text[:1] in "[("):
        return [Statement(RETURN, text)], []
    if is_last and re.match(
        r"(?:[\w:]*(?:Vec|vec|State|Matrix|Ok|Some|[aA]rray|List|Seq|from)\w*|\w+::new|\w+::from)!?(?:::<[^<>]*>)?\s*[\[({]",
        text,
    ):
        return [Statement(RETURN, text)], []
    if CALLED.fullmatch(text):
        return [Statement(CALL, text)], []
    return None, []


def _as_function(text: str) -> Function | None:
    """A function that is one expression: (x) => …, fun f(x) = …"""
    for pattern in (ARROW, KOTLIN, SHARP):
        found = pattern.match(text)
        if found is None:
            continue
        head = function_head(found["head"].strip() + (" =>" if pattern is ARROW else ""))
        if head:
            name = found.groupdict().get("name") or head[0]
            return Function(name, head[1], (Statement(RETURN, found["body"].strip()),))
    return None


def _pushed(text: str) -> Statements | None:
    found = PUSHED.match(text)
    if found:
        return [Statement(f"{found['name']}[+]", part) for part in parts_of(found["value"], ",")[:MOST_PARTS]]
    found = SET.match(text)
    return [Statement(f"{found['name']}[{found['at']}]", found["value"].strip())] if found else None


def _filled(text: str) -> Statements | None:
    """M << a, b, c, d of Eigen."""
    found = FILLED.match(text)
    if found is None or found["target"].strip() in ("cout", "std::cout", "file", "out", "os"):
        return [] if found else None
    return [Statement(re.sub(r"[()*\s]", "", found["target"]), "<<" + found["value"])]


def _declared(text: str) -> Statements | None:
    """double a = …, b; const [a, b] = y; auto f = …; float[] s = new float[4]."""
    words = WORDS.match(text)
    bare = text[words.end() :].strip() if words else text
    typed = TYPED.match(bare)
    if typed and typed["type"].strip() not in NO_TYPE and not re.match(r"(?:in|as|is|if)\b", typed["rest"]):
        of, bare = typed["type"].strip(), typed["rest"].strip()
    elif words:
        of = ""
    else:
        return None
    bare = re.sub(r"^[A-Z]\w*\s*(?=\{[^{}]*\}\s*=)", "", bare)
    if bare[:1] in "[{(":
        return _taken_apart(bare)
    made: Statements = []
    for part in parts_of(bare, ",") if not re.match(r"\w+\s*,[^=]*:?=", bare) else _with_several(bare):
        found = _declarator(part, of)
        if found is None:
            return None
        made += found
    return made


def _with_several(bare: str) -> list[str]:
    """double a, b = 1 as it stands in C; Go's a, b := 1, 2 has as many values as names."""
    left, _, right = bare.partition("=")
    names, values = parts_of(left.rstrip(":"), ","), parts_of(right, ",")
    if len(names) == len(values) and not any(re.search(r"(?<![=<>!])=(?!=)", v) for v in values):
        return [f"{n} = {v}" for n, v in zip(names, values, strict=True)]
    return parts_of(bare, ",")


def _declarator(part: str, of: str) -> Statements | None:
    part = part.strip().lstrip("&* ")
    found = re.match(
        r"(?P<name>[A-Za-z_]\w*)\s*(?:!?\s*:(?!:)\s*(?P<type>[^=]+?))?\s*(?P<many>(?:\[[^\]]*\])*)\s*(?P<rest>.*)$",
        part,
        re.DOTALL,
    )
    if found is None:
        return None
    name, rest, kind = found["name"], found["rest"].strip(), of or found["type"] or ""
    made = f"{ALLOCATED} {kind}"
    if not rest:
        return [Statement(name, made)]
    if rest[:1] == "=" or rest[:2] == ":=":
        value = re.sub(r"^:?=\s*", "", rest)
        return [Statement(name, made if ALLOCATES.match(value) else value)]
    if rest[0] in "({" and closing(rest, 0) == len(rest) - 1:
        inner = rest[1:-1].strip()
        if not inner or (
            re.fullmatch(r"\d+(?:\s*,\s*(?:0\.?0*|\d+))?", inner) and not re.search(r"double|float|auto|real|int", kind)
        ):
            return [Statement(name, made)]
        many = len(parts_of(inner, ",")) > 1
        return [Statement(name, f"[{inner}]" if many else inner)]
    return None


def _taken_apart(bare: str) -> Statements | None:
    """[a, b] = y; {m, l} = p says nothing but names."""
    end = closing(bare, 0)
    behind = re.match(r"\s*(?::[^=]+)?:?=\s*(?P<value>.+)$", bare[end + 1 :], re.DOTALL) if end > 0 else None
    if behind is None:
        return None
    if bare[0] == "{":
        renamed = [part.split(":") for part in parts_of(bare[1:end], ",") if part]
        source = behind["value"].strip().lstrip("&*")
        return [Statement(one[-1].strip(), f"{source}.{one[0].strip()}") for one in renamed if "=" not in "".join(one)]
    return [Statement("(" + bare[1:end] + ")", behind["value"].strip())]


def _assigned(text: str) -> Statements | None:  # noqa: PLR0911 -- one for each kind of assignment
    if text[:1] in "[{(" and re.match(r"\(?[\[{(][^=]*[\]})]\s*=(?!=)", text) and not re.match(r"\(\s*\*", text):
        return _taken_apart(text)
    parts = parts_of(text, ",")
    several = len(parts) > 1 and all(ASSIGNED.match(part) for part in parts)
    if not several and len(parts) > 1 and re.match(r"[\w\[\].]+(?:\s*,\s*[\w\[\].]+)+\s*:?=", text):
        left, _, right = text.partition("=")
        names, values = parts_of(left.rstrip(":"), ","), parts_of(right, ",")
        if len(names) == len(values):
            return [s for n, v in zip(names, values, strict=True) for s in _assigned(f"{n} = {v}") or []]
        if len(values) == 1:
            return [Statement("(" + left.rstrip(":").strip() + ")", right.strip())]
        return None
    made: Statements = []
    for part in parts if several else [text]:
        found = ASSIGNED.match(part)
        if found is None or found["op"] in ("%", "<<", "|", "&", "**"):
            return None
        target, value = found["target"].strip(), found["value"].strip()
        op = found["op"] or ""
        chained = CHAINED.match(value) if not op else None
        if chained:  # M(0,1) = M(1,0) = …
            made += [*(_assigned(value) or []), Statement(target, chained["target"].strip())]
            continue
        if re.search(r"\s", re.sub(r"\s*(?:,|->|\.|\[|\]|\(|\))\s*", "", target)) or re.search(
            r"(?<![=!<>])=(?![=>])", value
        ):
            return None
        if op:
            made.append(Statement(target, f"{target} {op} ({value})", op, value))
        else:
            made.append(Statement(target, ALLOCATED if ALLOCATES.match(value) else value))
    return made
