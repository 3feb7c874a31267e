"""JavaScript and TypeScript, by TypeScript's grammar."""

import re

from .language import Language

SCRIPT = Language(
    "JavaScript", "tree_sitter_typescript",
    re.compile(r"\bfunction\b|=>|\b(?:const|let|var)\s+[\w{\[]|\bthis\.|\binterface\b|\)\s*:\s*(?:number|void)"),
    function="language_typescript",
    not_if=re.compile(r"\bfn\s+\w+|\bfunc\s|\bfun\s|\blet\s+mut\b|#include|\b(?:private|public|static|void)\s+(?:static\s+)?(?:double|float|void|override)\b|"
                      r"\bend\b\s*$|\bdouble\s+\w|\bfloat\s+\w|\blocal\s|\bdef\s|:=|<-|\blist\s*\(|\bval\s"),
    wraps=(("", ""), ("class Wrapped {\n", "\n}")),
    whole=False, powers=frozenset({"**"}),
)  # fmt: skip
