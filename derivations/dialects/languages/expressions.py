# ruff: noqa: E501 -- patterns stand on one line
"""Expressions of many languages in the words of one: casts, suffixes of numbers, modules, lists, methods of matrices."""

from __future__ import annotations

import re

from ....models.errors import InvalidInput
from ..markup.calls import closing, parts_of

MODULE = re.compile(
    r"(?<![\w.])(?:std::|Math\.|MathF\.|Mathf\.|math\.|cmath\.|Foundation\.|kotlin\.math\.|std\.math\.|glm::|boost::math::|f64::|f32::|libm::|casadi::|THREE\.MathUtils\.|p5\.|mathjs\.|numeric\.|Base\.)(?=[A-Za-z_])"
)
CAPITAL = re.compile(r"(?<![\w.])(?:Sin|Cos|Tan|Sqrt|Pow|Abs|Square|SIN|COS|TAN|SQRT|POW)(?=\s*\()")
SINGLE = re.compile(r"(?<![\w.])(?P<f>sin|cos|tan|sqrt|pow|fabs)(?:f|l)(?=\s*\()")
DOUBLE = re.compile(r"(?<![\w.])[dD](?=(?:sin|cos|tan|sqrt|SIN|COS|TAN|SQRT)\s*\()")
CAST = re.compile(
    r"(?:static_cast|reinterpret_cast|const_cast)\s*<[^<>]*(?:<[^<>]*>)?[^<>]*>\s*(?=\()|\(\s*(?:const\s+)?(?:double|float|real|real_t|realtype|sunrealtype|f64|f32|value_type|Scalar|T)\s*(?:const\s*)?\*?\s*\)\s*(?=[\w(.-])|(?<![\w.])(?:double|float|float64|float32|f64::from|Double|CGFloat|Float|REAL|real|dble|DBLE|T|Number|parseFloat|Scalar)(?=\s*\()|(?<=[\w)\]])\s+as\s+(?:f64|f32|Double|number)\b"
)
SUFFIX = re.compile(
    r"(?<![\w.])(?P<n>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)(?:_?f(?:64|32)|[fFlL]|_(?:dp|sp|wp|rk|8|4|real64|rp|r8|kind))(?![\w])"
)
NUMBER_D = re.compile(r"(?<![\w.])(?P<m>[0-9]+\.?[0-9]*|\.[0-9]+)[dD](?P<e>[+-]?[0-9]+)(?![\w])")
PI = re.compile(r"(?<![\w.])(?:M_PI|PI|Pi|std::numbers::pi|consts::PI)(?![\w(])")
SQUARE = re.compile(r"(?<![\w.])(?:sq|sqr|SQR|SQ|Sqr|square|pow2|gsl_pow_2|Square)\s*\(")
POWERS = re.compile(r"(?<![\w.])(?:gsl_pow_(?P<gsl>[2-4])|gsl_pow_int|powi|ipow|int_pow|powr|power|Power)\s*\(")
OWN = re.compile(r"(?<![\w.])(?:\(\s*\*\s*this\s*\)\.|this\s*(?:->|\.)|self\s*\.|Self::|@(?=[A-Za-z]))")
LIST = re.compile(
    r"(?:new\s+[\w.:]+\s*(?:<[^<>]*>)?\s*(?:\[\s*\d*\s*\]|\(\s*\))*\s*\{|(?<![\w.])(?:vec!|array!|nd::array!|dvector!|vector!)\s*\[|\[\s*(?:\d+|\.\.\.)?\s*\](?:float64|float32|f64)\s*\{|(?<![\w.])(?:std::array|std::vector|array|vector|valarray|std::valarray|State|Vec|state_type|state_t|Array)\s*(?:<[^<>]*>)?\s*\{"
    r"|(?<![\w.])(?:Eigen::|nalgebra::|na::|glm::|std::|DVector::|mat::|blaze::|arma::|new\s+|numeric\.)?(?:[Vv]ector[2-9]?[dfX]?|Vector\d*(?:<[^<>]*>)?|[Vv]ec\d?|dvec\d|SVector(?:::<[^<>]*>)?|State|Vector\dd?|make_tuple|make_array|List|Array|Float64Array|PVector|createVector|tuple|Tuple|arrayOf|doubleArrayOf|listOf|mutableListOf|floatArrayOf|matrix|StaticArray|Vec\d?)(?:\s*<[^<>]*>)?(?:\s*(?:::|\.)\s*(?:new|from|of|from_slice|asList|Build\.Dense|OfArray|from_row_slice|from_vec))?\s*\(|(?<![\w.])(?:Arrays\.asList|List\.of|DVector::from_vec|DVector::from|Ok|Some|Array1::from|arr1|Vector\.Create|CreateVector\.DenseOfArray|Vector<double>\.Build\.Dense\w*)\s*\()"
)
MATRIX = re.compile(
    r"(?<![\w.])(?:Eigen::|nalgebra::|na::|new\s+)?(?:[Mm]atrix(?P<n>[2-4])?[dfX]?|SMatrix)(?:<[^<>]*>)?(?:::<[^<>]*>)?::(?:new|from_row_slice)\s*\(\s*(?:&\s*\[)?"
)
PLAIN_BRACE = re.compile(r"(?<![\w\]>)])\s*\{")
SOLVED = re.compile(
    r"(?P<m>[A-Za-z_]\w*)\s*\.\s*(?:ldlt|llt|lu|partialPivLu|fullPivLu|colPivHouseholderQr|householderQr|completeOrthogonalDecomposition|jacobiSvd|qr|cholesky|col_piv_qr)\s*\([^()]*\)\s*(?:\.\s*(?:unwrap|expect)\s*\([^()]*\)\s*)?\.\s*(?:solve|Solve)\s*\("
)
SOLVES = re.compile(
    r"(?<![\w.])(?:(?:arma::|math\.|numeric\.|linalg\.|la\.|mathjs\.)?(?:solve|lusolve|linsolve|solve_linear|mldivide|Solve|gauss|LUsolve))\s*\((?=[^()]*,)"
)
METHOD_SOLVE = re.compile(r"(?P<m>[A-Za-z_]\w*)\s*\.\s*(?:solve|Solve)\s*\(")
INVERSE = re.compile(
    r"(?P<m>[A-Za-z_]\w*)\s*\.\s*(?:inverse|try_inverse|Inverse|inv|i)\s*\(\s*\)(?:\s*\.\s*(?:unwrap|expect|eval)\s*\([^()]*\))?|(?<![\w.])(?:arma::|Eigen::|math\.|numeric\.|glm::|mat::)?(?:inverse|inv|Inverse)\s*(?=\()"
)
UNWRAPPED = re.compile(
    r"\s*\.\s*(?:unwrap|eval|transpose_in_place|clone|toArray|ToArray|into|to_vec|to_owned|matrix|array|as_slice|normalized_copy)\s*\(\s*\)|\s*\?(?=\s*$)"
)
AT = re.compile(
    r"(?P<x>[A-Za-z_]\w*)\s*(?:\.|->)\s*(?:at|get|element|getEntry|coeff|coeffRef|operator\[\])\s*\(\s*(?P<i>\d+)\s*(?:,\s*(?P<j>\d+)\s*)?\)"
)
HEAD = re.compile(
    r"(?P<x>[A-Za-z_]\w*)\.(?:template\s+)?(?P<which>head|tail|segment|topRows|bottomRows)\s*(?:<\s*(?P<n>\d)\s*>)?\s*\((?P<of>[\d\s,]*)\)"
)
WHOLE = re.compile(r"(?P<before>[*/]\s*)?(?<![\w.])(?P<a>[0-9]+)\s*/\s*(?P<b>[0-9]+)(?![\w.])")
CALL_MUL = re.compile(
    r"(?P<a>[A-Za-z_]\w*)\s*\.\s*(?P<of>mul|times|multiply|mult|dot|Multiply|plus|add|minus|sub|subtract)\s*\("
)
OPERATIONS = {
    "mul": "*",
    "times": "*",
    "multiply": "*",
    "mult": "*",
    "dot": "@",
    "Multiply": "*",
    "plus": "+",
    "add": "+",
    "minus": "-",
    "sub": "-",
    "subtract": "-",
}
MOST = 200


