"""A function's statements as Python's: entries of arrays as names, fields and helper functions put in."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from ....models.errors import InvalidInput
from ..languages.expressions import in_rows, parts_of_vectors
from ..languages.program import ALLOCATED, CALL, RETURN, Function, Statement
from ..markup.calls import closing, parts_of
from ..names import plain_name
from .words import CHANGES, DATA_OF, ENTRY, NUMERIC, PART, PUT, Index, Words


@dataclass
class Writer(Words):
    """Follows statements, one after another; ``lines`` are Python's."""

    def statement(self, one: Statement) -> None:  # noqa: PLR0911 -- one for each kind of statement
        """Follow one statement."""
        value, target = self.with_entries(DATA_OF.sub(r"\1", one.value)), self.with_entries(one.target)
        if target == RETURN and any(place.startswith(f"{value.strip()}·") for place in self.locals):
            return  # a struct whose fields are followed
        if target == RETURN:
            self.returned = self.written(value) if value and not self.is_trivial(value) else self.returned
            return
        if target == CALL:
            self.without_effect(value)
            return
        if value.startswith(ALLOCATED):
            self.entries[target] = {}
            self.types[target] = value[len(ALLOCATED) :].strip()
            return
        if value.startswith("<<"):
            self.fill(target, value[2:])
            return
        target = parts_of_vectors(re.sub(r"^(?:this\s*(?:->|\.)|self\s*\.|@)", "", target).strip())
        if target[:1] == "(" and target[-1:] == ")" and not PUT.fullmatch(target) and target.count("*") == 0:
            self.take_apart(target[1:-1], value)
            return
        part = PART.fullmatch(target)
        if part:
            self.put_part(part, value, one)
            return
        found = PUT.fullmatch(target)
        if found and (
            found["name"] not in self.locals or found["name"] in self.entries or self.parameter(found["name"])
        ):
            self.put(found["name"], found["i"], found["j"], self.written(value), one)
            return
        push = re.fullmatch(r"(\w+)\[\+\]", target)
        if push:
            held = self.entries.setdefault(push[1], {})
            self.put(push[1], str(len(held) + self.first), None, self.written(value), one)
            return
        name = target.lstrip("*").strip()
        path = re.fullmatch(r"(?P<owner>[^\W\d]\w*)(?:->|\.)(?P<field>[^\W\d]\w*)", name)
        if path:
            self.scalar(f"{path['owner']}·{path['field']}", value)
            return
        if not re.fullmatch(r"[^\W\d]\w*", name):
            raise InvalidInput(f"{target[:40]!r}: a name is needed on the left of an assignment")
        self.scalar(name, value)

    def without_effect(self, text: str) -> None:
        """Raises InvalidInput where a call may change what the equations are made of."""
        name = re.match(r"(?:[\w.:>-]*(?:->|\.|::))?(\w+)", text)
        arrays = {
            n
            for n in (
                *self.entries,
                *self.aliases,
                self.state,
                *(p.name for p in self.function.parameters if p.kind == "array"),
            )
            if n
        }
        used = set(re.findall(r"[^\W\d]\w*", text.partition("(")[2]))
        own = {f.name for f in self.program.functions}
        changes = name is None or name[1] in own or CHANGES.search(name[1]) or "&" in text or used & arrays
        if changes:
            raise InvalidInput(f"{text[:40]!r}: assignments and one return are followed, and nothing else")

    def is_trivial(self, value: str) -> bool:
        """return 0, GSL_SUCCESS, nothing: a word that is no array of this function's."""
        return (
            re.fullmatch(
                r"-?\d|[A-Z][A-Z_0-9]+|nil|null|None|nothing|true|false|void|undefined|Ok\(\(\)\)|\(\s*\)|\(?0\)?",
                value,
            )
            is not None
        )

    def scalar(self, name: str, value: str) -> None:  # noqa: PLR0912 -- one for each kind of value
        bare = self.cleaned(value)
        if bare.strip() == name:
            self.quantities.add(name)
            return
        if re.fullmatch(r"\(?\s*[&*]?\s*[^\W\d]\w*\s*\)?", bare):
            source = re.sub(r"[()&*\s]", "", bare)
            owner = self.parameter(source)
            if owner and name != source and (owner != self.state or source != name):
                kind = next(p.kind for p in self.function.parameters if p.name == owner)
                if kind != "number" and owner not in self.number_parameters():
                    self.aliases[name] = owner
                    return
        entry = ENTRY.fullmatch(bare)
        if entry and not (entry["path"] or entry["at"]):
            entry = None
        if entry and self.is_quantity(entry["of"], bare, name):
            source = re.sub(r"\s", "", bare)
            if self.sources.setdefault(source, name) != name:
                raise InvalidInput(f"{source[:30]} is both {self.sources[source]} and {name}")
            self.quantities.add(name)
            return
        plain = plain_name(name.strip("_")) or name
        if (
            name in self.number_parameters()
            and plain in self.known
            and f"*{name}" not in {s.target for s in self.function.statements}
        ):
            raise InvalidInput(f"{name} is changed; give each value a name of its own")
        if NUMERIC.fullmatch(bare) and (plain in self.known or name in self.known):
            self.quantities.add(name)
            return
        if NUMERIC.fullmatch(bare):
            self.constants.add(name)  # a number of its own, which is no quantity's value
        text = self.written(value)
        if text.strip() == self.local(name):
            self.quantities.add(name)
            return
        bare_text = text.strip()
        if (
            bare_text[:1] == "("
            and closing(bare_text, 0) == len(bare_text) - 1
            and len(parts_of(bare_text[1:-1], ",")) > 1
        ):
            text = f"[{bare_text[1:-1]}]"
        self.entries.pop(name, None)
        if (
            self.parameter(name)
            and name != self.state
            and text.strip()[:1] == "["
            and closing(text.strip(), 0) == len(text.strip()) - 1
        ):
            self.entries[name] = {}
            for k, each in enumerate(parts_of(text.strip()[1:-1], ",")):
                self.put(name, str(k + self.first), None, each, Statement(name, each))
            return
        self.aliases.pop(name, None)
        self.quantities.discard(name)
        if text.strip()[:1] == "[":
            self.types.setdefault(name, "list")
        self.lines.append((self.local(name), text))

    def is_quantity(self, owner: str, bare: str, name: str) -> bool:
        """Whether m = params[0], or l1 = p.len1, says no more than what a quantity is called."""
        of = self.parameter(owner)
        if of == self.state and of:
            return False
        if self.given_of(bare):
            return False
        if owner in self.entries or (owner in self.locals and not of and owner not in self.types):
            return False
        if re.search(r"[\[(]", bare) and re.search(r"->|\.", bare):
            return (plain_name(name.strip("_")) or name) in self.known
        if re.search(r"[\[(]", bare):
            return bool(of) or owner not in self.locals
        last = plain_name(re.split(r"->|\.", bare)[-1].strip(" )").strip("_"))
        return (plain_name(name.strip("_")) in self.known and last not in self.known) or last == plain_name(
            name.strip("_")
        )

    def fill(self, target: str, text: str) -> None:
        """M << a, b, c, d."""
        parts = [self.written(part) for part in parts_of(text, ",")]
        of = self.types.get(target, "")
        width = (
            {4: 2, 9: 3, 16: 4}.get(len(parts), 0) if re.search(r"[Mm]at", of) and not re.search(r"\b1\b", of) else 0
        )
        value = in_rows(parts, width) if width else "[" + ", ".join(parts) + "]"
        self.entries.pop(target, None)
        if self.parameter(target):
            self.entries[target] = {}
            for k, part in enumerate(parts):
                self.put(target, str(k + self.first), None, part, Statement(target, part))
            return
        self.lines.append((self.local(target), value))

    def take_apart(self, names: str, value: str) -> None:
        parts = [
            re.sub(r"^(?:let|mut|const|var|ref|&)\s+", "", part).split(":")[0].strip() for part in parts_of(names, ",")
        ]
        source = self.parameter(re.sub(r"^[&*]|\.\w+\(\)$", "", value.strip()))
        if source and source != self.state:
            self.quantities |= set(parts)
            return
        text = self.written(re.sub(r"^[&*]+|\.(?:into|clone|to_owned|values)\(\)$", "", value.strip()))
        for part in parts:
            self.entries.pop(part, None)
        self.lines.append((", ".join(self.local(part) for part in parts) + ("," if len(parts) == 1 else ""), text))

    def put(self, name: str, i: str, j: str | None, text: str, one: Statement) -> None:
        """One entry of an array."""
        if name == self.state or self.aliases.get(name) == self.state:
            raise InvalidInput(f"{one.target[:30]}: the state itself is changed; give each value a name of its own")
        place: Index = (int(i) - self.first,) if j is None else (int(i) - self.first, int(j) - self.first)
        if min(place) < 0:
            raise InvalidInput(f"{one.target[:30]}: entries are counted from {self.first} here")
        held = self.entries.setdefault(name, {})
        entry = f"{name.strip('_')}{'entry'}{''.join(map(str, place))}"
        if place in held and not one.op:
            entry = f"{held[place]}again"
        held[place] = entry
        self.lines.append((entry, text))

    def put_part(self, part: re.Match[str], value: str, one: Statement) -> None:
        """du[1:2] = …: a list, entry by entry, or a vector's entries."""
        first, last = self.ends(part)
        text = self.written(value).strip()
        if text[:1] == "[" and closing(text, 0) == len(text) - 1:
            values = parts_of(text[1:-1], ",")
        else:
            own = f"{part['x'].strip('_')}part{first}"
            self.lines.append((own, text))
            values = [f"{own}[{k}]" for k in range(last - first)]
        if len(values) != last - first:
            raise InvalidInput(f"{one.target[:30]}: {last - first} entries, and {len(values)} values")
        for k, each in enumerate(values):
            self.put(part["x"], str(first + k), None, each, Statement(one.target, each))


def locals_of(function: Function, statements: Iterable[Statement]) -> frozenset[str]:
    """The names that a function gives values to, and its parameters."""
    found: set[str] = {p.name for p in function.parameters if p.name.isidentifier()}
    found |= {
        part
        for p in function.parameters
        if p.name[:1] == "[" and p.kind == "array"
        for part in parts_of(p.name[1:-1], ",")
    }
    for one in statements:
        target = re.sub(r"^(?:this\s*(?:->|\.)|self\s*\.)", "", one.target)
        if target[:1] == "(" and not PUT.fullmatch(target):
            found |= {
                re.sub(r"^(?:let|mut|const|var|ref|&)\s+", "", part).split(":")[0].strip()
                for part in parts_of(target.strip("()"), ",")
            }
            continue
        put = PUT.fullmatch(target)
        path = re.fullmatch(r"(?P<owner>[^\W\d]\w*)(?:->|\.)(?P<field>[^\W\d]\w*)", target)
        if put:
            found.add(put["name"])
        elif path:
            found |= {path["owner"], f"{path['owner']}·{path['field']}"}
        elif target not in (RETURN, CALL):
            found.add(target.lstrip("*").removesuffix("[+]").strip())
    return frozenset(found)
