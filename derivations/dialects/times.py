r"""Explicit time: a support that moves as y_s = a cos Ωt, a torque F cos ωt, in a mechanism that a file declares.

With ``[define] y_s = 'a\cos\Omega t'`` cos Ωt is -y_s''/(a Ω²) and sin Ωt is -y_s'/(a Ω): identities, so that rows with
them mean what they say. Where y_s itself stands in the true rows, as behind a spring, the same function would have two
names; that is refused. Cosines in a drive, which may be any function of time, are quantities of their own.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import Any

from ...models.errors import InvalidInput
from .lines import BLANKS, LONGEST_LINE
from .names import WRITTEN, plain_name

_SPACE = r"(?:\s|\\[,;:! ])*"
_INDEX = r"(?:_\{[0-9A-Za-z]{1,8}\}|_?\{?[0-9A-Za-z]\}?)?"
_NAME = rf"(?:\\(?:Omega|omega|gamma|nu|beta|alpha|lambda|sigma)|[ΩωγνβαλσA-Za-z]){_INDEX}"
_TIMES = r"(?:\*|\\cdot(?![A-Za-z])|·|⋅)"
_ANGLE = rf"(?P<rate>{_NAME}){_SPACE}{_TIMES}?{_SPACE}t"
_WORD = r"[A-Za-z]\w{0,14}"
# A rate of several letters, or a number, has its sign of a product; what is added is a phase
_LONG = rf"(?:(?P<long>{_WORD}|[0-9]{{1,6}}(?:\.[0-9]{{1,6}})?){_SPACE}{_TIMES}{_SPACE})?t(?![A-Za-z0-9_])"
_SHIFT = rf"(?:{_SPACE}(?P<sign>[+−-]){_SPACE}(?P<shift>\\?{_WORD})(?![A-Za-z0-9_(]))?"
PHASE = re.compile(
    rf"(?:(?<![A-Za-z\\])(?:np\.|math\.|Math\.)?|\\)(?P<wave>cos|sin){_SPACE}"
    rf"(?:(?:\\left)?[(\{{\[]{_SPACE}(?:{_ANGLE}(?![A-Za-z0-9_])|{_LONG}){_SHIFT}{_SPACE}(?:\\right)?[)\}}\]]"
    rf"|{_ANGLE.replace('P<rate>', 'P<bare>')}(?![A-Za-z0-9_]))"
)
_OF = r"(?:[0-9]?\s*\\?[A-Za-zθϕφψα][^()+−-]{0,20}?)"
_IN = (
    rf"(?:{_ANGLE.replace('P<rate>', 'P<first>')}{_SPACE}(?P<s1>[-+−]){_SPACE}(?P<of1>{_OF})"
    rf"|(?P<of2>{_OF}){_SPACE}(?P<s2>[-+−]){_SPACE}{_ANGLE.replace('P<rate>', 'P<second>')})"
)
# sin(φ - γt), whose cosine and sine of time are taken out
TOGETHER = re.compile(
    rf"(?:(?<![A-Za-z\\])(?:np\.|math\.|Math\.)?|\\)(?P<wave>cos|sin){_SPACE}(?:\\left\s*)?\({_SPACE}{_IN}{_SPACE}(?:\\right\s*)?\)"
)
FIELDS = ("equations", "solved")
ENERGIES = ("lagrangian", "kinetic", "potential", "hamiltonian")
Wave = tuple[str, str, str]  # cos or sin, the rate, and the phase behind it


def with_times(data: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The fields with rates and quantities in place of cosines of time, and the names of constants that these need."""
    bodies, define = data.get("bodies"), data.get("define", {})
    if not isinstance(bodies, list) or len(bodies) > 8 or not all(isinstance(b, dict) for b in bodies):
        return data, []
    if not isinstance(define, dict) or any(plain_name(str(b.get("coordinate", ""))) == "t" for b in bodies):
        return data, []  # a coordinate that is called t is no time
    given = {plain_name(str(b.get("coordinate", ""))): b for b in bodies if b.get("motion") == "given"}
    if given:
        own = [line for name, line in define.items() if plain_name(str(name).removesuffix("(t)")) in given]
        said = {_key(m)[1:] for line in own if _is_plain(line) for m in PHASE.finditer(line)}
        data = data | {f: _apart(data[f], said) for f in (*FIELDS, *ENERGIES) if f in data}
    if not _has_phase([data.get(f) for f in (*FIELDS, *ENERGIES)]):
        return data, []
    waves: dict[Wave, str] = {}
    places: dict[Wave, str] = {}  # in a Lagrangian: what moves so, itself
    slower: list[tuple[Wave, str, str]] = []
    moved: dict[str, tuple[str, str, str]] = {}
    constants: list[str] = []
    kept = {}
    for name, line in define.items():
        coordinate = plain_name(str(name).removesuffix("(t)"))
        if coordinate not in given or not isinstance(line, str):
            kept[name] = line
            continue
        if given[coordinate].get("joint") != "slide" or given[coordinate].get("along") == "link":
            raise InvalidInput(f"define.{name}: a given motion is put in for a slide that is fixed in direction; "
                               f"here write the rows with {coordinate} and its rates")  # fmt: skip
        amplitude, found = motion_of(name, line)
        if any("spring" in b for b in bodies):
            raise InvalidInput(f"define.{name}: with a spring in the mechanism, leave cosines out; write "
                               f"{coordinate}'' and {coordinate} in the rows")  # fmt: skip
        rate = rate_of(found)
        written = str(given[coordinate]["coordinate"]).replace("\\", "")
        second, first = f"(-{written}''/(({amplitude})*{rate}^2))", f"({written}'/(({amplitude})*{rate}))"
        other = "sin" if found["wave"] == "cos" else "cos"
        first = f"(-{first})" if other == "sin" else first
        key = _key(found)
        if key in waves:
            raise InvalidInput(f"define.{name}: two motions with one frequency; write the rows with {coordinate}''")
        waves[key], places[key] = second, f"({written}/({amplitude}))"
        slower.append(((other, *key[1:]), first, first))
        moved[coordinate or ""] = (amplitude, found["wave"], rate)
        constants += [*names_in(amplitude), *names_in(rate)]
    for key, in_rows, in_energies in slower:  # where nothing else moves so, what is a quarter of a turn behind
        waves.setdefault(key, in_rows)
        places.setdefault(key, in_energies)
    waves |= _of_drives(bodies, waves, constants)
    timed = bool(moved) and _is_timed(data, bodies, places)
    made = {f: _mapped(data[f], places if f in ENERGIES else waves, f) for f in (*FIELDS, *ENERGIES) if f in data}
    if timed:
        made["moved"] = moved
    made["define"] = {name: _mapped(line, waves, f"define.{name}") for name, line in kept.items()}
    made["bodies"] = [
        {k: _mapped(v, waves, f"bodies: {k}") if k == "drive" else v for k, v in b.items()} for b in bodies
    ]
    if "define" not in data:
        del made["define"]
    return data | made, list(dict.fromkeys(constants))


