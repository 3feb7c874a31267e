"""Says an equation back as it was read: one notation, the author's letters, nothing multiplied out."""

from __future__ import annotations

from ..algebra.notation import SUBSCRIPTS, SUPERSCRIPTS
from .nodes import Call, Determinant, Inverse, Matrix, Name, Node, Number, Power, Product, Rate, Root, Sum, Symbol
from .vocabulary import Vocabulary

LONGEST = 600  # characters that are said back of one line
LETTERS = {
    "t": "θ",
    "w": "θ̇",
    "a": "θ̈",
    "l": "l",
    "m": "m",
    "g": "g",
    "r": "ρ",
    "I": "I",
    "c": "l_c",
    "p": "π",
    "P": "p",
    "D": "p\u0307",
}
DOTS = {"w": "\u0307", "a": "\u0308"}


class Typesetter:
    """Writes trees with one author's letters."""

    def __init__(self, words: Vocabulary) -> None:
        self.letters = dict(LETTERS)
        self.single: dict[int, tuple[str, str]] = {}  # a coordinate's letter and index
        for word in sorted((*words.fixed, *words.numbers), key=lambda w: (len(w) == 1, w == "θ", w == "φ")):
            if word in words.fixed:
                self.single[words.fixed[word][1]] = (word, "")
            else:
                self.single |= {k: (word, _low(i)) for i, k in words.numbers[word].items()}
        self.counted = {number: letter for letter, number in words.indices.items()}
        for written, meant in words.said:
            if meant == "angle":
                self._angles(written)
            elif meant == "momentum":
                self.letters |= {"P": written, "D": written + DOTS["w"]}
            elif meant == "rate of the angle":
                self.letters |= {"w": written, "a": written + DOTS["w"]}
            elif meant.startswith("θ") and meant[1:].isdigit():
                self.single[int(meant[1:])] = (written, "")
            elif meant in self.letters and not written.startswith("index"):
                self.letters[meant] = written

    def _angles(self, letter: str) -> None:
        self.letters |= {"t": letter, "w": letter + DOTS["w"], "a": letter + DOTS["a"]}

    def equation(self, sides: tuple[Node, ...]) -> str:
        """Both sides, or an expression alone."""
        text = " = ".join(self.text(side) for side in sides)
        return text if len(text) <= LONGEST else text[:LONGEST] + " …"

    def text(self, node: Node, inside: int = 0) -> str:  # noqa: PLR0911, PLR0912 -- one for each kind of node
        """``inside``: 0 anything may stand bare; 1, in a sum: all but sums; 2, in a product: no fractions; 3: none."""
        match node:
            case Number(value=value):
                return str(value) if value.q == 1 or inside < 3 else f"({value})"
            case Symbol():
                return self._symbol(node)
            case Name(text=text):
                return text
            case Sum(parts=parts):
                out = " ".join(("+ " if sign > 0 else "− ") + self.text(part, 1) for sign, part in parts)
                out = out.removeprefix("+ ")
                if out.startswith("− "):
                    out = "−" + out[2:]
                return f"({out})" if inside else out
            case Product(parts=parts):
                return self._product(parts, inside)
            case Power(base=base, exponent=exponent):
                if isinstance(base, Call):
                    return base.function + str(exponent).translate(SUPERSCRIPTS) + self.text(base)[len(base.function) :]
                return self.text(base, 3) + str(exponent).translate(SUPERSCRIPTS)
            case Call(function=function, argument=argument):
                return self._call(function, argument)
            case Matrix(rows=rows):
                return "[" + "; ".join(", ".join(self.text(entry) for entry in row) for row in rows) + "]"
            case Root(base=base):
                return f"√{self.text(base, 3)}"
            case Rate(base=Name(text=text)):
                return text + DOTS["w"]
            case Rate(base=base):
                return f"d/dt {self.text(base, 3)}"
            case Inverse(base=base):
                return self.text(base, 3) + "⁻¹"
            case Determinant(base=base):
                return f"det {self.text(base, 3)}"

    def _call(self, function: str, argument: Node) -> str:
        inner = self.text(argument)
        if function == "abs":
            return f"|{inner}|"
        return f"{function} {inner}" if isinstance(argument, Symbol) else f"{function}({inner})"

    def _product(self, parts: tuple[tuple[bool, Node], ...], inside: int) -> str:
        above = [(self.text(part, 2), part) for is_above, part in parts if is_above]
        below = [(self.text(part, 2), part) for is_above, part in parts if not is_above]
        if len(above) > 1 and above[0][0] == "1" and below:
            above = above[1:]
        top, bottom = _side_by_side(above) or "1", _side_by_side(below)
        if not bottom:
            return f"({top})" if inside > 2 else top
        if " " in bottom and not (len(below) == 1 and bottom.startswith("(")):
            bottom = f"({bottom})"
        return f"({top}/{bottom})" if inside > 1 else f"{top}/{bottom}"

    def _symbol(self, node: Symbol) -> str:
        if node.index in self.single and node.letter in "twa":
            letter, index = self.single[node.index]
            return letter + DOTS.get(node.letter, "") + index
        counted = self.counted if node.letter in "twa" else {}
        written = "".join(counted.get(k, str(k).translate(SUBSCRIPTS)) for k in (node.index, node.less) if k)
        return self.letters[node.letter] + written


def _low(index: str) -> str:
    return index.translate(SUBSCRIPTS) if index.isdigit() else f"_{index}"


def _side_by_side(parts: list[tuple[str, Node]]) -> str:
    """Factors with a blank between, and a point between numbers."""
    out = ""
    for place, (text, part) in enumerate(parts):
        numbers = place and isinstance(part, Number) and isinstance(parts[place - 1][1], Number)
        out += ("·" if numbers else " " if place else "") + text
    return out
