"""C#, Unity's too."""

import re

from .language import Language

CSHARP = Language(
    "C#", "tree_sitter_c_sharp",
    re.compile(r"\bMath\.(?:Sin|Cos|Pow|Sqrt|SinCos)|\bMathf?F?\.(?:Sin|Cos)|\busing\s+[A-Z]\w*|\bnamespace\s+\w+|\bpublic\s+(?:override|readonly)\b"),
    not_if=re.compile(r"\bmath\.(?:Sin|Cos)|\bfunc\s|#include"),
    wraps=(("class Wrapped {\n", "\n}"), ("", "")),
)  # fmt: skip
