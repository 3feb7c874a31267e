# ruff: noqa: E501 -- patterns stand on one line
"""What stands in front of a block: a function with its parameters, a class, or a loop or condition."""

from __future__ import annotations

import re

from ..markup.calls import closing, parts_of
from .program import Parameter

CLASS = re.compile(
    r"(?:(?:template\s*<[^>]*>|public|private|protected|internal|export|default|abstract|static|final|sealed|pub|data|partial|open|unsafe|typedef)\s*)*"
    r"(?:class|struct|namespace|interface|impl|object|enum|extension|module|trait|union|extern|functions)\b(?![^{]*=\s*$)"
)
CONTROL = re.compile(
    r"(?:\}?\s*else\b|(?:if|for|while|switch|do|try|catch|finally|loop|match|guard|foreach|repeat|with)\b)"
)
WORDS = r"(?:const|mut|ref|out|in|final|readonly|volatile|struct|unsigned|restrict|__restrict|inout|var|val|let|register|borrowing|dyn|params|public|private)"
LIST_TYPE = re.compile(
    r"\[|\*|[Vv]ec|[Aa]rray|[Ss]tate|[Ll]ist|[Mm]atrix|slice|span|Float64List|valarray|tuple|Tuple|ndarray|Tensor"
)
NUMBER_TYPE = re.compile(
    r"^(?:[\w.]*::)?(?:double|float|real|f64|f32|float64|float32|number|Double|Float|CGFloat|int|long|Real|real_t|realtype|sunrealtype|size_t|i32|usize|Int|num|value_type|scalar|Scalar|T)\s*&?$"
)
BY_COLON = re.compile(r"^(?P<names>\w+(?:\s+\w+)?|\[[\w\s,]*\]|\{[\w\s,]*\})\s*\??\s*:\s*(?P<type>[^:].*)$")
GO = re.compile(r"^(?P<name>\w+)\s+(?P<type>(?:\[\d*\]|\*)*[\w.]+(?:\[[\w\s,]*\])?)$")
C = re.compile(r"^(?P<type>.*?[\s&*>\]])(?P<name>\w+)\s*(?P<many>(?:\[[^\]]*\])*)$")


def is_class(head: str) -> bool:
    """Whether a block is a class, a namespace or so."""
    return CLASS.match(head) is not None and not re.search(r"\)\s*(?:const\s*)?(?:->[^{]*)?$", head)


def is_control(head: str) -> bool:
    """Whether a block, or a statement, is a loop or a condition."""
    return CONTROL.match(head) is not None


def function_head(head: str) -> tuple[str, tuple[Parameter, ...]] | None:
    """The name of a function and its parameters; None where the head is none of a function."""
    text = re.sub(r"\s+", " ", head).strip()
    closure = re.search(r"(?:(?P<name>\w+)\s*(?::[^=]*)?=\s*)?(?:move\s*)?\|(?P<of>[^|]*)\|\s*(?:->.*)?$", text)
    if closure:
        return closure["name"] or "", parameters_of(closure["of"])
    if text.endswith("=>"):
        return _arrow(text[:-2].strip())
    is_go = re.match(r"func\s*\(\s*\w+\s+\*?\w+\s*\)\s*\w+", text)
    at = text.find("(", closing(text, text.find("(")) + 1) if is_go else text.find("(")
    attribute = re.match(r"\[[^\]]*\]\s*(?=\w)", text)
    if attribute and not is_go and at < attribute.end():
        return None
    end = closing(text, at) if at >= 0 else -1
    if end < 0:
        return None
    name = re.search(r"(?P<name>[\w~]+)\s*(?:<[^<>]*>\s*)?$", text[:at])
    assigned = re.search(r"(\w+)\s*(?::[^=]*)?=\s*(?:\[[^\]]*\]|(?:async )?function\b.*)\s*$", text[:at])
    given = assigned[1] if assigned else name["name"] if name else ""
    return given, parameters_of(text[at + 1 : end], by_go=text.startswith("func "))


def _arrow(text: str) -> tuple[str, tuple[Parameter, ...]] | None:
    """f = (t, y), f = y, double F(double t)."""
    single = re.search(r"(?:(?P<name>\w+)\s*=\s*|[(,=]\s*|^)(?P<of>\w+)$", text)
    if single:
        return single["name"] or "", (Parameter(single["of"]),)
    found = re.search(r"(?:(?P<name>\w+)\s*(?::[^=]*)?=\s*(?:async\s*)?|(?P<direct>\w+)\s*|[(,=\s]|^)(?=\()", text)
    while found:
        at = found.end()
        end = closing(text, at)
        if end > 0 and re.fullmatch(r"\s*(?::.*)?", text[end + 1 :]):
            return found["name"] or found["direct"] or "", parameters_of(text[at + 1 : end])
        found = re.compile(r"(?P<name>$^)?(?P<direct>\w+)?\s*(?=\()").search(text, at + 1)
    return None


def parameters_of(text: str, by_go: bool = False) -> tuple[Parameter, ...]:
    """The parameters between the brackets of a head."""
    flat = _without_angles(text)
    found: list[Parameter] = []
    for part in parts_of(flat, ","):
        bare = re.sub(r"(?<![=!<>])=(?![=>]).*$", "", part, flags=re.DOTALL).strip()
        if not bare or bare in ("self", "&self", "&mut self", "void", "this", "*", "/", "..."):
            continue
        one = _parameter(bare, by_go)
        if one:
            found.append(one)
    if by_go:  # t, y float64: the type of both
        kinds = list(found)
        for k in range(len(kinds) - 2, -1, -1):
            if not kinds[k].kind:
                kinds[k] = Parameter(kinds[k].name, kinds[k + 1].kind)
        found = kinds
    return tuple(found)


def _parameter(bare: str, by_go: bool) -> Parameter | None:  # noqa: PLR0911 -- one for each way to write it
    if bare[0] in "[{" and bare[-1] in "]}":
        return Parameter("[" + bare[1:-1].strip() + "]", "array" if bare[0] == "[" else "fields")
    colon = BY_COLON.match(bare)
    if colon:
        names = colon["names"].strip()
        if names[0] in "[{":
            return Parameter("[" + names[1:-1].strip() + "]", "array" if names[0] == "[" else "fields")
        name = names.split()[-1]
        return Parameter(name, _kind(re.sub(r"^(?:&\s*)?(?:mut\s+|inout\s+)?", "", colon["type"].strip())))
    if by_go:
        go = GO.match(bare)
        return Parameter(go["name"], _kind(go["type"])) if go else Parameter(bare) if bare.isidentifier() else None
    bare = re.sub(rf"^(?:{WORDS}\s+)+", "", bare)
    if bare.isidentifier():
        return None if NUMBER_TYPE.match(bare) and len(bare) > 1 else Parameter(bare)
    found = C.match(bare)
    if found is None:
        return None
    kind = _kind(re.sub(rf"\b{WORDS}\b", " ", found["type"]).strip() + (" *" if found["many"] else ""))
    return Parameter(found["name"], kind)


def _kind(of: str) -> str:
    if LIST_TYPE.search(of):
        return "array"
    return "number" if NUMBER_TYPE.match(of.strip()) else ""


def _without_angles(text: str) -> str:
    """Types without what stands in their angle brackets, which may have commas; a list's keeps that it is one."""
    for _ in range(6):
        changed = re.sub(r"(?<=[\w>])\s*<[^<>()]*>", "", text)
        if changed == text:
            break
        text = changed
    return text