def rate_of(found: re.Match[str]) -> str:
    """The rate of a cosine of time; 1 of cos t."""
    return found["rate"] or found["bare"] or found["long"] or "1"


def _key(found: re.Match[str]) -> Wave:
    rate = rate_of(found)
    return found["wave"], plain_name(rate) or rate, (found["sign"] or "") + (plain_name(found["shift"] or "") or "")


def _is_timed(data: dict[str, Any], bodies: list[dict[str, Any]], places: Mapping[Wave, str]) -> bool:
    """Whether the Lagrangian has cosines of time. Raises InvalidInput where more than that is given."""
    if not any(_has_phase([data.get(f)]) for f in ENERGIES):
        return False
    if any(shift or plain_name(rate) is None for _, rate, shift in places):
        raise InvalidInput("lagrangian: a cosine of time with a phase or without a rate; give the rows in [equations]")
    others = any(f in data for f in (*FIELDS, *ENERGIES) if f != "lagrangian")
    if others or any(force in b for b in bodies for force in ("drive", "damping", "friction")):
        raise InvalidInput(
            "a cosine of time in an energy; write it with the support's own coordinate and rate, or give the rows in "
            "[equations]"
        )
    return True


def motion_of(name: str, line: str) -> tuple[str, re.Match[str]]:
    """The amplitude and the cosine of a given motion."""
    found = list(PHASE.finditer(line))
    bare = line.strip().rstrip(" ;.,")
    if len(found) != 1 or not bare.endswith(found[0][0].strip()):
        raise InvalidInput(f"define.{name}: a given motion is read as an amplitude times a cosine or sine, as in "
                           f"{name} = \"a*cos(w*t)\"; write other motions as {name}'' in the rows")  # fmt: skip
    before = line[: found[0].start()].strip()
    before = re.sub(rf"(?:\*|\\cdot|·|\\,|{_SPACE})$", "", before).strip().rstrip("*").strip()
    amplitude = {"": "1", "-": "(-1)", "+": "1"}.get(before, before)
    if re.search(r"(?<=[^\s(])\s*[+−-]", amplitude):
        raise InvalidInput(f"define.{name}: a sum; a given motion is read as an amplitude times a cosine or sine")
    return amplitude, found[0]


