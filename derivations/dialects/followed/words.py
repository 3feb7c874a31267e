# ruff: noqa: E501 -- patterns stand on one line
"""What the words of an expression stand for: entries of the state and of arrays, fields, helper functions."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from ....models.errors import InvalidInput
from ..languages.expressions import in_rows, plain_expression
from ..languages.program import ALLOCATED, RETURN, Function, Program, Statement
from ..markup.calls import closing, parts_of
from ..programs import methods

MATHS = (
    "sin",
    "cos",
    "tan",
    "sqrt",
    "pow",
    "abs",
    "fabs",
    "inv",
    "solve",
    "sign",
    "sgn",
    "transpose",
    "tanh",
    "matmul",
)
WORD = re.compile(
    r"(?<![\w.])(?P<name>[^\W\d]\w*)(?P<path>(?:\s*(?:->|\.)\s*[^\W\d]\w*)*)(?P<at>\s*\[\s*\d{1,2}\s*(?:,\s*\d\s*)?\](?:\s*\[\s*\d\s*\])?|\s*\(\s*\d{1,2}\s*(?:,\s*\d\s*)?\))?(?P<call>\s*\()?"
)
PUT = re.compile(
    r"\(?\s*\*?\s*(?P<name>[^\W\d]\w*)\s*\)?\s*(?:(?:->|\.)\s*(?:data|values|elements|x|q)\s*)?(?:\[|\()\s*(?P<i>\d{1,2})\s*(?:(?:,|\]\s*\[|\)\s*\()\s*(?P<j>\d)\s*)?[\])]"
)
SLICE = re.compile(r"(?<![\w.])(?P<x>[^\W\d]\w*)\s*(?:\[|\()\s*(?P<a>-?\d)?\s*:\s*(?P<b>\d)?\s*[\])]")
PART = re.compile(r"(?P<x>[^\W\d]\w*)\s*(?:\[|\()\s*(?P<a>-?\d)?\s*:\s*(?P<b>\d)?\s*[\])]")
ENTRY = re.compile(  # params[0], p->l, model.m[1]
    r"\(?\s*(?P<of>[^\W\d]\w*)(?P<path>(?:\s*(?:->|\.)\s*[^\W\d]\w*)*)(?P<at>\s*[\[(]\s*\d{1,2}\s*[\])])?\s*\)?"
)
NUMBER = re.compile(r"[-+]?\s*(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
NUMERIC = re.compile(r"[-+*/().\s0-9eE]*[0-9][-+*/().\s0-9eE]*")
DATA_OF = re.compile(
    r"\b(?:N_VGetArrayPointer\w*|NV_DATA_S|NV_DATA|as_ref|as_slice|data|begin|std::begin)\s*\(\s*(\w+)\s*\)"
)
ITH = re.compile(r"\b(?P<f>NV_Ith_S|NV_Ith|Ith|IJth)\s*\(\s*(?P<x>\w+)\s*,\s*(?P<k>\d)\s*\)")
CHANGES = re.compile(
    r"set|update|apply|step|integrate|clamp|constrain|wrap|limit|copy|swap|fill|move|add|scale|mult|normal|rk4|euler|solve",
    re.IGNORECASE,
)
MOST_INLINED, DEEPEST = 60, 6
Index = tuple[int, ...]


@dataclass
class Words:
    """``state``: the parameter that is the state, "" for none; ``entries``: of each array that is filled, by place."""

    program: Program
    function: Function
    known: frozenset[str]  # the quantities and names that the file declares
    given: Mapping[str, str]  # what [define] says of entries, by "u[0]"
    state: str
    state_name: str
    locals: frozenset[str]
    lines: list[tuple[str, str]] = field(default_factory=list)
    entries: dict[str, dict[Index, str]] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)
    quantities: set[str] = field(default_factory=set)  # locals that are entries of parameters
    constants: set[str] = field(default_factory=set)
    sources: dict[str, str] = field(default_factory=dict)  # what each entry of a parameter is called
    members: dict[str, set[str]] = field(default_factory=dict)
    updates: list[Statement] = field(default_factory=list)
    returned: str | None = None
    inlined: int = 0
    depth: int = 0
    first: int = 0
    size: int = 0  # of the state

    def parameter(self, name: str) -> str:
        """The parameter that a name stands for; an empty text for none."""
        name = self.aliases.get(name, name)
        return name if any(p.name == name for p in self.function.parameters) else ""

    def with_entries(self, text: str) -> str:
        """SUNDIALS' NV_Ith_S(y, 0), and Ith(y, 1) of its examples, as y[0]."""
        return ITH.sub(lambda m: f"{m['x']}[{int(m['k']) - (m['f'] == 'Ith') + self.first}]", text)

    def number_parameters(self) -> set[str]:
        return {p.name for p in self.function.parameters if p.kind == "number"}

    def given_of(self, bare: str) -> str | None:
        return self.given.get(re.sub(r"[\s()]", lambda m: {"(": "[", ")": "]"}.get(m[0], ""), bare.strip()))

    def local(self, name: str) -> str:
        """A local name as it is written here."""
        name = name.replace("·", "field")
        bare = name.strip("_") or name
        if name in self.constants:
            return f"{bare}local"
        return f"{bare}{'local'}" if name in self.clashes() else bare if name != "_" else "_"

    def clashes(self) -> set[str]:
        """Local names that would be those of quantities, once underscores are gone."""
        outer = {word for word in re.findall(r"\b[^\W\d]\w*\b", " ".join(s.value for s in self.function.statements))
                 if word not in self.locals and word != word.strip("_")}  # fmt: skip
        return {name for name in self.locals if name.strip("_") in {w.strip("_") for w in outer}} | {
            name for name in self.locals if name in MATHS or name == self.state_name
        }

    def whole(self, name: str) -> str:
        """All entries of an array that is filled."""
        held = self.entries[name]
        if not held:
            raise InvalidInput(f"{name} is read before it is filled")
        rows = max(place[0] for place in held) + 1
        columns = max((place[1] + 1 for place in held if len(place) == 2), default=0)
        wanted = [(r, c) for r in range(rows) for c in range(columns)] if columns else [(r,) for r in range(rows)]
        missing = next((place for place in wanted if place not in held), None)
        if missing:
            raise InvalidInput(f"{name}: entry {', '.join(str(k + self.first) for k in missing)} is not given")
        parts = [held[place] for place in wanted]
        return in_rows(parts, columns) if columns else "[" + ", ".join(parts) + "]"

    def cleaned(self, value: str) -> str:
        return methods(plain_expression(value, self.program.whole, self.program.powers))

    def written(self, value: str) -> str:
        """The expression with what its words stand for."""
        text = SLICE.sub(self.slice, self.calls(self.cleaned(value)))
        text = (
            re.sub(r"(?<=[-+*/(,=])\s*\*\s*(?=[^\W\d])(?!\*)|^\s*\*\s*(?=[^\W\d])", " ", text)
            if self.has_pointers()
            else text
        )
        text = re.sub(r"(?<![\w)\]])&\s*(?=[^\W\d])", "", text)
        return WORD.sub(self.word, text)

    def slice(self, found: re.Match[str]) -> str:
        """x[1:2] as the list of its entries; the last is one of them where entries are counted from 1."""
        first, last = self.ends(found)
        return "[" + ", ".join(f"{found['x']}[{k}]" for k in range(first, last)) + "]"

    def ends(self, found: re.Match[str]) -> tuple[int, int]:
        size = self.size if self.parameter(found["x"]) else len(self.entries.get(found["x"], ()))
        first = int(found["a"]) if found["a"] else self.first
        first += size if first < 0 else 0
        last = (int(found["b"]) + (1 if self.first else 0)) if found["b"] else size + self.first
        return first, last

    def has_pointers(self) -> bool:
        return any(s.target.startswith("*") for s in self.function.statements)

    def calls(self, text: str) -> str:
        """The expression with a name for what each helper function comes to."""
        at = 0
        names = {f.name: f for f in self.program.functions if f.name and f is not self.function}
        for _ in range(MOST_INLINED):
            found = re.compile(r"(?<![\w.])(?P<name>[^\W\d]\w*)\s*\(").search(text, at)
            if found is None:
                return text
            at = found.end()
            helper = names.get(found["name"])
            end = closing(text, found.end() - 1)
            if helper is None or end < 0 or found["name"] in MATHS:
                continue
            result = self.inline(helper, parts_of(text[found.end() : end], ","))
            text = f"{text[: found.start()]}{result}{text[end + 1 :]}"
            at = found.start()
        raise InvalidInput("functions that call each other more than sixty times; write out what they come to")

    def inline(self, helper: Function, arguments: list[str]) -> str:
        """The lines of a helper function, under names of its own; the name of what it returns."""
        self.inlined += 1
        if self.depth >= DEEPEST or self.inlined > MOST_INLINED:
            raise InvalidInput("functions that call each other more than six deep; write out what they come to")
        if helper.refused:
            raise InvalidInput(f"{helper.name}: {helper.refused}")
        arguments = [a for a in arguments if a]
        names = [p.name for p in helper.parameters]
        if len(names) != len(arguments) or any(not n.isidentifier() for n in names):
            raise InvalidInput(f"{helper.name}(…) is called with {len(arguments)} values for {len(names)}")
        prefix = f"h{self.inlined}"
        own = {
            name: f"{prefix}{name.strip('_')}"
            for name in [
                *names,
                *(s.target for s in helper.statements if s.target.isidentifier() and s.target != RETURN),
            ]
        }
        self.depth += 1
        passed: dict[str, str] = {}
        for name, argument in zip(names, arguments, strict=True):
            if re.fullmatch(r"[^\W\d]\w*(?:\[\d\])?", argument.strip()):
                passed[name] = argument.strip()
            else:
                self.lines.append((own[name], self.written(argument)))
        result = ""
        for one in helper.statements:
            value = re.sub(
                r"(?<![\w.])([^\W\d]\w*)\b(?!\s*\()", lambda m: passed.get(m[1], own.get(m[1], m[1])), one.value
            )
            if value.startswith(ALLOCATED) or (one.target != RETURN and not one.target.isidentifier()):
                raise InvalidInput(f"{helper.name}: a helper function with arrays; write out what it comes to")
            if one.target == RETURN:
                text = self.written(value)
                if text.strip()[:1] == "[":
                    raise InvalidInput(f"{helper.name}: a helper function that returns several values; write them out")
                self.lines.append((f"{prefix}is", text))
                result = f"{prefix}is"
            else:
                passed.pop(one.target, None)
                self.lines.append((own[one.target], self.written(value)))
        self.depth -= 1
        if not result:
            raise InvalidInput(f"{helper.name} returns nothing; write out what it does")
        return result

    def word(self, found: re.Match[str]) -> str:  # noqa: PLR0911 -- one for each kind of word
        name, path, at = found["name"], re.sub(r"\s", "", found["path"] or ""), re.sub(r"\s", "", found["at"] or "")
        call = found["call"] or ""
        if name in MATHS and name not in self.locals:
            return f"{name}{path}{found['at'] or ''}{call}"
        if call:
            raise InvalidInput(
                f"{(name + path)[:30]}(…) is no function that is known here; write out what it comes to, or * for a product"
            )
        if (
            path
            and not at
            and re.fullmatch(r"(?:->|\.)[xyzw]", path)
            and (self.parameter(name) == self.state and self.state)
        ):
            return f"{self.state_name}[{'xyzw'.index(path[-1])}]"
        source = self.parameter(name)
        if source and source == self.state and name not in self.entries:
            if path:
                raise InvalidInput(f"{(name + path)[:40]}: fields of the state are not followed; give each its name")
            if not at:
                return self.state_name
            k = re.findall(r"\d+", at)
            if len(k) != 1 or int(k[0]) < self.first:
                raise InvalidInput(f"{name}{at}: entries of the state are counted from {self.first} here")
            return f"{self.state_name}[{int(k[0]) - self.first}]"
        if name in self.entries and not path:
            if not at:
                return self.whole(name)
            place = tuple(int(k) - self.first for k in re.findall(r"\d+", at))
            if place not in self.entries[name]:
                raise InvalidInput(f"{name}{at} is read before it is written")
            return self.entries[name][place]
        if path:
            return self.member(name, path, at)
        if at:
            return self.entry(name, at)
        return self.outer(name)

    def entry(self, name: str, at: str) -> str:
        """x[0] of what is no array that is filled here."""
        said = self.given_of(name + at)
        if said is not None:
            return f"({said})"
        if name in self.locals:
            places = [int(k) - self.first for k in re.findall(r"\d+", at)]
            return self.local(name) + "".join(f"[{k}]" for k in places)
        if self.first == 1 and re.fullmatch(r"[\[(]\d[\])]", at):
            return f"{name.strip('_')}{at[1]}"
        raise InvalidInput(f"{name}{at}: say what this entry is, as in [define] '{name}{at}' = \"…\"")

    def member(self, name: str, path: str, at: str) -> str:
        """params.m1, p->l: the last word, where it is one thing."""
        parts = [part for part in re.split(r"->|\.", path) if part]
        if at:
            return self.entry(parts[-1], at)
        if name in self.locals and f"{name}·{parts[-1]}" in self.locals:
            return self.local(f"{name}·{parts[-1]}")
        owner = name + "." + ".".join(parts[:-1])
        said = self.given_of(f"{name}.{'.'.join(parts)}")
        if said is not None:
            return f"({said})"
        self.members.setdefault(parts[-1], set()).add(owner)
        if len(self.members[parts[-1]]) > 1:
            return f"{name}{parts[-1]}"
        if (
            parts[-1] in self.locals
            and parts[-1] not in self.quantities
            and any(t == self.local(parts[-1]) for t, _ in self.lines)
        ):
            raise InvalidInput(f"{name}{path} and {parts[-1]} are two things here; give each a name of its own")
        return self.outer(parts[-1], is_member=True)

    def outer(self, name: str, is_member: bool = False) -> str:
        if name in self.locals and not is_member and name not in self.quantities:
            written = any(
                target in (self.local(name), f"{self.local(name)},") or self.local(name) in target.split(", ")
                for target, _ in self.lines
            )
            if not written and (
                not self.parameter(name) or f"*{name}" in {s.target.replace(" ", "") for s in self.function.statements}
            ):
                raise InvalidInput(f"{name} is read before it is written")
            return self.local(name)
        if is_member and name in self.clashes():
            return name
        return name.strip("_") or name
