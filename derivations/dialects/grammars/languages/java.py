"""Java and Processing, by Java's grammar."""

import re

from .language import Language

JAVA = Language(
    "Java", "tree_sitter_java",
    re.compile(r"\b(?:double|float|void|int|PVector|public|private)\b"),
    not_if=re.compile(r"\bMath\.(?:Sin|Cos)|Mathf\.|\busing\s|#include|\bfn\s|\bfunc\s|\bfun\s|\bstruct\b|\bfunction\b|std::|&|\bnamespace\b|\bimport\s+'|\bvar\s*\(|"
                      r"\blate\b|\w->\w|\bvec[234]\b|\bdef\s|\boverride\b|\bvirtual\b|\bconst\b"),
    wraps=(("class Wrapped {\n", "\n}"), ("", "")),
)  # fmt: skip
