"""What programs call a coordinate's rate and its acceleration: dtheta1, theta1_v, omega1; ddtheta1, alpha1."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ..names import GLYPHS

FIRST = ("{b}dot{i}", "{b}{i}dot", "d{b}{i}", "d{b}{i}dt", "{b}{i}d", "{b}d{i}", "{b}{i}v", "{b}{i}vel", "{b}vel{i}",
         "vel{b}{i}", "{b}{i}velocity", "{b}velocity{i}", "{b}{i}p", "{b}p{i}", "{b}{i}prime", "{b}prime{i}", "v{b}{i}",
         "dot{b}{i}", "{b}{i}t", "deriv{b}{i}", "{b}v{i}", "{b}{i}speed", "w{b}{i}", "omega{b}{i}", "{b}rate{i}",
         "der{b}{i}", "{b}{i}rate", "{b}omega{i}")  # fmt: skip
SECOND = ("{b}ddot{i}", "{b}{i}ddot", "dd{b}{i}", "d2{b}{i}", "d2{b}{i}dt2", "{b}{i}dd", "{b}dd{i}", "{b}{i}a",
          "{b}{i}acc", "{b}acc{i}", "acc{b}{i}", "{b}{i}acceleration", "{b}acceleration{i}", "{b}{i}accel",
          "{b}accel{i}", "{b}dotdot{i}", "{b}{i}dotdot", "a{b}{i}", "{b}a{i}", "ddot{b}{i}", "{b}{i}pp", "{b}pp{i}",
          "{b}doubledot{i}", "{b}{i}doubledot", "alpha{b}{i}", "{b}{i}doubleprime", "{b}alpha{i}")  # fmt: skip
TURNING_FIRST = ("omega{i}", "w{i}", "angularvelocity{i}", "angvel{i}", "angularvel{i}", "avelocity{i}", "avel{i}",
                 "vel{i}", "velocity{i}", "rodvelocity{i}", "angularspeed{i}", "om{i}", "angv{i}", "av{i}")  # fmt: skip
TURNING_SECOND = ("alpha{i}", "angularacceleration{i}", "angacc{i}", "angularacc{i}", "aacceleration{i}", "aacc{i}",
                  "acc{i}", "acceleration{i}", "accel{i}", "angularaccel{i}", "domega{i}", "dw{i}", "omegadot{i}",
                  "wdot{i}", "domega{i}dt", "angaccel{i}")  # fmt: skip
SLIDING_FIRST = ("v", "vel", "velocity", "speed")
SLIDING_SECOND = ("a", "acc", "acceleration", "accel", "dv", "vdot")


def simple(name: str) -> str:
    """A name without underscores and capitals, its Greek letters as words."""
    return "".join(GLYPHS.get(c, c) for c in re.sub("_", "", name)).lower()


def rates_of(name: str, names: Iterable[str], *, turns: bool, alone: bool) -> list[str]:
    """Those of the names that are the rate of a coordinate. ``alone``: no other coordinate is of its kind."""
    general = TURNING_FIRST if turns else SLIDING_FIRST if alone else ()
    return _found(name, names, (FIRST, general), alone)


def accelerations_of(name: str, names: Iterable[str], *, turns: bool, alone: bool) -> list[str]:
    """Those of the names that are the acceleration of a coordinate."""
    general = TURNING_SECOND if turns else SLIDING_SECOND if alone else ()
    return _found(name, names, (SECOND, general), alone)


def derivatives_of(name: str, names: Iterable[str]) -> list[str]:
    """Those of the names that say the derivative of one: domega1, omega1_dot of omega1."""
    forms = ("d{b}{i}", "{b}{i}dot", "{b}dot{i}", "d{b}{i}dt", "{b}{i}prime", "{b}{i}p", "d{b}dt{i}", "dot{b}{i}",
             "der{b}{i}", "deriv{b}{i}")  # fmt: skip
    return _found(name, names, (forms,), False)


def _found(name: str, names: Iterable[str], families: tuple[tuple[str, ...], ...], alone: bool) -> list[str]:
    plain = simple(name)
    base = plain.rstrip("0123456789")
    index = plain[len(base) :]
    by_word: dict[str, str] = {}
    for other in names:
        by_word.setdefault(simple(other), other)
    for family in families:
        words = [form.format(b=base, i=i) for form in family for i in ([index, ""] if alone else [index])]
        hits = list(dict.fromkeys(by_word[word] for word in words if word in by_word and word != plain))
        if hits:
            return hits
    return []