def plain_expression(text: str, whole: bool, powers: tuple[str, ...]) -> str:
    """The expression in the reader's words. Raises InvalidInput for what means something else in its language."""
    text = re.sub(r"\s+", " ", text).strip()
    text = OWN.sub("", text)
    text = re.sub(r"(?<![\w.])(?:std::f(?:64|32)::)?consts::PI\b", "PI", text)
    text = CAST.sub("", MODULE.sub("", CAST.sub("", text)))
    text = NUMBER_D.sub(lambda m: f"{m['m']}e{m['e']}", text)
    text = SUFFIX.sub(lambda m: m["n"], text)
    text = DOUBLE.sub("", text)
    text = CAPITAL.sub(lambda m: m[0].lower(), text)
    text = SINGLE.sub(lambda m: m["f"], text)
    text = PI.sub("pi", text)
    _check(text, whole, powers)
    text = parts_of_vectors(text)
    text = AT.sub(lambda m: f"{m['x']}[{m['i']}]" + (f"[{m['j']}]" if m["j"] else ""), text)
    text = _called(text, SQUARE, lambda inner: f"(({inner})**2)")
    text = _powers_by_name(text)
    text = _matrices(text)
    text = _lists(text)
    text = UNWRAPPED.sub("", text)
    text = _solved(text)
    text = INVERSE.sub(lambda m: f"inv({m['m']})" if m["m"] else "inv", text)
    return _products(text)


