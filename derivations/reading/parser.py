"""Reads the tokens of a line into a tree: sums, products, powers, calls of cos, sin and tan. Nothing is evaluated.

equation  = sum "=" sum
sum       = ["+"|"-"] product { ("+"|"-") product }
product   = factor { ["*"|"/"] factor }              side by side is a product; / takes one factor, as in Python
factor    = ("+"|"-") factor | primary [ "^" whole number ]
primary   = number | symbol | "(" sum ")" | call | "\\frac" group group
          | "[" rows "]" | "\\begin{bmatrix}" rows "\\end{bmatrix}"
          | "|" sum "|"
          | ("d/dt" "(" sum ")" | "diff" "(" sum "," "t" ")")
call      = ("cos"|"sin"|"tan"|"sec"|"csc"|"cot"|"sgn"|"abs") [ "^" whole number ] ( "(" sum ")" | [number] symbol )
          | "sqrt" "(" sum ")"
"""

from __future__ import annotations

from dataclasses import dataclass, field

from flint import fmpq

from .nodes import Call, Determinant, Inverse, Matrix, Name, Node, Number, Power, Product, Rate, Root, Sum, Symbol
from .tokens import CLOSING, FASTER, OPENING, Token, fail, tokenize
from .vocabulary import Vocabulary

DEEPEST = 60  # brackets within brackets
LARGEST_POWER = 12
LOST_POWERS = ("2", "3", "4")  # what a copied page makes of x² where it has nothing for a high figure
SIDE_BY_SIDE = ("symbol", "function", "open", "fraction", "number", "name", "matrix")  # a product without a sign


@dataclass
class Slashes:
    """How ``3g/2l`` is read: 0 as typed, (3g/2)·l, as in Python; 1: 3g/(2l), where the top is more than a number;
    2: also 1/2l as 1/(2l); 3: also with a blank, 3g/2 l. ``doubtful``: from where to where these readings differ; in
    the modes above 0 only what is read otherwise than typed.
    """

    mode: int = 0
    doubtful: list[tuple[int, int]] = field(default_factory=list)


def parse_expression(
    line: str, names: frozenset[str] = frozenset(), words: Vocabulary | None = None, slashes: Slashes | None = None
) -> Node:
    """The tree of an expression without an equals sign. ``names`` are the file's own definitions."""
    parser = _Parser(line, names, words, slashes)
    node = parser.sum(0)
    parser.expect_end("an equals sign is not expected here" if parser.next.text == "=" else "")
    return node


def parse_equation(
    line: str, names: frozenset[str] = frozenset(), words: Vocabulary | None = None, slashes: Slashes | None = None,
    *, alone: bool = False,
) -> tuple[Node, Node]:  # fmt: skip
    """The trees of both sides of an equation; of the rows that computer algebra prints as a list, and 0.

    ``alone``: there is one coordinate, so that a row with its acceleration is no right-hand side.
    """
    parser = _Parser(line, names, words, slashes)
    left = parser.sum(0)
    if parser.next.text != "=":
        parser.expect_end("")
        if not ((alone or isinstance(left, Matrix)) and _accelerates(left)):
            fail(parser.next.at, "an equation needs an equals sign; put '= 0' behind it")
        return left, Number(fmpq(0), parser.next.at)
    parser.advance()
    right = parser.sum(0)
    parser.expect_end("a second equals sign; one equation a row" if parser.next.text == "=" else "")
    return left, right


