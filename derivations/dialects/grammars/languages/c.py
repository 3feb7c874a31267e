"""C, C++, Arduino's and shaders' GLSL, by C++'s grammar."""

import re

from .language import Language

GLSL = Language(
    "GLSL", "tree_sitter_cpp",
    re.compile(r"\b(?:vec[234]|mat[234]|uniform|dvec[234])\b"),
    not_if=re.compile(r"\bglm\b|#include|std::|=>|\bfn\s"),
    by_columns=True, copies=True,
    blank=re.compile(r"\b(?:uniform|varying|highp|mediump|lowp|in|inout|attribute|flat)\b(?=\s+\w+\s+\w)"
                     r"|(?m:^\s*#version[^\n]*$)|(?m:^\s*precision\s+\w+\s+\w+;)"),
)  # fmt: skip
C = Language(
    "C++", "tree_sitter_cpp",
    re.compile(r"\b(?:double|float|void|auto|int|real_t|realtype|sunrealtype)\b[^\n=;]*[\w>&*\])]|#include|\bstruct\b|#define"),
    not_if=re.compile(r"\bfn\s+\w+|(?m:^\s*(?:\w+\s+)?func?\s+\w+\s*\((?!\s*(?:double|int|float|const|void)\b))|\bfun\s+\w+\s*\(|=>|\bfunction\b|\bdef\s|\bMath\.|\bMathf?\.|\bvar\s|\bval\s|\blet\s"),
    copies=True, wraps=(("", ""), ("void wrapped() {\n", "\n}"), ("class Wrapped {\n", "\n};")),
)  # fmt: skip