def parts_of_vectors(text: str) -> str:
    """x.head(2), x.tail<2>(), x.segment(1, 2) of Eigen as x[0:2], x[-2:], x[1:3]."""

    def part(found: re.Match[str]) -> str:
        inside = [int(k) for k in re.findall(r"\d+", (found["of"] or "") + " ")]
        n = [int(found["n"])] if found["n"] else []
        match found["which"]:
            case "head" | "topRows":
                return f"{found['x']}[0:{(n + inside)[0]}]"
            case "tail" | "bottomRows":
                return f"{found['x']}[-{(n + inside)[0]}:]"
        start, size = (inside[0], n[0]) if n else (inside[0], inside[1])
        return f"{found['x']}[{start}:{start + size}]"

    return HEAD.sub(part, text)


def _check(text: str, whole: bool, powers: tuple[str, ...]) -> None:
    found = WHOLE.search(text) if whole else None
    while found:
        if not found["before"] and int(found["b"]) and int(found["a"]) % int(found["b"]):
            raise InvalidInput(f"{found['a']}/{found['b']} is a division of whole numbers, {int(found['a']) // int(found['b'])} "
                               f"in this language; write {found['a']}.0/{found['b']}.0 if the fraction is meant")  # fmt: skip
        found = WHOLE.search(text, found.end())
    for sign, words in (("^", "write pow(x, 2) if a power is meant"), ("**", "write pow(x, 2) if a power is meant")):
        if sign in text and sign not in powers:
            raise InvalidInput(f"{sign} is no power in this language; {words}")
    other = re.search(r"%|\?[^.]|&&|\|\||>>|(?<![<])<(?![<\w])|(?<!-)>(?![\w(])", text)
    if other and "::" not in text:
        raise InvalidInput(
            f"{text[:40]!r}: {other[0].strip()} is no operation of mechanics; write out what it comes to"
        )


def _called(text: str, pattern: re.Pattern[str], made) -> str:  # type: ignore[no-untyped-def]
    at = 0
    for _ in range(MOST):
        found = pattern.search(text, at)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        text = f"{text[: found.start()]}{made(text[found.end() : end])}{text[end + 1 :]}"
        at = found.start()
    return text


def _powers_by_name(text: str) -> str:
    at = 0
    for _ in range(MOST):
        found = POWERS.search(text, at)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        parts = parts_of(text[found.end() : end], ",")
        exponent = found["gsl"] or (parts[1] if len(parts) == 2 else "")
        at = found.end()
        if exponent:
            text = f"{text[: found.start()]}(({parts[0]})**{exponent}){text[end + 1 :]}"
            at = found.start()
    return text


def _lists(text: str) -> str:
    """new double[] {a, b}, vec![a, b], Vector4d(a, b, c, d), {a, b} as [a, b]."""
    for _ in range(MOST):
        found = LIST.search(text) or PLAIN_BRACE.search(text)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        inner = text[found.end() : end].strip().rstrip(",")
        parts = parts_of(inner, ",")
        if len(parts) == 1 and inner[:1] in "[{(" and closing(inner, 0) == len(inner) - 1:
            inner = inner[1:-1] if inner[0] != "(" or len(parts_of(inner[1:-1], ",")) > 1 else inner
        before = " " if found.re is PLAIN_BRACE else ""
        text = f"{text[: found.start()]}{before}[{inner}]{text[end + 1 :]}"
    return text


def _matrices(text: str) -> str:
    """Matrix2::new(a, b, c, d) of nalgebra, row by row."""
    for _ in range(MOST):
        found = MATRIX.search(text)
        opened = text.find("(", found.start()) if found else -1
        end = closing(text, opened) if found else -1
        if found is None or end < 0:
            return text
        inner = text[found.end() : end].rstrip("] ")
        parts = parts_of(inner, ",")
        size = {4: 2, 9: 3, 16: 4}.get(len(parts))
        if size is None:
            return text
        text = f"{text[: found.start()]}{in_rows(parts, size)}{text[end + 1 :]}"
    return text


def in_rows(parts: list[str], width: int) -> str:
    """The entries of a matrix, row by row, as a list of lists."""
    rows = [parts[k : k + width] for k in range(0, len(parts), width)]
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in rows) + "]"


def _solved(text: str) -> str:
    """M.ldlt().solve(b) as solve(M, b)."""
    for pattern in (SOLVED, METHOD_SOLVE):
        for _ in range(MOST):
            found = pattern.search(text)
            end = closing(text, found.end() - 1) if found else -1
            if found is None or end < 0 or found["m"] in ("linalg", "la", "math", "numeric"):
                break
            inner = text[found.end() : end].strip().lstrip("&")
            text = f"{text[: found.start()]}solve({found['m']}, {inner}){text[end + 1 :]}"
    return SOLVES.sub("solve(", text)


def _products(text: str) -> str:
    """M.mul(v) as (M*(v)): of what is a matrix or a vector."""
    for _ in range(MOST):
        found = CALL_MUL.search(text)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        inner = text[found.end() : end]
        text = f"{text[: found.start()]}({found['a']} {OPERATIONS[found['of']]} ({inner})){text[end + 1 :]}"
    return text