def _of_drives(bodies: list[Any], known: Mapping[Wave, str], constants: list[str]) -> dict[Wave, str]:
    """A quantity for each cosine in a drive."""
    made: dict[Wave, str] = {}
    for body in bodies:
        for found in PHASE.finditer(str(body.get("drive", ""))[:200]):
            key = _key(found)
            if key not in known and key not in made:
                made[key] = f"{found['wave'][0]}wave{len(made) + 1}"
    constants += made.values()
    return made


def names_in(text: str) -> list[str]:
    """The names in a product of quantities."""
    return [m[0] for m in WRITTEN.finditer(re.sub(r"\\[dt]?frac|(?<![\w{])[0-9.]+", " ", text))]


def _has_phase(values: list[Any]) -> bool:
    lines = [x for v in values for x in (v.values() if isinstance(v, dict) else v if isinstance(v, list) else [v])]
    return any(_is_plain(x) and PHASE.search(x) for x in lines)


def _mapped(value: Any, waves: Mapping[Wave, str], where: str) -> Any:
    if isinstance(value, dict):
        return {k: _mapped(v, waves, f"{where}.{k}") for k, v in value.items()}
    if isinstance(value, list):
        return [_mapped(v, waves, where) for v in value]

    def one(found: re.Match[str]) -> str:
        text = waves.get(_key(found))
        if text is None:
            raise InvalidInput(
                f"{where}: column {found.start() + 1}: {found[0].strip()[:30]} is a function of time; say what "
                'moves so: drive = "F*cos(w*t)", or a support with motion = \'given\' and [define] x_s = "a*cos(w*t)"'
            )
        return f" {text} "

    return PHASE.sub(one, value) if _is_plain(value) else value


def _apart(value: Any, said: Collection[tuple[str, str]]) -> Any:
    """sin(φ - γt) as sin φ cos γt - cos φ sin γt; not where that is the phase of a motion (``said``)."""
    if isinstance(value, dict):
        return {k: _apart(v, said) for k, v in value.items()}
    if isinstance(value, list):
        return [_apart(v, said) for v in value]

    def one(found: re.Match[str]) -> str:
        whole = PHASE.fullmatch(found[0])
        return found[0] if whole is not None and _key(whole)[1:] in said else _of_two(found)

    return TOGETHER.sub(one, value) if _is_plain(value) and "t" in value else value


def _of_two(found: re.Match[str]) -> str:
    of, sign = (found["of1"] or found["of2"]).strip(), found["s1"] or found["s2"]
    rate = found["first"] or found["second"]
    one, two, other, wave = f"sin({of})", f"cos({of})", f"sin({rate} t)", f"cos({rate} t)"
    slash = "\\" if "\\" in found[0] else ""
    one, two, other, wave = (slash + x for x in (one, two, other, wave))
    minus = sign != "+"
    if found["wave"] == "cos":
        return f"({two} {wave} {'+' if minus else '-'} {one} {other})"
    first, second = f"{one} {wave}", f"{two} {other}"
    if found["of1"] and minus:
        first, second = second, first
    return f"({first} {'-' if minus else '+'} {second})"


def _is_plain(value: object) -> bool:
    return isinstance(value, str) and len(value) <= LONGEST_LINE and not BLANKS.search(value)