class _Parser:
    def __init__(self, line: str, names: frozenset[str], words: Vocabulary | None, slashes: Slashes | None) -> None:
        self.tokens = tokenize(line, names, words)
        self.slashes = slashes or Slashes()
        self.place = 0
        self.is_latex = "\\" in line  # where a power is typed, and none is lost
        self.in_bars = False
        self.blanks: list[int] = []  # where things stand side by side, with a blank between

    @property
    def next(self) -> Token:
        return self.tokens[self.place]

    def sees(self, kind: str) -> bool:
        """Whether a token of this kind comes next."""
        return self.next.kind == kind

    def advance(self) -> Token:
        token = self.tokens[self.place]
        self.place += 1
        return token

    def sees_times(self) -> bool:
        """Whether a sign of multiplication comes next."""
        return self.next.kind == "operator" and self.next.text == "*"

    def expect_end(self, why: str) -> None:
        token = self.next
        if token.kind != "end":
            if not why:
                why = (
                    "this closing bracket was never opened"
                    if token.kind == "close"
                    else f"{token.text!r} is not expected here"
                )
            fail(token.at, why)

    def sum(self, depth: int) -> Node:
        at = self.next.at
        if depth > DEEPEST:
            fail(at, f"more than {DEEPEST} brackets within one another")
        parts: list[tuple[int, Node]] = []
        sign = 1
        while True:
            parts.append((sign, self.product(depth)))
            if self.next.kind != "operator" or self.next.text not in ("+", "-"):
                break
            sign = 1 if self.advance().text == "+" else -1
        node = parts[0][1] if len(parts) == 1 else Sum(tuple(parts), at)
        if self.next.kind == "operator" and self.next.text == "over":  # TeX's {a \\over b}
            self.advance()
            return Product(((True, node), (False, self.sum(depth + 1))), at)
        return node

    def product(self, depth: int) -> Node:
        at = self.next.at
        parts: list[tuple[bool, Node]] = [(True, self.factor(depth))]
        while True:
            token = self.next
            if token.kind == "operator" and token.text == "left":  # MATLAB's A \\ b
                self.advance()
                before = parts[0][1] if len(parts) == 1 else Product(tuple(parts), at)
                parts = [(True, Inverse(before, token.at, left=True)), (True, self.factor(depth))]
            elif token.kind == "operator" and token.text in ("*", "/"):
                self.advance()
                parts.append((token.text == "*", self.factor(depth)))
                if token.text == "/":
                    self.below(parts, depth)
            elif token.kind in SIDE_BY_SIDE or (token.kind == "bar" and not self.in_bars):
                if token.kind == "number" and isinstance(parts[-1][1], Number):
                    fail(token.at, "two numbers side by side; write * between them")
                last = self.tokens[self.place - 1]
                if self.may_be_power(token, last):
                    fail(
                        token.at,
                        f"{token.text} behind a factor: a power printed high, or a factor? Write ^ or * before it",
                    )
                if token.at > last.end:
                    self.blanks.append(token.at)
                parts.append((True, self.factor(depth)))
            else:
                break
        return parts[0][1] if len(parts) == 1 else Product(tuple(parts), at)

    def may_be_power(self, figure: Token, last: Token) -> bool:
        """Whether a figure behind a factor may be a high one of a page that was copied as plain text."""
        return figure.kind == "number" and figure.text in LOST_POWERS and last.kind != "number" and not self.is_latex

    def below(self, parts: list[tuple[bool, Node]], depth: int) -> None:
        """Behind ``a/2``: whether a symbol at once behind the number belongs below as well is the author's secret."""
        number = self.tokens[self.place - 1]
        while number.kind == "number" and self.next.kind in ("symbol", "name"):
            blank = self.next.at > self.tokens[self.place - 1].end
            alone = all(isinstance(part, Number) for above, part in parts if above)
            needed = 3 if blank else 2 if alone else 1
            here = (parts[0][1].at, self.next.end)
            if self.slashes.mode < needed:
                self.slashes.doubtful += [here] if not self.slashes.mode else []
                return
            self.slashes.doubtful.append(here)
            parts.append((False, self.factor(depth)))

    def factor(self, depth: int) -> Node:
        at, sign = self.next.at, 1
        while self.next.kind == "operator" and self.next.text in ("+", "-"):
            sign = sign if self.advance().text == "+" else -sign
        node = self.powered(self.primary(depth))
        return node if sign > 0 else Sum(((-1, node),), at)

    def powered(self, base: Node) -> Node:
        token = self.next
        if token.kind != "operator" or not token.text.startswith("^"):
            return base
        self.advance()
        node = Power(base, self.exponent(token), token.at)
        if self.next.kind == "operator" and self.next.text.startswith("^"):
            fail(self.next.at, "a power of a power; put brackets around the first")
        return node

    def exponent(self, token: Token) -> int:
        """The whole number behind a ``^`` (or the superscript that it was)."""
        if len(token.text) > 1:
            return _bounded(int(token.text[1:]) if len(token.text) < 6 else LARGEST_POWER + 1, token.at)
        opened = self.advance() if self.next.kind == "open" else None
        sign = 1
        if self.next.kind == "operator" and self.next.text in ("+", "-"):
            sign = -1 if self.advance().text == "-" else 1
        figure = self.next
        if figure.kind != "number":
            fail(figure.at, "a power must be a whole number")
        self.advance()
        if opened is not None:
            self.close(opened)
        if figure.value.q != 1:
            fail(figure.at, f"the power {figure.text} is not a whole number")
        return _bounded(sign * int(min(figure.value.p, LARGEST_POWER + 1)), figure.at)

    def close(self, opened: Token) -> None:
        token = self.next
        if token.kind != "close" or token.text != OPENING[opened.text]:
            found = "the line ends" if token.kind == "end" else f"found {token.text!r}"
            fail(
                token.at,
                f"{OPENING[opened.text]!r} is missing for the {opened.text!r} of column {opened.at + 1}; {found}",
            )
        self.advance()

    def group(self, depth: int) -> Node:
        opened = self.advance()
        if self.next.kind == "close" and self.next.text in CLOSING:
            fail(self.next.at, "nothing between the brackets")
        node = self.sum(depth + 1)
        if opened.text == "[" and self.next.kind == "separator" and self.next.text in ",;":
            return self.brackets(opened, depth, node)
        self.close(opened)
        return node

    def brackets(self, opened: Token, depth: int, first: Node) -> Node:
        """[a, b; c, d] of MATLAB, [[a, b], [c, d]] of Python; one list is a column. ``first``: what stands first."""
        rows: list[list[Node]] = [[first]]
        while self.next.kind == "separator" and self.next.text in ",;":
            if self.advance().text == ";":
                rows.append([])
            if self.sees("close"):
                rows = [row for row in rows if row]
                break
            rows[-1].append(self.sum(depth + 1))
        self.close(opened)
        blank = next((at for at in self.blanks if at > opened.at), None)
        if len(rows) > 1 and len(rows[0]) == 1 and blank is not None:
            fail(blank, "this blank may stand for a product or for the next entry of the matrix; write * or a comma")
        if len(rows) == 1 and all(isinstance(x, Matrix) for x in rows[0]):  # columns, which are meant as rows
            inner = [x for x in rows[0] if isinstance(x, Matrix)]
            return self.checked([[entry for entries in x.rows for entry in entries] for x in inner], opened.at)
        if len(rows) == 1:
            rows = [[x] for x in rows[0]]
        return self.checked(rows, opened.at)

    def matrix(self, depth: int) -> Node:
        """The rows of a LaTeX matrix."""
        begun = self.advance()
        if depth > DEEPEST:
            fail(begun.at, f"more than {DEEPEST} brackets within one another")
        rows: list[list[Node]] = [[]]
        while True:
            rows[-1].append(self.sum(depth + 1))
            if self.next.kind != "separator":
                break
            if self.advance().text != "&":
                if self.sees("close"):
                    break
                rows.append([])
        if self.next.kind != "close" or not self.next.text.startswith("\\end"):
            fail(self.next.at, f"\\end{{{begun.text}}} is missing for the matrix of column {begun.at + 1}")
        self.advance()
        found = self.checked(rows, begun.at)
        return Determinant(found, begun.at) if begun.text == "vmatrix" else found

    def checked(self, rows: list[list[Node]], at: int) -> Matrix:
        if len({len(row) for row in rows}) != 1:
            fail(at, f"the rows of this matrix have {', '.join(str(len(row)) for row in rows[:6])} entries")
        return Matrix(tuple(tuple(row) for row in rows), at)

    def primary(self, depth: int) -> Node:  # noqa: PLR0911 -- one for each kind of token
        token = self.next
        match token.kind:
            case "number":
                self.advance()
                return Number(token.value, token.at)
            case "symbol":
                self.advance()
                return Symbol(token.text, token.index, token.at, token.less)
            case "name":
                self.advance()
                named: Node = Name(token.text, token.at)
                for _ in range(token.index):
                    named = Rate(named, token.at)
                return named
            case "open":
                return self.group(depth)
            case "matrix":
                return self.matrix(depth)
            case "function":
                return self.call(depth)
            case "bar" if not self.in_bars:
                return self.bars(depth)
            case "fraction":
                return self.fraction(depth)
            case "close":
                return fail(token.at, "this closing bracket was never opened, or something is missing before it")
            case "end":
                return fail(token.at, "the line ends where a term is expected")
            case _:
                return fail(token.at, f"a term is expected before {token.text!r}")

    def bars(self, depth: int) -> Node:
        """|x|, of a matrix its determinant; bars within bars cannot be told apart."""
        opened = self.advance()
        self.in_bars = True
        node = self.sum(depth + 1)
        if not self.sees("bar"):
            fail(self.next.at, f"the bar of column {opened.at + 1} is not closed")
        self.advance()
        self.in_bars = False
        return Determinant(node, opened.at) if isinstance(node, Matrix) else Call("abs", node, opened.at)

    def call(self, depth: int) -> Node:
        function = self.advance()
        if function.text == "inv":
            if self.next.kind != "open":
                fail(self.next.at, "inv needs a matrix in brackets, as in inv(M)")
            return Inverse(self.group(depth), function.at)
        if function.text == "det":
            if self.next.kind not in ("open", "matrix"):
                fail(self.next.at, "det needs a matrix, as in det(M)")
            return Determinant(self.primary(depth), function.at)
        if function.text == "solve":
            return self.solution(function, depth)
        if function.text in ("d/dt", "diff"):
            return self.rate(function, depth)
        if function.text == "sqrt":
            if self.next.kind != "open" or self.next.text == "[":
                fail(self.next.at, "a square root needs brackets or braces, as in sqrt(g/l) or \\sqrt{g/l}")
            return Root(self.group(depth), function.at)
        exponent = 1
        if self.next.kind == "operator" and self.next.text.startswith("^"):
            exponent = self.exponent(self.advance())
            if exponent < 0:
                fail(function.at, f"{function.text} to a negative power is ambiguous; write 1/{function.text}(…)")
        node: Node = Call(function.text, self.argument(function, depth), function.at)
        return node if exponent == 1 else Power(node, exponent, function.at)

    def solution(self, function: Token, depth: int) -> Node:
        """solve(A, b) of numpy: the inverse of A times b."""
        parts: list[Node] = []
        if self.next.kind == "open":
            opened = self.advance()
            parts.append(self.sum(depth + 1))
            if self.sees("separator"):
                self.advance()
                parts.append(self.sum(depth + 1))
                self.close(opened)
        if len(parts) < 2:
            fail(self.next.at, "solve needs a matrix and a column, as in np.linalg.solve(A, b)")
        return Product(((True, Inverse(parts[0], function.at)), (True, parts[1])), function.at)

    def rate(self, function: Token, depth: int) -> Node:
        """d/dt (…), and diff(…, t) of computer algebra."""
        if self.next.kind != "open":
            fail(self.next.at, "put brackets around what d/dt acts on, as in d/dt(m l^2 θ')")
        if function.text == "d/dt":
            return self.derived(self.group(depth), function.at)
        opened = self.advance()
        base = self.sum(depth + 1)
        behind = self.tokens[self.place : self.place + 2]
        if [x.kind for x in behind] != ["separator", "symbol"] or behind[1].text != "t" or behind[1].index:
            fail(self.next.at, "a derivative with respect to time is read, diff(…, t); take others yourself")
        self.place += 2
        self.close(opened)
        return self.derived(base, function.at)

    def derived(self, base: Node, at: int) -> Node:
        """Of a symbol alone, the symbol of its derivative."""
        if isinstance(base, Symbol) and base.letter in FASTER:
            return Symbol(FASTER[base.letter], base.index, at, base.less)
        return Rate(base, at)

    def argument(self, function: Token, depth: int) -> Node:
        if self.next.kind == "open":
            return self.group(depth)
        if depth >= DEEPEST:
            fail(self.next.at, f"more than {DEEPEST} brackets within one another")
        parts: list[tuple[bool, Node]] = []
        if self.next.kind == "number":
            token = self.advance()
            parts.append((True, Number(token.value, token.at)))
            if self.sees_times():
                self.advance()
        if self.next.kind == "fraction" and not parts:
            return self.fraction(depth)
        if self.next.kind not in ("symbol", "name"):
            fail(self.next.at, f"{function.text} needs an angle, as in {function.text}(t1)")
        parts.append((True, self.primary(depth)))
        return parts[0][1] if len(parts) == 1 else Product(tuple(parts), function.at)

    def fraction(self, depth: int) -> Node:
        token = self.advance()
        top, bottom = self.fraction_part(token, depth), self.fraction_part(token, depth)
        return Product(((True, top), (False, bottom)), token.at)

    def fraction_part(self, fraction: Token, depth: int) -> Node:
        if self.next.kind == "open" and self.next.text == "{":
            return self.group(depth)
        if self.next.kind == "number" and len(self.next.text) == 2 and self.next.text.isdigit():
            # \frac12: each digit is a part of its own
            token = self.next
            self.tokens[self.place] = Token("number", token.text[1], token.at + 1, value=fmpq(int(token.text[1])))
            return Number(fmpq(int(token.text[0])), token.at)
        if self.next.kind in ("number", "symbol"):
            return self.primary(depth)
        return fail(self.next.at, f"{fraction.text} needs two parts in braces: {fraction.text}{{…}}{{…}}")


def _accelerates(node: Node) -> bool:
    """Whether accelerations occur, in every entry of a matrix: then it is a row, and no right-hand side."""
    match node:
        case Symbol(letter=letter):
            return letter == "a"
        case Sum(parts=parts) | Product(parts=parts):
            return any(_accelerates(part) for _, part in parts)
        case Matrix(rows=rows):
            return all(_accelerates(entry) for row in rows for entry in row)
    return False


def _bounded(exponent: int, at: int) -> int:
    if abs(exponent) > LARGEST_POWER:
        fail(at, f"a power beyond ±{LARGEST_POWER}; no equation of motion has one")
    return exponent
