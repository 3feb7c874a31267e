"""Usual mechanisms in the letters that a text has for them: pendulums and cart-poles with their forces and losses.

Nothing is concluded from a letter: each mechanism is tried, and what a derivation is right for is said, with every
letter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

from ...dialects.letters.every_text import lines_of
from ...dialects.names import spelling
from ..hypotheses import Said

Bodies = list[dict[str, str]]

ANGLES = ("theta", "varphi", "phi", "alpha", "psi", "q")
LENGTHS = ("l", "L", "l_p", "L_p", "l_1", "L_1", "r", "R", "l_c", "l_G", "d", "a")
MASSES = ("m", "M", "m_p", "m_1", "m_b")
CARTS = (("M", "m"), ("m_c", "m_p"), ("M_c", "m_p"), ("M_c", "M_p"), ("M", "m_p"), ("m_1", "m_2"), ("m_0", "m_1"))
INERTIAS = ("I", "J", "I_p", "J_p", "I_G", "I_c", "J_c")
FORCES = ("F", "u", "f", "U")
TORQUES = ("tau", "T", "u", "Q", "F")
LOSSES = ("b", "c", "B", "mu", "gamma", "b_c", "c_1", "b_1", "d")
WORDS = ("sin", "cos", "tan", "exp", "phi", "psi", "tau", "eta", "mu")
GREEK = "theta|varphi|phi|alpha|psi|tau|mu|gamma"
MOST = 60  # mechanisms


def usual_bodies(data: Mapping[str, Any]) -> Iterator[Bodies]:
    """Mechanisms, body by body, that have all their letters in these fields of a derivation, the plainest first."""
    equations = data.get("equations")
    text = "\n".join([equations] if isinstance(equations, str) else lines_of(data))
    text = re.sub(rf"\\(?!{GREEK}|ell)[A-Za-z]+", " ", text)  # commands
    text = re.sub(r"(?<![A-Za-z\\_])[A-Za-z]{2,4}(?![A-Za-z_0-9])", _apart, text)
    yield from islice(_carts(text) if _has(text, "x") else _pendulums(text), MOST)


def said_of_bodies(bodies: Bodies) -> Said:
    """What they are, with every quantity."""
    english = "; ".join(f"{_name(body)} with {', '.join(_quantities(body))}" for body in bodies)
    japanese = "；".join(f"{_name(body)}、{'、'.join(_quantities(body))}" for body in bodies)
    return f"it is about a {english}", f"次の機構についての式である：{japanese}"


def _name(body: Mapping[str, str]) -> str:
    return f"{body['name']} ({body['coordinate']})"


def _quantities(body: Mapping[str, str]) -> list[str]:
    about = f" about the {body.get('about', 'centre')}"
    return [
        f"{name} {body[name]}{about if name == 'inertia' else ''}"
        for name in ("mass", "length", "centre", "inertia", "damping", "drive")
        if name in body
    ]


def _pendulums(text: str) -> Iterator[Bodies]:
    for angle in _present(text, ANGLES):
        for mass in (*_present(text, MASSES), "1"):
            for length in _present(text, LENGTHS):
                for pole in _poles(text, length, mass):
                    for more in _forces(text, TORQUES, taken=(mass, length, pole.get("inertia", ""))):
                        yield [{"name": "pendulum", "coordinate": angle, "mass": mass, **pole, **more}]


def _carts(text: str) -> Iterator[Bodies]:
    pairs = [pair for pair in CARTS if all(_has(text, letter) for letter in pair)]
    for angle in _present(text, ANGLES)[:2]:
        for cart, mass in pairs[:2]:
            for length in _present(text, LENGTHS)[:2]:
                for pole in _poles(text, length, mass):
                    for more in _forces(text, FORCES, taken=(cart, mass, length, pole.get("inertia", ""))):
                        yield [
                            {"name": "cart", "coordinate": "x", "joint": "slide", "mass": cart, **more},
                            {"name": "pole", "coordinate": angle, "mass": mass, **pole},
                        ]


def _poles(text: str, length: str, mass: str) -> Iterator[dict[str, str]]:
    """A point mass at the end; a rod whose inertia has a letter; uniform rods by their length, and by half of it."""
    for inertia in _present(text, INERTIAS)[:1]:
        for about in ("centre", "pivot"):
            yield {"length": length, "inertia": inertia, "about": about}
            yield {"length": length, "centre": f"{length}/2", "inertia": inertia, "about": about}
        return
    yield {"length": length}
    yield {"length": length, "centre": f"{length}/2", "inertia": f"{mass}*{length}^2/12"}
    yield {"length": f"2*{length}", "centre": length, "inertia": f"{mass}*{length}^2/3"}


def _forces(text: str, letters: tuple[str, ...], taken: tuple[str, ...]) -> Iterator[dict[str, str]]:
    """A drive and a loss, those that have a letter."""
    drive = next((x for x in _present(text, letters) if x not in taken), None)
    loss = next((x for x in _present(text, LOSSES) if x not in (*taken, drive)), None)
    yield {name: letter for name, letter in (("damping", loss), ("drive", drive)) if letter is not None}


def _present(text: str, names: tuple[str, ...]) -> list[str]:
    return [name for name in names if _has(text, name)]


def _apart(run: re.Match[str]) -> str:
    """Letters side by side, m g l; names of functions and Greek letters stay."""
    return run[0] if run[0] in WORDS else " ".join(run[0])


def _has(text: str, name: str) -> bool:
    return re.search(rf"(?<![A-Za-z_\\])(?:{spelling(name.replace('_', '')).pattern})(?![A-Za-z])", text) is not None
